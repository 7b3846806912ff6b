#include "chain.h"

#include <math.h>
#include <string.h>

#include "clones.h"
#include "vectors.h"

static inline size_t unknowns(const rf_chain *chain)
{
    return chain->lines * chain->half;
}

static inline size_t below(const rf_chain *chain, size_t p)
{
    const size_t left = unknowns(chain) - 1 - p;
    return left < chain->half ? left : chain->half;
}

RF_CLONES
static void factorize_band(rf_chain *chain)
{
    const size_t half = chain->half, stride = rf_chain_stride(half);
    for (size_t line = 0; line < chain->lines; ++line) {
        const size_t start = line * half;
        if (chain->state[line] != RF_LINE_NEW)
            continue;
        /* A kept line before it takes from it once more what it took before. */
        const size_t from = line > 0 && chain->state[line - 1] == RF_LINE_KEPT ? start - half : start;
        for (size_t p = from; p < start + half; ++p) {
            double *column = chain->band + p * stride;
            const size_t reach = below(chain, p);
            if (p >= start) {
                const double inverse = 1.0 / sqrt(column[0]);
                column[0] = inverse;
                for (size_t k = 1; k <= reach; ++k)
                    column[k] *= inverse;
            }
            for (size_t k = p < start ? start - p : 1; k <= reach; ++k)
                if (column[k] != 0.0)
                    rf_subtract((half + 4 - k) / 4 * 4, column[k], column + k, column + k * stride);
        }
    }
}

/* Solve with the band for all columns of the border, and take what they leave from the corner. */
RF_CLONES
static void factorize_border(rf_chain *chain)
{
    const size_t half = chain->half, stride = rf_chain_stride(half);
    for (size_t p = 0; p < unknowns(chain); ++p) {
        const double *column = chain->band + p * stride;
        double *row = chain->border + p * half;
        for (size_t j = 0; j < half; ++j)
            row[j] *= column[0];
        for (size_t k = 1; k <= below(chain, p); ++k)
            if (column[k] != 0.0)
                rf_subtract(half, column[k], row, row + k * half);
        for (size_t j = 0; j < half; ++j)
            if (row[j] != 0.0)
                rf_subtract(j + 1, row[j], row, chain->corner + j * half);
    }
}

static void factorize_corner(rf_chain *chain)
{
    const size_t half = chain->half;
    for (size_t j = 0; j < half; ++j) {
        double *row = chain->corner + j * half;
        for (size_t k = 0; k <= j; ++k) {
            const double *other = chain->corner + k * half;
            double total = row[k];
            for (size_t m = 0; m < k; ++m)
                total -= row[m] * other[m];
            row[k] = k < j ? total * other[k] : 1.0 / sqrt(total);
        }
    }
}

void rf_factorize_chain(rf_chain *chain)
{
    factorize_band(chain);
    if (chain->bordered) {
        factorize_border(chain);
        factorize_corner(chain);
    }
}

RF_CLONES
static void forward(const rf_chain *chain, double *x)
{
    const size_t half = chain->half, stride = rf_chain_stride(half);
    for (size_t line = 0; line < chain->lines; ++line) {
        if (chain->state[line] == RF_LINE_EMPTY)
            continue;
        for (size_t p = line * half; p < (line + 1) * half; ++p) {
            const double *column = chain->band + p * stride;
            x[p] *= column[0];
            if (x[p] != 0.0)
                rf_subtract(below(chain, p), x[p], column + 1, x + p + 1);
        }
    }
}

RF_CLONES
static void backward(const rf_chain *chain, double *x)
{
    const size_t half = chain->half, stride = rf_chain_stride(half);
    for (size_t line = chain->lines; line-- > 0;) {
        if (chain->state[line] == RF_LINE_EMPTY)
            continue;
        for (size_t p = (line + 1) * half; p-- > line * half;) {
            const double *column = chain->band + p * stride;
            x[p] = (x[p] - rf_product(below(chain, p), column + 1, x + p + 1)) * column[0];
        }
    }
}

RF_CLONES
static void solve_border(const rf_chain *chain, double *x, double *last)
{
    const size_t half = chain->half;
    for (size_t p = 0; p < unknowns(chain); ++p)
        if (x[p] != 0.0)
            rf_subtract(half, x[p], chain->border + p * half, last);
    for (size_t j = 0; j < half; ++j) {
        const double *row = chain->corner + j * half;
        last[j] = (last[j] - rf_product(j, row, last)) * row[j];
    }
    for (size_t j = half; j-- > 0;) {
        const double *row = chain->corner + j * half;
        last[j] *= row[j];
        rf_subtract(j, last[j], row, last);
    }
    for (size_t p = 0; p < unknowns(chain); ++p)
        x[p] -= rf_product(half, chain->border + p * half, last);
}

void rf_solve_chain(const rf_chain *chain, double *x, double *last)
{
    forward(chain, x);
    if (chain->bordered)
        solve_border(chain, x, last);
    backward(chain, x);
}

void rf_solve_ring(const rf_chain *chain, size_t cut, const uint8_t *wanted, const double *right, double *chained,
                   double *answer)
{
    const size_t nodes = chain->half, all = (chain->lines + 1) * nodes, first = (cut + 1) * nodes;
    for (size_t q = 0; q < all; ++q) {
        const size_t from = q + first < all ? q + first : q + first - all;
        chained[q] = wanted[from] ? right[from] : 0.0;
    }
    rf_solve_chain(chain, chained, chained + all - nodes);
    memcpy(answer + first, chained, (all - first) * sizeof(double));
    memcpy(answer, chained + all - first, first * sizeof(double));
}
