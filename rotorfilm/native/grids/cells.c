#include "cells.h"

#include <math.h>

#include "../films/quintic.h"
#include "clones.h"

#define CROWDING 0.35 /* the distance of lines at the minimum film falls as its thickness to this power */
#define TURN 6.28318530717958647692

void rf_place_cells(rf_cells *cells, double *memory, size_t n)
{
    double **const rows[RF_CELL_ROWS] = {
        &cells->theta,           &cells->face,           &cells->around,         &cells->along,
        &cells->around_slope[0], &cells->around_slope[1], &cells->along_slope[0], &cells->along_slope[1],
        &cells->normal[0],       &cells->normal[1]};
    for (size_t k = 0; k < RF_CELL_ROWS; ++k)
        *rows[k] = memory + k * n;
}

/* arg(1 + conj(a) exp(i s)), or with the sign reversed arg(1 - conj(a) exp(i s)). */
static double bend(const double a[2], double s, double sign)
{
    const double c = sign * cos(s), q = sign * sin(s);
    return atan2(a[0] * q - a[1] * c, 1.0 + a[0] * c + a[1] * q);
}

static void set_angles(const rf_ring *ring, const rf_grid *grid, const double a[2], const double *place,
                       double *theta)
{
    int32_t last = -1;
    double start = 0.0, size = 0.0;
    const double widest = atan2(-a[1], -a[0]); /* which the map of the circle leaves at its place */
    for (size_t i = 0; i < grid->lines; ++i) {
        const int32_t k = grid->span[i];
        if (k != last) {
            start = ring->turning ? widest : ring->start[k];
            size = ring->extent[k];
            if (ring->pinned) { /* the s that maps to theta is theta - 2 arg(1 - conj(a) exp(i theta)) */
                const double end = start + size;
                start -= 2.0 * bend(a, start, -1.0);
                size = end - 2.0 * bend(a, end, -1.0) - start;
            }
            last = k;
        }
        /* t + a = t conj(1 + conj(a) t), so the angle is s - 2 arg(...): continuous, and never wrapped. */
        const double s = start + size * place[i];
        theta[i] = s - 2.0 * bend(a, s, 1.0);
    }
}

static double wrapped(double angle)
{
    const double rest = fmod(angle, TURN);
    return rest < 0.0 ? rest + TURN : rest;
}

/* factor H^3, and its derivative in e. */
static double cubed(const double *e, double cosine, double sine, double factor, double slope[2])
{
    const double film = 1.0 - e[0] * cosine - e[1] * sine, by_film = -3.0 * factor * film * film;
    slope[0] = by_film * cosine;
    slope[1] = by_film * sine;
    return factor * film * film * film;
}

double rf_least_film(const rf_ring *ring, const double *e, double at[2])
{
    at[0] = e[0];
    at[1] = e[1];
    if (!ring->pad)
        return 1.0 - rf_length(e[0], e[1]);
    const double half = 0.5 * ring->extent[1], middle = ring->start[1] + half;
    const double c = cos(middle), s = sin(middle), along = e[0] * c + e[1] * s, across = e[1] * c - e[0] * s;
    const double place = fmin(fmax(atan2(across, along), -half), half), least = 1.0 - along * cos(place) - across * sin(place);
    const double towards = fmax(1.0 - least, 0.0);
    at[0] = towards * cos(middle + place);
    at[1] = towards * sin(middle + place);
    return least;
}

void rf_set_cells(const rf_ring *ring, const rf_grid *grid, const double *e, rf_cells *cells)
{
    const size_t n = grid->lines;
    double place[2];
    rf_least_film(ring, e, place);
    const double depth = 1.0 + pow(1.0 - place[0] * place[0] - place[1] * place[1], CROWDING);
    const double a[2] = {place[0] / depth, place[1] / depth}, across = 1.0 / (ring->slenderness * ring->slenderness);
    set_angles(ring, grid, a, grid->line, cells->theta);
    set_angles(ring, grid, a, grid->face, cells->face);
    double before = cells->face[n - 1], cosine = cos(before), sine = sin(before);
    for (size_t i = 0; i < n; ++i) {
        const double line = cells->theta[i], face = cells->face[i], next = cells->theta[i + 1 < n ? i + 1 : 0];
        const double c = cos(face), s = sin(face);
        double slope[2];
        cells->around[i] = cubed(e, c, s, 1.0 / wrapped(next - line), slope);
        cells->around_slope[0][i] = slope[0];
        cells->around_slope[1][i] = slope[1];
        cells->along[i] = cubed(e, cos(line), sin(line), across * wrapped(face - before), slope);
        cells->along_slope[0][i] = slope[0];
        cells->along_slope[1][i] = slope[1];
        cells->normal[0][i] = s - sine;
        cells->normal[1][i] = cosine - c;
        before = face;
        cosine = c;
        sine = s;
    }
}

void rf_set_source(const rf_grid *grid, const rf_cells *cells, const double *w, double *source)
{
    for (size_t i = 0; i < grid->lines; ++i) {
        const double around = cells->normal[0][i] * w[0] + cells->normal[1][i] * w[1];
        for (size_t j = 0; j < grid->nodes; ++j)
            source[i * grid->nodes + j] = around * grid->width[j];
    }
}

void rf_set_film_force(const rf_grid *grid, const rf_cells *cells, const double *pressure, double *f)
{
    double sum[2] = {0.0, 0.0};
    for (size_t i = 0; i < grid->lines; ++i) {
        double mean = 0.0;
        for (size_t j = 0; j < grid->nodes; ++j)
            mean += pressure[i * grid->nodes + j] * grid->width[j];
        sum[0] += cells->normal[0][i] * mean;
        sum[1] += cells->normal[1][i] * mean;
    }
    f[0] = -12.0 * sum[0];
    f[1] = -12.0 * sum[1];
}

RF_CLONES
static void set_flow(const rf_grid *grid, const double *around, const double *along, const double *pressure,
                     double *flow)
{
    const size_t lines = grid->lines, nodes = grid->nodes;
    for (size_t i = 0; i < lines; ++i) {
        const double *here = pressure + i * nodes;
        const double *after = pressure + (i + 1 < lines ? i + 1 : 0) * nodes;
        const double *before = pressure + (i > 0 ? i - 1 : lines - 1) * nodes;
        const double out = around[i], in = around[i > 0 ? i - 1 : lines - 1];
        double *q = flow + i * nodes;
        for (size_t j = 0; j < nodes; ++j)
            q[j] = grid->width[j] * (out * (here[j] - after[j]) + in * (here[j] - before[j]));
        for (size_t j = 0; j < nodes; ++j) {
            const double axial = along[i] * grid->conductance[j] * (here[j] - (j + 1 < nodes ? here[j + 1] : 0.0));
            q[j] += axial;
            if (j + 1 < nodes)
                q[j + 1] -= axial;
        }
    }
}

void rf_set_flow(const rf_grid *grid, const double *around, const double *along, const double *pressure,
                 double *flow)
{
    set_flow(grid, around, along, pressure, flow);
}
