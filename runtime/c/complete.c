/* Complete a design.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "meshwright.h"
#include "solver/complete.h"

int mw_complete(const mw_model *m, double *p, double *q, mw_info *info)
{
    return mwi_complete(m, p, q, info);
}
