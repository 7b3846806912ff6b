#include "evaluate.h"

#include <math.h>
#include <string.h>

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
    if ((role != RF_OUTPUT && role != RF_DERIVATIVE && role != RF_SWITCH) || c->known & 1u << role)
        return RF_FINE;
    return rf_judged(c, rf_evaluate(c, role, &why),
                  role == RF_OUTPUT       ? "outputs"
                  : role == RF_DERIVATIVE ? "derivatives"
                                          : "switching functions",
                  &why);
}

/* Numbers of variables, the arrays element by element; `references` must have been checked by `require`. */
typedef struct rf_walk {
    const rf_variable *variables;
    const unsigned *references;
    size_t count;
    uint32_t element;
} rf_walk;

static rf_walk walk(const rf_instance *c, const unsigned *references, size_t count)
{
    const rf_walk begin = {c->resource->variables, references, count, 0};
    return begin;
}

/* The next number, NULL at the end. */
static const rf_variable *next(rf_walk *at)
{
    if (!at->count)
        return NULL;
    const rf_variable *first = at->variables + *at->references, *found = first + at->element;
    if (at->element++ == first->more) {
        at->element = 0;
        ++at->references;
        --at->count;
    }
    return found;
}

/* Whether there are these variables, and so many numbers in them. */
static rf_answer require(rf_instance *c, const unsigned *references, size_t count, size_t numbers,
                         const char *function)
{
    size_t total = 0;
    for (size_t i = 0; i < count; ++i) {
        const rf_variable *v = find(c, references[i], function);
        if (!v)
            return RF_ERROR;
        total += 1 + v->more;
    }
    if (total == numbers)
        return RF_FINE;
    return rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s: %zu variables have %zu values, got %zu", function, count, total,
                  numbers);
}

rf_answer rf_get(rf_instance *c, const unsigned *references, size_t count, double *values, size_t numbers)
{
    rf_answer worst = require(c, references, count, numbers, "get");
    rf_walk at = walk(c, references, count);
    const rf_variable *v;
    while (worst <= RF_WARNING && (v = next(&at)) != NULL) {
        const rf_answer answer = refresh(c, v->role);
        worst = answer > worst ? answer : worst;
        *values++ = v->role == RF_TIME ? c->now.time : c->values[v->role][v->index];
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
                      rf_phase_name(c->now.phase));
    if (!isfinite(value))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s must be finite, got %.9g", v->name, value);
    if (v->role == RF_PARAMETER && !(value >= v->minimum && value <= v->maximum))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s must be within %.9g and %.9g, got %.9g", v->name,
                      v->minimum, v->maximum, value);
    return RF_FINE;
}

rf_answer rf_set(rf_instance *c, const unsigned *references, size_t count, const double *values, size_t numbers)
{
    if (require(c, references, count, numbers, "set") != RF_FINE)
        return RF_ERROR;
    rf_walk at = walk(c, references, count);
    const rf_variable *v;
    for (size_t i = 0; (v = next(&at)) != NULL; ++i)
        if (may_set(c, v, values[i]) != RF_FINE)
            return RF_ERROR;
    at = walk(c, references, count);
    while ((v = next(&at)) != NULL) {
        c->values[v->role][v->index] = *values++;
        c->parameters_changed |= v->role == RF_PARAMETER;
    }
    rf_forget(c);
    return RF_FINE;
}

rf_answer rf_set_time(rf_instance *c, double time)
{
    if (!isfinite(time))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "time must be finite, got %.9g", time);
    c->now.time = time;
    rf_forget(c);
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
    rf_forget(c);
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

/* Put the Jacobian where `entry` finds it. */
static rf_answer derive(rf_instance *c)
{
    rf_message why;
    if (!c->type->jacobian)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "no partial derivatives are provided");
    int status = rf_apply_parameters(c, &why);
    const rf_point at = rf_present_point(c);
    if (status == RF_OK)
        status = c->type->jacobian(c->kernel, &at, &c->jacobian, &why);
    return rf_judged(c, status, "partial derivatives", &why);
}

rf_answer rf_differentiate(rf_instance *c, const rf_pair *pair, const double *seed, size_t seeds,
                           double *sensitivity, size_t sensitivities, int transposed)
{
    const size_t rows = transposed ? seeds : sensitivities, columns = transposed ? sensitivities : seeds;
    const rf_answer answer = derive(c);
    if (answer > RF_WARNING)
        return answer;
    if (require(c, pair->unknowns, pair->unknown_count, rows, "partial derivatives") != RF_FINE
        || require(c, pair->knowns, pair->known_count, columns, "partial derivatives") != RF_FINE)
        return RF_ERROR;
    for (size_t i = 0; i < sensitivities; ++i)
        sensitivity[i] = 0.0;
    const rf_variable *unknown, *known;
    rf_walk row = walk(c, pair->unknowns, pair->unknown_count);
    for (size_t i = 0; (unknown = next(&row)) != NULL; ++i) {
        rf_walk column = walk(c, pair->knowns, pair->known_count);
        for (size_t j = 0; (known = next(&column)) != NULL; ++j) {
            const double *slope = entry(c, unknown, known);
            if (!slope)
                return rf_log(c, RF_ERROR, RF_LOG_ERROR, "no derivative of %s by %s is provided", unknown->name,
                              known->name);
            sensitivity[transposed ? j : i] += *slope * seed[transposed ? i : j];
        }
    }
    for (size_t i = 0; i < sensitivities; ++i)
        if (!isfinite(sensitivity[i]))
            return rf_log(c, RF_ERROR, RF_LOG_ERROR, "partial derivative %zu is not finite", i);
    return answer;
}

/* Add the outputs some time ahead at the present states, times a weight, to c->drift. */
static int add_ahead(rf_instance *c, double ahead, double weight, rf_message *why)
{
    const rf_point at = {c->now.time + ahead, c->values[RF_STATE], c->values[RF_INPUT]};
    double *outputs = c->drift + c->sizes.outputs;
    const int status = c->type->output(c->kernel, &at, outputs, why);
    for (size_t i = 0; status <= RF_OUTSIDE && i < c->sizes.outputs; ++i)
        c->drift[i] += weight * outputs[i];
    return status;
}

/* dy/dt = C dx/dt under held inputs, and what the time itself changes, by differences forward within the next step. */
rf_answer rf_get_output_slopes(rf_instance *c, const unsigned *references, size_t count, const int *orders,
                               double *values, size_t numbers)
{
    rf_message why;
    if (require(c, references, count, numbers, "output derivatives") != RF_FINE)
        return RF_ERROR;
    if (!count)
        return RF_FINE;
    rf_answer answer = refresh(c, RF_DERIVATIVE);
    answer = answer <= RF_WARNING ? derive(c) : answer;
    if (answer > RF_WARNING)
        return answer;
    const double h = 1e-3 * (c->now.step > 0.0 ? c->now.step : 1e-3);
    memset(c->drift, 0, c->sizes.outputs * sizeof *c->drift);
    int status = add_ahead(c, 0.0, -1.5 / h, &why);
    status = status <= RF_OUTSIDE ? add_ahead(c, h, 2.0 / h, &why) : status;
    status = status <= RF_OUTSIDE ? add_ahead(c, 2.0 * h, -0.5 / h, &why) : status;
    if (status > RF_OUTSIDE)
        return rf_failed(c, status, "output derivatives", &why);
    for (size_t i = 0; i < count; ++i) {
        const rf_variable *v = c->resource->variables + references[i];
        if (v->role != RF_OUTPUT || orders[i] != 1 || !c->sizes.states)
            return rf_log(c, RF_ERROR, RF_LOG_ERROR, "outputs have derivatives of order 1 where there are states, got %s, %d",
                          v->name, orders[i]);
        for (uint32_t k = 0; k <= v->more; ++k) {
            const size_t row = v[k].index;
            double sum = c->drift[row];
            for (size_t j = 0; j < c->sizes.states; ++j)
                sum += c->jacobian.C[row * c->sizes.states + j] * c->values[RF_DERIVATIVE][j];
            if (!isfinite(sum))
                return rf_log(c, RF_ERROR, RF_LOG_ERROR, "derivative of %s is not finite", v[k].name);
            *values++ = sum;
        }
    }
    return answer;
}
