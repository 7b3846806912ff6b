/* Kernel "heated_journal": a plain journal bearing whose film has one temperature
   (bearings/journal/heat/heated_bearing.py).

   Parameters in the order of the enumeration below; inputs x, y [m], vx, vy [m/s], speed [rad/s]; state the
   temperature [K]; outputs force_x, force_y [N], film_temperature [K], power_loss [W], side_flow [m3/s].
   Tables: oil (n: quintic spline coefficients of ln viscosity), oil_range (2: lowest and highest temperature), full_gap
   (1). The film is the map of coefficients (1, x, t), center (1), reach (1), with its losses loss_coefficients
   (3, x, t), loss_center (3), loss_reach (1); without `coefficients` it is the short film. */

/* Documentation of the FMU

   Model: Film force of a full cylindrical journal bearing whose oil warms, with one temperature T of film and
   bush. x and y are Cartesian from the bearing center, rotation is positive about +z (from x to y), the force acts
   on the journal. With the eccentricity e = (x, y)/clearance and the source w = (vx, vy)/clearance - (speed/2) z^ x
   e, the force is that of the isothermal film at the viscosity of the oil at T; the heat that the film makes goes
   with the oil that leaves, through the housing, and into the bush. Where the film is ruptured the oil is in
   streamers.

   Equations:
   F = viscosity(T) length radius^3 / clearance^2  f(e, w)
   capacity dT/dt = P - volumetric_heat side_flow (T - supply_temperature)
                      - housing_conductance (T - ambient_temperature)
   P = viscosity(T) radius^3 length / clearance (speed^2 Sigma(e, w) - f(e, w).w)
   capacity = bush_heat_capacity + volumetric_heat 2 pi radius length clearance

   Validity: One temperature for the whole film: eccentricity ratio within 6 %, power within 7 % of a film
   with temperatures along and across it. The oil is known between the temperatures of the table `oil_range`; radius
   and length are fixed. Laminar, aligned, without grooves. In vibration the temperature hardly moves. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/heated_film.h"
#include "../films/journal_model.h"
#include "../films/map_kernel.h"
#include "../films/short_kernel.h"

#define TWO_PI 6.28318530717958647692

enum { RADIUS, LENGTH, CLEARANCE, SUPPLY, AMBIENT, CONDUCTANCE, BUSH, VOLUMETRIC_HEAT, PARAMETERS };

typedef struct model {
    rf_heated film;
    rf_map map;
    rf_short ocvirk;
    rf_loss_map losses;
    double capacity;
    double u[5]; /* the last input, with its heat and status: held inputs ask again and again */
    rf_heat heat;
    int status;
} model;

/* Kernels are given as constant, but their scratch space is written. */
static model *writable(const void *kernel)
{
    return (model *)kernel;
}

/* The film at an input: asked once for each. */
static const rf_heat *heat_at(model *m, const double *u)
{
    if (memcmp(m->u, u, sizeof m->u) != 0) {
        m->status = rf_heat_at(&m->film, u, &m->heat, NULL);
        memcpy(m->u, u, sizeof m->u);
    }
    return &m->heat;
}

static int explain(const model *m, int status, const rf_point *at, rf_message *why)
{
    const double t = at->x[0];
    const rf_oil *oil = &m->film.oil;
    if (status <= RF_OUTSIDE && !(t > 0.0 && t < HUGE_VAL))
        return rf_say(why, RF_NOT_FINITE, "temperature must be finite and positive, got %.9g K", t);
    if (status == RF_OK && !(t >= oil->coldest && t <= oil->hottest))
        return rf_say(why, RF_OUTSIDE, "temperature must be from %.6g to %.6g K, where the oil is known, got %.6g K",
                      oil->coldest, oil->hottest, t);
    return rf_explain_journal(&m->film.journal, status, at->u, why);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    model *m = writable(kernel);
    const rf_heat *heat = heat_at(m, at->u);
    double mu;
    rf_oil_viscosity(&m->film.oil, at->x[0], &mu, NULL);
    y[0] = mu * heat->force[0];
    y[1] = mu * heat->force[1];
    y[2] = at->x[0];
    y[3] = mu * heat->drag;
    y[4] = heat->flow;
    return explain(m, m->status, at, why);
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    model *m = writable(kernel);
    dx[0] = rf_heat_surplus(&m->film, heat_at(m, at->u), at->x[0], NULL) / m->capacity;
    return explain(m, m->status, at, why);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *m = kernel;
    rf_heat heat;
    rf_heat_slopes by;
    double mu, thins, cools;
    const int status = rf_heat_at(&m->film, at->u, &heat, &by);
    if (status > RF_OUTSIDE)
        return explain(m, status, at, why);
    rf_oil_viscosity(&m->film.oil, at->x[0], &mu, &thins);
    rf_heat_surplus(&m->film, &heat, at->x[0], &cools);
    const double taken = m->film.volumetric_heat * (at->x[0] - m->film.supply);
    const double by_temperature[5] = {thins * heat.force[0], thins * heat.force[1], 1.0, thins * heat.drag, 0.0};
    memcpy(answer->C, by_temperature, sizeof by_temperature);
    answer->A[0] = cools / m->capacity;
    for (int k = 0; k < 5; ++k) {
        answer->B[k] = (mu * by.drag[k] - taken * by.flow[k]) / m->capacity;
        answer->D[k] = mu * by.force[k];
        answer->D[5 + k] = mu * by.force[5 + k];
        answer->D[10 + k] = 0.0;
        answer->D[15 + k] = mu * by.drag[k];
        answer->D[20 + k] = by.flow[k];
    }
    return explain(m, status, at, why);
}

/* Numbers of a table with one axis of `count`; NULL with the message otherwise. */
static const double *numbers(const rf_tables *tables, const char *name, uint32_t count, rf_message *why)
{
    const rf_table *found = rf_find_table(tables, name, 1, why);
    if (found && found->extent[0] != count) {
        rf_say(why, RF_INVALID, "table %s must have %u numbers, got %u", name, (unsigned)count,
               (unsigned)found->extent[0]);
        return NULL;
    }
    return found ? found->numbers : NULL;
}

static int take_oil(model *m, const rf_tables *tables, rf_message *why)
{
    const rf_table *oil = rf_find_table(tables, "oil", 1, why);
    const double *range = oil ? numbers(tables, "oil_range", 2, why) : NULL;
    const double *gap = range ? numbers(tables, "full_gap", 1, why) : NULL;
    if (!gap)
        return RF_INVALID;
    if (oil->extent[0] < 6 || oil->extent[0] > 100000 || !(range[0] > 0.0 && range[1] > range[0]))
        return rf_say(why, RF_INVALID, "the oil must be known over a range of temperatures, got %u numbers over %.9g to "
                      "%.9g K", (unsigned)oil->extent[0], range[0], range[1]);
    m->film.oil.ln = oil->numbers;
    m->film.oil.cells = (int32_t)oil->extent[0] - 5;
    m->film.oil.coldest = range[0];
    m->film.oil.hottest = range[1];
    m->film.full_gap = gap[0] != 0.0;
    return RF_OK;
}

static int take_short(model *m)
{
    m->film.journal.film = rf_short_film;
    m->film.journal.data = &m->ocvirk;
    m->film.loss = rf_short_losses;
    return RF_OK;
}

static int take_map(model *m, const rf_tables *tables, rf_message *why)
{
    const rf_table *c = rf_find_table(tables, "coefficients", 3, why);
    const rf_table *l = c ? rf_find_table(tables, "loss_coefficients", 3, why) : NULL;
    const double *center = l ? numbers(tables, "center", 1, why) : NULL;
    const double *reach = center ? numbers(tables, "reach", 1, why) : NULL;
    const double *loss_center = reach ? numbers(tables, "loss_center", RF_LOSSES, why) : NULL;
    const double *loss_reach = loss_center ? numbers(tables, "loss_reach", 1, why) : NULL;
    if (!loss_reach)
        return RF_INVALID;
    const rf_table *const both[] = {c, l};
    for (int k = 0; k < 2; ++k)
        for (int axis = 1; axis < 3; ++axis)
            if (both[k]->extent[axis] < 6 || both[k]->extent[axis] > 10000
                || both[k]->extent[0] != (k ? RF_LOSSES : 1))
                return rf_say(why, RF_INVALID, "the maps of a film must be of one bearing, 6 x 6 at least");
    m->map = (rf_map){(int32_t)c->extent[1] - 5, (int32_t)c->extent[2] - 5, reach[0], center[0], c->numbers, 0.0, 1.0};
    m->losses = (rf_loss_map){(int32_t)l->extent[1] - 5, (int32_t)l->extent[2] - 5, loss_reach[0],
                                  {loss_center[0], loss_center[1], loss_center[2]}, l->numbers};
    m->film.journal.film = rf_map_film;
    m->film.journal.data = &m->map;
    m->film.loss = rf_map_losses;
    m->film.loss_data = &m->losses;
    return RF_OK;
}

static int is_mapped(const rf_tables *tables)
{
    for (size_t k = 0; k < tables->count; ++k)
        if (strcmp(tables->list[k].name, "coefficients") == 0)
            return 1;
    return 0;
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *m = calloc(1, sizeof *m);
    if (!m) {
        rf_say(why, RF_MEMORY, "no memory for a journal");
        return NULL;
    }
    if (take_oil(m, tables, why) != RF_OK
        || (is_mapped(tables) ? take_map(m, tables, why) : take_short(m)) != RF_OK) {
        free(m);
        return NULL;
    }
    const rf_sizes mine = {PARAMETERS, 5, 5, 1, 0};
    *sizes = mine;
    return m;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    static const char *const NAMES[] = {"supply_temperature", "ambient_temperature", "housing_conductance",
                                        "bush_heat_capacity", "volumetric_heat"};
    model *m = kernel;
    rf_heated *film = &m->film;
    rf_journal scaled = film->journal;
    const double unit[] = {p[RADIUS], p[LENGTH], p[CLEARANCE], 1.0};
    if (rf_scale_journal(&scaled, unit, why) != RF_OK)
        return RF_INVALID;
    for (int k = SUPPLY; k < PARAMETERS; ++k)
        if (!((k == CONDUCTANCE ? p[k] >= 0.0 : p[k] > 0.0) && p[k] < HUGE_VAL))
            return rf_say(why, RF_INVALID, "%s must be finite and %s, got %.9g", NAMES[k - SUPPLY],
                          k == CONDUCTANCE ? "not negative" : "positive", p[k]);
    const double slenderness = rf_slenderness(unit);
    if (m->map.coefficients) {
        rf_map_to_wall(&m->map, slenderness, 1.0);
        scaled.error = rf_map_error(&m->map);
    }
    m->ocvirk.factor = 4.0 * slenderness * slenderness;
    film->journal = scaled;
    film->radius = p[RADIUS];
    film->length = p[LENGTH];
    film->clearance = p[CLEARANCE];
    film->supply = p[SUPPLY];
    film->ambient = p[AMBIENT];
    film->conductance = p[CONDUCTANCE];
    film->volumetric_heat = p[VOLUMETRIC_HEAT];
    m->capacity = p[BUSH] + p[VOLUMETRIC_HEAT] * TWO_PI * p[RADIUS] * p[LENGTH] * p[CLEARANCE];
    for (int k = 0; k < 5; ++k)
        m->u[k] = NAN;
    return RF_OK;
}

const rf_kernel_type rf_heated_journal_type = {
    .create = create,
    .destroy = free,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
};
