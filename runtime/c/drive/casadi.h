/* Entries of the drive MW_DRIVE for casadi.external(name, object), with derivatives.  SPDX-License-Identifier: MIT-0
 *
 * <drive>_complete: given -> p, the parameters of a design (NaN: open) completed by rules and design systems.
 * <drive>_contact: (p, phi, start) -> x, the contact near start at complete parameters p.
 * A design that cannot be completed and a contact that is not found are errors of the call. */
#include <string.h>
#include "meshwright.h"

typedef long long casadi_int;

/* work w[np + 1] */
static int complete(const mw_model *m, const double **arg, double **res, double *w)
{
    mw_info info;
    double p[MW_MAX_PARAMETERS];
    if (!arg[0] || m->np > MW_MAX_PARAMETERS) return 1;
    memcpy(p, arg[0], sizeof(double) * (size_t)m->np);
    if (mw_complete(m, p, w, &info)) return 1;
    if (res[0]) memcpy(res[0], p, sizeof(double) * (size_t)m->np);
    return 0;
}

/* (given, p) -> dp/d(given); the columns of open parameters are 0 */
static int complete_jacobian(const mw_model *m, const double **arg, double **res, double *w)
{
    (void)w;
    const double *given = arg[0], *p = arg[1];
    if (!given || !p) return 1;
    if (!res[0]) return 0;
    memset(res[0], 0, sizeof(double) * (size_t)(m->np * m->np));
    for (int k = 0; k < m->np; k++) {
        double *column = res[0] + k * m->np;
        if (given[k] != given[k]) continue;
        column[k] = 1.0;
        if (mw_complete_tangent(m, given, p, column) < 0) return 1;
    }
    return 0;
}

/* work w[ns] */
static int contact(const mw_model *m, const double **arg, double **res, double *w)
{
    double x[MW_MAX_UNKNOWNS];
    mw_info info;
    if (!arg[0] || !arg[2] || m->setup(arg[0], w)) return 1;
    m->set_phi(w, arg[1] ? arg[1][0] : 0.0);
    memcpy(x, arg[2], sizeof(double) * (size_t)m->nx);
    if (mw_refine(m, w, x, &info) < 0) return 1;
    if (res[0]) memcpy(res[0], x, sizeof(double) * (size_t)m->nx);
    return 0;
}

/* (p, phi, start, x) -> dx/dp, dx/dphi; the start has no influence. Work w[ns]. */
static int contact_jacobian(const mw_model *m, const double **arg, double **res, double *w)
{
    const double *p = arg[0], *x = arg[3], phi = arg[1] ? arg[1][0] : 0.0;
    double dp[MW_MAX_PARAMETERS] = { 0.0 }, point[3];
    if (!p || !x || m->np > MW_MAX_PARAMETERS || m->setup(p, w)) return 1;
    m->set_phi(w, phi);
    for (int k = 0; res[0] && k < m->np; k++) {
        dp[k] = 1.0;
        if (mw_contact_tangent(m, p, dp, phi, 0.0, w, x, res[0] + k * m->nx, point) < 0) return 1;
        dp[k] = 0.0;
    }
    return res[1] && mw_contact_tangent(m, p, dp, phi, 1.0, w, x, res[1], point) < 0;
}

static const char *const complete_in[] = { "given", "p" }, *const complete_out[] = { "p", "jac_p_given" };
static const char *const contact_in[] = { "p", "phi", "start", "x" };
static const char *const contact_out[] = { "x" };
static const char *const contact_slopes[] = { "jac_x_p", "jac_x_phi", "jac_x_start" };

/* One external function: name##_in and name##_out are its sparsity patterns, ins and outs the names of both. */
#define MW_ENTRY(name, drive, call, ins, outs, work) \
    int name(const double **arg, double **res, casadi_int *iw, double *w, int mem); \
    casadi_int name##_n_in(void); \
    casadi_int name##_n_out(void); \
    const char *name##_name_in(casadi_int i); \
    const char *name##_name_out(casadi_int i); \
    const casadi_int *name##_sparsity_in(casadi_int i); \
    const casadi_int *name##_sparsity_out(casadi_int i); \
    int name##_work(casadi_int *sz_arg, casadi_int *sz_res, casadi_int *sz_iw, casadi_int *sz_w); \
    enum { name##_ins = sizeof name##_in / sizeof name##_in[0], name##_outs = sizeof name##_out / sizeof name##_out[0] }; \
    int name(const double **arg, double **res, casadi_int *iw, double *w, int mem) \
    { \
        (void)iw; \
        (void)mem; \
        return call(&drive##_model, arg, res, w); \
    } \
    casadi_int name##_n_in(void) { return name##_ins; } \
    casadi_int name##_n_out(void) { return name##_outs; } \
    const char *name##_name_in(casadi_int i) { return i >= 0 && i < name##_ins ? ins[i] : NULL; } \
    const char *name##_name_out(casadi_int i) { return i >= 0 && i < name##_outs ? outs[i] : NULL; } \
    const casadi_int *name##_sparsity_in(casadi_int i) { return i >= 0 && i < name##_ins ? name##_in[i] : NULL; } \
    const casadi_int *name##_sparsity_out(casadi_int i) { return i >= 0 && i < name##_outs ? name##_out[i] : NULL; } \
    int name##_work(casadi_int *sz_arg, casadi_int *sz_res, casadi_int *sz_iw, casadi_int *sz_w) \
    { \
        *sz_arg = name##_ins; \
        *sz_res = name##_outs; \
        *sz_iw = 0; \
        *sz_w = work; \
        return 0; \
    }

/* Patterns are { rows, columns, 1 } where dense, else { rows, columns, begin of each column, ... }: all 0 is empty. */
#define MW_CASADI(drive, np, ns, nx) \
    static const casadi_int drive##_angle[] = { 1, 1, 1 }, drive##_p[] = { np, 1, 1 }, drive##_x[] = { nx, 1, 1 }; \
    static const casadi_int drive##_p_by_p[] = { np, np, 1 }, drive##_x_by_p[] = { nx, np, 1 }; \
    static const casadi_int drive##_x_by_start[nx + 3] = { nx, nx }; \
    static const casadi_int *const drive##_complete_in[] = { drive##_p }; \
    static const casadi_int *const drive##_complete_out[] = { drive##_p }; \
    static const casadi_int *const jac_##drive##_complete_in[] = { drive##_p, drive##_p }; \
    static const casadi_int *const jac_##drive##_complete_out[] = { drive##_p_by_p }; \
    static const casadi_int *const drive##_contact_in[] = { drive##_p, drive##_angle, drive##_x }; \
    static const casadi_int *const drive##_contact_out[] = { drive##_x }; \
    static const casadi_int *const jac_##drive##_contact_in[] = { drive##_p, drive##_angle, drive##_x, drive##_x }; \
    static const casadi_int *const jac_##drive##_contact_out[] = { drive##_x_by_p, drive##_x, drive##_x_by_start }; \
    MW_ENTRY(drive##_complete, drive, complete, complete_in, complete_out, np + 1) \
    MW_ENTRY(jac_##drive##_complete, drive, complete_jacobian, complete_in, (complete_out + 1), 0) \
    MW_ENTRY(drive##_contact, drive, contact, contact_in, contact_out, ns) \
    MW_ENTRY(jac_##drive##_contact, drive, contact_jacobian, contact_in, contact_slopes, ns)

#define MW_CASADI_OF(drive) MW_CASADI(drive, drive##_NP, drive##_NS, drive##_NX)
#define MW_CASADI_HERE(drive) MW_CASADI_OF(drive)
MW_CASADI_HERE(MW_DRIVE)
