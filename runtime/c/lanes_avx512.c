/* Lanes for x86-64 processors with AVX512; never run without it.  SPDX-License-Identifier: MIT-0 */
#if defined(__x86_64__) && defined(__GNUC__)
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,fma"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq,avx512vl,fma,prefer-vector-width=512")
#endif
#define MW_LANES 16
#define MW_FUSED
#define MW_LANE_SET _lanes_avx512
#define MW_LANE_SET_NAME "avx512"
#define MW_LANE_SET_NUMBER MW_AVX512
#include "lane_kernels.h"
#ifdef __clang__
#pragma clang attribute pop
#endif
#else
typedef int mw_no_avx512; /* a translation unit must not be empty */
#endif
