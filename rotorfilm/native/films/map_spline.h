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

/* From the coefficients on, over x, with three axes over y, and over s. Order -1 is m alone, order 0 has m_s too, order 1
   the other first derivatives, order 2 all. */
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
    if (order >= 0)
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

/* What the Reynolds number adds is of third order over x, y and r, where no second derivative is asked for. */
#define RF_CUBIC 4

/* The cubic splines under a place that is so many cells from the first node, and their slopes by cells. */
static inline void rf_weigh_cubic(double at, int32_t cells, double per, rf_weights *by)
{
    by->cell = (size_t)rf_cell(at, cells, &by->rest);
    by->per = per;
    const double u = by->rest, v = 1.0 - u;
    by->value[0] = v * v * v / 6.0;
    by->value[1] = (4.0 + u * u * (3.0 * u - 6.0)) / 6.0;
    by->value[2] = (4.0 + v * v * (3.0 * v - 6.0)) / 6.0;
    by->value[3] = u * u * u / 6.0;
    by->slope[0] = -0.5 * v * v;
    by->slope[1] = 0.5 * u * (3.0 * u - 4.0);
    by->slope[2] = -0.5 * v * (3.0 * v - 4.0);
    by->slope[3] = 0.5 * u * u;
}

/* Those under the Reynolds number at a rate, which stays at the last node; whether it is beyond that. `per` is the
   derivative by the rate of the place in cells, 0 beyond. */
static inline int rf_weigh_rate(const rf_map_growth *growth, double rate, rf_weights *by, double *per)
{
    const double reynolds = fabs(rate) * growth->per_rate, y = log1p(reynolds / growth->scale);
    const int outside = y > growth->r.last;
    const double scale = growth->r.cells / growth->r.last;
    rf_weigh_cubic((outside ? growth->r.last : y) * scale, growth->r.cells, scale, by);
    *per = outside || rate == 0.0 ? 0.0 : scale * copysign(growth->per_rate / (growth->scale + reynolds), rate);
    return outside;
}

/* Four rows of six coefficients, weighted by b and added to a sum. */
static inline void rf_add_rows(const double *c, size_t stride, const double *b, double sum[RF_ORDER])
{
    for (size_t k = 0; k < RF_ORDER; ++k)
        sum[k] += b[0] * c[k] + b[1] * c[stride + k] + b[2] * c[2 * stride + k] + b[3] * c[3 * stride + k];
}

/* Sums over x, y and r of six coefficients over s. */
static inline void rf_growth_row(const double *c, const size_t strides[3], const double *x, const double *y,
                                 const double *r, double sum[RF_ORDER])
{
    for (size_t k = 0; k < RF_ORDER; ++k)
        sum[k] = 0.0;
    for (size_t k = 0; k < RF_CUBIC * RF_CUBIC; ++k) {
        const double w = x[k / RF_CUBIC] * y[k % RF_CUBIC], b[RF_CUBIC] = {w * r[0], w * r[1], w * r[2], w * r[3]};
        rf_add_rows(c + k / RF_CUBIC * strides[0] + k % RF_CUBIC * strides[1], strides[2], b, sum);
    }
}

/* Add what the Reynolds number does to a spline over x, y and s, of order 0 or 2; and the derivatives by its place in
   cells of m and m_s. The weights are over the nodes of the growth, cubic of x and y, then those of the Reynolds number. */
static RF_INLINE void rf_grow(const rf_map_growth *growth, const rf_weights by[3], const rf_weights *rate, int order,
                              rf_spline *m, double by_rate[2])
{
    const rf_weights *x = by, *y = by + 1, *s = by + 2;
    const size_t row = (size_t)growth->s.cells + 5, line = row * ((size_t)growth->r.cells + 3);
    const size_t strides[] = {line * ((size_t)growth->y.cells + 3), line, row};
    const double *c = growth->coefficients + x->cell * strides[0] + y->cell * line + rate->cell * row + s->cell;
    double sum[RF_ORDER];
    if (order == 0) {
        rf_growth_row(c, strides, x->value, y->value, rate->value, sum);
        m->m += rf_dot(sum, s->value);
        m->m_s += s->per * rf_dot(sum, s->slope);
        return;
    }
    double block[RF_CUBIC * RF_CUBIC][RF_ORDER] = {{0.0}}, lines[2][RF_CUBIC][RF_ORDER] = {{{0.0}}};
    for (size_t k = 0; k < RF_CUBIC * RF_CUBIC; ++k)
        rf_add_rows(c + k / RF_CUBIC * strides[0] + k % RF_CUBIC * line, row, rate->value, block[k]);
    for (size_t j = 0; j < RF_CUBIC; ++j) {
        rf_add_rows(block[j], RF_CUBIC * RF_ORDER, x->value, lines[0][j]);
        rf_add_rows(block[j], RF_CUBIC * RF_ORDER, x->slope, lines[1][j]);
    }
    double here[RF_ORDER] = {0.0}, along[RF_ORDER] = {0.0}, across[RF_ORDER] = {0.0};
    rf_add_rows(lines[0][0], RF_ORDER, y->value, here);
    rf_add_rows(lines[1][0], RF_ORDER, y->value, along);
    rf_add_rows(lines[0][0], RF_ORDER, y->slope, across);
    m->m += rf_dot(here, s->value);
    m->m_s += s->per * rf_dot(here, s->slope);
    m->m_ss += s->per * s->per * rf_dot(here, s->bend);
    m->m_x += x->per * rf_dot(along, s->value);
    m->m_xs += x->per * s->per * rf_dot(along, s->slope);
    m->m_y += y->per * rf_dot(across, s->value);
    m->m_ys += y->per * s->per * rf_dot(across, s->slope);
    rf_growth_row(c, strides, x->value, y->value, rate->slope, sum);
    by_rate[0] = rf_dot(sum, s->value);
    by_rate[1] = s->per * rf_dot(sum, s->slope);
}

#endif
