#include "map_table.h"

#include <math.h>
#include <string.h>

#include "quintic.h"

#define ROUNDOFF 1e-12 /* relative, by which length/diameter may leave the table */

int rf_map_slice(const rf_map_table *table, double slenderness, double *coefficients, double *center)
{
    const size_t size = (size_t)(table->cells_x + 5) * (size_t)(table->cells_t + 5);
    if (!(slenderness >= table->low * (1.0 - ROUNDOFF) && slenderness <= table->high * (1.0 + ROUNDOFF)))
        return RF_INVALID;
    if (table->cells_s == 0) {
        memcpy(coefficients, table->coefficients, size * sizeof *coefficients);
        *center = table->center[0];
        return RF_OK;
    }
    double rest, weights[RF_ORDER];
    const double at = log(slenderness / table->low) / log(table->high / table->low) * table->cells_s;
    const size_t first = (size_t)rf_cell(at, table->cells_s, &rest);
    rf_values(rest, weights);
    memset(coefficients, 0, size * sizeof *coefficients);
    *center = 0.0;
    for (size_t k = 0; k < RF_ORDER; ++k) {
        const double *layer = table->coefficients + (first + k) * size;
        *center += weights[k] * table->center[first + k];
        for (size_t i = 0; i < size; ++i)
            coefficients[i] += weights[k] * layer[i];
    }
    return RF_OK;
}
