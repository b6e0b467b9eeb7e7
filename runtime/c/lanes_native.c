/* Lanes of the instruction set that the compiler targets by default (SSE2, NEON).  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#define MW_LANES 4
#define MW_LANE_SET _lanes_native
#define MW_LANE_SET_NAME "native"
#define MW_LANE_SET_NUMBER MW_NATIVE
#include "lane_kernels.h"
