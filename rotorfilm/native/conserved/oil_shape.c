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

int rf_open_oil(rf_oil_equations *equations, const rf_oil_shape *shape, const rf_oil_gap *gap, double rate)
{
    const size_t n = shape->lines, m = shape->nodes, all = n * m;
    double *at = calloc(4 * n + 3 * all, sizeof *at);
    equations->memory = at;
    if (!at)
        return RF_MEMORY;
    equations->along = at;
    equations->store = at + n;
    equations->extent = at + 2 * n;
    equations->center = at + 3 * n;
    equations->wedge = at + 4 * n;
    equations->around = equations->wedge + all;
    equations->old = equations->around + all;
    for (size_t i = 0; i < n; ++i) {
        const double h = gap->line[i], extent = extent_of(shape, i);
        equations->extent[i] = extent;
        equations->along[i] = h * h * h * extent / (shape->slenderness * shape->slenderness);
        equations->center[i] = shape->center;
        for (size_t q = i * m; q < (i + 1) * m; ++q) {
            equations->wedge[q] = rate * gap->face[i];
            equations->around[q] = gap->cube[i] / shape->spacing[i];
        }
    }
    const rf_oil_cells cells = {
        n,
        shape->nodes,
        equations->wedge,
        equations->around,
        equations->along,
        equations->store,
        shape->width,
        shape->conductance,
        equations->center,
        shape->center_pressure,
        shape->end_pressure,
        NULL,
        shape->opening,
        shape->fed,
        shape->flow,
        shape->openings,
        rate < 0.0,
    };
    equations->cells = cells;
    return RF_OK;
}

void rf_close_oil(rf_oil_equations *equations)
{
    free(equations->memory);
}

void rf_store_oil(rf_oil_equations *equations, const rf_oil_gap *gap, double rate)
{
    for (size_t i = 0; i < equations->cells.lines; ++i)
        equations->store[i] = rate * gap->line[i] * equations->extent[i];
    equations->cells.old = equations->old;
}

void rf_hold_openings(const rf_oil_shape *shape, double *pressure, double *theta)
{
    for (size_t q = 0; q < shape->lines * shape->nodes; ++q) {
        const int32_t k = shape->opening[q];
        pressure[q] = k != RF_FILM_CELL && !shape->fed[k] ? shape->pressure[k] : 0.0;
        theta[q] = 1.0;
    }
}

rf_oil_gap rf_circular_gap(const rf_oil_shape *shape, const double *eccentricity, double *numbers)
{
    const size_t n = shape->lines;
    const rf_oil_gap gap = {numbers, numbers + n, numbers + 2 * n};
    for (size_t i = 0; i < n; ++i) {
        const double *at = shape->direction + i;
        const double face = 1.0 - (eccentricity[0] * at[2 * n] + eccentricity[1] * at[3 * n]);
        numbers[i] = 1.0 - (eccentricity[0] * at[0] + eccentricity[1] * at[n]);
        numbers[n + i] = face;
        numbers[2 * n + i] = face * face * face;
    }
    return gap;
}

static double onto_journal(const rf_oil_shape *shape, const double *pressure, const double *direction)
{
    double sum = 0.0;
    for (size_t i = 0; i < shape->lines; ++i) {
        double along = 0.0;
        for (size_t j = 0; j < shape->nodes; ++j)
            along += shape->width[j] * (pressure[i * shape->nodes + j] - shape->end_pressure);
        sum += direction[i] * extent_of(shape, i) * along;
    }
    return -12.0 * sum;
}

/* Through the ends, out and in. */
static void set_end_flows(const rf_oil_cells *cells, const double *pressure, double *sums)
{
    for (size_t i = 0; i < cells->lines; ++i) {
        const size_t q = i * cells->nodes + cells->nodes - 1;
        const double fall = pressure[q] - cells->end_pressure;
        if (fabs(fall) <= ROUNDOFF * cells->end_pressure)
            continue;
        sums[fall > 0.0 ? RF_OIL_OUT : RF_OIL_DRAWN_IN] += fabs(cells->along[i] * cells->conductance[q] * fall);
    }
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
    set_end_flows(cells, pressure, sums);
    rf_oil_outflow(cells, pressure, theta, outflow);
    for (size_t q = 0; q < n * m; ++q) {
        sums[RF_OIL_INFLOW] += shape->opening[q] != RF_FILM_CELL ? outflow[q] : 0.0;
        sums[RF_OIL_VOLUME] += theta[q] * gap->line[q / m] * extent_of(shape, q / m) * shape->width[q % m];
    }
    for (size_t i = 0; i < n; ++i)
        sums[RF_OIL_INFLOW] += cells->along[i] * cells->center[i] * (cells->center_pressure - pressure[i * m]);
    free(outflow);
    return RF_OK;
}
