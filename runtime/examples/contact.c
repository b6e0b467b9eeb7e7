/* One contact of a recess-action worm drive from the generated header alone; compiles as C99 and C++11. */
#include <stdio.h>
#include "cylindrical_worm_zn_zn.h"

#define X(name) cylindrical_worm_zn_zn_##name

int main(void)
{
    const double degree = 3.141592653589793 / 180.0;
    double p[X(NP)], s[X(NS)], x[X(NX)];
    mw_info info;
    for (int k = 0; k < X(NP); k++) p[k] = NAN; /* open: filled in by rules and defaults */
    p[X(P_normal_module_mm)] = 2.0;
    p[X(P_worm_threads)] = 1.0;
    p[X(P_wheel_teeth)] = 277.0;
    p[X(P_worm_lead_angle_deg)] = 3.0 * degree;
    p[X(P_pressure_angle_deg)] = 10.0 * degree;
    p[X(P_pitch_line_shift_mm)] = 4.0;
    p[X(P_hob_pitch_radius_mm)] = 20.063824;
    if (X(solve_design)(p, &info) || X(setup)(p, s)) return 2;
    const int status = X(solve)(s, 7.0, x, &info); /* worm angle, rad */
    if (status < 0) {
        fprintf(stderr, "%s\n", X(status_text)(status));
        return 1;
    }
    printf("transmission error %.6f arcsec after %d steps\n",
           x[X(U_transmission_error)] * 648000.0 / 3.141592653589793, info.iterations);
    return 0;
}
