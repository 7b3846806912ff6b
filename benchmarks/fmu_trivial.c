/* The least that an FMI 2.0 Co-Simulation FMU can do with the variables of a journal bearing: it stores inputs
   and answers their sum. What a simulator costs with it is what the simulator itself costs. */
#include <stdlib.h>
#include <string.h>

#include "fmi/fmi2Functions.h"

typedef struct model {
    double value[16];
} model;

#define UNUSED(name, ...)                 \
    fmi2Status name(__VA_ARGS__)          \
    {                                     \
        return fmi2Error;                 \
    }

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)type, (void)guid, (void)resources, (void)callbacks, (void)visible, (void)logging;
    return calloc(1, sizeof(model));
}

void fmi2FreeInstance(fmi2Component c) { free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance, fmi2Real value, fmi2Real start,
                               fmi2Boolean stop, fmi2Real end)
{
    (void)c, (void)tolerance, (void)value, (void)start, (void)stop, (void)end;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return c ? fmi2OK : fmi2Error; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return c ? fmi2OK : fmi2Error; }
fmi2Status fmi2Terminate(fmi2Component c) { return c ? fmi2OK : fmi2Error; }
fmi2Status fmi2Reset(fmi2Component c) { return c ? fmi2OK : fmi2Error; }

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    model *self = c;
    for (size_t i = 0; i < n; ++i) {
        if (vr[i] >= 16)
            return fmi2Error;
        self->value[vr[i]] = value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    const model *self = c;
    for (size_t i = 0; i < n; ++i) {
        if (vr[i] >= 16)
            return fmi2Error;
        value[i] = self->value[vr[i]] + self->value[5];
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_set_state)
{
    model *self = c;
    (void)no_set_state;
    self->value[0] = time + step;
    return fmi2OK;
}

#define VR const fmi2ValueReference vr[], size_t n
UNUSED(fmi2SetDebugLogging, fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[])
UNUSED(fmi2GetInteger, fmi2Component c, VR, fmi2Integer value[])
UNUSED(fmi2GetBoolean, fmi2Component c, VR, fmi2Boolean value[])
UNUSED(fmi2GetString, fmi2Component c, VR, fmi2String value[])
UNUSED(fmi2SetInteger, fmi2Component c, VR, const fmi2Integer value[])
UNUSED(fmi2SetBoolean, fmi2Component c, VR, const fmi2Boolean value[])
UNUSED(fmi2SetString, fmi2Component c, VR, const fmi2String value[])
UNUSED(fmi2GetFMUstate, fmi2Component c, fmi2FMUstate *state)
UNUSED(fmi2SetFMUstate, fmi2Component c, fmi2FMUstate state)
UNUSED(fmi2FreeFMUstate, fmi2Component c, fmi2FMUstate *state)
UNUSED(fmi2SerializedFMUstateSize, fmi2Component c, fmi2FMUstate state, size_t *size)
UNUSED(fmi2SerializeFMUstate, fmi2Component c, fmi2FMUstate state, fmi2Byte data[], size_t size)
UNUSED(fmi2DeSerializeFMUstate, fmi2Component c, const fmi2Byte data[], size_t size, fmi2FMUstate *state)
UNUSED(fmi2GetDirectionalDerivative, fmi2Component c, const fmi2ValueReference u[], size_t n,
       const fmi2ValueReference k[], size_t m, const fmi2Real dk[], fmi2Real du[])
UNUSED(fmi2SetRealInputDerivatives, fmi2Component c, VR, const fmi2Integer order[], const fmi2Real value[])
UNUSED(fmi2GetRealOutputDerivatives, fmi2Component c, VR, const fmi2Integer order[], fmi2Real value[])
UNUSED(fmi2CancelStep, fmi2Component c)
UNUSED(fmi2GetStatus, fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
UNUSED(fmi2GetRealStatus, fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
UNUSED(fmi2GetIntegerStatus, fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
UNUSED(fmi2GetBooleanStatus, fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
UNUSED(fmi2GetStringStatus, fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
