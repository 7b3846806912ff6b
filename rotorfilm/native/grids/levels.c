#include "levels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int rf_open_levels(rf_levels *levels, const rf_ring *ring)
{
    const rf_grid *finest = &ring->grids[0];
    const size_t all = finest->lines * finest->nodes;
    size_t numbers = 4 * all;
    for (int level = 0; level < ring->levels; ++level)
        numbers += rf_cells_size(ring, &ring->grids[level]);
    double *next = malloc(numbers * sizeof(double) + 3 * all);
    levels->ring = ring;
    levels->memory = next;
    levels->keeps = 0;
    memset(levels->search, 0, sizeof levels->search);
    if (!next)
        return RF_MEMORY;
    for (int level = 0; level < ring->levels; ++level) {
        rf_open_cells(&levels->cells[level], ring, &ring->grids[level], next);
        next += rf_cells_size(ring, &ring->grids[level]);
    }
    levels->source = next;
    levels->pressure = next + all;
    levels->answer = next + 2 * all;
    levels->flow = next + 3 * all;
    levels->full = (uint8_t *)(next + 4 * all);
    levels->held = levels->full + all;
    levels->known = levels->held + all;
    int status = RF_OK;
    for (int level = 0; level < ring->levels && status == RF_OK; ++level)
        status = rf_open_search(&levels->search[level], ring->grids[level].lines, ring->grids[level].nodes);
    return status;
}

void rf_close_levels(rf_levels *levels)
{
    for (int level = 0; level < levels->ring->levels; ++level)
        rf_close_search(&levels->search[level]);
    free(levels->memory);
}

void rf_place_journal(rf_levels *levels, const double *q, double rate)
{
    for (int level = 0; level < levels->ring->levels; ++level) {
        rf_set_cells(&levels->cells[level], q, rate);
        levels->search[level].keeps = 0;
    }
}

static size_t middle_of(const rf_ring *ring, const rf_grid *grid)
{
    return ring->whole ? grid->nodes / 2 : 0;
}

/* Hold nodes in openings at their pressure. */
static void hold(rf_levels *levels, const rf_grid *grid)
{
    const size_t nodes = grid->nodes, middle = middle_of(levels->ring, grid);
    memset(levels->held, 0, grid->lines * nodes);
    memset(levels->pressure, 0, grid->lines * nodes * sizeof(double));
    for (size_t i = 0; i < grid->lines; ++i)
        for (size_t j = 0; grid->held[i] > 0 && j < nodes; ++j)
            if ((j >= middle ? j - middle : middle - j) < (size_t)grid->held[i]) {
                levels->held[i * nodes + j] = 1;
                levels->pressure[i * nodes + j] = grid->value[i];
            }
}

/* Begin with the nodes where the source drives pressure, or the whole film. A step drives pressure far beyond what
   the smooth film makes, and a film that grows from its source gains one line an iteration. */
static void guess_full(rf_levels *levels, const rf_grid *grid)
{
    const rf_ring *ring = levels->ring;
    const int all = !ring->ruptured || ring->recess >= 0;
    for (size_t q = 0; q < grid->lines * grid->nodes; ++q)
        levels->full[q] = all || levels->source[q] > 0.0;
}

/* Nodes of the coarser grid on both sides of node j. */
static void nodes_beside(const rf_levels *levels, const rf_grid *grid, size_t j, size_t *near, size_t *far)
{
    const size_t odd = middle_of(levels->ring, grid) % 2, few = (grid + 1)->nodes;
    /* From the middle on every second node is one of the coarser grid. */
    *near = j < odd ? 0 : (j - odd) / 2;
    *far = (j + 1 - odd) / 2 < few ? (j + 1 - odd) / 2 : few - 1;
}

/* Begin with all nodes that see a full one of the next coarser grid. */
static void refine_full(rf_levels *levels, const rf_grid *grid)
{
    const rf_grid *coarser = grid + 1;
    const size_t nodes = grid->nodes, few = coarser->nodes;
    for (size_t i = 0; i < grid->lines; ++i) {
        const uint8_t *left = levels->known + (i / 2) * few;
        const uint8_t *right = levels->known + ((i + 1) / 2 % coarser->lines) * few;
        for (size_t j = 0; j < nodes; ++j) {
            size_t near, far;
            nodes_beside(levels, grid, j, &near, &far);
            levels->full[i * nodes + j] = left[near] || right[near] || left[far] || right[far];
        }
    }
}

static int search_level(rf_levels *levels)
{
    rf_search *search = &levels->search[levels->level];
    const int status = rf_search_film(search, &levels->film, levels->ring->ruptured, levels->pressure, levels->full);
    search->keeps = levels->keeps && status == RF_OK;
    return status;
}

int rf_solve_level(rf_levels *levels, int level, const double *drive)
{
    const rf_ring *ring = levels->ring;
    const rf_grid *grid = &ring->grids[level];
    const rf_cells *cells = &levels->cells[level];
    const rf_stencil film = {grid->lines, grid->nodes, cells->around, cells->along, ring->whole ? cells->entry : NULL,
                             levels->source, levels->held};
    levels->film = film;
    levels->level = level;
    rf_set_source(cells, drive, levels->source);
    hold(levels, grid);
    if (level + 1 < ring->levels && ring->ruptured)
        refine_full(levels, grid);
    else
        guess_full(levels, grid);
    const int status = search_level(levels);
    if (level > 0)
        memcpy(levels->known, levels->full, grid->lines * grid->nodes);
    return status;
}

int rf_solve_down_to(rf_levels *levels, int level, const double *drive)
{
    int status = RF_OK;
    for (int k = levels->ring->ruptured ? levels->ring->levels - 1 : level; k >= level && status == RF_OK; --k)
        status = rf_solve_level(levels, k, drive);
    return status;
}

int rf_solve_again(rf_levels *levels)
{
    for (size_t q = 0; q < levels->film.lines * levels->film.nodes; ++q)
        if (levels->held[q] && levels->full[q])
            levels->pressure[q] = 0.0;
    return search_level(levels);
}

void rf_take_force(rf_levels *levels, double *f)
{
    double products[RF_DRIVES];
    for (size_t q = 0; levels->ring->clipped && q < levels->film.lines * levels->film.nodes; ++q)
        levels->pressure[q] = fmax(levels->pressure[q], 0.0);
    rf_multiply(&levels->cells[levels->level], levels->pressure, products);
    for (int k = 0; k < RF_FREEDOMS; ++k)
        f[k] = -12.0 * products[k];
}

/* With the full nodes I and b the source, A_II P_I = (b - A P_held)_I and f_k = -12 N_k.P, N_k being the source of a
   unit drive. A is symmetric, so with V_k = A_II^-1 N_k a change of A and b makes d f_k = 12 V_k.(dA P - db). The
   pressure and its slope vanish at the edge of a ruptured zone, so moving the edge adds nothing. */
void rf_take_derivatives(rf_levels *levels, double rate, double *by)
{
    const rf_cells *cells = &levels->cells[levels->level];
    const int parts = levels->ring->whole ? RF_FREEDOMS : 2;
    memset(by, 0, RF_FREEDOMS * RF_COLUMNS * sizeof(double));
    for (int k = 0; k < parts; ++k, by += RF_COLUMNS) {
        const double unit[RF_DRIVES] = {k == 0, k == 1, k == 2, k == 3, 0.0};
        double bent[RF_FREEDOMS + 1], products[RF_DRIVES];
        rf_set_source(cells, unit, levels->answer);
        for (size_t q = 0; levels->ring->clipped && q < levels->film.lines * levels->film.nodes; ++q)
            levels->answer[q] = levels->pressure[q] > 0.0 ? levels->answer[q] : 0.0;
        rf_solve_film(&levels->search[levels->level], levels->answer, levels->answer);
        rf_bend(cells, levels->answer, levels->pressure, rate, bent);
        rf_multiply(cells, levels->answer, products);
        for (int m = 0; m < RF_FREEDOMS; ++m)
            by[m] = 12.0 * bent[m];
        for (int m = 0; m < RF_DRIVES; ++m)
            by[RF_FREEDOMS + m] = -12.0 * products[m];
        if (cells->around_grown && rate != 0.0)
            by[RF_COLUMNS - 1] += 12.0 * bent[RF_FREEDOMS] / rate;
    }
}

/* Force and, unless NULL, derivatives of the grid that was solved last. */
static void take(rf_levels *levels, double rate, double *f, double *by)
{
    if (by)
        rf_take_derivatives(levels, rate, by);
    rf_take_force(levels, f);
}

static void extrapolate(size_t n, double *fine, const double *coarse)
{
    for (size_t k = 0; k < n; ++k)
        fine[k] += (fine[k] - coarse[k]) / 3.0;
}

int rf_take_film(rf_levels *levels, const double *drive, double *f, double *by)
{
    const int extrapolated = levels->ring->extrapolated != 0;
    double coarse[RF_FREEDOMS], slopes[RF_FREEDOMS * RF_COLUMNS];
    int status = rf_solve_down_to(levels, extrapolated, drive);
    if (status == RF_OK && extrapolated) {
        take(levels, drive[4], coarse, by ? slopes : NULL);
        status = rf_solve_level(levels, 0, drive);
    }
    if (status != RF_OK)
        return status;
    take(levels, drive[4], f, by);
    if (extrapolated)
        extrapolate(RF_FREEDOMS, f, coarse);
    if (extrapolated && by)
        extrapolate(RF_FREEDOMS * RF_COLUMNS, by, slopes);
    return RF_OK;
}
