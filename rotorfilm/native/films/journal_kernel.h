/* A journal bearing in SI units over any film: kinematics, scaling, and what cannot be. */
#ifndef ROTORFILM_JOURNAL_KERNEL_H
#define ROTORFILM_JOURNAL_KERNEL_H

#include "film.h"

/* A film force [N] on the journal at state[5] = position x, y [m], velocity vx, vy [m/s] and speed
   [rad/s] about +z. */
typedef struct rf_journal {
    rf_film film;
    const void *data;   /* of the film */
    double clearance;   /* m */
    double force_scale; /* viscosity * length * radius^3 / clearance^2 [N s] */
    double error;       /* of the force where the film answers RF_OUTSIDE [%]; 0 where none is known */
    int openings;       /* whether that holds only where no opening is near */
} rf_journal;

/* The force and, unless `jacobian` is NULL, jacobian[2][5] = d f/d(x, y, vx, vy, speed) [N/m, N s/m,
   N s/rad]. */
RF_EXPORT int rf_journal_at(const rf_journal *journal, const double *state, double *f, double *jacobian);

/* Scalar call for hosts that hold numbers, not arrays. */
RF_EXPORT int rf_journal_call(const rf_journal *journal, double x, double y, double vx, double vy,
                              double speed, double *f);

/* A batch of n states, as in film.h, with 2 x 5 rows of jacobian or NULL; `speed` advances by speed_step: 1,
   or 0 for one speed. */
RF_EXPORT int rf_journal_batch(const rf_journal *journal, size_t n, const double *position,
                               size_t position_stride, const double *velocity, size_t velocity_stride,
                               const double *speed, size_t speed_step, double *f, size_t f_stride,
                               double *jacobian, size_t jacobian_stride, size_t *first);

#endif
