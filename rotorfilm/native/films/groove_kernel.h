/* The impedance map of one bearing with axial openings at ambient pressure.

   The film minimizes a quadratic functional, so its force is the gradient F = dJ/dw of the minimum

       J(e, w) = -|w|^2 exp(L0(phi) + chi M(X, theta, s)),   X = chi/(1 - chi^2)^(1/4),

   with the eccentricity e = position/clearance, chi = |e|, at the angle theta, and the source w =
   velocity/clearance - (speed/2) z^ x e [1/s] at the angle phi, both from the axis of the openings, and
   tan s = squeeze tan(phi - theta), which crowds the nodes where the source is across the eccentricity.
   Forces are in units of viscosity * length * radius^3 / clearance^2. L0 and M are quintic B-splines on
   uniform nodes, periodic in the angles; that M(-X, theta + pi, s - pi) = -M(X, theta, s) makes J smooth
   through the center. */
#ifndef ROTORFILM_GROOVE_KERNEL_H
#define ROTORFILM_GROOVE_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#include "film.h"

typedef struct rf_groove_map {
    int32_t cells_x;            /* cells of [0, X_end] */
    int32_t cells_e;            /* cells of a turn in theta */
    int32_t cells_s;            /* cells of a turn in s */
    int32_t cells_w;            /* cells of a turn in phi, for L0 */
    double x_end;               /* X of the last node */
    double squeeze;             /* in (0, 1] */
    double axis;                /* angle of the axis of the openings in the bearing frame [rad] */
    const double *center;       /* cells_w + 5 of L0; the last five repeat the first */
    const double *coefficients; /* (cells_x + 5) x (cells_e + 5) x (cells_s + 5) of M, s fastest; of the
                                   angles the last five repeat the first */
    double slenderness;         /* length/diameter, for the film at the wall */
} rf_groove_map;

/* The film of an rf_groove_map. Beyond the last node J goes on as the film at the wall (wall.h), as far
   as the openings leave it: RF_OUTSIDE. Without
   source there is no derivative, not at the center either. */
RF_EXPORT int rf_groove_film(const void *map, const double *e, const double *w, double *f, double *jacobian);

/* As rf_map_error, where no opening is near. */
RF_EXPORT int rf_groove_error(const rf_groove_map *map);

#endif
