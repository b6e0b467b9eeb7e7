/* Trace with CasADi's generated Newton solver. argv: points, repeats, 1 to start from the extrapolation that the runtime
 * uses, 0 from the point before. stdin: count of parameters, parameters, first angle, step, start values. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "clock.h"
#include "solver.h"

enum { NX = UNKNOWNS, MAX_POINTS = 200000 };

static double x[MAX_POINTS + 4][NX];

int main(int argc, char **argv)
{
    const int n = argc > 1 ? atoi(argv[1]) : 1000;
    const int extrapolate = argc > 3 && atoi(argv[3]);
    double q[256], phi, step, w[solver_SZ_W];
    casadi_int iw[solver_SZ_IW + 1];
    const double *arg[solver_SZ_ARG];
    double *res[solver_SZ_RES];
    int np;
    if (scanf("%d", &np) != 1) return 2;
    for (int i = 0; i < np; i++)
        if (scanf("%lf", q + i) != 1) return 2;
    if (scanf("%lf %lf", &phi, &step) != 2) return 2;
    for (int j = 0; j < NX; j++)
        if (scanf("%lf", &x[0][j]) != 1) return 2;
    double best = 1e9;
    for (int repeat = 0; repeat < (argc > 2 ? atoi(argv[2]) : 1); repeat++) {
        const double begin = seconds();
        for (int k = 0; k < n; k++) {
            double guess[NX];
            for (int j = 0; j < NX; j++)
                guess[j] = k < 4 || !extrapolate ? x[k ? k - 1 : 0][j]
                                 : 4.0 * (x[k - 1][j] + x[k - 3][j]) - (6.0 * x[k - 2][j] + x[k - 4][j]);
            q[np] = phi + step * k;
            arg[0] = guess;
            arg[1] = q;
            res[0] = x[k];
            if (solver(arg, res, iw, w, 0)) return 1;
        }
        const double time = seconds() - begin;
        if (time < best) best = time;
    }
    printf("%.17g %.17g\n", n / best, x[n - 1][NX - 1]);
    return 0;
}
