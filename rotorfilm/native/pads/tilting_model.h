/* What the kernels of tilting-pad bearings share: pads without inertia, and with it.

   Parameters radius, length, clearance of a pad [m], viscosity [Pa s]; inputs x, y [m], vx, vy [m/s], speed [rad/s];
   outputs force_x, force_y [N] and the load of each pivot [N]; states as in tilting.h. Tables: pivots (N: angles
   [rad]), pads (7: extent [rad], offset of the pivot, preload, stiffness of a pivot [N/m] or 0, inertia over the square
   of its distance from the film [kg] or 0, mass that moves with a pivot [kg], length/diameter), and those of
   RF_PAD in map_table.h. */
#ifndef ROTORFILM_TILTING_MODEL_H
#define ROTORFILM_TILTING_MODEL_H

#include "../films/map_kernel.h"
#include "../kernels/kernel.h"
#include "tilting.h"

#define RF_MOST_TILTING 50 /* pads */

typedef struct rf_tilting_model {
    rf_tilting bearing;
    rf_map map;
    double slenderness;
    size_t states, outputs;
    double pivots[2 * RF_MOST_TILTING];
    double rates[4 * RF_MOST_TILTING], forces[2 + RF_MOST_TILTING]; /* of one point */
    double *inverse, *matrix, *spare; /* (n, n), (n, n), n of pads with inertia */
    double *by[4]; /* B, C, D where only A is asked for */
} rf_tilting_model;

/* What `take` of an rf_kernel_type does for pads with or without inertia, and its other functions. */
int rf_take_tilting(rf_tilting_model *model, const rf_tables *tables, int inertia, rf_sizes *sizes, rf_message *why);
void rf_release_tilting(void *kernel);
int rf_set_tilting(void *kernel, const double *parameters, rf_message *why);
int rf_tilting_output(const void *kernel, const rf_point *at, double *y, rf_message *why);
int rf_tilting_derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why);
int rf_tilting_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why);
int rf_tilting_factorize(void *kernel, const rf_point *at, double shift, rf_message *why);
void rf_tilting_solve(void *kernel, double *b);
void rf_tilting_drift(const void *kernel, const rf_point *at, double *slope);

#endif
