/* Contact geometry of many solved points.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "meshwright.h"
#include "solver/touch.h"

static void no_contact_at(const mw_model *m, double *o, mw_contact *c)
{
    for (int i = 0; i < m->no; i++) o[i] = NAN;
    for (int i = 0; i < 3; i++) c->point[i] = c->normal[i] = c->major[i] = NAN;
    c->curvature_min = c->curvature_max = c->distance = c->misfit = NAN;
    c->lever_pinion = c->lever_wheel = c->ratio = NAN;
    c->line = 0;
    c->flags = 0;
}

/* Geometry of one solution, s set up for its angle; what becomes of its status. */
static int look(const mw_model *m, const double *s, const double *x, int status, double *o, mw_contact *c)
{
    const int kind = mwi_contact_at(m, s, x, o, c), touch = mwi_touch(m, x, o);
    return touch < 0 ? touch : kind == MW_LINE_CONTACT ? kind : status;
}

void mw_contacts(const mw_model *m, double *s, const double *phi, size_t n, const double *x, mw_info *info, double *o,
                 mw_contact *contact)
{
    const int usable = mwi_usable(m);
    for (size_t k = 0; k < n; k++)
        if (!usable || !mwi_angle_in_range(phi[k])) info[k].status = MW_BAD_INPUT;
    for (size_t k = 0; usable && k < n; k++, x += m->nx, o += m->no) {
        if (info[k].status >= 0) {
            m->set_phi(s, phi[k]);
            info[k].status = look(m, s, x, info[k].status, o, contact + k);
        }
        if (info[k].status < 0) no_contact_at(m, o, contact + k);
    }
}

size_t mw_analyse(const mw_model *m, const double *p, const double *phi, size_t n, double *s, double *work, double *x,
                  mw_info *info, double *o, mw_contact *contact)
{
    size_t succeeded = 0;
    if (mw_trace(m, p, phi, n, s, work, x, info) > 0) m->setup(p, s);
    if (!mwi_usable(m)) return 0;
    for (size_t k = 0; k < n; k++, x += m->nx, o += m->no) {
        for (int attempt = 0; attempt < 2 && info[k].status >= 0; attempt++) {
            m->set_phi(s, phi[k]);
            const int status = look(m, s, x, info[k].status, o, contact + k);
            const int again = status < 0 && attempt == 0;
            info[k].status = status;
            if (!again) break;
            mw_solve(m, p, phi[k], s, work, x, info + k);
        }
        if (info[k].status < 0) {
            no_contact_at(m, o, contact + k);
            for (int i = 0; i < m->nx; i++) x[i] = NAN;
        }
        succeeded += info[k].status >= 0;
    }
    return succeeded;
}

void mw_contact_points(const mw_model *m, const double *p, size_t designs, const double *phi, size_t n,
                       const double *x, int *status, double *s, double *o, double *points, unsigned *flags)
{
    const int usable = mwi_usable(m), nx = usable ? m->nx : 0, np = usable ? m->np : 0;
    for (size_t d = 0; d < designs; d++, p += np) {
        if (usable) m->setup(p, s);
        for (size_t k = 0; k < n; k++, x += nx, status++, points += 3, flags++) {
            mw_contact c;
            *flags = 0;
            points[0] = points[1] = points[2] = NAN;
            if (!usable) *status = MW_BAD_INPUT;
            if (*status < 0) continue;
            m->set_phi(s, phi[k]);
            *status = look(m, s, x, *status, o, &c);
            if (*status < 0 || *status == MW_LINE_CONTACT) continue;
            if (mwi_nearly_flat(&c)) *status = MW_CONVERGED_NOISE;
            for (int i = 0; i < 3; i++) points[i] = c.point[i];
            *flags = c.flags;
        }
    }
}
