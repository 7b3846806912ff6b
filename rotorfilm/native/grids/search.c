#include "search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_SETS 200     /* each step of a monotone search moves the edge of the film, so few are needed */
#define THRESHOLD 1e-13   /* of the largest source, above which a node that is empty fills */

int rf_open_search(rf_search *search, const rf_ring *ring)
{
    const size_t m = ring->grids[0].nodes, all = ring->grids[0].lines * m;
    size_t lines = 0;
    for (int level = 0; level < RF_LEVELS; ++level)
        lines += ring->grids[level].lines;
    const size_t numbers = RF_CELL_ROWS * lines + 4 * all + all * (m + 1) + all * m + m * m;
    double *next = malloc(numbers * sizeof(double) + 3 * all + 2 * ring->grids[0].lines);
    search->ring = ring;
    search->memory = next;
    search->work.solutions = search->work.lines = 0;
    if (!next)
        return RF_MEMORY;
    for (int level = 0; level < RF_LEVELS; ++level) {
        rf_place_cells(&search->cells[level], next, ring->grids[level].lines);
        next += RF_CELL_ROWS * ring->grids[level].lines;
    }
    search->source = next;
    search->pressure = search->source + all;
    search->flow = search->pressure + all;
    search->chained = search->flow + all;
    search->chain.band = search->chained + all;
    search->chain.border = search->chain.band + all * (m + 1);
    search->chain.corner = search->chain.border + all * m;
    search->free = (uint8_t *)(search->chain.corner + m * m);
    search->known = search->free + all;
    search->shut = search->known + all;
    search->moved = search->shut + all;
    search->chain.state = search->moved + ring->grids[0].lines;
    memset(search->shut, 0, all);
    return RF_OK;
}

void rf_close_search(rf_search *search)
{
    free(search->memory);
}

void rf_place_journal(rf_search *search, const double *e)
{
    for (int level = 0; level < RF_LEVELS; ++level)
        rf_set_cells(search->ring, &search->ring->grids[level], e, &search->cells[level]);
}

/* Begin with the nodes where the source drives pressure, or the whole film. */
static void guess_free(rf_search *search, const rf_grid *grid)
{
    const size_t nodes = grid->nodes;
    for (size_t i = 0; i < grid->lines; ++i) {
        const size_t held = (size_t)grid->held[i];
        memset(search->free + i * nodes, 0, held);
        memset(search->free + i * nodes + held, !search->ring->ruptured || search->source[i * nodes] > 0.0,
               nodes - held);
    }
}

/* Begin with all nodes that see a free one of the next coarser grid. */
static void refine_free(rf_search *search, const rf_grid *grid)
{
    const rf_grid *coarser = grid + 1;
    const size_t nodes = grid->nodes, few = coarser->nodes;
    for (size_t i = 0; i < grid->lines; ++i) {
        const uint8_t *left = search->known + (i / 2) * few;
        const uint8_t *right = search->known + ((i + 1) / 2 % coarser->lines) * few;
        for (size_t j = 0; j < nodes; ++j) {
            const size_t near = j / 2, far = (j + 1) / 2 < few ? (j + 1) / 2 : few - 1;
            search->free[i * nodes + j] =
                j >= (size_t)grid->held[i] && (left[near] || right[near] || left[far] || right[far]);
        }
    }
}

/* The coefficients of one line: its diagonal, the couplings along it and those to the next line. */
static void set_line(const rf_search *search, int level, size_t i, size_t stride, double *diagonal,
                     double *along, double *after)
{
    const rf_grid *grid = &search->ring->grids[level];
    const rf_cells *cells = &search->cells[level];
    const size_t lines = grid->lines, nodes = grid->nodes, next = i + 1 < lines ? i + 1 : 0;
    const double both = cells->around[i] + cells->around[i > 0 ? i - 1 : lines - 1];
    const uint8_t *free = search->free + i * nodes, *beyond = search->free + next * nodes;
    for (size_t j = 0; j < nodes; ++j) {
        const double inward = j > 0 ? grid->conductance[j - 1] : 0.0;
        diagonal[j * stride] =
            free[j] ? both * grid->width[j] + cells->along[i] * (grid->conductance[j] + inward) : 1.0;
        if (j + 1 < nodes && free[j] && free[j + 1])
            along[j * stride] = -cells->along[i] * grid->conductance[j];
        if (after && free[j] && beyond[j])
            after[j * stride] = -cells->around[i] * grid->width[j];
    }
}

static int has_film(const rf_search *search, const rf_grid *grid, size_t line)
{
    return memchr(search->free + line * grid->nodes, 1, grid->nodes) != NULL;
}

/* Tell which lines of the chain are to be factorized: all of them, or those that a moved one reaches. The ring
   is cut at an empty line if there is one, and stays so as long as that is empty. */
static void set_states(rf_search *search, const rf_grid *grid, int all)
{
    const size_t lines = grid->lines;
    const uint8_t *moved = search->moved;
    rf_chain *chain = &search->chain;
    if (all || chain->bordered || has_film(search, grid, search->cut)) {
        size_t empty = 0;
        while (empty < lines && has_film(search, grid, empty))
            ++empty;
        chain->bordered = empty == lines;
        search->cut = empty % lines;
        all = 1;
    }
    for (size_t k = 0; k < lines - 1; ++k) {
        const size_t i = (search->cut + 1 + k) % lines, before = i > 0 ? i - 1 : lines - 1;
        const int reached = all || moved[i] || moved[before] || moved[i + 1 < lines ? i + 1 : 0]
                            || (k > 0 && chain->state[k - 1] == RF_LINE_NEW);
        chain->state[k] = !has_film(search, grid, i) ? RF_LINE_EMPTY : reached ? RF_LINE_NEW : RF_LINE_KEPT;
    }
}

/* Set up what is to be factorized. */
static void assemble(rf_search *search, int level, int all)
{
    const rf_grid *grid = &search->ring->grids[level];
    const size_t lines = grid->lines, nodes = grid->nodes;
    const size_t half = nodes, stride = half + 1;
    rf_chain *chain = &search->chain;
    chain->half = half;
    chain->lines = lines - 1;
    set_states(search, grid, all);
    for (size_t k = 0; k < lines - 1; ++k) {
        double *rows = chain->band + k * half * stride;
        if (chain->state[k] != RF_LINE_NEW)
            continue;
        memset(rows, 0, half * stride * sizeof(double));
        const size_t i = (search->cut + 1 + k) % lines;
        set_line(search, level, i, stride, rows, rows + 1, k + 2 < lines ? rows + half : NULL);
        ++search->work.lines;
    }
    if (!chain->bordered)
        return;
    memset(chain->border, 0, (lines - 1) * half * half * sizeof(double));
    memset(chain->corner, 0, half * half * sizeof(double));
    /* Row p of the border couples to its column j: the line after the cut is the first of the band. */
    set_line(search, level, search->cut, stride, chain->corner, chain->corner + half, chain->border);
    const size_t before = search->cut > 0 ? search->cut - 1 : lines - 1;
    double *last = chain->border + (lines - 2) * half * half;
    for (size_t j = 0; j < nodes; ++j)
        if (search->free[before * nodes + j] && search->free[search->cut * nodes + j])
            last[j * stride] = -search->cells[level].around[before] * grid->width[j];
}

void rf_solve_free(const rf_search *search, const double *flow, double *answer)
{
    rf_solve_ring(&search->chain, search->cut, search->free, flow, search->chained, answer);
}

/* Free every node that is full and every one that fills; return whether any changed. */
static int move_edge(rf_search *search, const rf_grid *grid, const double *outflow, double threshold)
{
    int changed = 0;
    for (size_t i = 0; i < grid->lines; ++i) {
        search->moved[i] = 0;
        for (size_t j = (size_t)grid->held[i]; j < grid->nodes; ++j) {
            const size_t at = i * grid->nodes + j;
            const int keep = grid == search->ring->grids && search->shut[at] ? 0
                             : search->free[at] ? search->pressure[at] > 0.0
                                                  : search->source[at] - outflow[at] > threshold;
            search->moved[i] |= keep != search->free[at];
            search->free[at] = (uint8_t)keep;
        }
        changed |= search->moved[i];
    }
    return changed;
}

static int search_from_here(rf_search *search, int level)
{
    const rf_grid *grid = &search->ring->grids[level];
    const rf_cells *cells = &search->cells[level];
    const size_t nodes = grid->nodes, all = grid->lines * nodes;
    double *pressure = search->pressure, *flow = search->flow, largest = 0.0;
    for (size_t q = 0; q < all; ++q)
        largest = fmax(largest, fabs(search->source[q]));
    for (int set = 0; set < MOST_SETS; ++set) {
        for (size_t i = 0; i < grid->lines; ++i)
            for (size_t j = 0; j < nodes; ++j)
                pressure[i * nodes + j] = j < (size_t)grid->held[i] ? grid->value[i] : 0.0;
        rf_set_flow(grid, cells->around, cells->along, pressure, flow);
        for (size_t q = 0; q < all; ++q)
            flow[q] = search->source[q] - flow[q];
        assemble(search, level, set == 0);
        ++search->work.solutions;
        rf_factorize_chain(&search->chain);
        rf_solve_free(search, flow, flow);
        for (size_t q = 0; q < all; ++q)
            pressure[q] += flow[q];
        if (!search->ring->ruptured)
            return RF_OK;
        rf_set_flow(grid, cells->around, cells->along, pressure, flow);
        if (!move_edge(search, grid, flow, THRESHOLD * largest))
            return RF_OK;
    }
    return RF_STUCK;
}

int rf_search_film(rf_search *search, int level, const double *w)
{
    const rf_grid *grid = &search->ring->grids[level];
    const size_t all = grid->lines * grid->nodes;
    rf_set_source(grid, &search->cells[level], w, search->source);
    if (level + 1 < RF_LEVELS && search->ring->ruptured)
        refine_free(search, grid);
    else
        guess_free(search, grid);
    const int status = search_from_here(search, level);
    if (level > 0)
        memcpy(search->known, search->free, all);
    return status;
}

int rf_search_down_to(rf_search *search, int level, const double *w)
{
    int status = RF_OK;
    for (int k = search->ring->ruptured ? RF_LEVELS - 1 : level; k >= level && status == RF_OK; --k)
        status = rf_search_film(search, k, w);
    return status;
}

int rf_search_without(rf_search *search)
{
    for (size_t q = 0; q < search->ring->grids[0].lines * search->ring->grids[0].nodes; ++q)
        search->free[q] = search->free[q] && !search->shut[q];
    return search_from_here(search, 0);
}
