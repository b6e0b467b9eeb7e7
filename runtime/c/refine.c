/* From start values to a judged solution.  SPDX-License-Identifier: MIT-0 */
#include <math.h>
#include <string.h>
#include "newton.h"
#include "choice.h"

static const double FUSED_TOLERANCE = 1e-9;

/* A singular Jacobian at a true contact means line contact if a relative curvature vanishes there. */
static int judge_singular(const mw_model *m, const double *s, const double *x, mw_info *info)
{
    if (info->status == MW_SINGULAR) {
        double o[MW_MAX_OBSERVATION];
        mw_contact c;
        if (mw_contact_at(m, s, x, o, &c) == MW_LINE_CONTACT) info->status = MW_LINE_CONTACT;
    }
    return info->status;
}

int mw_within_bounds(const mw_model *m, const double *x)
{
    const mw_name *end = m->unknowns + m->nx;
    for (const mw_name *unknown = m->unknowns; unknown < end; unknown++, x++)
        if (!(*x >= unknown->lower && *x <= unknown->upper)) return 0;
    return 1;
}

int mw_refine(const mw_model *m, const double *s, double *x, mw_info *info)
{
    double before[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS];
    memset(info, 0, sizeof *info);
    for (int i = 0; i < m->nx; i++) before[i] = x[i];
    if (mw_newton_fused(m, s, x, FUSED_TOLERANCE, info)) {
        m->eval(s, x, R, NULL);
        for (int i = 0; i < m->nx; i++)
            if (!(fabs(R[i]) <= info->residual)) info->residual = fabs(R[i]);
    } else {
        for (int i = 0; i < m->nx; i++) x[i] = before[i];
        m->scale(s, scale);
        mw_newton(m->eval, m->nx, s, scale, x, info);
        judge_singular(m, s, x, info);
    }
    if (info->status >= 0 && !mw_within_bounds(m, x)) info->status = MW_LEFT_FLANK;
    return info->status;
}
