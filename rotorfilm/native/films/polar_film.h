/* A film whose law in polar axes depends on the eccentricity ratio alone (bearings/films/polar_table.py).

   With chi = |e|, e_r = e/chi, e_t = z^ x e_r and the source (g_s, g_c) = (w.e_t, w.e_r),

       (F_t, F_r) = -A(chi) (g_s, g_c),   and a lift -l(chi) e beside it.

   The table has Chebyshev coefficients of A_ss, A_sc, A_cs, A_cc and l, times (1 - chi^2)^(3/2), over atanh(chi)
   from 0 to its last node. Backward rotation is mirrored, as the arc of such a film follows the rotation. */
#ifndef ROTORFILM_POLAR_FILM_H
#define ROTORFILM_POLAR_FILM_H

#include <stdint.h>

#include "film.h"
#include "../kernels/kernel.h"

typedef struct rf_polar_table {
    const double *table; /* terms x 5 */
    double reach;        /* its last eccentricity ratio */
    double slenderness;  /* length / diameter for which it holds */
    int32_t terms;
} rf_polar_table;

/* The film of an rf_polar_table, an rf_film. Beyond its table it goes on as (1 - chi^2)^(-3/2). */
int rf_polar_film(const void *film, const double *e, const double *w, double *f, double *jacobian);

/* Take the tables `polar` (terms, 5) and `reach` (2: eccentricity ratio, length / diameter). RF_INVALID, with the
   message, where they do not fit. */
int rf_take_polar(rf_polar_table *film, const rf_tables *tables, rf_message *why);

#endif
