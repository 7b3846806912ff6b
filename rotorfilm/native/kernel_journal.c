/* Kernel "journal": a plain journal bearing over the universal impedance map.

   Parameters radius, length, clearance [m], viscosity [Pa s]; inputs x, y [m], vx, vy [m/s], speed [rad/s];
   outputs force_x, force_y [N]. Tables: coefficients (s, x, t), center (s), range (2: smallest and largest
   length/diameter), reach (1). */
#include <math.h>
#include <stdlib.h>

#include "journal_kernel.h"
#include "kernel.h"
#include "map_table.h"

enum { RADIUS, LENGTH, CLEARANCE, VISCOSITY, PARAMETERS };

typedef struct model {
    rf_journal journal;
    rf_map_table table;
    double slenderness; /* of the map in `journal`; 0 as long as there is none */
    double *slice, *spare;
} model;

static void destroy(void *kernel)
{
    model *self = kernel;
    free(self->slice);
    free(self->spare);
    free(self);
}

static int take_tables(model *self, const rf_tables *tables, rf_message *why)
{
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
    self->journal.map.cells_x = table.cells_x;
    self->journal.map.cells_t = table.cells_t;
    self->journal.map.x_end = reach->numbers[0];
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
        destroy(self);
        return NULL;
    }
    const size_t count = (size_t)(self->table.cells_x + 5) * (size_t)(self->table.cells_t + 5);
    self->slice = malloc(count * sizeof *self->slice);
    self->spare = malloc(count * sizeof *self->spare);
    if (!self->slice || !self->spare) {
        rf_say(why, RF_MEMORY, "no memory for the map of a journal");
        destroy(self);
        return NULL;
    }
    const rf_sizes mine = {PARAMETERS, 5, 2, 0};
    *sizes = mine;
    return self;
}

static int check(const double *p, rf_message *why)
{
    static const char *const NAMES[] = {"radius", "length", "clearance", "viscosity"};
    for (int i = 0; i < PARAMETERS; ++i)
        if (!(p[i] > 0.0 && p[i] < HUGE_VAL))
            return rf_say(why, RF_INVALID, "%s must be finite and positive, got %.9g", NAMES[i], p[i]);
    if (p[CLEARANCE] >= p[RADIUS])
        return rf_say(why, RF_INVALID, "clearance must be below the radius %.9g, got %.9g", p[RADIUS],
                      p[CLEARANCE]);
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    if (check(p, why) != RF_OK)
        return RF_INVALID;
    const double slenderness = p[LENGTH] / (2.0 * p[RADIUS]);
    const double c = p[CLEARANCE],
                 scale = p[VISCOSITY] * p[LENGTH] * (p[RADIUS] * p[RADIUS] * p[RADIUS]) / (c * c);
    if (!(scale > 0.0 && scale < HUGE_VAL))
        return rf_say(why, RF_INVALID, "viscosity length radius^3 / clearance^2 must be finite, got %.9g",
                      scale);
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
        self->journal.map.center = center;
        self->journal.map.coefficients = self->slice;
    }
    self->journal.clearance = c;
    self->journal.force_scale = scale;
    return RF_OK;
}

static int explain(const model *self, int status, const double *u, rf_message *why)
{
    const double c = self->journal.clearance, e = sqrt(u[0] * u[0] + u[1] * u[1]);
    switch (status) {
    case RF_OK: return RF_OK;
    case RF_OUTSIDE:
        return rf_say(why, status,
                      "eccentricity ratio %.6g is beyond the map of the film; its force is extrapolated",
                      e / c);
    case RF_UNDEFINED:
        return rf_say(
            why, status,
            "the film has no derivative where its source velocity/clearance - (speed/2) z x eccentricity "
            "vanishes: x = %.9g, y = %.9g m, vx = %.9g, vy = %.9g m/s, speed = %.9g rad/s",
            u[0], u[1], u[2], u[3], u[4]);
    case RF_CONTACT:
        return rf_say(why, status,
                      "the journal must stay inside the clearance %.9g m, got an eccentricity of %.9g m "
                      "(x = %.9g, y = %.9g)",
                      c, e, u[0], u[1]);
    default:
        return rf_say(
            why, status,
            "the force is not finite at x = %.9g, y = %.9g m, vx = %.9g, vy = %.9g m/s, speed = %.9g rad/s",
            u[0], u[1], u[2], u[3], u[4]);
    }
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    return explain(self, rf_journal_force(&self->journal, at->u, y), at->u, why);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    double y[2];
    return explain(self, rf_journal_jacobian(&self->journal, at->u, y, answer->D), at->u, why);
}

extern const rf_kernel_type rf_journal_type;
const rf_kernel_type rf_journal_type = {
    .name = "journal",
    .create = create,
    .destroy = destroy,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
};
