/* Ball bearings on one shaft: force and moment over the motion of the shaft in five degrees, and equilibria.

   A motion is (x, y, z [m], tilt_x, tilt_y [rad]) of the shaft at one point, a wrench the force [N] and moment [N m] on
   it there, both about the same axes. */
#ifndef ROTORFILM_BALLS_H
#define ROTORFILM_BALLS_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "ball.h"

#define RF_BALL_DEGREES 5

/* What a wrench is differentiated by: the motion, the speed, the angles of cage and shaft. */
#define RF_BALL_SLOPES 8

/* Waviness of the races of one ring, of all rows: cos(lobes (angle - that of the ring) + phase) times these amplitudes is
   added to the distance of the centers of curvature. */
typedef struct rf_ball_wave {
    double turns;  /* 1 of the inner ring, 0 of the outer one, which stands */
    double lobes;
    double radial; /* amplitude, positive where it takes clearance [m] */
    double axial;  /* [m] */
    double phase;  /* [rad] */
} rf_ball_wave;

#define RF_WAVE_COLUMNS 5

typedef struct rf_balls {
    const rf_ball_row *rows;
    size_t count;
    double growth;   /* of the inner rings, radially against the outer ones [m] */
    rf_ball_law law;
    double cage;     /* angle by which the cages are turned further [rad] */
    double shaft;    /* angle of the inner rings, where they have waves [rad] */
    const rf_ball_wave *waves;
    size_t wave_count;
} rf_balls;

/* Wrench[5] and, unless NULL, its derivatives by[5][8], and each ball, row by row. The worst status of a ball. */
RF_EXPORT_LOOP int rf_balls_at(const rf_balls *balls, const double *motion, double speed, double *wrench, double *by,
                               rf_ball *each);

/* The motion under a load[5] on the shaft, from a first one, and the derivatives of the wrench there. Degrees with a
   held[5] other than 0 stay, none where it is NULL. *steps gets the count of wrenches that were computed. RF_STUCK where
   no equilibrium was found. */
RF_EXPORT_LOOP int rf_balls_rest(const rf_balls *balls, const double *load, double speed, const int32_t *held, double *motion,
                                 double *by, int32_t *steps);

/* A shaft that moves along x and y only: a reaction. */
typedef struct rf_ball_journal {
    rf_balls balls;
    double place[3]; /* z [m], tilt_x, tilt_y [rad]; z is where a search begins if it is free */
    double thrust;   /* axial load [N] */
    double damping;  /* beside the balls, along x and y [N s/m] */
    int32_t is_free; /* whether z follows from the thrust */
} rf_ball_journal;

/* Force f[2] and, unless NULL, its derivatives jacobian[2][5] at x, y [m], vx, vy [m/s], speed [rad/s]; z unless NULL. */
RF_EXPORT_LOOP int rf_ball_journal_at(const rf_ball_journal *journal, const double *state, double *f, double *jacobian,
                                      double *z);

#endif
