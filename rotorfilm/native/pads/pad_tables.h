/* The map of one pad in the tables of a kernel. */
#ifndef ROTORFILM_PAD_TABLES_H
#define ROTORFILM_PAD_TABLES_H

#include "../films/pad_kernel.h"
#include "../kernels/kernel.h"

/* Take the map of "coefficients" (u, Y, phi) and "shape" (4: extent [rad], first and last u, last Y), both names with
   `of` in front. The map reads the coefficients where they are. RF_INVALID, with a message, where there is none. */
int rf_take_pad_map(rf_pad_map *map, const char *of, const rf_tables *tables, rf_message *why);

#endif
