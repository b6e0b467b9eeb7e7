/* Newton steps a second of the lane kernel alone, at a solution. Same input as scalar_trace.c. */
#include <stdio.h>
#include <time.h>
#ifdef __AVX512F__
#define MW_LANES 16
#elif defined(__AVX2__)
#define MW_LANES 8
#else
#define MW_LANES 4
#endif
#ifdef __FMA__
#define MW_FUSED
#endif
#define MW_LANES_SIMD
#include HEADER

enum { ROUNDS = 2000, REPEATS = 200 };
static double p[256 * MW_LANES], s[512 * MW_LANES], x[8 * MW_LANES], phi[MW_LANES], size[MW_LANES];

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int spread(double *to)
{
    if (scanf("%lf", to) != 1) return 0;
    for (int l = 1; l < MW_LANES; l++) to[l] = to[0];
    return 1;
}

int main(void)
{
    double step, best = 1e9;
    int np;
    if (scanf("%d", &np) != 1) return 2;
    for (int i = 0; i < np; i++)
        if (!spread(p + i * MW_LANES)) return 2;
    if (!spread(phi) || scanf("%lf", &step) != 1) return 2;
    for (int j = 0; j < MODEL_NX; j++)
        if (!spread(x + j * MW_LANES)) return 2;
    MW_LANE_NAME(SETUP)(p, s, size);
    MW_LANE_NAME(SET_PHI)(s, phi);
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double begin = seconds();
        for (int k = 0; k < ROUNDS; k++) MW_LANE_NAME(STEP)(s, x, size);
        const double time = seconds() - begin;
        if (time < best) best = time;
    }
    printf("%.17g %.3g\n", (double)ROUNDS * MW_LANES / best, size[0]);
    return 0;
}
