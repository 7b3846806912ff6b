/* The map of a squeeze film among the tables of a damper's kernel. */
#ifndef ROTORFILM_DAMPER_MAP_H
#define ROTORFILM_DAMPER_MAP_H

#include "../kernels/kernel.h"
#include "map_kernel.h"

/* Take coefficients (x, t), center (1), reach (1) and wall (2: length/diameter and share of the film at the wall), or
   answer RF_INVALID with the message. */
int rf_take_damper_map(rf_map *map, const rf_tables *tables, rf_message *why);

#endif
