/* Contact points of many solved designs.  SPDX-License-Identifier: MIT-0 */
#include <math.h>
#include "meshwright.h"

void mw_contact_points(const mw_model *m, const double *p, size_t designs, const double *phi, size_t n,
                       const double *x, int *status, double *s, double *o, double *points, unsigned *flags)
{
    for (size_t d = 0; d < designs; d++, p += m->np) {
        m->setup(p, s);
        for (size_t k = 0; k < n; k++, x += m->nx, status++, points += 3, flags++) {
            mw_contact c;
            *flags = 0;
            points[0] = points[1] = points[2] = NAN;
            if (*status < 0) continue;
            m->set_phi(s, phi[k]);
            if (mw_contact_at(m, s, x, o, &c) == MW_LINE_CONTACT) *status = MW_LINE_CONTACT;
            if (*status == MW_LINE_CONTACT) continue;
            for (int i = 0; i < 3; i++) points[i] = c.point[i];
            *flags = c.flags;
        }
    }
}
