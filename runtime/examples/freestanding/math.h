/* All that a generated header needs of <math.h>, for targets without a C library. */
#ifndef FREESTANDING_MATH_H
#define FREESTANDING_MATH_H
#define NAN __builtin_nan("")
#define HUGE_VAL __builtin_huge_val()
static inline double sqrt(double a) { return __builtin_sqrt(a); }
#endif
