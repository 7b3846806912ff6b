#include "coarser_oil.h"

#include <stdlib.h>

#include "../status.h"

#define FEWEST_LINES 16

int rf_has_coarser_oil(const rf_oil_cells *fine)
{
    return fine->lines % 2 == 0 && fine->nodes % 2 == 0 && fine->lines >= FEWEST_LINES;
}

/* Of a line and half of those beside it, their numbers one stride apart. */
static double around_line(const rf_oil_cells *fine, const double *numbers, size_t i, size_t stride)
{
    const size_t before = i > 0 ? i - 1 : fine->lines - 1;
    return numbers[i * stride] + 0.5 * (numbers[before * stride] + numbers[(i + 1) * stride]);
}

static double in_series(const double *c, size_t j, size_t nodes)
{
    const double within = 1.0 / c[j] + 0.5 / c[j - 1];
    return 1.0 / (j + 1 < nodes ? within + 0.5 / c[j + 1] : within);
}

static void set_lines(const rf_oil_cells *fine, double *along, double *store, double *center)
{
    for (size_t i = 0; i < fine->lines; i += 2) {
        const double first = fine->center[i];
        *along++ = around_line(fine, fine->along, i, 1);
        *store++ = around_line(fine, fine->store, i, 1);
        *center++ = first > 0.0 ? 1.0 / (1.0 / first + 0.5 / fine->conductance[i * fine->nodes]) : 0.0;
    }
}

/* Two faces one behind the other in series; two beside each other share what flows by their widths. */
static void set_faces(const rf_oil_cells *fine, double *wedge, double *around)
{
    const size_t nodes = fine->nodes;
    for (size_t i = 0; i < fine->lines; i += 2)
        for (size_t j = 0; j < nodes; j += 2, ++wedge, ++around) {
            const double whole = fine->width[j] + fine->width[j + 1];
            *wedge = *around = 0.0;
            for (size_t k = j; k < j + 2; ++k) {
                const size_t here = i * nodes + k, beyond = here + nodes;
                const double share = fine->width[k] / whole, both = fine->around[here] + fine->around[beyond];
                *wedge += share * 0.5 * (fine->wedge[here] + fine->wedge[beyond]);
                *around += both > 0.0 ? share * fine->around[here] * fine->around[beyond] / both : 0.0;
            }
        }
}

static void set_cells(const rf_oil_cells *fine, double *conductance, double *old, int32_t *opening)
{
    const size_t nodes = fine->nodes;
    for (size_t i = 0; i < fine->lines; i += 2)
        for (size_t j = 0; j < nodes; j += 2) {
            *conductance++ = in_series(fine->conductance + i * nodes, j + 1, nodes);
            *opening++ = fine->opening[i * nodes + j];
            if (fine->old)
                *old++ = around_line(fine, fine->old + j, i, nodes) + around_line(fine, fine->old + j + 1, i, nodes);
        }
}

int rf_open_coarser_oil(rf_coarser_oil *coarser, const rf_oil_cells *fine, const double *pressure,
                        const double *theta)
{
    const size_t n = fine->lines / 2, m = fine->nodes / 2, all = n * m;
    double *lines = malloc((3 * n + m + 6 * all) * sizeof(double) + all * (sizeof(int32_t) + 1));
    coarser->memory = lines;
    if (!lines)
        return RF_MEMORY;
    double *width = lines + 3 * n, *wedge = width + m, *around = wedge + all;
    double *conductance = around + all, *old = conductance + all;
    coarser->pressure = old + all;
    coarser->theta = coarser->pressure + all;
    int32_t *opening = (int32_t *)(coarser->theta + all);
    coarser->full = (uint8_t *)(opening + all);
    set_lines(fine, lines, lines + n, lines + 2 * n);
    set_faces(fine, wedge, around);
    set_cells(fine, conductance, old, opening);
    for (size_t j = 0; j < m; ++j)
        width[j] = fine->width[2 * j] + fine->width[2 * j + 1];
    for (size_t q = 0; q < all; ++q) {
        coarser->pressure[q] = pressure[2 * (q / m) * fine->nodes + 2 * (q % m)];
        coarser->theta[q] = theta[2 * (q / m) * fine->nodes + 2 * (q % m)];
    }
    coarser->cells = *fine;
    coarser->cells.lines = n;
    coarser->cells.nodes = m;
    coarser->cells.wedge = wedge;
    coarser->cells.around = around;
    coarser->cells.along = lines;
    coarser->cells.store = lines + n;
    coarser->cells.center = lines + 2 * n;
    coarser->cells.width = width;
    coarser->cells.conductance = conductance;
    coarser->cells.old = fine->old ? old : NULL;
    coarser->cells.opening = opening;
    return RF_OK;
}

void rf_close_coarser_oil(rf_coarser_oil *coarser)
{
    free(coarser->memory);
}

void rf_refine_full(const rf_coarser_oil *coarser, uint8_t *full)
{
    const size_t m = coarser->cells.nodes, nodes = 2 * m;
    for (size_t q = 0; q < 2 * coarser->cells.lines * nodes; ++q)
        full[q] = coarser->full[q / nodes / 2 * m + q % nodes / 2];
}
