/* The coefficients of a ring of cells at one place of the journal.

   Integrated over a cell the equation needs a conductance for each of its faces, `around` = m H^3 width/distance to
   the next line and `along` = (L/D)^-2 m H^3 width/distance to the next node, the integral of n, exactly, and what
   the walls drag through the face after a line beyond that of the smooth wall. */
#ifndef ROTORFILM_CELLS_H
#define ROTORFILM_CELLS_H

#include "ring.h"

typedef struct rf_cells {
    const rf_ring *ring;
    const rf_grid *grid;
    double *theta, *face;                   /* N: angles of lines and of the faces after them [rad] */
    double *at_line[2], *at_face[2];        /* N: n there */
    double *normal[2];                      /* N: integral of n over the cell */
    double *entry, *entry_slope, *entry_grown; /* N: conductance out of the first node */
    double *around, *along;                 /* N x M */
    double *around_slope, *along_slope;     /* N x M: derivatives by the thickness, the lines held */
    double *dragged, *dragged_slope;        /* N x M: per rate; NULL where walls drag H alone */
    double *around_grown, *along_grown;     /* N x M: derivatives by the logarithm of the growth of a mobility; ... */
    double *dragged_grown;                  /* ... NULL where it has none */
    double *deep;                           /* M: width of the cell within the recess */
    double growth;                          /* X/H of the mobility */
} rf_cells;

/* How many numbers the cells of a grid take, and where they begin. */
size_t rf_cells_size(const rf_ring *ring, const rf_grid *grid);
void rf_open_cells(rf_cells *cells, const rf_ring *ring, const rf_grid *grid, double *memory);

/* Put the journal at q = (e, tau), turning at a rate. */
void rf_set_cells(rf_cells *cells, const double *q, double rate);

/* Depth of the recess behind a line, within its share of the length. */
double rf_depth_behind(const rf_cells *cells, size_t i);

/* What drive[5] = (w of e, w of tau, rate) drives out of each cell, N x M. */
void rf_set_source(const rf_cells *cells, const double *drive, double *source);

/* The products of x, N x M, with the sources of unit drives. */
void rf_multiply(const rf_cells *cells, const double *x, double products[RF_DRIVES]);

/* d (x.(A P - b))/d(e, tau), and by the logarithm of the growth of a mobility, pressure and rate held. */
void rf_bend(const rf_cells *cells, const double *x, const double *pressure, double rate, double bent[RF_FREEDOMS + 1]);

#endif
