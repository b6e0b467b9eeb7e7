/* One contact of a recess-action worm drive, proved: two generated headers, no library; compiles as C99 and C++11.
 *
 * The design that it is proved of is the one of exactly these doubles. Of a design in decimals, give each number's distance
 * from its double as well: mw_wide has a second double and a radius. */
#include <stdio.h>
#include "cylindrical_worm_zn_zn.h"
#include "cylindrical_worm_zn_zn_certify.h"

#define X(name) cylindrical_worm_zn_zn_##name

int main(void)
{
    const double degree = 3.141592653589793 / 180.0, arcsec = 3.141592653589793 / 648000.0;
    double p[X(NP)], s[X(NS)], x[X(NX)], state[X(CERTIFY_NS)], within[X(NX)], box[X(NX)];
    mw_wide exactly[X(NP)];
    mw_info info;
    for (int k = 0; k < X(NP); k++) p[k] = NAN; /* open: filled in by rules and defaults */
    p[X(P_normal_module_mm)] = 2.0;
    p[X(P_worm_threads)] = 1.0;
    p[X(P_wheel_teeth)] = 277.0;
    p[X(P_worm_lead_angle_deg)] = 3.0 * degree;
    p[X(P_pressure_angle_deg)] = 10.0 * degree;
    p[X(P_pitch_line_shift_mm)] = 4.0;
    p[X(P_hob_pitch_radius_mm)] = 20.063824;
    if (X(solve_design)(p, &info) || X(setup)(p, s) || X(solve)(s, 7.0, x, &info) < 0) return 2;
    for (int k = 0; k < X(NP); k++) exactly[k] = mwc_wide_of(p[k]);
    if (!X(certify_setup)(exactly, state)) return 3;
    if (!X(certify)(state, mwc_make(7.0, 0.0), x, within, box)) return 1;
    printf("one contact: transmission error %.6f arcsec within %.0e arcsec, the only one within %.0e arcsec\n",
           x[X(U_transmission_error)] / arcsec, within[X(U_transmission_error)] / arcsec, box[X(U_transmission_error)] / arcsec);
    return 0;
}
