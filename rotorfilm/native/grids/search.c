#include "search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "clones.h"

#define MOST_SETS 400   /* each step of a monotone search moves the edge of the film, by a line at least */
#define THRESHOLD 1e-13 /* of the largest source, above which a node that is empty fills */

int rf_open_search(rf_search *search, size_t lines, size_t nodes)
{
    const size_t all = lines * nodes;
    double *next = malloc((2 * all + all * rf_chain_stride(nodes) + all * nodes + nodes * nodes) * sizeof(double) + 2 * lines + all);
    search->memory = next;
    search->keeps = 0;
    search->work.solutions = search->work.lines = 0;
    if (!next)
        return RF_MEMORY;
    search->flow = next;
    search->chained = next + all;
    search->chain.band = search->chained + all;
    search->chain.border = search->chain.band + all * rf_chain_stride(nodes);
    search->chain.corner = search->chain.border + all * nodes;
    search->moved = (uint8_t *)(search->chain.corner + nodes * nodes);
    search->chain.state = search->moved + lines;
    search->factorized = search->chain.state + lines;
    return RF_OK;
}

void rf_close_search(rf_search *search)
{
    free(search->memory);
}

static size_t line_before(const rf_stencil *film, size_t i)
{
    return i > 0 ? i - 1 : film->lines - 1;
}

static size_t line_after(const rf_stencil *film, size_t i)
{
    return i + 1 < film->lines ? i + 1 : 0;
}

RF_CLONES
static void set_outflow(const rf_stencil *film, const double *pressure, double *flow)
{
    const size_t lines = film->lines, nodes = film->nodes;
    for (size_t i = 0; i < lines; ++i) {
        const size_t back = line_before(film, i) * nodes;
        const double *here = pressure + i * nodes, *after = pressure + line_after(film, i) * nodes;
        const double *before = pressure + back, *out = film->around + i * nodes, *in = film->around + back;
        const double *along = film->along + i * nodes;
        double *q = flow + i * nodes;
        for (size_t j = 0; j < nodes; ++j)
            q[j] = out[j] * (here[j] - after[j]) + in[j] * (here[j] - before[j]);
        for (size_t j = 0; j + 1 < nodes; ++j) {
            const double axial = along[j] * (here[j] - here[j + 1]);
            q[j] += axial;
            q[j + 1] -= axial;
        }
        q[nodes - 1] += along[nodes - 1] * here[nodes - 1];
        if (film->entry)
            q[0] += film->entry[i] * here[0];
    }
}

/* The coefficients of one line: its diagonal, the couplings along it and those to the next line. */
static void set_line(const rf_search *search, size_t i, size_t stride, double *diagonal, double *along, double *after)
{
    const rf_stencil *film = search->film;
    const size_t nodes = film->nodes;
    const double *out = film->around + i * nodes, *in = film->around + line_before(film, i) * nodes;
    const double *axial = film->along + i * nodes;
    const uint8_t *full = search->full + i * nodes, *beyond = search->full + line_after(film, i) * nodes;
    double inward = film->entry ? film->entry[i] : 0.0;
    for (size_t j = 0; j < nodes; ++j) {
        diagonal[j * stride] = full[j] ? out[j] + in[j] + (axial[j] + inward) : 1.0;
        if (j + 1 < nodes && full[j] && full[j + 1])
            along[j * stride] = -axial[j];
        if (after && full[j] && beyond[j])
            after[j * stride] = -out[j];
        inward = axial[j];
    }
}

static int has_film(const rf_search *search, size_t line)
{
    return memchr(search->full + line * search->film->nodes, 1, search->film->nodes) != NULL;
}

/* Tell which lines of the chain are to be factorized: all of them, or those that a moved one reaches. The ring
   is cut at an empty line if there is one, and stays so as long as that is empty. */
static void set_states(rf_search *search, int all)
{
    const rf_stencil *film = search->film;
    const uint8_t *moved = search->moved;
    rf_chain *chain = &search->chain;
    if (all || chain->bordered || has_film(search, search->cut)) {
        size_t empty = 0;
        while (empty < film->lines && has_film(search, empty))
            ++empty;
        chain->bordered = empty == film->lines;
        search->cut = empty % film->lines;
        all = 1;
    }
    for (size_t k = 0; k < film->lines - 1; ++k) {
        const size_t i = (search->cut + 1 + k) % film->lines;
        const int reached = all || moved[i] || moved[line_before(film, i)] || moved[line_after(film, i)]
                            || (k > 0 && chain->state[k - 1] == RF_LINE_NEW);
        chain->state[k] = !has_film(search, i) ? RF_LINE_EMPTY : reached ? RF_LINE_NEW : RF_LINE_KEPT;
    }
}

/* Set up what is to be factorized. */
static void assemble(rf_search *search, int all)
{
    const rf_stencil *film = search->film;
    const size_t lines = film->lines, half = film->nodes, stride = rf_chain_stride(half);
    rf_chain *chain = &search->chain;
    chain->half = half;
    chain->lines = lines - 1;
    set_states(search, all);
    for (size_t k = 0; k < lines - 1; ++k) {
        double *rows = chain->band + k * half * stride;
        if (chain->state[k] != RF_LINE_NEW)
            continue;
        memset(rows, 0, half * stride * sizeof(double));
        set_line(search, (search->cut + 1 + k) % lines, stride, rows, rows + 1, k + 2 < lines ? rows + half : NULL);
        ++search->work.lines;
    }
    if (!chain->bordered)
        return;
    memset(chain->border, 0, (lines - 1) * half * half * sizeof(double));
    memset(chain->corner, 0, half * half * sizeof(double));
    /* Row p of the border couples to its column j: the line after the cut is the first of the band. */
    set_line(search, search->cut, half + 1, chain->corner, chain->corner + half, chain->border);
    const size_t before = line_before(film, search->cut) * half;
    double *last = chain->border + (lines - 2) * half * half;
    for (size_t j = 0; j < half; ++j)
        if (search->full[before + j] && search->full[search->cut * half + j])
            last[j * (half + 1)] = -film->around[before + j];
}

void rf_solve_film(const rf_search *search, const double *right, double *answer)
{
    rf_solve_ring(&search->chain, search->cut, search->full, right, search->chained, answer);
}

/* Keep every node that is full under pressure, and fill every one that gets too much; whether any changed. */
static int move_edge(rf_search *search, const double *pressure, double threshold)
{
    const rf_stencil *film = search->film;
    int changed = 0;
    set_outflow(film, pressure, search->flow);
    for (size_t i = 0; i < film->lines; ++i) {
        search->moved[i] = 0;
        for (size_t q = i * film->nodes; q < (i + 1) * film->nodes; ++q) {
            const int keep = film->held[q] ? 0 : search->full[q] ? pressure[q] > 0.0
                                                 : film->source[q] - search->flow[q] > threshold;
            search->moved[i] |= keep != search->full[q];
            search->full[q] = (uint8_t)keep;
        }
        changed |= search->moved[i];
    }
    return changed;
}

int rf_search_film(rf_search *search, const rf_stencil *film, int ruptured, double *pressure, uint8_t *full)
{
    const size_t all = film->lines * film->nodes;
    const int fresh = !search->keeps;
    double *flow = search->flow, largest = 0.0;
    search->film = film;
    search->full = full;
    search->keeps = 0;
    for (size_t q = 0; q < all; ++q) {
        largest = fabs(film->source[q]) > largest ? fabs(film->source[q]) : largest;
        full[q] = full[q] && !film->held[q];
    }
    for (size_t i = 0; i < film->lines && !fresh; ++i)
        search->moved[i] = memcmp(full + i * film->nodes, search->factorized + i * film->nodes, film->nodes) != 0;
    for (int set = 0; set < MOST_SETS; ++set) {
        for (size_t q = 0; q < all; ++q)
            pressure[q] = film->held[q] ? pressure[q] : 0.0;
        set_outflow(film, pressure, flow);
        for (size_t q = 0; q < all; ++q)
            flow[q] = film->source[q] - flow[q];
        assemble(search, fresh && set == 0);
        ++search->work.solutions;
        rf_factorize_chain(&search->chain);
        rf_solve_film(search, flow, flow);
        for (size_t q = 0; q < all; ++q)
            pressure[q] += flow[q];
        memcpy(search->factorized, full, all);
        if (!ruptured || !move_edge(search, pressure, THRESHOLD * largest))
            return RF_OK;
    }
    return RF_STUCK;
}

int rf_stencil_film(const rf_stencil *film, double *pressure, uint8_t *full, size_t count, double *answers)
{
    rf_search search;
    int status = rf_open_search(&search, film->lines, film->nodes);
    if (status == RF_OK)
        status = rf_search_film(&search, film, 1, pressure, full);
    for (size_t k = 0; k < count && status == RF_OK; ++k)
        rf_solve_film(&search, answers + k * film->lines * film->nodes, answers + k * film->lines * film->nodes);
    rf_close_search(&search);
    return status;
}
