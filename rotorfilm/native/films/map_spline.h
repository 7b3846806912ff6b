/* Quintic splines over uniform nodes of two or three axes, and the derivatives of them that a film needs.

   The last axis, s, is that of the direction of the source: the force is a derivative along it, so that its Jacobian
   takes a second one. Numbers of axes and orders of derivatives are constants where these functions are called. */
#ifndef ROTORFILM_MAP_SPLINE_H
#define ROTORFILM_MAP_SPLINE_H

#include "map_kernel.h"
#include "quintic.h"

/* The splines under a place on an axis, with derivatives by the place in cells. */
typedef struct rf_weights {
    size_t cell;
    double per, rest; /* cells per unit; place in the cell */
    double value[RF_ORDER], slope[RF_ORDER], bend[RF_ORDER];
} rf_weights;

/* A spline over x, y and s. */
typedef struct rf_spline {
    double m, m_x, m_y, m_s, m_xs, m_ys, m_ss;
} rf_spline;

static inline void rf_weigh(int order, rf_weights *by)
{
    rf_values(by->rest, by->value);
    if (order > 0)
        rf_slopes(by->rest, by->slope);
    if (order > 1)
        rf_curvatures(by->rest, by->bend);
}

static inline void rf_weigh_between(const rf_axis *axis, double at, int order, rf_weights *by)
{
    by->per = axis->cells / (axis->last - axis->first);
    by->cell = (size_t)rf_cell((at - axis->first) * by->per, axis->cells, &by->rest);
    rf_weigh(order, by);
}

/* On an axis from 0 on, as X. */
static inline void rf_weigh_from_zero(const rf_axis *axis, double at, int order, rf_weights *by)
{
    by->per = axis->cells / axis->last;
    by->cell = (size_t)rf_cell(at / axis->last * axis->cells, axis->cells, &by->rest);
    rf_weigh(order, by);
}

/* On an axis that is a turn. */
static inline void rf_weigh_angle(const rf_axis *axis, double angle, int order, rf_weights *by)
{
    by->per = axis->cells / RF_TURN;
    by->cell = (size_t)rf_turned(angle, axis->cells, &by->rest);
    rf_weigh(order, by);
}

/* Go on linearly, so many cells beyond the place. */
static inline void rf_weigh_beyond(double cells, rf_weights *by)
{
    for (int j = 0; j < RF_ORDER; ++j)
        by->value[j] += cells * by->slope[j];
}

static inline size_t rf_width(const rf_axis *axis)
{
    return (size_t)axis->cells + RF_ORDER - 1;
}

/* Sums over the first of three axes: 6 x 6 numbers, rows of coefficients being `row` and layers `layer` apart. */
static inline void rf_layers(const double *c, size_t layer, size_t row, const double b[RF_ORDER],
                             double sum[RF_ORDER * RF_ORDER])
{
    for (size_t j = 0; j < RF_ORDER; ++j)
        rf_rows(c + j * row, layer, b, sum + j * RF_ORDER);
}

/* From the coefficients on, over x, with three axes over y, and over s. Order 0 is m and m_s, order 1 has the other first
   derivatives, order 2 all. */
static RF_INLINE void rf_evaluate(const double *c, int axes, int order, const size_t *strides, const rf_weights *by,
                                  rf_spline *at)
{
    const rf_weights *x = by, *y = by + 1, *s = by + 2;
    double row[RF_ORDER], row_x[RF_ORDER], row_y[RF_ORDER], block[RF_ORDER * RF_ORDER];
    c += x->cell * strides[0] + (axes > 2 ? y->cell * strides[1] : 0) + s->cell;
    if (axes > 2) {
        rf_layers(c, strides[0], strides[1], x->value, block);
        rf_rows(block, RF_ORDER, y->value, row);
        if (order > 0) {
            rf_rows(block, RF_ORDER, y->slope, row_y);
            rf_layers(c, strides[0], strides[1], x->slope, block);
            rf_rows(block, RF_ORDER, y->value, row_x);
            at->m_y = y->per * rf_dot(row_y, s->value);
        }
    } else {
        rf_rows(c, strides[0], x->value, row);
        if (order > 0)
            rf_rows(c, strides[0], x->slope, row_x);
    }
    at->m = rf_dot(row, s->value);
    at->m_s = s->per * rf_dot(row, s->slope);
    if (order > 0)
        at->m_x = x->per * rf_dot(row_x, s->value);
    if (order > 1) {
        at->m_xs = x->per * s->per * rf_dot(row_x, s->slope);
        at->m_ss = s->per * s->per * rf_dot(row, s->bend);
        if (axes > 2)
            at->m_ys = y->per * s->per * rf_dot(row_y, s->slope);
    }
}

#endif
