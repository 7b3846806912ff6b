#include "heated_model.h"

#include <math.h>
#include <string.h>

#include "../films/journal_model.h"

#define TWO_PI 6.28318530717958647692
#define TOLERANCE 1e-11 /* of the last term of the series in a step, relative to the temperature */
#define STABLE 0.5      /* longest step in units of the time constant */
#define PER_KELVIN 256.0
#define MOST_STEPS 10000000

enum { RADIUS, LENGTH, CLEARANCE, SUPPLY, AMBIENT, CONDUCTANCE, BUSH, VOLUMETRIC_HEAT, PARAMETERS };

const rf_sizes RF_HEATED_SIZES = {PARAMETERS, 5, 5, 1, 0};

/* Kernels are given as constant, but their scratch space is written. */
static rf_heated_model *writable(const void *kernel)
{
    return (rf_heated_model *)kernel;
}

/* The film at an input: asked once for each. */
static const rf_heat *heat_at(rf_heated_model *m, const double *u)
{
    if (memcmp(m->u, u, sizeof m->u) != 0) {
        m->status = rf_heat_at(&m->film, u, &m->heat, NULL);
        memcpy(m->u, u, sizeof m->u);
    }
    return &m->heat;
}

static int explain(const rf_heated_model *m, int status, const rf_point *at, rf_message *why)
{
    const double t = at->x[0];
    const rf_oil *oil = &m->film.oil;
    if (status <= RF_OUTSIDE && !(t > 0.0 && t < HUGE_VAL))
        return rf_say(why, RF_NOT_FINITE, "temperature must be finite and positive, got %.9g K", t);
    if (status == RF_OK && !(t >= oil->coldest && t <= oil->hottest))
        return rf_say(why, RF_OUTSIDE, "temperature must be from %.6g to %.6g K, where the oil is known, got %.6g K",
                      oil->coldest, oil->hottest, t);
    return rf_explain_journal(&m->film.journal, status, at->u, why);
}

/* The viscosity at a temperature, by a series from the nearest of those that lie so close that it is exact. */
static rf_viscosity viscosity_at(rf_heated_model *m, double t)
{
    const double near = floor(t * PER_KELVIN + 0.5) / PER_KELVIN;
    if (m->t != near) {
        rf_oil_viscosity(&m->film.oil, near, &m->mu);
        m->t = near;
    }
    rf_viscosity mu = m->mu;
    rf_advance_viscosity(&mu, t - near);
    return mu;
}

int rf_heated_output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    rf_heated_model *m = writable(kernel);
    const rf_heat *heat = heat_at(m, at->u);
    const double mu = viscosity_at(m, at->x[0]).value;
    y[0] = mu * heat->force[0];
    y[1] = mu * heat->force[1];
    y[2] = at->x[0];
    y[3] = mu * heat->drag;
    y[4] = heat->leak;
    return explain(m, m->status, at, why);
}

int rf_heated_derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    rf_heated_model *m = writable(kernel);
    const rf_heat *heat = heat_at(m, at->u);
    const rf_viscosity mu = viscosity_at(m, at->x[0]);
    dx[0] = rf_heat_surplus(&m->film, heat, at->x[0], &mu) * m->per_capacity;
    return explain(m, m->status, at, why);
}

/* By the series of third order in time, as long as its last term is below the tolerance: what is left out is far
   smaller. Under held inputs the heat is one function of the temperature, so that nothing else is asked. */
int rf_heated_step(void *kernel, const rf_point *at, double dt, double *x, rf_message *why)
{
    rf_heated_model *m = kernel;
    const rf_heat *heat = heat_at(m, at->u);
    const double per = m->per_capacity;
    double left = dt, t = at->x[0];
    for (long k = 0; left > 0.0 && k < MOST_STEPS && m->status <= RF_OUTSIDE; ++k) {
        const rf_viscosity mu = viscosity_at(m, t);
        const double f = rf_heat_surplus(&m->film, heat, t, &mu) * per;
        const double by = rf_heat_slope(&m->film, heat, &mu) * per;
        const double bend = heat->drag * mu.value * (mu.thins * mu.thins + mu.bends) * per;
        const double second = 0.5 * f * by, third = f * (by * by + f * bend) / 6.0, most = TOLERANCE * t;
        double h = left;
        if (!(h * fabs(by) <= STABLE && h * h * h * fabs(third) <= most))
            h = fmin(left, fmin(STABLE / fabs(by), cbrt(most / fabs(third))));
        t += h * (f + h * (second + h * third));
        left = h < left ? left - h : 0.0;
    }
    if (m->status <= RF_OUTSIDE && !(left == 0.0))
        return rf_say(why, RF_STUCK, "the temperature must follow the heat over %.9g s, and did not", dt);
    if (m->status <= RF_OUTSIDE)
        x[0] = t;
    return explain(m, m->status, at, why);
}

int rf_heated_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    rf_heated_model *m = writable(kernel);
    rf_heat heat;
    rf_heat_slopes by;
    const int status = rf_heat_at(&m->film, at->u, &heat, &by);
    if (status > RF_OUTSIDE)
        return explain(m, status, at, why);
    const rf_viscosity mu = viscosity_at(m, at->x[0]);
    const double taken = m->film.volumetric_heat * (at->x[0] - m->film.supply), thins = mu.value * mu.thins;
    const double by_temperature[5] = {thins * heat.force[0], thins * heat.force[1], 1.0, thins * heat.drag, 0.0};
    memcpy(answer->C, by_temperature, sizeof by_temperature);
    answer->A[0] = rf_heat_slope(&m->film, &heat, &mu) * m->per_capacity;
    for (int k = 0; k < 5; ++k) {
        answer->B[k] = (mu.value * by.drag[k] - taken * by.flow[k]) * m->per_capacity;
        answer->D[k] = mu.value * by.force[k];
        answer->D[5 + k] = mu.value * by.force[5 + k];
        answer->D[10 + k] = 0.0;
        answer->D[15 + k] = mu.value * by.drag[k];
        answer->D[20 + k] = by.leak[k];
    }
    return explain(m, status, at, why);
}

/* Numbers of a table with one axis of `count`; NULL with the message otherwise. */
int rf_take_oil(rf_heated_model *m, const rf_tables *tables, rf_message *why)
{
    const rf_table *oil = rf_find_table(tables, "oil", 1, why);
    const double *range = oil ? rf_numbers(tables, "oil_range", 2, why) : NULL;
    const double *gap = range ? rf_numbers(tables, "full_gap", 1, why) : NULL;
    if (!gap)
        return RF_INVALID;
    if (oil->extent[0] < 6 || oil->extent[0] > 100000 || !(range[0] > 0.0 && range[1] > range[0]))
        return rf_say(why, RF_INVALID, "the oil must be known over a range of temperatures, got %u numbers over %.9g "
                      "to %.9g K", (unsigned)oil->extent[0], range[0], range[1]);
    m->film.oil.ln = oil->numbers;
    m->film.oil.cells = (int32_t)oil->extent[0] - 5;
    m->film.oil.coldest = range[0];
    m->film.oil.hottest = range[1];
    m->film.full_gap = gap[0] != 0.0;
    return RF_OK;
}

int rf_set_heated(rf_heated_model *m, const double *p, rf_message *why)
{
    static const char *const NAMES[] = {"supply_temperature", "ambient_temperature", "housing_conductance",
                                        "bush_heat_capacity", "volumetric_heat"};
    rf_heated *film = &m->film;
    rf_journal scaled = film->journal;
    const double unit[] = {p[RADIUS], p[LENGTH], p[CLEARANCE], 1.0};
    if (rf_scale_journal(&scaled, unit, why) != RF_OK)
        return RF_INVALID;
    for (int k = SUPPLY; k < PARAMETERS; ++k)
        if (!((k == CONDUCTANCE ? p[k] >= 0.0 : p[k] > 0.0) && p[k] < HUGE_VAL))
            return rf_say(why, RF_INVALID, "%s must be finite and %s, got %.9g", NAMES[k - SUPPLY],
                          k == CONDUCTANCE ? "not negative" : "positive", p[k]);
    film->journal = scaled;
    film->radius = p[RADIUS];
    film->length = p[LENGTH];
    film->clearance = p[CLEARANCE];
    film->supply = p[SUPPLY];
    film->ambient = p[AMBIENT];
    film->conductance = p[CONDUCTANCE];
    film->volumetric_heat = p[VOLUMETRIC_HEAT];
    const double capacity = p[BUSH] + p[VOLUMETRIC_HEAT] * TWO_PI * p[RADIUS] * p[LENGTH] * p[CLEARANCE];
    m->per_capacity = 1.0 / capacity;
    for (int k = 0; k < 5; ++k)
        m->u[k] = NAN;
    m->t = NAN;
    return RF_OK;
}
