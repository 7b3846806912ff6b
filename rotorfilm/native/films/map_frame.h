/* What the maps of films share besides splines: the axes of a state, and the force in them.

   A film minimizes a quadratic functional, so its force is the gradient F = dJ/dw of the minimum
   J(e, w) = -|w|^2 exp(L): F = |w| E (2 n + L' m) with E = J/|w|^2, n = w/|w|, m = z^ x n and L' the
   derivative of L in the angle of w. */
#ifndef ROTORFILM_MAP_FRAME_H
#define ROTORFILM_MAP_FRAME_H

#include <math.h>

#include "quintic.h"
#include "../status.h"

#define RF_ROUNDING 1e-12 /* by which the last node of a map may be passed */

/* |w|, n, chi = |e|, r = e/chi, and the angle from w to e. */
typedef struct rf_frame {
    double size, nx, ny, chi, rx, ry, cos, sin;
} rf_frame;

/* Whether one is not finite: fmax would hide a not-a-number. */
static inline int rf_is_broken(const double *values, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += 0.0 * values[i];
    return !(sum == 0.0);
}

/* Answer not-a-number, and the status. */
static inline int rf_fail(int status, double *f, double *jacobian, int count)
{
    f[0] = f[1] = NAN;
    for (int i = 0; jacobian && i < count; ++i)
        jacobian[i] = NAN;
    return status;
}

/* Without source: no force, and no derivative. */
static inline int rf_rest(double *f, double *jacobian)
{
    rf_fail(RF_UNDEFINED, f, jacobian, 8);
    f[0] = f[1] = 0.0;
    return jacobian ? RF_UNDEFINED : RF_OK;
}

/* The frame; without a source, RF_UNDEFINED with chi alone. */
static inline int rf_orient(const double *e, const double *w, rf_frame *at)
{
    if (!isfinite(e[0]) || !isfinite(e[1]) || !isfinite(w[0]) || !isfinite(w[1]))
        return RF_NOT_FINITE;
    at->chi = rf_length(e[0], e[1]);
    if (at->chi >= 1.0)
        return RF_AT_WALL;
    at->size = rf_length(w[0], w[1]);
    if (at->size == 0.0)
        return RF_UNDEFINED;
    at->nx = w[0] / at->size;
    at->ny = w[1] / at->size;
    /* At the center no direction is special: M is a plane there, and any r makes the same of it. */
    at->rx = at->chi > 0.0 ? e[0] / at->chi : at->nx;
    at->ry = at->chi > 0.0 ? e[1] / at->chi : at->ny;
    at->cos = at->rx * at->nx + at->ry * at->ny;
    at->sin = at->ry * at->nx - at->rx * at->ny;
    return RF_OK;
}

static inline void rf_set_force(const rf_frame *at, double potential, double turn, double *f)
{
    const double along = 2.0 * at->size * potential, across = at->size * potential * turn;
    f[0] = along * at->nx - across * at->ny;
    f[1] = along * at->ny + across * at->nx;
}

/* Turn a tensor with rows along (n, m) and columns along (a, z^ x a) to (x, y): columns `first` and `first`
   + 1 of the Jacobian. */
static inline void rf_set_columns(const rf_frame *at, double ax, double ay, const double t[4], int first,
                                  double *jacobian)
{
    const double nx = t[0] * ax - t[1] * ay, ny = t[0] * ay + t[1] * ax;
    const double mx = t[2] * ax - t[3] * ay, my = t[2] * ay + t[3] * ax;
    jacobian[first] = at->nx * nx - at->ny * mx;
    jacobian[first + 1] = at->nx * ny - at->ny * my;
    jacobian[first + 4] = at->ny * nx + at->nx * mx;
    jacobian[first + 5] = at->ny * ny + at->nx * my;
}

/* Columns of d f/dw: the second derivative of L in the angle of w is turn_turn. */
static inline void rf_set_damping(const rf_frame *at, double potential, double turn, double turn_turn,
                                  double *jacobian)
{
    const double by_w[4] = {2.0 * potential, potential * turn, potential * turn,
                            potential * (2.0 + turn * turn + turn_turn)};
    rf_set_columns(at, at->nx, at->ny, by_w, 2, jacobian);
}

/* L and its derivatives: along and across a direction of e, in the angle of w, and in that with each of the three. */
typedef struct rf_exponent {
    double value, along, across, turn, turn_along, turn_across, turn_turn;
} rf_exponent;

/* Force and Jacobian of J = |w|^2 E, that direction being (ax, ay). */
static inline void rf_set_answer(const rf_frame *at, double potential, const rf_exponent *by, double ax, double ay,
                                 double *f, double *jacobian)
{
    const double k = at->size * potential, turn = by->turn;
    rf_set_force(at, potential, turn, f);
    if (!jacobian)
        return;
    const double by_e[4] = {2.0 * k * by->along, 2.0 * k * by->across, k * (by->along * turn + by->turn_along),
                            k * (by->across * turn + by->turn_across)};
    rf_set_columns(at, ax, ay, by_e, 0, jacobian);
    rf_set_damping(at, potential, turn, by->turn_turn, jacobian);
}

/* Derivatives of such a force by the rate, from those of L and of its slope in the angle of w: columns 8 and 9. */
static inline void rf_set_rate(const rf_frame *at, double potential, const double by_rate[2], const double *f,
                               double *jacobian)
{
    const double turned = at->size * potential * by_rate[1];
    jacobian[8] = by_rate[0] * f[0] - turned * at->ny;
    jacobian[9] = by_rate[0] * f[1] + turned * at->nx;
}

/* The status of an answer at X that may have overflown. */
static inline int rf_judge(double x, double x_end, double *f, double *jacobian)
{
    if (rf_is_broken(f, 2) || (jacobian && rf_is_broken(jacobian, 8)))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 8);
    return x > x_end * (1.0 + RF_ROUNDING) ? RF_OUTSIDE : RF_OK;
}

#endif
