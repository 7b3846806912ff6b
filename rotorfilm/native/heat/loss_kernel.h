/* Shear and flow of a film: what decides its power loss and the oil that leaves it.

   The torque on the journal is viscosity omega R^3 L/c times a shear integral Sigma, plus (E x F)_z/2; Sigma is
   that of the film and of the streamers behind its end. The side flow is in units of c R L. Sigma depends on the
   direction of the source w alone, the flow grows with it. */
#ifndef ROTORFILM_LOSS_KERNEL_H
#define ROTORFILM_LOSS_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "../status.h"

/* Sigma of the film, that of film and streamers, and the side flow. */
#define RF_LOSSES 3

/* The losses from number `first` on, which is not the last, at e[2], w[2] and, unless NULL, slopes[3][4] = d losses/
   d(e, w). Without source nothing flows, and the shear is that of rotation; it has no slopes there: RF_UNDEFINED. What
   fails answers not-a-number together with its status. */
typedef int (*rf_loss)(const void *data, const double *e, const double *w, int first, double *losses, double *slopes);

/* The losses of one plain bearing as three maps over X of map_kernel.h and s, tan s = squeeze tan beta, beta in [0, pi]
   being the angle between e and w, which crowds the nodes where the source is across the eccentricity:

       ln(g Sigma_f),  ln(g (Sigma_f + Sigma_r)),  ln(flow/|w|),  each L0 + chi M(X, s),  g = sqrt(1 - chi^2).

   Beyond the last node M goes on linearly in ln X: all are powers of X there. */
typedef struct rf_loss_map {
    int32_t cells_x, cells_s;   /* cells of [0, X_end] and of [0, pi] */
    double x_end;               /* X of the last node */
    double squeeze;             /* in (0, 1] */
    double center[RF_LOSSES];   /* L0 */
    const double *coefficients; /* RF_LOSSES x (cells_x + 5) x (cells_s + 5) of M, quintic, s fastest */
} rf_loss_map;

RF_EXPORT int rf_map_losses(const void *map, const double *e, const double *w, int first, double *losses,
                            double *slopes);

/* Those of the short film, in closed form: the half circle that faces the source. There are no data. */
RF_EXPORT int rf_short_losses(const void *none, const double *e, const double *w, int first, double *losses,
                            double *slopes);

/* A batch of n states, rows of n: e and w (2 rows each), losses (3), the second of the streamers alone, and slopes (12,
   or NULL). The most severe status;
   `first` receives the index of the first state that has it. */
RF_EXPORT int rf_loss_batch(rf_loss film, const void *data, size_t n, const double *e, const double *w, double *losses,
                            double *slopes, size_t *first);

#endif
