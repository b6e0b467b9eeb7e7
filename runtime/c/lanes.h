/* Kernels over several instances at once, compiled for each instruction set.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_LANES_H
#define MW_LANES_H

#include "certify/domain.h"
#include "kernels.h"
#include "meshwright.h"

enum { MW_MAX_LANES = 16 };

/* Where the points of a lane go: x[count * nx]. */
typedef struct mw_lane_row {
    double *x;
    size_t count;
} mw_lane_row;

/* Points that are kept in lanes before they go to the rows; so they stay in the nearest cache. */
enum { MW_LANE_BLOCK = 32 };

/* look() and decide(): see lane_certify.h. One instruction set: vectors of width numbers, lanes instances at once. follow() traces every lane along
 * its own phi[n * lanes] from start[nx * lanes], the start values at phi[0], and writes the points to rows[lanes];
 * solved[l] counts the points of lane l before it failed; s is set up; points[(MW_HISTORY + MW_LANE_BLOCK) * nx * lanes]
 * is work. */
struct mw_lane_set {
    const char *name;
    mw_instruction_set set;
    int width, lanes;
    void (*follow)(const mw_lane_model *k, const mw_model *m, double *s, const double *phi, size_t n, const double *start,
                   double *points, const mw_lane_row *rows, size_t *solved);
    void (*look)(const mw_enclosing *k, mwc_domain *of, const double *s, const double *most, double *t, const mw_wide *phi,
                 const double *x, double *R, double *J);
    void (*decide)(const mwc_domain *of, const double *R, const double *J, const double *x, unsigned char *unique,
                   mw_ball *errors);
};

#endif
