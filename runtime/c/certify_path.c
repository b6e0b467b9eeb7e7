/* Certified paths: Krawczyk's test for every angle of a piece at once. See mw_certify.h.  SPDX-License-Identifier: MIT-0 */
#include <string.h>
#define MWC_PATHS
#include "certify/kinks.h"
#include "certify/krawczyk.h"
#include "certify/tables.h"
#include "kernels.h"

/* What a first box has beyond twice the shift, mm and rad: room for the neighbouring piece at a joint. */
static const double ROOM = 1e-8;

enum { NODES = MWC_ORDER + 1, SHAPING = 6, NARROWING = 4, MOST_SIDES = 3 };

/* What a test on a piece works on: numbers that functions read, registers, polynomials of the inverse Jacobian, and which
 * sides are taken of kinks of the flanks. */
typedef struct work {
    int n;
    const mw_certified *tables;
    mw_polynomial arguments[MWC_ARGUMENTS], registers[MWC_REGISTERS];
    mw_polynomial C[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS];
    mwc_sides sides;
    int kinks;
} work;

/* Cosines of the odd multiples of pi/18, ascending. */
void mw_piece_nodes(double *t)
{
    for (int k = 0; k < NODES; k++) {
        mw_ball sine, cosine;
        mwc_sincos(mwc_make(3.141592653589793 * (2.0 * (double)(NODES - 1 - k) + 1.0) / (2.0 * (double)NODES), 0.0), &sine, &cosine);
        t[k] = cosine.mid;
    }
}

/* The polynomial through values at the nodes: Newton's differences, then powers. Any polynomial will do. */
static mw_polynomial through(const double *t, const double *values)
{
    mw_polynomial p = { { 0.0 }, 0.0 };
    double d[NODES];
    memcpy(d, values, sizeof d);
    for (int j = 1; j < NODES; j++)
        for (int k = NODES - 1; k >= j; k--) d[k] = (d[k] - d[k - 1]) / (t[k] - t[k - j]);
    p.c[0] = d[NODES - 1];
    for (int j = NODES - 2; j >= 0; j--) {
        for (int k = NODES - 1; k >= 1; k--) p.c[k] = p.c[k - 1] - t[j] * p.c[k];
        p.c[0] = d[j] - t[j] * p.c[0];
    }
    return p;
}

/* Where nothing may jump. */
static const mwc_sides NO_SIDES = { 0, 0, 0, 0U };

static void run(work *w, const mw_code *code, int count)
{
    w->sides.met = 0;
    mwc_run_polynomial(code, count, w->arguments, w->registers, &w->sides);
    if (w->sides.met > w->kinks) w->kinks = w->sides.met;
}

/* The state along the piece: numbers of the design stay, those of the angle become polynomials. */
static void set_state(work *w, const mw_wide *s, const mw_piece *piece)
{
    const mw_certified *t = w->tables;
    mw_polynomial *phi = w->arguments + t->slots;
    for (int i = 0; i < t->design_slots; i++) w->arguments[i] = mwc_poly_of_wide(s[i]);
    memset(phi, 0, sizeof *phi);
    phi->c[0] = piece->centre;
    phi->c[1] = piece->half;
    run(w, &t->instant, t->instant.instructions);
    for (int i = t->design_slots; i < t->slots; i++) w->arguments[i] = w->registers[t->instant.output[i - t->design_slots]];
}

static void set_unknowns(work *w, const mw_polynomial *x, const double *d)
{
    for (int i = 0; i < w->n; i++) {
        mw_polynomial *of = w->arguments + w->tables->slots + i;
        *of = x[i];
        of->radius = d ? d[i] : 0.0;
    }
}

/* The larger, or whichever is none. */
static double larger(double a, double b)
{
    return a >= b || a != a ? a : b;
}

/* Polynomials through the inverses at the nodes, of the mean over both sides of kinks; 0 where one is singular in double. */
static int fit_inverse(work *w, const double *t, const mw_polynomial *x)
{
    const mw_code *code = &w->tables->equations;
    const int n = w->n, size = n * n;
    double found[NODES][MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], values[NODES], sides = 0.0;
    mw_polynomial J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS];
    set_unknowns(w, x, NULL);
    do {
        run(w, code, code->instructions);
        for (int i = 0; i < size; i++) {
            const mw_polynomial side = w->registers[code->output[n + i]];
            J[i] = sides > 0.0 ? mwc_poly_add(J[i], side) : side;
        }
        sides += 1.0;
    } while (mwc_other_sides(&w->sides));
    for (int k = 0; k < NODES; k++) {
        mw_ball at[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS];
        for (int i = 0; i < size; i++) at[i] = mwc_poly_at(&J[i], mwc_make(t[k], 0.0));
        if (!mwc_inverse(n, at, found[k])) return 0;
    }
    for (int i = 0; i < size; i++) {
        for (int k = 0; k < NODES; k++) values[k] = sides * found[k][i];
        w->C[i] = through(t, values);
    }
    return 1;
}

/* |C R| along the piece, as balls about 0. */
static void shifts(work *w, mw_ball *z)
{
    const mw_code *code = &w->tables->equations;
    for (int i = 0; i < w->n; i++) z[i] = mwc_make(0.0, 0.0);
    do {
        run(w, code, code->first);
        for (int i = 0; i < w->n; i++) {
            mw_polynomial sum = mwc_poly_of_ball(mwc_make(0.0, 0.0));
            for (int k = 0; k < w->n; k++)
                sum = mwc_poly_add(sum, mwc_poly_mul(w->C[i * w->n + k], w->registers[code->output[k]]));
            z[i].radius = larger(z[i].radius, mwc_poly_most(&sum));
        }
    } while (mwc_other_sides(&w->sides));
}

/* |I - C J| over the piece and the box. */
static void defects(work *w, double *M)
{
    const mw_code *code = &w->tables->equations;
    const int n = w->n;
    for (int i = 0; i < n * n; i++) M[i] = 0.0;
    do {
        run(w, code, code->instructions);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                mw_polynomial sum = mwc_poly_of_ball(mwc_make(i == j ? 1.0 : 0.0, 0.0));
                for (int k = 0; k < n; k++)
                    sum = mwc_poly_sub(sum, mwc_poly_mul(w->C[i * n + k], w->registers[code->output[n + k * n + j]]));
                M[i * n + j] = larger(M[i * n + j], mwc_poly_most(&sum));
            }
    } while (mwc_other_sides(&w->sides));
}

static void observe_margins(const mw_model *m, work *w, const double *within, mw_piece *piece)
{
    const mw_code *code = &w->tables->observed;
    const int most = (int)(sizeof piece->margin / sizeof piece->margin[0]);
    int sides = 0;
    set_unknowns(w, piece->x, within);
    piece->margins = 2 + m->bodies[0].margins + m->bodies[1].margins;
    if (piece->margins > most) piece->margins = most;
    do {
        run(w, code, code->instructions);
        for (int i = 0; i < piece->margins; i++) {
            const mw_polynomial side = w->registers[code->output[15 + i]];
            piece->margin[i] = sides ? mwc_poly_hull(piece->margin[i], side) : side;
        }
        sides++;
    } while (mwc_other_sides(&w->sides));
}

static int reason_of(const mw_model *m, work *w, const mw_wide *s, const double *x, mw_piece *piece)
{
    const int n = m->nx;
    double t[NODES], values[NODES], M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], K[MW_MAX_UNKNOWNS], within[MW_MAX_UNKNOWNS];
    mw_ball z[MW_MAX_UNKNOWNS];
    double *d = piece->box;
    mw_piece_nodes(t);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < NODES; k++) values[k] = x[k * n + i];
        piece->x[i] = through(t, values);
    }
    w->sides = NO_SIDES;
    w->kinks = 0;
    set_state(w, s, piece);
    if (mwc_continuous(&w->tables->equations, n)) w->sides.most = MOST_SIDES;
    if (!fit_inverse(w, t, piece->x)) return MW_REASON_FOLD;
    set_unknowns(w, piece->x, NULL);
    shifts(w, z);
    for (int i = 0; i < n; i++) d[i] = 2.0 * z[i].radius + ROOM;
    for (int step = 0; step < SHAPING; step++) {
        set_unknowns(w, piece->x, d);
        defects(w, M);
        mwc_image(n, z, M, d, K);
        if (mwc_inside(n, K, d)) break;
        for (int i = 0; i < n; i++) d[i] = 2.0 * z[i].radius + (step == 0 ? 0.0 : 1.1 * (K[i] - z[i].radius));
    }
    if (!mwc_inside(n, K, d)) return MW_REASON_WIDE;
    memcpy(within, K, sizeof within);
    for (int step = 0; step < NARROWING; step++) {
        mwc_image(n, z, M, within, K);
        for (int i = 0; i < n; i++)
            if (K[i] < within[i]) within[i] = K[i];
    }
    for (int i = 0; i < n; i++) {
        const double side = mwc_poly_part(&piece->x[i], 1) + d[i];
        if (!(piece->x[i].c[0] - side >= m->unknowns[i].lower && piece->x[i].c[0] + side <= m->unknowns[i].upper))
            return MW_REASON_OUTSIDE;
    }
    observe_margins(m, w, within, piece);
    for (int i = 0; i < n; i++) piece->x[i].radius = within[i];
    return MW_REASON_NONE;
}

static int possible(const mw_certified *t, int nx)
{
    const mw_code *codes[] = { &t->instant, &t->equations, &t->observed };
    for (int i = 0; i < 3; i++)
        if (codes[i]->registers > MWC_REGISTERS) return 0;
    return t->slots + nx + 1 <= MWC_ARGUMENTS;
}

int mw_certify_piece(const mw_model *m, const mw_wide *s, double from, double to, const double *x, mw_piece *piece)
{
    work w;
    memset(piece, 0, sizeof *piece);
    piece->centre = 0.5 * from + 0.5 * to;
    piece->half = (0.5 * to - 0.5 * from) * (1.0 + 8.0 * MWC_U) + 4.0 * MWC_U * (mwc_abs(from) + mwc_abs(to));
    piece->reason = MW_REASON_ARITHMETIC;
    if (!mw_encloses(m)) return piece->outcome = MW_UNKNOWN;
    w.n = m->nx;
    w.tables = m->kernels->certified();
    piece->reason = MW_REASON_DESIGN;
    if (!possible(w.tables, m->nx)) return piece->outcome = MW_UNKNOWN;
    piece->reason = reason_of(m, &w, s, x, piece);
    piece->kinks = w.kinks;
    return piece->outcome = piece->reason == MW_REASON_NONE ? MW_UNIQUE : MW_UNKNOWN;
}

/* The share t of an angle. */
static mw_ball share(const mw_piece *piece, double angle)
{
    return mwc_div(mwc_sub(mwc_make(angle, 0.0), mwc_make(piece->centre, 0.0)), mwc_make(piece->half, 0.0));
}

mw_ball mw_piece_at(const mw_piece *piece, const mw_polynomial *of, double angle)
{
    return mwc_poly_at(of, share(piece, angle));
}

/* Whether the solution of one lies where that of the other is the only one. */
static int held(const mw_model *m, const mw_piece *one, const mw_piece *other, double angle)
{
    for (int i = 0; i < m->nx; i++) {
        mw_polynomial middle = other->x[i];
        middle.radius = 0.0;
        const mw_ball apart = mwc_sub(mw_piece_at(one, &one->x[i], angle), mw_piece_at(other, &middle, angle));
        if (!(mwc_abs(apart.mid) + mwc_reach(apart) < other->box[i])) return 0;
    }
    return 1;
}

int mw_pieces_join(const mw_model *m, const mw_piece *before, const mw_piece *after, double angle)
{
    if (before->outcome != MW_UNIQUE || after->outcome != MW_UNIQUE) return 0;
    return held(m, before, after, angle) || held(m, after, before, angle);
}

/* Bounds over t within `reach` of `at`, by the mean value over each half or, at depth 0, as they come. */
static void range(const mw_polynomial *of, double at, double reach, int depth, double *bounds)
{
    if (depth > 0) {
        range(of, at - 0.5 * reach, 0.5 * reach, depth - 1, bounds);
        range(of, at + 0.5 * reach, 0.5 * reach, depth - 1, bounds);
        return;
    }
    mw_polynomial slope = { { 0.0 }, 0.0 };
    double rounded = 0.0;
    for (int k = 1; k <= MWC_ORDER; k++) {
        slope.c[k - 1] = (double)k * of->c[k];
        rounded += mwc_abs(slope.c[k - 1]);
    }
    slope.radius = rounded * 2.0 * MWC_U;
    const mw_ball middle = mwc_poly_at(of, mwc_make(at, 0.0));
    const mw_ball rise = mwc_poly_at(&slope, mwc_make(at, reach * (1.0 + 8.0 * MWC_U)));
    const double side = (mwc_abs(rise.mid) + mwc_reach(rise)) * reach * (1.0 + 8.0 * MWC_U) + mwc_reach(middle);
    const double low = middle.mid - side * (1.0 + 8.0 * MWC_U), high = middle.mid + side * (1.0 + 8.0 * MWC_U);
    if (!(low - MWC_U * mwc_abs(low) >= bounds[0])) bounds[0] = low - 2.0 * MWC_U * mwc_abs(low);
    if (!(high + MWC_U * mwc_abs(high) <= bounds[1])) bounds[1] = high + 2.0 * MWC_U * mwc_abs(high);
}

void mw_piece_range(const mw_piece *piece, const mw_polynomial *of, double from, double to, int depth, double *bounds)
{
    const mw_ball a = share(piece, from), b = share(piece, to);
    const double low = a.mid - mwc_reach(a), high = b.mid + mwc_reach(b);
    const double at = 0.5 * low + 0.5 * high, reach = (0.5 * high - 0.5 * low) * (1.0 + 8.0 * MWC_U) + 4.0 * MWC_U;
    bounds[0] = HUGE_VAL;
    bounds[1] = -HUGE_VAL;
    range(of, at, reach, depth, bounds);
}
