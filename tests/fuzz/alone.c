/* <drive>_solve of the drive's header alone, for tests/fuzz/interface.c.  SPDX-License-Identifier: MIT-0 */
#include "names.h"
#include MW_GENERATED()

int MW_PASTE(fuzz_alone_, MW_DRIVE)(double *s, double phi, double *x, mw_info *info);
int MW_PASTE(fuzz_alone_, MW_DRIVE)(double *s, double phi, double *x, mw_info *info)
{
    return MW_OF(_solve)(s, phi, x, info);
}

/* The drive's entries for CasADi, 0 to 3: complete, contact and the Jacobians of both; -1 asks all what they are called and
 * how large they are. */
#define MW_ENTRIES(X) X(, _complete) X(, _contact) X(jac_, _complete) X(jac_, _contact)
#define MW_ENTRY_DECLARED(before, after) \
    int MW_PASTE(MW_PASTE(before, MW_DRIVE), after)(const double **arg, double **res, long long *iw, double *w, int mem); \
    long long MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_n_in)(void); \
    long long MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_n_out)(void); \
    const char *MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_name_in)(long long i); \
    const char *MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_name_out)(long long i); \
    const long long *MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_sparsity_in)(long long i); \
    const long long *MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_sparsity_out)(long long i); \
    int MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_work)(long long *a, long long *r, long long *i, long long *w);
MW_ENTRIES(MW_ENTRY_DECLARED)

#define MW_ENTRY_ASKED(before, after) \
    for (long long i = -1; i < 6; i++) { \
        const int in = i >= 0 && i < MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_n_in)(); \
        const int out = i >= 0 && i < MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_n_out)(); \
        wrong += (MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_name_in)(i) != NULL) != in; \
        wrong += (MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_name_out)(i) != NULL) != out; \
        wrong += (MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_sparsity_in)(i) != NULL) != in; \
        wrong += (MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_sparsity_out)(i) != NULL) != out; \
    } \
    MW_PASTE(MW_PASTE(before, MW_DRIVE), after##_work)(&size[0], &size[1], &size[2], &size[3]); \
    wrong += size[0] < 1 || size[1] < 1 || size[2] != 0 || size[3] < 0;

#define MW_ENTRY_LISTED(before, after) MW_PASTE(MW_PASTE(before, MW_DRIVE), after),

int MW_PASTE(fuzz_casadi_, MW_DRIVE)(int which, const double **arg, double **res, double *w);
int MW_PASTE(fuzz_casadi_, MW_DRIVE)(int which, const double **arg, double **res, double *w)
{
    static int (*const entries[])(const double **, double **, long long *, double *, int) = { MW_ENTRIES(MW_ENTRY_LISTED) };
    long long size[4];
    int wrong = 0;
    if (which >= 0) return entries[which](arg, res, NULL, w, 0);
    MW_ENTRIES(MW_ENTRY_ASKED)
    return wrong;
}
