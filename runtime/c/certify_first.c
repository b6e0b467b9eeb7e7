/* First contact, proved: that two bounded flanks have no place in common as the wheel comes up to a certified contact.
 * See mw_certify.h.  SPDX-License-Identifier: MIT-0
 *
 * A point of the wheel's flank, turned about the wheel's axis, meets the pinion's flank where both have the same distance
 * from the axis and the same place along it; the angle between them is what the wheel is then apart from the contact. Over a
 * part of the wheel's flank and a range of pinion angles that angle is a polynomial with an error bound: the pinion's
 * parameters are polynomials from Newton's method, and Krawczyk's operator bounds how far from them anything within a box lies
 * that meets the part. The box holds every part of the pinion's flank whose distance, place and angle may be those of the
 * wheel's part. Whether the polynomial keeps its sign where the limits do is told by dividing the polynomials; parts of the
 * flank are halved where these are not close enough.
 *
 * Variables of the sheets: s and t are the wheel's parameters over a part, or the pinion's; u is the angle. The frame of the
 * search turns with the wheel, so that its points stay; parts of the pinion's flank follow the contact. */
#include <string.h>
#define MWC_BALLS
#define MWC_SHEETS
#include "certify/cube.h"
#include "certify/krawczyk.h"
#include "certify/tables.h"
#include "kernels.h"
#include "mw_certify.h"

enum {
    MOST_PARTS = 60000, MOST_LISTED = 120000, /* of the pinion's flank; that are kept in mind */
    FEWEST = 2000, MANY = 16,                 /* of the pinion's flank, and for each of the wheel's, where few of these are allowed */
    DEEPEST = 32, DEEPEST_EDGE = 14,          /* halvings */
    MOST_OPEN = 64,                           /* parts of the wheel's flank that may stay open, in search of an overlap */
    CELLS = 48, BLOCK = 8,                    /* across the wheel's flank and along it, where its pieces are told apart; in one */
    MOST_MET = 160,                           /* parts of the pinion's flank whose box is looked at as one */
    NEWTON_STEPS = 12, NARROWING_STEPS = 40,
    DEEPEST_CUBE = 24, MOST_CUBES = 4000,     /* halvings of polynomials, and how many cubes in all */
    MOST_LIMITS = 12,                         /* that are looked at together with the distance */
    MARGINS = 32                              /* of one flank, its regularity included, at most */
};

typedef mwc_range range;

/* How much larger than the wheel's part parts of the pinion's flank may be, at first. */
static const double COARSE = 3.0;

/* How large a share of what a limit varies by its error may be where polynomials tell the cells. */
static const double CLOSE = 0.003;

/* Bounds of where a part of a flank is: two combinations of the squared distance from the wheel's axis and the place along
 * it, such as are the pinion's parameters near the contact, and how wide they are at one angle; the angle about the axis. */
typedef struct bounds {
    range across[2], angle;
    double spread[2];
} bounds;

/* A part of the pinion's flank: its parameters, as they follow the contact, and where it is; number of the first of both
 * halves, 0 if it has none; whether it lies outside the blank. */
typedef struct part {
    range box[2];
    bounds at;
    int halves, outside;
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
    mwc_sheet turn[9], move[3];               /* of the pinion's points, fixed frame, into that of the search */
    mw_ball cosine, sine;                     /* of the wheel's, body frame */
    double sense, slack, reach, view[4];
    range whole[2][2], pinion[2];             /* parameters of both flanks; the pinion's as they follow the contact */
    int parts, effort, open, cubes;
    unsigned char cell[CELLS][CELLS];         /* 0: outside or of another piece */
    part *part;
    int *list;
    mw_first_certificate *found;
    double share;                             /* of the range of angles, in [-1, 1], where the place found is */
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

static bounds bounds_of(const search *h, const mwc_sheet *x)
{
    bounds b;
    const mwc_sheet square = squared(x), angle = mwc_sheet_atan2(x[1], x[0]);
    for (int i = 0; i < 2; i++) {
        const mwc_sheet across = mwc_sheet_add(mwc_sheet_times(square, mwc_make(h->view[2 * i], 0.0)),
                                               mwc_sheet_times(x[2], mwc_make(h->view[2 * i + 1], 0.0)));
        double turning = 0.0;
        for (int k = 1; k <= across.along; k++) turning += mwc_abs(across.c[MWC_BLOCK[k]]);
        b.across[i] = mwc_cube_range(&across);
        b.spread[i] = width(b.across[i]) - 2.0 * turning;
    }
    b.angle = mwc_cube_range(&angle);
    return b;
}

/* -- flanks -------------------------------------------------------------------------------------------------------- */

/* Operations after which the first `count` results are known. */
static int leading(const mw_code *code, int count)
{
    int last = 0;
    for (int i = 0; i < code->instructions; i++) {
        const unsigned short *operation = code->operation + 4 * i;
        for (int k = 0; k < count; k++) {
            const int other = operation[0] == MW_OP_SINCOS && operation[3] == code->output[k];
            if (operation[1] == code->output[k] || other) last = i + 1;
        }
    }
    return last;
}

/* Parameters of a flank over a part of it, one of s and t each. */
static void over(mwc_sheet *q, const range *box)
{
    for (int i = 0; i < 2; i++) {
        q[i] = number(0.5 * box[i].low + 0.5 * box[i].high);
        q[i].across = 1;
        q[i].c[1 + i] = (0.5 * box[i].high - 0.5 * box[i].low) * (1.0 + 8.0 * MWC_U)
                        + 4.0 * MWC_U * (mwc_abs(box[i].low) + mwc_abs(box[i].high));
    }
}

/* A vector of the fixed frame in that of the search. */
static void carried(const search *h, const mwc_sheet *r, const mwc_sheet *move, mwc_sheet *x)
{
    for (int i = 0; i < 3; i++) {
        x[i] = mwc_sheet_mul(r[0], h->turn[3 * i]);
        if (move) x[i] = mwc_sheet_add(x[i], move[i]);
        for (int j = 1; j < 3; j++) x[i] = mwc_sheet_add(x[i], mwc_sheet_mul(r[j], h->turn[3 * i + j]));
    }
}

/* A flank at parameters q[2]: its point, its limits from LIMITS on, and with TANGENTS those of the pinion. */
static void on_flank(search *h, int member, const mwc_sheet *q, int much, place *at, mwc_sheet (*tangents)[3])
{
    const mw_code *code = &h->tables->flanks[member];
    mwc_sheet r[3];
    memcpy(h->arguments[member] + h->tables->slots, q, 2 * sizeof *q);
    mwc_run_sheet(code, h->enough[member][much], h->arguments[member], h->registers);
    for (int i = 0; i < 3; i++) r[i] = h->registers[code->output[i]];
    if (member == 0) {
        carried(h, r, h->move, at->x);
    } else {
        at->x[0] = mwc_sheet_sub(mwc_sheet_times(r[0], h->cosine), mwc_sheet_times(r[1], h->sine));
        at->x[1] = mwc_sheet_add(mwc_sheet_times(r[0], h->sine), mwc_sheet_times(r[1], h->cosine));
        at->x[2] = r[2];
    }
    for (int i = 0; much >= LIMITS && i < h->margins[member]; i++) at->limit[i] = h->registers[code->output[REGULAR + i]];
    for (int k = 0; much == TANGENTS && k < 2; k++) {
        for (int i = 0; i < 3; i++) r[i] = h->registers[code->output[REGULAR + h->margins[member] + 3 * k + i]];
        carried(h, r, NULL, tangents[k]);
    }
}

/* Whether a part surely lies outside a limit; inside all of them. */
static int outside(const search *h, int member, const place *at)
{
    for (int i = 0; i < h->margins[member]; i++)
        if (h->set[member][i] && at->limit[i].c[0] < 0.0 && mwc_sheet_least(&at->limit[i]) > 0.0) return 1;
    return 0;
}

static int inside(const search *h, int member, const place *at)
{
    for (int i = 0; i < h->margins[member]; i++)
        if (h->set[member][i] && !(at->limit[i].c[0] > 0.0 && mwc_sheet_least(&at->limit[i]) > 0.0)) return 0;
    return 1;
}

/* The longer side of a part, in shares of the sides of the whole flank. */
static int longer(const range *box, const range *whole)
{
    return width(box[1]) * width(whole[0]) > width(box[0]) * width(whole[1]);
}

static void halved(const range *box, int side, range *first, range *second)
{
    const double middle = 0.5 * box[side].low + 0.5 * box[side].high;
    memcpy(first, box, 2 * sizeof *box);
    memcpy(second, box, 2 * sizeof *box);
    first[side].high = second[side].low = middle;
}

/* -- parts of the pinion's flank ----------------------------------------------------------------------------------- */

/* The pinion's parameters over a box that follows the contact. */
static void following(const search *h, const range *box, mwc_sheet *q)
{
    over(q, box);
    for (int i = 0; i < 2; i++) q[i] = mwc_sheet_add(q[i], h->follow[i]);
}

static int measured(search *h, const range *box)
{
    mwc_sheet q[2];
    place at;
    part *p = h->part + h->parts;
    if (h->parts == (h->effort < (MOST_PARTS - FEWEST) / MANY ? FEWEST + MANY * h->effort : MOST_PARTS)) return 0;
    memset(p, 0, sizeof *p);
    memcpy(p->box, box, sizeof p->box);
    following(h, box, q);
    on_flank(h, 0, q, LIMITS, &at, NULL);
    p->outside = outside(h, 0, &at);
    for (int i = 0; i < 2; i++) p->outside = p->outside || !overlap(mwc_cube_range(q + i), h->whole[0][i]);
    p->at = bounds_of(h, at.x);
    h->parts++;
    return 1;
}

/* Whether a part of the pinion's flank may meet the wheel's part, apart by -reach to -slack. */
static int may_meet(const search *h, const part *p, const bounds *w)
{
    const double a = h->sense * (p->at.angle.low - w->angle.high), b = h->sense * (p->at.angle.high - w->angle.low);
    range apart = { a < b ? a : b, a < b ? b : a }, asked = { -h->reach, -h->slack };
    apart.low -= 1e-12 + 4.0 * MWC_U * mwc_abs(apart.low);
    apart.high += 1e-12 + 4.0 * MWC_U * mwc_abs(apart.high);
    if (!(apart.high >= apart.low)) apart.low = -HUGE_VAL, apart.high = HUGE_VAL;
    if (p->outside || !overlap(p->at.across[0], w->across[0]) || !overlap(p->at.across[1], w->across[1])) return 0;
    for (int turns = -1; turns <= 1; turns++) { /* angles of both may lie on either side of the cut */
        const range there = { apart.low + 6.3 * turns - 0.02, apart.high + 6.3 * turns + 0.02 };
        if (overlap(turns ? there : apart, asked)) return 1;
    }
    return 0;
}

/* List, from `to` on, the parts of number k that may meet the wheel's part, none larger than so many times its size. Returns
 * the list's new end; -1: there is no room. */
static int list_parts(search *h, int k, const bounds *w, double times, int to)
{
    if (!may_meet(h, h->part + k, w)) return to;
    const part *p = h->part + k;
    if (p->at.spread[0] <= times * w->spread[0] && p->at.spread[1] <= times * w->spread[1]) {
        if (to == MOST_LISTED) return -1;
        h->list[to] = k;
        return to + 1;
    }
    if (!p->halves) {
        range first[2], second[2];
        halved(p->box, longer(p->box, h->pinion), first, second);
        const int number = h->parts;
        if (!measured(h, first) || !measured(h, second)) return -1;
        h->part[k].halves = number;
    }
    const int number = h->part[k].halves;
    to = list_parts(h, number, w, times, to);
    return to < 0 ? to : list_parts(h, number + 1, w, times, to);
}

/* -- where the pinion meets a part of the wheel's flank ------------------------------------------------------------- */

/* How far place `p` of the pinion is apart from `w` of the wheel, rad, positive where it does not overlap. */
static mwc_sheet apart(const search *h, const place *p, const place *w)
{
    const mwc_sheet across = mwc_sheet_sub(mwc_sheet_mul(w->x[0], p->x[1]), mwc_sheet_mul(w->x[1], p->x[0]));
    const mwc_sheet along = mwc_sheet_add(mwc_sheet_mul(w->x[0], p->x[0]), mwc_sheet_mul(w->x[1], p->x[1]));
    return mwc_sheet_times(mwc_sheet_atan2(across, along), mwc_make(h->sense, 0.0));
}

/* Residual of the place of the pinion's flank at q against the wheel's part, and unless NULL its Jacobian. */
static void against(search *h, const mwc_sheet *q, const place *w, const mwc_sheet *square, place *p, mwc_sheet *R, mwc_sheet *J)
{
    mwc_sheet tangents[2][3];
    on_flank(h, 0, q, J ? TANGENTS : POINT, p, tangents);
    R[0] = mwc_sheet_sub(squared(p->x), *square);
    R[1] = mwc_sheet_sub(p->x[2], w->x[2]);
    for (int k = 0; J && k < 2; k++) {
        const mwc_sheet *t = tangents[k];
        J[k] = mwc_sheet_times(mwc_sheet_add(mwc_sheet_mul(p->x[0], t[0]), mwc_sheet_mul(p->x[1], t[1])), mwc_make(2.0, 0.0));
        J[2 + k] = t[2];
    }
}

/* The same at s = t = u = 0 in plain numbers, of the wheel's point x with this squared distance. */
static void against_at(search *h, const double *q, double square, double along, mw_ball *R, mw_ball *J)
{
    const mw_code *code = &h->tables->flanks[0];
    mw_ball registers[MWC_REGISTERS], x[3][3];
    for (int i = 0; i < 2; i++) h->middle[h->tables->slots + i] = mwc_make(q[i], 0.0);
    mwc_run_ball(code, code->instructions, h->middle, registers);
    for (int n = 0; n < 3; n++) { /* point and tangents */
        const unsigned short *from = code->output + (n ? REGULAR + h->margins[0] + 3 * (n - 1) : 0);
        for (int i = 0; i < 3; i++) {
            x[n][i] = mwc_make(n ? 0.0 : h->move[i].c[0], 0.0);
            for (int j = 0; j < 3; j++) x[n][i].mid += h->turn[3 * i + j].c[0] * registers[from[j]].mid;
        }
    }
    R[0].mid = x[0][0].mid * x[0][0].mid + x[0][1].mid * x[0][1].mid - square;
    R[1].mid = x[0][2].mid - along;
    for (int k = 0; k < 2; k++) {
        J[k].mid = 2.0 * (x[0][0].mid * x[1 + k][0].mid + x[0][1].mid * x[1 + k][1].mid);
        J[2 + k].mid = x[1 + k][2].mid;
    }
}

/* Parameters at[2] that nearly meet the middle of the wheel's part at u = 0, by Newton's method in plain numbers, and C[4],
 * nearly the inverse Jacobian there. 0 where it leads out of the box. */
static int centred(search *h, const place *w, double square, const range *hull, double *at, double *C)
{
    double from[2];
    mw_ball R[2], J[4];
    for (int i = 0; i < 2; i++) at[i] = from[i] = h->follow[i].c[0] + 0.5 * hull[i].low + 0.5 * hull[i].high;
    for (int step = 0; step < NEWTON_STEPS; step++) {
        double size = 0.0;
        against_at(h, at, square, w->x[2].c[0], R, J);
        if (!mwc_inverse(2, J, C)) return 0;
        for (int i = 0; i < 2; i++) {
            const double by = C[2 * i] * R[0].mid + C[2 * i + 1] * R[1].mid;
            at[i] -= by;
            if (!(mwc_abs(at[i] - from[i]) < 4.0 * width(hull[i]))) return 0;
            size = fmax(size, mwc_abs(by) / width(hull[i]));
        }
        if (size < 1e-9) return 1;
    }
    return 0;
}

/* Polynomials q[2] that nearly meet the wheel's part, whichever, from parameters that meet its middle: two steps of Newton's
 * method and one with the last Jacobian. */
static int sought(search *h, const place *w, const mwc_sheet *square, const double *at, mwc_sheet *q, place *p)
{
    mwc_sheet R[2], J[4], inverse[4];
    for (int i = 0; i < 2; i++) q[i] = h->follow[i], q[i].c[0] = at[i];
    for (int step = 0; step < 3; step++) {
        against(h, q, w, square, p, R, step < 2 ? J : NULL);
        if (step < 2) {
            const mwc_sheet det = mwc_sheet_sub(mwc_sheet_mul(J[0], J[3]), mwc_sheet_mul(J[1], J[2]));
            const mwc_sheet over = mwc_sheet_div(number(1.0), det);
            if (!(mwc_abs(det.c[0]) > 0.0)) return 0;
            for (int k = 0; k < 4; k++) inverse[k] = mwc_sheet_mul(J[k == 0 ? 3 : k == 3 ? 0 : k], over);
        }
        for (int i = 0; i < 2; i++) {
            const mwc_sheet first = mwc_sheet_mul(inverse[3 * i], R[i]), second = mwc_sheet_mul(inverse[1 + i], R[1 - i]);
            q[i] = mwc_sheet_sub(q[i], mwc_sheet_sub(first, second));
            q[i].radius = 0.0;
        }
    }
    return 1;
}

/* |I - C J| over a box of the pinion's parameters that follows the contact. */
static void defect(search *h, const range *box, const place *w, const mwc_sheet *square, const double *C, double *M)
{
    mwc_sheet b[2], R[2], J[4];
    place p;
    following(h, box, b);
    against(h, b, w, square, &p, R, J);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            mwc_sheet sum = number(i == j ? 1.0 : 0.0);
            for (int k = 0; k < 2; k++)
                sum = mwc_sheet_sub(sum, mwc_sheet_times(J[2 * k + j], mwc_make(C[2 * i + k], 0.0)));
            M[2 * i + j] = mwc_sheet_most(&sum);
        }
}

/* The pinion's parameters q[2] that meet the wheel's part, as polynomials with error bounds: whatever of the parts listed
 * meets it lies within them, and where `exists` something does. q is any polynomial, C any matrix, and J, which does not
 * depend on the wheel, is over a box that holds q and the parts: what meets the wheel is apart from q by |C R| + |I - C J|
 * times as much at most, over and over again. 0 where the box is too large for that, or Newton's method leads out of it. */
static int meeting(search *h, const place *w, const int *list, int count, mwc_sheet *q, place *p, int *exists)
{
    const mwc_sheet square = squared(w->x);
    mwc_sheet R[2];
    mw_ball z[2];
    double C[4], M[4], K[2], at[2], within[2], wider[2], far[2];
    range hull[2];
    int beyond = 0;
    memcpy(hull, h->part[list[0]].box, sizeof hull);
    for (int k = 1; k < count; k++)
        for (int i = 0; i < 2; i++) {
            hull[i].low = fmin(hull[i].low, h->part[list[k]].box[i].low);
            hull[i].high = fmax(hull[i].high, h->part[list[k]].box[i].high);
        }
    if (!centred(h, w, square.c[0], hull, at, C)) return 0;
    defect(h, hull, w, &square, C, M);
    if (!(M[0] < 1.0 && M[3] < 1.0 && (1.0 - M[0]) * (1.0 - M[3]) > M[1] * M[2])) return 0;
    if (!sought(h, w, &square, at, q, p)) return 0;
    against(h, q, w, &square, p, R, NULL);
    for (int i = 0; i < 2; i++) {
        const mwc_sheet shift = mwc_sheet_add(mwc_sheet_times(R[0], mwc_make(C[2 * i], 0.0)),
                                              mwc_sheet_times(R[1], mwc_make(C[2 * i + 1], 0.0)));
        const mwc_sheet beside = mwc_sheet_sub(q[i], h->follow[i]);
        const range r = mwc_cube_range(&beside);
        z[i] = mwc_make(0.0, mwc_sheet_most(&shift));
        beyond = beyond || !(r.low >= hull[i].low && r.high <= hull[i].high);
        hull[i].low = fmin(hull[i].low, r.low);
        hull[i].high = fmax(hull[i].high, r.high);
        far[i] = fmin(r.low - hull[i].low, hull[i].high - r.high);
        within[i] = width(hull[i]) * (1.0 + 1e-9);
    }
    if (beyond) defect(h, hull, w, &square, C, M);
    for (int step = 0; step < NARROWING_STEPS; step++) {
        mwc_image(2, z, M, within, K);
        for (int i = 0; i < 2; i++)
            if (K[i] < within[i]) within[i] = K[i];
    }
    *exists = 1;
    for (int i = 0; i < 2; i++) {
        wider[i] = 2.0 * within[i] + 4.0 * MWC_U * mwc_abs(q[i].c[0]);
        *exists = *exists && wider[i] < far[i] * (1.0 - 1e-9);
    }
    mwc_image(2, z, M, wider, K);
    *exists = *exists && mwc_inside(2, K, wider);
    for (int i = 0; i < 2; i++) q[i].radius = within[i];
    on_flank(h, 0, q, LIMITS, p, NULL);
    return 1;
}

/* -- a part of the wheel's flank ----------------------------------------------------------------------------------- */

/* What is found of a part; WIDE: the pinion's parts are too large to tell where it meets them. */
enum { OPEN, SETTLED, REFUTED, WIDE };

/* A cube of a part: how far the pinion is apart, and limits, beyond which nothing is of a flank; all: none was left out. */
typedef struct cube {
    mwc_sheet away, limit[MOST_LIMITS];
    double at[3], half[3];
    int limits, all;
} cube;

/* The variable that the polynomials of a cube depend on most, in shares of what they are. */
static int steepest(const cube *c)
{
    double by[3] = { 0.0, 0.0, 0.0 };
    for (int n = -1; n < c->limits; n++) {
        const mwc_sheet *a = n < 0 ? &c->away : &c->limit[n];
        double size[3] = { 0.0, 0.0, 0.0 }, all = 0.0;
        for (int k = 0; k <= a->along; k++)
            for (int d = 0; d <= mwc_sheet_less(a->across, MWC_DEGREE - k); d++)
                for (int j = 0; j <= d; j++) {
                    const double term = mwc_abs(a->c[mwc_cube_at(d - j, j, k)]);
                    if (d + k == 0) continue;
                    all += term;
                    size[0] += j < d ? term : 0.0;
                    size[1] += j > 0 ? term : 0.0;
                    size[2] += k > 0 ? term : 0.0;
                }
        for (int i = 0; i < 3 && all > 0.0; i++) by[i] += size[i] / all;
    }
    return by[2] > by[0] && by[2] > by[1] ? 2 : by[1] > by[0];
}

/* Whether nothing in a cube overlaps deeper than the slack, or something in its middle does. */
static int told(search *h, cube *c, int exists, double *witness, int depth)
{
    int kept = 0, held = 1, sure = c->all && exists;
    if (mwc_cube_low(&c->away) > -h->slack || mwc_cube_range(&c->away).high < -h->reach) return SETTLED;
    for (int i = 0; i < c->limits; i++) {
        const range r = mwc_cube_range(&c->limit[i]);
        if (r.high < 0.0) return SETTLED;
        if (r.low > 0.0) continue;
        held = held && c->limit[i].c[0] + c->limit[i].radius >= 0.0;
        sure = sure && c->limit[i].c[0] - c->limit[i].radius > 0.0;
        if (kept < i) c->limit[kept] = c->limit[i];
        kept++;
    }
    c->limits = kept;
    const double middle = c->away.c[0], off = c->away.radius * (1.0 + 4.0 * MWC_U) + 4.0 * MWC_U * mwc_abs(middle);
    if (sure && middle + off < -h->slack && middle - off > -h->reach) {
        memcpy(witness, c->at, sizeof c->at);
        return REFUTED;
    }
    if (held && middle - off <= -h->slack && middle + off >= -h->reach) return OPEN; /* and of no cube about its middle */
    if (depth == DEEPEST_CUBE || ++h->cubes > MOST_CUBES) return OPEN;
    const int side = steepest(c);
    int verdict = SETTLED;
    for (double end = -1.0; end <= 1.0; end += 2.0) {
        cube half = *c;
        half.half[side] *= 0.5;
        half.at[side] += end * half.half[side];
        mwc_cube_half(&half.away, side, end);
        for (int i = 0; i < half.limits; i++) mwc_cube_half(&half.limit[i], side, end);
        const int found = told(h, &half, exists, witness, depth + 1);
        if (found == REFUTED) return found;
        if (found == OPEN) verdict = OPEN;
        if (found == OPEN && !(c->all && exists)) return OPEN; /* no overlap can be shown here */
    }
    return verdict;
}

static void take_limits(const search *h, int member, const place *at, cube *c)
{
    for (int i = 0; i < h->margins[member]; i++) {
        if (!h->set[member][i]) continue;
        const range r = mwc_cube_range(&at->limit[i]);
        if (r.low > 0.0) continue;
        if (c->limits == MOST_LIMITS || !(r.high < HUGE_VAL)) c->all = 0;
        else c->limit[c->limits++] = at->limit[i];
    }
}

static void take_range(const mwc_sheet *q, range whole, cube *c)
{
    const range r = mwc_cube_range(q);
    if (r.low >= whole.low && r.high <= whole.high) return;
    if (c->limits + 2 > MOST_LIMITS) {
        c->all = 0;
        return;
    }
    c->limit[c->limits++] = mwc_sheet_sub(*q, number(whole.low));
    c->limit[c->limits++] = mwc_sheet_sub(number(whole.high), *q);
}

/* Value of a polynomial at a place of the cube, as it comes. */
static double at_place(const mwc_sheet *a, const double *at)
{
    mwc_sheet b = *a;
    double sum = 0.0;
    for (int k = 0; k <= b.along; k++)
        for (int d = 0; d <= mwc_sheet_less(b.across, MWC_DEGREE - k); d++)
            for (int j = 0; j <= d; j++) {
                double term = b.c[mwc_cube_at(d - j, j, k)];
                for (int n = 0; n < d - j; n++) term *= at[0];
                for (int n = 0; n < j; n++) term *= at[1];
                for (int n = 0; n < k; n++) term *= at[2];
                sum += term;
            }
    return sum;
}

/* Remember the middle of a part of the wheel's flank. */
static void remember(search *h, const range *box)
{
    mw_first_certificate *c = h->found;
    for (int i = 0; i < 2; i++) {
        c->wheel[i] = 0.5 * box[i].low + 0.5 * box[i].high;
        c->pinion[i] = NAN;
    }
    c->apart = mwc_make(NAN, NAN);
    h->share = 0.0;
}

/* -- pieces of the wheel's flank ----------------------------------------------------------------------------------- */

/* First and last cell that a part touches along one side. */
static void cells_of(const range *box, const range *whole, int side, int *first, int *last)
{
    const double size = width(whole[side]) / (double)CELLS;
    const double low = (box[side].low - whole[side].low) / size - 1e-6, high = (box[side].high - whole[side].low) / size + 1e-6;
    *first = low > 0.0 ? (int)low : 0;
    *last = high < (double)(CELLS - 1) ? (int)high : CELLS - 1;
    if (*first > CELLS - 1) *first = CELLS - 1;
    if (*last < 0) *last = 0;
}

/* Whether any cell of a part is marked. */
static int marked(const search *h, const range *box)
{
    int first[2], last[2];
    for (int side = 0; side < 2; side++) cells_of(box, h->whole[1], side, first + side, last + side);
    for (int i = first[0]; i <= last[0]; i++)
        for (int j = first[1]; j <= last[1]; j++)
            if (h->cell[i][j]) return 1;
    return 0;
}

/* What parts of the pinion's flank, listed, do to a part of the wheel's. */
static int looked_at(search *h, const range *box, const place *w, const int *list, int count)
{
    mwc_sheet q[2];
    place p;
    cube whole = { .at = { 0.0, 0.0, 0.0 }, .half = { 1.0, 1.0, 1.0 }, .all = 1 };
    double witness[3];
    int exists = 0;
    if (!meeting(h, w, list, count, q, &p, &exists)) return WIDE;
    whole.away = apart(h, &p, w);
    take_limits(h, 0, &p, &whole);
    take_limits(h, 1, w, &whole);
    for (int i = 0; i < 2; i++) take_range(q + i, h->whole[0][i], &whole);
    const mwc_sheet away = whole.away;
    h->cubes = 0;
    const int verdict = told(h, &whole, exists, witness, 0);
    if (verdict == REFUTED) {
        mw_first_certificate *c = h->found;
        range there[2];
        for (int i = 0; i < 2; i++)
            there[i].low = there[i].high = 0.5 * box[i].low + 0.5 * box[i].high + witness[i] * 0.5 * width(box[i]);
        if (!marked(h, there)) return OPEN; /* on another piece */
        for (int i = 0; i < 2; i++) {
            c->wheel[i] = there[i].low;
            c->pinion[i] = at_place(q + i, witness);
        }
        c->apart = mwc_make(at_place(&away, witness), away.radius + 128.0 * MWC_U * mwc_sheet_part(&away, 0));
        h->share = witness[2];
    }
    return verdict;
}

/* Of cells from i, j on, `size` each way, which are not surely outside the limits: 2. */
static void mark_cells(search *h, int i, int j, int size, const cube *c)
{
    cube own = { .limits = 0 };
    for (int k = 0; k < c->limits; k++) {
        const range r = mwc_cube_range(&c->limit[k]);
        if (r.high < 0.0) return;
        if (!(r.low > 0.0)) own.limit[own.limits++] = c->limit[k];
    }
    if (size == 1 || own.limits == 0) {
        for (int m = 0; m < size; m++) memset(&h->cell[i + m][j], 2, (size_t)size);
        return;
    }
    for (int quarter = 0; quarter < 4; quarter++) {
        cube one = own;
        for (int k = 0; k < own.limits; k++) {
            mwc_cube_half(&one.limit[k], 0, quarter & 1 ? 1.0 : -1.0);
            mwc_cube_half(&one.limit[k], 1, quarter & 2 ? 1.0 : -1.0);
        }
        mark_cells(h, i + (quarter & 1 ? size / 2 : 0), j + (quarter & 2 ? size / 2 : 0), size / 2, &one);
    }
}

/* The same from the flank itself: of cells together where the limits are told closely enough by polynomials. */
static void look_for_cells(search *h, int i, int j, int size)
{
    mwc_sheet q[2];
    place w;
    cube c = { .all = 1 };
    range at[2];
    int close = 1;
    for (int side = 0; side < 2; side++) { /* a little wider, as wide as cells are told apart */
        const double cell = width(h->whole[1][side]) / (double)CELLS, n = (double)(side ? j : i);
        at[side].low = h->whole[1][side].low + (n - 1e-5) * cell;
        at[side].high = h->whole[1][side].low + (n + (double)size + 1e-5) * cell;
    }
    over(q, at);
    on_flank(h, 1, q, LIMITS, &w, NULL);
    if (outside(h, 1, &w)) return;
    take_limits(h, 1, &w, &c);
    for (int k = 0; k < c.limits; k++) close = close && c.limit[k].radius < CLOSE * mwc_sheet_part(&c.limit[k], 1);
    if (size == 1 || (c.all && close)) {
        mark_cells(h, i, j, size, &c);
        return;
    }
    for (int quarter = 0; quarter < 4; quarter++)
        look_for_cells(h, i + (quarter & 1 ? size / 2 : 0), j + (quarter & 2 ? size / 2 : 0), size / 2);
}

/* Mark the cells that hang together with the contact's through cells that are not surely outside the limits: what of the
 * wheel's flank lies in others is no part of the piece on which the contact lies. */
static void mark_piece(search *h, const mwc_sheet *q)
{
    int *const list = h->list, first[2], last[2], count = 0;
    range at[2];
    memset(h->cell, 0, sizeof h->cell);
    for (int i = 0; i < CELLS; i += BLOCK)
        for (int j = 0; j < CELLS; j += BLOCK) look_for_cells(h, i, j, BLOCK);
    for (int side = 0; side < 2; side++) {
        at[side] = mwc_cube_range(q + side);
        cells_of(at, h->whole[1], side, first + side, last + side);
    }
    for (int i = first[0]; i <= last[0]; i++)
        for (int j = first[1]; j <= last[1]; j++) h->cell[i][j] = 1, list[count++] = i * CELLS + j;
    while (count > 0) {
        const int k = list[--count];
        for (int i = k / CELLS - 1; i <= k / CELLS + 1; i++)
            for (int j = k % CELLS - 1; j <= k % CELLS + 1; j++) {
                if (i < 0 || j < 0 || i >= CELLS || j >= CELLS || h->cell[i][j] != 2) continue;
                h->cell[i][j] = 1;
                list[count++] = i * CELLS + j;
            }
    }
    for (int i = 0; i < CELLS; i++)
        for (int j = 0; j < CELLS; j++) h->cell[i][j] = h->cell[i][j] == 1;
}

/* Remember a part that stays open; last: nothing more can be looked at. */
static int left_open(search *h, const range *box, int last)
{
    remember(h, box);
    h->found->reason = MW_REASON_EFFORT;
    h->open += last ? MOST_OPEN + 1 : 1;
    return OPEN;
}

/* Settle a part of the wheel's flank, against the pinion's parts listed from `from` to `to`. */
static int settled(search *h, const range *box, int from, int to, int depth)
{
    mwc_sheet q[2];
    place w;
    if (++h->found->parts > h->effort || depth > DEEPEST) return left_open(h, box, h->found->parts > h->effort);
    if (!marked(h, box)) return SETTLED;
    over(q, box);
    on_flank(h, 1, q, LIMITS, &w, NULL);
    if (outside(h, 1, &w)) return SETTLED;
    const bounds there = bounds_of(h, w.x);
    int end = to;
    for (int look = 0; look < 2; look++) { /* coarse parts first */
        const int begin = end;
        for (int k = look ? to : from; k < (look ? begin : to) && end >= 0; k++)
            end = list_parts(h, h->list[k], &there, look ? 1.0 : COARSE, end);
        if (end < 0) return left_open(h, box, 1);
        if (end == begin) return SETTLED;
        if (look) to = begin;
        if (end - to > MOST_MET) break;
        const int verdict = looked_at(h, box, &w, h->list + to, end - to);
        if (verdict == SETTLED || verdict == REFUTED) return verdict;
        if (verdict == OPEN) break; /* smaller parts of the pinion's flank would not help */
    }
    range first[2], second[2];
    halved(box, longer(box, h->whole[1]), first, second);
    const int verdict = settled(h, first, to, end, depth + 1);
    if (verdict == REFUTED) return verdict;
    if (h->open > MOST_OPEN) return OPEN;
    const int other = settled(h, second, to, end, depth + 1);
    return other == SETTLED ? verdict : other;
}

/* Whether a line of a flank, from box[side].low to high, surely lies outside the blank. */
static int line_outside(search *h, int member, const range *box, int side, int depth)
{
    mwc_sheet q[2];
    place at;
    range first[2], second[2];
    over(q, box);
    on_flank(h, member, q, LIMITS, &at, NULL);
    if (outside(h, member, &at)) return 1;
    if (depth == DEEPEST_EDGE) return 0;
    halved(box, side, first, second);
    return line_outside(h, member, first, side, depth + 1) && line_outside(h, member, second, side, depth + 1);
}

/* Whether the blank surely ends a flank within these parameters, on all four sides. */
static int ends_within(search *h, int member, const range *box)
{
    for (int side = 0; side < 2; side++)
        for (int end = 0; end < 2; end++) {
            range line[2] = { box[0], box[1] };
            if (end) line[1 - side].low = line[1 - side].high;
            else line[1 - side].high = line[1 - side].low;
            if (!line_outside(h, member, line, side, 0)) return 0;
        }
    return 1;
}

/* -- frames -------------------------------------------------------------------------------------------------------- */

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
    return (sizeof(search) + MOST_PARTS * sizeof(part) + MOST_LISTED * sizeof(int)) / sizeof(double) + 4;
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
    h->part = (part *)(h + 1);
    h->list = (int *)(h->part + MOST_PARTS);
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
    if (!measured(h, h->pinion)) return c->outcome;
    for (int i = 0; i < 2; i++) q[i] = h->at.x[m->bodies[1].unknowns[i]];
    mark_piece(h, q);
    h->list[0] = 0;
    const int verdict = settled(h, h->whole[1], 0, 1, 0);
    if (verdict == SETTLED) c->outcome = MW_FIRST_PROVED;
    if (verdict == REFUTED) c->outcome = MW_FIRST_REFUTED;
    if (verdict != OPEN) c->reason = MW_REASON_NONE;
    return c->outcome;
}

int mw_certify_first(const mw_model *m, const mw_wide *s, mw_wide phi, const mw_certificate *contact, const double *flanks,
                     double slack, double reach, int effort, double *work, mw_first_certificate *c)
{
    search *h = (search *)work;
    int known = contact->flags ? MW_REASON_OFF_FLANK : MW_REASON_NONE;
    if (contact->outcome != MW_UNIQUE) known = contact->reason == MW_REASON_NONE ? MW_REASON_CONTACT : contact->reason;
    if (begun(m, known, s, flanks, slack, reach, effort, work, c) != MW_REASON_NONE) return c->outcome;
    h->at.phi = mwc_sheet_of_wide(phi);
    h->at.wheel_angle = mwc_sheet_of_ball(contact->wheel_angle);
    for (int i = 0; i < m->nx; i++) h->at.x[i] = mwc_sheet_of_wide(contact->x[i]);
    for (int i = 0; i < 3; i++) {
        h->at.point[i] = mwc_sheet_of_ball(contact->point[i]);
        h->at.normal[i] = mwc_sheet_of_ball(contact->normal[i]);
    }
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
    searched(h);
    if (c->wheel[0] == c->wheel[0]) *angle = 0.5 * from + 0.5 * to + h->share * (0.5 * to - 0.5 * from);
    return c->outcome;
}
