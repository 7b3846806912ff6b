/* Time integration of a rotor in modes on films: collocation of the film forces.

   The unknowns of a step are the forces at its nodes only, so Newton's method solves 2 n_bearings s equations
   for a rotor of any size. With Radau's nodes the method has order 2 s - 1 where films and modes are slow and
   s + 1 uniformly; its local error is read from the force at the start of the step, which the polynomial does
   not know. */
#ifndef ROTORFILM_MARCH_H
#define ROTORFILM_MARCH_H

#include "../films/film.h"
#include "collocation.h"

/* The journals: forces at states (x, y, vx, vy, speed) as of rf_journal_at, beside springs and dampers that
   the rotor rests on and that are given back here. */
typedef struct rf_journals {
    int32_t count;
    const rf_response *films;
    const void *const *of;
    const double *rest;            /* 4 n: motion about which that of the rotor is counted */
    const double *spring, *damper; /* 2 n [N/m], [N s/m] */
    const double *lengths;         /* n: clearances [m] */
} rf_journals;

/* Speed over time, linear between the times. */
typedef struct rf_speeds {
    int32_t count;
    const double *times, *speeds, *slopes, *angles; /* slopes after the times, angles turned since t = 0 */
} rf_speeds;

#define RF_SLOTS 24   /* lengths of steps whose tables are kept */
#define RF_STEPS 400  /* lengths of steps: the longest over 2^(k/4) */

typedef enum rf_march_end {
    RF_MARCH_DONE = 0,
    RF_MARCH_WALL = 1,   /* a journal reaches the wall */
    RF_MARCH_SHORT = 2,  /* steps become too short */
    RF_MARCH_BUSY = 3,   /* the budget of steps is spent */
    RF_MARCH_BROKEN = 4, /* a force is not finite, or Newton's method does not end */
    RF_MARCH_MEMORY = 5
} rf_march_end;

typedef struct rf_march {
    rf_modes rotor;
    rf_scheme scheme;
    rf_journals journals;
    rf_speeds profile;
    const double *scales; /* 4 n: make x, y, vx, vy of each journal dimensionless */
    double longest, shortest; /* step [s] */
    double rtol, newton;      /* local error, and what Newton's method leaves of it */
    rf_step_table *tables;    /* RF_SLOTS + 1: the last is for steps that happen once */
    int32_t slot_of[RF_STEPS], step_of[RF_SLOTS], next_slot; /* -1: none */
    int32_t step, left_map;   /* the length of the next step; whether a film was asked beyond its map */
    double time;
    int64_t films, jacobians, steps, rejected; /* work done */
    rf_complex *z;            /* modal coordinates */
} rf_march;

/* Go on to `stop`, or for `budget` steps, and write the modal coordinates at the times of `grid` passed, of
   count, from *place on. Answers an rf_march_end. */
RF_EXPORT_LOOP int rf_march_to(rf_march *march, double stop, int64_t budget, const double *grid, int64_t count,
                          int64_t *place, rf_complex *out);

/* Forces of films and springs (2 n rows) and slopes by x, y, vx, vy (2 n x 4 rows) of motions (4 n rows), rows
   of `samples`, at one speed; the most severe status. */
RF_EXPORT_LOOP int rf_journal_forces(const rf_journals *journals, int64_t samples, const double *motion,
                                double speed, double *force, double *slope);

#endif
