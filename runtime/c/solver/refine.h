/* From start values to a judged solution.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_REFINE_H) && !defined(MW_DEVICE_ONLY)
#define MWI_REFINE_H

#include "newton.h"
#include "warm.h"

/* What a settled iteration is worth. A singular Jacobian at a true contact means line contact if a relative curvature
 * vanishes there. */
static inline int mwi_judge(const mw_model *m, const double *s, const double *x, mw_info *info)
{
    double o[MW_MAX_OBSERVATION];
    mw_contact c;
    if (info->status < 0 && info->status != MW_SINGULAR) return info->status;
    const int kind = mwi_contact_at(m, s, x, o, &c), touch = mwi_touch(m, x, o);
    if (touch < 0) return info->status = touch;
    if (info->status == MW_SINGULAR && kind == MW_LINE_CONTACT) info->status = MW_LINE_CONTACT;
    return info->status;
}

/* Solve from start values x[nx], state s set up for its angle. Returns info->status. */
static inline int mwi_refine(const mw_model *m, const double *s, double *x, mw_info *info)
{
    double before[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS];
    *info = mwi_ended(MW_CONVERGED, 0);
    mwi_copy(before, x, m->nx);
    if (mwi_newton_fused(m, s, x, MWI_FUSED_TOLERANCE, info)) {
        m->eval(s, x, R, NULL);
        info->residual = mwi_largest(m->nx, R);
    } else {
        mwi_copy(x, before, m->nx);
        m->scale(s, scale);
        mwi_newton(m->eval, m->nx, s, scale, x, info);
    }
    return mwi_judge(m, s, x, info);
}

#endif
