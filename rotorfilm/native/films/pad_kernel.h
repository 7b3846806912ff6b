/* The impedance map of one pad, in its own frame: its middle is at the angle 0.

   With the center of curvature r_p, the clearance c_p and the velocity v_p of the pad its film knows only
   e = (r - r_p)/c_p = (xi, eta) and w = (v - v_p)/c_p - (speed/2) z^ x e [1/s] at the angle phi. It minimizes a quadratic
   functional, so its force is the gradient F = dJ/dw of the minimum

       J(e, w) = -|w|^2 s^5 exp(M(u, Y, phi)),   s = cos phi + sin b  for |phi| < pi/2 + b,  else 0,
       xi = 1 - exp(-u),   eta = tanh(Y) E(xi),   E = sqrt(1 - xi^2) for xi > cos b, else (1 - xi cos b)/sin b,

   where the pad covers 2 b: the film is open where |eta| < E, beyond the unit circle too, and a source with
   |phi| >= pi/2 + b drives none. M is a quintic B-spline: nodes uniform in u, in Y over [-y_end, y_end], and at the
   middles of equal parts of phi. Beyond the last nodes it goes on linearly in u and in Y. Forces are in units of
   viscosity * length * radius^3 / c_p^2. */
#ifndef ROTORFILM_PAD_KERNEL_H
#define ROTORFILM_PAD_KERNEL_H

#include <stdint.h>

#include "film.h"

typedef struct rf_pad_map {
    int32_t cells_u;   /* cells of [u_first, u_last] */
    int32_t cells_y;   /* cells of [-y_end, y_end] */
    int32_t cells_phi; /* cells between the first and the last middle of cells_phi + 1 parts */
    double u_first;
    double u_last;
    double y_end;
    double reach;  /* pi/2 + b [rad] */
    double sine;   /* of b */
    double cosine; /* of b */
    const double *coefficients; /* (cells_u + 5) x (cells_y + 5) x (cells_phi + 5) of M, phi fastest */
} rf_pad_map;

/* Set what depends on the extent [rad] of the pad, below pi. */
RF_EXPORT_LOOP void rf_shape_pad(rf_pad_map *map, double extent);

/* The film of an rf_pad_map. Beyond the last nodes: RF_OUTSIDE; where the journal touches the pad: RF_AT_WALL. Without
   source there is no derivative; where the source drives no film force and derivatives are zero. */
RF_EXPORT_LOOP int rf_pad_film(const void *map, const double *e, const double *w, double *f, double *jacobian);

#endif
