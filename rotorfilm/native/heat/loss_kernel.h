/* Shear and flow of a film: what decides its power loss and the oil that leaves it.

   The torque on the journal is viscosity omega R^3 L/c times a shear integral Sigma, plus (E x F)_z/2; Sigma is
   that of the film and of the streamers behind its end. The side flow is in units of c R L. Sigma depends on the
   direction of the source w alone, the flow grows with it. */
#ifndef ROTORFILM_LOSS_KERNEL_H
#define ROTORFILM_LOSS_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "../films/map_kernel.h"
#include "../kernels/kernel.h"

/* Sigma of the film, that of film and streamers, and the side flow. */
#define RF_LOSSES 3

/* The losses from number `first` on, which is not the last, at e[2], w[2] and, unless NULL, slopes[3][4] = d losses/
   d(e, w). Without source nothing flows, and the shear is that of rotation; it has no slopes there: RF_UNDEFINED. What
   fails answers not-a-number together with its status. */
typedef int (*rf_loss)(const void *data, const double *e, const double *w, int first, double *losses, double *slopes);

/* The losses of one bearing as maps over X of map_kernel.h and s, tan s = squeeze tan |beta|, beta in [0, pi] being the
   angle between e and w, which crowds the nodes where the source is across the eccentricity, with g = sqrt(1 - chi^2).

   Of a plain bearing they are ln(g Sigma_f), ln(g (Sigma_f + Sigma_r)) and ln(flow/|w|), each L0 + chi M(X, s). Beyond the
   last node M goes on linearly in ln X: all are powers of X there.

   With openings they are g Sigma_f, g (Sigma_f + Sigma_r) and flow/|w| themselves, over the angle theta of e from the axis
   of the openings too, and apart for each sense in which the oil runs, along as that of a journal at rest in w: it runs
   forward where w is to the right of e. Over X, theta and the sense, for a journal at rest, there are also the flow out of
   each opening, and what arrives there, over half the speed. Beyond the last node all stays as it is there. None is below
   zero: a film that no oil reaches is none. */
typedef struct rf_loss_map {
    rf_axis x, y, s;            /* X, theta, of which there are no cells in a plain bearing, and s in [0, pi] */
    double squeeze, axis;       /* in (0, 1]; angle of the axis of the openings in the bearing frame [rad] */
    const double *center;       /* RF_LOSSES of L0, of a plain bearing */
    const double *coefficients; /* with openings 2 senses, forward first, x RF_LOSSES x 5 more than cells in each axis, s
                                   fastest; over theta the last five repeat the first */
    int32_t openings, lands;    /* openings with a flow of their own, and films between openings */
    const double *flows;        /* 2 senses x out and in x openings, over X and theta */
    const double *edges;        /* lands x 2: where films begin and end, from the axis [rad] */
} rf_loss_map;

/* Take the maps of losses from tables, where they stay: `loss_coefficients` of 3 axes, with openings of 4, the first one of
   maps; numbers `loss_map`, reach, squeeze, and three L0, with openings the axis; with openings `loss_flows` of 3 axes and
   `loss_edges` of 2. RF_INVALID, with the message, where there are none. */
RF_EXPORT_LOOP int rf_take_losses(rf_loss_map *map, int32_t opened, const rf_tables *tables, rf_message *why);

/* An rf_loss. */
RF_EXPORT_LOOP int rf_map_losses(const void *map, const double *e, const double *w, int first, double *losses,
                                 double *slopes);

/* Those of the short film, in closed form: the half circle that faces the source. There are no data. */
RF_EXPORT_LOOP int rf_short_losses(const void *none, const double *e, const double *w, int first, double *losses,
                                   double *slopes);

/* A batch of n states, rows of n: e and w (2 rows each), losses (3), the second of the streamers alone, and slopes (12,
   or NULL). The most severe status;
   `first` receives the index of the first state that has it. */
RF_EXPORT_LOOP int rf_loss_batch(rf_loss film, const void *data, size_t n, const double *e, const double *w, double *losses,
                                 double *slopes, size_t *first);

#endif
