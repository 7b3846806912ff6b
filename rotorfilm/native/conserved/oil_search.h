/* The film that conserves its oil, by an active set or by Newton's method for Fischer's and Burmeister's function.

   A cell is full, with theta = 1 and P unknown, or not, with P = 0 and theta unknown. The active set moves cells
   whose P or 1 - theta has become negative until none does. Newton's method (Woloszynski, Podsiadlo & Stachowiak
   2015) has P + psi = sqrt(P^2 + psi^2), psi = 1 - theta, in every cell and no sets; it takes over where the sets
   would go round in a circle. */
#ifndef ROTORFILM_OIL_SEARCH_H
#define ROTORFILM_OIL_SEARCH_H

#include "oil_cells.h"

enum { RF_BY_SETS = 0, RF_BY_NEWTON = 1 };

/* What a search took. */
typedef struct rf_oil_work {
    int64_t solutions; /* linear systems */
    int64_t newton;    /* those of Newton's method */
} rf_oil_work;

/* The work of searches on cells of one shape. After a search that found its film it has the factors of its matrix. */
typedef struct rf_oil_solver {
    const rf_oil_cells *cells;
    rf_oil_places places;
    rf_border_band band;
    double *by_pressure, *by_theta, *flow; /* N x M */
    double *right, *imaginary;             /* of the matrix */
    rf_oil_work work;
    void *memory;
} rf_oil_solver;

/* RF_OK or RF_MEMORY. */
int rf_open_oil_solver(rf_oil_solver *solver, const rf_oil_cells *cells, int is_complex);

void rf_close_oil_solver(rf_oil_solver *solver);

/* rf_oil_film in a solver, whose work is then that of this search. */
int rf_search_oil(rf_oil_solver *solver, const rf_oil_cells *cells, int method, int guessed, uint8_t *full,
                  double *pressure, double *theta);

/* rf_oil_response of the film that a solver has just found, with no further storage. */
void rf_follow_oil(rf_oil_solver *solver, size_t count, double *right);

/* Set P and theta, which come with their values in openings that are held. `full` is the guess of the cells that
   are full if `guessed`, else they are those of the film on half the cells; it then tells them. `method` is
   RF_BY_SETS, or RF_BY_NEWTON to begin with that. RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_film(const rf_oil_cells *cells, int method, int guessed, uint8_t *full, double *pressure,
                               double *theta, rf_oil_work *work);

/* Replace `count` right-hand sides (count x N x M, both parts) by the changes of P where the cells are full and of
   theta where not that make the flow out of the cells change so; theta has further storage (N x M, both parts). Unless
   `coupling` (2 x N x M, both parts) is NULL, then as many again, each less coupling times what came of the first.
   `right_imaginary` and `imaginary` NULL: all is real. RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_response(const rf_oil_cells *cells, const uint8_t *full, const double *storage,
                                   const double *imaginary, const double *coupling, size_t count, double *right,
                                   double *right_imaginary);

#endif
