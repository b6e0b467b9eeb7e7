/* What the scalar trace and the lane trace have in common.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_STEPS_H
#define MWI_STEPS_H

#include "../mw_device.h"

/* Points from which the next one is predicted, the tolerance for "equally spaced", and the prediction then. */
enum { MW_HISTORY = 4, MW_MAX_FUSED = 12 };
static const double MW_EQUAL_SPACING = 1e-9;
#define MW_PREDICT_CUBIC(x0, x1, x2, x3) (4.0 * ((x0) + (x2)) - (6.0 * (x1) + (x3)))

/* Steps are sums over the unknowns in units of their natural size. */
static const double MW_FUSED_TOLERANCE = 1e-8; /* the step after one this small is below round-off */
static const double MW_STEP_LIMIT = 0.7;       /* a longer step leads to another branch */

/* Angles that lie further apart than a lane follows a contact, rad, are reached over others between: where there are no more
 * than so many altogether. */
static const double MW_LANE_STRIDE = 0.05;
enum { MW_MOST_BETWEEN = 512 };

/* Into how many parts the way from each of n angles to the next is divided. */
MW_DEVICE static inline int mwi_parts_of(const double *phi, int n)
{
    double widest = 0.0;
    for (int i = 1; i < n; i++) {
        const double apart = phi[i] < phi[i - 1] ? phi[i - 1] - phi[i] : phi[i] - phi[i - 1];
        if (apart > widest) widest = apart;
    }
    const double parts = widest / MW_LANE_STRIDE;
    if (!(parts < (double)MW_MOST_BETWEEN)) return 1;
    const int whole = (int)parts + ((double)(int)parts < parts);
    return whole > 1 && whole * (n - 1) < MW_MOST_BETWEEN ? whole : 1;
}

/* Angle number k of those with so many parts between each two. */
MW_DEVICE static inline double mwi_angle_between(const double *phi, int parts, int k)
{
    const int at = k / parts, part = k % parts;
    return part ? phi[at] + (phi[at + 1] - phi[at]) * (double)part / (double)parts : phi[at];
}

#endif
