#include "recess.h"

#include <math.h>
#include <string.h>

#include "../films/film.h"
#include "../films/map_frame.h"
#include "recess_cells.h"

/* Add a share of what a pad does to the force and, unless NULL, to its derivatives by the state. */
static void add_plate(const rf_plate *at, const rf_recess *bearing, double share, double *force, double *jacobian)
{
    const double r = bearing->radius;
    const double scale = share * bearing->viscosity * bearing->length * (r * r * r) / (at->own * at->own);
    double f[2], by[2 * RF_PLATE_COLUMNS];
    rf_take_plate(at, f, jacobian ? by : NULL);
    for (int k = 0; k < 2; ++k) {
        force[k] += scale * f[k];
        if (!jacobian)
            continue;
        const double *d = by + RF_PLATE_COLUMNS * k, per = scale / at->own;
        double *row = jacobian + 5 * k;
        /* w = v/c + rate (e_y, -e_x) */
        row[0] += per * (d[0] - at->rate * d[3]);
        row[1] += per * (d[1] + at->rate * d[2]);
        row[2] += per * d[2];
        row[3] += per * d[3];
        row[4] += 0.5 * scale * (d[2] * at->e[1] - d[3] * at->e[0] + d[4]);
    }
}

/* The same of one pad on its grids. */
static int add_pad(rf_plate *at, const rf_recess *bearing, double *force, double *jacobian)
{
    const int extrapolated = bearing->extrapolated != 0;
    int status = rf_open_plate(at);
    for (int level = 1; level >= 0 && status == RF_OK; --level) {
        const double share = level == 1 ? -1.0 / 3.0 : extrapolated ? 4.0 / 3.0 : 1.0;
        const int taken = level == 0 || extrapolated;
        status = rf_solve_plate(at, level, taken && jacobian);
        if (status == RF_OK && taken)
            add_plate(at, bearing, share, force, jacobian);
    }
    rf_close_plate(at);
    return status;
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
        rf_plate plate;
        rf_place_plate(&plate, bearing, bearing->pads + k, state);
        if (rf_plate_rests(&plate))
            rests = 1;
        else
            status = add_pad(&plate, bearing, f, jacobian);
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
    rf_plate plate;
    rf_place_plate(&plate, bearing, bearing->pads + pad, state);
    if (!(rf_plate_least(&plate) > 0.0))
        return RF_AT_WALL;
    int status = rf_open_plate(&plate);
    for (int level = 1; level >= 0 && status == RF_OK; --level)
        status = rf_solve_plate(&plate, level, 0);
    const double slope = bearing->radius / plate.own;
    for (size_t q = 0; q < plate.stencil.lines * plate.stencil.nodes; ++q)
        pressure[q] = 12.0 * bearing->viscosity * slope * slope * plate.pressure[q];
    rf_close_plate(&plate);
    return status;
}

double rf_recess_least(const rf_recess *bearing, const double *position, size_t *pad)
{
    const double state[5] = {position[0], position[1], 0.0, 0.0, 0.0};
    double least = HUGE_VAL;
    *pad = 0;
    for (size_t k = 0; k < bearing->count; ++k) {
        rf_plate plate;
        rf_place_plate(&plate, bearing, bearing->pads + k, state);
        const double thickness = plate.own * rf_plate_least(&plate);
        if (thickness < least) {
            least = thickness;
            *pad = k;
        }
    }
    return least;
}
