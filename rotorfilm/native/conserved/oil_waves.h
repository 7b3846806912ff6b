/* A film and its cavity in small motion: slow, or at one exponent.

   In the cavity oil is only carried along: a change of theta in a cell is (source + flow change of the cell upstream) /
   (own + storage), where the storage is complex. Pressure in the film feels no exponent. */
#ifndef ROTORFILM_OIL_WAVES_H
#define ROTORFILM_OIL_WAVES_H

#include "oil_shape.h"

/* Of a steady film with its oil full where `full` tells (N x M): by how much `forces` integrals of the pressure, with their
   weights (each N x M), fall with the places of the journal, with the speed, with the rates of the places and with
   nothing, in motion slow against the time that oil takes to cross the cavity (forces x 2 (freedoms + 1)). */
RF_EXPORT_LOOP int rf_oil_slow(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells, double rate,
                               const uint8_t *full, const double *pressure, const double *theta, size_t freedoms,
                               size_t forces, const double *weights, double *found);

/* Columns are the changes of theta where the cavity ends ("inlets" of the film), then the places of the journal and then
   their rates, one for each freedom. */
typedef struct rf_oil_cavity {
    size_t cells, inlets, freedoms, forces;
    const int32_t *up, *inlet;     /* which cell is upstream of each, -1 for none, and which are upstream of the inlets */
    const double *own, *flow;      /* what a change of theta carries out of a cell, and into it from the one upstream */
    const double *room;            /* of each cell, the size of its gap times its own */
    const double *turn, *carrying; /* of each cell, twice the angle over which it extends, and twice the speed of its oil */
    const double *source;          /* cells x columns: what leaves each less by the pressure that answers, and by the gap */
    const double *felt;            /* forces x columns: the force of that pressure */
} rf_oil_cavity;

/* Set the cavity of a steady film with its oil full where `full` tells, whose `freedoms` and `forces` are set: with
   `numbers` NULL its sizes, else all of it, in 5 cells + (cells + forces) columns numbers and cells + inlets places; the
   weights of the forces are N x M each. RF_OK, RF_MEMORY, or RF_STUCK where it goes all around the film. */
RF_EXPORT_LOOP int rf_set_oil_cavity(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells,
                                     double rate, const uint8_t *full, const double *pressure, const double *theta,
                                     const double *weights, rf_oil_cavity *cavity, double *numbers, int32_t *places);

/* Set K(s) and dK/ds (forces x freedoms each, complex numbers are pairs). The cavity, whose cells come in the order of the
   flow, stores at the rate s if `blurred`, else so that resolved waves keep their phase. RF_OK, RF_STUCK or RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_motion(const rf_oil_cavity *cavity, const double *s, int blurred, double *found);

#endif
