/* Kernel "bush_wear": a polymer bush under a load, worn by melting, with one state (bearings/bush/bush_wear.py).

   Parameters and table in bush.h. Inputs load [N], speed [rad/s]; state the wear moment W; outputs contact_angle
   [rad], settlement [m], temperature [K], maximum_pressure [Pa], friction_torque [N m], melt_rate [m/s],
   speed_ratio. Events: steady temperature less melting point, speed. */

/* Documentation of the FMU

   Model: A rigid shaft that rubs in a thin polymer liner and wears it by melting, under a load that does
   not fall. Temperatures are above the ambient one. Half the contact angle alpha and the contact
   temperature T follow from load, speed and the wear moment W; q_m is what friction heat has left over at
   the melting point. In Co-Simulation W is advanced by an implicit step of fourth order with error control;
   beginning and end of melting and the change of the sense of rotation are event indicators.

   Equations:
   c(T) F(alpha) = a_1 N + W,  F = (alpha - sin(2 alpha)/2)/cos(alpha),  N = load/force unit
   T = min(melting point, temperature at which losses equal friction heat)
   dW/dt = q_m N/(melting_heat radius qbar),  q_m = max(0, omega R_1 f qbar - Q_1 - Q_2)

   Validity: Evtushenko & Kovalenko (1993), re-derived. Contact pressure of the shape cos(phi) - cos(alpha).
   The table `bush` holds what is fixed: clearance, thermal closing, a_1, G R_1, conductances of shaft and
   liner, melting point, whether heat leaves the whole shaft, radii, thickness, force unit, shear modulus.
   No abrasive wear, no heat stored. */
#include <math.h>
#include <stdlib.h>

#include "bush_contact.h"

#define HALF_PI 1.57079632679489661923
#define TOLERANCE 1e-10 /* of the local error of W, relative to it and to a typical value */
#define TYPICAL 1e-3
#define LONGEST 8.0 /* step, in times in which the rate of wear falls by 1/e */
#define MOST_PARTS 20000
#define COOLED 0.02 /* part of the melting point by which a worn contact may be colder without a word */

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    const rf_bush *b = kernel;
    rf_bush_demand d;
    rf_bush_contact c;
    int status = rf_bush_read(b, at, &d, why);
    if (status == RF_OK)
        status = rf_bush_find(b, &d, &c, why);
    if (status == RF_OK)
        *dx = c.melting ? rf_bush_surplus(b, &c, &d) / rf_bush_heat_per_moment(b, &c.at) : 0.0;
    return status;
}

static double sense(double speed)
{
    return speed > 0.0 ? 1.0 : speed < 0.0 ? -1.0 : 0.0;
}

/* Maximum pressure of a unit of load, (1 - cos)/segment. */
static double peak(const rf_bush_arc *at)
{
    return at->sin * at->sin / ((1.0 + at->cos) * at->segment);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const rf_bush *b = kernel;
    rf_bush_demand d;
    rf_bush_contact c;
    int status = rf_bush_read(b, at, &d, why);
    if (status == RF_OK)
        status = rf_bush_find(b, &d, &c, why);
    if (status != RF_OK)
        return status;
    const double cosine = c.at.a > 0.0 ? c.at.cos : 1.0;
    y[0] = c.at.a;
    y[1] = b->is.radius * (rf_bush_gap(b, c.temperature) / cosine - b->is.clearance);
    y[2] = c.temperature;
    y[3] = y[4] = y[5] = y[6] = 0.0;
    if (!(y[1] < b->is.thickness))
        return rf_say(why, RF_AT_WALL,
                      "settlement must be below the thickness of the liner %.6g m, got %.6g m",
                      b->is.thickness, y[1]);
    if (c.at.a == 0.0)
        return RF_OK;
    y[3] = b->is.modulus * d.load * peak(&c.at);
    y[4] = sense(at->u[1]) * b->is.force_unit * b->is.shaft_radius * rf_bush_friction(b, c.temperature)
           * d.load * 2.0 * c.at.a * c.at.weight;
    y[5] = rf_bush_surplus(b, &c, &d) / b->melting_heat;
    y[6] = rf_bush_sliding(b, &c.at, &d) * b->grip / rf_bush_losses(b, c.at.a, c.at.sin, b->is.melting);
    if (d.moment > 0.0 && c.temperature < (1.0 - COOLED) * b->is.melting)
        return rf_say(why, RF_OUTSIDE,
                      "load and speed must keep a worn contact at its melting point, got %.4g K: the model "
                      "takes it to end on unworn liner, and makes it too wide and too cold",
                      c.temperature);
    return RF_OK;
}

static int events(const void *kernel, const rf_point *at, double *z, rf_message *why)
{
    const rf_bush *b = kernel;
    rf_bush_demand d;
    rf_bush_contact c;
    if (rf_bush_read(b, at, &d, why) != RF_OK)
        return RF_NOT_FINITE;
    rf_bush_find_hot(b, &d, &c);
    z[0] = fmin(c.temperature - b->is.melting, b->is.melting);
    z[1] = at->u[1];
    return RF_OK;
}

/* d(angle)/d(W, N, |speed|) and the same of T; `cold` are the derivatives of the heat at T. */
static void contact_slopes(const rf_bush *b, const rf_bush_contact *c, const double cold[4], double a[3], double T[3])
{
    const double by_a = rf_bush_gap(b, c->temperature) * c->at.F_slope, by_T = -b->is.closing * c->at.F;
    const double lift[3] = {1.0, b->is.compliance, 0.0};
    const double right[3] = {0.0, -cold[2], -cold[3]};
    for (int k = 0; k < 3; ++k) {
        const double det = by_a * cold[1] - by_T * cold[0];
        a[k] = c->melting ? lift[k] / by_a : (lift[k] * cold[1] - by_T * right[k]) / det;
        T[k] = c->melting ? 0.0 : (by_a * right[k] - cold[0] * lift[k]) / det;
    }
}

static int jacobian(const void *kernel, const rf_point *point, rf_jacobian *answer, rf_message *why)
{
    const rf_bush *b = kernel;
    rf_bush_demand d;
    rf_bush_contact c;
    double cold[4], hot[4], a[3], T[3];
    int status = rf_bush_read(b, point, &d, why);
    if (status == RF_OK)
        status = rf_bush_find(b, &d, &c, why);
    if (status != RF_OK)
        return status;
    if (c.at.a == 0.0)
        return rf_say(why, RF_UNDEFINED, "load and wear must not both be zero for a derivative");
    rf_bush_heat_slopes(b, &c.at, c.temperature, &d, cold);
    rf_bush_heat_slopes(b, &c.at, b->is.melting, &d, hot);
    contact_slopes(b, &c, cold, a, T);
    const rf_bush_arc *at = &c.at;
    const double f = rf_bush_friction(b, c.temperature), f_slope = b->friction[1] + 2.0 * b->friction[2] * c.temperature;
    const double unit = sense(point->u[1]) * b->is.force_unit * b->is.shaft_radius * 2.0 * at->a * at->weight;
    const double losses = rf_bush_losses(b, at->a, at->sin, b->is.melting), log_weight = rf_bush_of_weight(at);
    const double ratio = rf_bush_sliding(b, at, &d) * b->grip / losses, extra = rf_bush_surplus(b, &c, &d);
    const double losses_slope = rf_bush_losses_slope(b, at->a, at->moment, b->is.melting);
    const double peak_slope = (at->sin - 2.0 * at->sin * at->sin * peak(at)) / at->segment;
    const double chain[3] = {point->x[0] >= 0.0, 1.0 / b->is.force_unit, copysign(1.0, point->u[1])};
    for (int k = 0; k < 3; ++k) {
        const double by_load = k == 1, more = -(hot[0] * a[k] + (k ? hot[k + 1] : 0.0));
        const double rate = c.melting ? (more - extra * log_weight * a[k]) / rf_bush_heat_per_moment(b, at) : 0.0;
        const double by[7] = {
            a[k],
            b->is.radius
                * (rf_bush_gap(b, c.temperature) * at->sin / (at->cos * at->cos) * a[k]
                   - b->is.closing / at->cos * T[k]),
            T[k],
            b->is.modulus * (peak(at) * by_load + d.load * peak_slope * a[k]),
            unit * (f * by_load + d.load * (f_slope * T[k] + f * (1.0 / at->a + log_weight) * a[k])),
            c.melting ? more / b->melting_heat : 0.0,
            (more + (1.0 - ratio) * losses_slope * a[k]) / losses,
        };
        *(k ? answer->B + k - 1 : answer->A) = rate * chain[k];
        for (int i = 0; i < 7; ++i)
            *(k ? answer->D + 2 * i + k - 1 : answer->C + i) = by[i] * chain[k];
    }
    return RF_OK;
}

/* dW/dt and its derivative by W while the bush melts, smooth beyond the end of the wear. */
typedef struct rate {
    double f, by_moment;
} rate;

static rate melt(const rf_bush *b, const rf_bush_demand *d, const rf_bush_arc *at)
{
    const double losses = rf_bush_losses(b, at->a, at->sin, b->is.melting), per = rf_bush_heat_per_moment(b, at);
    const double slope = rf_bush_losses_slope(b, at->a, at->moment, b->is.melting) - losses * rf_bush_of_weight(at);
    const rate found = {(rf_bush_sliding(b, at, d) * b->grip - losses) / per, -slope / (per * b->gap * at->F_slope)};
    return found;
}

/* W1 - W0 = h (f0 + f1)/2 + h^2 (f0 f0' - f1 f1')/12: implicit, of order 4, and stable for all h. Newton's
   method goes over the angle, of which W is a function. Answers the growth of W and, in *error, how far it is
   from that of order 3; not a number where no step was found. */
static double grow(const rf_bush *b, const rf_bush_demand *d, double h, rf_bush_arc *at, rate *r, double *error)
{
    const rate r0 = *r;
    const rf_bush_arc start = *at;
    const double known = h * (0.5 * r0.f + h * r0.f * r0.by_moment / 12.0);
    double step = -h * (r0.f + 0.5 * h * r0.f * r0.by_moment) / (b->gap * start.F_slope);
    for (int i = 0; i < 20; ++i) {
        const double a = at->a - step;
        if (!(a >= start.a && a < HALF_PI))
            break;
        rf_bush_see(a, at);
        *r = melt(b, d, at);
        const double z = h * r->by_moment, growth = known + h * r->f * (0.5 - z / 12.0);
        step = (b->gap * (at->F - start.F) - growth) / (b->gap * at->F_slope * (1.0 - 0.5 * z + z * z / 12.0));
        /* What is left of the step changes the growth by z of it. */
        if (fabs(step * z) <= 1e-13 * (a - start.a) || fabs(step) <= 4e-16 * a) {
            *error = fabs(h * (r0.f - r->f) / 6.0 + h * h * (r0.f * r0.by_moment + r->f * r->by_moment) / 12.0);
            return growth;
        }
    }
    return *error = NAN;
}

static int step(void *kernel, const rf_point *at, double dt, double *x, rf_message *why)
{
    const rf_bush *b = kernel;
    rf_bush_demand d;
    rf_bush_contact c;
    if (rf_bush_read(b, at, &d, why) != RF_OK)
        return RF_NOT_FINITE;
    rf_bush_find_hot(b, &d, &c);
    if (!c.melting)
        return RF_OK; /* nor will it under held inputs */
    double h = dt, left = dt, moment = d.moment;
    rate r = melt(b, &d, &c.at);
    for (int part = 0; part < MOST_PARTS && left > 0.0; ++part) {
        rf_bush_arc next = c.at;
        rate then = r;
        double error, allowed = TOLERANCE * (TYPICAL + moment);
        if (r.f <= -1e-3 * allowed * r.by_moment) {
            left = 0.0; /* all wear that is left is none */
            break;
        }
        if (r.by_moment < 0.0) /* where longer steps would not damp what is left */
            h = fmin(h, -LONGEST / r.by_moment);
        const double growth = grow(b, &d, h, &next, &then, &error);
        if (error <= allowed) {
            c.at = next;
            r = then;
            moment += fmax(growth, 0.0);
            left -= h;
        }
        if (left > 0.0)
            h = fmin(left, h * (error < HUGE_VAL ? fmin(4.0, 0.8 * pow(allowed / (error + 1e-30), 0.25)) : 0.1));
        if (left > 0.0 && !(h >= 1e-16 * left))
            break;
    }
    if (left > 0.0)
        return rf_say(why, RF_STUCK, "the wear cannot go on beyond %.9g of a step", 1.0 - left / dt);
    *x = moment;
    return RF_OK;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    *sizes = (rf_sizes){RF_BUSH_PARAMETERS, 2, 7, 1, 2};
    return rf_bush_tables(kernel, tables, why);
}

const rf_kernel_type rf_bush_wear_type = {
    .bytes = sizeof(rf_bush),
    .take = take_tables,
    .set_parameters = rf_bush_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .step = step,
    .events = events,
};
