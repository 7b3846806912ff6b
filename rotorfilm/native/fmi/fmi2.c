/* FMI 2.0: names and rules of call order over instance.h. */
#include <string.h>

#include "fmi2_call.h"

static void send(const rf_host *host, const char *name, rf_answer answer, const char *category,
                 const char *text)
{
    char format[1300];
    size_t used = 0;
    fmi2CallbackLogger logger = (fmi2CallbackLogger)host->callback;
    if (!logger)
        return;
    /* The message is a format, and no value follows. */
    for (; *text && used < sizeof format - 2; ++text) {
        if (*text == '%')
            format[used++] = '%';
        format[used++] = *text;
    }
    format[used] = '\0';
    logger(host->environment, name, (fmi2Status)answer, category, format);
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, size_t count,
                               const fmi2String categories[])
{
    CALL(fmi2SetDebugLogging, ANY);
    return (fmi2Status)rf_set_logging(c, on, count, categories);
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    rf_host host = {send, NULL, NULL};
    (void)visible;
    if (functions) {
        host.callback = (void (*)(void))functions->logger;
        host.environment = functions->componentEnvironment;
    }
    return rf_make_instance(name, guid, resources, logging, type == fmi2CoSimulation, &host);
}

void fmi2FreeInstance(fmi2Component component)
{
    rf_free_instance(component);
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop)
{
    CALL(fmi2SetupExperiment, RF_INSTANTIATED);
    return (fmi2Status)rf_set_experiment(c, tolerance_defined, tolerance, start, stop_defined, stop);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component)
{
    CALL(fmi2EnterInitializationMode, RF_INSTANTIATED);
    rf_enter(c, RF_INITIALIZING);
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component)
{
    CALL(fmi2ExitInitializationMode, RF_INITIALIZING);
    const rf_answer answer = rf_exit_initialization(c);
    if (answer <= RF_WARNING)
        rf_enter(c, c->co_simulation ? RF_STEPPING : RF_EVENT);
    return (fmi2Status)answer;
}

fmi2Status fmi2Terminate(fmi2Component component)
{
    CALL(fmi2Terminate, RUNNING | RF_STEP_FAILED);
    rf_enter(c, RF_TERMINATED);
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component component)
{
    CALL(fmi2Reset, RF_ALWAYS);
    return (fmi2Status)rf_reset(c);
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference vr[], size_t count,
                       fmi2Real values[])
{
    CALL(fmi2GetReal, AFTER_START);
    return (fmi2Status)rf_get(c, vr, count, values, count);
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference vr[], size_t count,
                       const fmi2Real values[])
{
    CALL(fmi2SetReal, RF_INSTANTIATED | RF_INITIALIZING | RUNNING);
    return (fmi2Status)rf_set(c, vr, count, values, count);
}

/* All variables are real: another type has none, and asking for none of them is fine. */
static fmi2Status refuse(fmi2Component component, const char *function, size_t count)
{
    rf_instance *const c = component;
    if (!c || rf_allow(c, function, ANY) != RF_FINE)
        return fmi2Error;
    if (count == 0)
        return fmi2OK;
    return (fmi2Status)rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s: all variables of this FMU are real", function);
}

#define NONE(name, type) \
    fmi2Status name(fmi2Component component, const fmi2ValueReference vr[], size_t count, type values[]) \
    { \
        (void)vr; \
        (void)values; \
        return refuse(component, #name, count); \
    }

NONE(fmi2GetInteger, fmi2Integer)
NONE(fmi2GetBoolean, fmi2Boolean)
NONE(fmi2GetString, fmi2String)
NONE(fmi2SetInteger, const fmi2Integer)
NONE(fmi2SetBoolean, const fmi2Boolean)
NONE(fmi2SetString, const fmi2String)

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *state)
{
    CALL(fmi2GetFMUstate, ANY);
    return (fmi2Status)rf_save(c, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state)
{
    CALL(fmi2SetFMUstate, RF_ALWAYS);
    return (fmi2Status)rf_restore(c, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *state)
{
    CALL(fmi2FreeFMUstate, RF_ALWAYS);
    if (state) {
        free(*state);
        *state = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, size_t *size)
{
    CALL(fmi2SerializedFMUstateSize, ANY);
    (void)state;
    if (!size)
        return fmi2Error;
    *size = rf_saved_size(c);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    CALL(fmi2SerializeFMUstate, ANY);
    return (fmi2Status)rf_serialize(c, state, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state)
{
    CALL(fmi2DeSerializeFMUstate, ANY);
    return (fmi2Status)rf_deserialize(c, bytes, size, state);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference unknowns[],
                                        size_t unknown_count, const fmi2ValueReference knowns[],
                                        size_t known_count, const fmi2Real seed[], fmi2Real sensitivity[])
{
    CALL(fmi2GetDirectionalDerivative, AFTER_START);
    const rf_pair pair = {unknowns, unknown_count, knowns, known_count};
    return (fmi2Status)rf_differentiate(c, &pair, seed, known_count, sensitivity, unknown_count, 0);
}

/* Model Exchange */

fmi2Status fmi2EnterEventMode(fmi2Component component)
{
    CALL(fmi2EnterEventMode, RF_CONTINUOUS | RF_EVENT);
    rf_enter(c, RF_EVENT);
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo *info)
{
    CALL(fmi2NewDiscreteStates, RF_EVENT);
    rf_pass_event(c);
    info->newDiscreteStatesNeeded = fmi2False;
    info->terminateSimulation = fmi2False;
    info->nominalsOfContinuousStatesChanged = fmi2False;
    info->valuesOfContinuousStatesChanged = fmi2False;
    info->nextEventTimeDefined = rf_has_kink(c);
    info->nextEventTime = rf_has_kink(c) ? c->now.kink : 0.0;
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component component)
{
    CALL(fmi2EnterContinuousTimeMode, RF_EVENT);
    rf_enter(c, RF_CONTINUOUS);
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component component, fmi2Boolean final,
                                       fmi2Boolean *enter_event_mode, fmi2Boolean *terminate)
{
    CALL(fmi2CompletedIntegratorStep, RF_CONTINUOUS);
    (void) final;
    *enter_event_mode = *terminate = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2SetTime(fmi2Component component, fmi2Real time)
{
    CALL(fmi2SetTime, RF_EVENT | RF_CONTINUOUS);
    return (fmi2Status)rf_set_time(c, time);
}

fmi2Status fmi2SetContinuousStates(fmi2Component component, const fmi2Real x[], size_t count)
{
    CALL(fmi2SetContinuousStates, RF_CONTINUOUS);
    return (fmi2Status)rf_set_states(c, x, count);
}

fmi2Status fmi2GetDerivatives(fmi2Component component, fmi2Real derivatives[], size_t count)
{
    CALL(fmi2GetDerivatives, AFTER_START);
    return (fmi2Status)rf_get_derivatives(c, derivatives, count);
}

fmi2Status fmi2GetEventIndicators(fmi2Component component, fmi2Real indicators[], size_t count)
{
    CALL(fmi2GetEventIndicators, AFTER_START);
    return (fmi2Status)rf_get_switches(c, indicators, count);
}

fmi2Status fmi2GetContinuousStates(fmi2Component component, fmi2Real x[], size_t count)
{
    CALL(fmi2GetContinuousStates, AFTER_START);
    return (fmi2Status)rf_get_states(c, x, count);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component component, fmi2Real nominal[], size_t count)
{
    CALL(fmi2GetNominalsOfContinuousStates, ANY);
    return (fmi2Status)rf_get_nominals(c, nominal, count);
}
