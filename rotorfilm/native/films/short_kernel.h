/* The short-bearing film in closed form: force and exact derivatives.

   Axial flow only, on the half circle that turns with the source w. With n = w/|w|, m = z^ x n, a = e.n and
   b = e.m its potential is J = -(factor/2) |w|^2 I(a, b), and the force dJ/dw:

       I = int_{-pi/2}^{pi/2} cos^2 psi / (1 - a cos psi - b sin psi)^3 dpsi
         = t (q^2 + 3 a^2)/q^5 + 3 a/q^4,    q^2 = 1 - a^2 - b^2,    t = atan2(q, -a),

   because cos^2/H^3 is half the second derivative of 1/H in a, and int 1/H = 2 t/q. */
#ifndef ROTORFILM_SHORT_KERNEL_H
#define ROTORFILM_SHORT_KERNEL_H

#include "film.h"

typedef struct rf_short {
    double factor; /* 4 (length/diameter)^2 */
} rf_short;

/* The film of an rf_short. Without source there is a derivative at the center only. */
RF_EXPORT int rf_short_film(const void *film, const double *e, const double *w, double *f, double *jacobian);

#endif
