/* Parts of the pinion's flank that may meet a part of the wheel's, as small as that tells.  SPDX-License-Identifier: MIT-0 */
#ifndef MWC_FIRST_PARTS_H
#define MWC_FIRST_PARTS_H

#include "flanks.h"

/* The pinion's parameters over a box that follows the contact. */
static void following(const search *h, const range *box, mwc_sheet *q)
{
    over(q, box);
    for (int i = 0; i < 2; i++) q[i] = mwc_sheet_add(q[i], h->follow[i]);
}

/* Whether what lies within bounds may meet the wheel's part, apart by -reach to -slack. */
static int may_meet(const search *h, const bounds *p, const bounds *w)
{
    const double a = h->sense * (p->angle.low - w->angle.high), b = h->sense * (p->angle.high - w->angle.low);
    range apart = { a < b ? a : b, a < b ? b : a }, asked = { -h->reach, -h->slack };
    apart.low -= 1e-12 + 4.0 * MWC_U * mwc_abs(apart.low);
    apart.high += 1e-12 + 4.0 * MWC_U * mwc_abs(apart.high);
    if (!(apart.high >= apart.low)) apart.low = -HUGE_VAL, apart.high = HUGE_VAL;
    if (!overlap(p->across[0], w->across[0]) || !overlap(p->across[1], w->across[1])) return 0;
    for (int turns = -1; turns <= 1; turns++) { /* angles of both may lie on either side of the cut */
        const range there = { apart.low + 6.3 * turns - 0.02, apart.high + 6.3 * turns + 0.02 };
        if (overlap(turns ? there : apart, asked)) return 1;
    }
    return 0;
}

/* Where in [-1, 1]^2 the polynomials of a part may take the values that the wheel's part has. With C near the inverse of
 * their slopes L by s and t, f = a(u) + L (s, t) + n takes a value w only where
 *     (s, t) = C (w - a - n) + (I - C L) (s, t).
 * off: by how much n and the last term let them vary; by: the share that s, and t, have in it. 0: nothing is told. */
static int where_met(const mwc_sheet *f, const bounds *w, range *at, double *off, double *by)
{
    mw_ball L[4];
    double C[4], rest[2] = { 0.0, 0.0 }, with[2][2] = { { 0.0 } };
    range value[2];
    for (int i = 0; i < 2; i++) {
        const double turns = turning(f + i) * MWC_SHEET_SUMMED;
        for (int j = 0; j < 2; j++) L[2 * i + j] = mwc_make(f[i].c[1 + j], 0.0);
        for (int k = 0; k <= f[i].along; k++)
            for (int d = k ? 1 : 2; d <= mwc_sheet_less(f[i].across, MWC_DEGREE - k); d++)
                for (int j = 0; j <= d; j++) {
                    const double term = mwc_abs(f[i].c[mwc_cube_at(d - j, j, k)]);
                    rest[i] += term;
                    with[i][0] += j < d ? term : 0.0;
                    with[i][1] += j > 0 ? term : 0.0;
                }
        rest[i] = (rest[i] + f[i].radius) * MWC_SHEET_SUMMED;
        value[i].low = w->across[i].low - f[i].c[0] - turns;
        value[i].high = w->across[i].high - f[i].c[0] + turns;
        rest[i] += 8.0 * MWC_U * (mwc_abs(w->across[i].low) + mwc_abs(w->across[i].high) + mwc_abs(f[i].c[0]) + turns);
    }
    if (!mwc_inverse(2, L, C)) return 0;
    by[0] = by[1] = 0.0;
    for (int i = 0; i < 2; i++) {
        double low = 0.0, high = 0.0, size = 0.0;
        off[i] = 0.0;
        for (int k = 0; k < 2; k++) {
            const double c = C[2 * i + k], a = c * value[k].low, b = c * value[k].high;
            low += a < b ? a : b;
            high += a < b ? b : a;
            size += mwc_abs(a) + mwc_abs(b);
            off[i] += mwc_abs(c) * rest[k];
            for (int j = 0; j < 2; j++) by[j] += mwc_abs(c) * with[k][j];
        }
        for (int j = 0; j < 2; j++) {
            const double p = C[2 * i] * L[j].mid, q = C[2 * i + 1] * L[2 + j].mid;
            off[i] += mwc_abs((i == j ? 1.0 : 0.0) - p - q) + 8.0 * MWC_U * (1.0 + mwc_abs(p) + mwc_abs(q));
        }
        off[i] = (off[i] + 16.0 * MWC_U * size) * (1.0 + 64.0 * MWC_U);
        at[i].low = low - off[i];
        at[i].high = high + off[i];
        if (!(off[i] < HUGE_VAL)) return 0;
    }
    return 1;
}

/* A side of a box cut to where in [-1, 1] of it something may be; returns whether anything is left. */
static int cut(range *side, const mwc_sheet *over, int variable, range at)
{
    const double middle = over->c[0], half = over->c[1 + variable];
    const double low = middle + half * at.low, high = middle + half * at.high;
    const double rounding = 4.0 * MWC_U * (mwc_abs(middle) + half);
    if (at.low > -1.0) side->low = fmax(side->low, low - rounding);
    if (at.high < 1.0) side->high = fmin(side->high, high + rounding);
    return side->low <= side->high;
}

/* What becomes of a part of the pinion's flank: nothing, it is kept, it is halved, or no more may be looked at. */
enum { NOTHING, KEPT, HALVED, TIRED };

/* Look where a part of the pinion's flank is. */
static int looked_up(search *h, part *p)
{
    mwc_sheet q[2];
    place at;
    if (h->looks == FEWEST + MANY * h->effort) return TIRED;
    h->looks++;
    following(h, p->box, q);
    on_flank(h, 0, q, LIMITS, &at, NULL);
    if (outside(h, 0, &at)) return NOTHING;
    for (int i = 0; i < 2; i++)
        if (!overlap(mwc_cube_range(q + i), h->whole[0][i])) return NOTHING;
    p->at = bounds_of(h, at.x, p->across);
    memcpy(p->within, p->box, sizeof p->box);
    return KEPT;
}

/* Cut a part of which is known where it is to what may meet the wheel's part, until it is nearly a plane or not larger than so
 * many times that. side: to be halved. */
static int narrowed(search *h, part *p, const bounds *w, double times, int *side)
{
    for (int step = 0;; step++) {
        mwc_sheet whole[2];
        range at[2], *const own = p->within;
        double off[2] = { 0.0, 0.0 }, by[2] = { 0.0, 0.0 }, left = 1.0;
        if (!may_meet(h, &p->at, w)) return NOTHING;
        const int told = where_met(p->across, w, at, off, by);
        over(whole, p->box);
        for (int i = 0; told && i < 2; i++) {
            if (!cut(own + i, whole + i, i, at[i])) return NOTHING;
            left *= width(own[i]) / width(p->box[i]);
        }
        if (left < WORTH && step < NARROWEST) {
            memcpy(p->box, own, sizeof p->box);
            const int found = looked_up(h, p);
            if (found != KEPT) return found;
            continue;
        }
        if (told && times > 1.0 && off[0] < STRAIGHT && off[1] < STRAIGHT) return KEPT;
        if (p->at.spread[0] <= times * w->spread[0] && p->at.spread[1] <= times * w->spread[1]) return KEPT;
        *side = longer(own, h->pinion);
        if (!told || !(times > 1.0)) return HALVED;
        for (int i = 0; i < 2; i++)
            if (0.5 * width(at[i]) - off[i] > FULL) by[i] = -1.0; /* the wheel's part is what is too large */
        if (by[0] < 0.0 && by[1] < 0.0) return KEPT;
        if (by[0] != by[1]) *side = by[1] > by[0];
        return HALVED;
    }
}

/* List, from `to` on, what of a part of the pinion's flank may meet the wheel's part. Returns the list's new end; -1: there is
 * no room. */
static int list_parts(search *h, const part *p, const bounds *w, double times, int to, int depth)
{
    if (to == MOST_LISTED) return -1;
    part *const own = h->list + to;
    range half[2][2];
    int side = 0, found;
    if (own != p) *own = *p;
    found = narrowed(h, own, w, times, &side);
    if (found == NOTHING) return to;
    if (found == KEPT) return to + 1;
    if (found == TIRED || depth == DEEPEST) return -1;
    halved(own->within, side, half[0], half[1]);
    for (int k = 0; k < 2 && to >= 0; k++) {
        if (to == MOST_LISTED) return -1;
        part *const next = h->list + to;
        memcpy(next->box, half[k], sizeof half[k]);
        found = looked_up(h, next);
        if (found == TIRED) return -1;
        if (found == KEPT) to = list_parts(h, next, w, times, to, depth + 1);
    }
    return to;
}

#endif
