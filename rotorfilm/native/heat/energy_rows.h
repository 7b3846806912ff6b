/* A sparse matrix that is nearly triangular, as that of oil which carries its heat along, eliminated row by row.

   Unknowns of the band couple to some that are near; those after them, its border, to any. Rows keep their order, which
   is that of the flow: then hardly anything fills. There is no pivoting, which the matrix must allow. */
#ifndef ROTORFILM_ENERGY_ROWS_H
#define ROTORFILM_ENERGY_ROWS_H

#include <stddef.h>

#include "../status.h"

typedef struct rf_entry {
    size_t column, next; /* `next`: another entry of the row, 0 if there is none */
    double value;
} rf_entry;

typedef struct rf_sparse {
    size_t band, size, count; /* unknowns of the band, and all; places in use, the first with nothing in it */
    size_t *rows;             /* size: an entry of each */
    rf_entry *entries;        /* those of one place are added */
} rf_sparse;

static inline void rf_put(rf_sparse *matrix, size_t row, size_t column, double value)
{
    const rf_entry entry = {column, matrix->rows[row], value};
    matrix->entries[matrix->count] = entry;
    matrix->rows[row] = matrix->count++;
}

/* Replace the right-hand side by the solution: RF_OK, RF_STUCK where the matrix is singular or a number is not finite, RF_MEMORY. */
int rf_solve_sparse(const rf_sparse *matrix, double *x);

#endif
