/* Kernel "linear": a state space dx' = A x + B u, y = C x + D u of any size, stepped by the exact solution
   under held inputs. Tables A (n, n), B (n, m), C (p, n), D (p, m); no parameters. */

/* Documentation of the FMU

   Model: Linear time-invariant system, exported from python-control.

   Equations:
   dx/dt = A x + B u
   y = C x + D u

   Validity: That of the linearization the matrices come from. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../solvers/dense.h"
#include "../solvers/exponential.h"
#include "kernel.h"

#define MOST 1000

typedef struct model {
    size_t n, m, p;
    const double *A, *B, *C, *D;
    double dt;          /* of the transition; 0 as long as there is none */
    double *transition; /* (n + m, n + m), its first n rows over [x; u] */
    double *next, *work;
} model;

static void release(void *kernel)
{
    model *self = kernel;
    free(self->transition);
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const rf_table *A = rf_find_table(tables, "A", 2, why),
                   *B = A ? rf_find_table(tables, "B", 2, why) : NULL;
    const rf_table *C = B ? rf_find_table(tables, "C", 2, why) : NULL,
                   *D = C ? rf_find_table(tables, "D", 2, why) : NULL;
    if (!D)
        return RF_INVALID;
    const size_t n = A->extent[0], m = D->extent[1], p = D->extent[0];
    if (A->extent[1] != n || B->extent[0] != n || B->extent[1] != m || C->extent[0] != p || C->extent[1] != n
        || n > MOST || m > MOST || p > MOST)
        return rf_say(why, RF_INVALID,
                      "A, B, C and D must fit each other, got %zu states, %zu inputs, %zu outputs", n, m, p);
    self->n = n, self->m = m, self->p = p;
    self->A = A->numbers, self->B = B->numbers, self->C = C->numbers, self->D = D->numbers;
    *sizes = (rf_sizes){0, m, p, n, 0};
    const size_t size = n + m;
    self->transition = malloc((size * size + n + rf_exponential_work(size) + 1) * sizeof(double));
    if (!self->transition)
        return rf_say(why, RF_MEMORY, "no memory for a state space of %zu states", n);
    self->next = self->transition + size * size;
    self->work = self->next + n;
    return RF_OK;
}

static int require_finite(size_t count, const double *values, const char *what, double t, rf_message *why)
{
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(values[i]))
            return rf_say(why, RF_NOT_FINITE, "%s %zu of the state space is not finite at t = %.9g s", what,
                          i, t);
    return RF_OK;
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    memset(y, 0, self->p * sizeof *y);
    rf_add_product(self->p, self->n, 1.0, self->C, at->x, y);
    rf_add_product(self->p, self->m, 1.0, self->D, at->u, y);
    return require_finite(self->p, y, "output", at->t, why);
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    const model *self = kernel;
    memset(dx, 0, self->n * sizeof *dx);
    rf_add_product(self->n, self->n, 1.0, self->A, at->x, dx);
    rf_add_product(self->n, self->m, 1.0, self->B, at->u, dx);
    return require_finite(self->n, dx, "derivative", at->t, why);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    (void)at;
    (void)why;
    memcpy(answer->A, self->A, self->n * self->n * sizeof(double));
    memcpy(answer->B, self->B, self->n * self->m * sizeof(double));
    memcpy(answer->C, self->C, self->p * self->n * sizeof(double));
    memcpy(answer->D, self->D, self->p * self->m * sizeof(double));
    return RF_OK;
}

/* exp([A B; 0 0] dt) holds the transition of x under held u in its first rows. */
static int prepare(model *self, double dt, rf_message *why)
{
    const size_t n = self->n, m = self->m, size = n + m;
    if (dt == self->dt)
        return RF_OK;
    self->dt = 0.0;
    memset(self->transition, 0, size * size * sizeof(double));
    for (size_t i = 0; i < n; ++i) {
        for (size_t j = 0; j < n; ++j)
            self->transition[i * size + j] = self->A[i * n + j] * dt;
        for (size_t j = 0; j < m; ++j)
            self->transition[i * size + n + j] = self->B[i * m + j] * dt;
    }
    if (rf_exponential(size, self->transition, self->work))
        return rf_say(why, RF_STUCK, "the state space grows beyond all numbers in a step of %.9g s", dt);
    self->dt = dt;
    return RF_OK;
}

static int step(void *kernel, const rf_point *at, double dt, double *x, rf_message *why)
{
    model *self = kernel;
    const size_t n = self->n, m = self->m, size = n + m;
    if (prepare(self, dt, why) != RF_OK)
        return RF_STUCK;
    memset(self->next, 0, n * sizeof(double));
    for (size_t i = 0; i < n; ++i) {
        rf_add_product(1, n, 1.0, self->transition + i * size, at->x, self->next + i);
        rf_add_product(1, m, 1.0, self->transition + i * size + n, at->u, self->next + i);
    }
    if (require_finite(n, self->next, "state", at->t + dt, why) != RF_OK)
        return RF_NOT_FINITE;
    memcpy(x, self->next, n * sizeof(double));
    return RF_OK;
}

const rf_kernel_type rf_linear_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .release = release,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .step = step,
};
