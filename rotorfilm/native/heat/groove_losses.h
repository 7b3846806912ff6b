/* What the openings of a bearing give to its films, from the maps of its losses (loss_kernel.h). */
#ifndef ROTORFILM_GROOVE_LOSSES_H
#define ROTORFILM_GROOVE_LOSSES_H

#include "loss_kernel.h"

/* Flows out of (first) and into (then) the openings at n states, rows of n, in units of c R L; e (2 rows), half the
   speed (n). */
RF_EXPORT_LOOP int rf_groove_flows(const rf_loss_map *map, size_t n, const double *e, const double *rate,
                              double *flows);

/* The share of what leaves an opening that arrived there, a smooth minimum of x = carry_over in/out and 1,

       a = x - w ln(1 + exp(z)),  z = (x - 1)/w,  w = 0.05, where carry_over is above 0.8 max((1 - carry_over)/4, 0.01);

   1 of one that gives nothing. */
double rf_carried_share(double out, double in, double carry_over, double *z);

/* What openings add to the effective flow of fresh oil, sum 2 (in - a out)/(1 + a), in units of c R L and, unless
   NULL, its derivatives by e and by the rate, half the speed. */
double rf_replaced_flow(const rf_loss_map *map, const double *e, double rate, double carry_over, double *slope);

/* Sigma of a gap that is full but for the openings and, unless NULL, its derivatives by e. */
double rf_land_shear(const rf_loss_map *map, const double *e, double *slope);

#endif
