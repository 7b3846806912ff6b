#include "oil_waves.h"

#include <stdlib.h>
#include <string.h>

#include "../grids/clones.h"
#include "../status.h"

/* y = inverse (x + flow u), columns of real parts followed by those of imaginary ones. */
static inline void pass(size_t columns, const double *inverse, double flow, const double *restrict x,
                        const double *restrict u, double *restrict y)
{
    for (size_t k = 0; k < columns; ++k) {
        const double real = x[k] + flow * u[k], imaginary = x[columns + k] + flow * u[columns + k];
        y[k] = inverse[0] * real - inverse[1] * imaginary;
        y[columns + k] = inverse[0] * imaginary + inverse[1] * real;
    }
}

/* y = factor x */
static inline void multiply(size_t columns, const double *factor, const double *restrict x, double *restrict y)
{
    for (size_t k = 0; k < columns; ++k) {
        y[k] = factor[0] * x[k] - factor[1] * x[columns + k];
        y[columns + k] = factor[0] * x[columns + k] + factor[1] * x[k];
    }
}

/* Rows of a cell: the change, what comes of it, and two of sources. */
RF_CLONES_OF_OIL
static void go_through(size_t cells, size_t columns, const int32_t *up, const double *own, const double *flow,
                       const double *source, const double *storage, const double *by, double *rows)
{
    const size_t pair = 2 * columns;
    double *given = rows + 2 * pair * (cells + 1), *none = rows + 2 * pair * cells;
    memset(given, 0, pair * sizeof *given);
    memset(none, 0, 2 * pair * sizeof *none);
    for (size_t c = 0; c < cells; ++c) {
        const double real = own[c] + storage[2 * c], imaginary = storage[2 * c + 1];
        const double square = real * real + imaginary * imaginary, inverse[2] = {real / square, -imaginary / square};
        const double *before = up[c] < 0 ? none : rows + 2 * pair * (size_t)up[c];
        double *row = rows + 2 * pair * c;
        memcpy(given, source + c * columns, columns * sizeof *given);
        pass(columns, inverse, flow[c], given, before, row);
        multiply(columns, by + 2 * c, row, given + pair);
        pass(columns, inverse, flow[c], given + pair, before + pair, row + pair);
    }
}

int rf_oil_waves(size_t cells, size_t columns, const int32_t *up, const double *own, const double *flow,
                 const double *source, const double *storage, const double *by, size_t inlets, const int32_t *inlet,
                 double *found)
{
    double *rows = malloc(4 * columns * (cells + 2) * sizeof *rows);
    if (!rows)
        return RF_MEMORY;
    go_through(cells, columns, up, own, flow, source, storage, by, rows);
    for (size_t part = 0; part < 2; ++part)
        for (size_t i = 0; i < inlets; ++i)
            for (size_t k = 0; k < columns; ++k, found += 2) {
                const double *row = rows + (2 * (size_t)inlet[i] + part) * 2 * columns;
                found[0] = row[k];
                found[1] = row[columns + k];
            }
    free(rows);
    return RF_OK;
}
