/* Kernel "reynolds_journal": a journal bearing under the two-dimensional film on a grid.

   Parameters, inputs and outputs as in journal_model.h. Tables: ring (6: length/diameter, ruptured, clipped,
   pinned, turning, extrapolated), spans (2 x K: start, extent [rad]) and for k = 0, 1, 2, the finest first,
   lines<k> (5 x N: span, line, face, held, value) and nodes<k> (2 x M: width, conductance); ring.h says what
   they are. With a supply pressure also pressure_unit (1: 12 viscosity (radius/clearance)^2 of the values), with a
   mobility those of mobility.h. */

/* Documentation of the FMU

   Model: Film force of a cylindrical journal bearing of finite length, plain or with pads, axial grooves, feed holes
   or a circumferential groove, at ambient or supply pressure; Reynolds equation in two dimensions by finite volumes. x and y are Cartesian from
   the bearing center, rotation is positive about +z (from x to y), the force acts on the journal. With the
   eccentricity e = (x, y)/clearance and the source w = (vx, vy)/clearance - (speed/2) z^ x e:

   Equations:
   (m H^3 P_theta)_theta + (length/diameter)^-2 m H^3 P_zz = -w.n,  H = 1 - e.n,  n = (cos theta, sin theta)
   P = 0 at the ends, P >= 0 where the film ruptures, 0 < z < 1 over half the length
   F = -12 viscosity length radius^3 / clearance^2  integral of P n over theta and z

   Validity: The lines of the grid crowd at the minimum film; where table ring says so, the force is extrapolated
   from two grids; the derivatives are those of the linearized
   equation on the same cells. Length / diameter must stay at most 4 or that of the grid; with openings radius
   and length are fixed. Isothermal, aligned; laminar, m = 1, unless there is a table mobility of m over H, or over the
   local Reynolds number, at which the viscosity counts too. Where w vanishes and there is no supply the force is zero
   and has no derivative. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/journal_model.h"
#include "../grids/ring.h"

#define ROUNDOFF 1e-12 /* relative, by which length/diameter may differ from that of the grid */
#define MOST_LINES 10000u
#define LONG 4.0       /* above it the nodes along the film depend on length/diameter */

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_ring ring;
    double slenderness, unit; /* of the grid; length/diameter, and 12 viscosity (radius/clearance)^2 */
    void *memory;
    double *value[RF_LEVELS];         /* pressures of the lines as the ring reads them ... */
    const double *supply[RF_LEVELS];  /* ... and in the unit of the grid */
} model;

static int is_count(double number, double most)
{
    return number >= 0.0 && number < most && number == floor(number);
}

static int take_grid(model *self, const rf_tables *tables, int level, int32_t **whole, double **value,
                     rf_message *why)
{
    char name[2][8] = {"lines0", "nodes0"};
    name[0][5] = name[1][5] = (char)('0' + level);
    const rf_table *lines = rf_find_table(tables, name[0], 2, why);
    const rf_table *nodes = lines ? rf_find_table(tables, name[1], 2, why) : NULL;
    if (!nodes)
        return RF_INVALID;
    const uint32_t n = lines->extent[1], m = nodes->extent[1];
    const int fits = level == 0 || (2 * n == self->ring.grids[level - 1].lines
                                    && 2 * m == self->ring.grids[level - 1].nodes);
    if (lines->extent[0] != 5 || nodes->extent[0] != 2 || n < 4 || m < 1 || n > MOST_LINES || m > 1000 || !fits)
        return rf_say(why, RF_INVALID, "the grids of a film must fit each other, got %u x %u cells",
                      (unsigned)n, (unsigned)m);
    const double *of = lines->numbers, *span = of, *held = of + 3 * n;
    int32_t *spans = *whole;
    int32_t *is_held = spans + n;
    for (uint32_t i = 0; i < n; ++i) {
        if (!is_count(span[i], self->ring.spans) || !is_count(held[i], m + 1.0))
            return rf_say(why, RF_INVALID, "line %u of a film must be of a span, got %.9g", (unsigned)i, span[i]);
        spans[i] = (int32_t)span[i];
        is_held[i] = (int32_t)held[i];
        (*value)[i] = of[4 * n + i];
    }
    for (uint32_t j = 0; j < 2 * m; ++j)
        if (!(nodes->numbers[j] > 0.0))
            return rf_say(why, RF_INVALID, "nodes of a film must be apart, got %.9g", nodes->numbers[j]);
    const rf_grid grid = {n, m, spans, of + n, of + 2 * n, *value, is_held,
                          nodes->numbers, nodes->numbers + m, NULL, NULL, 0};
    self->ring.grids[level] = grid;
    self->value[level] = *value;
    self->supply[level] = of + 4 * n;
    *whole = is_held + n;
    *value += n;
    return RF_OK;
}

/* The unit of the pressures that lines are held at, where one is. */
static int take_unit(model *self, const rf_tables *tables, rf_message *why)
{
    const rf_grid *grid = &self->ring.grids[0];
    for (size_t i = 0; i < grid->lines; ++i) {
        if (grid->value[i] == 0.0)
            continue;
        const rf_table *unit = rf_find_table(tables, "pressure_unit", 1, why);
        if (!unit || unit->extent[0] != 1 || !(unit->numbers[0] > 0.0))
            return rf_say(why, RF_INVALID, "table pressure_unit must be one positive number for a supply");
        self->unit = unit->numbers[0];
        return RF_OK;
    }
    return RF_OK;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const rf_table *ring = rf_find_table(tables, "ring", 1, why);
    const rf_table *spans = ring ? rf_find_table(tables, "spans", 2, why) : NULL;
    const rf_table *lines = spans ? rf_find_table(tables, "lines0", 2, why) : NULL;
    if (!lines)
        return RF_INVALID;
    const double *n = ring->numbers;
    const uint32_t count = spans->extent[1];
    if (ring->extent[0] != 6 || spans->extent[0] != 2 || count < 1 || count > 1000
        || !(n[0] > 0.0 && is_count(n[1], 2.0) && is_count(n[2], 2.0) && is_count(n[3], 2.0)
             && is_count(n[4], 2.0) && is_count(n[5], 2.0)))
        return rf_say(why, RF_INVALID, "table ring must be of a film, got length/diameter %.9g", n[0]);
    self->slenderness = self->ring.slenderness = n[0];
    self->ring.ruptured = n[1] != 0.0;
    self->ring.clipped = n[2] != 0.0;
    self->ring.pinned = n[3] != 0.0;
    self->ring.turning = n[4] != 0.0;
    self->ring.extrapolated = n[5] != 0.0;
    self->ring.levels = RF_LEVELS;
    self->ring.recess = -1;
    self->ring.spans = (int32_t)count;
    self->ring.start = spans->numbers;
    self->ring.extent = spans->numbers + count;
    self->journal.film = rf_ring_film;
    self->journal.data = &self->ring;
    *sizes = RF_JOURNAL_SIZES;
    if (lines->extent[0] != 5 || lines->extent[1] > MOST_LINES)
        return rf_say(why, RF_INVALID, "table lines0 must be 5 x %u at most, got %u x %u", MOST_LINES,
                      (unsigned)lines->extent[0], (unsigned)lines->extent[1]);
    const size_t most = 2 * (size_t)lines->extent[1];
    double *value = self->memory = malloc(most * (sizeof *value + 2 * sizeof(int32_t)));
    if (!value)
        return rf_say(why, RF_MEMORY, "no memory for a journal");
    int32_t *whole = (int32_t *)(value + most);
    for (int level = 0; level < RF_LEVELS; ++level)
        if (take_grid(self, tables, level, &whole, &value, why) != RF_OK)
            return RF_INVALID;
    return rf_take_mobility(&self->ring.mobility, tables, why) == RF_OK ? take_unit(self, tables, why) : RF_INVALID;
}

static void release(void *kernel)
{
    free(((model *)kernel)->memory);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_journal scaled = self->journal;
    if (rf_scale_journal(&scaled, p, why) != RF_OK)
        return RF_INVALID;
    const double slenderness = rf_slenderness(p), grid = self->slenderness;
    const int same = fabs(slenderness - grid) <= ROUNDOFF * grid;
    if (!same && (self->ring.pinned || fmax(slenderness, grid) > LONG))
        return rf_say(why, RF_INVALID, "length/diameter must be that of the grid of the film, %.9g, got %.9g",
                      grid, slenderness);
    self->journal = scaled;
    self->ring.slenderness = same ? grid : slenderness;
    rf_scale_mobility(&self->ring.mobility, p[0], p[2], p[3]);
    const double unit = 12.0 * p[3] * (p[0] / p[2]) * (p[0] / p[2]);
    for (int level = 0; level < RF_LEVELS; ++level)
        for (size_t i = 0; i < self->ring.grids[level].lines; ++i)
            self->value[level][i] = self->supply[level][i] * (self->unit / unit);
    return RF_OK;
}

const rf_kernel_type rf_reynolds_journal_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .release = release,
    .set_parameters = set_parameters,
    .output = rf_journal_output,
    .jacobian = rf_journal_derivatives,
};
