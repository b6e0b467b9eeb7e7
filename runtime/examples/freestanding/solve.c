/* A solver for a controller or a web page: parameters and start values in, unknowns out, no C library.
 * Compile with -DDRIVE=cylindrical_worm_zn_zn -DHEADER='"cylindrical_worm_zn_zn.h"'. */
#include HEADER

#define JOIN2(drive, name) drive##_##name
#define JOIN(drive, name) JOIN2(drive, name)
#define X(name) JOIN(DRIVE, name)

/* Newton from x[NX] at input angle phi with complete parameters p[NP]; s[NS] is work. Returns the steps taken, or a
 * negative number. */
int solve(const double *p, double phi, double *s, double *x)
{
    if (X(setup)(p, s)) return -1;
    X(set_phi)(s, phi);
    for (int steps = 1; steps <= 30; steps++)
        if (X(step)(s, x) < 1e-13) return steps;
    return 30; /* as close as round-off lets it */
}
