/* A journal's film at one temperature of its oil: the heat that it makes and takes along, and the temperature at which
   they balance.

   With the power P = mu(T) A into the oil and the flow Q of fresh oil that replaces what leaks,

       A mu(T) = volumetric_heat Q (T - supply) + conductance (T - ambient)                                        (1)

   has one root T, since the left side falls and the right side rises. Without openings Q is what leaks. */
#ifndef ROTORFILM_HEATED_FILM_H
#define ROTORFILM_HEATED_FILM_H

#include <stdint.h>

#include "groove_losses.h"
#include "../films/journal_kernel.h"

/* ln viscosity over temperature: uniform quintic splines, beyond the range an exponential. */
typedef struct rf_oil {
    int32_t cells;      /* of [coldest, hottest] */
    const double *ln;   /* cells + 5 coefficients */
    double coldest, hottest; /* K */
} rf_oil;

typedef struct rf_heated {
    rf_journal journal; /* at unit viscosity */
    rf_loss loss;
    const void *loss_data;
    const rf_loss_map *openings; /* NULL without; then also the data of the losses */
    rf_oil oil;
    double radius, length, clearance;    /* m */
    double supply, ambient, conductance; /* K, K, W/K */
    double volumetric_heat;              /* J/(m3 K) */
    double carry_over;                   /* share of what arrives at an opening that goes on */
    int32_t full_gap;                    /* oil fills the gap also where the film is ruptured */
} rf_heated;

/* The film at unit viscosity: force, power A, flow Q, and what of it leaks. */
typedef struct rf_heat {
    double force[2], drag, flow, leak; /* N, W, m3/s, m3/s */
} rf_heat;

/* Derivatives of these by x, y, vx, vy, speed. */
typedef struct rf_heat_slopes {
    double force[10], drag[5], flow[5], leak[5];
} rf_heat_slopes;

/* Viscosity, and the first two derivatives of its logarithm by the temperature. */
typedef struct rf_viscosity {
    double value, thins, bends; /* Pa s, 1/K, 1/K2 */
} rf_viscosity;

/* At a temperature. RF_OUTSIDE beyond the range. */
int rf_oil_viscosity(const rf_oil *oil, double temperature, rf_viscosity *at);

/* The same a step further, of milli-kelvins: what is left out is of third order. */
void rf_advance_viscosity(rf_viscosity *at, double step);

/* The film at a state x, y, vx, vy, speed and, unless NULL, its slopes. */
RF_EXPORT_LOOP int rf_heat_at(const rf_heated *film, const double *state, rf_heat *heat, rf_heat_slopes *slopes);

/* Heat made less heat taken away at a temperature with its viscosity [W], and its derivative by the temperature. */
double rf_heat_surplus(const rf_heated *film, const rf_heat *heat, double temperature, const rf_viscosity *mu);
double rf_heat_slope(const rf_heated *film, const rf_heat *heat, const rf_viscosity *mu);

/* The root of (1), and the viscosity there, by Halley's method. RF_STUCK if nothing takes the heat away, RF_OUTSIDE
   beyond the range of the oil. */
int rf_balance(const rf_heated *film, const rf_heat *heat, double *temperature, rf_viscosity *mu);

/* Force f[2], temperature and, unless NULL, jacobian[2][5] of the film that at every state has the temperature of
   its balance. */
RF_EXPORT_LOOP int rf_balanced_at(const rf_heated *film, const double *state, double *f, double *jacobian,
                                  double *temperature);

/* A film whose temperature is a state. */
typedef struct rf_warming {
    rf_heated film;
    double per_capacity; /* K/J */
} rf_warming;

/* Force and rate of the temperature [K/s] of an rf_warming at a state x, y, vx, vy, speed, temperature: f[3] and, unless
   NULL, jacobian[3][6]. RF_INVALID where the oil is not known. */
RF_EXPORT_LOOP int rf_warming_at(const void *of, const double *state, double *f, double *jacobian);

/* n states in rows of n, x, y, vx, vy, speed; rows of forces (2), temperatures and, unless NULL, Jacobians (10). */
RF_EXPORT_LOOP int rf_balanced_batch(const rf_heated *film, size_t n, const double *states, double *f,
                                     double *temperature, double *jacobian, size_t *first);

#endif
