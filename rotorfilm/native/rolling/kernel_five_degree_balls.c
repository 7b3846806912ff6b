/* Kernel "five_degree_balls": a shaft in ball bearings that moves along x, y, z and tilts about x, y.

   Tables: rows, waves and law of ball_tables.h, law of 1. Parameters: growth [m], damping along x and y [N s/m], speed of the
   cage over that of the shaft, z [m] and tilts [rad] of the inner rings where the shaft is at 0, those of the law of the balls
   in ball_tables.h. Inputs: x, y, z [m], tilt_x, tilt_y [rad], their rates, speed [rad/s]. Outputs: force_x, force_y, force_z
   [N], moment_x, moment_y [N m]. States: angles of cage and shaft [rad]. */

/* Documentation of the FMU

   Model: Force and moment of a ball bearing, or of a set of them on one shaft, on the shaft, whose outer rings stand. x, y
   and z are Cartesian from where the rings face each other, or their balls just touch, rotation and tilts are positive about
   +x, +y and +z; the shaft's place and moment are those at the middle of the set. The angles of cage
   and shaft are states: the cage turns with a fixed share of the speed. With e the unit vector along a contact at the angle alpha, t = de/d(alpha), and B the
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
#include <string.h>

#include "../films/quintic.h"
#include "ball_tables.h"

enum { GROWTH, DAMPING, RATIO, OFFSET, PARAMETERS = OFFSET + 3 };
enum { VELOCITY = RF_BALL_DEGREES, SPEED = 2 * RF_BALL_DEGREES, INPUTS };
enum { CAGE, SHAFT, STATES };

typedef struct model {
    rf_balls balls;
    double damping, ratio, offset[3];
    rf_ball_tables tables;
    rf_ball *each;
    size_t count;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const double *law;
    *sizes = (rf_sizes){PARAMETERS, INPUTS, RF_BALL_DEGREES, STATES, 0};
    if (rf_take_balls(tables, 1, &self->tables, &self->balls, &law, why))
        return RF_INVALID;
    sizes->parameters += rf_ball_law_parameters(&self->balls);
    for (size_t k = 0; k < self->balls.count; ++k)
        self->count += (size_t)self->balls.rows[k].count;
    sizes->events = self->count;
    self->each = calloc(self->count, sizeof *self->each);
    return self->each ? RF_OK : rf_say(why, RF_MEMORY, "no memory for %zu balls", self->count);
}

static void release(void *kernel)
{
    model *self = kernel;
    free(self->each);
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    if (rf_check_balls(p, PARAMETERS, DAMPING, why) || rf_set_ball_law(&self->balls, p + PARAMETERS, why))
        return RF_INVALID;
    self->balls.growth = p[GROWTH];
    self->damping = p[DAMPING];
    self->ratio = p[RATIO];
    for (int i = 0; i < 3; ++i)
        self->offset[i] = p[OFFSET + i];
    return RF_OK;
}

/* The wrench y[5] and, unless NULL, its derivatives by the motion, the speed and both angles, and each ball. */
static int at(const model *self, const rf_point *point, double *y, double *by, rf_ball *each, rf_message *why)
{
    const double *u = point->u;
    double motion[RF_BALL_DEGREES];
    rf_balls balls = self->balls;
    balls.cage = remainder(point->x[CAGE], RF_TURN);
    balls.shaft = remainder(point->x[SHAFT], RF_TURN);
    for (int i = 0; i < RF_BALL_DEGREES; ++i)
        motion[i] = u[i] + (i < 2 ? 0.0 : self->offset[i - 2]);
    int status = rf_balls_at(&balls, motion, u[SPEED], y, by, each);
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
    return at(kernel, point, y, NULL, NULL, why);
}

static int derivative(const void *kernel, const rf_point *point, double *dx, rf_message *why)
{
    const model *self = kernel;
    (void)why;
    dx[CAGE] = self->ratio * point->u[SPEED];
    dx[SHAFT] = point->u[SPEED];
    return RF_OK;
}

/* The approach of each ball to the inner ring. */
static int events(const void *kernel, const rf_point *point, double *z, rf_message *why)
{
    const model *self = kernel;
    double y[RF_BALL_DEGREES];
    const int status = at(self, point, y, NULL, self->each, why);
    for (size_t k = 0; k < self->count; ++k)
        z[k] = self->each[k].gap;
    return status;
}

static int jacobian(const void *kernel, const rf_point *point, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    double y[RF_BALL_DEGREES], by[RF_BALL_DEGREES * RF_BALL_SLOPES];
    const int status = at(self, point, y, by, NULL, why);
    memset(answer->A, 0, STATES * STATES * sizeof(double));
    memset(answer->B, 0, STATES * INPUTS * sizeof(double));
    answer->B[INPUTS * CAGE + SPEED] = self->ratio;
    answer->B[INPUTS * SHAFT + SPEED] = 1.0;
    for (int i = 0; i < RF_BALL_DEGREES; ++i) {
        double *row = answer->D + INPUTS * i;
        const double *slopes = by + RF_BALL_SLOPES * i;
        for (int j = 0; j < RF_BALL_DEGREES; ++j)
            row[j] = slopes[j];
        for (int j = 0; j < RF_BALL_DEGREES; ++j)
            row[VELOCITY + j] = i == j && i < 2 ? -self->damping : 0.0;
        row[SPEED] = slopes[RF_BALL_DEGREES];
        for (int j = 0; j < STATES; ++j)
            answer->C[STATES * i + j] = slopes[RF_BALL_DEGREES + 1 + j];
    }
    return status;
}

const rf_kernel_type rf_five_degree_balls_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .release = release,
    .set_parameters = set_parameters,
    .output = output,
    .derivative = derivative,
    .events = events,
    .jacobian = jacobian,
};
