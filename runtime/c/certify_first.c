/* First contact, proved: that two bounded flanks have no place in common as the wheel comes up to a certified contact.
 * See mw_certify.h.  SPDX-License-Identifier: MIT-0
 *
 * A point of the wheel's flank, turned about the wheel's axis, meets the pinion's flank where both have the same distance
 * from the axis and the same place along it; the angle between them is what the wheel is then apart from the contact. Over a
 * part of the wheel's flank that angle is a polynomial with an error bound: the pinion's parameters are polynomials from
 * Newton's method, and Krawczyk's operator bounds how far from them anything within a box lies that meets the part. The box
 * holds every part of the pinion's flank whose distance, place and angle may be those of the wheel's part. Parts are halved
 * until each lies outside the blank, meets nothing, or is apart. */
#include <string.h>
#define MWC_WIDES
#define MWC_SHEETS
#include "certify/krawczyk.h"
#include "certify/tables.h"
#include "kernels.h"
#include "mw_certify.h"

enum {
    MOST_PARTS = 60000, MOST_LISTED = 120000, /* of the pinion's flank; that are kept in mind */
    DEEPEST = 32, DEEPEST_EDGE = 14,          /* halvings */
    MOST_OPEN = 64,                           /* parts of the wheel's flank that may stay open, in search of an overlap */
    CELLS = 48,                               /* across the wheel's flank and along it, where its pieces are told apart */
    MOST_MET = 160,                           /* parts of the pinion's flank whose box is looked at as one */
    NEWTON_STEPS = 8, FULL_STEPS = 3, NARROWING_STEPS = 40,
    POINT = 0, REGULAR = 3                    /* outputs of a flank */
};

/* Half the middle of a part, in shares of it. */
static const double MIDDLE = 1e-6;

typedef struct range { double low, high; } range;

/* Bounds of where a part of a flank is: two combinations of the squared distance from the wheel's axis and the place along
 * it, such as are the pinion's parameters near the contact; the angle about the axis. */
typedef struct bounds {
    range across[2], angle;
} bounds;

/* A part of the pinion's flank: its parameters, where it is; number of the first of both halves, 0 if it has none; whether
 * it lies outside the blank. */
typedef struct part {
    range box[2];
    bounds at;
    int halves, outside;
} part;

typedef struct search {
    const mw_certified *tables;
    int margins[2], set[2][32];               /* limits of each flank and whether the design sets them */
    mw_ball turn[9], move[3], cosine, sine;   /* of the pinion's points and of the wheel's, into the frame of the search */
    double sense, slack, reach, view[4];
    int parts, effort, open;
    unsigned char cell[CELLS][CELLS];         /* 0: outside or of another piece */
    part *part;
    int *list;
    mw_first_certificate *found;
    mwc_sheet arguments[2][MWC_ARGUMENTS], registers[MWC_REGISTERS];
} search;

/* What a part of a flank is: point, frame of the search, and limits. */
typedef struct place {
    mwc_sheet x[3], limit[32];
} place;

static range range_of(const mwc_sheet *a)
{
    const double side = (mwc_sheet_part(a, 1) + a->radius) * MWC_SHEET_SUMMED, low = a->c[0] - side, high = a->c[0] + side;
    range r = { -HUGE_VAL, HUGE_VAL };
    if (side < HUGE_VAL) {
        r.low = low - 2.0 * MWC_U * mwc_abs(low);
        r.high = high + 2.0 * MWC_U * mwc_abs(high);
    }
    return r;
}

static int overlap(range a, range b)
{
    return !(a.low > b.high) && !(b.low > a.high);
}

static double width(range a)
{
    return a.high - a.low;
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
        b.across[i] = range_of(&across);
    }
    b.angle = range_of(&angle);
    return b;
}

/* -- flanks -------------------------------------------------------------------------------------------------------- */

/* Parameters of a flank over a part of it, one variable of the sheets each. */
static void over(mwc_sheet *q, const range *box)
{
    for (int i = 0; i < 2; i++) {
        memset(q + i, 0, sizeof q[i]);
        q[i].c[0] = 0.5 * box[i].low + 0.5 * box[i].high;
        q[i].c[1 + i] = (0.5 * box[i].high - 0.5 * box[i].low) * (1.0 + 8.0 * MWC_U)
                        + 4.0 * MWC_U * (mwc_abs(box[i].low) + mwc_abs(box[i].high));
    }
}

/* A vector of the pinion's frame in that of the search. */
static void carried(const search *h, const mwc_sheet *r, const mw_ball *move, mwc_sheet *x)
{
    for (int i = 0; i < 3; i++) {
        x[i] = mwc_sheet_of_ball(move ? move[i] : mwc_make(0.0, 0.0));
        for (int j = 0; j < 3; j++) x[i] = mwc_sheet_add(x[i], mwc_sheet_times(r[j], h->turn[3 * i + j]));
    }
}

/* A flank at parameters q[2]; tangents, unless NULL, of the pinion's, frame of the search. */
static void on_flank(search *h, int member, const mwc_sheet *q, place *at, mwc_sheet (*tangents)[3])
{
    const mw_code *code = &h->tables->flanks[member];
    mwc_sheet r[3];
    memcpy(h->arguments[member] + h->tables->slots, q, 2 * sizeof *q);
    mwc_run_sheet(code, tangents ? code->instructions : code->first, h->arguments[member], h->registers);
    for (int i = 0; i < 3; i++) r[i] = h->registers[code->output[POINT + i]];
    for (int i = 0; i < h->margins[member]; i++) at->limit[i] = h->registers[code->output[REGULAR + i]];
    if (member == 0) {
        carried(h, r, h->move, at->x);
    } else {
        at->x[0] = mwc_sheet_sub(mwc_sheet_times(r[0], h->cosine), mwc_sheet_times(r[1], h->sine));
        at->x[1] = mwc_sheet_add(mwc_sheet_times(r[0], h->sine), mwc_sheet_times(r[1], h->cosine));
        at->x[2] = r[2];
    }
    for (int k = 0; tangents && k < 2; k++) {
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

static int measured(search *h, const range *box)
{
    mwc_sheet q[2];
    place at;
    part *p = h->part + h->parts;
    if (h->parts == MOST_PARTS) return 0;
    memset(p, 0, sizeof *p);
    memcpy(p->box, box, sizeof p->box);
    over(q, box);
    on_flank(h, 0, q, &at, NULL);
    p->outside = outside(h, 0, &at);
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

/* List, from `to` on, the parts of number k that may meet the wheel's part, none much larger than it. Returns the list's new
 * end; -1: there is no room. */
static int list_parts(search *h, int k, const bounds *w, int to, const range *whole)
{
    if (!may_meet(h, h->part + k, w)) return to;
    const part *p = h->part + k;
    if (width(p->at.across[0]) <= width(w->across[0]) && width(p->at.across[1]) <= width(w->across[1])) {
        if (to == MOST_LISTED) return -1;
        h->list[to] = k;
        return to + 1;
    }
    if (!p->halves) {
        range first[2], second[2];
        halved(p->box, longer(p->box, whole), first, second);
        const int number = h->parts;
        if (!measured(h, first) || !measured(h, second)) return -1;
        h->part[k].halves = number;
    }
    const int number = h->part[k].halves;
    to = list_parts(h, number, w, to, whole);
    return to < 0 ? to : list_parts(h, number + 1, w, to, whole);
}

/* -- a part of the wheel's flank ----------------------------------------------------------------------------------- */

/* Lower bound of a sheet: where its quadratic part is convex, from its slope at any place z of the square, best its lowest:
 * q(x) >= q(z) + slope (x - z). */
static double lowest(const mwc_sheet *a)
{
    const double *c = a->c, plain = range_of(a).low;
    const mw_ball det = mwc_sub(mwc_mul(mwc_make(4.0 * c[3], 0.0), mwc_make(c[5], 0.0)), mwc_sqr(mwc_make(c[4], 0.0)));
    if (!(c[3] > 0.0 && c[5] > 0.0 && det.mid - mwc_reach(det) > 0.0)) return plain;
    double z[2] = { (c[4] * c[2] - 2.0 * c[5] * c[1]) / det.mid, (c[4] * c[1] - 2.0 * c[3] * c[2]) / det.mid };
    if (!(mwc_abs(z[0]) <= 1.0 && mwc_abs(z[1]) <= 1.0)) { /* the lowest place of each side */
        double least = HUGE_VAL;
        for (int side = 0; side < 4; side++) {
            const double on = side & 1 ? 1.0 : -1.0;
            const double x = side < 2 ? on : fmin(1.0, fmax(-1.0, -(c[1] + c[4] * on) / (2.0 * c[3])));
            const double y = side < 2 ? fmin(1.0, fmax(-1.0, -(c[2] + c[4] * on) / (2.0 * c[5]))) : on;
            const double value = x * (c[1] + c[3] * x + c[4] * y) + y * (c[2] + c[5] * y);
            if (value < least) least = value, z[0] = x, z[1] = y;
        }
    }
    const mw_ball x = mwc_make(z[0], 0.0), y = mwc_make(z[1], 0.0), k[] = { mwc_make(c[0], 0.0), mwc_make(c[1], 0.0),
        mwc_make(c[2], 0.0), mwc_make(c[3], 0.0), mwc_make(c[4], 0.0), mwc_make(c[5], 0.0) };
    const mw_ball along = mwc_add(mwc_add(k[1], mwc_mul(k[4], y)), mwc_mul(mwc_make(2.0 * c[3], 0.0), x));
    const mw_ball across = mwc_add(mwc_add(k[2], mwc_mul(k[4], x)), mwc_mul(mwc_make(2.0 * c[5], 0.0), y));
    mw_ball low = mwc_add(mwc_add(k[0], mwc_add(mwc_mul(k[1], x), mwc_mul(k[2], y))),
                          mwc_add(mwc_mul(k[3], mwc_sqr(x)), mwc_add(mwc_mul(k[4], mwc_mul(x, y)), mwc_mul(k[5], mwc_sqr(y)))));
    double fall = a->radius + mwc_sheet_part(a, 6);
    fall += along.mid > 0.0 ? along.mid * (z[0] + 1.0) : -along.mid * (1.0 - z[0]);
    fall += across.mid > 0.0 ? across.mid * (z[1] + 1.0) : -across.mid * (1.0 - z[1]);
    fall += 2.0 * (mwc_reach(along) + mwc_reach(across)) + mwc_reach(low);
    const double better = low.mid - fall * (1.0 + 32.0 * MWC_U) - 2.0 * MWC_U * mwc_abs(low.mid);
    return better > plain ? better : plain;
}

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
    on_flank(h, 0, q, p, J ? tangents : NULL);
    R[0] = mwc_sheet_sub(squared(p->x), *square);
    R[1] = mwc_sheet_sub(p->x[2], w->x[2]);
    for (int k = 0; J && k < 2; k++) {
        const mwc_sheet *t = tangents[k];
        J[k] = mwc_sheet_times(mwc_sheet_add(mwc_sheet_mul(p->x[0], t[0]), mwc_sheet_mul(p->x[1], t[1])), mwc_make(2.0, 0.0));
        J[2 + k] = t[2];
    }
}

/* The pinion's parameters q[2] that meet the wheel's part, as polynomials with error bounds: whatever of the parts listed
 * meets it lies within them, and where `exists` something does. q is any polynomial, C any matrix, and J, which does not
 * depend on the wheel, is over a box that holds q and the parts: what meets the wheel is apart from q by |C R| + |I - C J|
 * times as much at most, over and over again. 0 where Newton's method does not lead to a polynomial. */
static int meeting(search *h, const place *w, const int *list, int count, mwc_sheet *q, place *p, int *exists)
{
    const mwc_sheet square = squared(w->x);
    mwc_sheet R[2], J[4], b[2];
    mw_ball middle[4], z[2];
    double C[4], M[4], K[2], within[2], wider[2];
    range hull[2];
    memcpy(hull, h->part[list[0]].box, sizeof hull);
    for (int k = 1; k < count; k++)
        for (int i = 0; i < 2; i++) {
            hull[i].low = fmin(hull[i].low, h->part[list[k]].box[i].low);
            hull[i].high = fmax(hull[i].high, h->part[list[k]].box[i].high);
        }
    for (int i = 0; i < 2; i++) q[i] = mwc_sheet_of_ball(mwc_make(0.5 * hull[i].low + 0.5 * hull[i].high, 0.0));
    for (int step = 0; step < NEWTON_STEPS; step++) {
        const int full = step < FULL_STEPS;
        against(h, q, w, &square, p, R, full ? J : NULL);
        for (int k = 0; full && k < 4; k++) middle[k] = mwc_make(J[k].c[0], 0.0);
        if (full && !mwc_inverse(2, middle, C)) return 0;
        for (int i = 0; i < 2; i++) {
            const mwc_sheet change = mwc_sheet_add(mwc_sheet_times(R[0], mwc_make(C[2 * i], 0.0)),
                                                   mwc_sheet_times(R[1], mwc_make(C[2 * i + 1], 0.0)));
            q[i] = mwc_sheet_sub(q[i], change);
            q[i].radius = 0.0; /* polynomials, whichever they are */
        }
        for (int i = 0; i < 2; i++)
            if (!(mwc_abs(q[i].c[0] - 0.5 * hull[i].low - 0.5 * hull[i].high) < 16.0 * width(hull[i]))) return 0;
    }
    against(h, q, w, &square, p, R, NULL);
    for (int i = 0; i < 2; i++) {
        const mwc_sheet shift = mwc_sheet_add(mwc_sheet_times(R[0], mwc_make(C[2 * i], 0.0)),
                                              mwc_sheet_times(R[1], mwc_make(C[2 * i + 1], 0.0)));
        const double reach = mwc_sheet_part(&q[i], 1), at = q[i].c[0];
        double side = fmax(mwc_abs(hull[i].low - at), mwc_abs(hull[i].high - at));
        side = fmax(side, 1.5 * reach) * (1.0 + 1e-9) + 4.0 * MWC_U * mwc_abs(at);
        z[i] = mwc_make(0.0, mwc_sheet_most(&shift));
        hull[i].low = at - side;
        hull[i].high = at + side;
        within[i] = (side + reach) * (1.0 + 1e-9);
    }
    over(b, hull);
    against(h, b, w, &square, p, R, J);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            mwc_sheet sum = mwc_sheet_of_ball(mwc_make(i == j ? 1.0 : 0.0, 0.0));
            for (int k = 0; k < 2; k++)
                sum = mwc_sheet_sub(sum, mwc_sheet_times(J[2 * k + j], mwc_make(C[2 * i + k], 0.0)));
            M[2 * i + j] = mwc_sheet_most(&sum);
        }
    for (int step = 0; step < NARROWING_STEPS; step++) {
        mwc_image(2, z, M, within, K);
        for (int i = 0; i < 2; i++)
            if (K[i] < within[i]) within[i] = K[i];
    }
    *exists = 1;
    for (int i = 0; i < 2; i++) {
        wider[i] = 2.0 * within[i] + 4.0 * MWC_U * mwc_abs(q[i].c[0]);
        *exists = *exists && mwc_sheet_part(&q[i], 1) + wider[i] < 0.5 * width(hull[i]) * (1.0 - 1e-9);
    }
    mwc_image(2, z, M, wider, K);
    *exists = *exists && mwc_inside(2, K, wider);
    for (int i = 0; i < 2; i++) q[i].radius = within[i];
    on_flank(h, 0, q, p, NULL);
    return 1;
}

/* What is found of a part. */
enum { OPEN, SETTLED, REFUTED };

static int judged(search *h, const place *w, const mwc_sheet *q, const place *p, int exists, const range *whole)
{
    const mwc_sheet away = apart(h, p, w);
    const double low = lowest(&away), high = range_of(&away).high;
    if (outside(h, 0, p) || high < -h->reach) return SETTLED;
    if (low > -h->slack) return SETTLED;
    if (!(exists && high < -h->slack && low > -h->reach && inside(h, 0, p) && inside(h, 1, w))) return OPEN;
    for (int i = 0; i < 2; i++) {
        const range r = range_of(&q[i]);
        if (!(r.low >= whole[i].low && r.high <= whole[i].high)) return OPEN;
    }
    return REFUTED;
}

/* Remember a part of the wheel's flank, and the pinion's place q unless NULL. */
static void remember(mw_first_certificate *c, const range *box, const mwc_sheet *q, const mwc_sheet *away)
{
    for (int i = 0; i < 2; i++) {
        c->wheel[i] = 0.5 * box[i].low + 0.5 * box[i].high;
        c->pinion[i] = q ? q[i].c[0] : NAN;
    }
    c->apart = mwc_make(away ? away->c[0] : NAN, away ? (mwc_sheet_part(away, 1) + away->radius) * MWC_SHEET_SUMMED : NAN);
}

/* What parts of the pinion's flank, listed, do to a part of the wheel's. A part that may overlap deeper than the slack does so
 * for sure, if at all, in its middle: on its border with others that do not nothing can be told. */
static int looked_at(search *h, const range *box, const int *list, int count, const range *whole)
{
    mwc_sheet q[2], away;
    place w, p;
    range middle[2];
    int exists = 0, verdict = OPEN;
    memcpy(middle, box, sizeof middle);
    for (int look = 0; look < 2; look++) {
        over(q, middle);
        on_flank(h, 1, q, &w, NULL);
        if (!meeting(h, &w, list, count, q, &p, &exists)) return OPEN;
        verdict = judged(h, &w, q, &p, exists, whole);
        away = apart(h, &p, &w);
        if (verdict != OPEN || !(away.c[0] < -h->slack)) break;
        for (int i = 0; i < 2; i++) {
            const double at = 0.5 * box[i].low + 0.5 * box[i].high, side = MIDDLE * width(box[i]);
            middle[i].low = at - side;
            middle[i].high = at + side;
        }
    }
    if (verdict == REFUTED) remember(h->found, middle, q, &away);
    return verdict == SETTLED && middle[0].low != box[0].low ? OPEN : verdict;
}

/* -- pieces of the wheel's flank ----------------------------------------------------------------------------------- */

/* First and last cell that a part touches along one side. */
static void cells_of(const range *box, const range *whole, int side, int *first, int *last)
{
    const double size = width(whole[side]) / (double)CELLS;
    const double low = (box[side].low - whole[side].low) / size - 1e-6, high = (box[side].high - whole[side].low) / size + 1e-6;
    *first = low > 0.0 ? (int)low : 0;
    *last = high < (double)(CELLS - 1) ? (int)high : CELLS - 1;
}

/* Whether any cell of a part is marked. */
static int marked(const search *h, const range *box, const range *whole)
{
    int first[2], last[2];
    for (int side = 0; side < 2; side++) cells_of(box, whole, side, first + side, last + side);
    for (int i = first[0]; i <= last[0]; i++)
        for (int j = first[1]; j <= last[1]; j++)
            if (h->cell[i][j]) return 1;
    return 0;
}

/* Mark the cells that hang together with the contact's through cells that are not surely outside the limits: what of the
 * wheel's flank lies in others is no part of the piece on which the contact lies. */
static void mark_piece(search *h, const range *whole, const double *contact)
{
    int *const list = h->list, first[2], last[2], count = 0;
    range at[2];
    memset(h->cell, 0, sizeof h->cell);
    for (int side = 0; side < 2; side++) {
        at[side].low = at[side].high = contact[side];
        cells_of(at, whole, side, first + side, last + side);
    }
    for (int i = first[0]; i <= last[0]; i++)
        for (int j = first[1]; j <= last[1]; j++) h->cell[i][j] = 1, list[count++] = i * CELLS + j;
    while (count > 0) {
        const int k = list[--count];
        for (int i = k / CELLS - 1; i <= k / CELLS + 1; i++)
            for (int j = k % CELLS - 1; j <= k % CELLS + 1; j++) {
                mwc_sheet q[2];
                place w;
                if (i < 0 || j < 0 || i >= CELLS || j >= CELLS || h->cell[i][j]) continue;
                for (int side = 0; side < 2; side++) {
                    const double size = width(whole[side]) / (double)CELLS, n = (double)(side ? j : i);
                    at[side].low = whole[side].low + (n - 1e-6) * size;
                    at[side].high = whole[side].low + (n + 1.0 + 1e-6) * size;
                }
                over(q, at);
                on_flank(h, 1, q, &w, NULL);
                if (outside(h, 1, &w)) continue;
                h->cell[i][j] = 1;
                list[count++] = i * CELLS + j;
            }
    }
}

/* Remember a part that stays open; last: nothing more can be looked at. */
static int left_open(search *h, const range *box, int last)
{
    remember(h->found, box, NULL, NULL);
    h->found->reason = MW_REASON_EFFORT;
    h->open += last ? MOST_OPEN + 1 : 1;
    return OPEN;
}

/* Settle a part of the wheel's flank, against the pinion's parts listed from `from` to `to`. whole: both flanks. */
static int settled(search *h, const range *box, const range (*whole)[2], int from, int to, int depth)
{
    mwc_sheet q[2];
    place w;
    if (++h->found->parts > h->effort || depth > DEEPEST) return left_open(h, box, h->found->parts > h->effort);
    if (!marked(h, box, whole[1])) return SETTLED;
    over(q, box);
    on_flank(h, 1, q, &w, NULL);
    if (outside(h, 1, &w)) return SETTLED;
    const bounds there = bounds_of(h, w.x);
    int end = to;
    for (int k = from; k < to && end >= 0; k++) end = list_parts(h, h->list[k], &there, end, whole[0]);
    if (end < 0) return left_open(h, box, 1);
    if (end == to) return SETTLED;
    if (end - to <= MOST_MET) {
        const int verdict = looked_at(h, box, h->list + to, end - to, whole[0]);
        if (verdict != OPEN) return verdict;
    }
    range first[2], second[2];
    halved(box, longer(box, whole[1]), first, second);
    const int verdict = settled(h, first, whole, to, end, depth + 1);
    if (verdict == REFUTED) return verdict;
    if (h->open > MOST_OPEN) return OPEN;
    const int other = settled(h, second, whole, to, end, depth + 1);
    return other == SETTLED ? verdict : other;
}

/* Whether a line of a flank, from box[side].low to high, surely lies outside the blank. */
static int line_outside(search *h, int member, const range *box, int side, int depth)
{
    mwc_sheet q[2];
    place at;
    range first[2], second[2];
    over(q, box);
    on_flank(h, member, q, &at, NULL);
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

/* The frame of the search: the wheel's, turned as at the contact, and so that the contact lies in its x z plane. Returns a
 * reason. */
static int place_bodies(search *h, const mw_wide *s, mw_wide phi, const mw_certificate *contact)
{
    const mw_certified *t = h->tables;
    const mw_code *code = &t->placement;
    mw_wide arguments[MWC_ARGUMENTS], registers[MWC_REGISTERS], o[36];
    memcpy(arguments, s, sizeof(mw_wide) * (size_t)t->slots);
    arguments[t->slots] = phi;
    arguments[t->slots + 1] = mwc_wide_of(0.0);
    mwc_run_wide(code, code->instructions, arguments, registers);
    for (int i = 0; i < 36; i++) o[i] = registers[code->output[i]];
    const mw_wide *pinion = o, *wheel = o + 18, *axis = o + 30, *origin = o + 33;
    mw_ball lever = mwc_make(0.0, 0.0), sense = lever, arm[3], moved[3];
    mw_wide turn[9], move[3];
    for (int i = 0; i < 3; i++) {
        arm[i] = mwc_sub(contact->point[i], mwc_of_wide(origin[i]));
        sense = mwc_add(sense, mwc_mul(mwc_of_wide(axis[i]), mwc_of_wide(wheel[4 * i + 2])));
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        moved[i] = mwc_sub(mwc_mul(mwc_of_wide(axis[j]), arm[k]), mwc_mul(mwc_of_wide(axis[k]), arm[j]));
        lever = mwc_add(lever, mwc_mul(contact->normal[i], moved[i]));
    }
    if (!(mwc_abs(lever.mid) - mwc_reach(lever) > 0.0 && mwc_abs(sense.mid) - mwc_reach(sense) > 0.0)) return MW_REASON_WIDE;
    /* turned further by a small angle in the wheel's frame, a place of the pinion is met by a wheel that is turned further */
    const double turns = sense.mid > 0.0 ? 1.0 : -1.0;
    h->sense = (lever.mid > 0.0 ? -1.0 : 1.0) * turns;
    for (int i = 0; i < 3; i++) {
        move[i] = mwc_wide_of(0.0);
        for (int k = 0; k < 3; k++)
            move[i] = mwc_wide_add(move[i], mwc_wide_mul(wheel[4 * k + i], mwc_wide_sub(pinion[4 * k + 3], wheel[4 * k + 3])));
        for (int j = 0; j < 3; j++) {
            turn[3 * i + j] = mwc_wide_of(0.0);
            for (int k = 0; k < 3; k++)
                turn[3 * i + j] = mwc_wide_add(turn[3 * i + j], mwc_wide_mul(wheel[4 * k + i], pinion[4 * k + j]));
        }
    }
    double at[2] = { 0.0, 0.0 };
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) at[i] += wheel[4 * k + i].hi * (contact->point[k].mid - wheel[4 * k + 3].hi);
    const double facing = mwi_angle(at[1], at[0]);
    mw_wide angle = mwc_wide(-facing, 0.0, 0.0), cosine, sine;
    mwc_wide_sincos(angle, &sine, &cosine);
    for (int j = 0; j < 4; j++) {
        mw_wide *x = j < 3 ? turn + j : move, *y = j < 3 ? turn + 3 + j : move + 1;
        const mw_wide a = *x, b = *y;
        *x = mwc_wide_sub(mwc_wide_mul(cosine, a), mwc_wide_mul(sine, b));
        *y = mwc_wide_add(mwc_wide_mul(sine, a), mwc_wide_mul(cosine, b));
    }
    for (int i = 0; i < 9; i++) h->turn[i] = mwc_of_wide(turn[i]);
    for (int i = 0; i < 3; i++) h->move[i] = mwc_of_wide(move[i]);
    /* the wheel's points, turned by its angle and then as the frame is */
    angle = mwc_wide(turns * contact->wheel_angle.mid, 0.0, mwc_reach(contact->wheel_angle));
    angle = mwc_wide_sub(angle, mwc_wide_of(facing));
    mwc_wide_sincos(angle, &sine, &cosine);
    h->cosine = mwc_of_wide(cosine);
    h->sine = mwc_of_wide(sine);
    return MW_REASON_NONE;
}

/* Which limits the design sets, those that are numbers at the contact; the view, any matrix. Returns whether the contact
 * surely lies inside all limits. */
static int look_at(search *h, const mw_model *m, const mw_certificate *contact)
{
    place at;
    mwc_sheet q[2], R[2], J[4];
    mw_ball middle[4];
    int within = 1;
    for (int member = 0; member < 2; member++) {
        for (int i = 0; i < 2; i++) q[i] = mwc_sheet_of_wide(contact->x[m->bodies[member].unknowns[i]]);
        on_flank(h, member, q, &at, NULL);
        for (int i = 0; i < h->margins[member]; i++) h->set[member][i] = at.limit[i].c[0] == at.limit[i].c[0];
        within = within && inside(h, member, &at);
    }
    const place wheel = at;
    const mwc_sheet square = squared(wheel.x);
    for (int i = 0; i < 2; i++) q[i] = mwc_sheet_of_wide(contact->x[m->bodies[0].unknowns[i]]);
    against(h, q, &wheel, &square, &at, R, J);
    for (int k = 0; k < 4; k++) middle[k] = mwc_make(J[k].c[0], 0.0);
    if (mwc_inverse(2, middle, h->view)) return within;
    h->view[0] = h->view[3] = 1.0;
    h->view[1] = h->view[2] = 0.0;
    return within;
}

/* Whether this can be asked of the drive and of the contact. Returns a reason. */
static int possible(const mw_model *m, const mw_certificate *contact)
{
    if (!mw_encloses(m)) return MW_REASON_ARITHMETIC;
    const mw_certified *t = m->kernels->certified();
    if (contact->outcome != MW_UNIQUE) return contact->reason == MW_REASON_NONE ? MW_REASON_CONTACT : contact->reason;
    if (contact->flags) return MW_REASON_OFF_FLANK;
    for (int i = 0; i < 2; i++) {
        if (m->bodies[i].parameters != 2 || m->bodies[i].margins > 30) return MW_REASON_CONDITION;
        if (t->flanks[i].registers > MWC_REGISTERS) return MW_REASON_DESIGN;
    }
    if (t->placement.registers > MWC_REGISTERS || t->slots + 2 > MWC_ARGUMENTS) return MW_REASON_DESIGN;
    return t->turning ? MW_REASON_NONE : MW_REASON_CONDITION;
}

size_t mw_certify_first_work(void)
{
    return (sizeof(search) + MOST_PARTS * sizeof(part) + MOST_LISTED * sizeof(int)) / sizeof(double) + 4;
}

int mw_certify_first(const mw_model *m, const mw_wide *s, mw_wide phi, const mw_certificate *contact, const double *flanks,
                     double slack, double reach, int effort, double *work, mw_first_certificate *c)
{
    search *h = (search *)work;
    range whole[2][2];
    memset(c, 0, sizeof *c);
    for (int i = 0; i < 2; i++) c->wheel[i] = c->pinion[i] = NAN;
    c->apart = mwc_make(NAN, NAN);
    c->outcome = MW_FIRST_UNKNOWN;
    c->reason = possible(m, contact);
    if (c->reason == MW_REASON_NONE && !(slack > 0.0 && reach > slack && reach < 1.0)) c->reason = MW_REASON_BOX;
    for (int i = 0; i < 4; i++) {
        whole[i / 2][i % 2].low = flanks[2 * i];
        whole[i / 2][i % 2].high = flanks[2 * i + 1];
        if (c->reason == MW_REASON_NONE && !(width(whole[i / 2][i % 2]) > 0.0 && width(whole[i / 2][i % 2]) < HUGE_VAL))
            c->reason = MW_REASON_BOX;
    }
    if (c->reason != MW_REASON_NONE) return c->outcome;
    memset(h, 0, sizeof *h);
    h->tables = m->kernels->certified();
    h->part = (part *)(h + 1);
    h->list = (int *)(h->part + MOST_PARTS);
    h->slack = slack;
    h->reach = reach;
    h->effort = effort;
    h->found = c;
    for (int i = 0; i < 2; i++) {
        h->margins[i] = 1 + m->bodies[i].margins;
        for (int k = 0; k < h->tables->design_slots; k++) h->arguments[i][k] = mwc_sheet_of_wide(s[k]);
    }
    c->reason = place_bodies(h, s, phi, contact);
    if (c->reason != MW_REASON_NONE) return c->outcome;
    if (!look_at(h, m, contact)) {
        c->reason = MW_REASON_OFF_FLANK;
        return c->outcome;
    }
    for (int i = 0; i < 2; i++) c->ends[i] = ends_within(h, i, whole[i]);
    if (!measured(h, whole[0])) return c->outcome;
    double at[2];
    for (int i = 0; i < 2; i++) at[i] = contact->x[m->bodies[1].unknowns[i]].hi;
    mark_piece(h, whole[1], at);
    h->list[0] = 0;
    const int verdict = settled(h, whole[1], (const range (*)[2])whole, 0, 1, 0);
    if (verdict == SETTLED) c->outcome = MW_FIRST_PROVED;
    if (verdict == REFUTED) c->outcome = MW_FIRST_REFUTED, c->reason = MW_REASON_NONE;
    return c->outcome;
}
