/* Where rays meet a surface.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "meshwright.h"
#include "solver/basics.h"
#include "solver/linear.h"

enum { MAX_STEPS = 16 };

/* A ray meets the surface with a step of so many mm, or with one that is followed by such a one, as quadratic convergence
 * from at most the other number has it. */
static const double DONE = 1e-9, QUADRATIC = 1e-2;

/* What Newton's method asks for at q, and its step, the last number that of the distance; its length on the surface. */
static double step(mw_surface surface, int k, int outputs, const double *s, const double *from, const double *along,
                   double distance, const double *q, double *o, double *change)
{
    const int n = k + 1, width = 1 + k;
    double J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], moved[3] = {0.0, 0.0, 0.0};
    surface(s, q, o);
    const double *tangents = o + 6, *condition = o + outputs - (k - 2) * width;
    for (int i = 0; i < 3; i++) {
        change[i] = o[i] - from[i] - distance * along[i];
        for (int j = 0; j < k; j++) J[i * n + j] = tangents[3 * j + i];
        J[i * n + k] = -along[i];
    }
    for (int i = 3; i < n; i++, condition += width) {
        change[i] = condition[0];
        for (int j = 0; j < k; j++) J[i * n + j] = condition[1 + j];
        J[i * n + k] = 0.0;
    }
    mwi_bordered_solve(n, J, change);
    for (int j = 0; j < k; j++)
        for (int i = 0; i < 3; i++) moved[i] += change[j] * tangents[3 * j + i];
    return sqrt(moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]);
}

int mw_rays(mw_surface surface, int parameters, int outputs, const double *s, const double *from, const double *along,
            size_t n, double longest, double farthest, double *o, double *q, double *distance)
{
    const int k = parameters;
    double change[MW_MAX_UNKNOWNS];
    if (k < 2 || k + 1 > MW_MAX_UNKNOWNS || outputs < 7 + 3 * k + (k - 2) * (1 + k)) return MW_BAD_INPUT;
    if (!(longest > 0.0 && farthest > 0.0)) return MW_BAD_INPUT;
    for (size_t i = 0; i < n; i++, from += 3, along += 3, q += k) {
        double at = 0.0, before = HUGE_VAL;
        int met = 0;
        for (int done = 0; done < MAX_STEPS && !met && mwi_abs(at) < farthest; done++) {
            const double length = step(surface, k, outputs, s, from, along, at, q, o, change);
            const double size = mwi_larger(length, mwi_abs(change[k])), ratio = size / before;
            if (!(length < HUGE_VAL && size < HUGE_VAL)) break;
            const double share = length > longest ? longest / length : 1.0;
            for (int j = 0; j < k; j++) q[j] -= share * change[j];
            at -= share * change[k];
            met = size < DONE || (ratio < QUADRATIC && before < QUADRATIC && size * ratio * ratio < DONE);
            before = size;
        }
        distance[i] = met ? at : NAN;
    }
    return MW_CONVERGED;
}
