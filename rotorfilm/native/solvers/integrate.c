/* The embedded method of order 5(4) of Dormand and Prince (1980), with error control, from kink to kink. */
#include "integrate.h"

#include <math.h>
#include <string.h>

#define STAGES 7
#ifndef RF_MOST_STEPS /* fewer where a test counts on many calls */
#define RF_MOST_STEPS 100000
#endif
#define SAFETY 0.9
#define LEAST 0.2
#define MOST 10.0
#define WORTHWHILE 1.25 /* a smaller gain does not pay for a new factorization */

static const double C[STAGES] = {0.0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1.0, 1.0};
static const double A[STAGES][STAGES - 1] = {
    {0.0},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
};
static const double E[STAGES] = {-71.0 / 57600,    0.0,         71.0 / 16695, -71.0 / 1920,
                                 17253.0 / 339200, -22.0 / 525, 1.0 / 40};

size_t rf_integration_work(size_t states)
{
    return (STAGES + 3) * states; /* and the next state, the error, the slope */
}

static rf_point point_in(const rf_piece *p, double t, const double *x)
{
    const rf_point at = {t < p->end ? t : nextafter(p->end, -HUGE_VAL), x, p->u};
    return at;
}

int rf_derive(const rf_piece *p, double t, const double *x, double *dx, rf_message *why)
{
    const rf_point at = point_in(p, t, x);
    return p->job->type->derivative(p->job->kernel, &at, dx, why);
}

/* The last stage is the first one of the step after this. */
static int dormand_prince(const rf_piece *p, double t, double h, const double *x, rf_message *why)
{
    const size_t n = p->job->states;
    double *const *k = p->stages;
    int status = RF_OK;
    if (p->last == RF_ACCEPTED)
        memcpy(k[0], k[STAGES - 1], n * sizeof *x);
    if (p->last == RF_FIRST)
        status = rf_derive(p, t, x, k[0], why);
    for (int s = 1; s < STAGES && status <= RF_OUTSIDE; ++s) {
        for (size_t i = 0; i < n; ++i) {
            double sum = 0.0;
            for (int r = 0; r < s; ++r)
                sum += A[s][r] * k[r][i];
            p->next[i] = x[i] + h * sum;
        }
        status = rf_derive(p, t + C[s] * h, p->next, k[s], why);
    }
    for (size_t i = 0; i < n && status <= RF_OUTSIDE; ++i) {
        p->error[i] = 0.0;
        for (int s = 0; s < STAGES; ++s)
            p->error[i] += h * E[s] * k[s][i];
    }
    return status;
}

static const rf_method DORMAND_PRINCE = {5.0, 1e-10, 0, dormand_prince};

static const rf_method *method_of(const rf_kernel_type *type)
{
    return type->method ? type->method : &DORMAND_PRINCE;
}

double rf_default_tolerance(const rf_kernel_type *type)
{
    return method_of(type)->tolerance;
}

/* Root mean square of the local error in tolerances; not a number where the state is none. */
static double error_of(const rf_piece *p, const double *x)
{
    const rf_integration *job = p->job;
    double sum = 0.0;
    for (size_t i = 0; i < job->states; ++i) {
        const double size = fabs(x[i]) > fabs(p->next[i]) ? fabs(x[i]) : fabs(p->next[i]);
        const double share = p->error[i] / (job->tolerance * (job->nominal[i] + size));
        sum += share * share + 0.0 * p->next[i];
    }
    return sqrt(sum / (double)job->states);
}

/* Factor of the step size after a step with this error. */
static double adapt(double error, const rf_method *method, int rejected)
{
    if (!(error < HUGE_VAL))
        return LEAST;
    const double factor = error > 0.0 ? SAFETY * pow(error, -1.0 / method->order) : MOST;
    const double most = rejected ? 1.0 : MOST;
    if (method->costly && factor >= 1.0 && factor < WORTHWHILE)
        return 1.0;
    return factor < LEAST ? LEAST : factor > most ? most : factor;
}

/* The step became too short; the cause is what stopped attempts since the last step, empty where that was their error. */
static int stuck(double t, double end, double h, const rf_message *cause, rf_message *why)
{
    return rf_say(why, RF_STUCK,
                  "the integration cannot reach %.9g s from %.9g s, its step fell to %.3g s: %.200s", end, t,
                  h, cause->text[0] ? cause->text : "the tolerance cannot be met");
}

static int worn_out(double t, double end, rf_message *why)
{
    return rf_say(why, RF_STUCK,
                  "the integration reached %.9g s of %.9g s within %d steps, the most in one call: ask for shorter "
                  "communication steps or a larger tolerance",
                  t, end, RF_MOST_STEPS);
}

/* The step size, no longer than the rest; where a new one is costly, the rest in equal parts. */
static double fitted(double h, double rest, int costly)
{
    const double parts = rest / h;
    if (!(parts > 1.0))
        return rest;
    return costly && parts < 1e6 ? rest / ceil(parts * (1.0 - 1e-9)) : h;
}

/* Tell the watch of a step, which may bring the end nearer. */
static void pass(rf_piece *p, double t)
{
    const rf_watch *watch = &p->job->watch;
    if (!watch->passed)
        return;
    const double end = watch->passed(watch->host, t, p->goal);
    if (end < p->goal)
        p->goal = end > t ? end : t;
    if (p->goal < p->end)
        p->end = p->goal;
}

static int run_piece(rf_piece *p, double *t, double *x, rf_message *why)
{
    const rf_method *method = method_of(p->job->type);
    rf_message cause = {""};
    const double kept = method->costly ? *p->job->stride : 0.0;
    double h = kept > 0.0 && kept < p->end - *t ? kept : p->end - *t;
    p->last = RF_FIRST;
    for (int count = 0; count < RF_MOST_STEPS; ++count) {
        h = fitted(h, p->end - *t, method->costly);
        const int last = *t + h >= p->end || h >= p->end - *t;
        rf_message said = {""};
        const int status = method->attempt(p, *t, h, x, &said);
        const double error = status <= RF_OUTSIDE ? error_of(p, x) : HUGE_VAL;
        const int accepted = error <= 1.0, before = p->last;
        if (accepted) {
            *t = last ? p->end : *t + h;
            memcpy(x, p->next, p->job->states * sizeof *x);
            if (last) {
                if (method->costly)
                    *p->job->stride = h * adapt(error, method, before == RF_REJECTED);
                return RF_OK;
            }
            pass(p, *t);
            if (*t >= p->end)
                return RF_OK;
        }
        if (status > RF_OUTSIDE)
            cause = said;
        else if (accepted && before == RF_ACCEPTED)
            cause.text[0] = '\0';
        p->last = accepted ? RF_ACCEPTED : before == RF_FIRST && status > RF_OUTSIDE ? RF_FIRST : RF_REJECTED;
        h *= adapt(error, method, before == RF_REJECTED || !accepted);
        if (h < 10.0 * (nextafter(fabs(*t), HUGE_VAL) - fabs(*t)))
            return stuck(*t, p->end, h, &cause, why);
    }
    return worn_out(*t, p->end, why);
}

int rf_integrate(const rf_integration *job, double *t, double *x, const double *u, double end,
                 rf_message *why)
{
    const size_t n = job->states;
    rf_piece p = {job, u, end, end, RF_FIRST, job->work, job->work + n, {NULL}, job->work + 2 * n};
    for (size_t s = 0; s < STAGES; ++s)
        p.stages[s] = p.slope + (s + 1) * n;
    while (*t < p.goal) {
        const double kink = job->type->next_event ? job->type->next_event(job->kernel, *t) : HUGE_VAL;
        p.end = kink < p.goal ? kink : p.goal;
        const int status = run_piece(&p, t, x, why);
        if (status != RF_OK)
            return status;
        if (*t < p.goal)
            pass(&p, *t);
    }
    return RF_OK;
}
