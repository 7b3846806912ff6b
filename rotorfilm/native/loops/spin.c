#include "spin.h"

#include <string.h>

#include "../solvers/dense.h"

/* out = (speed - speed of the modes) (S z + S_0), z and out real parts and then imaginary ones. */
static void set_drive(const rf_march *march, double speed, const double *z, double *out)
{
    const size_t size = 2 * (size_t)march->rotor.modes;
    const double beyond = speed - march->spin.speed;
    for (size_t k = 0; k < size; ++k)
        out[k] = beyond * march->spin.rest[k];
    rf_add_product(size, size, beyond, march->spin.matrix, z, out);
}

/* The torque of rotating damping at a speed. */
static double damping_torque(const rf_march *march, double speed, const double *z)
{
    const int32_t wide = 2 * march->rotor.modes + 1;
    const double *still = march->motor.damping, *turning = still + wide * wide;
    double total = 0.0;
    for (int32_t i = 0; i < wide; ++i) {
        double sum = 0.0;
        for (int32_t j = 0; j < wide; ++j)
            sum += (still[i * wide + j] - speed * turning[i * wide + j]) * (j + 1 < wide ? z[j] : 1.0);
        total += sum * (i + 1 < wide ? z[i] : 1.0);
    }
    return total;
}

void rf_set_drive_start(const rf_march *march, double speed, rf_scratch *at)
{
    const int32_t modes = march->rotor.modes;
    for (int32_t m = 0; m < modes; ++m) {
        at->both[m] = march->z[m].re;
        at->both[modes + m] = march->z[m].im;
    }
    set_drive(march, speed, at->both, at->drive_start);
    if (march->motor.damping)
        at->damping[0] = damping_torque(march, speed, at->both);
}

/* What acts on the modes at the nodes, s x 2 modes: forces and drive. */
static void set_push(const rf_march *march, rf_scratch *at)
{
    const int32_t modes = march->rotor.modes, channels = march->rotor.channels;
    memcpy(at->push, at->drive, (size_t)(march->scheme.stages * 2 * modes) * sizeof *at->push);
    for (int32_t j = 0; j < march->scheme.stages; ++j) {
        double *re = at->push + 2 * j * modes, *im = re + modes;
        const double *force = at->guess + j * channels;
        for (int32_t m = 0; m < modes; ++m)
            for (int32_t c = 0; c < channels; ++c) {
                re[m] += march->rotor.push[m * channels + c].re * force[c];
                im[m] += march->rotor.push[m * channels + c].im * force[c];
            }
    }
}

static void add_weighted(int32_t modes, const rf_complex *weights, const double *drive, double *z)
{
    for (int32_t m = 0; m < modes; ++m) {
        z[m] += weights[m].re * drive[m] - weights[m].im * drive[modes + m];
        z[modes + m] += weights[m].re * drive[modes + m] + weights[m].im * drive[m];
    }
}

/* Modal coordinates at a node under what is in at->push. */
static void set_node(const rf_march *march, const rf_step_table *table, const rf_scratch *at, int32_t i, double *z)
{
    const int32_t s = march->scheme.stages, modes = march->rotor.modes;
    for (int32_t m = 0; m < modes; ++m) {
        const rf_complex turn = table->turn[i * modes + m], from = march->z[m];
        z[m] = turn.re * from.re - turn.im * from.im;
        z[modes + m] = turn.re * from.im + turn.im * from.re;
    }
    for (int32_t j = 0; j < s; ++j)
        add_weighted(modes, table->weights + (i * (s + 1) + j) * modes, at->push + 2 * j * modes, z);
}

static void set_seen(const rf_march *march, const double *z, double *motion)
{
    const int32_t modes = march->rotor.modes;
    for (int32_t q = 0; q < march->rotor.rows; ++q) {
        const rf_complex *sense = march->rotor.sense + q * modes;
        double total = 0.0;
        for (int32_t m = 0; m < modes; ++m)
            total += sense[m].re * z[m] - sense[m].im * z[modes + m];
        motion[q] = total;
    }
}

void rf_set_spinning_motion(const rf_march *march, const rf_step_table *table, rf_scratch *at, double *motion)
{
    set_push(march, at);
    for (int32_t i = 0; i < march->scheme.stages; ++i) {
        set_node(march, table, at, i, at->both);
        set_seen(march, at->both, motion + i * march->rotor.rows);
        double *const drive = at->drive + 2 * i * march->rotor.modes;
        set_drive(march, at->speed[i], at->both, drive);
        if (march->motor.damping)
            at->damping[i] = damping_torque(march, at->speed[i], at->both);
        rf_add_direct(march, at->guess + i * march->rotor.channels, drive, motion + i * march->rotor.rows);
    }
}

void rf_advance_spinning(rf_march *march, const rf_step_table *table, rf_scratch *at)
{
    const int32_t modes = march->rotor.modes;
    set_push(march, at);
    set_node(march, table, at, march->scheme.stages - 1, at->both);
    for (int32_t m = 0; m < modes; ++m) {
        march->z[m].re = at->both[m];
        march->z[m].im = at->both[modes + m];
    }
}

void rf_set_spinning_gap(const rf_march *march, const rf_step_table *table, rf_scratch *at, double *motion)
{
    const int32_t s = march->scheme.stages, modes = march->rotor.modes;
    memcpy(at->push, at->drive_start, 2 * (size_t)modes * sizeof *at->push);
    for (int32_t j = 0; j < s; ++j)
        for (int32_t k = 0; k < 2 * modes; ++k)
            at->push[k] -= march->scheme.lagrange[j * s] * at->drive[2 * j * modes + k];
    for (int32_t i = 0; i < s; ++i) {
        memset(at->both, 0, 2 * (size_t)modes * sizeof *at->both);
        add_weighted(modes, table->weights + (i * (s + 1) + s) * modes, at->push, at->both);
        set_seen(march, at->both, motion + i * march->rotor.rows);
    }
}
