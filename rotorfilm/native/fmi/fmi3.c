/* FMI 3.0: names and rules of call order over instance.h. All variables are scalars of type Float64. */
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wstrict-prototypes" /* in the header of the standard */
#endif
#include "fmi3Functions.h"

#include "instance.h"

#define CALL(name, phases) \
    rf_instance *const c = instance; \
    if (!c || rf_allow(c, #name, (phases)) != RF_FINE) \
    return fmi3Error

enum {
    RUNNING = RF_EVENT | RF_CONTINUOUS | RF_STEPPING,
    AFTER_START = RF_INITIALIZING | RUNNING | RF_STEP_FAILED | RF_TERMINATED,
    ANY = RF_INSTANTIATED | RF_CONFIGURING | RF_RECONFIGURING | AFTER_START
};

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
    (void)visible, (void)intermediate, (void)intermediate_count, (void)update;
    rf_instance *c = make(name, token, resources, logging, 1, environment, callback);
    if (c) {
        c->event_mode = event_mode;
        c->early_return = early_return;
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

static fmi3Status require_scalars(rf_instance *c, size_t references, size_t values)
{
    if (references == values)
        return fmi3OK;
    return (fmi3Status)rf_log(c, RF_ERROR, RF_LOG_ERROR,
                              "all variables are scalars, got %zu values for %zu of them", values,
                              references);
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                          fmi3Float64 values[], size_t value_count)
{
    CALL(fmi3GetFloat64, AFTER_START);
    const fmi3Status fits = require_scalars(c, count, value_count);
    return fits == fmi3OK ? (fmi3Status)rf_get(c, vr, count, values) : fits;
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                          const fmi3Float64 values[], size_t value_count)
{
    CALL(fmi3SetFloat64, RF_INSTANTIATED | RF_INITIALIZING | RUNNING);
    const fmi3Status fits = require_scalars(c, count, value_count);
    return fits == fmi3OK ? (fmi3Status)rf_set(c, vr, count, values) : fits;
}

/* What this FMU does not have: asking for none of it is fine. */
static fmi3Status refuse(fmi3Instance instance, const char *function, size_t count, const char *what)
{
    rf_instance *const c = instance;
    if (!c || rf_allow(c, function, ANY) != RF_FINE)
        return fmi3Error;
    return count ? (fmi3Status)rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s: %s", function, what) : fmi3OK;
}

#define NO_TYPE "all variables of this FMU are of type Float64"
#define NO_CLOCK "this FMU has no clocks"

#define NONE(name, type) \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference vr[], size_t count, type values[], \
                    size_t value_count) \
    { \
        (void)vr, (void)values, (void)value_count; \
        return refuse(instance, #name, count, NO_TYPE); \
    }

NONE(fmi3GetFloat32, fmi3Float32)
NONE(fmi3GetInt8, fmi3Int8)
NONE(fmi3GetUInt8, fmi3UInt8)
NONE(fmi3GetInt16, fmi3Int16)
NONE(fmi3GetUInt16, fmi3UInt16)
NONE(fmi3GetInt32, fmi3Int32)
NONE(fmi3GetUInt32, fmi3UInt32)
NONE(fmi3GetInt64, fmi3Int64)
NONE(fmi3GetUInt64, fmi3UInt64)
NONE(fmi3GetBoolean, fmi3Boolean)
NONE(fmi3GetString, fmi3String)
NONE(fmi3SetFloat32, const fmi3Float32)
NONE(fmi3SetInt8, const fmi3Int8)
NONE(fmi3SetUInt8, const fmi3UInt8)
NONE(fmi3SetInt16, const fmi3Int16)
NONE(fmi3SetUInt16, const fmi3UInt16)
NONE(fmi3SetInt32, const fmi3Int32)
NONE(fmi3SetUInt32, const fmi3UInt32)
NONE(fmi3SetInt64, const fmi3Int64)
NONE(fmi3SetUInt64, const fmi3UInt64)
NONE(fmi3SetBoolean, const fmi3Boolean)
NONE(fmi3SetString, const fmi3String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference vr[], size_t count, size_t sizes[],
                         fmi3Binary values[], size_t value_count)
{
    (void)vr, (void)sizes, (void)values, (void)value_count;
    return refuse(instance, "fmi3GetBinary", count, NO_TYPE);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                         const size_t sizes[], const fmi3Binary values[], size_t value_count)
{
    (void)vr, (void)sizes, (void)values, (void)value_count;
    return refuse(instance, "fmi3SetBinary", count, NO_TYPE);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                        fmi3Clock values[])
{
    (void)vr, (void)values;
    return refuse(instance, "fmi3GetClock", count, NO_CLOCK);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                        const fmi3Clock values[])
{
    (void)vr, (void)values;
    return refuse(instance, "fmi3SetClock", count, NO_CLOCK);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference vr, size_t *count)
{
    (void)vr, (void)count;
    return refuse(instance, "fmi3GetNumberOfVariableDependencies", 1,
                  "dependencies are those of the description");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent, size_t of[],
                                       fmi3ValueReference independents[], size_t on[],
                                       fmi3DependencyKind kinds[], size_t count)
{
    (void)dependent, (void)of, (void)independents, (void)on, (void)kinds;
    return refuse(instance, "fmi3GetVariableDependencies", count,
                  "dependencies are those of the description");
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

static fmi3Status differentiate(rf_instance *c, const fmi3ValueReference unknowns[], size_t unknown_count,
                                const fmi3ValueReference knowns[], size_t known_count,
                                const fmi3Float64 seed[], size_t seeds, fmi3Float64 sensitivity[],
                                size_t sensitivities, int transposed)
{
    const size_t from = transposed ? unknown_count : known_count,
                 to = transposed ? known_count : unknown_count;
    if (require_scalars(c, from, seeds) != fmi3OK || require_scalars(c, to, sensitivities) != fmi3OK)
        return fmi3Error;
    return (fmi3Status)rf_differentiate(c, unknowns, unknown_count, knowns, known_count, seed, sensitivity,
                                        transposed);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t unknown_count, const fmi3ValueReference knowns[],
                                        size_t known_count, const fmi3Float64 seed[], size_t seeds,
                                        fmi3Float64 sensitivity[], size_t sensitivities)
{
    CALL(fmi3GetDirectionalDerivative, AFTER_START);
    return differentiate(c, unknowns, unknown_count, knowns, known_count, seed, seeds, sensitivity,
                         sensitivities, 0);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t unknown_count, const fmi3ValueReference knowns[],
                                    size_t known_count, const fmi3Float64 seed[], size_t seeds,
                                    fmi3Float64 sensitivity[], size_t sensitivities)
{
    CALL(fmi3GetAdjointDerivative, AFTER_START);
    return differentiate(c, unknowns, unknown_count, knowns, known_count, seed, seeds, sensitivity,
                         sensitivities, 1);
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

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                  fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    (void)vr, (void)intervals, (void)qualifiers;
    return refuse(instance, "fmi3GetIntervalDecimal", count, NO_CLOCK);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                   fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[])
{
    (void)vr, (void)counters, (void)resolutions, (void)qualifiers;
    return refuse(instance, "fmi3GetIntervalFraction", count, NO_CLOCK);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                               fmi3Float64 shifts[])
{
    (void)vr, (void)shifts;
    return refuse(instance, "fmi3GetShiftDecimal", count, NO_CLOCK);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    return refuse(instance, "fmi3GetShiftFraction", count, NO_CLOCK);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                  const fmi3Float64 intervals[])
{
    (void)vr, (void)intervals;
    return refuse(instance, "fmi3SetIntervalDecimal", count, NO_CLOCK);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                   const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    return refuse(instance, "fmi3SetIntervalFraction", count, NO_CLOCK);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                               const fmi3Float64 shifts[])
{
    (void)vr, (void)shifts;
    return refuse(instance, "fmi3SetShiftDecimal", count, NO_CLOCK);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    return refuse(instance, "fmi3SetShiftFraction", count, NO_CLOCK);
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

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t value_count)
{
    (void)vr, (void)orders, (void)values, (void)value_count;
    return refuse(instance, "fmi3GetOutputDerivatives", count, "outputs have no time derivatives");
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

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)clock, (void)time;
    return refuse(instance, "fmi3ActivateModelPartition", 1, NO_CLOCK);
}
