/* Kernel "journal": a plain journal bearing over the universal impedance map.

   Parameters, inputs and outputs as in journal_model.h. Tables: coefficients (s, x, t), center (s), range (2: smallest and largest
   length/diameter), reach (1). */

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
#include "../films/map_kernel.h"
#include "../films/map_table.h"

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_map map;
    rf_map_table table;
    double slenderness; /* of the map; 0 as long as there is none */
    double *slice, *spare;
} model;

static void destroy(void *kernel)
{
    model *self = kernel;
    free(self->slice);
    free(self->spare);
    free(self);
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const rf_table *c = rf_find_table(tables, "coefficients", 3, why);
    const rf_table *center = c ? rf_find_table(tables, "center", 1, why) : NULL;
    const rf_table *range = center ? rf_find_table(tables, "range", 1, why) : NULL;
    const rf_table *reach = range ? rf_find_table(tables, "reach", 1, why) : NULL;
    if (!reach)
        return RF_INVALID;
    const uint32_t layers = c->extent[0], x = c->extent[1], t = c->extent[2];
    if (x < 6 || t < 6 || x > 10000 || t > 10000 || layers > 10000 || center->extent[0] != layers
        || !(layers == 1 || layers >= 6) || range->extent[0] != 2 || reach->extent[0] != 1)
        return rf_say(why, RF_INVALID, "the tables of a journal must fit each other, got %u x %u x %u and %u",
                      (unsigned)layers, (unsigned)x, (unsigned)t, (unsigned)center->extent[0]);
    const double low = range->numbers[0], high = range->numbers[1];
    if (!(low > 0.0 && (layers == 1 ? high >= low : high > low) && reach->numbers[0] > 0.0))
        return rf_say(why, RF_INVALID, "range must be positive and ascending, got %.9g and %.9g", low, high);
    const rf_map_table table = {layers == 1 ? 0 : (int32_t)layers - 5,
                                (int32_t)x - 5,
                                (int32_t)t - 5,
                                low,
                                high,
                                center->numbers,
                                c->numbers};
    self->table = table;
    self->map.cells_x = table.cells_x;
    self->map.cells_t = table.cells_t;
    self->map.x_end = reach->numbers[0];
    self->journal.film = rf_map_film;
    self->journal.data = &self->map;
    self->slice = malloc((size_t)x * t * sizeof *self->slice);
    self->spare = malloc((size_t)x * t * sizeof *self->spare);
    *sizes = RF_JOURNAL_SIZES;
    return self->slice && self->spare ? RF_OK : rf_say(why, RF_MEMORY, "no memory for the map of a journal");
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    return rf_make_kernel(sizeof(model), take_tables, destroy, tables, sizes, why);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_journal scaled = self->journal;
    if (rf_scale_journal(&scaled, p, why) != RF_OK)
        return RF_INVALID;
    const double slenderness = rf_slenderness(p);
    if (slenderness != self->slenderness) {
        double center;
        if (rf_map_slice(&self->table, slenderness, self->spare, &center) != RF_OK)
            return rf_say(why, RF_INVALID,
                          "length/diameter must be within the table of the film, %.9g to %.9g, got %.9g",
                          self->table.low, self->table.high, slenderness);
        double *const old = self->slice;
        self->slice = self->spare;
        self->spare = old;
        self->slenderness = slenderness;
        self->map.center = center;
        self->map.coefficients = self->slice;
        rf_map_to_wall(&self->map, slenderness, 1.0);
        scaled.error = rf_map_error(&self->map);
    }
    self->journal = scaled;
    return RF_OK;
}

const rf_kernel_type rf_journal_type = {
    .create = create,
    .destroy = destroy,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
