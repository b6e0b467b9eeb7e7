/* Contact geometry at a solution: curvatures, directions, flags.  SPDX-License-Identifier: MIT-0 */
#include <math.h>
#include <string.h>
#include "meshwright.h"

/* Relative curvature below this share of the larger one is zero to round-off. */
static const double LINE_SHARE = 1e-10;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void normalise(double *a)
{
    const double length = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++) a[i] /= length;
}

/* Two independent directions in parameter space along the surface: all of it, or the null space of one condition. */
static void along_surface(const mw_body *b, const double *slopes, double N[2][3])
{
    memset(N, 0, 6 * sizeof(double));
    if (b->conditions == 0) {
        N[0][0] = N[1][1] = 1.0;
        return;
    }
    int pivot = 0;
    for (int i = 1; i < b->parameters; i++)
        if (fabs(slopes[i]) > fabs(slopes[pivot])) pivot = i;
    for (int i = 0, k = 0; i < b->parameters; i++)
        if (i != pivot) {
            N[k][i] = slopes[pivot];
            N[k][pivot] = -slopes[i];
            k++;
        }
}

/* Second fundamental form of a body along its own outward normal, in the tangent basis e. */
static void second_form(const mw_body *b, const double *o, double e[2][3], double K[3])
{
    const double *d = o + b->at;
    double N[2][3], M[2][2], D[2][2];
    along_surface(b, d + 6 * b->parameters, N);
    memset(M, 0, sizeof M);
    memset(D, 0, sizeof D);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < b->parameters; i++)
            for (int r = 0; r < 2; r++) {
                M[r][k] += N[k][i] * dot(e[r], d + 6 * i);
                D[r][k] += N[k][i] * dot(e[r], d + 6 * i + 3);
            }
    const double det = M[0][0] * M[1][1] - M[0][1] * M[1][0];
    K[0] = -(D[0][0] * M[1][1] - D[0][1] * M[1][0]) / det;
    K[2] = -(D[1][1] * M[0][0] - D[1][0] * M[0][1]) / det;
    K[1] = -0.5 * ((D[0][1] * M[0][0] - D[0][0] * M[0][1]) + (D[1][0] * M[1][1] - D[1][1] * M[1][0])) / det;
}

static unsigned flags_of(const mw_model *m, const double *o, double curvature_min, int line)
{
    unsigned flags = 0, bit = 4;
    for (int b = 0; b < 2; b++)
        if (o[m->bodies[b].regular] < 0.0) flags |= 1u;
    if (curvature_min < 0.0 && !line) flags |= 2u;
    for (int b = 0; b < 2; b++)
        for (int i = 0; i < m->bodies[b].margins; i++, bit <<= 1)
            if (o[m->bodies[b].margin + i] < 0.0) flags |= bit;
    return flags;
}

int mw_impossible(const char *flag)
{
    return strcmp(flag, "interference") == 0 || strcmp(flag, "spurious_sheet") == 0 || strcmp(flag, "not_first") == 0;
}

const char *mw_flag(const mw_model *m, int bit)
{
    if (bit == 0) return "undercut";
    if (bit == 1) return "interference";
    bit -= 2;
    for (int b = 0; b < 2; bit -= m->bodies[b].margins, b++)
        if (bit < m->bodies[b].margins) return m->bodies[b].flags[bit];
    return NULL;
}

int mw_contact_at(const mw_model *m, const double *s, const double *x, double *o, mw_contact *c)
{
    double e[2][3], first[3], second[3], K[3];
    m->observe(s, x, o);
    const double *pinion = o, *wheel = o + 6; /* point and normal of each, fixed frame */
    memset(c, 0, sizeof *c);
    for (int i = 0; i < 3; i++) {
        c->point[i] = 0.5 * (pinion[i] + wheel[i]);
        c->normal[i] = pinion[3 + i];
        c->distance += (pinion[i] - wheel[i]) * (pinion[i] - wheel[i]);
        c->misfit += (pinion[3 + i] + wheel[3 + i]) * (pinion[3 + i] + wheel[3 + i]);
        e[0][i] = o[m->bodies[0].at + i];
    }
    c->distance = sqrt(c->distance);
    c->misfit = sqrt(c->misfit);
    const double along = dot(e[0], c->normal);
    for (int i = 0; i < 3; i++) e[0][i] -= along * c->normal[i];
    normalise(e[0]);
    cross(c->normal, e[0], e[1]);
    second_form(&m->bodies[0], o, e, first);
    second_form(&m->bodies[1], o, e, second);
    /* second is along the wheel's outward normal, which is minus the contact normal */
    for (int i = 0; i < 3; i++) K[i] = -second[i] - first[i];
    const double mean = 0.5 * (K[0] + K[2]), half = 0.5 * (K[0] - K[2]);
    const double radius = sqrt(half * half + K[1] * K[1]);
    c->curvature_max = mean + radius;
    c->curvature_min = mean > 0.0 ? (K[0] * K[2] - K[1] * K[1]) / c->curvature_max : mean - radius;
    /* eigenvector of the smaller eigenvalue */
    const double u = half > 0.0 ? -K[1] : half - radius;
    const double v = half > 0.0 ? half + radius : K[1];
    const double length = sqrt(u * u + v * v);
    for (int i = 0; i < 3; i++) c->major[i] = length > 0.0 ? (u * e[0][i] + v * e[1][i]) / length : e[0][i];
    c->line = fabs(c->curvature_min) <= LINE_SHARE * fabs(c->curvature_max);
    c->flags = flags_of(m, o, c->curvature_min, c->line);
    return c->line ? MW_LINE_CONTACT : MW_CONVERGED;
}

void mw_flank(mw_surface flank, int parameters, int outputs, const double *s, const double *q, size_t n, double *o)
{
    for (size_t k = 0; k < n; k++, q += parameters, o += outputs) flank(s, q, o);
}
