/* From a place where two bounded flanks meet to the extreme of the wheel angle within their limits.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FIRST_CLIMB_H
#define MWI_FIRST_CLIMB_H

#include "expand.h"

enum {
    CLIMB_STEPS = 80,
    RESTORATIONS = 3
};

/* A place so near to a limit, mm or natural sizes, lies on it. */
static const double ON_LIMIT = 1e-7;
/* A ridge bends less along it than across it by this share. */
static const double RIDGE = 0.1;
/* How far a climb goes at first, natural sizes; a rise by less over such a way, rad, is lost in rounding. */
static const double FIRST_RADIUS = 0.1, LEVEL = 1e-16;

/* The step with the largest quadratic model among those that keep every linearised limit, by looking at all sets of no,
 * one and two active ones; radius bounds it. active: numbers of the limits that hold it, -1 for none. */
typedef struct candidate { double d[2], gain, multiplier[2]; int active[2]; } candidate;

typedef struct lines { int n; double value[MAX_LIMITS + 4], a[MAX_LIMITS + 4][2]; int number[MAX_LIMITS + 4]; } lines;

static void consider(const lines *L, const double *g, const double *H, const double *d, int i, int j, candidate *best)
{
    for (int k = 0; k < L->n; k++)
        if (k != i && k != j) {
            const double scale = fabs(L->a[k][0]) + fabs(L->a[k][1]);
            if (L->value[k] + L->a[k][0] * d[0] + L->a[k][1] * d[1] < -1e-12 * scale) return;
        }
    const double gain = g[0] * d[0] + g[1] * d[1] + 0.5 * (H[0] * d[0] * d[0] + H[2] * d[1] * d[1]) + H[1] * d[0] * d[1];
    if (!(gain > best->gain)) return;
    best->gain = gain;
    best->d[0] = d[0];
    best->d[1] = d[1];
    best->active[0] = i >= 0 ? L->number[i] : -1;
    best->active[1] = j >= 0 ? L->number[j] : -1;
    /* slope of the model there = - sum of multipliers times slopes of active limits */
    const double r[2] = {g[0] + H[0] * d[0] + H[1] * d[1], g[1] + H[1] * d[0] + H[2] * d[1]};
    best->multiplier[0] = best->multiplier[1] = 0.0;
    if (i >= 0 && j >= 0) {
        const double det = L->a[i][0] * L->a[j][1] - L->a[i][1] * L->a[j][0];
        best->multiplier[0] = -(r[0] * L->a[j][1] - r[1] * L->a[j][0]) / det;
        best->multiplier[1] = -(L->a[i][0] * r[1] - L->a[i][1] * r[0]) / det;
    } else if (i >= 0) {
        const double size = L->a[i][0] * L->a[i][0] + L->a[i][1] * L->a[i][1];
        best->multiplier[0] = -(r[0] * L->a[i][0] + r[1] * L->a[i][1]) / size;
    }
}

static int best_step(const search *h, const model_ *q, const double *H, double radius, candidate *best)
{
    lines L;
    const double *g = q->slope;
    L.n = 0;
    for (int i = 0; i < limit_count(h); i++) {
        const double size = fabs(q->along[i][0]) + fabs(q->along[i][1]);
        if (!(q->limit[i] < HUGE_VAL) || !(size > 0.0) || q->limit[i] > 2.0 * radius * size) continue;
        L.value[L.n] = q->limit[i];
        L.a[L.n][0] = q->along[i][0];
        L.a[L.n][1] = q->along[i][1];
        L.number[L.n++] = i;
    }
    for (int k = 0; k < 4; k++) {
        L.value[L.n] = radius;
        L.a[L.n][0] = k == 0 ? 1.0 : k == 1 ? -1.0 : 0.0;
        L.a[L.n][1] = k == 2 ? 1.0 : k == 3 ? -1.0 : 0.0;
        L.number[L.n++] = MAX_LIMITS;
    }
    best->gain = -HUGE_VAL;
    const double det = H[0] * H[2] - H[1] * H[1];
    if (H[0] < 0.0 && det > 0.0) {
        const double d[2] = {-(g[0] * H[2] - g[1] * H[1]) / det, -(H[0] * g[1] - H[1] * g[0]) / det};
        consider(&L, g, H, d, -1, -1, best);
    }
    for (int i = 0; i < L.n; i++) {
        const double *a = L.a[i], size = a[0] * a[0] + a[1] * a[1];
        const double at[2] = {-L.value[i] * a[0] / size, -L.value[i] * a[1] / size}, t[2] = {-a[1], a[0]};
        const double bend = H[0] * t[0] * t[0] + 2.0 * H[1] * t[0] * t[1] + H[2] * t[1] * t[1];
        if (bend < 0.0) {
            const double rise = t[0] * (g[0] + H[0] * at[0] + H[1] * at[1]) + t[1] * (g[1] + H[1] * at[0] + H[2] * at[1]);
            const double d[2] = {at[0] - rise / bend * t[0], at[1] - rise / bend * t[1]};
            consider(&L, g, H, d, i, -1, best);
        }
        for (int j = 0; j < i; j++) {
            const double across = a[0] * L.a[j][1] - a[1] * L.a[j][0];
            if (!(fabs(across) > 1e-12 * sqrt(size))) continue;
            const double d[2] = {(-L.value[i] * L.a[j][1] + L.value[j] * a[1]) / across,
                                 (-a[0] * L.value[j] + L.a[j][0] * L.value[i]) / across};
            consider(&L, g, H, d, i, j, best);
        }
    }
    return best->gain > -HUGE_VAL;
}

/* How far outside its limits a place is, mm. */
static double violation(const search *h, const place *P)
{
    return fmax(0.0, -worst(h, P));
}

/* A place brought back onto the limits that hold it, which bend away from their tangents: the second-order correction
 * without which steps along a curved limit shrink to nothing (Maratos, "Exact penalty function algorithms for finite
 * dimensional and control optimization problems", thesis, Imperial College, 1978). */
static void restore(const search *h, const model_ *q, const int *active, place *P)
{
    int held[2], n = 0;
    for (int a = 0; a < 2; a++)
        if (active[a] >= 0 && active[a] < MAX_LIMITS) held[n++] = active[a];
    for (int k = 0; k < RESTORATIONS && n > 0; k++) {
        const double *a = q->along[held[0]], *b = q->along[held[n - 1]];
        const double c[2] = {P->limits[held[0]], P->limits[held[n - 1]]};
        const double det = a[0] * b[1] - a[1] * b[0], size = a[0] * a[0] + a[1] * a[1];
        double d[2] = {-c[0] * a[0] / size, -c[0] * a[1] / size};
        if (n == 2) {
            d[0] = -(c[0] * b[1] - a[1] * c[1]) / det;
            d[1] = -(a[0] * c[1] - b[0] * c[0]) / det;
        }
        place to;
        if (!(fabs(d[0]) + fabs(d[1]) < 0.1) || !beside(h, P, d[0], d[1], &to)) return;
        double before = 0.0, after = 0.0;
        for (int i = 0; i < n; i++) {
            before = fmax(before, fabs(P->limits[held[i]]));
            after = fmax(after, fabs(to.limits[held[i]]));
        }
        if (!(after < before)) return;
        *P = to;
    }
}

/* Whether nothing around a place is higher, as on the ridge along which the flanks of a line contact touch: what holds the
 * best step is its length alone, and a long one gains nothing. */
static int level(const search *h, const model_ *q, const double *H, double radius, const candidate *step)
{
    candidate longer;
    if (!(step->gain < LEVEL) || (step->active[0] != MAX_LIMITS && step->active[1] != MAX_LIMITS)) return 0;
    return best_step(h, q, H, fmax(radius, FIRST_RADIUS), &longer) && longer.gain < LEVEL;
}

static int held_by_limit(const int *active)
{
    return (active[0] >= 0 && active[0] < MAX_LIMITS) || (active[1] >= 0 && active[1] < MAX_LIMITS);
}

/* A step along a ridge, as flanks have that touch nearly along a line, leaves it where it bends: back across it to where
 * the slope across is gone. Without this a climb goes along a bent ridge in steps that only its width allows. */
static void onto_ridge(const search *h, const double *H, place *to)
{
    const double middle = 0.5 * (H[0] + H[2]), apart = sqrt(0.25 * (H[0] - H[2]) * (H[0] - H[2]) + H[1] * H[1]);
    const double across = middle - apart, along_it = middle + apart;
    if (!h->given || !(fabs(along_it) < RIDGE * -across)) return;
    double e[2] = {H[1], across - H[0]};
    if (fabs(across - H[2]) > fabs(e[1])) e[0] = across - H[2], e[1] = H[1];
    const double size = sqrt(e[0] * e[0] + e[1] * e[1]);
    double slope = (to->slope[0] * e[0] + to->slope[1] * e[1]) / size;
    for (int k = 0; k < RESTORATIONS; k++) {
        place back;
        const double c = -slope / (across * size);
        if (!beside(h, to, c * e[0], c * e[1], &back)) return;
        const double left = (back.slope[0] * e[0] + back.slope[1] * e[1]) / size;
        if (!(fabs(left) < fabs(slope))) return;
        *to = back;
        slope = left;
    }
}

/* Climb from a place to the local extreme of the bounded flanks; active receives the limits that hold it. */
static int climb(const search *h, place *P, int *active)
{
    double radius = FIRST_RADIUS, weight = 0.0, before = HUGE_VAL, multiplier[2] = {0.0, 0.0};
    int held[2] = {-1, -1};
    for (int k = 0; k < CLIMB_STEPS; k++) {
        model_ q;
        candidate step;
        place to;
        if (!expand(h, P, &q)) return 0;
        double H[3] = {q.second[0], q.second[1], q.second[2]};
        for (int a = 0; a < 2; a++)
            if (held[a] >= 0 && held[a] < MAX_LIMITS && multiplier[a] > 0.0)
                for (int i = 0; i < 3; i++) H[i] += multiplier[a] * q.curve[held[a]][i];
        if (!best_step(h, &q, H, radius, &step)) {
            if (radius > 1.0) return 0;
            radius *= 2.0;
            continue;
        }
        if (level(h, &q, H, radius, &step)) {
            onto_ridge(h, H, P);
            active[0] = active[1] = -1;
            return violation(h, P) < 1e-8;
        }
        const double length = fmax(fabs(step.d[0]), fabs(step.d[1]));
        for (int a = 0; a < 2; a++)
            if (step.active[a] >= 0 && step.active[a] < MAX_LIMITS) weight = fmax(weight, 2.0 * fabs(step.multiplier[a]));
        const int moved = beside(h, P, step.d[0], step.d[1], &to);
        /* steps that gain nothing and get no shorter are rounding: the place is determined no better */
        const int lost = step.gain < LEVEL && length > 0.5 * before;
        before = step.gain < LEVEL ? length : HUGE_VAL;
        if (length < 1e-11 || (length < 1e-9 && k > 40) || (lost && !held_by_limit(step.active))) {
            if (moved) *P = to;
            if (lost && !held_by_limit(step.active)) onto_ridge(h, H, P);
            active[0] = step.active[0];
            active[1] = step.active[1];
            return violation(h, P) < 1e-8;
        }
        if (moved && !held_by_limit(step.active)) onto_ridge(h, H, &to);
        if (moved) restore(h, &q, step.active, &to);
        const double now = P->value - weight * violation(h, P);
        if (!moved || !(to.value - weight * violation(h, &to) > now - 1e-15) ) {
            if (length > 1e-6) {
                radius = 0.25 * fmin(radius, length);
                continue;
            }
            if (!moved) return 0;
        }
        if (length > 0.9 * radius) radius *= 2.0;
        *P = to;
        for (int a = 0; a < 2; a++) {
            held[a] = step.active[a];
            multiplier[a] = step.multiplier[a];
        }
    }
    return 0;
}

/* The best place so far, with the limits that hold it; floor: the highest place inside all limits that was looked at,
 * lever: its; highest: what a part that could not be looked at might hold; least: what need not be found; budget: places that
 * may still be looked at. */
typedef struct best_ {
    place at;
    int active[2], found;
    double floor, lever, highest, least;
    long budget;
} best_;

/* The search with points of the pinion given: where the pinion's flank ends at its singular line the wheel's points do not
 * determine the pinion's smoothly, but the pinion's do the wheel's. Each of its conditions gives the parameter that moves it most. */
static search by_the_pinion(const search *h, const place *at)
{
    const mw_body *pinion = &h->m->bodies[0];
    search by = *h;
    double o[MAX_OUTPUTS];
    int given[MAX_K] = {0}, free_[MAX_K], left = 0;
    pinion->flank(h->s, at->p, o);
    for (int c = 0; c < pinion->conditions; c++) {
        const double *slopes = condition_of(pinion, o, c) + 1;
        int most = -1;
        for (int i = 0; i < h->nk; i++)
            if (!given[i] && (most < 0 || fabs(slopes[i]) * h->mesh->pinion_sizes[i]
                                              > fabs(slopes[most]) * h->mesh->pinion_sizes[most])) most = i;
        given[most] = 1;
    }
    for (int i = 0; i < h->nk; i++)
        if (!given[i]) free_[left++] = i;
    by.given = 0;
    span(&by, 0, free_[0], free_[1]);
    return by;
}

/* Refine from a place inside all limits and keep what is higher than the best. */
static void refine(const search *h, const place *from, best_ *best)
{
    place P = *from;
    int active[2];
    int done = climb(h, &P, active);
    if (!done) {
        const search by_pinion = by_the_pinion(h, from);
        P = *from;
        done = climb(&by_pinion, &P, active);
    }
    const place *top = done && P.value > from->value ? &P : from;
    if (top->value > best->floor) {
        best->floor = top->value;
        best->lever = fabs(top->lever);
    }
    if (!done || (best->found && !(P.value > best->at.value))) return;
    best->at = P;
    best->active[0] = active[0];
    best->active[1] = active[1];
    best->found = 1;
}

/* Limits on which the best place lies without leaning against them, as at the cusp in which a flank ends: they end it. */
static void name_limits(const search *h, best_ *best)
{
    for (int a = 0; a < 2; a++) {
        if (best->active[a] >= 0 && best->active[a] < MAX_LIMITS) continue;
        for (int i = 0; i < limit_count(h); i++)
            if (best->at.limits[i] < ON_LIMIT && i != best->active[1 - a]) {
                best->active[a] = i;
                break;
            }
    }
}

#endif
