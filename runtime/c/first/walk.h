/* From a place where two flanks meet to others, and to the vertices of a mesh.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FIRST_WALK_H
#define MWI_FIRST_WALK_H

#include "meet.h"

/* Steps at most from a place to one that is further away. */
enum { FINEST_WALK = 64 };

/* Where the wheel's point at q meets the pinion's flank, from a place that meets it, in as many steps as it takes but
 * none shorter than a share of the way; 0 where it does not lead there. A step goes no further than one that has failed. */
static int reach(const search *h, const place *from, const double *q, double shortest, place *P)
{
    double done = 0.0, step = 1.0, failed = HUGE_VAL;
    *P = *from;
    while (done < 1.0) {
        place next = *P;
        const double share = fmin(fmin(1.0, done + step), failed);
        for (int i = 0; i < h->nw; i++) next.q[i] = share < 1.0 ? from->q[i] + share * (q[i] - from->q[i]) : q[i];
        if (meet(h, &next)) {
            *P = next;
            if (share >= failed) failed = HUGE_VAL;
            done = share;
            step *= 2.0;
        } else {
            failed = share;
            step = 0.5 * (share - done);
            if (step < shortest) return P->good = 0;
        }
    }
    return 1;
}

/* A place halfway between two others, walked to from one in steps no shorter than a share of the way; where neither meets
 * the pinion's flank, it is not known to. */
static int halfway(const search *h, const place *a, const place *b, double shortest, place *P)
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
    if ((a->good && reach(h, a, q, shortest, P)) || (b->good && reach(h, b, q, shortest, P))) return 1;
    memcpy(P->q, q, sizeof q);
    return 0;
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

/* The place nearest to a vertex, in natural sizes, among a known one and the vertices that meet the pinion's flank. */
static const place *nearest(const search *h, const place *known, const place *at, size_t vertex)
{
    const place *found = known;
    double least = away(h, vertex, known->q);
    for (size_t v = 0; v < h->mesh->vertices; v++)
        if (at[v].good && away(h, vertex, at[v].q) < least) {
            least = away(h, vertex, at[v].q);
            found = &at[v];
        }
    return found;
}

/* Attempts to reach a vertex; the mark of one beside a vertex that cannot be walked to. */
enum { AT_MOST = 3, BESIDE = 128 };

static void mark_beside(const mw_flank_mesh *mesh, size_t vertex, unsigned char *tried)
{
    for (size_t t = 0; t < 3 * mesh->triangles; t++)
        if ((size_t)mesh->corner[t] == vertex)
            for (size_t k = t - t % 3; k < t - t % 3 + 3; k++) tried[mesh->corner[k]] = (unsigned char)(tried[mesh->corner[k]] | BESIDE);
}

/* Where every vertex of the mesh meets the pinion's flank: each piece of the mesh from its vertex nearest to a known
 * place, walked to from the nearest one by then, and from there along its edges. Until another piece is found, vertices
 * beside one that cannot be walked to are left out. tried[vertices] is work. */
static void flood(const search *h, const place *known, place *at, unsigned char *tried)
{
    const mw_flank_mesh *mesh = h->mesh;
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
        const place *near = nearest(h, known, at, seed);
        const double finest = sqrt(least / away(h, seed, near->q)) / (double)FINEST_WALK;
        if (!lead(h, near, seed, fmin(finest, 0.25), at)) {
            mark_beside(mesh, seed, tried);
            continue;
        }
        for (size_t v = 0; v < mesh->vertices; v++) tried[v] = (unsigned char)(tried[v] & ~BESIDE);
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

#endif
