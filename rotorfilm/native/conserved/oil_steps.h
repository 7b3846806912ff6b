/* Steps in time of a film that conserves its oil, from what it remembers to a gap. */
#ifndef ROTORFILM_OIL_STEPS_H
#define ROTORFILM_OIL_STEPS_H

#include "oil_search.h"
#include "oil_shape.h"

#define MOST_GROWTH 2.0 /* of a step over the last one, up to which differences take both (stable to 2.41) */

/* Oil theta H of every cell, now and before the last step, N x M; the length of that, 0 where there was none. */
typedef struct rf_oil_past {
    const double *content, *before;
    double length;
} rf_oil_past;

/* The work of steps of a film, and the equations of the last one. */
typedef struct rf_oil_room {
    rf_oil_cells cells;
    rf_oil_solver solver;
    double *numbers, *old, *carried;
} rf_oil_room;

/* RF_OK or RF_MEMORY. */
int rf_open_room(rf_oil_room *room, const rf_oil_shape *shape);

void rf_close_room(rf_oil_room *room);

/* A film. Where one is sought, theta and `full` come as those of a film nearby. */
typedef struct rf_oil_found {
    double *pressure, *theta; /* N x M */
    uint8_t *full;
    double *old; /* N x M: what the storage of the step held */
    double rate; /* of that storage */
    double lag;  /* how the step differs: rate dt change = dt flow + lag times the change in the step before */
    rf_oil_work work;
    rf_oil_room *room; /* that of several steps, or NULL */
} rf_oil_found;

/* What leaves the cells, N x M, beyond transport at upstream theta: at a face theta is that upstream plus d- d+/(d- + d+)
   where both have one sign (van Leer 1974), d- and d+ being the differences before and behind that cell. */
RF_EXPORT_LOOP void rf_sharpen_oil(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, const double *theta,
                                   double *carried);

/* The film after a step of length dt in the gap at its end, where walls carry the oil with a speed of `rate`: by
   differences of second order of the last two contents; of first order where there was no step before, or one less
   than half as long, or where the former would take more from a cell than it has. Theta that comes in `found`
   tells by how much transport differs from that of upstream values. RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_step(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, const rf_oil_past *past,
                               double dt, rf_oil_found *found);

/* The steady film that steps in a gap that stays come to. RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_rest(const rf_oil_shape *shape, const rf_oil_gap *gap, double rate, rf_oil_found *found);

#endif
