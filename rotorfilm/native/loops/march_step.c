#include "march_step.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/map_frame.h"
#include "../solvers/dense.h"
#include "film_states.h"
#include "motor.h"
#include "spin.h"

#define NEWTON_STEPS 8
#define HUGE_CHANGE 1e300

/* What Newton's method solves for at each node: the films' forces, and the acceleration of a motor. */
static int32_t unknowns(const rf_march *march)
{
    return rf_force_count(&march->journals) + (march->motor.torque ? 1 : 0);
}

int rf_open_scratch(rf_scratch *at, const rf_march *march)
{
    const size_t s = (size_t)march->scheme.stages, channels = (size_t)march->rotor.channels;
    const size_t rows = (size_t)march->rotor.rows, modes = (size_t)march->rotor.modes;
    const size_t all = s * (size_t)rf_force_count(&march->journals), wide = (size_t)rf_slope_width(&march->journals);
    const size_t each = (size_t)unknowns(march), size = s * each, driven = march->motor.torque ? size * s * rows : 0;
    const size_t drives = march->spin.matrix ? 2 * modes : 0;
    const size_t sizes[] = {s * channels, s * channels, channels, 2 * modes, s * rows, s * rows,  s * rows,
                            s, s, all, wide * all, s * drives, s * drives, drives, s * drives, size * size,
                            size, s, 2 * s, s, all, driven, rf_states_size(&march->journals, s, each),
                            2 * modes * s, 2 * modes * s};
    double **const places[] = {&at->u,      &at->guess, &at->start, &at->both,   &at->free, &at->motion,
                               &at->before, &at->speed, &at->turned, &at->force, &at->slope, &at->drive,
                               &at->drive_before, &at->drive_start, &at->push, &at->matrix, &at->right,
                               &at->time, &at->torque, &at->damping, &at->by_speed, &at->gain, &at->states};
    const size_t count = sizeof sizes / sizeof *sizes, named = sizeof places / sizeof *places;
    size_t total = 0;
    for (size_t k = 0; k < count; ++k)
        total += sizes[k];
    double *next = at->memory = malloc(total * sizeof *next);
    if (!next)
        return RF_MEMORY;
    for (size_t k = 0; k < named; next += sizes[k++])
        *places[k] = next;
    memset(at->damping, 0, s * sizeof *at->damping);
    at->forced = (rf_complex *)next;
    at->weights = at->forced + modes * s;
    return RF_OK;
}

/* Set the pair of motor.h, *turned to the angle, and return the speed at a time. */
static double unbalance(const rf_speeds *profile, double t, double pair[2], double *turned)
{
    int32_t k = 0;
    while (k + 1 < profile->count && profile->times[k + 1] <= t)
        ++k;
    const double passed = t - profile->times[k], a = passed >= 0.0 ? profile->slopes[k] : 0.0;
    const double w = profile->speeds[k] + a * passed;
    *turned = profile->angles[k] + passed * (profile->speeds[k] + 0.5 * a * passed);
    rf_set_pair(*turned, w, a, pair);
    return w;
}

static void set_excitation(const rf_excitation *given, double t, double *out)
{
    int32_t k = 0, beyond = given->count - 1;
    const int inside = t >= given->times[0] && t < given->times[beyond];
    while (inside && beyond - k > 1) {
        const int32_t middle = (k + beyond) / 2;
        *(given->times[middle] <= t ? &k : &beyond) = middle;
    }
    const double part = (t - given->times[k]) / (given->times[beyond] - given->times[k]);
    for (int32_t row = 0; row < given->rows; ++row) {
        const double *values = given->values + row * given->count;
        out[row] = inside ? values[k] + part * (values[beyond] - values[k]) : 0.0;
    }
}

/* What acts besides the films at a time, in the channels after theirs; the speed, and the angle turned. */
static double set_given(const rf_march *march, double t, double *given, double *turned)
{
    if (march->excitation.count > 0)
        set_excitation(&march->excitation, t, given + 2);
    return unbalance(&march->profile, t, given, turned);
}

/* Motion of the journals at the nodes under the forces in at->guess. */
static void set_motion(const rf_march *march, const rf_step_table *table, rf_scratch *at, double *motion)
{
    const size_t s = (size_t)march->scheme.stages, channels = (size_t)march->rotor.channels;
    const size_t rows = (size_t)march->rotor.rows;
    if (march->spin.matrix) {
        rf_set_spinning_motion(march, table, at, motion);
        return;
    }
    memcpy(motion, at->free, s * rows * sizeof *motion);
    for (size_t i = 0; i < s; ++i)
        for (size_t j = 0; j < s; ++j)
            rf_add_product(rows, channels, 1.0, table->gain + (i * s + j) * rows * channels,
                           at->guess + j * channels, motion + i * rows);
}

/* Films at the motion of all nodes. */
static int set_node_forces(rf_march *march, rf_scratch *at)
{
    const int32_t rows = march->rotor.rows, forces = rf_force_count(&march->journals);
    const int32_t slopes = rf_slope_width(&march->journals) * forces;
    int worst = RF_OK;
    for (int32_t i = 0; i < march->scheme.stages; ++i) {
        const int status = rf_set_forces(&march->journals, at->motion + i * rows, at->speed[i], at->turned[i],
                                         at->guess + i * march->rotor.channels,
                                         at->force + i * forces, at->slope + slopes * i,
                                         march->motor.torque ? at->by_speed + i * forces : NULL);
        march->films += 1;
        if (status >= RF_AT_WALL)
            return status;
        worst = status > worst ? status : worst;
    }
    const int status = march->motor.torque ? rf_set_torques(march, march->scheme.stages, at) : RF_OK;
    return status > worst ? status : worst;
}

/* Number k of what the force of a journal changes with, among all rows: its motion, states of its film, acceleration; -1
   where its film has fewer states. */
static int32_t row_of(const rf_march *march, int32_t journal, int32_t k)
{
    const rf_journals *journals = &march->journals;
    const int32_t own = 4 * journals->points, behind = own + journals->most;
    if (k < own)
        return own * journal + k;
    if (k < behind)
        return k - own < rf_film_states(journals, journal) ? 4 * journals->count + journals->first[journal] + k - own : -1;
    return rf_state_count(journals) + 2 * journal + k - behind;
}

/* The journal of one of the forces of all, and of the rates of the states of their films behind them. */
static int32_t journal_of(const rf_march *march, int32_t force)
{
    const int32_t forces = 2 * march->journals.count, inner = force - forces;
    if (inner < 0)
        return force / (2 * march->journals.points);
    int32_t journal = 0;
    while (march->journals.first[journal + 1] <= inner)
        ++journal;
    return journal;
}

/* Solve the linear equations of Newton's method for the unknowns at so many nodes; a status. */
static int solve_equations(const rf_march *march, int32_t s, const double *by_channel, rf_scratch *at)
{
    const int32_t channels = march->rotor.channels, rows = march->rotor.rows, width = rf_slope_width(&march->journals);
    const int32_t forces = rf_force_count(&march->journals);
    const int32_t each = unknowns(march), size = s * each, stride = each > forces ? each : channels;
    const int32_t planar = 2 * march->journals.count, own = 4 * march->journals.points;
    const int32_t behind = own + march->journals.most;
    const double *gains = each > forces ? rf_set_driven_gain(march, s, by_channel, at) : by_channel;
    memset(at->matrix, 0, (size_t)size * (size_t)size * sizeof *at->matrix);
    for (int32_t of = 0; of < s * forces; ++of) {
        const int32_t i = of / forces, r = of % forces, row = i * each + r, journal = journal_of(march, r);
        double *to = at->matrix + row * size;
        for (int32_t j = 0; j < s; ++j)
            for (int32_t k = 0; k < width; ++k) {
                const double slope = at->slope[width * of + k];
                const int32_t of_row = row_of(march, journal, k), inner = k >= own && k < behind;
                if (of_row < 0)
                    continue;
                const double *gain = gains + ((i * s + j) * rows + of_row) * stride;
                const int32_t first = inner ? of_row - planar : 0, last = inner ? first + 1 : planar;
                for (int32_t c = first; c < last; ++c) /* a state follows its own rate alone */
                    to[j * each + c] -= slope * gain[c];
                if (each > forces)
                    to[(j + 1) * each - 1] -= slope * gain[each - 1];
            }
        to[row] += 1.0;
        at->right[row] = at->force[of] - at->guess[i * channels + r];
    }
    if (each > forces)
        rf_add_motor_equations(march, s, gains, at);
    if (march->journals.first)
        rf_solve_with_states(&march->journals, s, each, at->matrix, at->right, at->states);
    else
        rf_eliminate((size_t)size, at->matrix, 1, at->right);
    return rf_is_broken(at->right, size) ? RF_NOT_FINITE : RF_OK;
}

/* Take the forces in at->right; the largest change of motion, scaled. */
static double take_forces(const rf_march *march, const rf_step_table *table, rf_scratch *at)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, rows = march->rotor.rows;
    const int32_t forces = rf_force_count(&march->journals), each = unknowns(march);
    double *const before = at->motion, change = 0.0;
    for (int32_t j = 0; j < s; ++j)
        for (int32_t c = 0; c < each; ++c)
            at->guess[c < forces ? j * channels + c : (j + 1) * channels - 1] += at->right[j * each + c];
    if (march->motor.torque)
        change = rf_set_turns(march, at);
    at->motion = at->before;
    at->before = before;
    set_motion(march, table, at, at->motion);
    for (int32_t q = 0; q < s * rows; ++q)
        change = fmax(change, fabs(at->motion[q] - before[q]) * march->scales[q % rows]);
    return change;
}

/* Solve for the films' forces at the nodes, in at->guess. */
static int newton(rf_march *march, const rf_step_table *table, rf_scratch *at)
{
    double before = HUGE_VAL;
    int worst = RF_OK;
    if (march->motor.torque)
        rf_set_turns(march, at);
    set_motion(march, table, at, at->motion);
    for (int step = 0; step < NEWTON_STEPS; ++step) {
        const int status = set_node_forces(march, at);
        if (status >= RF_AT_WALL)
            return status;
        worst = status > worst ? status : worst;
        march->jacobians += 1;
        if (solve_equations(march, march->scheme.stages, table->gain, at) != RF_OK)
            return RF_NOT_FINITE;
        const double change = take_forces(march, table, at);
        if (!(change < HUGE_CHANGE) || (step > 1 && change > before))
            return RF_NOT_FINITE;
        /* Where Newton's method contracts, what is left is less than the last change times the contraction. */
        if (change * (step > 0 ? fmin(change / before, 1.0) : 1.0) < march->newton)
            return worst;
        before = change;
    }
    return RF_NOT_FINITE;
}

/* The largest motion that the gap between the force at the start and its polynomial makes, scaled. */
static double local_error(const rf_march *march, const rf_step_table *table, rf_scratch *at)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, rows = march->rotor.rows;
    double *gap = at->right, worst = 0.0;
    if (march->spin.matrix)
        rf_set_spinning_gap(march, table, at, at->before);
    for (int32_t c = 0; c < channels; ++c) {
        gap[c] = at->start[c];
        for (int32_t j = 0; j < s; ++j)
            gap[c] -= march->scheme.lagrange[j * s] * at->guess[j * channels + c];
    }
    if (march->motor.torque)
        worst = rf_turn_error(march, at->h, gap[channels - 1]);
    for (int32_t i = 0; i < s; ++i)
        for (int32_t q = 0; q < rows; ++q) {
            const double *defect = table->defect + (i * rows + q) * channels;
            double total = march->spin.matrix ? at->before[i * rows + q] : 0.0;
            for (int32_t c = 0; c < channels; ++c)
                total += defect[c] * gap[c];
            worst = fmax(worst, fabs(total) * march->scales[q]);
        }
    return worst;
}

int rf_try_step(rf_march *march, const rf_step_table *table, double h, double last, rf_scratch *at, double *error)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, rows = march->rotor.rows;
    const int32_t modes = march->rotor.modes;
    at->h = h;
    for (int32_t i = 0; i < s; ++i) {
        at->time[i] = fmin(march->time + h * march->scheme.nodes[i], last);
        at->speed[i] = set_given(march, at->time[i], at->guess + i * channels + rf_force_count(&march->journals),
                                 at->turned + i);
    }
    for (int32_t m = 0; m < modes; ++m) {
        at->both[m] = march->z[m].re;
        at->both[modes + m] = march->z[m].im;
    }
    memset(at->free, 0, (size_t)(s * rows) * sizeof *at->free);
    rf_add_product((size_t)(s * rows), 2 * (size_t)modes, 1.0, table->move, at->both, at->free);
    const int status = newton(march, table, at);
    *error = status >= RF_AT_WALL ? 0.0 : local_error(march, table, at) / march->rtol;
    return status;
}

void rf_add_direct(const rf_march *march, const double *forces, const double *drive, double *motion)
{
    const int32_t modes = march->rotor.modes, rows = march->rotor.rows, first = rf_state_count(&march->journals);
    if (!march->rotor.direct)
        return;
    rf_add_product((size_t)rows, (size_t)march->rotor.channels, 1.0, march->rotor.direct, forces, motion);
    for (int32_t k = 0; drive && k < rows - first; ++k) {
        const rf_complex *rate = march->rotor.rates + k * modes;
        for (int32_t m = 0; m < modes; ++m)
            motion[first + k] += rate[m].re * drive[m] - rate[m].im * drive[modes + m];
    }
}

/* Speed, angle and all that acts at the time of the march without films, in the first row of at->guess. */
static void set_given_start(rf_march *march, rf_scratch *at)
{
    const int32_t forces = rf_force_count(&march->journals), channels = march->rotor.channels;
    at->h = 0.0;
    at->time[0] = march->time;
    memset(at->guess, 0, (size_t)channels * sizeof *at->guess);
    at->speed[0] = set_given(march, march->time, at->guess + forces, at->turned);
    if (!march->motor.torque)
        return;
    at->speed[0] = march->motor.speed;
    at->turned[0] = march->motor.angle;
    rf_set_pair(at->turned[0], at->speed[0], 0.0, at->guess + forces);
}

/* The forces at the start, and the acceleration of a motor, from those at the accelerations without any of them. */
static int share_acceleration(rf_march *march, rf_scratch *at)
{
    const int32_t forces = rf_force_count(&march->journals), last = march->rotor.channels - 1;
    int status = march->motor.torque ? rf_set_torques(march, 1, at) : RF_OK;
    if (status == RF_OK)
        status = solve_equations(march, 1, march->rotor.direct, at);
    memcpy(at->start, at->right, (size_t)forces * sizeof *at->start);
    if (!march->motor.torque)
        return status;
    at->start[last] = at->right[forces];
    march->motor.first = march->time > 0.0 ? march->motor.first : at->start[last];
    rf_set_pair(at->turned[0], at->speed[0], at->start[last], at->start + forces);
    return status;
}

int rf_set_start(rf_march *march, rf_scratch *at)
{
    const int32_t rows = march->rotor.rows, modes = march->rotor.modes, forces = rf_force_count(&march->journals);
    for (int32_t q = 0; q < rows; ++q) {
        const rf_complex *sense = march->rotor.sense + q * modes;
        double total = 0.0;
        for (int32_t m = 0; m < modes; ++m)
            total += sense[m].re * march->z[m].re - sense[m].im * march->z[m].im;
        at->motion[q] = total;
    }
    set_given_start(march, at);
    if (march->spin.matrix)
        rf_set_drive_start(march, at->speed[0], at);
    rf_add_direct(march, at->guess, march->spin.matrix ? at->drive_start : NULL, at->motion);
    memcpy(at->start, at->guess, (size_t)march->rotor.channels * sizeof *at->start);
    const int status = rf_set_forces(&march->journals, at->motion, at->speed[0], at->turned[0], NULL, at->start, at->slope,
                                     march->motor.torque ? at->by_speed : NULL);
    memcpy(at->force, at->start, (size_t)forces * sizeof *at->force);
    if (!march->rotor.direct || status >= RF_AT_WALL)
        return status;
    const int solved = share_acceleration(march, at);
    return solved > status ? solved : status;
}
