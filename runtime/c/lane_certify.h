/* Krawczyk's test in lanes for one instruction set: see lane_kernels.h and certify/ball.h.  SPDX-License-Identifier: MIT-0
 *
 * The drive's table of operations runs on as many points at once as there are lanes; the bounds are those of ball.h. Products
 * that a compiler fuses into sums here are rounded once instead of twice: the bounds hold as well. */
#include "certify/krawczyk.h"
#include "certify/tables.h"

/* One number of every lane. */
typedef struct lane_ball {
    double mid[MW_LANES], radius[MW_LANES];
} lane_ball;

#define EACH _Pragma("omp simd") for (int l = 0; l < MW_LANES; l++)
#define BALL(a) mwc_make((a)->mid[l], (a)->radius[l])
#define PUT(r, value) do { const mw_ball put = value; (r)->mid[l] = put.mid; (r)->radius[l] = put.radius; } while (0)

/* What a function reads, from argument number `first` on: registers of inputs and constants are never written again. */
static void lane_load(const mw_code *code, int first, const lane_ball *arguments, lane_ball *registers)
{
    lane_ball *constants = registers + code->inputs;
    for (int k = 0; k < code->inputs; k++)
        if (code->input[k] >= first) registers[k] = arguments[code->input[k]];
    for (int k = 0; first == 0 && k < code->constants; k++) {
        const mw_ball c = mwc_of_wide(code->constant[k]);
        EACH PUT(constants + k, c);
    }
}

static void lane_run(const mw_code *code, int count, lane_ball *registers)
{
    const unsigned short *i = code->operation, *const end = i + 4 * count;
    for (; i < end; i += 4) {
        lane_ball *const r = registers + i[1];
        const lane_ball *const a = registers + i[2], *const b = registers + i[3];
        switch (i[0]) {
        case MW_OP_ADD: EACH PUT(r, mwc_add(BALL(a), BALL(b))); break;
        case MW_OP_SUB: EACH PUT(r, mwc_sub(BALL(a), BALL(b))); break;
        case MW_OP_MUL: EACH PUT(r, mwc_mul(BALL(a), BALL(b))); break;
        case MW_OP_SQR: EACH PUT(r, mwc_sqr(BALL(a))); break;
        case MW_OP_DIV: EACH PUT(r, mwc_div(BALL(a), BALL(b))); break;
        case MW_OP_NEG: EACH PUT(r, mwc_neg(BALL(a))); break;
        case MW_OP_SQRT: for (int l = 0; l < MW_LANES; l++) PUT(r, mwc_sqrt(BALL(a))); break;
        case MW_OP_SINCOS: {
            lane_ball *const cosine = registers + i[3];
            EACH {
                mw_ball s, c;
                mwc_sincos(BALL(a), &s, &c);
                PUT(r, s);
                PUT(cosine, c);
            }
            break;
        }
        case MW_OP_ATAN2: for (int l = 0; l < MW_LANES; l++) PUT(r, mwc_atan2(BALL(a), BALL(b))); break;
        default: for (int l = 0; l < MW_LANES; l++) PUT(r, mwc_sign(BALL(a))); break;
        }
    }
}

/* Inverses of J's midpoints in every lane, rows in the order that lane 0 needs: any matrix near them will do. */
static int lane_inverse(int n, const lane_ball *J, double (*C)[MW_LANES])
{
    double a[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS][MW_LANES], by[MW_LANES], f[MW_LANES];
    for (int i = 0; i < n * n; i++) EACH a[i][l] = J[i].mid[l], C[i][l] = i % (n + 1) == 0 ? 1.0 : 0.0;
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (mwc_abs(a[i * n + k][0]) > mwc_abs(a[pivot * n + k][0])) pivot = i;
        for (int j = 0; pivot != k && j < n; j++) EACH {
            const double t = a[k * n + j][l], s = C[k * n + j][l];
            a[k * n + j][l] = a[pivot * n + j][l], a[pivot * n + j][l] = t;
            C[k * n + j][l] = C[pivot * n + j][l], C[pivot * n + j][l] = s;
        }
        EACH by[l] = 1.0 / a[k * n + k][l];
        for (int j = k; j < n; j++) EACH a[k * n + j][l] *= by[l];
        for (int j = 0; j < n; j++) EACH C[k * n + j][l] *= by[l];
        for (int i = 0; i < n; i++) {
            if (i == k) continue;
            EACH f[l] = a[i * n + k][l];
            for (int j = k + 1; j < n; j++) EACH a[i * n + j][l] -= f[l] * a[k * n + j][l];
            for (int j = 0; j < n; j++) EACH C[i * n + j][l] -= f[l] * C[k * n + j][l];
        }
    }
    return 1;
}

/* |z| + M d */
static void lane_image(int n, double (*z)[MW_LANES], double (*M)[MW_LANES], double (*d)[MW_LANES], double (*K)[MW_LANES])
{
    for (int i = 0; i < n; i++) {
        EACH K[i][l] = z[i][l];
        for (int j = 0; j < n; j++) EACH K[i][l] += M[i * n + j][l] * d[j][l];
        EACH K[i][l] *= MWC_READ;
    }
}

/* MW_LANES points: arguments hold the state of the design as balls, registers what the equations read of it unless this is
 * the first call; phi, x[nx], half-widths d[nx] of the boxes. */
static void lane_certify(const mw_certified *t, int n, int error, int first, lane_ball *arguments, lane_ball *registers,
                         const mw_wide *phi, const double *x, const double *d, unsigned char *unique, mw_ball *errors)
{
    lane_ball at[MWC_REGISTERS], R[MW_MAX_UNKNOWNS], *const unknowns = arguments + t->slots;
    double C[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS][MW_LANES], M[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS][MW_LANES];
    double z[MW_MAX_UNKNOWNS][MW_LANES], box[MW_MAX_UNKNOWNS][MW_LANES], K[MW_MAX_UNKNOWNS][MW_LANES], ok[MW_LANES];
    lane_ball J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS];
    for (int l = 0; l < MW_LANES; l++) PUT(unknowns, mwc_of_wide(phi[l]));
    lane_load(&t->instant, 0, arguments, at);
    lane_run(&t->instant, t->instant.instructions, at);
    for (int i = t->design_slots; i < t->slots; i++) arguments[i] = at[t->instant.output[i - t->design_slots]];
    for (int i = 0; i < n; i++)
        for (int l = 0; l < MW_LANES; l++) {
            unknowns[i].mid[l] = x[l * n + i];
            unknowns[i].radius[l] = 0.0;
            box[i][l] = d[i];
        }
    lane_load(&t->equations, first ? 0 : t->design_slots, arguments, registers);
    lane_run(&t->equations, t->equations.first, registers);
    for (int i = 0; i < n; i++) R[i] = registers[t->equations.output[i]];
    for (int i = 0; i < n; i++) EACH unknowns[i].radius[l] = box[i][l];
    lane_load(&t->equations, t->slots, arguments, registers);
    lane_run(&t->equations, t->equations.instructions, registers);
    for (int i = 0; i < n * n; i++) J[i] = registers[t->equations.output[n + i]];
    lane_inverse(n, J, C);
    for (int i = 0; i < n; i++) {
        double sum[MW_LANES], radius[MW_LANES];
        EACH sum[l] = radius[l] = 0.0;
        for (int k = 0; k < n; k++) EACH {
            const double p = C[i * n + k][l] * R[k].mid[l];
            sum[l] += p;
            radius[l] += mwc_abs(C[i * n + k][l]) * R[k].radius[l] + (MWC_U * (mwc_abs(p) + mwc_abs(sum[l])) + MWC_TINY);
        }
        EACH z[i][l] = (mwc_abs(sum[l]) + radius[l]) * MWC_READ;
        for (int j = 0; j < n; j++) {
            EACH sum[l] = i == j ? 1.0 : 0.0, radius[l] = 0.0;
            for (int k = 0; k < n; k++) EACH {
                const double p = C[i * n + k][l] * J[k * n + j].mid[l];
                sum[l] -= p;
                radius[l] += mwc_abs(C[i * n + k][l]) * J[k * n + j].radius[l]
                             + (MWC_U * (mwc_abs(p) + mwc_abs(sum[l])) + MWC_TINY);
            }
            EACH M[i * n + j][l] = (mwc_abs(sum[l]) + radius[l]) * MWC_READ;
        }
    }
    lane_image(n, z, M, box, K);
    EACH ok[l] = 1.0;
    for (int i = 0; i < n; i++) EACH ok[l] = K[i][l] < box[i][l] ? ok[l] : 0.0;
    lane_image(n, z, M, K, box); /* from K < d on, the same about K, and once more */
    lane_image(n, z, M, box, K);
    for (int l = 0; l < MW_LANES; l++) {
        unique[l] = ok[l] > 0.0;
        errors[l] = mwc_make(x[l * n + error], ok[l] > 0.0 ? K[error][l] : HUGE_VAL);
    }
}

#undef EACH
#undef BALL
#undef PUT
