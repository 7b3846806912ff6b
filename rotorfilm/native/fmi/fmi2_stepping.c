/* FMI 2.0, Co-Simulation. */
#include "fmi2_call.h"

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference vr[], size_t count,
                                       const fmi2Integer order[], const fmi2Real values[])
{
    CALL(fmi2SetRealInputDerivatives, RF_INSTANTIATED | RF_INITIALIZING | RF_STEPPING);
    (void)vr, (void)order, (void)values;
    return count == 0 ? fmi2OK : (fmi2Status)rf_log(c, RF_ERROR, RF_LOG_ERROR, "inputs are held over a step");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference vr[], size_t count,
                                        const fmi2Integer order[], fmi2Real values[])
{
    CALL(fmi2GetRealOutputDerivatives, RF_STEPPING | RF_STEP_FAILED | RF_TERMINATED);
    return (fmi2Status)rf_get_output_slopes(c, vr, count, order, values, count);
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real from, fmi2Real step, fmi2Boolean final)
{
    CALL(fmi2DoStep, RF_STEPPING);
    (void) final;
    return (fmi2Status)rf_step(c, from, step);
}

fmi2Status fmi2CancelStep(fmi2Component component)
{
    CALL(fmi2CancelStep, 0); /* a step is over when fmi2DoStep returns */
    return fmi2Error;
}

enum { STEPPED = RF_STEPPING | RF_STEP_FAILED | RF_TERMINATED };

fmi2Status fmi2GetStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Status *value)
{
    CALL(fmi2GetStatus, STEPPED);
    (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Real *value)
{
    CALL(fmi2GetRealStatus, STEPPED);
    if (kind != fmi2LastSuccessfulTime)
        return fmi2Discard;
    *value = c->last_good_time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Integer *value)
{
    CALL(fmi2GetIntegerStatus, STEPPED);
    (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean *value)
{
    CALL(fmi2GetBooleanStatus, STEPPED);
    if (kind != fmi2Terminated)
        return fmi2Discard;
    *value = c->terminated;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component component, const fmi2StatusKind kind, fmi2String *value)
{
    CALL(fmi2GetStringStatus, STEPPED);
    (void)kind, (void)value;
    return fmi2Discard;
}
