/* Kernel "damper": a cavitated squeeze film over its impedance map, and retainer springs beside it.

   Parameters of a journal (journal_model.h) and stiffness [N/m]; inputs x, y [m], vx, vy [m/s]; outputs force_x, force_y [N].
   Forces of the film are in units of viscosity * radius * length^3 / clearance^2 per 1/s. Tables of RF_PLAIN in
   map_table.h. What of the dimensions the map holds for is up to the bounds of the parameters. */

/* Documentation of the FMU

   Model: Force of a squeeze-film damper with a solid or porous cage, and of its retainer springs, on the
   rotor. The race does not spin: there is no speed. x and y are Cartesian from the bearing center. With the
   eccentricity e = (x, y)/clearance and its rate w = (vx, vy)/clearance, the film minimizes a quadratic
   functional, so that its force is a gradient:

   Equations:
   F = viscosity radius length^3 / clearance^2  dJ/dw - stiffness (x, y)
   J(e, w) = -|w|^2 exp(L0 + chi M(X, T)),  chi = |e|
   X = chi / (1 - chi^2)^(1/4),  T = (1 + cos(e, w)) / 2

   Validity: M is a spline over X and T, made for this damper. Fixed is what it holds for: length and
   clearance where the cage is porous, radius and length where the film is of finite length. The springs are
   preloaded so that they carry the static load. Beyond the last X, the first number of the table map, the force goes
   on as that of the film near the wall, or, where the map is no such film (porous cages, films without
   rupture), as a power of X, with a warning. Laminar, isothermal, aligned, without oil inertia. Where the
   rotor is at rest off the center the film force is zero and has no derivative. */
#include <math.h>
#include <stdlib.h>

#include "../films/journal_model.h"
#include "../films/map_table.h"

enum { RADIUS, LENGTH, STIFFNESS = 4, PARAMETERS, INPUTS = 4 };

typedef struct model {
    rf_journal journal; /* first, as journal_model.h asks */
    rf_map map;
    double stiffness;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    static const rf_sizes mine = {PARAMETERS, INPUTS, 2, 0, 0};
    model *self = kernel;
    if (rf_take_map(&self->map, RF_PLAIN, "", tables, why) != RF_OK)
        return RF_INVALID;
    rf_map_to_wall(&self->map);
    self->journal.film = rf_map_film;
    self->journal.data = &self->map;
    self->journal.error = rf_map_error(&self->map);
    *sizes = mine;
    return RF_OK;
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    return rf_make_kernel(sizeof(model), take_tables, free, tables, sizes, why);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    const double slimness = p[LENGTH] / p[RADIUS];
    if (!(p[STIFFNESS] >= 0.0 && p[STIFFNESS] < HUGE_VAL))
        return rf_say(why, RF_INVALID, "stiffness must be finite and not negative, got %.9g", p[STIFFNESS]);
    if (rf_scale_journal(&self->journal, p, why) != RF_OK)
        return RF_INVALID;
    self->journal.force_scale *= slimness * slimness;
    self->stiffness = p[STIFFNESS];
    return RF_OK;
}

/* Force and, unless NULL, D[2][4]. The race does not spin: speed 0. */
static int answer(const void *kernel, const rf_point *at, double *y, double *D, rf_message *why)
{
    const model *self = kernel;
    const double k = self->stiffness, u[5] = {at->u[0], at->u[1], at->u[2], at->u[3], 0.0};
    const rf_point still = {at->t, at->x, u};
    double jacobian[10];
    rf_jacobian film = {NULL, NULL, NULL, jacobian};
    const int status = D ? rf_journal_derivatives(kernel, &still, &film, why)
                         : rf_journal_output(kernel, &still, y, why);
    for (int i = 0; i < 2; ++i) {
        if (!D)
            y[i] -= k * u[i];
        for (int j = 0; D && j < INPUTS; ++j)
            D[INPUTS * i + j] = jacobian[5 * i + j] - (i == j ? k : 0.0);
    }
    return status;
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    return answer(kernel, at, y, NULL, why);
}

static int derivatives(const void *kernel, const rf_point *at, rf_jacobian *given, rf_message *why)
{
    return answer(kernel, at, NULL, given->D, why);
}

const rf_kernel_type rf_damper_type = {
    .create = create,
    .destroy = free,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = derivatives,
};
