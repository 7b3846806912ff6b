/* Springs behind an address, as rf_journal_at. */
#ifndef ROTORFILM_SPRINGS_H
#define ROTORFILM_SPRINGS_H

#include "../films/film.h"

/* A spring and a damper: of is K and C row by row. */
RF_EXPORT_LOOP int rf_springs_at(const void *of, const double *state, double *f, double *jacobian);

/* An rf_sprung: a film beside equal springs along x and y; one whose journal does not spin is asked at speed 0. */
typedef struct rf_sprung {
    rf_response film;
    const void *of;
    double stiffness; /* [N/m] */
    int still;
} rf_sprung;

RF_EXPORT_LOOP int rf_sprung_at(const void *of, const double *state, double *f, double *jacobian);

#endif
