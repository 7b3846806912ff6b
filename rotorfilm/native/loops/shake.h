/* A rigid rotor on one film in equal steps, under a force over time.

   With v' = (a + a')/2 and q' = q + dt v + dt^2 (a + a')/4, (m + M(q', v')) a' = F(q', v') + pull' is solved for q' by
   Newton's method (trapezoidal rule; order 2). */
#ifndef ROTORFILM_SHAKE_H
#define ROTORFILM_SHAKE_H

#include <stdint.h>

#include "../films/film.h"

typedef struct rf_shaken {
    rf_response film;
    const void *of;
    double mass, speed, clearance, step;
    int64_t calls, done;  /* of the film, and steps so far */
    int left_map;         /* whether the film was asked beyond its map */
    rf_mass_response heavy; /* the mass that the oil adds, of `loaded`; NULL where there is none */
    const void *loaded;
} rf_shaken;

/* Write x, y, vx, vy after each of `count` steps, (count + 1) x 4, the first row given; pulls, (count + 1) x 2,
   are the forces at the ends of the steps, the first of them with that of the film at rest. RF_AT_WALL where
   the journal gets to the wall, RF_STUCK where Newton's method does not end, else the status of the film. */
RF_EXPORT_LOOP int rf_follow_shaken(rf_shaken *rotor, int64_t count, const double *pulls, double *motion);

#endif
