/* Certified contacts in lanes for one instruction set: see lane_kernels.h.  SPDX-License-Identifier: MIT-0 */
#include "certify/point.h"
#include "lanes.h"

/* MW_LANES points: s holds the balls of the design, t has room for those of the angle; phi, x[nx], half-widths d[nx] of the
 * boxes. */
static void lane_certify(const mw_enclosing *k, int n, int error, const double *s, double *t, const mw_wide *phi,
                         const double *x, const double *d, unsigned char *unique, mw_ball *errors)
{
    double angle[2 * MW_LANES], own[MWC_MAX * MW_LANES], R[2 * MWC_MAX * MW_LANES], J[2 * MWC_MAX * MWC_MAX * MW_LANES];
    double proved[MW_LANES], z[MWC_MAX][MW_LANES], K[MWC_MAX][MW_LANES], e[MWC_MAX][MW_LANES];
    for (int l = 0; l < MW_LANES; l++) MWC_KEEP(angle, 0, mwc_of_wide(phi[l]));
    for (int i = 0; i < n; i++)
        for (int l = 0; l < MW_LANES; l++) own[i * MW_LANES + l] = x[l * n + i];
    k->instant(s, angle, t);
    k->linearise(s, t, own, d, R, J);
    switch (n) { /* loops of a constant length are what compilers vectorise */
    case 5: MWC_LANE_NAME(mwc_prove)(5, R, J, d, proved, z, K, e); break;
    case 6: MWC_LANE_NAME(mwc_prove)(6, R, J, d, proved, z, K, e); break;
    default: MWC_LANE_NAME(mwc_prove)(n, R, J, d, proved, z, K, e);
    }
    for (int l = 0; l < MW_LANES; l++) {
        unique[l] = proved[l] > 0.0;
        errors[l] = mwc_make(x[l * n + error], proved[l] > 0.0 ? e[error][l] : HUGE_VAL);
    }
}
