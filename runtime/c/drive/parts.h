/* What the units of the object of the drive MW_DRIVE offer each other: many units compile at once.
 * SPDX-License-Identifier: MIT-0 */
#include "kernels.h"
#include "names.h"

const mw_tangents *MW_OF(_part_tangents)(void);   /* tangents.c */
const mw_bounded *MW_OF(_part_bounded)(void);     /* bounded.c */
const mw_certified *MW_OF(_part_certified)(void); /* certified.c */
const mw_enclosing *MW_OF(_part_enclosing)(void); /* certified.c */
