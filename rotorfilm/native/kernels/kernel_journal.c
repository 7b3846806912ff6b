/* Kernel "journal": a plain journal bearing over the universal impedance map.

   Parameters, inputs and outputs as in journal_model.h; tables of RF_LAYERED in map_table.h. */

/* Documentation of the FMU

   Model: Film force of a full cylindrical journal bearing of finite length, Reynolds equation with Reynolds
   rupture. x and y are Cartesian from the bearing center, rotation is positive about +z (from x to y), the
   force acts on the journal. With the eccentricity e = (x, y)/clearance and the source w = (vx,
   vy)/clearance - (speed/2) z^ x e, the film minimizes a quadratic functional, so that its force is a
   gradient:

   Equations:
   F = viscosity length radius^3 / clearance^2  dJ/dw
   J(e, w) = -|w|^2 exp(L0 + chi M(X, T)),  chi = |e|
   X = chi / (1 - chi^2)^(1/4),  T = (1 + cos(e, w)) / 2

   Validity: M and L0 are splines over X, T and ln(length / (2 radius)), fitted to converged solutions: one
   force within 1e-4 up to an eccentricity ratio of 0.97, length / diameter from 0.1 to 4; beyond the
   last node of the map it goes on as the film near the wall, or, where the map is no such film, as a power of
   X, with a warning that says how far it may be off. Laminar, isothermal, aligned, without grooves. Where w
   vanishes off the center the force is zero and has no derivative. */
#include <stdlib.h>

#include "../films/journal_model.h"
#include "../films/map_table.h"

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_map map;
    const rf_table *layers, *centers;
    const double *range;
    double slenderness, center; /* of the map; 0 as long as there is none */
    double *slice, *spare;
} model;

static void release(void *kernel)
{
    model *self = kernel;
    free(self->slice);
    free(self->spare);
}

static size_t layer_size(const model *self)
{
    return (size_t)self->layers->extent[1] * self->layers->extent[2];
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    if (rf_take_map(&self->map, RF_LAYERED, "", tables, why) != RF_OK
        || !(self->range = rf_numbers(tables, "range", 2, why)))
        return RF_INVALID;
    self->layers = rf_find_table(tables, "coefficients", 3, why);
    self->centers = rf_find_table(tables, "center", 1, why);
    const double low = self->range[0], high = self->range[1];
    if (!(low > 0.0 && (self->centers->extent[0] == 1 ? high >= low : high > low)))
        return rf_say(why, RF_INVALID, "range must be positive and ascending, got %.9g and %.9g", low, high);
    self->journal.film = rf_map_film;
    self->journal.data = &self->map;
    self->map.center = &self->center;
    self->slice = malloc(layer_size(self) * sizeof *self->slice);
    self->spare = malloc(layer_size(self) * sizeof *self->spare);
    *sizes = RF_JOURNAL_SIZES;
    return self->slice && self->spare ? RF_OK : rf_say(why, RF_MEMORY, "no memory for the map of a journal");
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_journal scaled = self->journal;
    if (rf_scale_journal(&scaled, p, why) != RF_OK)
        return RF_INVALID;
    const double slenderness = rf_slenderness(p);
    if (slenderness != self->slenderness) {
        const size_t layers = self->centers->extent[0];
        if (rf_map_slice(self->layers->numbers, layers, layer_size(self), self->range, slenderness, self->spare) != RF_OK)
            return rf_say(why, RF_INVALID,
                          "length/diameter must be within the table of the film, %.9g to %.9g, got %.9g",
                          self->range[0], self->range[1], slenderness);
        rf_map_slice(self->centers->numbers, layers, 1, self->range, slenderness, &self->center);
        double *const old = self->slice;
        self->slice = self->spare;
        self->spare = old;
        self->slenderness = slenderness;
        self->map.coefficients = self->slice;
        self->map.slenderness = slenderness;
        rf_map_to_wall(&self->map);
        scaled.error = rf_map_error(&self->map);
    }
    self->journal = scaled;
    return RF_OK;
}

const rf_kernel_type rf_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .release = release,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
