/* The equations of the drive MW_DRIVE with error bounds, at one point.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "parts.h"
#include MW_GENERATED(_certify)

static const mw_enclosing enclosing = { MW_OF(_enclose_instant1), MW_OF(_enclose1), MW_OF(_enclose_point1) };

const mw_enclosing *MW_OF(_part_enclosing)(void)
{
    return &enclosing;
}
