/* Complete a design: rules and defaults, then the systems that place its tools.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include <string.h>
#include "complete.h"
#include "solver/newton.h"

enum { PATH_STEPS = 32, MAX_PATH_HALVINGS = 8 };

int mw_solve_system(const mw_model *m, const mw_system *system, double *q, double *y, mw_info *info)
{
    double scale[MW_MAX_UNKNOWNS], last[MW_MAX_UNKNOWNS], slope[MW_MAX_UNKNOWNS] = { 0.0 };
    double *path = q + m->np, at = 0.0, step = 1.0 / (double)PATH_STEPS;
    *path = 0.0;
    system->guess(q, y);
    system->scale(q, scale);
    for (int halvings = 0; halvings <= MAX_PATH_HALVINGS;) {
        memcpy(last, y, sizeof last);
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
            memcpy(y, last, sizeof last);
            step *= 0.5;
            halvings++;
        }
        *path = at + step < 1.0 ? at + step : 1.0;
    }
    return info->status;
}

int mw_complete(const mw_model *m, double *p, double *q, mw_info *info)
{
    *info = mwi_ended(MW_BAD_INPUT, 0);
    if (!mwi_usable(m)) return -1;
    info->status = MW_CONVERGED;
    m->derive(p);
    for (int k = 0; k < m->nsystems; k++) {
        double y[MW_MAX_UNKNOWNS] = { 0.0 };
        if (m->systems[k].open(p) == 0) continue;
        memcpy(q, p, sizeof(double) * (size_t)m->np);
        if (mw_solve_system(m, &m->systems[k], q, y, info) < 0) return 1 + k;
        m->systems[k].fill(y, q);
        memcpy(p, q, sizeof(double) * (size_t)m->np);
        m->derive(p);
    }
    return 0;
}
