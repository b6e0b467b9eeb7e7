/* Exact sensitivities of a contact by the implicit function theorem.  SPDX-License-Identifier: MIT-0 */
#include <string.h>
#include "linear.h"
#include "meshwright.h"

typedef struct mw_tangents {
    const char *drive;
    void (*derive)(const double *given, const double *p, double *dp);
    void (*contact)(const double *p, const double *dp, double phi, const double *x, const double *dx, double *dR,
                    double *dr);
} mw_tangents;

#include "sensitivity_models.h"

static const mw_tangents *find(const mw_model *m)
{
    for (size_t i = 0; i < sizeof mw_tangent_models / sizeof mw_tangent_models[0]; i++)
        if (strcmp(mw_tangent_models[i].drive, m->drive) == 0) return &mw_tangent_models[i];
    return NULL;
}

int mw_complete_tangent(const mw_model *m, const double *given, const double *p, double *dp)
{
    const mw_tangents *t = find(m);
    if (!t || m->nsystems > 0) return MW_BAD_INPUT;
    t->derive(given, p, dp);
    return MW_CONVERGED;
}

/* Below this share of the largest pivot the contact does not determine its point: line contact. */
static const double RANK_TOLERANCE = 1e-12;

int mw_sensitivity(const mw_model *m, const double *given, const double *p, double phi, const double *s,
                   const double *x, const double *change, double *dp, double *dx, double *dr)
{
    const mw_tangents *t = find(m);
    double R[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], right[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    double gap;
    memcpy(dp, change, sizeof(double) * (size_t)m->np);
    if (mw_complete_tangent(m, given, p, dp) < 0) return MW_BAD_INPUT;
    for (int j = 0; j < m->nx; j++) dx[j] = 0.0;
    t->contact(p, dp, phi, x, dx, right, dr);
    for (int j = 0; j < m->nx; j++) right[j] = -right[j];
    m->eval(s, x, R, J);
    m->scale(s, scale);
    if (mw_linear_solve(m->nx, J, right, scale, RANK_TOLERANCE, dx, &gap) < m->nx) return MW_SINGULAR;
    t->contact(p, dp, phi, x, dx, right, dr);
    return MW_CONVERGED;
}
