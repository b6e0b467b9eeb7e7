/* Flanks over parts of them, in the frame of the search, and whether these lie inside their limits.
 * SPDX-License-Identifier: MIT-0 */
#ifndef MWC_FIRST_FLANKS_H
#define MWC_FIRST_FLANKS_H

#include "search.h"

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

#endif
