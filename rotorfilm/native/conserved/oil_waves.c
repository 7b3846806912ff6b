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

#define KEEPS 1e30 /* storage of cells that keep their oil */

static int is_film(const rf_oil_cells *cells, const uint8_t *full, size_t q, int filled)
{
    return cells->opening[q] == RF_FILM_CELL && (full[q] != 0) == filled;
}

static size_t one_line_back(const rf_oil_cells *cells, size_t q)
{
    return q < cells->nodes ? q + (cells->lines - 1) * cells->nodes : q - cells->nodes;
}

static size_t one_line_on(const rf_oil_cells *cells, size_t q)
{
    const size_t all = cells->lines * cells->nodes;
    return q + cells->nodes < all ? q + cells->nodes : q + cells->nodes - all;
}

static size_t upstream(const rf_oil_cells *cells, size_t q)
{
    return cells->backward ? one_line_on(cells, q) : one_line_back(cells, q);
}

/* What a full gap carries into a cell, and out of it. */
static double carried_in(const rf_oil_cells *cells, size_t q)
{
    return fabs(cells->wedge[cells->backward ? q : one_line_back(cells, q)]);
}

static double carried_out(const rf_oil_cells *cells, size_t q)
{
    return fabs(cells->wedge[cells->backward ? one_line_back(cells, q) : q]);
}

/* The first line of a column that is not of the cavity; the number of lines where all are. */
static size_t first_line(const rf_oil_cells *cells, const uint8_t *full, size_t column)
{
    size_t i = 0;
    while (i < cells->lines && is_film(cells, full, i * cells->nodes + column, 0))
        ++i;
    return i;
}

static int size_cavity(const rf_oil_cells *cells, const uint8_t *full, rf_oil_cavity *cavity)
{
    cavity->cells = cavity->inlets = 0;
    for (size_t q = 0; q < cells->lines * cells->nodes; ++q) {
        cavity->cells += (size_t)is_film(cells, full, q, 0);
        cavity->inlets += (size_t)(is_film(cells, full, q, 1) && is_film(cells, full, upstream(cells, q), 0));
    }
    for (size_t j = 0; j < cells->nodes; ++j)
        if (first_line(cells, full, j) == cells->lines)
            return RF_STUCK;
    return RF_OK;
}

/* Put the cells of the cavity in the order of the flow: `cell` has their places in the film, and `rank` theirs there. */
static void put_in_order(const rf_oil_cells *cells, const uint8_t *full, int32_t *cell, int32_t *rank)
{
    const size_t lines = cells->lines, along = cells->nodes;
    int32_t count = 0, *first = rank + lines * along;
    for (size_t q = 0; q < lines * along; ++q)
        rank[q] = -1;
    for (size_t j = 0; j < along; ++j)
        first[j] = (int32_t)first_line(cells, full, j);
    for (size_t d = 0; d < lines; ++d)
        for (size_t j = 0; j < along; ++j) {
            const size_t i = (size_t)first[j] + (cells->backward ? lines - d : d);
            const size_t q = (i < lines ? i : i - lines) * along + j;
            if (!is_film(cells, full, q, 0))
                continue;
            cell[count] = (int32_t)q;
            rank[q] = count++;
        }
}

/* Twice the speed with which the walls carry the oil of each cell, the largest where it is the same. */
static void set_carrying(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells, double *carrying)
{
    const size_t all = cells->lines * cells->nodes;
    double least = HUGE_VAL, most = 0.0;
    for (size_t q = 0; q < all; ++q) {
        carrying[q] = 2.0 * fabs(cells->wedge[q]) / (gap->face[q] * shape->width[q % cells->nodes]);
        least = fmin(least, carrying[q]);
        most = fmax(most, carrying[q]);
    }
    for (size_t q = 0; q < all && most - least <= 1e-12 * most; ++q)
        carrying[q] = most;
}

/* What leaves a cell less by the pressure of its neighbors. */
static double pressed(const rf_oil_cells *cells, size_t q, const double *change)
{
    const size_t along = cells->nodes, j = q % along, back = one_line_back(cells, q);
    const double *faces = cells->along + q / along * (along + 1) + j;
    return cells->around[back] * change[back] + cells->around[q] * change[one_line_on(cells, q)]
           + (j > 0 ? faces[0] * change[q - 1] : 0.0) + (j + 1 < along ? faces[1] * change[q + 1] : 0.0);
}

/* Set columns to 0 outside the full film. */
static void keep_film(const rf_oil_cells *cells, const uint8_t *full, size_t columns, double *right)
{
    const size_t all = cells->lines * cells->nodes;
    for (size_t k = 0; k < columns; ++k, right += all)
        for (size_t q = 0; q < all; ++q)
            right[q] = is_film(cells, full, q, 1) ? right[q] : 0.0;
}

int rf_set_oil_cavity(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells, double rate,
                      const uint8_t *full, const double *pressure, const double *theta, const double *weights,
                      rf_oil_cavity *cavity, double *numbers, int32_t *places)
{
    if (!numbers)
        return size_cavity(cells, full, cavity);
    const size_t all = cells->lines * cells->nodes, count = cavity->cells, m = cavity->inlets, n = cavity->freedoms;
    const size_t columns = m + 2 * n;
    double *right = calloc((columns + 2) * all, sizeof *right), *keeps = right + columns * all, *speed = keeps + all;
    int32_t *rank = malloc((all + cells->nodes + count) * sizeof *rank), *cell = rank + all + cells->nodes, *up = places, *inlet = places + count;
    if (!right || !rank) {
        free(right);
        free(rank);
        return RF_MEMORY;
    }
    double *own = numbers, *flow = own + count, *room = flow + count, *turn = room + count, *carrying = turn + count;
    double *source = carrying + count, *felt = source + count * columns;
    put_in_order(cells, full, cell, rank);
    set_carrying(shape, gap, cells, speed);
    int status = rf_oil_slopes(shape, gap, rate, 0.0, pressure, theta, n, right + m * all, right + (m + n) * all);
    for (size_t q = m * all; q < columns * all; ++q)
        right[q] = -right[q];
    for (size_t q = 0, i = 0; q < all; ++q) {
        const int32_t before = rank[upstream(cells, q)];
        keeps[q] = rank[q] >= 0 ? KEEPS : 0.0;
        if (!is_film(cells, full, q, 1) || before < 0)
            continue;
        right[i * all + q] = carried_in(cells, q);
        inlet[i++] = before;
    }
    for (size_t c = 0; c < count; ++c) {
        const size_t q = (size_t)cell[c], i = q / cells->nodes;
        up[c] = rank[upstream(cells, q)];
        own[c] = carried_out(cells, q) + cells->store[q];
        flow[c] = carried_in(cells, q);
        room[c] = gap->line[q] * rf_cell_area(shape, q);
        turn[c] = shape->spacing[i] + shape->spacing[i > 0 ? i - 1 : cells->lines - 1];
        carrying[c] = speed[q];
        for (size_t k = 0; k < columns; ++k)
            source[c * columns + k] = right[k * all + q];
    }
    keep_film(cells, full, columns, right);
    if (status == RF_OK)
        status = rf_oil_response(cells, full, keeps, NULL, NULL, columns, right, NULL);
    keep_film(cells, full, columns, right);
    for (size_t c = 0; c < count; ++c)
        for (size_t k = 0; k < columns; ++k)
            source[c * columns + k] += pressed(cells, (size_t)cell[c], right + k * all);
    for (size_t i = 0; i < cavity->forces; ++i)
        for (size_t k = 0; k < columns; ++k, ++felt) {
            *felt = 0.0;
            for (size_t q = 0; q < all; ++q)
                *felt += 12.0 * weights[i * all + q] * right[k * all + q];
        }
    const rf_oil_cavity made = {count, m, n, cavity->forces, up, inlet, own, flow, room, turn, carrying, source,
                                source + count * columns};
    *cavity = made;
    free(right);
    free(rank);
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
