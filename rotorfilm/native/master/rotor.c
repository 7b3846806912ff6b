#include "rotor.h"

#include <math.h>
#include <string.h>

#include "chain.h"

#define TOLERANCE 1e-9 /* of the state at the end of a step, relative to it and to its nominal value */
#define HALVINGS 4     /* of a step, before the rotor counts as not linear */
#define LAW_NUMBERS 18 /* of one station */

/* Where the numbers of a step under an exponential are. */
typedef struct scratch {
    double *rates, *powers, *scaled, *loop, *y, *end, *motion, *force, *column, *chain;
} scratch;

size_t rf_rotor_work(size_t n, size_t m)
{
    return 2 * RF_NODES * n + RF_NODES * n + n * n + (3 + HALVINGS) * n + 3 * m + n + 2 * m + rf_chain_work(n);
}

static scratch placed(const rf_rotor *rotor, size_t n, size_t m)
{
    scratch s;
    s.rates = rotor->work;
    s.powers = s.rates + RF_NODES * n;
    s.scaled = s.powers + RF_NODES * n;
    s.loop = s.scaled + RF_NODES * n;
    s.y = s.loop + n * n;
    s.end = s.y + n;
    s.motion = s.end + (2 + HALVINGS) * n;
    s.force = s.motion + 2 * m;
    s.column = s.force + m;
    s.chain = s.column + n + 2 * m;
    return s;
}

static int rates_at(rf_rotor *rotor, const scratch *s, double t, const double *x, const rf_law *law,
                    double *rates)
{
    rf_partner *p = rotor->partner;
    const size_t m = law->m;
    if (rf_move(p, t, x) || rf_put(p, rotor->drive_refs, m, rotor->base)
        || rf_take(p, rotor->motion_refs, 2 * m, s->motion))
        return RF_ROTOR_FAILS;
    rf_law_at(law, t, s->motion, s->motion + m, s->force);
    return rf_put(p, rotor->drive_refs, m, s->force) || rf_rate(p, rates) ? RF_ROTOR_FAILS : 0;
}

/* A - B (K dq/dx + C dv/dx). */
static void close_loop(const rf_rotor *rotor, const rf_law *law, size_t n, double *loop)
{
    const size_t m = law->m, width = n + m;
    for (size_t i = 0; i < n; ++i)
        memcpy(loop + i * n, rotor->slopes + i * width, n * sizeof *loop);
    for (size_t k = 0; k < m; ++k)
        for (size_t j = 0; j < n; ++j) {
            double felt = 0.0;
            for (size_t l = 0; l < m; ++l)
                felt += law->stiffness[k * m + l] * rotor->slopes[(n + l) * width + j]
                        + law->damping[k * m + l] * rotor->slopes[(n + m + l) * width + j];
            for (size_t i = 0; i < n; ++i)
                loop[i * n + j] -= rotor->slopes[i * width + n + k] * felt;
        }
}

/* Powers of the rates over the step from those at the nodes, and both in nominal units for the chain. */
static void fit(const rf_rotor *rotor, const scratch *s, size_t n, double dt)
{
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < RF_NODES; ++k) {
            double sum = 0.0;
            for (size_t j = 0; j < RF_NODES; ++j)
                sum += rotor->to_powers[k * RF_NODES + j] * s->rates[j * n + i];
            s->powers[i * RF_NODES + k] = sum;
            s->scaled[i * RF_NODES + k] = dt * sum / rotor->nominal[i];
        }
}

/* One step by the exponential to s->end; its error in tolerances, or negative where a call failed. */
static double attempt(rf_rotor *rotor, const scratch *s, double t, const double *x, double dt,
                      const rf_law *law, double *end)
{
    const size_t n = rotor->partner->states;
    double worst = 0.0;
    for (size_t j = 0; j < RF_NODES; ++j)
        if (rates_at(rotor, s, t + rotor->nodes[j] * dt, x, law, s->rates + j * n))
            return -1.0;
    fit(rotor, s, n, dt);
    close_loop(rotor, law, n, s->loop);
    for (size_t i = 0; i < n * n; ++i)
        s->loop[i] *= dt * rotor->nominal[i % n] / rotor->nominal[i / n];
    rf_chain(n, s->loop, s->scaled, s->y, s->chain);
    for (size_t i = 0; i < n; ++i)
        end[i] = x[i] + rotor->nominal[i] * s->y[i];
    if (rates_at(rotor, s, nextafter(t + dt, t), end, law, s->rates))
        return -1.0;
    for (size_t i = 0; i < n; ++i) {
        double defect = dt * s->rates[i] / rotor->nominal[i];
        for (size_t j = 0; j < n; ++j)
            defect -= s->loop[i * n + j] * s->y[j];
        for (size_t k = 0; k < RF_NODES; ++k)
            defect -= s->scaled[i * RF_NODES + k];
        const double allowed =
            TOLERANCE * (1.0 + fabs(s->y[i])) + 1e-14 * fabs(dt * s->rates[i] / rotor->nominal[i]);
        const double error = fabs(defect) / allowed;
        worst = error <= worst ? worst : error; /* what is no number counts as large */
    }
    return worst;
}

static int smooth(rf_rotor *rotor, const scratch *s, double t, const double *x, double dt, const rf_law *law,
                  int halvings, double *end)
{
    const size_t n = rotor->partner->states, m = law->m;
    for (int fresh = 0; fresh < 2; ++fresh) {
        if (fresh || !rotor->known) {
            rotor->known = 0;
            if (rf_move(rotor->partner, t, x) || rf_put(rotor->partner, rotor->drive_refs, m, rotor->base)
                || rf_slopes(rotor->partner, rotor->rows, n + 2 * m, rotor->columns, n + m, rotor->slopes,
                             s->column))
                return RF_ROTOR_FAILS;
            rotor->known = 1;
        }
        const double error = attempt(rotor, s, t, x, dt, law, end);
        if (error < 0.0)
            return RF_ROTOR_FAILS;
        if (error <= 1.0)
            return 0;
    }
    if (halvings == 0)
        return RF_ROTOR_WAITS;
    double *middle = s->end + (size_t)halvings * n;
    const int ended = smooth(rotor, s, t, x, 0.5 * dt, law, halvings - 1, middle);
    return ended ? ended : smooth(rotor, s, t + 0.5 * dt, middle, 0.5 * dt, law, halvings - 1, end);
}

static int integrate(rf_rotor *rotor, double t, double dt, const rf_law *law)
{
    const size_t n = rotor->partner->states;
    const scratch s = placed(rotor, n, law->m);
    if (!(rotor->kink > t + dt))
        return RF_ROTOR_WAITS;
    const int ended = smooth(rotor, &s, t, rotor->x, dt, law, HALVINGS, s.end);
    if (ended)
        return ended;
    memcpy(rotor->x, s.end, n * sizeof(double));
    return rf_move(rotor->partner, t + dt, rotor->x) ? RF_ROTOR_FAILS : 0;
}

/* base_time, then force, slope, curvature, stiffness, damping, position and velocity of each station. */
static size_t spelled(const rf_law *law, double *values)
{
    double *at = values;
    *at++ = law->start;
    for (size_t k = 0; k < law->m; k += 2) {
        const double *const pairs[] = {law->force, law->slope, law->curvature};
        const double *const squares[] = {law->stiffness, law->damping};
        for (int i = 0; i < 3; ++i)
            *at++ = pairs[i][k], *at++ = pairs[i][k + 1];
        for (int i = 0; i < 2; ++i)
            for (size_t row = k; row < k + 2; ++row)
                *at++ = squares[i][row * law->m + k], *at++ = squares[i][row * law->m + k + 1];
        *at++ = law->position[k], *at++ = law->position[k + 1];
        *at++ = law->velocity[k], *at++ = law->velocity[k + 1];
    }
    return (size_t)(at - values);
}

int rf_drive(rf_rotor *rotor, double t, double dt, const rf_law *law)
{
    if (rotor->mode == RF_INTEGRATED)
        return integrate(rotor, t, dt, law);
    const double *values = law->force;
    size_t count = law->m;
    if (rotor->mode == RF_LAWFUL) {
        count = spelled(law, rotor->work);
        values = rotor->work;
    }
    return rf_put(rotor->partner, rotor->drive_refs, count, values) || rf_stride(rotor->partner, t, dt)
               ? RF_ROTOR_FAILS
               : 0;
}
