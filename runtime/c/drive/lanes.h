/* The lane kernels of the drive MW_DRIVE for one instruction set: see lane_kernels.h.  SPDX-License-Identifier: MIT-0 */
#include "kernels.h"
#include "names.h"
#include MW_GENERATED(_lanes)

extern const mw_lane_model MW_OF(MW_LANE_SET);
const mw_lane_model MW_OF(MW_LANE_SET) = {
    MW_LANE_NAME(MW_OF(_setup_lanes)), MW_LANE_NAME(MW_OF(_set_phi_lanes)), MW_LANE_NAME(MW_OF(_step_lanes))
};
