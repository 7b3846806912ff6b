/* The contact of a rigid shaft that rubs in a polymer liner under a load, worn or not (bearings/bush/wear_at_nodes.py). */
#ifndef ROTORFILM_BUSH_CONTACT_H
#define ROTORFILM_BUSH_CONTACT_H

#include "bush.h"

/* Half the contact angle and what follows from it alone. */
typedef struct rf_bush_arc {
    double a, sin, cos, segment, moment;
    double F, F_slope; /* segment/cos */
    double weight;     /* mean pressure of a unit of load (2.15) */
} rf_bush_arc;

/* What it must bear: the wear moment W, the load N per force unit, and |speed|. */
typedef struct rf_bush_demand {
    double moment, load, speed;
} rf_bush_demand;

typedef struct rf_bush_contact {
    rf_bush_arc at;
    double temperature; /* [K] */
    int melting;        /* whether it is held at the melting point */
} rf_bush_contact;

/* Logarithmic derivative of the weight by the angle. */
double rf_bush_of_weight(const rf_bush_arc *at);
/* All that follows from half the contact angle a. */
void rf_bush_see(double a, rf_bush_arc *at);
/* Clearance c(T), and friction heat per area and friction. */
double rf_bush_gap(const rf_bush *b, double T);
double rf_bush_sliding(const rf_bush *b, const rf_bush_arc *at, const rf_bush_demand *d);
/* Derivatives of (losses - friction heat) by the angle, T, N and |speed|. */
void rf_bush_heat_slopes(const rf_bush *b, const rf_bush_arc *at, double T, const rf_bush_demand *d, double by[4]);
/* What a point of the kernel "bush_wear" demands. */
int rf_bush_read(const rf_bush *b, const rf_point *at, rf_bush_demand *d, rf_message *why);
/* The contact at the melting point, the widest there can be, and its steady temperature. */
void rf_bush_find_hot(const rf_bush *b, const rf_bush_demand *d, rf_bush_contact *c);
/* The contact as it is; RF_STUCK at the brink of thermal runaway. */
int rf_bush_find(const rf_bush *b, const rf_bush_demand *d, rf_bush_contact *c, rf_message *why);
/* Friction heat that is left over at the melting point, per area. */
double rf_bush_surplus(const rf_bush *b, const rf_bush_contact *c, const rf_bush_demand *d);
/* Melting heat per contact area that raises W by one. */
double rf_bush_heat_per_moment(const rf_bush *b, const rf_bush_arc *at);

#endif
