/* Kernel "polar_journal": a plain journal bearing whose film lies on an arc fixed to the line of centers.

   Parameters, inputs and outputs as in journal_model.h; tables of films/polar_film.h. */

/* Documentation of the FMU

   Model: Film force of a full cylindrical journal bearing by the splitting method of Sussi and Fridman (1978), on an
   arc fixed to the line of centers. x and y are Cartesian from the bearing center, rotation is positive about +z (from x
   to y), the force acts on the journal. With the eccentricity e = (x, y)/clearance, chi = |e|, e_r = e/chi, e_t = z^ x e_r
   and the source w = (vx, vy)/clearance - (speed/2) z^ x e:

   Equations:
   F = viscosity length radius^3 / clearance^2  (F_t e_t + F_r e_r)
   (F_t, F_r) = -A(chi) (w.e_t, w.e_r)

   Validity: The matrix A is a series over atanh(chi), made for this order, arc and length / diameter, and equal to the
   model in Python within 1e-9. So radius and length are fixed, and clearance and viscosity tunable. Beyond the
   eccentricity ratio 0.999 the force goes on as (1 - chi^2)^(-3/2), with a warning. The arc follows the sense of
   rotation; for small motion about a static equilibrium. Laminar, isothermal, aligned, without grooves. */
#include "../films/journal_model.h"
#include "../films/polar_film.h"

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_polar_table film;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    self->journal.film = rf_polar_film;
    self->journal.data = &self->film;
    *sizes = RF_JOURNAL_SIZES;
    return rf_take_polar(&self->film, tables, why);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    if (rf_judge_slenderness(self->film.slenderness, "table of the film", p, why) != RF_OK)
        return RF_INVALID;
    return rf_scale_journal(&self->journal, p, why);
}

const rf_kernel_type rf_polar_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
