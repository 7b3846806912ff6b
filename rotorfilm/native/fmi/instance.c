#include "instance.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FINEST 1e-13 /* tolerance of the time integration */
#define COARSEST 1e-3

static const char *const CATEGORIES[RF_CATEGORIES] = {"logStatusWarning", "logStatusDiscard",
                                                      "logStatusError", "logEvents", "logAll"};
enum {
    ALL_CATEGORIES = (1 << RF_CATEGORIES) - 1,
    FAILURES = 1 << RF_LOG_WARNING | 1 << RF_LOG_DISCARD | 1 << RF_LOG_ERROR
};

static const char *phase_name(uint32_t phase)
{
    switch (phase) {
    case RF_INSTANTIATED: return "instantiated";
    case RF_CONFIGURING: return "configuration mode";
    case RF_INITIALIZING: return "initialization mode";
    case RF_EVENT: return "event mode";
    case RF_CONTINUOUS: return "continuous-time mode";
    case RF_STEPPING: return "step mode";
    case RF_STEP_FAILED: return "step failed";
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
                  phase_name(c->now.phase));
}

static void forget(rf_instance *c)
{
    c->known = 0;
}

/* Start values of all variables, and the phase after instantiation. */
static void start(rf_instance *c)
{
    const rf_resource *r = c->resource;
    const rf_condition initial = {0.0, HUGE_VAL, 0.0, RF_INSTANTIATED, 0};
    for (size_t i = 0; i < r->variable_count; ++i) {
        const rf_variable *v = r->variables + i;
        if (v->role != RF_TIME)
            c->values[v->role][v->index] = v->start;
        if (v->role == RF_STATE)
            c->nominal[v->index] = v->nominal;
    }
    c->now = initial;
    c->resume = RF_INSTANTIATED;
    c->tolerance = rf_default_tolerance(c->type);
    c->stop_defined = c->terminated = 0;
    c->last_good_time = 0.0;
    c->parameters_changed = 1;
    forget(c);
}

/* One block for all numbers: values that are saved, values that follow, derivatives, work. */
static int allocate(rf_instance *c)
{
    const size_t p = c->sizes.parameters, m = c->sizes.inputs, q = c->sizes.outputs, n = c->sizes.states;
    const size_t z = c->sizes.events, total = p + m + n + q + n + z + n + n * n + n * m + q * n + q * m + rf_integration_work(n) + n;
    double *at = calloc(total + 1, sizeof *at);
    if (!at)
        return 0;
    c->value_count = p + m + n;
    c->values[RF_PARAMETER] = at, at += p;
    c->values[RF_INPUT] = at, at += m;
    c->values[RF_STATE] = at, at += n;
    c->values[RF_OUTPUT] = at, at += q;
    c->values[RF_DERIVATIVE] = at, at += n;
    c->values[RF_SWITCH] = at, at += z;
    c->nominal = at, at += n;
    c->jacobian.A = at, at += n * n;
    c->jacobian.B = at, at += n * m;
    c->jacobian.C = at, at += q * n;
    c->jacobian.D = at, at += q * m;
    c->work = at; /* for the integration, and a state beside it */
    return 1;
}

static int fits(const rf_instance *c, rf_message *why)
{
    const size_t *count = c->resource->count;
    if (count[RF_TIME] == 1 && count[RF_PARAMETER] == c->sizes.parameters
        && count[RF_INPUT] == c->sizes.inputs && count[RF_OUTPUT] == c->sizes.outputs
        && count[RF_STATE] == c->sizes.states && count[RF_DERIVATIVE] == c->sizes.states
        && count[RF_SWITCH] == c->sizes.events)
        return 1;
    rf_say(why, RF_INVALID,
           "the variables must be those of the kernel %s: %zu parameters, %zu inputs, %zu outputs, "
           "%zu states, got %zu, %zu, %zu, %zu",
           c->resource->kernel, c->sizes.parameters, c->sizes.inputs, c->sizes.outputs, c->sizes.states,
           count[RF_PARAMETER], count[RF_INPUT], count[RF_OUTPUT], count[RF_STATE]);
    return 0;
}

static int load(rf_instance *c, const char *token, const char *folder, rf_message *why)
{
    char *path = rf_resource_path(folder, why);
    c->resource = path ? rf_read_resource(path, why) : NULL;
    free(path);
    if (!c->resource)
        return 0;
    if (!token || strcmp(token, c->resource->token) != 0) {
        rf_say(why, RF_INVALID, "the guid or instantiation token must be %s, got %.100s", c->resource->token,
               token ? token : "none");
        return 0;
    }
    c->type = rf_find_kernel(c->resource->kernel);
    if (!c->type) {
        rf_say(why, RF_INVALID, "this library has no kernel %s", c->resource->kernel);
        return 0;
    }
    c->kernel = c->type->create(&c->resource->tables, &c->sizes, why);
    if (!c->kernel || !fits(c, why))
        return 0;
    if (allocate(c))
        return 1;
    rf_say(why, RF_MEMORY, "no memory for an instance");
    return 0;
}

rf_instance *rf_make_instance(const char *name, const char *token, const char *folder, int logging,
                              int co_simulation, const rf_host *host)
{
    rf_message why;
    rf_instance *c = calloc(1, sizeof *c);
    const char *shown = name ? name : "";
    char *copy = malloc(strlen(shown) + 1);
    if (!c || !copy) {
        free(c);
        free(copy);
        return NULL;
    }
    c->name = strcpy(copy, shown);
    c->host = *host;
    c->categories = logging ? ALL_CATEGORIES & ~(1u << RF_LOG_ALL) : FAILURES;
    c->co_simulation = co_simulation;
    if (!*shown || !load(c, token, folder, &why)) {
        rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s",
               *shown ? why.text : "the name of an instance must not be empty");
        rf_free_instance(c);
        return NULL;
    }
    start(c);
    return c;
}

void rf_free_instance(rf_instance *c)
{
    if (!c)
        return;
    if (c->kernel)
        c->type->destroy(c->kernel);
    rf_free_resource(c->resource);
    free(c->values[RF_PARAMETER]);
    free(c->name);
    free(c);
}

/* What the simulator gets for a status. In continuous-time mode a smaller step may help, and the standards
   then want Discard ("a function is outside of its domain"); it does not mend parameters. */
static rf_answer failed(rf_instance *c, int status, const char *what, const rf_message *why)
{
    const int retry = c->now.phase == RF_CONTINUOUS && status != RF_INVALID;
    return rf_log(c, retry ? RF_DISCARD : RF_ERROR, retry ? RF_LOG_DISCARD : RF_LOG_ERROR,
                  "%s at t = %.9g s: %s", what, c->now.time, why->text);
}

/* An answer beyond the verified range is worth one warning. */
static rf_answer judged(rf_instance *c, int status, const char *what, const rf_message *why)
{
    if (status > RF_OUTSIDE)
        return failed(c, status, what, why);
    if (status == RF_OK || c->now.warned)
        return RF_FINE;
    c->now.warned = 1;
    return rf_log(c, RF_WARNING, RF_LOG_WARNING, "%s at t = %.9g s: %s (told once)", what, c->now.time,
                  why->text);
}

static int apply_parameters(rf_instance *c, rf_message *why)
{
    int status = RF_OK;
    if (c->parameters_changed && c->type->set_parameters)
        status = c->type->set_parameters(c->kernel, c->values[RF_PARAMETER], why);
    c->parameters_changed = status != RF_OK;
    return status;
}

/* In continuous-time mode a time event still lies ahead: what counts there is the limit from before. */
static rf_point point(const rf_instance *c)
{
    const int before = c->now.phase == RF_CONTINUOUS && c->now.time == c->now.kink;
    const rf_point at = {before ? nextafter(c->now.time, -HUGE_VAL) : c->now.time, c->values[RF_STATE],
                         c->values[RF_INPUT]};
    return at;
}

/* Compute the values of this role unless they are known. */
static int evaluate(rf_instance *c, rf_role role, rf_message *why)
{
    const rf_kernel_type *type = c->type;
    int (*const function)(const void *, const rf_point *, double *, rf_message *) =
        role == RF_OUTPUT ? type->output : role == RF_DERIVATIVE ? type->derivative : type->events;
    if (c->known & 1u << role || !function)
        return RF_OK;
    int status = apply_parameters(c, why);
    const rf_point at = point(c);
    if (status == RF_OK)
        status = function(c->kernel, &at, c->values[role], why);
    for (size_t i = 0; status <= RF_OUTSIDE && i < c->resource->count[role]; ++i)
        if (!isfinite(c->values[role][i]))
            status = rf_say(why, RF_NOT_FINITE, "value %zu is not finite", i);
    if (status <= RF_OUTSIDE)
        c->known |= 1u << role;
    return status;
}

rf_answer rf_set_experiment(rf_instance *c, int tolerance_defined, double tolerance, double begin,
                            int stop_defined, double stop)
{
    if (!isfinite(begin) || (stop_defined && !(stop >= begin && stop < HUGE_VAL)))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR,
                      "start and stop time must be finite and ascending, got %.9g and %.9g s", begin, stop);
    if (tolerance_defined && !(tolerance > 0.0 && tolerance < HUGE_VAL))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "tolerance must be finite and positive, got %.9g",
                      tolerance);
    c->tolerance = tolerance_defined ? fmin(fmax(tolerance, FINEST), COARSEST)
                                     : rf_default_tolerance(c->type);
    c->now.time = c->last_good_time = begin;
    c->stop_defined = stop_defined;
    c->stop_time = stop;
    forget(c);
    return RF_FINE;
}

rf_answer rf_exit_initialization(rf_instance *c)
{
    rf_message why;
    if (apply_parameters(c, &why) != RF_OK)
        return failed(c, RF_INVALID, "parameters", &why);
    const rf_answer answer = judged(c, evaluate(c, RF_OUTPUT, &why), "outputs", &why);
    if (answer <= RF_WARNING)
        rf_pass_event(c);
    return answer;
}

rf_answer rf_reset(rf_instance *c)
{
    start(c);
    return RF_FINE;
}

static const rf_variable *find(rf_instance *c, unsigned reference, const char *function)
{
    if (reference < c->resource->variable_count)
        return c->resource->variables + reference;
    rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s: value reference must be below %zu, got %u", function,
           c->resource->variable_count, reference);
    return NULL;
}

/* Compute what the variables of this role follow from. */
static rf_answer refresh(rf_instance *c, rf_role role)
{
    rf_message why;
    if (role != RF_OUTPUT && role != RF_DERIVATIVE && role != RF_SWITCH)
        return RF_FINE;
    return judged(c, evaluate(c, role, &why),
                  role == RF_OUTPUT       ? "outputs"
                  : role == RF_DERIVATIVE ? "derivatives"
                                          : "switching functions",
                  &why);
}

rf_answer rf_get(rf_instance *c, const unsigned *references, size_t count, double *values)
{
    rf_answer worst = RF_FINE;
    for (size_t i = 0; i < count; ++i) {
        const rf_variable *v = find(c, references[i], "get");
        const rf_answer answer = v ? refresh(c, v->role) : RF_ERROR;
        worst = answer > worst ? answer : worst;
        if (worst > RF_WARNING)
            return worst;
        values[i] = v->role == RF_TIME ? c->now.time : c->values[v->role][v->index];
    }
    return worst;
}

static rf_answer may_set(rf_instance *c, const rf_variable *v, double value)
{
    const int before = (c->now.phase & (RF_INSTANTIATED | RF_INITIALIZING)) != 0;
    const int between = (c->now.phase & (RF_EVENT | RF_STEPPING)) != 0;
    const int allowed = v->role == RF_INPUT
                        || (v->role == RF_PARAMETER && (before || (between && v->flags & RF_TUNABLE)))
                        || (v->role == RF_STATE && before);
    if (!allowed)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s cannot be set in the state '%s'", v->name,
                      phase_name(c->now.phase));
    if (!isfinite(value))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s must be finite, got %.9g", v->name, value);
    if (v->role == RF_PARAMETER && !(value >= v->minimum && value <= v->maximum))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s must be within %.9g and %.9g, got %.9g", v->name,
                      v->minimum, v->maximum, value);
    return RF_FINE;
}

rf_answer rf_set(rf_instance *c, const unsigned *references, size_t count, const double *values)
{
    for (size_t i = 0; i < count; ++i) {
        const rf_variable *v = find(c, references[i], "set");
        if (!v || may_set(c, v, values[i]) != RF_FINE)
            return RF_ERROR;
    }
    for (size_t i = 0; i < count; ++i) {
        const rf_variable *v = c->resource->variables + references[i];
        c->values[v->role][v->index] = values[i];
        c->parameters_changed |= v->role == RF_PARAMETER;
    }
    forget(c);
    return RF_FINE;
}

rf_answer rf_set_time(rf_instance *c, double time)
{
    if (!isfinite(time))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "time must be finite, got %.9g", time);
    c->now.time = time;
    forget(c);
    return RF_FINE;
}

static rf_answer require_states(rf_instance *c, size_t count)
{
    if (count == c->sizes.states)
        return RF_FINE;
    return rf_log(c, RF_ERROR, RF_LOG_ERROR, "the number of continuous states must be %zu, got %zu",
                  c->sizes.states, count);
}

rf_answer rf_set_states(rf_instance *c, const double *x, size_t count)
{
    if (require_states(c, count) != RF_FINE)
        return RF_ERROR;
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(x[i]))
            return rf_log(c, RF_ERROR, RF_LOG_ERROR, "continuous state %zu must be finite, got %.9g", i,
                          x[i]);
    if (count)
        memcpy(c->values[RF_STATE], x, count * sizeof *x);
    forget(c);
    return RF_FINE;
}

static rf_answer copy_states(rf_instance *c, const double *from, double *to, size_t count)
{
    if (require_states(c, count) != RF_FINE)
        return RF_ERROR;
    if (count)
        memcpy(to, from, count * sizeof *to);
    return RF_FINE;
}

rf_answer rf_get_states(rf_instance *c, double *x, size_t count)
{
    return copy_states(c, c->values[RF_STATE], x, count);
}

rf_answer rf_get_nominals(rf_instance *c, double *nominal, size_t count)
{
    return copy_states(c, c->nominal, nominal, count);
}

rf_answer rf_get_derivatives(rf_instance *c, double *dx, size_t count)
{
    const rf_answer answer = refresh(c, RF_DERIVATIVE);
    if (answer > RF_WARNING)
        return answer;
    return copy_states(c, c->values[RF_DERIVATIVE], dx, count) == RF_FINE ? answer : RF_ERROR;
}

rf_answer rf_get_switches(rf_instance *c, double *z, size_t count)
{
    if (count != c->sizes.events)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "the number of event indicators must be %zu, got %zu",
                      c->sizes.events, count);
    const rf_answer answer = refresh(c, RF_SWITCH);
    if (answer <= RF_WARNING && count)
        memcpy(z, c->values[RF_SWITCH], count * sizeof *z);
    return answer;
}

/* The entry of the Jacobian; NULL if these are no unknown and known. */
static const double *entry(const rf_instance *c, const rf_variable *unknown, const rf_variable *known)
{
    const size_t n = c->sizes.states, m = c->sizes.inputs;
    const int of_output = unknown->role == RF_OUTPUT, by_input = known->role == RF_INPUT;
    if (!(of_output || unknown->role == RF_DERIVATIVE) || !(by_input || known->role == RF_STATE))
        return NULL;
    const double *matrix =
        of_output ? (by_input ? c->jacobian.D : c->jacobian.C) : (by_input ? c->jacobian.B : c->jacobian.A);
    return matrix + unknown->index * (by_input ? m : n) + known->index;
}

/* Whether all these variables can be derived by each other. */
static rf_answer require_entries(rf_instance *c, const unsigned *unknowns, size_t unknown_count,
                                 const unsigned *knowns, size_t known_count)
{
    for (size_t i = 0; i < unknown_count * known_count; ++i) {
        const rf_variable *unknown = find(c, unknowns[i / known_count], "partial derivatives");
        const rf_variable *known = find(c, knowns[i % known_count], "partial derivatives");
        if (!unknown || !known)
            return RF_ERROR;
        if (!entry(c, unknown, known))
            return rf_log(c, RF_ERROR, RF_LOG_ERROR, "no derivative of %s by %s is provided", unknown->name,
                          known->name);
    }
    return RF_FINE;
}

rf_answer rf_differentiate(rf_instance *c, const unsigned *unknowns, size_t unknown_count,
                           const unsigned *knowns, size_t known_count, const double *seed,
                           double *sensitivity, int transposed)
{
    rf_message why;
    int status = apply_parameters(c, &why);
    const rf_point at = point(c);
    if (status == RF_OK)
        status = c->type->jacobian(c->kernel, &at, &c->jacobian, &why);
    const rf_answer answer = judged(c, status, "partial derivatives", &why);
    if (answer > RF_WARNING || require_entries(c, unknowns, unknown_count, knowns, known_count) != RF_FINE)
        return answer > RF_WARNING ? answer : RF_ERROR;
    const size_t rows = transposed ? known_count : unknown_count,
                 columns = transposed ? unknown_count : known_count;
    for (size_t i = 0; i < rows; ++i) {
        double sum = 0.0;
        for (size_t j = 0; j < columns; ++j) {
            const size_t unknown = unknowns[transposed ? j : i], known = knowns[transposed ? i : j];
            sum += seed[j] * *entry(c, c->resource->variables + unknown, c->resource->variables + known);
        }
        if (!isfinite(sum))
            return rf_log(c, RF_ERROR, RF_LOG_ERROR, "partial derivative %zu is not finite", i);
        sensitivity[i] = sum;
    }
    return answer;
}

void rf_enter(rf_instance *c, rf_phase phase)
{
    c->now.phase = phase;
    forget(c);
}

void rf_pass_event(rf_instance *c)
{
    c->now.kink = c->type->next_event ? c->type->next_event(c->kernel, c->now.time) : HUGE_VAL;
    forget(c);
}

int rf_has_kink(const rf_instance *c)
{
    return c->now.kink < HUGE_VAL;
}

/* Move the states to *t = end, or as far as it goes. */
static int move(rf_instance *c, double *t, double end, rf_message *why)
{
    double *x = c->values[RF_STATE];
    if (c->sizes.states && c->type->step) {
        const rf_point at = {*t, x, c->values[RF_INPUT]};
        const int status = c->type->step(c->kernel, &at, end - *t, x, why);
        *t = status <= RF_OUTSIDE ? end : *t;
        return status;
    }
    if (c->sizes.states) {
        const rf_integration job = {c->type,      c->kernel,       c->sizes.states, c->nominal,
                                    c->tolerance, &c->now.stride, c->work};
        return rf_integrate(&job, t, x, c->values[RF_INPUT], end, why);
    }
    *t = end;
    return RF_OK;
}

/* A film without states has no use for a smaller step: that is an error, and the time stays. States that
   cannot go on end the simulation at the last good time. */
static rf_answer give_up(rf_instance *c, double reached, const rf_message *why)
{
    c->now.time = c->last_good_time = reached;
    forget(c);
    if (c->sizes.states == 0)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "step from t = %.9g s: %s", reached, why->text);
    c->terminated = 1;
    c->now.phase = RF_STEP_FAILED;
    return rf_log(c, RF_DISCARD, RF_LOG_DISCARD, "step failed, last good time t = %.9g s: %s", reached,
                  why->text);
}

static rf_answer require_step(rf_instance *c, double from, double step)
{
    const double slack = 1e-6 * step + 1e-9 * fabs(c->now.time);
    if (!(step > 0.0 && step < HUGE_VAL))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR,
                      "communicationStepSize must be finite and positive, got %.9g s", step);
    if (!(fabs(from - c->now.time) <= slack))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "currentCommunicationPoint must be %.17g s, got %.17g s",
                      c->now.time, from);
    if (c->stop_defined && from + step > c->stop_time + slack)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR,
                      "the step must not end after the stop time %.17g s, got %.17g s", c->stop_time,
                      from + step);
    return RF_FINE;
}

rf_answer rf_step(rf_instance *c, double from, double step)
{
    rf_message why;
    if (require_step(c, from, step) != RF_FINE)
        return RF_ERROR;
    if (apply_parameters(c, &why) != RF_OK)
        return failed(c, RF_INVALID, "parameters", &why);
    const double kink = c->event_mode && c->early_return ? c->now.kink : HUGE_VAL;
    const double end = kink > from && kink < from + step ? kink : from + step;
    double t = from, *before = c->work + rf_integration_work(c->sizes.states);
    memcpy(before, c->values[RF_STATE], c->sizes.states * sizeof *before);
    int status = move(c, &t, end, &why);
    if (status > RF_OUTSIDE)
        return give_up(c, t, &why);
    c->now.time = t;
    forget(c);
    status = evaluate(c, RF_OUTPUT, &why);
    if (status > RF_OUTSIDE) {
        memcpy(c->values[RF_STATE], before, c->sizes.states * sizeof *before);
        return give_up(c, from, &why);
    }
    c->last_good_time = t;
    if (!c->event_mode || t != c->now.kink) {
        rf_pass_event(c);
        c->known |= 1u << RF_OUTPUT;
    }
    return judged(c, status, "outputs", &why);
}
