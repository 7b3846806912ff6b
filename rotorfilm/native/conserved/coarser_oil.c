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

/* From the middle of a pair to that of the next one, or to the end. */
static double in_series(const double *along, size_t face, size_t nodes)
{
    double resistance = 1.0 / along[face];
    if (face > 0)
        resistance += 0.5 / along[face - 1];
    if (face < nodes)
        resistance += 0.5 / along[face + 1];
    return along[face] > 0.0 ? 1.0 / resistance : 0.0;
}

/* Two faces one behind the other in series; two beside each other add up. */
static void set_faces(const rf_oil_cells *fine, double *wedge, double *around)
{
    const size_t nodes = fine->nodes;
    for (size_t i = 0; i < fine->lines; i += 2)
        for (size_t j = 0; j < nodes; j += 2, ++wedge, ++around) {
            *wedge = *around = 0.0;
            for (size_t here = i * nodes + j; here < i * nodes + j + 2; ++here) {
                const size_t beyond = here + nodes;
                const double both = fine->around[here] + fine->around[beyond];
                *wedge += 0.5 * (fine->wedge[here] + fine->wedge[beyond]);
                *around += both > 0.0 ? fine->around[here] * fine->around[beyond] / both : 0.0;
            }
        }
}

static void set_cells(const rf_oil_cells *fine, double *store, double *old, int32_t *opening)
{
    const size_t nodes = fine->nodes;
    for (size_t i = 0; i < fine->lines; i += 2)
        for (size_t j = 0; j < nodes; j += 2) {
            *opening++ = fine->opening[i * nodes + j];
            *store++ = around_line(fine, fine->store + j, i, nodes) + around_line(fine, fine->store + j + 1, i, nodes);
            if (fine->old)
                *old++ = around_line(fine, fine->old + j, i, nodes) + around_line(fine, fine->old + j + 1, i, nodes);
        }
}

/* Of the lines beside each other that become one. */
static void set_along(const rf_oil_cells *fine, double *along)
{
    const size_t stride = fine->nodes + 1;
    for (size_t i = 0; i < fine->lines; i += 2)
        for (size_t face = 0; face <= fine->nodes; face += 2) {
            const double *line = fine->along + i * stride, *before = line + (i > 0 ? 0 : fine->lines * stride) - stride;
            *along++ = in_series(line, face, fine->nodes)
                       + 0.5 * (in_series(before, face, fine->nodes) + in_series(line + stride, face, fine->nodes));
        }
}

int rf_open_coarser_oil(rf_coarser_oil *coarser, const rf_oil_cells *fine, const double *pressure,
                        const double *theta)
{
    const size_t n = fine->lines / 2, m = fine->nodes / 2, all = n * m;
    double *wedge = malloc((n + 7 * all) * sizeof(double) + all * (sizeof(int32_t) + 1));
    coarser->memory = wedge;
    if (!wedge)
        return RF_MEMORY;
    double *around = wedge + all, *store = around + all, *old = store + all, *along = old + all;
    coarser->pressure = along + all + n;
    coarser->theta = coarser->pressure + all;
    int32_t *opening = (int32_t *)(coarser->theta + all);
    coarser->full = (uint8_t *)(opening + all);
    set_faces(fine, wedge, around);
    set_cells(fine, store, old, opening);
    set_along(fine, along);
    for (size_t q = 0; q < all; ++q) {
        coarser->pressure[q] = pressure[2 * (q / m) * fine->nodes + 2 * (q % m)];
        coarser->theta[q] = theta[2 * (q / m) * fine->nodes + 2 * (q % m)];
    }
    coarser->cells = *fine;
    coarser->cells.lines = n;
    coarser->cells.nodes = m;
    coarser->cells.wedge = wedge;
    coarser->cells.around = around;
    coarser->cells.store = store;
    coarser->cells.along = along;
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
