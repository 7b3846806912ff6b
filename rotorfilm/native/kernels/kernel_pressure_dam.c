/* Kernel "pressure_dam": a bearing of fixed pads with recesses under the two-dimensional film on a grid.

   Parameters, inputs and outputs as in journal_model.h. Tables: pads (P x 13: the numbers of an rf_recess_pad of
   recess.h, in its order), extrapolated (1: whether the force is that of two grids); with a mobility those of
   mobility.h. */

/* Documentation of the FMU

   Model: Film force of a bearing of fixed pads, each with its own center of curvature and any with a recess
   (pressure dam, step, relief track), at ambient pressure; Reynolds equation in two dimensions by finite volumes. x
   and y are Cartesian from the bearing center, rotation is positive about +z (from x to y), the force acts on the
   journal. The clearance c_p is that of a pad: its radius of curvature less that of the journal. With d the
   position from the pad's center of curvature, e = d/c_p, the source w = (vx, vy)/c_p - (speed/2) z^ x e, n =
   (cos theta, sin theta) and the depth D of the recess over c_p:

   Equations:
   (m H^3 P_theta)_theta + (length/diameter)^-2 m H^3 P_zz = -w.n + (speed/2) D_theta,  H = 1 - e.n + D
   P = 0 at the ends of a pad, P >= 0 where the film ruptures, 0 < z < 1 over half the length
   F = sum over the pads of -12 viscosity length radius^3 / c_p^2  integral of P n over theta and z

   Validity: Isothermal, aligned; laminar, m = 1, unless there is a table mobility of m over H, or over the local
   Reynolds number, at which the viscosity counts too; no loss nor inertia at a step, no inlet pressure. Arcs, preloads and the
   recesses with their depth in m are fixed. Where nothing drives the film of a pad the force has no derivative. */
#include <math.h>

#include "../films/journal_model.h"
#include "../grids/recess.h"

#define COLUMNS 13u
#define MOST_PADS 100u
#define MOST_LINES 10000
#define MOST_NODES 1000
#define TURN 6.28318530717958647692

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks: dimensions are checked and explained as a journal's */
    rf_recess bearing;
    rf_recess_pad pads[MOST_PADS];
} model;

static int is_even_count(double number)
{
    return number >= 0.0 && number <= MOST_LINES && fmod(number, 2.0) == 0.0;
}

/* Whether there are cells where there is something between the edges, and nowhere else. */
static int fits_edges(const rf_recess_pad *pad)
{
    const double edge[4] = {pad->start, pad->from, pad->to, pad->start + pad->extent};
    int fits = (pad->along[1] > 0) == (pad->share < 1.0);
    for (int k = 0; k < 3; ++k)
        fits = fits && edge[k] <= edge[k + 1] && (pad->around[k] > 0) == (edge[k] < edge[k + 1]);
    return fits;
}

static int take_pad(const double *row, rf_recess_pad *pad)
{
    for (int cell = 8; cell < 13; ++cell)
        if (!is_even_count(row[cell]))
            return 0;
    const rf_recess_pad taken = {row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7],
                                 {(int32_t)row[8], (int32_t)row[9], (int32_t)row[10]},
                                 {(int32_t)row[11], (int32_t)row[12]}};
    *pad = taken;
    const int32_t lines = pad->around[0] + pad->around[1] + pad->around[2], nodes = pad->along[0] + pad->along[1];
    return pad->extent > 0.0 && pad->extent < TURN && pad->preload >= 0.0 && pad->preload < 1.0 && pad->depth >= 0.0
           && pad->share > 0.0 && pad->share <= 1.0 && lines >= 4 && lines <= MOST_LINES && pad->along[0] >= 2
           && nodes <= MOST_NODES && fits_edges(pad);
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const rf_table *pads = rf_find_table(tables, "pads", 2, why);
    const rf_table *extrapolated = pads ? rf_find_table(tables, "extrapolated", 1, why) : NULL;
    if (!extrapolated)
        return RF_INVALID;
    const uint32_t count = pads->extent[0];
    if (count < 1 || count > MOST_PADS || pads->extent[1] != COLUMNS || extrapolated->extent[0] != 1)
        return rf_say(why, RF_INVALID, "table pads must be 1 to %u x %u, got %u x %u", MOST_PADS, COLUMNS,
                      (unsigned)count, (unsigned)pads->extent[1]);
    for (uint32_t k = 0; k < count; ++k) {
        if (!take_pad(pads->numbers + k * COLUMNS, self->pads + k))
            return rf_say(why, RF_INVALID, "pad %u must have its recess on its arc, and even counts of cells on both "
                          "sides of edges", (unsigned)k);
    }
    self->bearing.pads = self->pads;
    self->bearing.count = count;
    self->bearing.extrapolated = extrapolated->numbers[0] != 0.0;
    if (rf_take_mobility(&self->bearing.mobility, tables, why) != RF_OK)
        return RF_INVALID;
    *sizes = RF_JOURNAL_SIZES;
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    if (rf_scale_journal(&self->journal, p, why) != RF_OK)
        return RF_INVALID;
    if (p[2] >= p[0])
        return rf_say(why, RF_INVALID, "pad clearance must be below the radius %.9g, got %.9g", p[0], p[2]);
    self->bearing.radius = p[0];
    self->bearing.length = p[1];
    self->bearing.clearance = p[2];
    self->bearing.viscosity = p[3];
    rf_scale_mobility(&self->bearing.mobility, p[0], p[2], p[3]);
    return RF_OK;
}

static int explain(const model *self, int status, const double *u, rf_message *why)
{
    size_t pad;
    if (status == RF_UNDEFINED)
        return rf_say(why, status,
                      "velocity and speed must drive the film of every pad where a derivative is asked for: "
                      "x = %.9g, y = %.9g m, vx = %.9g, vy = %.9g m/s, speed = %.9g rad/s",
                      u[0], u[1], u[2], u[3], u[4]);
    if (status != RF_AT_WALL)
        return rf_explain_journal(&self->journal, status, u, why);
    const double least = rf_recess_least(&self->bearing, u, &pad);
    return rf_say(why, status,
                  "the journal must stay off the pads, got a film of %.9g m on pad %u (x = %.9g, y = %.9g)", least, (unsigned)pad, u[0], u[1]);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    return explain(self, rf_recess_at(&self->bearing, at->u, y, NULL), at->u, why);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    double y[2];
    return explain(self, rf_recess_at(&self->bearing, at->u, y, answer->D), at->u, why);
}

const rf_kernel_type rf_pressure_dam_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
};
