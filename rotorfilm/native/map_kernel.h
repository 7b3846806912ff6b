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

#include "export.h"
#include "status.h"

typedef struct rf_map {
    int32_t cells_x;            /* cells of [0, X_end] */
    int32_t cells_t;            /* cells of [0, 1] */
    double x_end;               /* X of the last node */
    double center;              /* L0 = ln(-J/|w|^2) at e = 0 */
    const double *coefficients; /* (cells_x + 5) x (cells_t + 5), T fastest */
} rf_map;

/* Weights of the six quintic B-splines at `at` cells from the first node, and the first of them. */
size_t rf_spline_weights(double at, int32_t cells, double weights[6]);

/* Force f[2] at e[2], w[2]. Beyond the last node J goes on as a power of X, unverified: RF_OUTSIDE. Without
   source, off the center, the force is zero and has no derivative: RF_UNDEFINED. What fails answers
   not-a-number together with its status. */
RF_EXPORT int rf_map_force(const rf_map *map, const double *e, const double *w, double *f);

/* The same and d f/d(e, w), jacobian[2][4]. */
RF_EXPORT int rf_map_jacobian(const rf_map *map, const double *e, const double *w, double *f,
                              double *jacobian);

/* A batch of n states: the components lead, one contiguous row of n each, the rows of e, w, f and
   jacobian (2 x 4 rows) one stride apart. `first` receives the index of the most severe status. */
RF_EXPORT int rf_map_force_batch(const rf_map *map, size_t n, const double *e, size_t e_stride,
                                 const double *w, size_t w_stride, double *f, size_t f_stride,
                                 size_t *first);
RF_EXPORT int rf_map_jacobian_batch(const rf_map *map, size_t n, const double *e, size_t e_stride,
                                    const double *w, size_t w_stride, double *f, size_t f_stride,
                                    double *jacobian, size_t jacobian_stride, size_t *first);

#endif
