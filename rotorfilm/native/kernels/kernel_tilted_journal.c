/* Kernel "tilted_journal": a plain journal bearing that feels the tilt of its journal, over impedance maps.

   Parameters as in journal_model.h; radius and length are those of the maps. Inputs x, y [m], tilt_x, tilt_y [rad], their
   rates and speed [rad/s]; outputs force_x, force_y [N], moment_x, moment_y [N m]. Tables: RF_LAYERED of map_table.h with
   one layer, and its range; tilt_share (1) of tilted_journal.h; and of the second order tilt_coefficients, tilt_center and
   tilt_map (1: last X) of tilt_map.h. */

/* Documentation of the FMU

   Model: Film force and moment of a full cylindrical journal bearing of finite length on a journal that may be tilted,
   Reynolds equation with Reynolds rupture. x and y are Cartesian from the bearing center, tilts are rotations about x and y,
   rotation is positive about +z, force and moment act on the journal, about the middle of the bearing. With the
   eccentricity e = (x, y)/clearance, the shift of the end tau = (tilt_y, -tilt_x) length/(2 clearance), and the sources w
   and w1 of both, as w = de/dt - (speed/2) z^ x e:

   Equations:
   force = viscosity length radius^3 / clearance^2  dJ/dw,  (moment_y, -moment_x) = (the same) length/2  dJ/dw1
   J = J0(e, w) + (|w| tau, w1).S (|w| tau, w1)/2, or without S the force of J0 and
   (moment_y, -moment_x) = share (F_w w1 + 2 F_e tau) length/2

   Validity: J0 and S are splines, fitted to converged solutions, S up to an eccentricity ratio of 0.96. The second order is
   within 1 % of the force, and 12 % of the moment, where the tilt takes 40 % of the aligned least film; beyond 60 % there is
   a warning. Laminar, isothermal, without grooves. Where w vanishes off the center the force is zero and has no
   derivative. */
#include <math.h>

#include "../films/journal_model.h"
#include "../films/map_table.h"
#include "../films/map_frame.h"
#include "../films/tilted_journal.h"

#define STATE RF_TILTED_STATE

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_map map;
    rf_tilt_map tilts;
    rf_tilted tilted;
    double slenderness;
} model;

static int take_tilts(model *self, const rf_tables *tables, rf_message *why)
{
    const rf_table *c = rf_find_table(tables, "tilt_coefficients", 3, why);
    const double *center = c ? rf_numbers(tables, "tilt_center", RF_TILT_ROWS, why) : NULL;
    const double *last = center ? rf_numbers(tables, "tilt_map", 1, why) : NULL;
    if (!last)
        return RF_INVALID;
    const uint32_t *n = c->extent;
    if (n[0] < 6 || n[1] < 6 || n[0] > 10000 || n[1] > 10000 || n[2] != RF_TILT_ROWS || !(last[0] > 0.0))
        return rf_say(why, RF_INVALID, "tilt_coefficients must be 6 x 6 x %d at least, got %u x %u x %u", RF_TILT_ROWS,
                      (unsigned)n[0], (unsigned)n[1], (unsigned)n[2]);
    const rf_tilt_map found = {{(int32_t)n[0] - 5, 0.0, last[0]}, {(int32_t)n[1] - 5, -1.0, 1.0}, c->numbers, center};
    self->tilts = found;
    self->tilted.map = &self->tilts;
    return RF_OK;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const double *range, *share;
    rf_message none;
    if (rf_take_map(&self->map, RF_LAYERED, "", tables, why) != RF_OK || !(range = rf_numbers(tables, "range", 2, why))
        || !(share = rf_numbers(tables, "tilt_share", 1, why)))
        return RF_INVALID;
    if (!(range[0] > 0.0 && range[1] == range[0]))
        return rf_say(why, RF_INVALID, "range must be one length/diameter, got %.9g and %.9g", range[0], range[1]);
    self->slenderness = self->map.slenderness = range[0];
    rf_map_to_wall(&self->map);
    self->journal.film = rf_map_film;
    self->journal.data = &self->map;
    self->tilted.aligned = rf_journal_at;
    self->tilted.of = &self->journal;
    self->tilted.share = *share;
    *sizes = (rf_sizes){4, STATE, 4, 0, 0};
    return rf_find_table(tables, "tilt_map", 1, &none) ? take_tilts(self, tables, why) : RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_journal scaled = self->journal;
    if (rf_scale_journal(&scaled, p, why) != RF_OK
        || rf_judge_slenderness(self->slenderness, "map of the film", p, why) != RF_OK)
        return RF_INVALID;
    scaled.error = rf_map_error(&self->map);
    self->journal = scaled;
    self->tilted.clearance = scaled.clearance;
    self->tilted.force_scale = scaled.force_scale;
    self->tilted.arm = 0.5 * p[1];
    return RF_OK;
}

static int respond(const model *self, const double *u, double *y, double *D, rf_message *why)
{
    const double c = self->journal.clearance, d[2] = {self->tilted.arm * u[3], -self->tilted.arm * u[2]};
    const double ends = fmax(rf_length(u[0] + d[0], u[1] + d[1]), rf_length(u[0] - d[0], u[1] - d[1]));
    const int status = rf_tilted_at(&self->tilted, u, y, D);
    const double own[5] = {u[0], u[1], u[4], u[5], u[8]};
    if (status == RF_AT_WALL || !(ends < c))
        return rf_say(why, RF_AT_WALL, "the ends of the journal must stay inside the clearance %.9g m, got %.9g m "
                      "(x = %.9g, y = %.9g m, tilts %.9g, %.9g rad)", c, ends, u[0], u[1], u[2], u[3]);
    if (status == RF_OUTSIDE)
        return rf_say(why, status, "the tilt must reduce the least film by at most 60 %%, change the film at most 1.5 times as "
                      "fast as the displacement does, and stay within the maps of the film, got x = %.9g, y = %.9g m and tilts %.9g, %.9g rad; "
                      "the force is continued", u[0], u[1], u[2], u[3]);
    return rf_explain_journal(&self->journal, status, own, why);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    return respond(kernel, at->u, y, NULL, why);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    double y[4];
    return respond(kernel, at->u, y, answer->D, why);
}

const rf_kernel_type rf_tilted_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
};
