/* Many designs, or many angles of one design, in lanes.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include <stdint.h>
#include <string.h>
#include "lanes.h"
#include "solver/steps.h"
#include "solver/touch.h"

extern const mw_lane_set mw_lanes_native, mw_lanes_avx2, mw_lanes_avx512;

/* The sets this processor runs, narrowest first. */
static int available(const mw_lane_set *sets[3])
{
    int count = 0;
    sets[count++] = &mw_lanes_native;
#ifdef MW_WIDE_LANES
    if (!__builtin_cpu_supports("fma")) return count;
    if (__builtin_cpu_supports("avx2")) sets[count++] = &mw_lanes_avx2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        sets[count++] = &mw_lanes_avx512;
#endif
    return count;
}

const mw_lane_set *mw_lanes(int width)
{
    const mw_lane_set *sets[3];
    const int count = available(sets);
    if (width == 0) return sets[count - 1];
    for (int i = 0; i < count; i++)
        if (sets[i]->width == width) return sets[i];
    return NULL;
}

int mw_lanes_width(const mw_lane_set *set)
{
    return set->width;
}

const char *mw_lanes_name(const mw_lane_set *set)
{
    return set->name;
}

/* A drive's kernels for an instruction set; NULL if it has none: a header alone, or a table of other functions. */
static const mw_lane_model *kernels_of(const mw_model *m, const mw_lane_set *set)
{
    return mwi_usable(m) && m->kernels ? m->kernels->lanes[set->set] : NULL;
}

/* Work of both traces: state, parameters, start, angles, points in lanes; then the scalar state and work, and rows of points
 * between those that are asked for. */
typedef struct room {
    double *s, *p, *start, *phi, *x, *state, *work, *between;
} room;

/* A vector that crosses a cache line costs twice: lanes begin at multiples of ALIGN numbers. */
enum { ALIGN = 8, PARTS = 5, KEPT = MW_HISTORY + MW_LANE_BLOCK };

size_t mw_lanes_work(const mw_lane_set *set, const mw_model *m, size_t n)
{
    const size_t lanes = (size_t)set->lanes, nx = (size_t)m->nx, ns = (size_t)m->ns, np = (size_t)m->np;
    return lanes * (ns + np + nx + n + MW_MOST_BETWEEN + (KEPT + MW_MOST_BETWEEN) * nx) + ns + np + PARTS * ALIGN;
}

static double *take(double **free, size_t count)
{
    const size_t past = (size_t)((uintptr_t)*free / sizeof(double) % ALIGN);
    double *part = *free + (past ? ALIGN - past : 0);
    *free = part + count;
    return part;
}

static room divide(const mw_lane_set *set, const mw_model *m, size_t n, double *work)
{
    const size_t lanes = (size_t)set->lanes, nx = (size_t)m->nx, ns = (size_t)m->ns, np = (size_t)m->np;
    room r;
    r.s = take(&work, lanes * ns);
    r.p = take(&work, lanes * np);
    r.start = take(&work, lanes * nx);
    r.phi = take(&work, lanes * (n > MW_MOST_BETWEEN ? n : MW_MOST_BETWEEN));
    r.x = take(&work, lanes * KEPT * nx);
    r.state = work;
    r.work = r.state + ns;
    r.between = r.work + np;
    return r;
}

static void spread(size_t lanes, size_t lane, const double *from, size_t count, double *to)
{
    for (size_t k = 0; k < count; k++) to[k * lanes + lane] = from[k];
}

/* A lane that lost its branch is traced again by the careful way, which says why. */
static size_t again(const mw_model *m, const double *p, const double *phi, size_t n, const room *r, double *x,
                    int *status)
{
    mw_info info[64];
    size_t succeeded = 0;
    for (size_t done = 0; done < n;) {
        const size_t part = n - done < 64 ? n - done : 64;
        succeeded += mw_trace(m, p, phi + done, part, r->state, r->work, x + done * (size_t)m->nx, info);
        for (size_t k = 0; k < part; k++) status[done + k] = info[k].status;
        done += part;
    }
    return succeeded;
}

/* The gate, asked where a lane ended: it went there from touching flanks in small steps. r->state is set up. */
static int touches(const mw_model *m, double phi, const double *x, const room *r)
{
    double o[MW_MAX_OBSERVATION];
    m->set_phi(r->state, phi);
    m->observe(r->state, x, o);
    return mwi_touch(m, x, o) >= 0;
}

/* Designs of which no lane is traced. */
static size_t all_again(const mw_model *m, const double *p, size_t designs, const double *phi, size_t n, const room *r,
                        double *x, int *status)
{
    size_t succeeded = 0;
    for (size_t d = 0; d < designs; d++)
        succeeded += again(m, p + d * (size_t)m->np, phi, n, r, x + d * n * (size_t)m->nx, status + d * n);
    return succeeded;
}

/* Whether there are lane kernels for this model table, and angles for them. */
static int in_lanes(const mw_lane_model *k, const double *phi, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!mwi_angle_in_range(phi[i])) return 0;
    return k != NULL && n > 0;
}

static size_t converged(size_t n, int *status)
{
    for (size_t k = 0; k < n; k++) status[k] = MW_CONVERGED;
    return n;
}

size_t mw_trace_designs(const mw_lane_set *set, const mw_model *m, const double *p, size_t designs, const double *phi,
                        size_t n, const double *start, double *work, double *x, int *status)
{
    const mw_lane_model *k = kernels_of(m, set);
    const size_t lanes = (size_t)set->lanes, nx = (size_t)m->nx, np = (size_t)m->np;
    const room r = divide(set, m, n, work);
    double valid[MW_MAX_LANES];
    size_t solved[MW_MAX_LANES], succeeded = 0;
    mw_lane_row rows[MW_MAX_LANES];
    if (!mwi_usable(m) || !in_lanes(k, phi, n)) return all_again(m, p, designs, phi, n, &r, x, status);
    const int parts = n < MW_MOST_BETWEEN ? mwi_parts_of(phi, (int)n) : 1;
    const size_t points = (n - 1) * (size_t)parts + 1;
    for (size_t l = 0; l < lanes; l++) {
        if (parts == 1) spread(lanes, l, phi, n, r.phi);
        else for (size_t i = 0; i < points; i++) r.phi[i * lanes + l] = mwi_angle_between(phi, parts, (int)i);
        spread(lanes, l, start, nx, r.start);
    }
    for (size_t first = 0; first < designs; first += lanes) {
        const size_t used = designs - first < lanes ? designs - first : lanes;
        for (size_t l = 0; l < lanes; l++) spread(lanes, l, p + (first + (l < used ? l : 0)) * np, np, r.p);
        k->setup(r.p, r.s, valid);
        for (size_t l = 0; l < lanes; l++) {
            const size_t own = l < used ? l : 0;
            double *const row = parts > 1 ? r.between + own * points * nx : x + (first + own) * n * nx;
            rows[l] = (mw_lane_row){ row, l < used ? points : 0 };
        }
        set->follow(k, m, r.s, r.phi, points, r.start, r.x, rows, solved);
        for (size_t l = 0, at = first * n; l < used; l++, at += n) {
            const double *own = p + (first + l) * np;
            for (size_t i = 0; parts > 1 && i < n; i++)
                memcpy(x + (at + i) * nx, rows[l].x + i * (size_t)parts * nx, nx * sizeof *x);
            const int followed = valid[l] > 0.0 && solved[l] == points && m->setup(own, r.state) == 0 &&
                                 touches(m, phi[n - 1], x + (at + n - 1) * nx, &r);
            succeeded += followed ? converged(n, status + at) : again(m, own, phi, n, &r, x + at * nx, status + at);
        }
    }
    return succeeded;
}

size_t mw_trace_angles(const mw_lane_set *set, const mw_model *m, const double *p, const double *phi, size_t n,
                       double *work, double *x, int *status)
{
    const mw_lane_model *k = kernels_of(m, set);
    const size_t lanes = (size_t)set->lanes, nx = (size_t)m->nx, part = (n + lanes - 1) / lanes;
    const room r = divide(set, m, part, work);
    double begin[MW_MAX_LANES] = { 0.0 }, valid[MW_MAX_LANES], xs[MW_MAX_LANES * MW_MAX_UNKNOWNS];
    size_t solved[MW_MAX_LANES], succeeded = 0;
    mw_info info[MW_MAX_LANES];
    mw_lane_row rows[MW_MAX_LANES];
    if (!mwi_usable(m) || !in_lanes(k, phi, n)) return all_again(m, p, 1, phi, n, &r, x, status);
    const double beyond = n > 1 ? phi[n - 1] - phi[n - 2] : 0.0; /* lanes that end early go on at the last spacing */
    for (size_t l = 0; l < lanes; l++)
        for (size_t i = 0, at = l * part; i < part; i++, at++)
            r.phi[i * lanes + l] = at < n ? phi[at] : phi[n - 1] + (double)(at - n + 1) * beyond;
    for (size_t l = 0; l < lanes; l++) begin[l] = r.phi[l];
    mw_trace(m, p, begin, lanes, r.state, r.work, xs, info);
    for (size_t l = 0; l < lanes; l++) {
        spread(lanes, l, p, (size_t)m->np, r.p);
        spread(lanes, l, xs + l * nx, nx, r.start);
    }
    k->setup(r.p, r.s, valid);
    for (size_t l = 0, at = 0; l < lanes; l++, at += part) {
        const size_t left = at < n ? n - at : 0;
        rows[l] = (mw_lane_row){ x + (left ? at : 0) * nx, left < part ? left : part };
    }
    set->follow(k, m, r.s, r.phi, part, r.start, r.x, rows, solved);
    m->setup(p, r.state);
    for (size_t l = 0, at = 0; at < n; l++, at += part) {
        const size_t last = at + rows[l].count - 1;
        const int followed = valid[l] > 0.0 && info[l].status >= 0 && solved[l] >= rows[l].count &&
                             touches(m, phi[last], x + last * nx, &r);
        succeeded += followed ? converged(rows[l].count, status + at)
                              : again(m, p, phi + at, rows[l].count, &r, x + at * nx, status + at);
        m->setup(p, r.state);
    }
    return succeeded;
}
