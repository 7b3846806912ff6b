#include "evaluate.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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
