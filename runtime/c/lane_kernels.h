/* Lanes for one instruction set: of the drive MW_DRIVE its kernels or, with MW_PROOFS, its equations with error bounds;
 * without MW_DRIVE the trace and the proofs that use those of any.
 * The including file defines MW_LANES, twice the numbers in a vector (while the one vector waits for a result, the other
 * goes on), MW_LANE_SET, its name, and MW_LANE_SET_NUMBER, selects the instruction set for the compiler, and defines
 * MW_FUSED if it has fused operations.  SPDX-License-Identifier: MIT-0 */
#define MW_LANES_SIMD
#if defined(MW_PROOFS)
#include "drive/proven.h"
#elif defined(MW_DRIVE)
#include "drive/lanes.h"
#else
#include "lane_certify.h"
#include "lane_follow.h"
#endif
