/* The impedance maps of films: force and exact derivatives from one scalar table.

   A film minimizes a quadratic functional, so its force is the gradient F = dJ/dw of the minimum

       J(e, w) = -|w|^2 exp(L)

   over the eccentricity e = position/clearance, chi = |e|, and the source w = velocity/clearance - (speed/2) z^ x e
   [1/s]. Forces are in units of viscosity * length * radius^3 / clearance^2. L is a spline M of map_spline.h in
   coordinates that follow the film, and a part in closed form:

       plain      L = L0 + chi M(X, cos)                X = chi/(1 - chi^2)^(1/4), cos the cosine of the angle from w to e;
       sped       L = L0(y) + chi M(X, y, cos)          y = ln(1 + Re/scale), Re the Reynolds number, which grows with the speed;
       grooved    L = L0(phi) + chi M(X, theta, s)      e at the angle theta and w at phi, both from the axis of the openings,
                                                        tan s = squeeze tan(phi - theta), which crowds the nodes where the
                                                        source is across the eccentricity;
       pad        L = 5 ln s + M(u, Y, phi)             in the frame of the pad, s = cos phi + sin b.

   Of turbulent oil pads and bearings with openings add to M, and to L0, what the Reynolds number changes: splines over
   the same coordinates and y, on nodes of their own (rf_map_growth).

   That M(-X, -cos) = -M(X, cos), and M(-X, theta + pi, s - pi) = -M(X, theta, s), makes J smooth through the center.
   L0 and the angles of a grooved map are periodic. Beyond the last X the film is that at the wall (wall.h).

   Of a pad that covers 2 b, whose film knows e = (r - r_p)/c_p = (xi, eta) from its center of curvature r_p and its
   clearance c_p,

       xi = 1 - exp(-u),   eta = tanh(Y) E(xi),   E = sqrt(1 - xi^2) for xi > cos b, else (1 - xi cos b)/sin b:

   the film is open where |eta| < E, beyond the unit circle too, and a source with |phi| >= pi/2 + b drives none. The
   nodes in phi are the middles of equal parts. Beyond the last nodes M goes on linearly in u and in Y. */
#ifndef ROTORFILM_MAP_KERNEL_H
#define ROTORFILM_MAP_KERNEL_H

#include <stdint.h>

#include "film.h"

/* Uniform nodes. */
typedef struct rf_axis {
    int32_t cells;
    double first, last; /* nodes */
} rf_axis;

/* What the Reynolds number adds to a map; none without coefficients. */
typedef struct rf_map_growth {
    rf_axis x, y, s, r;                 /* of its nodes; r of ln(1 + Re/scale) */
    const double *coefficients, *center; /* of M over x, y, r and s; of L0 over r and phi */
    double scale, per_rate, density;    /* of the axis, Re over the rate [s], and density of the oil [kg/m3] */
} rf_map_growth;

typedef struct rf_map {
    rf_axis x, y, s;            /* X, theta and s; of a plain film X and cos alone, with y where it is sped; of a pad u, Y and
                                   phi */
    const double *coefficients; /* of M, with 5 more than cells in each axis, s fastest; of turns the last five repeat */
    const double *center;       /* of L0: a number, or with openings over phi as the angles */
    int32_t cells_w;            /* cells of a turn in phi, for L0 with openings */
    int32_t eased;              /* whether the oil has a mobility, so that beyond the last node the error is unknown */
    double squeeze, axis;       /* in (0, 1]; angle of the axis of the openings in the bearing frame [rad] */
    double sine, cosine;        /* of b, of a pad */
    double slenderness, share;  /* length/diameter of the film at the wall, 0 where it is not that; its share, 1 in units of
                                   a journal */
    double scale, per_rate;     /* of y, and Re over the rate [s] */
    rf_map_growth growth;
} rf_map;

/* The film of a plain map. Beyond the last node, where that is no film at the wall, J goes on as a power of X:
   RF_OUTSIDE. Without source there is a derivative at the center only. */
RF_EXPORT int rf_map_film(const void *map, const double *e, const double *w, double *f, double *jacobian);

/* That of a plain map which changes with the rate, and its derivative by that. Beyond the last X J goes on as a power of
   it, beyond the last y it stays: RF_OUTSIDE. */
RF_EXPORT int rf_sped_film(const void *map, const double *e, const double *w, double *f, double *jacobian);

/* That of a map with openings. Beyond the last node it is the film at the wall as far as the openings leave it:
   RF_OUTSIDE. Without source there is no derivative, not at the center either. */
RF_EXPORT int rf_groove_film(const void *map, const double *e, const double *w, double *f, double *jacobian);

/* That of a pad. Beyond the last nodes: RF_OUTSIDE; where the journal touches the pad: RF_AT_WALL. Without source there
   is no derivative; where the source drives no film force and derivatives are zero. */
RF_EXPORT_LOOP int rf_pad_film(const void *map, const double *e, const double *w, double *f, double *jacobian);

/* Let a plain map go on as the film at the wall that it names only where its last node says that it is one, in motion to
   the wall and away from it; else as a power of X. */
RF_EXPORT void rf_map_to_wall(rf_map *map);

/* Largest error of a force beyond the last node that was measured [%], where no opening is near; 0 where none was. */
RF_EXPORT int rf_map_error(const rf_map *map);

#endif
