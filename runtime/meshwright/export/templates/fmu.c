/* @said@ as a component: model exchange and co-simulation by FMI @fmi@, without states.
 * Made by meshwright.  SPDX-License-Identifier: MIT-0
 *
 * Torques follow from one energy, V = sum of K d^2 / 2 over the pairs of both flanks that are approached by d, the wheel angle by
 * which the bodies would overlap; K falls to 0 towards the ends of a pair's flanks, so that V does not jump. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "@drive@.h"
#define X(name) @drive@_##name

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

static const char TOKEN[] = "@token@";
static const double SIGN = @sign@; /* -1: the mirror image of the drive that is solved */
static const double DRIVEN[] = { @driven@ };
static const double COASTING[] = { @coasting@ };
static const int MISALIGNED[] = { @misaligned@ };       /* places of misalignments in p */
static const double FACTORS[] = { @factors@ };          /* of their keys' units */
static const double STARTS[] = { @starts@ };
static const double STIFF = @stiffness@;                /* with which a pair starts, N m/rad at the wheel */
enum { HAS_COAST = @coast@, MISALIGNMENTS = @misalignments@ };

/* Value references. */
enum {
    TIME, PHI_A, W_A, PHI_B, W_B, STIFFNESS, DAMPING, FRICTION, TAU_A, TAU_B, ERROR, RATIO, BACKLASH, ENERGY, LOSS, GAP_DRIVE,
    GAP_COAST, CONTACT, LEADING, FLANGE_A, FLANGE_B, REALS,
    FIRST_MISALIGNMENT = 100
};

/* Share of a pair's window over which its stiffness rises and falls; below this sliding speed, m/s, friction fades. */
static const double RAMP = 0.125, SLOW = 1e-6, METRE = 1e-3;

/* Pairs of one flank at most. */
enum { MOST = 2 * MWI_PLACES };

typedef struct pair {
    double number, error, ratio, stiffness, slope, lever, point[3], normal[3];
} pair;

/* All that changes: what a saved state holds. */
typedef struct memory {
    double value[REALS], misalignment[MISALIGNMENTS + 1], c[X(NC)], axes[12];
    long long leading;
    int contact, stale, ready;
} memory;

/* The pairs of a flank by their numbers, which leads, and which are approached and pressed. */
typedef struct pressed {
    int count;
    double leads, number[MOST];
    int near[MOST], forced[MOST];
} pressed;

/* frozen: the same pairs lead, are approached and pressed as before, whatever the inputs: then all is smooth. */
typedef void (*logger)(void);
typedef struct component {
    memory now;
    pressed held[2];
    int frozen;
    logger log;
    void *environment;
    char name[256];
} component;

static void say(component *m, int status, const char *words);

static double wrapped(double a, double unit)
{
    return ((a / unit + MWI_TO_INTEGER) - MWI_TO_INTEGER) * unit;
}

/* The share of its stiffness that a pair has at its own angle, and the slope of that. */
static double share(const double *side, double angle, double *slope)
{
    const double lower = side[MWI_LOWER + MWI_END_ANGLE], upper = side[MWI_UPPER + MWI_END_ANGLE], ramp = RAMP * (upper - lower);
    double u = 1.0, v = 1.0;
    *slope = 0.0;
    if (side[MWI_KIND] == MWI_OF_LINES || !(ramp < HUGE_VAL)) return 1.0;
    u = (angle - lower) / ramp, v = (upper - angle) / ramp;
    if (u < 1.0) *slope = 6.0 * u * (1.0 - u) / ramp;
    if (v < 1.0) *slope = -6.0 * v * (1.0 - v) / ramp;
    if (v < u) u = v;
    if (u <= 0.0) return *slope = 0.0;
    return u < 1.0 ? u * u * (3.0 - 2.0 * u) : 1.0;
}

/* The pairs of a flank at the own angle of pair 0: how many, and which leads, -1 where none touches. */
static int pairs_of(double *side, double angle, pair *all, int *leads)
{
    const mw_model *const m = &X(model);
    double first = 0.0, last = 0.0, x[X(NX)], o[X(NO)];
    const double teeth = mwi_parameters_in(m, side)[m->teeth], places = MWI_PLACES;
    int count = 0;
    mw_info info;
    mw_contact c;
    *leads = -1;
    if (side[MWI_KIND] == MWI_ABSENT || side[MWI_KIND] == MWI_NO_WINDOW) return 0;
    if (side[MWI_KIND] == MWI_OF_POINTS) mwi_pairs_inside(m, side, angle, &first, &last);
    for (double k = first; k <= last && count < MOST; k += 1.0) {
        const double own = mwi_less_pitches(teeth, angle, k);
        pair *const at = all + count;
        if (mwi_pair_at(m, side, (int)(k - places * mwi_floor(k / places)), own, x, &info) < 0) continue;
        mwi_contact_at(m, side + MWI_STATE, x, o, &c);
        at->number = k, at->error = x[m->error], at->ratio = c.ratio, at->lever = c.lever_wheel;
        at->stiffness = share(side, own, &at->slope);
        mwi_copy(at->point, c.point, 3);
        mwi_copy(at->normal, c.normal, 3);
        if (*leads < 0 || side[MWI_SENSE] * at->error > side[MWI_SENSE] * all[*leads].error + MWI_AHEAD) *leads = count;
        count++;
    }
    return count;
}

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Friction of a pair pressed by a torque on the wheel: torques on both shafts, returns the power that is lost. */
static double rub(const memory *s, const pair *at, double torque, const double *w, double *tau)
{
    double arm[2][3], v[2][3], slip[3], along = 0.0, speed = 0.0, moment[3];
    const double force = s->value[FRICTION] * torque / (mwi_abs(at->lever) * METRE);
    for (int b = 0; b < 2; b++) {
        for (int i = 0; i < 3; i++) arm[b][i] = (at->point[i] - s->axes[6 * b + 3 + i]) * METRE;
        cross(s->axes + 6 * b, arm[b], v[b]);
    }
    for (int i = 0; i < 3; i++) {
        slip[i] = w[0] * v[0][i] - w[1] * v[1][i];
        along += slip[i] * at->normal[i];
    }
    for (int i = 0; i < 3; i++) {
        slip[i] -= along * at->normal[i];
        speed += slip[i] * slip[i];
    }
    const double each = force / sqrt(speed + SLOW * SLOW);
    for (int b = 0; b < 2; b++) {
        cross(arm[b], slip, moment);
        tau[b] -= (b ? -1.0 : 1.0) * each * mwi_dot(s->axes + 6 * b, moment);
    }
    return each * speed;
}

/* The place of a pair, by its number, among those of before; the number of all where it is none. */
static int place_of(const pressed *held, double number)
{
    int at = 0;
    while (at < held->count && held->number[at] != number) at++;
    return at;
}

/* Keep which pairs there are, numbered from `first` on, and which leads, or find that one again. */
static void hold(const component *m, pressed *held, const pair *all, int count, double first, int *leads)
{
    if (!m->frozen) {
        held->count = count;
        held->leads = *leads < 0 ? NAN : first + all[*leads].number;
        for (int k = 0; k < count; k++) held->number[k] = first + all[k].number;
        return;
    }
    for (int k = 0; k < count; k++)
        if (first + all[k].number == held->leads) *leads = k;
}

/* Torques of a flank's pairs, numbered from `first` on, on both shafts, energy and loss, where the wheel lags behind the ratio by
 * `behind`; returns the least gap, wheel angle. */
static double press(component *m, pressed *held, const double *side, const pair *all, int count, double first, double shift,
                    double behind, double *tau)
{
    memory *const s = &m->now;
    const double sense = side[MWI_SENSE], w[2] = { SIGN * s->value[W_A], SIGN * s->value[W_B] };
    double gap = HUGE_VAL;
    for (int k = 0; k < count; k++) {
        const pair *const at = all + k;
        const double deep = sense * (behind + at->error + shift), speed = sense * (at->ratio * w[0] - w[1]);
        const double K = s->value[STIFFNESS] * at->stiffness, slope = s->value[STIFFNESS] * at->slope;
        const double pressing = K * deep * (1.0 + s->value[DAMPING] * speed);
        const int place = m->frozen ? place_of(held, first + at->number) : k;
        if (-deep < gap) gap = -deep;
        if (m->frozen && place == held->count) continue;
        if (!m->frozen) held->near[k] = deep > 0.0, held->forced[k] = pressing > 0.0;
        if (!held->near[place]) continue;
        const double F = held->forced[place] ? pressing : 0.0;
        tau[0] -= sense * F * at->ratio + 0.5 * slope * deep * deep;
        tau[1] += sense * F;
        s->value[ENERGY] += 0.5 * K * deep * deep;
        s->value[LOSS] += (F - K * deep) * speed;
        if (s->value[FRICTION] > 0.0) s->value[LOSS] += rub(s, at, F, w, tau);
    }
    return gap;
}

/* Everything at the inputs; 0 where no pair of the driving flank touches. */
static int evaluate(component *m)
{
    memory *const s = &m->now;
    const mw_model *const table = &X(model);
    double *const drive = s->c + MWI_SIDES, *const coast = drive + mwi_side_size(table), *const value = s->value;
    const double ratio = s->c[MWI_RATIO], *const p = mwi_parameters_in(table, drive);
    pair of_drive[MOST], of_coast[MOST];
    double number, other, tau[2] = { 0.0, 0.0 }, shift = 0.0;
    int leads, follows = -1, coasting = 0;
    if (!s->stale) return 1;
    const double angle = mwi_own_angle(table, p, SIGN * value[PHI_A], &number);
    /* the wheel has turned by as many of its own pitches: of either angle what is left is small, and their difference exact */
    const double pitches = ratio < 0.0 ? -number : number, teeth = p[table->teeth] / mwi_abs(ratio);
    const double whole = (teeth + MWI_TO_INTEGER) - MWI_TO_INTEGER;
    const double behind = ratio * angle - mwi_less_pitches(whole, SIGN * value[PHI_B], pitches);
    if (angle != angle) return say(m, 3, "phi_a is no angle, or beyond 1e12 rad"), 0;
    const int driving = pairs_of(drive, angle, of_drive, &leads);
    if (leads < 0) {
        say(m, 3, "no tooth pair touches within the limits of its flanks at phi_a: the contact is on an edge, or none");
        return 0;
    }
    hold(m, m->held, of_drive, driving, number, &leads);
    value[ENERGY] = value[LOSS] = 0.0;
    value[ERROR] = SIGN * of_drive[leads].error;
    value[RATIO] = of_drive[leads].ratio;
    value[BACKLASH] = NAN;
    value[GAP_DRIVE] = press(m, m->held, drive, of_drive, driving, number, 0.0, behind, tau);
    value[GAP_COAST] = HUGE_VAL;
    if (coast[MWI_KIND] != MWI_ABSENT) {
        const double own = mwi_own_angle(table, mwi_parameters_in(table, coast), angle + s->c[MWI_PINION_OFFSET], &other);
        coasting = pairs_of(coast, own, of_coast, &follows);
        hold(m, m->held + 1, of_coast, coasting, number + other, &follows);
    }
    if (follows >= 0) {
        shift = ratio * s->c[MWI_PINION_OFFSET] + s->c[MWI_WHEEL_OFFSET];
        shift -= wrapped(of_coast[follows].error + shift - of_drive[leads].error, MWI_TURN / p[table->teeth] * ratio);
        value[BACKLASH] = drive[MWI_SENSE] * (of_coast[follows].error + shift - of_drive[leads].error);
        value[GAP_COAST] = press(m, m->held + 1, coast, of_coast, coasting, number + other, shift, behind, tau);
    }
    value[TAU_A] = SIGN * tau[0];
    value[TAU_B] = SIGN * tau[1];
    value[FLANGE_A] = -value[TAU_A], value[FLANGE_B] = -value[TAU_B];
    if (value[GAP_COAST] == HUGE_VAL) value[GAP_COAST] = 1.0;
    value[LEADING] = SIGN * (number + of_drive[leads].number);
    s->stale = 0;
    return 1;
}

/* What changes at events and steps alone. */
static int settle(component *m)
{
    if (!evaluate(m)) return 0;
    m->now.contact = m->now.value[GAP_DRIVE] <= 0.0 ? 1 : m->now.value[GAP_COAST] <= 0.0 ? -1 : 0;
    m->now.leading = (long long)m->now.value[LEADING];
    return 1;
}

static void restart(component *m)
{
    memset(&m->now, 0, sizeof m->now);
    for (int k = 0; k < MISALIGNMENTS; k++) m->now.misalignment[k] = STARTS[k];
    m->now.value[STIFFNESS] = STIFF;
    m->now.stale = 1;
}

/* After the misalignments are given: 0 where the design cannot be assembled so. */
static int assemble(component *m)
{
    double driven[X(NP)], coasting[X(NP)], *const drive = m->now.c + MWI_SIDES;
    const double zero[2] = { 0.0, 0.0 };
    double place[64];
    for (int k = 0; k < X(NP); k++) driven[k] = DRIVEN[k], coasting[k] = COASTING[k];
    for (int k = 0; k < MISALIGNMENTS; k++)
        driven[MISALIGNED[k]] = coasting[MISALIGNED[k]] = m->now.misalignment[k] * FACTORS[k];
    const int guard = X(cycle_setup)(driven, HAS_COAST ? coasting : NULL, m->now.c);
    if (guard) return say(m, 3, X(guard_texts)[guard - 1]), 0;
    X(placement)(drive + MWI_STATE, zero, place);
    for (int b = 0; b < 2; b++) mwi_copy(m->now.axes + 6 * b, place + 18 * b + 12, 6);
    m->now.ready = m->now.stale = 1;
    return settle(m);
}

static int get_real(component *m, unsigned int reference, double *value)
{
    if (reference >= FIRST_MISALIGNMENT && reference < FIRST_MISALIGNMENT + MISALIGNMENTS)
        return *value = m->now.misalignment[reference - FIRST_MISALIGNMENT], 1;
    if (reference >= REALS || reference == CONTACT) return say(m, 3, "no such variable"), 0;
    if (reference > FRICTION && m->now.ready && !evaluate(m)) return 0;
    *value = reference == LEADING ? (double)m->now.leading : m->now.value[reference];
    return 1;
}

static int set_real(component *m, unsigned int reference, double value)
{
    if (reference >= FIRST_MISALIGNMENT && reference < FIRST_MISALIGNMENT + MISALIGNMENTS) {
        if (m->now.ready) return say(m, 3, "a misalignment is fixed: set it before the initialisation ends"), 0;
        return m->now.misalignment[reference - FIRST_MISALIGNMENT] = value, 1;
    }
    if (reference < PHI_A || reference > FRICTION) return say(m, 3, "this variable cannot be set"), 0;
    if (reference >= STIFFNESS && !(value >= 0.0)) return say(m, 3, "stiffness, damping and friction are not negative"), 0;
    if (!(mwi_abs(value) < HUGE_VAL)) return say(m, 3, "an input is not a finite number"), 0;
    if (m->now.value[reference] != value) m->now.value[reference] = value, m->now.stale = 1;
    return 1;
}

/* du[nu] of outputs u along dk[nk] of inputs k: differences of fourth order in steps of a part of a pitch, or of the speed, of the
 * same pairs that are pressed now. 0 where an output or an input is none. */
static int along(component *m, const unsigned int *u, size_t nu, const unsigned int *k, size_t nk, const double *dk, double *du)
{
    static const double AT[4] = { -2.0, -1.0, 1.0, 2.0 }, WEIGHT[4] = { 1.0 / 12.0, -2.0 / 3.0, 2.0 / 3.0, -1.0 / 12.0 };
    static const double PART = 1.0 / 4096.0;
    if (!m->now.ready && !assemble(m)) return 0;
    m->now.stale = 1; /* a state may have been put back since */
    if (!evaluate(m)) return 0;
    const double ratio = m->now.c[MWI_RATIO], pitch = MWI_TURN / mwi_parameters_in(&X(model), m->now.c + MWI_SIDES)[X(model).teeth];
    const memory before = m->now;
    int there = 1;
    for (size_t i = 0; i < nu; i++) du[i] = 0.0;
    for (size_t j = 0; j < nk && there; j++) {
        if (k[j] < PHI_A || k[j] > W_B) return say(m, 3, "no derivative by this variable: it is no input"), 0;
        const double of[4] = { pitch, 1.0 + mwi_abs(before.value[W_A]), pitch * mwi_abs(ratio), 1.0 + mwi_abs(before.value[W_B]) };
        const double step = PART * of[k[j] - PHI_A];
        m->frozen = 1;
        for (int e = 0; e < 4 && there; e++) {
            m->now = before;
            m->now.value[k[j]] += AT[e] * step;
            m->now.stale = 1;
            there = evaluate(m);
            for (size_t i = 0; i < nu && there; i++) {
                if (!(u[i] >= TAU_A && u[i] < REALS) || u[i] == CONTACT || u[i] == LEADING)
                    there = (say(m, 3, "no derivative of this variable: it is no continuous output"), 0);
                else du[i] += dk[j] * WEIGHT[e] * m->now.value[u[i]] / step;
            }
        }
        m->frozen = 0;
        m->now = before;
    }
    return there;
}

static component *begin(const char *name, logger log, void *environment)
{
    component *const m = (component *)calloc(1, sizeof *m);
    if (m == NULL) return NULL;
    m->log = log, m->environment = environment;
    snprintf(m->name, sizeof m->name, "%s", name ? name : "");
    restart(m);
    return m;
}

@interface@