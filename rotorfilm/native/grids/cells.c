#include "cells.h"

#include <math.h>
#include <string.h>

#include "../films/quintic.h"
#include "clones.h"

#define CROWDING 0.35 /* the distance of lines at the minimum film falls as its thickness to this power */
#define TURN 6.28318530717958647692
#define LINE_ROWS 11

static int drags(const rf_ring *ring)
{
    return ring->mobility.drags || (ring->recess >= 0 && ring->depth > 0.0);
}

/* Arrays of numbers by cell. */
static size_t cell_rows(const rf_ring *ring)
{
    const size_t drawn = drags(ring) ? 6 : 4, grown = drags(ring) ? 3 : 2;
    return drawn + (ring->mobility.per_rate > 0.0 ? grown : 0);
}

size_t rf_cells_size(const rf_ring *ring, const rf_grid *grid)
{
    return LINE_ROWS * grid->lines + cell_rows(ring) * grid->lines * grid->nodes + grid->nodes;
}

/* Whether the cells between a node and the next are within the share of the recess, which lies about the middle. */
static int is_inside(const rf_cells *cells, size_t j)
{
    const size_t middle = cells->ring->whole ? cells->grid->nodes / 2 : 0, within = cells->grid->within;
    return j >= middle ? j - middle < within : middle - 1 - j < within;
}

void rf_open_cells(rf_cells *cells, const rf_ring *ring, const rf_grid *grid, double *memory)
{
    double **const by_line[LINE_ROWS] = {
        &cells->theta,      &cells->face,      &cells->at_line[0], &cells->at_line[1], &cells->at_face[0],
        &cells->at_face[1], &cells->normal[0], &cells->normal[1],  &cells->entry,      &cells->entry_slope,
        &cells->entry_grown};
    double **const by_cell[9] = {&cells->around,        &cells->along,        &cells->around_slope,
                                 &cells->along_slope,   &cells->dragged,      &cells->dragged_slope,
                                 &cells->around_grown,  &cells->along_grown,  &cells->dragged_grown};
    const int grows = ring->mobility.per_rate > 0.0;
    const size_t nodes = grid->nodes;
    cells->ring = ring;
    cells->grid = grid;
    for (int k = 0; k < LINE_ROWS; ++k, memory += grid->lines)
        *by_line[k] = memory;
    for (int k = 0; k < 9; ++k) {
        const int taken = (k < 6 || grows) && (k < 4 || k == 6 || k == 7 || drags(ring));
        *by_cell[k] = taken ? memory : NULL;
        memory += *by_cell[k] ? grid->lines * nodes : 0;
    }
    cells->deep = memory;
    memset(cells->deep, 0, nodes * sizeof(double));
    const double share = ring->whole ? 0.125 : 0.5; /* of 1/conductance: half a distance, as a part of the length */
    for (size_t j = 0; j < nodes; ++j) {
        const double half = is_inside(cells, j) ? share / grid->conductance[j] : 0.0;
        cells->deep[j] += half;
        if (j + 1 < nodes)
            cells->deep[j + 1] += half;
        else if (ring->whole)
            cells->deep[0] += half;
    }
}

/* arg(1 + conj(a) exp(i s)), or with the sign reversed arg(1 - conj(a) exp(i s)). */
static double bend(const double a[2], double s, double sign)
{
    const double c = sign * cos(s), q = sign * sin(s);
    return atan2(a[0] * q - a[1] * c, 1.0 + a[0] * c + a[1] * q);
}

static void set_angles(const rf_cells *cells, const double a[2], const double *place, double *theta)
{
    const rf_ring *ring = cells->ring;
    int32_t last = -1;
    double start = 0.0, size = 0.0;
    const double widest = atan2(-a[1], -a[0]); /* which the map of the circle leaves at its place */
    for (size_t i = 0; i < cells->grid->lines; ++i) {
        const int32_t k = cells->grid->span[i];
        if (k != last) {
            start = ring->turning ? widest : ring->start[k];
            size = ring->extent[k];
            if (ring->pinned && !ring->resting) {
                /* the s that maps to theta is theta - 2 arg(1 - conj(a) exp(i theta)) */
                const double end = start + size;
                start -= 2.0 * bend(a, start, -1.0);
                size = end - 2.0 * bend(a, end, -1.0) - start;
            }
            last = k;
        }
        /* t + a = t conj(1 + conj(a) t), so the angle is s - 2 arg(...): continuous, and never wrapped. */
        const double s = start + size * place[i];
        theta[i] = ring->resting ? s : s - 2.0 * bend(a, s, 1.0);
    }
}

static double wrapped(double angle)
{
    const double rest = fabs(angle) < TURN ? angle : fmod(angle, TURN);
    return rest < 0.0 ? rest + TURN : rest;
}

/* The least H of a pad between the ends of a span, and its place as in rf_least_film. */
static double least_on_span(const rf_ring *ring, int32_t span, const double *e, double at[2])
{
    const double half = 0.5 * ring->extent[span], middle = ring->start[span] + half;
    const double c = cos(middle), s = sin(middle), along = e[0] * c + e[1] * s, across = e[1] * c - e[0] * s;
    const double place = fmin(fmax(atan2(across, along), -half), half);
    const double least = 1.0 - along * cos(place) - across * sin(place), towards = fmax(1.0 - least, 0.0);
    at[0] = towards * cos(middle + place);
    at[1] = towards * sin(middle + place);
    return least;
}

/* The least H of a cross section. Beside the share of a recess there is land. */
static double least_across(const rf_ring *ring, const double *e, double at[2])
{
    double least = HUGE_VAL;
    at[0] = e[0];
    at[1] = e[1];
    if (!ring->pad)
        return 1.0 - rf_length(e[0], e[1]);
    for (int32_t span = 1; span < ring->spans; ++span) {
        double place[2];
        const int deep = span == ring->recess && ring->grids[0].within >= ring->grids[0].nodes;
        const double found = least_on_span(ring, span, e, place) + (deep ? ring->depth : 0.0);
        if (found < least) {
            least = found;
            at[0] = place[0];
            at[1] = place[1];
        }
    }
    return least;
}

double rf_least_film(const rf_ring *ring, const double *q, double *at)
{
    const rf_grid *grid = &ring->grids[0];
    double least = least_across(ring, q, at), beside[2];
    for (size_t k = 0; grid->place && k < 2 * grid->nodes + 3; ++k) {
        const double e[2] = {q[0] + grid->place[k] * q[2], q[1] + grid->place[k] * q[3]};
        least = fmin(least, least_across(ring, e, beside) + grid->wall[k] - 1.0);
    }
    return least;
}

double rf_depth_behind(const rf_cells *cells, size_t i)
{
    return cells->grid->span[i] == cells->ring->recess ? cells->ring->depth : 0.0;
}

/* A row of faces or nodes across the film: the depth of the recess there, and n.(e, tau). */
typedef struct strip {
    const rf_cells *cells;
    double depth, base, lean;
} strip;

static strip row_at(const rf_cells *cells, const double *q, const double n0, const double n1, double depth)
{
    const strip found = {cells, depth, q[0] * n0 + q[1] * n1, cells->grid->place ? q[2] * n0 + q[3] * n1 : 0.0};
    return found;
}

/* H at place k, on land. */
static double thickness(const strip *across, size_t k)
{
    const rf_grid *grid = across->cells->grid;
    return grid->place ? grid->wall[k] - across->base - grid->place[k] * across->lean : 1.0 - across->base;
}

/* What a face adds up, and its derivatives by the thickness and by the logarithm of the growth of the mobility. */
typedef struct sum {
    double *value, *slope, *grown;
} sum;

/* The sum of a cell; there may be none of the growth. */
static sum sum_at(double *value, double *slope, double *grown, size_t at)
{
    const sum found = {value + at, slope + at, grown ? grown + at : NULL};
    return found;
}

static void add(const sum *to, double value, double slope, double grown)
{
    *to->value += value;
    *to->slope += slope;
    if (to->grown)
        *to->grown += grown;
}

/* Add a conductance of so much width per length at a thickness. */
static void conduct(const rf_cells *cells, rf_factor way, double H, double share, const sum *to)
{
    const rf_through of = rf_pressed(&cells->ring->mobility, way, cells->growth, H);
    add(to, share * of.flow, share * of.slope, share * of.grown);
}

/* Add what walls drag over so much width of a depth beyond the smooth H. */
static void drag(const rf_cells *cells, double H, double depth, double width, const sum *to)
{
    const rf_through of = rf_dragged_beyond(&cells->ring->mobility, cells->growth, H + depth);
    add(to, width * (depth + of.flow), width * of.slope, width * of.grown);
}

/* The same of all nodes of an even face, per width. */
typedef struct once {
    double of[3];
} once;

static sum sum_of(once *all)
{
    const sum found = {all->of, all->of + 1, all->of + 2};
    return found;
}

static void share_out(const once *all, double width, const sum *to)
{
    *to->value = all->of[0] * width;
    *to->slope = all->of[1] * width;
    if (to->grown)
        *to->grown = all->of[2] * width;
}

/* The conductances to the next line, and what is dragged there. */
static void set_around(rf_cells *cells, size_t i, const strip *face, double step)
{
    const rf_grid *grid = cells->grid;
    const size_t nodes = grid->nodes, first = i * nodes;
    const double per = step > 0.0 ? 1.0 / step : 0.0; /* two openings may touch */
    const int even = !grid->place && face->depth == 0.0;
    once all = {{0.0, 0.0, 0.0}};
    const sum whole = sum_of(&all);
    if (even)
        conduct(cells, RF_AROUND, thickness(face, 0), per, &whole);
    for (size_t j = 0; j < nodes; ++j) {
        const double deep = even ? 0.0 : cells->deep[j];
        const sum to = sum_at(cells->around, cells->around_slope, cells->around_grown, first + j);
        share_out(&all, grid->width[j], &to);
        if (!even) {
            const double H = thickness(face, 2 * j + 2);
            conduct(cells, RF_AROUND, H, per * (grid->width[j] - deep), &to);
            conduct(cells, RF_AROUND, H + face->depth, per * deep, &to);
        }
    }
    for (size_t j = 0; cells->dragged && j < nodes; ++j) {
        const double H = thickness(face, 2 * j + 2), deep = face->depth > 0.0 ? cells->deep[j] : 0.0;
        const sum to = sum_at(cells->dragged, cells->dragged_slope, cells->dragged_grown, first + j);
        share_out(&all, 0.0, &to);
        drag(cells, H, 0.0, grid->width[j] - deep, &to);
        drag(cells, H, face->depth, deep, &to);
    }
}

/* The conductances to the next node and out of the ends, through the halves of the cells before and behind a line. */
static void set_along(rf_cells *cells, size_t i, const strip half[2], const double wide[2])
{
    const rf_ring *ring = cells->ring;
    const rf_grid *grid = cells->grid;
    const size_t nodes = grid->nodes;
    const int even = !grid->place && half[0].depth == 0.0 && half[1].depth == 0.0;
    once all = {{0.0, 0.0, 0.0}};
    const sum whole = sum_of(&all), entry = {cells->entry + i, cells->entry_slope + i, cells->entry_grown + i};
    if (even)
        conduct(cells, RF_ALONG, thickness(half, 0), wide[0] + wide[1], &whole);
    for (size_t j = 0; j < nodes; ++j) {
        const sum to = sum_at(cells->along, cells->along_slope, cells->along_grown, i * nodes + j);
        share_out(&all, grid->conductance[j], &to);
        for (int k = 0; k < 2 && !even; ++k) {
            const double depth = is_inside(cells, j) ? half[k].depth : 0.0;
            conduct(cells, RF_ALONG, thickness(half, 2 * j + 3) + depth, wide[k] * grid->conductance[j], &to);
        }
    }
    *entry.value = *entry.slope = *entry.grown = 0.0;
    for (int k = 0; k < 2 && ring->whole; ++k)
        conduct(cells, RF_ALONG, thickness(half, 1) + (grid->within > nodes / 2 ? half[k].depth : 0.0),
                wide[k] * grid->conductance[nodes - 1], &entry);
}

void rf_set_cells(rf_cells *cells, const double *q, double rate)
{
    const rf_ring *ring = cells->ring;
    const size_t n = cells->grid->lines;
    double place[2];
    rf_least_film(ring, q, place);
    const double depth = 1.0 + pow(1.0 - place[0] * place[0] - place[1] * place[1], CROWDING);
    const double a[2] = {place[0] / depth, place[1] / depth}, across = 1.0 / (ring->slenderness * ring->slenderness);
    cells->growth = rf_growth(&ring->mobility, rate);
    set_angles(cells, a, cells->grid->line, cells->theta);
    set_angles(cells, a, cells->grid->face, cells->face);
    for (size_t i = 0; i < n; ++i) {
        cells->at_line[0][i] = cos(cells->theta[i]);
        cells->at_line[1][i] = sin(cells->theta[i]);
        cells->at_face[0][i] = cos(cells->face[i]);
        cells->at_face[1][i] = sin(cells->face[i]);
    }
    for (size_t i = 0, before = n - 1; i < n; before = i++) {
        const double line = cells->theta[i], *const *at = (const double *const *)cells->at_line;
        const double wide[2] = {across * wrapped(line - cells->face[before]),
                                across * wrapped(cells->face[i] - line)};
        const strip half[2] = {row_at(cells, q, at[0][i], at[1][i], rf_depth_behind(cells, before)),
                             row_at(cells, q, at[0][i], at[1][i], rf_depth_behind(cells, i))};
        const strip face = row_at(cells, q, cells->at_face[0][i], cells->at_face[1][i], rf_depth_behind(cells, i));
        set_around(cells, i, &face, wrapped(cells->theta[i + 1 < n ? i + 1 : 0] - line));
        set_along(cells, i, half, wide);
        cells->normal[0][i] = cells->at_face[1][i] - cells->at_face[1][before];
        cells->normal[1][i] = cells->at_face[0][before] - cells->at_face[0][i];
    }
}

/* What is dragged through the face after a line beyond what comes through the one before, per rate. */
static double spread(const rf_cells *cells, size_t i, size_t j)
{
    const size_t nodes = cells->grid->nodes, before = i > 0 ? i - 1 : cells->grid->lines - 1;
    return cells->dragged[i * nodes + j] - cells->dragged[before * nodes + j];
}

void rf_set_source(const rf_cells *cells, const double *drive, double *source)
{
    const rf_grid *grid = cells->grid;
    for (size_t i = 0; i < grid->lines; ++i) {
        const double n0 = cells->normal[0][i], n1 = cells->normal[1][i], around = n0 * drive[0] + n1 * drive[1];
        double *row = source + i * grid->nodes;
        for (size_t j = 0; j < grid->nodes; ++j)
            row[j] = around * grid->width[j];
        for (size_t j = 0; grid->place && j < grid->nodes; ++j)
            row[j] += (n0 * drive[2] + n1 * drive[3]) * grid->place[2 * j + 2] * grid->width[j];
        for (size_t j = 0; cells->dragged && drive[4] != 0.0 && j < grid->nodes; ++j)
            row[j] -= drive[4] * spread(cells, i, j);
    }
}

void rf_multiply(const rf_cells *cells, const double *x, double products[RF_DRIVES])
{
    const rf_grid *grid = cells->grid;
    memset(products, 0, RF_DRIVES * sizeof(double));
    for (size_t i = 0; i < grid->lines; ++i) {
        const double *row = x + i * grid->nodes;
        double mean = 0.0, moment = 0.0;
        for (size_t j = 0; j < grid->nodes; ++j)
            mean += row[j] * grid->width[j];
        for (size_t j = 0; grid->place && j < grid->nodes; ++j)
            moment += row[j] * grid->width[j] * grid->place[2 * j + 2];
        for (size_t j = 0; cells->dragged && j < grid->nodes; ++j)
            products[4] -= row[j] * spread(cells, i, j);
        for (int m = 0; m < 2; ++m) {
            products[m] += cells->normal[m][i] * mean;
            products[2 + m] += cells->normal[m][i] * moment;
        }
    }
}

/* Add what a fall of the thickness by n, over one row of slopes, changes. */
static void add_bent(const double *const n[2], size_t i, double even, double leaning, double bent[RF_FREEDOMS])
{
    for (int m = 0; m < 2; ++m) {
        bent[m] -= n[m][i] * even;
        bent[2 + m] -= n[m][i] * leaning;
    }
}

/* What the growth of a mobility changes at a cell. */
static double grown(const rf_cells *cells, size_t q, double fall, double drop, double beyond, double beside, double rate)
{
    const double flux = cells->dragged_grown ? rate * cells->dragged_grown[q] : 0.0;
    return fall * (cells->around_grown[q] * drop + flux) + cells->along_grown[q] * beyond * beside;
}

void rf_bend(const rf_cells *cells, const double *x, const double *pressure, double rate, double bent[RF_FREEDOMS + 1])
{
    const rf_grid *grid = cells->grid;
    const size_t lines = grid->lines, nodes = grid->nodes;
    const double *place = grid->place;
    memset(bent, 0, (RF_FREEDOMS + 1) * sizeof(double));
    for (size_t i = 0; i < lines; ++i) {
        const double *X = x + i * nodes, *after = x + (i + 1 < lines ? i + 1 : 0) * nodes;
        const double *P = pressure + i * nodes, *beyond = pressure + (after - x);
        double sums[4] = {0.0, 0.0, 0.0, 0.0};
        for (size_t j = 0, q = i * nodes; j < nodes; ++j, ++q) {
            const int last = j + 1 == nodes;
            const double flux = cells->dragged && rate != 0.0 ? rate * cells->dragged_slope[q] : 0.0;
            const double around = (X[j] - after[j]) * (cells->around_slope[q] * (P[j] - beyond[j]) + flux);
            const double fall = X[j] - (last ? 0.0 : X[j + 1]), drop = P[j] - (last ? 0.0 : P[j + 1]);
            const double along = cells->along_slope[q] * fall * drop;
            if (cells->around_grown)
                bent[RF_FREEDOMS] += grown(cells, q, X[j] - after[j], P[j] - beyond[j], fall, drop, rate);
            sums[0] += around;
            sums[1] += along;
            if (place) {
                sums[2] += around * place[2 * j + 2];
                sums[3] += along * place[2 * j + 3];
            }
        }
        if (place) {
            const double entry = cells->entry_slope[i] * X[0] * P[0];
            bent[RF_FREEDOMS] += cells->entry_grown[i] * X[0] * P[0];
            sums[1] += entry;
            sums[3] += entry * place[1];
        }
        add_bent((const double *const *)cells->at_face, i, sums[0], sums[2], bent);
        add_bent((const double *const *)cells->at_line, i, sums[1], sums[3], bent);
    }
}
