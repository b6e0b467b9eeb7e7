/* What every part of the solver needs.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_BASICS_H
#define MWI_BASICS_H

#include "../mw_device.h"
#include "../mw_arithmetic.h"
#include "../mw_model.h"
#include "../mw_status.h"

/* A function of a drive: of its table or, on a device, which has none, of the only drive there. */
#ifndef MW_CALL
#define MW_CALL(m, function) (m)->function
#endif

MW_DEVICE static inline double mwi_abs(double a)
{
    return a < 0.0 ? -a : a;
}

MW_DEVICE static inline double mwi_larger(double a, double b)
{
    return a > b ? a : b;
}

/* Added and taken off again it rounds a number below 2^51 to an integer. */
static const double MWI_TO_INTEGER = 6755399441055744.0;

MW_DEVICE static inline void mwi_copy(double *to, const double *from, int n)
{
    for (int i = 0; i < n; i++) to[i] = from[i];
}

MW_DEVICE static inline void mwi_clear(double *a, int n)
{
    for (int i = 0; i < n; i++) a[i] = 0.0;
}

MW_DEVICE static inline int mwi_same_text(const char *a, const char *b)
{
    while (*a && *a == *b) a++, b++;
    return *a == *b;
}

/* The record of what ended like this before a first step. */
MW_DEVICE static inline mw_info mwi_ended(int status, int guard)
{
    mw_info info;
    info.status = status;
    info.iterations = 0;
    info.guard = guard;
    info.cold = 1;
    info.step = info.residual = info.rank_gap = info.pair = info.angle = 0.0;
    return info;
}

#ifndef MW_DEVICE_ONLY
static inline const char *mwi_status_word(int status)
{
    switch (status) {
#define MWI_STATUS_WORD(code, value, word, text) case value: return word;
        MW_STATUS_LIST(MWI_STATUS_WORD)
#undef MWI_STATUS_WORD
    default: return "unknown";
    }
}

static inline const char *mwi_status_text(int status)
{
    switch (status) {
#define MWI_STATUS_TEXT(code, value, word, text) case value: return text;
        MW_STATUS_LIST(MWI_STATUS_TEXT)
#undef MWI_STATUS_TEXT
    default: return "no such status";
    }
}

/* Whether there is a table, of this version, and no larger than the arrays of the solver. */
static inline int mwi_usable(const mw_model *m)
{
    if (m == NULL || m->abi != MW_MODEL_ABI) return 0;
    if (m->nx < 1 || m->nx > MW_MAX_UNKNOWNS || m->nstart < 0 || m->nstart > MW_MAX_UNKNOWNS) return 0;
    if (m->nanchor < 0 || m->nanchor > MW_MAX_ANCHOR) return 0;
    return m->no >= 0 && m->no <= MW_MAX_OBSERVATION && m->np >= 0 && m->np <= MW_MAX_PARAMETERS;
}

/* Whether an input angle is one to which a pair of teeth can be followed. */
static inline int mwi_angle_in_range(double phi)
{
    return mwi_abs(phi) <= (double)MW_MAX_TURN; /* not-a-number is not */
}

#endif

#endif
