/* Parts of a cold start: what a solution is worth, and where else to look.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_REFINE_H
#define MW_REFINE_H

#include "meshwright.h"

/* Whether every unknown lies within its bounds: outside there is no flank. */
int mw_within_bounds(const mw_model *m, const double *x);

/* From the best known contact of a cold start (x, info; info->status < 0 if none) look for a better one: a regular
 * contact without interference. Starts are spread over the wheel flank about x0. State s is set up. */
void mw_search(const mw_model *m, const double *s, const double *x0, double *x, mw_info *info);

#endif
