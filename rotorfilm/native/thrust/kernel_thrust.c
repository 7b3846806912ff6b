/* Kernel "thrust": a thrust bearing of sector pads, fixed or on pivots, under its film on a grid.

   Tables: angle (lines + 1), radius (nodes + 1), profile (lines x nodes x 4) of sector.h; numbers (9): ring, ruptured,
   levels and extrapolated of sector.h; count, first, side, pivot and tilts of thrust.h. Parameters: gap [m], viscosity
   [Pa s]. Or also a film from tables, film_table.h: film (cells_x + 5, cells_y + 5, functions), ranges (8) of its members x0 to
   pivot, and of a whole bearing shears (cells_x + 5, 2). Inputs: z [m], tilt_x, tilt_y [rad], their rates, speed [rad/s]. States: tilts of the pads [rad]. Outputs:
   force_z [N], moment_x, moment_y, torque [N m]. */

/* Documentation of the FMU

   Model: Force, moments and torque of the films of a thrust bearing on a flat collar. z points along the axis of rotation
   from where the films over the lands of the pads have the thickness gap, tilts are rotations of the shaft about +x and +y.
   The collar may push towards -z (side = 1) or +z (side = -1). Pads may stand on pivots: a pad has no mass, and
   tilts so that its film has no moment about the pivot; its tilts, along the rotation and outward, are states. On a pad
   with the depth g below its land, X and Y from the axis:

   Equations:
   h = g + gap + side (z + tilt_x Y - tilt_y X) + A_t s_t + A_r s_r
   div(h^3/(12 viscosity) grad p) = (speed/2) dh/dphi + dh/dt,  p = 0 at all edges, p >= 0 where the film ruptures
   force_z = side integral of p,  moment_x = side integral of Y p,  moment_y = -side integral of X p
   torque = -integral of (viscosity speed r^2/h + (h/2) dp/dphi)

   Validity: Laminar, isothermal, rigid; ambient pressure around every pad, no inertia at steps. Dimensions are fixed.
   Where nothing drives the film of a pad the force has no derivative. */
#include <math.h>

#include "../kernels/kernel.h"
#include "thrust.h"
#include "../films/quintic.h"

#define MOST_CELLS 10000u
#define MOST_PADS 1000
#define NUMBERS 9
#define RANGES 8

enum { GAP, VISCOSITY, PARAMETERS };

typedef struct model {
    rf_thrust bearing;
} model;

static int is_count(double number, double least, double most)
{
    return number >= least && number <= most && floor(number) == number;
}

static int is_rising(const double *numbers, size_t count)
{
    for (size_t k = 1; k < count; ++k)
        if (!(numbers[k] > numbers[k - 1]))
            return 0;
    return 1;
}

static int fits(const rf_table *angle, const rf_table *radius, const rf_table *profile, const double *n)
{
    const uint32_t lines = profile->extent[0], nodes = profile->extent[1];
    const int rules = (n[0] == 0.0 || n[0] == 1.0) && (n[1] == 0.0 || n[1] == 1.0) && (n[3] == 0.0 || n[3] == 1.0)
                      && is_count(n[2], 1.0 + n[3], 6.0) && is_count(n[4], 1.0, MOST_PADS) && fabs(n[6]) == 1.0
                      && is_count(n[8], 0.0, 2.0);
    if (!rules || profile->extent[2] != 4 || lines > MOST_CELLS || nodes > MOST_CELLS)
        return 0;
    const uint32_t whole = 1u << (int)n[2];
    return lines >= 2 * whole && nodes >= whole && lines % (whole / 2) == 0 && nodes % (whole / 2) == 0
           && angle->extent[0] == lines + 1 && radius->extent[0] == nodes + 1 && radius->numbers[0] > 0.0
           && is_rising(angle->numbers, lines + 1) && is_rising(radius->numbers, nodes + 1);
}

/* The table of the film, if there is one. */
static int take_film(const rf_tables *tables, rf_thrust *bearing, rf_message *why)
{
    rf_film_table *to = &bearing->table;
    if (!rf_seek_table(tables, "film"))
        return RF_OK;
    const rf_table *film = rf_find_table(tables, "film", 3, why);
    const double *n = film ? rf_numbers(tables, "ranges", RANGES, why) : NULL;
    if (!n)
        return RF_INVALID;
    const uint32_t functions = film->extent[2], x = film->extent[0], y = film->extent[1];
    const rf_table *shears = functions == RF_TABLE_WHOLE ? rf_find_table(tables, "shears", 2, why) : NULL;
    if (functions == RF_TABLE_WHOLE && !shears)
        return RF_INVALID;
    const int sized = x > RF_ORDER && y > RF_ORDER && x < MOST_CELLS && y < MOST_CELLS && n[1] > n[0] && n[3] > n[2];
    const int known = shears ? bearing->tilts == 0 && shears->extent[0] == x && shears->extent[1] == RF_TABLE_SHEARS
                             : functions == RF_TABLE_PAD && bearing->tilts > 0;
    if (!sized || !known)
        return rf_say(why, RF_INVALID, "film must be a table of a whole bearing of fixed pads, or of one pad that tilts");
    const rf_film_table taken = {(int32_t)functions, (int32_t)x - RF_ORDER + 1, (int32_t)y - RF_ORDER + 1, n[0], n[1], n[2],
                                 n[3], n[4], n[5], n[6], n[7], film->numbers, shears ? shears->numbers : NULL};
    *to = taken;
    return RF_OK;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    rf_thrust *bearing = &((model *)kernel)->bearing;
    const rf_table *angle = rf_find_table(tables, "angle", 1, why);
    const rf_table *radius = angle ? rf_find_table(tables, "radius", 1, why) : NULL;
    const rf_table *profile = radius ? rf_find_table(tables, "profile", 3, why) : NULL;
    const double *n = profile ? rf_numbers(tables, "numbers", NUMBERS, why) : NULL;
    if (!n)
        return RF_INVALID;
    if (!fits(angle, radius, profile, n))
        return rf_say(why, RF_INVALID, "tables must be of rising angles and radii, with a profile of 4 numbers a cell "
                      "and cells that halve");
    const rf_sector pad = {profile->extent[0], profile->extent[1], angle->numbers, radius->numbers, profile->numbers,
                           1.0, (int32_t)n[0], (int32_t)n[1], (int32_t)n[2], (int32_t)n[3]};
    rf_thrust taken = {pad, (size_t)n[4], n[5], n[6], 0.0, n[7], (int32_t)n[8], 0, {0}};
    if (take_film(tables, &taken, why) != RF_OK)
        return RF_INVALID;
    *bearing = taken;
    *sizes = (rf_sizes){PARAMETERS, RF_THRUST_INPUTS, RF_SECTOR_ROWS, taken.count * (size_t)taken.tilts, 0};
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    if (!(isfinite(p[GAP]) && p[GAP] >= 0.0) || !(isfinite(p[VISCOSITY]) && p[VISCOSITY] > 0.0))
        return rf_say(why, RF_INVALID, "gap must not be negative and viscosity must be positive, got %.9g m and %.9g Pa s",
                      p[GAP], p[VISCOSITY]);
    self->bearing.gap = p[GAP];
    self->bearing.pad.viscosity = p[VISCOSITY];
    return RF_OK;
}

static int explain(const model *self, int status, const rf_point *at, rf_message *why)
{
    static const char *const said[] = {
        "", "", "velocity and speed must drive the film where a derivative is asked for", "the collar must stay off all pads",
        "the force is not finite", "", "the search for the film of a pad, or for its tilts, found none", "no memory"};
    const double *u = at->u;
    if (status == RF_OK)
        return RF_OK;
    const double least = status == RF_AT_WALL ? rf_thrust_least(&self->bearing, at->x, u) : 0.0;
    return rf_say(why, status, "%s, at z = %.9g m, tilts (%.9g, %.9g) rad, speed = %.9g rad/s, least film %.9g m",
                  said[status], u[0], u[1], u[2], u[6], least);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    return explain(self, rf_thrust_at(&self->bearing, at->x, at->u, y, NULL, NULL), at, why);
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    const model *self = kernel;
    double y[RF_SECTOR_ROWS];
    return explain(self, rf_thrust_at(&self->bearing, at->x, at->u, y, dx, NULL), at, why);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    const rf_thrust_slopes slopes = {answer->A, answer->B, answer->C, answer->D};
    double y[RF_SECTOR_ROWS];
    return explain(self, rf_thrust_at(&self->bearing, at->x, at->u, y, NULL, &slopes), at, why);
}

const rf_kernel_type rf_thrust_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
};
