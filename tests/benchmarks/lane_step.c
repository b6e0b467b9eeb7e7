/* Newton steps a second of the lane kernel alone, at a solution, and the peak of the core beside it. Same input as
 * scalar_trace.c. */
#include <stdio.h>
#include <stdlib.h>
#include "clock.h"
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

enum { ROUNDS = 200, REPEATS = 10000 };
static double p[256 * MW_LANES], s[512 * MW_LANES], x[8 * MW_LANES], phi[MW_LANES], size[MW_LANES];

typedef struct pair {
    double steps, top;
} pair;
static pair pairs[REPEATS];

double peak(double *sum);

static int spread(double *to)
{
    if (scanf("%lf", to) != 1) return 0;
    for (int l = 1; l < MW_LANES; l++) to[l] = to[0];
    return 1;
}

static double steps(void)
{
    const double begin = seconds();
    for (int k = 0; k < ROUNDS; k++) MW_LANE_NAME(STEP)(s, x, size);
    return (double)ROUNDS * MW_LANES / (seconds() - begin);
}

static int by_share(const void *a, const void *b)
{
    const pair *p = a, *q = b;
    const double difference = p->steps * q->top - q->steps * p->top;
    return (difference > 0.0) - (difference < 0.0);
}

/* The clock changes with the load, and neighbours on the same core take from the kernel what they leave to a loop in
 * registers: so the two alternate. A pair counts if the peak is the same before and after the steps; printed is the one
 * that nine in ten do not reach. */
int main(void)
{
    double step, sum = 0.0;
    int np, count = 0;
    if (scanf("%d", &np) != 1) return 2;
    for (int i = 0; i < np; i++)
        if (!spread(p + i * MW_LANES)) return 2;
    if (!spread(phi) || scanf("%lf", &step) != 1) return 2;
    for (int j = 0; j < MODEL_NX; j++)
        if (!spread(x + j * MW_LANES)) return 2;
    MW_LANE_NAME(SETUP)(p, s, size);
    MW_LANE_NAME(SET_PHI)(s, phi);
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double before = peak(&sum), rate = steps(), after = peak(&sum);
        const double top = before > after ? before : after;
        if ((before < after ? before : after) > 0.99 * top) pairs[count++] = (pair){ rate, top };
    }
    if (count == 0) return 3;
    qsort(pairs, (size_t)count, sizeof *pairs, by_share);
    const pair *best = pairs + count - 1 - count / 10;
    printf("%.17g %.17g %.3g %.3g\n", best->steps, best->top, size[0], sum);
    return 0;
}
