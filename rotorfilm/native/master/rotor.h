/* A rotor over a macro step: stepped by itself under a held force or a force law, or integrated here. */
#ifndef ROTORFILM_ROTOR_H
#define ROTORFILM_ROTOR_H

#include "law.h"
#include "partner.h"

enum { RF_HELD, RF_LAWFUL, RF_INTEGRATED };

#define RF_DEGREE 6
#define RF_NODES (RF_DEGREE + 1)

typedef struct rf_rotor {
    rf_partner *partner;
    int32_t mode, stations;
    size_t outputs;
    const uint32_t *output_refs, *motion_refs; /* all outputs; positions and velocities of all journals */
    const uint32_t *drive_refs;                /* what a step under a law sets: forces, or the law's inputs */
    const uint32_t *rows, *columns; /* of the derivatives: rates and motion by states and forces */
    /* Of one that is integrated here by the exponential (cosim/schemes.py). */
    double *x;
    const double *nominal, *base; /* of the states; forces where the motion is asked for */
    const double *nodes, *to_powers;
    double kink;   /* next time at which the rates have one */
    int32_t known; /* whether the derivatives are of use */
    double *slopes; /* (states + 2 m, states + m) */
    double *work;   /* rf_rotor_work(states, m) numbers */
} rf_rotor;

enum { RF_ROTOR_FAILS = 1, RF_ROTOR_WAITS = 2 };

RF_EXPORT_MASTER size_t rf_rotor_work(size_t states, size_t m);

/* Advance from t to t + dt. RF_ROTOR_WAITS where the rotor has a kink there, or cannot be integrated by the
   exponential: it then is where it was. RF_ROTOR_FAILS where a call failed. */
int rf_drive(rf_rotor *rotor, double t, double dt, const rf_law *law);

#endif
