#include "heated_film.h"

#include <math.h>

#include "../films/map_frame.h"
#include "../films/quintic.h"

#define TWO_PI 6.28318530717958647692
#define STEPS 60
#define SMALL 2e-6 /* relative step of third order after which the next one is below roundoff */

int rf_oil_viscosity(const rf_oil *oil, double t, rf_viscosity *at)
{
    double u, b[RF_ORDER];
    const double held = fmin(fmax(t, oil->coldest), oil->hottest), per = oil->cells / (oil->hottest - oil->coldest);
    const double *c = oil->ln + rf_cell((held - oil->coldest) * per, oil->cells, &u);
    rf_values(u, b);
    const double ln = rf_dot(c, b);
    rf_slopes(u, b);
    at->thins = per * rf_dot(c, b);
    rf_curvatures(u, b);
    at->bends = t == held ? per * per * rf_dot(c, b) : 0.0;
    at->value = exp(ln + at->thins * (t - held));
    return t == held ? RF_OK : RF_OUTSIDE;
}

void rf_advance_viscosity(rf_viscosity *mu, double step)
{
    const double a = step * (mu->thins + 0.5 * step * mu->bends);
    mu->value *= 1.0 + a * (1.0 + a * (0.5 + a / 6.0));
    mu->thins += step * mu->bends;
}

/* Eccentricity and source of a state. */
static void kinematics(double c, const double *state, double *e, double *w)
{
    const double half = 0.5 * state[4];
    e[0] = state[0] / c;
    e[1] = state[1] / c;
    w[0] = state[2] / c + half * e[1];
    w[1] = state[3] / c - half * e[0];
}

/* A row d/d(e, w) becomes one d/d(x, y, vx, vy, speed). */
static void by_state(const double *by, const double *e, double speed, double c, double *row)
{
    const double half = 0.5 * speed;
    row[0] = (by[0] - half * by[3]) / c;
    row[1] = (by[1] + half * by[2]) / c;
    row[2] = by[2] / c;
    row[3] = by[3] / c;
    row[4] = 0.5 * (by[2] * e[1] - by[3] * e[0]);
}

/* Sigma and the effective flow of a film, and their derivatives by e and w, and of the flow by half the speed. */
typedef struct taken {
    double shear, flow, by_shear[4], by_flow[4], by_rate;
} taken;

/* Sigma of a gap that is full of oil. */
static void fill_gap(const rf_heated *film, const double *e, taken *of)
{
    if (film->openings) {
        of->shear = rf_land_shear(film->openings, e, of->by_shear);
    } else {
        const double gap = 1.0 - e[0] * e[0] - e[1] * e[1];
        of->shear = TWO_PI / sqrt(gap);
        of->by_shear[0] = of->shear / gap * e[0];
        of->by_shear[1] = of->shear / gap * e[1];
    }
    of->by_shear[2] = of->by_shear[3] = 0.0;
}

static void take(const rf_heated *film, const double *e, double half, const double *losses, const double *by_loss,
                 taken *of)
{
    double more[3] = {0.0, 0.0, 0.0};
    of->shear = losses[1];
    of->flow = losses[2];
    for (int k = 0; k < 4; ++k) {
        of->by_shear[k] = by_loss ? by_loss[4 + k] : 0.0;
        of->by_flow[k] = by_loss ? by_loss[8 + k] : 0.0;
    }
    if (film->full_gap)
        fill_gap(film, e, of);
    if (film->openings)
        of->flow += rf_replaced_flow(film->openings, e, half, film->carry_over, by_loss ? more : NULL);
    of->by_flow[0] += more[0];
    of->by_flow[1] += more[1];
    of->by_rate = more[2];
}

/* Slopes of drag and flow: A = R^3 L/c speed^2 Sigma - F.W, W = c w, and Q = c R L times the flow of the losses. */
static void set_slopes(const rf_heated *film, const double *state, const double *f, const taken *by,
                       const double *by_leak, rf_heat_slopes *of)
{
    const double r = film->radius, l = film->length, c = film->clearance, speed = state[4], half = 0.5 * speed;
    const double ring = r * r * r * l / c, unit = c * r * l;
    double e[2], w[2];
    kinematics(c, state, e, w);
    by_state(by->by_shear, e, speed, c, of->drag);
    by_state(by->by_flow, e, speed, c, of->flow);
    by_state(by_leak, e, speed, c, of->leak);
    of->flow[4] += 0.5 * by->by_rate;
    const double by_w[2][5] = {{0.0, half, 1.0, 0.0, 0.5 * state[1]}, {-half, 0.0, 0.0, 1.0, -0.5 * state[0]}};
    for (int k = 0; k < 5; ++k) {
        of->drag[k] = ring * speed * speed * of->drag[k] - f[0] * by_w[0][k] - f[1] * by_w[1][k]
                      - c * (of->force[k] * w[0] + of->force[5 + k] * w[1]);
        of->flow[k] *= unit;
        of->leak[k] *= unit;
    }
    of->drag[4] += 2.0 * ring * speed * by->shear;
}

int rf_heat_at(const rf_heated *film, const double *state, rf_heat *heat, rf_heat_slopes *slopes)
{
    double e[2], w[2], losses[RF_LOSSES], by_loss[4 * RF_LOSSES];
    taken found;
    int status = rf_journal_at(&film->journal, state, heat->force, slopes ? slopes->force : NULL);
    if (status > RF_OUTSIDE)
        return status;
    const double r = film->radius, l = film->length, c = film->clearance, *f = heat->force;
    kinematics(c, state, e, w);
    int known = film->loss(film->loss_data, e, w, 1, losses, slopes ? by_loss : NULL);
    if (known == RF_UNDEFINED) {
        /* Without source the losses have a kink, whatever the direction: their mean slope is none. */
        for (int k = 0; slopes && k < 4 * RF_LOSSES; ++k)
            by_loss[k] = 0.0;
        known = RF_OK;
    }
    if (known > RF_OUTSIDE)
        return known;
    status = known > status ? known : status;
    take(film, e, 0.5 * state[4], losses, slopes ? by_loss : NULL, &found);
    heat->drag = r * r * r * l / c * state[4] * state[4] * found.shear - c * (f[0] * w[0] + f[1] * w[1]);
    heat->flow = c * r * l * found.flow;
    heat->leak = c * r * l * losses[2];
    if (slopes)
        set_slopes(film, state, f, &found, by_loss + 8, slopes);
    return status;
}

double rf_heat_surplus(const rf_heated *film, const rf_heat *heat, double t, const rf_viscosity *mu)
{
    const double oil = film->volumetric_heat * heat->flow;
    return heat->drag * mu->value - oil * (t - film->supply) - film->conductance * (t - film->ambient);
}

double rf_heat_slope(const rf_heated *film, const rf_heat *heat, const rf_viscosity *mu)
{
    return heat->drag * mu->value * mu->thins - film->volumetric_heat * heat->flow - film->conductance;
}

/* The root of an oil that thins evenly, as from the temperature t0 that the film has without heat: x e^x = z by a
   formula for Lambert's W, within some per cent. */
static double guess(const rf_heated *film, const rf_heat *heat, double takes, double t0)
{
    rf_viscosity mu;
    rf_oil_viscosity(&film->oil, t0, &mu);
    const double thinning = -mu.thins, rise = heat->drag * mu.value / takes;
    if (!(thinning > 0.0 && rise > 0.0))
        return t0;
    const double l = log(1.0 + thinning * rise);
    return t0 + l * (1.0 - log(1.0 + l) / (2.0 + l)) / thinning;
}

int rf_balance(const rf_heated *film, const rf_heat *heat, double *temperature, rf_viscosity *mu)
{
    const double oil = film->volumetric_heat * heat->flow, takes = oil + film->conductance;
    *temperature = film->supply;
    if (!(takes > 0.0))
        return heat->drag > 0.0 ? RF_STUCK : rf_oil_viscosity(&film->oil, *temperature, mu);
    const double unheated = (oil * film->supply + film->conductance * film->ambient) / takes;
    double t = guess(film, heat, takes, unheated);
    for (int k = 0; k < STEPS; ++k) {
        const int known = rf_oil_viscosity(&film->oil, t, mu);
        const double left = rf_heat_surplus(film, heat, t, mu), slope = rf_heat_slope(film, heat, mu);
        const double newton = -left / slope, curve = mu->value * (mu->thins * mu->thins + mu->bends);
        const double bent = 0.5 * newton * heat->drag * curve / slope;
        const double step = fmax(newton / (1.0 + fmax(bent, -0.5)), unheated - t);
        t += step;
        if (fabs(step) <= SMALL * t) {
            rf_advance_viscosity(mu, step);
            *temperature = t;
            return known;
        }
    }
    return RF_STUCK;
}

int rf_balanced_at(const rf_heated *film, const double *state, double *f, double *jacobian, double *temperature)
{
    rf_heat heat;
    rf_heat_slopes slopes;
    rf_viscosity mu;
    int status = rf_heat_at(film, state, &heat, jacobian ? &slopes : NULL);
    const int balanced = status <= RF_OUTSIDE ? rf_balance(film, &heat, temperature, &mu) : RF_OK;
    status = balanced > status ? balanced : status;
    if (status > RF_OUTSIDE) {
        *temperature = NAN;
        return rf_fail(status, f, jacobian, 10);
    }
    f[0] = mu.value * heat.force[0];
    f[1] = mu.value * heat.force[1];
    if (jacobian) {
        const double cools = rf_heat_slope(film, &heat, &mu);
        const double warmer = film->volumetric_heat * (*temperature - film->supply);
        for (int k = 0; k < 5; ++k) {
            const double warms = -(mu.value * slopes.drag[k] - warmer * slopes.flow[k]) / cools;
            for (int i = 0; i < 2; ++i)
                jacobian[5 * i + k] = mu.value * slopes.force[5 * i + k] + mu.value * mu.thins * heat.force[i] * warms;
        }
    }
    return status;
}

int rf_warming_at(const void *of, const double *state, double *f, double *jacobian)
{
    const rf_warming *warming = of;
    const rf_heated *film = &warming->film;
    const double t = state[5], per = warming->per_capacity;
    rf_heat heat;
    rf_heat_slopes by;
    rf_viscosity mu;
    if (rf_oil_viscosity(&film->oil, t, &mu) != RF_OK)
        return RF_INVALID;
    const int status = rf_heat_at(film, state, &heat, jacobian ? &by : NULL);
    if (status > RF_OUTSIDE)
        return status;
    f[0] = mu.value * heat.force[0];
    f[1] = mu.value * heat.force[1];
    f[2] = per * rf_heat_surplus(film, &heat, t, &mu);
    if (!jacobian)
        return status;
    const double warmer = film->volumetric_heat * (t - film->supply);
    for (int k = 0; k < 5; ++k) {
        jacobian[k] = mu.value * by.force[k];
        jacobian[6 + k] = mu.value * by.force[5 + k];
        jacobian[12 + k] = per * (mu.value * by.drag[k] - warmer * by.flow[k]);
    }
    jacobian[5] = mu.thins * f[0];
    jacobian[11] = mu.thins * f[1];
    jacobian[17] = per * rf_heat_slope(film, &heat, &mu);
    return status;
}

int rf_balanced_batch(const rf_heated *film, size_t n, const double *states, double *f, double *temperature,
                      double *jacobian, size_t *first)
{
    double force[2], slopes[10];
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double state[5] = {states[i], states[n + i], states[2 * n + i], states[3 * n + i], states[4 * n + i]};
        const int status = rf_balanced_at(film, state, force, jacobian ? slopes : NULL, temperature + i);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        for (size_t k = 0; k < 2; ++k)
            f[k * n + i] = force[k];
        for (size_t k = 0; jacobian && k < 10; ++k)
            jacobian[k * n + i] = slopes[k];
    }
    return worst;
}
