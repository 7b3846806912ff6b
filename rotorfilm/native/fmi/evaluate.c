#include "evaluate.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void rf_forget(rf_instance *c)
{
    c->known = 0;
}

rf_answer rf_failed(rf_instance *c, int status, const char *what, const rf_message *why)
{
    const int retry = c->now.phase == RF_CONTINUOUS && status != RF_INVALID;
    return rf_log(c, retry ? RF_DISCARD : RF_ERROR, retry ? RF_LOG_DISCARD : RF_LOG_ERROR,
                  "%s at t = %.9g s: %s", what, c->now.time, why->text);
}

rf_answer rf_judged(rf_instance *c, int status, const char *what, const rf_message *why)
{
    if (status > RF_OUTSIDE)
        return rf_failed(c, status, what, why);
    if (status == RF_OK || c->now.warned)
        return RF_FINE;
    c->now.warned = 1;
    return rf_log(c, RF_WARNING, RF_LOG_WARNING, "%s at t = %.9g s: %s (told once)", what, c->now.time,
                  why->text);
}

int rf_apply_parameters(rf_instance *c, rf_message *why)
{
    int status = RF_OK;
    if (c->parameters_changed && c->type->set_parameters)
        status = c->type->set_parameters(c->kernel, c->values[RF_PARAMETER], why);
    c->parameters_changed = status != RF_OK;
    return status;
}

rf_point rf_present_point(const rf_instance *c)
{
    const int before = c->now.phase == RF_CONTINUOUS && c->now.time == c->now.kink;
    const rf_point at = {before ? nextafter(c->now.time, -HUGE_VAL) : c->now.time, c->values[RF_STATE],
                         c->values[RF_INPUT]};
    return at;
}

int rf_evaluate(rf_instance *c, rf_role role, rf_message *why)
{
    const rf_kernel_type *type = c->type;
    int (*const function)(const void *, const rf_point *, double *, rf_message *) =
        role == RF_OUTPUT ? type->output : role == RF_DERIVATIVE ? type->derivative : type->events;
    if (c->known & 1u << role || !function)
        return RF_OK;
    int status = rf_apply_parameters(c, why);
    const rf_point at = rf_present_point(c);
    if (status == RF_OK && c->type->rest && c->now.phase & (RF_INSTANTIATED | RF_INITIALIZING))
        status = c->type->rest(c->kernel, &at, c->values[RF_STATE], why);
    if (status <= RF_OUTSIDE)
        status = function(c->kernel, &at, c->values[role], why);
    for (size_t i = 0; status <= RF_OUTSIDE && i < c->resource->count[role]; ++i)
        if (!isfinite(c->values[role][i]))
            status = rf_say(why, RF_NOT_FINITE, "value %zu is not finite", i);
    if (status <= RF_OUTSIDE)
        c->known |= 1u << role;
    return status;
}

static const char *const CATEGORIES[RF_CATEGORIES] = {"logStatusWarning", "logStatusDiscard",
                                                      "logStatusError", "logEvents", "logAll"};

const char *rf_phase_name(uint32_t phase)
{
    switch (phase) {
    case RF_INSTANTIATED: return "instantiated";
    case RF_CONFIGURING: return "configuration mode";
    case RF_INITIALIZING: return "initialization mode";
    case RF_EVENT: return "event mode";
    case RF_CONTINUOUS: return "continuous-time mode";
    case RF_STEPPING: return "step mode";
    case RF_STEP_FAILED: return "step failed";
    case RF_WITHIN_STEP: return "intermediate update mode";
    case RF_RECONFIGURING: return "reconfiguration mode";
    default: return "terminated";
    }
}

rf_answer rf_log(rf_instance *c, rf_answer answer, rf_category category, const char *format, ...)
{
    char text[640];
    va_list values;
    if (!(c->categories & 1u << category))
        return answer;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    c->host.send(&c->host, c->name, answer, CATEGORIES[category], text);
    return answer;
}

rf_answer rf_set_logging(rf_instance *c, int on, size_t count, const char *const categories[])
{
    unsigned chosen = count ? 0 : ALL_CATEGORIES;
    for (size_t i = 0; i < count; ++i) {
        unsigned k = 0;
        while (k < RF_CATEGORIES
               && !(categories && categories[i] && strcmp(categories[i], CATEGORIES[k]) == 0))
            ++k;
        if (k == RF_CATEGORIES)
            return rf_log(c, RF_ERROR, RF_LOG_ERROR, "log category %zu is unknown", i);
        chosen |= k == RF_LOG_ALL ? ALL_CATEGORIES : 1u << k;
    }
    c->categories = on ? c->categories | chosen : c->categories & ~chosen;
    return RF_FINE;
}

rf_answer rf_allow(rf_instance *c, const char *function, unsigned phases)
{
    if (c->now.phase & phases || phases == RF_ALWAYS) {
        if (c->categories & 1u << RF_LOG_ALL)
            rf_log(c, RF_FINE, RF_LOG_ALL, "%s at t = %.17g", function, c->now.time);
        return RF_FINE;
    }
    return rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s must not be called in the state '%s'", function,
                  rf_phase_name(c->now.phase));
}
