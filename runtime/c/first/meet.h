/* Where a point of one bounded flank, turned about the wheel's axis, meets the other flank.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FIRST_MEET_H
#define MWI_FIRST_MEET_H

#include <math.h>
#include <string.h>
#include "../circular.h"
#include "../kernels.h"
#include "../meshwright.h"

enum {
    MAX_C = 2,                   /* conditions on a flank */
    MAX_K = 2 + MAX_C,           /* parameters of a flank */
    MAX_OUTPUTS = 48,            /* of a flank: point, normal and limits, and those of parameters and conditions */
    MAX_LIMITS = 18,             /* of both flanks, and four of a trust region */
    NEWTON_STEPS = 14
};

/* Newton's method ends with a step below this, in natural sizes, or one that the next would follow with one far below it. */
static const double STEP_DONE = 1e-10, NEXT_DONE = 1e-13, QUADRATIC = 1e-3;
/* Newton's method that has moved more than so many times its first step and this, or than that, in natural sizes, or turns
 * the wheel by more, rad, may have left its sheet or come to the next tooth. */
static const double JUMP = 3.0, JUMP_LEAST = 0.02, FARTHEST = 0.5, LARGEST_TURN = 0.1;

typedef struct search {
    const mw_model *m;
    const double *s;
    const mw_flank_mesh *mesh;
    double A[9], b[3];           /* from the wheel's frame, turned, to the pinion's */
    double turn, sense;
    int nk, nw;                  /* parameters of pinion and wheel */
    int given;                   /* whose point is given, 0 pinion, 1 wheel: it is looked for on the other's flank */
    int free_[2][2], bound[2][MAX_C]; /* parameters of each flank: two that span it; those that its conditions give */
} search;

/* What Newton's method asks of the pinion's flank at parameters p: tangents, its conditions with slopes. */
typedef struct linear {
    double p[MAX_K], tangents[3 * MAX_K], conditions[MAX_C * (1 + MAX_K)];
} linear;

/* One point of the wheel's flank and where it meets the pinion's. value: sense times the wheel angle. */
typedef struct place {
    double q[MAX_K], p[MAX_K];   /* parameters of wheel and pinion */
    double delta, value, slope[2], lever, inner;
    double limits[MAX_LIMITS];   /* of the wheel's flank, then of the pinion's */
    double point[3], normal[3];  /* pinion's frame */
    linear pinion;               /* where point and normal are */
    int good;
} place;

/* A turn of the wheel. */
typedef struct turned { double cosine, sine; } turned;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Solve n equations in place by elimination with row exchange; 0 where they are singular. */
static inline int eliminate(double *M, double *r, const int n)
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

/* The same for the numbers of equations that occur, each with its loops unrolled. */
static int solve(double *M, double *r, int n)
{
    switch (n) {
    case 3: return eliminate(M, r, 3);
    case 4: return eliminate(M, r, 4);
    default: return eliminate(M, r, n);
    }
}

static int conditions_at(const mw_body *b)
{
    return 7 + 3 * b->parameters + b->margins;
}

/* A body's condition of a number, with its slopes, among the outputs of its flank. */
static const double *condition_of(const mw_body *b, const double *o, int number)
{
    return o + conditions_at(b) + number * (1 + b->parameters);
}

static const double *sizes_of(const search *h, int member)
{
    return member ? h->mesh->wheel_sizes : h->mesh->pinion_sizes;
}

/* Let two parameters of a member span its flank: its conditions give the others. */
static void span(search *h, int member, int first, int second)
{
    h->free_[member][0] = first;
    h->free_[member][1] = second;
    for (int i = 0, k = 0; i < h->m->bodies[member].parameters; i++)
        if (i != first && i != second) h->bound[member][k++] = i;
}

/* Slopes of a member's conditions by the parameters that they give, by rows. */
static void by_bound(const search *h, int member, const double *o, double *M)
{
    const mw_body *body = &h->m->bodies[member];
    for (int i = 0; i < body->conditions; i++)
        for (int j = 0; j < body->conditions; j++)
            M[i * body->conditions + j] = condition_of(body, o, i)[1 + h->bound[member][j]];
}

/* By how much the parameters that a member's conditions give fall with another one. */
static void falls(const search *h, int member, const double *o, int number, double *fall)
{
    const mw_body *body = &h->m->bodies[member];
    double M[MAX_C * MAX_C];
    by_bound(h, member, o, M);
    for (int i = 0; i < body->conditions; i++) fall[i] = condition_of(body, o, i)[1 + number];
    if (body->conditions && !solve(M, fall, body->conditions))
        for (int i = 0; i < body->conditions; i++) fall[i] = NAN;
}

/* Whether a Newton step after another one, by both of which the method converges quadratically, is the last that matters. */
static int converged(double step, double before)
{
    return before < HUGE_VAL && step < QUADRATIC * before && step * (step / before) * (step / before) < NEXT_DONE;
}

/* A flank at two of its parameters: q completed from its conditions, outputs o. */
static int on_flank(const search *h, int member, double *q, double *o)
{
    const mw_body *body = &h->m->bodies[member];
    const int *bound = h->bound[member], n = body->conditions;
    double M[MAX_C * MAX_C], step[MAX_C];
    body->flank(h->s, q, o);
    for (int k = 0; k < NEWTON_STEPS && n; k++) {
        int still = 1, last = 1;
        by_bound(h, member, o, M);
        for (int i = 0; i < n; i++) step[i] = condition_of(body, o, i)[0];
        if (!solve(M, step, n)) return 0;
        for (int i = 0; i < n; i++) {
            const double size = sizes_of(h, member)[bound[i]];
            still &= fabs(step[i]) < NEXT_DONE * size;
            last &= fabs(step[i]) < STEP_DONE * size;
        }
        if (still) break;
        for (int i = 0; i < n; i++) q[bound[i]] -= step[i];
        body->flank(h->s, q, o);
        if (last) break;
    }
    return 1;
}

static turned turned_by(const search *h, double delta)
{
    const double angle = h->turn * delta;
    turned by = {NAN, NAN};
    if (fabs(angle) < MWI_CIRCULAR_FAR) mwi_sine(angle, &by.sine, &by.cosine);
    return by;
}

/* A vector of the wheel's frame, turned, in the pinion's frame; its derivative by the wheel's angle if rate is given. */
static void carried(const search *h, const double *r, const turned *by, double *x, double *rate)
{
    const double c = by->cosine, s = by->sine;
    const double at[3] = {c * r[0] - s * r[1], s * r[0] + c * r[1], r[2]};
    const double moved[3] = {-h->turn * at[1], h->turn * at[0], 0.0};
    for (int i = 0; i < 3; i++) {
        x[i] = dot(h->A + 3 * i, at);
        if (rate) rate[i] = dot(h->A + 3 * i, moved);
    }
}

/* Slopes of the wheel angle by the wheel's free parameters, in natural sizes, at a place with these outputs. */
static void slopes_at(const search *h, const double *ow, const double *op, const turned *by, place *P)
{
    for (int a = 0; a < 2; a++) {
        const int number = h->free_[1][a];
        double tangent[3], along[3], fall[MAX_C];
        falls(h, 1, ow, number, fall);
        for (int i = 0; i < 3; i++) {
            tangent[i] = ow[6 + 3 * number + i];
            for (int j = 0; j < h->nw - 2; j++) tangent[i] -= fall[j] * ow[6 + 3 * h->bound[1][j] + i];
        }
        carried(h, tangent, by, along, NULL);
        P->slope[a] = -h->sense * dot(op + 3, along) / P->lever * h->mesh->wheel_sizes[number];
    }
}

/* Whether Newton's method of such a first step, now `at` unknowns that were `from`, may have left its sheet or come to the
 * next tooth. */
static int strayed(const double *size, int n, const double *at, const double *from, double angle, double first)
{
    double moved = fabs(angle);
    if (moved > LARGEST_TURN) return 1;
    for (int j = 0; j < n; j++) moved = fmax(moved, fabs(at[j] - from[j]) / size[j]);
    return moved > fmin(FARTHEST, JUMP * first + JUMP_LEAST);
}

/* The pinion's flank at the parameters of a place: as it was found where they are still those of its point. */
static void pinion_at(const search *h, const place *P, double *o)
{
    const mw_body *body = &h->m->bodies[0];
    const size_t k = (size_t)h->nk;
    if (memcmp(P->p, P->pinion.p, k * sizeof *P->p) != 0) {
        body->flank(h->s, P->p, o);
        return;
    }
    memcpy(o, P->point, sizeof P->point);
    memcpy(o + 3, P->normal, sizeof P->normal);
    memcpy(o + 6, P->pinion.tangents, 3 * k * sizeof *o);
    memcpy(o + conditions_at(body), P->pinion.conditions, (size_t)body->conditions * (1 + k) * sizeof *o);
}

static void keep_pinion(const search *h, const double *o, place *P)
{
    const mw_body *body = &h->m->bodies[0];
    const size_t k = (size_t)h->nk;
    memcpy(P->point, o, sizeof P->point);
    memcpy(P->normal, o + 3, sizeof P->normal);
    memcpy(P->pinion.p, P->p, sizeof P->p);
    memcpy(P->pinion.tangents, o + 6, 3 * k * sizeof *o);
    memcpy(P->pinion.conditions, o + conditions_at(body), (size_t)body->conditions * (1 + k) * sizeof *o);
}

/* Where the given member's point, at P->q or P->p, meets the other one's flank, from the other parameters and P->delta on;
 * 0 where that does not lead to a place on the same sheet. */
static int meet(const search *h, place *P)
{
    const mw_body *pinion = &h->m->bodies[0], *wheel = &h->m->bodies[1];
    double ow[MAX_OUTPUTS], op[MAX_OUTPUTS], x[3], rate[3], M[(1 + MAX_K) * (1 + MAX_K)], r[1 + MAX_K];
    const int sought = !h->given, parameters = sought ? h->nw : h->nk, n = parameters + 1;
    double *unknown = sought ? P->q : P->p, *known = sought ? P->p : P->q;
    const double *size = sizes_of(h, sought);
    P->good = 0;
    P->inner = -HUGE_VAL;
    if (!on_flank(h, h->given, known, h->given ? ow : op)) return 0;
    double before = HUGE_VAL, first = 0.0, from[MAX_K];
    int done = 0;
    memcpy(from, unknown, sizeof from);
    const double delta = P->delta;
    for (int k = 0; k < NEWTON_STEPS && !done; k++) {
        const mw_body *body = &h->m->bodies[sought];
        double *o = sought ? ow : op;
        const turned by = turned_by(h, P->delta);
        if (k == 0 && !sought) pinion_at(h, P, o);
        else body->flank(h->s, unknown, o);
        carried(h, ow, &by, x, rate);
        for (int j = 0; j < parameters; j++) {
            double tangent[3];
            if (sought) carried(h, o + 6 + 3 * j, &by, tangent, NULL);
            for (int i = 0; i < 3; i++) M[i * n + j] = sought ? -tangent[i] : o[6 + 3 * j + i];
        }
        for (int i = 0; i < 3; i++) {
            M[i * n + parameters] = -rate[i];
            r[i] = op[i] - x[i] - h->b[i];
        }
        for (int i = 0; i < body->conditions; i++) {
            const double *condition = condition_of(body, o, i);
            for (int j = 0; j < parameters; j++) M[(3 + i) * n + j] = condition[1 + j];
            M[(3 + i) * n + parameters] = 0.0;
            r[3 + i] = condition[0];
        }
        if (!solve(M, r, n)) return 0;
        double largest = fabs(r[parameters]);
        for (int j = 0; j < parameters; j++) largest = fmax(largest, fabs(r[j]) / size[j]);
        if (k > 2 && largest > before) return 0;
        if (k == 0) first = fmin(largest, 0.5);
        const double share = largest > 0.5 ? 0.5 / largest : 1.0;
        for (int j = 0; j < parameters; j++) unknown[j] -= share * r[j];
        P->delta -= share * r[parameters];
        if (strayed(size, parameters, unknown, from, P->delta - delta, first)) return 0;
        done = largest < STEP_DONE || converged(largest, before) || (largest < 1e-8 && largest > 0.5 * before);
        before = largest;
    }
    if (!done) return 0;
    h->m->bodies[sought].flank(h->s, unknown, sought ? ow : op);
    const turned by = turned_by(h, P->delta);
    carried(h, ow, &by, x, rate);
    P->lever = dot(op + 3, rate);
    if (!(P->lever * h->sense > 0.0)) return 0;
    slopes_at(h, ow, op, &by, P);
    P->value = h->sense * P->delta;
    keep_pinion(h, op, P);
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

#endif
