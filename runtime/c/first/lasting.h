/* Whether what leads at three pinion angles leads at all between them.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FIRST_LASTING_H
#define MWI_FIRST_LASTING_H

#include "cover.h"
#include "expand.h"

enum {
    LASTING_DEEPEST = 24,        /* how often a triangle is halved */
    LASTING_BUDGET = 20000       /* places that are looked at between the vertices, at each of the angles */
};

/* The searches at three angles, of which the second lies at a share of the way from the first to the last; `top`: the value
 * that leads at each, `lever`: the longest of theirs. Limits of the pinion that hold these places, -1 for none, with their
 * multipliers `push`: a value and these times the limits is no less than the value inside the limits, and does not rise across
 * them, which run over the wheel's flank as the pinion turns. nowhere: the flanks do not meet at any of the angles; top and push
 * are not used. */
typedef struct stretch {
    search h[3];
    middle *known[3];
    double top[3], push[3][2], lever, share;
    int held[2], nowhere;
    long budget;
} stretch;

/* What holds the place that leads at angle number e, at two limits of the whole list at most. */
static int pushes(stretch *b, int e, place *P, const int *active)
{
    model_ q;
    const int of_wheel = b->h[e].m->bodies[1].margins + 1;
    double push[2] = {0.0, 0.0};
    if (!meet(&b->h[e], P) || !expand(&b->h[e], P, &q)) return 0;
    const double *g = q.slope;
    if (active[0] >= 0 && active[1] >= 0) {
        const double *one = q.along[active[0]], *two = q.along[active[1]], det = one[0] * two[1] - one[1] * two[0];
        push[0] = -(g[0] * two[1] - g[1] * two[0]) / det;
        push[1] = -(one[0] * g[1] - one[1] * g[0]) / det;
    } else
        for (int k = 0; k < 2; k++)
            if (active[k] >= 0) {
                const double *a = q.along[active[k]];
                push[k] = -(g[0] * a[0] + g[1] * a[1]) / (a[0] * a[0] + a[1] * a[1]);
            }
    for (int k = 0; k < 2; k++) {
        const int held = active[k] >= of_wheel ? active[k] : -1;
        if (e > 0 && held != b->held[k]) return 0;
        b->held[k] = held;
        b->push[e][k] = push[k] > 0.0 && push[k] < HUGE_VAL ? push[k] : 0.0;
    }
    return 1;
}

/* The limits' share added to the values of a triangle at an angle, and to the slopes as it changes over the triangle. */
static void add_limits(const stretch *b, int e, int whole, place *T)
{
    const int *free_ = b->h[e].free_[1];
    const double *sizes = b->h[e].mesh->wheel_sizes;
    for (int k = 0; k < 2; k++) {
        const int i = b->held[k];
        const double push = b->push[e][k];
        if (i < 0 || !(push > 0.0)) continue;
        double d[2][2], rise[2];
        for (int a = 0; a < 2; a++) {
            for (int j = 0; j < 2; j++) d[a][j] = (T[a + 1].q[free_[j]] - T[0].q[free_[j]]) / sizes[free_[j]];
            rise[a] = push * (T[a + 1].limits[i] - T[0].limits[i]);
        }
        const double det = d[0][0] * d[1][1] - d[0][1] * d[1][0], span = fmax(fabs(rise[0]), fabs(rise[1]));
        for (int a = 0; a < 3; a++) {
            if (!T[a].good || !(T[a].limits[i] < HUGE_VAL)) continue;
            T[a].value += push * T[a].limits[i] + (whole ? 0.05 * span : 0.0); /* as in bound */
            if (!whole) continue;
            T[a].slope[0] += (rise[0] * d[1][1] - rise[1] * d[0][1]) / det;
            T[a].slope[1] += (rise[1] * d[0][0] - rise[0] * d[1][0]) / det;
        }
    }
}

/* By how much a number with these values at the three angles can be above the largest of them between: a parabola by a quarter
 * of this at most. */
static double bend_between(const stretch *b, const double *v)
{
    const double share = b->share, straight = (1.0 - share) * v[0] + share * v[2];
    return fabs(v[1] - straight) / (4.0 * share * (1.0 - share));
}


/* At each corner of a triangle the largest of the values at the three angles of how deep it lies inside the pinion's limits. */
static void widen(const stretch *b, place (*T)[3])
{
    for (int a = 0; a < 3; a++) {
        const double inner[3] = {T[0][a].inner, T[1][a].inner, T[2][a].inner};
        double most = fmax(fmax(inner[0], inner[1]), inner[2]);
        if (T[0][a].good && T[1][a].good && T[2][a].good && most < HUGE_VAL) most += bend_between(b, inner);
        for (int e = 0; e < 3; e++)
            if (T[e][a].good) T[e][a].inner = most;
    }
}

/* By how much a triangle's part inside the pinion's limits can lead anywhere between the angles, as `bound` has it at each and as
 * the values at its corners bend; change: the most by which one of these changes from one angle to the next, or else what is known
 * of the triangle of which this is a part; `least`: by how much a corner cannot be shown to lead less. */
static double lead_between(const stretch *b, place (*T)[3], int whole, int *edge, double *change, double *least)
{
    double high = -HUGE_VAL, bend = 0.0;
    *least = -HUGE_VAL;
    double moved = -HUGE_VAL;
    int ends = 0;
    for (int a = 0; a < 3; a++) {
        double ahead[3];
        int known = 0;
        for (int e = 0; e < 3; e++) {
            known += T[e][a].good;
            ahead[e] = T[e][a].value - b->top[e];
            if (e > 0 && T[e - 1][a].good && T[e][a].good) moved = fmax(moved, fabs(ahead[e] - ahead[e - 1]));
        }
        ends |= known % 3;
        if (known < 3) continue;
        const double most = bend_between(b, ahead);
        bend = fmax(bend, most);
        for (int e = 0; e < 3; e++)
            if (worst(&b->h[e], &T[e][a]) >= 0.0) *least = fmax(*least, ahead[e] + most);
    }
    if (moved >= 0.0) *change = moved;
    if (ends) bend = fmax(bend, 2.0 * *change); /* as in bound_at_end */
    for (int e = 0; e < 3; e++) {
        int its_edge = 0;
        const double here = whole ? bound(&b->h[e], T[e], &its_edge) : bound_at_end(&b->h[e], T[e]);
        high = fmax(high, here - b->top[e]);
        if (e == 1) *edge = its_edge;
    }
    return high + bend;
}

/* Whether a vertex where nothing ends the flank meets the pinion's bounded flank at every angle between. */
static int stays_open(const stretch *b, const mw_flank_mesh *mesh, place *const *at)
{
    for (size_t v = 0; v < mesh->vertices; v++) {
        const double inner[3] = {at[0][v].inner, at[1][v].inner, at[2][v].inner};
        const double least = fmin(fmin(inner[0], inner[1]), inner[2]);
        if (!mesh->open[v] || !at[0][v].good || !at[1][v].good || !at[2][v].good || !(least >= 0.0)) continue;
        if (!(least < HUGE_VAL) || least >= bend_between(b, inner)) return 1;
    }
    return 0;
}

/* Whether nothing in a triangle leads between the angles by half the resolution. */
static int lasts_in(stretch *b, place *const *at, const int *corner)
{
    place stack[LASTING_DEEPEST + 2][3][3];
    double change[LASTING_DEEPEST + 2];
    int depth[LASTING_DEEPEST + 2], n = 1;
    const double most = 0.5 * RESOLUTION / b->lever;
    for (int e = 0; e < 3; e++)
        for (int a = 0; a < 3; a++) stack[0][e][a] = at[e][corner[a]];
    depth[0] = 0;
    change[0] = HUGE_VAL;
    while (n > 0) {
        place T[3][3], wide[3][3];
        int edge = 0, whole = 1;
        double least;
        memcpy(T, stack[--n], sizeof T);
        const int deep = depth[n];
        for (int e = 0; e < 3; e++)
            for (int a = 0; a < 3; a++) whole &= T[e][a].good;
        memcpy(wide, T, sizeof wide);
        widen(b, wide);
        double known = change[n], high = lead_between(b, wide, whole, &edge, &known, &least);
        if (!(high > -HUGE_VAL)) continue;
        if (b->nowhere) return 0;
        if (high > most && (b->held[0] >= 0 || b->held[1] >= 0)) {
            double beside;
            for (int e = 0; e < 3; e++) add_limits(b, e, whole, wide[e]);
            high = lead_between(b, wide, whole, &edge, &known, &beside);
            least = fmin(least, beside);
        }
        if (!(high > most)) continue;
        if (least > most || --b->budget < 0 || deep >= LASTING_DEEPEST) return 0;
        if (!whole || deep % 2) edge = longest(&b->h[1], T[1]);
        const int next = (edge + 1) % 3;
        memcpy(stack[n], T, sizeof T);
        memcpy(stack[n + 1], T, sizeof T);
        for (int e = 0; e < 3; e++) {
            const place *half = middle_of(&b->h[e], &T[e][edge], &T[e][next], deep < WALKED ? 0.25 : 1.0, b->known[e]);
            stack[n][e][next] = stack[n + 1][e][edge] = *half;
        }
        depth[n] = depth[n + 1] = deep + 1;
        change[n] = change[n + 1] = known;
        n += 2;
    }
    return 1;
}

#endif
