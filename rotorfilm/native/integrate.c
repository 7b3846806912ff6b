/* The embedded method of order 5(4) of Dormand and Prince (1980), with error control, from kink to kink. */
#include "integrate.h"

#include <math.h>
#include <string.h>

#define STAGES 7
#define MOST_STEPS 100000
#define SAFETY 0.9
#define LEAST 0.2
#define MOST 10.0

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

/* One piece between two kinks; its end belongs to it with the derivative from before. */
typedef struct piece {
    const rf_integration *job;
    const double *u;
    double end;
    double *k[STAGES], *trial;
} piece;

size_t rf_integration_work(size_t states)
{
    return (STAGES + 1) * states;
}

static int derive(const piece *p, double t, const double *x, double *dx, rf_message *why)
{
    const rf_point at = {t < p->end ? t : nextafter(p->end, -HUGE_VAL), x, p->u};
    return p->job->type->derivative(p->job->kernel, &at, dx, why);
}

/* Stages 1 to 6 after stage 0; the last one is the new state's, left in `trial`. */
static int stages(const piece *p, double t, double h, const double *x, rf_message *why)
{
    const size_t n = p->job->states;
    for (int s = 1; s < STAGES; ++s) {
        for (size_t i = 0; i < n; ++i) {
            double sum = 0.0;
            for (int r = 0; r < s; ++r)
                sum += A[s][r] * p->k[r][i];
            p->trial[i] = x[i] + h * sum;
        }
        const int status = derive(p, t + C[s] * h, p->trial, p->k[s], why);
        if (status > RF_OUTSIDE)
            return status;
    }
    return RF_OK;
}

/* Root mean square of the local error in tolerances; not a number where the state is none. */
static double error_of(const piece *p, double h, const double *x)
{
    const rf_integration *job = p->job;
    double sum = 0.0;
    for (size_t i = 0; i < job->states; ++i) {
        double error = 0.0;
        for (int s = 0; s < STAGES; ++s)
            error += E[s] * p->k[s][i];
        const double size = fabs(x[i]) > fabs(p->trial[i]) ? fabs(x[i]) : fabs(p->trial[i]);
        const double share = h * error / (job->tolerance * (job->nominal[i] + size));
        sum += share * share + 0.0 * p->trial[i];
    }
    return sqrt(sum / (double)job->states);
}

/* Factor of the step size after a step with this error. */
static double adapt(double error, int rejected)
{
    if (!(error < HUGE_VAL))
        return LEAST;
    const double factor = error > 0.0 ? SAFETY * pow(error, -0.2) : MOST;
    const double most = rejected ? 1.0 : MOST;
    return factor < LEAST ? LEAST : factor > most ? most : factor;
}

static int stuck(double t, double end, double h, const rf_message *cause, rf_message *why)
{
    return rf_say(why, RF_STUCK,
                  "the integration cannot reach %.9g s from %.9g s, its step fell to %.3g s: %.200s", end, t,
                  h, cause->text[0] ? cause->text : "the tolerance cannot be met");
}

static int run_piece(const piece *p, double *t, double *x, rf_message *why)
{
    const size_t n = p->job->states;
    rf_message cause = {""};
    double h = p->end - *t;
    int rejected = 0, status = derive(p, *t, x, p->k[0], &cause);
    if (status > RF_OUTSIDE)
        return stuck(*t, p->end, h, &cause, why);
    for (int count = 0; count < MOST_STEPS; ++count) {
        const int last = *t + h >= p->end;
        h = last ? p->end - *t : h;
        status = stages(p, *t, h, x, &cause);
        const double error = status == RF_OK ? error_of(p, h, x) : HUGE_VAL;
        if (error <= 1.0) {
            *t = last ? p->end : *t + h;
            memcpy(x, p->trial, n * sizeof *x);
            memcpy(p->k[0], p->k[STAGES - 1], n * sizeof *x);
            if (last)
                return RF_OK;
        }
        h *= adapt(error, rejected || !(error <= 1.0));
        rejected = !(error <= 1.0);
        if (h < 10.0 * (nextafter(fabs(*t), HUGE_VAL) - fabs(*t)))
            break;
    }
    return stuck(*t, p->end, h, &cause, why);
}

int rf_integrate(const rf_integration *job, double *t, double *x, const double *u, double end,
                 rf_message *why)
{
    piece p = {job, u, end, {NULL}, job->work + STAGES * job->states};
    for (int s = 0; s < STAGES; ++s)
        p.k[s] = job->work + (size_t)s * job->states;
    while (*t < end) {
        const double kink = job->type->next_event ? job->type->next_event(job->kernel, *t) : HUGE_VAL;
        p.end = kink < end ? kink : end;
        const int status = run_piece(&p, t, x, why);
        if (status != RF_OK)
            return status;
    }
    return RF_OK;
}
