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
    if (role != RF_OUTPUT && role != RF_DERIVATIVE && role != RF_SWITCH)
        return RF_FINE;
    return rf_judged(c, rf_evaluate(c, role, &why),
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
                      rf_phase_name(c->now.phase));
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
    if (!c->type->jacobian)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "no partial derivatives are provided");
    int status = rf_apply_parameters(c, &why);
    const rf_point at = rf_present_point(c);
    if (status == RF_OK)
        status = c->type->jacobian(c->kernel, &at, &c->jacobian, &why);
    const rf_answer answer = rf_judged(c, status, "partial derivatives", &why);
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
