/* Reynolds' equation with any conductances on a ring of lines with nodes on each.

   Oil flows from node to node in proportion to the fall of pressure, and out of the last node of a line to the
   ambient pressure 0. In the film what flows out of a node is its source; elsewhere the pressure is 0, and
   nothing is left to flow out (complementarity), or it is held. */
#ifndef ROTORFILM_STENCIL_H
#define ROTORFILM_STENCIL_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "../status.h"

/* Rows of lines x nodes. */
typedef struct rf_stencil {
    size_t lines, nodes;
    const double *around; /* conductance to the next line */
    const double *along;  /* to the next node of the line */
    const double *source; /* that drives oil out of a node */
    const uint8_t *held;  /* nodes whose pressure is given */
} rf_stencil;

/* Set the pressure, which comes with its values at nodes that are held, and the nodes that are full, which
   come as a guess. The right-hand sides `answers` (count x lines x nodes) are then replaced by solutions of the
   same film, 0 where it is not full. RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_stencil_film(const rf_stencil *stencil, double *pressure, uint8_t *full, size_t count,
                                   double *answers);

#endif
