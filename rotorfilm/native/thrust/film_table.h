/* Films of thrust bearings from tables, with exact derivatives; quintic splines, of unit viscosity in SI units.

   A whole bearing of fixed pads, three at least: the potential J with G = dJ/dw to second order in the tilts (a, b),

       J = J0 + alpha t/2 + beta (a w1 + b w2) + gamma (a w2 - b w1) + delta (w1^2 + w2^2)/2,   t = a^2 + b^2,

   over x = ln z, z the film over the lands, and y the angle of (speed, RATIO w0/z), with s their length:
   -s^2 f0/z, s^2 f1/z^3, s f2/z^3, s f3/z^3, f4/z^3; beside them over x alone z and z^3 times the integrals of r^2/h and
   r^4/h^3, which shear goes by.

   One flat pad under a gap plane, unruptured: G = -C w, over x = ln(g_l/g_t) of the gaps at the middle lines of its
   leading and trailing edges, both over that at the pivot, and y, the gap's rise outward over the distance `arm` as part of
   g_l g_t/(g_l + g_t): ln of h^3 c00, the others of (00, 01, 02, 11, 12, 22) over that, and h times the integral of
   r^2/h. */
#ifndef ROTORFILM_FILM_TABLE_H
#define ROTORFILM_FILM_TABLE_H

#include "sector.h"

#define RF_TABLE_RATIO 3
#define RF_TABLE_WHOLE 5 /* functions of a whole bearing, */
#define RF_TABLE_SHEARS 2
#define RF_TABLE_PAD 7 /* and of one pad */

typedef struct rf_film_table {
    int32_t functions;          /* none, those of a whole bearing or of a pad */
    int32_t cells_x, cells_y;
    double x0, x1, y0, y1;      /* first and last nodes */
    double leading, trailing;   /* of a pad: Y of these edges at the outer radius; of a bearing the largest tilt over z */
    double arm, pivot;          /* of a pad [m]; of a bearing arm is the least f0, below which all pads nearly rupture */
    const double *coefficients; /* (cells_x + 5) x (cells_y + 5) x functions */
    const double *shears;       /* of a whole bearing: (cells_x + 5) x 2 */
} rf_film_table;

/* Force, moments and torque y[4] of all pads at q = (z, a, b), rates v and speed; unless NULL by[4][7] by q, v and speed.
   RF_OUTSIDE, and nothing set, beyond the table, below its least f0, where sources of tilt rates add too much to J, in
   reversed rotation and where the film opens fast: partly ruptured pads have kinks, which splines have not. */
int rf_whole_film(const rf_film_table *table, double viscosity, const double *q, const double *v, double speed, double *y,
                  double *by);

/* The answer of rf_sector_film; RF_OUTSIDE, and nothing set, beyond the table or where the film may rupture. */
int rf_pad_table_film(const rf_film_table *table, const rf_sector *pad, const double *q, const double *w, double *y, double *by);

#endif
