/* Kernel "ball_bearing": a shaft in ball bearings that moves along x and y.

   Tables: rows, waves and law of ball_tables.h, law of 2: the inertia of the balls, and whether the second parameter is a
   thrust. Parameters: growth [m]; z [m] or the thrust [N]; tilt_x,
   tilt_y [rad]; angle of the cage [rad], added to that of the rows; damping [N s/m]; those of the law of the balls in
   ball_tables.h. Inputs and outputs of a reaction. */

/* Documentation of the FMU

   Model: Force of a ball bearing, or of a set of them on one shaft, on the shaft, whose outer rings stand. x and y are
   Cartesian from the center of the outer rings, rotation is positive about +z, tilts are held, and z is held or follows
   from an axial load. Each ball is in Hertzian contact with both grooves, whose centers of curvature are apart by the
   vector a; e is the unit vector along a contact at the angle alpha, t = de/d(alpha):

   Equations:
   force = - sum over the balls of (Q_i e_i - T_i t_i) - damping (vx, vy)
   Q_i e_i - Q_o e_o - T_i t_i + T_o t_o + F_c r = 0,  Q = K d^1.5,  d = distance - free distance, not below 0
   F_c = mass pitch_diameter orbit^2 / 2,  T_i + T_o = 2 M / ball_diameter,  M = - J orbit spin
   Balls that friction holds: T = traction_coefficient Q slip / S,  S^2 = v0^2 + slip^2 + (3/8 a E spin_k)^2,
   v0 = slide_to_roll_ratio pitch_diameter speed / 4. Race control: (T_i, T_o) = (0, 2) or (1, 1) M / ball_diameter

   Validity: Dry elastic contacts of rigid rings, balls that roll along their orbit without sliding, and under
   race control spin on one race only; a ball that leaves the inner race rests on the outer one. Without inertia of the balls
   F_c and M are zero. The cage stands at the angle that is given. Beyond a contact pressure of 4200 MPa, and where the
   gyroscopic moment asks for more than 0.9 of the traction coefficient (more than 0.06 under race control), there is a
   warning. */

#include "ball_tables.h"

enum { GROWTH, AXIAL, TILT_X, TILT_Y, CAGE, DAMPING, PARAMETERS };

typedef struct model {
    rf_ball_journal journal;
    rf_ball_tables tables;
} model;

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const double *law;
    *sizes = (rf_sizes){PARAMETERS, 5, 2, 0, 0};
    if (rf_take_balls(tables, 2, &self->tables, &self->journal.balls, &law, why))
        return RF_INVALID;
    sizes->parameters += rf_ball_law_parameters(&self->journal.balls);
    self->journal.is_free = law[1] != 0.0;
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    rf_ball_journal *journal = &self->journal;
    if (rf_check_balls(p, PARAMETERS, DAMPING, why) || rf_set_ball_law(&journal->balls, p + PARAMETERS, why))
        return RF_INVALID;
    journal->balls.growth = p[GROWTH];
    *(journal->is_free ? &journal->thrust : &journal->place[0]) = p[AXIAL];
    journal->place[1] = p[TILT_X];
    journal->place[2] = p[TILT_Y];
    journal->damping = p[DAMPING];
    journal->balls.cage = p[CAGE];
    return RF_OK;
}

static int explain(int status, const double *u, rf_message *why)
{
    return status == RF_OK ? RF_OK
                           : rf_say(why, status, "%s, at x = %.9g, y = %.9g m, speed = %.9g rad/s", rf_ball_text(status),
                                    u[0], u[1], u[4]);
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    return explain(rf_ball_journal_at(&self->journal, at->u, y, NULL, NULL), at->u, why);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    double y[2];
    return explain(rf_ball_journal_at(&self->journal, at->u, y, answer->D, NULL), at->u, why);
}

const rf_kernel_type rf_ball_bearing_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
};
