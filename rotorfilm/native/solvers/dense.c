#include "dense.h"

#include <math.h>

static void swap_rows(size_t columns, double *a, size_t i, size_t j)
{
    for (size_t k = 0; i != j && k < columns; ++k) {
        const double kept = a[i * columns + k];
        a[i * columns + k] = a[j * columns + k];
        a[j * columns + k] = kept;
    }
}

static void subtract(size_t n, double factor, const double *restrict from, double *restrict of)
{
    for (size_t j = 0; factor != 0.0 && j < n; ++j)
        of[j] -= factor * from[j];
}

void rf_eliminate(size_t n, double *q, size_t m, double *p)
{
    for (size_t k = 0; k < n; ++k) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; ++i)
            pivot = fabs(q[i * n + k]) > fabs(q[pivot * n + k]) ? i : pivot;
        swap_rows(n, q, k, pivot);
        swap_rows(m, p, k, pivot);
        for (size_t i = k + 1; i < n; ++i) {
            const double factor = q[i * n + k] / q[k * n + k];
            subtract(n - k, factor, q + k * n + k, q + i * n + k);
            subtract(m, factor, p + k * m, p + i * m);
        }
    }
    for (size_t k = n; k-- > 0;) {
        for (size_t j = 0; j < m; ++j)
            p[k * m + j] /= q[k * n + k];
        for (size_t i = 0; i < k; ++i)
            subtract(m, q[i * n + k], p + k * m, p + i * m);
    }
}

/* Four sums at once: one alone would wait for each of its additions. */
static double product(size_t n, const double *a, const double *v)
{
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    size_t j = 0;
    for (; j + 4 <= n; j += 4)
        for (size_t k = 0; k < 4; ++k)
            sum[k] += a[j + k] * v[j + k];
    for (; j < n; ++j)
        sum[0] += a[j] * v[j];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

void rf_add_product(size_t rows, size_t columns, double scale, const double *a, const double *v, double *sum)
{
    for (size_t i = 0; i < rows; ++i)
        sum[i] += scale * product(columns, a + i * columns, v);
}
