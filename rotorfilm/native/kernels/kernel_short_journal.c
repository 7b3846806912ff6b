/* Kernel "short_journal": a plain journal bearing with the short-bearing film.

   Parameters, inputs and outputs as in journal_model.h; no tables. */
#include <stdlib.h>

#include "../films/journal_model.h"
#include "../films/short_kernel.h"

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_short film;
} model;

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    (void)tables;
    model *self = calloc(1, sizeof *self);
    if (!self) {
        rf_say(why, RF_MEMORY, "no memory for a journal");
        return NULL;
    }
    self->journal.film = rf_short_film;
    self->journal.map = &self->film;
    *sizes = RF_JOURNAL_SIZES;
    return self;
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

extern const rf_kernel_type rf_short_journal_type;
const rf_kernel_type rf_short_journal_type = {
    .name = "short_journal",
    .create = create,
    .destroy = free,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
