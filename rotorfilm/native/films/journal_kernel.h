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
   N s/rad]: an rf_response of an rf_journal. */
RF_EXPORT int rf_journal_at(const void *journal, const double *state, double *f, double *jacobian);

#endif
