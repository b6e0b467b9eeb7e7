/* The lane kernels for one instruction set. The including file defines MW_LANES, MW_LANE_SET and MW_LANE_SET_NAME and
 * selects the instruction set for the compiler.  SPDX-License-Identifier: MIT-0 */
#define MW_LANES_SIMD
#include <math.h>
#include <string.h>
#include "lanes.h"
#include "trace.h"

#define MW_LANE_MODEL(drive) \
    { #drive, MW_LANE_NAME(drive##_setup_lanes), MW_LANE_NAME(drive##_set_phi_lanes), \
      MW_LANE_NAME(drive##_step_lanes) }
#include "lane_models.h"

static const mw_lane_model *find(const char *drive)
{
    for (size_t i = 0; i < sizeof mw_lane_models / sizeof mw_lane_models[0]; i++)
        if (strcmp(mw_lane_models[i].drive, drive) == 0) return &mw_lane_models[i];
    return NULL;
}

/* Whether the n angles of every lane are equally spaced. */
static int equally_spaced(const double *phi, size_t n)
{
    double worst = 0.0;
    for (size_t k = 1; k + 1 < n; k++)
        for (size_t l = 0; l < MW_LANES; l++) {
            const double *a = phi + (k - 1) * MW_LANES + l;
            const double step = phi[MW_LANES + l] - phi[l];
            const double excess = fabs(a[2 * MW_LANES] - 2.0 * a[MW_LANES] + a[0]) - MW_EQUAL_SPACING * fabs(step);
            worst = excess > worst ? excess : worst;
        }
    return worst <= 0.0;
}

/* Lagrange weights of the last count points of each lane. */
static void weights(const double *phi, size_t k, size_t count, double *w)
{
    for (size_t i = 1; i <= count; i++, w += MW_LANES) {
        for (int l = 0; l < MW_LANES; l++) w[l] = 1.0;
        for (size_t j = 1; j <= count; j++) {
            const double *to = phi + k * MW_LANES, *own = phi + (k - i) * MW_LANES, *other = phi + (k - j) * MW_LANES;
            if (j != i) MW_LANE_LOOP w[l] *= (to[l] - other[l]) / (own[l] - other[l]);
        }
    }
}

/* Point k of every lane from its predecessors, as the scalar trace predicts it. */
static void predict(int nx, const double *phi, int uniform, size_t k, double *x)
{
    const size_t size = (size_t)nx * MW_LANES, count = k < MW_HISTORY ? k : MW_HISTORY;
    const double *a = x - size, *b = a - size, *c = b - size, *d = c - size;
    if (uniform && k >= MW_HISTORY) {
        for (size_t j = 0; j < size; j += MW_LANES) MW_LANE_LOOP
            x[j + (size_t)l] = MW_PREDICT_CUBIC(a[j + (size_t)l], b[j + (size_t)l], c[j + (size_t)l], d[j + (size_t)l]);
        return;
    }
    double w[MW_HISTORY * MW_LANES];
    weights(phi, k, count, w);
    for (size_t j = 0; j < size; j += MW_LANES) {
        for (size_t l = 0; l < MW_LANES; l++) x[j + l] = 0.0;
        for (size_t i = 0; i < count; i++)
            for (size_t l = 0; l < MW_LANES; l++) x[j + l] += w[i * MW_LANES + l] * x[j + l - (i + 1) * size];
    }
}

/* Newton in every lane until its step is small; a lane that is done keeps its numbers. Returns 1 if one step was enough
 * for all; else clears alive[l] where the steps do not shrink. */
static int newton(const mw_lane_model *k, int nx, const double *s, double *x, int *alive)
{
    double size[MW_LANES], previous[MW_LANES], before[MW_MAX_UNKNOWNS * MW_LANES];
    int open = 0;
    k->step(s, x, size);
    for (int l = 0; l < MW_LANES; l++) open += !(size[l] < MW_FUSED_TOLERANCE);
    if (!open) return 1;
    int active[MW_LANES];
    for (int l = 0; l < MW_LANES; l++) {
        active[l] = alive[l] && !(size[l] < MW_FUSED_TOLERANCE);
        if (!(size[l] <= MW_STEP_LIMIT)) active[l] = alive[l] = 0;
    }
    for (int iteration = 2; iteration <= MW_MAX_FUSED; iteration++) {
        int any = 0;
        for (int l = 0; l < MW_LANES; l++) any |= active[l];
        if (!any) return 0;
        memcpy(before, x, sizeof(double) * (size_t)nx * MW_LANES);
        memcpy(previous, size, sizeof size);
        k->step(s, x, size);
        for (int l = 0; l < MW_LANES; l++) {
            if (!active[l]) {
                for (int j = 0; j < nx; j++) x[j * MW_LANES + l] = before[j * MW_LANES + l];
                continue;
            }
            active[l] = !(size[l] < MW_FUSED_TOLERANCE);
            if (active[l] && !(size[l] < 0.5 * previous[l])) active[l] = alive[l] = 0;
        }
    }
    for (int l = 0; l < MW_LANES; l++)
        if (active[l]) alive[l] = 0;
    return 0;
}

/* How far the unknowns of each lane are inside the part on which the flanks lie; negative outside. */
static int all_inside(const mw_model *m, const double *x, double *inside)
{
    int outside = 0;
    for (int l = 0; l < MW_LANES; l++) inside[l] = HUGE_VAL;
    for (int j = 0; j < m->nx; j++) {
        const double *own = x + j * MW_LANES, lower = m->unknowns[j].lower, upper = m->unknowns[j].upper;
        MW_LANE_LOOP {
            const double above = own[l] - lower, below = upper - own[l];
            const double least = above < below ? above : below;
            inside[l] = least < inside[l] ? least : inside[l];
        }
    }
    for (int l = 0; l < MW_LANES; l++) outside += inside[l] < 0.0;
    return !outside;
}

static void follow(const mw_lane_model *k, const mw_model *m, double *s, const double *phi, size_t n,
                   const double *start, double *x, size_t *solved)
{
    const int nx = m->nx, uniform = equally_spaced(phi, n);
    const size_t size = (size_t)nx * MW_LANES;
    double inside[MW_LANES];
    int alive[MW_LANES];
    for (int l = 0; l < MW_LANES; l++) {
        alive[l] = 1;
        solved[l] = n;
    }
    for (size_t point = 0; point < n; point++, x += size) {
        if (point == 0) memcpy(x, start, sizeof(double) * size);
        else predict(nx, phi, uniform, point, x);
        k->set_phi(s, phi + point * MW_LANES);
        const int quick = newton(k, nx, s, x, alive);
        if (all_inside(m, x, inside) && quick) continue;
        for (int l = 0; l < MW_LANES; l++) {
            alive[l] &= !(inside[l] < 0.0);
            if (!alive[l] && solved[l] == n) solved[l] = point;
        }
    }
}

const mw_lane_set MW_LANE_SET = { MW_LANE_SET_NAME, MW_LANES, find, follow };
