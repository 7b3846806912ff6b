/* The least that a Co-Simulation FMU can do with the variables of a journal bearing, of FMI 2.0 and 3.0: it
   stores inputs and answers sums. What a simulator costs with it is what the simulator itself costs. */
#include <stdlib.h>

#include "fmi/fmi2FunctionTypes.h"
#include "fmi/fmi3PlatformTypes.h"

#include "fmi/fmi3FunctionTypes.h"

enum { VARIABLES = 16 };

static int set(double *values, const unsigned *vr, size_t n, const double *given)
{
    for (size_t i = 0; i < n; ++i) {
        if (vr[i] >= VARIABLES)
            return fmi2Error;
        values[vr[i]] = given[i];
    }
    return fmi2OK;
}

static int get(const double *values, const unsigned *vr, size_t n, double *asked)
{
    for (size_t i = 0; i < n; ++i) {
        if (vr[i] >= VARIABLES)
            return fmi2Error;
        asked[i] = values[vr[i]] + values[5];
    }
    return fmi2OK;
}

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }
const char *fmi3GetVersion(void) { return "3.0"; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)type, (void)guid, (void)resources, (void)callbacks, (void)visible, (void)logging;
    return calloc(VARIABLES, sizeof(double));
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean events,
                                         fmi3Boolean early, const fmi3ValueReference required[], size_t n,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)events, (void)early;
    (void)required, (void)n, (void)environment, (void)log, (void)update;
    return calloc(VARIABLES, sizeof(double));
}

void fmi2FreeInstance(void *c) { free(c); }
void fmi3FreeInstance(void *c) { free(c); }

int fmi2SetReal(void *c, const unsigned vr[], size_t n, const double value[]) { return set(c, vr, n, value); }
int fmi2GetReal(void *c, const unsigned vr[], size_t n, double value[]) { return get(c, vr, n, value); }

int fmi3SetFloat64(void *c, const unsigned vr[], size_t n, const double value[], size_t m)
{
    return m == n ? set(c, vr, n, value) : fmi3Error;
}

int fmi3GetFloat64(void *c, const unsigned vr[], size_t n, double value[], size_t m)
{
    return m == n ? get(c, vr, n, value) : fmi3Error;
}

int fmi2DoStep(void *c, double time, double step, fmi2Boolean no_set_state)
{
    double *values = c;
    (void)no_set_state;
    values[0] = time + step;
    return fmi2OK;
}

int fmi3DoStep(void *c, double time, double step, fmi3Boolean no_set_state, fmi3Boolean *event,
               fmi3Boolean *terminate, fmi3Boolean *early, double *last)
{
    double *values = c;
    (void)no_set_state;
    *event = *terminate = *early = fmi3False;
    *last = values[0] = time + step;
    return fmi3OK;
}

#define DONE(name) int name(void) { return fmi2OK; }
#define UNUSED(name) int name(void) { return fmi2Error; }
DONE(fmi2SetupExperiment) DONE(fmi2EnterInitializationMode) DONE(fmi2ExitInitializationMode) DONE(fmi2Terminate)
DONE(fmi2Reset) DONE(fmi3EnterInitializationMode) DONE(fmi3ExitInitializationMode) DONE(fmi3Terminate)
DONE(fmi3Reset)
UNUSED(fmi2CancelStep) UNUSED(fmi2CompletedIntegratorStep) UNUSED(fmi2DeSerializeFMUstate)
UNUSED(fmi2EnterContinuousTimeMode) UNUSED(fmi2EnterEventMode) UNUSED(fmi2FreeFMUstate) UNUSED(fmi2GetBoolean)
UNUSED(fmi2GetBooleanStatus) UNUSED(fmi2GetContinuousStates) UNUSED(fmi2GetDerivatives)
UNUSED(fmi2GetDirectionalDerivative) UNUSED(fmi2GetEventIndicators) UNUSED(fmi2GetFMUstate)
UNUSED(fmi2GetInteger) UNUSED(fmi2GetIntegerStatus) UNUSED(fmi2GetNominalsOfContinuousStates)
UNUSED(fmi2GetRealOutputDerivatives) UNUSED(fmi2GetRealStatus) UNUSED(fmi2GetStatus) UNUSED(fmi2GetString)
UNUSED(fmi2GetStringStatus) UNUSED(fmi2NewDiscreteStates) UNUSED(fmi2SerializeFMUstate)
UNUSED(fmi2SerializedFMUstateSize) UNUSED(fmi2SetBoolean) UNUSED(fmi2SetContinuousStates)
UNUSED(fmi2SetDebugLogging) UNUSED(fmi2SetFMUstate) UNUSED(fmi2SetInteger) UNUSED(fmi2SetRealInputDerivatives)
UNUSED(fmi2SetString) UNUSED(fmi2SetTime)
UNUSED(fmi3ActivateModelPartition) UNUSED(fmi3CompletedIntegratorStep) UNUSED(fmi3DeserializeFMUState)
UNUSED(fmi3EnterConfigurationMode) UNUSED(fmi3EnterContinuousTimeMode) UNUSED(fmi3EnterEventMode)
UNUSED(fmi3EnterStepMode) UNUSED(fmi3EvaluateDiscreteStates) UNUSED(fmi3ExitConfigurationMode)
UNUSED(fmi3FreeFMUState) UNUSED(fmi3GetAdjointDerivative) UNUSED(fmi3GetBinary) UNUSED(fmi3GetBoolean)
UNUSED(fmi3GetClock) UNUSED(fmi3GetContinuousStateDerivatives) UNUSED(fmi3GetContinuousStates)
UNUSED(fmi3GetDirectionalDerivative) UNUSED(fmi3GetEventIndicators) UNUSED(fmi3GetFMUState)
UNUSED(fmi3GetFloat32) UNUSED(fmi3GetInt16) UNUSED(fmi3GetInt32) UNUSED(fmi3GetInt64) UNUSED(fmi3GetInt8)
UNUSED(fmi3GetIntervalDecimal) UNUSED(fmi3GetIntervalFraction) UNUSED(fmi3GetNominalsOfContinuousStates)
UNUSED(fmi3GetNumberOfContinuousStates) UNUSED(fmi3GetNumberOfEventIndicators)
UNUSED(fmi3GetNumberOfVariableDependencies) UNUSED(fmi3GetOutputDerivatives) UNUSED(fmi3GetShiftDecimal)
UNUSED(fmi3GetShiftFraction) UNUSED(fmi3GetString) UNUSED(fmi3GetUInt16) UNUSED(fmi3GetUInt32)
UNUSED(fmi3GetUInt64) UNUSED(fmi3GetUInt8) UNUSED(fmi3GetVariableDependencies)
UNUSED(fmi3InstantiateModelExchange) UNUSED(fmi3InstantiateScheduledExecution) UNUSED(fmi3SerializeFMUState)
UNUSED(fmi3SerializedFMUStateSize) UNUSED(fmi3SetBinary) UNUSED(fmi3SetBoolean) UNUSED(fmi3SetClock)
UNUSED(fmi3SetContinuousStates) UNUSED(fmi3SetDebugLogging) UNUSED(fmi3SetFMUState) UNUSED(fmi3SetFloat32)
UNUSED(fmi3SetInt16) UNUSED(fmi3SetInt32) UNUSED(fmi3SetInt64) UNUSED(fmi3SetInt8)
UNUSED(fmi3SetIntervalDecimal) UNUSED(fmi3SetIntervalFraction) UNUSED(fmi3SetShiftDecimal)
UNUSED(fmi3SetShiftFraction) UNUSED(fmi3SetString) UNUSED(fmi3SetTime) UNUSED(fmi3SetUInt16)
UNUSED(fmi3SetUInt32) UNUSED(fmi3SetUInt64) UNUSED(fmi3SetUInt8) UNUSED(fmi3UpdateDiscreteStates)
