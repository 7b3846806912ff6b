/* A film that conserves its oil around a journal that moves: what it remembers, and how it follows.

   The motion of the journal is (x, y, vx, vy, speed) [m, m/s, rad/s]. On the way between two motions the journal goes
   along the cubic with the positions and velocities of both, the speed along a line. */
#ifndef ROTORFILM_OIL_TRAVEL_H
#define ROTORFILM_OIL_TRAVEL_H

#include "../status.h"
#include "oil_steps.h"

enum { RF_MOTION = 5 };

/* The film in SI units, and how long its inner steps may be. */
typedef struct rf_oil_film_si {
    rf_oil_shape shape;
    double clearance;     /* [m] */
    double carrying;      /* of the speed, that with which the walls carry the oil: 1/2, or 0 of a race that does not spin */
    double force, oil;    /* units of the force [N s] and of the oil [m3] */
    double largest_angle; /* of the shaft in an inner step [rad] */
    double largest_way;   /* of the journal in an inner step, in clearances */
} rf_oil_film_si;

/* What the film remembers is a block of numbers: the length of the last inner step [s], the motion at its end, the sums
   there as of oil_shape.h in N, m3/s and m3 and the mean flows [m3/s] of the last step, so that these times its length are
   what the oil in the gap has changed by; what the flows were in the last inner step [m3]; and of the cells theta H, the same before the last step, P, theta, and 1
   in cells that are full. */
enum {
    RF_OIL_LENGTH = 0,
    RF_OIL_MOTION = 1,
    RF_OIL_ANSWER = RF_OIL_MOTION + RF_MOTION,
    RF_OIL_MEANS = RF_OIL_ANSWER + RF_OIL_SUMS,
    RF_OIL_FLOWS = RF_OIL_VOLUME - RF_OIL_OUT,
    RF_OIL_PASSED = RF_OIL_MEANS + RF_OIL_FLOWS,
    RF_OIL_CELLS = RF_OIL_PASSED + RF_OIL_FLOWS,
    RF_OIL_ANSWERS = RF_OIL_PASSED - RF_OIL_ANSWER,
    RF_OIL_ROWS = 5
};

size_t rf_oil_numbers(const rf_oil_shape *shape);

/* One block for what is new, and the work of a step. */
typedef struct rf_oil_traveler {
    const rf_oil_film_si *film;
    size_t all;
    double *block, *gap, *slopes;
    rf_oil_found found;
    rf_oil_room room;
} rf_oil_traveler;

/* RF_OK or RF_MEMORY. */
int rf_open_traveler(rf_oil_traveler *self, const rf_oil_film_si *film, rf_message *why);

void rf_close_traveler(rf_oil_traveler *self);

/* Begin with the steady film of a journal at rest in a motion. RF_AT_WALL, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_begin(const rf_oil_film_si *film, const double *motion, double *block, rf_message *why);

/* Go on from t by dt to a motion, in inner steps, all of them halved where the film is not found. The block stays as it
   was unless the answer is RF_OK. `work` counts inner steps and solutions. RF_AT_WALL, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_travel(const rf_oil_film_si *film, double t, const double *motion, double dt, double *block,
                                 int64_t *work, rf_message *why);

/* Try one inner step to a motion and leave the block as it is: `end` is the block there, and unless NULL `stiffness` is
   -d force / d (x, y) [N/m], 2 x 2. Of the block `near` it takes the cells that are full.
   Theta as the last two contents foresee it, in the gap of the trial and 1 in cells that are full in `near`, says by how
   much transport differs from that of upstream values. RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_attempt(const rf_oil_film_si *film, const double *block, const double *near, const double *motion,
                                  double dt, double *end, double *stiffness, int64_t *work);

/* The same in a traveler, which may go on to another trial; `end` may be `near`. Adds to the solutions. */
int rf_try_oil(rf_oil_traveler *self, const double *block, const double *near, const double *motion, double dt, double *end,
               double *stiffness, int64_t *solutions);

#endif
