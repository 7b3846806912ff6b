/* Bearings of fixed pads with recesses: Reynolds' equation in two dimensions on the arc of each pad.

   Every pad is a ring of ring.h about its own center of curvature, and all have the clearance c_p: with d the
   position of the journal from that center e = d/c_p, and D is the depth of the recess over c_p. P = 0 at the ends
   of the pad and of the bearing. Cells are rectangles of one depth, the edges of the recess are on nodes, and on
   either side of a node conductance and Couette flux are those of the half cell there: what drives oil at a step is
   the difference of both (Rayleigh 1918). Lines rest while the journal moves, so the derivatives are those of the
   discrete film. */
#ifndef ROTORFILM_RECESS_H
#define ROTORFILM_RECESS_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "../status.h"
#include "mobility.h"

typedef struct rf_recess_pad {
    double start, extent;   /* of the arc [rad] */
    double preload, anchor; /* the center of curvature lies preload c_p away from the angle anchor */
    double from, to;        /* angles of the recess [rad] */
    double depth, share;    /* of the recess [m], and of the length that it takes, about the middle */
    int32_t around[3];      /* cells before, along and behind the recess */
    int32_t along[2];       /* over half the length, beside the middle: within its share and beyond it */
} rf_recess_pad;

typedef struct rf_recess {
    const rf_recess_pad *pads;
    size_t count;
    double radius, length, clearance, viscosity; /* of the bearing; the clearance of a pad */
    rf_mobility mobility;
    int32_t extrapolated; /* whether the force is f + (f - f2)/3 of the grid and one with half its cells */
} rf_recess;

/* The force [N] on the journal at state[5] = position x, y [m], velocity vx, vy [m/s] and speed [rad/s] about +z
   and, unless NULL, jacobian[2][5] = d f/d(x, y, vx, vy, speed). RF_AT_WALL where a pad is touched, RF_STUCK,
   RF_MEMORY; RF_UNDEFINED for the derivative where nothing drives the film of some pad. */
RF_EXPORT_LOOP int rf_recess_at(const rf_recess *bearing, const double *state, double *f, double *jacobian);

/* The same of n states, rows of n one stride apart, as rf_journal_batch. */
RF_EXPORT_LOOP int rf_recess_batch(const rf_recess *bearing, size_t n, const double *state, double *f,
                                   double *jacobian, size_t *first);

/* The pressure [Pa] of one pad on its lines from the first edge, without the last, and its nodes from the middle.
   RF_AT_WALL, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_recess_field(const rf_recess *bearing, size_t pad, const double *state, double *pressure);

#define RF_RECESS_LOSSES 7

/* Of each pad at state[5] a row of losses (count x RF_RECESS_LOSSES): the force of its film x, y in units of viscosity
   R^3 L/c_p^2; what pressure on the steps adds to the torque, over half of the same and c_p, per rate; Sigma, the
   integral of 1/H over film and streamers, and that of a gap full of oil; what enters at the edge that the oil meets
   first, and what comes to the other, in units of c_p R L. Sigma and the flows are those of a journal that rests there:
   the oil runs along at half the speed. RF_AT_WALL, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_recess_losses(const rf_recess *bearing, const double *state, double *losses);

/* The least film [m] over all pads at a position [m], and the pad that has it. */
RF_EXPORT_LOOP double rf_recess_least(const rf_recess *bearing, const double *position, size_t *pad);

#endif
