/* Where two bounded flanks of a tooth pair touch first.  SPDX-License-Identifier: MIT-0
 *
 * A point of the wheel's flank, turned about the wheel's axis, meets the pinion's flank at one wheel angle. Bodies touch
 * first where that angle is extreme over all points of the wheel's flank that meet the pinion's flank inside its limits:
 * in the interior (a tangency), on a limit of either flank (an edge), or where two limits meet (a corner). */
#include "exact.h"
#include "first/cover.h"
#include "solver/basics.h"

/* Local extremes of the mesh that are refined. */
enum { STARTS = 12 };

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
    found->wheel_turn = best.at.delta;
    found->lever = best.at.lever;
    for (int i = 0; i < 2; i++) {
        const int wheel_limits = m->bodies[1].margins + 1;
        const int a = best.active[i] < MAX_LIMITS ? best.active[i] : -1;
        found->limit[i] = a < 0 ? -1 : a < wheel_limits ? a : a - wheel_limits;
        found->member[i] = a < 0 ? -1 : a < wheel_limits;
    }
    memcpy(found->q_wheel, best.at.q, (size_t)h.nw * sizeof *best.at.q);
    memcpy(found->q_pinion, best.at.p, (size_t)h.nk * sizeof *best.at.p);
    for (int i = 0; i < 3; i++) {
        found->point[i] = pinion[4 * i + 3] + dot(pinion + 4 * i, best.at.point);
        found->normal[i] = dot(pinion + 4 * i, best.at.normal);
    }
    return found->status = MW_CONVERGED;
}

size_t mw_first_contact_work(size_t vertices)
{
    return (vertices * (sizeof(place) + 1) + MIDDLES * sizeof(middle) + sizeof(double) - 1) / sizeof(double);
}
