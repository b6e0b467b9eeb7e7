/* Every operation is rounded by itself, whatever the options: included before all else.  SPDX-License-Identifier: MIT-0
 *
 * The same bits are promised of every compiler and machine with IEEE arithmetic, at any level of optimisation, with
 * -ffp-contract=off and without -ffast-math: of every function of the interface, whatever the C library, which is asked for
 * sqrt, fmax and fmin alone. GCC's vectoriser of straight-line code fuses products into pairs of a sum and a difference in spite of
 * that option where the target has fused products; here it may not. The promise ends at lanes wider than two and at headers
 * with MW_FUSED, which fuse products into sums by design and agree among themselves; and at the bits of a not-a-number. */
#ifndef MW_EXACT_H
#define MW_EXACT_H

#if defined(__GNUC__) && !defined(__clang__) && defined(__FMA__)
#pragma GCC optimize("no-tree-slp-vectorize")
#endif

#endif
