/* Sums over the rows of a band, in one order on every machine: number by number, or four sums side by side. */
#ifndef ROTORFILM_VECTORS_H
#define ROTORFILM_VECTORS_H

#include <stddef.h>

/* y -= a x */
static inline void rf_subtract(size_t n, double a, const double *restrict x, double *restrict y)
{
    for (size_t k = 0; k < n; ++k)
        y[k] -= a * x[k];
}

/* Four sums side by side, whatever the machine adds at once. */
static inline double rf_product(size_t n, const double *restrict x, const double *restrict y)
{
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    size_t k = 0;
    for (; k + 4 <= n; k += 4)
        for (size_t m = 0; m < 4; ++m)
            sums[m] += x[k + m] * y[k + m];
    for (size_t m = 0; k + m < n; ++m)
        sums[m] += x[k + m] * y[k + m];
    return (sums[0] + sums[2]) + (sums[1] + sums[3]);
}

#endif
