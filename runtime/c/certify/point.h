/* Krawczyk's test at MW_LANES points at once, MW_LANES = 1 at one; include again with another MW_LANES for another width.
 * SPDX-License-Identifier: MIT-0
 *
 * As in krawczyk.h, with one J over the box for everything. C is any matrix, here from the midpoints of J by elimination. A
 * sum of n products and a term is within (n + 2) MWC_U of the sum of their sizes, and MWC_TINY for each product (Higham,
 * "Accuracy and Stability of Numerical Algorithms", 2nd ed., 3.1); so with w = radius of J + (n + 2) MWC_U |J| and N what
 * doubles find for |I - C J|,
 *     M d <= N d + |C| (w d) + (n + 2) MWC_U d,
 * which takes no product of matrices but N's own. */
#include "lane.h"

/* C = inverses of J's midpoints, in place, rows in the order that the first lane needs. */
MWI_INLINE void MWC_LANE_NAME(mwc_inverses)(int n, const double *J, double (*C)[MW_LANES])
{
    int swapped[MWC_MAX];
    double by[MW_LANES], f[MW_LANES];
    for (int i = 0; i < n * n; i++) MWC_EACH C[i][l] = J[2 * i * MW_LANES + l];
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (mwc_abs(C[i * n + k][0]) > mwc_abs(C[pivot * n + k][0])) pivot = i;
        swapped[k] = pivot;
        for (int j = 0; pivot != k && j < n; j++) MWC_EACH {
            const double a = C[k * n + j][l];
            C[k * n + j][l] = C[pivot * n + j][l];
            C[pivot * n + j][l] = a;
        }
        MWC_EACH by[l] = 1.0 / C[k * n + k][l], C[k * n + k][l] = 1.0;
        for (int j = 0; j < n; j++) MWC_EACH C[k * n + j][l] *= by[l];
        for (int i = 0; i < n; i++) {
            if (i == k) continue;
            MWC_EACH f[l] = -C[i * n + k][l], C[i * n + k][l] = 0.0;
            for (int j = 0; j < n; j++) MWC_EACH C[i * n + j][l] = MWC_FMA(f[l], C[k * n + j][l], C[i * n + j][l]);
        }
    }
    for (int k = n - 1; k >= 0; k--)
        for (int i = 0; swapped[k] != k && i < n; i++) MWC_EACH {
            const double a = C[i * n + k][l];
            C[i * n + k][l] = C[i * n + swapped[k]][l];
            C[i * n + swapped[k]][l] = a;
        }
}

/* z + M d by the bound above, all upper bounds. */
MWI_INLINE void MWC_LANE_NAME(mwc_images)(int n, double (*z)[MW_LANES], double (*C)[MW_LANES], double (*N)[MW_LANES],
                                          double (*w)[MW_LANES], double (*d)[MW_LANES], double (*K)[MW_LANES])
{
    const double share = (double)(n + 2) * MWC_U, tiny = (double)(4 * n) * MWC_TINY;
    double wide[MWC_MAX][MW_LANES];
    for (int k = 0; k < n; k++) {
        MWC_EACH wide[k][l] = tiny;
        for (int j = 0; j < n; j++) MWC_EACH wide[k][l] = MWC_FMA(w[k * n + j][l], d[j][l], wide[k][l]);
    }
    for (int i = 0; i < n; i++) {
        double sum[MW_LANES];
        MWC_EACH sum[l] = MWC_FMA(share, d[i][l], z[i][l] + tiny);
        for (int j = 0; j < n; j++)
            MWC_EACH sum[l] = MWC_FMA(N[i * n + j][l], d[j][l], MWC_FMA(mwc_abs(C[i * n + j][l]), wide[j][l], sum[l]));
        MWC_EACH K[i][l] = sum[l] * MWC_READ;
    }
}

/* Of R and J as mw_enclosing has them, box half-widths d[n]: proved[l] is 1 where each box holds exactly one zero, which then
 * lies within e[i][l] of its centre, else 0. z = |C R| and K as above. */
MWI_INLINE void MWC_LANE_NAME(mwc_prove)(int n, const double *R, const double *J, const double *d, double *proved,
                                         double (*z)[MW_LANES], double (*K)[MW_LANES], double (*e)[MW_LANES])
{
    const double share = (double)(n + 2) * MWC_U, tiny = (double)(4 * n) * MWC_TINY;
    double C[MWC_MAX * MWC_MAX][MW_LANES], N[MWC_MAX * MWC_MAX][MW_LANES];
    double w[MWC_MAX * MWC_MAX][MW_LANES], box[MWC_MAX][MW_LANES];
    double off[MWC_MAX][MW_LANES];
    MWC_LANE_NAME(mwc_inverses)(n, J, C);
    for (int i = 0; i < n * n; i++) MWC_EACH {
        const mw_ball entry = MWC_OWN(J, i);
        w[i][l] = MWC_FMA(MWC_READ, entry.radius, MWC_FMA(share, mwc_abs(entry.mid), MWC_TINY));
    }
    for (int k = 0; k < n; k++) MWC_EACH {
        const mw_ball entry = MWC_OWN(R, k);
        off[k][l] = MWC_FMA(MWC_READ, entry.radius, MWC_FMA(share, mwc_abs(entry.mid), MWC_TINY));
        box[k][l] = d[k];
    }
    for (int i = 0; i < n; i++) {
        double sum[MW_LANES], radius[MW_LANES];
        MWC_EACH sum[l] = 0.0, radius[l] = tiny;
        for (int k = 0; k < n; k++) MWC_EACH {
            sum[l] = MWC_FMA(C[i * n + k][l], R[2 * k * MW_LANES + l], sum[l]);
            radius[l] = MWC_FMA(mwc_abs(C[i * n + k][l]), off[k][l], radius[l]);
        }
        MWC_EACH z[i][l] = (mwc_abs(sum[l]) + radius[l]) * MWC_READ;
        for (int j = 0; j < n; j++) {
            MWC_EACH sum[l] = i == j ? 1.0 : 0.0;
            for (int k = 0; k < n; k++) MWC_EACH sum[l] = MWC_FMA(-C[i * n + k][l], J[2 * (k * n + j) * MW_LANES + l], sum[l]);
            MWC_EACH N[i * n + j][l] = mwc_abs(sum[l]) + tiny;
        }
    }
    MWC_LANE_NAME(mwc_images)(n, z, C, N, w, box, K);
    MWC_EACH proved[l] = 1.0;
    for (int i = 0; i < n; i++) MWC_EACH proved[l] = K[i][l] < box[i][l] ? proved[l] : 0.0;
    MWC_LANE_NAME(mwc_images)(n, z, C, N, w, K, e); /* from K < d on, the same of K */
}
