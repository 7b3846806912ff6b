/* A rotor that a motor drives: its angle p and speed w are states.

   With r = w^2 e - a n, which the unbalance U makes forces of, e = (cos p, sin p), n = e' and a = w',

       I a = torque(t, w) + n (g - s) + damping,

   s being the acceleration U' q'' of the unbalance, g what gravity has of it, and `damping` the torque of rotating
   damping (rotors/motor.py). The acceleration a is a polynomial through the nodes of a step as the forces are, in the
   last channel, whose push is zero. Speed and angle are its exact integrals, and Newton's method solves for it along
   with the films' forces. */
#ifndef ROTORFILM_MOTOR_H
#define ROTORFILM_MOTOR_H

#include "march_step.h"

/* Set pair to (w^2 cos p + a sin p, w^2 sin p - a cos p). */
void rf_set_pair(double p, double w, double a, double *pair);

/* Angle, speed and acceleration at a share of a step of length h under the accelerations in at->guess. */
void rf_set_turn(const rf_march *march, const rf_scratch *at, double h, double share, double *turn);

/* The same at the nodes, with their pairs; the largest change, scaled. */
double rf_set_turns(const rf_march *march, rf_scratch *at);

/* Torques and their slopes at the nodes; a status. */
int rf_set_torques(const rf_march *march, int32_t nodes, rf_scratch *at);

/* Motion at each node per unknown at each node: the forces of the films and a, from that per channel. */
const double *rf_set_driven_gain(const rf_march *march, int32_t nodes, const double *gain, rf_scratch *at);

/* Add the equation of a at each node, and the slopes of the films' forces by the speed. */
void rf_add_motor_equations(const rf_march *march, int32_t nodes, const double *gain, rf_scratch *at);

/* The largest angle and speed that a gap of a at the start of a step makes, scaled. */
double rf_turn_error(const rf_march *march, double h, double gap);

/* The torque of a motor whose line is shifted over time, at a state (t, w), and its slope by w: of is the slope of
   the line, a resistance, how many times there are, these, and the speed without load at each. */
RF_EXPORT_LOOP int rf_line_torque_at(const void *of, const double *state, double *f, double *jacobian);

#endif
