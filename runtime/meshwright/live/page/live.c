/* What the live page calls: one design, completed and solved at many input angles. No C library, no heap; all numbers
 * pass through the buffers below. Compile with -DLIVE_DRIVE=NAME and -DLIVE_HEADER, its header in quotes.
 * SPDX-License-Identifier: MIT-0 */
#include LIVE_HEADER
#include "exact.h"

#define JOIN2(drive, name) drive##_##name
#define JOIN(drive, name) JOIN2(drive, name)
#define X(name) JOIN(LIVE_DRIVE, name)
#define EXPORT __attribute__((visibility("default")))

/* Most places of a flank at once; numbers of a place, the most that a flank writes for it, and what is kept of that. */
enum { MOST_PLACES = 4096, MOST_COORDINATES = 3, MOST_WRITTEN = 64, KEPT = 6 };

/* Most angles in a cycle; numbers of a row before unknowns x[NX], observation o[NO] and placement. */
enum { MOST_ANGLES = 1024, HEAD = 21, MOST_PLACEMENT = 64, ROW = HEAD + X(NX) + X(NO) + MOST_PLACEMENT };

static double parameters[X(NP)], sizes[X(ND) + 1], angles[MOST_ANGLES], rows[MOST_ANGLES * ROW];
static double places[MOST_PLACES * MOST_COORDINATES], shape[MOST_PLACES * KEPT];

EXPORT double *live_parameters(void) { return parameters; }
EXPORT double *live_sizes(void) { return sizes; }
EXPORT double *live_angles(void) { return angles; }
EXPORT double *live_rows(void) { return rows; }
EXPORT double *live_places(void) { return places; }
EXPORT double *live_shape(void) { return shape; }
EXPORT int live_row_length(void) { return ROW; }
EXPORT int live_most_angles(void) { return MOST_ANGLES; }

/* Complete the parameters (NaN: open) in place and derive the sizes: 0, k if the k-th design system has no solution, −k
 * if the k-th guard does not hold. */
EXPORT int live_complete(void)
{
    double s[X(NS)];
    const int system = X(solve_design)(parameters, NULL);
    if (system) return system;
    const int guard = X(setup)(parameters, s);
    if (guard) return -guard;
    X(size)(parameters, sizes);
    return 0;
}

static const mw_function *placement(void)
{
    for (int k = 0; k < X(model).nfunctions; k++)
        if (mwi_same_text(X(model).functions[k].name, "placement")) return &X(model).functions[k];
    return NULL;
}

/* One row: status, iterations, line, flags, point, normal, curvatures, major direction, distance, misfit, lever arms,
 * ratio, 1 free; x, o, placement of both members. Not a number where there is no contact. The steps are those of
 * X(solve), which finds the pair's reference for each angle anew; here one is found for all. */
static int row_of(mwi_pair *pair, double phi, double *row)
{
    double *const x = row + HEAD, *const o = x + X(NX), *const place = o + X(NO);
    const mw_function *const bodies = placement();
    mw_info info = mwi_ended(MW_BAD_INPUT, 0);
    mw_contact c;
    for (int i = 0; i < ROW; i++) row[i] = NAN;
    row[0] = info.status;
    mwi_solved(pair, phi, x, &info);
    pair->m->set_phi(pair->s, phi);
    int status = info.status;
    row[1] = info.iterations;
    if (status >= 0) {
        const int kind = X(geometry)(pair->s, x, o, &c);
        if (kind != MW_CONVERGED) status = kind;
    }
    row[0] = status;
    if (status < 0) {
        for (int i = HEAD; i < ROW; i++) row[i] = NAN;
        return 0;
    }
    row[2] = c.line;
    row[3] = c.flags;
    for (int i = 0; i < 3; i++) row[4 + i] = c.point[i], row[7 + i] = c.normal[i], row[12 + i] = c.major[i];
    row[10] = c.curvature_min;
    row[11] = c.curvature_max;
    row[15] = c.distance;
    row[16] = c.misfit;
    row[17] = c.lever_pinion;
    row[18] = c.lever_wheel;
    row[19] = c.ratio;
    if (bodies && bodies->outputs <= MOST_PLACEMENT) {
        const double at[2] = { phi, o[X(model).wheel_angle] };
        bodies->evaluate(pair->s, at, place);
    }
    return 1;
}

/* Solve the completed design at the first n angles, which ascend: row k for angle k. Returns how many angles have a
 * contact, −1 for a design or a number that cannot be solved. Each side is walked away from the reference. */
EXPORT int live_cycle(int n)
{
    double s[X(NS)], work[X(NP)];
    mwi_pair pair;
    int count = 0, first = 0;
    if (n > MOST_ANGLES || X(setup)(parameters, s)) return -1;
    pair.m = &X(model), pair.p = parameters, pair.s = s, pair.work = work;
    mwi_find_reference(&pair);
    while (first < n && angles[first] < mwi_reference_angle(&pair)) first++;
    for (int k = first; k < n; k++) count += row_of(&pair, angles[k], rows + (size_t)k * ROW);
    for (int k = first - 1; k >= 0; k--) count += row_of(&pair, angles[k], rows + (size_t)k * ROW);
    return count;
}

/* Points and unit normals out of the material, body frame, of the completed design's flank of a member (0 pinion, 1
 * wheel) at n places, given by all its parameters. Returns how many numbers a place has, −1 for a design or a number that
 * cannot be. */
EXPORT int live_flank(int member, int n)
{
    double s[X(NS)], o[MOST_WRITTEN];
    const mw_body *const body = &X(model).bodies[member];
    const int k = body->parameters;
    if (n > MOST_PLACES || k > MOST_COORDINATES || body->outputs > MOST_WRITTEN || X(setup)(parameters, s)) return -1;
    for (int i = 0; i < n; i++) {
        body->flank(s, places + (size_t)i * (size_t)k, o);
        for (int j = 0; j < KEPT; j++) shape[i * KEPT + j] = o[j];
    }
    return k;
}
