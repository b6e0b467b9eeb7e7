/* A design's contact problem: its equations, at an angle, as balls.  SPDX-License-Identifier: MIT-0 */
#ifndef MWC_POSED_H
#define MWC_POSED_H

#include "problem.h"

/* Whether the equations know what they read of the state from the one number to the other. Returns a reason. */
static inline int mwc_known_between(const mwc_problem *p, int first, int end)
{
    for (int i = 0; i < p->equations->inputs; i++) {
        const int at = p->equations->input[i];
        if (at < first || at >= end) continue;
        if (!(p->balls[at].radius < HUGE_VAL && p->balls[at].mid == p->balls[at].mid)) return MW_REASON_DESIGN;
    }
    return MW_REASON_NONE;
}

/* A design's contact problem at no angle yet. Returns a reason. */
static inline int mwc_posed(const mw_model *m, const mw_wide *s, mwc_problem *p)
{
    const mw_certified *t = mwc_tables_of(m);
    if (!mw_encloses(m)) return MW_REASON_ARITHMETIC;
    p->equations = &t->equations;
    p->n = m->nx;
    mwc_known(p, s, t->slots);
    return mwc_known_between(p, 0, t->design_slots);
}

/* What follows from the angle, and the natural sizes of the unknowns, from the midpoints of the state. Returns a reason. */
static inline int mwc_posed_at(const mw_model *m, mw_wide phi, mwc_problem *p)
{
    const mw_certified *t = mwc_tables_of(m);
    mw_wide registers[MWC_REGISTERS];
    double state[MWC_ARGUMENTS];
    p->arguments[t->slots] = mwc_bounded(phi);
    mwc_run_wide(&t->instant, t->instant.instructions, p->arguments, registers);
    for (int i = t->design_slots; i < t->slots; i++) {
        p->arguments[i] = registers[t->instant.output[i - t->design_slots]];
        p->balls[i] = mwc_of_wide(p->arguments[i]);
    }
    for (int i = 0; i < t->slots; i++) state[i] = p->arguments[i].hi;
    for (int i = t->slots; i < MWC_ARGUMENTS; i++) state[i] = NAN;
    m->scale(state, p->sizes);
    return mwc_known_between(p, t->design_slots, t->slots);
}

/* As the printed code does it, to the same bits, residual at x, unless NULL, and Jacobian over the box x +- d; own: balls of
 * the angle. By the table where there is no printed code. */
static inline void mwc_linearise(const mw_enclosing *by, const mw_certified *t, mwc_problem *p, const double *own,
                                 const double *x, const double *d, double *R, double *J)
{
    mw_ball registers[MWC_REGISTERS], *at = p->balls + p->count;
    double not_asked[2 * MW_MAX_UNKNOWNS];
    const unsigned short *output = p->equations->output;
    const int n = p->n;
    if (by) {
        by->linearise(&p->balls[0].mid, own, x, d, R ? R : not_asked, J);
        return;
    }
    for (int i = t->design_slots; i < t->slots; i++, own += 2) p->balls[i] = mwc_make(own[0], own[1]);
    for (int i = 0; i < n; i++) at[i] = mwc_make(x[i], 0.0);
    if (R) mwc_run_ball(p->equations, p->equations->first, p->balls, registers);
    for (int i = 0; R && i < n; i++) mwc_put(R, i, registers[output[i]]);
    for (int i = 0; i < n; i++) at[i] = mwc_make(x[i], d[i]);
    mwc_run_ball(p->equations, p->equations->instructions, p->balls, registers);
    for (int i = 0; i < n * n; i++) mwc_put(J, i, registers[output[n + i]]);
}

/* Likewise what follows from an angle. */
static inline void mwc_at_angle(const mw_enclosing *by, const mw_certified *t, mwc_problem *p, mw_ball phi, double *own)
{
    mw_ball registers[MWC_REGISTERS];
    if (by) {
        by->instant(&p->balls[0].mid, &phi.mid, own);
        return;
    }
    p->balls[t->slots] = phi;
    mwc_run_ball(&t->instant, t->instant.instructions, p->balls, registers);
    for (int i = 0; i < t->slots - t->design_slots; i++) mwc_put(own, i, registers[t->instant.output[i]]);
}

#endif
