/* The drive at an input angle: the pair that leads on either flank, and the play between.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_CYCLE_H) && !defined(MW_DEVICE_ONLY)
#define MWI_CYCLE_H

#include "follow.h"

/* Pairs of which a side keeps the last solution: more may be in mesh, which then share a place and are solved anew. */
enum { MWI_PLACES = 16 };

/* Looks for where a pair is on both flanks: one of these must find it to either side of the reference, and it is followed over
 * no more than 64 pitches: no pair is in mesh longer whose teeth end. */
enum { MWI_LOOKS_A_PITCH = 16, MWI_LOOKS = 8 * MWI_LOOKS_A_PITCH, MWI_HALVINGS = 60 };
static const double MWI_LOOKS_FOLLOWED = 1024.0;

/* An end of a window is located to this part of the way between two looks. */
static const double MWI_END_TOLERANCE = 1.6e-13;

/* What both sides of a drive have in common: the ratio; what to add to the driving flank's angles of pinion and wheel to have
 * the other's for the same stand of the bodies; then the sides. */
enum { MWI_RATIO, MWI_PINION_OFFSET, MWI_WHEEL_OFFSET, MWI_SIDES };

/* A side: how it can be asked, one of these numbers; whether the wheel is pushed to larger angles, 1, or to smaller, -1; two
 * ends; the state from setup, then angle and unknowns of the last solution in each of MWI_PLACES. An end: the own angle up to
 * which a pair is on both flanks, its error there and the slope of that, not a number where no surface goes on beyond it. */
enum { MWI_END_ANGLE, MWI_END_ERROR, MWI_END_SLOPE, MWI_END };
enum { MWI_KIND, MWI_SENSE, MWI_LOWER, MWI_UPPER = MWI_LOWER + MWI_END, MWI_STATE = MWI_UPPER + MWI_END };
static const double MWI_ABSENT = 0.0, MWI_NO_WINDOW = 1.0, MWI_OF_LINES = 2.0, MWI_OF_POINTS = 3.0;

/* A pair is ahead of another, and may touch with an edge before it, by more than this, rad: beyond rounding. */
static const double MWI_AHEAD = 2e-15, MWI_EDGE_AHEAD = 5e-14;

/* Halvings of an angle until its tangent is small, and terms of the arc tangent's series then. */
enum { MWI_ANGLE_HALVINGS = 3, MWI_ARC_TERMS = 9 };

static inline int mwi_side_size(const mw_model *m)
{
    return MWI_STATE + m->ns + MWI_PLACES * (1 + m->nx);
}

static inline const double *mwi_parameters_in(const mw_model *m, const double *side)
{
    return side + MWI_STATE + m->ns - m->np;
}

/* The angle of a vector of length 1. */
static inline double mwi_angle_of(double cosine, double sine)
{
    double tangent = sine / (1.0 + mwi_abs(cosine)), sum = 0.0;
    for (int k = 0; k < MWI_ANGLE_HALVINGS; k++) tangent /= 1.0 + sqrt(1.0 + tangent * tangent);
    for (int k = MWI_ARC_TERMS - 1; k >= 0; k--) sum = 1.0 / (2 * k + 1) - tangent * tangent * sum;
    const double angle = (double)(2 << MWI_ANGLE_HALVINGS) * tangent * sum;
    return cosine >= 0.0 ? angle : (sine < 0.0 ? -MWI_HALF_A_TURN : MWI_HALF_A_TURN) - angle;
}

static inline double mwi_floor(double a)
{
    const double nearest = (a + MWI_TO_INTEGER) - MWI_TO_INTEGER;
    return nearest > a ? nearest - 1.0 : nearest;
}

/* The contact of pair 0 at its own angle, from the last solution in a place. */
static inline int mwi_pair_at(const mw_model *m, double *side, int place, double angle, double *x, mw_info *info)
{
    double p[MW_MAX_PARAMETERS], work[MW_MAX_PARAMETERS];
    double *const s = side + MWI_STATE, *const kept = s + m->memory, *const last = s + m->ns + place * (1 + m->nx);
    mwi_copy(p, mwi_parameters_in(m, side), m->np);
    mwi_copy(x, last + 1, m->nx);
    mwi_copy(kept + MWI_KEPT + m->nx, last + 1, m->nx);
    kept[MWI_LAST_KEPT] = last[0];
    mwi_follow_at(m, p, angle, s, work, x, info);
    last[0] = kept[MWI_LAST_KEPT];
    mwi_copy(last + 1, kept + MWI_KEPT + m->nx, m->nx);
    return info->status;
}

/* How pair 0 touches at its own angle, with its contact in x and c: on both flanks; beyond a limit of one, on the surface that
 * goes on there; or not, or in what is no flank. */
enum { MWI_ON_FLANKS, MWI_BEYOND_LIMIT, MWI_NOWHERE };

static inline int mwi_touches(const mw_model *m, double *side, double angle, double *x, mw_contact *c)
{
    double o[MW_MAX_OBSERVATION];
    mw_info info;
    int within = 1;
    if (mwi_pair_at(m, side, 0, angle, x, &info) < 0) return MWI_NOWHERE;
    mwi_contact_at(m, side + MWI_STATE, x, o, c);
    if (mwi_worth_in(m, c) == MWI_IMPOSSIBLE) return MWI_NOWHERE;
    for (const mw_body *b = m->bodies; b < m->bodies + 2; b++) {
        if (o[b->regular] < 0.0) return MWI_NOWHERE;
        for (int i = 0; i < b->margins; i++) within &= !(o[b->margin + i] < 0.0);
    }
    return within ? MWI_ON_FLANKS : MWI_BEYOND_LIMIT;
}

/* From an own angle at which pair 0 touches on both flanks, in steps, to the last at which it does. The end is infinite where
 * that is not found within half a turn of the wheel. */
static inline void mwi_find_end(const mw_model *m, double *side, double inside, double step, double ratio, double *end)
{
    double x[MW_MAX_UNKNOWNS], outside = inside + step;
    const double tolerance = MWI_END_TOLERANCE * mwi_abs(step);
    const double reference = mwi_reference_of(m, mwi_parameters_in(m, side)), half = MWI_HALF_A_TURN / mwi_abs(ratio);
    const double followed = MWI_LOOKS_FOLLOWED * mwi_abs(step), farthest = half < followed ? half : followed;
    mw_contact c;
    int beyond;
    while ((beyond = mwi_touches(m, side, outside, x, &c)) == MWI_ON_FLANKS) {
        inside = outside, outside += step;
        if (mwi_abs(outside - reference) <= farthest) continue;
        end[MWI_END_ANGLE] = step > 0.0 ? HUGE_VAL : -HUGE_VAL;
        return;
    }
    for (int k = 0; k < MWI_HALVINGS && mwi_abs(outside - inside) > tolerance; k++) {
        const double middle = 0.5 * (inside + outside);
        const int there = mwi_touches(m, side, middle, x, &c);
        if (there == MWI_ON_FLANKS) inside = middle;
        else outside = middle, beyond = there;
    }
    mwi_touches(m, side, inside, x, &c);
    end[MWI_END_ANGLE] = inside;
    end[MWI_END_ERROR] = x[m->error];
    end[MWI_END_SLOPE] = beyond == MWI_BEYOND_LIMIT ? c.ratio - ratio : NAN;
}

/* How far ahead a pair would be beyond an end of its flanks, going on as it went there; without a limit where they end. */
static inline double mwi_ahead_beyond(double sense, const double *end, double angle)
{
    const double slope = end[MWI_END_SLOPE];
    return slope == slope ? sense * (end[MWI_END_ERROR] + slope * (angle - end[MWI_END_ANGLE])) : HUGE_VAL;
}

/* What a side is, and its window. */
static inline void mwi_look_at_side(const mw_model *m, double *side, double ratio)
{
    double x[MW_MAX_UNKNOWNS], o[MW_MAX_OBSERVATION];
    const double step = MWI_TURN / ((double)MWI_LOOKS_A_PITCH * mwi_parameters_in(m, side)[m->teeth]);
    const double reference = mwi_reference_of(m, mwi_parameters_in(m, side));
    mw_contact c;
    mw_info info;
    side[MWI_KIND] = MWI_NO_WINDOW;
    if (mwi_pair_at(m, side, 0, reference, x, &info) >= 0 && mwi_contact_at(m, side + MWI_STATE, x, o, &c) == MW_LINE_CONTACT) {
        side[MWI_KIND] = MWI_OF_LINES;
        side[MWI_SENSE] = c.lever_wheel < 0.0 ? -1.0 : 1.0;
        return;
    }
    for (int k = 0; k <= 2 * MWI_LOOKS; k++) {
        const double angle = reference + (k % 2 ? step : -step) * ((k + 1) / 2);
        if (mwi_touches(m, side, angle, x, &c) != MWI_ON_FLANKS) continue;
        side[MWI_KIND] = MWI_OF_POINTS;
        side[MWI_SENSE] = c.lever_wheel < 0.0 ? -1.0 : 1.0;
        mwi_find_end(m, side, angle, -step, ratio, side + MWI_LOWER);
        mwi_find_end(m, side, angle, step, ratio, side + MWI_UPPER);
        return;
    }
}

/* A side of a design that passes its guards; returns the guard that it does not. */
static inline int mwi_begin_side(const mw_model *m, const double *p, double *side)
{
    mwi_clear(side, mwi_side_size(m));
    for (int k = 0; k < MWI_PLACES; k++) side[MWI_STATE + m->ns + k * (1 + m->nx)] = NAN;
    return m->setup(p, side + MWI_STATE);
}

/* From one side's zero of a body's angle to the other's, in the sense in which it grows: of what its placement function says
 * of the body with both angles 0, rows of (rotation, origin), then the axis. */
static inline double mwi_turned_by(const double *here, const double *there)
{
    double cosine = 0.0, sine = 0.0, along = 0.0;
    for (int i = 0; i < 3; i++) {
        cosine += here[4 * i] * there[4 * i];
        sine += here[4 * i + 1] * there[4 * i];
        along += here[12 + i] * here[4 * i + 2];
    }
    return along < 0.0 ? -mwi_angle_of(cosine, sine) : mwi_angle_of(cosine, sine);
}

static inline int mwi_offsets(const mw_model *m, double *c)
{
    const double zero[2] = { 0.0, 0.0 }, *const drive = c + MWI_SIDES + MWI_STATE;
    double here[MW_MAX_OBSERVATION], there[MW_MAX_OBSERVATION];
    for (int k = 0; k < m->nfunctions; k++) {
        const mw_function *f = m->functions + k;
        if (!mwi_same_text(f->name, "placement")) continue;
        f->evaluate(drive, zero, here);
        f->evaluate(drive + mwi_side_size(m), zero, there);
        c[MWI_PINION_OFFSET] = -mwi_turned_by(here, there);
        c[MWI_WHEEL_OFFSET] = mwi_turned_by(here + f->outputs / 2, there + f->outputs / 2);
        return 1;
    }
    return 0;
}

/* c[MWI_SIDES + 2 * mwi_side_size(m)] for mwi_cycle of a drive p[np] whose other flank is that of coast[np], or NULL: there is
 * none. Returns 0, or the guard that either does not pass. */
static inline int mwi_cycle_setup(const mw_model *m, const double *p, const double *coast, double *c)
{
    double *const drive = c + MWI_SIDES, *const other = drive + mwi_side_size(m);
    int guard = mwi_begin_side(m, p, drive);
    mwi_clear(other, mwi_side_size(m));
    if (guard || !mwi_has_memory(m)) return guard;
    c[MWI_RATIO] = mwi_ratio(m, drive + MWI_STATE);
    mwi_look_at_side(m, drive, c[MWI_RATIO]);
    if (coast) guard = mwi_begin_side(m, coast, other);
    if (coast && !guard && mwi_offsets(m, c)) mwi_look_at_side(m, other, c[MWI_RATIO]);
    return guard;
}

static inline mw_side mwi_no_side(int status)
{
    mw_side side;
    side.status = status;
    side.pairs = 0, side.edge = status == MW_NO_CONTACT;
    side.pair = side.error = side.ratio = NAN;
    return side;
}

/* Numbers of the pairs within their limits at the own angle of pair 0, from *first to *last: fewer than MWI_PLACES where their
 * windows have no end. Returns the largest error, times the sense, that a pair beyond an end would have. */
static inline double mwi_pairs_inside(const mw_model *m, const double *side, double angle, double *first, double *last)
{
    const double teeth = mwi_parameters_in(m, side)[m->teeth], pitch = MWI_TURN / teeth;
    const double *const lower = side + MWI_LOWER, *const upper = side + MWI_UPPER;
    double beyond = -HUGE_VAL;
    *first = -MWI_PLACES / 2, *last = MWI_PLACES / 2;
    if (upper[MWI_END_ANGLE] < HUGE_VAL) {
        *first = -mwi_floor((upper[MWI_END_ANGLE] - angle) / pitch);
        beyond = mwi_ahead_beyond(side[MWI_SENSE], upper, mwi_less_pitches(teeth, angle, *first - 1.0));
    }
    if (lower[MWI_END_ANGLE] > -HUGE_VAL) {
        *last = mwi_floor((angle - lower[MWI_END_ANGLE]) / pitch);
        beyond = mwi_larger(beyond, mwi_ahead_beyond(side[MWI_SENSE], lower, mwi_less_pitches(teeth, angle, *last + 1.0)));
    }
    return beyond;
}

/* The pair that leads at the own angle of pair 0. Along lines one is as good as another. */
static inline mw_side mwi_side_at(const mw_model *m, double *side, double angle)
{
    double x[MW_MAX_UNKNOWNS], at[MW_MAX_UNKNOWNS], o[MW_MAX_OBSERVATION], first = 0.0, last = 0.0;
    double ahead = -HUGE_VAL, beyond = -HUGE_VAL;
    const double teeth = mwi_parameters_in(m, side)[m->teeth], places = MWI_PLACES;
    mw_side found = mwi_no_side(side[MWI_KIND] == MWI_ABSENT ? MW_BAD_INPUT : MW_NO_CONTACT);
    mw_info info;
    mw_contact c;
    if (side[MWI_KIND] == MWI_ABSENT || side[MWI_KIND] == MWI_NO_WINDOW) return found;
    if (side[MWI_KIND] == MWI_OF_POINTS) beyond = mwi_pairs_inside(m, side, angle, &first, &last);
    for (double k = first; k <= last; k += 1.0) {
        const int place = (int)(k - places * mwi_floor(k / places));
        if (mwi_pair_at(m, side, place, mwi_less_pitches(teeth, angle, k), x, &info) < 0) continue;
        found.pairs += side[MWI_KIND] == MWI_OF_POINTS;
        if (!(side[MWI_SENSE] * x[m->error] > ahead + MWI_AHEAD)) continue;
        ahead = side[MWI_SENSE] * x[m->error];
        found.pair = k;
        mwi_copy(at, x, m->nx);
    }
    if (found.pair != found.pair) return found;
    m->set_phi(side + MWI_STATE, mwi_less_pitches(teeth, angle, found.pair));
    found.status = mwi_contact_at(m, side + MWI_STATE, at, o, &c);
    found.edge = beyond > ahead + MWI_EDGE_AHEAD;
    found.error = at[m->error];
    found.ratio = c.ratio;
    return found;
}

/* The drive at an input angle; c as of mwi_cycle_setup. Returns out->drive.status. */
static inline int mwi_cycle(const mw_model *m, double *c, double phi, mw_cycle *out)
{
    double *const drive = c + MWI_SIDES, *const other = drive + mwi_side_size(m), tooth, behind;
    const double *const p = mwi_parameters_in(m, drive);
    out->drive = out->coast = mwi_no_side(MW_BAD_INPUT);
    out->backlash = NAN;
    out->angle = mwi_own_angle(m, p, phi, &out->pair);
    if (out->angle != out->angle) return MW_BAD_INPUT;
    out->drive = mwi_side_at(m, drive, out->angle);
    out->drive.pair += out->pair;
    if (other[MWI_KIND] == MWI_ABSENT) return out->drive.status;
    const double angle = mwi_own_angle(m, mwi_parameters_in(m, other), out->angle + c[MWI_PINION_OFFSET], &tooth);
    out->coast = mwi_side_at(m, other, angle);
    out->coast.pair += out->pair + tooth;
    out->coast.error += c[MWI_RATIO] * c[MWI_PINION_OFFSET] + c[MWI_WHEEL_OFFSET];
    behind = out->coast.error - out->drive.error;
    tooth = MWI_TURN / p[m->teeth] * c[MWI_RATIO];
    if (behind == behind) out->coast.error -= tooth * ((behind / tooth + MWI_TO_INTEGER) - MWI_TO_INTEGER);
    out->backlash = drive[MWI_SENSE] * (out->coast.error - out->drive.error);
    return out->drive.status;
}

#endif
