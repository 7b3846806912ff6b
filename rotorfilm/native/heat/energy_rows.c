#include "energy_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../grids/clones.h"
#include "../grids/vectors.h"

/* Other libraries have no use for these functions, and would keep them for their clones. */
#if !defined(RF_SUBSET) || RF_SUBSET == RF_ROTORFILM_LOOPS
#define RF_CLONES_OF_HEAT RF_CLONES
#else
#define RF_CLONES_OF_HEAT
#endif

/* Columns from `low` on, below `high`. */
typedef struct range {
    size_t low, high;
} range;

/* A row: where it has numbers in the band and in the border, and those right of a diagonal of 1. */
typedef struct sparse_row {
    range part[2];
    double *numbers;
} sparse_row;

static inline void widen(range *of, range by)
{
    if (by.low >= by.high)
        return;
    of->low = by.low < of->low ? by.low : of->low;
    of->high = by.high > of->high ? by.high : of->high;
}

/* Take a row that is done from the one at hand. */
static inline void take_row(const sparse_row *done, double factor, sparse_row *hand)
{
    const double *numbers = done->numbers;
    for (int k = 0; k < 2; ++k) {
        const range part = done->part[k];
        rf_subtract(part.high - part.low, factor, numbers, hand->numbers + part.low);
        widen(&hand->part[k], part);
        numbers += part.high - part.low;
    }
}

/* Take from the row at hand what is left of its diagonal, and what that says of the right-hand side x. */
static inline void take_rows(const sparse_row *done, size_t p, sparse_row *hand, double *x)
{
    for (int k = 0; k < 2; ++k)
        for (size_t q = hand->part[k].low; q < hand->part[k].high && q < p; ++q)
            if (hand->numbers[q] != 0.0) {
                take_row(done + q, hand->numbers[q], hand);
                x[p] -= hand->numbers[q] * x[q];
                hand->numbers[q] = 0.0;
            }
}

/* Keep the row at hand over its diagonal, and leave that empty. */
static int keep_row(sparse_row *hand, size_t p, sparse_row *kept, double *x)
{
    const double pivot = hand->numbers[p];
    size_t count = 0;
    for (int k = 0; k < 2; ++k) {
        kept->part[k].low = hand->part[k].low > p ? hand->part[k].low : p + 1;
        kept->part[k].high = hand->part[k].high > kept->part[k].low ? hand->part[k].high : kept->part[k].low;
        count += kept->part[k].high - kept->part[k].low;
    }
    double *to = kept->numbers = malloc((count + 1) * sizeof(double));
    if (!to)
        return RF_MEMORY;
    for (int k = 0; k < 2; ++k)
        for (size_t q = kept->part[k].low; q < kept->part[k].high; ++q) {
            *to++ = hand->numbers[q] / pivot;
            hand->numbers[q] = 0.0;
        }
    hand->numbers[p] = 0.0;
    x[p] /= pivot;
    return fabs(pivot) > 0.0 && isfinite(pivot) ? RF_OK : RF_STUCK;
}

RF_CLONES_OF_HEAT
static int eliminate(const rf_sparse *matrix, sparse_row *rows, double *numbers, double *x)
{
    int status = RF_OK;
    for (size_t p = 0; p < matrix->size && status == RF_OK; ++p) {
        sparse_row hand = {{{matrix->size, 0}, {matrix->size, 0}}, numbers};
        for (size_t k = matrix->rows[p]; k > 0; k = matrix->entries[k].next) {
            const size_t column = matrix->entries[k].column;
            const range one = {column, column + 1};
            numbers[column] += matrix->entries[k].value;
            widen(&hand.part[column >= matrix->band], one);
        }
        take_rows(rows, p, &hand, x);
        status = keep_row(&hand, p, rows + p, x);
    }
    return status;
}

static int substitute(const sparse_row *rows, size_t size, double *x)
{
    for (size_t p = size; p-- > 0;) {
        const double *numbers = rows[p].numbers;
        for (int k = 0; k < 2; ++k) {
            const size_t count = rows[p].part[k].high - rows[p].part[k].low;
            x[p] -= rf_product(count, numbers, x + rows[p].part[k].low);
            numbers += count;
        }
        if (!isfinite(x[p]))
            return RF_STUCK;
    }
    return RF_OK;
}

int rf_solve_sparse(const rf_sparse *matrix, double *x)
{
    sparse_row *rows = calloc(matrix->size, sizeof *rows);
    double *numbers = calloc(matrix->size, sizeof *numbers);
    int status = rows && numbers ? eliminate(matrix, rows, numbers, x) : RF_MEMORY;
    if (status == RF_OK)
        status = substitute(rows, matrix->size, x);
    for (size_t p = 0; rows && p < matrix->size; ++p)
        free(rows[p].numbers);
    free(rows);
    free(numbers);
    return status;
}
