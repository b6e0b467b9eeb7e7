/* What the units of the objects of the drive MW_DRIVE offer each other: many units compile at once.
 * SPDX-License-Identifier: MIT-0 */
#include "kernels.h"
#include "names.h"

const mw_tangents *MW_OF(_part_tangents)(void);   /* tangents.c */
const mw_bounded *MW_OF(_part_bounded)(void);     /* bounded.c */
const mw_certified *MW_OF(_part_certified)(void); /* certified.c */
const mw_enclosing *MW_OF(_part_enclosing)(void); /* enclosing.c */

/* What the lanes_*.c make of a drive, one of a type for every instruction set: MW_OF of its name, or MW_PROOFS_OF. */
#ifdef MW_WIDE_LANES
#define MW_DECLARE_SETS(type, of) extern const type of(_lanes_native), of(_lanes_avx2), of(_lanes_avx512);
#define MW_EVERY_SET(of) { &of(_lanes_native), &of(_lanes_avx2), &of(_lanes_avx512) }
#else
#define MW_DECLARE_SETS(type, of) extern const type of(_lanes_native);
#define MW_EVERY_SET(of) { &of(_lanes_native), NULL, NULL }
#endif
