/* A bush with wear depths at nodes of its liner (bearings/bush/bush_reaction.py): its contact and its wear. */
#ifndef ROTORFILM_WORN_BUSH_H
#define ROTORFILM_WORN_BUSH_H

#include "bush.h"
#include "bush_profile.h"

#define RF_LEAST_ANGLE 1e-9 /* stands for no contact in the heat balance */

enum {
    RF_WEAR_ROWS = 8, /* of the extrapolation */
    RF_WEAR_WORK = 9 + RF_WEAR_ROWS
};

typedef struct rf_worn_bush {
    rf_bush bush;
    rf_bush_profile profile; /* scratch, as are the arrays behind it */
    int local, given; /* each point melts by itself; the temperature is one that the model was given */
    double center, extent, retardation;
    double held, gap, grip; /* temperature of the contact, clearance and friction there */
    double unit, friction; /* force of a unit of load; friction with its sign */
    double work, losses, losses_slope, kept;
    double *scratch[RF_WEAR_WORK];
} rf_worn_bush;

/* At node i, in shear moduli. */
double rf_worn_pressure(const rf_worn_bush *m, size_t i);
/* Only a contact that is held at the melting point wears. */
int rf_worn_melts(const rf_worn_bush *m);
/* Depths, loads and heat at wear depths x under the input u. */
void rf_worn_press(rf_worn_bush *m, const double *x, const double *u);
/* Rate of wear at node i. */
double rf_worn_rate(const rf_worn_bush *m, size_t i);
/* d(rate)/d(pressure of the node itself), and the part g of d(rates) = g (what the whole contact changes). */
void rf_worn_rate_slopes(const rf_worn_bush *m, size_t i, double *own, double *whole);
/* What the whole contact changes where the sum of the loads changes by `total` and half the angle by `angle`. */
double rf_worn_whole_change(const rf_worn_bush *m, double total, double angle);

/* Wear the depths x under held inputs u for a time dt, from a contact that was pressed at x. */
int rf_worn_advance(rf_worn_bush *m, const double *u, double dt, double *x, rf_message *why);

#endif
