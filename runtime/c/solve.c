/* Words, and what is known of one point: the interface of meshwright.h to solver/.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "meshwright.h"
#include "solver/refine.h"

int mw_abi(void)
{
    return MW_MODEL_ABI;
}

const char *mw_status_word(int status)
{
    return mwi_status_word(status);
}

const char *mw_status_text(int status)
{
    return mwi_status_text(status);
}

const char *mw_flag(const mw_model *m, int bit)
{
    return mwi_flag(m, bit);
}

int mw_impossible(const char *flag)
{
    return mwi_impossible(flag);
}

int mw_refine(const mw_model *m, const double *s, double *x, mw_info *info)
{
    *info = mwi_ended(MW_BAD_INPUT, 0);
    return mwi_usable(m) ? mwi_refine(m, s, x, info) : MW_BAD_INPUT;
}

int mw_touch(const mw_model *m, const double *x, const double *o)
{
    return mwi_usable(m) ? mwi_touch(m, x, o) : MW_BAD_INPUT;
}

int mw_contact_at(const mw_model *m, const double *s, const double *x, double *o, mw_contact *c)
{
    if (!mwi_usable(m)) return MW_BAD_INPUT;
    const int kind = mwi_contact_at(m, s, x, o, c), touch = mwi_touch(m, x, o);
    return touch < 0 ? touch : kind;
}

int mw_observe(const mw_model *m, double *s, const double *phi, const double *x, size_t n, double *o)
{
    if (!mwi_usable(m)) return MW_BAD_INPUT;
    for (size_t k = 0; k < n; k++, x += m->nx, o += m->no) {
        int finite = mwi_angle_in_range(phi[k]);
        for (int i = 0; i < m->nx; i++) finite &= x[i] - x[i] == 0.0;
        for (int i = 0; i < m->no; i++) o[i] = NAN;
        if (!finite) continue;
        m->set_phi(s, phi[k]);
        m->observe(s, x, o);
    }
    return MW_CONVERGED;
}

void mw_flank(mw_surface flank, int parameters, int outputs, const double *s, const double *q, size_t n, double *o)
{
    for (size_t k = 0; k < n; k++, q += parameters, o += outputs) flank(s, q, o);
}
