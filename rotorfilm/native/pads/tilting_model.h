/* What the kernels of tilting-pad bearings share: pads without inertia, and with it.

   Parameters radius, length, clearance of a pad [m], viscosity [Pa s]; inputs x, y [m], vx, vy [m/s], speed [rad/s];
   outputs force_x, force_y [N] and the load of each pivot [N]; states as in tilting.h. Tables: pivots (N: angles
   [rad]), pads (7: extent [rad], offset of the pivot, preload, stiffness of a pivot [N/m] or 0, inertia over the square
   of its distance from the film [kg] or 0, mass that moves with a pivot [kg], length/diameter), and those of
   RF_PAD in map_table.h. */
#ifndef ROTORFILM_TILTING_MODEL_H
#define ROTORFILM_TILTING_MODEL_H

#include "../kernels/kernel.h"

/* The functions of an rf_kernel_type; `create` for pads with or without inertia. */
void *rf_create_tilting(const rf_tables *tables, int inertia, rf_sizes *sizes, rf_message *why);
void rf_destroy_tilting(void *kernel);
int rf_set_tilting(void *kernel, const double *parameters, rf_message *why);
int rf_tilting_output(const void *kernel, const rf_point *at, double *y, rf_message *why);
int rf_tilting_derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why);
int rf_tilting_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why);
int rf_tilting_factorize(void *kernel, const rf_point *at, double shift, rf_message *why);
void rf_tilting_solve(void *kernel, double *b);
void rf_tilting_drift(const void *kernel, const rf_point *at, double *slope);

#endif
