/* Kernel "heated_journal": a plain journal bearing whose film has one temperature
   (bearings/oil/heated_bearing.py).

   Parameters, inputs, outputs and the tables of the oil as in heated_model.h. The film is the map of coefficients
   (1, x, t), center (1), reach (1), with its losses loss_coefficients (3, x, s), loss_center (3), loss_reach (1),
   loss_squeeze (1); without `coefficients` it is the short film. */

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
#include <stdlib.h>
#include <string.h>

#include "heated_model.h"
#include "../films/journal_model.h"
#include "../films/map_kernel.h"
#include "../films/short_kernel.h"

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
    const rf_table *c = rf_find_table(tables, "coefficients", 3, why);
    const rf_table *l = c ? rf_find_table(tables, "loss_coefficients", 3, why) : NULL;
    const double *center = l ? rf_numbers(tables, "center", 1, why) : NULL;
    const double *reach = center ? rf_numbers(tables, "reach", 1, why) : NULL;
    const double *loss_center = reach ? rf_numbers(tables, "loss_center", RF_LOSSES, why) : NULL;
    const double *loss_reach = loss_center ? rf_numbers(tables, "loss_reach", 1, why) : NULL;
    const double *squeeze = loss_reach ? rf_numbers(tables, "loss_squeeze", 1, why) : NULL;
    if (!squeeze)
        return RF_INVALID;
    const rf_table *const both[] = {c, l};
    for (int k = 0; k < 2; ++k)
        for (int axis = 1; axis < 3; ++axis)
            if (both[k]->extent[axis] < 6 || both[k]->extent[axis] > 10000
                || both[k]->extent[0] != (k ? RF_LOSSES : 1))
                return rf_say(why, RF_INVALID, "the maps of a film must be of one bearing, 6 x 6 at least");
    m->map = (rf_map){(int32_t)c->extent[1] - 5, (int32_t)c->extent[2] - 5, reach[0], center[0], c->numbers, 0.0, 1.0};
    m->losses = (rf_loss_map){(int32_t)l->extent[1] - 5, (int32_t)l->extent[2] - 5, loss_reach[0], squeeze[0],
                                  {loss_center[0], loss_center[1], loss_center[2]}, l->numbers};
    m->heated.film.journal.film = rf_map_film;
    m->heated.film.journal.data = &m->map;
    m->heated.film.loss = rf_map_losses;
    m->heated.film.loss_data = &m->losses;
    return RF_OK;
}

static int is_mapped(const rf_tables *tables)
{
    for (size_t k = 0; k < tables->count; ++k)
        if (strcmp(tables->list[k].name, "coefficients") == 0)
            return 1;
    return 0;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *m = kernel;
    *sizes = RF_HEATED_SIZES;
    if (rf_take_oil(&m->heated, tables, why) != RF_OK)
        return RF_INVALID;
    return is_mapped(tables) ? take_map(m, tables, why) : take_short(m);
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    return rf_make_kernel(sizeof(model), take_tables, free, tables, sizes, why);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *m = kernel;
    const int status = rf_set_heated(&m->heated, p, why);
    if (status != RF_OK)
        return status;
    const double slenderness = rf_slenderness(p);
    if (m->map.coefficients) {
        rf_map_to_wall(&m->map, slenderness, 1.0);
        m->heated.film.journal.error = rf_map_error(&m->map);
    }
    m->ocvirk.factor = 4.0 * slenderness * slenderness;
    return RF_OK;
}

const rf_kernel_type rf_heated_journal_type = {
    .create = create,
    .destroy = free,
    .set_parameters = set_parameters,
    .output = rf_heated_output,
    .jacobian = rf_heated_derivatives,
    .derivative = rf_heated_derivative,
    .step = rf_heated_step,
};
