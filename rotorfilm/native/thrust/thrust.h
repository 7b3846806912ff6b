/* A thrust bearing of equal sector pads, evenly around the shaft, fixed or on pivots.

   The collar at (z, a, b), its rates (vz, va, vb), the speed about +z. Pads that push towards +z see q = (gap + z, a, b);
   those that push towards -z see (gap - z, -a, -b) and push the other way. Each has a frame of its own, turned about z.
   A pad on a pivot, which lies on its X axis, adds to its gap A_t s_t + A_r s_r, with s_t along the rotation and s_r
   outward from the pivot. It has no mass: its rates are those at which no moment acts about the pivot. */
#ifndef ROTORFILM_THRUST_H
#define ROTORFILM_THRUST_H

#include "film_table.h"

#define RF_THRUST_INPUTS 7 /* z, a, b, vz, va, vb, speed */

typedef struct rf_thrust {
    rf_sector pad;
    size_t count;
    double first; /* angle of the frame of the first pad [rad] */
    double side;  /* 1 pushes towards +z, -1 the other way */
    double gap;   /* over the lands of the pads, with the collar at 0 [m] */
    double pivot; /* radius at which pivots are [m] */
    int32_t tilts; /* of a pad: none, A_t, or A_t and A_r */
    int32_t held;  /* whether they stay where they are */
    rf_film_table table; /* which answers within its range, if it has functions */
} rf_thrust;

/* Derivatives by the states and inputs, as of a kernel: A and B of the rates, C and D of y. */
typedef struct rf_thrust_slopes {
    double *A, *B, *C, *D;
} rf_thrust_slopes;

/* Force, moments and torque y[4] on the shaft for states x (count x tilts) and u[7]; rates of the states and slopes,
   unless NULL. RF_UNDEFINED for slopes where nothing drives the film; RF_AT_WALL, RF_NOT_FINITE, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_thrust_at(const rf_thrust *bearing, const double *x, const double *u, double *y, double *rates,
                                const rf_thrust_slopes *slopes);

/* Set the states, which come as a guess, to those that rest with a collar at rest; RF_STUCK where Newton finds none. */
RF_EXPORT_LOOP int rf_thrust_rest(const rf_thrust *bearing, const double *u, double *x);

/* Place q[3] and w[4] of the film of one pad, of states that change at these rates. */
RF_EXPORT_LOOP void rf_thrust_place(const rf_thrust *bearing, size_t pad, const double *x, const double *rates,
                                    const double *u, double *q, double *w);

/* The least gap [m] of all pads for states and u. */
RF_EXPORT_LOOP double rf_thrust_least(const rf_thrust *bearing, const double *x, const double *u);

#endif
