/* A ball on its reduced contact law, stepped by the classical Runge-Kutta method of order four. */
#ifndef ROTORFILM_RIDE_H
#define ROTORFILM_RIDE_H

#include <stdint.h>

#include "../export.h"

/* The film's force at an approach delta, dimensionless: max(0, depth^exponent + C x + D drive) with
   depth = max(offset - delta, 0)/span, drive = min(delta, offset) - operating and x' = A x + B drive. */
typedef struct rf_ride_law {
    int32_t order; /* of x */
    const double *A, *B, *C;
    double D, offset, span, exponent, operating;
    double W; /* inertia of the ball */
} rf_ride_law;

/* Write delta, velocity and x after each of n equal steps from `start`, (n + 1) x (2 + order); `pushes`, 2 n + 1,
   are the loads at the ends and middles of the steps. */
RF_EXPORT_LOOP int rf_ride(const rf_ride_law *law, const double *start, double step, int64_t n,
                           const double *pushes, double *out);

#endif
