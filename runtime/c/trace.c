/* The contact of a tooth pair at one angle and at many.  SPDX-License-Identifier: MIT-0
 *
 * The rule is "Which contact" in meshwright.h. */
#include <math.h>
#include <string.h>
#include "branch.h"
#include "choice.h"

/* Where nothing touches at angle 0 (misalignment may have moved the contact): angles at which a contact on both flanks
 * is tried next, ever further to either side. From FIRST on they double; the last is past a turn of the pinion. */
enum { DOUBLINGS = 10 };
static const double FIRST = 1.0 / 64.0; /* rad */

/* The branch of the reference, walked along stations at equal spacing from it, so that every angle is reached by the same
 * steps whichever angles are asked for. The newest of the history is the station reached; `ended` says why none comes
 * after it, 0 where one may. */
typedef struct walk {
    mw_history history;
    double at[2][MW_MAX_UNKNOWNS], beside[MW_MAX_UNKNOWNS];
    int station, ended;          /* stations are counted from the reference, negative below it */
} walk;

/* Between stations the unknowns move by a part of their natural sizes. */
static const double STATION = 0.25; /* rad */

/* Points of a trace go from one to the next in single steps. That none came out on another branch is checked against the
 * walk, every so many points for each station of it; where one did, the points since the last check are walked to. */
enum { CHECK_EVERY = 256 };

/* Solutions nearer than this, in natural sizes, are one; near line contact they scatter along the line. */
static const double SAME = 1e-4;

typedef struct trace {
    const mw_model *m;
    const double *p, *phi;
    size_t n;
    double *s, *work, *x;
    mw_info *info;
    mw_history reference, history;
    double at_reference[MW_MAX_UNKNOWNS], beside[MW_MAX_UNKNOWNS];
    walk walk;
    size_t checked, walked;      /* points before these numbers are on the branch; have to be walked to */
} trace;

/* Where the pair meets in the middle of its flanks. */
static double reference_angle(const trace *t)
{
    return t->m->reference < 0 ? 0.0 : t->p[t->m->reference];
}

/* The tangency at a reference angle: what the start values lead to or, at angle 0 and if that is impossible, a contact
 * that bodies can make. */
static int tangency_at(trace *t, double phi, mw_info *info)
{
    double *x = t->at_reference;
    const int started = mw_start(t->m, t->p, phi, t->s, t->work, x, info) >= 0;
    if (started && mw_worth_of(t->m, t->s, x) != MW_IMPOSSIBLE) return 1;
    return (phi == reference_angle(t) && mw_search(t->m, t->s, x, info)) || started;
}

static void find_reference(trace *t)
{
    mw_info info;
    double angle = reference_angle(t);
    int found = tangency_at(t, angle, &info);
    for (int k = 0; k < 2 * DOUBLINGS && !found; k++) {
        angle = reference_angle(t) + ldexp(k % 2 ? -FIRST : FIRST, k / 2);
        found = tangency_at(t, angle, &info) && mw_worth_of(t->m, t->s, t->at_reference) >= MW_ON_BOTH_FLANKS;
    }
    /* a point of a contact line is arbitrary: no branch begins there */
    if (found && mw_worth_of(t->m, t->s, t->at_reference) != MW_OF_A_LINE)
        mw_remember(&t->reference, angle, t->at_reference);
}

static void begin_walk(trace *t)
{
    memset(&t->walk, 0, sizeof t->walk);
    t->walk.history = t->reference;
}

/* Walk on to the next station of that side. */
static void to_next_station(trace *t, int side)
{
    walk *w = &t->walk;
    double x[MW_MAX_UNKNOWNS];
    mw_info info;
    const double phi = t->reference.phi[0] + (w->station + side) * STATION;
    if (w->history.count == 1) mw_take_direction(t->m, &w->history, phi, t->s, w->beside);
    if (mw_walk(t->m, &w->history, phi, t->s, x, &info) < 0) {
        w->ended = info.status;
        return;
    }
    w->station += side;
    double *place = w->at[w->station & 1];
    memcpy(place, x, sizeof x);
    mw_remember(&w->history, phi, place);
    w->history.count = 2;
}

/* The point of the branch at phi, from the station before it. */
static int walk_to(trace *t, double phi, double *x, mw_info *info)
{
    walk *w = &t->walk;
    const double distance = phi - t->reference.phi[0];
    const int side = distance < 0.0 ? -1 : 1, last = (int)(fabs(distance) / STATION) * side;
    if (w->station * side < 0 || w->station * side > last * side || (w->station == 0 && w->ended)) begin_walk(t);
    while (w->station != last && !w->ended) to_next_station(t, side);
    memset(info, 0, sizeof *info);
    if (w->station != last) return info->status = w->ended;
    if (distance == 0.0) {
        memcpy(x, t->reference.x[0], sizeof(double) * (size_t)t->m->nx);
        t->m->set_phi(t->s, phi);
        return mw_refine(t->m, t->s, x, info);
    }
    mw_history from = w->history;
    double beside[MW_MAX_UNKNOWNS];
    if (from.count == 1) mw_take_direction(t->m, &from, phi, t->s, beside);
    return mw_walk(t->m, &from, phi, t->s, x, info);
}

static int possible(const trace *t, double phi, const double *x)
{
    t->m->set_phi(t->s, phi);
    return mw_worth_of(t->m, t->s, x) != MW_IMPOSSIBLE;
}

/* Whether point k is of the branch, and bodies can make it. */
static int holds(trace *t, size_t k)
{
    double x[MW_MAX_UNKNOWNS];
    mw_info info;
    return walk_to(t, t->phi[k], x, &info) >= 0 && possible(t, t->phi[k], x) &&
           mw_near(t->m, t->s, x, t->x + k * (size_t)t->m->nx, SAME);
}

/* Solve point k where no branch leads: the tangency in the middle, unless bodies can make another. */
static void alone(trace *t, size_t k)
{
    double *x = t->x + k * (size_t)t->m->nx;
    mw_info *info = t->info + k;
    const int status = mw_start(t->m, t->p, t->phi[k], t->s, t->work, x, info);
    if (status >= 0 && mw_worth_of(t->m, t->s, x) != MW_IMPOSSIBLE) return;
    if (!mw_search(t->m, t->s, x, info) && status == MW_DIVERGED) info->status = MW_NO_CONTACT;
}

/* Solve point k by walking to it, or by search. */
static void by_walk(trace *t, size_t k)
{
    double *x = t->x + k * (size_t)t->m->nx;
    const int status = walk_to(t, t->phi[k], x, t->info + k);
    memset(&t->history, 0, sizeof t->history);
    t->checked = k + 1;
    if (status >= 0 && possible(t, t->phi[k], x)) {
        mw_remember(&t->history, t->phi[k], x);
        return;
    }
    t->m->set_phi(t->s, t->phi[k]);
    mw_search(t->m, t->s, x, t->info + k);
}

/* Solve point k by a step from the points before it. Returns 0 where that does not succeed. */
static int by_leap(trace *t, size_t k)
{
    double *x = t->x + k * (size_t)t->m->nx;
    const double phi = t->phi[k];
    if (t->history.count == 0 || phi == t->history.phi[0]) return 0;
    if (t->history.count == 1) mw_take_direction(t->m, &t->history, phi, t->s, t->beside);
    if (!mw_leap(t->m, &t->history, phi, t->s, x, t->info + k)) return 0;
    mw_remember(&t->history, phi, x);
    return 1;
}

static int check_is_due(const trace *t, size_t k)
{
    const double stations = 1.0 + fabs(t->phi[k] - t->reference.phi[0]) / STATION;
    return k + 1 == t->n || (double)(k + 1 - t->checked) >= (double)CHECK_EVERY * stations;
}

/* Walk to the points since the last check up to number `end`. */
static size_t back(trace *t, size_t end)
{
    t->walked = end;
    t->history.count = 0;
    return t->checked;
}

/* Solve point k of the branch; returns the number of the point that is next. */
static size_t on_branch(trace *t, size_t k)
{
    if (k >= t->walked && by_leap(t, k)) {
        if (!check_is_due(t, k)) return k + 1;
        if (!holds(t, k)) return back(t, k + 1);
        t->checked = k + 1;
        t->m->set_phi(t->s, t->phi[k]);
        return k + 1;
    }
    if (k > t->checked && !holds(t, k - 1)) return back(t, k);
    by_walk(t, k);
    return k + 1;
}

int mw_angle_in_range(double phi)
{
    return fabs(phi) <= (double)MW_MAX_ANGLE; /* not-a-number is not */
}

/* Trace the points of `all` from number `begin` on, as long as their angles are in range; returns the number of the
 * next point. */
static size_t trace_in_range(const trace *all, size_t begin)
{
    trace t = *all;
    t.phi += begin, t.x += begin * (size_t)t.m->nx, t.info += begin;
    for (t.n = 0; begin + t.n < all->n && mw_angle_in_range(t.phi[t.n]);) t.n++;
    if (t.n > 0) t.m->setup(t.p, t.s);
    begin_walk(&t);
    for (size_t k = 0; k < t.n && t.reference.count == 0; k++) alone(&t, k);
    for (size_t k = 0; k < t.n && t.reference.count > 0;) k = on_branch(&t, k);
    return begin + t.n;
}

size_t mw_trace(const mw_model *m, const double *p, const double *phi, size_t n, double *s, double *work, double *x,
                mw_info *info)
{
    trace t = { .m = m, .p = p, .phi = phi, .n = n, .s = s, .work = work, .x = x, .info = info };
    size_t succeeded = 0;
    const int guard = m->setup(p, s);
    for (size_t k = 0; k < n && guard; k++) info[k] = (mw_info){ .status = MW_BAD_INPUT, .guard = guard };
    if (guard) return 0;
    find_reference(&t);
    for (size_t k = trace_in_range(&t, 0); k < n; k = trace_in_range(&t, k + 1))
        info[k] = (mw_info){ .status = MW_BAD_INPUT };
    for (size_t k = 0; k < n; k++) succeeded += info[k].status >= 0;
    return succeeded;
}

int mw_solve(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info)
{
    mw_trace(m, p, &phi, 1, s, work, x, info);
    return info->status;
}
