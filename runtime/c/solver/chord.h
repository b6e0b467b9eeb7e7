/* Newton steps with the inverse Jacobian of an earlier point of a trace.  SPDX-License-Identifier: MIT-0
 *
 * Where the points of a trace are close, their predictions are nearly solutions and their Jacobians nearly equal. A step
 * d = C R with the inverse C of an earlier Jacobian takes a part of the operations, and leaves of an error e what K e is,
 * K = I - C J. K grows with the distance from where C was made: how fast is measured each time that C is made anew, of the
 * old C and the new J. */
#ifndef MWI_CHORD_H
#define MWI_CHORD_H

#include "branch.h"

#ifdef __GNUC__
#define MWI_UNROLLED static inline __attribute__((always_inline))
#else
#define MWI_UNROLLED static inline
#endif

/* What such a step may leave of an error, in natural sizes of the unknowns: less than round-off leaves of solutions. The
 * transmission error is better determined than the place of contact. */
static const double MWI_CHORD_LEFT = 1e-14, MWI_CHORD_LEFT_OF_ERROR = 1e-16;

/* Longer steps say that the points are too far apart. The most that K may be; how many times the distance over which its
 * growth was measured it is believed; how many points C must serve, as making it takes a few steps' time. */
static const double MWI_CHORD_STEP = 1e-11, MWI_CHORD_SHARE = 1.0 / 16.0, MWI_CHORD_BELIEVED = 16.0, MWI_CHORD_WORTH = 8.0;

/* The largest distance where nothing is known of K. */
static const double MWI_CHORD_NOWHERE = -1.0;

/* Points from one attempt to the next where C does not serve so many; each time twice as many. Points from which the next is
 * predicted: so close together, more of them add more of their round-off than of the curve. */
enum { MWI_CHORD_PAUSE = 8, MWI_CHORD_LONGEST_PAUSE = 8192, MWI_CHORD_ROWS = 3 };

/* columns: of C, the inverse of the Jacobian at phi by unknowns in natural sizes; at: the anchor there (see by_anchor()
 * in mw_model.h); span: the largest distance in angle; reach: largest product of a step's size and its distance after which no
 * more is left than may be. left: points until the next attempt. */
typedef struct mwi_chord {
    int made, pause, left;
    double phi, reach, span;
    double columns[MW_MAX_UNKNOWNS][MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    double at[MW_MAX_ANCHOR];
} mwi_chord;

static inline mwi_chord mwi_no_chord(void)
{
    mwi_chord c;
    c.made = c.left = 0;
    c.pause = MWI_CHORD_PAUSE;
    c.phi = c.reach = 0.0;
    c.span = MWI_CHORD_NOWHERE;
    return c;
}

/* Whether a step of this size at phi leaves no more of an error than may be. */
static inline int mwi_chord_reaches(const mwi_chord *c, double phi, double step)
{
    const double distance = mwi_abs(phi - c->phi);
    return distance <= c->span && distance * step <= c->reach;
}

/* x -= C R of n unknowns. Returns the largest change in natural sizes. */
MWI_UNROLLED double mwi_chord_change(const mwi_chord *c, int n, const double *R, double *x)
{
    double change[MW_MAX_UNKNOWNS] = { 0.0 }, size = 0.0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) change[i] += c->columns[j][i] * R[j];
    for (int i = 0; i < n; i++) {
        x[i] -= change[i] * c->scale[i];
        size = mwi_larger(size, mwi_abs(change[i])); /* if R is not a number none of them is */
    }
    return size;
}

/* Predict the point at *phi, the row x, from the MWI_CHORD_ROWS rows of points before it. */
MWI_UNROLLED void mwi_chord_predict(int n, const double *phi, int equal, double *x)
{
    if (equal >= MWI_CHORD_ROWS - 1) {
        for (int j = 0; j < n; j++) x[j] = 3.0 * (x[j - n] - x[j - 2 * n]) + x[j - 3 * n];
        return;
    }
    mwi_history h = mwi_no_history();
    for (int i = MWI_CHORD_ROWS; i > 0; i--) mwi_remember(&h, phi[-i], x - i * n);
    mwi_predict(&h, *phi, n, x);
}

/* Solve the points from number k to before `end` by a step each, as far as they follow from the MWI_CHORD_ROWS points before
 * them and C serves: x[n] and info of each. step: size of the last. Returns the number of the point that is next. */
MWI_UNROLLED size_t mwi_chord_points(const mw_model *m, const mwi_chord *c, const double *s, int n, const double *phi,
                                     size_t k, size_t end, double *x, mw_info *info, double *step)
{
    double last = phi[k - 1] - phi[k - 2], R[MW_MAX_UNKNOWNS];
    int equal = 0, bounded = 0; /* how many spacings before have been equal to the one after them; whether an unknown is */
    for (int i = 0; i < n; i++) bounded |= m->unknowns[i].lower > -HUGE_VAL || m->unknowns[i].upper < HUGE_VAL;
    for (; k < end && mwi_chord_reaches(c, phi[k], *step); k++) {
        double *const point = x + k * (size_t)n, spacing = phi[k] - phi[k - 1];
        equal = mwi_abs(spacing - last) <= MW_EQUAL_SPACING * mwi_abs(spacing) ? equal + 1 : 0;
        last = spacing;
        mwi_chord_predict(n, phi + k, equal, point);
        if (!(m->by_anchor(s, c->at, phi[k], point, R) <= m->nearest)) break;
        *step = mwi_chord_change(c, n, R, point);
        if (!(*step <= MWI_CHORD_STEP && mwi_chord_reaches(c, phi[k], *step))) break;
        if (bounded && !mwi_within_bounds(m, point)) break;
        info[k] = mwi_ended(MW_CONVERGED, 0);
        info[k].iterations = 1;
        info[k].step = *step;
    }
    return k;
}

/* The same for any model: a program for each number of unknowns. */
static inline size_t mwi_chord_run(const mw_model *m, const mwi_chord *c, const double *s, const double *phi, size_t k,
                                   size_t end, double *x, mw_info *info, double *step)
{
    switch (m->nx) {
    case 5: return mwi_chord_points(m, c, s, 5, phi, k, end, x, info, step);
    case 6: return mwi_chord_points(m, c, s, 6, phi, k, end, x, info, step);
    case 7: return mwi_chord_points(m, c, s, 7, phi, k, end, x, info, step);
    default: return mwi_chord_points(m, c, s, m->nx, phi, k, end, x, info, step);
    }
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
            for (int j = 0; j < MW_MAX_UNKNOWNS; j++) row[j] -= c->columns[k][i] * J[k][j];
        sums[i] = 0.0;
        for (int j = 0; j < m->nx; j++) sums[i] += mwi_abs(row[j]);
    }
    for (int i = 0; i < m->nx; i++) {
        most = mwi_larger(most, sums[i]);
        left = mwi_larger(left, sums[i] / (i == m->error ? MWI_CHORD_LEFT_OF_ERROR : MWI_CHORD_LEFT));
    }
    c->reach = 0.0;
    c->span = MWI_CHORD_NOWHERE;
    if (!(most < 2.0 * MWI_CHORD_SHARE)) return;
    c->reach = distance / left;
    c->span = distance * MWI_CHORD_SHARE / most;
    if (c->span > MWI_CHORD_BELIEVED * distance) c->span = MWI_CHORD_BELIEVED * distance;
}

/* Whether to make C anew after a step of this size. */
static inline int mwi_chord_is_due(const mw_model *m, mwi_chord *c, double step)
{
    if (m->by_anchor == NULL || !(step <= MWI_CHORD_STEP)) return 0;
    return c->left-- <= 0;
}

/* One Newton step of x at phi, for which s is set up, with C and the anchor made anew. Its size is infinite where C is not
 * to be had. If steps of that size from points so far apart do not let C serve enough of them, it is not used for a while. */
static inline double mwi_chord_renew(const mw_model *m, mwi_chord *c, const double *s, double phi, double spacing, double *x)
{
    double R[MW_MAX_UNKNOWNS], flat[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS];
    double J[MW_MAX_UNKNOWNS][MW_MAX_UNKNOWNS] = { { 0.0 } };
    const int n = m->nx, known = c->made;
    m->scale(s, c->scale);
    m->anchor(s, phi, x, c->at);
    m->eval(s, x, R, flat);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) J[i][j] = flat[i * n + j] * c->scale[j];
    if (known) mwi_chord_measure(m, c, J, mwi_abs(phi - c->phi));
    c->phi = phi;
    c->made = mwi_invert(n, J);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) c->columns[j][i] = J[i][j];
    const double step = c->made ? mwi_chord_change(c, n, R, x) : HUGE_VAL;
    const int worth = mwi_chord_reaches(c, phi + MWI_CHORD_WORTH * spacing, step);
    if (!(step <= MWI_CHORD_STEP) || (known && !worth)) {
        c->made = 0;
        c->span = MWI_CHORD_NOWHERE;
        c->left = c->pause;
        if (c->pause < MWI_CHORD_LONGEST_PAUSE) c->pause *= 2;
    } else if (known) {
        c->pause = MWI_CHORD_PAUSE;
    }
    return step;
}

#endif
