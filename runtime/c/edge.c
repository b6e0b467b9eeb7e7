/* Contact of edges, and limits of flanks beyond their values.  SPDX-License-Identifier: MIT-0 */
#include "kernels.h"
#include "meshwright.h"
#include "solver/branch.h"

static const mw_bounded *bounded_of(const mw_model *m)
{
    return mwi_usable(m) && m->kernels ? m->kernels->bounded() : NULL;
}

int mw_edge(const mw_model *m, int pinion_margin, int wheel_margin)
{
    const mw_bounded *bounded = bounded_of(m);
    for (int k = 0; bounded && k < bounded->nedges; k++)
        if (bounded->edges[k].margin[0] == pinion_margin && bounded->edges[k].margin[1] == wheel_margin) return k;
    return -1;
}

static const mw_edge_system *system_of(const mw_model *m, int edge)
{
    const mw_bounded *bounded = bounded_of(m);
    return bounded && edge >= 0 && edge < bounded->nedges ? bounded->edges + edge : NULL;
}

/* Whether both bodies have a point in common within the rounding of its own terms, each in its domain. */
static int meets(const mw_model *m, const double *s, const double *x)
{
    double o[MW_MAX_OBSERVATION], apart[3];
    if (!mwi_within_bounds(m, x)) return 0;
    m->observe(s, x, o);
    for (int i = 0; i < 3; i++) apart[i] = o[i] - o[6 + i];
    const double size = mwi_terms(&m->bodies[0], o, o, 0.0, x) + mwi_terms(&m->bodies[1], o, o + 6, o[m->wheel_angle], x);
    return mwi_is_rounding(mwi_extent(apart), size, 1.0 + mwi_larger(mwi_extent(o), mwi_extent(o + 6)));
}

static int solved(const mw_model *m, const mw_edge_system *edge, const double *s, double *x, mw_info *info)
{
    double scale[MW_MAX_UNKNOWNS];
    *info = mwi_ended(MW_CONVERGED, 0);
    m->scale(s, scale);
    if (mwi_newton(edge->eval, m->nx, s, scale, x, info) >= 0 && !meets(m, s, x)) info->status = MW_DIVERGED;
    return info->status;
}

int mw_edge_solve(const mw_model *m, int edge, const double *s, double *x, mw_info *info)
{
    const mw_edge_system *system = system_of(m, edge);
    *info = mwi_ended(MW_BAD_INPUT, 0);
    return system ? solved(m, system, s, x, info) : MW_BAD_INPUT;
}

int mw_edge_eval(const mw_model *m, int edge, const double *s, const double *x, double *R, double *J)
{
    const mw_edge_system *system = system_of(m, edge);
    if (!system) return MW_BAD_INPUT;
    system->eval(s, x, R, J);
    return MW_CONVERGED;
}

/* One step to phi from the last two points, to a solution near where they lead. */
static int stepped(const mw_model *m, const mw_edge_system *edge, const mwi_history *h, double phi, double *s, double *x,
                   mw_info *info)
{
    double predicted[MW_MAX_UNKNOWNS];
    mwi_predict(h, phi, m->nx, predicted);
    m->set_phi(s, phi);
    *info = mwi_ended(MW_DIVERGED, 0);
    if (!mwi_near(m, s, predicted, h->x[0], MWI_STRIDE)) return 0;
    mwi_copy(x, predicted, m->nx);
    return solved(m, edge, s, x, info) >= 0 && mwi_near(m, s, x, predicted, MWI_BRANCH_WIDTH);
}

/* To phi in steps as small as the edge needs; way holds the last two points. */
static int walked(const mw_model *m, const mw_edge_system *edge, mwi_way *way, double phi, double *s, double *x,
                  mw_info *info)
{
    double step = phi - way->h.phi[0];
    const double smallest = mwi_abs(step) / (double)(1 << MWI_MAX_SPLITS);
    while (mwi_abs(step) > smallest) {
        const double next = mwi_abs(phi - way->h.phi[0]) <= 1.0001 * mwi_abs(step) ? phi : way->h.phi[0] + step;
        if (!stepped(m, edge, &way->h, next, s, x, info)) {
            step *= 0.5;
            continue;
        }
        mwi_advance(m, way, next, x);
        if (next == phi) return 1;
        step *= 2.0;
    }
    if (info->status >= 0) info->status = MW_DIVERGED; /* a solution, but not of this edge's branch */
    return 0;
}

size_t mw_edge_follow(const mw_model *m, int edge, double *s, double phi0, const double *x0, const double *phi, size_t n,
                      double *x, mw_info *info)
{
    const mw_edge_system *system = system_of(m, edge);
    mwi_way way;
    way.h = mwi_no_history();
    way.mwi_bend = 0;
    if (system) {
        mwi_copy(way.x[0], x0, m->nx);
        mwi_remember(&way.h, phi0, way.x[0]);
    }
    for (size_t k = 0; k < n; k++, x += m->nx, info++) {
        *info = mwi_ended(MW_BAD_INPUT, 0);
        if (!system || !mwi_angle_in_range(phi0) || !mwi_angle_in_range(phi[k])) return k;
        if (phi[k] != way.h.phi[0]) {
            if (!walked(m, system, &way, phi[k], s, x, info)) return k;
            continue;
        }
        mwi_copy(x, way.x[0], m->nx);
        m->set_phi(s, phi[k]);
        if (solved(m, system, s, x, info) < 0) return k;
    }
    return n;
}

int mw_bounds(const mw_model *m, int surface, int order, const double *s, const double *q, size_t n, double *o)
{
    const mw_bounded *bounded = bounded_of(m);
    if (!bounded || surface < 0 || surface >= 2 + m->nregions || order < 1 || order > 2) return MW_BAD_INPUT;
    const int of_body = surface < 2;
    const mw_body *body = m->bodies + (of_body ? surface : 0);
    const mw_region *region = m->regions + (of_body ? 0 : surface - 2);
    const int k = of_body ? body->parameters : region->parameters, c = of_body ? body->conditions : region->conditions;
    const int limits = (of_body ? body->outputs : region->outputs) - 6 - 3 * k - c * (1 + k);
    const int each = order == 1 ? limits * k : (3 + limits + c) * k * (k + 1) / 2;
    const mw_surface f = order == 1 ? bounded->expansions[surface].slopes : bounded->expansions[surface].second;
    if (!f) return MW_BAD_INPUT;
    for (size_t i = 0; i < n; i++, q += k, o += each) f(s, q, o);
    return MW_CONVERGED;
}
