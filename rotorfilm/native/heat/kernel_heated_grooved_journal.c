/* Kernel "heated_grooved_journal": a journal bearing with axial openings whose film has one temperature
   (bearings/oil/heated_bearing.py).

   Parameters, inputs, outputs and the tables of the oil as in heated_model.h, with one more parameter, carry_over;
   tables of the film as RF_GROOVED of map_table.h, and of its losses as in loss_kernel.h. */

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
#include "../films/journal_model.h"
#include "../films/map_table.h"
#include "heated_model.h"

#define CARRY_OVER 8

typedef struct model {
    rf_heated_model heated; /* first, as heated_model.h asks */
    rf_map map;
    rf_loss_map losses;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *m = kernel;
    if (rf_take_oil(&m->heated, tables, why) != RF_OK || rf_take_map(&m->map, RF_GROOVED, "", tables, why) != RF_OK
        || rf_take_losses(&m->losses, 1, tables, why) != RF_OK)
        return RF_INVALID;
    rf_heated *film = &m->heated.film;
    film->journal.film = rf_groove_film;
    film->journal.data = &m->map;
    film->journal.error = rf_map_error(&m->map);
    film->journal.openings = 1;
    film->loss = rf_map_losses;
    film->loss_data = film->openings = &m->losses;
    *sizes = RF_HEATED_SIZES;
    ++sizes->parameters;
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *m = kernel;
    if (!(p[CARRY_OVER] >= 0.0 && p[CARRY_OVER] <= 1.0))
        return rf_say(why, RF_INVALID, "carry_over must be from 0 to 1, got %.9g", p[CARRY_OVER]);
    if (rf_judge_slenderness(m->map.slenderness, "map of the film", p, why) != RF_OK)
        return RF_INVALID;
    const int status = rf_set_heated(&m->heated, p, why);
    if (status == RF_OK)
        m->heated.film.carry_over = p[CARRY_OVER];
    return status;
}

const rf_kernel_type rf_heated_grooved_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = rf_heated_output,
    .jacobian = rf_heated_derivatives,
    .derivative = rf_heated_derivative,
    .step = rf_heated_step,
};
