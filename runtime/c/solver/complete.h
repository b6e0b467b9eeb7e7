/* Complete a design: rules and defaults, then the systems that place its tools.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_COMPLETE_H) && !defined(MW_DEVICE_ONLY)
#define MWI_COMPLETE_H

#include "newton.h"

enum { MWI_PATH_STEPS = 32, MWI_PATH_MAX_HALVINGS = 8 };

/* Follow one system from its guess along its path, the last of q[np + 1]. y[system->n] is zero before. Negative if the
 * path breaks off or leaves the regular part. */
static inline int mwi_solve_system(const mw_model *m, const mw_system *system, double *q, double *y, mw_info *info)
{
    double scale[MW_MAX_UNKNOWNS], last[MW_MAX_UNKNOWNS], slope[MW_MAX_UNKNOWNS];
    double *path = q + m->np, at = 0.0, step = 1.0 / (double)MWI_PATH_STEPS;
    mwi_clear(slope, MW_MAX_UNKNOWNS);
    *path = 0.0;
    system->guess(q, y);
    system->scale(q, scale);
    for (int halvings = 0; halvings <= MWI_PATH_MAX_HALVINGS;) {
        mwi_copy(last, y, system->n);
        for (int i = 0; i < system->n; i++) y[i] += slope[i] * (*path - at);
        const int solved = mwi_newton(system->eval, system->n, q, scale, y, info) >= 0;
        if (solved && system->watch && !(system->watch(q, y) > 0.0)) return info->status = MW_LEFT_FLANK;
        if (solved) {
            if (*path > at)
                for (int i = 0; i < system->n; i++) slope[i] = (y[i] - last[i]) / (*path - at);
            if (*path >= 1.0) return info->status;
            at = *path;
        } else {
            if (at == *path) return info->status;
            mwi_copy(y, last, system->n);
            step *= 0.5;
            halvings++;
        }
        *path = at + step < 1.0 ? at + step : 1.0;
    }
    return info->status;
}

/* p[np] with what is open (NaN) filled in; q[np + 1] is work. Returns 0, or 1 + the index of the system that has no
 * solution; -1: no table of this version. */
static inline int mwi_complete(const mw_model *m, double *p, double *q, mw_info *info)
{
    *info = mwi_ended(MW_BAD_INPUT, 0);
    if (!mwi_usable(m)) return -1;
    info->status = MW_CONVERGED;
    m->derive(p);
    for (int k = 0; k < m->nsystems; k++) {
        double y[MW_MAX_UNKNOWNS];
        mwi_clear(y, MW_MAX_UNKNOWNS);
        if (m->systems[k].open(p) == 0) continue;
        mwi_copy(q, p, m->np);
        if (mwi_solve_system(m, &m->systems[k], q, y, info) < 0) return 1 + k;
        m->systems[k].fill(y, q);
        mwi_copy(p, q, m->np);
        m->derive(p);
    }
    return 0;
}

#endif
