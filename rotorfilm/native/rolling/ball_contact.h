/* The Hertzian contact of a ball and a race. */
#ifndef ROTORFILM_BALL_CONTACT_H
#define ROTORFILM_BALL_CONTACT_H

#include "ball.h"

/* Direction e = (sin, cos) of the contact angle, t = de/d(angle), and d(load e)/d(center). */
typedef struct rf_ball_contact {
    double e[2], t[2], length, load;
    double slope; /* d(load)/d(approach) [N/m] */
    double by[4];
} rf_ball_contact;

/* A contact whose centers are apart by (axial, radial), and by `touch` where it is not pressed. */
rf_ball_contact rf_ball_press(double axial, double radial, double touch, double stiffness);

/* Where the center x[2] of a ball would be if the static load acted through its inner contact: the outer angle is
   reduced. */
void rf_ball_guess(const rf_ball_row *row, const double *a, double centrifugal, double *x);

#endif
