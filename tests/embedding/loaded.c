/* Loads the libraries of a wheel at run time and prints the bits of a trace, on whatever machine this was compiled for.
 * Argument: the folder of the libraries. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include "meshwright.h"
#include "cylindrical_worm_zn_zn.h" /* for the places of its parameters */

#ifdef _WIN32
#include <windows.h>
#define opened(path) ((void *)LoadLibraryExA(path, NULL, LOAD_WITH_ALTERED_SEARCH_PATH))
#define found(library, name) ((void *)GetProcAddress((HMODULE)(library), name))
#define SEPARATOR "\\"
#else
#include <dlfcn.h>
#define opened(path) dlopen(path, RTLD_NOW | RTLD_GLOBAL)
#define found(library, name) dlsym(library, name)
#define SEPARATOR "/"
#endif

#define P(key) cylindrical_worm_zn_zn_P_##key
enum { ANGLES = 21, ROOM = 4096 };

static void *library(const char *folder, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s" SEPARATOR "%s", folder, name);
    void *handle = opened(path);
    if (!handle) printf("%s could not be loaded\n", path);
    return handle;
}

/* The bits of a pointer to data as one to a function: ISO C has no cast for it. */
#define FUNCTION(type, name, from, symbol)      \
    type;                                       \
    do {                                        \
        void *address = found(from, symbol);    \
        if (!address) {                         \
            printf("there is no %s\n", symbol); \
            return 2;                           \
        }                                       \
        memcpy(&name, &address, sizeof name);   \
    } while (0)

int main(int count, char **arguments)
{
    if (count != 2) return 2;
    void *core = library(arguments[1], CORE), *own = library(arguments[1], "cylindrical_worm_zn_zn.so");
    if (!core || !own) return 2;
    FUNCTION(int (*abi)(void), abi, core, "mw_abi");
    FUNCTION(int (*complete)(const mw_model *, double *, double *, mw_info *), complete, core, "mw_complete");
    FUNCTION(size_t (*trace)(const mw_model *, const double *, const double *, size_t, double *, double *, double *, mw_info *),
             trace, core, "mw_trace");
    FUNCTION(const mw_model *(*model)(void), model, own, "mw_drive_cylindrical_worm_zn_zn");
    const mw_model *drive = model();
    if (abi() != MW_MODEL_ABI || drive->abi != MW_MODEL_ABI) return 2;

    static double p[ROOM], q[ROOM], s[ROOM], phi[ANGLES], x[ANGLES * 16];
    mw_info info[ANGLES];
    const double degree = 3.141592653589793 / 180.0, none = 0.0 / (p[0] + 0.0);
    for (int k = 0; k < drive->np; k++) p[k] = none;
    p[P(normal_module_mm)] = 2.0, p[P(worm_threads)] = 1.0, p[P(wheel_teeth)] = 277.0;
    p[P(worm_lead_angle_deg)] = 3.0 * degree, p[P(pressure_angle_deg)] = 10.0 * degree;
    p[P(pitch_line_shift_mm)] = 4.0, p[P(hob_pitch_radius_mm)] = 20.063824;
    if (complete(drive, p, q, info)) return 2;
    for (int k = 0; k < ANGLES; k++) phi[k] = 100.0 * degree * k;
    size_t solved = trace(drive, p, phi, ANGLES, s, q, x, info);
    for (int k = 0; k < ANGLES * drive->nx; k++) {
        uint64_t bits;
        memcpy(&bits, &x[k], sizeof bits);
        printf("%08lx%08lx\n", (unsigned long)(bits >> 32), (unsigned long)(bits & 0xffffffffu));
    }
    return solved == ANGLES ? 0 : 1;
}
