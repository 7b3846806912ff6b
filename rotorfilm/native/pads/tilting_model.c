#include "tilting_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/journal_model.h"
#include "../solvers/dense.h"
#include "../films/map_table.h"

enum { EXTENT, OFFSET, PRELOAD, SPRING, INERTIA, MASS, SLENDERNESS, NUMBERS };

/* Kernels are given as constant, but their scratch space is written. */
static rf_tilting_model *writable(const void *kernel)
{
    return (rf_tilting_model *)kernel;
}

static int take_pads(rf_tilting_model *m, const rf_tables *tables, int inertia, rf_message *why)
{
    const rf_table *pads = rf_find_table(tables, "pads", 1, why);
    const rf_table *pivots = pads ? rf_find_table(tables, "pivots", 1, why) : NULL;
    if (!pivots)
        return RF_INVALID;
    const double *n = pads->numbers;
    const uint32_t count = pivots->extent[0];
    if (pads->extent[0] != NUMBERS || count < 1 || count > RF_MOST_TILTING)
        return rf_say(why, RF_INVALID, "pads must have %d numbers and 1 to %d pivots, got %u and %u", NUMBERS, RF_MOST_TILTING,
                      (unsigned)pads->extent[0], (unsigned)count);
    const int whole = n[EXTENT] > 0.0 && n[OFFSET] > 0.0 && n[OFFSET] < 1.0 && n[PRELOAD] < 1.0 && n[SPRING] >= 0.0
                      && (inertia ? n[INERTIA] > 0.0 : n[INERTIA] == 0.0) && n[MASS] >= 0.0 && n[SLENDERNESS] > 0.0;
    if (!whole)
        return rf_say(why, RF_INVALID, "pads must be of a bearing, got extent %.9g, offset %.9g, preload %.9g, inertia %.9g",
                      n[EXTENT], n[OFFSET], n[PRELOAD], n[INERTIA]);
    for (uint32_t k = 0; k < count; ++k) {
        m->pivots[2 * k] = cos(pivots->numbers[k]);
        m->pivots[2 * k + 1] = sin(pivots->numbers[k]);
    }
    rf_tilting *b = &m->bearing;
    rf_set_tilting_pad(&b->pad, rf_pad_film, &m->map, n[EXTENT], n[OFFSET]);
    b->count = count;
    b->pivot = m->pivots;
    b->preload = n[PRELOAD];
    b->spring = n[SPRING];
    b->inertia = n[INERTIA];
    b->mass = n[MASS];
    m->slenderness = n[SLENDERNESS];
    m->states = rf_tilting_states(b);
    m->outputs = 2 + count;
    return RF_OK;
}

static int allocate(rf_tilting_model *m, rf_message *why)
{
    const size_t n = m->states;
    double *next = m->inverse = malloc((2 * n * n + n + 5 * n + m->outputs * (n + 5)) * sizeof(double));
    if (!next)
        return rf_say(why, RF_MEMORY, "no memory for %zu states of pads", n);
    m->matrix = next + n * n;
    m->spare = m->matrix + n * n;
    m->by[1] = m->spare + n;
    m->by[2] = m->by[1] + 5 * n;
    m->by[3] = m->by[2] + m->outputs * n;
    return RF_OK;
}

int rf_take_tilting(rf_tilting_model *m, const rf_tables *tables, int inertia, rf_sizes *sizes, rf_message *why)
{
    if (rf_take_map(&m->map, RF_PAD, "", tables, why) != RF_OK || take_pads(m, tables, inertia, why) != RF_OK
        || allocate(m, why) != RF_OK)
        return RF_INVALID;
    *sizes = (rf_sizes){RF_JOURNAL_SIZES.parameters, 5, m->outputs, m->states, 0};
    return RF_OK;
}

void rf_release_tilting(void *kernel)
{
    free(((rf_tilting_model *)kernel)->inverse);
}

int rf_set_tilting(void *kernel, const double *p, rf_message *why)
{
    rf_tilting_model *m = kernel;
    rf_journal scaled = {NULL, NULL, 0.0, 0.0, 0.0, 0};
    if (rf_scale_journal(&scaled, p, why) != RF_OK
        || rf_judge_slenderness(m->slenderness, "map of a pad", p, why) != RF_OK)
        return RF_INVALID;
    rf_scale_growth(&m->map, p);
    m->bearing.clearance = scaled.clearance;
    m->bearing.force_scale = scaled.force_scale;
    return RF_OK;
}

static int explain(int status, size_t pad, const double *u, rf_message *why)
{
    const unsigned number = (unsigned)pad + 1;
    switch (status) {
    case RF_OK: return RF_OK;
    case RF_OUTSIDE:
        return rf_say(why, status, "pad %u is beyond the map of its film; its force is extrapolated there, with an error "
                      "that is not known", number);
    case RF_AT_WALL:
        return rf_say(why, status, "the journal must leave a film on every pad, and touches pad %u at x = %.9g, y = %.9g m",
                      number, u[0], u[1]);
    case RF_STUCK: return rf_say(why, status, "the search for the tilt of pad %u must end, and did not", number);
    default:
        return rf_say(why, status, "the force of pad %u is not finite or has no derivative at x = %.9g, y = %.9g m, "
                      "vx = %.9g, vy = %.9g m/s, speed = %.9g rad/s", number, u[0], u[1], u[2], u[3], u[4]);
    }
}

int rf_tilting_output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    rf_tilting_model *m = writable(kernel);
    size_t pad;
    const int status = rf_tilting_at(&m->bearing, at->u, at->x, m->rates, y, NULL, &pad);
    return explain(status, pad, at->u, why);
}

int rf_tilting_derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    rf_tilting_model *m = writable(kernel);
    size_t pad;
    const int status = rf_tilting_at(&m->bearing, at->u, at->x, dx, m->forces, NULL, &pad);
    return explain(status, pad, at->u, why);
}

int rf_tilting_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    rf_tilting_model *m = writable(kernel);
    const rf_tilting_slopes slopes = {answer->A, answer->B, answer->C, answer->D};
    size_t pad;
    const int status = rf_tilting_at(&m->bearing, at->u, at->x, m->rates, m->forces, &slopes, &pad);
    return explain(status, pad, at->u, why);
}

int rf_tilting_factorize(void *kernel, const rf_point *at, double shift, rf_message *why)
{
    rf_tilting_model *m = kernel;
    const size_t n = m->states;
    const rf_tilting_slopes slopes = {m->matrix, m->by[1], m->by[2], m->by[3]};
    size_t pad;
    const int status = rf_tilting_at(&m->bearing, at->u, at->x, m->rates, m->forces, &slopes, &pad);
    if (status > RF_OUTSIDE)
        return explain(status, pad, at->u, why);
    memset(m->inverse, 0, n * n * sizeof(double));
    for (size_t i = 0; i < n; ++i) {
        m->inverse[i * n + i] = 1.0;
        for (size_t j = 0; j < n; ++j)
            m->matrix[i * n + j] = (i == j ? shift : 0.0) - m->matrix[i * n + j];
    }
    rf_eliminate(n, m->matrix, n, m->inverse);
    return explain(status, pad, at->u, why);
}

void rf_tilting_solve(void *kernel, double *b)
{
    rf_tilting_model *m = kernel;
    memset(m->spare, 0, m->states * sizeof(double));
    rf_add_product(m->states, m->states, 1.0, m->inverse, b, m->spare);
    memcpy(b, m->spare, m->states * sizeof(double));
}

void rf_tilting_drift(const void *kernel, const rf_point *at, double *slope)
{
    const rf_tilting_model *m = kernel;
    (void)at;
    memset(slope, 0, m->states * sizeof(double));
}
