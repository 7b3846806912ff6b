/* Shear and flow of the films of pads with recesses. */
#ifndef ROTORFILM_RECESS_LOSSES_H
#define ROTORFILM_RECESS_LOSSES_H

#include "recess.h"

#define RF_RECESS_LOSSES 7

/* Of each pad at state[5] a row of losses (count x RF_RECESS_LOSSES): the force of its film x, y in units of viscosity
   R^3 L/c_p^2; what pressure on the steps adds to the torque, over half of the same and c_p, per rate; Sigma, the
   integral of 1/H over film and streamers, and that of a gap full of oil; what enters at the edge that the oil meets
   first, and what comes to the other, in units of c_p R L. Sigma and the flows are those of a journal that rests there:
   the oil runs along at half the speed.

   Streamers keep the thickness at which a film ended, in a recess and beside it; behind the edge of a pad they have
   that of the gap. A film begins only where they bring what it takes. RF_AT_WALL, RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_recess_losses(const rf_recess *bearing, const double *state, double *losses);

#endif
