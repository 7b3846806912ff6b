#include "march.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../solvers/dense.h"
#include "march_step.h"
#include "motor.h"
#include "spin.h"

#define WHOLE 1.0001 /* of a step that must fit before the stop */

/* What acts in the last step, so many numbers a node, continued to the nodes of one that is `ratio` as long. */
static void extrapolate(const rf_march *march, double ratio, int32_t channels, const double *u, double *out)
{
    const int32_t s = march->scheme.stages;
    for (int32_t i = 0; i < s; ++i) {
        const double at = 1.0 + ratio * march->scheme.nodes[i];
        double *row = out + i * channels;
        memset(row, 0, (size_t)channels * sizeof *row);
        for (int32_t j = 0; j < s; ++j) {
            const double *lagrange = march->scheme.lagrange + j * s;
            double value = 0.0;
            for (int32_t k = s - 1; k >= 0; --k)
                value = value * at + lagrange[k];
            for (int32_t c = 0; c < channels; ++c)
                row[c] += value * u[j * channels + c];
        }
    }
}

/* What may act in a step that follows one of this length, 0 where there is none. */
static void guess(const rf_march *march, double h, double before, rf_scratch *at)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels;
    const int32_t drives = march->spin.matrix ? 2 * march->rotor.modes : 0;
    if (before > 0.0) {
        extrapolate(march, h / before, channels, at->u, at->guess);
        extrapolate(march, h / before, drives, at->drive_before, at->drive);
        return;
    }
    for (int32_t i = 0; i < s; ++i) {
        memcpy(at->guess + i * channels, at->start, (size_t)channels * sizeof *at->guess);
        memcpy(at->drive + i * drives, at->drive_start, (size_t)drives * sizeof *at->drive);
    }
}

/* What acted in the step that is done, for the next one. */
static void keep_forces(const rf_march *march, rf_scratch *at)
{
    const size_t s = (size_t)march->scheme.stages, channels = (size_t)march->rotor.channels;
    const size_t drives = march->spin.matrix ? 2 * (size_t)march->rotor.modes : 0;
    memcpy(at->u, at->guess, s * channels * sizeof *at->u);
    memcpy(at->start, at->guess + (s - 1) * channels, channels * sizeof *at->start);
    memcpy(at->drive_before, at->drive, s * drives * sizeof *at->drive);
    memcpy(at->drive_start, at->drive + (s - 1) * drives, drives * sizeof *at->drive);
}

static double length_of(const rf_march *march, int32_t step)
{
    return march->longest * pow(2.0, -0.25 * step);
}

/* The tables of a length of step, filled if they are not there yet; NULL without memory. */
static const rf_step_table *table_of(rf_march *march, int32_t step)
{
    if (march->slot_of[step] >= 0)
        return &march->tables[march->slot_of[step]];
    const int32_t slot = march->next_slot;
    march->next_slot = (slot + 1) % RF_SLOTS;
    if (march->step_of[slot] >= 0)
        march->slot_of[march->step_of[slot]] = -1;
    march->step_of[slot] = march->slot_of[step] = -1;
    if (rf_set_step_table(&march->rotor, &march->scheme, length_of(march, step), &march->tables[slot]) != RF_OK)
        return NULL;
    march->step_of[slot] = step;
    march->slot_of[step] = slot;
    return &march->tables[slot];
}

static const rf_step_table *table_once(rf_march *march, double h)
{
    rf_step_table *table = &march->tables[RF_SLOTS];
    return rf_set_step_table(&march->rotor, &march->scheme, h, table) == RF_OK ? table : NULL;
}

/* What the forces of the step that is done do to each mode, by powers of the time in steps: modes x s. */
static void set_forced(const rf_march *march, rf_scratch *at)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels;
    rf_complex *to = at->forced;
    for (int32_t m = 0; m < march->rotor.modes; ++m, to += s) {
        const rf_complex *push = march->rotor.push + m * channels;
        memset(to, 0, (size_t)s * sizeof *to);
        for (int32_t j = 0; j < s; ++j) {
            rf_complex at_node = {0.0, 0.0};
            if (march->spin.matrix) {
                at_node.re = at->drive[2 * j * march->rotor.modes + m];
                at_node.im = at->drive[(2 * j + 1) * march->rotor.modes + m];
            }
            for (int32_t c = 0; c < channels; ++c) {
                at_node.re += push[c].re * at->guess[j * channels + c];
                at_node.im += push[c].im * at->guess[j * channels + c];
            }
            for (int32_t k = 0; k < s; ++k) {
                to[k].re += march->scheme.lagrange[j * s + k] * at_node.re;
                to[k].im += march->scheme.lagrange[j * s + k] * at_node.im;
            }
        }
    }
}

/* Modal coordinates at the times of the grid within the step that is done. */
static int64_t sample(const rf_march *march, double h, const double *grid, int64_t count, int64_t place,
                      rf_scratch *at, rf_complex *out)
{
    const int32_t s = march->scheme.stages, modes = march->rotor.modes;
    if (place >= count || grid[place] > march->time + h)
        return place;
    set_forced(march, at);
    for (; place < count && grid[place] <= march->time + h; ++place) {
        rf_complex *to = out + place * modes;
        const double share = (grid[place] - march->time) / h;
        rf_set_integrals(&march->rotor, h, share, s, to, at->weights);
        if (march->motor.torque)
            rf_set_turn(march, at, h, share, march->motor.turns + 3 * place);
        for (int32_t m = 0; m < modes; ++m) {
            const rf_complex turn = to[m], z = march->z[m];
            rf_complex total = {turn.re * z.re - turn.im * z.im, turn.re * z.im + turn.im * z.re};
            for (int32_t k = m * s; k < (m + 1) * s; ++k) {
                const rf_complex w = at->weights[k], f = at->forced[k];
                total.re += w.re * f.re - w.im * f.im;
                total.im += w.re * f.im + w.im * f.re;
            }
            to[m] = total;
        }
    }
    return place;
}

static void advance(rf_march *march, const rf_step_table *table, rf_scratch *at)
{
    const size_t modes = (size_t)march->rotor.modes;
    const size_t wide = (size_t)march->scheme.stages * (size_t)march->rotor.channels;
    march->motor.angle = at->turned[march->scheme.stages - 1];
    march->motor.speed = at->speed[march->scheme.stages - 1];
    if (march->spin.matrix) {
        rf_advance_spinning(march, table, at);
        return;
    }
    memset(at->both, 0, 2 * modes * sizeof *at->both);
    rf_add_product(2 * modes, wide, 1.0, table->forced, at->guess, at->both);
    for (size_t m = 0; m < modes; ++m) {
        const rf_complex keep = table->keep[m], z = march->z[m];
        march->z[m].re = keep.re * z.re - keep.im * z.im + at->both[m];
        march->z[m].im = keep.re * z.im + keep.im * z.re + at->both[modes + m];
    }
}

/* How many lengths shorter the step that follows a failed one is. */
static int32_t shorter_by(const rf_march *march, int status, double error)
{
    const double order = march->scheme.stages + 1.0, most = 40.0;
    const double change = 4.0 * log2(error / pow(0.9, order)) / order;
    return status >= RF_AT_WALL ? 8 : 1 + (int32_t)(change < most ? change : most);
}

static int32_t longer_by(const rf_march *march, double error)
{
    const double rise = floor(4.0 * log2(0.8 * pow(fmax(error, 1e-12), -1.0 / (march->scheme.stages + 1.0))));
    return rise < 0.0 ? 0 : rise > 4.0 ? 4 : (int32_t)rise;
}

/* Why a march ends where a film answers this status. */
static int end_of(int status)
{
    return status == RF_AT_WALL ? RF_MARCH_WALL : status == RF_MEMORY ? RF_MARCH_MEMORY : RF_MARCH_BROKEN;
}

static int march_on(rf_march *march, double stop, int64_t budget, const double *grid, int64_t count,
                    int64_t *place, rf_complex *out, rf_scratch *at)
{
    const double last = nextafter(stop, -HUGE_VAL);
    double before = 0.0; /* length of the step whose forces are known */
    const int start = rf_set_start(march, at);
    if (start >= RF_AT_WALL)
        return end_of(start);
    while (march->time < stop && budget-- > 0) {
        double h = length_of(march, march->step), error;
        const int whole = march->time + WHOLE * h < stop;
        h = whole ? h : stop - march->time;
        const rf_step_table *table = whole ? table_of(march, march->step) : table_once(march, h);
        if (!table)
            return RF_MARCH_MEMORY;
        guess(march, h, before, at);
        const int status = rf_try_step(march, table, h, last, at, &error);
        if (status == RF_MEMORY)
            return RF_MARCH_MEMORY;
        if (status >= RF_AT_WALL || !(error <= 1.0)) {
            if (h < march->shortest)
                return status >= RF_AT_WALL ? end_of(status) : RF_MARCH_SHORT;
            const int32_t of_length = (int32_t)ceil(-4.0 * log2(h / march->longest) - 1e-9);
            const int32_t step = of_length > march->step ? of_length : march->step;
            const int32_t next = step + shorter_by(march, status, error);
            march->step = next < RF_STEPS ? next : RF_STEPS - 1;
            march->rejected += 1;
            march->walls += status == RF_AT_WALL;
            before = status >= RF_AT_WALL ? 0.0 : before;
            continue;
        }
        march->steps += 1;
        march->left_map |= status == RF_OUTSIDE;
        *place = sample(march, h, grid, count, *place, at, out);
        advance(march, table, at);
        keep_forces(march, at);
        march->time = whole ? march->time + h : stop;
        before = h;
        if (whole) {
            const int32_t next = march->step - longer_by(march, error);
            march->step = next > 0 ? next : 0;
        }
        if (march->motor.torque && fabs(march->motor.speed - march->spin.speed) > march->motor.band)
            return march->time >= stop ? RF_MARCH_DONE : RF_MARCH_BAND;
    }
    return march->time >= stop ? RF_MARCH_DONE : RF_MARCH_BUSY;
}

int rf_march_to(rf_march *march, double stop, int64_t budget, const double *grid, int64_t count,
                int64_t *place, rf_complex *out)
{
    rf_scratch at;
    if (rf_open_scratch(&at, march) != RF_OK)
        return RF_MARCH_MEMORY;
    const int end = march_on(march, stop, budget, grid, count, place, out, &at);
    free(at.memory);
    return end;
}
