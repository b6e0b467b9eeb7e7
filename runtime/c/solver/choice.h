/* The contact of a tooth pair at one angle: the rule is "Which contact" in meshwright.h.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_CHOICE_H
#define MWI_CHOICE_H

#include "branch.h"
#include "search.h"

/* Where nothing touches at the reference angle (misalignment may have moved the contact): angles at which a contact on both flanks
 * is tried next, ever further to either side. From FIRST on they double; the last is past a turn of the pinion. */
enum { MWI_DOUBLINGS = 10 };
static const double MWI_FIRST = 1.0 / 64.0; /* rad */

/* Between stations the unknowns move by a part of their natural sizes. */
static const double MWI_STATION = 0.25; /* rad */

/* A tooth pair and the branch of its reference, walked along stations at equal spacing from it, so that every angle is
 * reached by the same steps whichever angles are asked for. p[np] complete; s[ns] and work[np] are written. The newest of
 * `walked` is the station reached, counted from the reference and negative below it; `ended` says why none comes after
 * it, 0 where one may. */
typedef struct mwi_pair {
    const mw_model *m;
    const double *p;
    double *s, *work;
    mwi_history reference, walked;
    double at_reference[MW_MAX_UNKNOWNS], at[2][MW_MAX_UNKNOWNS], beside[MW_MAX_UNKNOWNS];
    int station, ended;
} mwi_pair;

static inline void mwi_begin_walk(mwi_pair *t)
{
    t->station = t->ended = 0;
    t->walked = t->reference;
}

/* Where the pair meets in the middle of its flanks. */
static inline double mwi_reference_angle(const mwi_pair *t)
{
    return t->m->reference < 0 ? 0.0 : t->p[t->m->reference];
}

/* The tangency at a reference angle: what the start values lead to or, at the first and if that is impossible, a contact
 * that bodies can make. */
static inline int mwi_tangency_at(mwi_pair *t, double phi, mw_info *info)
{
    double *x = t->at_reference;
    const int first = phi == mwi_reference_angle(t);
    const double smallest = first ? MWI_SMALLEST_STEP : MWI_SMALLEST_LOOK;
    const int started = mwi_start(t->m, t->p, phi, smallest, t->s, t->work, x, info) >= 0;
    if (started && mwi_worth_of(t->m, t->s, x) != MWI_IMPOSSIBLE) return 1;
    return (first && mwi_search(t->m, t->s, x, info)) || started;
}

/* The pair of a design that passes its guards, at its reference; there is none if t->reference is empty. */
static inline void mwi_find_reference(mwi_pair *t)
{
    mw_info info;
    double angle = mwi_reference_angle(t), next = MWI_FIRST;
    int found = mwi_tangency_at(t, angle, &info);
    t->reference = mwi_no_history();
    for (int k = 0; k < 2 * MWI_DOUBLINGS && !found; k++) {
        angle = mwi_reference_angle(t) + (k % 2 ? -next : next);
        if (k % 2) next *= 2.0;
        found = mwi_tangency_at(t, angle, &info) && mwi_worth_of(t->m, t->s, t->at_reference) >= MWI_ON_BOTH_FLANKS;
    }
    /* a point of a contact line is arbitrary: no branch begins there */
    if (found && mwi_worth_of(t->m, t->s, t->at_reference) != MWI_OF_A_LINE)
        mwi_remember(&t->reference, angle, t->at_reference);
    t->m->setup(t->p, t->s);
    mwi_begin_walk(t);
}

/* Walk on to the next station of that side. */
static inline void mwi_to_next_station(mwi_pair *t, int side)
{
    double x[MW_MAX_UNKNOWNS];
    mw_info info;
    const double phi = t->reference.phi[0] + (t->station + side) * MWI_STATION;
    if (t->walked.count == 1) mwi_take_direction(t->m, &t->walked, phi, t->s, t->beside);
    if (mwi_walk(t->m, &t->walked, phi, t->s, x, &info) < 0) {
        t->ended = info.status;
        return;
    }
    t->station += side;
    double *place = t->at[t->station & 1];
    mwi_copy(place, x, t->m->nx);
    mwi_remember(&t->walked, phi, place);
    t->walked.count = 2;
}

/* The point of the branch at phi, from the station before it. */
static inline int mwi_walk_to(mwi_pair *t, double phi, double *x, mw_info *info)
{
    const double distance = phi - t->reference.phi[0];
    const int side = distance < 0.0 ? -1 : 1, last = (int)(mwi_abs(distance) / MWI_STATION) * side;
    if (t->station * side < 0 || t->station * side > last * side || (t->station == 0 && t->ended)) mwi_begin_walk(t);
    while (t->station != last && !t->ended) mwi_to_next_station(t, side);
    *info = mwi_ended(t->ended, 0);
    if (t->station != last) return info->status;
    if (distance == 0.0) {
        mwi_copy(x, t->reference.x[0], t->m->nx);
        t->m->set_phi(t->s, phi);
        return mwi_refine(t->m, t->s, x, info);
    }
    mwi_history from = t->walked;
    double beside[MW_MAX_UNKNOWNS];
    if (from.count == 1) mwi_take_direction(t->m, &from, phi, t->s, beside);
    return mwi_walk(t->m, &from, phi, t->s, x, info);
}

static inline int mwi_possible(const mwi_pair *t, double phi, const double *x)
{
    t->m->set_phi(t->s, phi);
    return mwi_worth_of(t->m, t->s, x) != MWI_IMPOSSIBLE;
}

/* Solve where no branch leads: the tangency in the middle, unless bodies can make another. */
static inline void mwi_alone(mwi_pair *t, double phi, double *x, mw_info *info)
{
    const int status = mwi_start(t->m, t->p, phi, MWI_SMALLEST_STEP, t->s, t->work, x, info);
    if (status >= 0 && mwi_worth_of(t->m, t->s, x) != MWI_IMPOSSIBLE) return;
    if (!mwi_search(t->m, t->s, x, info) && status == MW_DIVERGED) info->status = MW_NO_CONTACT;
}

/* Solve by walking along the branch, or by search. Returns 1 where the solution is a point of the branch. */
static inline int mwi_by_walk(mwi_pair *t, double phi, double *x, mw_info *info)
{
    if (mwi_walk_to(t, phi, x, info) >= 0 && mwi_possible(t, phi, x)) return 1;
    t->m->set_phi(t->s, phi);
    mwi_search(t->m, t->s, x, info);
    return 0;
}

/* The contact at phi, not a number where there is none; s[ns] is left set up for it. Returns info->status. */
static inline int mwi_solve(const mw_model *m, const double *p, double phi, double *s, double *work, double *x,
                            mw_info *info)
{
    mwi_pair t;
    *info = mwi_ended(MW_BAD_INPUT, 0);
    if (!mwi_usable(m)) return MW_BAD_INPUT;
    const int known = mwi_angle_in_range(phi);
    if (known) info->guard = m->setup(p, s);
    if (known && !info->guard) {
        t.m = m, t.p = p, t.s = s, t.work = work;
        mwi_find_reference(&t);
        if (t.reference.count > 0) mwi_by_walk(&t, phi, x, info);
        else mwi_alone(&t, phi, x, info);
        m->set_phi(s, phi);
    }
    for (int i = 0; i < m->nx && info->status < 0; i++) x[i] = NAN;
    return info->status;
}

#endif
