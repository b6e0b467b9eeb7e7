/* Functions with kinks: continuous where a formula changes, their slopes not.  SPDX-License-Identifier: MIT-0
 *
 * Krawczyk's test holds for them too. A function that is continuous, and smooth but where signs of numbers change, has between
 * two points of a box a mean slope that is a mean of its derivatives on either side; each is that of one choice of signs. */
#ifndef MWC_KINKS_H
#define MWC_KINKS_H

#include "tables.h"

/* Numbers by the order in which they are computed: none of them, and more than one. */
enum { MWC_NOTHING = -1, MWC_SEVERAL = -2 };

/* What is known of a register: the number in it, that with whose sign it jumps, and one that it is a multiple of. */
typedef struct mwc_kink {
    int number, jumps, multiple;
} mwc_kink;

static inline int mwc_either(int one, int other)
{
    return one == MWC_NOTHING ? other : other == MWC_NOTHING || other == one ? one : MWC_SEVERAL;
}

/* Whether b, which does not jump, is zero where a jumps. */
static inline int mwc_bridged(mwc_kink a, mwc_kink b)
{
    return b.jumps == MWC_NOTHING && a.jumps != MWC_NOTHING && (a.jumps == b.number || a.jumps == b.multiple);
}

static inline mwc_kink mwc_kink_of(int operation, mwc_kink a, mwc_kink b, int number)
{
    mwc_kink k = { number, a.jumps, MWC_NOTHING };
    switch (operation) {
    case MW_OP_MUL:
        if (mwc_bridged(a, b)) k.jumps = MWC_NOTHING, k.multiple = a.jumps;
        else if (mwc_bridged(b, a)) k.jumps = MWC_NOTHING, k.multiple = b.jumps;
        else k.jumps = mwc_either(a.jumps, b.jumps), k.multiple = a.multiple != MWC_NOTHING ? a.multiple : b.multiple;
        break;
    case MW_OP_ADD: case MW_OP_SUB: case MW_OP_DIV: case MW_OP_ATAN2: k.jumps = mwc_either(a.jumps, b.jumps); break;
    case MW_OP_SQR: case MW_OP_NEG: k.multiple = a.multiple == MWC_NOTHING ? a.number : a.multiple; break;
    case MW_OP_SIGN: k.jumps = a.jumps == MWC_NOTHING ? a.number : MWC_SEVERAL; break;
    default: break;
    }
    return k;
}

/* Whether the leading results are continuous wherever a sign changes: what is made of the sign of a number is multiplied by
 * that number, which is zero there, or a multiple of it, before it becomes part of them. Else 0, which says nothing. */
static int mwc_continuous(const mw_code *code, int results)
{
    mwc_kink known[MWC_REGISTERS];
    const unsigned short *i = code->operation, *const end = i + 4 * code->first;
    int numbers = code->inputs + code->constants;
    for (int k = 0; k < numbers; k++) known[k].number = k, known[k].jumps = known[k].multiple = MWC_NOTHING;
    for (; i < end; i += 4) {
        const mwc_kink made = mwc_kink_of(i[0], known[i[2]], known[i[0] == MW_OP_SINCOS ? i[2] : i[3]], numbers++);
        known[i[1]] = made;
        if (i[0] == MW_OP_SINCOS) known[i[3]] = made, known[i[3]].number = numbers++;
    }
    for (int k = 0; k < results; k++)
        if (known[code->output[k]].jumps != MWC_NOTHING) return 0;
    return 1;
}

#endif
