/* What the search for a first contact holds: parts of flanks, bounds of where they are, sheets over them.
 * SPDX-License-Identifier: MIT-0 */
#ifndef MWC_FIRST_SEARCH_H
#define MWC_FIRST_SEARCH_H

#include <string.h>

#include "../../mw_certify.h"
#include "../cube.h"
#include "../krawczyk.h"
#include "../tables.h"

enum {
    MOST_LISTED = 6000,                       /* parts of the pinion's flank that are kept in mind */
    FEWEST = 2000, MANY = 16,                 /* that are looked at, and for each of the wheel's */
    DEEPEST = 32, DEEPEST_EDGE = 14,          /* halvings */
    MOST_OPEN = 64,                           /* parts of the wheel's flank that may stay open, in search of an overlap */
    LOOKED_ON = 64,                           /* parts after an overlap at one angle, in search of one at every angle */
    CELLS = 48, BLOCK = 8,                    /* across the wheel's flank and along it, where its pieces are told apart; in one */
    MOST_MET = 160, FEW_MET = 6,              /* parts of the pinion's flank whose box is looked at as one; and once more, finer */
    NARROWEST = 12,                           /* steps in which one is narrowed, at most */
    PROBES = 5,                               /* places along a side of a part, and of the range of angles, tried for an overlap */
    NEWTON_STEPS = 12, NARROWING_STEPS = 40,
    DEEPEST_CUBE = 24, MOST_CUBES = 4000,     /* halvings of polynomials, and how many cubes in all */
    MOST_LIMITS = 12,                         /* that are looked at together with the distance */
    MARGINS = 32                              /* of one flank, its regularity included, at most */
};

typedef mwc_range range;

/* How much larger than the wheel's part parts of the pinion's flank may be that cannot be narrowed; the largest share of a
 * part's half-width by which it may be off its tangent plane to be taken whole; the share that a step of narrowing leaves if it
 * is worth another; the share of a side that may meet the wheel's part above which halving that side tells nothing. */
static const double COARSE = 3.0, STRAIGHT = 0.25, WORTH = 0.6, FULL = 0.5;

/* By what share of itself a box of parts is widened; the share of the box within which bounds are close enough for halves to
 * start from them. */
static const double BESIDE = 0.0625, NEARLY = 0.004;

/* How large a share of what a limit varies by its error may be where polynomials tell the cells. */
static const double CLOSE = 0.003;

/* Bounds of where a part of a flank is: two combinations of the squared distance from the wheel's axis and the place along
 * it, such as are the pinion's parameters near the contact, and how wide they are at one angle; the angle about the axis. */
typedef struct bounds {
    range across[2], angle;
    double spread[2];
} bounds;

/* A part of the pinion's flank: its parameters, as they follow the contact, and where it is; what of it may meet the wheel's. */
typedef struct part {
    range box[2], within[2];
    bounds at;
    mwc_sheet across[2];
} part;

/* What a contact is, as sheets of the angle. x: unknowns. */
typedef struct touching {
    mwc_sheet phi, x[MW_MAX_UNKNOWNS], point[3], normal[3], wheel_angle;
} touching;

typedef struct search {
    const mw_model *model;
    const mw_certified *tables;
    int margins[2], set[2][MARGINS];          /* limits of each flank and whether the design sets them */
    int enough[2][3];                         /* operations that lead to point, limits and tangents of each flank */
    mwc_sheet follow[2];                      /* the pinion's parameters at the contact */
    mwc_sheet drift[2];                       /* by how much parts of the wheel's flank follow it, from the middle angle */
    mwc_sheet turn[9], move[3];               /* of the pinion's points, fixed frame, into that of the search */
    mw_ball cosine, sine;                     /* of the wheel's, body frame */
    double sense, slack, reach, view[4];
    range whole[2][2], pinion[2];             /* parameters of both flanks; the pinion's as they follow the contact */
    int looks, effort, open, cubes;           /* looks: at parts of the pinion's flank */
    int own;                                  /* whether the range of angles is looked at for the pair of the contact itself */
    unsigned char cell[CELLS][CELLS];         /* 0: outside or of another piece */
    part *list;
    mw_first_certificate *found;
    double share;                             /* of the range of angles, in [-1, 1], where the place found is */
    mw_first_certificate once;                /* the first overlap at one angle of several; of no parts: none yet */
    double once_share;
    touching at;
    mw_ball middle[MWC_ARGUMENTS];            /* what the pinion's flank reads, at u = 0 */
    mwc_sheet arguments[2][MWC_ARGUMENTS], registers[MWC_REGISTERS];
} search;

/* What a part of a flank is: point, frame of the search, and limits. */
typedef struct place {
    mwc_sheet x[3], limit[MARGINS];
} place;

/* How much of a flank is asked for, and where its results begin. */
enum { POINT, LIMITS, TANGENTS, REGULAR = 3 };

static int overlap(range a, range b)
{
    return !(a.low > b.high) && !(b.low > a.high);
}

static double width(range a)
{
    return a.high - a.low;
}

static mwc_sheet number(double value)
{
    return mwc_sheet_of_ball(mwc_make(value, 0.0));
}

static mwc_sheet squared(const mwc_sheet *x)
{
    return mwc_sheet_add(mwc_sheet_sqr(x[0]), mwc_sheet_sqr(x[1]));
}

/* What the terms in u alone come to. */
static double turning(const mwc_sheet *a)
{
    double sum = 0.0;
    for (int k = 1; k <= a->along; k++) sum += mwc_abs(a->c[MWC_BLOCK[k]]);
    return sum;
}

static bounds bounds_of(const search *h, const mwc_sheet *x, mwc_sheet *across)
{
    bounds b;
    const mwc_sheet square = squared(x), angle = mwc_sheet_atan2(x[1], x[0]);
    for (int i = 0; i < 2; i++) {
        across[i] = mwc_sheet_add(mwc_sheet_times(square, mwc_make(h->view[2 * i], 0.0)),
                                  mwc_sheet_times(x[2], mwc_make(h->view[2 * i + 1], 0.0)));
        b.across[i] = mwc_cube_range(across + i);
        b.spread[i] = width(b.across[i]) - 2.0 * turning(across + i);
    }
    b.angle = mwc_cube_range(&angle);
    return b;
}

#endif
