#include "bush_contact.h"

#include <math.h>

#define HALF_PI 1.57079632679489661923
#define MOST_STEPS 100
#define LEAST 1e-250 /* of what is lifted: below, the powers of the angle are none */

double rf_bush_of_weight(const rf_bush_arc *at)
{
    return at->a * at->sin / at->moment - 1.0 / at->a - 2.0 * at->sin * at->sin / at->segment;
}

void rf_bush_see(double a, rf_bush_arc *at)
{
    at->a = a;
    at->sin = sin(a);
    at->cos = cos(a);
    rf_arc(a, at->sin, at->cos, &at->segment, &at->moment);
    at->F = at->segment / at->cos;
    at->F_slope = at->sin * (2.0 * at->sin + at->F) / at->cos;
    at->weight = at->moment / (a * at->segment);
}

/* The angle at which F = y > 0, by Halley's method. The start is a fit of it, good to 1e-5. */
static double angle_of(double y)
{
    const double s = cbrt(1.5 * y), v = s * s;
    double a = s < 1.5 ? s * (1.0 + v * (-0.10007 + v * (-0.002293 + v * (0.0036173 - v * 0.0004931))))
                       : HALF_PI;
    for (int i = 0; i < MOST_STEPS; ++i) {
        const double sine = sin(a), cosine = cos(a), slope = sine * (2.0 * sine + y);
        double segment, moment;
        rf_arc(a, sine, cosine, &segment, &moment);
        const double newton = (segment - y * cosine) / slope;
        const double step = newton / (1.0 - 0.5 * newton * (4.0 * sine + y) * cosine / slope);
        a -= step;
        if (fabs(step) <= 2e-5 * a) /* its cube is what is left */
            break;
    }
    return a;
}

double rf_bush_gap(const rf_bush *b, double T)
{
    return b->is.clearance - b->is.closing * T;
}

double rf_bush_sliding(const rf_bush *b, const rf_bush_arc *at, const rf_bush_demand *d)
{
    return b->is.pressure_work * d->speed * d->load * at->weight;
}

/* Where friction heat equals the losses, the lower root of a quadratic equation; infinite if it runs away. */
static double steady(const rf_bush *b, const rf_bush_arc *at, const rf_bush_demand *d)
{
    const double heat = rf_bush_sliding(b, at, d), *f = b->friction;
    const double source =
        heat * f[0] + b->is.liner * (b->outer[0] + b->outer[1] * at->sin / at->a);
    const double linear = rf_bush_conductance(b, at->a) - heat * f[1];
    const double square = linear * linear - 4.0 * heat * f[2] * source;
    const double below = linear + sqrt(fmax(square, 0.0));
    return square < 0.0 || below <= 0.0 ? HUGE_VAL : 2.0 * source / below;
}

void rf_bush_heat_slopes(const rf_bush *b, const rf_bush_arc *at, double T, const rf_bush_demand *d, double by[4])
{
    const double unit = b->is.pressure_work * rf_bush_friction(b, T);
    by[0] = rf_bush_losses_slope(b, at->a, at->moment, T)
            - unit * d->speed * d->load * at->weight * rf_bush_of_weight(at);
    by[1] = rf_bush_conductance(b, at->a)
            - rf_bush_sliding(b, at, d) * (b->friction[1] + 2.0 * b->friction[2] * T);
    by[2] = -unit * d->speed * at->weight;
    by[3] = -unit * d->load * at->weight;
}

/* Newton's method between bounds for c(T(a)) F(a) = lifted; the residual rises with a. */
static int find_cold(const rf_bush *b, const rf_bush_demand *d, double lifted, rf_bush_contact *c, rf_message *why)
{
    double low = 0.0, high = c->at.a, residual = HUGE_VAL;
    for (int i = 0; i < 2 * MOST_STEPS; ++i) {
        double by[4];
        c->temperature = steady(b, &c->at, d);
        const double T = fmin(c->temperature, b->is.melting);
        residual = rf_bush_gap(b, T) * c->at.F - lifted;
        *(residual < 0.0 ? &low : &high) = c->at.a;
        rf_bush_heat_slopes(b, &c->at, T, d, by);
        const double slope = rf_bush_gap(b, T) * c->at.F_slope + b->is.closing * c->at.F * by[0] / by[1];
        const double step = residual / slope;
        if (fabs(step) <= 4e-16 * c->at.a || fabs(residual) <= 1e-15 * lifted || high - low <= 4e-16 * high)
            break;
        const double trial = c->at.a - step;
        const int inside = trial > low && trial < high;
        rf_bush_see(inside ? trial : 0.5 * (low + high), &c->at);
        if (inside && fabs(step) <= 1e-8 * trial) { /* its square is what is left */
            c->temperature = steady(b, &c->at, d);
            return RF_OK;
        }
    }
    if (fabs(residual) <= 1e-9 * lifted)
        return RF_OK;
    return rf_say(why, RF_STUCK,
                  "contact must be steady, got one at the brink of thermal runaway at %.6g rad", c->at.a);
}

int rf_bush_read(const rf_bush *b, const rf_point *at, rf_bush_demand *d, rf_message *why)
{
    if (!(at->u[0] >= 0.0))
        return rf_say(why, RF_NOT_FINITE, "load must be finite and not negative, got %.9g N", at->u[0]);
    d->moment = fmax(at->x[0], 0.0); /* integrators try states beyond the solution */
    d->load = at->u[0] / b->is.force_unit;
    d->speed = fabs(at->u[1]);
    return RF_OK;
}

void rf_bush_find_hot(const rf_bush *b, const rf_bush_demand *d, rf_bush_contact *c)
{
    const double lifted = b->is.compliance * d->load + d->moment;
    c->melting = 0;
    c->at.a = 0.0;
    c->temperature = b->is.liner * (b->outer[0] + b->outer[1]) / (b->is.shaft + b->is.liner);
    if (lifted > LEAST) {
        rf_bush_see(angle_of(lifted / b->gap), &c->at);
        c->temperature = steady(b, &c->at, d);
        c->melting = c->temperature >= b->is.melting;
    }
}

int rf_bush_find(const rf_bush *b, const rf_bush_demand *d, rf_bush_contact *c, rf_message *why)
{
    rf_bush_find_hot(b, d, c);
    if (c->melting)
        c->temperature = b->is.melting;
    if (c->melting || c->at.a == 0.0)
        return RF_OK;
    return find_cold(b, d, b->is.compliance * d->load + d->moment, c, why);
}

double rf_bush_surplus(const rf_bush *b, const rf_bush_contact *c, const rf_bush_demand *d)
{
    return c->melting ? fmax(rf_bush_sliding(b, &c->at, d) * b->grip - rf_bush_losses(b, c->at.a, c->at.sin, b->is.melting), 0.0)
                      : 0.0;
}

double rf_bush_heat_per_moment(const rf_bush *b, const rf_bush_arc *at)
{
    return b->melting_heat * b->is.radius * at->weight;
}
