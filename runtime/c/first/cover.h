/* Whether a part of a flank can hold an extreme, and a look at all that can.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FIRST_COVER_H
#define MWI_FIRST_COVER_H

#include <stdint.h>
#include "climb.h"
#include "walk.h"

enum {
    CLIMB_COST = 100,            /* places that a climb counts as, about those of a dozen steps */
    DEEPEST = 46,                /* how often a triangle is halved, and how often where a part of it never meets */
    DEEPEST_EDGE = 20,
    WALKED = 4,                  /* up to so many halvings places between are walked to; then they are near enough */
    BUDGET = 20000,              /* places that are looked at between the vertices */
    MIDDLES_BITS = 10, MIDDLES = 1 << MIDDLES_BITS /* edges of which the middle is kept */
};

/* No extreme that stands out by more is missed, mm along the normal. */
static const double RESOLUTION = 1e-4;

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

/* The middle of an edge between places a and b: the triangle beyond the edge asks for it, too. */
typedef struct middle {
    double a[MAX_K], b[MAX_K], shortest;
    place at;
} middle;

static void no_middles(middle *known)
{
    for (int i = 0; i < MIDDLES; i++) known[i].shortest = NAN;
}

/* Where among the middles that of an edge is kept, the same from either end. */
static size_t slot_of(const search *h, const place *a, const place *b)
{
    uint64_t bits[2];
    for (int i = 0; i < 2; i++) {
        const double sum = a->q[h->free_[1][i]] + b->q[h->free_[1][i]];
        memcpy(bits + i, &sum, sizeof sum);
    }
    return (size_t)(((bits[0] ^ (bits[1] << 21 | bits[1] >> 43)) * 0x9e3779b97f4a7c15u) >> (64 - MIDDLES_BITS));
}

static const place *middle_of(const search *h, const place *a, const place *b, double shortest, middle *known)
{
    middle *m = known + slot_of(h, a, b);
    const size_t size = (size_t)h->nw * sizeof *a->q;
    if (m->shortest == shortest) {
        const int same = memcmp(m->a, a->q, size) == 0 && memcmp(m->b, b->q, size) == 0;
        if (same || (memcmp(m->a, b->q, size) == 0 && memcmp(m->b, a->q, size) == 0)) return &m->at;
    }
    memcpy(m->a, a->q, size);
    memcpy(m->b, b->q, size);
    m->shortest = shortest;
    halfway(h, a, b, shortest, &m->at);
    return &m->at;
}

/* Look at a triangle and at its parts, until none can hold an extreme that stands out by more than the resolution. */
static void look(const search *h, const place *corners, middle *known, best_ *best)
{
    place stack[DEEPEST + 2][3];
    int depth[DEEPEST + 2], n = 1;
    memcpy(stack[0], corners, sizeof stack[0]);
    depth[0] = 0;
    while (n > 0) {
        place T[3];
        int edge = 0;
        memcpy(T, stack[--n], sizeof T);
        const int deep = depth[n], whole = T[0].good && T[1].good && T[2].good;
        const double high = whole ? bound(h, T, &edge) : bound_at_end(h, T);
        if (!(high > -HUGE_VAL) || high <= best->least) continue;
        if (!((high - best->floor) * best->lever > RESOLUTION)) continue;
        if (!whole || deep % 2) edge = longest(h, T);
        if (--best->budget < 0 || deep >= (whole ? DEEPEST : DEEPEST_EDGE)) {
            best->highest = fmax(best->highest, high);
            continue;
        }
        const place *half = middle_of(h, &T[edge], &T[(edge + 1) % 3], deep < WALKED ? 0.25 : 1.0, known);
        if (half->good && half->inner >= 0.0 && worst(h, half) >= 0.0 && half->value > best->floor + 1e-13) {
            refine(h, half, best);
            best->budget -= CLIMB_COST; /* where climbs end nowhere, each place would begin another one */
        }
        memcpy(stack[n], T, sizeof T);
        depth[n] = deep + 1;
        stack[n++][(edge + 1) % 3] = *half;
        memcpy(stack[n], T, sizeof T);
        depth[n] = deep + 1;
        stack[n++][edge] = *half;
    }
}

#endif
