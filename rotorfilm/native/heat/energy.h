/* The temperature of the oil in a film, over it or over and across it, with openings that mix, bush and journal.

   Cells of N lines, M on each, are cut into K layers of equal share of the gap from the bush to the journal; of one layer
   the temperature is the mean of a parabola between the walls. Oil takes its temperature along, upwind, shear makes heat,
   and the walls take some of it. Temperatures are above that of fresh oil [K], flows are in units of c R L/2 [1/s]. */
#ifndef ROTORFILM_ENERGY_H
#define ROTORFILM_ENERGY_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "../status.h"

/* Integrals over layers of oil of fluidity f across the gap, eta = 0 at the bush (Dowson, 1962), the fluidity and the
   last five of them columns x layers:

       F_0 = int f,  y = int f eta/F_0,  F_2 = int f eta (eta - y),

   the flow of each layer over U h where the journal drags, and over -h^3 p_x; its shares of the heat of the drag and of
   that of the pressure, and of U h p_x of half the heat of both together. */
RF_EXPORT_LOOP void rf_layer_shares(size_t columns, size_t layers, const double *fluidity, double *F0, double *F2,
                                    double *dragged, double *pressed, double *sheared, double *squeezed,
                                    double *crossed);

typedef struct rf_energy {
    size_t lines, cells, layers, openings; /* of the openings that all round at mid-length is the last */
    int32_t walls;                         /* whether they take heat */
    int32_t backward;                      /* whether the oil runs against the order of the lines */
    const int32_t *opening; /* N x M: of a cell, -1 in film */
    /* N x M, as in `FilmFlow`; `central`, N, is NULL without a groove all round. */
    const double *dragged, *pressed, *axial, *entering, *leaving, *shear, *dissipation, *climb, *central;
    const double *viscosity, *thinning, *temperature; /* N x M x K: the heat falls from that temperature on */
    double speed, heat_scale, diffusion;
    double carry_over; /* share of the oil that arrives at openings and goes on; below 0 nothing leaves there */
    /* Of the walls: bush T = mean + spread q, give (mean - ambient) = take sum q, q being the heat of a line;
       journal shaft_give (T - shaft_ambient) = shaft_take x its heat. */
    const double *spread; /* N x N */
    double give, take, ambient, shaft_give, shaft_take, shaft_ambient;
} rf_energy;

/* Where the heat goes [K/s], and the temperature of the journal. */
typedef struct rf_heat_account {
    double made, leaked, drained, to_bush, to_journal, journal;
} rf_heat_account;

/* Set the temperatures of the oil (N x M x K, in openings that of the mixed oil), of the openings and of the bush (N, or
   NULL), and the heat that is made (N x M x K). RF_STUCK, RF_MEMORY. */
RF_EXPORT_LOOP int rf_solve_energy(const rf_energy *given, double *oil, double *openings, double *bush, double *made,
                                   rf_heat_account *account);

#endif
