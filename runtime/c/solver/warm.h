/* From one contact of a branch to the next by its tangent, without a walk.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_WARM_H
#define MWI_WARM_H

#include "reduce.h"
#include "touch.h"

/* Where a pair meets in the middle of its flanks. */
MW_BY_TABLE static inline double mwi_reference_of(const mw_model *m, const double *p)
{
    return m->reference < 0 ? 0.0 : p[m->reference];
}

MW_BY_TABLE static inline double mwi_own_angle(const mw_model *m, const double *p, double phi, double *pair)
{
    return mwi_reduce(p[m->teeth], mwi_reference_of(m, p), phi, pair);
}

/* Steps are sums over the unknowns in units of their natural size: the next would be round-off. */
static const double MWI_FUSED_TOLERANCE = 1e-9;

/* How far from its prediction, in natural sizes of the unknowns, a solution may lie and still be of the branch. */
static const double MWI_BRANCH_WIDTH = 0.25;

/* From a point of a branch so far on, rad, one Newton step is the tangent's, to as many digits as a prediction needs. */
static const double MWI_BESIDE = 1e-5;

/* A stride along a branch: no more Newton steps, each a tenth of the one before. */
enum { MWI_STRIDE_STEPS = 6 };
static const double MWI_CONTRACTION = 0.1;

/* Solutions are made the same, to the last bit, wherever Newton's method came from: rounded to this part of a natural size, then
 * two steps, the second of which is round-off. */
static const double MWI_GRID = 1e-8;
static const double MWI_NO_FURTHER = 1e-7;

/* Longest way from one solution to the next without asking the reference, rad. */
static const double MWI_WARM = 0.25;

/* What a state keeps of its pair at s[model->memory]: the angle of its reference, not a number before it was sought, infinite
 * where there is none; the angle of the last solution of the branch, not a number where the last is of none; the sign of
 * curvature along the branch. From MWI_KEPT on, nx numbers each: the reference, the last solution. */
enum { MWI_REFERENCE_KEPT, MWI_LAST_KEPT, MWI_BEND_KEPT, MWI_KEPT };

MW_BY_TABLE static inline int mwi_has_memory(const mw_model *m)
{
    return m->memory >= 0 && m->ns - m->np - m->memory >= MWI_KEPT + 2 * m->nx;
}

/* Whether a and b lie within so many natural sizes of each other. */
MW_BY_TABLE static inline int mwi_near(const mw_model *m, const double *s, const double *a, const double *b, double sizes)
{
    double scale[MW_MAX_UNKNOWNS];
    MW_CALL(m, scale)(s, scale);
    for (int i = 0; i < m->nx; i++)
        if (!(mwi_abs(a[i] - b[i]) <= sizes * scale[i])) return 0;
    return 1;
}

/* Sign of the relative Gaussian curvature, 0 along a line of contact. Along a branch it changes only where the equations
 * are singular, or a flank is: of solutions that differ in it one is of another branch, or beyond such a place. */
MW_DEVICE static inline int mwi_bend_of(const mw_contact *c)
{
    return c->line ? 0 : c->curvature_min * c->curvature_max > 0.0 ? 1 : -1;
}

/* What a tangency is worth: bodies cannot make it; they can, beyond a limit of a flank; they can, on both flanks; it is
 * one of a line of them. */
typedef enum mwi_worth { MWI_IMPOSSIBLE, MWI_BEYOND_LIMITS, MWI_ON_BOTH_FLANKS, MWI_OF_A_LINE } mwi_worth;

MW_BY_TABLE static inline mwi_worth mwi_worth_in(const mw_model *m, const mw_contact *c)
{
    const char *flag;
    if (c->line) return MWI_OF_A_LINE;
    if (!(c->curvature_min > 0.0)) return MWI_IMPOSSIBLE;
    for (int bit = 0; c->flags >> bit && (flag = mwi_flag(m, bit)) != NULL; bit++)
        if ((c->flags >> bit & 1u) && mwi_impossible(flag)) return MWI_IMPOSSIBLE;
    return c->flags ? MWI_BEYOND_LIMITS : MWI_ON_BOTH_FLANKS;
}

/* The tangent of the branch at its point x at phi: predicted[nx] is the point of it at `to`. */
MW_BY_TABLE static inline void mwi_along_tangent(const mw_model *m, double *s, double phi, const double *x, double to, double *predicted)
{
    mwi_copy(predicted, x, m->nx);
    MW_CALL(m, set_phi)(s, phi + MWI_BESIDE);
    MW_CALL(m, step)(s, predicted);
    for (int i = 0; i < m->nx; i++) predicted[i] = x[i] + (predicted[i] - x[i]) * ((to - phi) / MWI_BESIDE);
}

/* Newton's method from x where its first step is no longer than MWI_BRANCH_WIDTH and each further one a tenth. */
MW_BY_TABLE static inline int mwi_contracted(const mw_model *m, const double *s, double *x, mw_info *info)
{
    double longest = MWI_BRANCH_WIDTH;
    *info = mwi_ended(MW_CONVERGED, 0);
    for (info->iterations = 1; info->iterations <= MWI_STRIDE_STEPS; info->iterations++) {
        info->step = MW_CALL(m, step)(s, x);
        if (info->step < MWI_FUSED_TOLERANCE) return mwi_within_bounds(m, x);
        if (!(info->step <= longest)) return 0;
        longest = MWI_CONTRACTION * info->step;
    }
    return 0;
}

/* Whether x is a contact that bodies can make, on a branch of this sign of curvature. */
MW_BY_TABLE static inline int mwi_is_of(const mw_model *m, const double *s, int bend, const double *x)
{
    double o[MW_MAX_OBSERVATION];
    mw_contact c;
    mwi_contact_at(m, s, x, o, &c);
    return mwi_bend_of(&c) == bend && mwi_touch(m, x, o) >= 0 && mwi_worth_in(m, &c) != MWI_IMPOSSIBLE;
}

MW_BY_TABLE static inline void mwi_settle(const mw_model *m, const double *s, double *x)
{
    double at[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    MW_CALL(m, scale)(s, scale);
    for (int i = 0; i < m->nx; i++) {
        const double much = MWI_TO_INTEGER * (MWI_GRID * scale[i]);
        at[i] = (x[i] + much) - much;
    }
    MW_CALL(m, step)(s, at);
    if (MW_CALL(m, step)(s, at) < MWI_FUSED_TOLERANCE && mwi_near(m, s, at, x, MWI_NO_FURTHER)) mwi_copy(x, at, m->nx);
}

/* From the point x0 at phi0 of a branch with this sign of curvature to that at phi. Returns 0 where that does not serve. */
MW_BY_TABLE static inline int mwi_stride(const mw_model *m, double *s, double phi0, const double *x0, int bend, double phi, double *x,
                                         mw_info *info)
{
    mwi_along_tangent(m, s, phi0, x0, phi, x);
    MW_CALL(m, set_phi)(s, phi);
    return mwi_contracted(m, s, x, info) && mwi_is_of(m, s, bend, x);
}

/* Go on from x, if that is the last solution kept and phi is near its angle. Returns 0 where that does not serve. */
MW_BY_TABLE static inline int mwi_go_on(const mw_model *m, double *s, double *kept, double phi, double *x, mw_info *info)
{
    double *last = kept + MWI_KEPT + m->nx, at[MW_MAX_UNKNOWNS];
    if (!(mwi_abs(phi - kept[MWI_LAST_KEPT]) <= MWI_WARM)) return 0;
    for (int i = 0; i < m->nx; i++)
        if (!(x[i] == last[i])) return 0;
    if (!mwi_stride(m, s, kept[MWI_LAST_KEPT], x, (int)kept[MWI_BEND_KEPT], phi, at, info)) return 0;
    mwi_settle(m, s, at);
    kept[MWI_LAST_KEPT] = phi;
    mwi_copy(last, at, m->nx);
    mwi_copy(x, at, m->nx);
    return 1;
}

#endif
