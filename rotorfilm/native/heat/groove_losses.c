#include "groove_losses.h"

#include <math.h>

#include "loss_frame.h"

#define PI 3.14159265358979323846
#define NEAR 1e-3 /* eccentricity ratio of the first node: nearer to the center the angles count as there */

/* A place over X and theta: where its coefficients begin, and the weights of the splines with their slopes over chi and
   over the angle of e. */
typedef struct spot {
    size_t layer, row; /* first coefficients over X and theta */
    double x[RF_ORDER], x_slope[RF_ORDER], e[RF_ORDER], e_slope[RF_ORDER];
} spot;

/* Value, and derivatives by chi and the angle of e. */
typedef struct plane {
    double value, by_chi, by_angle;
} plane;

static RF_ONCE void weigh(double u, double per, int full, double b[RF_ORDER], double slope[RF_ORDER])
{
    rf_values(u, b);
    if (!full)
        return;
    rf_slopes(u, slope);
    for (int k = 0; k < RF_ORDER; ++k)
        slope[k] *= per;
}

static void find_spot(const rf_opening_map *map, double chi, double angle, int full, spot *at)
{
    double u, v, slope;
    const double x = rf_stretch(chi, &slope), within = fmin(x, map->x_end);
    at->layer = (size_t)rf_cell(within / map->x_end * map->cells_x, map->cells_x, &u);
    at->row = (size_t)rf_turned(angle - map->axis, map->cells_e, &v);
    weigh(u, x > within ? 0.0 : slope * map->cells_x / map->x_end, full, at->x, at->x_slope);
    weigh(v, map->cells_e / RF_TURN, full, at->e, at->e_slope);
}

/* Sums over theta and X of rows of numbers that lie `width` apart, with their derivatives. */
static RF_ONCE void sum_rows(const double *c, size_t layer, size_t width, const spot *at, double sum[3][RF_ORDER],
                             int full)
{
    double row[RF_ORDER], turned[RF_ORDER];
    for (int j = 0; j < RF_ORDER; ++j)
        sum[0][j] = sum[1][j] = sum[2][j] = 0.0;
    for (size_t i = 0; i < RF_ORDER; ++i) {
        rf_rows(c + i * layer, width, at->e, row);
        if (full)
            rf_rows(c + i * layer, width, at->e_slope, turned);
        for (int j = 0; j < RF_ORDER; ++j) {
            sum[0][j] += at->x[i] * row[j];
            if (full) {
                sum[1][j] += at->x_slope[i] * row[j];
                sum[2][j] += at->x[i] * turned[j];
            }
        }
    }
}

int rf_groove_losses(const void *of, const double *e, const double *w, int first, double *losses, double *slopes)
{
    const rf_opening_map *map = of;
    rf_frame at;
    rf_polar loss[RF_LOSSES];
    const int status = rf_orient_loss(e, w, &at);
    if (status != RF_OK)
        return rf_fail_losses(status, losses, slopes);
    spot here;
    double v, s_weights[RF_ORDER], s_slopes[RF_ORDER], sum[3][RF_ORDER];
    find_spot(map, at.chi, atan2(at.ry, at.rx), slopes != NULL, &here);
    const double q = map->squeeze, across = fabs(at.sin), gap = (1.0 - at.chi) * (1.0 + at.chi);
    const size_t width = (size_t)map->cells_s + RF_ORDER - 1, layer = ((size_t)map->cells_e + RF_ORDER - 1) * width;
    const size_t all = ((size_t)map->cells_x + RF_ORDER - 1) * layer;
    const size_t k_s = (size_t)rf_cell(atan2(q * across, at.cos) / PI * map->cells_s, map->cells_s, &v);
    const double per = map->cells_s / PI * q / (at.cos * at.cos + q * q * across * across), off = fmax(at.chi, NEAR);
    weigh(v, at.sin > 0.0 ? -per : per, slopes != NULL, s_weights, s_slopes);
    const double *c = map->coefficients + (at.sin >= 0.0 ? 0 : RF_LOSSES * all) + here.layer * layer
                      + here.row * width + k_s;
    for (size_t k = (size_t)first; k < RF_LOSSES; ++k) {
        sum_rows(c + k * all, layer, width, &here, sum, slopes != NULL);
        const int shears = k + 1 < RF_LOSSES;
        const double sum_here = rf_dot(sum[0], s_weights), scale = shears ? 1.0 / sqrt(gap) : 1.0;
        const double value = fmax(sum_here, 0.0), slope = sum_here > 0.0 ? scale : 0.0;
        loss[k].value = value * scale;
        loss[k].by_chi = slope * rf_dot(sum[1], s_weights) + (shears ? loss[k].value * at.chi / gap : 0.0);
        loss[k].by_turn = slope * rf_dot(sum[0], s_slopes) / off;
        loss[k].by_side = slope * rf_dot(sum[2], s_weights) / off;
    }
    return rf_answer_losses(&at, loss, first, losses, slopes);
}

/* The flow of row k, (out, in) x openings, over half the speed. None is below zero. */
static plane opening_flow(const rf_opening_map *map, const spot *at, int backward, size_t k, int full)
{
    const size_t width = (size_t)map->cells_e + RF_ORDER - 1, all = ((size_t)map->cells_x + RF_ORDER - 1) * width;
    const size_t rows = 2 * (size_t)map->openings;
    const double *c = map->flows + ((backward ? rows : 0) + k) * all + at->layer * width + at->row;
    double row[RF_ORDER], row_x[RF_ORDER];
    plane found = {0.0, 0.0, 0.0};
    rf_rows(c, width, at->x, row);
    const double value = rf_dot(row, at->e);
    if (!(value > 0.0))
        return found;
    found.value = value;
    if (full) {
        rf_rows(c, width, at->x_slope, row_x);
        found.by_chi = rf_dot(row_x, at->e);
        found.by_angle = rf_dot(row, at->e_slope);
    }
    return found;
}

static double spot_of(const rf_opening_map *map, const double *e, int full, spot *at)
{
    const double chi = rf_length(e[0], e[1]);
    find_spot(map, chi, chi > 0.0 ? atan2(e[1], e[0]) : 0.0, full, at);
    return chi;
}

int rf_groove_flows(const rf_opening_map *map, size_t n, const double *e, const double *rate, double *flows)
{
    const size_t rows = 2 * (size_t)map->openings;
    for (size_t i = 0; i < n; ++i) {
        const double here[2] = {e[i], e[n + i]};
        spot at;
        if (!(spot_of(map, here, 0, &at) < 1.0))
            return RF_AT_WALL;
        for (size_t k = 0; k < rows; ++k)
            flows[k * n + i] = fabs(rate[i]) * opening_flow(map, &at, rate[i] < 0.0, k, 0).value;
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

double rf_replaced_flow(const rf_opening_map *map, const double *e, double rate, double carry_over, double *slope)
{
    spot at;
    plane sum = {0.0, 0.0, 0.0};
    const double chi = spot_of(map, e, slope != NULL, &at);
    for (size_t k = 0; k < (size_t)map->openings; ++k) {
        const plane out = opening_flow(map, &at, rate < 0.0, k, slope != NULL);
        const plane in = opening_flow(map, &at, rate < 0.0, k + (size_t)map->openings, slope != NULL);
        double by_out, by_in;
        sum.value += replaced(out.value, in.value, carry_over, &by_out, &by_in);
        sum.by_chi += by_in * in.by_chi + by_out * out.by_chi;
        sum.by_angle += by_in * in.by_angle + by_out * out.by_angle;
    }
    if (slope) {
        const double rx = chi > 0.0 ? e[0] / chi : 1.0, ry = chi > 0.0 ? e[1] / chi : 0.0;
        const double along = fabs(rate) * sum.by_chi, across = fabs(rate) * sum.by_angle / fmax(chi, NEAR);
        slope[0] = along * rx - across * ry;
        slope[1] = along * ry + across * rx;
        slope[2] = rate < 0.0 ? -sum.value : sum.value;
    }
    return fabs(rate) * sum.value;
}

double rf_land_shear(const rf_opening_map *map, const double *e, double *slope)
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
