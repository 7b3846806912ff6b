/* One pad with a recess as a ring: its arc in spans, and the gap between its ends. */
#ifndef ROTORFILM_RECESS_PAD_H
#define ROTORFILM_RECESS_PAD_H

#include "levels.h"
#include "recess.h"

#define RF_GAP_LINES 2 /* of the finest grid, the first ones: those of the gap */

/* One pad at one state. */
typedef struct rf_over_pad {
    const rf_recess_pad *pad;
    double q[RF_FREEDOMS], drive[RF_DRIVES]; /* of the journal, from the pad's center of curvature */
    double start[4], extent[4];              /* of the spans */
    int32_t cells[4];                        /* of the finest grid on each */
    rf_ring ring;
    rf_levels film;
    void *memory;
} rf_over_pad;

/* Put the journal over a pad, without its grids. */
void rf_place_over_pad(rf_over_pad *at, const rf_recess *bearing, const rf_recess_pad *pad, const double *state);

/* The same with them, and the journal placed on all; RF_MEMORY, RF_AT_WALL. It is to be closed in any case. */
int rf_open_pad(rf_over_pad *at, const rf_recess *bearing, const rf_recess_pad *pad, const double *state);
void rf_close_pad(rf_over_pad *at);

/* Whether nothing drives its film. */
int rf_pad_rests(const rf_over_pad *at);

#endif
