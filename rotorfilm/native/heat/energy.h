/* The temperature of the oil in a film, over it or over and across it, with openings that mix, bush and journal.

   Cells of N lines, M on each, are cut into K layers of equal share of the gap from the bush to the journal; of one layer
   the temperature is the mean of a parabola between the walls. Oil takes its temperature along, upwind, and the walls
   take some heat. Temperatures are above that of fresh oil [K], flows are times the heat capacity of the oil [W/K]. */
#ifndef ROTORFILM_ENERGY_H
#define ROTORFILM_ENERGY_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "../status.h"

typedef struct rf_energy {
    size_t lines, cells, layers, openings; /* of the openings that all round at mid-length is the last */
    int32_t walls;                         /* whether they take heat */
    int32_t backward;                      /* whether the oil runs against the order of the lines */
    double carry_over; /* share of the oil that arrives at openings and goes on; below 0 nothing leaves there */
    const int32_t *opening; /* N x M: of a cell, -1 in film */
    const double *central;  /* N x K: flow from a groove all round at mid-length, or NULL */
    const double *around, *axial; /* N x M x K: flow through the faces after a line and after a cell, the last the end */
    const double *fresh;          /* N x M x K: oil from outside, or lost to there if below 0 */
    const double *heat, *less;    /* N x M x K: heat that is made at no temperature, and by how much less per kelvin */
    const double *between; /* N x M x K - 1: conducted from a layer to the next one, per kelvin */
    /* N x M x 3: into a wall per kelvin of the layer beside it above the wall, and per kelvin of what is beyond, the next
       layer or of one layer the other wall; and the share of the heat made in the layer that goes there at once. */
    const double *beside;
    /* Of the walls: bush T = mean + spread q, give (mean - ambient) = take sum q, q being the heat of a line;
       journal shaft_give (T - shaft_ambient) = shaft_take x its heat. */
    const double *spread; /* N x N */
    double give, take, ambient, shaft_give, shaft_take, shaft_ambient;
} rf_energy;

/* Set the temperatures of the oil (N x M x K, in openings that of the mixed oil), of openings and bush (N), and the heat
   [W] that leaves through openings, goes into bush and journal, and the journal's temperature. RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_solve_energy(const rf_energy *given, double *oil, double *openings, double *bush, double *account);

#endif
