/* The short squeeze film on a porous layer: full, ruptured, or fed and clipped where its pressure is negative.

   Oil flows along the axis only. The film is a sum of groups of axial modes (bearings/damper/squeeze_films.py),

       G(h) = sum weight/(h^3 + leak),    S(h) = sum feed/(h^3 + leak),

   h = 1 - e.u, u the direction from the bearing center to the film. The source is the rate w = velocity/clearance:

       full       F = -across w - excess (e.w) e - lift e, three integrals over the circle in closed form
       ruptured   F = -int (w.u) u G over w.u > 0, by Gauss's rule over that half circle
       fed        F = -(3/2) int int max(p, 0) u, p = ends(Z) + sum shape(Z) (w.u + feed/weight)/(h^3 + leak)

   Forces are in units of viscosity * radius * length^3 / clearance^2. */
#ifndef ROTORFILM_SQUEEZE_FILM_H
#define ROTORFILM_SQUEEZE_FILM_H

#include <stdint.h>

#include "film.h"
#include "../kernels/kernel.h"

#define RF_MOST_GROUPS 64
#define RF_AXIAL_NODES 16

typedef struct rf_squeeze {
    const double *weight, *leak, *feed; /* of each group; the feed [1/s] */
    const double *nodes, *weights;      /* of Gauss on [-1, 1], over the half circle or over a cell; NULL for a full film */
    const double *axial;                /* of a fed film that may rupture: nodes Z, weights, and the shape of each group there */
    int32_t groups, count;
    double depth;                       /* by which the film counts as thicker where nodes are spread */
    double ends[2];                     /* pressure at Z = -1 and Z = 1 times clearance^2/(3 viscosity length^2) [1/s] */
} rf_squeeze;

/* The film of an rf_squeeze, an rf_film. A ruptured film without rate has no derivative. */
RF_EXPORT_LOOP int rf_squeeze_film(const void *film, const double *e, const double *w, double *f, double *jacobian);

/* Take the tables `groups` (3, groups): weights, leaks and feeds; `arc` (2, count), the nodes and weights of Gauss, unless the
   film is full; and `axial` (2 + groups, RF_AXIAL_NODES), of a fed film that may rupture. RF_INVALID, with the message, where
   they do not fit. */
RF_EXPORT_LOOP int rf_take_squeeze(rf_squeeze *film, const rf_tables *tables, rf_message *why);

/* Nodes over an arc, angles from the minimum film, by the Sommerfeld angle xi of a film thicker by a depth. */
typedef struct rf_arc {
    double eps, b;
} rf_arc;

/* A place on it: cosine and sine of its angle psi, film thickness, d psi/d xi. */
typedef struct rf_place {
    double cos, sin, h, stretch;
} rf_place;

rf_arc rf_set_arc(double eps, double depth);
double rf_spread(const rf_arc *arc, double psi);
rf_place rf_place_at(const rf_arc *arc, double xi);

#endif
