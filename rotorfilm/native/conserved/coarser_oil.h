/* The cells of a film with every second line and pairs along it, from which a search starts. */
#ifndef ROTORFILM_COARSER_OIL_H
#define ROTORFILM_COARSER_OIL_H

#include "oil_cells.h"

typedef struct rf_coarser_oil {
    rf_oil_cells cells;
    double *pressure, *theta;
    uint8_t *full;
    void *memory;
} rf_coarser_oil;

/* Whether cells go into pairs both ways, and are enough for it. */
int rf_has_coarser_oil(const rf_oil_cells *fine);

/* Make the cells, with pressure and theta as they are in openings; RF_OK or RF_MEMORY. Oil is kept, conductances
   are in series. */
int rf_open_coarser_oil(rf_coarser_oil *coarser, const rf_oil_cells *fine, const double *pressure,
                        const double *theta);

void rf_close_coarser_oil(rf_coarser_oil *coarser);

/* Set what of the finer cells is full: as the cell that they are part of. */
void rf_refine_full(const rf_coarser_oil *coarser, uint8_t *full);

#endif
