/* Kernel "rigid_rotor": one journal's share of a rigid rotor that moves without tilting (rotors/rigid.py).

   Parameters mass [kg], unbalance [kg m], unbalance_angle [rad], gravity_x, gravity_y [m/s2], static_force_x,
   static_force_y [N] and, where the speed profile has one point only, speed [rad/s]. Tables times [s], speeds
   [rad/s]: the profile, linear between its points and constant outside. Inputs force_x, force_y [N]; states
   x, y [m], vx, vy [m/s]; outputs x, y, vx, vy, speed. With a table law (any number) the force is
   force + slope T + curvature T^2 - K (q - q0) - C (v - v0), T = t - t0, and slope_x, slope_y, curvature_x,
   curvature_y, K and C (row by row), q0, v0, t0 are inputs too (rotors/force_law.py). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernel.h"

enum {
    MASS,
    UNBALANCE,
    UNBALANCE_ANGLE,
    GRAVITY,
    STATIC_FORCE = GRAVITY + 2,
    SPEED = STATIC_FORCE + 2,
    PARAMETERS
};

enum { SLOPE = 2, CURVATURE = 4, STIFFNESS = 6, DAMPING = 10, BASE = 14, BASE_TIME = 18, LAW_INPUTS };

typedef struct model {
    double p[PARAMETERS];
    double load[2];
    size_t inputs, points;
    double *times, *speeds, *angles; /* the angle turned since the first point, at each point */
} model;

/* Points of the profile not after t. */
static size_t passed(const model *self, double t)
{
    size_t low = 0, high = self->points;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (self->times[middle] <= t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static double slope(const model *self, size_t k)
{
    return (self->speeds[k] - self->speeds[k - 1]) / (self->times[k] - self->times[k - 1]);
}

/* Angular speed, the acceleration just after t, and the angle turned since the first point. */
static void motion(const model *self, double t, double *speed, double *acceleration, double *angle)
{
    const size_t k = passed(self, t), from = k ? k - 1 : 0;
    const double elapsed = t - self->times[from];
    *acceleration = k == 0 || k == self->points ? 0.0 : slope(self, k);
    *speed = self->speeds[from] + *acceleration * (k ? elapsed : 0.0);
    *angle = self->angles[from] + elapsed * (self->speeds[from] + 0.5 * *acceleration * elapsed);
}

static void integrate_profile(model *self)
{
    self->angles[0] = 0.0;
    for (size_t k = 1; k < self->points; ++k)
        self->angles[k] =
            self->angles[k - 1]
            + 0.5 * (self->speeds[k] + self->speeds[k - 1]) * (self->times[k] - self->times[k - 1]);
}

static void destroy(void *kernel)
{
    model *self = kernel;
    free(self->times);
    free(self);
}

static model *with_profile(const rf_table *times, const rf_table *speeds, size_t inputs, rf_message *why)
{
    const size_t n = times->extent[0];
    model *self = calloc(1, sizeof *self);
    double *numbers = malloc(3 * n * sizeof *numbers);
    if (!self || !numbers) {
        rf_say(why, RF_MEMORY, "no memory for a rotor");
        free(self);
        free(numbers);
        return NULL;
    }
    self->inputs = inputs;
    self->points = n;
    self->times = numbers;
    self->speeds = numbers + n;
    self->angles = numbers + 2 * n;
    memcpy(self->times, times->numbers, n * sizeof *numbers);
    memcpy(self->speeds, speeds->numbers, n * sizeof *numbers);
    integrate_profile(self);
    return self;
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    const rf_table *times = rf_find_table(tables, "times", 1, why);
    const rf_table *speeds = times ? rf_find_table(tables, "speeds", 1, why) : NULL;
    if (!speeds)
        return NULL;
    const size_t n = times->extent[0];
    if (n == 0 || speeds->extent[0] != n) {
        rf_say(why, RF_INVALID, "speeds must be as many as times, one at least, got %u and %u",
               (unsigned)speeds->extent[0], (unsigned)n);
        return NULL;
    }
    for (size_t k = 1; k < n; ++k)
        if (!(times->numbers[k] > times->numbers[k - 1])) {
            rf_say(why, RF_INVALID, "times must increase strictly, got %.9g after %.9g", times->numbers[k],
                   times->numbers[k - 1]);
            return NULL;
        }
    const size_t inputs = rf_find_table(tables, "law", 1, why) ? LAW_INPUTS : 2;
    const rf_sizes mine = {n == 1 ? PARAMETERS : SPEED, inputs, 5, 4};
    *sizes = mine;
    return with_profile(times, speeds, inputs, why);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    const size_t count = self->points == 1 ? PARAMETERS : SPEED;
    if (!(p[MASS] > 0.0))
        return rf_say(why, RF_INVALID, "mass must be finite and positive, got %.9g", p[MASS]);
    if (!(p[UNBALANCE] >= 0.0))
        return rf_say(why, RF_INVALID, "unbalance must be finite and not negative, got %.9g", p[UNBALANCE]);
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(p[i]))
            return rf_say(why, RF_INVALID, "parameter %zu of a rotor must be finite, got %.9g", i, p[i]);
    memcpy(self->p, p, count * sizeof *p);
    for (int i = 0; i < 2; ++i)
        self->load[i] = p[MASS] * p[GRAVITY + i] + p[STATIC_FORCE + i];
    if (self->points == 1)
        self->speeds[0] = p[SPEED];
    return RF_OK;
}

/* Component i of the film force. */
static double film_force(const model *self, const rf_point *at, int i)
{
    const double *u = at->u;
    if (self->inputs == 2)
        return u[i];
    const double elapsed = at->t - u[BASE_TIME];
    double sum = u[i] + elapsed * (u[SLOPE + i] + elapsed * u[CURVATURE + i]);
    for (int j = 0; j < 4; ++j)
        sum -= u[STIFFNESS + 2 * i + j + (j & 2)] * (at->x[j] - u[BASE + j]);
    return sum;
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    const model *self = kernel;
    double w, alpha, angle, now, then, start;
    motion(self, at->t, &w, &alpha, &angle);
    motion(self, 0.0, &now, &then, &start);
    const double phase = angle - start + self->p[UNBALANCE_ANGLE], c = cos(phase), s = sin(phase);
    const double shake[2] = {self->p[UNBALANCE] * (w * w * c + alpha * s),
                             self->p[UNBALANCE] * (w * w * s - alpha * c)};
    for (int i = 0; i < 2; ++i) {
        dx[i] = at->x[2 + i];
        dx[2 + i] = (film_force(self, at, i) + self->load[i] + shake[i]) / self->p[MASS];
    }
    if (!isfinite(dx[0]) || !isfinite(dx[1]) || !isfinite(dx[2]) || !isfinite(dx[3]))
        return rf_say(why, RF_NOT_FINITE,
                      "the acceleration is not finite under force_x = %.9g, force_y = %.9g N", at->u[0],
                      at->u[1]);
    return RF_OK;
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    double acceleration, angle;
    (void)why;
    memcpy(y, at->x, 4 * sizeof *y);
    motion(kernel, at->t, y + 4, &acceleration, &angle);
    return RF_OK;
}

/* The row of a film force in A and B, in forces per mass. */
static void differentiate_law(const model *self, const rf_point *at, int i, double *A, double *B)
{
    const double *u = at->u, elapsed = at->t - u[BASE_TIME], share = 1.0 / self->p[MASS];
    B[SLOPE + i] = share * elapsed;
    B[CURVATURE + i] = share * elapsed * elapsed;
    B[BASE_TIME] = -share * (u[SLOPE + i] + 2.0 * elapsed * u[CURVATURE + i]);
    for (int j = 0; j < 4; ++j) {
        const int k = STIFFNESS + 2 * i + j + (j & 2);
        B[k] = -share * (at->x[j] - u[BASE + j]);
        A[j] = -share * u[k];
        B[BASE + j] = -A[j];
    }
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    const size_t m = self->inputs;
    (void)why;
    memset(answer->A, 0, 16 * sizeof(double));
    memset(answer->B, 0, 4 * m * sizeof(double));
    memset(answer->C, 0, 20 * sizeof(double));
    memset(answer->D, 0, 5 * m * sizeof(double));
    for (int i = 0; i < 2; ++i) {
        double *row = answer->B + (size_t)(2 + i) * m;
        answer->A[4 * i + 2 + i] = 1.0;
        row[i] = 1.0 / self->p[MASS];
        if (m > 2)
            differentiate_law(self, at, i, answer->A + 4 * (2 + i), row);
    }
    for (int i = 0; i < 4; ++i)
        answer->C[4 * i + i] = 1.0;
    return RF_OK;
}

static double next_event(const void *kernel, double t)
{
    const model *self = kernel;
    const size_t k = passed(self, t);
    return self->points > 1 && k < self->points ? self->times[k] : HUGE_VAL;
}

extern const rf_kernel_type rf_rigid_rotor_type;
const rf_kernel_type rf_rigid_rotor_type = {
    .name = "rigid_rotor",
    .create = create,
    .destroy = destroy,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .next_event = next_event,
};
