/* One step of a march: the forces at its nodes by Newton's method, and the local error. */
#ifndef ROTORFILM_MARCH_STEP_H
#define ROTORFILM_MARCH_STEP_H

#include "march.h"

/* What a call of rf_march_to needs beside the tables. */
typedef struct rf_scratch {
    double *u, *guess;      /* s x channels: forces at the nodes of the last step and of this one */
    double *start;          /* channels: at its start */
    double *both;           /* 2 modes */
    double *free, *motion, *before; /* s x rows: without forces, with them, and with those of the last iterate */
    double h, *time;        /* length of the step, and s times */
    double *speed, *turned; /* s: angular speed, and angle */
    double *torque, *damping, *by_speed, *gain; /* s x 2, s, s x 2 n, s x s x rows x (2 n + 1): of motor.h */
    double *force, *slope;  /* s x 2 n, s x 2 n x rf_slope_width */
    double *drive, *drive_before; /* s x 2 modes: what spin.h adds, in this step and in the last one */
    double *drive_start, *push;   /* 2 modes: at the start; s x 2 modes: all that acts on the modes */
    double *matrix, *right; /* unknowns squared, and as many as one row or all channels */
    double *states;         /* of film_states.h */
    rf_complex *forced;     /* modes x s: what the forces of a step do to each mode, by powers of time */
    rf_complex *weights;    /* modes x s */
    double *memory;
} rf_scratch;

int rf_open_scratch(rf_scratch *at, const rf_march *march);

/* Films' forces and unbalance at the time of the march, in at->start. */
int rf_set_start(rf_march *march, rf_scratch *at);

/* Add to the motion of the journals the accelerations per force and drive at the same moment. */
void rf_add_direct(const rf_march *march, const double *forces, const double *drive, double *motion);

/* Solve one step for the forces in at->guess; a status, and the local error over rtol. `last` is the latest
   time at which the speed is asked for. */
int rf_try_step(rf_march *march, const rf_step_table *table, double h, double last, rf_scratch *at, double *error);

#endif
