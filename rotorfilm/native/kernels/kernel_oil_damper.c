/* Kernel "oil_damper": a squeeze film between seals whose oil has inertia (films/oil_damper.h), and springs.

   Parameters of a journal (journal_model.h), stiffness [N/m], density [kg/m3] and leakage [m2/(Pa s)] of the seals, which
   only a short film reads; inputs x, y [m], vx, vy [m/s]; outputs force_x, force_y [N] and, where the table `parts` says so,
   mass_xx, mass_xy, mass_yy [kg]. Tables: parts (6: whether the viscous film is a map or that of squeeze_film.h; shares of zone, closed form and
   table in the inertia; share of the circumference between leaking seals, 0 without; whether there is a mass); of a map
   those of RF_PLAIN in map_table.h, else those of rf_take_squeeze; of a table radial (terms, 7) and least (1); of a zone
   nodes and weights. */

/* Documentation of the FMU

   Model: Force of a squeeze-film damper with seals, or whose oil has inertia, and of its retainer springs, on the
   rotor, and the mass that the oil adds to the rotor. The race does not spin: there is no speed. x and y are
   Cartesian from the bearing center.

   Equations:
   (force_x, force_y) = viscous film + convection q(x, v, v) - stiffness (x, y)
   force of the film on the rotor = (force_x, force_y) - [mass_xx mass_xy; mass_xy mass_yy] acceleration

   Validity: A rotor must solve for its acceleration with the mass, (m + M) a = force, in its own equations; the
   FMU of rotor and damper together does. Never exchange -M a as a force: that diverges where the mass of the
   oil is larger than that of the rotor. Inertia of first order in the squeeze Reynolds number speed clearance^2
   density/viscosity: to 10, of a ruptured film to 5. Fixed is what the tables hold for. Laminar, isothermal,
   aligned. Where a rotor in a film that ruptures is at rest off the center, the force is zero and has no
   derivative. */
#include <math.h>

#include "../films/journal_model.h"
#include "../films/map_table.h"
#include "../films/oil_damper.h"
#include "../films/squeeze_film.h"

enum { RADIUS, LENGTH, CLEARANCE, VISCOSITY, STIFFNESS, DENSITY, LEAKAGE, PARAMETERS, INPUTS = 4 };
enum { MAPPED, ZONE, CLOSED, TABLED, SEALED, HEAVY, PARTS };

#define PI 3.14159265358979323846

typedef struct model {
    rf_oil_damper damper; /* first, as journal_model.h asks */
    rf_map map;
    rf_squeeze film;
    double stiffness, sealed;
    int heavy;
} model;

static int take_radial(rf_oil_damper *to, const rf_tables *tables, rf_message *why)
{
    const rf_table *radial = rf_find_table(tables, "radial", 2, why);
    const rf_table *least = radial ? rf_find_table(tables, "least", 1, why) : NULL;
    if (!least)
        return RF_INVALID;
    if (radial->extent[0] < 2 || radial->extent[0] > 1000 || radial->extent[1] != RF_RADIAL || least->extent[0] != 1
        || !(least->numbers[0] > 0.0 && least->numbers[0] < 1.0))
        return rf_say(why, RF_INVALID, "the table of a damper must have %d columns, got %u x %u", RF_RADIAL,
                      (unsigned)radial->extent[0], (unsigned)radial->extent[1]);
    to->table = radial->numbers;
    to->terms = (int32_t)radial->extent[0];
    to->least = least->numbers[0];
    return RF_OK;
}

static int take_zone(rf_oil_damper *to, const rf_tables *tables, rf_message *why)
{
    const rf_table *nodes = rf_find_table(tables, "nodes", 1, why);
    const rf_table *weights = nodes ? rf_find_table(tables, "weights", 1, why) : NULL;
    if (!weights)
        return RF_INVALID;
    if (nodes->extent[0] != weights->extent[0] || nodes->extent[0] > 1000)
        return rf_say(why, RF_INVALID, "nodes and weights of a damper must be as many, got %u and %u",
                      (unsigned)nodes->extent[0], (unsigned)weights->extent[0]);
    to->nodes = nodes->numbers;
    to->weights = weights->numbers;
    to->count = (int32_t)nodes->extent[0];
    return RF_OK;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    rf_oil_damper *to = &self->damper;
    const rf_table *parts = rf_find_table(tables, "parts", 1, why);
    if (!parts)
        return RF_INVALID;
    if (parts->extent[0] != PARTS)
        return rf_say(why, RF_INVALID, "parts of a damper must be %d, got %u", PARTS, (unsigned)parts->extent[0]);
    const double *part = parts->numbers;
    to->mapped = part[MAPPED] != 0.0;
    to->zone = part[ZONE];
    to->closed = part[CLOSED];
    to->tabled = part[TABLED];
    to->least = 1.0;
    self->sealed = part[SEALED];
    self->heavy = part[HEAVY] != 0.0;
    const int closed = rf_seek_table(tables, "groups") != NULL;
    if (to->mapped && (closed ? rf_take_squeeze(&self->film, tables, why) : rf_take_map(&self->map, RF_PLAIN, "", tables, why)) != RF_OK)
        return RF_INVALID;
    if ((!to->mapped || to->tabled != 0.0) && take_radial(to, tables, why) != RF_OK)
        return RF_INVALID;
    to->journal.film = closed ? rf_squeeze_film : rf_map_film;
    to->journal.data = closed ? (const void *)&self->film : &self->map;
    if (to->mapped && !closed) {
        rf_map_to_wall(&self->map);
        to->journal.error = rf_map_error(&self->map);
    }
    *sizes = (rf_sizes){PARAMETERS, INPUTS, self->heavy ? 5 : 2, 0, 0};
    return to->zone != 0.0 ? take_zone(to, tables, why) : RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    static const char *const NAMES[] = {"stiffness", "density", "leakage"};
    model *self = kernel;
    rf_oil_damper *to = &self->damper;
    const double slimness = p[LENGTH] / p[RADIUS], c = p[CLEARANCE];
    for (int i = STIFFNESS; i < PARAMETERS; ++i)
        if (!(p[i] >= 0.0 && p[i] < HUGE_VAL))
            return rf_say(why, RF_INVALID, "%s must be finite and not negative, got %.9g", NAMES[i - STIFFNESS], p[i]);
    if (self->sealed > 0.0 && !(p[LEAKAGE] > 0.0))
        return rf_say(why, RF_INVALID, "leakage must be positive in a short film, got %.9g", p[LEAKAGE]);
    if (rf_scale_journal(&to->journal, p, why) != RF_OK)
        return RF_INVALID;
    to->journal.force_scale *= slimness * slimness;
    to->viscous = to->journal.force_scale;
    to->inertial = p[DENSITY] * p[RADIUS] * p[LENGTH] * p[LENGTH] * p[LENGTH];
    to->seal = 0.0;
    if (self->sealed > 0.0)
        to->seal = self->sealed * PI * c * c * c / (2.0 * p[VISCOSITY] * p[LEAKAGE] * p[LENGTH]);
    self->stiffness = p[STIFFNESS];
    return RF_OK;
}

/* Forces and masses, and unless NULL D[outputs][4]. */
static int answer(const model *self, const double *u, double *y, double *D, rf_message *why)
{
    const double state[5] = {u[0], u[1], u[2], u[3], 0.0};
    double jacobian[10];
    int status = rf_oil_damper_at(&self->damper, state, y, D ? jacobian : NULL);
    if (status <= RF_OUTSIDE && self->heavy) {
        const int of_mass = rf_oil_damper_mass(&self->damper, state, y + 2, D ? D + 2 * INPUTS : NULL);
        status = of_mass > status ? of_mass : status;
    }
    for (int i = 0; i < 2; ++i) {
        y[i] -= self->stiffness * u[i];
        for (int j = 0; D && j < INPUTS; ++j)
            D[INPUTS * i + j] = jacobian[5 * i + j] - (i == j ? self->stiffness : 0.0);
    }
    return rf_explain_journal(&self->damper.journal, status, state, why);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    return answer(kernel, at->u, y, NULL, why);
}

static int derivatives(const void *kernel, const rf_point *at, rf_jacobian *given, rf_message *why)
{
    double y[5];
    return answer(kernel, at->u, y, given->D, why);
}

const rf_kernel_type rf_oil_damper_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = derivatives,
    .adds_mass = 1,
};
