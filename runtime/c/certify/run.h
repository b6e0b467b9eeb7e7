/* Runs a function's table of operations in one arithmetic.  SPDX-License-Identifier: MIT-0
 *
 * The including file defines MWC_RUN, the name of the function; MWC_NUMBER, the type of its numbers; MWC_DO(operation), the
 * name of an operation of that arithmetic; MWC_CONSTANT(c), a constant of the table in it; and, where numbers are too large to
 * be handed over by value, MWC_TO(operation, r, a, b), which puts a sum, difference or product of a and b into r, maybe one of
 * them; where signs may be chosen, MWC_CHOICE, the type of what chooses them, which is the last argument then and goes to the
 * sign's operation. These are undefined again. */
#ifndef MWC_TO
#define MWC_TO(operation, r, a, b) (*(r) = MWC_DO(operation)(*(a), *(b)))
#endif
#ifdef MWC_CHOICE
#define MWC_BY , MWC_CHOICE *choice
#define MWC_SIGN(a) MWC_DO(sign)(a, choice)
#else
#define MWC_BY
#define MWC_SIGN(a) MWC_DO(sign)(a)
#endif

/* Runs `count` operations of code with its arguments in a row; results stay in their registers. */
static void MWC_RUN(const mw_code *code, int count, const MWC_NUMBER *arguments, MWC_NUMBER *registers MWC_BY)
{
    MWC_NUMBER *constants = registers + code->inputs;
    const unsigned short *i = code->operation, *const end = i + 4 * count;
    for (int k = 0; k < code->inputs; k++) registers[k] = arguments[code->input[k]];
    for (int k = 0; k < code->constants; k++) constants[k] = MWC_CONSTANT(code->constant[k]);
    for (; i < end; i += 4) {
        MWC_NUMBER *const result = registers + i[1];
        const MWC_NUMBER *const a = registers + i[2], *const b = registers + i[3];
        switch (i[0]) {
        case MW_OP_ADD: MWC_TO(add, result, a, b); break;
        case MW_OP_SUB: MWC_TO(sub, result, a, b); break;
        case MW_OP_MUL: MWC_TO(mul, result, a, b); break;
        case MW_OP_SQR: *result = MWC_DO(sqr)(*a); break;
        case MW_OP_DIV: *result = MWC_DO(div)(*a, *b); break;
        case MW_OP_NEG: *result = MWC_DO(neg)(*a); break;
        case MW_OP_SQRT: *result = MWC_DO(sqrt)(*a); break;
        case MW_OP_SINCOS: MWC_DO(sincos)(*a, result, registers + i[3]); break;
        case MW_OP_ATAN2: *result = MWC_DO(atan2)(*a, *b); break;
        case MW_OP_MAGNITUDE: *result = MWC_DO(magnitude)(*a); break;
        default: *result = MWC_SIGN(*a); break;
        }
    }
}

#undef MWC_RUN
#undef MWC_BY
#undef MWC_SIGN
#undef MWC_CHOICE
#undef MWC_TO
#undef MWC_NUMBER
#undef MWC_DO
#undef MWC_CONSTANT
