#include "oil_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../status.h"

#define ROUNDOFF 1e-12 /* of the pressure at the ends, that of the film beside them: nothing flows there */

static double extent_of(const rf_oil_shape *shape, size_t i)
{
    return 0.5 * (shape->spacing[i] + shape->spacing[i > 0 ? i - 1 : shape->lines - 1]);
}

double rf_cell_area(const rf_oil_shape *shape, size_t q)
{
    return extent_of(shape, q / shape->nodes) * shape->width[q % shape->nodes];
}

rf_oil_gap rf_gap_in(const rf_oil_shape *shape, const double *numbers)
{
    const size_t all = shape->lines * shape->nodes;
    const rf_oil_gap gap = {numbers, numbers + all, numbers + 2 * all};
    return gap;
}

static double at(const double *direction, size_t lines, double full, const double *e)
{
    return full - (e[0] * direction[0] + e[1] * direction[lines]);
}

/* The wall of the centered journal: at a face, before a line or behind it. */
enum side { AT_FACE, BEFORE, BEHIND };

static double wall_at(const rf_oil_shape *shape, enum side side, size_t i)
{
    return shape->wall ? shape->wall[side * shape->lines + i] : 1.0;
}

/* Depth between a line and the next. */
static double depth_at(const rf_oil_shape *shape, size_t i, size_t j)
{
    return shape->depth ? shape->depth[i * shape->nodes + j] : 0.0;
}

static size_t line_before(const rf_oil_shape *shape, size_t i)
{
    return i > 0 ? i - 1 : shape->lines - 1;
}

/* Of numbers before and behind a line, by what its cell has of both sides. */
static double mean_of_halves(const rf_oil_shape *shape, size_t i, double before, double behind)
{
    const double *spacing = shape->spacing, first = spacing[line_before(shape, i)];
    return before == behind ? before : (first * before + spacing[i] * behind) / (first + spacing[i]);
}

void rf_circular_gap(const rf_oil_shape *shape, double full, const double *place, double *numbers)
{
    const size_t n = shape->lines, m = shape->nodes;
    double *line = numbers, *face = line + n * m, *side = face + n * m;
    for (size_t i = 0; i < n; ++i, side += m + 1) {
        const double *here = shape->direction + i, *beyond = here + 2 * n;
        const double tilt = at(here, n, 0.0, place + 2), onward = at(beyond, n, 0.0, place + 2);
        const double land = mean_of_halves(shape, i, wall_at(shape, BEFORE, i), wall_at(shape, BEHIND, i));
        const double mean = at(here, n, full * land, place);
        const double means = at(beyond, n, full * wall_at(shape, AT_FACE, i), place);
        double z = shape->whole ? -1.0 : 0.0;
        side[0] = mean + z * tilt;
        for (size_t j = 0; j < m; ++j) {
            const double half = (shape->whole ? 1.0 : 0.5) * shape->width[j];
            const double before = depth_at(shape, line_before(shape, i), j), behind = depth_at(shape, i, j);
            line[i * m + j] = mean + (z + half) * tilt + full * mean_of_halves(shape, i, before, behind);
            face[i * m + j] = means + (z + half) * onward + full * behind;
            z += 2.0 * half;
            side[j + 1] = mean + z * tilt;
        }
    }
}

/* What equations are set: in a gap, or their derivatives by a slope of the gap or by the rate. */
typedef struct setting {
    const rf_oil_shape *shape;
    const rf_oil_gap *gap, *slope;
    double rate, growth;
    int by_rate;
    rf_through last[RF_FACTORS]; /* what was found for the last thicknesses, as many cells have the same */
    double thickness[RF_FACTORS], thick[RF_FACTORS];
} setting;

/* At a face after a line (q) or along it, whose numbers follow. */
static rf_through through(setting *self, rf_factor way, size_t q, double H)
{
    const rf_oil_shape *shape = self->shape;
    const size_t face = way == RF_ALONG ? shape->lines * shape->nodes + q : q;
    const double thick = shape->thick ? shape->thick[face] : 1.0, growth = self->growth / thick;
    if (H != self->thickness[way] || thick != self->thick[way]) {
        const rf_mobility *mobility = &shape->mobility;
        self->thickness[way] = H;
        self->thick[way] = thick;
        self->last[way] = way == RF_OF_DRAG ? rf_dragged_beyond(mobility, growth, H) : rf_pressed(mobility, way, growth, H);
    }
    return self->last[way];
}

/* The flow, or its derivative: by a rate that growth is in proportion to, and by one that is a factor of it too. */
static double taken(const setting *self, rf_through of, double slope)
{
    if (self->by_rate)
        return self->rate != 0.0 && self->shape->mobility.per_rate > 0.0 ? of.grown / self->rate : 0.0;
    return self->slope ? of.slope * slope : of.flow;
}

/* One gap behind the other, of which the second has a share of the length. */
static rf_through in_series(rf_through first, rf_through second, double share)
{
    const double a = (1.0 - share) / first.flow, b = share / second.flow, flow = 1.0 / (a + b), square = flow * flow;
    const rf_through found = {
        flow,
        square * (a * first.slope / first.flow + b * second.slope / second.flow),
        square * (a * first.grown / first.flow + b * second.grown / second.flow),
    };
    return found;
}

/* What flows along at the face before cell j of a line, on one side of the line, which has the depths of line `of`. */
static rf_through through_side(setting *self, size_t i, size_t of, size_t j)
{
    const rf_oil_shape *shape = self->shape;
    const size_t m = shape->nodes, q = i * (m + 1) + j;
    const double H = self->gap->side[q];
    if (!shape->depth)
        return through(self, RF_ALONG, q, H);
    size_t near = j > 0 ? j - 1 : j, far = j < m ? j : j - 1;
    if (shape->opening[i * m + near] != RF_FILM_CELL)
        near = far;
    else if (shape->opening[i * m + far] != RF_FILM_CELL)
        far = near;
    const double first = depth_at(shape, of, near), second = depth_at(shape, of, far);
    const rf_through land = through(self, RF_ALONG, q, H + first);
    if (first == second)
        return land;
    return in_series(land, through(self, RF_ALONG, q, H + second),
                     shape->width[far] / (shape->width[near] + shape->width[far]));
}

/* The conductance of the face before cell j of a line. */
static double conducted_along(setting *self, size_t i, size_t j)
{
    const rf_oil_shape *shape = self->shape;
    const size_t before = line_before(shape, i), q = i * (shape->nodes + 1) + j;
    const double slope = self->slope ? self->slope->side[q] : 0.0;
    double sum = taken(self, through_side(self, i, i, j), slope);
    if (!shape->depth)
        return sum * extent_of(shape, i) * shape->along[q];
    sum *= 0.5 * shape->spacing[i];
    sum += 0.5 * shape->spacing[before] * taken(self, through_side(self, i, before, j), slope);
    return sum * shape->along[q];
}

/* What walls carry over a face per width. */
static double carried(setting *self, size_t q)
{
    const double *dragged = self->shape->dragged, H = self->gap->face[q], share = dragged ? dragged[q] : 1.0;
    const double slope = self->slope ? self->slope->face[q] : 0.0;
    const rf_through beyond = through(self, RF_OF_DRAG, q, H);
    if (self->by_rate)
        return H * share + beyond.flow + self->rate * taken(self, beyond, 0.0);
    return self->rate * ((self->slope ? slope : H) * share + taken(self, beyond, slope));
}

static void set_equations(setting *self, double storing, rf_oil_cells *cells, double *numbers)
{
    const rf_oil_shape *shape = self->shape;
    const rf_oil_gap *gap = self->gap, *slope = self->slope;
    const size_t n = shape->lines, m = shape->nodes, all = n * m;
    const double covered = (shape->whole ? 2.0 : 1.0) * shape->slenderness, square = covered * covered;
    double *wedge = numbers, *around = wedge + all, *store = around + all, *along = store + all;
    self->growth = rf_growth(&shape->mobility, self->rate);
    for (size_t q = 0, side = 0; q < all; ++q, ++side) {
        const size_t i = q / m, j = q % m;
        const double ease = shape->around ? shape->around[q] : 1.0;
        const double pressed = taken(self, through(self, RF_AROUND, q, gap->face[q]), slope ? slope->face[q] : 0.0);
        wedge[q] = carried(self, q) * shape->width[j];
        around[q] = pressed / shape->spacing[i] * ease * shape->width[j];
        store[q] = storing * (slope ? slope : gap)->line[q] * extent_of(shape, i) * shape->width[j];
        if (j == 0)
            along[side++] = conducted_along(self, i, 0) / square;
        along[side] = conducted_along(self, i, j + 1) / square;
    }
    const rf_oil_cells set = {
        n, m, shape->openings, wedge, around, store, along, NULL, shape->first_pressure, shape->last_pressure,
        shape->opening, shape->fed, shape->flow, self->rate < 0.0,
    };
    *cells = set;
}

void rf_set_oil(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_gap *slope, double rate, double storing,
                rf_oil_cells *cells, double *numbers)
{
    setting self = {.shape = shape, .gap = gap, .slope = slope, .rate = rate, .thickness = {NAN, NAN, NAN, NAN}};
    set_equations(&self, storing, cells, numbers);
}

void rf_set_oil_by_rate(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, rf_oil_cells *cells, double *numbers)
{
    setting self = {.shape = shape, .gap = gap, .rate = rate, .by_rate = 1, .thickness = {NAN, NAN, NAN, NAN}};
    set_equations(&self, 0.0, cells, numbers);
}

double rf_least_gap(const rf_oil_shape *shape, const double *e)
{
    const size_t n = shape->lines, m = shape->nodes;
    double least = HUGE_VAL;
    for (size_t q = 0; q < n * m; ++q) {
        const size_t i = q / m, j = q % m, before = line_before(shape, i), beyond = i + 1 < n ? q + m : j;
        const int here = shape->opening[q] == RF_FILM_CELL, there = shape->opening[beyond] == RF_FILM_CELL;
        const double *direction = shape->direction + i, depth = depth_at(shape, i, j);
        if (here || there) {
            least = fmin(least, at(direction + 2 * n, n, wall_at(shape, AT_FACE, i), e) + depth);
            least = fmin(least, at(direction, n, wall_at(shape, BEHIND, i), e) + depth);
        }
        if (here || shape->opening[before * m + j] == RF_FILM_CELL)
            least = fmin(least, at(direction, n, wall_at(shape, BEFORE, i), e) + depth_at(shape, before, j));
    }
    return least;
}

void rf_hold_openings(const rf_oil_shape *shape, double *pressure, double *theta)
{
    for (size_t q = 0; q < shape->lines * shape->nodes; ++q) {
        const int32_t k = shape->opening[q];
        pressure[q] = k != RF_FILM_CELL && !shape->fed[k] ? shape->pressure[k] : 0.0;
        theta[q] = 1.0;
    }
}

static double onto_journal(const rf_oil_shape *shape, const double *pressure, const double *direction)
{
    double sum = 0.0;
    for (size_t i = 0; i < shape->lines; ++i) {
        double along = 0.0;
        for (size_t j = 0; j < shape->nodes; ++j)
            along += shape->width[j] * (pressure[i * shape->nodes + j] - shape->last_pressure);
        sum += direction[i] * extent_of(shape, i) * along;
    }
    return -12.0 * sum;
}

/* Through an end of the film, out and in. */
static void add_end_flow(double conductance, double pressure, double outside, double *sums)
{
    const double fall = pressure - outside;
    if (fabs(fall) > ROUNDOFF * outside)
        sums[fall > 0.0 ? RF_OIL_OUT : RF_OIL_DRAWN_IN] += fabs(conductance * fall);
}

int rf_oil_sums(const rf_oil_shape *shape, const rf_oil_gap *gap, const rf_oil_cells *cells, const double *pressure,
                const double *theta, double *sums)
{
    const size_t n = shape->lines, m = shape->nodes;
    double *outflow = malloc(n * m * sizeof *outflow);
    if (!outflow)
        return RF_MEMORY;
    memset(sums, 0, RF_OIL_SUMS * sizeof *sums);
    for (size_t k = 0; k < 2; ++k)
        sums[RF_OIL_FORCE + k] = onto_journal(shape, pressure, shape->direction + k * n);
    rf_oil_outflow(cells, pressure, theta, outflow);
    for (size_t q = 0; q < n * m; ++q) {
        sums[RF_OIL_INFLOW] += shape->opening[q] != RF_FILM_CELL ? outflow[q] : 0.0;
        sums[RF_OIL_VOLUME] += theta[q] * gap->line[q] * rf_cell_area(shape, q);
    }
    for (size_t i = 0; i < n; ++i) {
        const double *along = cells->along + i * (m + 1), *p = pressure + i * m;
        add_end_flow(along[m], p[m - 1], cells->last_pressure, sums);
        if (shape->whole)
            add_end_flow(along[0], p[0], cells->first_pressure, sums);
        else
            sums[RF_OIL_INFLOW] += along[0] * (cells->first_pressure - p[0]);
    }
    free(outflow);
    return RF_OK;
}

int rf_oil_slopes(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, double storing, const double *pressure,
                  const double *theta, size_t freedoms, double *moved, double *held)
{
    const size_t all = shape->lines * shape->nodes;
    double *numbers = malloc((rf_gap_numbers(shape) + rf_equation_numbers(shape)) * sizeof *numbers);
    if (!numbers)
        return RF_MEMORY;
    for (size_t k = 0; k < freedoms; ++k) {
        double place[RF_OIL_FREEDOMS] = {0.0};
        rf_oil_cells cells;
        place[k] = 1.0;
        rf_circular_gap(shape, 0.0, place, numbers);
        const rf_oil_gap slope = rf_gap_in(shape, numbers);
        rf_set_oil(shape, gap, &slope, rate, storing, &cells, numbers + rf_gap_numbers(shape));
        rf_oil_outflow(&cells, pressure, theta, moved + k * all);
        for (size_t q = 0; q < all; ++q)
            held[k * all + q] = theta[q] * rf_cell_area(shape, q) * slope.line[q];
    }
    free(numbers);
    return RF_OK;
}
