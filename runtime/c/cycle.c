/* The drive at many angles: leading pairs of both flanks and the play between them.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "meshwright.h"
#include "solver/cycle.h"

int mw_cycle_size(const mw_model *m)
{
    return mwi_usable(m) ? MWI_SIDES + 2 * mwi_side_size(m) : 0;
}

int mw_cycle_setup(const mw_model *m, const double *p, const double *coast, double *c)
{
    return mwi_usable(m) ? mwi_cycle_setup(m, p, coast, c) : -1;
}

size_t mw_cycles(const mw_model *m, double *c, const double *phi, size_t n, mw_cycle *out)
{
    size_t touching = 0;
    for (size_t k = 0; k < n && mwi_usable(m); k++) touching += mwi_cycle(m, c, phi[k], out + k) >= 0;
    return touching;
}
