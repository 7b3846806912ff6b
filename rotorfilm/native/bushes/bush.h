/* A polymer bush worn by melting (bearings/bush/bearing.py): what both of its kernels know. */
#ifndef ROTORFILM_BUSH_H
#define ROTORFILM_BUSH_H

#include "../kernels/kernel.h"

/* Parameters of both kernels; kernel "bush_reaction" has RETARDATION [s] and TEMPERATURE [K] besides. */
enum {
    RF_FRICTION,
    RF_OUTER = 3,
    RF_MELTING_HEAT = 5,
    RF_BUSH_PARAMETERS,
    RF_RETARDATION = RF_BUSH_PARAMETERS,
    RF_TEMPERATURE,
    RF_REACTION_PARAMETERS
};

/* Table "bush", in this order: lengths per liner radius where no unit is given. */
typedef struct rf_bush_numbers {
    double clearance, closing, compliance;
    double pressure_work;      /* [N/m] heat per area at unit pressure, friction and speed */
    double shaft, liner;       /* conductances [W/(m2 K)] */
    double melting;            /* point [K] */
    double whole;              /* 1 where the shaft takes heat all around (GlobalBalance), else 0 */
    double radius, shaft_radius, thickness; /* [m] */
    double force_unit;         /* [N] */
    double modulus;            /* [Pa] */
} rf_bush_numbers;

typedef struct rf_bush {
    rf_bush_numbers is;
    double friction[3];        /* f0, f1 [1/K], f2 [1/K2] */
    double outer[2];           /* D_0, D_1 [K] */
    double melting_heat;       /* [J/m3] */
    double gap;                /* c(T_*) */
    double grip;               /* f(T_*) */
} rf_bush;

int rf_bush_tables(rf_bush *bush, const rf_tables *tables, rf_message *why);
int rf_bush_parameters(void *bush, const double *p, rf_message *why);

/* a - sin(2 a)/2 and sin(a) - a cos(a), without cancellation. */
void rf_arc(double a, double sin_a, double cos_a, double *segment, double *moment);

double rf_bush_friction(const rf_bush *bush, double temperature);
/* Heat per area and kelvin that shaft and liner take; what they take at a temperature, and its derivative by a. */
double rf_bush_conductance(const rf_bush *bush, double a);
double rf_bush_losses(const rf_bush *bush, double a, double sin_a, double temperature);
double rf_bush_losses_slope(const rf_bush *bush, double a, double moment, double temperature);

#endif
