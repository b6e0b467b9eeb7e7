/* The contact of whichever pair is in mesh, from the solution before it where that serves.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FOLLOW_H
#define MWI_FOLLOW_H

#include "choice.h"
#include "reduce.h"

/* Longest way from one solution to the next without asking the reference, rad. */
static const double MWI_WARM = 0.25;

/* What a state keeps of its pair at s[model->memory]: the angle of its reference, not a number before it was sought, infinite
 * where there is none; the angle of the last solution of the branch, not a number where the last is of none; the sign of
 * curvature along the branch. From MWI_KEPT on, nx numbers each: the reference, the last solution. */
enum { MWI_REFERENCE_KEPT, MWI_LAST_KEPT, MWI_BEND_KEPT, MWI_KEPT };

static inline int mwi_has_memory(const mw_model *m)
{
    return m->memory >= 0 && m->ns - m->np - m->memory >= MWI_KEPT + 2 * m->nx;
}

/* The pair that `kept` knows or, where that is new, of the design; returns the guard that this does not pass. */
static inline int mwi_recall(mwi_pair *t, const double *kept)
{
    const int nx = t->m->nx;
    if (kept[MWI_REFERENCE_KEPT] != kept[MWI_REFERENCE_KEPT]) {
        const int guard = t->m->setup(t->p, t->s);
        if (!guard) mwi_find_reference(t);
        return guard;
    }
    t->reference = mwi_no_history();
    mwi_copy(t->at_reference, kept + MWI_KEPT, nx);
    t->bend = (int)kept[MWI_BEND_KEPT];
    t->reach = 0.0;
    if (kept[MWI_REFERENCE_KEPT] < HUGE_VAL) mwi_remember(&t->reference, kept[MWI_REFERENCE_KEPT], t->at_reference);
    mwi_begin_walk(t);
    return 0;
}

static inline void mwi_keep(const mwi_pair *t, double *kept, double last, const double *x)
{
    const int nx = t->m->nx;
    kept[MWI_REFERENCE_KEPT] = t->reference.count > 0 ? t->reference.phi[0] : HUGE_VAL;
    kept[MWI_LAST_KEPT] = last;
    kept[MWI_BEND_KEPT] = (double)t->bend;
    mwi_copy(kept + MWI_KEPT, t->at_reference, nx);
    mwi_copy(kept + MWI_KEPT + nx, x, nx);
}

/* Go on from x, if that is the last solution kept and phi is near its angle. Returns 0 where that does not serve. */
static inline int mwi_go_on(const mw_model *m, double *s, double *kept, double phi, double *x, mw_info *info)
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

static inline double mwi_own_angle(const mw_model *m, const double *p, double phi, double *pair)
{
    return mwi_reduce(p[m->teeth], mwi_reference_of(m, p), phi, pair);
}

/* The contact of pair 0 at its own angle; s[ns] from setup, left set up for it; p[np] its parameters; work[np]; x[nx] in: what the
 * call before gave, or not a number; out: the contact, not a number where there is none. Returns info->status. */
static inline int mwi_follow_at(const mw_model *m, const double *p, double angle, double *s, double *work, double *x, mw_info *info)
{
    double *const kept = mwi_has_memory(m) ? s + m->memory : NULL;
    const int warm = kept && mwi_go_on(m, s, kept, angle, x, info);
    if (!kept) mwi_solve(m, p, angle, s, work, x, info);
    else if (!warm) {
        mwi_pair t;
        t.m = m, t.p = p, t.s = s, t.work = work;
        *info = mwi_ended(MW_BAD_INPUT, mwi_recall(&t, kept));
        if (!info->guard) mwi_keep(&t, kept, mwi_solved(&t, angle, x, info) ? angle : NAN, x);
        m->set_phi(s, angle);
    }
    info->cold = !warm;
    for (int i = 0; i < m->nx && info->status < 0; i++) x[i] = NAN;
    return info->status;
}

/* That of the pair in mesh at phi, at info->angle of its own. */
static inline int mwi_follow(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info)
{
    double pair;
    const double angle = mwi_own_angle(m, p, phi, &pair);
    *info = mwi_ended(MW_BAD_INPUT, 0);
    if (angle == angle) mwi_follow_at(m, p, angle, s, work, x, info);
    else for (int i = 0; i < m->nx; i++) x[i] = NAN;
    info->pair = pair, info->angle = angle;
    return info->status;
}

#endif
