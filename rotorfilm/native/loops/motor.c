#include "motor.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "../films/map_frame.h"

/* The integral of a polynomial of so many coefficients from 0 to c, and the integral of that. */
static void set_integrals(const double *polynomial, int32_t count, double c, double *once, double *twice)
{
    *once = *twice = 0.0;
    for (int32_t k = count - 1; k >= 0; --k) {
        *once = c * (*once + polynomial[k] / (k + 1));
        *twice = c * (*twice + polynomial[k] / ((k + 1) * (k + 2)));
    }
    *twice *= c;
}

/* What an acceleration at node j does to speed and angle at node i. */
static void set_reach(const rf_march *march, double h, int32_t i, int32_t j, double *by_speed, double *by_angle)
{
    const rf_scheme *scheme = &march->scheme;
    set_integrals(scheme->lagrange + j * scheme->stages, scheme->stages, scheme->nodes[i], by_speed, by_angle);
    *by_speed *= h;
    *by_angle *= h * h;
}

void rf_set_pair(double p, double w, double a, double *pair)
{
    const double c = cos(p), s = sin(p);
    pair[0] = w * w * c + a * s;
    pair[1] = w * w * s - a * c;
}

void rf_set_turn(const rf_march *march, const rf_scratch *at, double h, double share, double *turn)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels;
    double once = 0.0, twice = 0.0, now = 0.0;
    for (int32_t j = 0; j < s; ++j) {
        const double *lagrange = march->scheme.lagrange + j * s, a = at->guess[(j + 1) * channels - 1];
        double by_speed, by_angle, value = 0.0;
        set_integrals(lagrange, s, share, &by_speed, &by_angle);
        for (int32_t k = s - 1; k >= 0; --k)
            value = value * share + lagrange[k];
        once += by_speed * a;
        twice += by_angle * a;
        now += value * a;
    }
    turn[0] = march->motor.angle + h * (share * march->motor.speed + h * twice);
    turn[1] = march->motor.speed + h * once;
    turn[2] = now;
}

double rf_set_turns(const rf_march *march, rf_scratch *at)
{
    const int32_t channels = march->rotor.channels, forces = rf_force_count(&march->journals);
    double change = 0.0, turn[3];
    for (int32_t i = 0; i < march->scheme.stages; ++i) {
        double *row = at->guess + i * channels;
        rf_set_turn(march, at, at->h, march->scheme.nodes[i], turn);
        const double rounded = 8.0 * DBL_EPSILON * fabs(turn[0]); /* after many turns */
        change = fmax(change, fmax(0.0, fabs(turn[0] - at->turned[i]) - rounded));
        change = fmax(change, fabs(turn[1] - at->speed[i]) / march->motor.rate);
        at->turned[i] = turn[0];
        at->speed[i] = turn[1];
        rf_set_pair(turn[0], turn[1], row[channels - 1], row + forces);
    }
    return change;
}

int rf_set_torques(const rf_march *march, int32_t nodes, rf_scratch *at)
{
    for (int32_t i = 0; i < nodes; ++i) {
        const double state[2] = {at->time[i], at->speed[i]};
        double *answer = at->torque + 2 * i;
        const int status = march->motor.torque(march->motor.of, state, answer, answer + 1);
        if (status >= RF_AT_WALL || rf_is_broken(answer, 2))
            return RF_NOT_FINITE;
    }
    return RF_OK;
}

/* The pair at node j by the acceleration at node k. */
static void set_pair_slope(const rf_march *march, const rf_scratch *at, int32_t j, int32_t k, double *slope)
{
    const double w = at->speed[j], a = at->guess[(j + 1) * march->rotor.channels - 1];
    const double c = cos(at->turned[j]), s = sin(at->turned[j]);
    double by_speed, by_angle;
    set_reach(march, at->h, j, k, &by_speed, &by_angle);
    slope[0] = 2.0 * w * c * by_speed + (a * c - w * w * s) * by_angle + (j == k ? s : 0.0);
    slope[1] = 2.0 * w * s * by_speed + (a * s + w * w * c) * by_angle - (j == k ? c : 0.0);
}

const double *rf_set_driven_gain(const rf_march *march, int32_t nodes, const double *gain, rf_scratch *at)
{
    const int32_t rows = march->rotor.rows, channels = march->rotor.channels, forces = rf_force_count(&march->journals);
    const int32_t wide = forces + 1, block = rows * channels;
    for (int32_t k = 0; k < nodes; ++k) {
        double slope[2 * RF_MOST_NODES];
        for (int32_t j = 0; j < nodes; ++j)
            set_pair_slope(march, at, j, k, slope + 2 * j);
        for (int32_t i = 0; i < nodes; ++i)
            for (int32_t q = 0; q < rows; ++q) {
                double *to = at->gain + ((i * nodes + k) * rows + q) * wide;
                memcpy(to, gain + (i * nodes + k) * block + q * channels, (size_t)forces * sizeof *to);
                to[forces] = 0.0;
                for (int32_t j = 0; j < nodes; ++j) {
                    const double *pair = gain + (i * nodes + j) * block + q * channels + forces;
                    to[forces] += pair[0] * slope[2 * j] + pair[1] * slope[2 * j + 1];
                }
            }
    }
    return at->gain;
}

void rf_add_motor_equations(const rf_march *march, int32_t nodes, const double *gain, rf_scratch *at)
{
    const rf_motor *motor = &march->motor;
    const int32_t rows = march->rotor.rows, channels = march->rotor.channels, forces = rf_force_count(&march->journals);
    const int32_t wide = forces + 1, size = nodes * wide;
    for (int32_t i = 0; i < nodes; ++i) {
        const double c = cos(at->turned[i]), s = sin(at->turned[i]), *moved = at->motion + (i + 1) * rows - 2;
        const double pull[2] = {motor->gravity[0] - moved[0], motor->gravity[1] - moved[1]};
        double *own = at->matrix + (i * wide + forces) * size;
        for (int32_t j = 0; j < nodes; ++j) {
            const double *by = gain + ((i * nodes + j + 1) * rows - 2) * wide;
            double by_speed, by_angle;
            set_reach(march, at->h, i, j, &by_speed, &by_angle);
            for (int32_t k = 0; k < wide; ++k)
                own[j * wide + k] = (c * by[wide + k] - s * by[k]) / motor->inertia;
            own[j * wide + forces] +=
                ((c * pull[0] + s * pull[1]) * by_angle - at->torque[2 * i + 1] * by_speed) / motor->inertia;
            for (int32_t r = 0; r < forces; ++r)
                at->matrix[(i * wide + r) * size + j * wide + forces] -= at->by_speed[i * forces + r] * by_speed;
        }
        own[i * wide + forces] += 1.0;
        at->right[i * wide + forces] = (at->torque[2 * i] + at->damping[i] + c * pull[1] - s * pull[0]) / motor->inertia
                                       - at->guess[(i + 1) * channels - 1];
    }
}

double rf_turn_error(const rf_march *march, double h, double gap)
{
    double worst = 0.0, once, twice;
    for (int32_t i = 0; i < march->scheme.stages; ++i) {
        set_integrals(march->scheme.remainder, march->scheme.stages + 1, march->scheme.nodes[i], &once, &twice);
        worst = fmax(worst, fabs(gap * h) * fmax(fabs(once) / march->motor.rate, fabs(h * twice)));
    }
    return worst;
}

int rf_line_torque_at(const void *of, const double *state, double *f, double *jacobian)
{
    const double *line = of, *times = line + 3, t = state[0], w = state[1];
    const int32_t count = (int32_t)line[2];
    const double *idle = times + count;
    int32_t k = 0;
    while (k + 1 < count && times[k + 1] <= t)
        ++k;
    const int inside = t > times[k] && k + 1 < count;
    const double slope = inside ? (idle[k + 1] - idle[k]) / (times[k + 1] - times[k]) : 0.0;
    const double passed = inside ? t - times[k] : 0.0;
    f[0] = line[0] * (idle[k] + slope * passed - w) - line[1] * w;
    if (jacobian)
        jacobian[0] = -line[0] - line[1];
    return RF_OK;
}
