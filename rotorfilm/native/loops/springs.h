/* Springs and dampers behind an address, as rf_journal_at: of is K and C row by row. */
#ifndef ROTORFILM_SPRINGS_H
#define ROTORFILM_SPRINGS_H

#include "../export.h"

RF_EXPORT_LOOP int rf_springs_at(const void *of, const double *state, double *f, double *jacobian);

#endif
