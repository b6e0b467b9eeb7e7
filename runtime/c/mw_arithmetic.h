/* The arithmetic that the results rest on: IEEE doubles, every operation rounded by itself. Each generated header repeats this
 * block, so that it can be used alone.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_ARITHMETIC
#define MW_ARITHMETIC

#ifndef MW_DEVICE_ONLY
#include <float.h>
#endif

/* Options that change results are refused where a macro shows them; X_self_test finds the others. Who defines
 * MW_ANY_ARITHMETIC takes what comes. */
#ifndef MW_ANY_ARITHMETIC
#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error "meshwright: fast mathematics changes results; compile without -ffast-math, -Ofast or /fp:fast, or define MW_ANY_ARITHMETIC"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0
#error "meshwright: what is not a number has to be told; compile without -ffinite-math-only, or define MW_ANY_ARITHMETIC"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "meshwright: sums and quotients stand as they are; compile without -fassociative-math and -freciprocal-math, or define MW_ANY_ARITHMETIC"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "meshwright: doubles must be rounded at once; compile with -msse2 -mfpmath=sse, or define MW_ANY_ARITHMETIC"
#endif
#endif

#endif
