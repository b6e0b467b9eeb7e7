/* What a drive's objects hold beside its model table: tangents, bounded flanks, tables; lane kernels, proofs.
 * SPDX-License-Identifier: MIT-0 */
#ifndef MW_KERNELS_H
#define MW_KERNELS_H

#include "mw_certified.h"
#include "mw_model.h"

/* A design system's tangents: see the generated sensitivity headers. */
typedef struct mw_system_tangents {
    void (*equations)(const double *q, const double *dq, const double *y, const double *dy, double *dR);
    void (*fill)(const double *q, const double *y, const double *dy, double *known, double *dq);
} mw_system_tangents;

/* A drive's tangents; systems and flanks as many and in the order of the model's systems and bodies. */
typedef struct mw_tangents {
    void (*derive)(double *known, const double *p, double *dp);
    const mw_system_tangents *systems;
    void (*contact)(const double *p, const double *dp, double phi, double dphi, const double *x, const double *dx,
                    double *dR, double *dr);
    void (*flanks[2])(const double *p, const double *dp, const double *q, double *dr);
} mw_tangents;

/* Contact with an edge: equations in the unknowns of contact. margin: which margin of pinion and wheel is zero, -1 where
 * the flank itself touches. */
typedef struct mw_edge_system {
    int margin[2];
    void (*eval)(const double *s, const double *x, double *R, double *J);
} mw_edge_system;

/* A surface beyond its tangents: slopes of its limits (regular, then the margins); second derivatives of its point, limits
 * and conditions, NULL where there are none. See the generated headers of bounded flanks. */
typedef struct mw_expansion {
    mw_surface slopes, second;
} mw_expansion;

/* What bounded flanks need; expansions: of pinion, wheel, and of the model's regions in their order. */
typedef struct mw_bounded {
    int nedges;
    const mw_edge_system *edges;
    const mw_expansion *expansions;
} mw_bounded;

/* A drive's equations of contact with error bounds at one point or as many as there are lanes: of s, balls of the design that
 * all lanes share, t, their own balls of the angle, x[nx] and half-widths d[nx] of a box that all lanes share: R, residual at
 * x, nx balls, and J, Jacobian over the box, nx * nx balls. instant: t from balls phi. at_point, of each number of s three
 * doubles, middle, radius in units of 2^-53, largest size: R at x, the radii in the same units, the middles of J, and G, what
 * certify/domain.h looks at; equation i goes to row
 * rows[i] of both, the column of the unknown that is the drive's error comes last. See the generated headers of proofs. */
typedef struct mw_enclosing {
    void (*instant)(const double *s, const double *phi, double *t);
    void (*linearise)(const double *s, const double *t, const double *x, const double *d, double *R, double *J);
    void (*at_point)(const double *s, const double *t, const double *x, const int *rows, double *R, double *J, double *G);
} mw_enclosing;

/* A drive's kernels for one instruction set; number k of lane l is at [k * lanes + l]. See the generated lane headers. */
typedef struct mw_lane_model {
    void (*setup)(const double *p, double *s, double *valid);
    void (*set_phi)(double *s, const double *phi);
    void (*step)(const double *s, double *x, double *size);
} mw_lane_model;

/* The instruction sets for which lanes are compiled: that of the compiler's default target, and on x86-64 two wider. */
typedef enum mw_instruction_set { MW_NATIVE, MW_AVX2, MW_AVX512, MW_INSTRUCTION_SETS } mw_instruction_set;

#if defined(__x86_64__) && defined(__GNUC__)
#define MW_WIDE_LANES
#endif

/* What it holds, each of a unit of its own. enclosing: NULL where that is in an object beside it (mw_proofs), and the tables
 * are run instead, to the same bits. lanes: NULL for an instruction set that was not compiled, or is in one (mw_in_lanes). */
typedef struct mw_kernels {
    const mw_tangents *(*tangents)(void);
    const mw_bounded *(*bounded)(void);
    const mw_certified *(*certified)(void);
    const mw_enclosing *(*enclosing)(void);
    const mw_lane_model *lanes[MW_INSTRUCTION_SETS];
} mw_kernels;

/* Objects beside a drive's own, because few programs need them and they take longer to compile than all else: lane kernels,
 * for many designs or angles; equations with error bounds, at one point and in lanes, for many proofs. drive: as in its model
 * table. NULL for an instruction set that was not compiled. */
typedef struct mw_in_lanes {
    const char *drive;
    const mw_lane_model *lanes[MW_INSTRUCTION_SETS];
} mw_in_lanes;

typedef struct mw_proofs {
    const char *drive;
    const mw_enclosing *lanes[MW_INSTRUCTION_SETS];
    const mw_enclosing *(*enclosing)(void);
} mw_proofs;

#endif
