/* Balls in lanes: MW_LANES points at once, MW_LANES = 1 one. Number k of lane l is a ball of two doubles, its middle at
 * [2 k MW_LANES + l] and its radius MW_LANES further.  SPDX-License-Identifier: MIT-0 */
#ifndef MWC_LANE_H
#define MWC_LANE_H

#include "ball.h"
#include "units.h"

#define MWC_JOINED2(name, width) name##width
#define MWC_JOINED(name, width) MWC_JOINED2(name, width)
#define MWC_LANE_NAME(name) MWC_JOINED(name, MW_LANES)
#ifdef MW_LANES_SIMD
#define MWC_EACH _Pragma("omp simd") for (int l = 0; l < MW_LANES; l++)
#else
#define MWC_EACH for (int l = 0; l < MW_LANES; l++)
#endif

/* Number k of a lane's balls in a row, of balls that all lanes share, and where one goes. */
#define MWC_OWN(a, k) mwc_make((a)[2 * (k) * MW_LANES + l], (a)[(2 * (k) + 1) * MW_LANES + l])
#define MWC_SHARED(a, k) mwc_make((a)[2 * (k)], (a)[2 * (k) + 1])
#define MWC_KEEP_AT(a, k, m, r) ((a)[2 * (k) * MW_LANES + l] = (m), (a)[(2 * (k) + 1) * MW_LANES + l] = (r))
#define MWC_KEEP(a, k, ball) MWC_KEEP_AT(a, k, (ball).mid, (ball).radius)

/* Most unknowns, as in mw_status.h. */
enum { MWC_MAX = 8 };

/* Boxes begin at this share of the natural sizes; steps that shape them, and the share beyond which none is tried. */
static const double MWC_FIRST_BOX = 5.9604644775390625e-8, MWC_WIDEST_BOX = 0.25;
enum { MWC_SHAPING_STEPS = 30 };

/* A half-width that takes the shape of the image K, wide along what the equations hardly determine. */
#define MWC_SHAPED(z, K) (2.0 * (z) + 1.1 * ((K) - (z)))

static inline void mwc_put(double *balls, int k, mw_ball b)
{
    balls[2 * k] = b.mid;
    balls[2 * k + 1] = b.radius;
}

#endif
