/* Many designs of the drive MW_DRIVE at the same angles, a thread of a device each: the bits of mw_trace_designs without fused
 * products, and of mw_contact_points.  SPDX-License-Identifier: MIT-0
 *
 * Its entry is mw_samples. A host compiles the same text to a loop over the threads. */
#define MW_DEVICE_ONLY
#include "names.h"
#include MW_GENERATED()

#define MW_NX MW_OF(_NX)

/* The angles of a trace: those that are asked for, and so many parts from each to the next. */
typedef struct trace {
    const double *phi;
    int parts, count, uniform;
} trace;

MW_DEVICE static double angle_of(const trace *t, int k)
{
    return mwi_angle_between(t->phi, t->parts, k);
}

/* uniform: whether they are equally spaced, as of lane_follow.h. */
MW_DEVICE static trace trace_of(const double *phi, int n)
{
    trace t = { phi, n < MW_MOST_BETWEEN ? mwi_parts_of(phi, n) : 1, 0, 0 };
    double worst = 0.0;
    t.count = (n - 1) * t.parts + 1;
    for (int k = 1; k + 1 < t.count; k++) {
        const double bend = mwi_abs(angle_of(&t, k + 1) - 2.0 * angle_of(&t, k) + angle_of(&t, k - 1));
        const double excess = bend - MW_EQUAL_SPACING * mwi_abs(angle_of(&t, 1) - angle_of(&t, 0));
        worst = excess > worst ? excess : worst;
    }
    t.uniform = worst <= 0.0;
    return t;
}

/* Point k from those before it: at[0] is the newest. */
MW_DEVICE static void predict(const trace *t, int k, double at[MW_HISTORY][MW_NX], double *x)
{
    double weight[MW_HISTORY], phi[MW_HISTORY + 1];
    const int count = k < MW_HISTORY ? k : MW_HISTORY;
    if (t->uniform && k >= MW_HISTORY) {
        for (int j = 0; j < MW_NX; j++) x[j] = MW_PREDICT_CUBIC(at[0][j], at[1][j], at[2][j], at[3][j]);
        return;
    }
    for (int j = 0; j <= count; j++) phi[j] = angle_of(t, k - j);
    for (int i = 0; i < count; i++) {
        weight[i] = 1.0;
        for (int j = 0; j < count; j++)
            if (j != i) weight[i] *= (phi[0] - phi[1 + j]) / (phi[1 + i] - phi[1 + j]);
    }
    for (int j = 0; j < MW_NX; j++) {
        x[j] = 0.0;
        for (int i = 0; i < count; i++) x[j] += weight[i] * at[i][j];
    }
}

/* Newton's method while its steps halve; returns whether the last is small, and the unknowns within their bounds. */
MW_DEVICE static int settle(const double *s, double *x)
{
    double size = MW_OF(_step)(s, x);
    if (!(size <= MW_STEP_LIMIT)) return 0;
    for (int step = 2; step <= MW_MAX_FUSED && !(size < MW_FUSED_TOLERANCE); step++) {
        const double previous = size;
        size = MW_OF(_step)(s, x);
        if (!(size < MW_FUSED_TOLERANCE) && !(size < 0.5 * previous)) return 0;
    }
    return size < MW_FUSED_TOLERANCE && mwi_within_bounds(&MW_OF(_model), x);
}

/* Points of contact, fixed frame, and flags, as of mw_contact_points; returns the status. */
MW_DEVICE static int look(const double *s, const double *x, double *o, double *point, unsigned *flags)
{
    mw_contact c;
    const int status = MW_OF(_geometry)(s, x, o, &c);
    *flags = 0;
    for (int i = 0; i < 3; i++) point[i] = NAN;
    if (status < 0 || status == MW_LINE_CONTACT) return status;
    for (int i = 0; i < 3; i++) point[i] = c.point[i];
    *flags = c.flags;
    return mwi_nearly_flat(&c) ? MW_CONVERGED_NOISE : status;
}

/* One design p[NP] at angles phi[n]. Returns 0 where its trace does not go through: the host is to solve it. */
MW_DEVICE static int sample(const double *p, const double *phi, int n, const double *start, int *status, unsigned *flags,
                            double *error, double *points)
{
    double s[MW_OF(_NS)], o[MW_OF(_NO)], at[MW_HISTORY][MW_NX], x[MW_NX];
    const trace t = trace_of(phi, n);
    if (MW_OF(_setup)(p, s)) return 0;
    for (int k = 0; k < t.count; k++) {
        const double here = angle_of(&t, k);
        if (k == 0) mwi_copy(x, start, MW_NX);
        else if (k == 1) mwi_along_tangent(&MW_OF(_model), s, phi[0], at[0], here, x);
        else predict(&t, k, at, x);
        MW_OF(_set_phi)(s, here);
        if (!settle(s, x)) return 0;
        for (int i = MW_HISTORY - 1; i > 0; i--) mwi_copy(at[i], at[i - 1], MW_NX);
        mwi_copy(at[0], x, MW_NX);
        if (k % t.parts) continue;
        const int own = k / t.parts;
        status[own] = look(s, x, o, points + 3 * own, flags + own);
        error[own] = status[own] < 0 ? NAN : x[MW_OF(_model).error];
    }
    return mwi_touch(&MW_OF(_model), x, o) >= 0;
}

/* designs: how many there are in p[designs * NP]; phi[n] in the order of the trace, start[NX] near the contacts at phi[0];
 * through[designs]: what sample() returns; status, flags, error[designs * n], points[designs * n * 3]. */
#if MW_OF_DEVICES
extern "C" __global__ void mw_samples(
#else
void mw_samples(const double *p, long long designs, const double *phi, int n, const double *start, int *through, int *status,
                unsigned *flags, double *error, double *points);
void mw_samples(
#endif
    const double *p, long long designs, const double *phi, int n, const double *start, int *through, int *status,
    unsigned *flags, double *error, double *points)
{
#if MW_OF_DEVICES
    const long long first = (long long)blockIdx.x * blockDim.x + threadIdx.x, next = first < designs ? first + 1 : first;
#else
    const long long first = 0, next = designs;
#endif
    for (long long k = first; k < next; k++)
        through[k] = sample(p + k * MW_OF(_NP), phi, n, start, status + k * n, flags + k * n, error + k * n, points + 3 * k * n);
}
