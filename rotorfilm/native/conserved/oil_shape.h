/* A film that conserves its oil as it is made: its cells, its openings and its supply; and its equations in a gap.

   Mobility and recesses are as in grids/ring.h. Where the gap is filled in part, the factors of the mobility are those of
   the full gap, and transport and shear are in proportion to the oil. Pressures count from that of the cavity, over 12 viscosity (radius/clearance)^2 [1/s]; flows and oil over
   clearance radius length. Lines go along half the length, from its middle, or along all of it. */
#ifndef ROTORFILM_OIL_SHAPE_H
#define ROTORFILM_OIL_SHAPE_H

#include "../grids/mobility.h"
#include "oil_cells.h"

typedef struct rf_oil_shape {
    size_t lines, nodes, openings;
    const double *spacing;   /* N: angle from a line to the next one */
    const double *direction; /* 2 x 2 x N: cos and sin of the lines, then of the faces after them */
    const double *width;     /* M: of the cells, as shares of the line */
    const double *along;     /* N x (M + 1): over what a gap conducts, from the first end of a line to its last; 0 if closed */
    const double *around;    /* N x M: ease of flow at the faces after the lines, or NULL: 1 */
    const double *dragged;   /* N x M: there, twice the share of speed and gap that the walls drag along, or NULL: 1 */
    const int32_t *opening;  /* N x M: as in rf_oil_cells */
    const uint8_t *fed;      /* of the openings: as there */
    const double *flow;      /* of the openings: as there */
    const double *pressure;  /* of the openings: in those that are held */
    double first_pressure, last_pressure; /* at the ends of the lines */
    double slenderness;                   /* length/diameter */
    int32_t whole;                        /* whether lines go along all of the length, both their ends being those of the film */
    const double *wall;  /* 3 x N: gap of the centered journal on land, at faces, before lines and behind them, or NULL: 1 */
    const double *depth; /* N x M: of the recess from a line to the next, or NULL: 0 */
    const double *thick; /* N x M and N x (M + 1): viscosity at the faces after and along the lines, or NULL: 1 */
    rf_mobility mobility;
} rf_oil_shape;

/* Freedoms of the journal: its place e and the shift tau of its end against its middle, over the clearance. */
enum { RF_OIL_FREEDOMS = 4 };

/* The gap over the clearance: N x M at the lines and at the faces after them, N x (M + 1) at the faces along them, those
   on land. The cell of a line at the edge of a recess has the mean of both sides. */
typedef struct rf_oil_gap {
    const double *line, *face, *side;
} rf_oil_gap;

static inline size_t rf_gap_numbers(const rf_oil_shape *shape)
{
    return shape->lines * (3 * shape->nodes + 1);
}

static inline size_t rf_equation_numbers(const rf_oil_shape *shape)
{
    return shape->lines * (4 * shape->nodes + 1);
}

/* Set the gap `full` (A + D) - (e + Z tau).n around a journal, A being the wall and D the depth, full 1; with 0 and a unit
   of (e, tau) it is a slope. */
RF_EXPORT_LOOP void rf_circular_gap(const rf_oil_shape *shape, double full, const double *place, double *numbers);

/* The gap in these numbers. */
rf_oil_gap rf_gap_in(const rf_oil_shape *shape, const double *numbers);

/* Set the equations of a gap, or unless NULL their derivative where the gap has a slope, in `numbers`; walls carry the
   oil with a speed of `rate`, theta stores at a rate of `storing`. */
RF_EXPORT_LOOP void rf_set_oil(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_gap *slope, double rate,
                               double storing, rf_oil_cells *cells, double *numbers);

/* The same by the rate. */
RF_EXPORT_LOOP void rf_set_oil_by_rate(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, rf_oil_cells *cells,
                                       double *numbers);

/* The least gap at e over all faces with film and both sides of all lines beside them. */
double rf_least_gap(const rf_oil_shape *shape, const double *e);

/* Size of a cell, or of the half of it in half the film: extent times width. */
double rf_cell_area(const rf_oil_shape *shape, size_t q);

/* Set pressure and theta to their values in openings that are held, 0 and 1 elsewhere. */
void rf_hold_openings(const rf_oil_shape *shape, double *pressure, double *theta);

enum { RF_OIL_FORCE = 0, RF_OIL_OUT = 2, RF_OIL_DRAWN_IN, RF_OIL_INFLOW, RF_OIL_VOLUME, RF_OIL_SUMS };

/* Of a film that solves these equations: force on the journal [1/s], flows out of the ends, into them and from all
   openings [1/s], and the oil in the gap. RF_OK or RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_sums(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells,
                               const double *pressure, const double *theta, double *sums);

/* By how much the flow out of the cells changes with each of the first freedoms (each N x M): `moved` by its place, `held`
   by its rate. RF_OK or RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_slopes(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, double storing,
                                 const double *pressure, const double *theta, size_t freedoms, double *moved, double *held);

#endif
