/* A symmetric positive definite matrix of blocks in a ring, factorized by Cholesky's method.

   Unknowns are numbered line by line, `half` on each, and couple to those of the next line at most: a band of
   that half-width. The ring is cut at one line, whose unknowns border the band. Lines without film are passed
   over, and so are those whose factor is still right.

   Sums run in one order on every machine: rows are added to rows, number by number. */
#ifndef ROTORFILM_CHAIN_H
#define ROTORFILM_CHAIN_H

#include <stddef.h>
#include <stdint.h>

/* What is to be done for a line of the band. */
enum { RF_LINE_EMPTY = 0, RF_LINE_KEPT = 1, RF_LINE_NEW = 2 };

typedef struct rf_chain {
    size_t lines;   /* of the band */
    size_t half;    /* its half-width, unknowns of a line and of the border */
    int bordered;   /* whether the border couples to the band */
    uint8_t *state; /* lines: what there is to do; none is kept in a chain with a border */
    double *band;   /* unknowns x rf_chain_stride: column p of the lower triangle from the diagonal down, then zeros */
    double *border; /* unknowns x half: row p couples unknown p to the border */
    double *corner; /* half x half: lower triangle of the border itself */
} rf_chain;

/* From one column to the next: whole vectors of four numbers from any row of a column on stay within it. */
static inline size_t rf_chain_stride(size_t half)
{
    return (half + 3) / 4 * 4 + 4;
}

/* Replace the matrix of all new lines by its factor; the diagonals then are inverted. A line after a new one
   is new or empty. */
void rf_factorize_chain(rf_chain *chain);

/* Replace the right-hand sides x of the band and last[half] of the border by the solution; those of empty
   lines are 0. */
void rf_solve_chain(const rf_chain *chain, double *x, double *last);

/* The same for a ring that begins at line 0 and is cut at `cut`, in the unknowns that are wanted; the others are
   0. `chained` is scratch for all unknowns of the ring; `answer` may be `right`. */
void rf_solve_ring(const rf_chain *chain, size_t cut, const uint8_t *wanted, const double *right, double *chained,
                   double *answer);

#endif
