/* Certified contact: proofs by arithmetic that encloses.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_CERTIFY_H
#define MW_CERTIFY_H

#include <stddef.h>
#include "mw_enclosures.h"
#include "mw_model.h"
#include "mw_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Why nothing is shown: value, word, what it means. */
#define MW_REASON_LIST(X) \
    X(MW_REASON_NONE, 0, "", "it is shown") \
    X(MW_REASON_LINE, 1, "line_contact", "the flanks touch along a line, or nearly: no single point is singled out") \
    X(MW_REASON_FOLD, 2, "fold", "the equations are singular or nearly so here: two contacts meet, or branches cross") \
    X(MW_REASON_WIDE, 3, "wide", "the equations cannot be told to have one solution in any box about the point") \
    X(MW_REASON_BOX, 4, "box", "neither a solution nor its absence can be shown in this box: divide it") \
    X(MW_REASON_OUTSIDE, 5, "outside", "the box reaches beyond the domain of the equations") \
    X(MW_REASON_DESIGN, 6, "design", "a size that follows from the design cannot be enclosed") \
    X(MW_REASON_CONTACT, 7, "no_contact", "there is no tangency to begin with: an edge or a corner touches, or nothing") \
    X(MW_REASON_ARITHMETIC, 8, "arithmetic", "this processor or compiler does not round as the bounds need") \
    X(MW_REASON_OFF_FLANK, 9, "off_flank", "the contact does not surely lie on both bounded flanks") \
    X(MW_REASON_CONDITION, 10, "condition", "places of a flank of this drive are not two free numbers, or its wheel turns otherwise") \
    X(MW_REASON_EFFORT, 11, "effort", "more or smaller parts of the flanks would have to be looked at than is allowed")

typedef enum mw_reason {
#define MW_REASON_ENUM(code, value, word, text) code = value,
    MW_REASON_LIST(MW_REASON_ENUM)
#undef MW_REASON_ENUM
    MW_REASON_END
} mw_reason;

/* BEGIN INTERFACE (the Python package reads from here to END INTERFACE) */

/* What is shown of the equations of contact: neither; one solution in the box, and the Jacobian regular in it; none. */
enum { MW_UNKNOWN, MW_UNIQUE, MW_NONE };

/* x[nx]: the solution lies within these; box[nx]: it is the only one within these of x[].hi + x[].lo. flags: those of
 * mw_flag that surely hold; undecided: those that the enclosure cannot tell. point: of the pinion, fixed frame; curvature:
 * principal, of the gap. Not numbers unless the outcome is MW_UNIQUE. */
typedef struct mw_certificate {
    int outcome, reason;
    unsigned flags, undecided;
    mw_wide x[8];
    double box[8];
    mw_ball point[3], normal[3], wheel_angle, curvature[2];
} mw_certificate;

const char *mw_reason_word(int reason);
const char *mw_reason_text(int reason);

/* Whether this library encloses the drive, and arithmetic here is what its bounds need. */
int mw_encloses(const mw_model *m);

/* Numbers of the enclosed state. */
int mw_enclosed_slots(const mw_model *m);

/* Complete an enclosed design: p[np], in the units of the keys where given, not a number where open; on return in inner
 * units and complete as mw_complete leaves a design. q[np + 1] work. Returns 0, or 1 + index of the design system whose
 * solution cannot be enclosed. */
int mw_enclose_design(const mw_model *m, mw_wide *p, double *q);

/* Design stage: p[np] of mw_enclose_design; s[mw_enclosed_slots]. */
void mw_enclose_setup(const mw_model *m, const mw_wide *p, mw_wide *s);

/* What another program can verify without trust in this one: about the doubles centre[n] the equations have exactly one zero
 * within box[n], and it lies within within[n], by Krawczyk's test with the matrix preconditioner[n*n], row by row. n is 0, and
 * reason a mw_reason, where that is not shown or not needed. */
typedef struct mw_proof {
    int n, reason;
    double centre[8], box[8], within[8], preconditioner[64];
} mw_proof;

/* mw_enclose_design with the proofs of the design systems that it solves: systems[nsystems]. */
int mw_prove_design(const mw_model *m, mw_wide *p, double *q, mw_proof *systems);

/* The proof of the contact near x[nx] at input angle phi. Returns its reason. */
int mw_prove(const mw_model *m, const mw_wide *s, mw_wide phi, const double *x, mw_proof *proof);

/* Certify the contact that x[nx], a solution in floating point at input angle phi, stands for: existence and uniqueness in
 * the widest box that a few steps find. line: whether the flanks are known to touch along a line. Returns the outcome. */
int mw_certify(const mw_model *m, const mw_wide *s, mw_wide phi, const double *x, int line, mw_certificate *c);

/* The same of a given box x +- d, d[nx] > 0: one solution, none, or unknown. */
int mw_certify_box(const mw_model *m, const mw_wide *s, mw_wide phi, const double *x, const double *d, mw_certificate *c);

/* Certify n points of one design at once, by plain doubles with radii: phi[n], x[n*nx]; unique[n] is 1 where the equations have
 * one solution within 2^-24 natural sizes of x, errors[n] then holds its transmission error. What doubles do not show is left
 * to mw_certify. set: as of mw_lanes, and proofs: the drive's, of mw_proofs_of or mw_proofs_<drive>() of an object of its own;
 * one point after the other where either is NULL, by tables where the object of m has no printed code for it either. Returns
 * how many are unique: none if the proofs are another drive's. */
struct mw_lane_set;
struct mw_proofs;
size_t mw_certify_many(const struct mw_lane_set *set, const struct mw_proofs *proofs, const mw_model *m, const mw_wide *s,
                       const mw_wide *phi, const double *x, size_t n, unsigned char *unique, mw_ball *errors);

/* A fold (crossing = 0) or crossing of branches of contact. unique: the equations have exactly one singular point within box
 * of the angle, rad, and likewise of the unknowns; it lies within angle and x. Of a crossing that is said of the equations
 * changed by `unfolding`, in shares of their slopes: two branches cross, or pass each other as close as so small a change
 * lets them. */
typedef struct mw_branch_certificate {
    int outcome, reason;
    mw_ball angle, x[8], unfolding;
    double box;
} mw_branch_certificate;

/* Certify what mw_branch_point found: angle and x[nx]. Returns the outcome. */
int mw_certify_branch(const mw_model *m, const mw_wide *s, int crossing, double angle, const double *x, mw_branch_certificate *c);

/* A piece of path: at every input angle centre + half t, -1 <= t <= 1, the equations have a solution within x[i].radius of the
 * polynomials x[nx], and no other within box[nx] of them: one branch, without turning point or crossing. margin: regular and
 * margins of the pinion, then of the wheel, along it; margins: how many; kinks: at how many places where the formula of a
 * flank changes, such as the start of a relief, the contact may be within the piece. */
typedef struct mw_piece {
    int outcome, reason, margins, kinks;
    double centre, half;
    mw_polynomial x[8];
    double box[8];
    mw_polynomial margin[32];
} mw_piece;

/* Shares of [-1, 1] at which the solutions of a piece are asked for, MW_ORDER + 1, ascending. */
void mw_piece_nodes(double *t);

/* Certify the piece from one angle to another, from its solutions x[(MW_ORDER + 1)*nx] at the nodes' angles. */
int mw_certify_piece(const mw_model *m, const mw_wide *s, double from, double to, const double *x, mw_piece *piece);

/* Whether two certified pieces that meet at an angle are of one branch: at the joint, the solution of the one lies where that of
 * the other is the only one. */
int mw_pieces_join(const mw_model *m, const mw_piece *before, const mw_piece *after, double angle);

/* The number of a polynomial of a piece at an angle. */
mw_ball mw_piece_at(const mw_piece *piece, const mw_polynomial *of, double angle);

/* Bounds of a polynomial over the angles from one to another, [low, high]: by halving down to 2^-depth of the piece. */
void mw_piece_range(const mw_piece *piece, const mw_polynomial *of, double from, double to, int depth, double *bounds);

/* Whether the flanks touch at a certified contact first. PROVED: with the wheel turned back from there, to the side on which
 * the gap is open, by any angle above slack and up to reach, no place of the one flank within the given parameters and its
 * limits, of the wheel's on the piece that holds the contact, is one of the other's.
 * REFUTED: they have one in common, surely: the parameters wheel[2] and pinion[2], nearly, and how far it is apart, rad,
 * negative; throughout: over a range of angles, at each of them, apart then holding it at all. Else the part of the wheel's flank that was looked at last, and why no more is known. ends, of pinion and wheel:
 * whether limits surely end the flank within the given parameters, or it goes on beyond them. parts: of the wheel's flank
 * that were looked at. */
enum { MW_FIRST_UNKNOWN, MW_FIRST_PROVED, MW_FIRST_REFUTED };

typedef struct mw_first_certificate {
    int outcome, reason, parts, throughout, ends[2];
    double wheel[2], pinion[2];
    mw_ball apart;
} mw_first_certificate;

/* Certify that a certified contact at phi is the first. flanks[8]: lowest and highest first and second parameter of the
 * pinion's flank, then of the wheel's. slack, reach: rad of the wheel. effort: most parts. work[mw_certify_first_work()].
 * Returns the outcome. */
int mw_certify_first(const mw_model *m, const mw_wide *s, mw_wide phi, const mw_certificate *contact, const double *flanks,
                     double slack, double reach, int effort, double *work, mw_first_certificate *c);
size_t mw_certify_first_work(void);

/* The same at every input angle from one to another of a certified piece of path at once; pinion_turn, wheel_turn: by how much
 * both bodies are turned further, 0 or by pitches of theirs, so that it is said of another pair. angle: where what c names
 * lies, not a number where it names nothing. */
int mw_certify_first_along(const mw_model *m, const mw_wide *s, const mw_piece *piece, double from, double to, mw_wide pinion_turn,
                           mw_wide wheel_turn, const double *flanks, double slack, double reach, int effort, double *work,
                           mw_first_certificate *c, double *angle);

/* A curve along which flanks touch, or nearly: how far they stand apart along it with the wheel at an angle. apart: bounds,
 * rad of the wheel, negative where they overlap; nearest: somewhere on it they stand apart by no more than this; limit:
 * bounds of the smallest limit of both flanks, in the units of their limits: above 0 the curve surely lies on both, below 0
 * surely beyond one. parts: of the curve that were looked at. */
typedef struct mw_line_certificate {
    int outcome, reason, parts;
    double apart[2], nearest, limit[2];
} mw_line_certificate;

enum { MW_CURVE_TERMS = 5 };

/* Enclose them. pose: a certificate that has the wheel's angle, and a point and the normal there by which sides are told;
 * curve[4 * MW_CURVE_TERMS]: polynomials over [-1, 1] of the wheel's two parameters and, nearly, of the pinion's that meet
 * them. flanks, work: as of mw_certify_first. fine: rad within which each part is told. Returns MW_UNIQUE or MW_UNKNOWN. */
int mw_certify_line(const mw_model *m, const mw_wide *s, mw_wide phi, const mw_certificate *pose, const double *flanks,
                    const double *curve, double fine, double *work, mw_line_certificate *c);

/* Both of one place of the flanks at every input angle of a piece, whose polynomials, of whatever path, say where it is: the
 * wheel's parameters and error as they are, the pinion's nearly those that meet it. Parts of either flank follow it, so that
 * flanks may touch all along a line. */
int mw_certify_first_followed(const mw_model *m, const mw_wide *s, const mw_piece *piece, const double *flanks, double slack,
                              double reach, int effort, double *work, mw_first_certificate *c);
int mw_certify_line_along(const mw_model *m, const mw_wide *s, const mw_piece *piece, const double *flanks, double fine, double *work,
                          mw_line_certificate *c);

/* What proves many contacts of a drive that is built into this library; NULL for any other. */
const struct mw_proofs *mw_proofs_of(const mw_model *m);

/* Both for n points: phi[n], x[n*nx], line[n], d[n*nx], c[n]. Return the number of those that are shown to be unique. */
size_t mw_certify_points(const mw_model *m, const mw_wide *s, const mw_wide *phi, const double *x, const int *line, size_t n,
                         mw_certificate *c);
size_t mw_certify_boxes(const mw_model *m, const mw_wide *s, const mw_wide *phi, const double *x, const double *d, size_t n,
                        mw_certificate *c);

/* END INTERFACE */

#ifdef __cplusplus
}
#endif
#endif
