/* Trace contact along the input angle.  SPDX-License-Identifier: MIT-0 */
#include <math.h>
#include <string.h>
#include "newton.h"
#include "refine.h"
#include "trace.h"

enum { HISTORY = MW_HISTORY, MAX_SPLITS = 12 };

static const double BRANCH_WIDTH = 0.5; /* in natural sizes of the unknowns */
static const double FOLD_GAP = 1e-6;
static const double NUDGE = 1e-3; /* rad */

/* The last points solved, newest first. */
typedef struct history {
    int count;
    const double *x[HISTORY];
    double phi[HISTORY];
} history;

static void remember(history *h, double phi, const double *x)
{
    for (int i = HISTORY - 1; i > 0; i--) {
        h->x[i] = h->x[i - 1];
        h->phi[i] = h->phi[i - 1];
    }
    h->x[0] = x;
    h->phi[0] = phi;
    if (h->count < HISTORY) h->count++;
}

/* Polynomial through the history, at phi. */
static void predict(const history *h, double phi, int n, double *x)
{
    double weight[HISTORY];
    const double d = phi - h->phi[0];
    int uniform = h->count == HISTORY;
    for (int i = 1; uniform && i < HISTORY; i++)
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

/* Newton from a prediction; a solution further than one natural size from it belongs to another branch. */
static int refine_near(const mw_model *m, const double *s, double *x, mw_info *info)
{
    double before[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    for (int i = 0; i < m->nx; i++) before[i] = x[i];
    if (mw_refine(m, s, x, info) < 0) return info->status;
    m->scale(s, scale);
    for (int i = 0; i < m->nx; i++)
        if (fabs(x[i] - before[i]) > BRANCH_WIDTH * scale[i]) info->status = MW_NO_CONTACT;
    return info->status;
}

/* Give a history of one point a second one close by, on the side of phi, so that it has a direction: a point alone
 * predicts itself, and a pitch further on that is the contact of the neighbouring pair. */
static void take_direction(const mw_model *m, history *h, double phi, double *s, double *near)
{
    mw_info info;
    const double next = h->phi[0] + (phi > h->phi[0] ? NUDGE : -NUDGE);
    memset(&info, 0, sizeof info);
    memcpy(near, h->x[0], sizeof(double) * (size_t)m->nx);
    m->set_phi(s, next);
    if (mw_refine(m, s, near, &info) >= 0) remember(h, next, near);
}

/* Walk from the newest points of the history to phi in steps as small as Newton needs. Steps that keep failing where
 * the Jacobian degenerates mean that the branch turns back. */
static int walk(const mw_model *m, const history *from, double to, double *s, double *x, mw_info *info)
{
    double good[2][MW_MAX_UNKNOWNS];
    history h = { from->count > 1 ? 2 : 1, { good[0], good[1] }, { from->phi[0], from->phi[1] } };
    double step = to - from->phi[0];
    for (int i = 0; i < h.count; i++) memcpy(good[i], from->x[i], sizeof(double) * (size_t)m->nx);
    for (int splits = 0; splits <= MAX_SPLITS;) {
        const double next = fabs(to - h.phi[0]) <= 1.0001 * fabs(step) ? to : h.phi[0] + step;
        predict(&h, next, m->nx, x);
        m->set_phi(s, next);
        if (refine_near(m, s, x, info) < 0) {
            step *= 0.5;
            splits++;
            continue;
        }
        if (next == to) return info->status;
        memcpy(good[1], good[0], sizeof good[0]);
        memcpy(good[0], x, sizeof(double) * (size_t)m->nx);
        h = (history){ 2, { good[0], good[1] }, { next, h.phi[0] } };
    }
    if (info->rank_gap < FOLD_GAP && info->status != MW_LEFT_FLANK) info->status = MW_FOLD;
    return info->status;
}

/* From the history: predicted and refined, then walked to. Negative if the branch does not reach phi. */
static int continue_branch(const mw_model *m, const history *h, double phi, double *s, double *x, mw_info *info)
{
    memset(info, 0, sizeof *info);
    m->set_phi(s, phi);
    predict(h, phi, m->nx, x);
    if (mw_newton_fused(m, s, x, MW_FUSED_TOLERANCE, info) && mw_within_bounds(m, x)) return info->status;
    return walk(m, h, phi, s, x, info);
}

size_t mw_trace(const mw_model *m, const double *p, const double *phi, size_t n, double *s, double *work, double *x,
                mw_info *info)
{
    history h;
    double near[MW_MAX_UNKNOWNS];
    size_t succeeded = 0;
    memset(&h, 0, sizeof h);
    const int guard = m->setup(p, s);
    for (size_t k = 0; k < n; k++, x += m->nx, info++) {
        int lost = 0;
        if (guard) {
            memset(info, 0, sizeof *info);
            info->guard = guard;
            info->status = MW_BAD_INPUT;
            continue;
        }
        if (h.count == 1) take_direction(m, &h, phi[k], s, near);
        if (h.count > 0) lost = continue_branch(m, &h, phi[k], s, x, info);
        if (h.count == 0 || lost < 0) {
            h.count = 0;
            if (mw_solve(m, p, phi[k], s, work, x, info) < 0) {
                if (lost < 0) info->status = lost;
                continue;
            }
        }
        /* a point of a contact line is arbitrary: it predicts nothing */
        if (info->status == MW_LINE_CONTACT) h.count = 0;
        else remember(&h, phi[k], x);
        succeeded++;
    }
    return succeeded;
}

size_t mw_follow(const mw_model *m, double *s, double phi0, const double *x0, const double *phi, size_t n, double *x,
                 mw_info *info)
{
    history h;
    memset(&h, 0, sizeof h);
    remember(&h, phi0, x0);
    for (size_t k = 0; k < n; k++, x += m->nx, info++) {
        if (phi[k] == h.phi[0]) {
            memcpy(x, h.x[0], sizeof(double) * (size_t)m->nx);
            memset(info, 0, sizeof *info);
            continue;
        }
        if (continue_branch(m, &h, phi[k], s, x, info) < 0) return k;
        remember(&h, phi[k], x);
    }
    return n;
}
