/* Kernel "heated_journal": a plain journal bearing whose film has one temperature
   (bearings/journal/heat/heated_bearing.py).

   Parameters in the order of the enumeration below; inputs x, y [m], vx, vy [m/s], speed [rad/s]; state the
   temperature [K]; outputs force_x, force_y [N], film_temperature [K], power_loss [W], side_flow [m3/s].
   Tables: oil (n: quintic spline coefficients of ln viscosity), oil_range (2: lowest and highest temperature), full_gap
   (1). The film is the map of coefficients (1, x, t), center (1), reach (1), with its losses loss_coefficients
   (3, x, t), loss_center (3), loss_reach (1); without `coefficients` it is the short film. */

/* Documentation of the FMU

   Model: Film force of a full cylindrical journal bearing whose oil warms, with one temperature T of film and
   bush. x and y are Cartesian from the bearing center, rotation is positive about +z (from x to y), the force acts
   on the journal. With the eccentricity e = (x, y)/clearance and the source w = (vx, vy)/clearance - (speed/2) z^ x
   e, the force is that of the isothermal film at the viscosity of the oil at T; the heat that the film makes goes
   with the oil that leaves, through the housing, and into the bush. Where the film is ruptured the oil is in
   streamers.

   Equations:
   F = viscosity(T) length radius^3 / clearance^2  f(e, w)
   capacity dT/dt = P - volumetric_heat side_flow (T - supply_temperature)
                      - housing_conductance (T - ambient_temperature)
   P = viscosity(T) radius^3 length / clearance (speed^2 Sigma(e, w) - f(e, w).w)
   capacity = bush_heat_capacity + volumetric_heat 2 pi radius length clearance

   Validity: One temperature for the whole film: eccentricity ratio within 6 %, power within 7 % of a film
   with temperatures along and across it. The oil is known between the temperatures of the table `oil_range`; radius
   and length are fixed. Laminar, aligned, without grooves. In vibration the temperature hardly moves. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/journal_model.h"
#include "../films/loss_kernel.h"
#include "../films/map_kernel.h"
#include "../films/quintic.h"
#include "../films/short_kernel.h"

#define TWO_PI 6.28318530717958647692

enum {
    RADIUS,
    LENGTH,
    CLEARANCE,
    SUPPLY,
    AMBIENT,
    CONDUCTANCE,
    BUSH,
    VOLUMETRIC_HEAT,
    PARAMETERS
};

enum { POWER, FLOW };

/* The film at unit viscosity at one input. */
typedef struct film {
    double u[5];
    int status;
    double force[2], drag, flow; /* N, W and m3/s */
} film;

typedef struct model {
    rf_journal journal;
    rf_map map;
    rf_short ocvirk;
    rf_loss_map map_losses;
    rf_loss loss;
    const void *loss_data;
    int32_t oil_cells;
    const double *oil;
    double coldest, hottest;
    int full_gap;
    double p[PARAMETERS], capacity;
    film at; /* the last one: held inputs ask again and again */
} model;

/* Kernels are given as constant, but their scratch space is written. */
static model *writable(const void *kernel)
{
    return (model *)kernel;
}

/* Viscosity [Pa s] at a temperature and, unless NULL, its derivative. RF_OUTSIDE beyond the oil's range: the law goes
   on as an exponential. */
static int viscosity(const model *m, double t, double *mu, double *slope)
{
    double u, b[RF_ORDER];
    const double held = fmin(fmax(t, m->coldest), m->hottest), per = m->oil_cells / (m->hottest - m->coldest);
    const double *c = m->oil + rf_cell((held - m->coldest) * per, m->oil_cells, &u);
    rf_values(u, b);
    const double ln = rf_dot(c, b);
    rf_slopes(u, b);
    const double thins = per * rf_dot(c, b);
    *mu = exp(ln + thins * (t - held));
    if (slope)
        *slope = *mu * thins;
    return t == held ? RF_OK : RF_OUTSIDE;
}

/* Power at unit viscosity and flow [W, m3/s] of force f, and losses. */
static void carry(const model *m, const double *u, const double *f, const double *losses, film *at)
{
    const double r = m->p[RADIUS], l = m->p[LENGTH], c = m->p[CLEARANCE], speed = u[4];
    const double chi2 = (u[0] * u[0] + u[1] * u[1]) / (c * c);
    const double shear = m->full_gap ? TWO_PI / sqrt(1.0 - chi2) : losses[0] + losses[1];
    /* -F.W with W = v - (speed/2) z x E */
    const double along = f[0] * (u[2] + 0.5 * speed * u[1]) + f[1] * (u[3] - 0.5 * speed * u[0]);
    at->force[0] = f[0];
    at->force[1] = f[1];
    at->drag = r * r * r * l / c * speed * speed * shear - along;
    at->flow = c * r * l * losses[2];
}

static void source(const model *m, const double *u, double *e, double *w)
{
    const double c = m->p[CLEARANCE], half = 0.5 * u[4];
    e[0] = u[0] / c;
    e[1] = u[1] / c;
    w[0] = u[2] / c + half * e[1];
    w[1] = u[3] / c - half * e[0];
}

/* The film at an input: asked once for each. */
static const film *film_at(model *m, const double *u)
{
    if (memcmp(m->at.u, u, sizeof m->at.u) == 0)
        return &m->at;
    double f[2], e[2], w[2], losses[RF_LOSSES];
    m->at.status = rf_journal_at(&m->journal, u, f, NULL);
    if (m->at.status <= RF_OUTSIDE) {
        source(m, u, e, w);
        m->loss(m->loss_data, e, w, losses, NULL);
        carry(m, u, f, losses, &m->at);
    }
    memcpy(m->at.u, u, sizeof m->at.u);
    return &m->at;
}

/* Heat that is left for the bush [W] and, unless NULL, its derivative by the temperature. */
static double surplus(const model *m, const film *at, double t, double *slope)
{
    double mu, thins;
    viscosity(m, t, &mu, &thins);
    const double oil = m->p[VOLUMETRIC_HEAT] * at->flow;
    if (slope)
        *slope = at->drag * thins - oil - m->p[CONDUCTANCE];
    return at->drag * mu - oil * (t - m->p[SUPPLY]) - m->p[CONDUCTANCE] * (t - m->p[AMBIENT]);
}

static int explain(const model *m, int status, const rf_point *at, rf_message *why)
{
    double mu;
    if (status > RF_OUTSIDE || !(at->x[0] > 0.0 && at->x[0] < HUGE_VAL)) {
        if (status <= RF_OUTSIDE)
            return rf_say(why, RF_NOT_FINITE, "temperature must be finite and positive, got %.9g K", at->x[0]);
        return rf_explain_journal(&m->journal, status, at->u, why);
    }
    if (viscosity(m, at->x[0], &mu, NULL) != RF_OK)
        return rf_say(why, RF_OUTSIDE, "temperature must be from %.6g to %.6g K, where the oil is known, got %.6g K",
                      m->coldest, m->hottest, at->x[0]);
    return rf_explain_journal(&m->journal, status, at->u, why);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    model *m = writable(kernel);
    const film *of = film_at(m, at->u);
    double mu;
    viscosity(m, at->x[0], &mu, NULL);
    y[0] = mu * of->force[0];
    y[1] = mu * of->force[1];
    y[2] = at->x[0];
    y[3] = mu * of->drag;
    y[4] = of->flow;
    return explain(m, of->status, at, why);
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    model *m = writable(kernel);
    const film *of = film_at(m, at->u);
    dx[0] = surplus(m, of, at->x[0], NULL) / m->capacity;
    return explain(m, of->status, at, why);
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

/* Derivatives of drag and flow by the input, from those of the force and of the losses. */
static void heat_slopes(const model *m, const double *u, const double *f, const double *force_slopes,
                        const double *losses, const double *slopes, double rows[2][5])
{
    const double r = m->p[RADIUS], l = m->p[LENGTH], c = m->p[CLEARANCE], speed = u[4];
    const double ring = r * r * r * l / c, flow = c * r * l;
    double e[2], w[2], shear[4];
    source(m, u, e, w);
    const double gap = 1.0 - e[0] * e[0] - e[1] * e[1], whole = TWO_PI / sqrt(gap);
    for (int k = 0; k < 4; ++k)
        shear[k] = m->full_gap ? (k < 2 ? whole / gap * e[k] : 0.0) : slopes[k] + slopes[4 + k];
    by_state(shear, e, speed, c, rows[POWER]);
    by_state(slopes + 8, e, speed, c, rows[FLOW]);
    /* W = v - (speed/2) z x E by the input, and F by the input. */
    const double half = 0.5 * speed, wx = c * w[0], wy = c * w[1];
    const double by_w[2][5] = {{0.0, half, 1.0, 0.0, 0.5 * u[1]}, {-half, 0.0, 0.0, 1.0, -0.5 * u[0]}};
    for (int k = 0; k < 5; ++k) {
        rows[POWER][k] = ring * speed * speed * rows[POWER][k] - f[0] * by_w[0][k] - f[1] * by_w[1][k]
                         - force_slopes[k] * wx - force_slopes[5 + k] * wy;
        rows[FLOW][k] *= flow;
    }
    rows[POWER][4] += 2.0 * ring * speed * (m->full_gap ? whole : losses[0] + losses[1]);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *m = kernel;
    double f[2], by_input[10], losses[RF_LOSSES], slopes[4 * RF_LOSSES], e[2], w[2], heat[2][5], mu, thins, cools;
    int status = rf_journal_at(&m->journal, at->u, f, by_input);
    if (status > RF_OUTSIDE)
        return explain(m, status, at, why);
    source(m, at->u, e, w);
    const int flows = m->loss(m->loss_data, e, w, losses, slopes);
    status = flows > status ? flows : status;
    if (status > RF_OUTSIDE)
        return explain(m, status, at, why);
    film of;
    carry(m, at->u, f, losses, &of);
    heat_slopes(m, at->u, f, by_input, losses, slopes, heat);
    viscosity(m, at->x[0], &mu, &thins);
    surplus(m, &of, at->x[0], &cools);
    const double taken = m->p[VOLUMETRIC_HEAT] * (at->x[0] - m->p[SUPPLY]);
    answer->A[0] = cools / m->capacity;
    const double by_temperature[5] = {thins * f[0], thins * f[1], 1.0, thins * of.drag, 0.0};
    memcpy(answer->C, by_temperature, sizeof by_temperature);
    for (int k = 0; k < 5; ++k) {
        answer->B[k] = (mu * heat[POWER][k] - taken * heat[FLOW][k]) / m->capacity;
        answer->D[k] = mu * by_input[k];
        answer->D[5 + k] = mu * by_input[5 + k];
        answer->D[10 + k] = 0.0;
        answer->D[15 + k] = mu * heat[POWER][k];
        answer->D[20 + k] = heat[FLOW][k];
    }
    return explain(m, status, at, why);
}

/* Numbers of a table with one axis of `count`; NULL with the message otherwise. */
static const double *numbers(const rf_tables *tables, const char *name, uint32_t count, rf_message *why)
{
    const rf_table *found = rf_find_table(tables, name, 1, why);
    if (found && found->extent[0] != count) {
        rf_say(why, RF_INVALID, "table %s must have %u numbers, got %u", name, (unsigned)count,
               (unsigned)found->extent[0]);
        return NULL;
    }
    return found ? found->numbers : NULL;
}

static int take_oil(model *m, const rf_tables *tables, rf_message *why)
{
    const rf_table *oil = rf_find_table(tables, "oil", 1, why);
    const double *range = oil ? numbers(tables, "oil_range", 2, why) : NULL;
    const double *gap = range ? numbers(tables, "full_gap", 1, why) : NULL;
    if (!gap)
        return RF_INVALID;
    if (oil->extent[0] < RF_ORDER || oil->extent[0] > 100000 || !(range[0] > 0.0 && range[1] > range[0]))
        return rf_say(why, RF_INVALID, "the oil must be known over a range of temperatures, got %u numbers over %.9g to "
                      "%.9g K", (unsigned)oil->extent[0], range[0], range[1]);
    m->oil = oil->numbers;
    m->oil_cells = (int32_t)oil->extent[0] - (RF_ORDER - 1);
    m->coldest = range[0];
    m->hottest = range[1];
    m->full_gap = gap[0] != 0.0;
    return RF_OK;
}

static int take_short(model *m)
{
    m->journal.film = rf_short_film;
    m->journal.data = &m->ocvirk;
    m->loss = rf_short_losses;
    return RF_OK;
}

static int take_map(model *m, const rf_tables *tables, rf_message *why)
{
    const rf_table *c = rf_find_table(tables, "coefficients", 3, why);
    const rf_table *l = c ? rf_find_table(tables, "loss_coefficients", 3, why) : NULL;
    const double *center = l ? numbers(tables, "center", 1, why) : NULL;
    const double *reach = center ? numbers(tables, "reach", 1, why) : NULL;
    const double *loss_center = reach ? numbers(tables, "loss_center", RF_LOSSES, why) : NULL;
    const double *loss_reach = loss_center ? numbers(tables, "loss_reach", 1, why) : NULL;
    if (!loss_reach)
        return RF_INVALID;
    const rf_table *const both[] = {c, l};
    for (int k = 0; k < 2; ++k)
        for (int axis = 1; axis < 3; ++axis)
            if (both[k]->extent[axis] < RF_ORDER || both[k]->extent[axis] > 10000
                || both[k]->extent[0] != (k ? RF_LOSSES : 1))
                return rf_say(why, RF_INVALID, "the maps of a film must be of one bearing, 6 x 6 at least");
    m->map = (rf_map){(int32_t)c->extent[1] - 5, (int32_t)c->extent[2] - 5, reach[0], center[0], c->numbers, 0.0, 1.0};
    m->map_losses = (rf_loss_map){(int32_t)l->extent[1] - 5, (int32_t)l->extent[2] - 5, loss_reach[0],
                                  {loss_center[0], loss_center[1], loss_center[2]}, l->numbers};
    m->journal.film = rf_map_film;
    m->journal.data = &m->map;
    m->loss = rf_map_losses;
    m->loss_data = &m->map_losses;
    return RF_OK;
}

static int is_mapped(const rf_tables *tables)
{
    for (size_t k = 0; k < tables->count; ++k)
        if (strcmp(tables->list[k].name, "coefficients") == 0)
            return 1;
    return 0;
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *m = calloc(1, sizeof *m);
    if (!m) {
        rf_say(why, RF_MEMORY, "no memory for a journal");
        return NULL;
    }
    if (take_oil(m, tables, why) != RF_OK
        || (is_mapped(tables) ? take_map(m, tables, why) : take_short(m)) != RF_OK) {
        free(m);
        return NULL;
    }
    const rf_sizes mine = {PARAMETERS, 5, 5, 1, 0};
    *sizes = mine;
    return m;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    static const char *const NAMES[] = {"supply_temperature", "ambient_temperature", "housing_conductance",
                                        "bush_heat_capacity", "volumetric_heat"};
    model *m = kernel;
    rf_journal scaled = m->journal;
    const double unit[] = {p[RADIUS], p[LENGTH], p[CLEARANCE], 1.0};
    if (rf_scale_journal(&scaled, unit, why) != RF_OK)
        return RF_INVALID;
    for (int k = SUPPLY; k < PARAMETERS; ++k)
        if (!((k == CONDUCTANCE ? p[k] >= 0.0 : p[k] > 0.0) && p[k] < HUGE_VAL))
            return rf_say(why, RF_INVALID, "%s must be finite and %s, got %.9g", NAMES[k - SUPPLY],
                          k == CONDUCTANCE ? "not negative" : "positive", p[k]);
    const double slenderness = rf_slenderness(unit);
    if (m->map.coefficients) {
        rf_map_to_wall(&m->map, slenderness, 1.0);
        scaled.error = rf_map_error(&m->map);
    }
    m->ocvirk.factor = 4.0 * slenderness * slenderness;
    m->journal = scaled;
    memcpy(m->p, p, sizeof m->p);
    m->capacity = p[BUSH] + p[VOLUMETRIC_HEAT] * TWO_PI * p[RADIUS] * p[LENGTH] * p[CLEARANCE];
    for (int k = 0; k < 5; ++k)
        m->at.u[k] = NAN;
    return RF_OK;
}

const rf_kernel_type rf_heated_journal_type = {
    .create = create,
    .destroy = free,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
};
