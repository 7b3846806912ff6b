/* Kernel "short_journal": a plain journal bearing with the short-bearing film.

   Parameters, inputs and outputs as in journal_model.h; no tables. */

/* Documentation of the FMU

   Model: Film force of a full cylindrical journal bearing that is short: flow along the axis only, pressure
   on the half circle on which the film is fed (Ocvirk). x and y are Cartesian from the bearing center,
   rotation is positive about +z (from x to y), the force acts on the journal. With the eccentricity e = (x,
   y)/clearance and the source w = (vx, vy)/clearance - (speed/2) z^ x e, and a, b the parts of e along w
   and across it, the force is the gradient of a closed form:

   Equations:
   F = viscosity length^3 radius / clearance^2  dJ/dw
   J(e, w) = -|w|^2 I(a, b) / 2,  q^2 = 1 - a^2 - b^2
   I = atan2(q, -a) (q^2 + 3 a^2) / q^5 + 3 a / q^4

   Validity: For length / (2 radius) up to about 0.25, 0.5 for static forces at small eccentricity: in large
   motion the force is off by 6 % (median) at 0.25, by 23 % at 0.5. Laminar, isothermal, aligned, without
   grooves. Where w vanishes off the center the force is zero and has no derivative. */
#include "../films/journal_model.h"
#include "../films/short_kernel.h"

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_short film;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    (void)tables, (void)why;
    self->journal.film = rf_short_film;
    self->journal.data = &self->film;
    *sizes = RF_JOURNAL_SIZES;
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    if (rf_scale_journal(&self->journal, p, why) != RF_OK)
        return RF_INVALID;
    const double slenderness = rf_slenderness(p);
    self->film.factor = 4.0 * slenderness * slenderness;
    return RF_OK;
}

const rf_kernel_type rf_short_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
