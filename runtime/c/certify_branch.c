/* Certified folds and crossings of branches: Krawczyk's test on their extended system. See mw_certify.h.
 * SPDX-License-Identifier: MIT-0 */
#include <string.h>
#define MWC_BALLS
#define MWC_LARGEST 18
#include "certify/krawczyk.h"
#include "certify/lane.h"
#include "certify/tables.h"
#include "kernels.h"
#include "mw_certify.h"
#include "solver/linear.h"

enum { NX = MW_MAX_UNKNOWNS, NY = NX + 1, NZ = NY + NX + 1, NEWTON_STEPS = 4, NARROWING_STEPS = 4, POWER_STEPS = 20 };

static const double SHIFT = 1e-12; /* of the matrix whose least vector is sought */

/* The system of branch_point.c in z = (y, psi[, mu]): y unknowns in natural sizes and the input angle, psi a left null vector
 * of the residual's derivative A by its first `columns` variables, rows scaled to slopes of size 1:
 *     R(y) + mu psi = 0,   A(y)^T psi = 0,   (psi . psi - 1)/2 = 0.
 * scale and row are any numbers. columns = n: a fold. columns = n + 1, with mu: a crossing of the equations changed by mu psi. */
typedef struct extended {
    const mw_certified *tables;
    int n, columns, size;
    double scale[NY], row[NX];
    mw_ball arguments[MWC_ARGUMENTS];
} extended;

static mw_ball times(mw_ball a, double b)
{
    return mwc_mul(a, mwc_make(b, 0.0));
}

/* y as the drive's own variables, after the numbers of the state that follow from the angle. */
static void placed(extended *e, const mw_ball *y, mw_ball *x)
{
    const mw_certified *t = e->tables;
    mw_ball registers[MWC_REGISTERS];
    for (int i = 0; i <= e->n; i++) x[i] = times(y[i], e->scale[i]);
    e->arguments[t->slots] = x[e->n];
    mwc_run_ball(&t->instant, t->instant.instructions, e->arguments, registers);
    for (int i = t->design_slots; i < t->slots; i++) e->arguments[i] = registers[t->instant.output[i - t->design_slots]];
}

/* First and second derivatives of the scaled residual along v[n + 1]. */
static void along(extended *e, const mw_ball *x, const double *v, mw_ball *first, mw_ball *second)
{
    const mw_code *code = &e->tables->along;
    mw_ball registers[MWC_REGISTERS], *arguments = e->arguments + e->tables->slots;
    *arguments++ = x[e->n];
    for (int i = 0; i < e->n; i++) *arguments++ = x[i];
    for (int i = 0; i <= e->n; i++) *arguments++ = mwc_make(v[i] * e->scale[i], 0.0);
    mwc_run_ball(code, code->instructions, e->arguments, registers);
    for (int i = 0; i < e->n; i++) {
        first[i] = times(registers[code->output[i]], e->row[i]);
        second[i] = times(registers[code->output[e->n + i]], e->row[i]);
    }
}

/* Scaled residual R and derivative A at x. */
static void derivative(extended *e, const mw_ball *x, mw_ball *R, mw_ball A[NX][NY])
{
    const mw_code *code = &e->tables->equations;
    const int n = e->n;
    mw_ball registers[MWC_REGISTERS], by_angle[NX], bent[NX];
    double v[NY] = { 0.0 };
    memcpy(e->arguments + e->tables->slots, x, sizeof(mw_ball) * (size_t)n);
    mwc_run_ball(code, code->instructions, e->arguments, registers);
    for (int i = 0; i < n; i++) {
        R[i] = times(registers[code->output[i]], e->row[i]);
        for (int j = 0; j < n; j++) A[i][j] = times(times(registers[code->output[n + i * n + j]], e->scale[j]), e->row[i]);
    }
    v[n] = 1.0;
    along(e, x, v, by_angle, bent);
    for (int i = 0; i < n; i++) A[i][n] = by_angle[i];
}

/* Second derivative of psi . R along v. */
static mw_ball bent(extended *e, const mw_ball *x, const mw_ball *psi, const double *v)
{
    mw_ball first[NX], second[NX], sum = mwc_make(0.0, 0.0);
    along(e, x, v, first, second);
    for (int i = 0; i < e->n; i++) sum = mwc_add(sum, mwc_mul(psi[i], second[i]));
    return sum;
}

/* Second derivatives of psi . R by y: from those along the axes and along their sums. */
static void hessian(extended *e, const mw_ball *x, const mw_ball *psi, mw_ball H[NY][NY])
{
    const int w = e->n + 1;
    for (int j = 0; j < w; j++) {
        double v[NY] = { 0.0 };
        v[j] = 1.0;
        H[j][j] = bent(e, x, psi, v);
    }
    for (int j = 0; j < w; j++)
        for (int k = 0; k < j; k++) {
            double v[NY] = { 0.0 };
            v[j] = v[k] = 1.0;
            H[j][k] = H[k][j] = times(mwc_sub(mwc_sub(bent(e, x, psi, v), H[j][j]), H[k][k]), 0.5);
        }
}

/* The system's left side G and, unless NULL, its Jacobian D over z + [-d, d]; d = NULL: at z. */
static void evaluate(extended *e, const double *z, const double *d, mw_ball *G, mw_ball *D)
{
    const int n = e->n, w = n + 1, unfolded = e->columns == w, size = e->size, last = n + e->columns;
    mw_ball at[NZ], x[NY], R[NX], A[NX][NY], H[NY][NY], *const psi = at + w;
    for (int i = 0; i < size; i++) at[i] = mwc_make(z[i], d ? d[i] : 0.0);
    const mw_ball mu = unfolded ? at[size - 1] : mwc_make(0.0, 0.0);
    placed(e, at, x);
    derivative(e, x, R, A);
    for (int i = 0; i < n; i++) G[i] = mwc_add(R[i], mwc_mul(mu, psi[i]));
    for (int k = 0; k < e->columns; k++) {
        G[n + k] = mwc_make(0.0, 0.0);
        for (int i = 0; i < n; i++) G[n + k] = mwc_add(G[n + k], mwc_mul(A[i][k], psi[i]));
    }
    G[last] = mwc_make(-0.5, 0.0);
    for (int i = 0; i < n; i++) G[last] = mwc_add(G[last], times(mwc_sqr(psi[i]), 0.5));
    if (!D) return;
    hessian(e, x, psi, H);
    for (int i = 0; i < size * size; i++) D[i] = mwc_make(0.0, 0.0);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < w; j++) D[i * size + j] = A[i][j];
        D[i * size + w + i] = mu;
        if (unfolded) D[i * size + w + n] = psi[i];
        D[last * size + w + i] = psi[i];
    }
    for (int k = 0; k < e->columns; k++) {
        for (int j = 0; j < w; j++) D[(n + k) * size + j] = H[k][j];
        for (int i = 0; i < n; i++) D[(n + k) * size + w + i] = A[i][k];
    }
}

/* Rows of the residual by their largest slope, and the left vector that A's columns see least, by inverse iteration on A A^T. */
static void prepare(extended *e, const double *y, double *psi)
{
    const int n = e->n;
    mw_ball at[NY], x[NY], R[NX], A[NX][NY];
    for (int i = 0; i <= n; i++) at[i] = mwc_make(y[i], 0.0);
    for (int i = 0; i < n; i++) e->row[i] = 1.0;
    placed(e, at, x);
    derivative(e, x, R, A);
    for (int i = 0; i < n; i++) {
        double largest = 0.0;
        for (int j = 0; j <= n; j++) largest = mwc_abs(A[i][j].mid) > largest ? mwc_abs(A[i][j].mid) : largest;
        e->row[i] = largest > 0.0 ? 1.0 / largest : 1.0;
        psi[i] = 1.0 / (1.0 + i);
    }
    for (int step = 0; step < POWER_STEPS; step++) {
        double B[NX * NX], length = 0.0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                B[i * n + j] = i == j ? SHIFT : 0.0;
                for (int k = 0; k < e->columns; k++) B[i * n + j] += A[i][k].mid * e->row[i] * (A[j][k].mid * e->row[j]);
            }
        mwi_bordered_solve(n, B, psi);
        for (int i = 0; i < n; i++) length += psi[i] * psi[i];
        for (int i = 0; i < n; i++) psi[i] /= sqrt(length);
    }
}

/* Refine z, then prove it: within[], the solution's distance, box[], where it is the only one. Returns a reason. */
static int proved(extended *e, double *z, double *within, double *box)
{
    const int size = e->size;
    double C[NZ * NZ], M[NZ * NZ], K[NZ];
    mw_ball G[NZ], D[NZ * NZ], shift[NZ];
    for (int step = 0; step < NEWTON_STEPS; step++) {
        evaluate(e, z, NULL, G, D);
        if (!mwc_inverse(size, D, C)) return MW_REASON_FOLD;
        mwc_shift(size, C, G, shift);
        for (int i = 0; i < size; i++) z[i] -= shift[i].mid;
    }
    evaluate(e, z, NULL, G, NULL);
    mwc_shift(size, C, G, shift);
    for (int i = 0; i < size; i++) box[i] = MWC_FIRST_BOX;
    for (int step = 0; step < MWC_SHAPING_STEPS; step++) {
        evaluate(e, z, box, G, D);
        mwc_defect(size, C, D, M);
        mwc_image(size, shift, M, box, K);
        if (mwc_inside(size, K, box)) {
            memcpy(within, K, sizeof K);
            for (int again = 0; again < NARROWING_STEPS; again++) {
                mwc_image(size, shift, M, within, K);
                memcpy(within, K, sizeof K);
            }
            return MW_REASON_NONE;
        }
        for (int i = 0; i < size; i++) {
            box[i] = MWC_SHAPED(mwc_abs(shift[i].mid) + shift[i].radius, K[i]);
            if (!(box[i] <= MWC_WIDEST_BOX)) return MW_REASON_WIDE;
        }
    }
    return MW_REASON_WIDE;
}

static int ended(mw_branch_certificate *c, int reason)
{
    c->reason = reason;
    return c->outcome = reason == MW_REASON_NONE ? MW_UNIQUE : MW_UNKNOWN;
}

int mw_certify_branch(const mw_model *m, const mw_wide *s, int crossing, double angle, const double *x, mw_branch_certificate *c)
{
    double state[MWC_ARGUMENTS], z[NZ] = { 0.0 }, within[NZ] = { 0.0 }, box[NZ] = { 0.0 };
    extended e;
    memset(c, 0, sizeof *c);
    c->angle = c->unfolding = mwc_make(NAN, NAN);
    for (int i = 0; i < NX; i++) c->x[i] = mwc_make(NAN, NAN);
    if (!mw_encloses(m)) return ended(c, MW_REASON_ARITHMETIC);
    e.tables = m->kernels->certified();
    e.n = m->nx;
    e.columns = m->nx + (crossing != 0);
    e.size = m->nx + 1 + e.columns;
    if (e.tables->along.registers > MWC_REGISTERS || e.tables->slots + 2 * m->nx + 2 > MWC_ARGUMENTS) return ended(c, MW_REASON_DESIGN);
    for (int i = 0; i < e.tables->slots; i++) e.arguments[i] = mwc_of_wide(s[i]);
    for (int i = 0; i < e.tables->equations.inputs; i++) {
        const int at = e.tables->equations.input[i];
        if (at < e.tables->design_slots && !(e.arguments[at].radius < HUGE_VAL && e.arguments[at].mid == e.arguments[at].mid))
            return ended(c, MW_REASON_DESIGN);
    }
    for (int i = 0; i <= m->nx; i++) e.scale[i] = 1.0;
    mw_ball at[NY];
    for (int i = 0; i < m->nx; i++) at[i] = mwc_make(x[i], 0.0);
    at[m->nx] = mwc_make(angle, 0.0);
    mw_ball own[NY];
    placed(&e, at, own);
    for (int i = 0; i < MWC_ARGUMENTS; i++) state[i] = i < e.tables->slots ? e.arguments[i].mid : NAN;
    m->scale(state, e.scale);
    for (int i = 0; i < m->nx; i++) z[i] = x[i] / e.scale[i];
    z[m->nx] = angle;
    prepare(&e, z, z + m->nx + 1);
    const int reason = proved(&e, z, within, box);
    if (reason != MW_REASON_NONE) return ended(c, reason);
    for (int i = 0; i < m->nx; i++) {
        const mw_ball whole = times(mwc_make(z[i], box[i]), e.scale[i]);
        if (!(whole.mid - mwc_reach(whole) >= m->unknowns[i].lower && whole.mid + mwc_reach(whole) <= m->unknowns[i].upper))
            return ended(c, MW_REASON_OUTSIDE);
        c->x[i] = times(mwc_make(z[i], within[i]), e.scale[i]);
        c->x[i].radius = mwc_reach(c->x[i]);
    }
    c->angle = mwc_make(z[m->nx], within[m->nx]);
    c->unfolding = crossing ? mwc_make(z[e.size - 1], within[e.size - 1]) : mwc_make(0.0, 0.0);
    c->box = box[m->nx];
    return ended(c, MW_REASON_NONE);
}
