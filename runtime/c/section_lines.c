/* Places of a surface on lines across a tooth.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "meshwright.h"
#include "solver/linear.h"

enum { MAX_STEPS = 40 };

/* No further step after one of this many natural sizes; no place where the last one was longer than the other. */
static const double STILL = 1e-12, SETTLED = 1e-9;

/* At most this much of a natural size a step, so that a start far away does not lead to another sheet. */
static const double LONGEST = 0.5;

/* The coordinate along the tooth at a place q with point o[0..2] and tangents o[6..]; its slopes by the parameters. */
static double coordinate(const mw_section_lines *l, const double *q, const double *o, double *slopes)
{
    const int k = l->parameters;
    if (l->radial == 0.0 && l->axial == 0.0) {
        for (int j = 0; j < k; j++) slopes[j] = j == k - 1 ? 1.0 : 0.0;
        return q[k - 1];
    }
    const double radius = sqrt(o[0] * o[0] + o[1] * o[1]);
    for (int j = 0; j < k; j++) {
        const double *t = o + 6 + 3 * j;
        slopes[j] = l->axial * t[2];
        if (l->radial != 0.0) slopes[j] += l->radial * (t[0] * o[0] + t[1] * o[1]) / radius;
    }
    return l->axial * o[2] + (l->radial != 0.0 ? l->radial * radius : 0.0);
}

/* One Newton step from q: the largest change in natural sizes, not a number where there is none. */
static double step(const mw_section_lines *l, const double *s, const double *at, double *o, double *q)
{
    const int k = l->parameters, width = 1 + k;
    double J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS], largest = 0.0;
    l->surface(s, q, o);
    const double *condition = o + l->outputs - (k - 2) * width;
    for (int j = 0; j < k; j++) J[j] = j == l->profile ? 1.0 : 0.0;
    R[0] = q[l->profile] - at[0];
    R[1] = coordinate(l, q, o, J + k) - at[1];
    for (int i = 2; i < k; i++, condition += width) {
        R[i] = condition[0];
        for (int j = 0; j < k; j++) J[i * k + j] = condition[1 + j];
    }
    mwi_bordered_solve(k, J, R);
    for (int j = 0; j < k; j++) {
        const double size = mwi_abs(R[j] / l->sizes[j]);
        if (!(size <= largest)) largest = largest == largest ? size : largest;
    }
    const double share = largest > LONGEST ? LONGEST / largest : 1.0;
    for (int j = 0; j < k; j++) q[j] -= share * R[j];
    return largest;
}

int mw_on_lines(const mw_section_lines *l, const double *s, const double *at, size_t n, double *o, double *q)
{
    const int k = l->parameters;
    if (k < 2 || k > MW_MAX_UNKNOWNS || l->profile < 0 || l->profile >= k) return MW_BAD_INPUT;
    if (l->outputs < 7 + 3 * k + (k - 2) * (1 + k)) return MW_BAD_INPUT;
    for (size_t i = 0; i < n; i++, at += 2, q += k) {
        double last = HUGE_VAL;
        for (int done = 0; done < MAX_STEPS && last > STILL; done++) last = step(l, s, at, o, q);
        if (!(last < SETTLED))
            for (int j = 0; j < k; j++) q[j] = NAN;
    }
    return MW_CONVERGED;
}
