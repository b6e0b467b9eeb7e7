/* Calls of edges, limits and certified contact, for interface.c, which includes this.  SPDX-License-Identifier: MIT-0
 *
 * What is called a success is held against both surfaces in floating point; what is proved, against what the solver finds. */

/* Both bodies have the point in common, each on the edge that the system names. */
static void must_meet(const mw_model *m, const double *s, const double *x, const int *margin)
{
    double *o = numbers((size_t)m->no), gap = 0.0;
    m->observe(s, x, o);
    for (int i = 0; i < 3; i++) gap = fmax(gap, fabs(o[i] - o[6 + i]));
    const double size = 1.0 + extent(o) + extent(o + 6);
    if (!(gap <= 1e-8 * size)) fail("an edge that is apart from its mate");
    for (int b = 0; b < 2; b++)
        if (margin && margin[b] >= 0 && !(fabs(o[m->bodies[b].margin + margin[b]]) <= 1e-7 * size)) fail("a contact off its edge");
    for (int i = 0; i < m->nx; i++)
        if (!(x[i] >= m->unknowns[i].lower && x[i] <= m->unknowns[i].upper)) fail("a contact of an edge beyond the flanks");
    successes++;
}

static void edges(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    const size_t nx = (size_t)m->nx, n = 1 + byte(r) % POINTS;
    const edge_seed *from = f->from->nedges ? f->from->edges + byte(r) % (unsigned)f->from->nedges : NULL;
    const unsigned how = byte(r);
    int margin[2];
    for (int b = 0; b < 2; b++)
        margin[b] = from && how < 192 ? from->margin[b] : (int)(byte(r) % (unsigned)(m->bodies[b].margins + 3)) - 2;
    const int named = mw_edge(m, margin[0], margin[1]), edge = how < 240 ? named : (int)byte(r) - 64;
    double *x = start(r, f), *R = numbers(nx), *again = numbers(nx), *J = numbers(nx * nx), *phi = numbers(n), *along = numbers(n * nx);
    mw_info *info = room(n, sizeof *info);
    double at = number(r, from ? from->phi : f->from->phi);
    for (size_t i = 0; from && how < 192 && i < nx; i++) x[i] = number(r, from->x[i]);
    m->set_phi(f->s, at);
    const int possible = mw_edge_eval(m, edge, f->s, x, R, J) == MW_CONVERGED;
    if (possible != (mw_edge_eval(m, edge, f->s, x, again, NULL) == MW_CONVERGED)) fail("an edge that comes and goes");
    if (edge < 0 && possible) fail("an edge of no number");
    for (size_t i = 0; possible && i < nx; i++)
        if (memcmp(R + i, again + i, sizeof *R) && (R[i] == R[i] || again[i] == again[i])) fail("R of an edge depends on J");
    const int solved_as = mw_edge_solve(m, edge, f->s, x, info);
    if (solved_as != info->status) fail("an edge: two words for one end");
    if (solved_as >= 0) must_meet(m, f->s, x, edge == named ? margin : NULL);
    ended[(solved_as + 8) & 15]++;
    note(r, &solved_as, sizeof solved_as);
    angles(r, phi, n);
    for (size_t k = 0; how % 2 && k < n; k++) phi[k] = at + (phi[k] - phi[0]);
    const size_t good = mw_edge_follow(m, edge, f->s, at, x, phi, n, along, info);
    if (good > n) fail("more points of an edge than asked for");
    if (good < n && info[good].status >= 0) fail("an edge that ends without a reason");
    for (size_t k = 0; k < good; k++) {
        m->set_phi(f->s, phi[k]);
        must_meet(m, f->s, along + k * nx, edge == named ? margin : NULL);
    }
    note_numbers(r, along, good * nx);
    calls += 5;
}

/* Numbers that mw_bounds writes for a place of a surface, or 0 where there is no such function. */
static size_t limits_of(const mw_model *m, int surface, int order, int *parameters)
{
    *parameters = 1;
    if (surface < 0 || surface >= 2 + m->nregions || order < 1 || order > 2) return 0;
    const mw_body *body = surface < 2 ? m->bodies + surface : NULL;
    const mw_region *region = body ? NULL : m->regions + (surface - 2);
    const int k = body ? body->parameters : region->parameters, c = body ? body->conditions : region->conditions;
    const int limits = (body ? body->outputs : region->outputs) - 6 - 3 * k - c * (1 + k);
    *parameters = k;
    return (size_t)(order == 1 ? limits * k : (3 + limits + c) * (k * (k + 1) / 2));
}

static void bounds(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    const int surface = (int)(byte(r) % (unsigned)(5 + m->nregions)) - 1, order = (int)(byte(r) % 8) % 4;
    int k;
    const size_t each = limits_of(m, surface, order, &k), n = byte(r) % 4;
    double *q = numbers(n * (size_t)k), *o = numbers(n * each);
    for (size_t i = 0; i < n * (size_t)k; i++)
        q[i] = number(r, f->from->x[surface == 0 || surface == 1 ? m->bodies[surface].unknowns[i % (size_t)k] : (int)(i % (size_t)m->nx)]);
    m->set_phi(f->s, angle(r));
    const int status = mw_bounds(m, surface, order, f->s, q, n, o);
    if (status >= 0 && each == 0) fail("limits of no surface");
    if (status < 0 && each && order == 1) fail("a surface without slopes of its limits");
    if (status >= 0) note_numbers(r, o, n * each);
    calls += 2;
}

/* The design with the error bounds of its state; nonzero if all that follows from it is enclosed, hardly wider than rounding. */
static int enclosed(reader *r, fuzzed *f, mw_wide *s)
{
    const mw_model *m = f->m;
    mw_wide *p = room((size_t)m->np, sizeof *p);
    const unsigned how = byte(r);
    for (int i = 0; i < m->np; i++) {
        p[i].hi = f->given[i] / m->parameters[i].factor;
        p[i].lo = 0.0;
        p[i].radius = how < 64 ? fabs(p[i].hi) * 1e-16 : 0.0;
    }
    if (how > 240) {
        mw_wide *wider = p + byte(r) % (unsigned)m->np;
        wider->radius = fabs(number(r, 1e-9));
    }
    const int failed = mw_enclose_design(m, p, numbers((size_t)m->np + 1));
    if (failed < 0 || failed > m->nsystems + 1) fail("a design system of no number");
    mw_enclose_setup(m, p, s);
    calls += 2;
    return !failed && how <= 240;
}

static mw_wide *enclosed_state(reader *r, fuzzed *f, int *all)
{
    mw_wide *s = room((size_t)mw_enclosed_slots(f->m), sizeof *s);
    if (!mw_encloses(f->m)) fail("a drive that cannot be enclosed");
    *all = enclosed(r, f, s);
    calls += 2;
    return s;
}

static mw_wide as_wide(double a, double radius)
{
    const mw_wide w = { a, 0.0, radius };
    return w;
}

/* What a certificate must be in itself. c->x lies in c->box. */
static void must_be_sound(reader *r, const mw_model *m, const mw_certificate *c, int returned)
{
    if (c->outcome != returned) fail("a certificate: two words for one outcome");
    if ((c->outcome == MW_UNKNOWN) != (c->reason != MW_REASON_NONE)) fail("a certificate without its reason");
    if (c->flags & c->undecided) fail("a flag that holds and is undecided");
    for (int i = 0; i < m->nx; i++) {
        if (c->outcome == MW_UNIQUE) {
            if (!(c->x[i].radius <= c->box[i]) || !(fabs(c->x[i].hi) < HUGE_VAL)) fail("an enclosure beyond its box");
        } else if (c->x[i].hi == c->x[i].hi) fail("numbers where nothing is shown");
    }
    note(r, &c->outcome, sizeof c->outcome);
    note(r, &c->reason, sizeof c->reason);
}

/* What is proved of a drive is true of what the solver finds: s is set up for p, the same design in floating point. */
static void must_agree(reader *r, fuzzed *f, double phi, const double *x, const double *d, const mw_certificate *c)
{
    const mw_model *m = f->m;
    double *y = numbers((size_t)m->nx), *scale = numbers((size_t)m->nx), *o = numbers((size_t)m->no);
    mw_info info;
    int inside = 1, near = 1, close = 1;
    m->set_phi(f->s, phi);
    m->scale(f->s, scale);
    for (int i = 0; i < m->nx; i++) y[i] = c->outcome == MW_UNIQUE ? c->x[i].hi : x[i];
    if (c->outcome == MW_UNIQUE) {
        m->observe(f->s, y, o);
        for (int i = 0; i < 3; i++) near = near && fabs(o[i] - c->point[i].mid) <= c->point[i].radius + 1e-7 * (1.0 + extent(o));
        if (!near) fail("a certificate whose point is not of the flank");
        for (int i = 0; i < m->nx; i++) close = close && c->x[i].radius < 1e-10 * scale[i];
        for (int i = 0; close && i < 3; i++) near = near && fabs(o[i] - o[6 + i]) <= 1e-7 * (1.0 + extent(o) + extent(o + 6));
        if (!near) fail("a certificate of flanks that are apart");
        note_numbers(r, y, (size_t)m->nx);
    }
    if (c->outcome == MW_UNKNOWN || mw_refine(m, f->s, y, &info) < 0) return;
    calls++;
    for (int i = 0; i < m->nx; i++) {
        const double middle = c->outcome == MW_UNIQUE ? c->x[i].hi : x[i], half = c->outcome == MW_UNIQUE ? c->box[i] : d[i];
        inside = inside && fabs(y[i] - middle) < half - 1e-6 * scale[i];
    }
    if (inside && c->outcome == MW_NONE) fail("a contact in a box that is said to hold none");
    if (inside && !(fabs(y[m->error] - c->x[m->error].hi) <= c->x[m->error].radius + 1e-7 * scale[m->error]))
        fail("another contact in a box that is said to hold one");
}

/* A start that is a solution more often than not. */
static double *solved_start(reader *r, fuzzed *f, double phi)
{
    double *x = start(r, f);
    mw_info info;
    f->m->set_phi(f->s, phi);
    if (byte(r) < 224) {
        double *y = numbers((size_t)f->m->nx);
        memcpy(y, x, (size_t)f->m->nx * sizeof *y);
        calls++;
        if (mw_refine(f->m, f->s, y, &info) >= 0) return y;
    }
    return x;
}

/* A place that is said to overlap: the wheel turned by how far it is apart, both flanks have that point in common, and it lies
 * within all limits. s is set up for the angle and the design in floating point. */
static void must_overlap(const mw_model *m, const double *s, const mw_certificate *contact, const mw_first_certificate *c)
{
    double *x = numbers((size_t)m->nx), *o = numbers((size_t)m->no), gap[2] = { 0.0, 0.0 }, size = 1.0;
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 0; i < m->nx; i++) x[i] = contact->x[i].hi;
        for (int i = 0; i < 2; i++) x[m->bodies[0].unknowns[i]] = c->pinion[i], x[m->bodies[1].unknowns[i]] = c->wheel[i];
        x[m->error] += turn ? c->apart.mid : -c->apart.mid;
        m->observe(s, x, o);
        for (int i = 0; i < 3; i++) gap[turn] = fmax(gap[turn], fabs(o[i] - o[6 + i]));
        size = 1.0 + extent(o) + extent(o + 6);
        for (int b = 0; b < 2; b++)
            for (int i = 0; i < m->bodies[b].margins; i++)
                if (o[m->bodies[b].margin + i] < -1e-6 * size) fail("an overlap outside the limits");
    }
    if (!(fmin(gap[0], gap[1]) <= 1e-6 * size)) fail("an overlap of flanks that have no point in common");
    successes++;
}

/* What a proof of first contact says in itself; `narrow`: the design and the angle are numbers. */
static void must_be_first(reader *r, fuzzed *f, double at, const mw_certificate *contact, const double *flanks, double slack,
                          double reach, int narrow, const mw_first_certificate *c, int returned)
{
    if (returned != c->outcome) fail("first contact: two words for one outcome");
    calls++, first_proofs++;
    note(r, &c->outcome, sizeof c->outcome);
    if ((c->outcome == MW_FIRST_UNKNOWN) != (c->reason != MW_REASON_NONE)) fail("first contact: not known, without its reason");
    if (c->outcome == MW_FIRST_UNKNOWN) return;
    if (contact->outcome != MW_UNIQUE) fail("first contact of a contact that is not certified");
    if (!(slack > 0.0 && reach > slack)) fail("first contact over no angles");
    if (c->outcome != MW_FIRST_REFUTED) return;
    if (!(c->apart.mid + c->apart.radius < 0.0)) fail("an overlap that is none");
    for (int i = 0; i < 2; i++)
        if (!(c->wheel[i] >= flanks[4 + 2 * i] && c->wheel[i] <= flanks[5 + 2 * i])) fail("an overlap beyond the flanks");
    if (!f->completed || !narrow) return;
    f->m->set_phi(f->s, at);
    must_overlap(f->m, f->s, contact, c);
}

/* A contact on both flanks, to be proved the first: as it is and with the wheel turned either way. Turned either way by more
 * than the slack, the wheel overlaps at one of both; what a smaller part of the flanks about it refutes, the whole does not prove. */
static void first_of_contact(reader *r, fuzzed *f, const mw_wide *s, int all)
{
    const mw_model *m = f->m;
    if (!f->from->nproofs) return;
    const double *from = f->from->proofs[byte(r) % (unsigned)f->from->nproofs], at = from[0], *whole = from + 3, *x = from + 11;
    double *work = numbers(mw_certify_first_work()), *scale = numbers((size_t)m->nx), part[8];
    mw_certificate *contact = room(1, sizeof *contact);
    mw_first_certificate *c = room(4, sizeof *c);
    const double slack = from[1] * (byte(r) < 128 ? 1.0 : 1e3), turn = slack * (2.0 + byte(r)), reach = byte(r) < 192 ? from[2] : 4.0 * turn;
    const int effort = 1 << byte(r) % 10, wide = byte(r) < 128;
    int holds = 1;
    must_be_sound(r, m, contact, mw_certify(m, s, as_wide(at, 0.0), x, 0, contact));
    calls++;
    m->set_phi(f->s, at);
    m->scale(f->s, scale);
    const double share = ldexp(1.0, -(int)(byte(r) % 12));
    for (int i = 0; i < 8; i++) {
        const int k = m->bodies[i / 4].unknowns[i % 4 / 2];
        const double middle = contact->outcome == MW_UNIQUE ? contact->x[k].hi : x[k];
        part[i] = wide ? whole[i] : middle + (i % 2 ? share : -share) * scale[k];
        holds = holds && (i % 2 ? part[i] > middle : part[i] < middle);
    }
    const double angle = contact->wheel_angle.mid;
    for (int way = 0; way < 3; way++) {
        contact->wheel_angle.mid = angle + (way - 1) * turn;
        must_be_first(r, f, at, contact, part, slack, reach, 0, c + way,
                      mw_certify_first(m, s, as_wide(at, 0.0), contact, part, slack, reach, effort, work, c + way));
    }
    contact->wheel_angle.mid = angle;
    if (f->completed && all && c[1].outcome == MW_FIRST_REFUTED) {
        m->set_phi(f->s, at);
        must_overlap(m, f->s, contact, c + 1);
    }
    if (holds && c[0].outcome == MW_FIRST_PROVED && c[2].outcome == MW_FIRST_PROVED && reach > 2.0 * turn)
        fail("a contact from which the wheel can be turned either way");
    if (wide || byte(r) < 192) return;
    must_be_first(r, f, at, contact, whole, slack, reach, 0, c + 3,
                  mw_certify_first(m, s, as_wide(at, 0.0), contact, whole, slack, reach, 8 * effort, work, c + 3));
    if (c[1].outcome == MW_FIRST_REFUTED && c[3].outcome == MW_FIRST_PROVED) fail("a whole that is proved, and a part refuted");
}

/* First contact within ranges of the flanks' parameters about a certified contact, or wherever a number may lie. */
static void first_proof(reader *r, fuzzed *f, const mw_wide *s, double at, const mw_certificate *contact, int narrow)
{
    const mw_model *m = f->m;
    double flanks[8], *scale = numbers((size_t)m->nx), *work = numbers(mw_certify_first_work());
    mw_first_certificate *c = room(1, sizeof *c);
    m->set_phi(f->s, at);
    m->scale(f->s, scale);
    for (int i = 0; i < 4; i++) {
        const int k = m->bodies[i / 2].unknowns[i % 2];
        const double middle = contact->outcome == MW_UNIQUE ? contact->x[k].hi : number(r, 0.0);
        for (int side = 0; side < 2; side++) flanks[2 * i + side] = number(r, middle + (side ? 1.0 : -1.0) * ldexp(scale[k], -(int)(byte(r) % 16)));
    }
    const double slack = number(r, 1e-7), reach = number(r, 1e-3);
    const int effort = 1 << byte(r) % 10;
    must_be_first(r, f, at, contact, flanks, slack, reach, narrow, c,
                  mw_certify_first(m, s, as_wide(at, 0.0), contact, flanks, slack, reach, effort, work, c));
}

static void certificate(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    int all;
    mw_wide *s = enclosed_state(r, f, &all);
    const double at = number(r, f->from->phi), *x = solved_start(r, f, at);
    double *d = numbers((size_t)m->nx), *centre = numbers((size_t)m->nx);
    mw_certificate *c = room(1, sizeof *c);
    const double radius = number(r, 0.0);
    must_be_sound(r, m, c, mw_certify(m, s, as_wide(at, radius), x, byte(r) & 1, c));
    if (f->completed && all && radius < 1e-12 && c->outcome == MW_UNIQUE) must_agree(r, f, at, x, NULL, c);
    if (byte(r) < 64) first_proof(r, f, s, at, c, all && radius == 0.0);
    else if (byte(r) < 96) first_of_contact(r, f, s, all);
    m->set_phi(f->s, at);
    m->scale(f->s, d);
    const double share = ldexp(1.0, -(int)(byte(r) % 40));
    for (int i = 0; i < m->nx; i++) centre[i] = x[i] + share * scattered(r) * d[i], d[i] = fabs(number(r, share * d[i]));
    must_be_sound(r, m, c, mw_certify_box(m, s, as_wide(at, 0.0), centre, d, c));
    if (f->completed && all) must_agree(r, f, at, centre, d, c);
    calls += 3;
}

static const mw_enclosing *nothing_printed(void)
{
    return NULL;
}

/* By the drive's table as it is without the objects beside it, and joined with them: to the same bits. */
static void certificates_joined(fuzzed *f, const mw_wide *s, const mw_wide *phi, const double *x, const int *line, size_t n,
                                const mw_certificate *c)
{
    const mw_in_lanes *lanes = f->from->lanes();
    const mw_proofs *proofs = mw_proofs_of(f->m);
    mw_in_lanes other_lanes = *lanes;
    mw_proofs other_proofs = *proofs;
    mw_model bare = *f->m;
    mw_kernels kernels = *f->m->kernels;
    kernels.enclosing = nothing_printed;
    bare.kernels = &kernels;
    other_lanes.drive = other_proofs.drive = "another";
    void *place = room(1, mw_joined_size());
    if (mw_joined(&bare, &other_lanes, NULL, place) || mw_joined(&bare, NULL, &other_proofs, place)) fail("another drive's object");
    const mw_model *const ways[] = { &bare, mw_joined(&bare, lanes, proofs, place) };
    mw_certificate *own = room(n, sizeof *own);
    for (int way = 0; way < 2; way++) {
        mw_certify_points(ways[way], s, phi, x, line, n, own);
        for (size_t k = 0; k < n; k++) {
            if (own[k].outcome != c[k].outcome || own[k].reason != c[k].reason) fail("a table and printed code find different ends");
            if (c[k].outcome == MW_UNIQUE && memcmp(own + k, c + k, sizeof *c) != 0) fail("a table and printed code differ");
        }
    }
    unsigned char *unique = room(n, 1);
    mw_ball *errors = room(n, sizeof *errors);
    mw_certify_many(NULL, NULL, &bare, s, phi, x, n, unique, errors);
    for (size_t k = 0; k < n; k++)
        if (c[k].outcome == MW_UNIQUE && !line[k] && !unique[k]) fail("a table shows less of many points than of one");
    calls += 6;
}

/* Many at once, in lanes and one by one: what both show is the same. */
static void certificates(reader *r, fuzzed *f)
{
    static const int widths[] = { 0, 2, 4, 8, -1, 2 };
    const mw_model *m = f->m;
    const size_t n = byte(r) % POINTS, nx = (size_t)m->nx;
    int all;
    mw_wide *s = enclosed_state(r, f, &all), *phi = room(n, sizeof *phi);
    double *x = numbers(n * nx), *d = numbers(n * nx);
    int *line = room(n, sizeof *line);
    unsigned char *unique = room(n, 1);
    mw_ball *errors = room(n, sizeof *errors);
    mw_certificate *c = room(n, sizeof *c);
    for (size_t k = 0; k < n; k++) {
        phi[k] = as_wide(number(r, f->from->phi + 1e-3 * (double)k), 0.0);
        memcpy(x + k * nx, solved_start(r, f, phi[k].hi), nx * sizeof *x);
        for (size_t i = 0; i < nx; i++) d[k * nx + i] = 1e-6;
        line[k] = byte(r) & 1;
    }
    size_t count = 0, shown = 0;
    const size_t points = mw_certify_points(m, s, phi, x, line, n, c);
    for (size_t k = 0; k < n; k++) must_be_sound(r, m, c + k, c[k].outcome), shown += c[k].outcome == MW_UNIQUE;
    certificates_joined(f, s, phi, x, line, n, c);
    const size_t lanes = mw_certify_many(mw_lanes(widths[byte(r) % 6]), mw_proofs_of(m), m, s, phi, x, n, unique, errors);
    for (size_t k = 0; k < n; k++) {
        count += unique[k];
        if (unique[k] && !(errors[k].radius < 1.0)) fail("an error without bounds");
        if (unique[k] && c[k].outcome == MW_UNIQUE
            && !(fabs(errors[k].mid - c[k].x[m->error].hi) <= errors[k].radius * 1.001 + c[k].x[m->error].radius + fabs(c[k].x[m->error].lo)))
            fail("bounds of lanes that do not hold the error");
    }
    if (shown != points || count != lanes) fail("certificates: they are not as many as was said");
    mw_certify_boxes(m, s, phi, x, d, n, c);
    for (size_t k = 0; k < n; k++) must_be_sound(r, m, c + k, c[k].outcome);
    calls += 4;
}

/* A fold or crossing where the solver finds one, or anywhere: what is proved of it, Newton's method finds there too. */
static void branch_proof(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    int all;
    const mw_wide *s = enclosed_state(r, f, &all);
    const int crossing = byte(r) & 1;
    double angle = number(r, f->from->phi), *x = solved_start(r, f, angle), *scale = numbers((size_t)m->nx);
    mw_branch_certificate *c = room(1, sizeof *c);
    if (byte(r) < 224) mw_branch_point(m, f->s, crossing, &angle, x);
    if (mw_certify_branch(m, s, crossing, angle, x, c) != c->outcome) fail("a singular point: two words for one outcome");
    if ((c->outcome == MW_UNIQUE) != (c->reason == MW_REASON_NONE)) fail("a singular point without its reason");
    note(r, &c->outcome, sizeof c->outcome);
    calls += 2;
    if (c->outcome != MW_UNIQUE) return;
    if (!(c->angle.radius <= c->box) || !(fabs(c->angle.mid) < HUGE_VAL)) fail("a singular point beyond its box");
    if (!f->completed || !all || mw_branch_point(m, f->s, crossing, &angle, x) < 0) return;
    int inside = fabs(angle - c->angle.mid) < 0.5 * c->box;
    m->set_phi(f->s, angle);
    m->scale(f->s, scale);
    for (int i = 0; i < m->nx; i++) inside = inside && fabs(x[i] - c->x[i].mid) < 0.5 * c->box * scale[i];
    if (inside && !(fabs(angle - c->angle.mid) <= c->angle.radius + 1e-7)) fail("another singular point where one is said to be");
    successes++;
}

/* A piece from its solutions, which a trace finds; its polynomials at an angle and over a part of it. */
static mw_piece *piece_of(reader *r, fuzzed *f, const mw_wide *s, double from, double to, size_t *solved)
{
    const mw_model *m = f->m;
    double *t = numbers(MW_ORDER + 1), *phi = numbers(MW_ORDER + 1), *x = numbers((MW_ORDER + 1) * (size_t)m->nx);
    mw_info *info = room(MW_ORDER + 1, sizeof *info);
    mw_piece *piece = room(1, sizeof *piece);
    mw_piece_nodes(t);
    for (int k = 0; k <= MW_ORDER; k++) {
        if (!(fabs(t[k]) < 1.0) || (k && !(t[k] > t[k - 1]))) fail("nodes that do not ascend");
        phi[k] = 0.5 * (from + to) + 0.5 * (to - from) * t[k];
    }
    *solved = mw_trace(m, f->p, phi, MW_ORDER + 1, f->s, f->work, x, info);
    if (byte(r) > 240) {
        double *changed = x + byte(r) % ((MW_ORDER + 1) * (unsigned)m->nx);
        *changed = number(r, 0.1);
    }
    if (mw_certify_piece(m, s, from, to, x, piece) != piece->outcome) fail("a piece: two words for one outcome");
    if ((piece->outcome == MW_UNIQUE) != (piece->reason == MW_REASON_NONE)) fail("a piece without its reason");
    note(r, &piece->outcome, sizeof piece->outcome);
    calls += 3;
    m->setup(f->p, f->s);
    return piece;
}

/* First contact over a range of angles of a piece of path, or one beyond it, of this pair or with both bodies turned. */
static void first_along(reader *r, fuzzed *f, const mw_wide *s, const mw_piece *piece, double begin, double end)
{
    const mw_model *m = f->m;
    if (!f->from->nproofs) return;
    const double *known = f->from->proofs[byte(r) % (unsigned)f->from->nproofs], width = end - begin;
    const double from = begin + (double)(byte(r) % 8) / 8.0 * width, to = from + (double)(byte(r) % 9) / 8.0 * (end - from);
    const double slack = known[1] * (byte(r) < 128 ? 1.0 : 1e3), turn = byte(r) < 192 ? 0.0 : number(r, 0.5);
    const int effort = 1 << byte(r) % 10;
    double *work = numbers(mw_certify_first_work()), angle;
    mw_first_certificate *c = room(1, sizeof *c);
    mw_certificate *shown = room(1, sizeof *shown);
    memset(shown, 0, sizeof *shown);
    shown->outcome = piece->outcome;
    must_be_first(r, f, from, shown, known + 3, slack, known[2], 0, c,
                  mw_certify_first_along(m, s, piece, from, to, as_wide(turn, 0.0), as_wide(turn, 0.0), known + 3, slack, known[2],
                                         effort, work, c, &angle));
    if (c->outcome == MW_FIRST_REFUTED && !(angle >= from && angle <= to)) fail("an overlap at an angle beyond the range");
    if (c->outcome == MW_FIRST_PROVED && !(from < to)) fail("first contact over no angles of the pinion");
}

static void path(reader *r, fuzzed *f)
{
    const mw_model *m = f->m;
    int all;
    size_t solved;
    const mw_wide *s = enclosed_state(r, f, &all);
    const double from = number(r, f->from->phi), width = number(r, ldexp(1.0, -(int)(byte(r) % 16))), to = from + width;
    const mw_piece *piece = piece_of(r, f, s, from, to, &solved);
    if (byte(r) & 1) {
        const mw_piece *next = piece_of(r, f, s, to, to + number(r, width), &solved);
        const int joined = mw_pieces_join(m, piece, next, to);
        if (joined && (piece->outcome != MW_UNIQUE || next->outcome != MW_UNIQUE)) fail("a joint of what is not shown");
        note(r, &joined, sizeof joined);
    }
    const double at = from + ((double)byte(r) / 255.0) * width;
    double limits[2], *y = numbers((size_t)m->nx), *scale = numbers((size_t)m->nx);
    const mw_polynomial *of = byte(r) & 1 ? &piece->x[byte(r) % (unsigned)m->nx] : &piece->margin[byte(r) % 32];
    const mw_ball there = mw_piece_at(piece, of, at);
    mw_piece_range(piece, of, from, to, (int)(byte(r) % 12) - 2, limits);
    calls += 3;
    if (piece->outcome != MW_UNIQUE) {
        if (byte(r) < 16) first_along(r, f, s, piece, from, to);
        return;
    }
    if (there.radius < HUGE_VAL && !(there.mid >= limits[0] - there.radius && there.mid <= limits[1] + there.radius))
        fail("bounds of a piece that do not hold its values");
    if (byte(r) < 64) first_along(r, f, s, piece, from, to);
    if (!f->completed || !all) return;
    mw_info info;
    m->set_phi(f->s, at);
    m->scale(f->s, scale);
    for (int i = 0; i < m->nx; i++) y[i] = mw_piece_at(piece, &piece->x[i], at).mid;
    if (mw_refine(m, f->s, y, &info) < 0) return;
    const mw_ball error = mw_piece_at(piece, &piece->x[m->error], at);
    int inside = 1;
    for (int i = 0; i < m->nx; i++)
        inside = inside && fabs(y[i] - mw_piece_at(piece, &piece->x[i], at).mid) < piece->box[i] - 1e-6 * scale[i];
    if (inside && !(fabs(y[m->error] - error.mid) <= error.radius + 1e-7 * scale[m->error])) fail("a contact off its piece of path");
    successes++;
}

/* A table without what these need, or of another version: nothing is shown, and why. */
static void without_proofs(reader *r, fuzzed *f, const mw_model *other)
{
    const size_t slots = (size_t)mw_enclosed_slots(f->m), nx = (size_t)f->m->nx;
    mw_wide *s = room(slots, sizeof *s), *p = room((size_t)f->m->np, sizeof *p), phi = as_wide(0.1, 0.0);
    double *x = start(r, f), *o = numbers((size_t)f->m->no), *nodes = numbers((MW_ORDER + 1) * nx);
    mw_certificate c;
    mw_branch_certificate found;
    mw_piece *piece = room(1, sizeof *piece);
    mw_info info;
    mw_ball error;
    unsigned char unique = 1;
    int line = 0;
    for (size_t i = 0; i < slots; i++) s[i] = phi;
    for (int i = 0; i < f->m->np; i++) p[i] = phi;
    for (size_t i = 0; i < (MW_ORDER + 1) * nx; i++) nodes[i] = 0.1;
    int refused = mw_edge(other, -1, 0) == -1;
    refused += mw_edge_eval(other, 0, f->s, x, o, NULL) == MW_BAD_INPUT;
    refused += mw_edge_solve(other, 0, f->s, x, &info) == MW_BAD_INPUT && info.status == MW_BAD_INPUT;
    refused += mw_edge_follow(other, 0, f->s, 0.1, x, &phi.hi, 1, o, &info) == 0 && info.status == MW_BAD_INPUT;
    refused += mw_bounds(other, 0, 1, f->s, x, 1, o) == MW_BAD_INPUT;
    refused += mw_encloses(other) == 0;
    refused += mw_enclosed_slots(other) == 0;
    refused += mw_enclose_design(other, p, o) != 0;
    refused += mw_certify(other, s, phi, x, 0, &c) == MW_UNKNOWN && c.reason == MW_REASON_ARITHMETIC;
    refused += mw_certify_box(other, s, phi, x, x, &c) == MW_UNKNOWN && c.reason == MW_REASON_ARITHMETIC;
    refused += mw_certify_points(other, s, &phi, x, &line, 1, &c) == 0 && mw_certify_boxes(other, s, &phi, x, x, 1, &c) == 0;
    refused += mw_certify_many(mw_lanes(2), mw_proofs_of(f->m), other, s, &phi, x, 1, &unique, &error) == 0 && !unique;
    refused += mw_certify_piece(other, s, 0.1, 0.2, nodes, piece) == MW_UNKNOWN && piece->reason == MW_REASON_ARITHMETIC;
    refused += mw_pieces_join(other, piece, piece, 0.2) == 0;
    refused += mw_certify_branch(other, s, 0, 0.1, x, &found) == MW_UNKNOWN && found.reason == MW_REASON_ARITHMETIC;
    mw_enclose_setup(other, p, s);
    if (refused != 15) fail("a table without proofs is not refused");
    calls += 17;
}
