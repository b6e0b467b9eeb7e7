/* Small dense linear algebra.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_LINEAR_H
#define MW_LINEAR_H

/* Solve A x = b with complete pivoting (n <= MW_MAX_UNKNOWNS, A row-major, both overwritten) after scaling columns by scale[n] and rows by
 * their largest entry. Directions whose pivot falls below tolerance times the largest are left out (their x is 0).
 * Returns the rank; *gap = last pivot over first. */
int mw_linear_solve(int n, double *A, double *b, const double *scale, double tolerance, double *x, double *gap);

/* Solve A x = b (A[w*w] row-major, both overwritten, x in b) with partial pivoting of rows scaled to unit size; returns the
 * determinant of the scaled matrix. What is singular gives numbers that are not finite. */
double mw_bordered_solve(int w, double *A, double *b);

#endif
