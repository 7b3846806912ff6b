#include "border_band.h"

#include <math.h>

#include "../grids/clones.h"
#include "../grids/vectors.h"
#include "../status.h"

/* Into functions for each width of registers. */
#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline))
#else
#define INLINE static inline
#endif

/* In a loop: no numbers side by side, since those just written would not be ready as one. */
#if defined(__GNUC__)
#define ONE_BY_ONE __asm__ volatile("")
#else
#define ONE_BY_ONE
#endif

/* Pieces of a row, or of a vector, in both parts; no imaginary one where all is real. */
typedef struct rf_piece {
    double *real, *imaginary;
} rf_piece;

static inline rf_piece piece(double *real, double *imaginary, size_t at)
{
    const rf_piece part = {real + at, imaginary ? imaginary + at : NULL};
    return part;
}

static inline rf_piece in_row(const rf_border_band *band, size_t row, size_t at)
{
    return piece(band->rows, band->imaginary_rows, row * rf_band_stride(band) + at);
}

static inline rf_piece in_last(const rf_border_band *band, size_t row, size_t at)
{
    return piece(band->last, band->imaginary_last, row * rf_last_stride(band) + at);
}

static inline size_t below(const rf_border_band *band, size_t p)
{
    const size_t left = band->size - 1 - p;
    return left < band->half ? left : band->half;
}

/* Divide an entry by the pivot; whether anything is left of it. */
INLINE int scale(rf_piece entry, rf_piece pivot)
{
    if (!pivot.imaginary) {
        entry.real[0] *= pivot.real[0];
        return entry.real[0] != 0.0;
    }
    const double real = entry.real[0], imaginary = entry.imaginary[0];
    entry.real[0] = real * pivot.real[0] - imaginary * pivot.imaginary[0];
    entry.imaginary[0] = real * pivot.imaginary[0] + imaginary * pivot.real[0];
    return entry.real[0] != 0.0 || entry.imaginary[0] != 0.0;
}

/* y -= a x */
INLINE void take(size_t n, rf_piece a, rf_piece x, rf_piece y)
{
    rf_subtract(n, a.real[0], x.real, y.real);
    if (!a.imaginary)
        return;
    rf_subtract(n, -a.imaginary[0], x.imaginary, y.real);
    rf_subtract(n, a.real[0], x.imaginary, y.imaginary);
    rf_subtract(n, a.imaginary[0], x.real, y.imaginary);
}

/* Replace a pivot by its inverse; whether it has one. */
static int invert(rf_piece pivot)
{
    const double imaginary = pivot.imaginary ? pivot.imaginary[0] : 0.0;
    const double square = pivot.real[0] * pivot.real[0] + imaginary * imaginary;
    if (!(square > 0.0 && isfinite(square)))
        return 0;
    pivot.real[0] /= square;
    if (pivot.imaginary)
        pivot.imaginary[0] = -imaginary / square;
    return 1;
}

INLINE int factorize_rows(const rf_border_band *band)
{
    const size_t half = band->half, beside = rf_band_beside(band), whole = rf_whole_vectors(half);
    for (size_t p = 0; p < band->size; ++p) {
        const rf_piece pivot = in_row(band, p, half), after = in_row(band, p, half + 1);
        const rf_piece far = in_row(band, p, half + 1 + whole);
        const size_t reach = below(band, p);
        if (!invert(pivot))
            return RF_STUCK;
        for (size_t d = 1; d <= reach; ++d) {
            const rf_piece factor = in_row(band, p + d, half - d);
            if (!scale(factor, pivot))
                continue;
            take(whole, factor, after, in_row(band, p + d, half - d + 1));
            take(beside, factor, far, in_row(band, p + d, half + 1 + whole));
        }
        for (size_t b = 0; b < band->border; ++b) {
            const rf_piece factor = in_last(band, b, p);
            if (!scale(factor, pivot))
                continue;
            take(reach, factor, after, in_last(band, b, p + 1));
            take(beside, factor, far, in_last(band, b, band->size));
        }
    }
    return RF_OK;
}

INLINE int factorize_corner(const rf_border_band *band)
{
    const size_t size = band->size, border = band->border, beside = rf_band_beside(band);
    for (size_t p = 0; p < border; ++p) {
        const rf_piece pivot = in_last(band, p, size + p);
        if (!invert(pivot))
            return RF_STUCK;
        for (size_t b = p + 1; b < border; ++b)
            if (scale(in_last(band, b, size + p), pivot))
                take(beside - 1 - p, in_last(band, b, size + p), in_last(band, p, size + p + 1),
                     in_last(band, b, size + p + 1));
    }
    return RF_OK;
}

/* y -= row.x */
INLINE void take_product(size_t n, rf_piece row, rf_piece x, rf_piece y)
{
    y.real[0] -= rf_product(n, row.real, x.real);
    if (!y.imaginary)
        return;
    y.real[0] += rf_product(n, row.imaginary, x.imaginary);
    y.imaginary[0] -= rf_product(n, row.real, x.imaginary) + rf_product(n, row.imaginary, x.real);
}

/* y -= row.x number by number, the nearest to y last: only that one waits for what has just been found. */
INLINE void take_in_order(size_t n, int ascending, rf_piece row, rf_piece x, rf_piece y)
{
    double real = y.real[0], imaginary = y.imaginary ? y.imaginary[0] : 0.0;
    for (size_t d = 0; d < n; ++d) {
        const size_t k = ascending ? d : n - 1 - d;
        ONE_BY_ONE;
        real -= row.real[k] * x.real[k];
        if (y.imaginary) {
            real += row.imaginary[k] * x.imaginary[k];
            imaginary -= row.real[k] * x.imaginary[k] + row.imaginary[k] * x.real[k];
        }
    }
    y.real[0] = real;
    if (y.imaginary)
        y.imaginary[0] = imaginary;
}

INLINE void forward(const rf_border_band *band, double *real, double *imaginary)
{
    const size_t half = band->half;
    for (size_t p = 1; p < band->size; ++p) {
        const size_t reach = p < half ? p : half;
        take_in_order(reach, 1, in_row(band, p, half - reach), piece(real, imaginary, p - reach),
                      piece(real, imaginary, p));
    }
    for (size_t b = 0; b < band->border; ++b)
        take_product(band->size + b, in_last(band, b, 0), piece(real, imaginary, 0),
                     piece(real, imaginary, band->size + b));
}

INLINE void backward(const rf_border_band *band, double *real, double *imaginary)
{
    const size_t half = band->half, size = band->size, border = band->border, reach = rf_band_reach(band);
    for (size_t b = border; b-- > 0;) {
        const rf_piece x = piece(real, imaginary, size + b);
        take_product(border - 1 - b, in_last(band, b, size + b + 1), piece(real, imaginary, size + b + 1), x);
        scale(x, in_last(band, b, size + b));
    }
    for (size_t p = size; p-- > 0;) {
        const rf_piece x = piece(real, imaginary, p);
        take_product(border, in_row(band, p, reach), piece(real, imaginary, size), x);
        take_in_order(below(band, p), 0, in_row(band, p, half + 1), piece(real, imaginary, p + 1), x);
        scale(x, in_row(band, p, half));
    }
}

/* The compiler is to know which of both there are. */
RF_CLONES_OF_OIL
static int factorize_real(const rf_border_band *band)
{
    const rf_border_band real = {band->size, band->half, band->border, band->rows, band->last, NULL, NULL};
    return factorize_rows(&real) == RF_OK ? factorize_corner(&real) : RF_STUCK;
}

RF_CLONES_OF_OIL
static void finish_real(const rf_border_band *band, double *x)
{
    const rf_border_band real = {band->size, band->half, band->border, band->rows, band->last, NULL, NULL};
    backward(&real, x, NULL);
}

RF_CLONES_OF_OIL
static void begin_real(const rf_border_band *band, double *x)
{
    const rf_border_band real = {band->size, band->half, band->border, band->rows, band->last, NULL, NULL};
    forward(&real, x, NULL);
}

int rf_factorize_band(rf_border_band *band, double *right)
{
    const size_t all = band->size + band->border; /* the column of the right-hand side */
    for (size_t p = 0; right && p < all; ++p)
        band->rows[rf_band_place(band, p, all)] = right[p];
    const int status = factorize_real(band);
    if (!right || status != RF_OK)
        return status;
    for (size_t p = 0; p < all; ++p)
        right[p] = band->rows[rf_band_place(band, p, all)];
    finish_real(band, right);
    return RF_OK;
}

void rf_solve_band(const rf_border_band *band, double *x)
{
    begin_real(band, x);
    finish_real(band, x);
}

RF_CLONES_OF_OIL
static int factorize_complex(const rf_border_band *band)
{
    return factorize_rows(band) == RF_OK ? factorize_corner(band) : RF_STUCK;
}

int rf_factorize_complex_band(rf_border_band *band)
{
    return factorize_complex(band);
}

void rf_solve_complex_band(const rf_border_band *band, double *real, double *imaginary)
{
    forward(band, real, imaginary);
    backward(band, real, imaginary);
}
