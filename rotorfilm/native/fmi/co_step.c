#include "evaluate.h"

#include <math.h>
#include <string.h>

static double pass(void *host, double t, double end)
{
    rf_instance *c = host;
    const double start = c->now.time;
    c->now.time = t;
    rf_forget(c);
    rf_enter(c, RF_WITHIN_STEP);
    const double wanted = c->within_step(c, t, end);
    rf_enter(c, RF_STEPPING);
    c->now.time = start;
    return wanted;
}

/* Move the states to *t = end, or as far as it goes. */
static int move(rf_instance *c, double *t, double end, rf_message *why)
{
    double *x = c->values[RF_STATE];
    if (rf_kept(c) && c->type->step) {
        const rf_point at = {*t, x, c->values[RF_INPUT]};
        const int status = c->type->step(c->kernel, &at, end - *t, x, why);
        *t = status <= RF_OUTSIDE ? end : *t;
        return status;
    }
    if (c->sizes.states) {
        const rf_integration job = {c->type,      c->kernel,       c->sizes.states, c->nominal,
                                    c->tolerance, &c->now.stride, c->work,
                                    {c->within_step ? pass : NULL, c}};
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
    rf_forget(c);
    if (rf_kept(c) == 0)
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
    if (rf_apply_parameters(c, &why) != RF_OK)
        return rf_failed(c, RF_INVALID, "parameters", &why);
    const double kink = c->event_mode && c->early_return ? c->now.kink : HUGE_VAL;
    const double end = kink > from && kink < from + step ? kink : from + step;
    double t = from, *before = c->work + rf_integration_work(c->sizes.states);
    memcpy(before, c->values[RF_STATE], rf_kept(c) * sizeof *before);
    int status = move(c, &t, end, &why);
    if (status > RF_OUTSIDE)
        return give_up(c, t, &why);
    c->now.time = t;
    rf_forget(c);
    status = rf_evaluate(c, RF_OUTPUT, &why);
    if (status > RF_OUTSIDE) {
        memcpy(c->values[RF_STATE], before, rf_kept(c) * sizeof *before);
        return give_up(c, from, &why);
    }
    c->last_good_time = t;
    c->now.step = t - from;
    if (!c->event_mode || t != c->now.kink) {
        rf_pass_event(c);
        c->known |= 1u << RF_OUTPUT;
    }
    return rf_judged(c, status, "outputs", &why);
}
