/* One drive: MW_DRIVE is its name, its generated headers are on the include path. With the other units of its object (see
 * parts.h) and the lanes_*.c of the folder above, compiled with the same MW_DRIVE, this is the drive's object: it exports
 *     const mw_model *mw_drive_<name>(void);
 * and the entries for CasADi (see casadi.h), and uses the core library.  SPDX-License-Identifier: MIT-0 */
#include "parts.h"

/* The model table of the header refers to this. */
static const mw_kernels kernels;
#define MW_KERNELS &kernels

#include MW_GENERATED()

extern const mw_lane_model MW_OF(_lanes_native);
#ifdef MW_WIDE_LANES
extern const mw_lane_model MW_OF(_lanes_avx2), MW_OF(_lanes_avx512);
#define MW_WIDE(name) &MW_OF(name)
#else
#define MW_WIDE(name) NULL
#endif
static const mw_kernels kernels = {
    MW_OF(_part_tangents), MW_OF(_part_bounded), MW_OF(_part_certified), MW_OF(_part_enclosing),
    { &MW_OF(_lanes_native), MW_WIDE(_lanes_avx2), MW_WIDE(_lanes_avx512) }
};

const mw_model *MW_PASTE(mw_drive_, MW_DRIVE)(void);
const mw_model *MW_PASTE(mw_drive_, MW_DRIVE)(void)
{
    return &MW_OF(_model);
}

#include "casadi.h"
