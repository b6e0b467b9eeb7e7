/* The equations of the drive MW_DRIVE as tables, for arithmetics with error bounds.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "parts.h"
#include MW_GENERATED(_certified)

const mw_certified *MW_OF(_part_certified)(void)
{
    return &MW_OF(_certified);
}
