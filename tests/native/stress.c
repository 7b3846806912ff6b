/* Whatever a simulator does, an instance answers a status: no crash, no leak, no not-a-number with OK.

   stress TOKEN CALLS GOOD... -- BAD... -- MAYBE...
   Folders of resources that must open, must be refused with a message, and must do either. */
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi/fmi2Functions.h"
#include "fmi/fmi3Functions.h"

enum { MOST = 8, INSTANCES = 1000, ALIVE = 40 };

static const char *token;
static uint64_t seed = 88172645463325252u;
static long messages;

static unsigned dice(unsigned sides)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (unsigned)(seed >> 32) % sides;
}

static void listen2(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                    fmi2String category, fmi2String message, ...)
{
    char text[2000];
    va_list none;
    va_start(none, message);
    vsnprintf(text, sizeof text, message, none);
    va_end(none);
    (void)environment, (void)name, (void)status, (void)category;
    messages += strlen(text) > 10;
}

static void listen3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                    fmi3String message)
{
    (void)environment, (void)status, (void)category;
    messages += strlen(message) > 10;
}

static const fmi2CallbackFunctions CALLBACKS = {listen2, calloc, free, NULL, NULL};

static void fail(const char *what, int detail)
{
    fprintf(stderr, "%s (%d)\n", what, detail);
    exit(1);
}

static void *open2(const char *folder, int kind)
{
    char uri[4000];
    snprintf(uri, sizeof uri, "file://%s", folder);
    return fmi2Instantiate("one", kind ? fmi2CoSimulation : fmi2ModelExchange, token, uri, &CALLBACKS, 0,
                           dice(2));
}

static void *open3(const char *folder, int kind)
{
    return kind ? fmi3InstantiateCoSimulation("one", token, folder, 0, dice(2), dice(2), dice(2), NULL, 0,
                                              NULL, listen3, NULL)
                : fmi3InstantiateModelExchange("one", token, folder, 0, dice(2), NULL, listen3);
}

static double number(void)
{
    static const double POOL[] = {0.0,  1.0,  -1.0, 1e-5,  5e-5,  1e-4,   9.9999e-5,
                                  2e-3, 0.03, 0.05, 100.0, 1e308, -1e308, 1e-308};
    switch (dice(20)) {
    case 0: return NAN;
    case 1: return INFINITY;
    default: return POOL[dice(sizeof POOL / sizeof *POOL)];
    }
}

static void require_finite(int status, const double *values, size_t count, const char *what)
{
    for (size_t i = 0; status <= 1 && i < count; ++i)
        if (!isfinite(values[i]))
            fail(what, (int)i);
}

typedef struct stage {
    unsigned vr[MOST], other[MOST];
    double values[MOST], more[MOST], t, dt;
    size_t count;
    void *saved;
    unsigned char bytes[4096];
    size_t size;
} stage;

static void prepare(stage *s)
{
    /* 8 and 9 are inputs, 10 and 11 outputs of all the models here. */
    const unsigned sound = dice(2);
    s->count = dice(MOST);
    for (int i = 0; i < MOST; ++i) {
        s->vr[i] = sound ? 10 + dice(2) : dice(24);
        s->other[i] = sound ? 8 + dice(2) : dice(24);
        s->values[i] = number();
        s->more[i] = (double)i;
    }
    s->dt = dice(3) ? 1e-3 : number();
}

/* A state as bytes with one bit changed is refused, and leaves nothing behind. */
static void damage2(void *c, stage *s)
{
    const fmi2Status made = fmi2GetFMUstate(c, &s->saved);
    fmi2FMUstate none = NULL;
    fmi2SerializedFMUstateSize(c, s->saved, &s->size);
    if (made != fmi2OK || fmi2SerializeFMUstate(c, s->saved, (char *)s->bytes, s->size) != fmi2OK)
        fail("fmi2SerializeFMUstate", made);
    s->bytes[dice((unsigned)s->size)] ^= (unsigned char)(1u << dice(8));
    if (fmi2DeSerializeFMUstate(c, (char *)s->bytes, s->size, &none) != fmi2Error || none)
        fail("fmi2DeSerializeFMUstate of damaged bytes", 0);
    if (fmi2FreeFMUstate(c, &s->saved) != fmi2OK || (dice(20) == 0 && fmi2Reset(c) != fmi2OK))
        fail("fmi2FreeFMUstate, fmi2Reset", 0);
}

static int common2(void *c, stage *s, unsigned which)
{
    fmi2Status answer;
    switch (which) {
    case 0:
        return fmi2SetupExperiment(c, dice(2), number(), dice(4) ? 0.0 : number(), dice(8) == 0, number());
    case 1:
    case 2: return fmi2EnterInitializationMode(c);
    case 3:
    case 4: return fmi2ExitInitializationMode(c);
    case 5: return dice(20) ? 0 : fmi2Terminate(c);
    case 6: return dice(20) ? 0 : fmi2Reset(c);
    case 7:
    case 8:
        answer = fmi2GetReal(c, s->vr, s->count, s->values);
        require_finite(answer, s->values, s->count, "fmi2GetReal");
        return answer;
    case 9:
    case 10: return fmi2SetReal(c, s->vr, s->count, s->values);
    case 11: return s->saved && dice(2) ? fmi2FreeFMUstate(c, &s->saved) : fmi2GetFMUstate(c, &s->saved);
    case 12: return fmi2SetFMUstate(c, s->saved);
    case 13: return s->saved ? fmi2SerializedFMUstateSize(c, s->saved, &s->size) : 0;
    case 14: return fmi2SerializeFMUstate(c, s->saved, (char *)s->bytes, dice(2) ? s->size : dice(64));
    case 15:
        fmi2FreeFMUstate(c, &s->saved);
        return fmi2DeSerializeFMUstate(c, (char *)s->bytes, dice(4) ? s->size : dice(64), &s->saved);
    default:
        answer = fmi2GetDirectionalDerivative(c, s->vr, s->count, s->other, MOST, s->more, s->values);
        require_finite(answer, s->values, s->count, "fmi2GetDirectionalDerivative");
        return answer;
    }
}

static int special2(void *c, stage *s, unsigned which)
{
    fmi2EventInfo info;
    fmi2Boolean flag, other;
    fmi2Status answer;
    switch (which) {
    case 0: return fmi2EnterEventMode(c);
    case 1: return fmi2NewDiscreteStates(c, &info);
    case 2: return fmi2EnterContinuousTimeMode(c);
    case 3: return fmi2CompletedIntegratorStep(c, 1, &flag, &other);
    case 4: return fmi2SetTime(c, s->dt);
    case 5: return fmi2SetContinuousStates(c, s->values, dice(2) ? 4 : s->count);
    case 6:
        answer = fmi2GetDerivatives(c, s->values, dice(2) ? 4 : 0);
        require_finite(answer == fmi2OK ? answer : 3, s->values, 0, "fmi2GetDerivatives");
        return answer;
    case 7: return fmi2GetContinuousStates(c, s->values, 4);
    case 8: return fmi2GetNominalsOfContinuousStates(c, s->values, 4);
    case 9: return fmi2GetEventIndicators(c, s->values, s->count);
    case 10: return fmi2GetInteger(c, s->vr, s->count, (int *)s->bytes);
    case 11: return fmi2CancelStep(c);
    case 12: return fmi2GetStatus(c, fmi2DoStepStatus, &answer);
    case 13: return fmi2GetRealStatus(c, dice(2) ? fmi2LastSuccessfulTime : fmi2PendingStatus, s->values);
    case 14: return fmi2GetBooleanStatus(c, dice(2) ? fmi2Terminated : fmi2PendingStatus, &flag);
    case 15: return fmi2SetDebugLogging(c, dice(2), 0, NULL);
    default: {
        const int stepped = fmi2DoStep(c, s->t, s->dt, 1);
        if (stepped == fmi2Discard
            && (fmi2GetBooleanStatus(c, fmi2Terminated, &flag) != fmi2OK || !flag
                || fmi2GetRealStatus(c, fmi2LastSuccessfulTime, s->values) != fmi2OK
                || !isfinite(s->values[0])))
            fail("fmi2DoStep does not tell how it ended", 0);
        s->t = stepped <= 1 ? s->t + s->dt : s->t;
        return stepped;
    }
    }
}

static int common3(void *c, stage *s, unsigned which)
{
    fmi3Status answer;
    switch (which) {
    case 0:
    case 1:
    case 2:
        return fmi3EnterInitializationMode(c, dice(2), number(), dice(4) ? 0.0 : number(), dice(8) == 0,
                                           number());
    case 3:
    case 4: return fmi3ExitInitializationMode(c);
    case 5: return dice(20) ? 0 : (int)fmi3Terminate(c);
    case 6: return dice(20) ? 0 : (int)fmi3Reset(c);
    case 7:
    case 8:
        answer = fmi3GetFloat64(c, s->vr, s->count, s->values, dice(9) ? s->count : 1);
        require_finite(answer, s->values, s->count, "fmi3GetFloat64");
        return answer;
    case 9:
    case 10: return fmi3SetFloat64(c, s->vr, s->count, s->values, s->count);
    case 11: return s->saved && dice(2) ? fmi3FreeFMUState(c, &s->saved) : fmi3GetFMUState(c, &s->saved);
    case 12: return fmi3SetFMUState(c, s->saved);
    case 13: return s->saved ? (int)fmi3SerializedFMUStateSize(c, s->saved, &s->size) : 0;
    case 14: return fmi3SerializeFMUState(c, s->saved, s->bytes, dice(2) ? s->size : dice(64));
    case 15:
        fmi3FreeFMUState(c, &s->saved);
        return fmi3DeserializeFMUState(c, s->bytes, dice(4) ? s->size : dice(64), &s->saved);
    case 16:
        answer =
            fmi3GetAdjointDerivative(c, s->vr, s->count, s->other, MOST, s->more, s->count, s->values, MOST);
        require_finite(answer, s->values, MOST, "fmi3GetAdjointDerivative");
        return answer;
    default:
        answer = fmi3GetDirectionalDerivative(c, s->vr, s->count, s->other, MOST, s->more, MOST, s->values,
                                              s->count);
        require_finite(answer, s->values, s->count, "fmi3GetDirectionalDerivative");
        return answer;
    }
}

static int special3(void *c, stage *s, unsigned which)
{
    fmi3Boolean a, b, d, e, f;
    switch (which) {
    case 0: return fmi3EnterEventMode(c);
    case 1: return fmi3UpdateDiscreteStates(c, &a, &b, &d, &e, &f, s->values);
    case 2: return fmi3EnterContinuousTimeMode(c);
    case 3: return fmi3CompletedIntegratorStep(c, 1, &a, &b);
    case 4: return fmi3SetTime(c, s->dt);
    case 5: return fmi3SetContinuousStates(c, s->values, dice(2) ? 4 : s->count);
    case 6: return fmi3GetContinuousStateDerivatives(c, s->values, dice(2) ? 4 : 0);
    case 7: return fmi3GetContinuousStates(c, s->values, 4);
    case 8: return fmi3GetNominalsOfContinuousStates(c, s->values, 4);
    case 9: return fmi3EnterStepMode(c);
    case 10: return fmi3GetInt32(c, s->vr, s->count, (int32_t *)s->bytes, s->count);
    case 11: return fmi3EnterConfigurationMode(c);
    case 12:
    case 13: return fmi3ExitConfigurationMode(c);
    case 14: return fmi3GetNumberOfContinuousStates(c, &s->count);
    case 15: return fmi3EvaluateDiscreteStates(c);
    default: {
        double last = s->t;
        const int stepped = fmi3DoStep(c, s->t, s->dt, 1, &a, &b, &d, &last);
        if (stepped == fmi3Discard && (!b || a || d || !isfinite(last)))
            fail("fmi3DoStep does not tell how it ended", 0);
        s->t = stepped <= 1 ? last : s->t;
        return stepped;
    }
    }
}

static void torture(const char *folder, long calls, int version, int kind)
{
    void *c = version == 2 ? open2(folder, kind) : open3(folder, kind);
    stage s;
    memset(&s, 0, sizeof s);
    for (long i = 0; c && i < calls; ++i) {
        prepare(&s);
        const int common = dice(3) > 0;
        if (version == 2 && dice(50) == 0)
            damage2(c, &s);
        const int answer = version == 2 ? (common ? common2(c, &s, dice(17)) : special2(c, &s, dice(20)))
                                        : (common ? common3(c, &s, dice(18)) : special3(c, &s, dice(20)));
        if (answer < 0 || answer > 3)
            fail("status", answer);
    }
    if (version == 2 && c) {
        fmi2FreeFMUstate(c, &s.saved);
        fmi2FreeInstance(c);
    } else if (c) {
        fmi3FreeFMUState(c, &s.saved);
        fmi3FreeInstance(c);
    }
}

static void crowd(const char *folder)
{
    void *alive[ALIVE] = {NULL};
    for (int i = 0; i < INSTANCES; ++i) {
        const unsigned k = dice(ALIVE);
        fmi2FreeInstance(alive[k]);
        alive[k] = open2(folder, i % 2);
        if (!alive[k])
            fail("instance", i);
    }
    for (int k = 0; k < ALIVE; ++k)
        fmi2FreeInstance(alive[k]);
}

int main(int argc, char **argv)
{
    const long calls = argc > 2 ? atol(argv[2]) : 0;
    int expected = 0; /* 0 must open, 1 must not, 2 may */
    token = argv[1];
    for (int i = 3; i < argc; ++i) {
        if (strcmp(argv[i], "--") == 0) {
            ++expected;
            continue;
        }
        const long before = messages;
        void *c = open2(argv[i], 1);
        if ((expected == 0 && !c) || (expected == 1 && (c || messages == before)))
            fail(argv[i], expected);
        fmi2FreeInstance(c);
        for (int version = 2; c && version < 4; ++version)
            for (int kind = 0; kind < 2; ++kind)
                torture(argv[i], calls, version, kind);
        if (expected == 0)
            crowd(argv[i]);
    }
    if (fmi2GetReal(NULL, NULL, 0, NULL) != fmi2Error
        || fmi3DoStep(NULL, 0, 0, 0, NULL, NULL, NULL, NULL) != fmi3Error)
        fail("no instance", 0);
    fmi2FreeInstance(NULL);
    printf("%ld messages\n", messages);
    return 0;
}
