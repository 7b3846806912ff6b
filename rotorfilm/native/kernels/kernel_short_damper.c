/* Kernel "short_damper": a short squeeze film on a porous layer or a solid cage, fed or not (films/squeeze_film.h), and springs.

   Parameters of damper_model.h, then inflow [m/s], supply_pressure, start_pressure and end_pressure [Pa]; inputs and outputs as there.
   Tables: those of rf_take_squeeze, whose feeds are shares of a velocity, and `cage`: permeability [m2] and thickness [m]
   between supply and film, zeros where nothing comes through the cage. */

/* Documentation of the FMU

   Model: Force of a short squeeze-film damper with a solid or porous cage, fed or not, and of its retainer springs, on
   the rotor. The race does not spin: there is no speed. x and y are Cartesian from the bearing center. With the
   eccentricity e = (x, y)/clearance, its rate w = (vx, vy)/clearance, directions u from the center and the film
   thickness h = 1 - e.u, the porous layer by Darcy's law makes the film a sum of films n:

   Equations:
   force = viscosity radius length^3 / clearance^2  F - stiffness (x, y)
   full film:       F = - int ((w.u) G - S) u,  G = sum weight_n/(h^3 + leak_n),  S = sum -feed_n/(h^3 + leak_n)
   ruptured film:   F = - int (w.u) u G  over w.u > 0
   fed, ruptured:   F = - (3/2) int int max(p, 0) u,  p = ends + sum shape_n (w.u + feed_n/weight_n)/(h^3 + leak_n)
   feed_n = share_n (inflow + permeability supply_pressure / (viscosity thickness)) / clearance
   ends = clearance^2 / (3 viscosity length^2) (start_pressure to end_pressure, linear along the axis)

   Validity: For length / (2 radius) up to about 0.25. Fixed are length and clearance where the cage is porous, and what
   does not feed this damper. The force of a fed film that ruptures is within 1e-3 of the equations, within 1e-2 where
   the pressures at its ends have opposite signs; that of the others is within 1e-9. The springs are preloaded so that
   they carry the static load. Laminar, isothermal, aligned, without oil inertia.
   Where a rotor is at rest in a ruptured film without feed, the film force is zero and has no derivative. */
#include <math.h>

#include "../films/damper_model.h"
#include "../films/squeeze_film.h"

enum { INFLOW = RF_DAMPER_PARAMETERS, SUPPLY, START, END, PARAMETERS };

typedef struct model {
    rf_damper damper; /* first, as damper_model.h asks */
    rf_squeeze film;
    const double *share, *cage;
    double feed[RF_MOST_GROUPS];
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    if (rf_take_squeeze(&self->film, tables, why) != RF_OK)
        return RF_INVALID;
    self->cage = rf_numbers(tables, "cage", 2, why);
    if (!self->cage)
        return RF_INVALID;
    self->share = self->film.feed;
    self->film.feed = self->feed;
    self->damper.journal.film = rf_squeeze_film;
    self->damper.journal.data = &self->film;
    *sizes = (rf_sizes){PARAMETERS, RF_DAMPER_INPUTS, 2, 0, 0};
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    static const char *const NAMES[] = {"inflow", "supply_pressure", "start_pressure", "end_pressure"};
    model *self = kernel;
    for (int i = INFLOW; i < PARAMETERS; ++i)
        if (!isfinite(p[i]))
            return rf_say(why, RF_INVALID, "%s must be finite, got %.9g", NAMES[i - INFLOW], p[i]);
    if (rf_scale_damper(kernel, p, why) != RF_OK)
        return RF_INVALID;
    const double c = p[RF_CLEARANCE], length = p[RF_LENGTH], mu = p[RF_VISCOSITY], thickness = self->cage[1];
    const double through = thickness > 0.0 ? self->cage[0] * p[SUPPLY] / (mu * thickness) : p[INFLOW];
    const double rate = c * c / (3.0 * mu * (length * length));
    for (int32_t n = 0; n < self->film.groups; ++n)
        self->feed[n] = self->share[n] * through / c;
    self->film.ends[0] = p[START] * rate;
    self->film.ends[1] = p[END] * rate;
    return RF_OK;
}

const rf_kernel_type rf_short_damper_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = rf_damper_output,
    .jacobian = rf_damper_derivatives,
};
