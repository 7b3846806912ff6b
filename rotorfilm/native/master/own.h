/* Kernels of this library as partners. Functions answer an rf_status, with 0 for what is beyond the verified
   range of a model, which is counted. */
#ifndef ROTORFILM_OWN_H
#define ROTORFILM_OWN_H

#include "partner.h"

int rf_own_put(rf_own *own, const uint32_t *references, size_t count, const double *values);
int rf_own_take(rf_own *own, const uint32_t *references, size_t count, double *values);
int rf_own_rate(rf_own *own, double *rates);
int rf_own_slopes(rf_own *own, const uint32_t *unknowns, size_t rows, const uint32_t *knowns, size_t columns,
                  double *matrix);

#endif
