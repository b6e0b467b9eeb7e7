/* Search for a contact that bodies can make.  SPDX-License-Identifier: MIT-0
 *
 * The equations also hold at saddles of the gap, past undercut lines and on spurious sheets. Where a cold start ends
 * there, or nowhere, points spread over the wheel flank are brought onto the pinion flank one by one (position only)
 * and refined, until a regular contact without interference and within all limits is found. */
#include <math.h>
#include <string.h>
#include "linear.h"
#include "refine.h"

enum { MAX_MATCH = 20 };

/* What a solution is worth, ascending. */
enum { FAILED, IMPOSSIBLE, OFF_LIMITS, REGULAR };

/* Spread of the starts in natural sizes: along the profile, and across it. */
static const double ALONG[] = { 0.0, -0.8, 0.8, -1.6, 1.6, -2.4 };
static const double ACROSS[] = { 0.0, 0.08, -0.08, 0.16, -0.16, 0.24, -0.24, 0.34, -0.34,
                                 0.46, -0.46, 0.6, -0.6 };

/* A solution further from the start than this is another place of the flank, or none. */
static const double REACH_ALONG = 4.0, REACH_ACROSS = 0.8;

static int worth(const mw_model *m, const double *s, const double *x, const mw_info *info)
{
    double o[MW_MAX_OBSERVATION];
    mw_contact c;
    if (info->status < 0) return FAILED;
    if (mw_contact_at(m, s, x, o, &c) == MW_LINE_CONTACT) return REGULAR;
    if (!(c.curvature_min > 0.0)) return IMPOSSIBLE;
    const char *name;
    for (int bit = 0; (name = mw_flag(m, bit)) != NULL; bit++)
        if ((c.flags >> bit & 1u) && (bit < 2 || strcmp(name, "spurious_sheet") == 0)) return IMPOSSIBLE;
    return c.flags ? OFF_LIMITS : REGULAR;
}

/* Equations and unknowns of "this point of the wheel lies on the pinion": positions and the pinion's own conditions
 * against the pinion's parameters and the transmission error. */
static int match(const mw_model *m, const double *s, const double *scale, double *x)
{
    const mw_body *pinion = &m->bodies[0];
    const int n = 3 + pinion->conditions;
    double R[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS];
    double A[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], b[MW_MAX_UNKNOWNS], step[MW_MAX_UNKNOWNS], size[MW_MAX_UNKNOWNS];
    double gap;
    for (int k = 0; k < MAX_MATCH; k++) {
        double most = 0.0;
        m->eval(s, x, R, J);
        for (int i = 0; i < n; i++) {
            const int row = i < 3 ? i : i + 2; /* two tangency equations stand between */
            for (int j = 0; j < n; j++) {
                const int column = j < n - 1 ? pinion->unknowns[j] : m->error;
                A[i * n + j] = J[row * m->nx + column];
                size[j] = scale[column];
            }
            b[i] = R[row];
        }
        if (mw_linear_solve(n, A, b, size, 1e-12, step, &gap) < n) return 0;
        for (int j = 0; j < n; j++)
            if (!(fabs(step[j]) / size[j] <= most)) most = fabs(step[j]) / size[j];
        if (!(most < 1e6)) return 0;
        const double factor = most > 0.7 ? 0.7 / most : 1.0;
        for (int j = 0; j < n; j++) x[j < n - 1 ? pinion->unknowns[j] : m->error] -= factor * step[j];
        if (most < 1e-6) return 1;
    }
    return 0;
}

void mw_search(const mw_model *m, const double *s, const double *x0, double *x, mw_info *info)
{
    double scale[MW_MAX_UNKNOWNS], trial[MW_MAX_UNKNOWNS];
    const mw_body *wheel = &m->bodies[1];
    int best = worth(m, s, x, info), left = !mw_within_bounds(m, x);
    if (best >= OFF_LIMITS || 3 + m->bodies[0].conditions > m->nx || wheel->parameters != 2) return;
    m->scale(s, scale);
    for (size_t a = 0; a < sizeof ACROSS / sizeof ACROSS[0]; a++)
        for (size_t b = 0; b < sizeof ALONG / sizeof ALONG[0]; b++) {
            const int along = wheel->unknowns[0], across = wheel->unknowns[1];
            mw_info attempt;
            memcpy(trial, x0, sizeof(double) * (size_t)m->nx);
            trial[along] += ALONG[b] * scale[along];
            trial[across] += ACROSS[a] * scale[across];
            if (!match(m, s, scale, trial)) continue;
            mw_refine(m, s, trial, &attempt);
            attempt.iterations += info->iterations;
            left |= attempt.status == MW_LEFT_FLANK;
            if (!(fabs(trial[along] - x0[along]) <= REACH_ALONG * scale[along]) ||
                !(fabs(trial[across] - x0[across]) <= REACH_ACROSS * scale[across])) continue;
            const int found = worth(m, s, trial, &attempt);
            if (best == FAILED ? found > best : found == REGULAR) {
                best = found;
                memcpy(x, trial, sizeof(double) * (size_t)m->nx);
                *info = attempt;
            }
            if (best == REGULAR) return;
        }
    if (best == FAILED && info->status == MW_DIVERGED) info->status = left ? MW_LEFT_FLANK : MW_NO_CONTACT;
}
