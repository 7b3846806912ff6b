#include "recess.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/film.h"
#include "../films/map_frame.h"
#include "losses.h"
#include "recess_pad.h"

/* Add what a pad does to the force and, unless NULL, to its derivatives by the state. */
static void add_pad(const rf_recess *bearing, const rf_over_pad *at, const double *wrench, const double *by,
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
        rf_over_pad at;
        status = rf_open_pad(&at, bearing, bearing->pads + k, state);
        if (rf_pad_rests(&at))
            rests = 1;
        else if (status == RF_OK)
            status = rf_take_film(&at.film, at.drive, wrench, jacobian ? by : NULL);
        if (status == RF_OK && !rf_pad_rests(&at))
            add_pad(bearing, &at, wrench, by, f, jacobian);
        rf_close_pad(&at);
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
    rf_over_pad at;
    int status = rf_open_pad(&at, bearing, bearing->pads + pad, state);
    if (status == RF_OK)
        status = rf_solve_down_to(&at.film, 0, at.drive);
    const double slope = bearing->radius / bearing->clearance;
    const size_t nodes = at.ring.grids[0].nodes, all = (at.ring.grids[0].lines - RF_GAP_LINES) * nodes;
    for (size_t q = 0; q < all && status == RF_OK; ++q)
        pressure[q] = 12.0 * bearing->viscosity * slope * slope * at.film.pressure[RF_GAP_LINES * nodes + q];
    rf_close_pad(&at);
    return status;
}

double rf_recess_least(const rf_recess *bearing, const double *position, size_t *pad)
{
    const double state[5] = {position[0], position[1], 0.0, 0.0, 0.0};
    double least = HUGE_VAL, place[2];
    *pad = 0;
    for (size_t k = 0; k < bearing->count; ++k) {
        rf_over_pad at;
        rf_place_over_pad(&at, bearing, bearing->pads + k, state);
        const double thickness = bearing->clearance * rf_least_film(&at.ring, at.q, place);
        if (thickness < least) {
            least = thickness;
            *pad = k;
        }
    }
    return least;
}

/* The row of one pad: the force and what pressure does on the steps per rate, 12 P.b(0, 1); then its oil at rest. */
static int take_losses(rf_over_pad *at, double *row)
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
        rf_over_pad at;
        status = rf_open_pad(&at, bearing, bearing->pads + k, state);
        if (status == RF_OK)
            status = take_losses(&at, losses + RF_RECESS_LOSSES * k);
        rf_close_pad(&at);
    }
    return status;
}
