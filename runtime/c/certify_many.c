/* Many certified points of one design, those that are near each other with bounds that they share. See mw_certify.h.
 * SPDX-License-Identifier: MIT-0 */
#define MW_LANES 1
#include "certify/point.h"
#include "certify/posed.h"
#include "lane_certify.h"

/* One point in doubles over its own box alone. */
static int certify_one(const mw_enclosing *by, const mw_model *m, mwc_problem *p, double *own, const mw_wide *phi, const double *x,
                       mw_ball *error)
{
    const mw_certified *t = mwc_tables_of(m);
    const int n = p->n;
    double R[2 * MW_MAX_UNKNOWNS], J[2 * MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], d[MW_MAX_UNKNOWNS];
    double proved[1], z[MW_MAX_UNKNOWNS][1], K[MW_MAX_UNKNOWNS][1], e[MW_MAX_UNKNOWNS][1];
    for (int i = 0; i < n; i++) d[i] = p->sizes[i] * MWC_FIRST_BOX;
    mwc_at_angle(by, t, p, mwc_of_wide(*phi), own);
    mwc_linearise(by, t, p, own, x, d, R, J);
    mwc_prove1(n, R, J, d, proved, z, K, e);
    if (!(proved[0] > 0.0)) return 0;
    error->radius = e[m->error][0];
    return 1;
}

/* What doubles do not show, shown with all means if it can be. */
static void certify_alone(const mw_model *m, const mw_wide *s, mw_wide phi, const double *x, unsigned char *unique, mw_ball *error)
{
    mw_certificate c;
    if (mw_certify(m, s, phi, x, 0, &c) != MW_UNIQUE) return;
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
static void domain_about(const mw_enclosing *by, const mw_model *m, mwc_problem *p, const double *most, mw_wide phi, const double *x,
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
static void domain_of(const mw_model *m, mwc_problem *p, const mw_wide *phi, const double *x, size_t count, mwc_domain *of)
{
    const mw_certified *t = mwc_tables_of(m);
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
static void prepared(const mwc_problem *p, int slots, double *most)
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
    mwc_problem p;
    mwc_domain of;
    int possible = mwc_posed(m, s, &p) == MW_REASON_NONE && (!proofs || strcmp(proofs->drive, m->drive) == 0);
    for (size_t i = 0; i < n; i++) unique[i] = 0, errors[i] = mwc_make(nx ? x[i * nx + (size_t)m->error] : NAN, HUGE_VAL);
    size_t posed = 0; /* natural sizes are those of the first angle that is one */
    while (possible && posed < n && mwc_posed_at(m, phi[posed], &p) != MW_REASON_NONE) posed++;
    if (!possible || posed == n) return 0;
    const mw_enclosing *in_lanes = set && proofs ? proofs->lanes[set->set] : NULL, *by = proofs ? proofs->enclosing() : m->kernels->enclosing();
    const double *balls = &p.balls[0].mid;
    of.guards = mwc_run_bounds(&mwc_tables_of(m)->equations, NULL, NULL, NULL);
    prepared(&p, mwc_tables_of(m)->design_slots, most);
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
        if (!unique[i]) certify_alone(m, s, phi[i], x + i * nx, unique + i, errors + i);
        count += unique[i];
    }
    return count;
}
