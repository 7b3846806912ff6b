/* Centrifugal force and gyroscopic moment of a ball that rolls on both races and spins on one of them only. */
#ifndef ROTORFILM_BALL_INERTIA_H
#define ROTORFILM_BALL_INERTIA_H

#include "ball.h"

/* Numbers with their derivatives by the inner and the outer contact angle. */
typedef struct rf_ball_inertia {
    double orbit;     /* angular speed about the shaft over that of the inner ring */
    double force[3];  /* centrifugal [N] */
    double moment[3]; /* gyroscopic, over the diameter [N] */
} rf_ball_inertia;

/* At the contact directions ei, eo = (sin, cos) of the angles. The moment is -J orbit w_r, with J the polar inertia of the
   ball and w_r its spin about the radial direction. */
void rf_ball_inertia_at(const rf_ball_row *row, int inertia, const double *ei, const double *eo, double speed,
                        rf_ball_inertia *answer);

#endif
