/* What bounded flanks of the drive MW_DRIVE need.  SPDX-License-Identifier: MIT-0 */
#include "parts.h"
#include MW_GENERATED(_bounded)

const mw_bounded *MW_OF(_part_bounded)(void)
{
    return &MW_OF(_bounded);
}
