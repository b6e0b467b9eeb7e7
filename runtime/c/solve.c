/* The solver of solver/ behind the interface of meshwright.h.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include "meshwright.h"
#include "solver/choice.h"

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

int mw_solve(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info)
{
    return mwi_solve(m, p, phi, s, work, x, info);
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

size_t mw_follow(const mw_model *m, double *s, double phi0, const double *x0, const double *phi, size_t n, double *x,
                 mw_info *info)
{
    mwi_history h = mwi_no_history();
    double o[MW_MAX_OBSERVATION];
    const int usable = mwi_usable(m) && mwi_angle_in_range(phi0);
    mwi_remember(&h, phi0, x0);
    for (size_t k = 0; k < n; k++, x += m->nx, info++) {
        *info = mwi_ended(MW_BAD_INPUT, 0);
        if (!usable || !mwi_angle_in_range(phi[k])) return k;
        if (phi[k] == h.phi[0]) {
            mwi_copy(x, h.x[0], m->nx);
            m->set_phi(s, phi[k]);
            m->observe(s, x, o);
            if ((info->status = mwi_touch(m, x, o)) < 0) return k;
            continue;
        }
        int there = mwi_leap(m, &h, phi[k], s, x, info);
        if (there) {
            m->observe(s, x, o);
            there = mwi_touch(m, x, o) >= 0;
        }
        if (!there && mwi_walk(m, &h, phi[k], s, x, info) < 0) return k;
        mwi_remember(&h, phi[k], x);
    }
    return n;
}

size_t mw_from_nodes(const mw_model *m, double *s, const double *phi0, const double *x0, const int *node,
                     const double *phi, size_t n, double *x, mw_info *info)
{
    const int nx = mwi_usable(m) ? m->nx : 0; /* nothing of a foreign table is believed */
    size_t succeeded = 0;
    for (size_t k = 0; k < n; k++, x += nx, info++) {
        const size_t from = node[k] < 0 ? 0 : (size_t)node[k];
        *info = mwi_ended(MW_BAD_INPUT, 0);
        if (nx > 0 && node[k] >= 0 && mw_follow(m, s, phi0[from], x0 + from * (size_t)nx, phi + k, 1, x, info) == 1)
            succeeded++;
        else
            for (int i = 0; i < nx; i++) x[i] = NAN;
    }
    return succeeded;
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

size_t mw_arclength(const mw_model *m, double *s, double phi0, const double *x0, double step, size_t count, double *phi,
                    double *x, double *slope, double *determinant)
{
    if (!mwi_usable(m) || !mwi_angle_in_range(phi0) || !(mwi_abs(step) < HUGE_VAL)) return 0;
    return mwi_arclength(m, s, phi0, x0, step, count, phi, x, slope, determinant);
}

void mw_flank(mw_surface flank, int parameters, int outputs, const double *s, const double *q, size_t n, double *o)
{
    for (size_t k = 0; k < n; k++, q += parameters, o += outputs) flank(s, q, o);
}
