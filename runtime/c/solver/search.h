/* Search the flanks for a contact that bodies can make.  SPDX-License-Identifier: MIT-0
 *
 * The equations also hold at saddles of the gap, past undercut lines and on spurious sheets. Places spread over the wheel
 * flank are brought onto the pinion flank one by one (position only) and refined, from the middle outwards, until a
 * contact on both flanks is found in which the teeth overlap nowhere on a face as wide as that contact needs. */
#if !defined(MWI_SEARCH_H) && !defined(MW_DEVICE_ONLY)
#define MWI_SEARCH_H

#include "start.h"

enum { MWI_SEARCH_MAX_TOUCH = 20, MWI_SEARCH_MAX_RIDGE = 12, MWI_SEARCH_SECTIONS = 24 };

/* Starts in natural sizes of the wheel flank's parameters, from the middle outwards. The size along the profile is a
 * module (or its share of the tool's size): the teeth reach two modules and their clearance below the tip. The size
 * across it is a radian of the rack angle (or its share of the face): a wheel wraps no more than about 70 degrees. */
static const double MWI_SEARCH_ALONG[] = { 0.0, -0.8, 0.8, -1.6, 1.6, -2.4 };
static const double MWI_SEARCH_ACROSS[] = { 0.0, 0.08, -0.08, 0.16, -0.16, 0.24, -0.24, 0.34, -0.34,
                                 0.46, -0.46, 0.6, -0.6 };

/* A tangency further from the middle than the starts and a half of that again was not looked for, but come upon. */
static const double MWI_SEARCH_REACH_ALONG = 1.5 * 2.4, MWI_SEARCH_REACH_ACROSS = 1.5 * 0.6;

/* Newton on positions: no step longer than MWI_SEARCH_SHORT natural sizes, done when below MWI_SEARCH_CLOSE, hopeless above MWI_SEARCH_FAR. */
static const double MWI_SEARCH_SHORT = 0.7, MWI_SEARCH_CLOSE = 1e-9, MWI_SEARCH_FAR = 1e6, MWI_SEARCH_RANK = 1e-12;

/* A section's ridge is found to this part of a natural size: the error it leaves in the angle is its square. */
static const double MWI_SEARCH_RIDGE_DONE = 1e-6, MWI_SEARCH_RIDGE_NUDGE = 1e-3, MWI_SEARCH_RIDGE_STEP = 0.25;

/* Wheel angles nearer than this are one, rad: two contacts of a tooth may share the load exactly. */
static const double MWI_SEARCH_SAME_ANGLE = 1e-11;

static inline mwi_worth mwi_worth_of(const mw_model *m, const double *s, const double *x)
{
    double o[MW_MAX_OBSERVATION];
    mw_contact c;
    mwi_contact_at(m, s, x, o, &c);
    return mwi_worth_in(m, &c);
}

/* What the search needs of a model at one angle; the middle of the flanks is that of the start values. */
typedef struct mwi_search_field {
    const mw_model *m;
    const double *s;
    int along, across;           /* the wheel flank's parameters among the unknowns */
    double scale[MW_MAX_UNKNOWNS], middle[MW_MAX_UNKNOWNS];
} mwi_search_field;

/* Solve "this point of the wheel lies on the pinion": positions and the pinion's own conditions, against the pinion's
 * parameters and the transmission error. *slope is then that of the error along the wheel's profile, a natural size. */
static inline int mwi_search_touch(const mwi_search_field *f, double *x, double *slope)
{
    const mw_model *m = f->m;
    const mw_body *pinion = &m->bodies[0];
    const int n = 3 + pinion->conditions;
    double R[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], size[MW_MAX_UNKNOWNS], step[MW_MAX_UNKNOWNS];
    double A[2][MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], b[2][MW_MAX_UNKNOWNS], gap;
    for (int k = 0; k < MWI_SEARCH_MAX_TOUCH; k++) {
        double most = 0.0;
        m->eval(f->s, x, R, J);
        for (int i = 0; i < n; i++) {
            const int row = i < 3 ? i : i + 2; /* two tangency equations stand between */
            for (int j = 0; j < n; j++) {
                const int column = j < n - 1 ? pinion->unknowns[j] : m->error;
                A[0][i * n + j] = A[1][i * n + j] = J[row * m->nx + column];
                size[j] = f->scale[column];
            }
            b[0][i] = R[row];
            b[1][i] = -J[row * m->nx + f->along] * f->scale[f->along];
        }
        if (mwi_linear_solve(n, A[0], b[0], size, MWI_SEARCH_RANK, step, &gap) < n) return 0;
        for (int j = 0; j < n; j++)
            if (!(mwi_abs(step[j]) / size[j] <= most)) most = mwi_abs(step[j]) / size[j];
        if (!(most < MWI_SEARCH_FAR)) return 0;
        const double factor = most > MWI_SEARCH_SHORT ? MWI_SEARCH_SHORT / most : 1.0;
        for (int j = 0; j < n; j++) x[j < n - 1 ? pinion->unknowns[j] : m->error] -= factor * step[j];
        if (most < MWI_SEARCH_CLOSE) {
            mwi_linear_solve(n, A[1], b[1], size, MWI_SEARCH_RANK, step, &gap);
            *slope = step[n - 1];
            return 1;
        }
    }
    return 0;
}

/* Move x along the wheel's profile, the place across it unchanged, to where the profile touches the pinion first. */
static inline int mwi_search_to_ridge(const mwi_search_field *f, double *x)
{
    double slope, before, step = MWI_SEARCH_RIDGE_NUDGE;
    if (!mwi_search_touch(f, x, &before)) return 0;
    for (int k = 0; k < MWI_SEARCH_MAX_RIDGE; k++) {
        x[f->along] += step * f->scale[f->along];
        if (!mwi_search_touch(f, x, &slope)) return 0;
        if (mwi_abs(step) < MWI_SEARCH_RIDGE_DONE) return 1;
        const double next = -slope * step / (slope - before);
        if (!(mwi_abs(next) < HUGE_VAL)) return 0;
        before = slope;
        step = mwi_abs(next) < MWI_SEARCH_RIDGE_STEP ? next : next < 0.0 ? -MWI_SEARCH_RIDGE_STEP : MWI_SEARCH_RIDGE_STEP;
    }
    return 0;
}

static inline int mwi_search_on_both_flanks(const mwi_search_field *f, const double *x)
{
    double o[MW_MAX_OBSERVATION];
    f->m->observe(f->s, x, o);
    for (int b = 0; b < 2; b++) {
        const mw_body *body = &f->m->bodies[b];
        if (o[body->regular] < 0.0) return 0;
        for (int i = 0; i < body->margins; i++)
            if (o[body->margin + i] < 0.0) return 0;
    }
    return 1;
}

/* Whether the teeth, touching in x, overlap on the face between x and its mirror place beyond the middle: a wheel's face
 * is as wide on the one side as on the other. Sections of the face are compared by the wheel angle at which each
 * touches; that of a contact is the extreme of its surroundings. */
static inline int mwi_search_overlaps(const mwi_search_field *f, const double *x)
{
    double at[MW_MAX_UNKNOWNS], beside[MW_MAX_UNKNOWNS], slope;
    const int error = f->m->error;
    const int nx = f->m->nx;
    const double step = 2.0 * (f->middle[f->across] - x[f->across]) / (double)MWI_SEARCH_SECTIONS;
    mwi_copy(beside, x, nx);
    beside[f->along] += MWI_SEARCH_RIDGE_STEP * f->scale[f->along];
    if (!mwi_search_touch(f, beside, &slope)) return 0;
    const double sense = beside[error] < x[error] ? 1.0 : -1.0;
    mwi_copy(at, x, nx);
    for (int k = 1; k <= MWI_SEARCH_SECTIONS; k++) {
        at[f->across] = x[f->across] + k * step;
        if (!mwi_search_to_ridge(f, at) || !mwi_search_on_both_flanks(f, at)) return 0; /* here the flank ends */
        if (sense * (at[error] - x[error]) > MWI_SEARCH_SAME_ANGLE) return 1;
    }
    return 0;
}

static inline int mwi_search_within_reach(const mwi_search_field *f, const double *x)
{
    return mwi_abs(x[f->along] - f->middle[f->along]) <= MWI_SEARCH_REACH_ALONG * f->scale[f->along] &&
           mwi_abs(x[f->across] - f->middle[f->across]) <= MWI_SEARCH_REACH_ACROSS * f->scale[f->across];
}

/* Look over the wheel flank for a contact on both flanks that bodies can make. Writes x and info and returns 1 if there
 * is one. State s is set up. */
static inline int mwi_search(const mw_model *m, const double *s, double *x, mw_info *info)
{
    const mw_body *wheel = &m->bodies[1];
    mwi_search_field f;
    double trial[MW_MAX_UNKNOWNS], slope;
    mw_info attempt;
    if (3 + m->bodies[0].conditions > m->nx || wheel->parameters != 2) return 0;
    f.m = m, f.s = s, f.along = wheel->unknowns[0], f.across = wheel->unknowns[1];
    m->scale(s, f.scale);
    mwi_start_values(m, s, f.middle, &attempt);
    for (size_t a = 0; a < sizeof MWI_SEARCH_ACROSS / sizeof MWI_SEARCH_ACROSS[0]; a++)
        for (size_t b = 0; b < sizeof MWI_SEARCH_ALONG / sizeof MWI_SEARCH_ALONG[0]; b++) {
            mwi_copy(trial, f.middle, m->nx);
            trial[f.along] += MWI_SEARCH_ALONG[b] * f.scale[f.along];
            trial[f.across] += MWI_SEARCH_ACROSS[a] * f.scale[f.across];
            if (!mwi_search_touch(&f, trial, &slope) || mwi_refine(m, s, trial, &attempt) < 0) continue;
            if (!mwi_search_within_reach(&f, trial)) continue;
            const mwi_worth worth = mwi_worth_of(m, s, trial);
            if (worth < MWI_ON_BOTH_FLANKS || (worth == MWI_ON_BOTH_FLANKS && mwi_search_overlaps(&f, trial))) continue;
            mwi_copy(x, trial, m->nx);
            *info = attempt;
            return 1;
        }
    return 0;
}

#endif
