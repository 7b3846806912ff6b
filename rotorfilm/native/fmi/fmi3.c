/* FMI 3.0: names and rules of call order over instance.h. All variables are of type Float64. */
#include "fmi3_call.h"

static void send(const rf_host *host, const char *name, rf_answer answer, const char *category,
                 const char *text)
{
    fmi3LogMessageCallback callback = (fmi3LogMessageCallback)host->callback;
    (void)name;
    if (callback)
        callback(host->environment, (fmi3Status)answer, category, text);
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t count,
                               const fmi3String categories[])
{
    CALL(fmi3SetDebugLogging, ANY);
    return (fmi3Status)rf_set_logging(c, on, count, categories);
}

static rf_instance *make(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean logging,
                         int co_simulation, fmi3InstanceEnvironment environment,
                         fmi3LogMessageCallback callback)
{
    const rf_host host = {send, (void (*)(void))callback, environment};
    return rf_make_instance(name, token, resources, logging, co_simulation, &host);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                          fmi3Boolean visible, fmi3Boolean logging,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback callback)
{
    (void)visible;
    return make(name, token, resources, logging, 0, environment, callback);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode,
                                         fmi3Boolean early_return, const fmi3ValueReference intermediate[],
                                         size_t intermediate_count, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback callback,
                                         fmi3IntermediateUpdateCallback update)
{
    (void)visible, (void)intermediate, (void)intermediate_count; /* all variables may be read */
    rf_instance *c = make(name, token, resources, logging, 1, environment, callback);
    if (c) {
        c->event_mode = event_mode;
        c->early_return = early_return;
        c->within_step = update ? rf_within_step : NULL;
        c->update = (void (*)(void))update;
    }
    return c;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback callback, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)update, (void)lock,
        (void)unlock;
    if (callback)
        callback(environment, fmi3Error, "logStatusError", "scheduled execution is not provided");
    return NULL;
}

void fmi3FreeInstance(fmi3Instance instance)
{
    rf_free_instance(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean tolerance_defined,
                                       fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean stop_defined,
                                       fmi3Float64 stop)
{
    CALL(fmi3EnterInitializationMode, RF_INSTANTIATED);
    if (rf_set_experiment(c, tolerance_defined, tolerance, start, stop_defined, stop) != RF_FINE)
        return fmi3Error;
    rf_enter(c, RF_INITIALIZING);
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    CALL(fmi3ExitInitializationMode, RF_INITIALIZING);
    const rf_answer answer = rf_exit_initialization(c);
    if (answer <= RF_WARNING)
        rf_enter(c, c->co_simulation && !c->event_mode ? RF_STEPPING : RF_EVENT);
    return (fmi3Status)answer;
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance)
{
    CALL(fmi3EnterEventMode, RF_CONTINUOUS | RF_STEPPING);
    if (c->co_simulation && !c->event_mode)
        return (fmi3Status)rf_log(c, RF_ERROR, RF_LOG_ERROR, "fmi3EnterEventMode needs eventModeUsed");
    rf_enter(c, RF_EVENT);
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    CALL(fmi3Terminate, RUNNING | RF_STEP_FAILED);
    rf_enter(c, RF_TERMINATED);
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    CALL(fmi3Reset, RF_ALWAYS);
    return (fmi3Status)rf_reset(c);
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                          fmi3Float64 values[], size_t value_count)
{
    CALL(fmi3GetFloat64, AFTER_START | RF_WITHIN_STEP);
    return (fmi3Status)rf_get(c, vr, count, values, value_count);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                          const fmi3Float64 values[], size_t value_count)
{
    CALL(fmi3SetFloat64, RF_INSTANTIATED | RF_INITIALIZING | RUNNING);
    return (fmi3Status)rf_set(c, vr, count, values, value_count);
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    CALL(fmi3GetFMUState, ANY);
    return (fmi3Status)rf_save(c, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state)
{
    CALL(fmi3SetFMUState, RF_ALWAYS);
    return (fmi3Status)rf_restore(c, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    CALL(fmi3FreeFMUState, RF_ALWAYS);
    if (state) {
        free(*state);
        *state = NULL;
    }
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size)
{
    CALL(fmi3SerializedFMUStateSize, ANY);
    (void)state;
    if (!size)
        return fmi3Error;
    *size = rf_saved_size(c);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    CALL(fmi3SerializeFMUState, ANY);
    return (fmi3Status)rf_serialize(c, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state)
{
    CALL(fmi3DeserializeFMUState, ANY);
    return (fmi3Status)rf_deserialize(c, bytes, size, state);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t unknown_count, const fmi3ValueReference knowns[],
                                        size_t known_count, const fmi3Float64 seed[], size_t seeds,
                                        fmi3Float64 sensitivity[], size_t sensitivities)
{
    CALL(fmi3GetDirectionalDerivative, AFTER_START);
    const rf_pair pair = {unknowns, unknown_count, knowns, known_count};
    return (fmi3Status)rf_differentiate(c, &pair, seed, seeds, sensitivity, sensitivities, 0);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t unknown_count, const fmi3ValueReference knowns[],
                                    size_t known_count, const fmi3Float64 seed[], size_t seeds,
                                    fmi3Float64 sensitivity[], size_t sensitivities)
{
    CALL(fmi3GetAdjointDerivative, AFTER_START);
    const rf_pair pair = {unknowns, unknown_count, knowns, known_count};
    return (fmi3Status)rf_differentiate(c, &pair, seed, seeds, sensitivity, sensitivities, 1);
}

/* There are no structural parameters: both modes only pass. */
fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance)
{
    CALL(fmi3EnterConfigurationMode, RF_INSTANTIATED | RF_EVENT | RF_STEPPING);
    c->resume = (rf_phase)c->now.phase;
    rf_enter(c, c->resume == RF_INSTANTIATED ? RF_CONFIGURING : RF_RECONFIGURING);
    return fmi3OK;
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance)
{
    CALL(fmi3ExitConfigurationMode, RF_CONFIGURING | RF_RECONFIGURING);
    rf_enter(c, c->resume);
    return fmi3OK;
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance)
{
    CALL(fmi3EvaluateDiscreteStates, RF_INITIALIZING | RF_EVENT);
    return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *values_changed,
                                    fmi3Boolean *next_defined, fmi3Float64 *next)
{
    CALL(fmi3UpdateDiscreteStates, RF_EVENT);
    rf_pass_event(c);
    *again = *terminate = *nominals_changed = *values_changed = fmi3False;
    *next_defined = rf_has_kink(c);
    *next = rf_has_kink(c) ? c->now.kink : 0.0;
    return fmi3OK;
}

/* Model Exchange */

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    CALL(fmi3EnterContinuousTimeMode, RF_EVENT);
    if (c->co_simulation)
        return (fmi3Status)rf_log(c, RF_ERROR, RF_LOG_ERROR,
                                  "fmi3EnterContinuousTimeMode is for Model Exchange");
    rf_enter(c, RF_CONTINUOUS);
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean final,
                                       fmi3Boolean *enter_event_mode, fmi3Boolean *terminate)
{
    CALL(fmi3CompletedIntegratorStep, RF_CONTINUOUS);
    (void) final;
    *enter_event_mode = *terminate = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    CALL(fmi3SetTime, RF_CONTINUOUS);
    return (fmi3Status)rf_set_time(c, time);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 x[], size_t count)
{
    CALL(fmi3SetContinuousStates, RF_CONTINUOUS);
    return (fmi3Status)rf_set_states(c, x, count);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[], size_t count)
{
    CALL(fmi3GetContinuousStateDerivatives, AFTER_START);
    return (fmi3Status)rf_get_derivatives(c, derivatives, count);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 indicators[], size_t count)
{
    CALL(fmi3GetEventIndicators, RF_INITIALIZING | RF_EVENT | RF_CONTINUOUS);
    return (fmi3Status)rf_get_switches(c, indicators, count);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 x[], size_t count)
{
    CALL(fmi3GetContinuousStates, AFTER_START);
    return (fmi3Status)rf_get_states(c, x, count);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t count)
{
    CALL(fmi3GetNominalsOfContinuousStates, AFTER_START);
    return (fmi3Status)rf_get_nominals(c, nominals, count);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *count)
{
    CALL(fmi3GetNumberOfEventIndicators, ANY);
    *count = c->sizes.events;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *count)
{
    CALL(fmi3GetNumberOfContinuousStates, ANY);
    *count = c->sizes.states;
    return fmi3OK;
}

/* Co-Simulation */

fmi3Status fmi3EnterStepMode(fmi3Instance instance)
{
    CALL(fmi3EnterStepMode, RF_EVENT);
    if (!c->co_simulation)
        return (fmi3Status)rf_log(c, RF_ERROR, RF_LOG_ERROR, "fmi3EnterStepMode is for Co-Simulation");
    rf_pass_event(c);
    rf_enter(c, RF_STEPPING);
    return fmi3OK;
}

double rf_within_step(rf_instance *c, double t, double end)
{
    fmi3IntermediateUpdateCallback update = (fmi3IntermediateUpdateCallback)c->update;
    fmi3Boolean leave = fmi3False;
    fmi3Float64 when = t;
    update(c->host.environment, t, fmi3False, fmi3True, fmi3True, c->early_return != 0, &leave, &when);
    return c->early_return && leave ? when : end;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 from, fmi3Float64 step, fmi3Boolean final,
                      fmi3Boolean *event_needed, fmi3Boolean *terminate, fmi3Boolean *early,
                      fmi3Float64 *last_time)
{
    CALL(fmi3DoStep, RF_STEPPING);
    (void) final;
    const double kink = c->now.kink;
    const rf_answer answer = rf_step(c, from, step);
    const int done = answer <= RF_WARNING;
    *event_needed = done && c->event_mode && c->now.time == kink;
    *terminate = c->terminated;
    *early = done && c->now.time < from + step;
    *last_time = c->last_good_time;
    return (fmi3Status)answer;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t value_count)
{
    CALL(fmi3GetOutputDerivatives, RF_STEPPING | RF_STEP_FAILED | RF_TERMINATED);
    return (fmi3Status)rf_get_output_slopes(c, vr, count, orders, values, value_count);
}
