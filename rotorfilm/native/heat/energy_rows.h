/* A sparse matrix that is nearly triangular, as that of oil which carries its heat along: eliminated row by row.

   Unknowns of the band couple to some that are near; those after them, its border, to any. Rows keep their order, which
   is that of the flow: then hardly anything fills. There is no pivoting, which the matrix must allow. */
#ifndef ROTORFILM_ENERGY_ROWS_H
#define ROTORFILM_ENERGY_ROWS_H

#include <stddef.h>
#include <stdint.h>

#include "../status.h"

typedef struct rf_entry {
    uint32_t row, column;
    double value;
} rf_entry;

typedef struct rf_sparse {
    size_t band, size, count, room; /* unknowns of the band, and all; entries, and how many there is room for */
    rf_entry *entries;              /* in any order; those of one place are added */
} rf_sparse;

/* Add to an entry; more than there is room for are counted only. */
static inline void rf_put(rf_sparse *matrix, size_t row, size_t column, double value)
{
    const rf_entry entry = {(uint32_t)row, (uint32_t)column, value};
    if (matrix->count++ < matrix->room)
        matrix->entries[matrix->count - 1] = entry;
}

/* Replace the right-hand side by the solution: RF_OK, RF_STUCK where the matrix is singular, RF_MEMORY. */
int rf_solve_sparse(const rf_sparse *matrix, double *x);

#endif
