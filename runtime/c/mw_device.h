/* Processors beside the host. Each generated header repeats this block, so that it can be used alone.  SPDX-License-Identifier: MIT-0
 *
 * MW_DEVICE stands before every function that a device can call: what compilers for one ask for (CUDA, HIP), else nothing; who
 * defines it before has that. With MW_DEVICE_ONLY a translation unit holds one drive without what no device has: tables of
 * functions, the walk from start values, words. X_setup, X_set_phi, X_eval, X_step, X_observe, X_along, X_reduce and all else that
 * is computed in straight lines are there, X_geometry, and X_follow, which answers MW_DIVERGED where it would solve anew. Compile
 * without contraction (nvcc and NVRTC: --fmad=false; HIP: -ffp-contract=off) for the same bits as on the host. */
#ifndef MW_DEVICE_H
#define MW_DEVICE_H

#if defined(__CUDACC_RTC__) || defined(__HIPCC_RTC__)
/* A compiler at run time has no host and no headers. */
#ifndef MW_DEVICE_ONLY
#define MW_DEVICE_ONLY
#endif
#ifndef NAN
#define NAN __builtin_bit_cast(double, 0x7ff8000000000000ull)
#endif
#ifndef HUGE_VAL
#define HUGE_VAL __builtin_bit_cast(double, 0x7ff0000000000000ull)
#endif
#ifndef NULL
#define NULL 0
#endif
#else
#include <float.h>
#include <math.h>
#include <stddef.h>
#endif

#if defined(__CUDACC__) || defined(__HIPCC__)
#define MW_OF_DEVICES 1
#else
#define MW_OF_DEVICES 0
#endif
#ifndef MW_DEVICE
#if MW_OF_DEVICES
#define MW_DEVICE __host__ __device__
#else
#define MW_DEVICE
#endif
#endif

/* Before a table that such functions read, before functions that read one, and around what only a host has: its tables are not
 * a device's. */
#ifdef MW_DEVICE_ONLY
#if MW_OF_DEVICES
#define MW_TABLE static __device__ const
#else
#define MW_TABLE static const
#endif
#define MW_BY_TABLE MW_DEVICE
#define MW_HOST(of_host) NULL
#else
#define MW_TABLE static const
#define MW_BY_TABLE
#define MW_HOST(of_host) of_host
#endif

#endif
