/* Follow one branch of contact over the input angle.  SPDX-License-Identifier: MIT-0 */
#include <math.h>
#include <string.h>
#include "branch.h"
#include "choice.h"
#include "newton.h"

enum { MAX_SPLITS = 12, ARC_STEPS = 32, ARC_PARTS = 16 };

/* In natural sizes of the unknowns: the longest step of a walk, and how far from its prediction a solution may lie and
 * still be of the branch. Flanks change over a natural size (a module, a radian), so a step of half of one is predicted
 * to a good part of it. */
static const double STRIDE = 0.5, BRANCH_WIDTH = 0.25;

/* Newton from a good prediction takes two or three steps. One that needs more crosses a place where the equations are
 * nearly singular, and only there can it come out on another branch. */
static const int USUAL_ITERATIONS = 4;

/* A step in arclength, natural sizes and rad. ARC_PARTS times ARC_STEPS of them lead off any flank. */
static const double ARC_STEP = 0.1;

static const double NUDGE = 1e-3; /* rad */

void mw_remember(mw_history *h, double phi, const double *x)
{
    for (int i = 0; i < MW_HISTORY; i++) { /* each moves on by one place */
        const double *older = h->x[i], before = h->phi[i];
        h->x[i] = x;
        h->phi[i] = phi;
        x = older;
        phi = before;
    }
    if (h->count < MW_HISTORY) h->count++;
}

/* Polynomial through the history, at phi. */
static void predict(const mw_history *h, double phi, int n, double *x)
{
    double weight[MW_HISTORY];
    const double d = phi - h->phi[0];
    int uniform = h->count == MW_HISTORY;
    for (int i = 1; uniform && i < MW_HISTORY; i++)
        uniform = fabs(h->phi[i - 1] - h->phi[i] - d) <= MW_EQUAL_SPACING * fabs(d);
    if (uniform) {
        for (int j = 0; j < n; j++)
            x[j] = MW_PREDICT_CUBIC(h->x[0][j], h->x[1][j], h->x[2][j], h->x[3][j]);
        return;
    }
    for (int i = 0; i < h->count; i++) {
        weight[i] = 1.0;
        for (int k = 0; k < h->count; k++)
            if (k != i) weight[i] *= (phi - h->phi[k]) / (h->phi[i] - h->phi[k]);
    }
    for (int j = 0; j < n; j++) {
        x[j] = 0.0;
        for (int i = 0; i < h->count; i++) x[j] += weight[i] * h->x[i][j];
    }
}

int mw_near(const mw_model *m, const double *s, const double *a, const double *b, double sizes)
{
    double scale[MW_MAX_UNKNOWNS];
    m->scale(s, scale);
    for (int i = 0; i < m->nx; i++)
        if (!(fabs(a[i] - b[i]) <= sizes * scale[i])) return 0;
    return 1;
}

/* Sign of the relative Gaussian curvature, 0 along a line of contact. Along a branch it changes only where the equations
 * are singular, or a flank is: of solutions that differ in it one is of another branch, or beyond such a place. */
static int bend(const mw_model *m, const double *s, const double *x)
{
    double o[MW_MAX_OBSERVATION];
    mw_contact c;
    mw_contact_at(m, s, x, o, &c);
    return c.line ? 0 : c.curvature_min * c.curvature_max > 0.0 ? 1 : -1;
}

void mw_take_direction(const mw_model *m, mw_history *h, double phi, double *s, double *beside)
{
    mw_info info;
    const double next = h->phi[0] + (phi > h->phi[0] ? NUDGE : -NUDGE);
    memset(&info, 0, sizeof info);
    memcpy(beside, h->x[0], sizeof(double) * (size_t)m->nx);
    m->set_phi(s, next);
    if (mw_refine(m, s, beside, &info) >= 0) mw_remember(h, next, beside);
}

/* Two solutions on the way, newest first, and the sign of curvature of their branch. */
typedef struct way {
    mw_history h;
    double x[2][MW_MAX_UNKNOWNS];
    int bend;
} way;

static void begin(const mw_model *m, const mw_history *from, double *s, way *w)
{
    memset(w, 0, sizeof *w);
    w->h.count = from->count > 1 ? 2 : 1;
    for (int i = 0; i < w->h.count; i++) {
        memcpy(w->x[i], from->x[i], sizeof(double) * (size_t)m->nx);
        w->h.x[i] = w->x[i];
        w->h.phi[i] = from->phi[i];
    }
    m->set_phi(s, w->h.phi[0]);
    w->bend = bend(m, s, w->x[0]);
}

static void advance(const mw_model *m, way *w, double phi, const double *x)
{
    memcpy(w->x[1], w->x[0], sizeof w->x[0]);
    memcpy(w->x[0], x, sizeof(double) * (size_t)m->nx);
    w->h = (mw_history){ 2, { w->x[0], w->x[1] }, { phi, w->h.phi[0] } };
}

/* One step to phi, to a solution of the same branch. */
static int stepped(const mw_model *m, const way *w, double phi, double *s, double *x, mw_info *info)
{
    double predicted[MW_MAX_UNKNOWNS];
    predict(&w->h, phi, m->nx, predicted);
    m->set_phi(s, phi);
    if (!mw_near(m, s, predicted, w->x[0], STRIDE)) return 0;
    memcpy(x, predicted, sizeof(double) * (size_t)m->nx);
    return mw_refine(m, s, x, info) >= 0 && mw_near(m, s, x, predicted, BRANCH_WIDTH) && bend(m, s, x) == w->bend;
}

/* Walk to phi in steps as small as the branch needs. Returns 0 where it takes too small ones. */
static int walked(const mw_model *m, way *w, double to, double *s, double *x, mw_info *info)
{
    double step = to - w->h.phi[0];
    const double smallest = ldexp(fabs(step) < STRIDE ? fabs(step) : STRIDE, -MAX_SPLITS);
    while (fabs(step) > smallest) {
        const double next = fabs(to - w->h.phi[0]) <= 1.0001 * fabs(step) ? to : w->h.phi[0] + step;
        if (!stepped(m, w, next, s, x, info)) {
            step *= 0.5;
            continue;
        }
        if (next == to) return 1;
        advance(m, w, next, x);
        step *= 2.0;
    }
    return 0;
}

/* Points of a stretch of branch in arclength. */
typedef struct arc {
    double phi[ARC_STEPS + 1], x[(ARC_STEPS + 1) * MW_MAX_UNKNOWNS], slope[ARC_STEPS + 1], determinant[ARC_STEPS + 1];
} arc;

/* Why the branch cannot be followed from x: the equations do not exist there, or nothing true can be said. */
static int stuck(const mw_model *m, double phi, double *s, double *x, mw_info *info)
{
    m->set_phi(s, phi);
    if (mw_refine(m, s, x, info) >= 0) info->status = MW_DIVERGED;
    return info->status;
}

/* Follow the branch in arclength towards `to`, through places where the angle cannot lead. Where it arrives, x and info
 * are the solution; else info->status says what became of the branch. */
static int along_arc(const mw_model *m, const way *w, double to, double *s, double *x, mw_info *info)
{
    arc a;
    double from = w->h.phi[0];
    const double sign = to > from ? 1.0 : -1.0;
    const size_t nx = (size_t)m->nx;
    memcpy(x, w->x[0], sizeof(double) * nx);
    for (int part = 0; part < ARC_PARTS; part++) {
        const size_t n = mw_arclength(m, s, from, x, sign * ARC_STEP, ARC_STEPS, a.phi, a.x, a.slope, a.determinant);
        for (size_t k = 1; k < n; k++) {
            if (!mw_within_bounds(m, a.x + k * nx)) return info->status = MW_LEFT_FLANK;
            if (sign * a.slope[k] <= 0.0) return info->status = MW_FOLD;
            if (sign * (a.phi[k] - to) < 0.0) continue;
            const double share = (to - a.phi[k - 1]) / (a.phi[k] - a.phi[k - 1]);
            for (size_t i = 0; i < nx; i++)
                x[i] = a.x[(k - 1) * nx + i] + share * (a.x[k * nx + i] - a.x[(k - 1) * nx + i]);
            m->set_phi(s, to);
            return mw_refine(m, s, x, info);
        }
        if (n < ARC_STEPS + 1) return stuck(m, from, s, x, info);
        from = a.phi[ARC_STEPS];
        memcpy(x, a.x + ARC_STEPS * nx, sizeof(double) * nx);
    }
    return info->status = MW_LEFT_FLANK;
}

int mw_leap(const mw_model *m, const mw_history *h, double phi, double *s, double *x, mw_info *info)
{
    memset(info, 0, sizeof *info);
    m->set_phi(s, phi);
    predict(h, phi, m->nx, x);
    return mw_near(m, s, x, h->x[0], STRIDE) && mw_newton_fused(m, s, x, MW_FUSED_TOLERANCE, info) &&
           info->iterations <= USUAL_ITERATIONS && mw_within_bounds(m, x);
}

int mw_walk(const mw_model *m, const mw_history *h, double phi, double *s, double *x, mw_info *info)
{
    way w;
    memset(info, 0, sizeof *info);
    begin(m, h, s, &w);
    if (walked(m, &w, phi, s, x, info)) return info->status;
    return along_arc(m, &w, phi, s, x, info);
}

size_t mw_follow(const mw_model *m, double *s, double phi0, const double *x0, const double *phi, size_t n, double *x,
                 mw_info *info)
{
    mw_history h;
    memset(&h, 0, sizeof h);
    mw_remember(&h, phi0, x0);
    for (size_t k = 0; k < n; k++, x += m->nx, info++) {
        if (phi[k] == h.phi[0]) {
            memcpy(x, h.x[0], sizeof(double) * (size_t)m->nx);
            memset(info, 0, sizeof *info);
            continue;
        }
        if (!mw_leap(m, &h, phi[k], s, x, info) && mw_walk(m, &h, phi[k], s, x, info) < 0) return k;
        mw_remember(&h, phi[k], x);
    }
    return n;
}
