/* The film of one sector pad of a thrust bearing: Reynolds' equation in polar coordinates.

   The gap is h = g(r, phi) + z + a Y - b X over the pad, X = r cos phi, Y = r sin phi, with its source linear in
   w = (dz/dt, da/dt + speed b/2, db/dt - speed a/2, speed/2):

       div(h^3/(12 viscosity) grad p) = w0 + w1 Y - w2 X + w3 dg/dphi,    p = 0 at the edges,

   p >= 0 where the film ruptures. Lines have one angle, nodes one radius. A cell between them has its own profile,
   bilinear between its corners, so that steps and the ends of tapers lie on lines and nodes; conductance and flow on
   either side of a line are those of the cell there. What pulls along the motion, w3 dg/dphi, is the difference of
   the Couette flows of g. With the shapes s of w, the answers are G = -s.p, so that their derivatives by w are
   symmetric, and the friction torque has the power of the dissipation to roundoff. */
#ifndef ROTORFILM_SECTOR_H
#define ROTORFILM_SECTOR_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "../status.h"

#define RF_SECTOR_PLACES 3  /* z, a, b */
#define RF_SECTOR_ROWS 4    /* force along z, moments about X and Y, torque about z */
#define RF_SECTOR_COLUMNS 7 /* z, a, b and w0 to w3 */
#define RF_SECTOR_FACTS 9

typedef struct rf_sector {
    size_t lines, nodes;   /* cells of the finest grid around the pad and across it */
    const double *angle;   /* lines + 1 [rad] from X, rising */
    const double *radius;  /* nodes + 1 [m], rising */
    const double *profile; /* lines x nodes x 4 [m]: g at (phi, r), (phi, r+), (phi+, r), (phi+, r+) of each cell */
    double viscosity;      /* [Pa s] */
    int32_t ring;          /* whether the last line is the first */
    int32_t ruptured;      /* whether the film ruptures at ambient pressure; else it is full */
    int32_t levels;        /* grids on which it is searched for, each with half the cells of the one before */
    int32_t extrapolated;  /* whether answers are f + (f - f2)/3 of the two finest */
} rf_sector;

/* Force, moments and torque y[4] on the collar at q = (z, a, b) and w[4] and, unless NULL, by[4][7] = dy/d(q, w).
   RF_UNDEFINED for the derivatives where nothing drives a film that ruptures; RF_AT_WALL, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_sector_film(const rf_sector *pad, const double *q, const double *w, double *y, double *by);

/* On the finest grid: the pressure [Pa] on lines + 1 edges x nodes + 1, and facts[9]: dissipation by shear and by
   pressure [W], flow through the edge of the first line, of the last one, of the inner and the outer radius [m3/s],
   highest pressure [Pa], least gap [m] and the share of its nodes that are film. RF_AT_WALL, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_sector_field(const rf_sector *pad, const double *q, const double *w, double *pressure, double *facts);

/* The least gap [m] at q. */
RF_EXPORT_LOOP double rf_sector_least(const rf_sector *pad, const double *q);

#endif
