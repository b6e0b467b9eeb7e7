/* First contact, proved: that two bounded flanks have no place in common as the wheel comes up to a certified contact.
 * See mw_certify.h.  SPDX-License-Identifier: MIT-0
 *
 * A point of the wheel's flank, turned about the wheel's axis, meets the pinion's flank where both have the same distance
 * from the axis and the same place along it; the angle between them is what the wheel is then apart from the contact. Over a
 * part of the wheel's flank and a range of pinion angles that angle is a polynomial with an error bound: the pinion's
 * parameters are polynomials from Newton's method, and Krawczyk's operator bounds how far from them anything within a box lies
 * that meets the part. The box holds every part of the pinion's flank whose distance, place and angle may be those of the
 * wheel's part, cut to where its own polynomials let them be; of a half of a part it is what is known of the whole. Whether the polynomial keeps its sign where the limits do is told by dividing the polynomials; parts of the
 * flank are halved where these are not close enough.
 *
 * Variables of the sheets: s and t are the wheel's parameters over a part, or the pinion's; u is the angle. The frame of the
 * search turns with the wheel, so that its points stay; parts of the pinion's flank follow the contact. */
#define MWC_BALLS
#define MWC_SHEETS
#include "certify/first/along.h"
#include "certify/first/pieces.h"
#include "kernels.h"

/* The pinion's state at angles phi, for its flank. */
static void set_angle(search *h, mwc_sheet phi)
{
    const mw_certified *t = h->tables;
    h->arguments[0][t->slots] = phi;
    mwc_run_sheet(&t->instant, t->instant.instructions, h->arguments[0], h->registers);
    for (int i = t->design_slots; i < t->slots; i++)
        h->arguments[0][i] = h->arguments[1][i] = h->registers[t->instant.output[i - t->design_slots]];
    for (int i = 0; i < t->slots; i++) h->middle[i] = mwc_make(h->arguments[0][i].c[0], 0.0);
}

/* The frame of the search: the wheel's own, so that the contact lies in its x z plane. Returns a reason. */
static int place_bodies(search *h)
{
    const mw_certified *t = h->tables;
    const touching *at = &h->at;
    const mw_code *code = &t->placement;
    mwc_sheet o[36], lever = number(0.0), sense = lever, arm[3], cosine, sine, home[12];
    h->arguments[0][t->slots] = at->phi;
    h->arguments[0][t->slots + 1] = number(0.0);
    mwc_run_sheet(code, code->instructions, h->arguments[0], h->registers);
    for (int i = 0; i < 36; i++) o[i] = h->registers[code->output[i]];
    const mwc_sheet *wheel = o + 18, *axis = o + 30, *origin = o + 33;
    for (int i = 0; i < 3; i++) {
        arm[i] = mwc_sheet_sub(at->point[i], origin[i]);
        sense = mwc_sheet_add(sense, mwc_sheet_mul(axis[i], wheel[4 * i + 2]));
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const mwc_sheet moved = mwc_sheet_sub(mwc_sheet_mul(axis[j], arm[k]), mwc_sheet_mul(axis[k], arm[j]));
        lever = mwc_sheet_add(lever, mwc_sheet_mul(at->normal[i], moved));
    }
    if (!(mwc_sheet_least(&lever) > 0.0 && mwc_sheet_least(&sense) > 0.0)) return MW_REASON_WIDE;
    /* turned further by a small angle in the wheel's frame, a place of the pinion is met by a wheel that is turned further */
    const double turns = sense.c[0] > 0.0 ? 1.0 : -1.0;
    h->sense = (lever.c[0] > 0.0 ? -1.0 : 1.0) * turns;
    /* the wheel's points about its axis, so that the contact's lies in the x z plane */
    mwc_sheet q[2];
    place w;
    h->cosine = mwc_make(1.0, 0.0);
    h->sine = mwc_make(0.0, 0.0);
    for (int i = 0; i < 2; i++) q[i] = number(at->x[h->model->bodies[1].unknowns[i]].c[0]);
    on_flank(h, 1, q, POINT, &w, NULL);
    const double facing = mwi_angle(w.x[1].c[0], w.x[0].c[0]);
    if (!(mwc_abs(facing) < 4.0)) return MW_REASON_WIDE;
    mwc_sincos(mwc_make(-facing, 0.0), &h->sine, &h->cosine);
    /* the fixed frame in that of the wheel at angle 0, then turned back by the wheel's angle as well */
    const mwc_sheet angle = mwc_sheet_add(mwc_sheet_times(at->wheel_angle, mwc_make(-turns, 0.0)), number(-facing));
    mwc_sheet_sincos(angle, &sine, &cosine);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) home[4 * i + j] = wheel[4 * j + i];
        home[4 * i + 3] = number(0.0);
        for (int j = 0; j < 3; j++) home[4 * i + 3] = mwc_sheet_sub(home[4 * i + 3], mwc_sheet_mul(wheel[4 * j + i], wheel[4 * j + 3]));
    }
    for (int j = 0; j < 4; j++) {
        const mwc_sheet a = home[j], b = home[4 + j];
        home[j] = mwc_sheet_sub(mwc_sheet_mul(cosine, a), mwc_sheet_mul(sine, b));
        home[4 + j] = mwc_sheet_add(mwc_sheet_mul(sine, a), mwc_sheet_mul(cosine, b));
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) h->turn[3 * i + j] = home[4 * i + j];
        h->move[i] = home[4 * i + 3];
    }
    return MW_REASON_NONE;
}

/* Which limits the design sets, those that are numbers at the contact; the view, any matrix. Returns whether the contact
 * surely lies inside all limits. */
static int look_at(search *h)
{
    const mw_model *m = h->model;
    place at;
    mwc_sheet q[2], R[2], J[4];
    mw_ball middle[4];
    int within = 1;
    for (int member = 0; member < 2; member++) {
        for (int i = 0; i < 2; i++) q[i] = h->at.x[m->bodies[member].unknowns[i]];
        on_flank(h, member, q, LIMITS, &at, NULL);
        for (int i = 0; i < h->margins[member]; i++) h->set[member][i] = at.limit[i].c[0] == at.limit[i].c[0];
        within = within && inside(h, member, &at);
    }
    const place wheel = at;
    const mwc_sheet square = squared(wheel.x);
    for (int i = 0; i < 2; i++) q[i] = h->at.x[m->bodies[0].unknowns[i]];
    against(h, q, &wheel, &square, &at, R, J);
    for (int k = 0; k < 4; k++) middle[k] = mwc_make(J[k].c[0], 0.0);
    if (mwc_inverse(2, middle, h->view)) return within;
    h->view[0] = h->view[3] = 1.0;
    h->view[1] = h->view[2] = 0.0;
    return within;
}

/* Whether this can be asked of the drive; known: why not of the contact. Returns a reason. */
static int possible(const mw_model *m, int known)
{
    if (!mw_encloses(m)) return MW_REASON_ARITHMETIC;
    if (known != MW_REASON_NONE) return known;
    const mw_certified *t = m->kernels->certified();
    for (int i = 0; i < 2; i++) {
        if (m->bodies[i].parameters != 2 || m->bodies[i].margins > MARGINS - 2) return MW_REASON_CONDITION;
        if (t->flanks[i].registers > MWC_REGISTERS) return MW_REASON_DESIGN;
    }
    if (t->placement.registers > MWC_REGISTERS || t->instant.registers > MWC_REGISTERS) return MW_REASON_DESIGN;
    if (t->observed.registers > MWC_REGISTERS || t->slots + m->nx + 2 > MWC_ARGUMENTS) return MW_REASON_DESIGN;
    return t->turning ? MW_REASON_NONE : MW_REASON_CONDITION;
}

size_t mw_certify_first_work(void)
{
    return (sizeof(search) + MOST_LISTED * sizeof(part)) / sizeof(double) + 4;
}

/* Begin a search in `work`; known: why nothing can be asked of the contact, if so. Returns a reason. */
static int begun(const mw_model *m, int known, const mw_wide *s, const double *flanks, double slack, double reach, int effort,
                 double *work, mw_first_certificate *c)
{
    search *h = (search *)work;
    memset(c, 0, sizeof *c);
    for (int i = 0; i < 2; i++) c->wheel[i] = c->pinion[i] = NAN;
    c->apart = mwc_make(NAN, NAN);
    c->outcome = MW_FIRST_UNKNOWN;
    c->reason = possible(m, known);
    if (c->reason != MW_REASON_NONE) return c->reason;
    memset(h, 0, sizeof *h);
    for (int i = 0; i < 4; i++) {
        range *side = &h->whole[i / 2][i % 2];
        side->low = flanks[2 * i];
        side->high = flanks[2 * i + 1];
        if (!(width(*side) > 0.0 && width(*side) < HUGE_VAL)) c->reason = MW_REASON_BOX;
    }
    if (!(slack > 0.0 && reach > slack && reach < 1.0)) c->reason = MW_REASON_BOX;
    h->model = m;
    h->tables = m->kernels->certified();
    h->list = (part *)(h + 1);
    h->slack = slack;
    h->reach = reach;
    h->effort = effort;
    h->found = c;
    for (int i = 0; i < 2; i++) {
        const mw_code *code = &h->tables->flanks[i];
        h->margins[i] = 1 + m->bodies[i].margins;
        h->enough[i][POINT] = leading(code, REGULAR);
        h->enough[i][LIMITS] = leading(code, REGULAR + h->margins[i]);
        h->enough[i][TANGENTS] = code->instructions;
        for (int k = 0; k < h->tables->design_slots; k++) h->arguments[i][k] = mwc_sheet_of_wide(s[k]);
    }
    return c->reason;
}

/* Whether the range of angles is short enough for polynomials: where the pinion meets one place of the wheel's flank, that of
 * the contact in the middle of the range, how far it is apart there is known to the slack. */
static int resolved(search *h)
{
    met at;
    place w, p;
    range box[2], about[2];
    mwc_sheet q[2];
    double from[2];
    int exists;
    for (int i = 0; i < 2; i++) {
        box[i].low = box[i].high = h->at.x[h->model->bodies[1].unknowns[i]].c[0];
        about[i].high = width(h->pinion[i]);
        about[i].low = -about[i].high;
    }
    over(q, box);
    on_flank(h, 1, q, POINT, &w, NULL);
    const mwc_sheet square = squared(w.x);
    memset(&at, 0, sizeof at);
    if (!centred(h, &w, square.c[0], about, from, at.C) || !sought(h, &w, &square, from, &at)) return 1;
    bounded(h, &w, &square, &at, &p, &exists);
    const mwc_sheet away = apart(h, &p, &w);
    return away.radius < h->slack;
}

/* Search for what comes before the contact that is set. Returns the outcome. */
static int searched(search *h)
{
    mw_first_certificate *c = h->found;
    const mw_model *m = h->model;
    mwc_sheet q[2];
    for (int i = 0; i < 2; i++) {
        h->follow[i] = h->at.x[m->bodies[0].unknowns[i]];
        h->follow[i].radius = 0.0;
    }
    set_angle(h, h->at.phi);
    c->reason = place_bodies(h);
    if (c->reason != MW_REASON_NONE) return c->outcome;
    if (!look_at(h)) {
        c->reason = MW_REASON_OFF_FLANK;
        return c->outcome;
    }
    for (int i = 0; i < 2; i++) {
        const range at = mwc_cube_range(&h->follow[i]), whole = h->whole[0][i];
        h->pinion[i].low = (whole.low - at.high) - 4.0 * MWC_U * (mwc_abs(whole.low) + mwc_abs(at.high));
        h->pinion[i].high = (whole.high - at.low) + 4.0 * MWC_U * (mwc_abs(whole.high) + mwc_abs(at.low));
    }
    for (int i = 0; i < 2; i++) c->ends[i] = ends_within(h, i, h->whole[i]);
    for (int i = 0; i < 2; i++) q[i] = h->at.x[m->bodies[1].unknowns[i]];
    mark_piece(h, q);
    memcpy(h->list[0].box, h->pinion, sizeof h->pinion);
    const int whole = looked_up(h, h->list);
    if (whole != KEPT) {
        c->reason = whole == NOTHING ? MW_REASON_OFF_FLANK : MW_REASON_EFFORT;
        return c->outcome;
    }
    if (h->own && !resolved(h)) {
        remember(h, h->whole[1]);
        c->reason = MW_REASON_EFFORT;
        return c->outcome;
    }
    range everywhere[2];
    for (int i = 0; i < 2; i++) {
        const range drift = mwc_cube_range(h->drift + i), wheel = h->whole[1][i];
        everywhere[i].low = wheel.low - drift.high;
        everywhere[i].high = wheel.high - drift.low;
    }
    int verdict = settled(h, everywhere, 0, 1, NULL, 0, 0.0, 0);
    if (verdict == OPEN && h->once.parts > 0) {
        h->once.parts = c->parts;
        *c = h->once;
        h->share = h->once_share;
        verdict = REFUTED;
    }
    if (verdict == SETTLED) c->outcome = MW_FIRST_PROVED;
    if (verdict == REFUTED) c->outcome = MW_FIRST_REFUTED;
    if (verdict != OPEN) c->reason = MW_REASON_NONE;
    return c->outcome;
}

/* How far the wheel may be turned back, rad, where nothing is searched. */
static const double ALL_ROUND = 0.5;

/* The contact at one angle that a certificate describes. */
static void pose_at(search *h, mw_wide phi, const mw_certificate *contact)
{
    h->at.phi = mwc_sheet_of_wide(phi);
    h->at.wheel_angle = mwc_sheet_of_ball(contact->wheel_angle);
    for (int i = 0; i < h->model->nx; i++) h->at.x[i] = mwc_sheet_of_wide(contact->x[i]);
    for (int i = 0; i < 3; i++) {
        h->at.point[i] = mwc_sheet_of_ball(contact->point[i]);
        h->at.normal[i] = mwc_sheet_of_ball(contact->normal[i]);
    }
}

int mw_certify_first(const mw_model *m, const mw_wide *s, mw_wide phi, const mw_certificate *contact, const double *flanks,
                     double slack, double reach, int effort, double *work, mw_first_certificate *c)
{
    search *h = (search *)work;
    int known = contact->flags ? MW_REASON_OFF_FLANK : MW_REASON_NONE;
    if (contact->outcome != MW_UNIQUE) known = contact->reason == MW_REASON_NONE ? MW_REASON_CONTACT : contact->reason;
    if (begun(m, known, s, flanks, slack, reach, effort, work, c) != MW_REASON_NONE) return c->outcome;
    pose_at(h, phi, contact);
    return searched(h);
}

/* A polynomial of a piece as a sheet of the angle; share: of the piece, as one. */
static mwc_sheet along_piece(const mw_polynomial *of, const mwc_sheet *share)
{
    mwc_sheet sum = number(of->c[MW_ORDER]);
    for (int k = MW_ORDER - 1; k >= 0; k--) sum = mwc_sheet_add(mwc_sheet_mul(sum, *share), number(of->c[k]));
    sum.radius = (sum.radius + of->radius) * MWC_SHEET_SUMMED;
    return sum;
}

/* The contact of a piece from one angle to another, and both bodies turned further. */
static void set_contact(search *h, const mw_piece *piece, double from, double to, mw_wide pinion_turn, mw_wide wheel_turn)
{
    const mw_certified *t = h->tables;
    const mw_code *code = &t->observed;
    touching *at = &h->at;
    mwc_sheet phi = number(0.5 * from + 0.5 * to), o[13];
    phi.along = 1;
    phi.c[MWC_BLOCK[1]] = (0.5 * to - 0.5 * from) * (1.0 + 8.0 * MWC_U) + 4.0 * MWC_U * (mwc_abs(from) + mwc_abs(to));
    const mwc_sheet share = mwc_sheet_div(mwc_sheet_sub(phi, number(piece->centre)), number(piece->half));
    for (int i = 0; i < h->model->nx; i++) at->x[i] = along_piece(&piece->x[i], &share);
    set_angle(h, phi);
    memcpy(h->arguments[0] + t->slots, at->x, sizeof at->x[0] * (size_t)h->model->nx);
    mwc_run_sheet(code, leading(code, 13), h->arguments[0], h->registers);
    for (int i = 0; i < 13; i++) o[i] = h->registers[code->output[i]];
    memcpy(at->point, o, sizeof at->point);
    memcpy(at->normal, o + 3, sizeof at->normal);
    at->wheel_angle = mwc_sheet_add(o[12], mwc_sheet_of_wide(wheel_turn));
    at->phi = mwc_sheet_add(phi, mwc_sheet_of_wide(pinion_turn));
}

int mw_certify_first_along(const mw_model *m, const mw_wide *s, const mw_piece *piece, double from, double to, mw_wide pinion_turn,
                           mw_wide wheel_turn, const double *flanks, double slack, double reach, int effort, double *work,
                           mw_first_certificate *c, double *angle)
{
    search *h = (search *)work;
    const int held = from < to && from >= piece->centre - piece->half && to <= piece->centre + piece->half;
    int known = held ? MW_REASON_NONE : MW_REASON_BOX;
    if (piece->outcome != MW_UNIQUE) known = piece->reason == MW_REASON_NONE ? MW_REASON_CONTACT : piece->reason;
    *angle = NAN;
    if (begun(m, known, s, flanks, slack, reach, effort, work, c) != MW_REASON_NONE) return c->outcome;
    set_contact(h, piece, from, to, pinion_turn, wheel_turn);
    h->own = pinion_turn.hi == 0.0;
    searched(h);
    if (c->wheel[0] == c->wheel[0]) *angle = 0.5 * from + 0.5 * to + h->share * (0.5 * to - 0.5 * from);
    return c->outcome;
}

/* Begin to enclose how far the flanks stand apart. Returns a reason. */
static int line_begun(const mw_model *m, int known, const mw_wide *s, const double *flanks, double *work, mw_line_certificate *c)
{
    mw_first_certificate looked;
    memset(c, 0, sizeof *c);
    c->outcome = MW_UNKNOWN;
    c->apart[0] = c->nearest = c->limit[0] = HUGE_VAL;
    c->apart[1] = c->limit[1] = -HUGE_VAL;
    return c->reason = begun(m, known, s, flanks, 0.5 * ALL_ROUND, ALL_ROUND, 1, work, &looked);
}

/* Enclose it along a curve q, of the contact that is set; depth: of halvings that are made already. */
static int line_enclosed(search *h, const mwc_sheet *q, double fine, int depth, mw_line_certificate *c)
{
    set_angle(h, h->at.phi);
    c->reason = place_bodies(h);
    if (c->reason != MW_REASON_NONE) return c->outcome;
    for (int i = 0; i < 2; i++) {
        h->follow[i] = h->at.x[h->model->bodies[0].unknowns[i]];
        h->follow[i].radius = 0.0;
    }
    look_at(h);
    if (all_along(h, q, fine, depth, c)) c->outcome = MW_UNIQUE;
    else c->reason = MW_REASON_EFFORT;
    return c->outcome;
}

int mw_certify_line(const mw_model *m, const mw_wide *s, mw_wide phi, const mw_certificate *pose, const double *flanks,
                    const double *curve, double fine, double *work, mw_line_certificate *c)
{
    search *h = (search *)work;
    mwc_sheet q[4];
    if (line_begun(m, MW_REASON_NONE, s, flanks, work, c) != MW_REASON_NONE) return c->outcome;
    pose_at(h, phi, pose);
    for (int i = 0; i < 4; i++) {
        q[i] = number(curve[MW_CURVE_TERMS * i]);
        q[i].across = MWC_DEGREE;
        for (int k = 1; k < MW_CURVE_TERMS; k++) q[i].c[mwc_cube_at(k, 0, 0)] = curve[MW_CURVE_TERMS * i + k];
    }
    return line_enclosed(h, q, fine, 0, c);
}

int mw_certify_first_followed(const mw_model *m, const mw_wide *s, const mw_piece *piece, const double *flanks, double slack,
                              double reach, int effort, double *work, mw_first_certificate *c)
{
    search *h = (search *)work;
    const mw_wide still = { 0.0, 0.0, 0.0 };
    if (begun(m, MW_REASON_NONE, s, flanks, slack, reach, effort, work, c) != MW_REASON_NONE) return c->outcome;
    set_contact(h, piece, piece->centre - piece->half, piece->centre + piece->half, still, still);
    for (int i = 0; i < 2; i++) {
        h->drift[i] = h->at.x[m->bodies[1].unknowns[i]];
        h->drift[i].c[0] = h->drift[i].radius = 0.0;
    }
    return searched(h);
}

int mw_certify_line_along(const mw_model *m, const mw_wide *s, const mw_piece *piece, const double *flanks, double fine, double *work,
                          mw_line_certificate *c)
{
    search *h = (search *)work;
    const mw_wide still = { 0.0, 0.0, 0.0 };
    mwc_sheet q[4];
    if (line_begun(m, MW_REASON_NONE, s, flanks, work, c) != MW_REASON_NONE) return c->outcome;
    set_contact(h, piece, piece->centre - piece->half, piece->centre + piece->half, still, still);
    for (int i = 0; i < 4; i++) q[i] = h->at.x[m->bodies[i < 2].unknowns[i % 2]];
    return line_enclosed(h, q, fine, DEEPEST_STRETCH, c);
}
