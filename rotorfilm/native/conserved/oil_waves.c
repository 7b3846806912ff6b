#include "oil_waves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../grids/clones.h"
#include "../solvers/dense.h"
#include "../status.h"
#include "oil_search.h"

int rf_oil_slow(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells, double rate,
                const uint8_t *full, const double *pressure, const double *theta, size_t freedoms, size_t forces,
                const double *weights, double *found)
{
    const size_t all = shape->lines * shape->nodes, count = freedoms + 1;
    double *right = calloc(2 * (count + 1) * all + rf_equation_numbers(shape), sizeof *right);
    if (!right)
        return RF_MEMORY;
    double *none = right + 2 * count * all, *room = none + all, *by_speed = right + freedoms * all;
    rf_oil_cells by_rate;
    int status = rf_oil_slopes(shape, gap, rate, 0.0, pressure, theta, freedoms, right, right + count * all);
    rf_set_oil_by_rate(shape, gap, rate, &by_rate, room + all);
    rf_oil_outflow(&by_rate, pressure, theta, by_speed);
    for (size_t q = 0; q < all; ++q) {
        by_speed[q] *= 0.5;
        room[q] = full[q] ? 0.0 : gap->line[q] * rf_cell_area(shape, q);
    }
    for (size_t q = 0; q < 2 * count * all; ++q)
        right[q] = -right[q];
    if (status == RF_OK)
        status = rf_oil_response(cells, full, none, NULL, room, count, right, NULL);
    for (size_t i = 0; i < forces; ++i)
        for (size_t k = 0; k < 2 * count; ++k, ++found) {
            *found = 0.0;
            for (size_t q = 0; q < all; ++q)
                *found += full[q] ? 12.0 * weights[i * all + q] * right[k * all + q] : 0.0;
        }
    free(right);
    return status;
}

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

/* Of each cell, what it stores beyond its own at s, and the derivative of that by s. */
static void set_storage(const rf_oil_cavity *cavity, const double *s, int blurred, double *storage)
{
    double wave[4] = {s[0], s[1], 1.0, 0.0}, turn = 0.0, carrying = 0.0;
    for (size_t c = 0; c < cavity->cells; ++c, storage += 4) {
        if (!blurred && (cavity->turn[c] != turn || cavity->carrying[c] != carrying)) {
            turn = cavity->turn[c];
            carrying = cavity->carrying[c];
            const double size = turn * hypot(s[0], s[1]);
            const double share = size > 0.0 && size <= carrying ? turn / carrying : 0.0;
            const double grown = share * s[0], phase = share * s[1], half = sin(0.5 * phase), growth = exp(grown);
            wave[0] = share > 0.0 ? (expm1(grown) * cos(phase) - 2.0 * half * half) / share : s[0];
            wave[1] = share > 0.0 ? growth * sin(phase) / share : s[1];
            wave[2] = growth * cos(phase);
            wave[3] = growth * sin(phase);
        }
        for (size_t k = 0; k < 4; ++k)
            storage[k] = cavity->room[c] * wave[k];
    }
}

/* Rows of a cell: the change, what comes of it, and two of sources. */
RF_CLONES_OF_OIL
static void go_through(size_t cells, size_t columns, const int32_t *up, const double *own, const double *flow,
                       const double *source, const double *storage, double *rows)
{
    const size_t pair = 2 * columns;
    double *given = rows + 2 * pair * (cells + 1), *none = rows + 2 * pair * cells;
    memset(given, 0, pair * sizeof *given);
    memset(none, 0, 2 * pair * sizeof *none);
    for (size_t c = 0; c < cells; ++c) {
        const double *by = storage + 4 * c + 2, real = own[c] + storage[4 * c], imaginary = storage[4 * c + 1];
        const double square = real * real + imaginary * imaginary, inverse[2] = {real / square, -imaginary / square};
        const double *before = up[c] < 0 ? none : rows + 2 * pair * (size_t)up[c];
        double *row = rows + 2 * pair * c;
        memcpy(given, source + c * columns, columns * sizeof *given);
        pass(columns, inverse, flow[c], given, before, row);
        multiply(columns, by, row, given + pair);
        pass(columns, inverse, flow[c], given + pair, before + pair, row + pair);
    }
}

/* The work of one exponent, complex numbers as real and imaginary parts one after the other. With `first` and `second`
   what the columns change where the cavity ends and what comes of it, (1 - first) x = right is solved in real numbers. */
typedef struct inlets {
    size_t count, freedoms, columns;
    double *storage, *rows, *matrix, *spent, *moved, *late;
} inlets;

static const double *row_of(const inlets *self, const rf_oil_cavity *cavity, size_t i, size_t part)
{
    return self->rows + (2 * (size_t)cavity->inlet[i] + part) * 2 * self->columns;
}

/* (1 - first) over both parts. */
static void set_matrix(inlets *self, const rf_oil_cavity *cavity)
{
    const size_t m = self->count;
    for (size_t i = 0; i < m; ++i) {
        const double *first = row_of(self, cavity, i, 0), *imaginary = first + self->columns;
        for (size_t j = 0; j < m; ++j) {
            self->matrix[i * 2 * m + j] = self->matrix[(m + i) * 2 * m + m + j] = (i == j) - first[j];
            self->matrix[i * 2 * m + m + j] = imaginary[j];
            self->matrix[(m + i) * 2 * m + j] = -imaginary[j];
        }
    }
}

static void solve(inlets *self, double *right)
{
    memcpy(self->spent, self->matrix, 4 * self->count * self->count * sizeof *self->spent);
    rf_eliminate(2 * self->count, self->spent, self->freedoms, right);
}

/* sum += a b of complex numbers, b as pairs of parts at a distance */
static inline void add(double *real, double *imaginary, double a, double b, double c, double d)
{
    *real += a * c - b * d;
    *imaginary += a * d + b * c;
}

static void answer(inlets *self, const rf_oil_cavity *cavity, const double *s)
{
    const size_t m = self->count, n = self->freedoms, w = self->columns;
    double *moved = self->moved, *late = self->late;
    for (size_t i = 0; i < m; ++i) {
        const double *first = row_of(self, cavity, i, 0) + m;
        for (size_t k = 0; k < n; ++k) {
            double *real = moved + i * n + k, *imaginary = moved + (m + i) * n + k;
            *real = first[k];
            *imaginary = first[w + k];
            add(real, imaginary, s[0], s[1], first[n + k], first[w + n + k]);
        }
    }
    solve(self, moved);
    for (size_t i = 0; i < m; ++i) {
        const double *first = row_of(self, cavity, i, 0) + m, *second = row_of(self, cavity, i, 1);
        for (size_t k = 0; k < n; ++k) {
            double *real = late + i * n + k, *imaginary = late + (m + i) * n + k;
            *real = first[n + k] - second[m + k];
            *imaginary = first[w + n + k] - second[w + m + k];
            add(real, imaginary, -s[0], -s[1], second[m + n + k], second[w + m + n + k]);
            for (size_t j = 0; j < m; ++j)
                add(real, imaginary, -second[j], -second[w + j], moved[j * n + k], moved[(m + j) * n + k]);
        }
    }
    solve(self, late);
}

/* K(s) and dK/ds; returns whether they are finite. */
static int feel(const inlets *self, const rf_oil_cavity *cavity, const double *s, double *found)
{
    const size_t m = self->count, n = self->freedoms, pairs = cavity->forces * n;
    double sum = 0.0;
    for (size_t q = 0; q < pairs; ++q) {
        const double *felt = cavity->felt + q / n * self->columns;
        const double still = felt[m + q % n], rate = felt[m + n + q % n];
        double *K = found + 2 * q, *slope = found + 2 * (pairs + q);
        K[0] = still + s[0] * rate;
        K[1] = s[1] * rate;
        slope[0] = rate;
        slope[1] = 0.0;
        for (size_t j = 0; j < m; ++j)
            for (size_t part = 0; part < 2; ++part) {
                K[part] += felt[j] * self->moved[(part * m + j) * n + q % n];
                slope[part] += felt[j] * self->late[(part * m + j) * n + q % n];
            }
        sum += K[0] + K[1] + slope[0] + slope[1];
    }
    return isfinite(sum);
}

int rf_oil_motion(const rf_oil_cavity *cavity, const double *s, int blurred, double *found)
{
    const size_t m = cavity->inlets, n = cavity->freedoms, cells = cavity->cells, columns = m + 2 * n;
    inlets self = {.count = m, .freedoms = n, .columns = columns};
    double *memory = malloc((4 * cells + 4 * columns * (cells + 2) + 8 * m * m + 4 * m * n + 1) * sizeof *memory);
    if (!memory)
        return RF_MEMORY;
    self.storage = memory;
    self.rows = self.storage + 4 * cells;
    self.matrix = self.rows + 4 * columns * (cells + 2);
    self.spent = self.matrix + 4 * m * m;
    self.moved = self.spent + 4 * m * m;
    self.late = self.moved + 2 * m * n;
    set_storage(cavity, s, blurred, self.storage);
    go_through(cells, columns, cavity->up, cavity->own, cavity->flow, cavity->source, self.storage, self.rows);
    set_matrix(&self, cavity);
    answer(&self, cavity, s);
    const int known = feel(&self, cavity, s, found);
    free(memory);
    return known ? RF_OK : RF_STUCK;
}
