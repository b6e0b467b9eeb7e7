/* Places of a surface at values of two coordinates.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "meshwright.h"
#include "solver/linear.h"

enum { MAX_STEPS = 40 };

/* No further step after one of this many natural sizes; no place where the last one was longer than the other. */
static const double STILL = 1e-12, SETTLED = 1e-9;

/* At most this much of a natural size a step, so that a start far away does not lead to another sheet. */
static const double LONGEST = 0.5;

/* A coordinate with factors f[k + 4] at a place q with point o[0..2] and tangents o[6..]; its slopes by the parameters. */
static double coordinate(int k, const double *f, const double *q, const double *o, double *slopes)
{
    const double *of = f + k, radius = of[3] != 0.0 ? sqrt(o[0] * o[0] + o[1] * o[1]) : 0.0;
    double value = of[3] * radius;
    for (int i = 0; i < 3; i++) value += of[i] * o[i];
    for (int j = 0; j < k; j++) {
        const double *t = o + 6 + 3 * j;
        value += f[j] * q[j];
        slopes[j] = f[j] + of[0] * t[0] + of[1] * t[1] + of[2] * t[2];
        if (of[3] != 0.0) slopes[j] += of[3] * (t[0] * o[0] + t[1] * o[1]) / radius;
    }
    return value;
}

/* One Newton step from q: the largest change in natural sizes, not a number where there is none. */
static double step(const mw_coordinates *c, const double *factors, const double *s, const double *at, double *o, double *q)
{
    const int k = c->parameters, width = 1 + k;
    double J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS], largest = 0.0;
    c->surface(s, q, o);
    const double *condition = o + c->outputs - (k - 2) * width;
    for (int i = 0; i < 2; i++) R[i] = coordinate(k, factors + i * (k + 4), q, o, J + i * k) - at[i];
    for (int i = 2; i < k; i++, condition += width) {
        R[i] = condition[0];
        for (int j = 0; j < k; j++) J[i * k + j] = condition[1 + j];
    }
    mwi_bordered_solve(k, J, R);
    for (int j = 0; j < k; j++) {
        const double size = mwi_abs(R[j] / c->sizes[j]);
        if (!(size <= largest)) largest = largest == largest ? size : largest;
    }
    const double share = largest > LONGEST ? LONGEST / largest : 1.0;
    for (int j = 0; j < k; j++) q[j] -= share * R[j];
    return largest;
}

int mw_places(const mw_coordinates *c, const double *s, const double *at, size_t n, double *o, double *q)
{
    const int k = c->parameters;
    if (k < 2 || k > MW_MAX_UNKNOWNS) return MW_BAD_INPUT;
    if (c->outputs < 7 + 3 * k + (k - 2) * (1 + k)) return MW_BAD_INPUT;
    const double *factors = c->factors;
    for (size_t i = 0; i < n; i++, at += 2, q += k, factors += c->apart) {
        double last = HUGE_VAL;
        for (int done = 0; done < MAX_STEPS && last > STILL; done++) last = step(c, factors, s, at, o, q);
        if (!(last < SETTLED))
            for (int j = 0; j < k; j++) q[j] = NAN;
    }
    return MW_CONVERGED;
}
