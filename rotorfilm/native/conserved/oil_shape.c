#include "oil_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../status.h"

#define ROUNDOFF 1e-12 /* of the pressure at the ends, that of the film beside them: nothing flows there */

static double extent_of(const rf_oil_shape *shape, size_t i)
{
    return 0.5 * (shape->spacing[i] + shape->spacing[i > 0 ? i - 1 : shape->lines - 1]);
}

double rf_cell_area(const rf_oil_shape *shape, size_t q)
{
    return extent_of(shape, q / shape->nodes) * shape->width[q % shape->nodes];
}

rf_oil_gap rf_gap_in(const rf_oil_shape *shape, const double *numbers)
{
    const size_t all = shape->lines * shape->nodes;
    const rf_oil_gap gap = {numbers, numbers + all, numbers + 2 * all};
    return gap;
}

static double at(const double *direction, size_t lines, double full, const double *e)
{
    return full - (e[0] * direction[0] + e[1] * direction[lines]);
}

void rf_circular_gap(const rf_oil_shape *shape, double full, const double *place, double *numbers)
{
    const size_t n = shape->lines, m = shape->nodes;
    double *line = numbers, *face = line + n * m, *side = face + n * m;
    for (size_t i = 0; i < n; ++i, side += m + 1) {
        const double *here = shape->direction + i, *beyond = here + 2 * n;
        const double tilt = at(here, n, 0.0, place + 2), onward = at(beyond, n, 0.0, place + 2);
        const double mean = at(here, n, full, place), means = at(beyond, n, full, place);
        double z = shape->whole ? -1.0 : 0.0;
        side[0] = mean + z * tilt;
        for (size_t j = 0; j < m; ++j) {
            const double half = (shape->whole ? 1.0 : 0.5) * shape->width[j];
            line[i * m + j] = mean + (z + half) * tilt;
            face[i * m + j] = means + (z + half) * onward;
            z += 2.0 * half;
            side[j + 1] = mean + z * tilt;
        }
    }
}

static double cube(const double *gap, const double *slope, size_t k)
{
    return slope ? 3.0 * gap[k] * gap[k] * slope[k] : gap[k] * gap[k] * gap[k];
}

void rf_set_oil(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_gap *slope, double rate, double storing,
                rf_oil_cells *cells, double *numbers)
{
    const size_t n = shape->lines, m = shape->nodes, all = n * m;
    const rf_oil_gap linear = slope ? *slope : *gap, none = {NULL, NULL, NULL}, by = slope ? *slope : none;
    const double covered = (shape->whole ? 2.0 : 1.0) * shape->slenderness, square = covered * covered;
    double *wedge = numbers, *around = wedge + all, *store = around + all, *along = store + all;
    for (size_t q = 0, side = 0; q < all; ++q, ++side) {
        const size_t i = q / m, j = q % m;
        const double extent = extent_of(shape, i), ease = shape->around ? shape->around[q] : 1.0;
        wedge[q] = rate * (shape->dragged ? linear.face[q] * shape->dragged[q] : linear.face[q]) * shape->width[j];
        around[q] = cube(gap->face, by.face, q) / shape->spacing[i] * ease * shape->width[j];
        store[q] = storing * linear.line[q] * extent * shape->width[j];
        if (j == 0) {
            along[side] = cube(gap->side, by.side, side) * extent / square * shape->along[side];
            ++side;
        }
        along[side] = cube(gap->side, by.side, side) * extent / square * shape->along[side];
    }
    const rf_oil_cells set = {
        n, m, shape->openings, wedge, around, store, along, NULL, shape->first_pressure, shape->last_pressure,
        shape->opening, shape->fed, shape->flow, rate < 0.0,
    };
    *cells = set;
}

void rf_hold_openings(const rf_oil_shape *shape, double *pressure, double *theta)
{
    for (size_t q = 0; q < shape->lines * shape->nodes; ++q) {
        const int32_t k = shape->opening[q];
        pressure[q] = k != RF_FILM_CELL && !shape->fed[k] ? shape->pressure[k] : 0.0;
        theta[q] = 1.0;
    }
}

static double onto_journal(const rf_oil_shape *shape, const double *pressure, const double *direction)
{
    double sum = 0.0;
    for (size_t i = 0; i < shape->lines; ++i) {
        double along = 0.0;
        for (size_t j = 0; j < shape->nodes; ++j)
            along += shape->width[j] * (pressure[i * shape->nodes + j] - shape->last_pressure);
        sum += direction[i] * extent_of(shape, i) * along;
    }
    return -12.0 * sum;
}

/* Through an end of the film, out and in. */
static void add_end_flow(double conductance, double pressure, double outside, double *sums)
{
    const double fall = pressure - outside;
    if (fabs(fall) > ROUNDOFF * outside)
        sums[fall > 0.0 ? RF_OIL_OUT : RF_OIL_DRAWN_IN] += fabs(conductance * fall);
}

int rf_oil_sums(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells, const double *pressure,
                const double *theta, double *sums)
{
    const size_t n = shape->lines, m = shape->nodes;
    double *outflow = malloc(n * m * sizeof *outflow);
    if (!outflow)
        return RF_MEMORY;
    memset(sums, 0, RF_OIL_SUMS * sizeof *sums);
    for (size_t k = 0; k < 2; ++k)
        sums[RF_OIL_FORCE + k] = onto_journal(shape, pressure, shape->direction + k * n);
    rf_oil_outflow(cells, pressure, theta, outflow);
    for (size_t q = 0; q < n * m; ++q) {
        sums[RF_OIL_INFLOW] += shape->opening[q] != RF_FILM_CELL ? outflow[q] : 0.0;
        sums[RF_OIL_VOLUME] += theta[q] * gap->line[q] * rf_cell_area(shape, q);
    }
    for (size_t i = 0; i < n; ++i) {
        const double *along = cells->along + i * (m + 1), *p = pressure + i * m;
        add_end_flow(along[m], p[m - 1], cells->last_pressure, sums);
        if (shape->whole)
            add_end_flow(along[0], p[0], cells->first_pressure, sums);
        else
            sums[RF_OIL_INFLOW] += along[0] * (cells->first_pressure - p[0]);
    }
    free(outflow);
    return RF_OK;
}

int rf_oil_slopes(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, double storing, const double *pressure,
                  const double *theta, size_t freedoms, double *moved, double *held)
{
    const size_t all = shape->lines * shape->nodes;
    double *numbers = malloc((rf_gap_numbers(shape) + rf_equation_numbers(shape)) * sizeof *numbers);
    if (!numbers)
        return RF_MEMORY;
    for (size_t k = 0; k < freedoms; ++k) {
        double place[RF_OIL_FREEDOMS] = {0.0};
        rf_oil_cells cells;
        place[k] = 1.0;
        rf_circular_gap(shape, 0.0, place, numbers);
        const rf_oil_gap slope = rf_gap_in(shape, numbers);
        rf_set_oil(shape, gap, &slope, rate, storing, &cells, numbers + rf_gap_numbers(shape));
        rf_oil_outflow(&cells, pressure, theta, moved + k * all);
        for (size_t q = 0; q < all; ++q)
            held[k * all + q] = theta[q] * rf_cell_area(shape, q) * slope.line[q];
    }
    free(numbers);
    return RF_OK;
}
