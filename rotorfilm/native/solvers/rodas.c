/* RODAS (Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.7): Rosenbrock method of order
   4(3), stiffly accurate and L-stable, with the exact Jacobian at the start of each step. */
#include <string.h>

#include "integrate.h"

#define STAGES 6
#define GAMMA 0.25

static const double ALPHA[STAGES] = {0.0, 0.386, 0.21, 0.63, 1.0, 1.0};
static const double DRIFT[STAGES] = {0.25, -0.1043, 0.1035, -0.03620000000000023, 0.0, 0.0};
static const double A[STAGES][STAGES - 1] = {
    {0.0},
    {1.544},
    {0.9466785280815826, 0.2557011698983284},
    {3.314825187068521, 2.896124015972201, 0.9986419139977817},
    {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950},
    {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1.0},
};
static const double C[STAGES][STAGES - 1] = {
    {0.0},
    {-5.6688},
    {-2.430093356833875, -0.2063599157091915},
    {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
    {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
    {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054},
};

/* sum[n] += a[0] v[0] + ... of the first `count` stages. */
static void add_stages(size_t n, int count, double scale, const double *a, double *const *stages, double *sum)
{
    for (int s = 0; s < count; ++s)
        for (size_t i = 0; i < n; ++i)
            sum[i] += scale * a[s] * stages[s][i];
}

static int attempt(const rf_piece *p, double t, double h, const double *x, rf_message *why)
{
    const rf_integration *job = p->job;
    const size_t n = job->states;
    const rf_point start = {t, x, p->u};
    int status = job->type->factorize(job->kernel, &start, 1.0 / (GAMMA * h), why);
    if (status > RF_OUTSIDE)
        return status;
    job->type->drift(job->kernel, &start, p->slope);
    for (int s = 0; s < STAGES; ++s) {
        double *stage = p->stages[s];
        memcpy(p->next, x, n * sizeof *x);
        add_stages(n, s, 1.0, A[s], p->stages, p->next);
        status = rf_derive(p, t + ALPHA[s] * h, p->next, stage, why);
        if (status > RF_OUTSIDE)
            return status;
        add_stages(n, s, 1.0 / h, C[s], p->stages, stage);
        for (size_t i = 0; i < n; ++i)
            stage[i] += DRIFT[s] * h * p->slope[i];
        job->type->solve(job->kernel, stage);
    }
    for (size_t i = 0; i < n; ++i)
        p->next[i] += p->error[i] = p->stages[STAGES - 1][i];
    return status;
}

const rf_method rf_rodas = {4.0, 1e-6, 1, attempt};
