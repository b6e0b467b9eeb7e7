/* Names of the drive that MW_DRIVE names, and of its generated headers.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_NAMES_H
#define MW_NAMES_H

#define MW_PASTE2(a, b) a##b
#define MW_PASTE(a, b) MW_PASTE2(a, b)
#define MW_QUOTE2(text) #text
#define MW_QUOTE(text) MW_QUOTE2(text)

/* of a drive "pair", MW_OF(_model) is pair_model, MW_PROOFS_OF(_lanes_avx2) pair_proofs_lanes_avx2, and
 * MW_GENERATED(_lanes) "pair_lanes.h" */
#define MW_OF(suffix) MW_PASTE(MW_DRIVE, suffix)
#define MW_PROOFS_OF(set) MW_PASTE(MW_OF(_proofs), set)
#define MW_GENERATED(suffix) MW_QUOTE(MW_OF(suffix).h)

#endif
