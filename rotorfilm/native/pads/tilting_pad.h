/* One tilting pad: its film in the frame of its pivot, the tilt that it has or takes.

   The pivot lies at the angle 0, n = (1, 0) points from the center to it and t = z^ x n along the arc, which goes from
   -lead to trail. With the clearance c of the pad, its preload m, its tilt q as a length and its pivot s outward, the
   journal is at e = (xi, eta) = (r.n/c + m + s/c, (r.t + q)/c) and the film has the source w = (w_n, w_t). Forces are on
   the journal, in units of viscosity * length * radius^3 / c^2. */
#ifndef ROTORFILM_TILTING_PAD_H
#define ROTORFILM_TILTING_PAD_H

#include "../export.h"
#include "../films/film.h"

#define RF_PAD_NODES 5
#define RF_PAD_NEAR 1e-4

typedef struct rf_tilting_pad {
    rf_film film; /* in the frame of the pad's middle */
    const void *data;
    double turn[2];        /* cos and sin of the angle from the middle to the pivot */
    double lead[2];        /* cos and sin of the angle from the pivot back to the leading end for speeds > 0 */
    double trail[2];       /* and on to the trailing end */
    double node[RF_PAD_NODES][2]; /* cos and sin of places on the arc */
} rf_tilting_pad;

/* A pad of this extent [rad], its pivot at a share of it from the leading end for speeds > 0. */
RF_EXPORT_LOOP void rf_set_tilting_pad(rf_tilting_pad *pad, rf_film film, const void *data, double extent, double offset);

/* The least H = 1 - e.n on the arc. */
double rf_pad_least(const rf_tilting_pad *pad, const double *e);

/* The force f[2] at e[2] and w[3] and, unless NULL, jacobian[10], as an rf_film; zero where no film is. */
int rf_pivoted_film(const rf_tilting_pad *pad, const double *e, const double *w, double *f, double *jacobian);

/* The w_t of w[3] at which a pad without inertia has no moment, for w_n > 0, with force and jacobian there. Where `near` is
   not NULL and no farther than RF_PAD_NEAR, relative, one step of Newton's method from it serves: an error of the square
   of that, and of the jacobian that it changes by. */
int rf_pad_follow(const rf_tilting_pad *pad, const double *e, const double *near, double *w, double *f, double *jacobian);

/* The w_t, of all that leave no film for w_n <= 0, that is nearest to `wanted`. */
double rf_pad_idle(const rf_tilting_pad *pad, double w_n, double wanted);

/* A pad at rest at a speed, its force over that. */
typedef struct rf_pad_rest {
    double eta;
    double force, slope; /* along n, and d force/d xi with the pad free to tilt */
    double by_rate;      /* and by the rate, of a film that knows it by more than its source */
    int unloaded;        /* whether it has no film: then eta is the end of its neutral tilts */
} rf_pad_rest;

/* The stable tilt at xi: the first root of the moment from trailing contact on. RF_AT_WALL where the pivot or, of an
   unloaded pad, the leading end touches. */
int rf_find_pad_rest(const rf_tilting_pad *pad, double xi, double speed, rf_pad_rest *rest);

#endif
