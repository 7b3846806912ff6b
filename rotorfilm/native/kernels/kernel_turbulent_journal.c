/* Kernel "turbulent_journal": a plain journal bearing over the map made for its turbulent oil.

   Parameters, inputs and outputs as in journal_model.h; length/diameter must be that of the map. Tables of RF_SPED in
   map_table.h, and `oil` (2: length/diameter of the map, density of the oil [kg/m3]), which gives Re over the rate. */

/* Documentation of the FMU

   Model: Film force of a full cylindrical journal bearing of finite length with turbulent oil, Reynolds equation with
   Reynolds rupture and factors of the local Reynolds number. x and y are Cartesian from the bearing center, rotation
   is positive about +z (from x to y), the force acts on the journal. With the eccentricity e = (x, y)/clearance and the
   source w = (vx, vy)/clearance - (speed/2) z^ x e, the film of one Reynolds number minimizes a quadratic functional, so
   that its force is a gradient:

   Equations:
   F = viscosity length radius^3 / clearance^2  dJ/dw
   J(e, w) = -|w|^2 exp(L0(y) + chi M(X, y, cos)),  chi = |e|,  cos the cosine of the angle from w to e
   X = chi / (1 - chi^2)^(1/4),  y = ln(1 + Re/scale),  Re = density |speed| radius clearance / viscosity

   Validity: M and L0 are splines, made for this oil and this length / diameter: radius and length are fixed,
   clearance and viscosity tunable. The table `map` is the last X, the scale of y, the last y and 1. With a band of
   transition the map belongs to one radius / clearance too. Beyond the last X the force goes on as a power of X, and
   beyond the last y it stays, with a warning. Isothermal, aligned, without grooves, with closures that are linear in
   the pressure. Where w vanishes off the center the force is zero and has no derivative. */
#include <math.h>

#include "../films/journal_model.h"
#include "../films/map_table.h"

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_map map;
    double slenderness, density;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const double *oil = rf_numbers(tables, "oil", 2, why);
    if (!oil || rf_take_map(&self->map, RF_SPED, "", tables, why) != RF_OK)
        return RF_INVALID;
    self->slenderness = oil[0];
    self->density = oil[1];
    if (!(oil[0] > 0.0 && oil[1] > 0.0 && oil[1] < HUGE_VAL))
        return rf_say(why, RF_INVALID, "table oil must be positive and finite, got %.9g and %.9g", oil[0], oil[1]);
    self->journal.film = rf_sped_film;
    self->journal.data = &self->map;
    *sizes = RF_JOURNAL_SIZES;
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_journal scaled = self->journal;
    if (rf_scale_journal(&scaled, p, why) != RF_OK
        || rf_judge_slenderness(self->slenderness, "map of the film", p, why) != RF_OK)
        return RF_INVALID;
    self->journal = scaled;
    self->map.per_rate = 2.0 * self->density * (p[0] * p[2] / p[3]);
    return RF_OK;
}

const rf_kernel_type rf_turbulent_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
