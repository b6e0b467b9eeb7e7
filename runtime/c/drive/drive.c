/* One drive: MW_DRIVE is its name, its generated headers are on the include path. With the lanes_*.c of the folder
 * above, compiled with the same MW_DRIVE, this is the drive's object: it exports
 *     const mw_model *mw_drive_<name>(void);
 * and the entries for CasADi (see casadi.h), and uses the core library.  SPDX-License-Identifier: MIT-0 */
#include "kernels.h"
#include "names.h"

/* The model table of the header refers to this. */
static const mw_kernels kernels;
#define MW_KERNELS &kernels

#include MW_GENERATED()
#include MW_GENERATED(_sensitivity)
#include MW_GENERATED(_bounded)
#include MW_GENERATED(_certified)
#include MW_GENERATED(_certify)

#define MW_SYSTEM_TANGENTS(system) { system##_tangent, system##_fill_tangent },
static const mw_system_tangents system_tangents[] = { MW_OF(_SYSTEMS)(MW_SYSTEM_TANGENTS) { NULL, NULL } };
static const mw_tangents tangents = {
    MW_OF(_derive_tangent), system_tangents, MW_OF(_tangent), { MW_OF(_pinion_tangent), MW_OF(_wheel_tangent) }
};

extern const mw_lane_model MW_OF(_lanes_native);
#ifdef MW_WIDE_LANES
extern const mw_lane_model MW_OF(_lanes_avx2), MW_OF(_lanes_avx512);
#define MW_WIDE(name) &MW_OF(name)
#else
#define MW_WIDE(name) NULL
#endif
static const mw_kernels kernels = {
    &tangents, &MW_OF(_bounded), &MW_OF(_certified), { MW_OF(_enclose_instant1), MW_OF(_enclose1) },
    { &MW_OF(_lanes_native), MW_WIDE(_lanes_avx2), MW_WIDE(_lanes_avx512) }
};

const mw_model *MW_PASTE(mw_drive_, MW_DRIVE)(void);
const mw_model *MW_PASTE(mw_drive_, MW_DRIVE)(void)
{
    return &MW_OF(_model);
}

#include "casadi.h"
