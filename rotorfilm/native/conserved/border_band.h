/* A matrix of a band and a border that are not symmetric, factorized without pivoting, real or complex.

   Its columns are diagonally dominant, which is what allows to go without. The unknowns of the band couple to
   those within `half` of them, those of the border, numbered after them, to all. Rows have zeros after the band and after
   the border and a right-hand side, so that all loops go over multiples of what a machine takes at once. */
#ifndef ROTORFILM_BORDER_BAND_H
#define ROTORFILM_BORDER_BAND_H

#include <stddef.h>

typedef struct rf_border_band {
    size_t size, half, border;
    double *rows; /* size x rf_band_stride: columns from `half` before the diagonal to `half` after it, the border, one more */
    double *last; /* border x rf_last_stride: the rows of the border */
    double *imaginary_rows, *imaginary_last; /* NULL in a real matrix */
} rf_border_band;

static inline size_t rf_whole_vectors(size_t n)
{
    return (n + 3) / 4 * 4;
}

/* Columns of the border, the right-hand side, and zeros. */
static inline size_t rf_band_beside(const rf_border_band *band)
{
    return rf_whole_vectors(band->border + 1);
}

/* Where they begin in a row. */
static inline size_t rf_band_reach(const rf_border_band *band)
{
    return band->half + 1 + rf_whole_vectors(band->half);
}

static inline size_t rf_band_stride(const rf_border_band *band)
{
    return rf_band_reach(band) + rf_band_beside(band);
}

static inline size_t rf_last_stride(const rf_border_band *band)
{
    return band->size + rf_band_beside(band);
}

/* Numbers of the rows and of the border together. */
static inline size_t rf_band_numbers(const rf_border_band *band)
{
    return band->size * rf_band_stride(band) + band->border * rf_last_stride(band);
}

/* Add to an entry. */
void rf_add_to_band(rf_border_band *band, size_t row, size_t column, double real, double imaginary);

/* Replace the matrix by its factors; RF_OK, or RF_STUCK where it is singular. A right-hand side of a real matrix, of
   size + border, unless NULL becomes the solution on the way. */
int rf_factorize_band(rf_border_band *band, double *right);
int rf_factorize_complex_band(rf_border_band *band);

/* Replace a right-hand side, of size + border, by the solution. */
void rf_solve_band(const rf_border_band *band, double *x);
void rf_solve_complex_band(const rf_border_band *band, double *real, double *imaginary);

#endif
