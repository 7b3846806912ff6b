/* The masses that the oil of bearings adds: forces that solve the accelerations of rotor and oil at once. */
#include <math.h>
#include <string.h>

#include "../solvers/dense.h"
#include "mounted.h"

/* Row i of M[2][2] of a bearing, times a[2]. */
static double times_mass(const double *mass, size_t i, const double *a)
{
    return mass[i] * a[0] + mass[i + 1] * a[1];
}

/* What the velocity of journal k along i makes of x: its row of the motion. */
static const double *row_of(const rf_mounted *self, size_t k, size_t i)
{
    return self->motion + (4 * k + 2 + i) * 2 * self->n;
}

void rf_mounted_accelerate(const rf_mounted *self, const double *dx)
{
    for (size_t k = 0; k < self->bearings; ++k)
        for (size_t i = 0; i < 2; ++i) {
            const double *row = row_of(self, k, i);
            double total = 0.0;
            for (size_t j = 0; j < 2 * self->n; ++j)
                total += row[j] * dx[j];
            self->acceleration[2 * k + i] = total;
        }
}

void rf_mounted_add_inertia(const rf_mounted *self, double sign, double *forces)
{
    for (size_t k = 0; k < self->bearings; ++k)
        for (size_t i = 0; i < 2; ++i)
            forces[2 * k + i] += sign * times_mass(self->mass + 3 * k, i, self->acceleration + 2 * k);
}

int rf_mounted_load(const rf_mounted *self, const double *dx)
{
    const size_t n = self->n, f = 2 * self->bearings;
    double *const joint = self->joint;
    if (self->masses == 0)
        return RF_OK;
    rf_mounted_accelerate(self, dx);
    rf_mounted_add_inertia(self, -1.0, self->force);
    memset(joint, 0, f * f * sizeof *joint);
    for (size_t j = 0; j < f; ++j) {
        for (size_t k = 0; k < self->bearings; ++k) {
            double pushed[2] = {0.0, 0.0};
            for (size_t i = 0; i < 2; ++i)
                for (size_t q = 0; q < n; ++q)
                    pushed[i] += row_of(self, k, i)[n + q] * self->carry[q * f + j];
            for (size_t i = 0; i < 2; ++i)
                joint[(2 * k + i) * f + j] = times_mass(self->mass + 3 * k, i, pushed);
        }
        joint[j * f + j] += 1.0;
    }
    rf_eliminate(f, joint, 1, self->force);
    for (size_t k = 0; k < f; ++k)
        if (!isfinite(self->force[k]))
            return RF_NOT_FINITE;
    return RF_OK;
}

void rf_mounted_slope_masses(const rf_mounted *self, const double *dx, double shift)
{
    if (self->masses == 0)
        return;
    rf_mounted_accelerate(self, dx);
    for (size_t k = 0; k < self->bearings; ++k)
        for (size_t i = 0; i < 2; ++i)
            for (size_t c = 0; c < 4; ++c) {
                const double *by = self->mass_by + 12 * k + c, *a = self->acceleration + 2 * k;
                double *slope = self->by_motion + 10 * k + 5 * i + c;
                *slope -= by[4 * i] * a[0] + by[4 * (i + 1)] * a[1];
                if (c >= 2)
                    *slope -= shift * self->mass[3 * k + i + c - 2];
            }
}
