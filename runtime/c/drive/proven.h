/* The equations of the drive MW_DRIVE with error bounds, in lanes of one instruction set: see lane_kernels.h.
 * SPDX-License-Identifier: MIT-0 */
#include "kernels.h"
#include "names.h"
#include MW_GENERATED(_certify)

extern const mw_enclosing MW_PROOFS_OF(MW_LANE_SET);
const mw_enclosing MW_PROOFS_OF(MW_LANE_SET) = {
    MWC_LANE_NAME(MW_OF(_enclose_instant)), NULL, MWC_LANE_NAME(MW_OF(_enclose_point))
};
