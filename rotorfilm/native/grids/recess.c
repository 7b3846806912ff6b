#include "recess.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/film.h"
#include "../films/map_frame.h"
#include "losses.h"

#define PAD_LEVELS 2 /* grids of a pad */
#define TURN 6.28318530717958647692
#define GAP_LINES 2 /* of the finest grid, the first ones: those of the gap */

/* One pad at one state as a ring: its arc in spans, and the gap between its ends. */
typedef struct over_pad {
    const rf_recess_pad *pad;
    double q[RF_FREEDOMS], drive[RF_DRIVES]; /* of the journal, from the pad's center of curvature */
    double start[4], extent[4];              /* of the spans */
    int32_t cells[4];                        /* of the finest grid on each */
    rf_ring ring;
    rf_levels film;
    void *memory;
} over_pad;

static void add_span(over_pad *at, double start, double end, int32_t cells)
{
    const int32_t k = at->ring.spans;
    at->start[k] = start;
    at->extent[k] = end - start;
    at->cells[k] = cells;
    at->ring.spans += cells > 0;
}

/* Put the journal over a pad, without its grids. */
static void place_pad(over_pad *at, const rf_recess *bearing, const rf_recess_pad *pad, const double *state)
{
    const double own = bearing->clearance, rate = 0.5 * state[4], end = pad->start + pad->extent;
    const double e[2] = {state[0] / own + pad->preload * cos(pad->anchor),
                         state[1] / own + pad->preload * sin(pad->anchor)};
    const double drive[RF_DRIVES] = {state[2] / own + rate * e[1], state[3] / own - rate * e[0], 0.0, 0.0, rate};
    rf_ring *ring = &at->ring;
    memset(at, 0, sizeof *at);
    memcpy(at->q, e, sizeof e);
    memcpy(at->drive, drive, sizeof drive);
    at->pad = pad;
    add_span(at, end, pad->start + TURN, GAP_LINES);
    add_span(at, pad->start, pad->from, pad->around[0]);
    ring->recess = pad->around[1] > 0 ? ring->spans : -1;
    add_span(at, pad->from, pad->to, pad->around[1]);
    add_span(at, pad->to, end, pad->around[2]);
    ring->start = at->start;
    ring->extent = at->extent;
    ring->slenderness = bearing->length / (2.0 * bearing->radius);
    ring->depth = pad->depth / own;
    ring->mobility = bearing->mobility;
    ring->levels = PAD_LEVELS;
    ring->extrapolated = bearing->extrapolated;
    ring->pinned = ring->resting = ring->ruptured = ring->pad = 1;
    for (int level = 0; level < PAD_LEVELS; ++level) {
        rf_grid *grid = &ring->grids[level];
        grid->lines = (size_t)(GAP_LINES + pad->around[0] + pad->around[1] + pad->around[2]) >> level;
        grid->nodes = (size_t)(pad->along[0] + pad->along[1]) >> level;
        grid->within = (size_t)pad->along[0] >> level;
    }
}

/* Lines and nodes of one grid: places of lines and faces, values, widths and conductances of nodes, spans and held
   nodes of lines; return what follows them. */
static double *set_grid(over_pad *at, int level, double *next)
{
    rf_grid *grid = &at->ring.grids[level];
    const size_t lines = grid->lines, nodes = grid->nodes;
    double *line = next, *face = line + lines, *value = face + lines;
    double *width = value + lines, *conductance = width + nodes;
    int32_t *span = (int32_t *)(conductance + nodes), *held = span + lines;
    const size_t gap = GAP_LINES >> level;
    size_t i = 0;
    for (int32_t k = 0; k < at->ring.spans; ++k) {
        const size_t cells = (size_t)at->cells[k] >> level;
        for (size_t c = 0; c < cells; ++c, ++i) {
            span[i] = k;
            line[i] = (double)c / (double)cells;
            face[i] = ((double)c + 0.5) / (double)cells;
            value[i] = 0.0;
            held[i] = i <= gap ? (int32_t)nodes : 0; /* the gap and both edges of the pad */
        }
    }
    memset(width, 0, nodes * sizeof(double));
    for (size_t j = 0; j < nodes; ++j) {
        const double share = at->pad->share, cells = (double)(j < grid->within ? grid->within : nodes - grid->within);
        const double distance = (j < grid->within ? share : 1.0 - share) / cells;
        conductance[j] = 1.0 / distance;
        width[j] += 0.5 * distance;
        if (j + 1 < nodes)
            width[j + 1] += 0.5 * distance;
    }
    const rf_grid set = {lines, nodes, span, line, face, value, held, width, conductance, NULL, NULL, grid->within};
    *grid = set;
    return conductance + nodes + lines;
}

/* The same with them, and the journal placed on all; RF_MEMORY, RF_AT_WALL. It is to be closed in any case. */
static int open_pad(over_pad *at, const rf_recess *bearing, const rf_recess_pad *pad, const double *state)
{
    double place[2];
    place_pad(at, bearing, pad, state);
    if (!(rf_least_film(&at->ring, at->q, place) > 0.0))
        return RF_AT_WALL;
    const rf_grid *finest = &at->ring.grids[0];
    double *next = at->memory = malloc(2 * (4 * finest->lines + 2 * finest->nodes) * sizeof(double));
    if (!next)
        return RF_MEMORY;
    for (int level = 0; level < PAD_LEVELS; ++level)
        next = set_grid(at, level, next);
    const int status = rf_open_levels(&at->film, &at->ring);
    if (status == RF_OK)
        rf_place_journal(&at->film, at->q, at->drive[4]);
    return status;
}

static void close_pad(over_pad *at)
{
    rf_close_levels(&at->film);
    free(at->memory);
}

/* Whether nothing drives its film. */
static int pad_rests(const over_pad *at)
{
    const int stepped = at->ring.depth > 0.0 && at->ring.recess >= 0 && at->ring.spans > 2;
    const int dragged = stepped || at->ring.mobility.drags;
    return at->drive[0] == 0.0 && at->drive[1] == 0.0 && !(dragged && at->drive[4] != 0.0);
}

/* Add what a pad does to the force and, unless NULL, to its derivatives by the state. */
static void add_pad(const rf_recess *bearing, const over_pad *at, const double *wrench, const double *by,
                    double *force, double *jacobian)
{
    const double r = bearing->radius, own = bearing->clearance, *e = at->q;
    const double scale = bearing->viscosity * bearing->length * (r * r * r) / (own * own), per = scale / own;
    for (int k = 0; k < 2; ++k) {
        force[k] += scale * wrench[k];
        if (!jacobian)
            continue;
        const double *slope = by + RF_COLUMNS * k, *d = slope + RF_FREEDOMS;
        double *row = jacobian + 5 * k;
        /* w = v/c + rate (e_y, -e_x) */
        row[0] += per * (slope[0] - at->drive[4] * d[1]);
        row[1] += per * (slope[1] + at->drive[4] * d[0]);
        row[2] += per * d[0];
        row[3] += per * d[1];
        row[4] += 0.5 * scale * (d[0] * e[1] - d[1] * e[0] + d[4]);
    }
}

int rf_recess_at(const rf_recess *bearing, const double *state, double *f, double *jacobian)
{
    int status = RF_OK, rests = 0;
    size_t touched;
    if (rf_is_broken(state, 5))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 10);
    if (!(rf_recess_least(bearing, state, &touched) > 0.0))
        return rf_fail(RF_AT_WALL, f, jacobian, 10);
    f[0] = f[1] = 0.0;
    if (jacobian)
        memset(jacobian, 0, 10 * sizeof(double));
    for (size_t k = 0; k < bearing->count && status == RF_OK; ++k) {
        double wrench[RF_FREEDOMS], by[RF_FREEDOMS * RF_COLUMNS];
        over_pad at;
        status = open_pad(&at, bearing, bearing->pads + k, state);
        if (pad_rests(&at))
            rests = 1;
        else if (status == RF_OK)
            status = rf_take_film(&at.film, at.drive, wrench, jacobian ? by : NULL);
        if (status == RF_OK && !pad_rests(&at))
            add_pad(bearing, &at, wrench, by, f, jacobian);
        close_pad(&at);
    }
    if (status != RF_OK)
        return rf_fail(status, f, jacobian, 10);
    if (rf_is_broken(f, 2) || (jacobian && rf_is_broken(jacobian, 10)))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 10);
    for (int k = 0; k < 10 && rests && jacobian; ++k)
        jacobian[k] = NAN;
    return rests && jacobian ? RF_UNDEFINED : RF_OK;
}

static int respond(const void *of, const double *state, double *f, double *jacobian)
{
    return rf_recess_at(of, state, f, jacobian);
}

int rf_recess_batch(const rf_recess *bearing, size_t n, const double *state, double *f, double *jacobian,
                    size_t *first)
{
    const rf_states states = {{state, state + n, state + 2 * n, state + 3 * n, state + 4 * n}, {1, 1, 1, 1, 1}};
    const rf_answers answers = {f, n, jacobian, n};
    return rf_each(respond, bearing, &states, 5, n, &answers, first);
}

int rf_recess_field(const rf_recess *bearing, size_t pad, const double *state, double *pressure)
{
    over_pad at;
    int status = open_pad(&at, bearing, bearing->pads + pad, state);
    if (status == RF_OK)
        status = rf_solve_down_to(&at.film, 0, at.drive);
    const double slope = bearing->radius / bearing->clearance;
    const size_t nodes = at.ring.grids[0].nodes, all = (at.ring.grids[0].lines - GAP_LINES) * nodes;
    for (size_t q = 0; q < all && status == RF_OK; ++q)
        pressure[q] = 12.0 * bearing->viscosity * slope * slope * at.film.pressure[GAP_LINES * nodes + q];
    close_pad(&at);
    return status;
}

double rf_recess_least(const rf_recess *bearing, const double *position, size_t *pad)
{
    const double state[5] = {position[0], position[1], 0.0, 0.0, 0.0};
    double least = HUGE_VAL, place[2];
    *pad = 0;
    for (size_t k = 0; k < bearing->count; ++k) {
        over_pad at;
        place_pad(&at, bearing, bearing->pads + k, state);
        const double thickness = bearing->clearance * rf_least_film(&at.ring, at.q, place);
        if (thickness < least) {
            least = thickness;
            *pad = k;
        }
    }
    return least;
}

/* The row of one pad: the force and what pressure does on the steps per rate, 12 P.b(0, 1); then its oil at rest. */
static int take_losses(over_pad *at, double *row)
{
    const double e[2] = {at->q[0], at->q[1]}, rate = at->drive[4];
    const double rest[RF_DRIVES] = {rate * e[1], -rate * e[0], 0.0, 0.0, rate};
    const int extrapolated = at->ring.extrapolated != 0;
    rf_pad_oil oil;
    int status = RF_OK;
    row[0] = row[1] = row[2] = 0.0;
    for (int level = 1; level >= 0 && status == RF_OK; --level) {
        const double share = level == 0 ? extrapolated ? 4.0 / 3.0 : 1.0 : extrapolated ? -1.0 / 3.0 : 0.0;
        double products[RF_DRIVES];
        status = rf_solve_level(&at->film, level, at->drive);
        rf_multiply(&at->film.cells[level], at->film.pressure, products);
        row[0] -= 12.0 * share * products[0];
        row[1] -= 12.0 * share * products[1];
        row[2] += 12.0 * share * products[4];
    }
    if (status == RF_OK)
        status = rf_follow_pad(&at->film, at->q, rest, &oil);
    if (status != RF_OK)
        return status;
    row[3] = oil.film + oil.streamers;
    row[4] = oil.gap;
    row[5] = oil.entering;
    row[6] = oil.leaving;
    return RF_OK;
}

int rf_recess_losses(const rf_recess *bearing, const double *state, double *losses)
{
    int status = rf_is_broken(state, 5) ? RF_NOT_FINITE : RF_OK;
    for (size_t k = 0; k < bearing->count && status == RF_OK; ++k) {
        over_pad at;
        status = open_pad(&at, bearing, bearing->pads + k, state);
        if (status == RF_OK)
            status = take_losses(&at, losses + RF_RECESS_LOSSES * k);
        close_pad(&at);
    }
    return status;
}
