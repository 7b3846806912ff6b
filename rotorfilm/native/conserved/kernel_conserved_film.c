/* Kernel "conserved_film": the film of a journal bearing or of a damper that conserves its oil, and steps by itself.

   Parameters viscosity [Pa s]; where table film says so supply_pressure [Pa] or supply_flow of each opening [m3/s]; where it
   says so stiffness [N/m]. Inputs x, y, vx, vy [m, m/s], speed [rad/s] at the end of a step. Outputs at the end of the last
   step: force_x, force_y [N], side_flow, drawn_in, inflow [m3/s], oil_volume [m3]; over that step
   mean_side_flow, mean_drawn_in, mean_inflow [m3/s].
   Tables: film (11: radius, clearance [m], film area [m2], length/diameter, cavitation pressure [Pa], share of the speed that
   carries oil, limits of inner steps as rf_oil_film_si has them, whether there is a supply, whether it is a flow, whether
   there are springs), lines (5 x N: spacing, direction), along (N x (M + 1)), opening (N x M), width (M), supplied (of the
   openings, with one more: whether it is at the supply); of pads wall (3 x N) and depth (N x M) as in oil_shape.h; where
   the film has a mobility those of grids/mobility.h. */

/* Documentation of the FMU

   Model: Film that conserves its oil where it ruptures (Jakobsson, Floberg, Olsson), around a journal that moves. Where the film
   ruptures the oil goes on in a gap that it fills in part, until there is enough to start the film again; so the film
   remembers, and steps by itself: Co-Simulation only. When initialization ends the film is the steady one of a journal at
   rest at the start values. x, y, vx, vy, speed are the motion at the end of a step; on the way there the journal goes along
   the cubic with the positions and velocities of both ends, in inner steps of a part of a turn, by differences of second
   order (BDF2) and limited transport (van Leer), halved where the film is not found. Outputs belong to the end of the last
   step: force on the journal, flows out of and into the ends, inflow from the openings, oil in the gap. The mean flows are
   those over the whole communication step, by the same differences as the oil, so that to round-off
   oil_volume - oil_volume before = step (mean_inflow + mean_drawn_in - mean_side_flow).

   Equations:
   d(theta H)/dt + rate d(theta H)/dxi = d(H^3 dP/dxi)/dxi + (2 radius/length)^2 d(H^3 dP/dz)/dz
   P >= 0,  theta <= 1,  P (1 - theta) = 0,  H = A - (x cos xi + y sin xi)/clearance, A = 1 in a bore
   F = -12 viscosity area (radius/clearance)^2 integral of (P - P_end) (cos xi, sin xi)

   Validity: Finite volumes, of second order. Isothermal, aligned; laminar unless there is a mobility, whose factors of
   H^3 are those of the full gap. Cells, openings and ends are those of the model;
   viscosity and supply may change between steps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../kernels/kernel.h"
#include "oil_travel.h"

#define MOST_LINES 10000u

enum { RADIUS, CLEARANCE, AREA, SLENDERNESS, CAVITY, CARRYING, ANGLE, WAY, SUPPLIED, FLOWS, SPRINGS, NUMBERS };

typedef struct model {
    rf_oil_film_si film;
    const double *is; /* table film */
    const double *at_supply;
    double *pressure, *flow; /* of the openings */
    int32_t *opening;
    uint8_t *fed;
    double stiffness;
} model;

static void release(void *kernel)
{
    model *self = kernel;
    free(self->pressure);
    free(self->opening);
    free(self->fed);
}

static int take_film(model *self, const rf_tables *tables, rf_message *why)
{
    const rf_table *film = rf_find_table(tables, "film", 1, why);
    if (!film)
        return RF_INVALID;
    const double *is = film->numbers;
    if (film->extent[0] != NUMBERS || !(is[RADIUS] > 0.0 && is[CLEARANCE] > 0.0 && is[AREA] > 0.0 && is[SLENDERNESS] > 0.0)
        || !(is[CAVITY] <= 0.0 && is[ANGLE] > 0.0 && is[WAY] > 0.0))
        return rf_say(why, RF_INVALID, "table film must be of a film that conserves its oil");
    self->is = is;
    self->film.clearance = is[CLEARANCE];
    self->film.carrying = is[CARRYING];
    self->film.oil = is[AREA] * is[CLEARANCE];
    self->film.largest_angle = is[ANGLE];
    self->film.largest_way = is[WAY];
    self->film.shape.slenderness = is[SLENDERNESS];
    return RF_OK;
}

static int are_positive(const double *numbers, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (!(numbers[k] > 0.0))
            return 0;
    return 1;
}

/* Of what the faces of lines conduct only the first may be closed. */
static int are_apart(const double *along, size_t n, size_t m)
{
    for (size_t i = 0; i < n; ++i)
        if (!(along[i * (m + 1)] >= 0.0 && are_positive(along + i * (m + 1) + 1, m)))
            return 0;
    return 1;
}

/* The wall of pads and the depth of their recesses, where there are some. */
static int take_wall(rf_oil_shape *shape, const rf_tables *tables, rf_message *why)
{
    const rf_table *wall = rf_seek_table(tables, "wall"), *depth = rf_seek_table(tables, "depth");
    const size_t n = shape->lines, m = shape->nodes;
    if (wall && !(wall->axes == 2 && wall->extent[0] == 3 && wall->extent[1] == n && are_positive(wall->numbers, 3 * n)))
        return rf_say(why, RF_INVALID, "table wall must be positive, of 3 x %zu numbers", n);
    if (depth && !(wall && depth->axes == 2 && depth->extent[0] == n && depth->extent[1] == m))
        return rf_say(why, RF_INVALID, "table depth must be beside a wall, of %zu x %zu numbers", n, m);
    for (size_t q = 0; depth && q < n * m; ++q)
        if (!(depth->numbers[q] >= 0.0 && depth->numbers[q] < HUGE_VAL))
            return rf_say(why, RF_INVALID, "table depth must be finite and not negative, got %.9g", depth->numbers[q]);
    shape->wall = wall ? wall->numbers : NULL;
    shape->depth = depth ? depth->numbers : NULL;
    return rf_take_mobility(&shape->mobility, tables, why);
}

static int take_openings(model *self, const double *openings, size_t all, uint32_t count, rf_message *why)
{
    rf_oil_shape *shape = &self->film.shape;
    self->opening = malloc(all * sizeof *self->opening);
    self->fed = calloc(count + 1, 1);
    self->pressure = calloc(2 * (size_t)count + 2, sizeof *self->pressure);
    if (!self->opening || !self->fed || !self->pressure)
        return rf_say(why, RF_MEMORY, "no memory for a film");
    self->flow = self->pressure + count + 1;
    for (size_t q = 0; q < all; ++q) {
        if (!(openings[q] >= RF_FILM_CELL && openings[q] < count && openings[q] == floor(openings[q])))
            return rf_say(why, RF_INVALID, "cell %zu must be film or of an opening, got %.9g", q, openings[q]);
        self->opening[q] = (int32_t)openings[q];
    }
    for (uint32_t k = 0; k < count; ++k)
        self->fed[k] = self->is[FLOWS] != 0.0;
    shape->openings = count;
    shape->opening = self->opening;
    shape->fed = self->fed;
    shape->flow = self->flow;
    shape->pressure = self->pressure;
    return RF_OK;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    rf_oil_shape *shape = &self->film.shape;
    if (take_film(self, tables, why) != RF_OK)
        return RF_INVALID;
    const rf_table *lines = rf_find_table(tables, "lines", 2, why);
    const rf_table *width = lines ? rf_find_table(tables, "width", 1, why) : NULL;
    const rf_table *along = width ? rf_find_table(tables, "along", 2, why) : NULL;
    const rf_table *opening = along ? rf_find_table(tables, "opening", 2, why) : NULL;
    const rf_table *supplied = opening ? rf_find_table(tables, "supplied", 1, why) : NULL;
    if (!supplied)
        return RF_INVALID;
    const uint32_t n = lines->extent[1], m = width->extent[0], count = supplied->extent[0] - 1;
    if (lines->extent[0] != 5 || n < 4 || n > MOST_LINES || m < 2 || m > 1000 || along->extent[0] != n
        || along->extent[1] != m + 1 || opening->extent[0] != n || opening->extent[1] != m || count > n)
        return rf_say(why, RF_INVALID, "the tables of a film must fit each other, got %u x %u cells", (unsigned)n, (unsigned)m);
    if (!are_positive(lines->numbers, n) || !are_positive(width->numbers, m) || !are_apart(along->numbers, n, m))
        return rf_say(why, RF_INVALID, "cells of a film must be apart");
    shape->lines = n;
    shape->nodes = m;
    shape->spacing = lines->numbers;
    shape->direction = lines->numbers + n;
    shape->width = width->numbers;
    shape->along = along->numbers;
    self->at_supply = supplied->numbers;
    if (take_wall(shape, tables, why) != RF_OK)
        return RF_INVALID;
    const size_t parameters = 1u + (self->is[SUPPLIED] != 0.0 ? 1u : 0u) + (self->is[SPRINGS] != 0.0 ? 1u : 0u);
    *sizes = (rf_sizes){parameters, RF_MOTION, RF_OIL_ANSWERS, 0, 0};
    return take_openings(self, opening->numbers, (size_t)n * m, count, why);
}

/* Pressures over their unit, flows over theirs. */
static void set_supply(model *self, double unit, double supply)
{
    rf_oil_shape *shape = &self->film.shape;
    const double end = -self->is[CAVITY] / unit, held = self->is[FLOWS] != 0.0 ? 0.0 : supply / unit;
    for (size_t k = 0; k < shape->openings; ++k) {
        self->pressure[k] = end + (self->at_supply[k] != 0.0 ? held : 0.0);
        self->flow[k] = self->is[FLOWS] != 0.0 ? supply / self->film.oil : 0.0;
    }
    shape->last_pressure = end;
    shape->first_pressure = end + held;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    const double slope = self->is[RADIUS] / self->is[CLEARANCE];
    const int supplied = self->is[SUPPLIED] != 0.0;
    if (!(p[0] > 0.0 && p[0] < HUGE_VAL))
        return rf_say(why, RF_INVALID, "viscosity must be finite and positive, got %.9g", p[0]);
    if (supplied && !(p[1] >= 0.0 && p[1] < HUGE_VAL))
        return rf_say(why, RF_INVALID, "the supply must be finite and not negative, got %.9g", p[1]);
    set_supply(self, 12.0 * p[0] * slope * slope, supplied ? p[1] : 0.0);
    self->film.force = self->is[AREA] * p[0] * slope * slope;
    rf_scale_mobility(&self->film.shape.mobility, self->is[RADIUS], self->is[CLEARANCE], p[0]);
    self->stiffness = self->is[SPRINGS] != 0.0 ? p[1 + supplied] : 0.0;
    return RF_OK;
}

static size_t memory(const void *kernel)
{
    return rf_oil_numbers(&((const model *)kernel)->film.shape);
}

static int rest(const void *kernel, const rf_point *at, double *block, rf_message *why)
{
    return rf_oil_begin(&((const model *)kernel)->film, at->u, block, why);
}

static int step(void *kernel, const rf_point *at, double dt, double *block, rf_message *why)
{
    int64_t work[2];
    return rf_oil_travel(&((model *)kernel)->film, at->t, at->u, dt, block, work, why);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    (void)why;
    memcpy(y, at->x + RF_OIL_ANSWER, RF_OIL_ANSWERS * sizeof *y);
    for (size_t k = 0; k < 2; ++k)
        y[k] -= self->stiffness * at->x[RF_OIL_MOTION + k];
    return RF_OK;
}

const rf_kernel_type rf_conserved_film_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .release = release,
    .set_parameters = set_parameters,
    .output = output,
    .memory = memory,
    .rest = rest,
    .step = step,
};
