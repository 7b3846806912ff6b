/* Reynolds' equation with any conductances on a ring of lines with nodes on each, and the search for its film.

   Oil flows from node to node in proportion to the fall of pressure, and out of the ends of a line to the ambient
   pressure 0. In the film what flows out of a node is its source; elsewhere the pressure is 0, and nothing is left
   to flow out (complementarity), or it is held. */
#ifndef ROTORFILM_SEARCH_H
#define ROTORFILM_SEARCH_H

#include "../export.h"
#include "../status.h"
#include "chain.h"

/* Rows of lines x nodes. */
typedef struct rf_stencil {
    size_t lines, nodes;
    const double *around; /* conductance to the next line */
    const double *along;  /* to the next node of the line, and out of its end */
    const double *entry;  /* lines: out of the first node of a line; NULL where the middle of the bearing is there */
    const double *source; /* that drives oil out of a node */
    const uint8_t *held;  /* nodes whose pressure is given */
} rf_stencil;

/* What solving films took. */
typedef struct rf_grid_work {
    int64_t solutions; /* linear systems, of all grids */
    int64_t lines;     /* that were factorized for them */
} rf_grid_work;

/* What a film is searched for with. */
typedef struct rf_search {
    const rf_stencil *film; /* that was searched for last, and its nodes that are full */
    uint8_t *full;
    rf_chain chain;
    double *flow, *chained; /* lines x nodes of the largest film */
    uint8_t *moved;         /* lines of which some node filled or emptied since they were factorized */
    uint8_t *factorized;    /* the nodes that were full when the chain was factorized last */
    int keeps;              /* whether the next film has the same conductances, so that its lines with the same nodes are kept */
    size_t cut;             /* the line at which the ring is cut */
    rf_grid_work work;      /* so far */
    void *memory;
} rf_search;

/* Memory for films of so many lines and nodes at most; RF_MEMORY where there is none. */
int rf_open_search(rf_search *search, size_t lines, size_t nodes);
void rf_close_search(rf_search *search);

/* Set the pressure, which comes with its values at nodes that are held, and the nodes that are full, which come as a
   guess; RF_STUCK. A film that is not ruptured is full as guessed.

   The search is a primal-dual active set method: for this M-matrix it is Newton's method for
   min(A P - b, P) = 0 and climbs monotonically to the solution after its first step (Hintermueller, Ito &
   Kunisch 2003, theorem 3.3). */
int rf_search_film(rf_search *search, const rf_stencil *film, int ruptured, double *pressure, uint8_t *full);

/* Solve again with the film that was found: right-hand side and answer lines x nodes, 0 where it is not full. */
void rf_solve_film(const rf_search *search, const double *right, double *answer);

/* One film that ruptures. The right-hand sides `answers` (count x lines x nodes) are replaced by solutions of the
   same film. RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_stencil_film(const rf_stencil *film, double *pressure, uint8_t *full, size_t count,
                                   double *answers);

#endif
