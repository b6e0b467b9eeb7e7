/* The interface of FMI 3.0 over the component.  SPDX-License-Identifier: MIT-0 */
#include <stdint.h>
#include <stdbool.h>

typedef void *fmi3Instance, *fmi3InstanceEnvironment, *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef int fmi3Status;
typedef const char *fmi3String;
typedef const uint8_t *fmi3Binary;
enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error };
typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);
typedef const fmi3ValueReference *references;

static void say(component *m, int status, const char *words)
{
    if (m->log) ((fmi3LogMessageCallback)m->log)(m->environment, status, "logStatusError", words);
}

#define OF(c) ((component *)(c))
#define PASS(...) { (void)c; return fmi3OK; }
#define REFUSE { return refuse(c); }

static fmi3Status refuse(fmi3Instance c)
{
    say(OF(c), fmi3Error, "this function is not offered: there are no states, no clocks and no derivatives of outputs");
    return fmi3Error;
}

EXPORT const char *fmi3GetVersion(void) { return "3.0"; }
EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance c, bool on, size_t n, const fmi3String names[])
{
    (void)c, (void)on, (void)n, (void)names;
    return fmi3OK;
}

static fmi3Instance instance(fmi3String name, fmi3String token, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    component *const m = begin(name, (logger)log, environment);
    if (m && (token == NULL || strcmp(token, TOKEN) != 0)) {
        say(m, fmi3Error, "the token is another one's: this binary belongs to another modelDescription.xml");
        free(m);
        return NULL;
    }
    return m;
}

EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String place, bool visible, bool logging,
                                                 fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    (void)place, (void)visible, (void)logging;
    return instance(name, token, environment, log);
}
EXPORT fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String place, bool visible, bool logging,
                                                bool events, bool early, references intermediate, size_t n,
                                                fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, void (*update)(void))
{
    (void)place, (void)visible, (void)logging, (void)events, (void)early, (void)intermediate, (void)n, (void)update;
    return instance(name, token, environment, log);
}
EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String place, bool visible, bool logging,
                                                      fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                                      void (*update)(void), void (*lock)(void), void (*unlock)(void))
{
    (void)name, (void)token, (void)place, (void)visible, (void)logging, (void)environment, (void)log, (void)update, (void)lock, (void)unlock;
    return NULL;
}
EXPORT void fmi3FreeInstance(fmi3Instance c) { free(c); }

EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance c, bool t, double tolerance, double start, bool s, double stop)
{
    (void)t, (void)tolerance, (void)s, (void)stop;
    OF(c)->now.value[TIME] = start;
    return fmi3OK;
}
EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance c) { return (OF(c)->now.ready || assemble(OF(c))) && settle(OF(c)) ? fmi3OK : fmi3Error; }
EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance c) PASS()
EXPORT fmi3Status fmi3Terminate(fmi3Instance c) PASS()
EXPORT fmi3Status fmi3Reset(fmi3Instance c) { restart(OF(c)); return fmi3OK; }
EXPORT fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) PASS()
EXPORT fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) PASS()
EXPORT fmi3Status fmi3EnterStepMode(fmi3Instance c) PASS()
EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) PASS()
EXPORT fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) PASS()

EXPORT fmi3Status fmi3GetFloat64(fmi3Instance c, references r, size_t n, double v[], size_t nv)
{
    (void)nv;
    for (size_t k = 0; k < n; k++) {
        if (r[k] == TIME) v[k] = OF(c)->now.value[TIME];
        else if (r[k] > FRICTION && r[k] < REALS && !OF(c)->now.ready && !assemble(OF(c))) return fmi3Error;
        else if (r[k] == LEADING || !get_real(OF(c), r[k], v + k)) return fmi3Error;
    }
    return fmi3OK;
}
EXPORT fmi3Status fmi3SetFloat64(fmi3Instance c, references r, size_t n, const double v[], size_t nv)
{
    (void)nv;
    for (size_t k = 0; k < n; k++)
        if (!set_real(OF(c), r[k], v[k])) return fmi3Error;
    return fmi3OK;
}
EXPORT fmi3Status fmi3GetInt32(fmi3Instance c, references r, size_t n, int32_t v[], size_t nv)
{
    (void)nv;
    for (size_t k = 0; k < n; k++) {
        if (r[k] != CONTACT) return say(OF(c), fmi3Error, "no such variable"), fmi3Error;
        if (!OF(c)->now.ready && !assemble(OF(c))) return fmi3Error;
        v[k] = OF(c)->now.contact;
    }
    return fmi3OK;
}
EXPORT fmi3Status fmi3GetInt64(fmi3Instance c, references r, size_t n, int64_t v[], size_t nv)
{
    (void)nv;
    for (size_t k = 0; k < n; k++) {
        if (r[k] != LEADING) return say(OF(c), fmi3Error, "no such variable"), fmi3Error;
        if (!OF(c)->now.ready && !assemble(OF(c))) return fmi3Error;
        v[k] = OF(c)->now.leading;
    }
    return fmi3OK;
}

#define NO_GET(Kind, kind) \
    EXPORT fmi3Status fmi3Get##Kind(fmi3Instance c, references r, size_t n, kind v[], size_t nv) \
    { (void)c, (void)r, (void)v, (void)nv; return n ? fmi3Error : fmi3OK; }
#define NO_SET(Kind, kind) \
    EXPORT fmi3Status fmi3Set##Kind(fmi3Instance c, references r, size_t n, const kind v[], size_t nv) \
    { (void)c, (void)r, (void)v, (void)nv; return n ? fmi3Error : fmi3OK; }
#define NEITHER(Kind, kind) NO_GET(Kind, kind) NO_SET(Kind, kind)
NEITHER(Float32, float)
NEITHER(Int8, int8_t)
NEITHER(UInt8, uint8_t)
NEITHER(Int16, int16_t)
NEITHER(UInt16, uint16_t)
NO_SET(Int32, int32_t)
NEITHER(UInt32, uint32_t)
NO_SET(Int64, int64_t)
NEITHER(UInt64, uint64_t)
NEITHER(Boolean, bool)
NEITHER(String, fmi3String)
EXPORT fmi3Status fmi3GetBinary(fmi3Instance c, references r, size_t n, size_t sizes[], fmi3Binary v[], size_t nv)
{
    (void)c, (void)r, (void)sizes, (void)v, (void)nv;
    return n ? fmi3Error : fmi3OK;
}
EXPORT fmi3Status fmi3SetBinary(fmi3Instance c, references r, size_t n, const size_t sizes[], const fmi3Binary v[], size_t nv)
{
    (void)c, (void)r, (void)sizes, (void)v, (void)nv;
    return n ? fmi3Error : fmi3OK;
}
EXPORT fmi3Status fmi3GetClock(fmi3Instance c, references r, size_t n, bool v[]) { (void)r, (void)v; return n ? refuse(c) : fmi3OK; }
EXPORT fmi3Status fmi3SetClock(fmi3Instance c, references r, size_t n, const bool v[]) { (void)r, (void)v; return n ? refuse(c) : fmi3OK; }

EXPORT fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference r, size_t *n) { (void)r, (void)n; REFUSE }
EXPORT fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference r, size_t e[], references i, size_t ei[], int kinds[],
                                              size_t n)
{
    (void)r, (void)e, (void)i, (void)ei, (void)kinds, (void)n;
    REFUSE
}

EXPORT fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state)
{
    if (*state == NULL) *state = malloc(sizeof(memory));
    if (*state == NULL) return fmi3Error;
    memcpy(*state, &OF(c)->now, sizeof(memory));
    return fmi3OK;
}
EXPORT fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) { memcpy(&OF(c)->now, state, sizeof(memory)); return fmi3OK; }
EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state) { (void)c; free(*state); *state = NULL; return fmi3OK; }
EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size) { (void)c, (void)state; *size = sizeof(memory); return fmi3OK; }
EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, uint8_t bytes[], size_t size)
{
    if (size < sizeof(memory)) return say(OF(c), fmi3Error, "too few bytes for a state"), fmi3Error;
    memcpy(bytes, state, sizeof(memory));
    return fmi3OK;
}
EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const uint8_t bytes[], size_t size, fmi3FMUState *state)
{
    if (size != sizeof(memory)) return say(OF(c), fmi3Error, "a state of another component"), fmi3Error;
    if (*state == NULL) *state = malloc(sizeof(memory));
    if (*state == NULL) return fmi3Error;
    memcpy(*state, bytes, sizeof(memory));
    return fmi3OK;
}

#define NO_DERIVATIVE(Kind) \
    EXPORT fmi3Status fmi3Get##Kind##Derivative(fmi3Instance c, references u, size_t nu, references k, size_t nk, const double s[], \
                                                size_t ns, double v[], size_t nv) \
    { (void)u, (void)nu, (void)k, (void)nk, (void)s, (void)ns, (void)v, (void)nv; REFUSE }
NO_DERIVATIVE(Adjoint)
EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, references u, size_t nu, references k, size_t nk, const double s[],
                                               size_t ns, double v[], size_t nv)
{
    if (ns != nk || nv != nu) return say(OF(c), fmi3Error, "of each variable one number is given and wanted"), fmi3Error;
    return along(OF(c), u, nu, k, nk, s, v) ? fmi3OK : fmi3Error;
}
EXPORT fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, references r, size_t n, const int32_t o[], double v[], size_t nv)
{
    (void)r, (void)n, (void)o, (void)v, (void)nv;
    REFUSE
}

#define NO_INTERVAL(Name, a, b) EXPORT fmi3Status fmi3##Name(fmi3Instance c, references r, size_t n, a, b) { (void)r, (void)n, (void)x, (void)y; REFUSE }
NO_INTERVAL(GetIntervalDecimal, double x[], int y[])
NO_INTERVAL(GetShiftFraction, uint64_t x[], uint64_t y[])
NO_INTERVAL(SetIntervalFraction, const uint64_t x[], const uint64_t y[])
NO_INTERVAL(SetShiftFraction, const uint64_t x[], const uint64_t y[])
EXPORT fmi3Status fmi3GetIntervalFraction(fmi3Instance c, references r, size_t n, uint64_t x[], uint64_t y[], int z[]) { (void)r, (void)n, (void)x, (void)y, (void)z; REFUSE }
EXPORT fmi3Status fmi3GetShiftDecimal(fmi3Instance c, references r, size_t n, double x[]) { (void)r, (void)n, (void)x; REFUSE }
EXPORT fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, references r, size_t n, const double x[]) { (void)r, (void)n, (void)x; REFUSE }
EXPORT fmi3Status fmi3SetShiftDecimal(fmi3Instance c, references r, size_t n, const double x[]) { (void)r, (void)n, (void)x; REFUSE }
EXPORT fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference r, double t) { (void)r, (void)t; REFUSE }

EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, bool *needed, bool *terminate, bool *nominals, bool *values, bool *defined,
                                           double *next)
{
    *needed = *terminate = *nominals = *values = *defined = false;
    (void)next;
    return settle(OF(c)) ? fmi3OK : fmi3Error;
}
EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, bool none, bool *event, bool *terminate)
{
    (void)c, (void)none;
    *event = *terminate = false;
    return fmi3OK;
}
EXPORT fmi3Status fmi3SetTime(fmi3Instance c, double time) { OF(c)->now.value[TIME] = time; return fmi3OK; }
EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance c, const double x[], size_t n) { (void)c, (void)x; return n ? fmi3Error : fmi3OK; }
EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance c, double x[], size_t n) { (void)c, (void)x; return n ? fmi3Error : fmi3OK; }
EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, double x[], size_t n) { (void)c, (void)x; return n ? fmi3Error : fmi3OK; }
EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, double x[], size_t n) { (void)c, (void)x; return n ? fmi3Error : fmi3OK; }
EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *n) { (void)c; *n = 2; return fmi3OK; }
EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *n) { (void)c; *n = 0; return fmi3OK; }
EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance c, double z[], size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (k > 1 || !get_real(OF(c), GAP_DRIVE + (unsigned int)k, z + k)) return fmi3Error;
    return fmi3OK;
}

EXPORT fmi3Status fmi3DoStep(fmi3Instance c, double at, double step, bool none, bool *event, bool *terminate, bool *early, double *last)
{
    (void)none;
    *event = *terminate = *early = false;
    *last = OF(c)->now.value[TIME] = at + step;
    return settle(OF(c)) ? fmi3OK : fmi3Error;
}
