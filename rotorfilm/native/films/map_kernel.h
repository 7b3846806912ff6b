/* The impedance map of one bearing: film force and exact derivatives from one scalar table.

   The film minimizes a quadratic functional, so its force is the gradient F = dJ/dw of the minimum

       J(e, w) = -|w|^2 exp(L0 + chi M(X, T)),   X = chi/(1 - chi^2)^(1/4),   T = (1 + cos)/2,

   with the eccentricity e = position/clearance, chi = |e|, the source w = velocity/clearance
   - (speed/2) z^ x e [1/s], and cos the cosine of the angle from w to e. Forces are in units of
   viscosity * length * radius^3 / clearance^2. M is a tensor product of uniform quintic B-splines on
   [0, X_end] x [0, 1]; that M(-X, T) = -M(X, 1 - T) makes J smooth through the center. */
#ifndef ROTORFILM_MAP_KERNEL_H
#define ROTORFILM_MAP_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#include "film.h"

typedef struct rf_map {
    int32_t cells_x;            /* cells of [0, X_end] */
    int32_t cells_t;            /* cells of [0, 1] */
    double x_end;               /* X of the last node */
    double center;              /* L0 = ln(-J/|w|^2) at e = 0 */
    const double *coefficients; /* (cells_x + 5) x (cells_t + 5), T fastest */
    double slenderness;         /* length/diameter for the film at the wall; 0 where that is not its law */
    double share;               /* of the film at the wall: 1 in units of a journal */
} rf_map;

/* The film of an rf_map. Beyond the last node J goes on as the film at the wall (wall.h), or, where that is not
   its law, as a power of X: RF_OUTSIDE. Without source there is a derivative at the center only. */
RF_EXPORT int rf_map_film(const void *map, const double *e, const double *w, double *f, double *jacobian);

/* Let a map go on as the film at the wall where its last node says that it is one, in motion to the wall and away from
   it; else as a power of X. */
RF_EXPORT void rf_map_to_wall(rf_map *map, double slenderness, double share);

/* Largest error of a force beyond the last node that was measured [%]; 0 where none was measured. */
RF_EXPORT int rf_map_error(const rf_map *map);

#endif
