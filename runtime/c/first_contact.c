/* Where two bounded flanks of a tooth pair touch first.  SPDX-License-Identifier: MIT-0
 *
 * A point of the wheel's flank, turned about the wheel's axis, meets the pinion's flank at one wheel angle. Bodies touch
 * first where that angle is extreme over all points of the wheel's flank that meet the pinion's flank inside its limits:
 * in the interior (a tangency), on a limit of either flank (an edge), or where two limits meet (a corner). */
#include "exact.h"
#include <math.h>
#include <string.h>
#include "circular.h"
#include "kernels.h"
#include "meshwright.h"
#include "solver/basics.h"

enum {
    MAX_K = 3,                   /* parameters of a flank */
    MAX_OUTPUTS = 48,            /* of a flank: 7 + 4 parameters and conditions, margins */
    MAX_LIMITS = 18,             /* of both flanks, and four of a trust region */
    MAX_SECOND = (3 + MAX_LIMITS + 1) * MAX_K * (MAX_K + 1) / 2,
    NEWTON_STEPS = 14,
    CLIMB_STEPS = 80,
    CLIMB_COST = 100,            /* places that a climb counts as, about those of a dozen steps */
    RESTORATIONS = 3,
    STARTS = 12,                 /* local extremes of the mesh that are refined */
    FINEST_WALK = 64,            /* steps at most from a place to one that is further away */
    DEEPEST = 46,                /* how often a triangle is halved, and how often where a part of it never meets */
    DEEPEST_EDGE = 20,
    BUDGET = 20000               /* places that are looked at between the vertices */
};

/* Newton's method ends with a step below this, in natural sizes. */
static const double STEP_DONE = 1e-10;
/* Newton's method that moves more than so many times its first step and this, or than that, in natural sizes, or turns
 * the wheel by more, rad, may have left its sheet or come to the next tooth. */
static const double JUMP = 3.0, JUMP_LEAST = 0.02, FARTHEST = 0.5, LARGEST_TURN = 0.1;
/* A place so near to a limit, mm or natural sizes, lies on it. */
static const double ON_LIMIT = 1e-7;
/* No extreme that stands out by more is missed, mm along the normal. */
static const double RESOLUTION = 1e-4;

typedef struct search {
    const mw_model *m;
    const double *s;
    const mw_flank_mesh *mesh;
    double A[9], b[3];           /* from the wheel's frame, turned, to the pinion's */
    double turn, sense;
    int nk, nw;                  /* parameters of pinion and wheel */
    int given;                   /* whose point is given, 0 pinion, 1 wheel: it is looked for on the other's flank */
    int bound[2], free_[2][2];   /* parameters of each flank: that its condition gives, or -1; the others */
} search;

/* One point of the wheel's flank and where it meets the pinion's. value: sense times the wheel angle. */
typedef struct place {
    double q[MAX_K], p[MAX_K];   /* parameters of wheel and pinion */
    double delta, value, slope[2], lever, inner;
    double limits[MAX_LIMITS];   /* of the wheel's flank, then of the pinion's */
    double point[3], normal[3];  /* pinion's frame */
    int good;
} place;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Solve n equations in place by elimination with row exchange; 0 where they are singular. */
static int solve(double *M, double *r, int n)
{
    for (int k = 0; k < n; k++) {
        int p = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(M[i * n + k]) > fabs(M[p * n + k])) p = i;
        if (!(fabs(M[p * n + k]) > 0.0)) return 0;
        for (int j = 0; j < n && p != k; j++) {
            const double t = M[k * n + j];
            M[k * n + j] = M[p * n + j];
            M[p * n + j] = t;
        }
        const double t = r[k];
        r[k] = r[p];
        r[p] = t;
        for (int i = k + 1; i < n; i++) {
            const double f = M[i * n + k] / M[k * n + k];
            for (int j = k; j < n; j++) M[i * n + j] -= f * M[k * n + j];
            r[i] -= f * r[k];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) r[i] -= M[i * n + j] * r[j];
        r[i] /= M[i * n + i];
        if (!(fabs(r[i]) < HUGE_VAL)) return 0;
    }
    return 1;
}

static int conditions_at(const mw_body *b)
{
    return 7 + 3 * b->parameters + b->margins;
}

static const double *sizes_of(const search *h, int member)
{
    return member ? h->mesh->wheel_sizes : h->mesh->pinion_sizes;
}

/* The parameters that are left without the one that a condition gives. */
static void others(int parameters, int bound, int *free_)
{
    for (int i = 0, k = 0; i < parameters; i++)
        if (i != bound && k < 2) free_[k++] = i;
}

/* A flank at two of its parameters: q completed from its condition, outputs o. */
static int on_flank(const search *h, int member, double *q, double *o)
{
    const mw_body *body = &h->m->bodies[member];
    const double *condition = o + conditions_at(body);
    const int bound = h->bound[member];
    for (int k = 0; k < NEWTON_STEPS; k++) {
        body->flank(h->s, q, o);
        if (bound < 0) break;
        const double step = condition[0] / condition[1 + bound];
        if (!(fabs(step) < HUGE_VAL)) return 0;
        q[bound] -= step;
        if (fabs(step) < STEP_DONE * sizes_of(h, member)[bound]) {
            body->flank(h->s, q, o);
            break;
        }
    }
    return 1;
}

/* A vector of the wheel's frame, turned by delta, in the pinion's frame; its derivative by delta if rate is given. */
static void carried(const search *h, const double *r, double delta, double *x, double *rate)
{
    const double angle = h->turn * delta;
    double c = NAN, s = NAN;
    if (fabs(angle) < MWI_CIRCULAR_FAR) mwi_sine(angle, &s, &c);
    const double turned[3] = {c * r[0] - s * r[1], s * r[0] + c * r[1], r[2]};
    const double moved[3] = {-h->turn * turned[1], h->turn * turned[0], 0.0};
    for (int i = 0; i < 3; i++) {
        x[i] = dot(h->A + 3 * i, turned);
        if (rate) rate[i] = dot(h->A + 3 * i, moved);
    }
}

/* Slopes of the wheel angle by the wheel's free parameters, in natural sizes, at a place with these outputs. */
static void slopes_at(const search *h, const double *ow, const double *op, place *P)
{
    const double *condition = ow + conditions_at(&h->m->bodies[1]) + 1;
    for (int a = 0; a < 2; a++) {
        const int number = h->free_[1][a], bound = h->bound[1];
        double tangent[3], along[3];
        for (int i = 0; i < 3; i++) {
            tangent[i] = ow[6 + 3 * number + i];
            if (bound >= 0) tangent[i] -= condition[number] / condition[bound] * ow[6 + 3 * bound + i];
        }
        carried(h, tangent, P->delta, along, NULL);
        P->slope[a] = -h->sense * dot(op + 3, along) / P->lever * h->mesh->wheel_sizes[number];
    }
}

/* Where the given member's point, at P->q or P->p, meets the other one's flank, from the other parameters and P->delta on;
 * 0 where that does not lead to a place on the same sheet. */
static int meet(const search *h, place *P)
{
    const mw_body *pinion = &h->m->bodies[0], *wheel = &h->m->bodies[1];
    double ow[MAX_OUTPUTS], op[MAX_OUTPUTS], x[3], rate[3], M[16], r[4];
    const int sought = !h->given, parameters = sought ? h->nw : h->nk, n = parameters + 1;
    double *unknown = sought ? P->q : P->p, *known = sought ? P->p : P->q;
    const double *size = sizes_of(h, sought);
    P->good = 0;
    P->inner = -HUGE_VAL;
    if (!on_flank(h, h->given, known, h->given ? ow : op)) return 0;
    double before = HUGE_VAL, first = 0.0, moved = 0.0, from[MAX_K];
    int done = 0;
    memcpy(from, unknown, sizeof from);
    const double delta = P->delta;
    for (int k = 0; k < NEWTON_STEPS && !done; k++) {
        const mw_body *body = &h->m->bodies[sought];
        double *o = sought ? ow : op;
        body->flank(h->s, unknown, o);
        carried(h, ow, P->delta, x, rate);
        for (int j = 0; j < parameters; j++) {
            double tangent[3];
            if (sought) carried(h, o + 6 + 3 * j, P->delta, tangent, NULL);
            for (int i = 0; i < 3; i++) M[i * n + j] = sought ? -tangent[i] : o[6 + 3 * j + i];
        }
        for (int i = 0; i < 3; i++) {
            M[i * n + parameters] = -rate[i];
            r[i] = op[i] - x[i] - h->b[i];
        }
        if (body->conditions) {
            const double *condition = o + conditions_at(body);
            for (int j = 0; j < parameters; j++) M[3 * n + j] = condition[1 + j];
            M[3 * n + parameters] = 0.0;
            r[3] = condition[0];
        }
        if (!solve(M, r, n)) return 0;
        double largest = fabs(r[parameters]);
        for (int j = 0; j < parameters; j++) largest = fmax(largest, fabs(r[j]) / size[j]);
        if (k > 2 && largest > before) return 0;
        if (k == 0) first = fmin(largest, 0.5);
        const double share = largest > 0.5 ? 0.5 / largest : 1.0;
        for (int j = 0; j < parameters; j++) unknown[j] -= share * r[j];
        P->delta -= share * r[parameters];
        done = largest < STEP_DONE || (largest < 1e-8 && largest > 0.5 * before);
        before = largest;
    }
    if (!done || fabs(P->delta - delta) > LARGEST_TURN) return 0;
    moved = fabs(P->delta - delta);
    for (int j = 0; j < parameters; j++) moved = fmax(moved, fabs(unknown[j] - from[j]) / size[j]);
    if (moved > fmin(FARTHEST, JUMP * first + JUMP_LEAST)) return 0;
    h->m->bodies[sought].flank(h->s, unknown, sought ? ow : op);
    carried(h, ow, P->delta, x, rate);
    P->lever = dot(op + 3, rate);
    if (!(P->lever * h->sense > 0.0)) return 0;
    slopes_at(h, ow, op, P);
    P->value = h->sense * P->delta;
    memcpy(P->point, op, sizeof P->point);
    memcpy(P->normal, op + 3, sizeof P->normal);
    double inner = HUGE_VAL;
    for (int i = 0; i <= wheel->margins; i++) {
        const double v = ow[6 + 3 * h->nw + i];
        P->limits[i] = v == v ? v : HUGE_VAL;
    }
    for (int i = 0; i <= pinion->margins; i++) {
        const double v = op[6 + 3 * h->nk + i];
        P->limits[wheel->margins + 1 + i] = v == v ? v : HUGE_VAL;
        inner = fmin(inner, P->limits[wheel->margins + 1 + i]);
    }
    P->inner = inner;
    return P->good = fabs(P->value) < HUGE_VAL;
}

static int limit_count(const search *h)
{
    return h->m->bodies[0].margins + h->m->bodies[1].margins + 2;
}

static double worst(const search *h, const place *P)
{
    double least = HUGE_VAL;
    for (int i = 0; i < limit_count(h); i++) least = fmin(least, P->limits[i]);
    return least;
}

/* A place beside another one, by (u, v) in natural sizes of the given member's free parameters. */
static int beside(const search *h, const place *from, double u, double v, place *P)
{
    const int *free_ = h->free_[h->given];
    const double *sizes = sizes_of(h, h->given);
    *P = *from;
    double *known = h->given ? P->q : P->p;
    known[free_[0]] += u * sizes[free_[0]];
    known[free_[1]] += v * sizes[free_[1]];
    return meet(h, P);
}

/* Value, slopes and second derivatives of the wheel angle and of every limit at a place, in natural sizes. */
typedef struct model_ {
    double slope[2], second[3];
    double limit[MAX_LIMITS], along[MAX_LIMITS][2], curve[MAX_LIMITS][3];
} model_;

/* A flank at a place to second order. */
typedef struct bent {
    int k, limits, pairs;
    double o[MAX_OUTPUTS], slopes[MAX_LIMITS * MAX_K], second[MAX_SECOND];
} bent;

static void to_second_order(const search *h, int member, const double *q, bent *f)
{
    const mw_body *body = &h->m->bodies[member];
    const mw_expansion *expansion = &h->m->kernels->bounded->expansions[member];
    f->k = body->parameters;
    f->limits = 1 + body->margins;
    f->pairs = f->k * (f->k + 1) / 2;
    body->flank(h->s, q, f->o);
    expansion->slopes(h->s, q, f->slopes);
    expansion->second(h->s, q, f->second);
}

/* Second derivative of number i of (point, limits, condition) along directions a and b of the parameters. */
static double bent_by(const bent *f, int i, const double *a, const double *b)
{
    const double *pair = f->second + i * f->pairs;
    double sum = 0.0;
    for (int j = 0; j < f->k; j++)
        for (int l = j; l < f->k; l++) sum += *pair++ * (j == l ? a[j] * b[j] : a[j] * b[l] + a[l] * b[j]);
    return sum;
}

static double along(int k, const double *slopes, const double *a)
{
    double sum = 0.0;
    for (int j = 0; j < k; j++) sum += slopes[j] * a[j];
    return sum;
}

/* Implicit differentiation of a place by the given member's free parameters. The equations, that both points are one and
 * that each flank keeps its condition, have the parameters of both and the angle as unknowns z. */
static int expand(const search *h, const place *P, model_ *q)
{
    enum { MOST = 2 * MAX_K + 1 };
    static const int A[3] = {0, 0, 1}, B[3] = {0, 1, 1};
    const mw_body *pinion = &h->m->bodies[0], *wheel = &h->m->bodies[1];
    const int of_pinion = h->nw, of_angle = h->nw + h->nk, n = 3 + wheel->conditions + pinion->conditions;
    bent p, w;
    double J[(2 * MAX_K - 1) * MOST] = {0.0}, z[2][MOST], zz[3][MOST], rate[3], x[3], turned[2][3], inwards[3];
    int follows[MOST];
    to_second_order(h, 0, P->p, &p);
    to_second_order(h, 1, P->q, &w);
    carried(h, w.o, P->delta, x, rate);
    for (int j = 0; j < h->nw; j++) {
        double tangent[3];
        carried(h, w.o + 6 + 3 * j, P->delta, tangent, NULL);
        for (int i = 0; i < 3; i++) J[i * MOST + j] = -tangent[i];
        if (wheel->conditions) J[3 * MOST + j] = w.o[conditions_at(wheel) + 1 + j];
    }
    for (int j = 0; j < h->nk; j++) {
        for (int i = 0; i < 3; i++) J[i * MOST + of_pinion + j] = p.o[6 + 3 * j + i];
        if (pinion->conditions) J[(n - 1) * MOST + of_pinion + j] = p.o[conditions_at(pinion) + 1 + j];
    }
    for (int i = 0; i < 3; i++) J[i * MOST + of_angle] = -rate[i];
    const int *free_ = h->free_[h->given], first = h->given ? 0 : of_pinion;
    for (int j = 0, k = 0; j <= of_angle; j++)
        if (j != first + free_[0] && j != first + free_[1]) follows[k++] = j;
    double M[(2 * MAX_K - 1) * (2 * MAX_K - 1)], r[2 * MAX_K - 1];
    for (int a = 0; a < 2; a++) {
        const double size = sizes_of(h, h->given)[free_[a]];
        for (int i = 0; i < n; i++) {
            for (int j = 0; j < n; j++) M[i * n + j] = J[i * MOST + follows[j]];
            r[i] = -J[i * MOST + first + free_[a]] * size;
        }
        if (!solve(M, r, n)) return 0;
        for (int j = 0; j < 2; j++) z[a][first + free_[j]] = j == a ? size : 0.0;
        for (int j = 0; j < n; j++) z[a][follows[j]] = r[j];
        double along_wheel[3] = {0.0};
        for (int j = 0; j < h->nw; j++)
            for (int i = 0; i < 3; i++) along_wheel[i] += w.o[6 + 3 * j + i] * z[a][j];
        carried(h, along_wheel, P->delta, x, turned[a]);
    }
    const double flat[3] = {-w.o[0], -w.o[1], 0.0}; /* second derivative by the angle of a point turning about z */
    carried(h, flat, P->delta, inwards, NULL);
    for (int c = 0; c < 3; c++) {
        const double *za = z[A[c]], *zb = z[B[c]];
        double bends[3];
        for (int i = 0; i < 3; i++) bends[i] = bent_by(&w, i, za, zb);
        carried(h, bends, P->delta, x, NULL);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) M[i * n + j] = J[i * MOST + follows[j]];
        for (int i = 0; i < 3; i++)
            r[i] = x[i] + turned[A[c]][i] * zb[of_angle] + turned[B[c]][i] * za[of_angle]
                   + inwards[i] * za[of_angle] * zb[of_angle] - bent_by(&p, i, za + of_pinion, zb + of_pinion);
        if (wheel->conditions) r[3] = -bent_by(&w, 3 + w.limits, za, zb);
        if (pinion->conditions) r[n - 1] = -bent_by(&p, 3 + p.limits, za + of_pinion, zb + of_pinion);
        if (!solve(M, r, n)) return 0;
        for (int j = 0; j < 2; j++) zz[c][first + free_[j]] = 0.0;
        for (int j = 0; j < n; j++) zz[c][follows[j]] = r[j];
        q->second[c] = h->sense * zz[c][of_angle];
    }
    for (int a = 0; a < 2; a++) q->slope[a] = h->sense * z[a][of_angle];
    for (int i = 0; i < limit_count(h); i++) {
        const int of_wheel = i < w.limits, number = of_wheel ? i : i - w.limits, at = of_wheel ? 0 : of_pinion;
        const bent *f = of_wheel ? &w : &p;
        const double *slopes = f->slopes + number * f->k;
        q->limit[i] = P->limits[i];
        memset(q->along[i], 0, sizeof q->along[i]);
        memset(q->curve[i], 0, sizeof q->curve[i]);
        if (!(P->limits[i] < HUGE_VAL)) continue;
        for (int a = 0; a < 2; a++) q->along[i][a] = along(f->k, slopes, z[a] + at);
        for (int c = 0; c < 3; c++)
            q->curve[i][c] = bent_by(f, 3 + number, z[A[c]] + at, z[B[c]] + at) + along(f->k, slopes, zz[c] + at);
    }
    return 1;
}

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

/* Climb from a place to the local extreme of the bounded flanks; active receives the limits that hold it. */
static int climb(const search *h, place *P, int *active)
{
    double radius = 0.1, weight = 0.0, multiplier[2] = {0.0, 0.0};
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
        const double length = fmax(fabs(step.d[0]), fabs(step.d[1]));
        for (int a = 0; a < 2; a++)
            if (step.active[a] >= 0 && step.active[a] < MAX_LIMITS) weight = fmax(weight, 2.0 * fabs(step.multiplier[a]));
        const int moved = beside(h, P, step.d[0], step.d[1], &to);
        if (length < 1e-11 || (length < 1e-9 && k > 40)) {
            if (moved) *P = to;
            active[0] = step.active[0];
            active[1] = step.active[1];
            return violation(h, P) < 1e-8;
        }
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
 * lever: its; highest: what a part that could not be looked at might hold; budget: places that may still be looked at. */
typedef struct best_ {
    place at;
    int active[2], found;
    double floor, lever, highest;
    long budget;
} best_;

/* The search with points of the pinion given: where the pinion's flank ends at its singular line the wheel's points do not
 * determine the pinion's smoothly, but the pinion's do the wheel's. Its condition gives the parameter that moves it most. */
static search by_the_pinion(const search *h, const place *at)
{
    const mw_body *pinion = &h->m->bodies[0];
    search by = *h;
    by.given = 0;
    by.bound[0] = -1;
    if (pinion->conditions) {
        double o[MAX_OUTPUTS], most = -1.0;
        pinion->flank(h->s, at->p, o);
        for (int i = 0; i < h->nk; i++) {
            const double slope = fabs(o[conditions_at(pinion) + 1 + i]) * h->mesh->pinion_sizes[i];
            if (slope > most) {
                most = slope;
                by.bound[0] = i;
            }
        }
    }
    others(h->nk, by.bound[0], by.free_[0]);
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

/* An upper bound of the wheel angle over the part of a triangle in which the pinion's limits hold, from the linear models
 * at its corners and the growth of slopes between them; -HUGE_VAL where no part does. edge: the one that bends most. */
static double bound(const search *h, const place *T, int *edge)
{
    double C[3][2], growth = 0.0, bend = 0.0, span = 0.0;
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 2; i++) C[a][i] = T[a].q[h->free_[1][i]] / h->mesh->wheel_sizes[h->free_[1][i]];
    *edge = 0;
    double most = -1.0;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const double d[2] = {C[b][0] - C[a][0], C[b][1] - C[a][1]};
        const double c = (T[b].slope[0] - T[a].slope[0]) * d[0] + (T[b].slope[1] - T[a].slope[1]) * d[1];
        growth = fmax(growth, c);
        bend = fmax(bend, fabs(c));
        span = fmax(span, fabs(T[b].inner - T[a].inner));
        const double size = fabs(c) + 1e-3 * fabs(T[b].value - T[a].value);
        if (size > most) {
            most = size;
            *edge = a;
        }
    }
    /* the polygon left of the triangle by the pinion's limits, a little more than linear interpolation gives */
    double polygon[4][2];
    int n = 0;
    const double slack = span < HUGE_VAL ? 0.05 * span : 0.0;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const double va = fmin(T[a].inner, 1e30) + slack, vb = fmin(T[b].inner, 1e30) + slack;
        if (va >= 0.0) {
            polygon[n][0] = C[a][0];
            polygon[n++][1] = C[a][1];
        }
        if ((va >= 0.0) != (vb >= 0.0)) {
            const double share = va / (va - vb);
            polygon[n][0] = C[a][0] + share * (C[b][0] - C[a][0]);
            polygon[n++][1] = C[a][1] + share * (C[b][1] - C[a][1]);
        }
    }
    if (n == 0) return -HUGE_VAL;
    double least = HUGE_VAL;
    for (int a = 0; a < 3; a++) {
        double highest = -HUGE_VAL;
        for (int k = 0; k < n; k++)
            highest = fmax(highest, T[a].value + T[a].slope[0] * (polygon[k][0] - C[a][0])
                                        + T[a].slope[1] * (polygon[k][1] - C[a][1]));
        least = fmin(least, highest);
    }
    return least + fmax(growth, 0.1 * bend);
}

/* Where the wheel's point at q meets the pinion's flank, from a place that meets it, in as many steps as it takes but
 * none shorter than a share of the way; 0 where it does not lead there. */
static int reach(const search *h, const place *from, const double *q, double shortest, place *P)
{
    double done = 0.0, step = 1.0;
    *P = *from;
    while (done < 1.0) {
        place next = *P;
        const double share = fmin(1.0, done + step);
        for (int i = 0; i < h->nw; i++) next.q[i] = share < 1.0 ? from->q[i] + share * (q[i] - from->q[i]) : q[i];
        if (meet(h, &next)) {
            *P = next;
            done = share;
            step *= 2.0;
        } else {
            step *= 0.5;
            if (step < shortest) return P->good = 0;
        }
    }
    return 1;
}

/* A place halfway between two others; where neither meets the pinion's flank, it is not known to. */
static int halfway(const search *h, const place *a, const place *b, place *P)
{
    double q[MAX_K];
    for (int i = 0; i < h->nw; i++) q[i] = 0.5 * (a->q[i] + b->q[i]);
    *P = *a;
    P->good = 0;
    if (a->good && b->good) {
        *P = *a;
        memcpy(P->q, q, sizeof q);
        for (int i = 0; i < h->nk; i++) P->p[i] = 0.5 * (a->p[i] + b->p[i]);
        P->delta = 0.5 * (a->delta + b->delta);
        if (meet(h, P)) return 1;
    }
    if ((a->good && reach(h, a, q, 0.25, P)) || (b->good && reach(h, b, q, 0.25, P))) return 1;
    memcpy(P->q, q, sizeof q);
    return 0;
}

/* The longest edge of a triangle, in natural sizes. */
static int longest(const search *h, const place *T)
{
    double most = -1.0;
    int edge = 0;
    for (int a = 0; a < 3; a++) {
        double length = 0.0;
        for (int i = 0; i < 2; i++) {
            const int j = h->free_[1][i];
            const double d = (T[a].q[j] - T[(a + 1) % 3].q[j]) / h->mesh->wheel_sizes[j];
            length += d * d;
        }
        if (length > most) {
            most = length;
            edge = a;
        }
    }
    return edge;
}

/* An upper bound over a triangle of which not every corner meets the pinion's flank, which ends there: from the corners
 * that do and are inside its limits, with slopes twice theirs; -HUGE_VAL if none is. */
static double bound_at_end(const search *h, const place *T)
{
    double highest = -HUGE_VAL;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3 && T[a].good && T[a].inner >= 0.0; b++) {
            double rise = 0.0;
            for (int i = 0; i < 2; i++) {
                const int j = h->free_[1][i];
                rise += T[a].slope[i] * (T[b].q[j] - T[a].q[j]) / h->mesh->wheel_sizes[j];
            }
            highest = fmax(highest, T[a].value + 2.0 * fabs(rise));
        }
    return highest;
}

/* Look at a triangle and at its parts, until none can hold an extreme that stands out by more than the resolution. */
static void look(const search *h, const place *corners, best_ *best)
{
    place stack[DEEPEST + 2][3];
    int depth[DEEPEST + 2], n = 1;
    memcpy(stack[0], corners, sizeof stack[0]);
    depth[0] = 0;
    while (n > 0) {
        place T[3], middle;
        int edge = 0;
        memcpy(T, stack[--n], sizeof T);
        const int deep = depth[n], whole = T[0].good && T[1].good && T[2].good;
        const double high = whole ? bound(h, T, &edge) : bound_at_end(h, T);
        if (!(high > -HUGE_VAL)) continue;
        if (!((high - best->floor) * best->lever > RESOLUTION)) continue;
        if (!whole || deep % 2) edge = longest(h, T);
        if (--best->budget < 0 || deep >= (whole ? DEEPEST : DEEPEST_EDGE)) {
            best->highest = fmax(best->highest, high);
            continue;
        }
        halfway(h, &T[edge], &T[(edge + 1) % 3], &middle);
        if (middle.good && middle.inner >= 0.0 && worst(h, &middle) >= 0.0 && middle.value > best->floor + 1e-13) {
            refine(h, &middle, best);
            best->budget -= CLIMB_COST; /* where climbs end nowhere, each place would begin another one */
        }
        memcpy(stack[n], T, sizeof T);
        depth[n] = deep + 1;
        stack[n++][(edge + 1) % 3] = middle;
        memcpy(stack[n], T, sizeof T);
        depth[n] = deep + 1;
        stack[n++][edge] = middle;
    }
}

static int set_up(search *h, const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                  const double *wheel, double turn)
{
    const mw_body *p = &m->bodies[0], *w = &m->bodies[1];
    memset(h, 0, sizeof *h);
    h->m = m;
    h->s = s;
    h->mesh = mesh;
    h->turn = turn;
    h->nk = p->parameters;
    h->nw = w->parameters;
    h->given = 1;
    h->bound[1] = mesh->bound;
    if (h->nk > MAX_K || h->nw > MAX_K || h->nk != 2 + p->conditions || h->nw != 2 + w->conditions) return 0;
    if (w->conditions ? mesh->bound < 0 || mesh->bound >= h->nw : mesh->bound != -1) return 0;
    if (p->outputs > MAX_OUTPUTS || w->outputs > MAX_OUTPUTS || limit_count(h) > MAX_LIMITS) return 0;
    others(h->nw, h->bound[1], h->free_[1]);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            h->A[3 * i + j] = pinion[i] * wheel[j] + pinion[4 + i] * wheel[4 + j] + pinion[8 + i] * wheel[8 + j];
        h->b[i] = 0.0;
        for (int j = 0; j < 3; j++) h->b[i] += pinion[4 * j + i] * (wheel[4 * j + 3] - pinion[4 * j + 3]);
    }
    return 1;
}

/* Carry a place from where it was solved along placements of the bodies. */
static int carry(search *h, const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                 const double *wheel, size_t steps, double turn, place *P)
{
    const double sense = h->sense;
    for (size_t k = 0; k < steps; k++) {
        if (!set_up(h, m, s, mesh, pinion + 12 * k, wheel + 12 * k, turn)) return MW_BAD_INPUT;
        h->sense = sense;
        if (!meet(h, P)) return MW_DIVERGED;
    }
    return MW_CONVERGED;
}

/* Distance of vertex v from parameters q, squared, in natural sizes. */
static double away(const search *h, size_t v, const double *q)
{
    double sum = 0.0;
    for (int i = 0; i < 2; i++) {
        const int j = h->free_[1][i];
        const double d = (h->mesh->q[(int)v * h->nw + j] - q[j]) / h->mesh->wheel_sizes[j];
        sum += d * d;
    }
    return sum;
}

/* Try to reach a vertex from a place that meets the pinion's flank. */
static int lead(const search *h, const place *from, size_t v, double shortest, place *at)
{
    const double *q = h->mesh->q + v * (size_t)h->nw;
    if (reach(h, from, q, shortest, &at[v])) return 1;
    memcpy(at[v].q, q, (size_t)h->nw * sizeof *q);
    at[v].inner = -HUGE_VAL;
    return 0;
}

/* Where every vertex of the mesh meets the pinion's flank: each piece of the mesh from its vertex nearest to a known
 * place, and from there along its edges. tried[vertices] is work. */
static void flood(const search *h, const place *known, place *at, unsigned char *tried)
{
    const mw_flank_mesh *mesh = h->mesh;
    enum { AT_MOST = 3 };
    memset(tried, 0, mesh->vertices);
    for (size_t v = 0; v < mesh->vertices; v++) at[v].good = 0;
    for (;;) {
        size_t seed = mesh->vertices;
        double least = HUGE_VAL;
        for (size_t v = 0; v < mesh->vertices; v++)
            if (!tried[v] && away(h, v, known->q) < least) {
                least = away(h, v, known->q);
                seed = v;
            }
        if (seed == mesh->vertices) return;
        tried[seed] = AT_MOST;
        if (!lead(h, known, seed, 1.0 / (double)FINEST_WALK, at)) continue;
        for (int grown = 1; grown;) {
            grown = 0;
            for (size_t t = 0; t < 3 * mesh->triangles; t++) {
                const size_t a = (size_t)mesh->corner[t], b = (size_t)mesh->corner[t % 3 == 2 ? t - 2 : t + 1];
                if (at[a].good == at[b].good) continue;
                const size_t from = at[a].good ? a : b, to = at[a].good ? b : a;
                if (tried[to] >= AT_MOST) continue;
                tried[to]++;
                grown |= 1;
                lead(h, &at[from], to, at[from].inner >= 0.0 ? 0.25 : 1.0, at);
            }
        }
    }
}

int mw_first_contact(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                     const double *wheel, size_t steps, double turn, double sense, const double *start, double *work,
                     mw_first *found)
{
    search h;
    best_ best;
    place known;
    memset(found, 0, sizeof *found);
    memset(&best, 0, sizeof best);
    memset(&known, 0, sizeof known);
    memset(&h, 0, sizeof h);
    h.sense = sense;
    best.floor = best.highest = -HUGE_VAL;
    best.lever = 1.0;
    best.budget = BUDGET;
    if (!mwi_usable(m) || mesh->vertices == 0 || steps == 0) return found->status = MW_BAD_INPUT;
    if (!m->kernels || !m->kernels->bounded) return found->status = MW_BAD_INPUT;
    if (m->bodies[0].parameters > MAX_K || m->bodies[1].parameters > MAX_K) return found->status = MW_BAD_INPUT;
    memcpy(known.q, start, (size_t)m->bodies[1].parameters * sizeof *start);
    memcpy(known.p, start + m->bodies[1].parameters, (size_t)m->bodies[0].parameters * sizeof *start);
    known.delta = start[m->bodies[1].parameters + m->bodies[0].parameters];
    found->status = carry(&h, m, s, mesh, pinion, wheel, steps, turn, &known);
    if (found->status < 0) return found->status;
    pinion += 12 * (steps - 1);
    place *at = (place *)(void *)work;
    unsigned char *marks = (unsigned char *)(void *)(at + mesh->vertices);
    flood(&h, &known, at, marks);
    for (size_t v = 0; v < mesh->vertices; v++)
        if (at[v].good && at[v].inner >= 0.0) {
            found->met++;
            if (mesh->open[v]) found->open++;
        }
    if (found->open) return found->status = MW_NO_CONTACT;
    if (worst(&h, &known) >= 0.0) refine(&h, &known, &best);
    /* the highest vertices that stand above their neighbours */
    unsigned char *below = marks;
    memset(below, 0, mesh->vertices);
    for (size_t t = 0; t < mesh->triangles; t++)
        for (int a = 0; a < 3; a++) {
            const int v = mesh->corner[3 * t + (size_t)a], w = mesh->corner[3 * t + (size_t)((a + 1) % 3)];
            const int in_v = at[v].good && at[v].inner >= 0.0, in_w = at[w].good && at[w].inner >= 0.0;
            if (in_v && in_w) below[at[v].value < at[w].value ? v : w] = 1;
        }
    for (int k = 0; k < STARTS; k++) {
        int top = -1;
        for (size_t v = 0; v < mesh->vertices; v++)
            if (!below[v] && at[v].good && at[v].inner >= 0.0 && (top < 0 || at[v].value > at[top].value)) top = (int)v;
        if (top < 0) break;
        below[top] = 1;
        refine(&h, &at[top], &best);
    }
    for (size_t t = 0; t < mesh->triangles; t++) {
        place T[3];
        for (int a = 0; a < 3; a++) T[a] = at[mesh->corner[3 * t + (size_t)a]];
        if (T[0].good || T[1].good || T[2].good) look(&h, T, &best);
    }
    if (best.found) name_limits(&h, &best);
    const double left = fmax(best.highest, best.floor);
    if (!best.found) return found->status = left > -HUGE_VAL ? MW_DIVERGED : MW_NO_CONTACT;
    found->unresolved = fmax(0.0, (left - best.at.value) * fabs(best.at.lever));
    found->wheel_turn = best.at.delta;
    found->lever = best.at.lever;
    for (int i = 0; i < 2; i++) {
        const int wheel_limits = m->bodies[1].margins + 1;
        const int a = best.active[i] < MAX_LIMITS ? best.active[i] : -1;
        found->limit[i] = a < 0 ? -1 : a < wheel_limits ? a : a - wheel_limits;
        found->member[i] = a < 0 ? -1 : a < wheel_limits;
    }
    memcpy(found->q_wheel, best.at.q, (size_t)h.nw * sizeof *best.at.q);
    memcpy(found->q_pinion, best.at.p, (size_t)h.nk * sizeof *best.at.p);
    for (int i = 0; i < 3; i++) {
        found->point[i] = pinion[4 * i + 3] + dot(pinion + 4 * i, best.at.point);
        found->normal[i] = dot(pinion + 4 * i, best.at.normal);
    }
    return found->status = MW_CONVERGED;
}

size_t mw_first_contact_work(size_t vertices)
{
    return (vertices * (sizeof(place) + 1) + sizeof(double) - 1) / sizeof(double);
}
