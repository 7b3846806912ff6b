/* A ring that a rotor rubs in, and two forces on one journal, behind an address, as rf_journal_at. */
#ifndef ROTORFILM_RUB_H
#define ROTORFILM_RUB_H

#include "../films/film.h"

/* A ring with its gap, as bearings/rub.py has it. */
typedef struct rf_rub {
    double gap, stiffness, radius, friction, slip_velocity, dissipation, center[2];
} rf_rub;

RF_EXPORT_LOOP int rf_rub_at(const void *of, const double *state, double *f, double *jacobian);

/* Two forces on one journal; where one has no derivative, none has the sum. */
typedef struct rf_both {
    rf_response first;
    const void *of_first;
    rf_response second;
    const void *of_second;
} rf_both;

RF_EXPORT_LOOP int rf_both_at(const void *of, const double *state, double *f, double *jacobian);

#endif
