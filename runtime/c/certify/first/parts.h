/* Parts of the pinion's flank, halved as they are asked for, that may meet a part of the wheel's.
 * SPDX-License-Identifier: MIT-0 */
#ifndef MWC_FIRST_PARTS_H
#define MWC_FIRST_PARTS_H

#include "flanks.h"

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

#endif
