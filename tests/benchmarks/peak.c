/* Peak of fused multiply-adds a second of one core, in floating-point operations: independent chains in registers. */
#include "clock.h"

#if defined(__AVX512F__)
enum { WIDTH = 8 };
#elif defined(__AVX__)
enum { WIDTH = 4 };
#else
enum { WIDTH = 2 };
#endif
typedef double vector __attribute__((vector_size(8 * WIDTH)));

/* One measurement, of some ten microseconds; what the chains come to is added to *sum, so that they are computed. */
double peak(double *sum)
{
    enum { CHAINS = 10, ROUNDS = 8000 };
    vector a[CHAINS], zero = { 0.0 }, b = zero + 0.999999, c = zero + 1e-9;
    for (int i = 0; i < CHAINS; i++) a[i] = b * (double)i;
    const double begin = seconds();
    for (int k = 0; k < ROUNDS; k++) {
        for (int i = 0; i < CHAINS; i++) a[i] = a[i] * b + c;
    }
    const double time = seconds() - begin;
    for (int i = 0; i < CHAINS; i++) *sum += a[i][0];
    return 2.0 * WIDTH * CHAINS * (double)ROUNDS / time;
}
