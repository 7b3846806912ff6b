/* FMI 3.0: Model Exchange and Co-Simulation. */
#include "fmi3_call.h"

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
