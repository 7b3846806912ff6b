#include "oil_steps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../status.h"

#define EMPTY (-1e-9)   /* content below which a difference took more oil from a cell than it had */
#define STILL 1e-13     /* change of theta at which the steady film stands */
#define STILL_ENOUGH 1e-9 /* change that it must have come below at the end */
#define MOST_STILL 1000 /* solutions on the way there, 60 as a rule, hundreds at times; of which ... */
#define WEIGHT 0.7      /* ... each counts so much */

static size_t neighbor(const rf_oil_shape *shape, size_t i, int forward)
{
    if (forward)
        return i + 1 < shape->lines ? i + 1 : 0;
    return i > 0 ? i - 1 : shape->lines - 1;
}

/* Of a line as the oil goes: by how much theta at the face behind it is above its own.

   Theta of the last cell before a film says how far the film reaches into it, and is no slope of the oil that arrives:
   there is no rise behind that cell. Behind the cell before, the slope is that of the oil which arrives, and fades as the
   last cell fills, so that nothing jumps when the film enters the next cell. */
static double rise(const rf_oil_shape *shape, size_t i, size_t j, int forward, const double *theta)
{
    const size_t m = shape->nodes, next = neighbor(shape, i, forward);
    const double here = theta[i * m + j], there = theta[next * m + j];
    const double behind = here - theta[neighbor(shape, i, !forward) * m + j];
    double ahead = there - here, share = 1.0;
    if (there >= 1.0 || !(behind * ahead > 0.0))
        return 0.0;
    if (theta[neighbor(shape, next, forward) * m + j] >= 1.0 && ahead > behind) {
        share = behind < 1.0 - here ? (1.0 - there) / (1.0 - here - behind) : 0.0;
        ahead = behind;
    }
    return share * behind * ahead / (behind + ahead);
}

void rf_sharpen_oil(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, const double *theta, double *carried)
{
    const size_t m = shape->nodes;
    const int forward = rate >= 0.0;
    memset(carried, 0, shape->lines * m * sizeof *carried);
    for (size_t i = 0; i < shape->lines; ++i) {
        const size_t after = neighbor(shape, i, 1), up = forward ? i : after;
        for (size_t j = 0; j < m; ++j) {
            const double flux = rate * gap->face[i * m + j] * rise(shape, up, j, forward, theta) * shape->width[j];
            carried[i * m + j] += flux;
            carried[after * m + j] -= flux;
        }
    }
}

/* y' = (a y_n+1 + b y_n + c y_n-1)/dt, of a step that is so many times the one before. */
static void set_differences(double ratio, double *a, double *b, double *c)
{
    *a = (1.0 + 2.0 * ratio) / (1.0 + ratio);
    *b = -(1.0 + ratio);
    *c = ratio * ratio / (1.0 + ratio);
}

int rf_open_room(rf_oil_room *room, const rf_oil_shape *shape)
{
    const size_t all = shape->lines * shape->nodes;
    memset(room, 0, sizeof *room);
    room->numbers = calloc(rf_equation_numbers(shape) + 2 * all, sizeof *room->numbers);
    if (!room->numbers)
        return RF_MEMORY;
    room->old = room->numbers + rf_equation_numbers(shape);
    room->carried = room->old + all;
    room->cells.lines = shape->lines;
    room->cells.nodes = shape->nodes;
    room->cells.openings = shape->openings;
    room->cells.opening = shape->opening;
    room->cells.fed = shape->fed;
    return rf_open_oil_solver(&room->solver, &room->cells, 0);
}

void rf_close_room(rf_oil_room *room)
{
    rf_close_oil_solver(&room->solver);
    free(room->numbers);
}

/* The room of what is found, or one of its own. */
static int enter(rf_oil_room *own, const rf_oil_shape *shape, rf_oil_found *found, rf_oil_room **room)
{
    memset(own, 0, sizeof *own);
    *room = found->room ? found->room : own;
    return found->room ? RF_OK : rf_open_room(own, shape);
}

/* Solve the equations, from the cells that are full. */
static int solve(rf_oil_room *self, const rf_oil_shape *shape, int guessed, rf_oil_found *found)
{
    rf_hold_openings(shape, found->pressure, found->theta);
    const int status = rf_search_oil(&self->solver, &self->cells, RF_BY_SETS, guessed, found->full, found->pressure,
                                     found->theta);
    found->work.solutions += self->solver.work.solutions;
    found->work.newton += self->solver.work.newton;
    return status;
}

/* A step by differences a, b, c over dt. */
static int solve_step(rf_oil_room *self, const rf_oil_shape *shape, const rf_oil_gap *gap, double rate,
                      const rf_oil_past *past, double dt, const double *by, rf_oil_found *found)
{
    found->rate = by[0];
    found->lag = by[2] * dt;
    rf_set_oil(shape, gap, NULL, rate, by[0], &self->cells, self->numbers);
    self->cells.old = self->old;
    for (size_t q = 0; q < shape->lines * shape->nodes; ++q) {
        const double held = by[1] * past->content[q] + (by[2] != 0.0 ? by[2] * past->before[q] : 0.0);
        self->old[q] = -held * rf_cell_area(shape, q) - self->carried[q];
    }
    return solve(self, shape, 1, found);
}

static int is_in_debt(const rf_oil_shape *shape, const double *theta)
{
    for (size_t q = 0; q < shape->lines * shape->nodes; ++q)
        if (theta[q] < EMPTY)
            return 1;
    return 0;
}

int rf_oil_step(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, const rf_oil_past *past, double dt,
                rf_oil_found *found)
{
    const double ratio = past->length > 0.0 ? dt / past->length : HUGE_VAL;
    double a, b, c;
    rf_oil_room own, *self;
    memset(&found->work, 0, sizeof found->work);
    int status = enter(&own, shape, found, &self), done = status != RF_OK;
    if (status == RF_OK)
        rf_sharpen_oil(shape, gap, rate, found->theta, self->carried);
    if (!done && ratio <= MOST_GROWTH) {
        set_differences(ratio, &a, &b, &c);
        const double second[3] = {a / dt, b / dt, c / dt};
        status = solve_step(self, shape, gap, rate, past, dt, second, found);
        done = status != RF_OK || !is_in_debt(shape, found->theta);
    }
    if (!done) {
        const double first[3] = {1.0 / dt, -1.0 / dt, 0.0};
        status = solve_step(self, shape, gap, rate, past, dt, first, found);
    }
    if (status == RF_OK)
        memcpy(found->old, self->old, shape->lines * shape->nodes * sizeof *found->old);
    rf_close_room(&own);
    return status;
}

/* Solve again with transport as the last theta has it, until that changes no more. */
static int settle(rf_oil_room *self, const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, double *last,
                  rf_oil_found *found)
{
    const size_t all = shape->lines * shape->nodes;
    double most = 0.0;
    self->cells.old = self->old;
    for (int k = 0; k < MOST_STILL; ++k) {
        most = 0.0;
        memcpy(last, found->theta, all * sizeof *last);
        rf_sharpen_oil(shape, gap, rate, last, self->carried);
        for (size_t q = 0; q < all; ++q)
            self->old[q] = (1.0 - WEIGHT) * self->old[q] - WEIGHT * self->carried[q];
        const int status = solve(self, shape, 1, found);
        if (status != RF_OK)
            return status;
        for (size_t q = 0; q < all; ++q)
            most = fmax(most, fabs(found->theta[q] - last[q]));
        if (most <= STILL)
            break;
    }
    return most <= STILL_ENOUGH ? RF_OK : RF_STUCK;
}

int rf_oil_rest(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, rf_oil_found *found)
{
    rf_oil_room own, *self;
    memset(&found->work, 0, sizeof found->work);
    found->rate = found->lag = 0.0;
    int status = enter(&own, shape, found, &self);
    if (status == RF_OK) {
        rf_set_oil(shape, gap, NULL, rate, 0.0, &self->cells, self->numbers);
        memset(self->old, 0, shape->lines * shape->nodes * sizeof *self->old);
        status = solve(self, shape, 0, found);
    }
    if (status == RF_OK) /* `old` of what is found has no part yet */
        status = settle(self, shape, gap, rate, found->old, found);
    if (status == RF_OK)
        memcpy(found->old, self->old, shape->lines * shape->nodes * sizeof *found->old);
    rf_close_room(&own);
    return status;
}
