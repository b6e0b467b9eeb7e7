/* Search the flanks for a contact that bodies can make.  SPDX-License-Identifier: MIT-0
 *
 * The equations also hold at saddles of the gap, past undercut lines and on spurious sheets. Places spread over the wheel
 * flank are brought onto the pinion flank one by one (position only) and refined, from the middle outwards, until a
 * contact on both flanks is found in which the teeth overlap nowhere on a face as wide as that contact needs. */
#include <math.h>
#include <string.h>
#include "choice.h"
#include "linear.h"

enum { MAX_TOUCH = 20, MAX_RIDGE = 12, SECTIONS = 24 };

/* Starts in natural sizes of the wheel flank's parameters, from the middle outwards. The size along the profile is a
 * module (or its share of the tool's size): the teeth reach two modules and their clearance below the tip. The size
 * across it is a radian of the rack angle (or its share of the face): a wheel wraps no more than about 70 degrees. */
static const double ALONG[] = { 0.0, -0.8, 0.8, -1.6, 1.6, -2.4 };
static const double ACROSS[] = { 0.0, 0.08, -0.08, 0.16, -0.16, 0.24, -0.24, 0.34, -0.34,
                                 0.46, -0.46, 0.6, -0.6 };

/* A tangency further from the middle than the starts and a half of that again was not looked for, but come upon. */
static const double REACH_ALONG = 1.5 * 2.4, REACH_ACROSS = 1.5 * 0.6;

/* Newton on positions: no step longer than SHORT natural sizes, done when below CLOSE, hopeless above FAR. */
static const double SHORT = 0.7, CLOSE = 1e-9, FAR = 1e6, RANK = 1e-12;

/* A section's ridge is found to this part of a natural size: the error it leaves in the angle is its square. */
static const double RIDGE_DONE = 1e-6, RIDGE_NUDGE = 1e-3, RIDGE_STEP = 0.25;

/* Wheel angles nearer than this are one, rad: two contacts of a tooth may share the load exactly. */
static const double SAME_ANGLE = 1e-11;

mw_worth mw_worth_of(const mw_model *m, const double *s, const double *x)
{
    double o[MW_MAX_OBSERVATION];
    mw_contact c;
    const char *flag;
    if (mw_contact_at(m, s, x, o, &c) == MW_LINE_CONTACT) return MW_OF_A_LINE;
    if (!(c.curvature_min > 0.0)) return MW_IMPOSSIBLE;
    for (int bit = 0; (flag = mw_flag(m, bit)) != NULL; bit++)
        if ((c.flags >> bit & 1u) && mw_impossible(flag)) return MW_IMPOSSIBLE;
    return c.flags ? MW_BEYOND_LIMITS : MW_ON_BOTH_FLANKS;
}

/* What the search needs of a model at one angle; the middle of the flanks is that of the start values. */
typedef struct field {
    const mw_model *m;
    const double *s;
    int along, across;           /* the wheel flank's parameters among the unknowns */
    double scale[MW_MAX_UNKNOWNS], middle[MW_MAX_UNKNOWNS];
} field;

/* Solve "this point of the wheel lies on the pinion": positions and the pinion's own conditions, against the pinion's
 * parameters and the transmission error. *slope is then that of the error along the wheel's profile, a natural size. */
static int touch(const field *f, double *x, double *slope)
{
    const mw_model *m = f->m;
    const mw_body *pinion = &m->bodies[0];
    const int n = 3 + pinion->conditions;
    double R[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], size[MW_MAX_UNKNOWNS], step[MW_MAX_UNKNOWNS];
    double A[2][MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], b[2][MW_MAX_UNKNOWNS], gap;
    for (int k = 0; k < MAX_TOUCH; k++) {
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
        if (mw_linear_solve(n, A[0], b[0], size, RANK, step, &gap) < n) return 0;
        for (int j = 0; j < n; j++)
            if (!(fabs(step[j]) / size[j] <= most)) most = fabs(step[j]) / size[j];
        if (!(most < FAR)) return 0;
        const double factor = most > SHORT ? SHORT / most : 1.0;
        for (int j = 0; j < n; j++) x[j < n - 1 ? pinion->unknowns[j] : m->error] -= factor * step[j];
        if (most < CLOSE) {
            mw_linear_solve(n, A[1], b[1], size, RANK, step, &gap);
            *slope = step[n - 1];
            return 1;
        }
    }
    return 0;
}

/* Move x along the wheel's profile, the place across it unchanged, to where the profile touches the pinion first. */
static int to_ridge(const field *f, double *x)
{
    double slope, before, step = RIDGE_NUDGE;
    if (!touch(f, x, &before)) return 0;
    for (int k = 0; k < MAX_RIDGE; k++) {
        x[f->along] += step * f->scale[f->along];
        if (!touch(f, x, &slope)) return 0;
        if (fabs(step) < RIDGE_DONE) return 1;
        const double next = -slope * step / (slope - before);
        if (!(fabs(next) < HUGE_VAL)) return 0;
        before = slope;
        step = fabs(next) < RIDGE_STEP ? next : copysign(RIDGE_STEP, next);
    }
    return 0;
}

static int on_both_flanks(const field *f, const double *x)
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
static int overlaps(const field *f, const double *x)
{
    double at[MW_MAX_UNKNOWNS], beside[MW_MAX_UNKNOWNS], slope;
    const int error = f->m->error;
    const size_t size = sizeof(double) * (size_t)f->m->nx;
    const double step = 2.0 * (f->middle[f->across] - x[f->across]) / (double)SECTIONS;
    memcpy(beside, x, size);
    beside[f->along] += RIDGE_STEP * f->scale[f->along];
    if (!touch(f, beside, &slope)) return 0;
    const double sense = beside[error] < x[error] ? 1.0 : -1.0;
    memcpy(at, x, size);
    for (int k = 1; k <= SECTIONS; k++) {
        at[f->across] = x[f->across] + k * step;
        if (!to_ridge(f, at) || !on_both_flanks(f, at)) return 0; /* here the flank ends */
        if (sense * (at[error] - x[error]) > SAME_ANGLE) return 1;
    }
    return 0;
}

static int within_reach(const field *f, const double *x)
{
    return fabs(x[f->along] - f->middle[f->along]) <= REACH_ALONG * f->scale[f->along] &&
           fabs(x[f->across] - f->middle[f->across]) <= REACH_ACROSS * f->scale[f->across];
}

int mw_search(const mw_model *m, const double *s, double *x, mw_info *info)
{
    const mw_body *wheel = &m->bodies[1];
    field f = { m, s, wheel->unknowns[0], wheel->unknowns[1], { 0.0 }, { 0.0 } };
    double trial[MW_MAX_UNKNOWNS], slope;
    mw_info attempt;
    if (3 + m->bodies[0].conditions > m->nx || wheel->parameters != 2) return 0;
    m->scale(s, f.scale);
    mw_start_values(m, s, f.middle, &attempt);
    for (size_t a = 0; a < sizeof ACROSS / sizeof ACROSS[0]; a++)
        for (size_t b = 0; b < sizeof ALONG / sizeof ALONG[0]; b++) {
            memcpy(trial, f.middle, sizeof trial);
            trial[f.along] += ALONG[b] * f.scale[f.along];
            trial[f.across] += ACROSS[a] * f.scale[f.across];
            if (!touch(&f, trial, &slope) || mw_refine(m, s, trial, &attempt) < 0) continue;
            if (!within_reach(&f, trial)) continue;
            const mw_worth worth = mw_worth_of(m, s, trial);
            if (worth < MW_ON_BOTH_FLANKS || (worth == MW_ON_BOTH_FLANKS && overlaps(&f, trial))) continue;
            memcpy(x, trial, sizeof(double) * (size_t)m->nx);
            *info = attempt;
            return 1;
        }
    return 0;
}
