/* Time integration of a rotor in modes on films: collocation of the film forces.

   The unknowns of a step are the forces at its nodes only, so Newton's method solves 2 n_bearings s equations
   for a rotor of any size. With Radau's nodes the method has order 2 s - 1 where films and modes are slow and
   s + 1 uniformly; its local error is read from the force at the start of the step, which the polynomial does
   not know. */
#ifndef ROTORFILM_MARCH_H
#define ROTORFILM_MARCH_H

#include "collocation.h"
#include "journals.h"

/* Speed over time, linear between the times. */
typedef struct rf_speeds {
    int32_t count;
    const double *times, *speeds, *slopes, *angles; /* slopes after the times, angles turned since t = 0 */
} rf_speeds;

/* What the speed changes of a rotor whose modes are those of another one: rates of its modal coordinates, real
   parts and then imaginary ones, per rad/s that it turns faster. */
typedef struct rf_spin_rates {
    double speed;         /* of the modes */
    const double *matrix; /* 2 modes x 2 modes; NULL where the speed changes nothing, or is that of the modes */
    const double *rest;   /* 2 modes: at the rest about which motion is counted */
} rf_spin_rates;

/* What excites the rotor over time, as the ground that shakes: linear between the times, 0 before and after. */
typedef struct rf_excitation {
    int32_t count, rows; /* times and channels; 0 for none */
    const double *times, *values; /* values: rows x count */
} rf_excitation;

/* What drives a rotor whose speed is a state (motor.h). */
typedef struct rf_motor {
    rf_response torque;    /* torque and its slope at a state (time, speed); NULL where the speed is given */
    const void *of;
    const double *damping;  /* 2 x (2 modes + 1) squared: z' (R0 - w R1) z, z real and imaginary parts and 1, or NULL */
    double *turns;         /* 3 for each time of the grid: angle, speed and acceleration there */
    double inertia, rate;  /* rate: typical speed */
    double band;           /* how far the speed may leave that of the modes */
    double gravity[2];     /* g of motor.h */
    double angle, speed;   /* at the time of the march */
    double first;          /* acceleration at t = 0 */
} rf_motor;

#define RF_SLOTS 24   /* lengths of steps whose tables are kept */
#define RF_STEPS 400  /* lengths of steps: the longest over 2^(k/4) */

typedef enum rf_march_end {
    RF_MARCH_DONE = 0,
    RF_MARCH_WALL = 1,   /* a journal reaches the wall */
    RF_MARCH_SHORT = 2,  /* steps become too short */
    RF_MARCH_BUSY = 3,   /* the budget of steps is spent */
    RF_MARCH_BROKEN = 4, /* a force is not finite, or Newton's method does not end */
    RF_MARCH_MEMORY = 5,
    RF_MARCH_BAND = 6    /* the motor's speed has left that of the modes too far */
} rf_march_end;

typedef struct rf_march {
    rf_modes rotor;
    rf_scheme scheme;
    rf_journals journals;
    rf_speeds profile;
    rf_spin_rates spin;
    rf_excitation excitation;
    rf_motor motor;
    const double *scales; /* rows: make x, y, vx, vy of each journal dimensionless; 0 for accelerations */
    double longest, shortest; /* step [s] */
    double rtol, newton;      /* local error, and what Newton's method leaves of it */
    rf_step_table *tables;    /* RF_SLOTS + 1: the last is for steps that happen once */
    int32_t slot_of[RF_STEPS], step_of[RF_SLOTS], next_slot; /* -1: none */
    int32_t step, left_map;   /* the length of the next step; whether a film was asked beyond its map */
    double time;
    int64_t films, jacobians, steps, rejected, walls; /* work done; walls: of the rejected at a wall */
    rf_complex *z;            /* modal coordinates */
} rf_march;

/* Go on to `stop`, or for `budget` steps, and write the modal coordinates at the times of `grid` passed, of
   count, from *place on. Answers an rf_march_end. */
RF_EXPORT_LOOP int rf_march_to(rf_march *march, double stop, int64_t budget, const double *grid, int64_t count,
                          int64_t *place, rf_complex *out);

#endif
