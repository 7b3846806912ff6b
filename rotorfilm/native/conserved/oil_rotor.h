/* A linear rotor and films that conserve their oil at its journals: steps in time, both in one Newton iteration.

   The rotor has x' = A x + B F + w(t). By differences of second order newest x + last x_n + older x_n-1 = dt x', so that
   x = inverse (dt w - last x_n - older x_n-1) + gain F with the inverse of newest - dt A. */
#ifndef ROTORFILM_OIL_ROTOR_H
#define ROTORFILM_OIL_ROTOR_H

#include "oil_travel.h"

typedef struct rf_oil_rotor {
    size_t states, films;
    const rf_oil_film_si *const *film;
    const double *springs; /* beside each film [N/m] */
    const double *inverse; /* states x states, or NULL: `drive` of a step is then where no film would push the rotor */
    const double *gain;    /* states x 2 films: inverse dt B */
    const double *sense;   /* 5 films x states: the motion of each journal */
    const double *scale;   /* of the states: what a Newton step is measured by */
    double last, older, growth; /* growth: of a step over the one before, by which the last change predicts the next */
} rf_oil_rotor;

/* Make `count` steps of the given lengths, or fewer where one fails, and set how many were made in done[0], Newton steps
   in done[1] and film solutions in done[2]. `time` is that at the end of each step, `drive` (count x states) is dt w,
   `offset` (count x 5 films) what the motion has beside that of the state. `states` begins with x_n-1 and x_n and goes on
   with what is found; `start`, unless NULL, is where the first step looks. `blocks` (see oil_travel.h, film after film)
   goes along; `answers` (count x films x RF_OIL_ANSWERS) are with the force of the springs. RF_AT_WALL, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_march(const rf_oil_rotor *rotor, size_t count, const double *lengths, const double *time,
                                const double *drive, const double *offset, const double *start, double *states,
                                double *blocks, double *answers, int64_t *done, rf_message *why);

#endif
