/* Follow one branch of contact over the input angle.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_BRANCH_H
#define MW_BRANCH_H

#include "meshwright.h"
#include "trace.h"

/* The last points solved, newest first; x points to nx numbers each. */
typedef struct mw_history {
    int count;
    const double *x[MW_HISTORY];
    double phi[MW_HISTORY];
} mw_history;

void mw_remember(mw_history *h, double phi, const double *x);

/* Continue the branch of h to phi in one step: x[nx] and info. Returns 0 where that does not succeed. Beside a place where
 * the equations are singular the step may come out on another branch. */
int mw_leap(const mw_model *m, const mw_history *h, double phi, double *s, double *x, mw_info *info);

/* Continue the branch of h to phi in steps as small as it needs: x[nx] and info. Negative, with the reason, if the branch
 * does not reach phi. s is set up; it is left at phi or on the way to it. */
int mw_walk(const mw_model *m, const mw_history *h, double phi, double *s, double *x, mw_info *info);

/* Whether a and b lie within so many natural sizes of each other. */
int mw_near(const mw_model *m, const double *s, const double *a, const double *b, double sizes);

/* Give a history of one point a second one close by, near[nx], on the side of phi, so that it has a direction: a point
 * alone predicts itself, and a pitch further on that is the contact of the neighbouring pair. */
void mw_take_direction(const mw_model *m, mw_history *h, double phi, double *s, double *near);

#endif
