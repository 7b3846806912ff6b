/* Kernel "polar_damper": a full squeeze film, of finite length or as published, fed or not, and springs beside it.

   Parameters, inputs and outputs as in damper_model.h; tables of films/polar_film.h. */

/* Documentation of the FMU

   Model: Force of a full squeeze film with a solid or porous cage, fed or not, and of its retainer springs, on the rotor.
   The race does not spin: there is no speed. x and y are Cartesian from the bearing center. With the eccentricity e = (x,
   y)/clearance, its rate w = (vx, vy)/clearance, chi = |e|, e_r = e/chi and e_t = z^ x e_r:

   Equations:
   F = viscosity radius length^3 / clearance^2  (F_t e_t + F_r e_r) - stiffness (x, y)
   F_t = -A_ss(chi) (w.e_t),  F_r = -A_cc(chi) (w.e_r) - lift(chi) chi

   Validity: A_ss, A_cc and lift are series over atanh(chi), made for this damper. Fixed is what they hold for: radius and
   length of a film of finite length, length and clearance of a porous cage, clearance and viscosity of a fed film. Beyond
   the eccentricity ratio 0.99 the force goes on as (1 - chi^2)^(-3/2), with a warning. The springs are preloaded so that
   they carry the static load. Laminar, isothermal, aligned, without oil inertia. */
#include "../films/damper_model.h"
#include "../films/polar_film.h"

typedef struct model {
    rf_damper damper; /* first, as damper_model.h asks */
    rf_polar_table film;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    self->damper.journal.film = rf_polar_film;
    self->damper.journal.data = &self->film;
    *sizes = (rf_sizes){RF_DAMPER_PARAMETERS, RF_DAMPER_INPUTS, 2, 0, 0};
    return rf_take_polar(&self->film, tables, why);
}

const rf_kernel_type rf_polar_damper_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = rf_scale_damper,
    .output = rf_damper_output,
    .jacobian = rf_damper_derivatives,
};
