/* Newton steps with the inverse Jacobian of an earlier point of a trace.  SPDX-License-Identifier: MIT-0
 *
 * Where the points of a trace are close, their predictions are nearly solutions and their Jacobians nearly equal. A step
 * d = C R with the inverse C of an earlier Jacobian takes a part of the operations, and leaves of an error e what K e is,
 * K = I - C J. K grows with the distance from where C was made: how fast is measured each time that C is made anew, of the
 * old C and the new J. */
#ifndef MWI_CHORD_H
#define MWI_CHORD_H

#include "basics.h"

/* What such a step may leave of an error, in natural sizes of the unknowns: less than round-off leaves of solutions. The
 * transmission error is better determined than the place of contact. */
static const double MWI_CHORD_LEFT = 1e-14, MWI_CHORD_LEFT_OF_ERROR = 1e-16;

/* Longer steps say that the points are too far apart. The most that K may be; how many times the distance over which its
 * growth was measured it is believed; how many points C must serve, as making it takes a few steps' time. */
static const double MWI_CHORD_STEP = 1e-11, MWI_CHORD_SHARE = 1.0 / 16.0, MWI_CHORD_BELIEVED = 16.0, MWI_CHORD_WORTH = 8.0;

/* Points from one attempt to the next where C does not serve so many; each time twice as many. */
enum { MWI_CHORD_PAUSE = 8, MWI_CHORD_LONGEST_PAUSE = 8192 };

/* inverse: of the Jacobian at phi by unknowns in natural sizes; reach: largest product of a step's size
 * and a distance in angle after which no more is left than may be; span: the largest distance, 0 where nothing is known of
 * K. left: points until the next attempt. */
typedef struct mwi_chord {
    int made, pause, left;
    double phi, reach, span;
    double inverse[MW_MAX_UNKNOWNS][MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
} mwi_chord;

static inline mwi_chord mwi_no_chord(void)
{
    mwi_chord c;
    c.made = c.left = 0;
    c.pause = MWI_CHORD_PAUSE;
    c.phi = c.reach = c.span = 0.0;
    return c;
}

/* Whether a step of this size at phi leaves no more of an error than may be. */
static inline int mwi_chord_reaches(const mwi_chord *c, double phi, double step)
{
    const double distance = mwi_abs(phi - c->phi);
    return distance <= c->span && distance * step <= c->reach;
}

/* x -= C R of n unknowns, R with zeros behind them. Returns the largest change in natural sizes. */
static inline double mwi_chord_change(const mwi_chord *c, int n, const double *R, double *x)
{
    double size = 0.0;
    for (int i = 0; i < n; i++) {
        const double *row = c->inverse[i];
        double change = row[0] * R[0];
        for (int j = 1; j < MW_MAX_UNKNOWNS; j++) change += row[j] * R[j];
        x[i] -= change * c->scale[i];
        size = mwi_larger(size, mwi_abs(change));
    }
    return size;
}

/* Whether a and b lie within so many natural sizes of each other. */
static inline int mwi_chord_near(const mwi_chord *c, int n, const double *a, const double *b, double sizes)
{
    for (int i = 0; i < n; i++)
        if (!(mwi_abs(a[i] - b[i]) <= sizes * c->scale[i])) return 0;
    return 1;
}

/* One step of x, s set up for its angle. */
static inline double mwi_chord_step(const mw_model *m, const mwi_chord *c, const double *s, double *x)
{
    double R[MW_MAX_UNKNOWNS] = { 0.0 };
    m->eval(s, x, R, NULL);
    return mwi_chord_change(c, m->nx, R, x);
}

/* A = its inverse, n rows of which the numbers are MW_MAX_UNKNOWNS apart, by Gauss and Jordan; 0 where it is singular. */
static inline int mwi_invert(int n, double A[MW_MAX_UNKNOWNS][MW_MAX_UNKNOWNS])
{
    int pivots[MW_MAX_UNKNOWNS];
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (mwi_abs(A[i][k]) > mwi_abs(A[pivot][k])) pivot = i;
        if (!(mwi_abs(A[pivot][k]) > 0.0)) return 0;
        const double by = 1.0 / A[pivot][k];
        pivots[k] = pivot;
        A[pivot][k] = 1.0;
        for (int j = 0; j < MW_MAX_UNKNOWNS; j++) {
            const double a = A[pivot][j] * by;
            A[pivot][j] = A[k][j];
            A[k][j] = a;
        }
        for (int i = 0; i < n; i++) {
            const double factor = A[i][k];
            if (i == k) continue;
            A[i][k] = 0.0;
            for (int j = 0; j < MW_MAX_UNKNOWNS; j++) A[i][j] -= factor * A[k][j];
        }
    }
    for (int k = n - 1; k >= 0; k--)
        for (int i = 0; i < n && pivots[k] != k; i++) {
            const double a = A[i][k];
            A[i][k] = A[i][pivots[k]];
            A[i][pivots[k]] = a;
        }
    return 1;
}

/* Set reach and span from K of C and the Jacobian J at another angle, `distance` away, by unknowns in natural sizes. */
static inline void mwi_chord_measure(const mw_model *m, mwi_chord *c, double J[MW_MAX_UNKNOWNS][MW_MAX_UNKNOWNS], double distance)
{
    double sums[MW_MAX_UNKNOWNS], most = 0.0, left = 0.0;
    for (int i = 0; i < m->nx; i++) {
        double row[MW_MAX_UNKNOWNS] = { 0.0 };
        row[i] = 1.0;
        for (int k = 0; k < m->nx; k++)
            for (int j = 0; j < MW_MAX_UNKNOWNS; j++) row[j] -= c->inverse[i][k] * J[k][j];
        sums[i] = 0.0;
        for (int j = 0; j < m->nx; j++) sums[i] += mwi_abs(row[j]);
    }
    for (int i = 0; i < m->nx; i++) {
        most = mwi_larger(most, sums[i]);
        left = mwi_larger(left, sums[i] / (i == m->error ? MWI_CHORD_LEFT_OF_ERROR : MWI_CHORD_LEFT));
    }
    c->span = c->reach = 0.0;
    if (!(most < 2.0 * MWI_CHORD_SHARE)) return;
    c->reach = distance / left;
    c->span = distance * MWI_CHORD_SHARE / most;
    if (c->span > MWI_CHORD_BELIEVED * distance) c->span = MWI_CHORD_BELIEVED * distance;
}

/* Whether to make C anew after a step of this size. */
static inline int mwi_chord_is_due(mwi_chord *c, double step)
{
    if (!(step <= MWI_CHORD_STEP)) return 0;
    return c->left-- <= 0;
}

/* One Newton step of x at phi, for which s and c->scale are set up, with C made anew. Its size is
 * infinite where C is not to be had. If steps of that size, or of `last`, from points so far apart do not let C serve enough
 * of them, it is not used for a while. */
static inline double mwi_chord_renew(const mw_model *m, mwi_chord *c, const double *s, double phi, double spacing,
                                     double last, double *x)
{
    double R[MW_MAX_UNKNOWNS] = { 0.0 }, flat[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS];
    double J[MW_MAX_UNKNOWNS][MW_MAX_UNKNOWNS] = { { 0.0 } };
    const int n = m->nx, known = c->made;
    m->eval(s, x, R, flat);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) J[i][j] = flat[i * n + j] * c->scale[j];
    if (known) mwi_chord_measure(m, c, J, mwi_abs(phi - c->phi));
    for (int i = 0; i < n; i++) mwi_copy(c->inverse[i], J[i], MW_MAX_UNKNOWNS);
    c->phi = phi;
    c->made = mwi_invert(n, c->inverse);
    const double step = c->made ? mwi_chord_change(c, n, R, x) : HUGE_VAL;
    const int worth = mwi_chord_reaches(c, phi + MWI_CHORD_WORTH * spacing, mwi_larger(last, step));
    if (!(step <= MWI_CHORD_STEP) || (known && !worth)) {
        c->made = 0;
        c->span = 0.0;
        c->left = c->pause;
        if (c->pause < MWI_CHORD_LONGEST_PAUSE) c->pause *= 2;
    } else if (known) {
        c->pause = MWI_CHORD_PAUSE;
    }
    return step;
}

#endif
