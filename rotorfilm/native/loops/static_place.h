/* The place at which a film has a given force on a journal at rest, and many such places at once. */
#ifndef ROTORFILM_STATIC_PLACE_H
#define ROTORFILM_STATIC_PLACE_H

#include <stdint.h>

#include "../export.h"
#include "../films/film.h"

/* What the search looks for. */
typedef struct rf_static_target {
    rf_response film;
    const void *of;
    double clearance;
    double relative_clearance; /* how far the journal may go from the middle, in clearances */
    double lead;               /* of the first start, from the load on [rad] */
    double noise;              /* of the force, by roundoff [N] */
    double speed;
    double force[2]; /* that the film must have [N] */
    double near[2];  /* where the film says that the journal rests [m]; not finite where it does not say */
} rf_static_target;

/* A trial: s = log(chi/(1 - chi)) of the eccentricity ratio chi, and the angle phi of the journal. The residual is
   ratio = log(|force|/|wanted force|) and the angle between both. */
typedef struct rf_static_point {
    double s, phi;
    double position[2];
    double ratio, angle, norm; /* norm: size of the residual; infinite where the film has no force */
    double matrix[4];          /* of the residual by s and phi, row by row */
    double force[2], slopes[10];
    double imbalance;   /* |force - wanted force| / |wanted force| */
    double unavoidable; /* what roundoff leaves of it */
    int32_t steps, status, found;
    int32_t unstable; /* the film drives the journal away: d(force)/d(position) has a positive real eigenvalue */
} rf_static_point;

/* Answer the trial (s, phi). RF_OK also where the film has no force there; else what it failed with. */
RF_EXPORT_LOOP int rf_static_trial(const rf_static_target *target, double s, double phi, int32_t steps,
                                   rf_static_point *point);

/* Go on from (s, phi) by at most so many steps of Newton's method. */
RF_EXPORT_LOOP int rf_static_newton(const rf_static_target *target, double s, double phi, int32_t most,
                                    rf_static_point *point);

/* Search each of n targets from many starts: the first point that is found, or the best one. The search of a target
   ends where its film fails; the most severe status. */
RF_EXPORT_LOOP int rf_static_places(const rf_static_target *targets, int64_t n, rf_static_point *points);

#endif
