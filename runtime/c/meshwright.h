/* meshwright: tooth contact analysis on generated models.  SPDX-License-Identifier: MIT-0
 *
 * C99, no heap, no globals, no input or output; every function is re-entrant and the caller owns all memory.
 * Units: mm, rad. A model comes from a generated header ("<drive>_model") or, in the shared library, from mw_find. */
#ifndef MESHWRIGHT_H
#define MESHWRIGHT_H

#include <stddef.h>
#include "mw_model.h"
#include "mw_status.h"
#include "mw_certify.h"

#ifdef __cplusplus
extern "C" {
#endif

/* BEGIN INTERFACE (the Python package reads from here to END INTERFACE) */

int mw_abi(void);
const char *mw_status_word(int status);
const char *mw_status_text(int status);
int mw_model_count(void);
const mw_model *mw_model_at(int index);
const mw_model *mw_find(const char *drive);

/* A drive whose object has its lane kernels and its equations with error bounds in objects beside it, with those of
 * mw_in_lanes_<drive>() and mw_proofs_<drive>(); without one that is NULL: lanes are then traced one by one, and points proved
 * by tables, to the same bits. room[mw_joined_size()] as of malloc, which the result is in. NULL if one is another drive's. */
struct mw_in_lanes;
struct mw_proofs;
size_t mw_joined_size(void);
const mw_model *mw_joined(const mw_model *m, const struct mw_in_lanes *lanes, const struct mw_proofs *proofs, void *room);

/* Complete the parameters p[np] of a design (NaN: open) by rules, defaults and the model's design systems;
 * q[np + 1] work. Returns 0, or 1 + index of the design system that has no regular solution, or -1 for a foreign table. */
int mw_complete(const mw_model *m, double *p, double *q, mw_info *info);

/* Which contact. The equations may hold in several places of a tooth pair at once, and also in places where bodies cannot
 * touch. The contact of a pair at an input angle is
 *   1. at the reference angle (0 unless the model names another), the tangency in the middle of the flanks, to which the
 *      model's start values lead; where bodies cannot make it but can make another as under 3, that one; elsewhere the
 *      point of the branch of contact through it. Where nothing touches there, the branch is that of a contact on both flanks at the nearest of a fixed series of angles;
 *   2. that point stays the contact where it lies beyond a limit of a flank, which is then flagged;
 *   3. where bodies cannot make it (see mw_impossible), or the branch ends before the angle: a contact within all limits
 *      of both flanks that bodies can make, the nearest to the middle that a search over the wheel flank finds. The teeth
 *      must not overlap elsewhere on a face that is as wide on the other side of the middle as this contact needs;
 *   4. where there is none: the point of 1 with its flags, or the status that says how the branch ended.
 * So one angle has one contact and one status, whichever other angles are asked for. A line of contact has no branch:
 * there every angle is solved from the start values. */

/* Solve one point. p[np] complete; s[ns] is left set up for p and phi; work[np]; x[nx] result, not a number where
 * there is none. Misalignments are applied by continuation. Returns info->status. */
int mw_solve(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info);

/* Solve from start values x[nx], state s set up for p and phi already. Returns info->status. */
int mw_refine(const mw_model *m, const double *s, double *x, mw_info *info);

/* Solve the points phi[n], each predicted from its predecessors: the same contacts as of mw_solve, faster where the
 * angles are in order. x[n*nx], info[n]. Returns the number of points that succeeded. */
size_t mw_trace(const mw_model *m, const double *p, const double *phi, size_t n, double *s, double *work, double *x,
                mw_info *info);

/* Largest input angle to either side, rad: MW_MAX_ANGLE. */
double mw_largest_angle(void);

/* The pair whose reference angle is the nearest to phi: its number and, returned, its own angle, as of X_reduce. */
double mw_reduce(const mw_model *m, const double *p, double phi, double *pair);

/* The contact of whichever pair is in mesh at each of phi[n] in turn, as of X_follow: x[n*nx] at info[k].angle of pair
 * info[k].pair. Returns the number of points that succeeded. */
size_t mw_turn(const mw_model *m, const double *p, const double *phi, size_t n, double *s, double *work, double *x,
               mw_info *info);

/* The whole drive at each of phi[n], as of X_cycle: c[mw_cycle_size(m)] from mw_cycle_setup of complete parameters of either
 * flank, p[np] of the one that drives and coast[np], which may be NULL. mw_cycle_setup returns 0, 1 + index of a guard that
 * one of them does not pass, or -1 for a foreign table; mw_cycles the number of angles at which a pair touches. */
int mw_cycle_size(const mw_model *m);
int mw_cycle_setup(const mw_model *m, const double *p, const double *coast, double *c);
size_t mw_cycles(const mw_model *m, double *c, const double *phi, size_t n, mw_cycle *out);

/* Follow the branch through the solution x0 at phi0 along phi[n], in order, starting near phi0; x[n*nx], info[n].
 * s is set up. Stops where the branch ends or an angle is none: returns how many points were solved; info of the next one says why. */
size_t mw_follow(const mw_model *m, double *s, double phi0, const double *x0, const double *phi, size_t n, double *x,
                 mw_info *info);

/* Points of a branch that is known at `nodes` of its places, x0[nodes*nx] at phi0[nodes]: point k, phi[k], beside node[k],
 * and NaN where the branch does not reach it from there or there is no such node; x[n*nx], info[n]. s is set up. Returns
 * the number of points that succeeded. */
size_t mw_from_nodes(const mw_model *m, double *s, const double *phi0, const double *x0, size_t nodes, const int *node,
                     const double *phi, size_t n, double *x, mw_info *info);

/* Observations o[n*no] of the unknowns x[n*nx] at the angles phi[n], s set up; NaN where an unknown is not a number. */
int mw_observe(const mw_model *m, double *s, const double *phi, const double *x, size_t n, double *o);

/* Kernels over several lanes for one instruction set: with vectors of the given width, or of the widest this processor
 * runs if width is 0; NULL if it runs none of that width. Width 2 gives the same bits on every machine; wider ones fuse
 * products into sums, and agree with one another to the last bit. */
typedef struct mw_lane_set mw_lane_set;
const mw_lane_set *mw_lanes(int width);
int mw_lanes_width(const mw_lane_set *set);
const char *mw_lanes_name(const mw_lane_set *set);

/* Numbers of work for a trace of n points a lane. */
size_t mw_lanes_work(const mw_lane_set *set, const mw_model *m, size_t n);

/* Trace many designs p[designs*np] along the same phi[n]: x[designs*n*nx], status[designs*n]. start[nx] is close to
 * the solutions at phi[0], for example that of the nominal design. What the lanes cannot follow is traced by mw_trace.
 * work[mw_lanes_work(set, m, n)]. Returns the number of points that succeeded. */
size_t mw_trace_designs(const mw_lane_set *set, const mw_model *m, const double *p, size_t designs, const double *phi,
                        size_t n, const double *start, double *work, double *x, int *status);

/* Trace one design along phi[n], each lane a part of it: as above, work for ceil(n / width) points. */
size_t mw_trace_angles(const mw_lane_set *set, const mw_model *m, const double *p, const double *phi, size_t n,
                       double *work, double *x, int *status);

/* The flank of a body, or of a region, at n places: q[n*parameters] -> o[n*outputs]; s is set up. */
void mw_flank(mw_surface flank, int parameters, int outputs, const double *s, const double *q, size_t n, double *o);

/* Two coordinates of a surface: sums, with factors[2][parameters + 4], of the parameters, of x, y and z in the body frame and of
 * the distance from the body's axis; those of the next place stand so many numbers `apart`, 0 for the same everywhere. It has
 * as many implicit conditions as leave two parameters free; sizes[parameters]: natural. */
typedef struct mw_coordinates {
    mw_surface surface;
    int parameters, outputs, apart;
    const double *sizes, *factors;
} mw_coordinates;

/* Places q[n*parameters] with the coordinates at[2*i] and at[2*i + 1], by Newton's method from the places that q holds
 * before; not a number where it finds none. s is set up; o[outputs] work. Returns MW_CONVERGED, or MW_BAD_INPUT for
 * numbers that describe no such surface. */
int mw_places(const mw_coordinates *by, const double *s, const double *at, size_t n, double *o, double *q);

/* Where n rays, from[3*n] and unit vectors along[3*n] in the body frame, meet a surface of mw_body or mw_region: distance[n]
 * along them, mm, negative behind where they begin, and places q[n*parameters], by at most 16 steps of Newton's method from
 * the places that q holds before and no distance: the meeting that it comes to, not the first, and of the surface, which
 * goes on beyond the limits of the flank. Where it comes to none, the distance is not a number, and q where it was left.
 * No step is longer than `longest`, mm on the surface. A ray whose end strays to `farthest`, mm, on the way is given up:
 * several times the distance that is wanted is enough. s is set up; o[outputs] work. Returns as above, and MW_BAD_INPUT
 * unless both lengths are positive. */
int mw_rays(mw_surface surface, int parameters, int outputs, const double *s, const double *from, const double *along,
            size_t n, double longest, double farthest, double *o, double *q, double *distance);

/* Follow the branch of contact through (phi0, x0) in arclength: up to count steps of |step| natural sizes, shorter where
 * the branch bends, towards larger angles first if step > 0. At each point of phi[count+1], x[(count+1)*nx]: slope = d(phi)/d(arclength), which
 * changes sign at a fold, and the bordered determinant, which changes sign where another branch crosses.
 * s[ns] set up by setup(). Returns the number of points: the first is x0 corrected. */
size_t mw_arclength(const mw_model *m, double *s, double phi0, const double *x0, double step, size_t count, double *phi,
                    double *x, double *slope, double *determinant);

/* Follow the line of contact at the angle that s is set up for: from x[nx], corrected straight onto the line, count steps of
 * so many natural sizes: x[(count+1)*nx]. border[2*nx], unit vectors in natural sizes: the direction of the line and the left
 * null vector of the Jacobian near x; at the end those at the last point. Returns the number of points, fewer where the line
 * is lost. */
size_t mw_line(const mw_model *m, const double *s, double *border, double step, size_t count, double *x);

/* The singular point of the equations next to phi and x[nx], to round-off. crossing = 0: a fold, where the branch turns
 * back (dR/dx singular); else a point where another branch crosses, a pitchfork or transcritical point (dR/d(x, phi)
 * singular). Newton's method on the extended system of Moore, "The numerical treatment of non-trivial bifurcation points",
 * Numer. Funct. Anal. Optim. 2 (1980): the residual, the left null vector and its length, with exact second derivatives.
 * s[ns] set up by setup(). Returns MW_CONVERGED, or MW_DIVERGED if there is none nearby; phi and x are then unchanged. */
int mw_branch_point(const mw_model *m, double *s, int crossing, double *phi, double *x);

/* One call for a whole trace: mw_trace, then the contact geometry of every point: o[n*no], contact[n] (NaN and 0 where
 * there is none). info[k].status becomes line contact where the flanks touch along a line. A point that does not pass
 * mw_touch is solved again by itself. Returns the number of points that succeeded. */
size_t mw_analyse(const mw_model *m, const double *p, const double *phi, size_t n, double *s, double *work, double *x,
                  mw_info *info, double *o, mw_contact *contact);

/* The geometry of contacts solved already, x[n*nx] at phi[n], where info[k].status >= 0; s is set up. As above, but a
 * point that does not pass mw_touch gets its status. */
void mw_contacts(const mw_model *m, double *s, const double *phi, size_t n, const double *x, mw_info *info, double *o,
                 mw_contact *contact);

/* Contact points[designs*n*3] (fixed frame; NaN where there is none) and flags[designs*n] of what mw_trace_designs
 * solved; status[designs*n] becomes line contact where the flanks touch along a line, and what mw_touch says where they
 * do not touch. Work: s[ns], o[no]. */
void mw_contact_points(const mw_model *m, const double *p, size_t designs, const double *phi, size_t n,
                       const double *x, int *status, double *s, double *o, double *points, unsigned *flags);

/* mw_complete differentiated: dp[np] holds the changes of the parameters given[np] (NaN: open) and receives those that
 * follow from them by rules and design systems; p[np] is given, completed. Returns MW_CONVERGED, or why a design system
 * has no regular solution. */
int mw_complete_tangent(const mw_model *m, const double *given, const double *p, double *dp);

/* Exact derivatives of a contact along changes dp[np] of the complete parameters p[np] and dphi of the angle: dx[nx]
 * of the unknowns, dr[3] of the contact point, fixed frame. s set up for p and phi, x[nx] the solution. Returns
 * MW_CONVERGED, or MW_SINGULAR where the contact does not determine its point. */
int mw_contact_tangent(const mw_model *m, const double *p, const double *dp, double phi, double dphi, const double *s,
                       const double *x, double *dx, double *dr);

/* Of contacts x[n*nx] at angles phi[n] of a design p[np], how their points move with the angle: dr[3*n], fixed frame, mm/rad, not
 * numbers where that is not determined. s[ns], work[np + nx]. */
void mw_contact_motion(const mw_model *m, const double *p, const double *phi, size_t n, const double *x, double *s, double *work,
                       double *dr);

/* Exact derivatives dr[n*3] of points of the flank of a body (0 pinion, 1 wheel), body frame, at fixed flank parameters
 * q[n*parameters], along changes dp[np] of the complete parameters p[np]. Their normal part is the change of the flank
 * along its normal. Returns MW_CONVERGED, or MW_BAD_INPUT where the model has no tangents or no such body. */
int mw_flank_tangent(const mw_model *m, int body, const double *p, const double *dp, const double *q, size_t n,
                     double *dr);

/* Both in a row, along a change[np] of the given parameters: dp[np], dx[nx], dr[3] and returns as above. */
int mw_sensitivity(const mw_model *m, const double *given, const double *p, double phi, const double *s,
                   const double *x, const double *change, double *dp, double *dx, double *dr);

/* Contact geometry at a solution; o[no] receives the observation. Returns MW_CONVERGED or MW_LINE_CONTACT, or what
 * mw_touch says where x is no contact: c is then the geometry of two surfaces that do not touch. */
int mw_contact_at(const mw_model *m, const double *s, const double *x, double *o, mw_contact *c);

/* Success means touching: the gate that every solution passes which anything here calls a success. Judges x[nx] by its
 * observation o[no]. MW_CONVERGED where position and direction of both normals, opposed, agree within the rounding of
 * their own terms and every surface parameter is in its domain; else MW_LEFT_FLANK (outside a domain), MW_NO_CONTACT
 * (normals parallel: both bodies on the same side) or MW_DIVERGED. */
int mw_touch(const mw_model *m, const double *x, const double *o);

/* Contact of an edge. A margin of a body whose role is tip, throat or face ends its flank in an edge. The number of the
 * system in which that edge, by the numbers of the margins, touches the mating flank (-1) or the mating edge; -1: the drive
 * has no such edge. */
int mw_edge(const mw_model *m, int pinion_margin, int wheel_margin);

/* The equations of a system at x[nx], as of the model's eval(): R[nx], J[nx*nx] or NULL; solved from x[nx]. s is set up.
 * Return MW_CONVERGED or another success, or why there is no solution: MW_BAD_INPUT also where there is no such system.
 * A margin that the design leaves open has no edge: MW_LEFT_FLANK. */
int mw_edge_eval(const mw_model *m, int edge, const double *s, const double *x, double *R, double *J);
int mw_edge_solve(const mw_model *m, int edge, const double *s, double *x, mw_info *info);

/* Follow the contact of an edge from x0[nx] at phi0, close to a solution, along phi[n]: as mw_follow. */
size_t mw_edge_follow(const mw_model *m, int edge, double *s, double phi0, const double *x0, const double *phi, size_t n,
                      double *x, mw_info *info);

/* Limits of a surface, 0 pinion, 1 wheel, 2 + number of a region, at q[n*parameters]; limits are regular and the margins.
 * order 1: o[n*limits*parameters] slopes of each limit. order 2, of flanks: o[n*(3 + limits + conditions)*pairs] second
 * derivatives of the point, of each limit and of each condition by the pairs (1, 1), (1, 2), ... of parameters. s is set
 * up. Returns MW_CONVERGED, or MW_BAD_INPUT where the model has no such function. */
int mw_bounds(const mw_model *m, int surface, int order, const double *s, const double *q, size_t n, double *o);

/* The bounded flank of the wheel as triangles, right hand: q[vertices*parameters] inside all limits, those of its border
 * on them, corner[triangles*3]; open[vertices]: whether nothing in the design ends the flank there. span: the two
 * parameters that span the flank; its conditions, two at most, give the others. Natural sizes of the parameters of either
 * flank. */
typedef struct mw_flank_mesh {
    size_t vertices, triangles;
    const double *q;
    const int *corner;
    const unsigned char *open;
    int span[2];
    const double *wheel_sizes, *pinion_sizes;
} mw_flank_mesh;

/* Where two bounded flanks touch first. wheel_turn: how far the wheel has turned then; lever: mm of normal approach per
 * rad. limit: what holds the place, on flank member (0 pinion, 1 wheel): 0 the singular line, 1 + number of a margin, -1
 * none: two of -1 are a tangency. point, normal (out of the pinion): fixed frame. met: vertices that meet the pinion's
 * bounded flank; open: those of them where nothing ends the flank. unresolved: a further extreme that the search could not
 * exclude would overlap by this at most, mm. apart: how far, nearly, the flanks stand apart a step of 0.05 natural sizes beside the
 * place, mm, along whichever curve through it that is least: next to nothing on a line. */
typedef struct mw_first {
    int status, limit[2], member[2];
    double wheel_turn, lever, q_wheel[4], q_pinion[4], point[3], normal[3], unresolved, apart;
    size_t met, open;
} mw_first;

/* Where the flanks of a pair touch first as the wheel comes from the side on which the gap is open: sense = +1, from
 * larger angles, or -1. pinion[steps*12], wheel[steps*12]: placements of the bodies, three rows of four, the last of them
 * those asked for; the wheel turns about its own z by turn (+1 or -1) times its angle. start: parameters of the wheel's and
 * of the pinion's flank and turn of the wheel where the two meet at the first placements, nearly; further placements lead
 * from there in steps. until: turn of the wheel, as wheel_turn, up to which the first contact is asked for, -sense times
 * infinity wherever it is: beyond, what is found may be a later contact of the flanks, or none. work[mw_first_contact_work(
 * vertices)]. Returns what kind of contact it is, MW_CONVERGED (a tangency), MW_EDGE_CONTACT or MW_CORNER_CONTACT; on a line,
 * which is no kind of its own here, see mw_first_curve, any of them; MW_NO_CONTACT where no point of the wheel's flank meets the pinion's or where both go
 * on with nothing to end them, MW_DIVERGED where the start does not lead to the flank, or MW_BAD_INPUT for flanks of another
 * kind. */
int mw_first_contact(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                     const double *wheel, size_t steps, double turn, double sense, const double *start, double until,
                     double *work, mw_first *found);
size_t mw_first_contact_work(size_t vertices);

/* Whether what mw_first_contact found at three pinion angles leads at all between them: found[3] there, none with an `until`,
 * met[3] what each search left at the begin of its work, mw_first_met_size(vertices) numbers each; pinion[3*12], wheel[3*12] the
 * placements, `share` that of the way from the first to the last at which the second lies. 1: wherever it leads from one to the
 * next, no other place of the flanks stands before it by more than half of what the search resolves at one angle, by the same
 * bounds; or, where no point met at any, none meets between; or, where flanks were open at all, they are between. 0: that is not shown. work[mw_first_lasts_work()]. */
int mw_first_lasts(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion, const double *wheel,
                   double share, double turn, double sense, double *const *met, const mw_first *found, double *work);
size_t mw_first_lasts_work(void);
size_t mw_first_met_size(size_t vertices);

/* From a place of first contact, `from`, to the extreme near it at each of n placements, one after the other, pinion[n*12] and
 * wheel[n*12]: found[n], of which `unresolved`, met and open are not set, MW_DIVERGED where none is reached. Returns how many are.
 * That they are first is shown by mw_first_lasts. */
size_t mw_first_along(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion, const double *wheel,
                      size_t n, double turn, double sense, const mw_first *from, mw_first *found);

/* The curve through a place at[1] of first contact: with limit = -1 the ridge on which the wheel angle is extreme across it,
 * else the border of a member (0 pinion, 1 wheel) on which that limit of it, numbered as in mw_first, holds. Where the wheel
 * angle is the same all along it, the flanks touch along it. From one of its places on both flanks, the nearest to `at`, it
 * goes both ways, in steps of so many natural sizes, to where another limit ends it (limit[1] and member[1] of the end, -1
 * where none does), or where the place that its angle gives to the flanks lies further back than `fall`, mm along the normal.
 * found[2*count + 1] in order along it, of which `unresolved`, met and open are not set; work[mw_first_curve_work(count)].
 * Placements as the last ones of mw_first_contact. Returns the number of places, 0 where no part of it lies on both flanks. */
size_t mw_first_curve(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion, const double *wheel,
                      double turn, double sense, const mw_first *at, int member, int limit, double step, double fall,
                      size_t count, double *work, mw_first *found);
size_t mw_first_curve_work(size_t count);

/* The place on the ridge through `at` that lies deepest inside the limits of both flanks, limit[0] and member[0] the one that it
 * is nearest to, limit[1] and member[1] another one as near, and how deep, the value of that limit, negative where the ridge misses the flanks. Returns as
 * mw_first_contact. */
int mw_first_deepest(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion, const double *wheel,
                     double turn, double sense, const mw_first *at, double step, double *depth, mw_first *found);

/* Start values x[nx] of the contact in the middle of the flanks, no solution; s is set up for its angle. Returns MW_CONVERGED, or
 * why they are only a first guess. */
int mw_start_values(const mw_model *m, const double *s, double *x);

/* Name of flag number bit of mw_contact.flags, NULL where there is none. */
const char *mw_flag(const mw_model *m, int bit);

/* Whether a flag marks points that satisfy the equations but that bodies cannot make. */
int mw_impossible(const char *flag);

/* END INTERFACE */

#ifdef __cplusplus
}
#endif
#endif
