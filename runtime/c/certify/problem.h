/* One solution of a system of equations, enclosed by Krawczyk's test with refined middles.  SPDX-License-Identifier: MIT-0 */
#ifndef MWC_PROBLEM_H
#define MWC_PROBLEM_H

#include <string.h>
#define MWC_BALLS
#define MWC_WIDES
#include "../kernels.h"
#include "../mw_certify.h"
#include "../solver/basics.h"
#include "krawczyk.h"
#include "lane.h"
#include "tables.h"

enum { MWC_REFINING_STEPS = 3, MWC_NARROWING_STEPS = 8 };

/* The box of a proof that leaves the program, as a share of the box found, and how many times as wide other arithmetic may
 * find slopes over a box; nothing is said to be nearer than the least share of its natural size, 2^-150. */
static const double MWC_SHOWN_BOX = 0.25, MWC_SHOWN_WIDER = 16.0, MWC_SHOWN_LEAST = 7.006492321624085e-46;

static inline const mw_certified *mwc_tables_of(const mw_model *m)
{
    return mwi_usable(m) && m->kernels ? m->kernels->certified() : NULL;
}

/* A radius that is none bounds nothing. */
static inline mw_wide mwc_bounded(mw_wide w)
{
    return mwc_wide_where(w.radius >= 0.0, w);
}

/* One system of n equations: natural sizes of its unknowns, and what its code reads, the unknowns after `count` others,
 * also as balls. */
typedef struct mwc_problem {
    const mw_code *equations;
    int n, count;
    double sizes[MW_MAX_UNKNOWNS];
    mw_wide arguments[MWC_ARGUMENTS];
    mw_ball balls[MWC_ARGUMENTS];
} mwc_problem;

/* x: the point about which everything is; within: the solution's distance; box: where it is the only one. */
typedef struct mwc_solution {
    mw_wide x[MW_MAX_UNKNOWNS];
    double within[MW_MAX_UNKNOWNS], box[MW_MAX_UNKNOWNS];
} mwc_solution;

/* Residual at x as balls, from double-double. */
static inline void mwc_residual_at(mwc_problem *p, const mw_wide *x, mw_ball *R)
{
    mw_wide registers[MWC_REGISTERS];
    memcpy(p->arguments + p->count, x, sizeof(mw_wide) * (size_t)p->n);
    mwc_run_wide(p->equations, p->equations->first, p->arguments, registers);
    for (int i = 0; i < p->n; i++) R[i] = mwc_of_wide(registers[p->equations->output[i]]);
}

/* Residual, unless NULL, and Jacobian over the box x + [-d, d]; d = NULL: at x. */
static inline void mwc_linearised(mwc_problem *p, const mw_wide *x, const double *d, mw_ball *R, mw_ball *J)
{
    mw_ball registers[MWC_REGISTERS];
    for (int i = 0; i < p->n; i++) {
        mw_wide side = x[i];
        if (d) side.radius += d[i];
        p->balls[p->count + i] = mwc_of_wide(side);
    }
    mwc_run_ball(p->equations, p->equations->instructions, p->balls, registers);
    for (int i = 0; R && i < p->n; i++) R[i] = registers[p->equations->output[i]];
    for (int i = 0; i < p->n * p->n; i++) J[i] = registers[p->equations->output[p->n + i]];
}

/* Newton steps with the inverse C, so that the residual is that of double-double. */
static inline void mwc_refine(mwc_problem *p, const double *C, mw_wide *x)
{
    mw_ball R[MW_MAX_UNKNOWNS];
    for (int step = 0; step < MWC_REFINING_STEPS; step++) {
        mwc_residual_at(p, x, R);
        for (int i = 0; i < p->n; i++) {
            double change = 0.0;
            for (int j = 0; j < p->n; j++) change += C[i * p->n + j] * R[j].mid;
            x[i] = mwc_wide_add(x[i], mwc_wide_of(-change));
            x[i].radius = 0.0; /* a point, whichever it is */
        }
    }
}

/* From K < d on, the bound on the solution's distance repeats itself smaller. */
static inline void mwc_narrow(int n, const mw_ball *z, const double *M, const double *K, double *within)
{
    double image[MW_MAX_UNKNOWNS];
    memcpy(within, K, sizeof(double) * (size_t)n);
    for (int step = 0; step < MWC_NARROWING_STEPS; step++) {
        mwc_image(n, z, M, within, image);
        for (int i = 0; i < n; i++)
            if (image[i] < within[i]) within[i] = image[i];
    }
}

/* One solution near s->x: in a box of equal shares of the natural sizes, else in one that takes the shape of the image,
 * wide along what the equations hardly determine. Returns a reason. */
static inline int mwc_enclose(mwc_problem *p, mwc_solution *s)
{
    const int n = p->n;
    mw_ball J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS], z[MW_MAX_UNKNOWNS];
    double C[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], K[MW_MAX_UNKNOWNS];
    double *d = s->box;
    mwc_linearised(p, s->x, NULL, NULL, J);
    if (!mwc_inverse(n, J, C)) return MW_REASON_FOLD;
    mwc_refine(p, C, s->x);
    mwc_residual_at(p, s->x, R);
    mwc_shift(n, C, R, z);
    for (int i = 0; i < n; i++) d[i] = p->sizes[i] * MWC_FIRST_BOX;
    for (int step = 0; step < MWC_SHAPING_STEPS; step++) {
        mwc_linearised(p, s->x, d, NULL, J);
        mwc_defect(n, C, J, M);
        mwc_image(n, z, M, d, K);
        if (mwc_inside(n, K, d)) {
            mwc_narrow(n, z, M, K, s->within);
            return MW_REASON_NONE;
        }
        for (int i = 0; i < n; i++) {
            const double shift = mwc_abs(z[i].mid) + z[i].radius;
            d[i] = MWC_SHAPED(shift, K[i]);
            if (!(d[i] <= MWC_WIDEST_BOX * p->sizes[i])) return MW_REASON_FOLD;
        }
    }
    return MW_REASON_WIDE;
}

/* What shows the same again about the nearest doubles, with room for other roundings. Returns a reason. */
static inline int mwc_shown(mwc_problem *p, const mwc_solution *s, mw_proof *proof)
{
    const int n = p->n;
    mw_wide x[MW_MAX_UNKNOWNS];
    mw_ball J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS], z[MW_MAX_UNKNOWNS];
    double M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], K[MW_MAX_UNKNOWNS];
    memset(proof, 0, sizeof *proof);
    for (int i = 0; i < n; i++) {
        x[i] = mwc_wide_of(proof->centre[i] = s->x[i].hi);
        proof->box[i] = s->box[i] * MWC_SHOWN_BOX;
    }
    mwc_linearised(p, x, NULL, NULL, J);
    if (!mwc_inverse(n, J, proof->preconditioner)) return proof->reason = MW_REASON_FOLD;
    mwc_residual_at(p, x, R);
    mwc_shift(n, proof->preconditioner, R, z);
    mwc_linearised(p, x, proof->box, NULL, J);
    mwc_defect(n, proof->preconditioner, J, M);
    mwc_image(n, z, M, proof->box, K);
    for (int i = 0; i < n; i++)
        if (!(2.0 * K[i] < proof->box[i])) return proof->reason = MW_REASON_WIDE;
    mwc_narrow(n, z, M, K, proof->within);
    mwc_image(n, z, M, proof->within, K);
    for (int i = 0; i < n; i++) {
        const double shift = mwc_abs(z[i].mid) + z[i].radius;
        proof->within[i] = 2.0 * shift + MWC_SHOWN_WIDER * (K[i] - shift) + MWC_SHOWN_LEAST * p->sizes[i];
        if (!(proof->within[i] < proof->box[i])) return proof->reason = MW_REASON_WIDE;
    }
    proof->n = n;
    return MW_REASON_NONE;
}

static inline void mwc_known(mwc_problem *p, const mw_wide *from, int count)
{
    p->count = count;
    memcpy(p->arguments, from, sizeof(mw_wide) * (size_t)count);
    for (int i = 0; i < count; i++) p->balls[i] = mwc_of_wide(from[i]);
}

static inline int mwc_fits(const mw_code *code, int arguments)
{
    return code->registers <= MWC_REGISTERS && arguments <= MWC_ARGUMENTS;
}

#endif
