/* A trace in lanes by the kernels of any drive, for one instruction set: see lane_kernels.h.  SPDX-License-Identifier: MIT-0 */
#include <math.h>
#include <string.h>
#include "lanes.h"
#include "solver/steps.h"
#include "solver/warm.h"

#define MW_LANE_LOOP _Pragma("omp simd") for (int l = 0; l < MW_LANES; l++)

static inline double magnitude(double a)
{
    return a < 0.0 ? -a : a;
}

/* Whether the n angles of every lane are equally spaced. */
static int equally_spaced(const double *phi, size_t n)
{
    double worst[MW_LANES], most = 0.0;
    for (int l = 0; l < MW_LANES; l++) worst[l] = 0.0;
    for (size_t k = 1; k + 1 < n; k++) {
        const double *a = phi + (k - 1) * MW_LANES;
        MW_LANE_LOOP {
            const double excess = magnitude(a[2 * MW_LANES + l] - 2.0 * a[MW_LANES + l] + a[l])
                                  - MW_EQUAL_SPACING * magnitude(phi[MW_LANES + l] - phi[l]);
            worst[l] = excess > worst[l] ? excess : worst[l];
        }
    }
    for (int l = 0; l < MW_LANES; l++) most = worst[l] > most ? worst[l] : most;
    return most <= 0.0;
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
    const int size = nx * MW_LANES;
    const size_t count = k < MW_HISTORY ? k : MW_HISTORY;
    const double *a = x - size, *b = a - size, *c = b - size, *d = c - size;
    if (uniform && k >= MW_HISTORY) {
        _Pragma("omp simd") for (int j = 0; j < size; j++) x[j] = MW_PREDICT_CUBIC(a[j], b[j], c[j], d[j]);
        return;
    }
    double w[MW_HISTORY * MW_LANES];
    weights(phi, k, count, w);
    for (int j = 0; j < size; j += MW_LANES) {
        for (int l = 0; l < MW_LANES; l++) x[j + l] = 0.0;
        for (size_t i = 0; i < count; i++)
            for (int l = 0; l < MW_LANES; l++) x[j + l] += w[i * MW_LANES + (size_t)l] * x[j + l - (int)(i + 1) * size];
    }
}

/* Point 1 of every lane from point 0 by the tangent there: one point alone predicts itself, from which the first of few angles
 * are too far. */
static void predict_by_tangent(const mw_lane_model *k, int nx, double *s, const double *phi, double *x)
{
    const size_t size = (size_t)nx * MW_LANES;
    const double *from = x - size;
    double beside[MW_LANES], step[MW_LANES];
    memcpy(x, from, sizeof(double) * size);
    for (int l = 0; l < MW_LANES; l++) beside[l] = phi[l] + MWI_BESIDE;
    k->set_phi(s, beside);
    k->step(s, x, step);
    for (int j = 0; j < nx * MW_LANES; j += MW_LANES)
        for (int l = 0; l < MW_LANES; l++)
            x[j + l] = from[j + l] + (x[j + l] - from[j + l]) * ((phi[MW_LANES + l] - phi[l]) / MWI_BESIDE);
}

/* Whether the last step is small in every lane. */
static int all_small(const double *size)
{
    unsigned long long open = 0;
    _Pragma("omp simd reduction(| : open)") for (int l = 0; l < MW_LANES; l++) open |= size[l] < MW_FUSED_TOLERANCE ? 0 : 1;
    return !open;
}

/* Newton in every lane, after a first step of this size, until the step is small; a lane that is done keeps its numbers.
 * Clears alive[l] where the steps do not shrink. */
static void settle(const mw_lane_model *k, int nx, const double *s, double *x, double *size, int *alive)
{
    double previous[MW_LANES], before[MW_MAX_UNKNOWNS * MW_LANES];
    int active[MW_LANES];
    for (int l = 0; l < MW_LANES; l++) {
        active[l] = alive[l] && !(size[l] < MW_FUSED_TOLERANCE);
        if (!(size[l] <= MW_STEP_LIMIT)) active[l] = alive[l] = 0;
    }
    for (int iteration = 2; iteration <= MW_MAX_FUSED; iteration++) {
        int any = 0;
        for (int l = 0; l < MW_LANES; l++) any |= active[l];
        if (!any) return;
        memcpy(before, x, sizeof(double) * (size_t)nx * MW_LANES);
        memcpy(previous, size, sizeof previous);
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
}

/* Whether all unknowns of count points are inside the part on which the flanks lie. */
static int all_inside(const mw_model *m, const double *x, size_t count)
{
    double least[MW_MAX_UNKNOWNS * MW_LANES], most[MW_MAX_UNKNOWNS * MW_LANES], outside = 0.0;
    const int size = m->nx * MW_LANES;
    memcpy(least, x, sizeof(double) * (size_t)size);
    memcpy(most, x, sizeof(double) * (size_t)size);
    for (size_t k = 1; k < count; k++) {
        x += size;
        _Pragma("omp simd") for (int j = 0; j < size; j++) {
            least[j] = x[j] < least[j] ? x[j] : least[j];
            most[j] = x[j] > most[j] ? x[j] : most[j];
        }
    }
    for (int j = 0; j < size; j++) {
        const mw_name *unknown = m->unknowns + j / MW_LANES;
        outside += least[j] < unknown->lower || most[j] > unknown->upper ? 1.0 : 0.0;
    }
    return outside == 0.0;
}

/* A lane ends before its first point outside. */
static void end_outside(const mw_model *m, const double *x, size_t first, size_t count, int *alive, size_t *solved)
{
    for (size_t k = 0; k < count; k++)
        for (int j = 0; j < m->nx; j++)
            for (int l = 0; l < MW_LANES; l++, x++) {
                if (!(*x < m->unknowns[j].lower || *x > m->unknowns[j].upper)) continue;
                alive[l] = 0;
                if (first + k < solved[l]) solved[l] = first + k;
            }
}

/* Points from lanes to rows. */
static void put(const double *x, size_t nx, size_t first, size_t count, const mw_lane_row *rows)
{
    for (int l = 0; l < MW_LANES; l++) {
        const size_t open = rows[l].count > first ? rows[l].count - first : 0, size = nx * (count < open ? count : open);
        const double *own = x + l;
        double *row = rows[l].x + nx * first;
        size_t k = 0;
        for (; k + 8 <= size; k += 8, own += 8 * MW_LANES)
            for (int i = 0; i < 8; i++) row[k + (size_t)i] = own[i * MW_LANES];
        for (; k < size; k++, own += MW_LANES) row[k] = *own;
    }
}

static void follow(const mw_lane_model *k, const mw_model *m, double *s, const double *phi, size_t n,
                   const double *start, double *points, const mw_lane_row *rows, size_t *solved)
{
    const int nx = m->nx, uniform = equally_spaced(phi, n);
    const size_t size = (size_t)nx * MW_LANES;
    double *x = points + MW_HISTORY * size, step[MW_LANES];
    int alive[MW_LANES];
    for (int l = 0; l < MW_LANES; l++) {
        alive[l] = 1;
        solved[l] = n;
    }
    for (size_t first = 0; first < n; first += MW_LANE_BLOCK) {
        const size_t count = n - first < MW_LANE_BLOCK ? n - first : MW_LANE_BLOCK;
        if (first > 0) memcpy(points, points + MW_LANE_BLOCK * size, sizeof(double) * MW_HISTORY * size);
        for (size_t i = 0, point = first; i < count; i++, point++) {
            double *own = x + i * size;
            if (point == 0) memcpy(own, start, sizeof(double) * size);
            else if (point == 1) predict_by_tangent(k, nx, s, phi, own);
            else predict(nx, phi, uniform, point, own);
            k->set_phi(s, phi + point * MW_LANES);
            k->step(s, own, step);
            if (all_small(step)) continue;
            settle(k, nx, s, own, step, alive);
            for (int l = 0; l < MW_LANES; l++)
                if (!alive[l] && point < solved[l]) solved[l] = point;
        }
        if (!all_inside(m, x, count)) end_outside(m, x, first, count, alive, solved);
        put(x, (size_t)nx, first, count, rows);
    }
}

#define MW_JOIN2(name, suffix) name##suffix
#define MW_JOIN(name, suffix) MW_JOIN2(name, suffix)
const mw_lane_set MW_JOIN(mw, MW_LANE_SET) = {
    MW_LANE_SET_NAME, MW_LANE_SET_NUMBER, MW_LANES / 2, MW_LANES, follow, MWC_LANE_NAME(mwc_look),
    MWC_LANE_NAME(mwc_decide)
};
