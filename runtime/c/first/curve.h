/* The curve on which a place of first contact lies: a ridge of the wheel angle, or a border.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FIRST_CURVE_H
#define MWI_FIRST_CURVE_H

#include "climb.h"

enum {
    CURVE_CORRECTIONS = 16,      /* Newton steps onto the curve, or to its end */
    CURVE_HALVINGS = 10,         /* of a step that does not lead on */
    CURVE_LEVEL_HALVINGS = 40,   /* to where a curve falls off */
    CURVE_ENDS = 4,              /* limits that are tried for the one that ends it */
    CURVE_OUTSIDE = 240,         /* steps at most to either side of a start, looking for the place deepest inside the limits */
    CURVE_LEAVING = 6,           /* of so many in a row, outside and ever farther out, the curve has left the flanks */
    CURVE_SECTIONS = 60          /* golden sections about the deepest place */
};

static const double CURVE_GOLDEN = 0.6180339887498949;

/* A step of Newton's method below this, in natural sizes, is the last; a limit that is exceeded by less, mm, is kept. */
static const double CURVE_DONE = 1e-13, CURVE_KEPT = 1e-10;

/* held: the limit along which the curve runs; -1 where it is a ridge, on which the wheel angle is extreme across. */
typedef struct curve { const search *h; int held; } curve;

/* A place to second order, how far it is from the curve, in natural sizes, and a unit vector across the curve; 0 where
 * there is none. */
static int curve_at(const curve *c, const place *P, model_ *q, double *off, double *across)
{
    if (!expand(c->h, P, q)) return 0;
    if (c->held >= 0) {
        const double *a = q->along[c->held], size = sqrt(a[0] * a[0] + a[1] * a[1]);
        if (!(q->limit[c->held] < HUGE_VAL) || !(size > 0.0)) return 0;
        *off = q->limit[c->held] / size;
        across[0] = a[0] / size;
        across[1] = a[1] / size;
        return 1;
    }
    /* the direction in which the angle falls off most */
    const double half = 0.5 * (q->second[0] - q->second[2]), b = q->second[1], radius = sqrt(half * half + b * b);
    const double bend = 0.5 * (q->second[0] + q->second[2]) - radius;
    const double u = half > 0.0 ? -b : half - radius, v = half > 0.0 ? half + radius : b, size = sqrt(u * u + v * v);
    if (!(bend < 0.0) || !(size > 0.0)) return 0;
    across[0] = u / size;
    across[1] = v / size;
    *off = (q->slope[0] * across[0] + q->slope[1] * across[1]) / bend;
    return 1;
}

/* From a place onto the curve or, with the number of a limit, to where the curve crosses that. */
static int curve_reach(const curve *c, int limit, place *P)
{
    double before = HUGE_VAL;
    for (int k = 0; k < CURVE_CORRECTIONS; k++) {
        model_ q;
        double off, a[2];
        place to;
        if (!curve_at(c, P, &q, &off, a)) return 0;
        double d[2] = {-off * a[0], -off * a[1]};
        if (limit >= 0) {
            const double *l = q.along[limit], det = a[0] * l[1] - a[1] * l[0];
            if (!(fabs(det) > 1e-9 * (fabs(l[0]) + fabs(l[1])))) return 0;
            d[0] = -(off * l[1] - q.limit[limit] * a[1]) / det;
            d[1] = -(a[0] * q.limit[limit] - l[0] * off) / det;
        }
        const double length = fmax(fabs(d[0]), fabs(d[1]));
        const double share = length > FARTHEST ? FARTHEST / length : 1.0;
        if (!beside(c->h, P, share * d[0], share * d[1], &to)) return 0;
        *P = to;
        if (length < CURVE_DONE || (length < 1e-9 && !(length < 0.1 * before))) return 1;
        before = length;
    }
    return 0;
}

/* The limit that a place exceeds most, but the one along which the curve runs; -1 if it keeps all. */
static int curve_exceeded(const curve *c, const place *P)
{
    int most = -1;
    for (int i = 0; i < limit_count(c->h); i++)
        if (i != c->held && P->limits[i] < (most < 0 ? -CURVE_KEPT : P->limits[most])) most = i;
    return most;
}

/* The next place on the curve, `step` natural sizes on in direction way[2], which becomes that there; 0 where the curve
 * does not lead on. */
static int curve_next(const curve *c, const place *P, double step, double *way, place *to)
{
    model_ q;
    double off, a[2];
    if (!curve_at(c, P, &q, &off, a)) return 0;
    const double side = -a[1] * way[0] + a[0] * way[1] < 0.0 ? -1.0 : 1.0;
    const double t[2] = {-side * a[1], side * a[0]};
    for (int k = 0; k < CURVE_HALVINGS; k++, step *= 0.5)
        if (beside(c->h, P, step * t[0], step * t[1], to) && curve_reach(c, -1, to)) {
            way[0] = t[0];
            way[1] = t[1];
            return 1;
        }
    return 0;
}

/* Where the curve leaves the flanks between a place on them and one that is not; the limit that ends it, -1 if none is found. */
static int curve_end(const curve *c, const place *inner, const place *outer, place *end)
{
    int limit = curve_exceeded(c, outer);
    for (int k = 0; k < CURVE_ENDS && limit >= 0; k++) {
        *end = *outer;
        if (!curve_reach(c, limit, end)) {
            *end = *inner;
            if (!curve_reach(c, limit, end)) return -1;
        }
        const int other = curve_exceeded(c, end);
        if (other < 0 || other == limit) return limit;
        limit = other;
    }
    return -1;
}

/* Where the curve falls off from its highest place, between one before and one after that. */
static void curve_level(const curve *c, double least, const place *inner, place *outer)
{
    place low = *inner;
    const int *free_ = c->h->free_[1];
    for (int k = 0; k < CURVE_LEVEL_HALVINGS; k++) {
        double d[2];
        place half;
        for (int i = 0; i < 2; i++)
            d[i] = 0.5 * (outer->q[free_[i]] - low.q[free_[i]]) / c->h->mesh->wheel_sizes[free_[i]];
        if (!beside(c->h, &low, d[0], d[1], &half) || !curve_reach(c, -1, &half)) break;
        if (half.value < least) *outer = half;
        else low = half;
    }
    *outer = low;
}

/* The places of the curve from one on it, `from`, to where a limit, or a fall of the angle by more than `fall`, ends it, at
 * most `count`, without `from` but with the end; returns how many. ended: the limit there; -1 if none. */
static size_t curve_along(const curve *c, const place *from, double step, double fall, const double *towards, size_t count,
                          place *found, int *ended)
{
    double way[2] = {towards[0], towards[1]};
    const place *last = from;
    *ended = -1;
    for (size_t k = 0; k < count; k++) {
        place *to = found + k;
        if (!curve_next(c, last, step, way, to)) return k;
        if (curve_exceeded(c, to) >= 0) {
            const place outer = *to;
            *ended = curve_end(c, last, &outer, to);
            if (*ended < 0) return k;
            if (!(to->value < from->value - fall)) return k + 1;
            *ended = -1;
        }
        if (to->value < from->value - fall) {
            curve_level(c, from->value - fall, last, to);
            return k + 1;
        }
        last = to;
    }
    return count;
}

/* How deep inside the limits a place is, but for the one along which the curve runs. */
static double curve_depth(const curve *c, const place *P)
{
    double least = HUGE_VAL;
    for (int i = 0; i < limit_count(c->h); i++)
        if (i != c->held) least = fmin(least, P->limits[i]);
    return least;
}

/* A place of the curve between two others of it. */
static int curve_between(const curve *c, const place *a, const place *b, double share, place *P)
{
    const int *free_ = c->h->free_[1];
    double d[2];
    for (int i = 0; i < 2; i++) d[i] = share * (b->q[free_[i]] - a->q[free_[i]]) / c->h->mesh->wheel_sizes[free_[i]];
    return beside(c->h, a, d[0], d[1], P) && curve_reach(c, -1, P);
}

/* The place of the curve that lies deepest inside the limits, from one on it; where that is enough, the first that lies inside. */
static void curve_deepest(const curve *c, double step, int enough, place *P)
{
    place best = *P, beside_best[2] = {*P, *P};
    double deepest = curve_depth(c, P);
    for (int side = 0; side < 2; side++) {
        double way[2] = {side ? -1.0 : 1.0, side ? -0.5 : 0.5}, before = curve_depth(c, P);
        place last = *P, next;
        int falling = 0, is_best = deepest <= before;
        for (int k = 0; k < CURVE_OUTSIDE && falling <= CURVE_LEAVING; k++) {
            if ((enough && deepest >= -CURVE_KEPT) || !curve_next(c, &last, step, way, &next)) break;
            const double depth = curve_depth(c, &next);
            if (is_best) beside_best[side] = next;
            is_best = depth > deepest;
            if (is_best) {
                deepest = depth;
                best = next;
                beside_best[1 - side] = last;
                beside_best[side] = next;
            }
            falling = depth < fmin(before, 0.0) ? falling + 1 : 0;
            before = depth;
            last = next;
        }
    }
    *P = best;
    if (enough && deepest >= -CURVE_KEPT) return;
    double low = 0.0, high = 1.0;
    place at[2];
    double depth[2];
    for (int k = 0; k < 2; k++) {
        const double share = k ? CURVE_GOLDEN : 1.0 - CURVE_GOLDEN;
        if (!curve_between(c, &beside_best[0], &beside_best[1], share, &at[k])) return;
        depth[k] = curve_depth(c, &at[k]);
    }
    for (int k = 0; k < CURVE_SECTIONS && high - low > CURVE_DONE; k++) {
        const int upper = depth[1] > depth[0];
        if (upper) low = high - CURVE_GOLDEN * (high - low);
        else high = low + CURVE_GOLDEN * (high - low);
        at[1 - upper] = at[upper];
        depth[1 - upper] = depth[upper];
        const double share = upper ? low + CURVE_GOLDEN * (high - low) : high - CURVE_GOLDEN * (high - low);
        if (!curve_between(c, &beside_best[0], &beside_best[1], share, &at[upper])) return;
        depth[upper] = curve_depth(c, &at[upper]);
        for (int i = 0; i < 2; i++)
            if (depth[i] > deepest) {
                deepest = depth[i];
                *P = at[i];
            }
        if (enough && deepest >= -CURVE_KEPT) return;
    }
}

/* How far the flanks stand apart, mm, a step of so many natural sizes beside a place, on whichever of the curves through it
 * that is least: the ridge, or a border that holds it; to second order. */
static double apart_beside(const search *h, const place *P, const int *active, double step)
{
    model_ q;
    double least = HUGE_VAL;
    if (!expand(h, P, &q)) return 0.0;
    for (int k = -1; k < 2; k++) {
        double across[2], second[3] = {q.second[0], q.second[1], q.second[2]};
        if (k < 0) {
            const double half = 0.5 * (q.second[0] - q.second[2]), radius = sqrt(half * half + q.second[1] * q.second[1]);
            const double u = half > 0.0 ? -q.second[1] : half - radius, v = half > 0.0 ? half + radius : q.second[1];
            across[0] = u, across[1] = v;
        } else {
            if (active[k] < 0 || active[k] >= MAX_LIMITS) continue;
            across[0] = q.along[active[k]][0], across[1] = q.along[active[k]][1];
        }
        const double size = sqrt(across[0] * across[0] + across[1] * across[1]), t[2] = {-across[1] / size, across[0] / size};
        if (!(size > 0.0)) return 0.0;
        if (k >= 0) { /* the border bends away from its tangent */
            const double push = (q.slope[0] * across[0] + q.slope[1] * across[1]) / (size * size);
            for (int i = 0; i < 3; i++) second[i] -= push * q.curve[active[k]][i];
        }
        const double slope = q.slope[0] * t[0] + q.slope[1] * t[1];
        const double bend = second[0] * t[0] * t[0] + 2.0 * second[1] * t[0] * t[1] + second[2] * t[1] * t[1];
        least = fmin(least, fabs(slope) * step + 0.5 * fabs(bend) * step * step);
    }
    return least * fabs(P->lever);
}

#endif
