/* Radii in units of MWC_U, beside middles that are computed by themselves.  SPDX-License-Identifier: MIT-0
 *
 * As in ball.h, but what a result's own rounding adds to its radius is then its size, and the printer leaves out the terms
 * of numbers that are exact. m is the middle of the result, of arguments a with radius ra and b with rb. */
#ifndef MWC_UNITS_H
#define MWC_UNITS_H

#include "ball.h"

/* 1 in these units; half of the least double, which a middle loses by underflow: what radii lose by it, so much less, is
 * among what MWC_READ makes good; MWC_READ of one unit. */
static const double MWC_UNITS = 9007199254740992.0, MWC_UNITS_TINY = 2.2250738585072014e-308;
static const double MWC_UNITS_READ = 1.1102230246261663e-16;

MWI_INLINE double mwc_units_sum(double ra, double rb, double m)
{
    return (ra + rb) + mwc_abs(m);
}

/* Both exact. */
MWI_INLINE double mwc_units_rounded(double m)
{
    return mwc_abs(m) + MWC_UNITS_TINY;
}

/* The one exact. */
MWI_INLINE double mwc_units_share(double a, double rb, double m)
{
    return MWC_FMA(mwc_abs(a), rb, mwc_units_rounded(m));
}

/* The largest size of b, read as such, is known. */
MWI_INLINE double mwc_units_scaled(double a, double ra, double most, double rb, double m)
{
    return MWC_FMA(mwc_abs(a), rb, MWC_FMA(ra, most, mwc_units_rounded(m)));
}

MWI_INLINE double mwc_units_product(double a, double ra, double b, double rb, double m)
{
    return mwc_units_scaled(a, ra, MWC_FMA(MWC_UNITS_READ, rb, mwc_abs(b)), rb, m);
}

MWI_INLINE double mwc_units_square(double a, double ra, double m)
{
    return MWC_FMA(ra, 2.0 * mwc_abs(a) + MWC_UNITS_READ * ra, mwc_units_rounded(m));
}

MWI_INLINE double mwc_units_quotient(double ra, double b, double rb, double m)
{
    const double least = mwc_abs(b) - MWC_UNITS_READ * rb;
    const double spread = (mwc_abs(m) * (1.0 + 4.0 * MWC_U) * rb + ra) / (least * (1.0 - 8.0 * MWC_U));
    return least > 0.0 ? spread + mwc_units_rounded(m) : HUGE_VAL;
}

/* The radicand surely positive. */
MWI_INLINE double mwc_units_root(double ra, double m)
{
    return ra * (1.0 + 8.0 * MWC_U) / m + mwc_abs(m);
}

/* Of the sine or cosine of an angle with radius ra, the slope its cosine or sine; size: what the kernel's error is a share of. */
MWI_INLINE double mwc_units_turned(double ra, double slope, double size)
{
    const double bend = 0.5 * MWC_UNITS_READ * ra;
    return MWC_FMA(ra, (mwc_abs(slope) + MWC_SINE) + bend, 2.0 * size + MWC_UNITS_TINY);
}

/* What the error of the sine of a is a share of: see MWC_SINE. */
MWI_INLINE double mwc_units_size(double a, double sine)
{
    return mwc_abs(a) < 0.78 ? mwc_abs(sine) : 1.0;
}

MWI_INLINE mw_ball mwc_units_ball(double m, double r)
{
    return mwc_make(m, MWC_FMA(MWC_U, r, MWC_TINY));
}

/* -1 below 0, else 1; not a number where a is none. */
MWI_INLINE double mwc_units_sign(double a)
{
    return a < 0.0 ? -1.0 : a >= 0.0 ? 1.0 : a;
}

/* How far a point is from where angles jump: one coordinate alone keeps it off as far. */
MWI_INLINE double mwc_uncut(double y, double x)
{
    const double off = mwc_abs(y);
    return x > off ? x : off;
}

#endif
