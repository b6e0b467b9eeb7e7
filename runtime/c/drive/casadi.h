/* Entries of the drive MW_DRIVE for casadi.external(name, object), with derivatives.  SPDX-License-Identifier: MIT-0
 *
 * <drive>_complete: given -> p, the parameters of a design (NaN: open) completed by rules and design systems.
 * <drive>_contact: (p, phi, start) -> x, status, flags: the contact of mw_solve at complete parameters p, by Newton's method
 * from start, and what is known of it. flags: 1 or 0 for each name of mw_flag, then for other_branch: where start leads to
 * another solution of the equations, of the next tooth or beyond a fold, or the pair has no contact at phi. x is not a number
 * where status is negative, a flag marks what bodies cannot make (mw_impossible), or other_branch is set; so is dx then.
 * A design that cannot be completed is an error of the call. */
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

static int flags_of(const mw_model *m)
{
    return 2 + m->bodies[0].margins + m->bodies[1].margins;
}

/* Whether x is the contact own[nx]: in its transmission error alone where the point is not determined, as along a line. */
static int same_contact(const mw_model *m, const double *s, const mw_info *info, const double *x, const double *own)
{
    double at[MW_MAX_UNKNOWNS];
    memcpy(at, info->status == MW_CONVERGED ? x : own, sizeof(double) * (size_t)m->nx);
    at[m->error] = x[m->error];
    return mwi_near(m, s, at, own, MWI_NO_FURTHER);
}

/* work w[ns + np] */
static int contact(const mw_model *m, const double **arg, double **res, double *w)
{
    double own[MW_MAX_UNKNOWNS], x[MW_MAX_UNKNOWNS], o[MW_MAX_OBSERVATION];
    int possible = 0, other = 0;
    mw_contact c;
    mw_info info;
    if (!arg[0] || !arg[2]) return 1;
    c.flags = 0;
    memcpy(x, arg[2], sizeof(double) * (size_t)m->nx);
    int status = mw_solve(m, arg[0], arg[1] ? arg[1][0] : 0.0, w, w + m->ns, own, &info);
    if (status != MW_BAD_INPUT && mw_refine(m, w, x, &info) >= 0) {
        mwi_contact_at(m, w, x, o, &c);
        possible = mwi_worth_in(m, &c) != MWI_IMPOSSIBLE;
        other = status < 0 || !same_contact(m, w, &info, x, own);
    }
    if (status >= 0) status = info.status;
    for (int i = 0; res[0] && i < m->nx; i++) res[0][i] = possible && !other ? x[i] : NAN;
    if (res[1]) res[1][0] = status;
    for (int bit = 0; res[2] && bit < flags_of(m); bit++) res[2][bit] = c.flags >> bit & 1u;
    if (res[2]) res[2][flags_of(m)] = other;
    return 0;
}

/* (p, phi, start, x) -> dx/dp, dx/dphi, not numbers where x is none; the start has no influence. Work w[ns]. */
static int contact_jacobian(const mw_model *m, const double **arg, double **res, double *w)
{
    const double *p = arg[0], *x = arg[3], phi = arg[1] ? arg[1][0] : 0.0;
    double dp[MW_MAX_PARAMETERS] = { 0.0 }, point[3];
    if (!p || !x || m->np > MW_MAX_PARAMETERS) return 1;
    if (x[0] != x[0]) {
        for (int k = 0; res[0] && k < m->np * m->nx; k++) res[0][k] = NAN;
        for (int k = 0; res[1] && k < m->nx; k++) res[1][k] = NAN;
        return 0;
    }
    if (m->setup(p, w)) return 1;
    m->set_phi(w, phi);
    for (int k = 0; res[0] && k < m->np; k++) {
        dp[k] = 1.0;
        if (mw_contact_tangent(m, p, dp, phi, 0.0, w, x, res[0] + k * m->nx, point) < 0) return 1;
        dp[k] = 0.0;
    }
    return res[1] && mw_contact_tangent(m, p, dp, phi, 1.0, w, x, res[1], point) < 0;
}

static const char *const complete_in[] = { "given", "p" }, *const complete_out[] = { "p", "jac_p_given" };
static const char *const contact_in[] = { "p", "phi", "start", "x", "status", "flags" };
static const char *const contact_out[] = { "x", "status", "flags" };
static const char *const contact_slopes[] = {
    "jac_x_p", "jac_x_phi", "jac_x_start", "jac_status_p", "jac_status_phi", "jac_status_start", "jac_flags_p",
    "jac_flags_phi", "jac_flags_start"
};

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
#define MW_CASADI(drive, np, ns, nx, nflags) \
    static const casadi_int drive##_one[] = { 1, 1, 1 }, drive##_p[] = { np, 1, 1 }, drive##_x[] = { nx, 1, 1 }; \
    static const casadi_int drive##_flags_set[] = { nflags, 1, 1 }, drive##_p_by_p[] = { np, np, 1 }; \
    static const casadi_int drive##_x_by_p[] = { nx, np, 1 }, drive##_x_by_start[nx + 3] = { nx, nx }; \
    static const casadi_int drive##_one_by_p[np + 3] = { 1, np }, drive##_one_by_one[] = { 1, 1, 0, 0 }; \
    static const casadi_int drive##_one_by_start[nx + 3] = { 1, nx }, drive##_flags_by_p[np + 3] = { nflags, np }; \
    static const casadi_int drive##_flags_by_one[] = { nflags, 1, 0, 0 }, drive##_flags_by_start[nx + 3] = { nflags, nx }; \
    static const casadi_int *const drive##_complete_in[] = { drive##_p }; \
    static const casadi_int *const drive##_complete_out[] = { drive##_p }; \
    static const casadi_int *const jac_##drive##_complete_in[] = { drive##_p, drive##_p }; \
    static const casadi_int *const jac_##drive##_complete_out[] = { drive##_p_by_p }; \
    static const casadi_int *const drive##_contact_in[] = { drive##_p, drive##_one, drive##_x }; \
    static const casadi_int *const drive##_contact_out[] = { drive##_x, drive##_one, drive##_flags_set }; \
    static const casadi_int *const jac_##drive##_contact_in[] = { \
        drive##_p, drive##_one, drive##_x, drive##_x, drive##_one, drive##_flags_set \
    }; \
    static const casadi_int *const jac_##drive##_contact_out[] = { \
        drive##_x_by_p, drive##_x, drive##_x_by_start, drive##_one_by_p, drive##_one_by_one, drive##_one_by_start, \
        drive##_flags_by_p, drive##_flags_by_one, drive##_flags_by_start \
    }; \
    MW_ENTRY(drive##_complete, drive, complete, complete_in, complete_out, np + 1) \
    MW_ENTRY(jac_##drive##_complete, drive, complete_jacobian, complete_in, (complete_out + 1), 0) \
    MW_ENTRY(drive##_contact, drive, contact, contact_in, contact_out, ns + np) \
    MW_ENTRY(jac_##drive##_contact, drive, contact_jacobian, contact_in, contact_slopes, ns)

#define MW_CASADI_OF(drive) MW_CASADI(drive, drive##_NP, drive##_NS, drive##_NX, (drive##_NFLAGS + 1))
#define MW_CASADI_HERE(drive) MW_CASADI_OF(drive)
MW_CASADI_HERE(MW_DRIVE)
