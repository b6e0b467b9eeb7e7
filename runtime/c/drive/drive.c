/* One drive: MW_DRIVE is its name, its generated headers are on the include path. With the other units of its object (see
 * parts.h), compiled with the same MW_DRIVE, this is the drive's object: it exports
 *     const mw_model *mw_drive_<name>(void);
 * and the entries for CasADi (see casadi.h), and uses the core library. With MW_APART, lane kernels and equations with error
 * bounds are in objects beside it (in_lanes.c, proofs.c); without it they are linked with it.  SPDX-License-Identifier: MIT-0 */
#include "parts.h"

/* The model table of the header refers to this. */
static const mw_kernels kernels;
#define MW_KERNELS &kernels

#include MW_GENERATED()

#ifdef MW_APART
static const mw_enclosing *apart(void)
{
    return NULL;
}
#define MW_ENCLOSING apart
#define MW_LANE_MODELS { NULL }
#else
#define MW_ENCLOSING MW_OF(_part_enclosing)
#define MW_LANE_MODELS MW_EVERY_SET(MW_OF)
MW_DECLARE_SETS(mw_lane_model, MW_OF)
#endif
static const mw_kernels kernels = {
    MW_OF(_part_tangents), MW_OF(_part_bounded), MW_OF(_part_certified), MW_ENCLOSING, MW_LANE_MODELS
};

const mw_model *MW_PASTE(mw_drive_, MW_DRIVE)(void);
const mw_model *MW_PASTE(mw_drive_, MW_DRIVE)(void)
{
    return &MW_OF(_model);
}

#include "casadi.h"
