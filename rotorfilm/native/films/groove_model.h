/* What the kernels of journal bearings with openings share: their map as tables coefficients (x, theta, s) and center
   (phi), in the angles the last five repeating the first, and map (4: length/diameter, reach, squeeze, axis [rad]). */
#ifndef ROTORFILM_GROOVE_MODEL_H
#define ROTORFILM_GROOVE_MODEL_H

#include "groove_kernel.h"
#include "../kernels/kernel.h"

int rf_take_groove_map(const rf_tables *tables, rf_groove_map *map, rf_message *why);

/* RF_INVALID unless the parameters of a journal have the length/diameter of the map. */
int rf_judge_slenderness(const rf_groove_map *map, const double *parameters, rf_message *why);

#endif
