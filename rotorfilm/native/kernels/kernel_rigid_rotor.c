/* Kernel "rigid_rotor": one journal's share of a rigid rotor that moves without tilting (rotors/rigid.py).

   Parameters mass [kg], unbalance [kg m], unbalance_angle [rad], gravity_x, gravity_y [m/s2], static_force_x,
   static_force_y [N] and, where the speed profile has one point only, speed [rad/s]. Tables times [s], speeds
   [rad/s]: the profile, linear between its points and constant outside. Inputs force_x, force_y [N]; states
   x, y [m], vx, vy [m/s]; outputs x, y, vx, vy, speed. With a table law (any number) the force is
   force + slope T + curvature T^2 - K (q - q0) - C (v - v0), T = t - t0, and slope_x, slope_y, curvature_x,
   curvature_y, K and C (row by row), q0, v0, t0 are inputs too (rotors/force_law.py). */

/* Documentation of the FMU

   Model: One journal's share of a rigid rotor that moves without tilting. x and y are Cartesian, rotation
   is positive about +z (from x to y); the inputs are the film force on the journal. With the angle p(t) of
   the unbalance, w = dp/dt and alpha = dw/dt:

   Equations:
   mass d2x/dt2 = force_x + mass gravity_x + static_force_x + unbalance (w^2 cos p + alpha sin p)
   mass d2y/dt2 = force_y + mass gravity_y + static_force_y + unbalance (w^2 sin p - alpha cos p)

   Validity: Small displacements, no tilting, a speed given over time (piecewise linear). The rotor knows no
   wall: the bearing's film ends the motion there. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../solvers/profile.h"

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
    size_t inputs;
    rf_profile profile;
} model;

static void release(void *kernel)
{
    model *self = kernel;
    rf_free_profile(&self->profile);
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    if (rf_take_profile(&self->profile, tables, why) != RF_OK)
        return RF_INVALID;
    self->inputs = rf_find_table(tables, "law", 1, why) ? LAW_INPUTS : 2;
    *sizes = (rf_sizes){self->profile.points == 1 ? PARAMETERS : SPEED, self->inputs, 5, 4, 0};
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    const size_t count = self->profile.points == 1 ? PARAMETERS : SPEED;
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
    if (self->profile.points == 1)
        self->profile.speeds[0] = p[SPEED];
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
    rf_spin spin = rf_spin_at(&self->profile, at->t);
    double shake[2];
    spin.angle += self->p[UNBALANCE_ANGLE];
    rf_shake(&spin, shake);
    for (int i = 0; i < 2; ++i) {
        dx[i] = at->x[2 + i];
        dx[2 + i] = (film_force(self, at, i) + self->load[i] + self->p[UNBALANCE] * shake[i]) / self->p[MASS];
    }
    if (!isfinite(dx[0]) || !isfinite(dx[1]) || !isfinite(dx[2]) || !isfinite(dx[3]))
        return rf_say(why, RF_NOT_FINITE,
                      "the acceleration is not finite under force_x = %.9g, force_y = %.9g N", at->u[0],
                      at->u[1]);
    return RF_OK;
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    (void)why;
    memcpy(y, at->x, 4 * sizeof *y);
    y[4] = rf_spin_at(&self->profile, at->t).speed;
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
    return rf_next_point(&((const model *)kernel)->profile, t);
}

const rf_kernel_type rf_rigid_rotor_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .release = release,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .next_event = next_event,
};
