#include "recess_pad.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PAD_LEVELS 2
#define TURN 6.28318530717958647692

static void add_span(rf_over_pad *at, double start, double end, int32_t cells)
{
    const int32_t k = at->ring.spans;
    at->start[k] = start;
    at->extent[k] = end - start;
    at->cells[k] = cells;
    at->ring.spans += cells > 0;
}

void rf_place_over_pad(rf_over_pad *at, const rf_recess *bearing, const rf_recess_pad *pad, const double *state)
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
    add_span(at, end, pad->start + TURN, RF_GAP_LINES);
    add_span(at, pad->start, pad->from, pad->around[0]);
    ring->recess = pad->around[1] > 0 ? ring->spans : -1;
    add_span(at, pad->from, pad->to, pad->around[1]);
    add_span(at, pad->to, end, pad->around[2]);
    ring->start = at->start;
    ring->extent = at->extent;
    ring->slenderness = bearing->length / (2.0 * bearing->radius);
    ring->depth = pad->depth / own;
    ring->levels = PAD_LEVELS;
    ring->extrapolated = bearing->extrapolated;
    ring->pinned = ring->resting = ring->ruptured = ring->pad = 1;
    for (int level = 0; level < PAD_LEVELS; ++level) {
        rf_grid *grid = &ring->grids[level];
        grid->lines = (size_t)(RF_GAP_LINES + pad->around[0] + pad->around[1] + pad->around[2]) >> level;
        grid->nodes = (size_t)(pad->along[0] + pad->along[1]) >> level;
        grid->within = (size_t)pad->along[0] >> level;
    }
}

/* Lines and nodes of one grid: places of lines and faces, values, widths and conductances of nodes, spans and held
   nodes of lines; return what follows them. */
static double *set_grid(rf_over_pad *at, int level, double *next)
{
    rf_grid *grid = &at->ring.grids[level];
    const size_t lines = grid->lines, nodes = grid->nodes;
    double *line = next, *face = line + lines, *value = face + lines;
    double *width = value + lines, *conductance = width + nodes;
    int32_t *span = (int32_t *)(conductance + nodes), *held = span + lines;
    const size_t gap = RF_GAP_LINES >> level;
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

int rf_open_pad(rf_over_pad *at, const rf_recess *bearing, const rf_recess_pad *pad, const double *state)
{
    double place[2];
    rf_place_over_pad(at, bearing, pad, state);
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
        rf_place_journal(&at->film, at->q);
    return status;
}

void rf_close_pad(rf_over_pad *at)
{
    rf_close_levels(&at->film);
    free(at->memory);
}

int rf_pad_rests(const rf_over_pad *at)
{
    const int stepped = at->ring.depth > 0.0 && at->ring.recess >= 0 && at->ring.spans > 2;
    return at->drive[0] == 0.0 && at->drive[1] == 0.0 && !(stepped && at->drive[4] != 0.0);
}
