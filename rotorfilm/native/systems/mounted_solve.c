#include "mounted.h"

#include <math.h>
#include <string.h>

#include "../solvers/dense.h"

/* Solve (shift I - A) b' = b of the rotor without bearings: q' = shift q - b1 leaves n equations for q. */
static void solve_free(const rf_mounted *self, double *b)
{
    const size_t n = self->n;
    double *const right = self->right, *q = right + n;
    memcpy(right, b + n, n * sizeof *b);
    for (size_t i = 0; i < n; ++i)
        right[i] += self->shift * b[i];
    rf_add_product(n, n, -1.0, self->rates, b, right);
    memset(q, 0, n * sizeof *q);
    rf_add_product(n, n, 1.0, self->inverse, right, q);
    for (size_t i = 0; i < n; ++i) {
        b[n + i] = self->shift * q[i] - b[i];
        b[i] = q[i];
    }
}

void rf_mounted_invert(rf_mounted *self, double shift, double speed)
{
    const size_t n = self->n, columns = 2 * self->bearings;
    double *const q = self->spare;
    memset(self->inverse, 0, n * n * sizeof *self->inverse);
    for (size_t i = 0; i < n; ++i) {
        const double *steady = self->steady + 2 * n * i, *spin = self->spin + 2 * n * i;
        for (size_t j = 0; j < n; ++j) {
            self->rates[i * n + j] = steady[n + j] + speed * spin[n + j];
            q[i * n + j] = -steady[j] - speed * spin[j] - shift * self->rates[i * n + j];
        }
        q[i * n + i] += shift * shift;
        self->inverse[i * n + i] = 1.0;
    }
    rf_eliminate(n, q, n, self->inverse);
    self->shift = shift;
    self->speed = speed;
    for (size_t k = 0; k < columns; ++k) {
        double *const column = self->response + 2 * n * k;
        memset(column, 0, n * sizeof *column);
        for (size_t i = 0; i < n; ++i)
            column[n + i] = self->carry[i * columns + k];
        solve_free(self, column);
    }
}

/* forces[2b] by the motion[4b] of the journals, linearized. */
static void add_linear_forces(const rf_mounted *self, const double *motion, double *forces)
{
    for (size_t k = 0; k < self->bearings; ++k)
        for (size_t i = 0; i < 2; ++i)
            for (size_t c = 0; c < 4; ++c)
                forces[2 * k + i] += self->by_motion[10 * k + 5 * i + c] * motion[4 * k + c];
}

int rf_mounted_close_loop(const rf_mounted *self, rf_message *why)
{
    const size_t f = 2 * self->bearings;
    double *const inverse = self->reaction, *const open = inverse + f * f;
    memset(inverse, 0, f * f * sizeof *inverse);
    for (size_t j = 0; j < f; ++j) {
        double *const forces = self->force; /* spent: the next derivative writes it anew */
        memset(self->moved, 0, 2 * f * sizeof *self->moved);
        memset(forces, 0, f * sizeof *forces);
        rf_add_product(2 * f, 2 * self->n, 1.0, self->motion, self->response + 2 * self->n * j, self->moved);
        add_linear_forces(self, self->moved, forces);
        for (size_t i = 0; i < f; ++i)
            open[i * f + j] = (i == j) - forces[i];
        inverse[j * f + j] = 1.0;
    }
    rf_eliminate(f, open, f, inverse);
    for (size_t i = 0; i < f * f; ++i)
        if (!isfinite(inverse[i]))
            return rf_say(why, RF_NOT_FINITE, "the step has no solution: its matrix is singular");
    return RF_OK;
}

void rf_mounted_solve(void *kernel, double *b)
{
    const rf_mounted *self = kernel;
    const size_t n = self->n, f = 2 * self->bearings;
    double *const forces = self->force, *const linear = self->moved + f; /* f of the 2f numbers of `moved` */
    if (self->masses)
        rf_mounted_accelerate(self, b);
    for (size_t i = 0; self->driven && i < n; ++i)
        b[n + i] += self->turning[i] * b[2 * n] / self->shift;
    solve_free(self, b);
    memset(self->moved, 0, 2 * f * sizeof *self->moved);
    rf_add_product(2 * f, 2 * n, 1.0, self->motion, b, self->moved);
    memset(forces, 0, f * sizeof *forces);
    add_linear_forces(self, self->moved, forces);
    if (self->masses)
        rf_mounted_add_inertia(self, 1.0, forces);
    memset(linear, 0, f * sizeof *linear);
    rf_add_product(f, f, 1.0, self->reaction, forces, linear);
    for (size_t k = 0; k < f; ++k)
        for (size_t i = 0; i < 2 * n; ++i)
            b[i] += linear[k] * self->response[2 * n * k + i];
    if (self->driven)
        b[2 * n] /= self->shift;
}
