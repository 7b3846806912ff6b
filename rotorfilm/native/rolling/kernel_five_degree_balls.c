/* Kernel "five_degree_balls": a shaft in ball bearings that moves along x, y, z and tilts about x, y.

   Tables: rows, waves and law of ball_tables.h, law of 1. Parameters: growth [m], damping along x and y [N s/m], those of
   the law of the balls in ball_tables.h. Inputs: x, y, z [m], tilt_x, tilt_y [rad], vx, vy [m/s], speed [rad/s], angles of cage and shaft [rad]. Outputs: force_x, force_y,
   force_z [N], moment_x, moment_y [N m]. */

/* Documentation of the FMU

   Model: Force and moment of a ball bearing, or of a set of them on one shaft, on the shaft, whose outer rings stand. x, y
   and z are Cartesian from where the rings face each other, or their balls just touch, rotation and tilts are positive about
   +x, +y and +z; the shaft's place and moment are those at the middle of the set. The angle of the cage is an input: it
   turns at about half the speed. With e the unit vector along a contact at the angle alpha, t = de/d(alpha), and B the
   derivatives of the distance of the centers of curvature by the motion:

   Equations:
   (force, moment) = - sum over the balls of B' (Q_i e_i - T_i t_i) - damping (vx, vy, 0, 0, 0)
   Q_i e_i - Q_o e_o - T_i t_i + T_o t_o + F_c r = 0,  Q = K d^1.5,  d = distance - free distance, not below 0
   F_c = mass pitch_diameter orbit^2 / 2,  T_i + T_o = 2 M / ball_diameter,  M = - J orbit spin
   Balls that friction holds: T = traction_coefficient Q slip / S,  S^2 = v0^2 + slip^2 + (3/8 a E spin_k)^2,
   v0 = slide_to_roll_ratio pitch_diameter speed / 4. Race control: (T_i, T_o) = (0, 2) or (1, 1) M / ball_diameter

   Validity: Dry elastic contacts of rigid rings, balls that roll along their orbit without sliding, and under
   race control spin on one race only; a ball that leaves the inner race rests on the outer one. Without inertia of the balls
   F_c and M are zero. Waves of the races change the distance of the centers of curvature; those of the inner one turn with
   the angle of the shaft. Beyond a contact pressure of 4200 MPa, and where the gyroscopic moment asks for more than 0.9 of
   the traction coefficient (more than 0.06 under race control), there is a warning. */
#include <math.h>
#include <stdlib.h>

#include "ball_tables.h"

enum { GROWTH, DAMPING, PARAMETERS };
enum { VELOCITY = RF_BALL_DEGREES, SPEED = VELOCITY + 2, CAGE, SHAFT, INPUTS };

typedef struct model {
    rf_balls balls;
    double damping;
    rf_ball_tables tables;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    static const rf_sizes mine = {PARAMETERS, INPUTS, RF_BALL_DEGREES, 0, 0};
    model *self = kernel;
    const double *law;
    *sizes = mine;
    if (rf_take_balls(tables, 1, &self->tables, &self->balls, &law, why))
        return RF_INVALID;
    sizes->parameters += rf_ball_law_parameters(&self->balls);
    return RF_OK;
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    return rf_make_kernel(sizeof(model), take_tables, free, tables, sizes, why);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    if (rf_check_balls(p, PARAMETERS, DAMPING, why) || rf_set_ball_law(&self->balls, p + PARAMETERS, why))
        return RF_INVALID;
    self->balls.growth = p[GROWTH];
    self->damping = p[DAMPING];
    return RF_OK;
}

/* The wrench y[5] and, unless NULL, its derivatives by the motion, the speed and both angles. */
static int at(const model *self, const double *u, double *y, double *by, rf_message *why)
{
    rf_balls balls = self->balls;
    balls.cage = u[CAGE];
    balls.shaft = u[SHAFT];
    int status = rf_balls_at(&balls, u, u[SPEED], y, by, NULL);
    for (int i = 0; i < 2; ++i)
        y[i] -= self->damping * u[VELOCITY + i];
    double sum = 0.0;
    for (int i = 0; i < RF_BALL_DEGREES; ++i)
        sum += y[i];
    if (!isfinite(sum))
        status = RF_NOT_FINITE;
    return status == RF_OK ? RF_OK
                           : rf_say(why, status, "%s, at (%.6g, %.6g, %.6g) m, (%.6g, %.6g) rad, speed = %.6g rad/s",
                                    rf_ball_text(status), u[0], u[1], u[2], u[3], u[4], u[SPEED]);
}

static int output(const void *kernel, const rf_point *point, double *y, rf_message *why)
{
    return at(kernel, point->u, y, NULL, why);
}

static int jacobian(const void *kernel, const rf_point *point, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    double y[RF_BALL_DEGREES], by[RF_BALL_DEGREES * RF_BALL_SLOPES];
    const int status = at(self, point->u, y, by, why);
    for (int i = 0; i < RF_BALL_DEGREES; ++i) {
        double *row = answer->D + INPUTS * i;
        const double *slopes = by + RF_BALL_SLOPES * i;
        for (int j = 0; j < RF_BALL_DEGREES; ++j)
            row[j] = slopes[j];
        for (int j = 0; j < 2; ++j)
            row[VELOCITY + j] = i == j ? -self->damping : 0.0;
        for (int j = SPEED; j < INPUTS; ++j)
            row[j] = slopes[j - 2];
    }
    return status;
}

const rf_kernel_type rf_five_degree_balls_type = {
    .create = create,
    .destroy = free,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
};
