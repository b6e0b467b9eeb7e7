/* Contact geometry at a solution: what the observation holds, the major direction, flags.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_CONTACT_H
#define MWI_CONTACT_H

#include "basics.h"

/* Relative curvature below this share of the larger one is zero to round-off. */
static const double MWI_LINE_SHARE = 1e-10;

/* Share of the larger principal curvature of the gap that the smaller one does not reach along a line, or nearly one. */
static const double MWI_NEARLY_FLAT = 1e-6;

MW_DEVICE static inline double mwi_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Direction of the smaller eigenvalue of the gap's second form K (11, 12, 22) in an orthonormal basis e[6]: major[3]. */
MW_DEVICE static inline void mwi_major_direction(const double *K, const double *e, double *major)
{
    const double half = 0.5 * (K[0] - K[2]), radius = sqrt(half * half + K[1] * K[1]);
    const double u = half > 0.0 ? -K[1] : half - radius;
    const double v = half > 0.0 ? half + radius : K[1];
    const double length = sqrt(u * u + v * v);
    for (int i = 0; i < 3; i++) major[i] = length > 0.0 ? (u * e[i] + v * e[3 + i]) / length : e[i];
}

MW_BY_TABLE static inline unsigned mwi_flags_of(const mw_model *m, const double *o, double curvature_min, int line)
{
    unsigned flags = 0, bit = 4;
    for (int b = 0; b < 2; b++)
        if (o[m->bodies[b].regular] < 0.0) flags |= 1u;
    if (curvature_min < 0.0 && !line) flags |= 2u;
    for (int b = 0; b < 2; b++)
        for (int i = 0; i < m->bodies[b].margins; i++, bit <<= 1)
            if (o[m->bodies[b].margin + i] < 0.0) flags |= bit;
    return flags;
}

MW_DEVICE static inline int mwi_impossible(const char *flag)
{
    return mwi_same_text(flag, "interference") || mwi_same_text(flag, "spurious_sheet")
           || mwi_same_text(flag, "not_first");
}

MW_BY_TABLE static inline const char *mwi_flag(const mw_model *m, int bit)
{
    if (bit < 0) return NULL;
    if (bit == 0) return "undercut";
    if (bit == 1) return "interference";
    bit -= 2;
    for (int b = 0; b < 2; bit -= m->bodies[b].margins, b++)
        if (bit < m->bodies[b].margins) return m->bodies[b].flags[bit];
    return NULL;
}

#ifndef MW_DEVICE_ONLY
/* Names of the flags that are set, each once, both members' margins being named alike; returns how many. */
static inline int mwi_flags(const mw_model *m, unsigned flags, const char **names)
{
    int count = 0;
    const char *name;
    for (int bit = 0; (name = mwi_flag(m, bit)) != NULL; bit++) {
        int known = !(flags >> bit & 1u);
        for (int k = 0; k < count && !known; k++) known = mwi_same_text(names[k], name);
        if (!known) names[count++] = name;
    }
    return count;
}
#endif

/* Contact geometry at x; o[no] receives the observation. Returns MW_CONVERGED or MW_LINE_CONTACT. */
MW_BY_TABLE static inline int mwi_contact_at(const mw_model *m, const double *s, const double *x, double *o, mw_contact *c)
{
    MW_CALL(m, observe)(s, x, o);
    const double *pinion = o, *wheel = o + 6; /* point and normal of each, fixed frame */
    const double *e = o + m->geometry, *gap = e + 12, *curvature = gap + 3;
    c->distance = c->misfit = 0.0;
    for (int i = 0; i < 3; i++) {
        c->point[i] = 0.5 * (pinion[i] + wheel[i]);
        c->normal[i] = pinion[3 + i];
        c->distance += (pinion[i] - wheel[i]) * (pinion[i] - wheel[i]);
        c->misfit += (pinion[3 + i] + wheel[3 + i]) * (pinion[3 + i] + wheel[3 + i]);
    }
    c->distance = sqrt(c->distance);
    c->misfit = sqrt(c->misfit);
    c->curvature_min = curvature[0];
    c->curvature_max = curvature[1];
    mwi_major_direction(gap, e, c->major);
    c->lever_pinion = curvature[2];
    c->lever_wheel = curvature[3];
    c->ratio = curvature[4];
    c->line = mwi_abs(c->curvature_min) <= MWI_LINE_SHARE * mwi_abs(c->curvature_max);
    c->flags = mwi_flags_of(m, o, c->curvature_min, c->line);
    return c->line ? MW_LINE_CONTACT : MW_CONVERGED;
}

MW_DEVICE static inline int mwi_nearly_flat(const mw_contact *c)
{
    return mwi_abs(c->curvature_min) <= MWI_NEARLY_FLAT * mwi_abs(c->curvature_max);
}

#endif
