#include "oil_travel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALVINGS 4 /* times that all inner steps are halved before a step is given up */
#define MOST_PIECES 1e6

size_t rf_oil_numbers(const rf_oil_shape *shape)
{
    return RF_OIL_CELLS + RF_OIL_ROWS * shape->lines * shape->nodes;
}

static double *row(const rf_oil_traveler *self, size_t k)
{
    return self->block + RF_OIL_CELLS + k * self->all;
}

int rf_open_traveler(rf_oil_traveler *self, const rf_oil_film_si *film, rf_message *why)
{
    const rf_oil_shape *shape = &film->shape;
    const size_t all = shape->lines * shape->nodes, numbers = rf_oil_numbers(shape);
    self->film = film;
    self->all = all;
    self->block = calloc(numbers + rf_gap_numbers(shape) + 8 * all, sizeof *self->block);
    self->found.room = &self->room;
    if (rf_open_room(&self->room, shape) != RF_OK || !self->block)
        return rf_say(why, RF_MEMORY, "no memory for a film");
    self->gap = self->block + numbers;
    self->found.pressure = self->gap + rf_gap_numbers(shape);
    self->found.theta = self->found.pressure + all;
    self->found.old = self->found.theta + all;
    self->slopes = self->found.old + all;
    self->found.full = (uint8_t *)(self->slopes + 4 * all);
    return RF_OK;
}

void rf_close_traveler(rf_oil_traveler *self)
{
    rf_close_room(&self->room);
    free(self->block);
}

/* The least film in clearances, of a bore from its center. */
static double least_film(const rf_oil_film_si *film, const double *motion)
{
    const double place[2] = {motion[0] / film->clearance, motion[1] / film->clearance};
    return film->shape.wall ? rf_least_gap(&film->shape, place) : 1.0 - hypot(place[0], place[1]);
}

static int require_inside(const rf_oil_film_si *film, const double *motion, double t, rf_message *why)
{
    const double e = hypot(motion[0], motion[1]), least = film->clearance * least_film(film, motion);
    if (film->shape.wall ? least > 0.0 : e < film->clearance)
        return RF_OK;
    if (film->shape.wall)
        return rf_say(why, RF_AT_WALL,
                      "the journal must leave a film on every pad, got %.6g m at t = %.9g s (x = %.9g, y = %.9g)", least, t,
                      motion[0], motion[1]);
    return rf_say(why, RF_AT_WALL,
                  "the journal must stay inside the clearance %.9g m, got an eccentricity of %.6g m at t = %.9g s "
                  "(x = %.9g, y = %.9g)",
                  film->clearance, e, t, motion[0], motion[1]);
}

static int judged(int status, double t, const double *motion, rf_message *why)
{
    if (status == RF_OK)
        return RF_OK;
    if (status == RF_MEMORY)
        return rf_say(why, status, "no memory for a film");
    return rf_say(why, status,
                  "the search for the ruptured zone of a mass-conserving film did not end at t = %.9g s, x = %.9g, "
                  "y = %.9g m: the film may have no supply, or be too thin for the cells",
                  t, motion[0], motion[1]);
}

static rf_oil_gap gap_of(const rf_oil_traveler *self, const double *motion)
{
    const double place[RF_OIL_FREEDOMS] = {motion[0] / self->film->clearance, motion[1] / self->film->clearance};
    rf_circular_gap(&self->film->shape, 1.0, place, self->gap);
    return rf_gap_in(&self->film->shape, self->gap);
}

/* Set the sums of what was found, in SI units. */
static int set_answer(rf_oil_traveler *self, const rf_oil_gap *gap)
{
    const rf_oil_film_si *film = self->film;
    double *sums = self->block + RF_OIL_ANSWER;
    const int status = rf_oil_sums(&film->shape, gap, &self->room.cells, self->found.pressure, self->found.theta, sums);
    for (size_t k = 0; k < RF_OIL_SUMS; ++k)
        sums[k] *= k < RF_OIL_OUT ? film->force : film->oil;
    return status;
}

/* Set what each flow was in a step, by the very differences by which the oil in the gap changed. */
static void add_up(rf_oil_traveler *self, double dt)
{
    const double *flow = self->block + RF_OIL_ANSWER + RF_OIL_OUT;
    double *passed = self->block + RF_OIL_PASSED;
    for (size_t k = 0; k < RF_OIL_FLOWS; ++k)
        passed[k] = dt > 0.0 ? (dt * flow[k] + self->found.lag * passed[k]) / (self->found.rate * dt) : 0.0;
}

/* Take what was found as the end of a step of length dt. */
static int keep(rf_oil_traveler *self, const rf_oil_gap *gap, const double *motion, double dt)
{
    self->block[RF_OIL_LENGTH] = dt;
    memcpy(self->block + RF_OIL_MOTION, motion, RF_MOTION * sizeof *motion);
    memcpy(row(self, 1), row(self, 0), self->all * sizeof(double));
    memcpy(row(self, 2), self->found.pressure, self->all * sizeof(double));
    memcpy(row(self, 3), self->found.theta, self->all * sizeof(double));
    for (size_t q = 0; q < self->all; ++q) {
        row(self, 0)[q] = self->found.theta[q] * gap->line[q];
        row(self, 4)[q] = self->found.full[q];
    }
    const int status = set_answer(self, gap);
    add_up(self, dt);
    return status;
}

int rf_oil_begin(const rf_oil_film_si *film, const double *motion, double *block, rf_message *why)
{
    rf_oil_traveler self;
    int status = require_inside(film, motion, 0.0, why);
    if (status != RF_OK)
        return status;
    status = rf_open_traveler(&self, film, why);
    if (status == RF_OK) {
        const rf_oil_gap gap = gap_of(&self, motion);
        status = rf_oil_rest(&film->shape, &gap, film->carrying * motion[4], &self.found);
        if (status == RF_OK)
            status = keep(&self, &gap, motion, 0.0);
        status = judged(status, 0.0, motion, why);
    }
    if (status == RF_OK) {
        memcpy(row(&self, 1), row(&self, 0), self.all * sizeof(double));
        memcpy(self.block + RF_OIL_MEANS, self.block + RF_OIL_ANSWER + RF_OIL_OUT, RF_OIL_FLOWS * sizeof(double));
        memcpy(block, self.block, rf_oil_numbers(&film->shape) * sizeof *block);
    }
    rf_close_traveler(&self);
    return status;
}

/* The motion at a share of the way of a step. */
static void set_between(const double *begin, const double *end, double dt, double s, double *motion)
{
    for (size_t k = 0; k < 2; ++k) {
        const double way = end[k] - begin[k], v0 = begin[2 + k] * dt, v1 = end[2 + k] * dt;
        const double bent = v0 + v1 - 2.0 * way, turned = 3.0 * way - 2.0 * v0 - v1;
        motion[k] = begin[k] + s * (v0 + s * (turned + s * bent));
        motion[2 + k] = (v0 + s * (2.0 * turned + 3.0 * s * bent)) / dt;
    }
    motion[4] = begin[4] + s * (end[4] - begin[4]);
}

/* Set theta at the end of a step as the last two contents foresee it, which is how transport differs from upstream values. */
static void foresee(rf_oil_traveler *self, const rf_oil_gap *gap, double dt)
{
    const double last = self->block[RF_OIL_LENGTH], growth = last > 0.0 && dt <= MOST_GROWTH * last ? dt / last : 0.0;
    const double *now = row(self, 0), *before = row(self, 1), *full = row(self, 4);
    for (size_t q = 0; q < self->all; ++q) {
        const double content = now[q] + growth * (now[q] - before[q]);
        self->found.theta[q] = full[q] != 0.0 ? 1.0 : fmin(fmax(content / gap->line[q], 0.0), 1.0);
    }
}

/* One inner step, from the cells that are full in a film near that at its end. */
static int inner_step(rf_oil_traveler *self, const double *motion, double dt, const double *near, int64_t *solutions)
{
    if (!(least_film(self->film, motion) > 0.0))
        return RF_STUCK;
    const rf_oil_gap gap = gap_of(self, motion);
    const rf_oil_past past = {row(self, 0), row(self, 1), self->block[RF_OIL_LENGTH]};
    const double *full = near + RF_OIL_CELLS + 4 * self->all;
    foresee(self, &gap, dt);
    for (size_t q = 0; q < self->all; ++q)
        self->found.full[q] = full[q] != 0.0;
    const int status = rf_oil_step(&self->film->shape, &gap, self->film->carrying * motion[4], &past, dt, &self->found);
    *solutions += self->found.work.solutions;
    return status == RF_OK ? keep(self, &gap, motion, dt) : status;
}

/* -d force / d place of what was just found: the oil of the last step stays. */
static int set_stiffness(rf_oil_traveler *self, const double *motion, double *stiffness)
{
    const rf_oil_film_si *film = self->film;
    const rf_oil_shape *shape = &film->shape;
    const double rate = film->carrying * motion[4];
    const rf_oil_gap gap = rf_gap_in(shape, self->gap);
    const int status = rf_oil_slopes(shape, &gap, rate, self->found.rate, self->found.pressure, self->found.theta, 2,
                               self->slopes, self->slopes + 2 * self->all);
    if (status == RF_OK)
        rf_follow_oil(&self->room.solver, 2, self->slopes);
    memset(stiffness, 0, 4 * sizeof *stiffness);
    for (size_t k = 0; k < 4; ++k)
        for (size_t q = 0; q < self->all && status == RF_OK; ++q)
            if (self->found.full[q])
                stiffness[k] -= 12.0 * film->force / film->clearance * shape->direction[k / 2 * shape->lines + q / shape->nodes]
                                * rf_cell_area(shape, q) * self->slopes[k % 2 * self->all + q];
    return status;
}

int rf_try_oil(rf_oil_traveler *self, const double *block, const double *near, const double *motion, double dt, double *end,
               double *stiffness, int64_t *solutions)
{
    const size_t bytes = rf_oil_numbers(&self->film->shape) * sizeof *block;
    memcpy(self->block, block, bytes);
    int status = inner_step(self, motion, dt, near, solutions);
    if (status == RF_OK && stiffness)
        status = set_stiffness(self, motion, stiffness);
    for (size_t k = 0; k < RF_OIL_FLOWS; ++k)
        self->block[RF_OIL_MEANS + k] = self->block[RF_OIL_PASSED + k] / dt;
    if (status == RF_OK)
        memcpy(end, self->block, bytes);
    return status;
}

int rf_oil_attempt(const rf_oil_film_si *film, const double *block, const double *near, const double *motion, double dt,
                   double *end, double *stiffness, int64_t *work)
{
    rf_oil_traveler self;
    rf_message why;
    int status = rf_open_traveler(&self, film, &why);
    work[0] = 1;
    work[1] = 0;
    if (status == RF_OK)
        status = rf_try_oil(&self, block, near, motion, dt, end, stiffness, work + 1);
    rf_close_traveler(&self);
    return status;
}

/* Go there in so many inner steps. */
static int follow(rf_oil_traveler *self, double t, const double *begin, const double *end, double dt, int64_t pieces,
                  int64_t *work, rf_message *why)
{
    const double length = dt / (double)pieces;
    double motion[RF_MOTION], passed[RF_OIL_FLOWS] = {0.0};
    for (int64_t k = 1; k <= pieces; ++k) {
        const double share = (double)k / (double)pieces, time = t + dt * share;
        memcpy(motion, end, sizeof motion);
        if (k < pieces)
            set_between(begin, end, dt, share, motion);
        int status = require_inside(self->film, motion, time, why);
        if (status != RF_OK)
            return status;
        status = judged(inner_step(self, motion, length, self->block, work + 1), time, motion, why);
        if (status != RF_OK)
            return status;
        for (size_t i = 0; i < RF_OIL_FLOWS; ++i)
            passed[i] += self->block[RF_OIL_PASSED + i];
    }
    for (size_t i = 0; i < RF_OIL_FLOWS; ++i)
        self->block[RF_OIL_MEANS + i] = passed[i] / dt;
    work[0] = pieces;
    return RF_OK;
}

static int64_t fewest_pieces(const rf_oil_film_si *film, const double *begin, const double *end, double dt)
{
    const double angle = fmax(fabs(begin[4]), fabs(end[4])) * dt / film->largest_angle;
    const double way = hypot(end[0] - begin[0], end[1] - begin[1]) / film->clearance / film->largest_way;
    const double pieces = fmax(1.0, fmax(ceil(angle), ceil(way)));
    return pieces < MOST_PIECES ? (int64_t)pieces : -1;
}

int rf_oil_travel(const rf_oil_film_si *film, double t, const double *motion, double dt, double *block, int64_t *work,
                  rf_message *why)
{
    const double *begin = block + RF_OIL_MOTION;
    const size_t bytes = rf_oil_numbers(&film->shape) * sizeof *block;
    const int64_t fewest = fewest_pieces(film, begin, motion, dt);
    rf_oil_traveler self;
    work[0] = work[1] = 0;
    if (fewest < 0)
        return rf_say(why, RF_STUCK, "a step of %.9g s must not have more than %g inner steps", dt, MOST_PIECES);
    int status = require_inside(film, motion, t + dt, why);
    if (status != RF_OK)
        return status;
    status = rf_open_traveler(&self, film, why);
    for (int halving = 0; status == RF_OK && halving <= HALVINGS; ++halving) {
        memcpy(self.block, block, bytes);
        status = follow(&self, t, begin, motion, dt, fewest << halving, work, why);
        if (status != RF_STUCK || halving == HALVINGS)
            break;
        status = RF_OK;
    }
    if (status == RF_OK)
        memcpy(block, self.block, bytes);
    rf_close_traveler(&self);
    return status;
}
