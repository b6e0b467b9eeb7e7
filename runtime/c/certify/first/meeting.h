/* Where the pinion meets a part of the wheel's flank: polynomials from Newton's method, bounds from Krawczyk's operator.
 * SPDX-License-Identifier: MIT-0 */
#ifndef MWC_FIRST_MEETING_H
#define MWC_FIRST_MEETING_H

#include "parts.h"

/* How far place `p` of the pinion is apart from `w` of the wheel, rad, positive where it does not overlap. */
static mwc_sheet apart(const search *h, const place *p, const place *w)
{
    const mwc_sheet across = mwc_sheet_sub(mwc_sheet_mul(w->x[0], p->x[1]), mwc_sheet_mul(w->x[1], p->x[0]));
    const mwc_sheet along = mwc_sheet_add(mwc_sheet_mul(w->x[0], p->x[0]), mwc_sheet_mul(w->x[1], p->x[1]));
    return mwc_sheet_times(mwc_sheet_atan2(across, along), mwc_make(h->sense, 0.0));
}

/* Residual of the place of the pinion's flank at q against the wheel's part, and unless NULL its Jacobian. */
static void against(search *h, const mwc_sheet *q, const place *w, const mwc_sheet *square, place *p, mwc_sheet *R, mwc_sheet *J)
{
    mwc_sheet tangents[2][3];
    on_flank(h, 0, q, J ? TANGENTS : POINT, p, tangents);
    R[0] = mwc_sheet_sub(squared(p->x), *square);
    R[1] = mwc_sheet_sub(p->x[2], w->x[2]);
    for (int k = 0; J && k < 2; k++) {
        const mwc_sheet *t = tangents[k];
        J[k] = mwc_sheet_times(mwc_sheet_add(mwc_sheet_mul(p->x[0], t[0]), mwc_sheet_mul(p->x[1], t[1])), mwc_make(2.0, 0.0));
        J[2 + k] = t[2];
    }
}

/* The same at s = t = u = 0 in plain numbers, of the wheel's point x with this squared distance. */
static void against_at(search *h, const double *q, double square, double along, mw_ball *R, mw_ball *J)
{
    const mw_code *code = &h->tables->flanks[0];
    mw_ball registers[MWC_REGISTERS], x[3][3];
    for (int i = 0; i < 2; i++) h->middle[h->tables->slots + i] = mwc_make(q[i], 0.0);
    mwc_run_ball(code, code->instructions, h->middle, registers);
    for (int n = 0; n < 3; n++) { /* point and tangents */
        const unsigned short *from = code->output + (n ? REGULAR + h->margins[0] + 3 * (n - 1) : 0);
        for (int i = 0; i < 3; i++) {
            x[n][i] = mwc_make(n ? 0.0 : h->move[i].c[0], 0.0);
            for (int j = 0; j < 3; j++) x[n][i].mid += h->turn[3 * i + j].c[0] * registers[from[j]].mid;
        }
    }
    R[0].mid = x[0][0].mid * x[0][0].mid + x[0][1].mid * x[0][1].mid - square;
    R[1].mid = x[0][2].mid - along;
    for (int k = 0; k < 2; k++) {
        J[k].mid = 2.0 * (x[0][0].mid * x[1 + k][0].mid + x[0][1].mid * x[1 + k][1].mid);
        J[2 + k].mid = x[1 + k][2].mid;
    }
}

/* Parameters at[2] that nearly meet the middle of the wheel's part at u = 0, by Newton's method in plain numbers, and C[4],
 * nearly the inverse Jacobian there. 0 where it leads out of the box. */
static int centred(search *h, const place *w, double square, const range *hull, double *at, double *C)
{
    double from[2];
    mw_ball R[2], J[4];
    for (int i = 0; i < 2; i++) at[i] = from[i] = h->follow[i].c[0] + 0.5 * hull[i].low + 0.5 * hull[i].high;
    for (int step = 0; step < NEWTON_STEPS; step++) {
        double size = 0.0;
        against_at(h, at, square, w->x[2].c[0], R, J);
        if (!mwc_inverse(2, J, C)) return 0;
        for (int i = 0; i < 2; i++) {
            const double by = C[2 * i] * R[0].mid + C[2 * i + 1] * R[1].mid;
            at[i] -= by;
            if (!(mwc_abs(at[i] - from[i]) < 4.0 * width(hull[i]))) return 0;
            size = fmax(size, mwc_abs(by) / width(hull[i]));
        }
        if (size < 1e-9) return 1;
    }
    return 0;
}

/* Where the pinion meets a part of the wheel's flank: parameters, the inverse of the Jacobian there, nearly, and a box that
 * follows the contact, in which nothing but these meets it, with C and M = |I - C J| over it. */
typedef struct met {
    mwc_sheet q[2], inverse[4];
    range hull[2];
    double C[4], M[4];
    int close; /* whether the parameters are close enough to be those of a half of the part, nearly */
} met;

/* A step of Newton's method on polynomials, with the inverse Jacobian there if J is given, else the last one. */
static int step_on(met *at, const mwc_sheet *R, const mwc_sheet *J)
{
    if (J) {
        const mwc_sheet det = mwc_sheet_sub(mwc_sheet_mul(J[0], J[3]), mwc_sheet_mul(J[1], J[2]));
        const mwc_sheet over = mwc_sheet_div(number(1.0), det);
        if (!(mwc_abs(det.c[0]) > 0.0)) return 0;
        for (int k = 0; k < 4; k++) at->inverse[k] = mwc_sheet_mul(J[k == 0 ? 3 : k == 3 ? 0 : k], over);
    }
    for (int i = 0; i < 2; i++) {
        const mwc_sheet first = mwc_sheet_mul(at->inverse[3 * i], R[i]), second = mwc_sheet_mul(at->inverse[1 + i], R[1 - i]);
        at->q[i] = mwc_sheet_sub(at->q[i], mwc_sheet_sub(first, second));
        at->q[i].radius = 0.0;
    }
    return 1;
}

/* Polynomials that nearly meet the wheel's part, whichever, from parameters that meet its middle: two steps of Newton's method
 * and one with the last Jacobian. */
static int sought(search *h, const place *w, const mwc_sheet *square, const double *from, met *at)
{
    mwc_sheet R[2], J[4];
    place p;
    for (int i = 0; i < 2; i++) at->q[i] = h->follow[i], at->q[i].c[0] = from[i];
    for (int step = 0; step < 3; step++) {
        against(h, at->q, w, square, &p, R, step < 2 ? J : NULL);
        if (!step_on(at, R, step < 2 ? J : NULL)) return 0;
    }
    return 1;
}

/* |I - C J| over a box of the pinion's parameters that follows the contact. */
static void defect(search *h, const range *box, const place *w, const mwc_sheet *square, const double *C, double *M)
{
    mwc_sheet b[2], R[2], J[4];
    place p;
    following(h, box, b);
    against(h, b, w, square, &p, R, J);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            mwc_sheet sum = number(i == j ? 1.0 : 0.0);
            for (int k = 0; k < 2; k++)
                sum = mwc_sheet_sub(sum, mwc_sheet_times(J[2 * k + j], mwc_make(C[2 * i + k], 0.0)));
            M[2 * i + j] = mwc_sheet_most(&sum);
        }
}

/* Whether the steps e = |C R| + M e come to an end. */
static int shrinks(const double *M)
{
    return M[0] < 1.0 && M[3] < 1.0 && (1.0 - M[0]) * (1.0 - M[3]) > M[1] * M[2];
}

/* Parameters that nearly meet the wheel's part, from the parts of the pinion's flank that may. 0 where their box is too large,
 * or Newton's method leads out of it. */
static int found_within(search *h, const place *w, const mwc_sheet *square, const part *list, int count, met *at)
{
    double from[2];
    memcpy(at->hull, list[0].within, sizeof at->hull);
    for (int k = 1; k < count; k++)
        for (int i = 0; i < 2; i++) {
            at->hull[i].low = fmin(at->hull[i].low, list[k].within[i].low);
            at->hull[i].high = fmax(at->hull[i].high, list[k].within[i].high);
        }
    for (int i = 0; i < 2; i++) { /* that something meets it is shown inside the box alone */
        const double beside = BESIDE * width(at->hull[i]);
        at->hull[i].low -= beside;
        at->hull[i].high += beside;
    }
    if (!centred(h, w, square->c[0], at->hull, from, at->C)) return 0;
    defect(h, at->hull, w, square, at->C, at->M);
    if (!shrinks(at->M)) return 0;
    return sought(h, w, square, from, at);
}

/* The same from those of a part of which the wheel's is half, within their bounds if these are closer than the box. */
static int found_of_whole(search *h, const place *w, const mwc_sheet *square, int side, double end, met *at)
{
    mwc_sheet R[2], J[4];
    range about[2];
    double C[4], M[4], from[2];
    place p;
    for (int i = 0; i < 2; i++) {
        mwc_cube_half(at->q + i, side, end);
        const mwc_sheet beside = mwc_sheet_sub(at->q[i], h->follow[i]);
        const range r = mwc_cube_range(&beside);
        const double more = BESIDE * width(r);
        about[i].low = fmax(at->hull[i].low, r.low - more);
        about[i].high = fmin(at->hull[i].high, r.high + more);
        if (!(about[i].low < about[i].high)) return 0;
        at->q[i].radius = 0.0;
    }
    if (!centred(h, w, square->c[0], about, from, C)) return 0;
    defect(h, about, w, square, C, M);
    if (shrinks(M)) {
        memcpy(at->hull, about, sizeof about);
        memcpy(at->C, C, sizeof C);
        memcpy(at->M, M, sizeof M);
    }
    against(h, at->q, w, square, &p, R, J);
    return step_on(at, R, J);
}

/* Bounds of how far the parameters are off: whatever within the box meets the wheel's part lies within them, and where `exists`
 * something does. They may be any polynomials, C any matrix, and J, which does not depend on the wheel, is over a box that
 * holds them: what meets the wheel is apart from them by |C R| + |I - C J| times as much at most, over and over again. */
static void bounded(search *h, const place *w, const mwc_sheet *square, met *at, place *p, int *exists)
{
    mwc_sheet R[2];
    mw_ball z[2];
    double K[2], within[2], wider[2], far[2];
    int beyond = 0;
    against(h, at->q, w, square, p, R, NULL);
    for (int i = 0; i < 2; i++) {
        const mwc_sheet shift = mwc_sheet_add(mwc_sheet_times(R[0], mwc_make(at->C[2 * i], 0.0)),
                                              mwc_sheet_times(R[1], mwc_make(at->C[2 * i + 1], 0.0)));
        const mwc_sheet beside = mwc_sheet_sub(at->q[i], h->follow[i]);
        const range r = mwc_cube_range(&beside);
        range *hull = at->hull + i;
        z[i] = mwc_make(0.0, mwc_sheet_most(&shift));
        beyond = beyond || !(r.low >= hull->low && r.high <= hull->high);
        hull->low = fmin(hull->low, r.low);
        hull->high = fmax(hull->high, r.high);
        far[i] = fmin(r.low - hull->low, hull->high - r.high);
        within[i] = width(*hull) * (1.0 + 1e-9);
    }
    if (beyond) defect(h, at->hull, w, square, at->C, at->M);
    for (int step = 0; step < NARROWING_STEPS; step++) {
        mwc_image(2, z, at->M, within, K);
        for (int i = 0; i < 2; i++)
            if (K[i] < within[i]) within[i] = K[i];
    }
    *exists = at->close = 1;
    for (int i = 0; i < 2; i++) {
        at->close = at->close && within[i] < NEARLY * width(at->hull[i]);
        wider[i] = 2.0 * within[i] + 4.0 * MWC_U * mwc_abs(at->q[i].c[0]);
        *exists = *exists && wider[i] < far[i] * (1.0 - 1e-9);
    }
    mwc_image(2, z, at->M, wider, K);
    *exists = *exists && mwc_inside(2, K, wider);
    for (int i = 0; i < 2; i++) at->q[i].radius = within[i];
    on_flank(h, 0, at->q, LIMITS, p, NULL);
}

#endif
