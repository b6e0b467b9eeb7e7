/* Every operation is rounded by itself, whatever the options: included before all else.  SPDX-License-Identifier: MIT-0
 *
 * The same bits are promised of every compiler and machine with IEEE arithmetic, at any level of optimisation, with
 * -ffp-contract=off and without -ffast-math. GCC's vectoriser of straight-line code fuses products into pairs of a sum and
 * a difference in spite of that option where the target has fused products; here it may not. The promise ends at lanes
 * wider than two and at headers with MW_FUSED, which fuse products into sums by design and agree among themselves, and at
 * mw_first_contact, which asks the C library for sines, cosines or arcs: there the same bits need the same library. */
#ifndef MW_EXACT_H
#define MW_EXACT_H

#if defined(__GNUC__) && !defined(__clang__) && defined(__FMA__)
#pragma GCC optimize("no-tree-slp-vectorize")
#endif

#endif
