/* Kernel "damper": a cavitated squeeze film over its impedance map, and retainer springs beside it.

   Parameters, inputs and outputs as in damper_model.h. Forces of the film are in units of viscosity * radius * length^3 / clearance^2 per 1/s. Tables of RF_PLAIN in
   map_table.h. What of the dimensions the map holds for is up to the bounds of the parameters. */

/* Documentation of the FMU

   Model: Force of a squeeze-film damper with a solid or porous cage, and of its retainer springs, on the
   rotor. The race does not spin: there is no speed. x and y are Cartesian from the bearing center. With the
   eccentricity e = (x, y)/clearance and its rate w = (vx, vy)/clearance, the film minimizes a quadratic
   functional, so that its force is a gradient:

   Equations:
   F = viscosity radius length^3 / clearance^2  dJ/dw - stiffness (x, y)
   J(e, w) = -|w|^2 exp(L0 + chi M(X, T)),  chi = |e|
   X = chi / (1 - chi^2)^(1/4),  T = (1 + cos(e, w)) / 2

   Validity: M is a spline over X and T, made for this damper. Fixed is what it holds for: length and
   clearance where the cage is porous, radius and length where the film is of finite length. The springs are
   preloaded so that they carry the static load. Beyond the last X, the first number of the table map, the force goes
   on as that of the film near the wall, or, where the map is no such film (porous cages, films without
   rupture), as a power of X, with a warning. Laminar, isothermal, aligned, without oil inertia. Where the
   rotor is at rest off the center the film force is zero and has no derivative. */
#include "../films/damper_model.h"
#include "../films/map_table.h"

typedef struct model {
    rf_damper damper; /* first, as damper_model.h asks */
    rf_map map;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    rf_journal *journal = &self->damper.journal;
    if (rf_take_map(&self->map, RF_PLAIN, "", tables, why) != RF_OK)
        return RF_INVALID;
    rf_map_to_wall(&self->map);
    journal->film = rf_map_film;
    journal->data = &self->map;
    journal->error = rf_map_error(&self->map);
    *sizes = (rf_sizes){RF_DAMPER_PARAMETERS, RF_DAMPER_INPUTS, 2, 0, 0};
    return RF_OK;
}

const rf_kernel_type rf_damper_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = rf_scale_damper,
    .output = rf_damper_output,
    .jacobian = rf_damper_derivatives,
};
