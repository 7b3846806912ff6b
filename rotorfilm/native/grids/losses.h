/* Shear and flow of the two-dimensional film: what decides its power loss and the oil that leaves it.

   The oil, film and streamers, is followed around in the direction in which it runs. Behind a film streamers keep the
   thickness H_r at which it ended, and what a film beside them adds on the way; behind an opening they have that of
   its downstream edge. A film between openings begins only where they bring what it takes: nodes where it would
   begin from nothing are shut, one line after the other. Beside openings that end within the bearing it begins
   where Reynolds' equation says. */
#ifndef ROTORFILM_LOSSES_H
#define ROTORFILM_LOSSES_H

#include "levels.h"

/* Shear integral of the film and of the streamers, flow out of both ends; then the flow that leaves each opening, and
   what arrives at each. */
#define RF_RING_LOSSES 3

/* Losses of n states, rows of n one stride apart: (RF_RING_LOSSES + 2 openings) x n, openings in the order of their
   lines, a groove all round last. The oil runs along the film at `rate` (n) [1/s], half the speed of a journal between
   walls that rest; its sign says where downstream is. */
RF_EXPORT_LOOP int rf_ring_losses(const rf_ring *ring, size_t n, const double *e, const double *w, const double *rate,
                             double *losses, size_t *first);

/* By the balance of the half cells that end the film, without openings and what a film in tension draws in. */
double rf_flow_out_of_ends(const rf_levels *film);

/* Shear integrals of the film, of the streamers, and of a gap full of oil; what enters a pad at the edge that the oil
   meets first, and what comes to the other. */
typedef struct rf_pad_oil {
    double film, streamers, gap, entering, leaving;
} rf_pad_oil;

/* The oil of the pad of a ring, the journal being placed at q, for drive[5]; RF_STUCK, RF_MEMORY. */
int rf_follow_pad(rf_levels *film, const double *q, const double *drive, rf_pad_oil *oil);

#endif
