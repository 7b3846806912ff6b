/* A film that conserves its oil as it is made: its cells, its openings and its supply; and its equations in a gap.

   Pressures count from that of the cavity, over 12 viscosity (radius/clearance)^2 [1/s]; flows and oil over
   clearance radius length. */
#ifndef ROTORFILM_OIL_SHAPE_H
#define ROTORFILM_OIL_SHAPE_H

#include "oil_cells.h"

typedef struct rf_oil_shape {
    size_t lines, nodes, openings;
    const double *spacing;     /* N: angle from a line to the next one */
    const double *direction;   /* 2 x 2 x N: cos and sin of the lines, then of the faces after them */
    const double *width;       /* M: of the cells along half the length */
    const double *conductance; /* N x M: as in rf_oil_cells */
    const int32_t *opening;    /* N x M: as there */
    const uint8_t *fed;        /* of the openings: as there */
    const double *flow;        /* of the openings: as there */
    const double *pressure;    /* of the openings: in those that are held */
    double center, center_pressure, end_pressure;
    double slenderness; /* length/diameter */
} rf_oil_shape;

/* The gap over the clearance: N at the lines, N at the faces after them, and N cubes of what conducts there. */
typedef struct rf_oil_gap {
    const double *line, *face, *cube;
} rf_oil_gap;

/* Equations, with the arrays that they are in. */
typedef struct rf_oil_equations {
    rf_oil_cells cells;
    double *along, *store, *extent, *center; /* N */
    double *wedge, *around, *old;            /* N x M */
    void *memory;
} rf_oil_equations;

/* Make the equations of a gap; walls carry the oil with a speed of `rate`. RF_OK or RF_MEMORY. */
int rf_open_oil(rf_oil_equations *equations, const rf_oil_shape *shape, const rf_oil_gap *gap, double rate);
void rf_close_oil(rf_oil_equations *equations);

/* Set what a step holds back at a rate; that of the past is for the caller to set in `old`. */
void rf_store_oil(rf_oil_equations *equations, const rf_oil_gap *gap, double rate);

/* Set pressure and theta to their values in openings that are held, 0 and 1 elsewhere. */
void rf_hold_openings(const rf_oil_shape *shape, double *pressure, double *theta);

/* Set the gap, 3 N, around a journal at an eccentricity over the clearance. */
rf_oil_gap rf_circular_gap(const rf_oil_shape *shape, const double *eccentricity, double *numbers);

enum { RF_OIL_FORCE = 0, RF_OIL_OUT = 2, RF_OIL_DRAWN_IN, RF_OIL_INFLOW, RF_OIL_VOLUME, RF_OIL_SUMS };

/* Of a film that solves these equations: force on the journal [1/s], flows out of the ends, into them and from all
   openings [1/s], and the oil in the gap. RF_OK or RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_sums(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells,
                               const double *pressure, const double *theta, double *sums);

#endif
