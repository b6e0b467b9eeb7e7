/* How far the flanks stand apart along a curve of the wheel's flank, and whether it lies inside their limits.
 * SPDX-License-Identifier: MIT-0 */
#ifndef MWC_FIRST_ALONG_H
#define MWC_FIRST_ALONG_H

#include "meeting.h"

enum { DEEPEST_STRETCH = 40, MOST_STRETCHES = 2000 };

/* How much wider than what the curve crosses the box of the pinion's parameters is, and its least share of the flank. */
static const double WIDER = 1.5, LEAST_BOX = 1e-4;

/* Bounds of the smallest limit of both flanks. */
static range least_limit(const search *h, const place *w, const place *p)
{
    range least = { HUGE_VAL, HUGE_VAL };
    for (int member = 0; member < 2; member++)
        for (int i = 0; i < h->margins[member]; i++) {
            if (!h->set[member][i]) continue;
            const range r = mwc_cube_range((member ? w : p)->limit + i);
            least.low = r.low < least.low || r.low != r.low ? r.low : least.low;
            least.high = r.high < least.high ? r.high : least.high;
        }
    return least;
}

/* A polynomial at s = t = 0, as one of u. */
static mwc_sheet at_middle(const mwc_sheet *a)
{
    mwc_sheet middle = number(a->c[0]);
    middle.along = a->along;
    for (int k = 1; k <= a->along; k++) middle.c[MWC_BLOCK[k]] = a->c[MWC_BLOCK[k]];
    return middle;
}

/* The same of a stretch of the curve; q: the wheel's parameters, then the pinion's, nearly. Whether they surely meet there. */
static int stretch_at(search *h, const mwc_sheet *q, range *away, range *limit)
{
    place w, p;
    met at;
    range about[2];
    double from[2];
    int exists;
    memset(&at, 0, sizeof at);
    on_flank(h, 1, q, LIMITS, &w, NULL);
    const mwc_sheet square = squared(w.x);
    for (int i = 0; i < 2; i++) {
        h->follow[i] = at_middle(q + 2 + i);
        const mwc_sheet beside = mwc_sheet_sub(q[2 + i], h->follow[i]);
        const double side = WIDER * width(mwc_cube_range(&beside)) + LEAST_BOX * width(h->whole[0][i]);
        about[i].low = -side;
        about[i].high = side;
    }
    if (!centred(h, &w, square.c[0], about, from, at.C)) return 0;
    defect(h, about, &w, &square, at.C, at.M);
    if (!shrinks(at.M) || !sought(h, &w, &square, from, &at)) return 0;
    memcpy(at.hull, about, sizeof about);
    bounded(h, &w, &square, &at, &p, &exists);
    const mwc_sheet apart_there = apart(h, &p, &w);
    *away = mwc_cube_range(&apart_there);
    *limit = least_limit(h, &w, &p);
    return exists;
}

/* All of a curve, halved where bounds are further apart than `fine`, rad, or a limit is not told. Whether it is told. */
static int all_along(search *h, const mwc_sheet *q, double fine, int depth, mw_line_certificate *c)
{
    range away = { -HUGE_VAL, HUGE_VAL }, limit = away;
    const int met_there = ++c->parts <= MOST_STRETCHES && stretch_at(h, q, &away, &limit);
    const int told_there = met_there && width(away) <= fine && (limit.low > 0.0 || limit.high < 0.0);
    if (told_there) {
        c->apart[0] = fmin(c->apart[0], away.low);
        c->apart[1] = fmax(c->apart[1], away.high);
        c->nearest = fmin(c->nearest, away.high);
        c->limit[0] = fmin(c->limit[0], limit.low);
        c->limit[1] = fmax(c->limit[1], limit.high);
        return 1;
    }
    if (depth == DEEPEST_STRETCH || c->parts > MOST_STRETCHES) return 0;
    for (double end = -1.0; end <= 1.0; end += 2.0) {
        mwc_sheet half[4];
        memcpy(half, q, sizeof half);
        for (int i = 0; i < 4; i++) mwc_cube_half(half + i, 0, end);
        if (!all_along(h, half, fine, depth + 1, c)) return 0;
    }
    return 1;
}

#endif
