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

/* What is left of a row: its entries right of the diagonal, over it, in the band and in the border. */
typedef struct row_left {
    size_t at;              /* its place among all numbers */
    uint32_t reach;         /* entries in the band, next to the diagonal */
    uint32_t first, border; /* first unknown of the border, and how many follow */
} row_left;

typedef struct work {
    const rf_sparse *matrix;
    size_t *start;    /* size + 1: where the entries of a row begin in `order` */
    rf_entry *order;  /* the entries, row by row */
    row_left *rows;   /* size */
    double *row, *x;  /* size: the row at hand, and what is known of the solution */
    double *numbers;  /* of all rows that are done */
    size_t used, room;
} work;

static void sort_entries(work *w)
{
    const rf_sparse *m = w->matrix;
    memset(w->start, 0, (m->size + 1) * sizeof *w->start);
    for (size_t k = 0; k < m->count; ++k)
        ++w->start[m->entries[k].row + 1];
    for (size_t p = 0; p < m->size; ++p)
        w->start[p + 1] += w->start[p];
    for (size_t k = 0; k < m->count; ++k)
        w->order[w->start[m->entries[k].row]++] = m->entries[k];
    memmove(w->start + 1, w->start, m->size * sizeof *w->start);
    w->start[0] = 0;
}

/* Where a row has entries: in the band [low, high), in the border [first, last). */
typedef struct extent {
    size_t low, high, first, last;
} extent;

static void spread(extent *of, size_t band, size_t column, size_t count)
{
    if (count == 0)
        return;
    size_t *low = column < band ? &of->low : &of->first, *high = column < band ? &of->high : &of->last;
    *low = column < *low ? column : *low;
    *high = column + count > *high ? column + count : *high;
}

static extent scatter(const work *w, size_t p)
{
    const size_t band = w->matrix->band;
    extent of = {band, 0, w->matrix->size, band};
    for (size_t k = w->start[p]; k < w->start[p + 1]; ++k) {
        w->row[w->order[k].column] += w->order[k].value;
        spread(&of, band, w->order[k].column, 1);
    }
    return of;
}

/* Take what is left of row q from the row at hand. */
static inline void take_row(const work *w, size_t q, extent *of, double *right)
{
    const row_left *left = &w->rows[q];
    const double factor = w->row[q], *numbers = w->numbers + left->at;
    w->row[q] = 0.0;
    if (factor == 0.0)
        return;
    rf_subtract(left->reach, factor, numbers, w->row + q + 1);
    rf_subtract(left->border, factor, numbers + left->reach, w->row + left->first);
    *right -= factor * w->x[q];
    spread(of, w->matrix->band, q + 1, left->reach);
    spread(of, w->matrix->band, left->first, left->border);
}

static int make_room(work *w, size_t more)
{
    if (w->used + more <= w->room)
        return 1;
    w->room = 2 * w->room + more;
    double *numbers = realloc(w->numbers, w->room * sizeof(double));
    w->numbers = numbers ? numbers : w->numbers;
    return numbers != NULL;
}

/* Keep what is left of row p, over its pivot, and leave the row at hand empty. */
static int keep_row(work *w, size_t p, extent of)
{
    const size_t band = w->matrix->band, after = p + 1;
    const size_t high = of.high > after && p < band ? of.high : after;
    const size_t first = of.first > after ? of.first : after, last = of.last > first ? of.last : first;
    const double pivot = w->row[p];
    if (!(fabs(pivot) > 0.0 && isfinite(pivot)))
        return RF_STUCK;
    if (!make_room(w, high - after + last - first))
        return RF_MEMORY;
    const row_left left = {w->used, (uint32_t)(high - after), (uint32_t)first, (uint32_t)(last - first)};
    double *to = w->numbers + w->used;
    for (size_t k = after; k < high; ++k)
        *to++ = w->row[k] / pivot;
    for (size_t k = first; k < last; ++k)
        *to++ = w->row[k] / pivot;
    w->x[p] /= pivot;
    w->row[p] = 0.0;
    memset(w->row + after, 0, (high - after) * sizeof(double));
    memset(w->row + first, 0, (last - first) * sizeof(double));
    w->used += high - after + last - first;
    w->rows[p] = left;
    return RF_OK;
}

RF_CLONES_OF_HEAT
static int eliminate(work *w)
{
    const size_t band = w->matrix->band;
    for (size_t p = 0; p < w->matrix->size; ++p) {
        extent of = scatter(w, p);
        double right = w->x[p];
        for (size_t q = of.low; q < of.high && q < p; ++q)
            take_row(w, q, &of, &right);
        for (size_t q = of.first; p >= band && q < p; ++q)
            take_row(w, q, &of, &right);
        w->x[p] = right;
        const int status = keep_row(w, p, of);
        if (status != RF_OK)
            return status;
    }
    return RF_OK;
}

RF_CLONES_OF_HEAT
static void substitute(const work *w)
{
    for (size_t p = w->matrix->size; p-- > 0;) {
        const row_left *left = &w->rows[p];
        const double *numbers = w->numbers + left->at;
        w->x[p] -= rf_product(left->reach, numbers, w->x + p + 1);
        w->x[p] -= rf_product(left->border, numbers + left->reach, w->x + left->first);
    }
}

int rf_solve_sparse(const rf_sparse *matrix, double *x)
{
    const size_t size = matrix->size;
    work w = {matrix, malloc((size + 1) * sizeof(size_t)), malloc(matrix->count * sizeof(rf_entry)),
              malloc(size * sizeof(row_left)), calloc(size, sizeof(double)), x, NULL, 0, 0};
    int status = RF_MEMORY;
    if (matrix->count <= matrix->room && w.start && w.order && w.rows && w.row) {
        sort_entries(&w);
        status = eliminate(&w);
    }
    if (status == RF_OK)
        substitute(&w);
    free(w.start);
    free(w.order);
    free(w.rows);
    free(w.row);
    free(w.numbers);
    return status;
}
