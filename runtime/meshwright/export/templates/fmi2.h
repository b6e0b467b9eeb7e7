/* The interface of FMI 2.0 over the component.  SPDX-License-Identifier: MIT-0 */
typedef void *fmi2Component;
typedef unsigned int fmi2ValueReference;
typedef int fmi2Integer, fmi2Boolean, fmi2Status;
typedef double fmi2Real;
typedef const char *fmi2String;
typedef char fmi2Byte;
enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error };
typedef struct fmi2CallbackFunctions {
    void (*log)(void *, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, fmi2Status);
    void *environment;
} fmi2CallbackFunctions;
typedef struct fmi2EventInfo {
    fmi2Boolean newDiscreteStatesNeeded, terminateSimulation, nominalsOfContinuousStatesChanged, valuesOfContinuousStatesChanged,
        nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

static void say(component *m, int status, const char *words)
{
    if (m->log) ((void (*)(void *, fmi2String, fmi2Status, fmi2String, fmi2String, ...))m->log)(m->environment, m->name, status, "logStatusError", "%s", words);
}

#define OF(c) ((component *)(c))
#define NOT_OFFERED(c) (say(OF(c), fmi2Error, "this function is not offered: there are no states"), fmi2Error)

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[])
{
    (void)c, (void)on, (void)n, (void)names;
    return fmi2OK;
}

EXPORT fmi2Component fmi2Instantiate(fmi2String name, int kind, fmi2String guid, fmi2String place, const fmi2CallbackFunctions *f,
                                     fmi2Boolean visible, fmi2Boolean logging)
{
    (void)kind, (void)place, (void)visible, (void)logging;
    component *const m = begin(name, f ? (logger)f->log : NULL, f ? f->environment : NULL);
    if (m && (guid == NULL || strcmp(guid, TOKEN) != 0)) {
        say(m, fmi2Error, "the guid is another one's: this binary belongs to another modelDescription.xml");
        free(m);
        return NULL;
    }
    return m;
}

EXPORT void fmi2FreeInstance(fmi2Component c) { free(c); }
EXPORT fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean t, fmi2Real tolerance, fmi2Real start, fmi2Boolean s, fmi2Real stop)
{
    (void)c, (void)t, (void)tolerance, (void)start, (void)s, (void)stop;
    return fmi2OK;
}
EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component c) { (void)c; return fmi2OK; }
EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return (OF(c)->now.ready || assemble(OF(c))) && settle(OF(c)) ? fmi2OK : fmi2Error; }
EXPORT fmi2Status fmi2Terminate(fmi2Component c) { (void)c; return fmi2OK; }
EXPORT fmi2Status fmi2Reset(fmi2Component c) { restart(OF(c)); return fmi2OK; }

EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real v[])
{
    for (size_t k = 0; k < n; k++) {
        if (r[k] > FRICTION && !OF(c)->now.ready && !assemble(OF(c))) return fmi2Error;
        if (!get_real(OF(c), r[k], v + k)) return fmi2Error;
    }
    return fmi2OK;
}

EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real v[])
{
    for (size_t k = 0; k < n; k++)
        if (!set_real(OF(c), r[k], v[k])) return fmi2Error;
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Integer v[])
{
    for (size_t k = 0; k < n; k++) {
        if (r[k] != CONTACT) return say(OF(c), fmi2Error, "no such variable"), fmi2Error;
        if (!OF(c)->now.ready && !assemble(OF(c))) return fmi2Error;
        v[k] = OF(c)->now.contact;
    }
    return fmi2OK;
}

EXPORT fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer v[])
{
    (void)r, (void)v;
    return n ? (say(OF(c), fmi2Error, "this variable cannot be set"), fmi2Error) : fmi2OK;
}
#define NONE_OF(Kind, kind) \
    EXPORT fmi2Status fmi2Get##Kind(fmi2Component c, const fmi2ValueReference r[], size_t n, kind v[]) \
    { (void)c, (void)r, (void)v; return n ? fmi2Error : fmi2OK; } \
    EXPORT fmi2Status fmi2Set##Kind(fmi2Component c, const fmi2ValueReference r[], size_t n, const kind v[]) \
    { (void)c, (void)r, (void)v; return n ? fmi2Error : fmi2OK; }
NONE_OF(Boolean, fmi2Boolean)
NONE_OF(String, fmi2String)

EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, void **state)
{
    if (*state == NULL) *state = malloc(sizeof(memory));
    if (*state == NULL) return fmi2Error;
    memcpy(*state, &OF(c)->now, sizeof(memory));
    return fmi2OK;
}
EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, void *state) { memcpy(&OF(c)->now, state, sizeof(memory)); return fmi2OK; }
EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, void **state) { (void)c; free(*state); *state = NULL; return fmi2OK; }
EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, void *state, size_t *size) { (void)c, (void)state; *size = sizeof(memory); return fmi2OK; }
EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component c, void *state, fmi2Byte bytes[], size_t size)
{
    (void)c;
    if (size < sizeof(memory)) return fmi2Error;
    memcpy(bytes, state, sizeof(memory));
    return fmi2OK;
}
EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, void **state)
{
    if (size != sizeof(memory)) return say(OF(c), fmi2Error, "a state of another component"), fmi2Error;
    if (*state == NULL) *state = malloc(sizeof(memory));
    if (*state == NULL) return fmi2Error;
    memcpy(*state, bytes, sizeof(memory));
    return fmi2OK;
}
EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference u[], size_t nu, const fmi2ValueReference k[],
                                               size_t nk, const fmi2Real dk[], fmi2Real du[])
{
    return along(OF(c), u, nu, k, nk, dk, du) ? fmi2OK : fmi2Error;
}

EXPORT fmi2Status fmi2EnterEventMode(fmi2Component c) { (void)c; return fmi2OK; }
EXPORT fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    memset(info, 0, sizeof *info);
    return settle(OF(c)) ? fmi2OK : fmi2Error;
}
EXPORT fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) { (void)c; return fmi2OK; }
EXPORT fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean none, fmi2Boolean *event, fmi2Boolean *stop)
{
    (void)c, (void)none;
    *event = *stop = 0;
    return fmi2OK;
}
EXPORT fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) { (void)c, (void)time; return fmi2OK; }
EXPORT fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n) { (void)c, (void)x; return n ? fmi2Error : fmi2OK; }
EXPORT fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real x[], size_t n) { (void)c, (void)x; return n ? fmi2Error : fmi2OK; }
EXPORT fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n) { (void)c, (void)x; return n ? fmi2Error : fmi2OK; }
EXPORT fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x[], size_t n) { (void)c, (void)x; return n ? fmi2Error : fmi2OK; }
EXPORT fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real z[], size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (k > 1 || !get_real(OF(c), GAP_DRIVE + (unsigned int)k, z + k)) return fmi2Error;
    return fmi2OK;
}

EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real at, fmi2Real step, fmi2Boolean none)
{
    (void)at, (void)step, (void)none;
    return settle(OF(c)) ? fmi2OK : fmi2Error;
}
EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer o[], const fmi2Real v[])
{
    (void)r, (void)n, (void)o, (void)v;
    return NOT_OFFERED(c);
}
EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer o[], fmi2Real v[])
{
    (void)r, (void)n, (void)o, (void)v;
    return NOT_OFFERED(c);
}
EXPORT fmi2Status fmi2CancelStep(fmi2Component c) { return NOT_OFFERED(c); }
#define NO_STATUS(Kind, kind) \
    EXPORT fmi2Status fmi2Get##Kind##Status(fmi2Component c, int what, kind *v) { (void)c, (void)what, (void)v; return fmi2Discard; }
NO_STATUS(, fmi2Status)
NO_STATUS(Real, fmi2Real)
NO_STATUS(Integer, fmi2Integer)
NO_STATUS(Boolean, fmi2Boolean)
NO_STATUS(String, fmi2String)
