/* Entries for casadi.external("<drive>_contact", library): (p, phi, start) -> x, the contact near start at complete
 * parameters p. A contact that is not found is an error of the call.  SPDX-License-Identifier: MIT-0 */
#include "meshwright.h"

typedef long long casadi_int;

static int contact(const char *drive, const double **arg, double **res, double *s)
{
    const mw_model *m = mw_find(drive);
    double x[MW_MAX_UNKNOWNS];
    mw_info info;
    if (!m || !arg[0] || !arg[2] || m->setup(arg[0], s)) return 1;
    m->set_phi(s, arg[1] ? arg[1][0] : 0.0);
    for (int j = 0; j < m->nx; j++) x[j] = arg[2][j];
    if (mw_refine(m, s, x, &info) < 0) return 1;
    for (int j = 0; res[0] && j < m->nx; j++) res[0][j] = x[j];
    return 0;
}

static const char *const inputs[] = { "p", "phi", "start" };

#define MW_CASADI(drive, np, ns, nx) \
    int drive##_contact(const double **arg, double **res, casadi_int *iw, double *w, int mem); \
    casadi_int drive##_contact_n_in(void); \
    casadi_int drive##_contact_n_out(void); \
    const char *drive##_contact_name_in(casadi_int i); \
    const char *drive##_contact_name_out(casadi_int i); \
    const casadi_int *drive##_contact_sparsity_in(casadi_int i); \
    const casadi_int *drive##_contact_sparsity_out(casadi_int i); \
    int drive##_contact_work(casadi_int *sz_arg, casadi_int *sz_res, casadi_int *sz_iw, casadi_int *sz_w); \
    int drive##_contact(const double **arg, double **res, casadi_int *iw, double *w, int mem) \
    { \
        (void)iw; \
        (void)mem; \
        return contact(#drive, arg, res, w); \
    } \
    casadi_int drive##_contact_n_in(void) { return 3; } \
    casadi_int drive##_contact_n_out(void) { return 1; } \
    const char *drive##_contact_name_in(casadi_int i) { return i >= 0 && i < 3 ? inputs[i] : NULL; } \
    const char *drive##_contact_name_out(casadi_int i) { return i == 0 ? "x" : NULL; } \
    const casadi_int *drive##_contact_sparsity_in(casadi_int i) \
    { \
        static const casadi_int dense[3][3] = { { np, 1, 1 }, { 1, 1, 1 }, { nx, 1, 1 } }; \
        return i >= 0 && i < 3 ? dense[i] : NULL; \
    } \
    const casadi_int *drive##_contact_sparsity_out(casadi_int i) \
    { \
        static const casadi_int dense[3] = { nx, 1, 1 }; \
        return i == 0 ? dense : NULL; \
    } \
    int drive##_contact_work(casadi_int *sz_arg, casadi_int *sz_res, casadi_int *sz_iw, casadi_int *sz_w) \
    { \
        *sz_arg = 3; \
        *sz_res = 1; \
        *sz_iw = 0; \
        *sz_w = ns; \
        return 0; \
    }

#include "casadi_models.h"
