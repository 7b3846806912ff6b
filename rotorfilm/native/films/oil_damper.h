/* A squeeze-film damper between seals whose oil has inertia: F = force - mass acceleration (bearings/damper/built).

   The viscous film is a map, with the constant damping of the seals of a short film beside it, or a table of
   a full film of finite length between any seals. The inertia is a sum of what the film has of

       the zone that a ruptured film fills:  M = (1/10) of u u/h,  q = -(17/70) of u (w.u)^2/h^2, over w.u > 0,
       a short full film in closed form, and a full film of finite length by the table,

   in units density radius length^3/clearance of the mass, with h = 1 - e.u, e and w position and velocity per
   clearance. The table has Chebyshev coefficients over s = sqrt(1 - e^2) of m, n, a, b, c and the damping c, d,
   times powers of s: M = m I + n e e, q = a w^2 e + b (e.w) w + c (e.w)^2 e, damping c w + d (e.w) e. */
#ifndef ROTORFILM_OIL_DAMPER_H
#define ROTORFILM_OIL_DAMPER_H

#include <stdint.h>

#include "journal_kernel.h"

#define RF_RADIAL 7 /* functions of a table */

typedef struct rf_oil_damper {
    rf_journal journal;         /* of the map; first */
    int32_t mapped;             /* whether the viscous film is the map, not the table */
    int32_t terms;              /* of the table, terms x RF_RADIAL; 0 for none */
    const double *table;
    double least;               /* smallest s of the table; 1 without */
    double viscous, inertial;   /* viscosity radius length^3/clearance^2 [N s], density radius length^3 [kg m] */
    double seal;                /* damping of the seals of a short film, in units of the viscous film */
    double zone, closed, tabled; /* shares of the inertia */
    const double *nodes, *weights; /* of Gauss and Legendre over the zone */
    int32_t count;              /* of them */
    int32_t unused;
} rf_oil_damper;

/* The force without that of the acceleration: an rf_response, whose last component, the speed, does not matter. */
RF_EXPORT_LOOP int rf_oil_damper_at(const void *damper, const double *state, double *f, double *jacobian);

/* The added mass xx, xy, yy and, unless NULL, slopes[3][4] by x, y, vx, vy. */
RF_EXPORT_LOOP int rf_oil_damper_mass(const void *damper, const double *state, double *mass, double *slopes);

#endif
