/* What the maps share: uniform quintic B-splines, the stretched eccentricity, lengths without overflow. */
#ifndef ROTORFILM_QUINTIC_H
#define ROTORFILM_QUINTIC_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#define RF_ORDER 6         /* coefficients under one point, per axis */
#define RF_SMALLEST 1e-200 /* squares outside these bounds lose digits or overflow */
#define RF_LARGEST 1e200
#define RF_TURN 6.283185307179586476925286766559

/* Kept out of line: large, and called where a call costs little. Or always in line, where arguments are constants. */
#if defined(__GNUC__)
#define RF_ONCE __attribute__((noinline))
#define RF_INLINE inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define RF_ONCE __declspec(noinline)
#define RF_INLINE __forceinline
#else
#define RF_ONCE
#define RF_INLINE inline
#endif

/* Values and up to two derivatives of the six quintic B-splines on one cell, at u in [0, 1]. */
static inline void rf_values(double u, double b[RF_ORDER])
{
    const double v = 1.0 - u, u2 = u * u, v2 = v * v, k = 1.0 / 120.0;
    b[0] = k * v2 * v2 * v;
    b[1] = k * (26.0 + u * (-50.0 + u * (20.0 + u * (20.0 + u * (-20.0 + u * 5.0)))));
    b[2] = k * (66.0 + u2 * (-60.0 + u2 * (30.0 - 10.0 * u)));
    b[3] = k * (66.0 + v2 * (-60.0 + v2 * (30.0 - 10.0 * v)));
    b[4] = k * (26.0 + v * (-50.0 + v * (20.0 + v * (20.0 + v * (-20.0 + v * 5.0)))));
    b[5] = k * u2 * u2 * u;
}

static inline void rf_slopes(double u, double b[RF_ORDER])
{
    const double v = 1.0 - u, u2 = u * u, v2 = v * v, k = 1.0 / 24.0;
    b[0] = -k * v2 * v2;
    b[1] = k * (-10.0 + u * (8.0 + u * (12.0 + u * (-16.0 + u * 5.0))));
    b[2] = k * u * (-24.0 + u2 * (24.0 - 10.0 * u));
    b[3] = -k * v * (-24.0 + v2 * (24.0 - 10.0 * v));
    b[4] = -k * (-10.0 + v * (8.0 + v * (12.0 + v * (-16.0 + v * 5.0))));
    b[5] = k * u2 * u2;
}

static inline void rf_curvatures(double u, double b[RF_ORDER])
{
    const double v = 1.0 - u, k = 1.0 / 6.0;
    b[0] = k * v * v * v;
    b[1] = k * (2.0 + u * (6.0 + u * (-12.0 + u * 5.0)));
    b[2] = k * (-6.0 + u * u * (18.0 - 10.0 * u));
    b[3] = k * (-6.0 + v * v * (18.0 - 10.0 * v));
    b[4] = k * (2.0 + v * (6.0 + v * (-12.0 + v * 5.0)));
    b[5] = k * u * u * u;
}

static inline double rf_dot(const double a[RF_ORDER], const double b[RF_ORDER])
{
    double sum = a[0] * b[0];
    for (int j = 1; j < RF_ORDER; ++j)
        sum += a[j] * b[j];
    return sum;
}

/* Sum of the six rows of coefficients from `c`, weighted by b; in this form compilers use vectors. */
static inline void rf_rows(const double *c, size_t stride, const double b[RF_ORDER], double *restrict sum)
{
    const double *c1 = c + stride, *c2 = c1 + stride, *c3 = c2 + stride, *c4 = c3 + stride, *c5 = c4 + stride;
    for (int j = 0; j < RF_ORDER; ++j)
        sum[j] = b[0] * c[j] + b[1] * c1[j] + b[2] * c2[j] + b[3] * c3[j] + b[4] * c4[j] + b[5] * c5[j];
}

/* Cell of a point at `at` cells from the first node; the rest is its place in the cell. */
static inline int32_t rf_cell(double at, int32_t cells, double *rest)
{
    int32_t i = (int32_t)at;
    i = i < 0 ? 0 : (i < cells ? i : cells - 1);
    *rest = at - (double)i;
    return i;
}

/* Cell of an angle on a turn of uniform nodes. */
static inline int32_t rf_turned(double angle, int32_t cells, double *rest)
{
    const double turns = angle / RF_TURN;
    return rf_cell((turns - floor(turns)) * cells, cells, rest);
}

/* hypot() of some C libraries is too new for the machines that an FMU may meet. */
static inline double rf_length(double x, double y)
{
    const double squared = x * x + y * y, size = fmax(fabs(x), fabs(y));
    if ((squared > RF_SMALLEST && squared < RF_LARGEST) || size == 0.0)
        return sqrt(squared);
    return size * sqrt((x / size) * (x / size) + (y / size) * (y / size));
}

/* X and, where asked for, dX/dchi. */
static inline double rf_stretch(double chi, double *slope)
{
    const double gap = (1.0 - chi) * (1.0 + chi), root = sqrt(sqrt(gap));
    if (slope)
        *slope = (1.0 - 0.5 * chi * chi) / (root * gap);
    return chi / root;
}

/* chi of X. */
static inline double rf_unstretch(double x)
{
    const double squared = x * x;
    return sqrt(2.0 * squared / (squared + sqrt(squared * squared + 4.0)));
}

#endif
