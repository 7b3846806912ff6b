/* The maps of films among the tables of a kernel. */
#ifndef ROTORFILM_MAP_TABLE_H
#define ROTORFILM_MAP_TABLE_H

#include "map_kernel.h"
#include "../kernels/kernel.h"

/* Tables `coefficients` of three axes, `center` of one, and numbers `map`:

       RF_PLAIN     (1, X, cos), (1), and reach, or reach with length/diameter and share of the film at the wall
       RF_LAYERED   (S, X, cos), (S) over S = ln(length/diameter), and reach; with `range`, its first and last one
       RF_GROOVED   (X, theta, s), (phi), and length/diameter, reach, squeeze, axis [rad] and whether the oil is laminar
       RF_SPED      (X, y, cos), (y), and reach, scale and last y, Re over the rate [s]
       RF_PAD       (u, Y, phi), none, and extent [rad], first and last u, last Y

   With them those of turbulent oil, of pads and with openings: `growth` (x, y, r, s) over the same and r = ln(1 + Re/scale),
   with openings `growth_center` (r, phi), and `growth_map`: scale, last r, Re over the rate [s], density [kg/m3]. */
typedef enum rf_map_kind { RF_PLAIN, RF_LAYERED, RF_GROOVED, RF_PAD, RF_SPED } rf_map_kind;

/* Take a map, for rf_map_to_wall where it is plain, whose coefficients stay where they are; of layers, the first. The names of its tables have `of` in front.
   RF_INVALID, with the message, where there is none. */
RF_EXPORT int rf_take_map(rf_map *map, int32_t kind, const char *of, const rf_tables *tables, rf_message *why);

/* Let the Reynolds number of a map be that of a bearing by its parameters: radius, length, clearance, viscosity. */
void rf_scale_growth(rf_map *map, const double *parameters);

/* The numbers of one length/diameter, `size` of them, from those of quintic splines over S, layers that cover a range. Of
   one layer, that one. RF_INVALID, without an answer, if length/diameter is outside. */
RF_EXPORT int rf_map_slice(const double *numbers, size_t layers, size_t size, const double *range, double slenderness,
                           double *own);

#endif
