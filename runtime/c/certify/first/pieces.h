/* Pieces of the wheel's flank, told apart over its cells: the one with the contact is searched, part by part.
 * SPDX-License-Identifier: MIT-0 */
#ifndef MWC_FIRST_PIECES_H
#define MWC_FIRST_PIECES_H

#include "apart.h"

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

/* Whether any cell of a part is marked, at whichever angle. */
static int marked(const search *h, const range *box)
{
    int first[2], last[2];
    range at[2];
    for (int side = 0; side < 2; side++) {
        const range drift = mwc_cube_range(h->drift + side);
        at[side].low = box[side].low + drift.low;
        at[side].high = box[side].high + drift.high;
        cells_of(at, h->whole[1], side, first + side, last + side);
    }
    for (int i = first[0]; i <= last[0]; i++)
        for (int j = first[1]; j <= last[1]; j++)
            if (h->cell[i][j]) return 1;
    return 0;
}

/* By how much the wheel's places have followed the contact, in one parameter, at a share of the range of angles. */
static double drifted(const search *h, int parameter, double share)
{
    const double at[2] = { 0.0, 0.0 };
    const line by = line_at(h->drift + parameter, at);
    return line_value(&by, share).mid;
}

/* Whether the pinion, where it meets a part of the wheel's flank, is apart from it there. */
static int looked_at(search *h, const range *box, const place *w, const mwc_sheet *square, met *at)
{
    place p;
    cube whole;
    const overlapping none = { .found = 0 };
    int exists = 0;
    bounded(h, w, square, at, &p, &exists);
    whole.limits = 0;
    whole.all = 1;
    whole.away = apart(h, &p, w);
    take_limits(h, 0, &p, &whole);
    take_limits(h, 1, w, &whole);
    for (int i = 0; i < 2; i++) take_range(at->q + i, h->whole[0][i], &whole);
    h->cubes = 0;
    const overlapping o = exists ? overlaps(h, &whole) : none;
    if (o.found) {
        mw_first_certificate *c = h->found;
        range there[2];
        for (int i = 0; i < 2; i++)
            there[i].low = there[i].high = 0.5 * box[i].low + 0.5 * box[i].high + o.at[i] * 0.5 * width(box[i]);
        if (!marked(h, there)) return OPEN; /* on another piece */
        for (int i = 0; i < 2; i++) {
            const line q = line_at(at->q + i, o.at);
            c->wheel[i] = there[i].low + drifted(h, i, o.at[2]);
            c->pinion[i] = line_value(&q, o.at[2]).mid;
        }
        c->apart = o.apart;
        c->throughout = o.throughout;
        h->share = o.at[2];
        if (o.throughout) return REFUTED;
        if (h->once.parts == 0) h->once = *c, h->once_share = h->share;
        return c->parts < h->once.parts + LOOKED_ON ? OPEN : REFUTED;
    }
    return told(h, &whole, 0);
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
    int list[CELLS * CELLS], first[2], last[2], count = 0;
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

/* Settle a part of the wheel's flank, against the pinion's parts listed from `from` to `to`, or, unless NULL, from what is
 * known of the part of which it is half, the end of a side. */
static int settled(search *h, const range *box, int from, int to, const met *of, int side, double end, int depth)
{
    met at;
    mwc_sheet q[2], across[2];
    place w;
    int verdict = WIDE;
    if (++h->found->parts > h->effort || depth > DEEPEST) return left_open(h, box, h->found->parts > h->effort);
    if (!marked(h, box)) return SETTLED;
    over(q, box);
    for (int i = 0; i < 2; i++)
        if (h->drift[i].along) mwc_sheet_to_add(q + i, q + i, h->drift + i);
    on_flank(h, 1, q, LIMITS, &w, NULL);
    if (outside(h, 1, &w)) return SETTLED;
    const mwc_sheet square = squared(w.x);
    if (of) {
        at = *of;
        if (found_of_whole(h, &w, &square, side, end, &at)) verdict = looked_at(h, box, &w, &square, &at);
    } else {
        const bounds there = bounds_of(h, w.x, across);
        for (int look = 0; look < 2 && verdict == WIDE; look++) { /* coarse parts first */
            int last = to;
            for (int k = from; k < to && last >= 0; k++)
                last = list_parts(h, h->list + k, &there, look ? 1.0 : COARSE, last, 0);
            if (last < 0) return left_open(h, box, 1);
            if (last == to) return SETTLED;
            from = to;
            to = last;
            if (to - from <= MOST_MET && found_within(h, &w, &square, h->list + from, to - from, &at))
                verdict = looked_at(h, box, &w, &square, &at);
            if (to - from > FEW_MET) break;
        }
    }
    if (verdict == SETTLED || verdict == REFUTED) return verdict;
    range first[2], second[2];
    const met *const known = verdict == OPEN && at.close ? &at : NULL;
    const int longest = longer(box, h->whole[1]);
    halved(box, longest, first, second);
    verdict = settled(h, first, from, to, known, longest, -1.0, depth + 1);
    if (verdict == REFUTED) return verdict;
    if (h->open > MOST_OPEN) return OPEN;
    const int other = settled(h, second, from, to, known, longest, 1.0, depth + 1);
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
            range edge[2] = { box[0], box[1] };
            if (end) edge[1 - side].low = edge[1 - side].high;
            else edge[1 - side].high = edge[1 - side].low;
            if (!line_outside(h, member, edge, side, 0)) return 0;
        }
    return 1;
}

#endif
