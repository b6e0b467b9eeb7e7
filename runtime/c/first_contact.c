/* Where two bounded flanks of a tooth pair touch first.  SPDX-License-Identifier: MIT-0
 *
 * A point of the wheel's flank, turned about the wheel's axis, meets the pinion's flank at one wheel angle. Bodies touch
 * first where that angle is extreme over all points of the wheel's flank that meet the pinion's flank inside its limits:
 * in the interior (a tangency), on a limit of either flank (an edge), or where two limits meet (a corner). */
#include "exact.h"
#include "first/cover.h"
#include "first/curve.h"
#include "first/lasting.h"
#include "solver/basics.h"

/* Local extremes of the mesh that are refined. */
enum { STARTS = 12 };

/* A step beside a place by which a curve is seen to be level or not, natural sizes. */
static const double BESIDE_STEP = 0.05;

/* A search that leaves no more than this open, mm, has left nothing open. */
static const double RESOLVED = 1e-3 * RESOLUTION;

static int set_up(search *h, const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                  const double *wheel, double turn)
{
    const mw_body *p = &m->bodies[0], *w = &m->bodies[1];
    memset(h, 0, sizeof *h);
    h->m = m;
    h->s = s;
    h->mesh = mesh;
    h->turn = turn;
    h->nk = p->parameters;
    h->nw = w->parameters;
    h->given = 1;
    if (h->nk > MAX_K || h->nw > MAX_K || h->nk != 2 + p->conditions || h->nw != 2 + w->conditions) return 0;
    const int first = mesh->span[0], second = mesh->span[1];
    if (first < 0 || second < 0 || first >= h->nw || second >= h->nw || first == second) return 0;
    if (p->outputs > MAX_OUTPUTS || w->outputs > MAX_OUTPUTS || limit_count(h) > MAX_LIMITS) return 0;
    span(h, 1, first, second);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            h->A[3 * i + j] = pinion[i] * wheel[j] + pinion[4 + i] * wheel[4 + j] + pinion[8 + i] * wheel[8 + j];
        h->b[i] = 0.0;
        for (int j = 0; j < 3; j++) h->b[i] += pinion[4 * j + i] * (wheel[4 * j + 3] - pinion[4 * j + 3]);
    }
    return 1;
}

/* Carry a place from where it was solved along placements of the bodies. */
static int carry(search *h, const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                 const double *wheel, size_t steps, double turn, place *P)
{
    const double sense = h->sense;
    for (size_t k = 0; k < steps; k++) {
        if (!set_up(h, m, s, mesh, pinion + 12 * k, wheel + 12 * k, turn)) return MW_BAD_INPUT;
        h->sense = sense;
        if (!meet(h, P)) return MW_DIVERGED;
    }
    return MW_CONVERGED;
}

/* A place with the limits that hold it, and its kind: held by none, in an edge or where two borders of a member meet. */
static void write_place(const search *h, const place *P, const double *pinion, const int *active, mw_first *found)
{
    const int of_wheel = h->m->bodies[1].margins + 1;
    for (int i = 0; i < 2; i++) {
        const int a = active[i] < MAX_LIMITS ? active[i] : -1;
        found->limit[i] = a < 0 ? -1 : a < of_wheel ? a : a - of_wheel;
        found->member[i] = a < 0 ? -1 : a < of_wheel;
    }
    const int held = (found->limit[0] >= 0) + (found->limit[1] >= 0);
    found->status = held == 0 ? MW_CONVERGED
                    : held == 2 && found->member[0] == found->member[1] ? MW_CORNER_CONTACT : MW_EDGE_CONTACT;
    found->wheel_turn = P->delta;
    found->lever = P->lever;
    memcpy(found->q_wheel, P->q, (size_t)h->nw * sizeof *P->q);
    memcpy(found->q_pinion, P->p, (size_t)h->nk * sizeof *P->p);
    for (int i = 0; i < 3; i++) {
        found->point[i] = pinion[4 * i + 3] + dot(pinion + 4 * i, P->point);
        found->normal[i] = dot(pinion + 4 * i, P->normal);
    }
}

/* A place as the search has it, at the placements of which h is set up. */
static void from_place(const search *h, const mw_first *at, place *P)
{
    memset(P, 0, sizeof *P);
    P->pinion.p[0] = NAN;
    memcpy(P->q, at->q_wheel, (size_t)h->nw * sizeof *P->q);
    memcpy(P->p, at->q_pinion, (size_t)h->nk * sizeof *P->p);
    P->delta = at->wheel_turn;
}

int mw_first_contact(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                     const double *wheel, size_t steps, double turn, double sense, const double *start, double until,
                     double *work, mw_first *found)
{
    search h;
    best_ best;
    place known;
    memset(found, 0, sizeof *found);
    memset(&best, 0, sizeof best);
    memset(&known, 0, sizeof known);
    known.pinion.p[0] = NAN;
    memset(&h, 0, sizeof h);
    h.sense = sense;
    best.floor = best.highest = -HUGE_VAL;
    best.lever = 1.0;
    best.least = sense * until;
    best.budget = BUDGET;
    if (!mwi_usable(m) || mesh->vertices == 0 || steps == 0) return found->status = MW_BAD_INPUT;
    if (!m->kernels || !m->kernels->bounded) return found->status = MW_BAD_INPUT;
    if (m->bodies[0].parameters > MAX_K || m->bodies[1].parameters > MAX_K) return found->status = MW_BAD_INPUT;
    memcpy(known.q, start, (size_t)m->bodies[1].parameters * sizeof *start);
    memcpy(known.p, start + m->bodies[1].parameters, (size_t)m->bodies[0].parameters * sizeof *start);
    known.delta = start[m->bodies[1].parameters + m->bodies[0].parameters];
    found->status = carry(&h, m, s, mesh, pinion, wheel, steps, turn, &known);
    if (found->status < 0) return found->status;
    pinion += 12 * (steps - 1);
    place *at = (place *)(void *)work;
    middle *middles = (middle *)(void *)(at + mesh->vertices);
    unsigned char *marks = (unsigned char *)(void *)(middles + MIDDLES);
    flood(&h, &known, at, marks);
    for (size_t v = 0; v < mesh->vertices; v++)
        if (at[v].good && at[v].inner >= 0.0) {
            found->met++;
            if (mesh->open[v]) found->open++;
        }
    if (found->open) return found->status = MW_NO_CONTACT;
    if (worst(&h, &known) >= 0.0) refine(&h, &known, &best);
    /* the highest vertices that stand above their neighbours */
    unsigned char *below = marks;
    memset(below, 0, mesh->vertices);
    for (size_t t = 0; t < mesh->triangles; t++)
        for (int a = 0; a < 3; a++) {
            const int v = mesh->corner[3 * t + (size_t)a], w = mesh->corner[3 * t + (size_t)((a + 1) % 3)];
            const int in_v = at[v].good && at[v].inner >= 0.0, in_w = at[w].good && at[w].inner >= 0.0;
            if (in_v && in_w) below[at[v].value < at[w].value ? v : w] = 1;
        }
    for (int k = 0; k < STARTS; k++) {
        int top = -1;
        for (size_t v = 0; v < mesh->vertices; v++)
            if (!below[v] && at[v].good && at[v].inner >= 0.0 && (top < 0 || at[v].value > at[top].value)) top = (int)v;
        if (top < 0) break;
        below[top] = 1;
        refine(&h, &at[top], &best);
    }
    no_middles(middles);
    for (size_t t = 0; t < mesh->triangles; t++) {
        place T[3];
        for (int a = 0; a < 3; a++) T[a] = at[mesh->corner[3 * t + (size_t)a]];
        if (T[0].good || T[1].good || T[2].good) look(&h, T, middles, &best);
    }
    if (best.found) name_limits(&h, &best);
    const double left = fmax(best.highest, best.floor);
    if (!best.found) return found->status = left > best.least ? MW_DIVERGED : MW_NO_CONTACT;
    found->unresolved = fmax(0.0, (left - best.at.value) * fabs(best.at.lever));
    found->apart = apart_beside(&h, &best.at, best.active, BESIDE_STEP);
    write_place(&h, &best.at, pinion, best.active, found);
    return found->status;
}

size_t mw_first_contact_work(size_t vertices)
{
    return (vertices * (sizeof(place) + 1) + MIDDLES * sizeof(middle) + sizeof(double) - 1) / sizeof(double);
}

/* The placements of one angle among many. */
static int set_up_at(search *h, const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                     const double *wheel, size_t k, double turn, double sense)
{
    if (!set_up(h, m, s, mesh, pinion + 12 * k, wheel + 12 * k, turn)) return 0;
    h->sense = sense;
    return 1;
}

int mw_first_lasts(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion, const double *wheel,
                   double share, double turn, double sense, double *const *met, const mw_first *found, double *work)
{
    stretch b;
    place *at[3], leads;
    int open = 0;
    if (!mwi_usable(m) || !m->kernels || !m->kernels->bounded || !(share > 0.0 && share < 1.0)) return 0;
    b.share = share;
    b.lever = 0.0;
    b.budget = LASTING_BUDGET;
    b.nowhere = found[0].status == MW_NO_CONTACT;
    b.held[0] = b.held[1] = -1;
    for (int e = 0; e < 3; e++) {
        if ((found[e].status == MW_NO_CONTACT) != b.nowhere || found[e].unresolved > RESOLVED) return 0;
        open += found[e].open > 0;
        if (!set_up_at(&b.h[e], m, s, mesh, pinion, wheel, (size_t)e, turn, sense)) return 0;
        at[e] = (place *)(void *)met[e];
        b.known[e] = (middle *)(void *)work + e * MIDDLES;
        no_middles(b.known[e]);
        b.top[e] = b.nowhere ? 0.0 : sense * found[e].wheel_turn;
        b.lever = fmax(b.lever, fabs(found[e].lever));
        if (b.nowhere) continue;
        int active[2];
        for (int k = 0; k < 2; k++) {
            const int of_wheel = m->bodies[1].margins + 1, limit = found[e].limit[k];
            active[k] = limit < 0 ? -1 : found[e].member[k] ? limit : limit + of_wheel;
        }
        from_place(&b.h[e], found + e, &leads);
        if (!pushes(&b, e, &leads, active)) return 0;
    }
    if (open) return open == 3 && stays_open(&b, mesh, at);
    for (size_t t = 0; t < mesh->triangles; t++)
        if (!lasts_in(&b, at, mesh->corner + 3 * t)) return 0;
    return 1;
}

size_t mw_first_met_size(size_t vertices)
{
    return (vertices * sizeof(place) + sizeof(double) - 1) / sizeof(double);
}

size_t mw_first_lasts_work(void)
{
    return (3 * MIDDLES * sizeof(middle) + sizeof(double) - 1) / sizeof(double);
}

size_t mw_first_along(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion, const double *wheel,
                      size_t n, double turn, double sense, const mw_first *from, mw_first *found)
{
    search h;
    place at;
    size_t succeeded = 0;
    memset(found, 0, n * sizeof *found);
    for (size_t k = 0; k < n; k++) {
        best_ best;
        found[k].status = MW_BAD_INPUT;
        if (!mwi_usable(m) || !m->kernels || !m->kernels->bounded) continue;
        if (!set_up_at(&h, m, s, mesh, pinion, wheel, k, turn, sense)) continue;
        if (k == 0) from_place(&h, from, &at);
        memset(&best, 0, sizeof best);
        best.at = at;
        found[k].status = MW_DIVERGED;
        if (!meet(&h, &best.at) || !climb(&h, &best.at, best.active)) continue;
        name_limits(&h, &best);
        at = best.at;
        write_place(&h, &at, pinion + 12 * k, best.active, found + k);
        found[k].apart = apart_beside(&h, &at, best.active, BESIDE_STEP);
        succeeded++;
    }
    return succeeded;
}

/* A place where flanks meet, `at`, on its curve; 0 where there is none, or the flanks are of another kind. */
static int on_curve(search *h, const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion,
                    const double *wheel, double turn, double sense, const mw_first *at, int member, int limit, curve *c, place *P)
{
    if (!mwi_usable(m) || !m->kernels || !m->kernels->bounded) return 0;
    if (m->bodies[0].parameters > MAX_K || m->bodies[1].parameters > MAX_K) return 0;
    if (limit >= 0 && (member < 0 || member > 1 || limit > m->bodies[member].margins)) return 0;
    if (!set_up(h, m, s, mesh, pinion, wheel, turn)) return 0;
    h->sense = sense;
    from_place(h, at, P);
    c->h = h;
    c->held = limit < 0 ? -1 : member ? limit : limit + m->bodies[1].margins + 1;
    return meet(h, P) && curve_reach(c, -1, P);
}

size_t mw_first_curve(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion, const double *wheel,
                      double turn, double sense, const mw_first *at, int member, int limit, double step, double fall,
                      size_t count, double *work, mw_first *found)
{
    search h;
    curve c;
    place P, *places = (place *)(void *)work;
    model_ q;
    double off, a[2];
    if (!(step > 0.0) || !on_curve(&h, m, s, mesh, pinion, wheel, turn, sense, at, member, limit, &c, &P)) return 0;
    if (curve_exceeded(&c, &P) >= 0) curve_deepest(&c, step, 1, &P);
    if (curve_exceeded(&c, &P) >= 0 || !curve_at(&c, &P, &q, &off, a)) return 0;
    const double most = fall / fabs(P.lever);
    size_t n = 0;
    for (int side = 0; side < 2; side++) {
        const double way[2] = {side ? -a[1] : a[1], side ? a[0] : -a[0]};
        int ended = -1;
        const size_t along = curve_along(&c, &P, step, most, way, count, places, &ended);
        for (size_t k = side ? 1 : 0; k <= along; k++) {
            const int active[2] = {c.held, k == along && along > 0 ? ended : -1};
            write_place(&h, k ? places + k - 1 : &P, pinion, active, found + n++);
        }
        for (size_t i = 0, j = n - 1; !side && i < j; i++, j--) { /* towards the start */
            const mw_first other = found[i];
            found[i] = found[j];
            found[j] = other;
        }
    }
    return n;
}

/* Limits that differ by less, mm, are as near to the deepest place: it lies between them. */
static const double AS_DEEP = 1e-6;

size_t mw_first_curve_work(size_t count)
{
    return (count * sizeof(place) + sizeof(double) - 1) / sizeof(double);
}

int mw_first_deepest(const mw_model *m, const double *s, const mw_flank_mesh *mesh, const double *pinion, const double *wheel,
                     double turn, double sense, const mw_first *at, double step, double *depth, mw_first *found)
{
    search h;
    curve c;
    place P;
    *depth = NAN;
    memset(found, 0, sizeof *found);
    if (!(step > 0.0) || !on_curve(&h, m, s, mesh, pinion, wheel, turn, sense, at, 0, -1, &c, &P))
        return found->status = MW_NO_CONTACT;
    curve_deepest(&c, step, 0, &P);
    *depth = curve_depth(&c, &P);
    int active[2] = {-1, -1}, n = 0;
    for (int i = 0; i < limit_count(&h) && n < 2; i++)
        if (P.limits[i] <= *depth + AS_DEEP) active[n++] = i;
    write_place(&h, &P, pinion, active, found);
    return found->status;
}
