/* The coefficients of a ring of cells at one place of the journal.

   Integrated over the cells of line i the equation needs one number for every line or face: `around` =
   H^3/distance at the face after it, `along` = (L/D)^-2 H^3 width, and `normal`, the integral of n, exactly. */
#ifndef ROTORFILM_CELLS_H
#define ROTORFILM_CELLS_H

#include "ring.h"

typedef struct rf_cells {
    double *theta, *face;                 /* N: angles of lines and of the faces after them [rad] */
    double *around, *along;               /* N */
    double *around_slope[2], *along_slope[2]; /* N: derivatives in e, the lines held */
    double *normal[2];                    /* N */
} rf_cells;

#define RF_CELL_ROWS 10

/* Take the rows of n from `memory` of RF_CELL_ROWS x n. */
void rf_place_cells(rf_cells *cells, double *memory, size_t n);

void rf_set_cells(const rf_ring *ring, const rf_grid *grid, const double *e, rf_cells *cells);

/* w times the integral of n over the cells, N x M. */
void rf_set_source(const rf_grid *grid, const rf_cells *cells, const double *w, double *source);

/* -12 times the integral of P n. */
void rf_set_film_force(const rf_grid *grid, const rf_cells *cells, const double *pressure, double *f);

/* A P, the flow out of each cell, for the coefficients `around` and `along`. */
void rf_set_flow(const rf_grid *grid, const double *around, const double *along, const double *pressure,
                 double *flow);

#endif
