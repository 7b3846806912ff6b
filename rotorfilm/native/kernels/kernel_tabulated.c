/* Kernel "tabulated": a bearing by stiffness and damping over the speed (bearings/linear.py).

   Table size (1): the number m of speeds. Parameters: m rising speeds [rad/s]; then m numbers each of kxx, kxy, kyx,
   kyy [N/m], cxx, cxy, cyx, cyy [N s/m]. Inputs x, y, vx, vy, speed; outputs force_x, force_y. */

/* Documentation of the FMU

   Model: Force of a bearing on the shaft that is given by its stiffness and damping over the speed, for small motion
   about an equilibrium. x and y are Cartesian from the equilibrium, rotation is positive about +z (from x to y).
   Between the speeds of the table each entry follows a monotone cubic (Fritsch and Butland 1984).

   Equations:
   F = -K(speed) (x, y) - C(speed) (vx, vy)

   Validity: At the speeds of the table; beyond them there is no answer. A table with a single speed holds for that
   speed only. */
#include <math.h>
#include <stdlib.h>

#include "kernel.h"

enum { ENTRIES = 8, INPUTS = 5, MOST = 10000 };

typedef struct model {
    size_t m;
    double *speeds; /* m of them, then for each entry m values and m slopes */
} model;

static void release(void *kernel)
{
    free(((model *)kernel)->speeds);
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const double *size = rf_numbers(tables, "size", 1, why);
    if (!size)
        return RF_INVALID;
    if (!(*size >= 1.0 && *size <= MOST))
        return rf_say(why, RF_INVALID, "size must be within 1 and %d, got %.9g", MOST, *size);
    self->m = (size_t)*size;
    *sizes = (rf_sizes){self->m * (1 + ENTRIES), INPUTS, 2, 0, 0};
    self->speeds = calloc(self->m * (1 + 2 * ENTRIES), sizeof *self->speeds);
    return self->speeds ? RF_OK : rf_say(why, RF_MEMORY, "no memory for %zu speeds", self->m);
}

/* The slope at an end: of the parabola, but not against the first chord, nor beyond three times it where the chords turn. */
static double end_slope(double width, double next_width, double chord, double next_chord)
{
    const double slope = ((2.0 * width + next_width) * chord - width * next_chord) / (width + next_width);
    if (!(slope * chord > 0.0))
        return 0.0;
    return chord * next_chord <= 0.0 && fabs(slope) > 3.0 * fabs(chord) ? 3.0 * chord : slope;
}

static void set_slopes(size_t m, const double *x, const double *y, double *slope)
{
    double width = 0.0, chord = 0.0;
    for (size_t k = 0; k + 1 < m; ++k) {
        const double next_width = x[k + 1] - x[k], next_chord = (y[k + 1] - y[k]) / next_width;
        const double left = 2.0 * next_width + width, right = next_width + 2.0 * width;
        if (k)
            slope[k] = chord * next_chord > 0.0 ? (left + right) / (left / chord + right / next_chord) : 0.0;
        width = next_width, chord = next_chord;
    }
    if (m == 2)
        slope[0] = slope[1] = chord;
    if (m > 2) {
        const double first = x[1] - x[0], second = x[2] - x[1], before = x[m - 2] - x[m - 3];
        slope[0] = end_slope(first, second, (y[1] - y[0]) / first, (y[2] - y[1]) / second);
        slope[m - 1] = end_slope(width, before, chord, (y[m - 2] - y[m - 3]) / before);
    }
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    const size_t m = self->m;
    for (size_t k = 0; k < m * (1 + ENTRIES); ++k)
        if (!isfinite(p[k]))
            return rf_say(why, RF_INVALID, "number %zu of the table must be finite, got %.9g", k, p[k]);
    for (size_t k = 0; k + 1 < m; ++k)
        if (!(p[k] < p[k + 1]))
            return rf_say(why, RF_INVALID, "speeds must rise, got %.9g and then %.9g rad/s", p[k], p[k + 1]);
    for (size_t k = 0; k < m; ++k)
        self->speeds[k] = p[k];
    for (size_t i = 0; i < ENTRIES; ++i) {
        double *to = self->speeds + m * (1 + 2 * i);
        for (size_t k = 0; k < m; ++k)
            to[k] = p[m * (1 + i) + k];
        set_slopes(m, p, to, to + m);
    }
    return RF_OK;
}

/* The interval with this speed. */
static size_t interval(const model *self, double speed)
{
    size_t low = 0, high = self->m - 1;
    while (low + 1 < high) {
        const size_t middle = low + (high - low) / 2;
        *(speed < self->speeds[middle] ? &high : &low) = middle;
    }
    return low;
}

/* The entries of K and C at a speed, and their slopes by it. */
static int look_up(const model *self, double speed, double *value, double *slope, rf_message *why)
{
    const size_t m = self->m;
    const double *x = self->speeds;
    if (!(speed >= x[0] && speed <= x[m - 1]))
        return rf_say(why, RF_UNDEFINED, "speed must be within the table, %.9g to %.9g rad/s, got %.9g", x[0], x[m - 1], speed);
    const size_t k = interval(self, speed);
    for (size_t i = 0; i < ENTRIES; ++i) {
        const double *y = x + m * (1 + 2 * i) + k, *d = y + m;
        value[i] = y[0], slope[i] = 0.0;
        if (m == 1)
            continue;
        const double width = x[k + 1] - x[k], s = speed - x[k], chord = (y[1] - y[0]) / width;
        const double cubic = (d[0] + d[1] - 2.0 * chord) / width, square = (chord - d[0]) / width - cubic;
        value[i] += s * (d[0] + s * (square + s * cubic / width));
        slope[i] = d[0] + s * (2.0 * square + 3.0 * s * cubic / width);
    }
    return RF_OK;
}

static double row(const double *matrix, const double *vector)
{
    return matrix[0] * vector[0] + matrix[1] * vector[1];
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    double value[ENTRIES], slope[ENTRIES];
    const int status = look_up(kernel, at->u[4], value, slope, why);
    for (size_t i = 0; i < 2 && status == RF_OK; ++i)
        y[i] = -row(value + 2 * i, at->u) - row(value + 4 + 2 * i, at->u + 2);
    return status;
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    double value[ENTRIES], slope[ENTRIES];
    const int status = look_up(kernel, at->u[4], value, slope, why);
    for (size_t i = 0; i < 2 && status == RF_OK; ++i) {
        double *to = answer->D + INPUTS * i;
        for (size_t j = 0; j < 2; ++j)
            to[j] = -value[2 * i + j], to[2 + j] = -value[4 + 2 * i + j];
        to[4] = -row(slope + 2 * i, at->u) - row(slope + 4 + 2 * i, at->u + 2);
    }
    return status;
}

const rf_kernel_type rf_tabulated_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .release = release,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
};
