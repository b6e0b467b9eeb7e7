/* Exact sensitivities of a design and of its contact by the implicit function theorem.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include <string.h>
#include "kernels.h"
#include "solver/complete.h"
#include "solver/linear.h"

/* Below this share of the largest pivot a system does not determine its solution: line contact. */
static const double RANK_TOLERANCE = 1e-12;

/* A drive's tangents; NULL where it has none, as a header alone, and for a foreign table. */
static const mw_tangents *tangents_of(const mw_model *m)
{
    return mwi_usable(m) && m->kernels ? m->kernels->tangents() : NULL;
}

/* Change of a solution: J change = -dR; J and dR are overwritten. */
static int implicit(int n, double *J, double *dR, const double *scale, double *change)
{
    double gap;
    for (int i = 0; i < n; i++) dR[i] = -dR[i];
    return mwi_linear_solve(n, J, dR, scale, RANK_TOLERANCE, change, &gap) < n ? MW_SINGULAR : MW_CONVERGED;
}

static int place(const mw_model *m, const mw_system *system, const mw_system_tangents *t, const double *p,
                 double *known, double *dp)
{
    double q[MW_MAX_PARAMETERS + 1], y[MW_MAX_UNKNOWNS] = { 0.0 }, dy[MW_MAX_UNKNOWNS] = { 0.0 };
    double R[MW_MAX_UNKNOWNS], dR[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    mw_info info;
    memcpy(q, p, sizeof(double) * (size_t)m->np);
    if (mwi_solve_system(m, system, q, y, &info) < 0) return info.status;
    t->equations(q, dp, y, dy, dR);
    system->eval(q, y, R, J);
    system->scale(q, scale);
    if (implicit(system->n, J, dR, scale, dy) < 0) return MW_SINGULAR;
    t->fill(q, y, dy, known, dp);
    return MW_CONVERGED;
}

int mw_complete_tangent(const mw_model *m, const double *given, const double *p, double *dp)
{
    double known[MW_MAX_PARAMETERS];
    const mw_tangents *t = tangents_of(m);
    if (!t) return MW_BAD_INPUT;
    memcpy(known, given, sizeof(double) * (size_t)m->np);
    t->derive(known, p, dp);
    for (int k = 0; k < m->nsystems; k++) {
        if (m->systems[k].open(known) == 0) continue;
        const int ended = place(m, &m->systems[k], &t->systems[k], p, known, dp);
        if (ended < 0) return ended;
        t->derive(known, p, dp);
    }
    return MW_CONVERGED;
}

int mw_contact_tangent(const mw_model *m, const double *p, const double *dp, double phi, double dphi, const double *s,
                       const double *x, double *dx, double *dr)
{
    double R[MW_MAX_UNKNOWNS], dR[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    const mw_tangents *t = tangents_of(m);
    if (!t) return MW_BAD_INPUT;
    for (int j = 0; j < m->nx; j++) dx[j] = 0.0;
    t->contact(p, dp, phi, dphi, x, dx, dR, dr);
    m->eval(s, x, R, J);
    m->scale(s, scale);
    if (implicit(m->nx, J, dR, scale, dx) < 0) return MW_SINGULAR;
    t->contact(p, dp, phi, dphi, x, dx, dR, dr);
    return MW_CONVERGED;
}

void mw_contact_motion(const mw_model *m, const double *p, const double *phi, size_t n, const double *x, double *s, double *work,
                       double *dr)
{
    const int usable = mwi_usable(m) && m->setup(p, s) == 0;
    double *const unchanged = work, *const dx = work + (usable ? m->np : 0);
    for (int i = 0; usable && i < m->np; i++) unchanged[i] = 0.0;
    for (size_t k = 0; k < n; k++, dr += 3) {
        if (usable) m->set_phi(s, phi[k]);
        if (usable && mw_contact_tangent(m, p, unchanged, phi[k], 1.0, s, x + k * (size_t)m->nx, dx, dr) >= 0) continue;
        dr[0] = dr[1] = dr[2] = NAN;
    }
}

int mw_flank_tangent(const mw_model *m, int body, const double *p, const double *dp, const double *q, size_t n, double *dr)
{
    const mw_tangents *t = tangents_of(m);
    if (!t || body < 0 || body > 1) return MW_BAD_INPUT;
    for (size_t k = 0; k < n; k++) t->flanks[body](p, dp, q + k * (size_t)m->bodies[body].parameters, dr + 3 * k);
    return MW_CONVERGED;
}

int mw_sensitivity(const mw_model *m, const double *given, const double *p, double phi, const double *s,
                   const double *x, const double *change, double *dp, double *dx, double *dr)
{
    if (!mwi_usable(m)) return MW_BAD_INPUT;
    memcpy(dp, change, sizeof(double) * (size_t)m->np);
    const int ended = mw_complete_tangent(m, given, p, dp);
    return ended < 0 ? ended : mw_contact_tangent(m, p, dp, phi, 0.0, s, x, dx, dr);
}
