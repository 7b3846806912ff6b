#include "evaluate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FINEST 1e-13 /* tolerance of the time integration */
#define COARSEST 1e-3

/* Start values of all variables, and the phase after instantiation. */
static void start(rf_instance *c)
{
    const rf_resource *r = c->resource;
    const rf_condition initial = {0.0, HUGE_VAL, 0.0, RF_INSTANTIATED, 0, 0.0};
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
    if (c->memory)
        memset(c->values[RF_STATE], 0, c->memory * sizeof(double));
    rf_forget(c);
}

/* One block for all numbers: values that are saved, values that follow, derivatives, work. A memory is where states
   would be. */
static int allocate(rf_instance *c)
{
    const size_t p = c->sizes.parameters, m = c->sizes.inputs, q = c->sizes.outputs, n = c->sizes.states;
    const size_t z = c->sizes.events, kept = rf_kept(c), derived = 3 * q + n + z + n + n * n + n * m + q * n + q * m;
    const size_t total = p + m + kept + derived + rf_integration_work(n) + kept;
    double *at = calloc(total + 1, sizeof *at);
    if (!at)
        return 0;
    c->value_count = p + m + kept;
    c->values[RF_PARAMETER] = at, at += p;
    c->values[RF_INPUT] = at, at += m;
    c->values[RF_STATE] = at, at += kept;
    c->values[RF_OUTPUT] = at, at += q;
    c->values[RF_DERIVATIVE] = at, at += n;
    c->values[RF_SWITCH] = at, at += z;
    c->nominal = at, at += n;
    c->drift = at, at += 2 * q;
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
    c->kernel = rf_create_kernel(c->type, &c->resource->tables, &c->sizes, why);
    if (!c->kernel || !fits(c, why))
        return 0;
    c->memory = c->type->memory ? c->type->memory(c->kernel) : 0;
    if (c->memory && !c->co_simulation) {
        rf_say(why, RF_INVALID, "the kernel %s steps by itself: it has Co-Simulation only", c->resource->kernel);
        return 0;
    }
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
    rf_destroy_kernel(c->type, c->kernel);
    rf_free_resource(c->resource);
    free(c->values[RF_PARAMETER]);
    free(c->name);
    free(c);
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
    rf_forget(c);
    return RF_FINE;
}

rf_answer rf_exit_initialization(rf_instance *c)
{
    rf_message why;
    if (rf_apply_parameters(c, &why) != RF_OK)
        return rf_failed(c, RF_INVALID, "parameters", &why);
    const rf_answer answer = rf_judged(c, rf_evaluate(c, RF_OUTPUT, &why), "outputs", &why);
    if (answer <= RF_WARNING)
        rf_pass_event(c);
    return answer;
}

rf_answer rf_reset(rf_instance *c)
{
    start(c);
    return RF_FINE;
}

void rf_enter(rf_instance *c, rf_phase phase)
{
    c->now.phase = phase;
    rf_forget(c);
}

void rf_pass_event(rf_instance *c)
{
    c->now.kink = c->type->next_event ? c->type->next_event(c->kernel, c->now.time) : HUGE_VAL;
    rf_forget(c);
}

int rf_has_kink(const rf_instance *c)
{
    return c->now.kink < HUGE_VAL;
}
