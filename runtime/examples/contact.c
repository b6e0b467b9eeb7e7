/* One contact of a recess-action worm drive from the generated header alone; compiles as C99 and C++11. */
#include <stdio.h>
#include "cylindrical_worm_zn_zn.h"

#define X(name) cylindrical_worm_zn_zn_##name

int main(void)
{
    const double degree = 3.141592653589793 / 180.0;
    double p[X(NP)], s[X(NS)], y[X(NSTART)], x[X(NX)];
    for (int k = 0; k < X(NP); k++) p[k] = NAN; /* open: filled in by rules and defaults */
    p[1] = 2.0;            /* normal module, mm */
    p[3] = 1.0;            /* threads */
    p[4] = 277.0;          /* teeth */
    p[5] = 3.0 * degree;   /* lead angle */
    p[7] = 10.0 * degree;  /* pressure angle */
    p[9] = 4.0;            /* pitch line shift, mm */
    p[10] = 20.063824;     /* hob pitch radius, mm */
    X(derive)(p);
    if (X(setup)(p, s)) return 2;
    X(set_phi)(s, 7.0);    /* worm angle, rad */
    X(guess)(s, y);
    X(start_solution)(s, y, x); /* start values in the middle of the flanks */
    int steps = 0;
    while (X(step)(s, x) > 1e-9)
        if (++steps == 50) return 1;
    printf("transmission error %.6f arcsec after %d steps\n", x[4] * 648000.0 / 3.141592653589793, steps + 1);
    return 0;
}
