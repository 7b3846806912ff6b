#include "heated_model.h"

#include <math.h>
#include <string.h>

#include "journal_model.h"

#define TWO_PI 6.28318530717958647692

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

int rf_heated_output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    rf_heated_model *m = writable(kernel);
    const rf_heat *heat = heat_at(m, at->u);
    double mu;
    rf_oil_viscosity(&m->film.oil, at->x[0], &mu, NULL);
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
    dx[0] = rf_heat_surplus(&m->film, heat_at(m, at->u), at->x[0], NULL) / m->capacity;
    return explain(m, m->status, at, why);
}

int rf_heated_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const rf_heated_model *m = kernel;
    rf_heat heat;
    rf_heat_slopes by;
    double mu, thins, cools;
    const int status = rf_heat_at(&m->film, at->u, &heat, &by);
    if (status > RF_OUTSIDE)
        return explain(m, status, at, why);
    rf_oil_viscosity(&m->film.oil, at->x[0], &mu, &thins);
    rf_heat_surplus(&m->film, &heat, at->x[0], &cools);
    const double taken = m->film.volumetric_heat * (at->x[0] - m->film.supply);
    const double by_temperature[5] = {thins * heat.force[0], thins * heat.force[1], 1.0, thins * heat.drag, 0.0};
    memcpy(answer->C, by_temperature, sizeof by_temperature);
    answer->A[0] = cools / m->capacity;
    for (int k = 0; k < 5; ++k) {
        answer->B[k] = (mu * by.drag[k] - taken * by.flow[k]) / m->capacity;
        answer->D[k] = mu * by.force[k];
        answer->D[5 + k] = mu * by.force[5 + k];
        answer->D[10 + k] = 0.0;
        answer->D[15 + k] = mu * by.drag[k];
        answer->D[20 + k] = by.leak[k];
    }
    return explain(m, status, at, why);
}

/* Numbers of a table with one axis of `count`; NULL with the message otherwise. */
const double *rf_numbers(const rf_tables *tables, const char *name, uint32_t count, rf_message *why)
{
    const rf_table *found = rf_find_table(tables, name, 1, why);
    if (found && found->extent[0] != count) {
        rf_say(why, RF_INVALID, "table %s must have %u numbers, got %u", name, (unsigned)count,
               (unsigned)found->extent[0]);
        return NULL;
    }
    return found ? found->numbers : NULL;
}

int rf_take_oil(rf_heated_model *m, const rf_tables *tables, rf_message *why)
{
    const rf_table *oil = rf_find_table(tables, "oil", 1, why);
    const double *range = oil ? rf_numbers(tables, "oil_range", 2, why) : NULL;
    const double *gap = range ? rf_numbers(tables, "full_gap", 1, why) : NULL;
    if (!gap)
        return RF_INVALID;
    if (oil->extent[0] < 6 || oil->extent[0] > 100000 || !(range[0] > 0.0 && range[1] > range[0]))
        return rf_say(why, RF_INVALID, "the oil must be known over a range of temperatures, got %u numbers over %.9g to "
                      "%.9g K", (unsigned)oil->extent[0], range[0], range[1]);
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
    m->capacity = p[BUSH] + p[VOLUMETRIC_HEAT] * TWO_PI * p[RADIUS] * p[LENGTH] * p[CLEARANCE];
    for (int k = 0; k < 5; ++k)
        m->u[k] = NAN;
    return RF_OK;
}
