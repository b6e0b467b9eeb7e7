/* All that the page's C needs of <math.h>: WebAssembly has no C library.  SPDX-License-Identifier: MIT-0 */
#ifndef LIVE_MATH_H
#define LIVE_MATH_H
#define NAN __builtin_nan("")
#define HUGE_VAL __builtin_huge_val()
static inline double sqrt(double a) { return __builtin_sqrt(a); }
#endif
