/* Lanes for x86-64 processors with AVX2; never run without it.  SPDX-License-Identifier: MIT-0 */
#if defined(__x86_64__) && defined(__GNUC__)
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC target("avx2,fma")
#endif
#define MW_LANES 8
#define MW_FUSED
#define MW_LANE_SET _lanes_avx2
#define MW_LANE_SET_NAME "avx2"
#define MW_LANE_SET_NUMBER MW_AVX2
#include "lane_kernels.h"
#ifdef __clang__
#pragma clang attribute pop
#endif
#else
typedef int mw_no_avx2; /* a translation unit must not be empty */
#endif
