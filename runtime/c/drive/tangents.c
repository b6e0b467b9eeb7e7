/* Tangents of the drive MW_DRIVE.  SPDX-License-Identifier: MIT-0 */
#include "parts.h"
#include MW_GENERATED(_sensitivity)

#define MW_SYSTEM_TANGENTS(system) { system##_tangent, system##_fill_tangent },
static const mw_system_tangents systems[] = { MW_OF(_SYSTEMS)(MW_SYSTEM_TANGENTS) { NULL, NULL } };
static const mw_tangents tangents = {
    MW_OF(_derive_tangent), systems, MW_OF(_tangent), { MW_OF(_pinion_tangent), MW_OF(_wheel_tangent) }
};

const mw_tangents *MW_OF(_part_tangents)(void)
{
    return &tangents;
}
