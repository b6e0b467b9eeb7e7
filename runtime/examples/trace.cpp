// A trace from C++11, with a library that has the drive built in (find_package(meshwright), pkg-config) or with the drive's
// shared object and the core library.
#include <cmath>
#include <cstdio>
#include <vector>
#include "meshwright.h"

extern "C" const mw_model *mw_drive_cylindrical_worm_zn_zn(void);

int main()
{
    const mw_model *drive = mw_drive_cylindrical_worm_zn_zn();
    if (mw_abi() != MW_MODEL_ABI || drive->abi != MW_MODEL_ABI) return 2;
    const double degree = 3.141592653589793 / 180.0;
    std::vector<double> p(static_cast<std::size_t>(drive->np), std::nan("")), q(p.size() + 1);
    p[1] = 2.0, p[3] = 1.0, p[4] = 277.0, p[5] = 3.0 * degree, p[7] = 10.0 * degree, p[9] = 4.0, p[10] = 20.063824;
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
