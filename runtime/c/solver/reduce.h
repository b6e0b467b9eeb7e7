/* The tooth pair in mesh at an input angle of any size, and the angle from its own reference.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_REDUCE_H
#define MWI_REDUCE_H

#include "basics.h"

/* 2 pi as a sum: each part is the double next to what the parts before it leave. */
static const double MWI_TURN = 6.283185307179586;
static const double MWI_TURN_MIDDLE = 2.4492935982947064e-16;
static const double MWI_TURN_LAST = -5.989539619436679e-33;

/* Times a number it leads to the upper half of its digits. */
static const double MWI_HALVES = 134217729.0;

MW_DEVICE static inline double mwi_upper_half(double a)
{
    const double c = MWI_HALVES * a;
    return c - (c - a);
}

/* a b, and what the rounded product lacks of it (T. J. Dekker, "A floating-point technique for extending the available
 * precision", Numerische Mathematik 18 (1971), section 5). */
MW_DEVICE static inline double mwi_product(double a, double b, double *rest)
{
    const double product = a * b, a1 = mwi_upper_half(a), b1 = mwi_upper_half(b), a2 = a - a1, b2 = b - b1;
    *rest = ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
    return product;
}

/* phi less `pair` pitches of so many teeth a turn. */
MW_DEVICE static inline double mwi_less_pitches(double teeth, double phi, double pair)
{
    double turned_rest, pitches_rest, middle_rest;
    const double turned = mwi_product(phi, teeth, &turned_rest), pitches = mwi_product(pair, MWI_TURN, &pitches_rest);
    const double middle = mwi_product(pair, MWI_TURN_MIDDLE, &middle_rest);
    const double above = (turned - pitches) + (turned_rest - pitches_rest);
    return ((above - middle) - (middle_rest + pair * MWI_TURN_LAST)) / teeth;
}

/* The angle of the pair whose reference is the nearest, within half a pitch of `reference`; *pair: its number, which is 0
 * at `reference`. Not a number, both, for an angle that is none or beyond MW_MAX_ANGLE. */
MW_DEVICE static inline double mwi_reduce(double teeth, double reference, double phi, double *pair)
{
    const double pitch = MWI_TURN / teeth;
    double angle = *pair = NAN, beyond = 1.0;
    if (!(mwi_abs(phi) <= MW_MAX_ANGLE) || !(teeth >= 1.0)) return NAN;
    *pair = ((phi - reference) / pitch + MWI_TO_INTEGER) - MWI_TO_INTEGER;
    for (int k = 0; k < 3 && beyond != 0.0; k++) {
        angle = mwi_less_pitches(teeth, phi, *pair);
        beyond = angle - reference < -0.5 * pitch ? -1.0 : angle - reference >= 0.5 * pitch ? 1.0 : 0.0;
        if (k < 2) *pair += beyond;
    }
    return angle;
}

#endif
