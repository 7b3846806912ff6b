/* Sums of Chebyshev polynomials. */
#ifndef ROTORFILM_CHEBYSHEV_H
#define ROTORFILM_CHEBYSHEV_H

#include <stdint.h>

/* Sums and their derivatives at x for all columns of table[terms][columns], by Clenshaw's recurrence. */
static inline void rf_chebyshev(const double *table, int32_t terms, int columns, double x, double *value, double *slope)
{
    for (int k = 0; k < columns; ++k) {
        double b1 = 0.0, b2 = 0.0, d1 = 0.0, d2 = 0.0;
        for (int32_t j = terms - 1; j > 0; --j) {
            const double b = table[j * columns + k] + 2.0 * x * b1 - b2;
            const double d = 2.0 * b1 + 2.0 * x * d1 - d2;
            b2 = b1, b1 = b, d2 = d1, d1 = d;
        }
        value[k] = table[k] + x * b1 - b2;
        slope[k] = b1 + x * d1 - d2;
    }
}

#endif
