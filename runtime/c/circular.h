/* Sine, cosine and the angle of a point from sums, products and quotients alone.  SPDX-License-Identifier: MIT-0
 *
 * C libraries differ in the last bits of these functions. Here the bits are the same wherever arithmetic is IEEE's. */
#ifndef MW_CIRCULAR_H
#define MW_CIRCULAR_H

/* Written out where it is used, so that several numbers at once can be taken there. */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define MWI_INLINE static inline __attribute__((always_inline))
#else
#define MWI_INLINE static inline
#endif

/* Beyond it the reduction of the argument is not exact. */
#define MWI_CIRCULAR_FAR 1.6e6

/* Sine and cosine for |a| < MWI_CIRCULAR_FAR, each within 2^-52: certify/ball.h has the bound's parts. */
MWI_INLINE void mwi_sine(double a, double *sine, double *cosine)
{
    const double magic = 6755399441055744.0; /* 1.5 * 2^52: a sum with it is rounded to a whole number */
    const double k = (a * 0.6366197723675814 + magic) - magic;
    const double r = ((a - k * 1.5707963267341256) - k * 6.077100506303966e-11) - k * 2.0222662487959506e-21;
    const double z = r * r;
    const double u = -0.16666666666666666 + z * (0.008333333333333333 + z * (-0.0001984126984126984 + z *
        (2.7557319223985893e-06 + z * (-2.505210838544172e-08 + z * (1.6059043836821613e-10 + z *
        (-7.647163731819816e-13 + z * (2.8114572543455206e-15)))))));
    const double v = 0.041666666666666664 + z * (-0.001388888888888889 + z * (2.48015873015873e-05 + z *
        (-2.755731922398589e-07 + z * (2.08767569878681e-09 + z * (-1.1470745597729725e-11 + z *
        (4.779477332387385e-14 + z * (-1.5619206968586225e-16)))))));
    const double s = r + (r * z) * u, w = 1.0 - 0.5 * z;
    const double c = w + (((1.0 - w) - 0.5 * z) + (z * z) * v);
    const int quadrant = (int)k, odd = quadrant & 1;
    const double first = odd ? c : s, second = odd ? s : c;
    *sine = (quadrant & 2) ? -first : first;
    *cosine = ((quadrant + 1) & 2) ? -second : second;
}

/* Angle of the point (x, y), -pi to pi, within 2^-50; 0 at the origin. A quotient between the bounds of an octant and the
 * minimax polynomial of its arc. */
MWI_INLINE double mwi_angle(double y, double x)
{
    const double ax = x < 0.0 ? -x : x, ay = y < 0.0 ? -y : y;
    const double large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
    const int upper = small > 0.41421356237309503 * large;
    const double top = upper ? small - large : small, bottom = upper ? small + large : large;
    const double r = bottom > 0.0 ? top / bottom : x + y;
    const double z = r * r;
    const double u = -0.3333333333333333 + z * (0.1999999999999552 + z * (-0.14285714284666542 + z * (0.11111111015256361 +
        z * (-0.09090904578123901 + z * (0.07692183190826078 + z * (-0.06664511447381855 + z * (0.05858148912801507 +
        z * (-0.050854497379370145 + z * (0.03923165829550329 + z * -0.01917688711896928)))))))));
    const double first = (upper ? 0.7853981633974483 : 0.0) + ((r * z) * u + r);
    const double octant = ax >= ay ? first : 1.5707963267948966 - first;
    const double half = x < 0.0 ? 3.141592653589793 - octant : octant;
    return y < 0.0 ? -half : half;
}

#endif
