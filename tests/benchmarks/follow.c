/* Seconds of a call: a solve at 0 and at 1000 rad, a bare step to a tolerance, a warm and a cold follow. argv: parameters. */
#include <stdio.h>
#include <stdlib.h>
#include "clock.h"
#include HEADER

enum { CALLS = 20000, SOLVES = 200, MOST_STEPS = 20 };
static const double STEP = 1e-3, TOLERANCE = 1e-9, REACH = 0.4, TURN = 6.283185307179586;

static double solve(double *s, double phi, double *x)
{
    mw_info info;
    const double begin = seconds();
    for (int k = 0; k < SOLVES; k++) DRIVE(solve)(s, phi, x, &info);
    return (seconds() - begin) / SOLVES;
}

static double follow(double *s, double *phi, double *x, int cold)
{
    mw_info info;
    const double begin = seconds();
    for (int k = 0; k < CALLS; k++) {
        *phi += STEP;
        if (cold) x[0] = NAN;
        DRIVE(follow)(s, *phi, x, &info);
    }
    return (seconds() - begin) / CALLS;
}

static double bare(double *s, const double *at, double *x)
{
    const double pitch = TURN / s[DRIVE(NS) - DRIVE(NP) + DRIVE(model).teeth], begin = seconds();
    double phi = HUGE_VAL;
    for (int k = 0; k < CALLS; k++) {
        phi += STEP;
        if (phi > REACH * pitch) {
            phi = STEP;
            for (int i = 0; i < DRIVE(NX); i++) x[i] = at[i];
        }
        DRIVE(set_phi)(s, phi);
        for (int i = 0; i < MOST_STEPS && !(DRIVE(step)(s, x) < TOLERANCE); i++) ;
    }
    return (seconds() - begin) / CALLS;
}

int main(int argc, char **argv)
{
    static double p[DRIVE(NP)], s[DRIVE(NS)], x[DRIVE(NX)], at[DRIVE(NX)];
    double phi = 0.0;
    mw_info info;
    if (argc != 1 + DRIVE(NP)) return 2;
    for (int k = 0; k < DRIVE(NP); k++) p[k] = strtod(argv[1 + k], NULL);
    if (DRIVE(setup)(p, s)) return 1;
    const double near = solve(s, 0.0, at), far = solve(s, 1000.0, x);
    if (DRIVE(setup)(p, s)) return 1;
    for (int i = 0; i < DRIVE(NX); i++) x[i] = NAN;
    DRIVE(follow)(s, phi, x, &info);
    const double warm = follow(s, &phi, x, 0), cold = follow(s, &phi, x, 1), steps = bare(s, at, x);
    printf("%.17g %.17g %.17g %.17g %.17g\n", near, far, steps, warm, cold);
    return 0;
}
