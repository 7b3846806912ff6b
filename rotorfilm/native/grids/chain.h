/* A symmetric positive definite matrix of blocks in a ring, factorized by Cholesky's method.

   Unknowns are numbered line by line, `half` on each, and couple to those of the next line at most: a band of
   that half-width. The ring is cut at one line, whose unknowns border the band.

   Sums run in one order on every machine: rows are added to rows, number by number. */
#ifndef ROTORFILM_CHAIN_H
#define ROTORFILM_CHAIN_H

#include <stddef.h>

typedef struct rf_chain {
    size_t size;    /* unknowns of the band */
    size_t half;    /* its half-width, and the number of unknowns of the border */
    int bordered;   /* whether the border couples to the band */
    double *band;   /* size x (half + 1): column p of the lower triangle from the diagonal down */
    double *border; /* size x half: row p couples unknown p to the border */
    double *corner; /* half x half: lower triangle of the border itself */
} rf_chain;

/* Replace the matrix by its factor; the diagonals then are inverted. */
void rf_factorize_chain(rf_chain *chain);

/* Replace the right-hand sides x[size] of the band and last[half] of the border by the solution. */
void rf_solve_chain(const rf_chain *chain, double *x, double *last);

#endif
