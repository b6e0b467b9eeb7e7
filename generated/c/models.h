/* Every generated drive, for runtime/c. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */
#include "cylindrical_worm_zn_zn.h"

static const mw_model *const mw_models[] = {
    &cylindrical_worm_zn_zn_model,
    NULL
};
