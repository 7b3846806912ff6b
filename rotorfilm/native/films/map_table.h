/* The impedance map of every plain journal bearing: map_kernel.h with a third axis, ln(length/diameter). */
#ifndef ROTORFILM_MAP_TABLE_H
#define ROTORFILM_MAP_TABLE_H

#include "map_kernel.h"

typedef struct rf_map_table {
    int32_t cells_s;            /* cells of [ln low, ln high]; 0 for the table of a single bearing */
    int32_t cells_x, cells_t;   /* as in rf_map */
    double low, high;           /* smallest and largest length/diameter */
    const double *center;       /* cells_s + 5 coefficients of L0, or L0 itself */
    const double *coefficients; /* (cells_s + 5 or 1) x (cells_x + 5) x (cells_t + 5) */
} rf_map_table;

/* The map of one bearing: (cells_x + 5) x (cells_t + 5) coefficients and L0. RF_INVALID, without an answer,
   if length/diameter is outside the table. */
RF_EXPORT int rf_map_slice(const rf_map_table *table, double slenderness, double *coefficients,
                           double *center);

#endif
