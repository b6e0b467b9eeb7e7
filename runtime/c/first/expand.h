/* The wheel angle at which flanks meet, and their limits there, to second order.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FIRST_EXPAND_H
#define MWI_FIRST_EXPAND_H

#include "meet.h"

enum { MAX_SECOND = (3 + MAX_LIMITS + MAX_C) * MAX_K * (MAX_K + 1) / 2 };

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
    const mw_expansion *expansion = &h->m->kernels->bounded()->expansions[member];
    f->k = body->parameters;
    f->limits = 1 + body->margins;
    f->pairs = f->k * (f->k + 1) / 2;
    body->flank(h->s, q, f->o);
    expansion->slopes(h->s, q, f->slopes);
    expansion->second(h->s, q, f->second);
}

/* Second derivative of number i of (point, limits, conditions) along directions a and b of the parameters. */
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
 * that each flank keeps its conditions, have the parameters of both and the angle as unknowns z. */
static int expand(const search *h, const place *P, model_ *q)
{
    enum { MOST = 2 * MAX_K + 1 };
    static const int A[3] = {0, 0, 1}, B[3] = {0, 1, 1};
    const mw_body *pinion = &h->m->bodies[0], *wheel = &h->m->bodies[1];
    const int of_pinion = h->nw, of_angle = h->nw + h->nk;
    const int kept = 3 + wheel->conditions, n = kept + pinion->conditions;
    bent p, w;
    double J[(2 * MAX_K - 1) * MOST] = {0.0}, z[2][MOST], zz[3][MOST], rate[3], x[3], swept[2][3], inwards[3];
    int follows[MOST];
    to_second_order(h, 0, P->p, &p);
    to_second_order(h, 1, P->q, &w);
    const turned by = turned_by(h, P->delta);
    carried(h, w.o, &by, x, rate);
    for (int j = 0; j < h->nw; j++) {
        double tangent[3];
        carried(h, w.o + 6 + 3 * j, &by, tangent, NULL);
        for (int i = 0; i < 3; i++) J[i * MOST + j] = -tangent[i];
        for (int i = 0; i < wheel->conditions; i++) J[(3 + i) * MOST + j] = condition_of(wheel, w.o, i)[1 + j];
    }
    for (int j = 0; j < h->nk; j++) {
        for (int i = 0; i < 3; i++) J[i * MOST + of_pinion + j] = p.o[6 + 3 * j + i];
        for (int i = 0; i < pinion->conditions; i++)
            J[(kept + i) * MOST + of_pinion + j] = condition_of(pinion, p.o, i)[1 + j];
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
        carried(h, along_wheel, &by, x, swept[a]);
    }
    const double flat[3] = {-w.o[0], -w.o[1], 0.0}; /* second derivative by the angle of a point turning about z */
    carried(h, flat, &by, inwards, NULL);
    for (int c = 0; c < 3; c++) {
        const double *za = z[A[c]], *zb = z[B[c]];
        double bends[3];
        for (int i = 0; i < 3; i++) bends[i] = bent_by(&w, i, za, zb);
        carried(h, bends, &by, x, NULL);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) M[i * n + j] = J[i * MOST + follows[j]];
        for (int i = 0; i < 3; i++)
            r[i] = x[i] + swept[A[c]][i] * zb[of_angle] + swept[B[c]][i] * za[of_angle]
                   + inwards[i] * za[of_angle] * zb[of_angle] - bent_by(&p, i, za + of_pinion, zb + of_pinion);
        for (int i = 0; i < wheel->conditions; i++) r[3 + i] = -bent_by(&w, 3 + w.limits + i, za, zb);
        for (int i = 0; i < pinion->conditions; i++)
            r[kept + i] = -bent_by(&p, 3 + p.limits + i, za + of_pinion, zb + of_pinion);
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

#endif
