/* Parts of the choice of a contact: see "Which contact" in meshwright.h.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_CHOICE_H
#define MW_CHOICE_H

#include "meshwright.h"

/* Whether every unknown lies within its bounds: outside there is no flank. */
int mw_within_bounds(const mw_model *m, const double *x);

/* Start values x[nx] in the middle of the flanks, from the model's start system, or from its first guess where that has
 * no solution. State s is set up. Returns the status of the start system. */
int mw_start_values(const mw_model *m, const double *s, double *x, mw_info *info);

/* The tangency that Newton reaches from the start values, misalignments applied by continuation where it must be; s is
 * left set up for p and phi, work[np]. Returns info->status. */
int mw_start(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info);

/* What a tangency is worth: bodies cannot make it; they can, beyond a limit of a flank; they can, on both flanks; it is
 * one of a line of them. */
typedef enum mw_worth { MW_IMPOSSIBLE, MW_BEYOND_LIMITS, MW_ON_BOTH_FLANKS, MW_OF_A_LINE } mw_worth;

mw_worth mw_worth_of(const mw_model *m, const double *s, const double *x);

/* Look over the wheel flank for a contact on both flanks that bodies can make. Writes x and info and returns 1 if there
 * is one. State s is set up. */
int mw_search(const mw_model *m, const double *s, double *x, mw_info *info);

#endif
