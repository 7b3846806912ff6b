/* The journal in SI units around any dimensionless film: kinematics, scaling, batches.

   A state is position x, y [m], velocity vx, vy [m/s] and speed [rad/s] about +z. */
#ifndef ROTORFILM_JOURNAL_STATE_H
#define ROTORFILM_JOURNAL_STATE_H

#include <math.h>
#include <stddef.h>

#include "map_kernel.h"

#define RF_ROUNDOFF 1e-14 /* a source below this fraction of its two terms is their cancellation */

/* A film force at state[5], and the same with jacobian[2][5]; `film` is whatever it needs. */
typedef int (*rf_state_force)(const void *film, const double *state, double *f);
typedef int (*rf_state_jacobian)(const void *film, const double *state, double *f, double *jacobian);

/* Whether one is not finite: fmax would hide a not-a-number, and finite factors may overflow. */
static inline int rf_is_broken(const double *values, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += 0.0 * values[i];
    return !(sum == 0.0);
}

static inline int rf_break(double *values, int count)
{
    for (int i = 0; i < count; ++i)
        values[i] = NAN;
    return RF_NOT_FINITE;
}

/* Eccentricity e[2] and source w[2] of a state; RF_NOT_FINITE for anything that is no finite state. */
static inline int rf_kinematics(double clearance, const double *state, double *e, double *w)
{
    const double half = 0.5 * state[4];
    if (rf_is_broken(state, 5))
        return RF_NOT_FINITE;
    e[0] = state[0] / clearance;
    e[1] = state[1] / clearance;
    const double squeeze[2] = {state[2] / clearance, state[3] / clearance};
    const double wedge[2] = {half * e[1], -half * e[0]};
    w[0] = squeeze[0] + wedge[0];
    w[1] = squeeze[1] + wedge[1];
    const double terms = fmax(fabs(squeeze[0]) + fabs(wedge[0]), fabs(squeeze[1]) + fabs(wedge[1]));
    if (fmax(fabs(w[0]), fabs(w[1])) <= RF_ROUNDOFF * terms)
        w[0] = w[1] = 0.0;
    return RF_OK;
}

/* Scale the force; the status of the film, unless the force overflows. */
static inline int rf_dimensional_force(double scale, int status, double *f)
{
    f[0] *= scale;
    f[1] *= scale;
    return status <= RF_UNDEFINED && rf_is_broken(f, 2) ? rf_break(f, 2) : status;
}

/* Scale the force; turn film[2][4] = d f/d(e, w) into jacobian[2][5] = d f/d(x, y, vx, vy, speed). The
   status of the film, unless an answer overflows. */
static inline int rf_dimensional(double clearance, double scale, const double *e, double speed,
                                 const double *film, int status, double *f, double *jacobian)
{
    const double per_c = scale / clearance, half = 0.5 * speed;
    for (int i = 0; i < 2; ++i) {
        const double *by = film + 4 * i;
        double *row = jacobian + 5 * i;
        f[i] *= scale;
        /* w = v/c + (speed/2) (e_y, -e_x) */
        row[0] = per_c * (by[0] - half * by[3]);
        row[1] = per_c * (by[1] + half * by[2]);
        row[2] = per_c * by[2];
        row[3] = per_c * by[3];
        row[4] = 0.5 * scale * (by[2] * e[1] - by[3] * e[0]);
    }
    if (status <= RF_OUTSIDE && (rf_is_broken(f, 2) || rf_is_broken(jacobian, 10))) {
        rf_break(f, 2);
        return rf_break(jacobian, 10);
    }
    return status;
}

/* Batches as in journal_kernel.h; the most severe status, and the index of the first state with it. */
static inline int rf_each_force(rf_state_force one, const void *film, size_t n, const double *position,
                                size_t position_stride, const double *velocity, size_t velocity_stride,
                                const double *speed, size_t speed_step, double *f, size_t f_stride,
                                size_t *first)
{
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double state[5] = {position[i], position[position_stride + i], velocity[i],
                                 velocity[velocity_stride + i], speed[speed_step * i]};
        double pair[2];
        const int status = one(film, state, pair);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        f[i] = pair[0];
        f[f_stride + i] = pair[1];
    }
    return worst;
}

static inline int rf_each_jacobian(rf_state_jacobian one, const void *film, size_t n,
                                   const double *position, size_t position_stride,
                                   const double *velocity, size_t velocity_stride, const double *speed,
                                   size_t speed_step, double *f, size_t f_stride, double *jacobian,
                                   size_t jacobian_stride, size_t *first)
{
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double state[5] = {position[i], position[position_stride + i], velocity[i],
                                 velocity[velocity_stride + i], speed[speed_step * i]};
        double pair[2], all[10];
        const int status = one(film, state, pair, all);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        f[i] = pair[0];
        f[f_stride + i] = pair[1];
        for (size_t k = 0; k < 10; ++k)
            jacobian[k * jacobian_stride + i] = all[k];
    }
    return worst;
}

#endif
