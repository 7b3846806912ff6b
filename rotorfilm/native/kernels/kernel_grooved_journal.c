/* Kernel "grooved_journal": a journal bearing with axial openings over the impedance map made for it.

   Parameters, inputs and outputs as in journal_model.h; length/diameter must be that of the map; tables of RF_GROOVED
   in map_table.h. */

/* Documentation of the FMU

   Model: Film force of a cylindrical journal bearing of finite length with axial grooves or several pads,
   open to ambient pressure; Reynolds equation with Reynolds rupture. x and y are Cartesian from the bearing
   center, rotation is positive about +z (from x to y), the force acts on the journal. With the eccentricity
   e = (x, y)/clearance at the angle theta and the source w = (vx, vy)/clearance - (speed/2) z^ x e at the
   angle phi, both from the axis of the openings, the film minimizes a quadratic functional, so that its
   force is a gradient:

   Equations:
   F = viscosity length radius^3 / clearance^2  dJ/dw
   J(e, w) = -|w|^2 exp(L0(phi) + chi M(X, theta, s)),  chi = |e|
   X = chi / (1 - chi^2)^(1/4),  tan s = squeeze tan(phi - theta)

   Validity: M and L0 are splines over X and the angles, made for these openings and this length / diameter:
   radius and length are fixed, clearance and viscosity tunable. The table `map` is length / diameter, the
   last X, squeeze and the axis [rad]; beyond the last X the force goes on as that of the film near the
   wall, as far as the openings leave it, with a warning. Laminar, isothermal, aligned. Where w vanishes the
   force is zero and has no derivative. */
#include "../films/journal_model.h"
#include "../films/map_table.h"

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_map map;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    if (rf_take_map(&self->map, RF_GROOVED, "", tables, why) != RF_OK)
        return RF_INVALID;
    self->journal.film = rf_groove_film;
    self->journal.data = &self->map;
    self->journal.error = rf_map_error(&self->map);
    self->journal.openings = 1;
    *sizes = RF_JOURNAL_SIZES;
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_journal scaled = self->journal;
    if (rf_scale_journal(&scaled, p, why) != RF_OK
        || rf_judge_slenderness(self->map.slenderness, "map of the film", p, why) != RF_OK)
        return RF_INVALID;
    rf_scale_growth(&self->map, p);
    self->journal = scaled;
    return RF_OK;
}

const rf_kernel_type rf_grooved_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
