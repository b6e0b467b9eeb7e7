/* A drive's functions as tables of operations, for arithmetics that enclose what they compute. SPDX-License-Identifier: MIT-0 */
#ifndef MW_CERTIFIED_H
#define MW_CERTIFIED_H

#include <stddef.h>
#include "mw_enclosures.h"

/* Operation numbers; the comment names result r and arguments a, b. */
enum {
    MW_OP_ADD, MW_OP_SUB, MW_OP_MUL, MW_OP_SQR, MW_OP_DIV, MW_OP_NEG, MW_OP_SQRT,
    MW_OP_SINCOS,                /* r = sin a, b = cos a */
    MW_OP_ATAN2,                 /* angle of the point (b, a) */
    MW_OP_SIGN                   /* -1 below 0, else 1 */
};

/* A function: registers 0 ... hold inputs, constants, then what is computed. Register k < inputs is number input[k] of the
 * function's arguments in a row. operation: number, result, first and second argument of each instruction. output:
 * registers of the results; after `first` instructions the leading ones are known: of equations, the residual. */
typedef struct mw_code {
    int registers, inputs, constants, instructions, first, outputs;
    const unsigned short *input;
    const mw_wide *constant;
    const unsigned short *operation;
    const unsigned short *output;
} mw_code;

/* A rule or default: the parameter that it fills in, its value of p, followed by what must not be zero. */
typedef struct mw_certified_rule {
    int target;
    mw_code value;
} mw_certified_rule;

/* A design system: its residual and Jacobian, the values that it fills in, of (q[np + 1], y[n]); fills: parameters. */
typedef struct mw_certified_system {
    mw_code equations, values;
    const int *fills;
} mw_certified_system;

/* A drive. factors[np]: from the units of keys to inner units. rules and systems in the model's order, ended by an empty
 * one. setup: of p; instant: of (s, phi); equations, residual and Jacobian, and observed: of (s[slots], x). observed is:
 * point and normal of the pinion, then of the wheel, fixed frame; wheel angle; principal curvatures of the gap; of each
 * body, whether it is regular, and its margins. along: of (s[slots], phi, x, v[nx + 1]), first and then second derivative of the
 * residual along v, a direction of (x, phi). flanks, of pinion and wheel: of (s[slots], parameters), point, regular and
 * margins, then the tangents; the pinion's in the fixed frame, the wheel's in its own. placement: of (s[slots], angles of pinion and wheel), for each of both the rows of
 * the motion into the fixed frame, direction and a point of its axis. turning: whether the wheel turns about its frame's z. */
typedef struct mw_certified {
    int slots, design_slots;
    const mw_wide *factors;
    const mw_certified_rule *rules;
    const mw_certified_system *systems;
    mw_code setup, instant, equations, observed, along, flanks[2], placement;
    int turning;
} mw_certified;

#endif
