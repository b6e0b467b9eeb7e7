/* Krawczyk's test at MW_LANES points of a domain at once, MW_LANES = 1 at one; include again with another MW_LANES for another
 * width.  SPDX-License-Identifier: MIT-0
 *
 * As in krawczyk.h with C = (L U)^-1, where L U = J + F is J's middles eliminated, |F| <= MWC_SHARE |L||U| and MWC_TINY for
 * each product and, times the pivot, for each quotient (Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed.,
 * 9.3). C is never formed: with w the radii of J,
 *     |C R| + M d <= |U^-1| |L^-1| (|R| + w d + |F| d),
 * and |T^-1| v <= t for triangular T where t solves it with the sizes of T's numbers off the diagonal, all signs positive
 * (ibid., 8.3). Where the sum is below d, the solution is within a share t of d with t <= max |C R|/d + t max M d/d. The one
 * unknown asked for takes a row c of its own, near C's, and the Jacobian over that smaller box:
 *     |c R| + |e - c J| t d. */
#include "domain.h"

/* Of R and J as mw_enclosing's at_point has them: proved[l] is 1 where each box holds exactly one zero, else 0, and the
 * unknown asked for then lies within e[l] of where it is. */
MWI_INLINE void MWC_LANE_NAME(mwc_settle)(int n, const mwc_domain *of, const double *R, const double *J, double *proved,
                                          double *e)
{
    const double share = MWC_SHARE(n), tiny = (double)(4 * n) * MWC_TINY;
    double T[MWC_MAX * MWC_MAX][MW_LANES], pivot[MWC_MAX][MW_LANES], most[MWC_MAX][MW_LANES];
    double off[MWC_MAX][MW_LANES], shift[MWC_MAX][MW_LANES], image[MWC_MAX][MW_LANES], c[MWC_MAX][MW_LANES];
    double above[MW_LANES], first[MW_LANES], part[MW_LANES], sum[MW_LANES];
    MWC_EACH proved[l] = 1.0;
    for (int i = 0; i < n * n; i++) MWC_EACH T[i][l] = J[i * MW_LANES + l];
    for (int k = 0; k < n; k++) {
        MWC_EACH pivot[k][l] = 1.0 / T[k * n + k][l];
        MWC_EACH proved[l] = mwc_abs(pivot[k][l]) > 1e-290 ? proved[l] : 0.0; /* its error is a share of itself */
        for (int i = k + 1; i < n; i++) {
            MWC_EACH T[i * n + k][l] *= pivot[k][l];
            for (int j = k + 1; j < n; j++) MWC_EACH T[i * n + j][l] = MWC_FMA(-T[i * n + k][l], T[k * n + j][l], T[i * n + j][l]);
        }
    }
    /* most = share |U| d; shift = |L^-1| |R|, image = |L^-1| (w d + |F| d) */
    MWC_EACH above[l] = tiny;
    for (int i = 0; i < n; i++) {
        MWC_EACH {
            const mw_ball entry = MWC_OWN(R, i);
            off[i][l] = MWC_FMA(MWC_UNITS_READ, entry.radius, MWC_FMA(share, mwc_abs(entry.mid), tiny));
            shift[i][l] = off[i][l] + mwc_abs(entry.mid);
            sum[l] = 0.0;
        }
        for (int j = i; j < n; j++) MWC_EACH sum[l] = MWC_FMA(mwc_abs(T[i * n + j][l]), of->d[j], sum[l]);
        MWC_EACH most[i][l] = MWC_FMA(share, sum[l], tiny);
        MWC_EACH image[i][l] = MWC_FMA(MWC_TINY, above[l], of->wide[i] + most[i][l]);
        for (int j = 0; j < i; j++) MWC_EACH {
            shift[i][l] = MWC_FMA(mwc_abs(T[i * n + j][l]), shift[j][l], shift[i][l]);
            image[i][l] = MWC_FMA(mwc_abs(T[i * n + j][l]), image[j][l] + most[j][l], image[i][l]);
        }
        MWC_EACH above[l] += sum[l];
    }
    /* the same times |U^-1|, and the largest shares of d */
    MWC_EACH first[l] = 0.0, part[l] = 0.0;
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) MWC_EACH {
            shift[i][l] = MWC_FMA(mwc_abs(T[i * n + j][l]), shift[j][l], shift[i][l]);
            image[i][l] = MWC_FMA(mwc_abs(T[i * n + j][l]), image[j][l], image[i][l]);
        }
        MWC_EACH {
            shift[i][l] = shift[i][l] * mwc_abs(pivot[i][l]) * MWC_READ + tiny;
            image[i][l] = image[i][l] * mwc_abs(pivot[i][l]) * MWC_READ + tiny;
            proved[l] = (shift[i][l] + image[i][l]) * MWC_READ < of->d[i] ? proved[l] : 0.0;
            first[l] = shift[i][l] * of->inverse[i] > first[l] ? shift[i][l] * of->inverse[i] : first[l];
            part[l] = image[i][l] * of->inverse[i] > part[l] ? image[i][l] * of->inverse[i] : part[l];
        }
    }
    /* from there on: the solution is within `part` of d, and row c of the last unknown */
    MWC_EACH {
        const double rest = 1.0 - part[l] * MWC_READ, share_of = first[l] * MWC_READ / rest * MWC_READ;
        part[l] = rest > 0.0 && share_of < 1.0 ? share_of : 1.0;
    }
    for (int i = n - 1; i >= 0; i--) {
        MWC_EACH c[i][l] = i == n - 1 ? pivot[i][l] : 0.0;
        for (int j = i + 1; j < n; j++) MWC_EACH c[i][l] = MWC_FMA(-T[j * n + i][l], c[j][l], c[i][l]);
    }
    MWC_EACH sum[l] = 0.0, e[l] = MWC_FMA(share * part[l], of->d[n - 1], tiny);
    for (int k = 0; k < n; k++) MWC_EACH {
        const double bound = part[l] <= MWC_NEAR ? of->near[k] : of->wide[k];
        sum[l] = MWC_FMA(c[k][l], R[2 * k * MW_LANES + l], sum[l]);
        e[l] = MWC_FMA(mwc_abs(c[k][l]), MWC_FMA(part[l], bound, off[k][l]), e[l]);
    }
    MWC_EACH e[l] += mwc_abs(sum[l]);
    for (int j = 0; j < n; j++) {
        MWC_EACH sum[l] = j == n - 1 ? 1.0 : 0.0;
        for (int k = 0; k < n; k++) MWC_EACH sum[l] = MWC_FMA(-c[k][l], J[(k * n + j) * MW_LANES + l], sum[l]);
        MWC_EACH e[l] = MWC_FMA(mwc_abs(sum[l]) + tiny, part[l] * of->d[j], e[l]);
    }
    MWC_EACH e[l] *= MWC_READ;
}
