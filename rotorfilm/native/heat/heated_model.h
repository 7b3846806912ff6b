/* What the kernels of journal bearings whose oil warms share. Their models begin with the rf_heated_model.

   Parameters radius, length, clearance [m], supply_temperature, ambient_temperature [K], housing_conductance [W/K],
   bush_heat_capacity [J/K], volumetric_heat [J/(m3 K)], and those of the kernel; inputs x, y [m], vx, vy [m/s], speed
   [rad/s]; state the temperature [K]; outputs force_x, force_y [N], film_temperature [K], power_loss [W], side_flow
   [m3/s]. Tables: oil (n: quintic spline coefficients of ln viscosity), oil_range (2: lowest and highest temperature),
   full_gap (1), and those of the kernel. */
#ifndef ROTORFILM_HEATED_MODEL_H
#define ROTORFILM_HEATED_MODEL_H

#include "heated_film.h"
#include "../kernels/kernel.h"

typedef struct rf_heated_model {
    rf_heated film;
    double per_capacity; /* K/J */
    double u[5]; /* the last input, with its heat and status: held inputs ask again and again */
    rf_heat heat;
    int status;
    double t; /* a temperature near the last one, with its viscosity */
    rf_viscosity mu;
} rf_heated_model;

extern const rf_sizes RF_HEATED_SIZES;

/* The oil, and whether the gap is full, from their tables. */
int rf_take_oil(rf_heated_model *model, const rf_tables *tables, rf_message *why);

/* Dimensions and heat from the parameters, or RF_INVALID and nothing changed. */
int rf_set_heated(rf_heated_model *model, const double *parameters, rf_message *why);

/* The functions `output`, `derivative`, `jacobian` and `step` of an rf_kernel_type. */
int rf_heated_output(const void *kernel, const rf_point *at, double *y, rf_message *why);
int rf_heated_derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why);
int rf_heated_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why);
int rf_heated_step(void *kernel, const rf_point *at, double dt, double *x, rf_message *why);

#endif
