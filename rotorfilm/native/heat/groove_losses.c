#include "groove_losses.h"

#include <math.h>

#include "loss_frame.h"

void rf_opened_spline(const double *coefficients, int order, const size_t *strides, const rf_weights *by, rf_spline *at)
{
    if (order < 0)
        rf_evaluate(coefficients, 3, -1, strides, by, at);
    else
        rf_evaluate(coefficients, 3, 1, strides, by, at);
}

/* A flow, and its derivatives by chi and the angle of e. */
typedef struct plane {
    double value, by_chi, by_angle;
} plane;

/* The splines under e over X and, as the last axis, theta, up to an order of derivatives; chi. */
static double weigh(const rf_loss_map *map, const double *e, int order, rf_weights *by)
{
    double slope;
    const double chi = rf_length(e[0], e[1]), x = rf_stretch(chi, &slope);
    rf_weigh_from_zero(&map->x, fmin(x, map->x.last), order, by);
    by->per *= x > map->x.last ? 0.0 : slope;
    rf_weigh_angle(&map->y, (chi > 0.0 ? atan2(e[1], e[0]) : 0.0) - map->axis, order, by + 2);
    return chi;
}

/* The flow of row k, (out, in) x openings, over half the speed. None is below zero. */
static plane opening_flow(const rf_loss_map *map, const rf_weights *by, int order, int backward, size_t k)
{
    const size_t width = rf_width(&map->y), rows = 2 * (size_t)map->openings;
    const double *c = map->flows + ((backward ? rows : 0) + k) * rf_width(&map->x) * width;
    rf_spline m = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    if (order < 0)
        rf_evaluate(c, 2, -1, &width, by, &m);
    else
        rf_evaluate(c, 2, 1, &width, by, &m);
    const plane found = {m.m, m.m_x, m.m_s}, none = {0.0, 0.0, 0.0};
    return m.m > 0.0 ? found : none;
}

int rf_groove_flows(const rf_loss_map *map, size_t n, const double *e, const double *rate, double *flows)
{
    const size_t rows = 2 * (size_t)map->openings;
    rf_weights by[3];
    for (size_t i = 0; i < n; ++i) {
        const double here[2] = {e[i], e[n + i]};
        if (!(weigh(map, here, -1, by) < 1.0))
            return RF_AT_WALL;
        for (size_t k = 0; k < rows; ++k)
            flows[k * n + i] = fabs(rate[i]) * opening_flow(map, by, -1, rate[i] < 0.0, k).value;
    }
    return RF_OK;
}

double rf_carried_share(double out, double in, double carry_over, double *z)
{
    const double width = fmax(0.01, fmin(0.05, 0.25 * (1.0 - carry_over)));
    const double x = out > 0.0 ? carry_over * in / out : HUGE_VAL;
    *z = (x - 1.0) / width;
    return fmin(x, 1.0) - width * log1p(exp(-fabs(*z)));
}

/* An opening's part of the effective flow of fresh oil, 2 (in - a out)/(1 + a), and its derivatives. */
static double replaced(double out, double in, double carry_over, double *by_out, double *by_in)
{
    double z;
    const double share = rf_carried_share(out, in, carry_over, &z), whole = 1.0 + share;
    *by_out = -2.0 * share / whole;
    *by_in = 2.0 / whole;
    if (z < 700.0) {
        const double pull = 2.0 * (in + out) / (whole * whole * out * (1.0 + exp(z)));
        *by_out += pull * (carry_over * in / out);
        *by_in -= pull * carry_over;
    }
    return 2.0 * (in - share * out) / whole;
}

double rf_replaced_flow(const rf_loss_map *map, const double *e, double rate, double carry_over, double *slope)
{
    rf_weights by[3];
    plane sum = {0.0, 0.0, 0.0};
    const int order = slope ? 1 : -1;
    const double chi = weigh(map, e, order, by);
    for (size_t k = 0; k < (size_t)map->openings; ++k) {
        const plane out = opening_flow(map, by, order, rate < 0.0, k);
        const plane in = opening_flow(map, by, order, rate < 0.0, k + (size_t)map->openings);
        double by_out, by_in;
        sum.value += replaced(out.value, in.value, carry_over, &by_out, &by_in);
        sum.by_chi += by_in * in.by_chi + by_out * out.by_chi;
        sum.by_angle += by_in * in.by_angle + by_out * out.by_angle;
    }
    if (slope) {
        const double rx = chi > 0.0 ? e[0] / chi : 1.0, ry = chi > 0.0 ? e[1] / chi : 0.0;
        const double along = fabs(rate) * sum.by_chi, across = fabs(rate) * sum.by_angle / fmax(chi, RF_NEAR);
        slope[0] = along * rx - across * ry;
        slope[1] = along * ry + across * rx;
        slope[2] = rate < 0.0 ? -sum.value : sum.value;
    }
    return fabs(rate) * sum.value;
}

double rf_land_shear(const rf_loss_map *map, const double *e, double *slope)
{
    const double chi = rf_length(e[0], e[1]), rx = chi > 0.0 ? e[0] / chi : 1.0, ry = chi > 0.0 ? e[1] / chi : 0.0;
    const double away = atan2(-ry, -rx) - map->axis;
    double sum = 0.0, along = 0.0, across = 0.0;
    for (int k = 0; k < 2 * map->lands; ++k) {
        double by_chi;
        const double angle = map->edges[k] - away, sign = k % 2 ? 1.0 : -1.0;
        sum += sign * rf_gap_integral(chi, angle, &by_chi);
        along += sign * by_chi;
        across += sign * cos(angle) / (1.0 + chi * cos(angle));
    }
    if (slope) {
        slope[0] = along * rx - across * ry;
        slope[1] = along * ry + across * rx;
    }
    return sum;
}
