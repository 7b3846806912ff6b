/* Kernel "grooved_journal": a journal bearing with axial openings over the impedance map made for it.

   Parameters, inputs and outputs as in journal_model.h; length/diameter must be that of the map. Tables:
   coefficients (x, theta, s) and center (phi), in the angles the last five repeating the first; map (4:
   length/diameter, reach, squeeze, axis [rad]). */

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
#include <math.h>
#include <stdlib.h>

#include "../films/groove_kernel.h"
#include "../films/journal_model.h"

#define ROUNDOFF 1e-12 /* relative, by which length/diameter may differ from that of the map */

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_groove_map map;
    double slenderness;
} model;

static int take_tables(model *self, const rf_tables *tables, rf_message *why)
{
    const rf_table *c = rf_find_table(tables, "coefficients", 3, why);
    const rf_table *center = c ? rf_find_table(tables, "center", 1, why) : NULL;
    const rf_table *map = center ? rf_find_table(tables, "map", 1, why) : NULL;
    if (!map)
        return RF_INVALID;
    const uint32_t x = c->extent[0], e = c->extent[1], s = c->extent[2], w = center->extent[0];
    if (x < 6 || e < 6 || s < 6 || w < 6 || x > 10000 || e > 10000 || s > 10000 || w > 10000
        || map->extent[0] != 4)
        return rf_say(why, RF_INVALID, "the tables of a journal must fit each other, got %u x %u x %u and %u",
                      (unsigned)x, (unsigned)e, (unsigned)s, (unsigned)w);
    const double *n = map->numbers;
    if (!(n[0] > 0.0 && n[1] > 0.0 && n[2] > 0.0 && n[2] <= 1.0))
        return rf_say(why, RF_INVALID,
                      "length/diameter and reach must be positive and squeeze in (0, 1], got %.9g, %.9g, %.9g",
                      n[0], n[1], n[2]);
    const rf_groove_map groove_map = {(int32_t)x - 5, (int32_t)e - 5, (int32_t)s - 5, (int32_t)w - 5,
                                      n[1], n[2], n[3], center->numbers, c->numbers, n[0]};
    self->map = groove_map;
    self->slenderness = n[0];
    return RF_OK;
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = calloc(1, sizeof *self);
    if (!self) {
        rf_say(why, RF_MEMORY, "no memory for a journal");
        return NULL;
    }
    if (take_tables(self, tables, why) != RF_OK) {
        free(self);
        return NULL;
    }
    self->journal.film = rf_groove_film;
    self->journal.data = &self->map;
    self->journal.error = rf_groove_error(&self->map);
    self->journal.openings = 1;
    *sizes = RF_JOURNAL_SIZES;
    return self;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_journal scaled = self->journal;
    if (rf_scale_journal(&scaled, p, why) != RF_OK)
        return RF_INVALID;
    const double slenderness = rf_slenderness(p);
    if (!(fabs(slenderness - self->slenderness) <= ROUNDOFF * self->slenderness))
        return rf_say(why, RF_INVALID, "length/diameter must be that of the map of the film, %.9g, got %.9g",
                      self->slenderness, slenderness);
    self->journal = scaled;
    return RF_OK;
}

const rf_kernel_type rf_grooved_journal_type = {
    .create = create,
    .destroy = free,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
