/* The C interface called with whatever bytes say: for libFuzzer, or by itself with random bytes (MW_FUZZ_ALONE) and in
 * several threads at once (MW_FUZZ_THREADS). Every buffer has exactly the length that the interface documents.
 *
 * Each success is looked at again with both surfaces: a contact that does not touch, lies beyond the flanks or has an
 * interference that no flag names, a result that differs between two equal calls, and numbers where there is none end
 * the program.  SPDX-License-Identifier: MIT-0 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "lanes.h"
#include "meshwright.h"
#include "seeds.h"

#ifdef MW_FUZZ_THREADS
#define MW_EACH _Thread_local
#else
#define MW_EACH
#endif

/* What bytes choose among, by what most of its calls are of; calls of mw_certify_first are counted beside. */
static const char *const kinds[] = {
    "the drive's table", "the drive's table", "the drive's table", "mw_solve", "a header's own solve", "mw_refine", "mw_trace",
    "mw_analyse", "mw_follow", "mw_arclength", "branch points", "lanes", "sensitivities", "words", "foreign tables",
    "CasADi's entries", "edges", "mw_bounds", "mw_certify", "mw_certify_many", "mw_certify_piece", "mw_first_contact",
    "mw_cycles",
};

enum { CALLS = 24, POINTS = 24, ROOMS = 512, KINDS = sizeof kinds / sizeof *kinds };

static MW_EACH unsigned long long calls, inputs, successes, ended[16], of_kind[sizeof kinds / sizeof *kinds], first_proofs;
static MW_EACH uint64_t all;     /* digest of the results of all inputs */
static MW_EACH void *rooms[ROOMS];
static MW_EACH size_t used;

typedef struct reader {
    const uint8_t *at, *end;
    uint64_t digest;             /* of all results */
} reader;

static void fail(const char *what)
{
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

static unsigned byte(reader *r)
{
    return r->at < r->end ? *r->at++ : 0;
}

static void *room(size_t count, size_t size)
{
    if (used == ROOMS) fail("out of rooms");
    void *made = malloc(count * size ? count * size : 1);
    if (!made) fail("out of memory");
    return rooms[used++] = made;
}

static double *numbers(size_t count)
{
    return room(count, sizeof(double));
}

static void note(reader *r, const void *data, size_t size)
{
    const unsigned char *c = data;
    for (size_t i = 0; i < size; i++) r->digest = (r->digest ^ c[i]) * 1099511628211u;
}

/* Not-a-numbers of any bits are one. */
static void note_numbers(reader *r, const double *a, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const double one = a[i] == a[i] ? a[i] : 0.125;
        note(r, &one, sizeof one);
    }
}

/* A number near this one, far from it, or any. */
static double number(reader *r, double near)
{
    static const double extreme[] = { 0.0, -0.0, 1.0, -1.0, 5e-324, 2.2e-308, 1e-15, 1e15, 1e154, 1e300, 1.7e308, -1.7e308,
                                      HUGE_VAL, -HUGE_VAL, NAN, 10000.0 };
    const unsigned kind = byte(r);
    if (kind < 96) return near;
    if (kind < 160) return near * (1.0 + ((double)byte(r) - 128.0) / 2048.0);
    if (kind < 208) return near + ((double)byte(r) - 128.0) / 512.0;
    if (kind < 224) return near + ((double)byte(r) - 128.0) / 8.0;
    if (kind < 248) return extreme[byte(r) % (sizeof extreme / sizeof *extreme)];
    double any;
    unsigned char bits[sizeof any];
    for (size_t i = 0; i < sizeof any; i++) bits[i] = (unsigned char)byte(r);
    memcpy(&any, bits, sizeof any);
    return any;
}

/* A number from -1 to 1 that follows from all results before it. */
static double scattered(reader *r)
{
    r->digest = r->digest * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)r->digest / 9223372036854775808.0;
}

static double angle(reader *r)
{
    return number(r, ((double)byte(r) - 128.0) / 64.0);
}

static void angles(reader *r, double *phi, size_t n)
{
    const double begin = angle(r), apart = ((double)byte(r) - 128.0) / 1024.0;
    const unsigned other = byte(r);
    const double step = other < 32 ? apart / 65536.0 : apart; /* so close that points share a Jacobian */
    for (size_t k = 0; k < n; k++) phi[k] = begin + (double)k * step;
    if (other > 128) phi[other % n] = angle(r);
}

static double extent(const double *a)
{
    return fabs(a[0]) + fabs(a[1]) + fabs(a[2]);
}

/* What anything called a success must be; s is set up for its angle. */
static void must_touch(const mw_model *m, const double *s, const double *x)
{
    double *o = numbers((size_t)m->no), gap = 0.0, misfit = 0.0;
    m->observe(s, x, o);
    for (int i = 0; i < 3; i++) {
        gap = fmax(gap, fabs(o[i] - o[6 + i]));
        misfit = fmax(misfit, fabs(o[3 + i] + o[9 + i]));
    }
    if (!(gap <= 1e-8 * (1.0 + extent(o) + extent(o + 6)))) fail("a success whose flanks are apart");
    if (!(misfit <= 1e-7)) fail("a success whose normals are not opposed");
    for (int i = 0; i < m->nx; i++)
        if (!(x[i] >= m->unknowns[i].lower && x[i] <= m->unknowns[i].upper)) fail("a success beyond the flanks");
    successes++;
}

static void judge(reader *r, const mw_model *m, double *s, double phi, const double *x, int status)
{
    ended[(status + 8) & 15]++;
    note(r, &status, sizeof status);
    note_numbers(r, x, (size_t)m->nx);
    if (status < 0) {
        for (int i = 0; i < m->nx; i++)
            if (x[i] == x[i]) fail("numbers where there is no contact");
        return;
    }
    m->set_phi(s, phi);
    must_touch(m, s, x);
}

static void must_be_flagged(const mw_model *m, const double *o, const mw_contact *c)
{
    int flagged = 0;
    for (int bit = 0; bit < 32; bit++)
        if (c->flags >> bit & 1u) {
            const char *name = mw_flag(m, bit);
            if (!name) fail("a flag without a name");
            flagged |= mw_impossible(name);
        }
    if (c->curvature_min < -1e-8 * fabs(c->curvature_max) && !c->line && !flagged) fail("interference that no flag names");
    for (int b = 0; b < 2; b++) {
        if (o[m->bodies[b].regular] < 0.0 && !(c->flags & 1u)) fail("a place beyond a singular line that no flag names");
        for (int i = 0; i < m->bodies[b].margins; i++)
            if (o[m->bodies[b].margin + i] < 0.0 && !c->flags) fail("a place outside a limit that no flag names");
    }
}

typedef struct fuzzed {
    const mw_model *m;
    const seed *from;
    double *given, *p, *s, *work;
    int completed;               /* given was completed by mw_complete, so that p follows from it */
} fuzzed;

/* A design: parameters given, changed and completed, or complete ones changed behind every check. Nonzero if it is set up. */
static int design(reader *r, fuzzed *f)
{
    f->from = &seeds[byte(r) % (sizeof seeds / sizeof *seeds)];
    f->m = mw_find(f->from->drive);
    if (!f->m) fail("a drive is missing");
    const mw_model *m = f->m;
    const size_t np = (size_t)m->np;
    const unsigned how = byte(r);
    f->given = numbers(np), f->p = numbers(np), f->s = numbers((size_t)m->ns), f->work = numbers(np);
    f->completed = how < 128;
    memcpy(f->given, f->from->given, np * sizeof *f->p);
    memcpy(f->p, f->completed ? f->from->given : f->from->complete, np * sizeof *f->p);
    for (unsigned k = 0; k < how % 4; k++) {
        const unsigned i = byte(r) % (unsigned)m->np;
        f->given[i] = f->p[i] = number(r, f->p[i]);
    }
    if (f->completed) {
        mw_info info;
        calls++;
        if (mw_complete(m, f->p, numbers(np + 1), &info)) return 0;
    }
    calls += 2;
    if (m->setup(f->p, f->s)) return 0;
    m->set_phi(f->s, 0.0);
    return 1;
}

static double *start(reader *r, const fuzzed *f)
{
    double *x = numbers((size_t)f->m->nx);
    for (int i = 0; i < f->m->nx; i++) x[i] = number(r, f->from->x[i]);
    return x;
}

static double *changes(reader *r, int n)
{
    double *d = numbers((size_t)n);
    for (int i = 0; i < n; i++) d[i] = 0.0;
    const unsigned which = byte(r) % (unsigned)n;
    d[which] = number(r, 1.0);
    return d;
}

/* Where rays meet a flank near q[3*count]: no number means nowhere. */
static void rays(reader *r, fuzzed *f, mw_surface flank, int count, int outputs, const double *q)
{
    double *from = numbers(9), *along = numbers(9), *found = numbers((size_t)count * 3), *o = numbers((size_t)outputs + 1), *distance = numbers(3);
    for (int i = 0; i < 9; i++) from[i] = number(r, 1.0), along[i] = number(r, i % 4 == 0);
    memcpy(found, q, sizeof *q * (size_t)count * 3);
    const double longest = number(r, 8.0), farthest = number(r, 100.0);
    const int status = mw_rays(flank, count, outputs, f->s, from, along, 3, longest, farthest, o, found, distance);
    if (!outputs && status != MW_BAD_INPUT) fail("rays to a surface without outputs");
    note_numbers(r, found, (size_t)count * 3);
}

/* Places near q[3*count] with given coordinates, one of them a parameter: no number means none, and each one found has it. */
static void across(reader *r, fuzzed *f, mw_surface flank, int count, int outputs, const double *q)
{
    double *sizes = numbers((size_t)count), *at = numbers(6), *found = numbers((size_t)count * 3), *o = numbers((size_t)outputs);
    double *factors = numbers(2 * (size_t)(count + 4));
    const int profile = byte(r) % count;
    for (int i = 0; i < count; i++) sizes[i] = number(r, 1.0);
    for (int i = 0; i < 6; i++) at[i] = number(r, q[i % count]);
    for (int i = 0; i < count + 4; i++) factors[i] = i == profile, factors[count + 4 + i] = number(r, 0.0);
    const mw_coordinates by = { flank, count, outputs - (byte(r) % 8 ? 0 : outputs), 0, sizes, factors };
    memcpy(found, q, sizeof *q * (size_t)count * 3);
    const int status = mw_places(&by, f->s, at, 3, o, found);
    if (!by.outputs && status != MW_BAD_INPUT) fail("places on a surface without outputs");
    for (int i = 0; status == MW_CONVERGED && i < 3; i++) {
        const double off = fabs(found[i * count + profile] - at[2 * i]);
        if (off > 1e-6 * (1.0 + fabs(at[2 * i]))) fail("a place beside its coordinate");
    }
    note_numbers(r, found, (size_t)count * 3);
    rays(r, f, flank, count, by.outputs, q);
}

/* The functions of the table themselves; each counts as a call of the interface. */
static void table(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    const size_t nx = (size_t)m->nx;
    double *R = numbers(nx), *J = numbers(nx * nx), *o = numbers((size_t)m->no), *x = start(r, f), *y = numbers(MW_MAX_UNKNOWNS);
    double *again = numbers(nx), *v = numbers(nx + 1), *d2 = numbers(nx), *scale = numbers(nx), *d = numbers((size_t)m->nd);
    const double phi = angle(r);
    m->set_phi(f->s, phi);
    for (size_t i = 0; i <= nx; i++) v[i] = number(r, i == nx);
    for (unsigned k = 0, n = 1 + byte(r) % 64; k < n; k++) {
        const size_t moved = k % nx; /* a walk of its own, from where the bytes begin */
        x[moved] += 1e-3 * scattered(r) * (1.0 + fabs(f->from->x[moved]));
        m->eval(f->s, x, R, NULL);
        m->eval(f->s, x, again, J);
        for (size_t i = 0; i < nx; i++)
            if (memcmp(R + i, again + i, sizeof *R) && (R[i] == R[i] || again[i] == again[i])) fail("R depends on J");
        m->observe(f->s, x, o);
        m->scale(f->s, scale);
        mw_touch(m, x, o);
        m->along(f->s, phi, x, v, R, NULL);
        m->along(f->s, phi, x, v, again, d2);
        note_numbers(r, o, (size_t)m->no);
        note_numbers(r, J, nx * nx);
        note_numbers(r, d2, nx);
        calls += 7;
    }
    double *at = numbers((size_t)m->nanchor);
    m->anchor(f->s, phi, x, at);
    m->by_anchor(f->s, at, phi, x, R);
    note_numbers(r, R, nx);
    const double length = m->step(f->s, x);
    note_numbers(r, &length, 1);
    note_numbers(r, x, nx);
    m->size(f->p, d);
    m->guess(f->s, y);
    m->start_scale(f->s, y);
    m->guess(f->s, y);
    m->start_eval(f->s, y, numbers(MW_MAX_UNKNOWNS), numbers(MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS));
    m->start_solution(f->s, y, x);
    calls += 9;
    for (int b = 0; b < 2 + m->nregions; b++) {
        const mw_surface flank = b < 2 ? m->bodies[b].flank : m->regions[b - 2].flank;
        const mw_surface curvature = b < 2 ? m->bodies[b].curvature : m->regions[b - 2].curvature;
        const int count = b < 2 ? m->bodies[b].parameters : m->regions[b - 2].parameters;
        const int outputs = b < 2 ? m->bodies[b].outputs : m->regions[b - 2].outputs;
        double *q = numbers((size_t)count * 3), *of = numbers((size_t)outputs * 3);
        for (int i = 0; i < 3 * count; i++)
            q[i] = number(r, b < 2 ? f->from->x[m->bodies[b].unknowns[i % count]] : f->from->x[i % (int)nx]);
        mw_flank(flank, count, outputs, f->s, q, 3, of);
        across(r, f, flank, count, outputs, q);
        calls += 2;
        if (curvature) curvature(f->s, q, numbers(16)), calls++;
    }
    for (int k = 0; k < m->nfunctions; k++) {
        double *q = numbers((size_t)m->functions[k].arguments);
        for (int i = 0; i < m->functions[k].arguments; i++) q[i] = number(r, 0.3);
        m->functions[k].evaluate(f->s, q, numbers((size_t)m->functions[k].outputs));
        calls++;
    }
}

static void one(reader *r, fuzzed *f)
{
    const double phi = angle(r);
    double *x = numbers((size_t)f->m->nx), *y = numbers((size_t)f->m->nx);
    mw_info *info = room(2, sizeof *info);
    const int first = mw_solve(f->m, f->p, phi, f->s, f->work, x, info);
    judge(r, f->m, f->s, phi, x, first);
    if (byte(r) % 4 == 0) {
        if (mw_solve(f->m, f->p, phi, f->s, f->work, y, info + 1) != first) fail("two equal calls end in different ways");
        for (int i = 0; i < f->m->nx; i++)
            if (x[i] != y[i] && x[i] == x[i]) fail("two equal calls give different numbers");
        calls++;
    }
    calls++;
}

static void alone(reader *r, fuzzed *f)
{
    const double phi = angle(r);
    double *x = numbers((size_t)f->m->nx);
    f->m->setup(f->p, f->s);
    judge(r, f->m, f->s, phi, x, f->from->solve(f->s, phi, x, NULL));
    calls += 2;
}

static void refine(reader *r, fuzzed *f)
{
    double *x = start(r, f), phi = angle(r);
    mw_info *info = room(1, sizeof *info);
    f->m->set_phi(f->s, phi);
    if (mw_refine(f->m, f->s, x, info) >= 0) must_touch(f->m, f->s, x);
    note(r, &info->status, sizeof info->status);
    calls += 2;
}

static void trace(reader *r, fuzzed *f, int analyse)
{
    const mw_model *m = f->m;
    const size_t n = 1 + byte(r) % POINTS, nx = (size_t)m->nx, no = (size_t)m->no;
    double *phi = numbers(n), *x = numbers(n * nx), *o = numbers(n * no);
    mw_info *info = room(n, sizeof *info);
    mw_contact *contact = room(n, sizeof *contact);
    angles(r, phi, n);
    size_t count = 0;
    const size_t good = analyse ? mw_analyse(m, f->p, phi, n, f->s, f->work, x, info, o, contact)
                                : mw_trace(m, f->p, phi, n, f->s, f->work, x, info);
    calls++;
    m->setup(f->p, f->s);
    for (size_t k = 0; k < n; k++) {
        judge(r, m, f->s, phi[k], x + k * nx, info[k].status);
        count += info[k].status >= 0;
        if (analyse && info[k].status >= 0) must_be_flagged(m, o + k * no, contact + k);
        if (analyse && info[k].status < 0 && contact[k].point[0] == contact[k].point[0]) fail("a point of no contact");
    }
    if (count != good) fail("the successes are not as many as was said");
    if (analyse || good == 0) return;
    for (size_t k = 0; k < n; k++) {
        if (info[k].status < 0) continue;
        m->set_phi(f->s, phi[k]);
        if (mw_contact_at(m, f->s, x + k * nx, o, contact) < 0) fail("a contact whose geometry is none");
        must_be_flagged(m, o, contact);
        calls++;
        break;
    }
    mw_contacts(m, f->s, phi, n, x, info, o, contact);
    for (size_t k = 0; k < n; k++)
        if (info[k].status >= 0) must_be_flagged(m, o + k * no, contact + k);
    calls++;
}

static void follow(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    const size_t n = 1 + byte(r) % POINTS, nx = (size_t)m->nx;
    double *phi = numbers(n), *x = numbers(n * nx), *x0 = start(r, f), at = number(r, f->from->phi);
    mw_info *info = room(n, sizeof *info);
    angles(r, phi, n);
    if (byte(r) < 64) phi[0] = at;
    const size_t good = mw_follow(m, f->s, at, x0, phi, n, x, info);
    calls++;
    if (good < n && info[good].status >= 0) fail("a branch that ends without a reason");
    for (size_t k = 0; k < good; k++) judge(r, m, f->s, phi[k], x + k * nx, info[k].status);
    double *o = numbers(n * (size_t)m->no);
    int *node = room(n, sizeof *node);
    for (size_t k = 0; k < n; k++) node[k] = byte(r) % 2 ? -1 : 0;
    const size_t each = mw_from_nodes(m, f->s, &at, x0, 1, node, phi, n, x, info);
    size_t count = 0;
    for (size_t k = 0; k < n; k++) count += info[k].status >= 0;
    if (count != each) fail("the points of a branch are not as many as was said");
    if (mw_observe(m, f->s, phi, x, n, o) == MW_BAD_INPUT) fail("a table that is refused");
    double pair;
    const size_t turned = mw_turn(m, f->p, phi, n, f->s, f->work, x, info);
    for (size_t k = count = 0; k < n; k++) {
        count += info[k].status >= 0;
        const double own = mw_reduce(m, f->p, phi[k], &pair);
        if (info[k].guard == 0 && info[k].angle != own && own == own) fail("two calls that reduce an angle differ");
        judge(r, m, f->s, info[k].angle, x + k * nx, info[k].status);
    }
    if (count != turned) fail("the contacts of a turning drive are not as many as was said");
    m->setup(f->p, f->s);
    calls += 2;
}

/* The whole drive, its other flank of any parameters. */
static void cycle(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    const size_t n = 1 + byte(r) % POINTS;
    double *phi = numbers(n), *c = numbers((size_t)mw_cycle_size(m));
    mw_cycle *found = room(n, sizeof *found);
    size_t touching = 0;
    angles(r, phi, n);
    mw_cycle_setup(m, f->p, byte(r) % 2 ? f->p : NULL, c);
    const size_t count = mw_cycles(m, c, phi, n, found);
    for (size_t k = 0; k < n; k++) {
        touching += found[k].drive.status >= 0;
        if ((found[k].drive.status >= 0) != (found[k].drive.error == found[k].drive.error)) fail("an error without a contact");
    }
    if (touching != count) fail("the contacts of a whole drive are not as many as was said");
    calls += 2;
}

static void arc(reader *r, fuzzed *f)
{
    const size_t n = byte(r) % POINTS, nx = (size_t)f->m->nx;
    double *phi = numbers(n + 1), *x = numbers((n + 1) * nx), *slope = numbers(n + 1), *determinant = numbers(n + 1);
    double *from = start(r, f), begin = number(r, f->from->phi), step = number(r, 0.1);
    const size_t good = mw_arclength(f->m, f->s, begin, from, step, n, phi, x, slope, determinant);
    if (good > n + 1) fail("more points than asked for");
    note_numbers(r, phi, good);
    note_numbers(r, determinant, good);
    double *border = numbers(2 * nx);
    for (size_t i = 0; i < 2 * nx; i++) border[i] = number(r, i % nx ? 0.1 : 1.0);
    memcpy(x, from, nx * sizeof *x);
    f->m->set_phi(f->s, begin);
    const size_t along = mw_line(f->m, f->s, border, step, n, x);
    if (along > n + 1) fail("more points of a line than asked for");
    note_numbers(r, x, along * nx);
    calls += 2;
}

static void branch(reader *r, fuzzed *f)
{
    double *x = start(r, f), phi = number(r, f->from->phi), before = phi;
    const int ended_as = mw_branch_point(f->m, f->s, byte(r) & 1, &phi, x);
    if (ended_as < 0 && memcmp(&phi, &before, sizeof phi)) fail("an angle changed where there is no singular point");
    note(r, &ended_as, sizeof ended_as);
    calls++;
}

static void in_lanes(reader *r, fuzzed *f)
{
#ifdef MW_FUZZ_EXACT
    static const int widths[] = { 2, 2, 2, 2, -1, 3 }; /* those of which the same bits are promised everywhere */
#else
    static const int widths[] = { 0, 2, 4, 8, -1, 3 };
#endif
    const mw_model *m = f->m;
    const mw_lane_set *set = mw_lanes(widths[byte(r) % 6]);
    const size_t n = 1 + byte(r) % POINTS, nx = (size_t)m->nx, designs = 1 + byte(r) % 3, np = (size_t)m->np;
    calls++;
    if (!set) return;
    if (mw_lanes_width(set) < 2 || !mw_lanes_name(set)) fail("a lane set without width or name");
    double *phi = numbers(n), *p = numbers(designs * np), *x = numbers(designs * n * nx), *first = start(r, f);
    double *work = numbers(mw_lanes_work(set, m, n)), *points = numbers(designs * n * 3), *o = numbers((size_t)m->no);
    int *status = room(designs * n, sizeof *status);
    unsigned *flags = room(designs * n, sizeof *flags);
    angles(r, phi, n);
    size_t count = 0;
    for (size_t d = 0; d < designs; d++) {
        memcpy(p + d * np, f->p, np * sizeof *p);
        if (d) {
            double *changed = p + d * np + byte(r) % np;
            *changed = number(r, f->p[0]);
        }
    }
    if (byte(r) & 1) {
        const size_t good = mw_trace_angles(set, m, f->p, phi, n, work, x, status);
        m->setup(f->p, f->s);
        for (size_t k = 0; k < n; k++) count += status[k] >= 0;
        for (size_t k = 0; k < n; k++) judge(r, m, f->s, phi[k], x + k * nx, status[k]);
        if (count != good) fail("lanes: the successes are not as many as was said");
        calls++;
        return;
    }
    const size_t good = mw_trace_designs(set, m, p, designs, phi, n, first, work, x, status);
    for (size_t d = 0; d < designs; d++) {
        if (m->setup(p + d * np, f->s)) continue;
        for (size_t k = 0; k < n; k++) judge(r, m, f->s, phi[k], x + (d * n + k) * nx, status[d * n + k]);
    }
    for (size_t k = 0; k < designs * n; k++) count += status[k] >= 0;
    if (count != good) fail("lanes: the successes are not as many as was said");
    mw_contact_points(m, p, designs, phi, n, x, status, f->s, o, points, flags);
    for (size_t k = 0; k < designs * n; k++)
        if (status[k] < 0 && (points[3 * k] == points[3 * k] || flags[k])) fail("a point of no contact");
    m->setup(f->p, f->s);
    calls += 2;
}

static void tangents(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    const size_t np = (size_t)m->np, nx = (size_t)m->nx;
    double *dp = numbers(np), *dx = numbers(nx), *dr = numbers(9), *x = start(r, f), phi = number(r, f->from->phi);
    const int body = (int)(byte(r) % 4) - 1;
    const size_t count = body == 0 || body == 1 ? (size_t)m->bodies[body].parameters : 1;
    double *q = numbers(3 * count);
    for (size_t i = 0; i < 3 * count; i++) q[i] = number(r, f->from->x[i % nx]);
    m->set_phi(f->s, phi);
    double *change = changes(r, m->np);
    if (f->completed) mw_sensitivity(m, f->given, f->p, phi, f->s, x, change, dp, dx, dr);
    mw_contact_tangent(m, f->p, change, phi, number(r, 0.0), f->s, x, dx, dr);
    mw_contact_motion(m, f->p, &phi, 1, x, numbers((size_t)m->ns), numbers(np + nx), dr);
    mw_flank_tangent(m, body, f->p, change, q, 3, dr);
    if (f->completed) mw_complete_tangent(m, f->given, f->p, change);
    calls += 5;
}

static void words(reader *r, fuzzed *f)
{
    unsigned bits = 0;
    for (int i = 0; i < 4; i++) bits = bits << 8 | byte(r);
    const int any = (int)(bits - 0x80000000u), some = (int)byte(r) - 32;
    if (!mw_status_word(any) || !mw_status_text(any) || !mw_status_word(some) || !mw_status_text(some)) fail("no word");
    mw_flag(f->m, any), mw_flag(f->m, some);
    if (mw_model_at(any) && (any < 0 || any >= mw_model_count())) fail("a model that is none");
    if (mw_abi() != MW_MODEL_ABI) fail("another version");
    if (!mw_reason_word(any) || !mw_reason_text(any) || !*mw_reason_text((int)((unsigned)some % MW_REASON_END))) fail("no reason");
    mw_model_at(some), mw_find(""), mw_lanes(any), mw_lanes(some);
    if (mw_find("no such drive")) fail("a drive of another name");
    calls += 15;
}

#include "proofs.h"

/* No table, one of another version, or larger than the solver's arrays: refused by all. */
static void foreign(reader *r, fuzzed *f)
{
    mw_model other = *f->m;
    const unsigned which = byte(r) % 6;
    int *const field[] = { &other.abi, &other.nx, &other.np, &other.no, &other.nstart, &other.nanchor };
    static const int most[] = { MW_MODEL_ABI,       MW_MAX_UNKNOWNS, MW_MAX_PARAMETERS,
                                MW_MAX_OBSERVATION, MW_MAX_UNKNOWNS, MW_MAX_ANCHOR };
    const int excess = 1 + (int)byte(r) * 8388608;
    *field[which] = byte(r) & 1 ? most[which] + excess : which == 0 ? MW_MODEL_ABI - excess : -excess;
    double *x = start(r, f), *o = numbers((size_t)f->m->no), *change = changes(r, f->m->np), phi = 0.1;
    const mw_model *const wrong = byte(r) & 1 ? &other : NULL;
    mw_info info;
    mw_contact contact;
    int refused = mw_solve(wrong, f->p, phi, f->s, f->work, x, &info) == MW_BAD_INPUT;
    refused += mw_refine(wrong, f->s, x, &info) == MW_BAD_INPUT;
    refused += mw_touch(wrong, x, o) == MW_BAD_INPUT;
    refused += mw_contact_at(wrong, f->s, x, o, &contact) == MW_BAD_INPUT;
    refused += mw_branch_point(wrong, f->s, 0, &phi, x) == MW_BAD_INPUT;
    refused += mw_contact_tangent(wrong, f->p, change, phi, 0.0, f->s, x, o, o) == MW_BAD_INPUT;
    refused += mw_complete_tangent(wrong, f->given, f->p, change) == MW_BAD_INPUT;
    refused += mw_flank_tangent(wrong, 0, f->p, change, f->from->x, 1, o) == MW_BAD_INPUT;
    refused += mw_complete(wrong, f->p, f->work, &info) != 0 && info.status == MW_BAD_INPUT;
    refused += mw_follow(wrong, f->s, phi, x, &phi, 1, x, &info) == 0 && info.status == MW_BAD_INPUT;
    refused += mw_from_nodes(wrong, f->s, &phi, x, 1, &(int){0}, &phi, 1, x, &info) == 0;
    refused += mw_observe(wrong, f->s, &phi, x, 1, o) == MW_BAD_INPUT;
    refused += mw_arclength(wrong, f->s, phi, x, 0.1, 1, o, x, o, o) == 0;
    refused += mw_line(wrong, f->s, o, 0.1, 1, x) == 0;
    refused += mw_trace(wrong, f->p, &phi, 1, f->s, f->work, x, &info) == 0 && info.status == MW_BAD_INPUT;
    refused += mw_analyse(wrong, f->p, &phi, 1, f->s, f->work, x, &info, o, &contact) == 0 && info.status == MW_BAD_INPUT;
    info.status = MW_CONVERGED;
    mw_contacts(wrong, f->s, &phi, 1, x, &info, o, &contact);
    refused += info.status == MW_BAD_INPUT;
    info.status = MW_CONVERGED;
    mw_contact_points(wrong, f->p, 1, &phi, 1, x, &info.status, f->s, o, contact.point, &contact.flags);
    refused += info.status == MW_BAD_INPUT;
    if (refused != 18) fail("a foreign table is not refused");
    calls += 17;
    without_proofs(r, f, &other);
    other = *f->m;
    other.kernels = NULL; /* the header alone */
    without_proofs(r, f, &other);
    if (mw_flank_tangent(&other, 0, f->p, change, f->from->x, 1, o) != MW_BAD_INPUT) fail("tangents of a header alone");
}

/* The curves through a place of first contact. */
static void along(reader *r, fuzzed *f, const mw_flank_mesh *mesh, const double *pinion, const double *wheel, double turn,
                  double sense, const mw_first *at)
{
    enum { PLACES = 6 };
    mw_first *found = room(2 * PLACES + 1, sizeof *found);
    double *work = numbers(mw_first_curve_work(PLACES)), depth = 0.0;
    const int member = (int)(byte(r) % 4) - 1, limit = (int)(byte(r) % 6) - 1;
    const double step = number(r, 0.125), fall = number(r, HUGE_VAL);
    const size_t n = mw_first_curve(f->m, f->s, mesh, pinion, wheel, turn, sense, at, member, limit, step, fall, PLACES, work, found);
    if (n > 2 * PLACES + 1) fail("a curve of more places than there is room for");
    for (size_t k = 0; k < n; k++)
        if (!(fabs(found[k].wheel_turn) < HUGE_VAL)) fail("a place of a curve without an angle");
    const int status = mw_first_deepest(f->m, f->s, mesh, pinion, wheel, turn, sense, at, step, &depth, found);
    if (status >= 0 && !(depth == depth)) fail("a deepest place without a depth");
    calls += 2;
}

/* What was found at one angle, followed over others, and asked whether it leads between three that are alike. */
static void between(reader *r, fuzzed *f, const mw_flank_mesh *mesh, const double *pinion, const double *wheel, size_t steps,
                    double turn, double sense, const mw_first *at, double *work)
{
    double *three[2] = { numbers(36), numbers(36) }, *met[3] = { work, work, work };
    mw_first *found = room(steps + 3, sizeof *found);
    for (int k = 0; k < 3; k++) {
        memcpy(three[0] + 12 * k, pinion + 12 * (steps - 1), 12 * sizeof *pinion);
        memcpy(three[1] + 12 * k, wheel + 12 * (steps - 1), 12 * sizeof *wheel);
        found[steps + (size_t)k] = *at;
    }
    const double share = number(r, 0.5);
    mw_first_lasts(f->m, f->s, mesh, three[0], three[1], share, turn, sense, met, found + steps, numbers(mw_first_lasts_work()));
    const size_t count = mw_first_along(f->m, f->s, mesh, pinion, wheel, steps, turn, sense, at, found);
    if (count > steps) fail("more first contacts than angles");
    calls += 2;
}

static void first(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    const first_seed *from = f->from->first;
    if (!from) return;
    const size_t parameters = (size_t)m->bodies[1].parameters, numbers_of = parameters + (size_t)m->bodies[0].parameters + 1;
    mw_flank_mesh mesh = from->mesh;
    double *q = numbers(mesh.vertices * parameters), *pinion = numbers(12 * from->steps), *wheel = numbers(12 * from->steps);
    double *begin = numbers(numbers_of), *work = numbers(mw_first_contact_work(mesh.vertices));
    memcpy(q, mesh.q, mesh.vertices * parameters * sizeof *q);
    memcpy(pinion, from->pinion, 12 * from->steps * sizeof *q);
    memcpy(wheel, from->wheel, 12 * from->steps * sizeof *q);
    memcpy(begin, from->start, numbers_of * sizeof *q);
    mesh.q = q;
    for (unsigned k = byte(r) % 4; k > 0; k--) {
        const unsigned which = byte(r) % 4, i = byte(r);
        if (which == 0) q[i % (mesh.vertices * parameters)] = number(r, q[i % (mesh.vertices * parameters)]);
        if (which == 1) pinion[i % (12 * from->steps)] = number(r, pinion[i % (12 * from->steps)]);
        if (which == 2) wheel[i % (12 * from->steps)] = number(r, wheel[i % (12 * from->steps)]);
        if (which == 3) begin[i % numbers_of] = number(r, begin[i % numbers_of]);
    }
    if (byte(r) > 240) {
        int *which = mesh.span + byte(r) % 2;
        *which = (int)(byte(r) % 5) - 2;
    }
    mw_first *found = room(1, sizeof *found);
    const double turn = number(r, from->turn), sense = number(r, from->sense), until = number(r, -sense * HUGE_VAL);
    const int status = mw_first_contact(m, f->s, &mesh, pinion, wheel, from->steps, turn, sense, begin, until, work, found);
    if (status != found->status) fail("first contact: two words for one end");
    if (status >= 0 && !(fabs(found->wheel_turn) < HUGE_VAL)) fail("first contact without an angle");
    ended[(status + 8) & 15]++;
    calls++;
    if (status >= 0) between(r, f, &mesh, pinion, wheel, from->steps, turn, sense, found, work);
    if (status >= 0) along(r, f, &mesh, pinion + 12 * (from->steps - 1), wheel + 12 * (from->steps - 1), turn, sense, found);
}

/* The drive's entries for CasADi; any argument or result may be absent. */
static void entries(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    const size_t np = (size_t)m->np, nx = (size_t)m->nx, most = np * np + np * nx + nx * nx;
    const int which = (int)(byte(r) % 5) - 1;
    const unsigned absent = byte(r);
    const double phi = angle(r), *x = start(r, f);
    double *results = numbers(most);
    const double *complete[] = { f->given, f->p }, *contact[] = { f->p, &phi, x, x };
    const double **arg = which == 0 || which == 2 ? complete : contact;
    double *res[] = { results, numbers(nx), NULL };
    for (int i = 0; i < (arg == complete ? 2 : 4); i++)
        if (absent >> i & absent >> 7 & 1u) arg[i] = NULL;
    if (absent >> 5 & absent >> 7 & 1u) res[0] = NULL;
    if (absent >> 6 & absent >> 7 & 1u) res[1] = NULL;
    if (which == 2 && !f->completed) return;
    const int refused = f->from->entry(which, arg, res, numbers(np + 1 + (size_t)m->ns));
    if (which < 0 && refused) fail("an entry for CasADi has a name too many or too few");
    if (which == 1 && !refused && res[0]) {
        m->set_phi(f->s, arg[1] ? phi : 0.0);
        int numbers_of_x = 0;
        for (size_t i = 0; i < nx; i++) numbers_of_x += res[0][i] == res[0][i];
        if (numbers_of_x == m->nx) must_touch(m, f->s, res[0]);
        else if (numbers_of_x) fail("numbers where there is no contact");
    }
    note(r, &refused, sizeof refused);
    calls++;
}

static uint64_t run(const uint8_t *data, size_t size)
{
    reader r = { data, data + size, 14695981039346656037u };
    fuzzed f;
    inputs++;
    for (int k = 0; k < CALLS && (k == 0 || r.at < r.end); k++) {
        const int ready = design(&r, &f);
        const unsigned kind = ready ? byte(&r) % KINDS : 0;
        const unsigned long long before = calls;
        if (ready) {
            switch (kind) {
            case 0: case 1: case 2: table(&r, &f); break;
            case 3: one(&r, &f); break;
            case 4: alone(&r, &f); break;
            case 5: refine(&r, &f); refine(&r, &f); break;
            case 6: trace(&r, &f, 0); break;
            case 7: trace(&r, &f, 1); break;
            case 8: follow(&r, &f); break;
            case 9: arc(&r, &f); break;
            case 10: branch(&r, &f); branch_proof(&r, &f); break;
            case 11: in_lanes(&r, &f); break;
            case 12: tangents(&r, &f); break;
            case 13: words(&r, &f); break;
            case 14: foreign(&r, &f); break;
            case 15: entries(&r, &f); break;
            case 16: edges(&r, &f); break;
            case 17: bounds(&r, &f); break;
            case 18: certificate(&r, &f); break;
            case 19: certificates(&r, &f); break;
            case 20: path(&r, &f); break;
            case 21: first(&r, &f); break;
            case 22: cycle(&r, &f); break;
            default: break;
            }
        }
        of_kind[kind] += calls - before;
        while (used) free(rooms[--used]);
    }
#ifdef MW_FUZZ_SHOW
    fprintf(stderr, "input %llu %016llx\n", inputs, (unsigned long long)r.digest);
#endif
    all = all * 1099511628211u + r.digest;
    return r.digest;
}

static void report(void)
{
    fprintf(stderr, "fuzz: digest %016llx\n", (unsigned long long)all);
    fprintf(stderr, "fuzz: %llu inputs, %llu calls, %llu successes looked at\n", inputs, calls, successes);
    for (int i = 2; i < KINDS; i++) {
        const unsigned long long all_of = of_kind[i] + (i == 2 ? of_kind[0] + of_kind[1] : 0);
        if (all_of) fprintf(stderr, "fuzz: %llu calls of %s\n", all_of, kinds[i]);
    }
    fprintf(stderr, "fuzz: %llu calls of mw_certify_first\n", first_proofs);
    for (int i = 0; i < 16; i++)
        if (ended[i]) fprintf(stderr, "fuzz: %llu ended as %s\n", ended[i], mw_status_word(i - 8));
}

#ifndef MW_FUZZ_ALONE
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc, (void)argv;
    return atexit(report);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    run(data, size);
    return 0;
}
#else
#ifndef __wasi__
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>
#endif

enum { LONGEST = 384 };

/* Input number k of a seed. */
static size_t made(uint64_t seed, uint64_t k, uint8_t *data)
{
    uint64_t state = seed * 0x9e3779b97f4a7c15u + k * 0xd1342543de82ef95u + 1u;
    const size_t size = 16 + (size_t)(k * 7919u % (LONGEST - 16));
    for (size_t i = 0; i < size; i++) {
        state ^= state << 13, state ^= state >> 7, state ^= state << 17;
        data[i] = (uint8_t)(state >> 32);
    }
    return size;
}

#ifdef MW_FUZZ_THREADS
#include <pthread.h>

typedef struct part {
    uint64_t seed, count, *digest;
    int which;
} part;

/* Every thread runs every input, each beginning elsewhere; their results are the same. */
static void *thread(void *given)
{
    const part *own = given;
    uint8_t data[LONGEST];
    for (uint64_t k = 0; k < own->count; k++) {
        const uint64_t at = (k + own->count * (uint64_t)own->which / MW_FUZZ_THREADS) % own->count;
        own->digest[at] = run(data, made(own->seed, at, data));
    }
    report();
    return NULL;
}

static void run_all(uint64_t seed, uint64_t begin, uint64_t count)
{
    pthread_t threads[MW_FUZZ_THREADS];
    part parts[MW_FUZZ_THREADS];
    (void)begin;
    for (int t = 0; t < MW_FUZZ_THREADS; t++) {
        parts[t] = (part){ seed, count, malloc(count * sizeof(uint64_t)), t };
        if (pthread_create(&threads[t], NULL, thread, &parts[t])) fail("no thread");
    }
    for (int t = 0; t < MW_FUZZ_THREADS; t++) pthread_join(threads[t], NULL);
    for (uint64_t k = 0; k < count; k++)
        for (int t = 1; t < MW_FUZZ_THREADS; t++)
            if (parts[t].digest[k] != parts[0].digest[k]) fail("threads find different results");
    for (int t = 0; t < MW_FUZZ_THREADS; t++) free(parts[t].digest);
}
#else
static uint64_t current;

#ifndef __wasi__
static void hang(int number)
{
    (void)number;
    fprintf(stderr, "fuzz: input %llu hangs\n", (unsigned long long)current);
    _exit(3);
}
#endif

static void run_all(uint64_t seed, uint64_t begin, uint64_t count)
{
#ifndef __wasi__
    /* ten seconds of the program's own time, which a sanitizer makes up to three times longer */
    const struct itimerval limit = { { 0, 0 }, { 30, 0 } };
    signal(SIGPROF, hang);
#endif
    for (current = begin; current < begin + count; current++) {
        uint8_t *data = malloc(LONGEST);
#ifndef __wasi__
        setitimer(ITIMER_PROF, &limit, NULL);
#endif
        run(data, made(seed, current, data));
        free(data);
    }
    report();
}
#endif

int main(int argc, char **argv)
{
    const uint64_t seed = argc > 1 ? strtoull(argv[1], NULL, 10) : 0, count = argc > 2 ? strtoull(argv[2], NULL, 10) : 1000;
    run_all(seed, argc > 3 ? strtoull(argv[3], NULL, 10) : 0, count);
    return 0;
}
#endif
