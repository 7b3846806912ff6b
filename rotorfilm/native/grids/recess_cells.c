#include "recess_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/quintic.h"

#define TURN 6.28318530717958647692

static size_t lines_of(const rf_recess_pad *pad, int level)
{
    return (size_t)(pad->around[0] + pad->around[1] + pad->around[2]) >> level;
}

static size_t nodes_of(const rf_recess_pad *pad, int level)
{
    return (size_t)(pad->along[0] + pad->along[1]) >> level;
}

int rf_open_plate(rf_plate *at)
{
    const size_t lines = lines_of(at->pad, 0), nodes = nodes_of(at->pad, 0), all = lines * nodes;
    double *next = malloc((8 * all + 4 * lines + 3 * nodes) * sizeof(double) + 3 * all + lines);
    double **const large[] = {&at->around, &at->along, &at->source, &at->pressure, &at->around_slope,
                              &at->along_slope, &at->answers};
    double **const by_line[] = {&at->theta, &at->face, &at->normal[0], &at->normal[1]};
    double **const by_node[] = {&at->deep, &at->shallow, &at->spacing};
    at->memory = next;
    if (!next)
        return RF_MEMORY;
    for (size_t k = 0; k < 7; ++k, next += all)
        *large[k] = next;
    next += all; /* the second answer */
    for (size_t k = 0; k < 4; ++k, next += lines)
        *by_line[k] = next;
    for (size_t k = 0; k < 3; ++k, next += nodes)
        *by_node[k] = next;
    at->held = (uint8_t *)next;
    at->full = at->held + all;
    at->known = at->full + all;
    at->recessed = at->known + all;
    return RF_OK;
}

void rf_close_plate(rf_plate *at)
{
    free(at->memory);
}

void rf_place_plate(rf_plate *at, const rf_recess *bearing, const rf_recess_pad *pad, const double *state)
{
    memset(at, 0, sizeof *at);
    at->pad = pad;
    at->slenderness = bearing->length / (2.0 * bearing->radius);
    at->own = bearing->clearance;
    at->rate = 0.5 * state[4];
    at->depth = pad->depth / at->own;
    at->e[0] = state[0] / at->own + pad->preload * cos(pad->anchor);
    at->e[1] = state[1] / at->own + pad->preload * sin(pad->anchor);
    at->w[0] = state[2] / at->own + at->rate * at->e[1];
    at->w[1] = state[3] / at->own - at->rate * at->e[0];
}

int rf_plate_rests(const rf_plate *at)
{
    const rf_recess_pad *pad = at->pad;
    const int stepped = pad->depth > 0.0 && pad->around[1] > 0 && (pad->around[0] > 0 || pad->around[2] > 0);
    return at->w[0] == 0.0 && at->w[1] == 0.0 && !(stepped && at->rate != 0.0);
}

static double thickness(const rf_plate *at, double theta)
{
    return 1.0 - at->e[0] * cos(theta) - at->e[1] * sin(theta);
}

/* The least 1 - e.n between two angles: in the direction of e, or at an end. */
static double least_between(const rf_plate *at, double from, double to)
{
    const double ends = fmin(thickness(at, from), thickness(at, to));
    double inside = fmod(atan2(at->e[1], at->e[0]) - from, TURN);
    if (inside < 0.0)
        inside += TURN;
    return inside <= to - from ? fmin(ends, 1.0 - rf_length(at->e[0], at->e[1])) : ends;
}

double rf_plate_least(const rf_plate *at)
{
    const rf_recess_pad *pad = at->pad;
    const double edge[4] = {pad->start, pad->from, pad->to, pad->start + pad->extent};
    double least = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        const double depth = k == 1 && pad->along[1] == 0 ? at->depth : 0.0; /* beside a share there is land */
        if (pad->around[k] > 0)
            least = fmin(least, least_between(at, edge[k], edge[k + 1]) + depth);
    }
    return least;
}

static void set_lines(rf_plate *at, int level)
{
    const rf_recess_pad *pad = at->pad;
    const double edge[4] = {pad->start, pad->from, pad->to, pad->start + pad->extent};
    size_t i = 0;
    for (int k = 0; k < 3; ++k) {
        const size_t cells = (size_t)pad->around[k] >> level;
        for (size_t c = 0; c < cells; ++c, ++i) {
            const double step = (edge[k + 1] - edge[k]) / (double)cells;
            at->theta[i] = edge[k] + step * (double)c;
            at->face[i] = edge[k] + step * ((double)c + 0.5);
            at->recessed[i] = k == 1;
        }
    }
    for (i = 1; i < at->stencil.lines; ++i) {
        at->normal[0][i] = sin(at->face[i]) - sin(at->face[i - 1]);
        at->normal[1][i] = cos(at->face[i - 1]) - cos(at->face[i]);
    }
}

static void set_nodes(rf_plate *at, int level)
{
    const size_t within = (size_t)at->pad->along[0] >> level, nodes = nodes_of(at->pad, level);
    memset(at->deep, 0, nodes * sizeof(double));
    memset(at->shallow, 0, nodes * sizeof(double));
    for (size_t j = 0; j < nodes; ++j) {
        const double cells = (double)(j < within ? within : nodes - within);
        double *side = j < within ? at->deep : at->shallow;
        at->spacing[j] = (j < within ? at->pad->share : 1.0 - at->pad->share) / cells;
        side[j] += 0.5 * at->spacing[j];
        if (j + 1 < nodes)
            side[j + 1] += 0.5 * at->spacing[j];
    }
}

/* Add a conductance of so much width per length at a thickness, and its derivative by the thickness. */
static void conduct(double thick, double share, double *conductance, double *slope)
{
    *conductance += share * thick * thick * thick;
    *slope += 3.0 * share * thick * thick;
}

/* Of the recess, behind a line in its share of the length; the film has none elsewhere. */
static double depth_behind(const rf_plate *at, size_t i)
{
    return at->recessed[i] ? at->depth : 0.0;
}

/* Angle from the line before to this one. */
static double step_before(const rf_plate *at, size_t i)
{
    return 2.0 * (at->theta[i] - at->face[i - 1]);
}

static void set_conductances(rf_plate *at, size_t within)
{
    const size_t lines = at->stencil.lines, nodes = at->stencil.nodes;
    const double across = 0.5 / (at->slenderness * at->slenderness);
    double *const rows[] = {at->around, at->along, at->around_slope, at->along_slope};
    for (size_t k = 0; k < 4; ++k)
        memset(rows[k], 0, lines * nodes * sizeof(double));
    for (size_t i = 0, q = 0; i < lines; ++i) {
        const double step = 2.0 * (at->face[i] - at->theta[i]), back = i > 0 ? step_before(at, i) : 0.0;
        const double face = thickness(at, at->face[i]), line = thickness(at, at->theta[i]);
        const double behind = depth_behind(at, i), before = i > 0 ? depth_behind(at, i - 1) : 0.0;
        for (size_t j = 0; j < nodes; ++j, ++q) {
            const double inside = j < within ? 1.0 : 0.0, wide = across / at->spacing[j];
            conduct(face + behind, at->deep[j] / step, at->around + q, at->around_slope + q);
            conduct(face, at->shallow[j] / step, at->around + q, at->around_slope + q);
            conduct(line + inside * behind, wide * step, at->along + q, at->along_slope + q);
            conduct(line + inside * before, wide * back, at->along + q, at->along_slope + q);
        }
    }
}

/* What a source w, and a rate at which oil is driven over the steps, leave in every node that is not held. */
static void set_source(const rf_plate *at, const double *w, double rate, double *source)
{
    const size_t nodes = at->stencil.nodes;
    memset(source, 0, nodes * sizeof(double));
    for (size_t i = 1; i < at->stencil.lines; ++i) {
        const double smooth = at->normal[0][i] * w[0] + at->normal[1][i] * w[1];
        const double jump = rate * (depth_behind(at, i) - depth_behind(at, i - 1));
        for (size_t j = 0; j < nodes; ++j)
            source[i * nodes + j] = smooth * (at->deep[j] + at->shallow[j]) - jump * at->deep[j];
    }
}

/* The product of x (lines x nodes) and what `set_source` makes of w and rate. */
static double against(const rf_plate *at, const double *x, const double *w, double rate)
{
    const size_t nodes = at->stencil.nodes;
    double sum = 0.0;
    for (size_t i = 1; i < at->stencil.lines; ++i) {
        double whole = 0.0, deep = 0.0;
        for (size_t j = 0; j < nodes; ++j) {
            whole += x[i * nodes + j] * (at->deep[j] + at->shallow[j]);
            deep += x[i * nodes + j] * at->deep[j];
        }
        sum += (at->normal[0][i] * w[0] + at->normal[1][i] * w[1]) * whole
               - rate * (depth_behind(at, i) - depth_behind(at, i - 1)) * deep;
    }
    return sum;
}

/* x.(dA/de) P: the thickness falls by the normal. */
static void set_bent(const rf_plate *at, const double *x, double bent[2])
{
    const size_t lines = at->stencil.lines, nodes = at->stencil.nodes;
    const double *P = at->pressure;
    bent[0] = bent[1] = 0.0;
    for (size_t i = 0; i < lines; ++i) {
        double around = 0.0, along = 0.0;
        for (size_t j = 0; j < nodes; ++j) {
            const size_t q = i * nodes + j, after = i + 1 < lines ? q + nodes : j;
            const int last = j + 1 == nodes;
            around += at->around_slope[q] * (x[q] - x[after]) * (P[q] - P[after]);
            along += at->along_slope[q] * (x[q] - (last ? 0.0 : x[q + 1])) * (P[q] - (last ? 0.0 : P[q + 1]));
        }
        bent[0] -= around * cos(at->face[i]) + along * cos(at->theta[i]);
        bent[1] -= around * sin(at->face[i]) + along * sin(at->theta[i]);
    }
}

/* Guess the nodes that are full. A step drives pressure far beyond what the smooth film makes, and a film that
   grows from its source gains one line an iteration: the search begins with film everywhere, and on the finer grid
   with the nodes of the coarser and those between them. */
static void set_guess(rf_plate *at, int level)
{
    const size_t lines = at->stencil.lines, nodes = at->stencil.nodes, wide = nodes / 2;
    memset(at->full, 1, lines * nodes);
    for (size_t i = 0; i < lines && level == 0; ++i) {
        const uint8_t *here = at->known + i / 2 * wide;
        const uint8_t *after = (i + 1) / 2 < lines / 2 ? at->known + (i + 1) / 2 * wide : here;
        for (size_t j = 0; j < nodes; ++j) {
            const size_t next = (j + 1) / 2 < wide ? (j + 1) / 2 : j / 2;
            at->full[i * nodes + j] = here[j / 2] | here[next] | after[j / 2] | after[next];
        }
    }
}

int rf_solve_plate(rf_plate *at, int level, int differentiated)
{
    const size_t lines = lines_of(at->pad, level), nodes = nodes_of(at->pad, level), all = lines * nodes;
    const size_t answers = differentiated ? 2 : 0;
    const rf_stencil stencil = {lines, nodes, at->around, at->along, at->source, at->held};
    at->stencil = stencil;
    set_lines(at, level);
    set_nodes(at, level);
    set_conductances(at, (size_t)at->pad->along[0] >> level);
    set_source(at, at->w, at->rate, at->source);
    for (size_t k = 0; k < answers; ++k) {
        const double unit[2] = {k == 0, k == 1};
        set_source(at, unit, 0.0, at->answers + k * all);
    }
    memset(at->held, 0, all);
    memset(at->held, 1, nodes); /* both edges of the pad are its first line */
    memset(at->pressure, 0, all * sizeof(double));
    set_guess(at, level);
    const int status = rf_stencil_film(&at->stencil, at->pressure, at->full, answers, at->answers);
    if (level == 1)
        memcpy(at->known, at->full, all);
    return status;
}

double rf_plate_on_steps(const rf_plate *at)
{
    static const double still[2] = {0.0, 0.0};
    return 12.0 * against(at, at->pressure, still, 1.0);
}

/* A P = b(w, rate) and F_k = -12 N_k.P with N_k = b(unit k, 0), so with V_k = A^-1 N_k a change of b makes
   dF_k = -12 V_k.db, and one of A dF_k = 12 V_k.(dA P). The edge of the film is held: pressure and its slope
   vanish there. */
void rf_take_plate(const rf_plate *at, double *f, double *by)
{
    const size_t all = at->stencil.lines * at->stencil.nodes;
    static const double unit[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (size_t k = 0; k < 2; ++k) {
        f[k] = -12.0 * against(at, at->pressure, unit[k], 0.0);
        if (!by)
            continue;
        const double *answer = at->answers + k * all;
        double *row = by + RF_PLATE_COLUMNS * k, bent[2];
        set_bent(at, answer, bent);
        row[0] = 12.0 * bent[0];
        row[1] = 12.0 * bent[1];
        for (size_t m = 0; m < 3; ++m)
            row[2 + m] = -12.0 * against(at, answer, unit[m], unit[m][2]);
    }
}

