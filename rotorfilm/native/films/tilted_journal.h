/* A tilted journal from its film without tilt, in SI units: state[9] = x, y [m], tilt_x, tilt_y [rad], their rates and
   the speed [rad/s]; f[4] = force_x, force_y [N], moment_x, moment_y [N m].

   The end z = length/2 lies d = (tilt_y, -tilt_x) arm beside the middle. By the map of tilts F and T are those of
   tilt_map.h. Without it F stays, and T is a share of what a shift of the whole journal would do,

       T = share (F_w w1 + 2 F_e tau),

   which is exact for short films (share 1/15) and, at rest in the middle, for full ones; a share of 0 leaves tilt out. */
#ifndef ROTORFILM_TILTED_JOURNAL_H
#define ROTORFILM_TILTED_JOURNAL_H

#include "film.h"
#include "tilt_map.h"

#define RF_TILTED_STATE 9

typedef struct rf_tilted {
    rf_response aligned; /* force of the journal without tilt, of (x, y, vx, vy, speed) */
    const void *of;
    double clearance, force_scale, arm; /* m, N s of film.h, m */
    double share;
    const rf_tilt_map *map; /* or NULL */
} rf_tilted;

/* Force and moment and, unless NULL, jacobian[4][9]: exact with a map; else moments by differences of the exact
   derivatives of the force. The status is the worse one of both films;
   RF_OUTSIDE too where the tilt alone drives the film of a journal aside, which the aligned film does not feel. */
RF_EXPORT_LOOP int rf_tilted_at(const rf_tilted *journal, const double *state, double *f, double *jacobian);

/* The same of n states, rows of n; jacobian 36 rows or NULL. */
RF_EXPORT_LOOP int rf_tilted_batch(const rf_tilted *journal, size_t n, const double *states, double *f, double *jacobian,
                                   size_t *first);

#endif
