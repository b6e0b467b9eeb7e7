/* A part of the wheel's flank: whether it is apart from the pinion's wherever both keep their limits.
 * SPDX-License-Identifier: MIT-0 */
#ifndef MWC_FIRST_APART_H
#define MWC_FIRST_APART_H

#include "meeting.h"

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

#endif
