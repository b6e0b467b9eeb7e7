/* Small dense linear algebra with complete pivoting.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_LINEAR_H
#define MW_LINEAR_H

/* Solve A x = b (n <= MW_MAX_UNKNOWNS, A row-major, both overwritten) after scaling columns by scale[n] and rows by
 * their largest entry. Directions whose pivot falls below tolerance times the largest are left out (their x is 0).
 * Returns the rank; *gap = last pivot over first. */
int mw_linear_solve(int n, double *A, double *b, const double *scale, double tolerance, double *x, double *gap);

#endif
