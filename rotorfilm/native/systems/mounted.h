/* A rotor with its bearings as one system (rotors/mounted.py): its tables, and the linear equations of its steps. */
#ifndef ROTORFILM_MOUNTED_H
#define ROTORFILM_MOUNTED_H

#include "../kernels/kernel.h"
#include "../solvers/profile.h"

typedef struct rf_mounted_bearing {
    const rf_kernel_type *type;
    void *kernel;
    rf_table *tables;
    size_t parameters, inputs;
    int heavy; /* whether it tells the mass of its oil */
} rf_mounted_bearing;

typedef struct rf_mounted {
    size_t n, bearings, inputs, sensed; /* n: coordinates */
    const double *steady, *spin, *push, *carry, *weight, *unbalance, *sense, *motion;
    rf_profile profile;
    size_t driven; /* 1 where speed and angular acceleration are inputs, behind the others, and the angle is the last state */
    double *turning; /* (n): accelerations by that angle, where a step was factorized */
    rf_mounted_bearing *bearing;
    const double *fixed, *planes; /* (n, 2), (n, 2 plane_count): of the unbalances that are no parameters; by forces */
    size_t plane_count;
    double *turned;  /* (n, 2): `unbalance`, with that of the planes */
    double *numbers; /* one block behind all that follows */
    double *moved, *force, *by_motion, *by_speed;     /* of the bearings at one point: (4b), (2b), (b, 2, 5), (2b) */
    double *inverse, *response, *reaction;            /* (n, n); (2n, 2b) to forces; (2b, 2b) */
    double *rates, *spare, *right;                    /* (n, n), (n, n); (2n) */
    size_t masses;                                    /* bearings that add mass */
    double *mass, *mass_by, *acceleration, *joint;    /* (3b), (b, 3, 4), (2b), (2b, 2b) */
    double shift, speed;                              /* of the inverse; shift 0 as long as there is none */
} rf_mounted;

/* The functions `take`, `release` and `solve` of an rf_kernel_type. */
int rf_mounted_take(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why);
void rf_mounted_release(void *kernel);
void rf_mounted_solve(void *kernel, double *b);

/* What depends on shift and speed only: the inverse, and the response of the free rotor to the forces. */
void rf_mounted_invert(rf_mounted *self, double shift, double speed);
/* Inverse of I - (forces by motion) (motion by forces): the bearings close the loop. After both, `solve` is ready. */
int rf_mounted_close_loop(const rf_mounted *self, rf_message *why);

/* A bearing that adds the mass M of its oil to its journal, whose acceleration is a = V x', answers f - M a. With the
   forces without mass, and x' without any of these forces: make them those with mass. RF_NOT_FINITE if there are none. */
int rf_mounted_load(const rf_mounted *self, const double *dx);
/* The accelerations of the journals by x'. */
void rf_mounted_accelerate(const rf_mounted *self, const double *dx);
/* Add M a, or -M a, to forces. */
void rf_mounted_add_inertia(const rf_mounted *self, double sign, double *forces);
/* Take the slopes of M a by the motion at x', and shift M by the velocity, from the slopes of the forces. */
void rf_mounted_slope_masses(const rf_mounted *self, const double *dx, double shift);

#endif
