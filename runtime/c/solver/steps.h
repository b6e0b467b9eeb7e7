/* What the scalar trace and the lane trace have in common.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_STEPS_H
#define MWI_STEPS_H

/* Points from which the next one is predicted, the tolerance for "equally spaced", and the prediction then. */
enum { MW_HISTORY = 4, MW_MAX_FUSED = 12 };
static const double MW_EQUAL_SPACING = 1e-9;
#define MW_PREDICT_CUBIC(x0, x1, x2, x3) (4.0 * ((x0) + (x2)) - (6.0 * (x1) + (x3)))

/* Steps are sums over the unknowns in units of their natural size. */
static const double MW_FUSED_TOLERANCE = 1e-8; /* the step after one this small is below round-off */
static const double MW_STEP_LIMIT = 0.7;       /* a longer step leads to another branch */

#endif
