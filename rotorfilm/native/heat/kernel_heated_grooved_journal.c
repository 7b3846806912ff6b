/* Kernel "heated_grooved_journal": a journal bearing with axial openings whose film has one temperature
   (bearings/oil/heated_bearing.py).

   Parameters, inputs, outputs and the tables of the oil as in heated_model.h, with one more parameter, carry_over;
   tables of the film as in groove_model.h, and its losses as in groove_losses.h: loss_coefficients (2 x 3, x, theta,
   s), loss_flows (4 x openings, x, theta) and loss_edges (lands, 2). */

/* Documentation of the FMU

   Model: Film force of a cylindrical journal bearing of finite length with axial grooves or several pads, open to
   ambient pressure, whose oil warms, with one temperature T of film and bush. x and y are Cartesian from the bearing
   center, rotation is positive about +z (from x to y), the force acts on the journal. With the eccentricity e = (x,
   y)/clearance and the source w = (vx, vy)/clearance - (speed/2) z^ x e, the force is that of the isothermal film at
   the viscosity of the oil at T; the heat that the film makes goes with the oil that leaves, through the housing, and
   into the bush. Where the film is ruptured the oil is in streamers; between openings it begins only where oil is.

   Equations:
   F = viscosity(T) length radius^3 / clearance^2  f(e, w)
   capacity dT/dt = P - volumetric_heat Q_e (T - supply_temperature)
                      - housing_conductance (T - ambient_temperature)
   P = viscosity(T) radius^3 length / clearance (speed^2 Sigma(e, w) - f(e, w).w)
   Q_e = side_flow + sum 2 (Q_2 - a Q_1) / (1 + a)
   a = r - d ln(1 + exp((r - 1) / d)),  r = carry_over Q_2 / Q_1,  d = 0.05, above carry_over 0.8
   d = max((1 - carry_over) / 4, 0.01)
   capacity = bush_heat_capacity + volumetric_heat 2 pi radius length clearance

   Validity: One temperature for the whole film: power usually within 30 % of a film with temperatures along
   and across it; with one groove near the load the place may differ too. Q_1 leaves an opening and Q_2 arrives there with the journal at rest. The map
   is made for these openings and this length / diameter: radius and length are fixed. The oil is known between the
   temperatures of the table `oil_range`. Laminar, aligned. In vibration the temperature hardly moves. */
#include <stdlib.h>

#include "../films/groove_model.h"
#include "heated_model.h"
#include "../films/journal_model.h"

#define CARRY_OVER 8

typedef struct model {
    rf_heated_model heated; /* first, as heated_model.h asks */
    rf_groove_map map;
    rf_opening_map losses;
} model;

static int take_losses(model *m, const rf_tables *tables, rf_message *why)
{
    const rf_table *c = rf_find_table(tables, "loss_coefficients", 4, why);
    const rf_table *flows = c ? rf_find_table(tables, "loss_flows", 3, why) : NULL;
    const rf_table *edges = flows ? rf_find_table(tables, "loss_edges", 2, why) : NULL;
    if (!edges)
        return RF_INVALID;
    int fits = c->extent[0] == 2 * RF_LOSSES && flows->extent[0] % 4 == 0 && flows->extent[0] <= 10000;
    fits = fits && edges->extent[1] == 2 && edges->extent[0] <= 10000;
    for (int axis = 1; axis < 4; ++axis)
        fits = fits && c->extent[axis] >= 6 && c->extent[axis] <= 10000;
    for (int axis = 1; axis < 3; ++axis)
        fits = fits && flows->extent[axis] == c->extent[axis];
    if (!fits)
        return rf_say(why, RF_INVALID, "the losses of a film must fit each other, for two senses and six nodes");
    m->losses = (rf_opening_map){(int32_t)c->extent[1] - 5, (int32_t)c->extent[2] - 5, (int32_t)c->extent[3] - 5,
                                 (int32_t)flows->extent[0] / 4, (int32_t)edges->extent[0], m->map.x_end,
                                 m->map.squeeze, m->map.axis, c->numbers, flows->numbers, edges->numbers};
    return RF_OK;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *m = kernel;
    if (rf_take_oil(&m->heated, tables, why) != RF_OK || rf_take_groove_map(tables, &m->map, why) != RF_OK
        || take_losses(m, tables, why) != RF_OK)
        return RF_INVALID;
    rf_heated *film = &m->heated.film;
    film->journal.film = rf_groove_film;
    film->journal.data = &m->map;
    film->journal.error = rf_groove_error(&m->map);
    film->journal.openings = 1;
    film->loss = rf_groove_losses;
    film->loss_data = film->openings = &m->losses;
    *sizes = RF_HEATED_SIZES;
    ++sizes->parameters;
    return RF_OK;
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    return rf_make_kernel(sizeof(model), take_tables, free, tables, sizes, why);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *m = kernel;
    if (!(p[CARRY_OVER] >= 0.0 && p[CARRY_OVER] <= 1.0))
        return rf_say(why, RF_INVALID, "carry_over must be from 0 to 1, got %.9g", p[CARRY_OVER]);
    if (rf_judge_slenderness(&m->map, p, why) != RF_OK)
        return RF_INVALID;
    const int status = rf_set_heated(&m->heated, p, why);
    if (status == RF_OK)
        m->heated.film.carry_over = p[CARRY_OVER];
    return status;
}

const rf_kernel_type rf_heated_grooved_journal_type = {
    .create = create,
    .destroy = free,
    .set_parameters = set_parameters,
    .output = rf_heated_output,
    .jacobian = rf_heated_derivatives,
    .derivative = rf_heated_derivative,
    .step = rf_heated_step,
};
