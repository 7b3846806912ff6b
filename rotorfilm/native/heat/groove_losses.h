/* Shear and flow of the film of one bearing with axial openings at ambient pressure, from maps made for it.

   Over X of groove_kernel.h, the angle theta of e from the axis of the openings, and s in [0, pi], tan s = squeeze
   tan |beta|, beta being the angle from e to w, and apart for each sense in which the oil runs, the maps hold

       g Sigma_f,  g (Sigma_f + Sigma_r),  flow/|w|,  g = sqrt(1 - chi^2),

   with the oil running along as that of a journal at rest in w: it runs forward where w is to the right of e. Over X,
   theta and the sense, for a journal at rest, they hold the flow out of each opening, and what arrives there, over half
   the speed. Beyond the last node all stays as it is there. None is
   below zero: a film that no oil reaches is none. */
#ifndef ROTORFILM_GROOVE_LOSSES_H
#define ROTORFILM_GROOVE_LOSSES_H

#include <stddef.h>
#include <stdint.h>

#include "loss_kernel.h"

typedef struct rf_opening_map {
    int32_t cells_x, cells_e, cells_s; /* cells of [0, X_end], of a turn in theta, and of [0, pi] */
    int32_t openings, lands;           /* openings with a flow of their own, and films between openings */
    double x_end;                      /* X of the last node */
    double squeeze;                    /* in (0, 1] */
    double axis;                       /* angle of the axis of the openings in the bearing frame [rad] */
    const double *coefficients;        /* 2 senses, forward first, x RF_LOSSES x (cells_x + 5) x (cells_e + 5)
                                          x (cells_s + 5), quintic, s fastest; over theta the last five repeat
                                          the first */
    const double *flows;               /* 2 senses x out and in x openings x (cells_x + 5) x (cells_e + 5) */
    const double *edges;               /* lands x 2: where films begin and end, from the axis [rad] */
} rf_opening_map;

/* An rf_loss. */
RF_EXPORT_LOOP int rf_groove_losses(const void *map, const double *e, const double *w, int first, double *losses,
                               double *slopes);

/* Flows out of (first) and into (then) the openings at n states, rows of n, in units of c R L; e (2 rows), half the
   speed (n). */
RF_EXPORT_LOOP int rf_groove_flows(const rf_opening_map *map, size_t n, const double *e, const double *rate,
                              double *flows);

/* The share of what leaves an opening that arrived there, a smooth minimum of x = carry_over in/out and 1,

       a = x - w ln(1 + exp(z)),  z = (x - 1)/w,  w = 0.05, where carry_over is above 0.8 max((1 - carry_over)/4, 0.01);

   1 of one that gives nothing. */
double rf_carried_share(double out, double in, double carry_over, double *z);

/* What openings add to the effective flow of fresh oil, sum 2 (in - a out)/(1 + a), in units of c R L and, unless
   NULL, its derivatives by e and by the rate, half the speed. */
double rf_replaced_flow(const rf_opening_map *map, const double *e, double rate, double carry_over, double *slope);

/* Sigma of a gap that is full but for the openings and, unless NULL, its derivatives by e. */
double rf_land_shear(const rf_opening_map *map, const double *e, double *slope);

#endif
