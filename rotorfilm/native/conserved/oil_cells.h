/* Conservation of oil in the cells of a film, full or not, on a ring of lines.

   On each of N lines there are M cells along the length. With the pressure P from that of the cavity and theta,
   the share of the gap that is oil, the flow out of a cell is

       transport  wedge theta of the cell upstream, at the faces before and after the line,
       pressure   around and along, in proportion to the fall of P, to the next cells and to both ends of the line,
       storage    store theta - old

   which is nothing where P, theta solve the film: P >= 0, theta <= 1, P (1 - theta) = 0. Lines between which nothing
   flows cut the ring open. */
#ifndef ROTORFILM_OIL_CELLS_H
#define ROTORFILM_OIL_CELLS_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "border_band.h"

#define RF_FILM_CELL (-1)

typedef struct rf_oil_cells {
    size_t lines, nodes, openings;
    const double *wedge;  /* N x M: oil that a full gap carries over the face after a cell, around the ring */
    const double *around; /* N x M: conductance of that face */
    const double *store;  /* N x M: that theta holds back */
    const double *along;  /* N x (M + 1): conductance of the faces of a line, from its first end to its last; 0 if closed */
    const double *old;    /* N x M: what storage has, or NULL */
    double first_pressure, last_pressure; /* at the ends of the lines */
    const int32_t *opening;               /* N x M: of which opening a cell is part; RF_FILM_CELL */
    const uint8_t *fed;                   /* of the openings: whether it is one cell with a given flow, not held */
    const double *flow;                   /* of the openings: that flow */
    int32_t backward;                     /* whether the oil is carried against the order of the lines */
} rf_oil_cells;

/* Where each cell stands in the matrix: in the band from the line after the cut on, in its border (the cells of
   the line of the cut, then the openings with a given flow), or nowhere where it is held. */
typedef struct rf_oil_places {
    size_t cut;
    int32_t *place; /* N x M; -1 nowhere */
    int32_t *entry; /* N x M x RF_OIL_ENTRIES: where in the matrix what a cell does to itself and its neighbors goes; -1 nowhere */
} rf_oil_places;

/* A cell itself, the next one around and the one before, the one before along the line and the next. */
enum { RF_OIL_ENTRIES = 5 };

/* Flow out of every cell, N x M. */
RF_EXPORT_LOOP void rf_oil_outflow(const rf_oil_cells *cells, const double *pressure, const double *theta,
                                   double *outflow);

/* Set the places and the entries, and the sizes of the matrix. */
void rf_place_oil(const rf_oil_cells *cells, rf_oil_places *places, rf_border_band *band);

/* d outflow / d x with dP = by_pressure dx and dtheta = by_theta dx; further storage of theta in both parts, or NULL
   twice. */
void rf_set_oil_matrix(const rf_oil_cells *cells, const rf_oil_places *places, const double *by_pressure,
                       const double *by_theta, const double *real, const double *imaginary, rf_border_band *band);

#endif
