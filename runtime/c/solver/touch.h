/* Success means touching: the one gate that every solution passes.  SPDX-License-Identifier: MIT-0
 *
 * The equations of contact ask that two points agree and that one normal is perpendicular to the tangent plane of the other
 * surface. They hold as well where the normals are parallel instead of opposed, and beyond the domain of a surface, where
 * its formula describes no flank. */
#ifndef MWI_TOUCH_H
#define MWI_TOUCH_H

#include "contact.h"

/* Units in the last place of a point's own terms that the operations behind it may lose, and the shares of a size and of
 * a radian beyond which no round-off is believed, however ill-determined a surface says it is. */
static const double MWI_ROUNDING = 4096.0 * 2.220446049250313e-16, MWI_BELIEVED = 1e-9;

MW_BY_TABLE static inline int mwi_within_bounds(const mw_model *m, const double *x)
{
    const mw_name *end = m->unknowns + m->nx;
    for (const mw_name *unknown = m->unknowns; unknown < end; unknown++, x++)
        if (!(*x >= unknown->lower && *x <= unknown->upper)) return 0;
    return 1;
}

/* Size of a vector, without a root. */
MW_DEVICE static inline double mwi_extent(const double *a)
{
    return mwi_abs(a[0]) + mwi_abs(a[1]) + mwi_abs(a[2]);
}

/* Size of the terms of a body's point, mm, which moves with its surface parameters x and turns by an angle. */
MW_DEVICE static inline double mwi_terms(const mw_body *body, const double *o, const double *place, double angle, const double *x)
{
    double size = (1.0 + mwi_abs(angle)) * mwi_extent(place);
    for (int i = 0; i < body->parameters; i++) size += mwi_abs(x[body->unknowns[i]]) * mwi_extent(o + body->at + 3 * i);
    return size;
}

/* Whether a gap is within the rounding of terms of this size. */
MW_DEVICE static inline int mwi_is_rounding(double gap, double size, double unit)
{
    return gap <= MWI_ROUNDING * size && gap <= MWI_BELIEVED * unit;
}

/* Judge a solution x[nx] by its observation o[no]: MW_CONVERGED where the flanks touch in it, else why they do not. */
MW_BY_TABLE static inline int mwi_touch(const mw_model *m, const double *x, const double *o)
{
    double apart[3], sum[3];
    const double *pinion = o, *wheel = o + 6, *forms = o + m->geometry + 6; /* points and normals; second forms */
    const double angle = o[m->wheel_angle];
    if (!mwi_within_bounds(m, x)) return MW_LEFT_FLANK;
    for (int i = 0; i < 3; i++) {
        apart[i] = pinion[i] - wheel[i];
        sum[i] = pinion[3 + i] + wheel[3 + i];
    }
    const double size = mwi_terms(&m->bodies[0], o, pinion, 0.0, x) + mwi_terms(&m->bodies[1], o, wheel, angle, x);
    const double unit = 1.0 + mwi_larger(mwi_extent(pinion), mwi_extent(wheel));
    /* a normal turns by the curvature of its surface where the point moves */
    const double turns = 2.0 + mwi_abs(angle) + (mwi_extent(forms) + mwi_extent(forms + 3)) * size;
    if (mwi_is_rounding(mwi_extent(apart), size, unit) && mwi_is_rounding(mwi_extent(sum), turns, 1.0)) return MW_CONVERGED;
    return mwi_dot(pinion + 3, wheel + 3) > 0.0 ? MW_NO_CONTACT : MW_DIVERGED;
}

#endif
