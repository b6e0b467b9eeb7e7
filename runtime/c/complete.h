/* Solution of a design system.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_COMPLETE_H
#define MW_COMPLETE_H

#include "meshwright.h"

/* Follow one system from its guess along its path, the last of q[np + 1]. y[system->n] is zero before. Negative if the
 * path breaks off or leaves the regular part. */
int mw_solve_system(const mw_model *m, const mw_system *system, double *q, double *y, mw_info *info);

#endif
