/* A solver for a controller or a web page: parameters in, unknowns out, no C library.
 * Compile with -DDRIVE=cylindrical_worm_zn_zn -DHEADER='"cylindrical_worm_zn_zn.h"'. */
#include HEADER

#define JOIN2(drive, name) drive##_##name
#define JOIN(drive, name) JOIN2(drive, name)
#define X(name) JOIN(DRIVE, name)

/* The contact x[NX] at input angle phi for complete parameters p[NP]; s[NS] is work. Returns the steps taken from the
 * last prediction, or the negative status that says why there is none. */
int solve(const double *p, double phi, double *s, double *x)
{
    mw_info info;
    if (X(setup)(p, s)) return MW_BAD_INPUT;
    return X(solve)(s, phi, x, &info) < 0 ? info.status : info.iterations;
}
