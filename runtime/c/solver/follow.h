/* The contact of whichever pair is in mesh, from the solution before it where that serves.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_FOLLOW_H
#define MWI_FOLLOW_H

#include "cold.h"
#include "warm.h"

/* The contact of pair 0 at its own angle; s[ns] from setup, left set up for it; p[np] its parameters; work[np]; x[nx] in: what the
 * call before gave, or not a number; out: the contact, not a number where there is none. Returns info->status. */
MW_BY_TABLE static inline int mwi_follow_at(const mw_model *m, const double *p, double angle, double *s, double *work, double *x, mw_info *info)
{
    double *const kept = mwi_has_memory(m) ? s + m->memory : NULL;
    const int warm = kept && mwi_go_on(m, s, kept, angle, x, info);
#ifdef MW_DEVICE_ONLY
    (void)p, (void)work;
    if (!warm) *info = mwi_ended(MW_DIVERGED, 0);
#else
    if (!warm) mwi_anew(m, p, angle, s, kept, work, x, info);
#endif
    info->cold = !warm;
    for (int i = 0; i < m->nx && info->status < 0; i++) x[i] = NAN;
    return info->status;
}

/* That of the pair in mesh at phi, at info->angle of its own. */
MW_BY_TABLE static inline int mwi_follow(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info)
{
    double pair;
    const double angle = mwi_own_angle(m, p, phi, &pair);
    *info = mwi_ended(MW_BAD_INPUT, 0);
    if (angle == angle) mwi_follow_at(m, p, angle, s, work, x, info);
    else for (int i = 0; i < m->nx; i++) x[i] = NAN;
    info->pair = pair, info->angle = angle;
    return info->status;
}

#endif
