// A trace from C++11, with a library that has the drive built in (find_package(meshwright), pkg-config) or with the drive's
// shared object and the core library.
#include <cmath>
#include <cstdio>
#include <vector>
#include "meshwright.h"
#include "cylindrical_worm_zn_zn.h" // for the places of its parameters

#define P(key) cylindrical_worm_zn_zn_P_##key

extern "C" const mw_model *mw_drive_cylindrical_worm_zn_zn(void);

int main()
{
    const mw_model *drive = mw_drive_cylindrical_worm_zn_zn();
    if (mw_abi() != MW_MODEL_ABI || drive->abi != MW_MODEL_ABI) return 2;
    const double degree = 3.141592653589793 / 180.0;
    std::vector<double> p(static_cast<std::size_t>(drive->np), std::nan("")), q(p.size() + 1);
    p[P(normal_module_mm)] = 2.0, p[P(worm_threads)] = 1.0, p[P(wheel_teeth)] = 277.0;
    p[P(worm_lead_angle_deg)] = 3.0 * degree, p[P(pressure_angle_deg)] = 10.0 * degree;
    p[P(pitch_line_shift_mm)] = 4.0, p[P(hob_pitch_radius_mm)] = 20.063824;
    std::vector<mw_info> info(11);
    if (mw_complete(drive, p.data(), q.data(), info.data())) return 2;
    std::vector<double> phi, s(static_cast<std::size_t>(drive->ns)), work(p.size());
    for (int k = 0; k < 11; k++) phi.push_back((400.0 + 10.0 * k) * degree);
    std::vector<double> x(phi.size() * static_cast<std::size_t>(drive->nx));
    const std::size_t solved =
        mw_trace(drive, p.data(), phi.data(), phi.size(), s.data(), work.data(), x.data(), info.data());
    std::printf("%u of %u points solved\n", static_cast<unsigned>(solved), static_cast<unsigned>(phi.size()));
    return solved == phi.size() ? 0 : 1;
}
