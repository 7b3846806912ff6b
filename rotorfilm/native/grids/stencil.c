#include "stencil.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"

#define MOST_SETS 400   /* each step moves the edge of the film, by a line at least */
#define THRESHOLD 1e-13 /* of the largest source, above which a node that is empty fills */

typedef struct rf_pool {
    const rf_stencil *stencil;
    uint8_t *full;
    rf_chain chain;
    double *flow, *chained; /* lines x nodes */
    size_t cut;             /* the line at which the ring is cut */
    void *memory;
} rf_pool;

static int open_pool(rf_pool *pool, const rf_stencil *stencil, uint8_t *full)
{
    const size_t m = stencil->nodes, all = stencil->lines * m;
    double *next = malloc((2 * all + all * (m + 1) + all * m + m * m) * sizeof(double) + stencil->lines);
    pool->stencil = stencil;
    pool->full = full;
    pool->memory = next;
    if (!next)
        return RF_MEMORY;
    pool->flow = next;
    pool->chained = next + all;
    pool->chain.band = pool->chained + all;
    pool->chain.border = pool->chain.band + all * (m + 1);
    pool->chain.corner = pool->chain.border + all * m;
    pool->chain.state = (uint8_t *)(pool->chain.corner + m * m);
    return RF_OK;
}

/* What flows out of each node. */
static void set_outflow(const rf_stencil *stencil, const double *pressure, double *flow)
{
    const size_t nodes = stencil->nodes, all = stencil->lines * nodes;
    memset(flow, 0, all * sizeof(double));
    for (size_t p = 0; p < all; ++p) {
        const size_t after = p + nodes < all ? p + nodes : p + nodes - all;
        const double around = stencil->around[p] * (pressure[p] - pressure[after]);
        const int last = (p + 1) % nodes == 0;
        const double along = stencil->along[p] * (pressure[p] - (last ? 0.0 : pressure[p + 1]));
        flow[p] += around + along;
        flow[after] -= around;
        if (!last)
            flow[p + 1] -= along;
    }
}

/* The coefficients of one line: its diagonal, the couplings along it and those to the next line. */
static void set_line(const rf_pool *pool, size_t i, double *diagonal, double *along, double *after)
{
    const rf_stencil *s = pool->stencil;
    const size_t lines = s->lines, nodes = s->nodes, stride = nodes + 1;
    const size_t here = i * nodes, beyond = (i + 1 < lines ? i + 1 : 0) * nodes;
    const size_t before = (i > 0 ? i - 1 : lines - 1) * nodes;
    for (size_t j = 0; j < nodes; ++j) {
        const double inward = j > 0 ? s->along[here + j - 1] : 0.0;
        const int full = pool->full[here + j];
        diagonal[j * stride] =
            full ? s->around[here + j] + s->around[before + j] + s->along[here + j] + inward : 1.0;
        if (j + 1 < nodes && full && pool->full[here + j + 1])
            along[j * stride] = -s->along[here + j];
        if (after && full && pool->full[beyond + j])
            after[j * stride] = -s->around[here + j];
    }
}

static size_t emptiest_line(const rf_pool *pool, size_t *fewest)
{
    const size_t nodes = pool->stencil->nodes;
    size_t best = 0;
    *fewest = nodes + 1;
    for (size_t i = 0; i < pool->stencil->lines; ++i) {
        size_t count = 0;
        for (size_t j = 0; j < nodes; ++j)
            count += pool->full[i * nodes + j];
        if (count < *fewest) {
            best = i;
            *fewest = count;
        }
    }
    return best;
}

static void factorize(rf_pool *pool)
{
    const size_t lines = pool->stencil->lines, nodes = pool->stencil->nodes, stride = nodes + 1;
    rf_chain *chain = &pool->chain;
    size_t fewest;
    pool->cut = emptiest_line(pool, &fewest);
    chain->half = nodes;
    chain->lines = lines - 1;
    chain->bordered = fewest > 0;
    memset(chain->band, 0, (lines - 1) * nodes * stride * sizeof(double));
    for (size_t k = 0; k < lines - 1; ++k) {
        const size_t i = (pool->cut + 1 + k) % lines;
        double *rows = chain->band + k * nodes * stride;
        chain->state[k] = memchr(pool->full + i * nodes, 1, nodes) ? RF_LINE_NEW : RF_LINE_EMPTY;
        set_line(pool, i, rows, rows + 1, k + 2 < lines ? rows + nodes : NULL);
    }
    if (chain->bordered) {
        const size_t before = (pool->cut > 0 ? pool->cut - 1 : lines - 1) * nodes;
        double *last = chain->border + (lines - 2) * nodes * nodes;
        memset(chain->border, 0, (lines - 1) * nodes * nodes * sizeof(double));
        memset(chain->corner, 0, nodes * nodes * sizeof(double));
        /* Row p of the border couples to its column j: the line after the cut is the first of the band. */
        set_line(pool, pool->cut, chain->corner, chain->corner + nodes, chain->border);
        for (size_t j = 0; j < nodes; ++j)
            if (pool->full[before + j] && pool->full[pool->cut * nodes + j])
                last[j * stride] = -pool->stencil->around[before + j];
    }
    rf_factorize_chain(chain);
}

/* Replace a right-hand side by the solution at nodes that are full, 0 elsewhere. */
static void solve(const rf_pool *pool, double *flow)
{
    rf_solve_ring(&pool->chain, pool->cut, pool->full, flow, pool->chained, flow);
}

/* Keep every node that is full under pressure, and fill every one that gets too much; whether any changed. */
static int move_edge(const rf_pool *pool, const double *pressure, double threshold)
{
    const rf_stencil *stencil = pool->stencil;
    int changed = 0;
    set_outflow(stencil, pressure, pool->flow);
    for (size_t p = 0; p < stencil->lines * stencil->nodes; ++p) {
        const double rest = stencil->source[p] - pool->flow[p];
        const int full = !stencil->held[p] && (pool->full[p] ? pressure[p] > 0.0 : rest > threshold);
        changed |= full != pool->full[p];
        pool->full[p] = (uint8_t)full;
    }
    return changed;
}

/* Newton's method for min(outflow - source, pressure) = 0, as in search.h. */
static int search_film(rf_pool *pool, double *pressure)
{
    const rf_stencil *stencil = pool->stencil;
    const size_t all = stencil->lines * stencil->nodes;
    double largest = 0.0;
    for (size_t p = 0; p < all; ++p) {
        largest = fmax(largest, fabs(stencil->source[p]));
        pool->full[p] = (uint8_t)(pool->full[p] && !stencil->held[p]);
    }
    for (int set = 0; set < MOST_SETS; ++set) {
        for (size_t p = 0; p < all; ++p)
            pressure[p] = stencil->held[p] ? pressure[p] : 0.0;
        set_outflow(stencil, pressure, pool->flow);
        for (size_t p = 0; p < all; ++p)
            pool->flow[p] = stencil->source[p] - pool->flow[p];
        factorize(pool);
        solve(pool, pool->flow);
        for (size_t p = 0; p < all; ++p)
            pressure[p] += pool->flow[p];
        if (!move_edge(pool, pressure, THRESHOLD * largest))
            return RF_OK;
    }
    return RF_STUCK;
}

int rf_stencil_film(const rf_stencil *stencil, double *pressure, uint8_t *full, size_t count, double *answers)
{
    rf_pool pool;
    int status = open_pool(&pool, stencil, full);
    if (status == RF_OK)
        status = search_film(&pool, pressure);
    for (size_t k = 0; k < count && status == RF_OK; ++k)
        solve(&pool, answers + k * stencil->lines * stencil->nodes);
    free(pool.memory);
    return status;
}
