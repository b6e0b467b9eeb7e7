/* Newton iterations on one system of equations.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_NEWTON_H
#define MW_NEWTON_H

#include "meshwright.h"

typedef void (*mw_equations)(const double *s, const double *x, double *R, double *J);

/* Newton with complete pivoting, limited steps and a rank decision. scale[n]: natural size of each unknown. */
int mw_newton(mw_equations f, int n, const double *s, const double *scale, double *x, mw_info *info);

/* Newton by the model's fused step: the fast way near a solution. Returns 0 if it should be done again by
 * mw_newton, 1 if info holds the answer. */
int mw_newton_fused(const mw_model *m, const double *s, double *x, double tolerance, mw_info *info);

#endif
