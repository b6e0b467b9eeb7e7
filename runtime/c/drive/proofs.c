/* Proofs of many contacts of the drive MW_DRIVE at once: with enclosing.c and the lanes_*.c of the folder above, compiled with
 * the same MW_DRIVE and with MW_PROOFS, this is an object beside the drive's own. It exports
 *     const mw_proofs *mw_proofs_<name>(void);
 * which mw_certify_many and mw_joined take.  SPDX-License-Identifier: MIT-0 */
#include "parts.h"

MW_DECLARE_SETS(mw_enclosing, MW_PROOFS_OF)
static const mw_proofs proofs = { MW_QUOTE(MW_DRIVE), MW_EVERY_SET(MW_PROOFS_OF), MW_OF(_part_enclosing) };

const mw_proofs *MW_PASTE(mw_proofs_, MW_DRIVE)(void);
const mw_proofs *MW_PASTE(mw_proofs_, MW_DRIVE)(void)
{
    return &proofs;
}
