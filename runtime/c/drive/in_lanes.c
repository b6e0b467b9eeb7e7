/* Many designs, or many angles, of the drive MW_DRIVE at once: with the lanes_*.c of the folder above, compiled with the same
 * MW_DRIVE, this is an object beside the drive's own. It exports
 *     const mw_in_lanes *mw_in_lanes_<name>(void);
 * which mw_joined takes.  SPDX-License-Identifier: MIT-0 */
#include "parts.h"

MW_DECLARE_SETS(mw_lane_model, MW_OF)
static const mw_in_lanes in_lanes = { MW_QUOTE(MW_DRIVE), MW_EVERY_SET(MW_OF) };

const mw_in_lanes *MW_PASTE(mw_in_lanes_, MW_DRIVE)(void);
const mw_in_lanes *MW_PASTE(mw_in_lanes_, MW_DRIVE)(void)
{
    return &in_lanes;
}
