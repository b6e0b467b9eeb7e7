/* Proofs of many contacts of the drive MW_DRIVE at once: with the lanes_*.c of the folder above, compiled with the same
 * MW_DRIVE and with MW_PROOFS, this is an object beside the drive's own. It exports
 *     const mw_proofs *mw_proofs_<name>(void);
 * which mw_certify_many takes.  SPDX-License-Identifier: MIT-0 */
#include "kernels.h"
#include "names.h"

extern const mw_enclosing MW_PROOFS_OF(_lanes_native);
#ifdef MW_WIDE_LANES
extern const mw_enclosing MW_PROOFS_OF(_lanes_avx2), MW_PROOFS_OF(_lanes_avx512);
#define MW_WIDE(name) &MW_PROOFS_OF(name)
#else
#define MW_WIDE(name) NULL
#endif
static const mw_proofs proofs = {
    MW_QUOTE(MW_DRIVE), { &MW_PROOFS_OF(_lanes_native), MW_WIDE(_lanes_avx2), MW_WIDE(_lanes_avx512) }
};

const mw_proofs *MW_PASTE(mw_proofs_, MW_DRIVE)(void);
const mw_proofs *MW_PASTE(mw_proofs_, MW_DRIVE)(void)
{
    return &proofs;
}
