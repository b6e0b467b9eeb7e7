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

/* Whether nothing in a cube overlaps deeper than the slack. */
static int told(search *h, cube *c, int depth)
{
    int kept = 0, held = 1;
    if (mwc_cube_low(&c->away) > -h->slack || mwc_cube_range(&c->away).high < -h->reach) return SETTLED;
    for (int i = 0; i < c->limits; i++) {
        const range r = mwc_cube_range(&c->limit[i]);
        if (r.high < 0.0) return SETTLED;
        if (r.low > 0.0) continue;
        held = held && c->limit[i].c[0] + c->limit[i].radius >= 0.0;
        if (kept < i) c->limit[kept] = c->limit[i];
        kept++;
    }
    c->limits = kept;
    const double middle = c->away.c[0], off = c->away.radius * (1.0 + 4.0 * MWC_U) + 4.0 * MWC_U * mwc_abs(middle);
    if (held && middle - off <= -h->slack && middle + off >= -h->reach) return OPEN; /* and of no cube about its middle */
    if (depth == DEEPEST_CUBE || ++h->cubes > MOST_CUBES) return OPEN;
    const int side = steepest(c);
    for (double end = -1.0; end <= 1.0; end += 2.0) {
        cube half = *c;
        mwc_cube_half(&half.away, side, end);
        for (int i = 0; i < half.limits; i++) mwc_cube_half(&half.limit[i], side, end);
        if (told(h, &half, depth + 1) == OPEN) return OPEN;
    }
    return SETTLED;
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

/* A polynomial at a place of the square, as one of u, and how far it is off: 128 roundings, with those of its value. */
typedef struct line {
    double c[MWC_DEGREE + 1], off;
} line;

static line line_at(const mwc_sheet *a, const double *at)
{
    line l = { { 0.0 }, (a->radius + 128.0 * MWC_U * mwc_sheet_part(a, 0)) * MWC_SHEET_SUMMED };
    for (int k = 0; k <= a->along; k++)
        for (int d = 0; d <= mwc_sheet_less(a->across, MWC_DEGREE - k); d++)
            for (int j = 0; j <= d; j++) {
                double term = a->c[mwc_cube_at(d - j, j, k)];
                for (int n = 0; n < d - j; n++) term *= at[0];
                for (int n = 0; n < j; n++) term *= at[1];
                l.c[k] += term;
            }
    return l;
}

static mw_ball line_value(const line *l, double u)
{
    double value = l->c[MWC_DEGREE];
    for (int k = MWC_DEGREE - 1; k >= 0; k--) value = value * u + l->c[k];
    return mwc_make(value, l->off);
}

/* Over all u. */
static mw_ball line_range(const line *l)
{
    double side = 0.0;
    for (int k = 1; k <= MWC_DEGREE; k++) side += mwc_abs(l->c[k]);
    return mwc_make(l->c[0], (side + l->off) * MWC_SHEET_SUMMED);
}

/* An overlap: place of the cube, how far apart there, and whether it is one at every u. */
typedef struct overlapping {
    double at[3];
    mw_ball apart;
    int found, throughout;
} overlapping;

/* Take an overlap at a place if it is deeper: at every u, probe < 0, or at one of some. */
static void try_overlap(const search *h, const line *away, const line *limits, int count, const double *at, int probe,
                        overlapping *o)
{
    const double u = probe < 0 ? 0.0 : (double)(2 * probe + 1 - PROBES) / (double)PROBES;
    const mw_ball apart = probe < 0 ? line_range(away) : line_value(away, u);
    if (!(apart.mid + apart.radius < -h->slack && apart.mid - apart.radius > -h->reach)) return;
    if (o->found && !(apart.mid + apart.radius < o->apart.mid + o->apart.radius)) return;
    for (int i = 0; i < count; i++) {
        const mw_ball limit = probe < 0 ? line_range(limits + i) : line_value(limits + i, u);
        if (!(limit.mid - limit.radius > 0.0)) return;
    }
    o->at[0] = at[0];
    o->at[1] = at[1];
    o->at[2] = u;
    o->apart = apart;
    o->found = 1;
    o->throughout = probe < 0;
}

/* Look for an overlap deeper than the slack at some places of a cube, at every u if there is one. */
static overlapping overlaps(const search *h, const cube *c)
{
    overlapping o = { .found = 0, .throughout = 0 };
    line limits[MOST_LIMITS];
    if (!c->all || !(mwc_cube_range(&c->away).low < -h->slack)) return o;
    for (int any = 0; any < 2 && !o.found; any++)
        for (int n = 0; n < PROBES * PROBES; n++) {
            const double at[2] = { (double)(2 * (n % PROBES) + 1 - PROBES) / (double)PROBES,
                                   (double)(2 * (n / PROBES) + 1 - PROBES) / (double)PROBES };
            const line away = line_at(&c->away, at);
            if (!(away.c[0] - line_range(&away).radius < -h->slack)) continue;
            for (int i = 0; i < c->limits; i++) limits[i] = line_at(&c->limit[i], at);
            for (int probe = any ? 0 : -1; probe < (any ? PROBES : 0); probe++)
                try_overlap(h, &away, limits, c->limits, at, probe, &o);
        }
    return o;
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
