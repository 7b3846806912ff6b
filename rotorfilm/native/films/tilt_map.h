/* The second-order map of a tilted journal: what a tilt adds to the film of a plain bore.

   With e = (x, y)/c, tau the shift of the end z = length/2 beside the middle, per clearance, and the sources w and w1
   of both pairs (grids/ring.h), the potential of the film is to second order in (tau, w1)

       J = J0(e, w) + (a tau, w1).S (a tau, w1)/2,   a = |w|,   F = dJ/dw,   T = dJ/dw1.

   S is symmetric, 4 x 4, and in the frame n = w/a, m = z^ x n it depends on chi = |e| and on the angle between e and
   w alone. With c and s the cosine and sine of the angle from w to e, X as in map_kernel.h, and L about ln(-J0/a^2),

       S_ij = exp(L) (1 - chi^2)^-p y_ij,   p = how many of i, j belong to tau;
       y = y0 + chi M(X, c)  of what a mirror at n leaves, as of L;   y = chi s M(X, c)  of what it turns around. */
#ifndef ROTORFILM_TILT_MAP_H
#define ROTORFILM_TILT_MAP_H

#include "map_kernel.h"

#define RF_TILT_ROWS 12    /* numbers at a node: L, ten of S, and one that fills up */
#define RF_TILT_COLUMNS 10 /* of the derivatives */
#define RF_TILT_SHARE 0.6  /* of the aligned least film, the most that a tilt may take where the map is meant */
#define RF_TILT_DRIVE 1.5  /* the most that |w1| may be, over |w|, likewise */

typedef struct rf_tilt_map {
    rf_axis x, s;               /* X and c */
    const double *coefficients; /* of M, (X cells + 5) x (c cells + 5) x RF_TILT_ROWS */
    const double *center;       /* RF_TILT_ROWS: L and y0 */
} rf_tilt_map;

/* What the tilt adds to F, and T, f[4], at q[4] = (e, tau) and drive[4] = (w, w1), in the units of film.h; unless NULL
   by[4][8] = d f/d(q, drive). RF_OUTSIDE beyond the last node, RF_TILT_SHARE or RF_TILT_DRIVE, RF_AT_WALL where an end
   touches, RF_NOT_FINITE; without w RF_UNDEFINED for derivatives and, without w1 either, zeros.

   J2 is no expansion where w1 is large beside w: F would grow as w1^2/|w|. With y = RF_TILT_DRIVE |w|/|w1| < 1, F is
   that of (2 y - y^2) w1: it goes on smoothly, and to 0 with w. T is linear in w1 and stays; without w, n is along w1. */
RF_EXPORT_LOOP int rf_tilt_wrench(const rf_tilt_map *map, const double *q, const double *drive, double *f, double *by);

#endif
