/* The contacts of a tooth pair at one angle and at many, and along a branch.  SPDX-License-Identifier: MIT-0
 *
 * The rule is "Which contact" in meshwright.h. */
#include "exact.h"
#include "meshwright.h"
#include "solver/follow.h"
#include "solver/chord.h"

/* Points of a trace go from one to the next in single steps. That none came out on another branch is checked against the
 * walk, every so many points for each station of it; where one did, the points since the last check are solved from the
 * reference. */
enum { CHECK_EVERY = 256 };

/* Solutions nearer than this, in natural sizes, are one; near line contact they scatter along the line. */
static const double SAME = 1e-4;

int mw_solve(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info)
{
    return mwi_solve(m, p, phi, s, work, x, info);
}

int mw_start_values(const mw_model *m, const double *s, double *x)
{
    mw_info info;
    return mwi_usable(m) ? mwi_start_values(m, s, x, &info) : MW_BAD_INPUT;
}

typedef struct trace {
    const mw_model *m;
    const double *phi;
    size_t n;
    double *x;
    mw_info *info;
    mwi_pair pair;
    mwi_history history;
    mwi_chord chord;
    double step;                 /* size of the last */
    double beside[MW_MAX_UNKNOWNS];
    size_t checked, walked;      /* points before these numbers are on the branch; have to be solved from the reference */
} trace;

/* Whether point k is of the branch, and bodies can make it. */
static int holds(trace *t, size_t k)
{
    double x[MW_MAX_UNKNOWNS];
    mw_info info;
    const int there = mwi_strode(&t->pair, t->phi[k], x, &info) ||
                      (mwi_walk_to(&t->pair, t->phi[k], x, &info) >= 0 && mwi_possible(&t->pair, t->phi[k], x));
    return there && mwi_near(t->m, t->pair.s, x, t->x + k * (size_t)t->m->nx, SAME);
}

/* Solve point k from the reference, or by search. */
static void from_reference(trace *t, size_t k)
{
    double *x = t->x + k * (size_t)t->m->nx;
    t->history = mwi_no_history();
    t->checked = k + 1;
    if (mwi_solved(&t->pair, t->phi[k], x, t->info + k)) mwi_remember(&t->history, t->phi[k], x);
}

/* Solve as many points from number k on as the inverse Jacobian of one before serves; returns the number of the next. */
static size_t by_chord(trace *t, size_t k)
{
    const size_t nx = (size_t)t->m->nx, end = t->n - k > CHECK_EVERY ? k + CHECK_EVERY : t->n;
    if (k < MWI_CHORD_ROWS || t->history.count < MWI_CHORD_ROWS) return k;
    if (t->history.x[MWI_CHORD_ROWS - 1] != t->x + (k - MWI_CHORD_ROWS) * nx) return k;
    const size_t next = mwi_chord_run(t->m, &t->chord, t->pair.s, t->phi, k, end, t->x, t->info, &t->step);
    for (size_t i = next - k < MW_HISTORY ? k : next - MW_HISTORY; i < next; i++)
        mwi_remember(&t->history, t->phi[i], t->x + i * nx);
    return next;
}

/* Solve for phi by a step from its prediction with an inverse Jacobian that may serve the points behind it. */
static int by_new_chord(trace *t, double phi, double *x, mw_info *info)
{
    const mw_model *m = t->m;
    if (!mwi_chord_is_due(m, &t->chord, t->step)) return 0;
    m->set_phi(t->pair.s, phi);
    mwi_predict(&t->history, phi, m->nx, x);
    if (!mwi_near(m, t->pair.s, x, t->history.x[0], MWI_STRIDE)) return 0;
    *info = mwi_ended(MW_CONVERGED, 0);
    info->iterations = 1;
    info->step = t->step = mwi_chord_renew(m, &t->chord, t->pair.s, phi, mwi_abs(phi - t->history.phi[0]), x);
    return info->step <= MWI_CHORD_STEP && mwi_within_bounds(m, x);
}

/* Solve point k by a step from the points before it. Returns 0 where that does not succeed. */
static int by_leap(trace *t, size_t k)
{
    double *x = t->x + k * (size_t)t->m->nx;
    const double phi = t->phi[k];
    if (t->history.count == 0 || phi == t->history.phi[0]) return 0;
    if (t->history.count == 1) mwi_take_direction(t->m, &t->history, phi, t->pair.s, t->beside);
    if (!by_new_chord(t, phi, x, t->info + k)) {
        if (!mwi_leap(t->m, &t->history, phi, t->pair.s, x, t->info + k)) return 0;
        t->step = t->info[k].iterations == 1 ? t->info[k].step : HUGE_VAL;
    }
    mwi_remember(&t->history, phi, x);
    return 1;
}

/* Solve points from number k on by steps; returns the number of the next, k where that does not succeed. */
static size_t forward(trace *t, size_t k)
{
    const size_t next = by_chord(t, k);
    return next > k ? next : k + (size_t)by_leap(t, k);
}

static int check_is_due(const trace *t, size_t k)
{
    const double stations = 1.0 + mwi_abs(t->phi[k] - t->pair.reference.phi[0]) / MWI_STATION;
    return k + 1 == t->n || (double)(k + 1 - t->checked) >= (double)CHECK_EVERY * stations;
}

/* Walk to the points since the last check up to number `end`. */
static size_t back(trace *t, size_t end)
{
    t->walked = end;
    t->history.count = 0;
    return t->checked;
}

/* Solve point k of the branch, or several from it on; returns the number of the point that is next. */
static size_t on_branch(trace *t, size_t k)
{
    const size_t next = k < t->walked ? k : forward(t, k);
    if (next > k) {
        if (!check_is_due(t, next - 1)) return next;
        if (!holds(t, next - 1)) return back(t, next);
        t->checked = next;
        t->m->set_phi(t->pair.s, t->phi[next - 1]);
        return next;
    }
    if (k > t->checked && !holds(t, k - 1)) return back(t, k);
    from_reference(t, k);
    return k + 1;
}

/* Trace the points of `all` from number `begin` on, as long as their angles are in range; returns the number of the
 * next point. */
static size_t trace_in_range(const trace *all, size_t begin)
{
    trace t = *all;
    const mw_model *m = t.m;
    t.phi += begin, t.x += begin * (size_t)m->nx, t.info += begin;
    for (t.n = 0; begin + t.n < all->n && !mwi_out_of_reach(&t.pair, t.phi[t.n]);) t.n++;
    if (t.n > 0) m->setup(t.pair.p, t.pair.s);
    mwi_begin_walk(&t.pair);
    for (size_t k = 0; k < t.n && t.pair.reference.count == 0; k++)
        mwi_alone(&t.pair, t.phi[k], t.x + k * (size_t)m->nx, t.info + k);
    for (size_t k = 0; k < t.n && t.pair.reference.count > 0;) k = on_branch(&t, k);
    return begin + t.n;
}

size_t mw_trace(const mw_model *m, const double *p, const double *phi, size_t n, double *s, double *work, double *x,
                mw_info *info)
{
    trace t;
    size_t succeeded = 0;
    const int usable = mwi_usable(m), guard = usable ? m->setup(p, s) : 0;
    for (size_t k = 0; k < n && (!usable || guard); k++) info[k] = mwi_ended(MW_BAD_INPUT, guard);
    for (size_t i = 0; guard && i < n * (size_t)m->nx; i++) x[i] = NAN;
    if (!usable || guard || n == 0) return 0;
    t.m = t.pair.m = m;
    t.pair.p = p, t.pair.s = s, t.pair.work = work;
    t.phi = phi, t.n = n, t.x = x, t.info = info;
    t.history = mwi_no_history();
    t.chord = mwi_no_chord();
    t.step = HUGE_VAL;
    t.checked = t.walked = 0;
    mwi_find_reference(&t.pair);
    for (size_t k = trace_in_range(&t, 0); k < n; k = trace_in_range(&t, k + 1))
        info[k] = mwi_ended(mwi_out_of_reach(&t.pair, phi[k]), 0);
    for (size_t k = 0; k < n; k++) {
        succeeded += info[k].status >= 0;
        for (int i = 0; i < m->nx && info[k].status < 0; i++) x[k * (size_t)m->nx + (size_t)i] = NAN;
    }
    return succeeded;
}

double mw_largest_angle(void)
{
    return MW_MAX_ANGLE;
}

double mw_reduce(const mw_model *m, const double *p, double phi, double *pair)
{
    *pair = NAN;
    return mwi_usable(m) ? mwi_own_angle(m, p, phi, pair) : NAN;
}

size_t mw_turn(const mw_model *m, const double *p, const double *phi, size_t n, double *s, double *work, double *x, mw_info *info)
{
    size_t succeeded = 0;
    const int nx = mwi_usable(m) ? m->nx : 0, guard = nx ? m->setup(p, s) : 0;
    const double *before = NULL;
    for (size_t k = 0; k < n; k++, before = x, x += nx, info++) {
        for (int i = 0; i < nx; i++) x[i] = before ? before[i] : NAN;
        *info = mwi_ended(MW_BAD_INPUT, guard);
        if (nx && !guard) succeeded += mwi_follow(m, p, phi[k], s, work, x, info) >= 0;
    }
    return succeeded;
}

size_t mw_follow(const mw_model *m, double *s, double phi0, const double *x0, const double *phi, size_t n, double *x,
                 mw_info *info)
{
    mwi_history h = mwi_no_history();
    double o[MW_MAX_OBSERVATION];
    const int usable = mwi_usable(m) && mwi_angle_in_range(phi0);
    mwi_remember(&h, phi0, x0);
    for (size_t k = 0; k < n; k++, x += m->nx, info++) {
        *info = mwi_ended(MW_BAD_INPUT, 0);
        if (!usable || !mwi_angle_in_range(phi[k])) return k;
        if (phi[k] == h.phi[0]) {
            mwi_copy(x, h.x[0], m->nx);
            m->set_phi(s, phi[k]);
            m->observe(s, x, o);
            if ((info->status = mwi_touch(m, x, o)) < 0) return k;
            continue;
        }
        int there = mwi_leap(m, &h, phi[k], s, x, info);
        if (there) {
            m->observe(s, x, o);
            there = mwi_touch(m, x, o) >= 0;
        }
        if (!there && mwi_walk(m, &h, phi[k], s, x, info) < 0) return k;
        mwi_remember(&h, phi[k], x);
    }
    return n;
}

/* The point at phi from the polynomial through the nodes about it, the first of which is number `from`. Returns 0 where
 * that does not lead to a contact. */
static int between_nodes(const mw_model *m, double *s, const double *phi0, const double *x0, size_t nodes, size_t from,
                         double phi, double *x, mw_info *info)
{
    mwi_history h = mwi_no_history();
    double o[MW_MAX_OBSERVATION];
    const size_t nx = (size_t)m->nx, about[] = {from + 2, from - 1, from + 1, from};
    for (int i = 0; i < MW_HISTORY; i++)
        if (about[i] < nodes) mwi_remember(&h, phi0[about[i]], x0 + about[i] * nx);
    if (phi == phi0[from] || !mwi_angle_in_range(phi) || !mwi_leap(m, &h, phi, s, x, info)) return 0;
    m->observe(s, x, o);
    return mwi_touch(m, x, o) >= 0;
}

size_t mw_from_nodes(const mw_model *m, double *s, const double *phi0, const double *x0, size_t nodes, const int *node,
                     const double *phi, size_t n, double *x, mw_info *info)
{
    const int nx = mwi_usable(m) ? m->nx : 0; /* nothing of a foreign table is believed */
    size_t succeeded = 0;
    for (size_t k = 0; k < n; k++, x += nx, info++) {
        const size_t from = node[k] < 0 ? nodes : (size_t)node[k];
        *info = mwi_ended(MW_BAD_INPUT, 0);
        if (nx > 0 && from < nodes && (between_nodes(m, s, phi0, x0, nodes, from, phi[k], x, info)
            || mw_follow(m, s, phi0[from], x0 + from * (size_t)nx, phi + k, 1, x, info) == 1))
            succeeded++;
        else
            for (int i = 0; i < nx; i++) x[i] = NAN;
    }
    return succeeded;
}

size_t mw_arclength(const mw_model *m, double *s, double phi0, const double *x0, double step, size_t count, double *phi,
                    double *x, double *slope, double *determinant)
{
    if (!mwi_usable(m) || !mwi_angle_in_range(phi0) || !(mwi_abs(step) < HUGE_VAL)) return 0;
    return mwi_arclength(m, s, phi0, x0, step, count, phi, x, slope, determinant);
}
