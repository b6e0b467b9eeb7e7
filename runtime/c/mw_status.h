/* How a solve ended, and what is known of its contact. Each generated header repeats this block under the same guard,
 * so that it can be used alone.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_STATUS_LIST

/* Code, value, the word used in results, what it means. Success is >= 0: only a contact that touches (see mw_touch in
 * meshwright.h) has it. */
#define MW_STATUS_LIST(X) \
    X(MW_CONVERGED, 0, "converged", "the last step was below tolerance") \
    X(MW_CONVERGED_NOISE, 1, "converged", "the steps ended in round-off; near line contact the point is ill-determined") \
    X(MW_LINE_CONTACT, 2, "line_contact", "the flanks touch along a line: no single contact point exists") \
    X(MW_EDGE_CONTACT, 3, "edge_contact", "an edge of a tooth touches the other flank, or an edge of that, first") \
    X(MW_CORNER_CONTACT, 4, "corner_contact", "a corner of a tooth, where two of its edges meet, touches the other flank first") \
    X(MW_NO_CONTACT, -1, "no_contact", "no turn of the wheel brings the bounded flanks together at this angle") \
    X(MW_LEFT_FLANK, -2, "left_flank", "the search left the domain in which the flanks exist") \
    X(MW_FOLD, -3, "fold", "the branch of contact turns back before this angle") \
    X(MW_SINGULAR, -4, "singular", "the equations are singular here but the flanks do not touch along a line") \
    X(MW_DIVERGED, -5, "diverged", "the iteration did not settle") \
    X(MW_BAD_INPUT, -6, "bad_input", "a guard of the design does not hold, or the angle is not finite or out of range")

typedef enum mw_status {
#define MW_STATUS_ENUM(code, value, word, text) code = value,
    MW_STATUS_LIST(MW_STATUS_ENUM)
#undef MW_STATUS_ENUM
    MW_STATUS_END = 1000
} mw_status;

/* Largest input angle to either side, rad. */
#define MW_MAX_ANGLE 1e12

/* BEGIN INTERFACE (the Python package reads from here to END INTERFACE) */

/* Largest nx, no, np and nanchor of any model; largest angle, rad, to which one pair of teeth is followed. */
enum { MW_MAX_UNKNOWNS = 8, MW_MAX_OBSERVATION = 512, MW_MAX_PARAMETERS = 128, MW_MAX_ANCHOR = 96, MW_MAX_TURN = 10000 };

/* Record of one solve. step: largest change of an unknown in the last step, in natural sizes. residual: largest |R|
 * before the last step, rank_gap: smallest over largest pivot of the scaled Jacobian, both 0 where it was not
 * factorised with complete pivoting. guard: 1 + index of a failed guard, else 0. Of X_follow: the number of the tooth pair,
 * its own angle, rad, and whether it was solved from the reference, not from the solution before. */
typedef struct mw_info {
    int status, iterations, guard, cold;
    double step, residual, rank_gap, pair, angle;
} mw_info;

/* Contact geometry, fixed frame. Principal relative curvatures (wheel less pinion along the normal, 1/mm):
 * positive without interference. major: direction of curvature_min. lever: velocity of a member's point along the normal
 * for a unit velocity of its own angle, mm; ratio: instantaneous d(wheel angle)/d(pinion angle), the quotient of both.
 * flags: see mw_flag. */
typedef struct mw_contact {
    double point[3], normal[3];
    double curvature_min, curvature_max;
    double major[3];
    double distance, misfit;     /* |r1 - r2|, |n1 + n2| */
    int line;                    /* curvature_min is zero to round-off: line contact */
    unsigned flags;
    double lever_pinion, lever_wheel, ratio;
} mw_contact;

/* One flank of a drive at an input angle, of X_cycle: the pair that leads, counted from the reference of its own flank, the
 * transmission error, rad, and d(wheel angle)/d(pinion angle). pairs: how many touch within the limits of both flanks; 0 along
 * lines, of which nobody asks how far they reach. edge: pairs are looked at inside these limits only, and the edge of another
 * may touch before them; error and ratio are not numbers, and status is no success, where no pair touches inside. */
typedef struct mw_side {
    int status, pairs, edge;
    double pair, error, ratio;
} mw_side;

/* A drive at an input angle: the pair of X_reduce and its own angle; the flank that drives and the other one, in the angles of
 * the first; how far the wheel can turn from one to the other, rad, negative where the drive jams. */
typedef struct mw_cycle {
    double pair, angle;
    mw_side drive, coast;
    double backlash;
} mw_cycle;

/* END INTERFACE */
#endif
