/* Certified contact: see mw_certify.h.  SPDX-License-Identifier: MIT-0 */
#include <string.h>
#define MWC_BALLS
#define MWC_WIDES
#define MW_LANES 1
#include "certify/krawczyk.h"
#include "certify/point.h"
#include "certify/tables.h"
#include "kernels.h"
#include "lane_certify.h"
#include "mw_certify.h"
#include "solver/complete.h"

enum { REFINING_STEPS = 3, NARROWING_STEPS = 8 };

/* A solution that plain doubles single out is good enough where the residual in double-double bounds it to this share of the
 * natural sizes; else it is refined. */
static const double NARROW = 1e-24;

static const mw_certified *tables_of(const mw_model *m)
{
    return mwi_usable(m) && m->kernels ? m->kernels->certified() : NULL;
}

/* A radius that is none bounds nothing. */
static mw_wide bounded(mw_wide w)
{
    return mwc_wide_where(w.radius >= 0.0, w);
}

const char *mw_reason_word(int reason)
{
#define MW_WORD(code, value, word, text) if (reason == value) return word;
    MW_REASON_LIST(MW_WORD)
    return "";
}

const char *mw_reason_text(int reason)
{
#define MW_TEXT(code, value, word, text) if (reason == value) return text;
    MW_REASON_LIST(MW_TEXT)
    return "";
}

int mw_encloses(const mw_model *m)
{
    return tables_of(m) && mwc_arithmetic();
}

int mw_enclosed_slots(const mw_model *m)
{
    return tables_of(m) ? tables_of(m)->slots : 0;
}

/* One system of n equations: natural sizes of its unknowns, and what its code reads, the unknowns after `count` others,
 * also as balls. */
typedef struct problem {
    const mw_code *equations;
    int n, count;
    double sizes[MW_MAX_UNKNOWNS];
    mw_wide arguments[MWC_ARGUMENTS];
    mw_ball balls[MWC_ARGUMENTS];
} problem;

/* x: the point about which everything is; within: the solution's distance; box: where it is the only one. */
typedef struct solution {
    mw_wide x[MW_MAX_UNKNOWNS];
    double within[MW_MAX_UNKNOWNS], box[MW_MAX_UNKNOWNS];
} solution;

/* Residual at x as balls, from double-double. */
static void residual_at(problem *p, const mw_wide *x, mw_ball *R)
{
    mw_wide registers[MWC_REGISTERS];
    memcpy(p->arguments + p->count, x, sizeof(mw_wide) * (size_t)p->n);
    mwc_run_wide(p->equations, p->equations->first, p->arguments, registers);
    for (int i = 0; i < p->n; i++) R[i] = mwc_of_wide(registers[p->equations->output[i]]);
}

/* Residual, unless NULL, and Jacobian over the box x + [-d, d]; d = NULL: at x. */
static void linearised(problem *p, const mw_wide *x, const double *d, mw_ball *R, mw_ball *J)
{
    mw_ball registers[MWC_REGISTERS];
    for (int i = 0; i < p->n; i++) {
        mw_wide side = x[i];
        if (d) side.radius += d[i];
        p->balls[p->count + i] = mwc_of_wide(side);
    }
    mwc_run_ball(p->equations, p->equations->instructions, p->balls, registers);
    for (int i = 0; R && i < p->n; i++) R[i] = registers[p->equations->output[i]];
    for (int i = 0; i < p->n * p->n; i++) J[i] = registers[p->equations->output[p->n + i]];
}

/* Newton steps with the inverse C, so that the residual is that of double-double. */
static void refine(problem *p, const double *C, mw_wide *x)
{
    mw_ball R[MW_MAX_UNKNOWNS];
    for (int step = 0; step < REFINING_STEPS; step++) {
        residual_at(p, x, R);
        for (int i = 0; i < p->n; i++) {
            double change = 0.0;
            for (int j = 0; j < p->n; j++) change += C[i * p->n + j] * R[j].mid;
            x[i] = mwc_wide_add(x[i], mwc_wide_of(-change));
            x[i].radius = 0.0; /* a point, whichever it is */
        }
    }
}

/* From K < d on, the bound on the solution's distance repeats itself smaller. */
static void narrow(int n, const mw_ball *z, const double *M, const double *K, double *within)
{
    double image[MW_MAX_UNKNOWNS];
    memcpy(within, K, sizeof(double) * (size_t)n);
    for (int step = 0; step < NARROWING_STEPS; step++) {
        mwc_image(n, z, M, within, image);
        for (int i = 0; i < n; i++)
            if (image[i] < within[i]) within[i] = image[i];
    }
}

static int within_domain(const mw_model *m, const mw_wide *x, const double *d)
{
    for (int i = 0; i < m->nx; i++)
        if (!(x[i].hi - d[i] >= m->unknowns[i].lower && x[i].hi + d[i] <= m->unknowns[i].upper)) return 0;
    return 1;
}

/* One solution near s->x: in a box of equal shares of the natural sizes, else in one that takes the shape of the image,
 * wide along what the equations hardly determine. Returns a reason. */
static int enclose(problem *p, solution *s)
{
    const int n = p->n;
    mw_ball J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS], z[MW_MAX_UNKNOWNS];
    double C[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], K[MW_MAX_UNKNOWNS];
    double *d = s->box;
    linearised(p, s->x, NULL, NULL, J);
    if (!mwc_inverse(n, J, C)) return MW_REASON_FOLD;
    refine(p, C, s->x);
    residual_at(p, s->x, R);
    mwc_shift(n, C, R, z);
    for (int i = 0; i < n; i++) d[i] = p->sizes[i] * MWC_FIRST_BOX;
    for (int step = 0; step < MWC_SHAPING_STEPS; step++) {
        linearised(p, s->x, d, NULL, J);
        mwc_defect(n, C, J, M);
        mwc_image(n, z, M, d, K);
        if (mwc_inside(n, K, d)) {
            narrow(n, z, M, K, s->within);
            return MW_REASON_NONE;
        }
        for (int i = 0; i < n; i++) {
            const double shift = mwc_abs(z[i].mid) + z[i].radius;
            d[i] = MWC_SHAPED(shift, K[i]);
            if (!(d[i] <= MWC_WIDEST_BOX * p->sizes[i])) return MW_REASON_FOLD;
        }
    }
    return MW_REASON_WIDE;
}

static void known(problem *p, const mw_wide *from, int count)
{
    p->count = count;
    memcpy(p->arguments, from, sizeof(mw_wide) * (size_t)count);
    for (int i = 0; i < count; i++) p->balls[i] = mwc_of_wide(from[i]);
}

static int fits(const mw_code *code, int arguments)
{
    return code->registers <= MWC_REGISTERS && arguments <= MWC_ARGUMENTS;
}

/* -- design -------------------------------------------------------------------------------------------------------- */

static void apply_rules(const mw_certified *t, mw_wide *p)
{
    mw_wide registers[MWC_REGISTERS];
    for (const mw_certified_rule *rule = t->rules; rule->target >= 0; rule++) {
        mw_wide *target = p + rule->target;
        const mw_code *value = &rule->value;
        if (target->hi == target->hi || value->registers > MWC_REGISTERS) continue;
        mwc_run_wide(value, value->instructions, p, registers);
        *target = registers[value->output[0]];
        for (int i = 1; i < value->outputs; i++)
            if (!(mwc_wide_least(registers[value->output[i]]) > 0.0)) target->hi = NAN;
    }
}

static int system_solved(const mw_model *m, int k, mw_wide *p, double *q)
{
    const mw_system *system = &m->systems[k];
    const mw_certified_system *t = &tables_of(m)->systems[k];
    const int np = m->np, n = system->n;
    double y[MW_MAX_UNKNOWNS] = { 0.0 };
    mw_wide arguments[MWC_ARGUMENTS], registers[MWC_REGISTERS];
    problem equations;
    solution found;
    mw_info info;
    if (!fits(&t->equations, np + 1 + n) || !fits(&t->values, np + 1 + n)) return 0;
    for (int i = 0; i < np; i++) q[i] = p[i].hi;
    if (mwi_solve_system(m, system, q, y, &info) < 0) return 0;
    system->scale(q, equations.sizes);
    memcpy(arguments, p, sizeof(mw_wide) * (size_t)np);
    arguments[np] = mwc_wide_of(1.0);
    equations.equations = &t->equations;
    equations.n = n;
    known(&equations, arguments, np + 1);
    for (int i = 0; i < n; i++) found.x[i] = mwc_wide_of(y[i]);
    if (enclose(&equations, &found) != MW_REASON_NONE) return 0;
    for (int i = 0; i < n; i++) {
        arguments[np + 1 + i] = found.x[i];
        arguments[np + 1 + i].radius = found.within[i];
    }
    mwc_run_wide(&t->values, t->values.instructions, arguments, registers);
    for (int i = 0; t->fills[i] >= 0; i++)
        if (p[t->fills[i]].hi != p[t->fills[i]].hi) p[t->fills[i]] = registers[t->values.output[i]];
    return 1;
}

int mw_enclose_design(const mw_model *m, mw_wide *p, double *q)
{
    const mw_certified *t = tables_of(m);
    double open[MW_MAX_PARAMETERS];
    if (!mw_encloses(m) || m->np + 1 > MWC_ARGUMENTS || m->np > MW_MAX_PARAMETERS) return 1 + m->nsystems;
    for (int i = 0; i < m->np; i++)
        if (p[i].hi == p[i].hi) p[i] = mwc_wide_mul(bounded(p[i]), t->factors[i]);
    apply_rules(t, p);
    for (int k = 0; k < m->nsystems; k++) {
        for (int i = 0; i < m->np; i++) open[i] = p[i].hi;
        if (m->systems[k].open(open) == 0) continue;
        if (!system_solved(m, k, p, q)) return 1 + k;
        apply_rules(t, p);
    }
    return 0;
}

void mw_enclose_setup(const mw_model *m, const mw_wide *p, mw_wide *s)
{
    const mw_certified *t = tables_of(m);
    mw_wide registers[MWC_REGISTERS];
    const int possible = mw_encloses(m) && fits(&t->setup, m->np) && fits(&t->observed, t->slots + m->nx)
                         && fits(&t->equations, t->slots + m->nx) && fits(&t->instant, t->slots + 1);
    if (possible) mwc_run_wide(&t->setup, t->setup.instructions, p, registers);
    for (int i = 0; i < mw_enclosed_slots(m); i++)
        s[i] = possible && i < t->design_slots ? registers[t->setup.output[i]] : mwc_wide(NAN, 0.0, 0.0);
}

/* -- contact ------------------------------------------------------------------------------------------------------- */

/* Whether the equations know what they read of the state from the one number to the other. Returns a reason. */
static int known_between(const problem *p, int first, int end)
{
    for (int i = 0; i < p->equations->inputs; i++) {
        const int at = p->equations->input[i];
        if (at < first || at >= end) continue;
        if (!(p->balls[at].radius < HUGE_VAL && p->balls[at].mid == p->balls[at].mid)) return MW_REASON_DESIGN;
    }
    return MW_REASON_NONE;
}

/* A design's contact problem at no angle yet. Returns a reason. */
static int posed(const mw_model *m, const mw_wide *s, problem *p)
{
    const mw_certified *t = tables_of(m);
    if (!mw_encloses(m)) return MW_REASON_ARITHMETIC;
    p->equations = &t->equations;
    p->n = m->nx;
    known(p, s, t->slots);
    return known_between(p, 0, t->design_slots);
}

/* What follows from the angle, and the natural sizes of the unknowns, from the midpoints of the state. Returns a reason. */
static int turned(const mw_model *m, mw_wide phi, problem *p)
{
    const mw_certified *t = tables_of(m);
    mw_wide registers[MWC_REGISTERS];
    double state[MWC_ARGUMENTS];
    p->arguments[t->slots] = bounded(phi);
    mwc_run_wide(&t->instant, t->instant.instructions, p->arguments, registers);
    for (int i = t->design_slots; i < t->slots; i++) {
        p->arguments[i] = registers[t->instant.output[i - t->design_slots]];
        p->balls[i] = mwc_of_wide(p->arguments[i]);
    }
    for (int i = 0; i < t->slots; i++) state[i] = p->arguments[i].hi;
    for (int i = t->slots; i < MWC_ARGUMENTS; i++) state[i] = NAN;
    m->scale(state, p->sizes);
    return known_between(p, t->design_slots, t->slots);
}

/* Negative surely, or perhaps; a limit that the design does not set is neither. */
static void judge(mw_ball margin, unsigned bit, mw_certificate *c)
{
    if (margin.mid != margin.mid) return;
    if (margin.mid + mwc_reach(margin) < 0.0) c->flags |= bit;
    else if (!(margin.mid - mwc_reach(margin) >= 0.0)) c->undecided |= bit;
}

/* The rest of a certificate: what the contact within the enclosure is like. */
static void observe(const mw_model *m, problem *p, mw_certificate *c)
{
    const mw_code *code = &tables_of(m)->observed;
    mw_ball registers[MWC_REGISTERS], o[MW_MAX_OBSERVATION];
    for (int i = 0; i < m->nx; i++) p->balls[p->count + i] = mwc_of_wide(c->x[i]);
    mwc_run_ball(code, code->instructions, p->balls, registers);
    for (int i = 0; i < code->outputs; i++) {
        o[i] = registers[code->output[i]];
        o[i].radius = mwc_reach(o[i]);
    }
    memcpy(c->point, o, sizeof c->point);
    memcpy(c->normal, o + 3, sizeof c->normal);
    c->wheel_angle = o[12];
    memcpy(c->curvature, o + 13, sizeof c->curvature);
    c->flags = c->undecided = 0;
    judge(o[13], 2u, c);
    unsigned bit = 4;
    const mw_ball *at = o + 15;
    for (int b = 0; b < 2; b++) {
        judge(*at++, 1u, c);
        for (int i = 0; i < m->bodies[b].margins; i++, bit <<= 1) judge(*at++, bit, c);
    }
    c->undecided &= ~c->flags;
}

static int ended(mw_certificate *c, int outcome, int reason)
{
    c->outcome = outcome;
    c->reason = reason;
    return outcome;
}

static void nothing(mw_certificate *c)
{
    memset(c, 0, sizeof *c);
    for (int i = 0; i < MW_MAX_UNKNOWNS; i++) c->x[i] = mwc_wide(NAN, NAN, NAN), c->box[i] = NAN;
    for (int i = 0; i < 3; i++) c->point[i] = c->normal[i] = mwc_make(NAN, NAN);
    c->wheel_angle = c->curvature[0] = c->curvature[1] = mwc_make(NAN, NAN);
}

/* The certificate of a solution that is the only one within box of x. */
static int granted(const mw_model *m, problem *p, const solution *found, mw_certificate *c)
{
    if (!within_domain(m, found->x, found->box)) return ended(c, MW_UNKNOWN, MW_REASON_OUTSIDE);
    for (int i = 0; i < m->nx; i++) {
        c->x[i] = found->x[i];
        c->x[i].radius = found->within[i];
        c->box[i] = found->box[i];
    }
    observe(m, p, c);
    return ended(c, MW_UNIQUE, MW_REASON_NONE);
}

/* As the printed code does it, to the same bits, residual at x, unless NULL, and Jacobian over the box x +- d; own: balls of the
 * angle. By the table where there is no printed code. */
static void linearise(const mw_enclosing *by, const mw_certified *t, problem *p, const double *own, const double *x,
                      const double *d, double *R, double *J)
{
    mw_ball registers[MWC_REGISTERS], *at = p->balls + p->count;
    double not_asked[2 * MW_MAX_UNKNOWNS];
    const unsigned short *output = p->equations->output;
    const int n = p->n;
    if (by) {
        by->linearise(&p->balls[0].mid, own, x, d, R ? R : not_asked, J);
        return;
    }
    for (int i = t->design_slots; i < t->slots; i++, own += 2) p->balls[i] = mwc_make(own[0], own[1]);
    for (int i = 0; i < n; i++) at[i] = mwc_make(x[i], 0.0);
    if (R) mwc_run_ball(p->equations, p->equations->first, p->balls, registers);
    for (int i = 0; R && i < n; i++) mwc_put(R, i, registers[output[i]]);
    for (int i = 0; i < n; i++) at[i] = mwc_make(x[i], d[i]);
    mwc_run_ball(p->equations, p->equations->instructions, p->balls, registers);
    for (int i = 0; i < n * n; i++) mwc_put(J, i, registers[output[n + i]]);
}

/* Likewise what follows from an angle. */
static void at_angle(const mw_enclosing *by, const mw_certified *t, problem *p, mw_ball phi, double *own)
{
    mw_ball registers[MWC_REGISTERS];
    if (by) {
        by->instant(&p->balls[0].mid, &phi.mid, own);
        return;
    }
    p->balls[t->slots] = phi;
    mwc_run_ball(&t->instant, t->instant.instructions, p->balls, registers);
    for (int i = 0; i < t->slots - t->design_slots; i++) mwc_put(own, i, registers[t->instant.output[i]]);
}

/* As enclose(), in doubles where that is enough: at x, about which it is the only one, then closer from the residual there in
 * double-double. 0 where it is not enough. */
static int enclose_quickly(const mw_model *m, problem *p, const double *x, solution *found)
{
    const mw_certified *t = tables_of(m);
    const double *own = &p->balls[t->design_slots].mid;
    const mw_enclosing *by = m->kernels->enclosing();
    const int n = p->n;
    double C[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], near[MW_MAX_UNKNOWNS];
    double proved[1], z[MW_MAX_UNKNOWNS][1], K[MW_MAX_UNKNOWNS][1], e[MW_MAX_UNKNOWNS][1];
    mw_ball R[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], shift[MW_MAX_UNKNOWNS];
    for (int i = 0; i < n; i++) found->box[i] = p->sizes[i] * MWC_FIRST_BOX;
    linearise(by, t, p, own, x, found->box, &R[0].mid, &J[0].mid);
    mwc_prove1(n, &R[0].mid, &J[0].mid, found->box, proved, z, K, e);
    if (!(proved[0] > 0.0)) return 0;
    for (int i = 0; i < n; i++) near[i] = e[i][0], found->x[i] = mwc_wide_of(x[i]);
    linearise(by, t, p, own, x, near, NULL, &J[0].mid);
    if (!mwc_inverse(n, J, C)) return 0;
    residual_at(p, found->x, R);
    mwc_shift(n, C, R, shift);
    mwc_defect(n, C, J, M);
    for (int i = 0; i < n; i++) {
        double rest = shift[i].radius;
        for (int j = 0; j < n; j++) rest += M[i * n + j] * near[j];
        found->x[i].hi = mwc_two_sum(x[i], -shift[i].mid, &found->x[i].lo);
        found->within[i] = rest * MWC_READ;
        found->box[i] = (found->box[i] - mwc_abs(shift[i].mid)) * (1.0 - 4.0 * MWC_U);
        if (!(found->within[i] < found->box[i] && found->within[i] < NARROW * p->sizes[i])) return 0;
    }
    return 1;
}

/* One certificate, p posed. */
static int certify(const mw_model *m, problem *p, mw_wide phi, const double *x, int line, mw_certificate *c)
{
    solution found;
    int reason = turned(m, phi, p);
    if (reason != MW_REASON_NONE) return ended(c, MW_UNKNOWN, reason);
    if (!enclose_quickly(m, p, x, &found)) {
        for (int i = 0; i < m->nx; i++) found.x[i] = mwc_wide_of(x[i]);
        reason = enclose(p, &found);
    }
    if (reason == MW_REASON_NONE) return granted(m, p, &found, c);
    return ended(c, MW_UNKNOWN, line ? MW_REASON_LINE : reason);
}

size_t mw_certify_points(const mw_model *m, const mw_wide *s, const mw_wide *phi, const double *x, const int *line, size_t n,
                         mw_certificate *c)
{
    size_t unique = 0;
    problem p;
    const int reason = posed(m, s, &p);
    for (size_t k = 0; k < n; k++) {
        int known = 1;
        nothing(c + k);
        for (int i = 0; mw_encloses(m) && i < m->nx; i++) known = known && x[k * (size_t)m->nx + (size_t)i] == x[k * (size_t)m->nx + (size_t)i];
        if (!known) ended(c + k, MW_UNKNOWN, MW_REASON_CONTACT);
        else if (reason != MW_REASON_NONE) ended(c + k, MW_UNKNOWN, reason);
        else unique += certify(m, &p, phi[k], x + k * (size_t)m->nx, line[k], c + k) == MW_UNIQUE;
    }
    return unique;
}

int mw_certify(const mw_model *m, const mw_wide *s, mw_wide phi, const double *x, int line, mw_certificate *c)
{
    mw_certify_points(m, s, &phi, x, &line, 1, c);
    return c->outcome;
}

/* A box about x, p posed. */
static int certify_box(const mw_model *m, problem *p, mw_wide phi, const double *x, const double *d, mw_certificate *c)
{
    const int n = m->nx;
    mw_ball J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS], z[MW_MAX_UNKNOWNS];
    double C[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], K[MW_MAX_UNKNOWNS];
    solution found;
    const int reason = turned(m, phi, p);
    if (reason != MW_REASON_NONE) return ended(c, MW_UNKNOWN, reason);
    for (int i = 0; i < n; i++) found.x[i] = mwc_wide_of(x[i]), found.box[i] = d[i];
    if (!within_domain(m, found.x, d)) return ended(c, MW_UNKNOWN, MW_REASON_OUTSIDE);
    linearised(p, found.x, d, R, J);
    for (int i = 0; i < n; i++)
        if (mwc_abs(R[i].mid) - mwc_reach(R[i]) > 0.0) return ended(c, MW_NONE, MW_REASON_NONE);
    residual_at(p, found.x, R);
    if (!mwc_inverse(n, J, C)) return ended(c, MW_UNKNOWN, MW_REASON_BOX);
    mwc_shift(n, C, R, z);
    mwc_defect(n, C, J, M);
    if (mwc_misses(n, z, M, d)) return ended(c, MW_NONE, MW_REASON_NONE);
    mwc_image(n, z, M, d, K);
    if (!mwc_inside(n, K, d)) return ended(c, MW_UNKNOWN, MW_REASON_BOX);
    narrow(n, z, M, K, found.within);
    return granted(m, p, &found, c);
}

size_t mw_certify_boxes(const mw_model *m, const mw_wide *s, const mw_wide *phi, const double *x, const double *d, size_t n,
                        mw_certificate *c)
{
    const size_t nx = mwi_usable(m) ? (size_t)m->nx : 0;
    size_t unique = 0;
    problem p;
    const int reason = posed(m, s, &p);
    for (size_t k = 0; k < n; k++) {
        nothing(c + k);
        if (reason != MW_REASON_NONE) ended(c + k, MW_UNKNOWN, reason);
        else unique += certify_box(m, &p, phi[k], x + k * nx, d + k * nx, c + k) == MW_UNIQUE;
    }
    return unique;
}

int mw_certify_box(const mw_model *m, const mw_wide *s, mw_wide phi, const double *x, const double *d, mw_certificate *c)
{
    mw_certify_boxes(m, s, &phi, x, d, 1, c);
    return c->outcome;
}

/* One point in doubles over its own box alone. */
static int certify_one(const mw_enclosing *by, const mw_model *m, problem *p, double *own, const mw_wide *phi, const double *x,
                       mw_ball *error)
{
    const mw_certified *t = tables_of(m);
    const int n = p->n;
    double R[2 * MW_MAX_UNKNOWNS], J[2 * MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], d[MW_MAX_UNKNOWNS];
    double proved[1], z[MW_MAX_UNKNOWNS][1], K[MW_MAX_UNKNOWNS][1], e[MW_MAX_UNKNOWNS][1];
    for (int i = 0; i < n; i++) d[i] = p->sizes[i] * MWC_FIRST_BOX;
    at_angle(by, t, p, mwc_of_wide(*phi), own);
    linearise(by, t, p, own, x, d, R, J);
    mwc_prove1(n, R, J, d, proved, z, K, e);
    if (!(proved[0] > 0.0)) return 0;
    error->radius = e[m->error][0];
    return 1;
}

/* What doubles do not show, shown with all means if it can be. */
static void certify_alone(const mw_model *m, problem *p, mw_wide phi, const double *x, unsigned char *unique, mw_ball *error)
{
    mw_certificate c;
    nothing(&c);
    if (certify(m, p, phi, x, 0, &c) != MW_UNIQUE) return;
    *unique = 1;
    *error = mwc_of_wide(c.x[m->error]);
}

/* Points that share a domain: with more it is larger and its bounds are looser, with fewer it is found more often. */
enum { DOMAIN_POINTS = 256 };

/* The largest size, not a number if one of both is none. */
static double larger(double most, double a)
{
    const double size = mwc_abs(a);
    return (size > most ? size : most) + (size - size);
}

/* Begins a domain: its box, and the order of rows that its first point needs. */
static void domain_about(const mw_enclosing *by, const mw_model *m, problem *p, const double *most, mw_wide phi, const double *x,
                         mwc_domain *of)
{
    const mw_ball first = mwc_of_wide(phi);
    static const int in_order[MWC_MAX] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    double own[2 * MWC_ARGUMENTS], R[2 * MWC_MAX], J[MWC_MAX * MWC_MAX];
    of->n = m->nx;
    of->error = m->error;
    by->instant(&p->balls[0].mid, &first.mid, own);
    by->at_point(most, own, x, in_order, R, J, of->least);
    mwc_order(of->n, J, of->rows);
    for (int i = 0; i < of->n; i++) { /* the unknown asked for is the last column */
        const int at = i < of->error ? i : i == of->error ? of->n - 1 : i - 1;
        of->d[at] = p->sizes[i] * MWC_FIRST_BOX;
        of->inverse[at] = 1.0 / of->d[at];
    }
}

/* The Jacobian's radii and share of rounding, times the box's half-widths, where unknowns are within `share` of these. */
static void domain_rows(const mw_certified *t, mwc_bound *known, const double *d, double share, const mwc_domain *of, double *rows)
{
    const int n = of->n;
    const double tiny = (double)(4 * n) * MWC_TINY;
    mwc_bound registers[MWC_REGISTERS];
    double all = 0.0;
    for (int i = 0; i < n; i++) known[t->slots + i].radius = share * d[i];
    mwc_run_bounds(&t->equations, known, of->least, registers);
    for (int i = 0; i < n; i++) all += registers[t->equations.output[i]].radius;
    for (int i = 0; i < n; i++) {
        double sum = all < HUGE_VAL ? tiny : HUGE_VAL;
        for (int j = 0; j < n; j++) {
            const mwc_bound entry = registers[t->equations.output[n + i * n + j]];
            sum += (mwc_bound_reach(entry) + MWC_SHARE(n) * entry.most + tiny) * d[j];
        }
        rows[of->rows[i]] = sum * MWC_READ;
    }
}

/* Ends it: bounds at points x[count] at angles phi[count], all of which were looked at. Where one number is none, or a bound
 * is none, nothing is proved. */
static void domain_of(const mw_model *m, problem *p, const mw_wide *phi, const double *x, size_t count, mwc_domain *of)
{
    const mw_certified *t = tables_of(m);
    const size_t n = (size_t)of->n;
    mwc_bound known[MWC_ARGUMENTS], registers[MWC_REGISTERS], *const angle = known + t->slots;
    double d[MWC_MAX];
    for (int i = 0; i < t->design_slots; i++) known[i] = mwc_bound_of(mwc_abs(p->balls[i].mid), p->balls[i].radius);
    angle->most = angle->radius = 0.0;
    for (size_t k = 0; k < count; k++) {
        const mw_ball here = mwc_of_wide(phi[k]);
        angle->most = larger(angle->most, here.mid);
        angle->radius = larger(angle->radius, here.radius);
    }
    mwc_run_bounds(&t->instant, known, NULL, registers);
    for (int i = t->design_slots; i < t->slots; i++) known[i] = registers[t->instant.output[i - t->design_slots]];
    for (size_t i = 0; i < n; i++) {
        double *const most = &known[(size_t)t->slots + i].most;
        *most = 0.0;
        for (size_t k = 0; k < count; k++) *most = larger(*most, x[k * n + i]);
        d[i] = p->sizes[i] * MWC_FIRST_BOX;
    }
    domain_rows(t, known, d, 1.0, of, of->wide);
    domain_rows(t, known, d, MWC_NEAR, of, of->near);
}

/* The design's balls as at_point reads them. */
static void prepared(const problem *p, int slots, double *most)
{
    for (int i = 0; i < slots; i++) {
        const mw_ball b = p->balls[i];
        most[3 * i] = b.mid;
        most[3 * i + 1] = MWC_UNITS * b.radius;
        most[3 * i + 2] = mwc_abs(b.mid) + mwc_reach(b);
    }
}

size_t mw_certify_many(const mw_lane_set *set, const mw_proofs *proofs, const mw_model *m, const mw_wide *s, const mw_wide *phi,
                       const double *x, size_t n, unsigned char *unique, mw_ball *errors)
{
    const size_t nx = mwi_usable(m) ? (size_t)m->nx : 0, lanes = set ? (size_t)set->lanes : 1;
    double own[2 * MWC_ARGUMENTS * MW_MAX_LANES], most[3 * MWC_ARGUMENTS];
    double R[2 * MWC_MAX * DOMAIN_POINTS], J[MWC_MAX * MWC_MAX * DOMAIN_POINTS];
    size_t count = 0;
    problem p;
    mwc_domain of;
    int possible = posed(m, s, &p) == MW_REASON_NONE && (!proofs || strcmp(proofs->drive, m->drive) == 0);
    for (size_t i = 0; i < n; i++) unique[i] = 0, errors[i] = mwc_make(nx ? x[i * nx + (size_t)m->error] : NAN, HUGE_VAL);
    if (!possible || n == 0 || turned(m, phi[0], &p) != MW_REASON_NONE) return 0;
    const mw_enclosing *in_lanes = set && proofs ? proofs->lanes[set->set] : NULL, *by = proofs ? proofs->enclosing() : m->kernels->enclosing();
    const double *balls = &p.balls[0].mid;
    of.guards = mwc_run_bounds(&tables_of(m)->equations, NULL, NULL, NULL);
    prepared(&p, tables_of(m)->design_slots, most);
    for (size_t begin = 0, size; by && begin < n && of.guards <= MWC_GUARDS; begin += size) {
        const double *at = x + begin * nx;
        const mw_wide *angle = phi + begin;
        size_t k = 0, together;
        size = n - begin < DOMAIN_POINTS ? n - begin : DOMAIN_POINTS;
        together = in_lanes ? size - size % lanes : 0;
        domain_about(by, m, &p, most, *angle, at, &of);
        for (; k < together; k += lanes)
            set->look(in_lanes, &of, balls, most, own, angle + k, at + k * nx, R + 2 * k * nx, J + k * nx * nx);
        for (; k < size; k++) mwc_look1(by, &of, balls, most, own, angle + k, at + k * nx, R + 2 * k * nx, J + k * nx * nx);
        domain_of(m, &p, angle, at, size, &of);
        for (k = 0; k < together; k += lanes)
            set->decide(&of, R + 2 * k * nx, J + k * nx * nx, at + k * nx, unique + begin + k, errors + begin + k);
        for (; k < size; k++)
            mwc_decide1(&of, R + 2 * k * nx, J + k * nx * nx, at + k * nx, unique + begin + k, errors + begin + k);
    }
    for (size_t i = 0; i < n; i++) {
        if (!unique[i]) unique[i] = certify_one(by, m, &p, own, phi + i, x + i * nx, errors + i) != 0;
        if (!unique[i]) certify_alone(m, &p, phi[i], x + i * nx, unique + i, errors + i);
        count += unique[i];
    }
    return count;
}
