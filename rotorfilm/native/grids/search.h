/* The film's equations on one grid, and the search for the zone that is full of oil. */
#ifndef ROTORFILM_SEARCH_H
#define ROTORFILM_SEARCH_H

#include "cells.h"
#include "chain.h"

/* What the grids of a ring are solved with and leave behind. */
typedef struct rf_search {
    const rf_ring *ring;
    rf_cells cells[RF_LEVELS];
    rf_chain chain;
    double *source, *pressure, *flow, *chained; /* N x M of the grid that was solved last */
    uint8_t *free, *known; /* N x M: nodes that are solved for, and those of the next coarser grid */
    uint8_t *shut;         /* N x M of the finest grid: nodes that stay empty */
    uint8_t *moved;        /* N: lines of which some node filled or emptied since they were factorized */
    size_t cut;            /* the line at which the ring is cut */
    rf_grid_work work;     /* so far */
    void *memory;
} rf_search;

/* Memory for the grids of a ring; RF_MEMORY where there is none. */
int rf_open_search(rf_search *search, const rf_ring *ring);
void rf_close_search(rf_search *search);

/* Put the journal at e on all grids from the coarsest to this one. */
void rf_place_journal(rf_search *search, const double *e);

/* Set the pressure on one grid for a source w; RF_STUCK. Where the film is searched for, the next coarser grid
   is to be solved before.

   The search is a primal-dual active set method: for this M-matrix it is Newton's method for
   min(A P - b, P) = 0 and climbs monotonically to the solution after its first step (Hintermueller, Ito &
   Kunisch 2003, theorem 3.3). */
int rf_search_film(rf_search *search, int level, const double *w);

/* The same after solving on all coarser grids, where the film is searched for. */
int rf_search_down_to(rf_search *search, int level, const double *w);

/* Go on on the finest grid, without nodes that were shut since. */
int rf_search_without(rf_search *search);

/* Solve on that grid again, with its film: right-hand side and answer N x M, 0 at nodes that are not free. */
void rf_solve_free(const rf_search *search, const double *flow, double *answer);

#endif
