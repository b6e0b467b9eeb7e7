/* Certified contacts in lanes for one instruction set: see lane_kernels.h.  SPDX-License-Identifier: MIT-0 */
#include "certify/settle.h"
#include "lanes.h"

/* R[2 n MW_LANES] and J[n n MW_LANES] at MW_LANES points; what of->least says of the points looked at before includes them
 * then. s holds the balls of the design, most the same as at_point reads them, t has room for those of the angle; phi, x[n]. */
static void MWC_LANE_NAME(mwc_look)(const mw_enclosing *k, mwc_domain *of, const double *s, const double *most, double *t,
                                    const mw_wide *phi, const double *x, double *R, double *J)
{
    double angle[2 * MW_LANES], own[MWC_MAX * MW_LANES], G[MWC_GUARDS * MW_LANES];
    for (int l = 0; l < MW_LANES; l++) MWC_KEEP(angle, 0, mwc_of_wide(phi[l]));
    for (int i = 0; i < of->n; i++)
        for (int l = 0; l < MW_LANES; l++) own[i * MW_LANES + l] = x[l * of->n + i];
    k->instant(s, angle, t);
    k->at_point(most, t, own, of->rows, R, J, G);
    for (int g = 0; g < of->guards; g++)
        for (int l = 0; l < MW_LANES; l++) of->least[g] = G[g * MW_LANES + l] < of->least[g] ? G[g * MW_LANES + l] : of->least[g];
}

/* What is proved of these points. */
static void MWC_LANE_NAME(mwc_decide)(const mwc_domain *of, const double *R, const double *J, const double *x,
                                      unsigned char *unique, mw_ball *errors)
{
    double proved[MW_LANES], e[MW_LANES];
    switch (of->n) { /* loops of a constant length are what compilers vectorise */
    case 5: MWC_LANE_NAME(mwc_settle)(5, of, R, J, proved, e); break;
    case 6: MWC_LANE_NAME(mwc_settle)(6, of, R, J, proved, e); break;
    default: MWC_LANE_NAME(mwc_settle)(of->n, of, R, J, proved, e);
    }
    for (int l = 0; l < MW_LANES; l++) {
        unique[l] = proved[l] > 0.0;
        errors[l] = mwc_make(x[l * of->n + of->error], proved[l] > 0.0 ? e[l] : HUGE_VAL);
    }
}
