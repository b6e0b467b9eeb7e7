/* The contact of a pair from its reference, where the solution before does not serve.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_COLD_H) && !defined(MW_DEVICE_ONLY)
#define MWI_COLD_H

#include "choice.h"

/* The pair that `kept` knows or, where that is new, of the design; returns the guard that this does not pass. */
static inline int mwi_recall(mwi_pair *t, const double *kept)
{
    const int nx = t->m->nx;
    if (kept[MWI_REFERENCE_KEPT] != kept[MWI_REFERENCE_KEPT]) {
        const int guard = t->m->setup(t->p, t->s);
        if (!guard) mwi_find_reference(t);
        return guard;
    }
    t->reference = mwi_no_history();
    mwi_copy(t->at_reference, kept + MWI_KEPT, nx);
    t->bend = (int)kept[MWI_BEND_KEPT];
    t->reach = 0.0;
    if (kept[MWI_REFERENCE_KEPT] < HUGE_VAL) mwi_remember(&t->reference, kept[MWI_REFERENCE_KEPT], t->at_reference);
    mwi_begin_walk(t);
    return 0;
}

static inline void mwi_keep(const mwi_pair *t, double *kept, double last, const double *x)
{
    const int nx = t->m->nx;
    kept[MWI_REFERENCE_KEPT] = t->reference.count > 0 ? t->reference.phi[0] : HUGE_VAL;
    kept[MWI_LAST_KEPT] = last;
    kept[MWI_BEND_KEPT] = (double)t->bend;
    mwi_copy(kept + MWI_KEPT, t->at_reference, nx);
    mwi_copy(kept + MWI_KEPT + nx, x, nx);
}

/* The contact of pair 0 at its own angle; what the state keeps, or NULL, is then of it. */
static inline void mwi_anew(const mw_model *m, const double *p, double angle, double *s, double *kept, double *work, double *x, mw_info *info)
{
    mwi_pair t;
    if (!kept) {
        mwi_solve(m, p, angle, s, work, x, info);
        return;
    }
    t.m = m, t.p = p, t.s = s, t.work = work;
    *info = mwi_ended(MW_BAD_INPUT, mwi_recall(&t, kept));
    if (!info->guard) mwi_keep(&t, kept, mwi_solved(&t, angle, x, info) ? angle : NAN, x);
    m->set_phi(s, angle);
}

#endif
