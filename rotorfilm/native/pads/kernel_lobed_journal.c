/* Kernel "lobed_journal": a journal bearing of fixed pads, each about its own center, over maps of their films.

   Parameters, inputs and outputs as in journal_model.h; the clearance is that of the pads, length/diameter that of the
   maps. Tables: lobes (n x 4: angle of the middle [rad], center of curvature x, y / clearance, number of the map),
   slenderness (1), and for each map k those of RF_PAD in map_table.h with "k." in front. */

/* Documentation of the FMU

   Model: Film force of a journal bearing of fixed pads of finite length, as elliptical, lobed or offset ones;
   Reynolds equation with Reynolds rupture, ambient pressure at the ends and sides of the pads. x and y are Cartesian
   from the bearing center, rotation is positive about +z (from x to y), the force acts on the journal. Each pad is an
   arc about a center of curvature r_p of its own. In the frame of its middle, with e = ((x, y) - r_p)/clearance and
   w = (vx, vy)/clearance - (speed/2) z^ x e at the angle phi, its film minimizes a quadratic functional, so that
   its force is a gradient, and that of the bearing is the sum:

   Equations:
   F = viscosity length radius^3 / clearance^2  sum dJ/dw
   J(e, w) = -|w|^2 s^5 exp(M(u, Y, phi)),  s = cos phi + sin(extent/2), 0 where nothing drives the film
   e = (1 - exp(-u), tanh(Y) E),  |e_y| < E where the film is open

   Validity: M is a spline made for pads of these extents and this length / diameter: radius and length are fixed, the
   clearance of the pads and the viscosity tunable, preload and offset as made. Beyond the last u and Y the force is
   extrapolated, with a warning. Laminar, isothermal, aligned. Where a w vanishes the force of its pad is zero and
   has no derivative. */
#include <math.h>
#include <stdio.h>

#include "../films/journal_model.h"
#include "../films/lobes.h"
#include "../films/map_table.h"

#define MOST_LOBES 50

typedef struct model {
    rf_lobes lobes;
    double slenderness;
    const double *places; /* of the table lobes */
    rf_map maps[MOST_LOBES];
    rf_lobe list[MOST_LOBES];
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const rf_table *places = rf_find_table(tables, "lobes", 2, why);
    const rf_table *slenderness = places ? rf_find_table(tables, "slenderness", 1, why) : NULL;
    if (!slenderness)
        return RF_INVALID;
    const uint32_t count = places->extent[0];
    if (places->extent[1] != 4 || count < 1 || count > MOST_LOBES || slenderness->extent[0] != 1
        || !(slenderness->numbers[0] > 0.0))
        return rf_say(why, RF_INVALID, "table lobes must be 1 to %d x 4, got %u x %u", MOST_LOBES, (unsigned)count,
                      (unsigned)places->extent[1]);
    self->slenderness = slenderness->numbers[0];
    self->places = places->numbers;
    self->lobes.count = count;
    self->lobes.list = self->list;
    int made = 0;
    for (uint32_t k = 0; k < count; ++k) {
        const double *row = places->numbers + 4 * k;
        if (!(row[3] >= 0.0 && row[3] <= made && row[3] == floor(row[3])))
            return rf_say(why, RF_INVALID, "number of a map must be 0 to %d, got %.9g", made, row[3]);
        const int number = (int)row[3];
        if (number == made) {
            char of[16];
            snprintf(of, sizeof of, "%d.", number);
            if (rf_take_map(&self->maps[made++], RF_PAD, of, tables, why) != RF_OK)
                return RF_INVALID;
        }
        rf_lobe *lobe = &self->list[k];
        lobe->film.film = rf_pad_film;
        lobe->film.data = &self->maps[number];
        lobe->cos = cos(row[0]);
        lobe->sin = sin(row[0]);
    }
    *sizes = RF_JOURNAL_SIZES;
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_journal scaled = self->list[0].film;
    if (rf_scale_journal(&scaled, p, why) != RF_OK
        || rf_judge_slenderness(self->slenderness, "maps of the pads", p, why) != RF_OK)
        return RF_INVALID;
    for (int k = 0; k < MOST_LOBES; ++k)
        rf_scale_growth(&self->maps[k], p);
    for (size_t k = 0; k < self->lobes.count; ++k) {
        rf_lobe *lobe = &self->list[k];
        lobe->film.clearance = scaled.clearance;
        lobe->film.force_scale = scaled.force_scale;
        lobe->x = scaled.clearance * self->places[4 * k + 1];
        lobe->y = scaled.clearance * self->places[4 * k + 2];
    }
    return RF_OK;
}

static int explain(const model *self, int status, const double *u, rf_message *why)
{
    if (status == RF_AT_WALL)
        return rf_say(why, status, "the journal must leave a film on every pad, and touches one at x = %.9g, y = %.9g m",
                      u[0], u[1]);
    return rf_explain_journal(&self->list[0].film, status, u, why);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    return explain(self, rf_lobes_at(&self->lobes, at->u, y, NULL), at->u, why);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    double y[2];
    return explain(self, rf_lobes_at(&self->lobes, at->u, y, answer->D), at->u, why);
}

const rf_kernel_type rf_lobed_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
};
