#include "oil_cells.h"

#include <math.h>
#include <string.h>

static size_t after(const rf_oil_cells *cells, size_t i)
{
    return i + 1 < cells->lines ? i + 1 : 0;
}

void rf_oil_outflow(const rf_oil_cells *cells, const double *pressure, const double *theta, double *outflow)
{
    const size_t nodes = cells->nodes, lines = cells->lines;
    for (size_t q = 0; q < lines * nodes; ++q)
        outflow[q] = cells->store[q] * theta[q] - (cells->old ? cells->old[q] : 0.0);
    for (size_t i = 0; i < lines; ++i) {
        const size_t here = i * nodes, beyond = after(cells, i) * nodes;
        const double *p = pressure + here, *up = theta + (cells->backward ? beyond : here);
        const double *wedge = cells->wedge + here, *around = cells->around + here, *along = cells->along + i * (nodes + 1);
        double *out = outflow + here, *next = outflow + beyond;
        for (size_t j = 0; j < nodes; ++j) {
            const double flow = wedge[j] * up[j] + around[j] * (p[j] - pressure[beyond + j]);
            const double outward = along[j + 1] * (p[j] - (j + 1 < nodes ? p[j + 1] : cells->last_pressure));
            out[j] += flow + outward;
            next[j] -= flow;
            if (j + 1 < nodes)
                out[j + 1] -= outward;
        }
        out[0] += along[0] * (p[0] - cells->first_pressure);
    }
}

static size_t film_cells_of(const rf_oil_cells *cells, size_t i)
{
    size_t count = 0;
    for (size_t j = 0; j < cells->nodes; ++j)
        count += cells->opening[i * cells->nodes + j] == RF_FILM_CELL;
    return count;
}

static size_t line_to_cut(const rf_oil_cells *cells)
{
    size_t best = 0, fewest = cells->nodes + 1;
    for (size_t i = 0; i < cells->lines; ++i) {
        const size_t count = film_cells_of(cells, i);
        if (count < fewest) {
            best = i;
            fewest = count;
        }
    }
    return best;
}

static void set_entries(const rf_oil_cells *cells, rf_oil_places *places, const rf_border_band *band, size_t q)
{
    const size_t nodes = cells->nodes, all = cells->lines * nodes, j = q % nodes;
    const size_t beyond = q + nodes < all ? q + nodes : q + nodes - all, before = q >= nodes ? q - nodes : q + all - nodes;
    const size_t rows[RF_OIL_ENTRIES] = {q, beyond, before, j > 0 ? q - 1 : all, j + 1 < nodes ? q + 1 : all};
    for (size_t k = 0; k < RF_OIL_ENTRIES; ++k) {
        const int stands = rows[k] < all && places->place[q] >= 0 && places->place[rows[k]] >= 0;
        const size_t row = stands ? (size_t)places->place[rows[k]] : 0;
        places->entry[RF_OIL_ENTRIES * q + k] =
            stands ? (int32_t)rf_band_place(band, row, (size_t)places->place[q]) : -1;
    }
}

void rf_place_oil(const rf_oil_cells *cells, rf_oil_places *places, rf_border_band *band)
{
    const size_t nodes = cells->nodes, all = cells->lines * nodes;
    const size_t cut = line_to_cut(cells), first = (cut + 1) * nodes;
    size_t beside = film_cells_of(cells, cut), border = 0;
    places->cut = cut;
    band->size = all - nodes;
    band->half = nodes;
    for (size_t q = 0; q < all; ++q) {
        const int32_t opening = cells->opening[q];
        if (opening == RF_FILM_CELL)
            places->place[q] =
                (int32_t)(q / nodes == cut ? band->size + border++ : (q >= first ? q - first : q + all - first));
        else if (cells->fed[opening])
            places->place[q] = (int32_t)(band->size + beside + (size_t)opening);
        else
            places->place[q] = -1;
    }
    for (size_t k = 0; k < cells->openings; ++k)
        if (cells->fed[k])
            beside = border + cells->openings;
    band->border = beside;
    for (size_t q = 0; q < all; ++q)
        set_entries(cells, places, band, q);
}

/* The column of a cell: what leaves it for each of its neighbors, in proportion to its unknown, and what it stores. */
static void add_cell(const rf_oil_cells *cells, const int32_t *entry, size_t q, double by_pressure, double by_theta,
                     double *rows)
{
    const size_t nodes = cells->nodes, all = cells->lines * nodes;
    const size_t before = q >= nodes ? q - nodes : q + all - nodes;
    const double *along = cells->along + q + q / nodes;
    const double carried = by_theta * fabs(cells->wedge[cells->backward ? before : q]);
    double onward = by_pressure * cells->around[q], back = by_pressure * cells->around[before];
    *(cells->backward ? &back : &onward) += carried;
    const double values[RF_OIL_ENTRIES] = {
        onward + back + by_pressure * (along[0] + along[1]) + by_theta * cells->store[q],
        -onward,
        -back,
        -by_pressure * along[0],
        -by_pressure * along[1],
    };
    for (size_t k = 0; k < RF_OIL_ENTRIES; ++k)
        if (entry[k] >= 0)
            rows[entry[k]] += values[k];
}

/* Rows that stand for no cell: those of held cells in the band, and of openings that are held. */
static void fill_empty_rows(const rf_oil_cells *cells, size_t cut, rf_border_band *band)
{
    const size_t nodes = cells->nodes, all = cells->lines * nodes, first = (cut + 1) * nodes;
    for (size_t p = 0, q = first < all ? first : 0; p < band->size; ++p, q = q + 1 < all ? q + 1 : 0)
        if (cells->opening[q] != RF_FILM_CELL)
            band->rows[rf_band_place(band, p, p)] = 1.0;
    for (size_t b = film_cells_of(cells, cut); b < band->border; ++b)
        if (!cells->fed[b - film_cells_of(cells, cut)])
            band->rows[rf_band_place(band, band->size + b, band->size + b)] = 1.0;
}

void rf_set_oil_matrix(const rf_oil_cells *cells, const rf_oil_places *places, const double *by_pressure,
                       const double *by_theta, const double *real, const double *imaginary, rf_border_band *band)
{
    const size_t numbers = rf_band_numbers(band);
    memset(band->rows, 0, numbers * sizeof(double));
    if (band->imaginary_rows)
        memset(band->imaginary_rows, 0, numbers * sizeof(double));
    for (size_t q = 0; q < cells->lines * cells->nodes; ++q) {
        const int32_t *entry = places->entry + RF_OIL_ENTRIES * q;
        if (places->place[q] < 0)
            continue;
        add_cell(cells, entry, q, by_pressure[q], by_theta[q], band->rows);
        if (real)
            band->rows[entry[0]] += by_theta[q] * real[q];
        if (imaginary)
            band->imaginary_rows[entry[0]] += by_theta[q] * imaginary[q];
    }
    fill_empty_rows(cells, places->cut, band);
}
