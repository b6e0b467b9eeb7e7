/* The contact of a tooth pair at one angle: the rule is "Which contact" in meshwright.h.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_CHOICE_H) && !defined(MW_DEVICE_ONLY)
#define MWI_CHOICE_H

#include "branch.h"
#include "search.h"

/* Where nothing touches at the reference angle (misalignment may have moved the contact): angles at which a contact on both flanks
 * is tried next, ever further to either side. From FIRST on they double; the last is past a turn of the pinion. */
enum { MWI_DOUBLINGS = 10 };
static const double MWI_FIRST = 1.0 / 64.0; /* rad */

/* Between stations the unknowns move by a part of their natural sizes. */
static const double MWI_STATION = 0.25; /* rad */

/* So near to its reference, rad, no tooth is asked whether the wheel has turned it away: no wheel turns half a turn sooner. */
static const double MWI_FAR = 1.0;
static const double MWI_HALF_A_TURN = 3.141592653589793;

/* Strides of one attempt to reach an angle, at most. */
enum { MWI_MAX_STRIDES = 4 };

/* A tooth pair and the branch of its reference, walked along stations at equal spacing from it, so that every angle is
 * reached by the same steps whichever angles are asked for. p[np] complete; s[ns] and work[np] are written. The newest of
 * `walked` is the station reached, counted from the reference and negative below it; `ended` says why none comes after
 * it, 0 where one may. `bend` is the sign of curvature of the branch; the wheel turns half a turn within `reach`, 0: not
 * known yet. */
typedef struct mwi_pair {
    const mw_model *m;
    const double *p;
    double *s, *work;
    mwi_history reference, walked;
    double at_reference[MW_MAX_UNKNOWNS], at[2][MW_MAX_UNKNOWNS], beside[MW_MAX_UNKNOWNS], reach;
    int station, ended, bend;
} mwi_pair;

static inline void mwi_begin_walk(mwi_pair *t)
{
    t->station = t->ended = 0;
    t->walked = t->reference;
}

static inline double mwi_reference_angle(const mwi_pair *t)
{
    return mwi_reference_of(t->m, t->p);
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
    t->bend = 0, t->reach = 0.0;
    for (int k = 0; k < 2 * MWI_DOUBLINGS && !found; k++) {
        angle = mwi_reference_angle(t) + (k % 2 ? -next : next);
        if (k % 2) next *= 2.0;
        found = mwi_tangency_at(t, angle, &info) && mwi_worth_of(t->m, t->s, t->at_reference) >= MWI_ON_BOTH_FLANKS;
    }
    /* a point of a contact line is arbitrary: no branch begins there */
    if (found && mwi_worth_of(t->m, t->s, t->at_reference) != MWI_OF_A_LINE)
        mwi_remember(&t->reference, angle, t->at_reference);
    if (t->reference.count > 0) {
        t->m->set_phi(t->s, angle);
        t->bend = mwi_bend(t->m, t->s, t->at_reference);
    }
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

/* The point of the branch at phi in as few strides from the reference as serve. Returns 0 where so many do not. */
static inline int mwi_strode(mwi_pair *t, double phi, double *x, mw_info *info)
{
    const double first = t->reference.phi[0];
    for (int strides = 1; strides <= MWI_MAX_STRIDES; strides *= 2) {
        double from[MW_MAX_UNKNOWNS], before = first;
        mwi_copy(from, t->reference.x[0], t->m->nx);
        for (int k = 1; k <= strides; k++) {
            const double next = k == strides ? phi : first + (phi - first) * k / strides;
            if (!mwi_stride(t->m, t->s, before, from, t->bend, next, x, info)) break;
            if (k == strides) return 1;
            mwi_copy(from, x, t->m->nx);
            before = next;
        }
    }
    return 0;
}

/* How far the wheel turns with a turn of the pinion by 1 without an error. s is left set up for that. */
static inline double mwi_ratio(const mw_model *m, double *s)
{
    double o[MW_MAX_OBSERVATION], x[MW_MAX_UNKNOWNS];
    mwi_clear(x, m->nx);
    m->set_phi(s, 0.0);
    m->observe(s, x, o);
    const double before = o[m->wheel_angle];
    m->set_phi(s, 1.0);
    m->observe(s, x, o);
    return o[m->wheel_angle] - before;
}

/* Whether the wheel has turned the tooth of the pair away from the pinion. */
static inline int mwi_faces_away(mwi_pair *t, double phi)
{
    const double distance = mwi_abs(phi - mwi_reference_angle(t));
    if (!(distance > MWI_FAR)) return 0;
    if (t->reach == 0.0) t->reach = MWI_HALF_A_TURN / mwi_abs(mwi_ratio(t->m, t->s));
    return distance > t->reach;
}

/* Why the pair cannot be solved for phi, 0 where it can be tried. */
static inline int mwi_out_of_reach(mwi_pair *t, double phi)
{
    if (!(mwi_abs(phi) <= MW_MAX_ANGLE)) return MW_BAD_INPUT;
    return mwi_faces_away(t, phi) ? MW_NO_CONTACT : mwi_angle_in_range(phi) ? 0 : MW_BAD_INPUT;
}

/* The contact at phi. Returns 1 where it is a point of the branch. */
static inline int mwi_solved(mwi_pair *t, double phi, double *x, mw_info *info)
{
    const int out = mwi_out_of_reach(t, phi);
    if (out != 0) {
        *info = mwi_ended(out, 0);
        return 0;
    }
    if (t->reference.count == 0) {
        mwi_alone(t, phi, x, info);
        return 0;
    }
    if (!mwi_strode(t, phi, x, info) && !mwi_by_walk(t, phi, x, info)) return 0;
    t->m->set_phi(t->s, phi);
    mwi_settle(t->m, t->s, x);
    return 1;
}

/* The contact at phi, not a number where there is none; s[ns] is left set up for it. Returns info->status. */
static inline int mwi_solve(const mw_model *m, const double *p, double phi, double *s, double *work, double *x,
                            mw_info *info)
{
    mwi_pair t;
    *info = mwi_ended(MW_BAD_INPUT, 0);
    if (!mwi_usable(m)) return MW_BAD_INPUT;
    info->guard = m->setup(p, s);
    if (!info->guard && mwi_abs(phi) <= MW_MAX_ANGLE) {
        t.m = m, t.p = p, t.s = s, t.work = work;
        mwi_find_reference(&t);
        mwi_solved(&t, phi, x, info);
        m->set_phi(s, phi);
    }
    for (int i = 0; i < m->nx && info->status < 0; i++) x[i] = NAN;
    return info->status;
}

#endif
