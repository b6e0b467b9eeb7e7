/* All that a generated header needs of <math.h>, for targets without a C library. */
#ifndef FREESTANDING_MATH_H
#define FREESTANDING_MATH_H
#define NAN __builtin_nan("")
#define HUGE_VAL __builtin_huge_val()

/* The square root is an instruction of the machine. Where a compiler keeps errno it calls sqrt() instead: a function of
 * that name, defined here by the builtin, would call itself, and clang deletes what it takes for an endless loop. */
#ifdef __has_builtin
#if __has_builtin(__builtin_elementwise_sqrt)
#define sqrt(a) __builtin_elementwise_sqrt((double)(a))
#endif
#endif
#ifndef sqrt
#ifndef __NO_MATH_ERRNO__
#error "there is no errno without a C library: compile with -fno-math-errno"
#endif
#define sqrt(a) __builtin_sqrt(a)
#endif
#endif
