/* Waves of oil through the cavity of a film in small motion, at one exponent.

   In the cavity oil is only carried along: a change of theta in a cell is (source + flow change of the cell upstream) /
   (own + storage), where the storage is complex. Pressure in the film feels no exponent. */
#ifndef ROTORFILM_OIL_WAVES_H
#define ROTORFILM_OIL_WAVES_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"

/* For each column of real sources (cells x columns) set in found[0] (inlets x columns) the change where the cavity ends,
   and in found[1] what comes of `by` times the changes as a source. Cells come in the order of the flow; up is -1 where
   it begins. Complex numbers are pairs. RF_OK or RF_MEMORY. */
RF_EXPORT_LOOP int rf_oil_waves(size_t cells, size_t columns, const int32_t *up, const double *own, const double *flow,
                                const double *source, const double *storage, const double *by, size_t inlets,
                                const int32_t *inlet, double *found);

#endif
