/* Certified contact: see mw_certify.h.  SPDX-License-Identifier: MIT-0 */
#define MW_LANES 1
#include "certify/point.h"
#include "certify/posed.h"

/* A solution that plain doubles single out is good enough where the residual in double-double bounds it to this share of the
 * natural sizes; else it is refined. */
static const double NARROW = 1e-24;

/* How often a point that is proved in doubles is moved to where the residual there says: closer by as much each time. */
enum { ROUNDS = 2 };

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

static int within_domain(const mw_model *m, const mw_wide *x, const double *d)
{
    for (int i = 0; i < m->nx; i++)
        if (!(x[i].hi - d[i] >= m->unknowns[i].lower && x[i].hi + d[i] <= m->unknowns[i].upper)) return 0;
    return 1;
}

/* Negative surely, or perhaps; a limit that the design does not set is neither. */
static void judge(mw_ball margin, unsigned bit, mw_certificate *c)
{
    if (margin.mid != margin.mid) return;
    if (margin.mid + mwc_reach(margin) < 0.0) c->flags |= bit;
    else if (!(margin.mid - mwc_reach(margin) >= 0.0)) c->undecided |= bit;
}

/* The rest of a certificate: what the contact within the enclosure is like. */
static void observe(const mw_model *m, mwc_problem *p, mw_certificate *c)
{
    const mw_code *code = &mwc_tables_of(m)->observed;
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
static int granted(const mw_model *m, mwc_problem *p, const mwc_solution *found, mw_certificate *c)
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

/* As mwc_enclose(), in doubles where that is enough: at x, about which it is the only one, then closer from the residual
 * there in double-double. 0 where it is not enough. */
static int enclose_quickly(const mw_model *m, mwc_problem *p, const double *x, mwc_solution *found)
{
    const mw_certified *t = mwc_tables_of(m);
    const double *own = &p->balls[t->design_slots].mid;
    const mw_enclosing *by = m->kernels->enclosing();
    const int n = p->n;
    double C[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], near[MW_MAX_UNKNOWNS];
    double bound[MW_MAX_UNKNOWNS], proved[1], z[MW_MAX_UNKNOWNS][1], K[MW_MAX_UNKNOWNS][1], e[MW_MAX_UNKNOWNS][1];
    mw_ball R[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], shift[MW_MAX_UNKNOWNS];
    for (int i = 0; i < n; i++) found->box[i] = p->sizes[i] * MWC_FIRST_BOX;
    mwc_linearise(by, t, p, own, x, found->box, &R[0].mid, &J[0].mid);
    mwc_prove1(n, &R[0].mid, &J[0].mid, found->box, proved, z, K, e);
    if (!(proved[0] > 0.0)) return 0;
    for (int i = 0; i < n; i++) near[i] = e[i][0], found->x[i] = mwc_wide_of(x[i]);
    mwc_linearise(by, t, p, own, x, near, NULL, &J[0].mid);
    if (!mwc_inverse(n, J, C)) return 0;
    mwc_defect(n, C, J, M);
    for (int round = 0; round < ROUNDS; round++) {
        int narrow = 1, about = 1;
        mwc_residual_at(p, found->x, R);
        mwc_shift(n, C, R, shift);
        for (int i = 0; i < n; i++) {
            double rest = shift[i].radius;
            for (int j = 0; j < n; j++) rest += M[i * n + j] * (round ? found->within[j] : near[j]);
            bound[i] = rest;
        }
        for (int i = 0; i < n; i++) {
            if (round) found->x[i] = mwc_wide_add(found->x[i], mwc_wide_of(-shift[i].mid));
            else found->x[i].hi = mwc_two_sum(x[i], -shift[i].mid, &found->x[i].lo);
            found->within[i] = (bound[i] + found->x[i].radius) * MWC_READ;
            found->x[i].radius = 0.0; /* a point, whichever it is */
            found->box[i] = (found->box[i] - mwc_abs(shift[i].mid)) * (1.0 - 4.0 * MWC_U);
            if (!(found->within[i] < found->box[i])) return 0;
            narrow = narrow && found->within[i] < NARROW * p->sizes[i];
            about = about && mwc_abs(shift[i].mid) <= near[i];
        }
        if (narrow) return 1;
        if (!about) return 0; /* the solution and the new point lie where the slopes are enclosed, and all between */
    }
    return 0;
}

/* One certificate, p posed. */
static int certify(const mw_model *m, mwc_problem *p, mw_wide phi, const double *x, int line, mw_certificate *c)
{
    mwc_solution found;
    int reason = mwc_posed_at(m, phi, p);
    if (reason != MW_REASON_NONE) return ended(c, MW_UNKNOWN, reason);
    if (!enclose_quickly(m, p, x, &found)) {
        for (int i = 0; i < m->nx; i++) found.x[i] = mwc_wide_of(x[i]);
        reason = mwc_enclose(p, &found);
    }
    if (reason == MW_REASON_NONE) return granted(m, p, &found, c);
    return ended(c, MW_UNKNOWN, line ? MW_REASON_LINE : reason);
}

size_t mw_certify_points(const mw_model *m, const mw_wide *s, const mw_wide *phi, const double *x, const int *line, size_t n,
                         mw_certificate *c)
{
    size_t unique = 0;
    mwc_problem p;
    const int reason = mwc_posed(m, s, &p);
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
static int certify_box(const mw_model *m, mwc_problem *p, mw_wide phi, const double *x, const double *d, mw_certificate *c)
{
    const int n = m->nx;
    mw_ball J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], R[MW_MAX_UNKNOWNS], z[MW_MAX_UNKNOWNS];
    double C[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], K[MW_MAX_UNKNOWNS];
    mwc_solution found;
    const int reason = mwc_posed_at(m, phi, p);
    if (reason != MW_REASON_NONE) return ended(c, MW_UNKNOWN, reason);
    for (int i = 0; i < n; i++) found.x[i] = mwc_wide_of(x[i]), found.box[i] = d[i];
    if (!within_domain(m, found.x, d)) return ended(c, MW_UNKNOWN, MW_REASON_OUTSIDE);
    mwc_linearised(p, found.x, d, R, J);
    for (int i = 0; i < n; i++)
        if (mwc_abs(R[i].mid) - mwc_reach(R[i]) > 0.0) return ended(c, MW_NONE, MW_REASON_NONE);
    mwc_residual_at(p, found.x, R);
    if (!mwc_inverse(n, J, C)) return ended(c, MW_UNKNOWN, MW_REASON_BOX);
    mwc_shift(n, C, R, z);
    mwc_defect(n, C, J, M);
    if (mwc_misses(n, z, M, d)) return ended(c, MW_NONE, MW_REASON_NONE);
    mwc_image(n, z, M, d, K);
    if (!mwc_inside(n, K, d)) return ended(c, MW_UNKNOWN, MW_REASON_BOX);
    mwc_narrow(n, z, M, K, found.within);
    return granted(m, p, &found, c);
}

size_t mw_certify_boxes(const mw_model *m, const mw_wide *s, const mw_wide *phi, const double *x, const double *d, size_t n,
                        mw_certificate *c)
{
    const size_t nx = mwi_usable(m) ? (size_t)m->nx : 0;
    size_t unique = 0;
    mwc_problem p;
    const int reason = mwc_posed(m, s, &p);
    for (size_t k = 0; k < n; k++) {
        nothing(c + k);
        if (reason != MW_REASON_NONE) ended(c + k, MW_UNKNOWN, reason);
        else unique += certify_box(m, &p, phi[k], x + k * nx, d + k * nx, c + k) == MW_UNIQUE;
    }
    return unique;
}

int mw_prove(const mw_model *m, const mw_wide *s, mw_wide phi, const double *x, mw_proof *proof)
{
    mwc_problem p;
    mwc_solution found;
    memset(proof, 0, sizeof *proof);
    if ((proof->reason = mwc_posed(m, s, &p)) != MW_REASON_NONE) return proof->reason;
    if ((proof->reason = mwc_posed_at(m, phi, &p)) != MW_REASON_NONE) return proof->reason;
    for (int i = 0; i < m->nx; i++) found.x[i] = mwc_wide_of(x[i]);
    if ((proof->reason = mwc_enclose(&p, &found)) != MW_REASON_NONE) return proof->reason;
    if (!within_domain(m, found.x, found.box)) return proof->reason = MW_REASON_OUTSIDE;
    return mwc_shown(&p, &found, proof);
}

int mw_certify_box(const mw_model *m, const mw_wide *s, mw_wide phi, const double *x, const double *d, mw_certificate *c)
{
    mw_certify_boxes(m, s, &phi, x, d, 1, c);
    return c->outcome;
}
