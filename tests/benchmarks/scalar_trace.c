/* Trace by the runtime; same input as casadi_trace.c, start values unused. argv: points, repeats. */
#include <stdio.h>
#include <stdlib.h>
#include "clock.h"
#include HEADER
#include "meshwright.h"

enum { MAX_POINTS = 200000 };
static double phi[MAX_POINTS], x[MAX_POINTS][MODEL_NX];
static mw_info info[MAX_POINTS];

int main(int argc, char **argv)
{
    const int n = argc > 1 ? atoi(argv[1]) : 1000;
    double p[256], s[512], work[256], first, step, best = 1e9;
    int np;
    if (scanf("%d", &np) != 1) return 2;
    for (int i = 0; i < np; i++)
        if (scanf("%lf", p + i) != 1) return 2;
    if (scanf("%lf %lf", &first, &step) != 2) return 2;
    for (int k = 0; k < n; k++) phi[k] = first + step * k;
    for (int repeat = 0; repeat < (argc > 2 ? atoi(argv[2]) : 1); repeat++) {
        const double begin = seconds();
        if (mw_trace(&MODEL, p, phi, (size_t)n, s, work, x[0], info) != (size_t)n) return 1;
        const double time = seconds() - begin;
        if (time < best) best = time;
    }
    printf("%.17g %.17g\n", n / best, x[n - 1][MODEL_NX - 1]);
    return 0;
}
