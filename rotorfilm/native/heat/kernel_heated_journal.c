/* Kernel "heated_journal": a plain journal bearing whose film has one temperature
   (bearings/oil/heated_bearing.py).

   Parameters, inputs, outputs and the tables of the oil as in heated_model.h. The film is RF_PLAIN of
   map_table.h, with its losses as in loss_kernel.h; without `coefficients` it is the short film. */

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

   Validity: One temperature for the whole film: power usually within 30 % of a film with temperatures along
   and across it; with one groove near the load the place may differ too. The oil is known between the temperatures of the table `oil_range`; radius
   and length are fixed. Laminar, aligned, without grooves. In vibration the temperature hardly moves. */
#include "../films/journal_model.h"
#include "../films/map_table.h"
#include "../films/short_kernel.h"
#include "heated_model.h"

typedef struct model {
    rf_heated_model heated; /* first, as heated_model.h asks */
    rf_map map;
    rf_short ocvirk;
    rf_loss_map losses;
} model;

static int take_short(model *m)
{
    m->heated.film.journal.film = rf_short_film;
    m->heated.film.journal.data = &m->ocvirk;
    m->heated.film.loss = rf_short_losses;
    return RF_OK;
}

static int take_map(model *m, const rf_tables *tables, rf_message *why)
{
    m->heated.film.journal.film = rf_map_film;
    m->heated.film.journal.data = &m->map;
    m->heated.film.loss = rf_map_losses;
    m->heated.film.loss_data = &m->losses;
    return rf_take_map(&m->map, RF_PLAIN, "", tables, why) == RF_OK ? rf_take_losses(&m->losses, 0, tables, why)
                                                                    : RF_INVALID;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *m = kernel;
    *sizes = RF_HEATED_SIZES;
    if (rf_take_oil(&m->heated, tables, why) != RF_OK)
        return RF_INVALID;
    return rf_seek_table(tables, "coefficients") ? take_map(m, tables, why) : take_short(m);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *m = kernel;
    const int status = rf_set_heated(&m->heated, p, why);
    if (status != RF_OK)
        return status;
    const double slenderness = rf_slenderness(p);
    if (m->map.coefficients) {
        m->map.slenderness = slenderness;
        rf_map_to_wall(&m->map);
        m->heated.film.journal.error = rf_map_error(&m->map);
    }
    m->ocvirk.factor = 4.0 * slenderness * slenderness;
    return RF_OK;
}

const rf_kernel_type rf_heated_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = rf_heated_output,
    .jacobian = rf_heated_derivatives,
    .derivative = rf_heated_derivative,
    .step = rf_heated_step,
};
