#include <math.h>

#include "map_frame.h"
#include "map_spline.h"
#include "wall.h"

#define EDGE (-0.414) /* sinh(ln(s)/3) of a contact at the edge: .23 of a film between parabola and edge is left */
#define LEAST 1e-9    /* share of the film at the wall */
#define MOST 0.999

/* L0 of a map with openings, and its first derivative, or two. */
static void center(const rf_map *map, double phi, int order, double out[3])
{
    const rf_axis turn = {map->cells_w, 0.0, RF_TURN};
    rf_weights by;
    rf_weigh_angle(&turn, phi, order > 0 ? 2 : 1, &by);
    const double *c = map->center + by.cell;
    out[0] = rf_dot(c, by.value);
    out[1] = by.per * rf_dot(c, by.slope);
    if (order > 0)
        out[2] = by.per * by.per * rf_dot(c, by.bend);
}

/* Add what the Reynolds number does to L0 and to M, with the derivatives by the rate of L and of its slope in phi. */
static RF_ONCE int grow(const rf_map *map, const rf_frame *at, double x, const double angles[3], double by_b, double rate,
                        int order, double zero[3], rf_spline *m, double by_rate[2])
{
    const rf_map_growth *growth = &map->growth;
    const rf_axis turn = {map->cells_w, 0.0, RF_TURN};
    const size_t width = rf_width(&turn);
    const double per_x = growth->x.cells / growth->x.last, per_y = growth->y.cells / RF_TURN;
    double turns = angles[0] / RF_TURN, per, row[RF_ORDER] = {0.0}, row_r[RF_ORDER] = {0.0}, moved[2] = {0.0, 0.0};
    rf_weights by[3], of_rate, phi;
    const int outside = rf_weigh_rate(growth, rate, &of_rate, &per);
    turns -= floor(turns);
    rf_weigh_cubic(x * per_x, growth->x.cells, per_x, by);
    rf_weigh_cubic(turns * growth->y.cells, growth->y.cells, per_y, by + 1);
    rf_weigh_angle(&growth->s, angles[1], order > 0 ? 2 : 1, by + 2);
    rf_weigh_angle(&turn, angles[2], order > 0 ? 2 : 1, &phi);
    if (order > 0)
        rf_grow(growth, by, &of_rate, 2, m, moved);
    else
        rf_grow(growth, by, &of_rate, 0, m, moved);
    const double *c = growth->center + of_rate.cell * width + phi.cell;
    rf_add_rows(c, width, of_rate.value, row);
    zero[0] += rf_dot(row, phi.value);
    zero[1] += phi.per * rf_dot(row, phi.slope);
    if (order > 0) {
        zero[2] += phi.per * phi.per * rf_dot(row, phi.bend);
        rf_add_rows(c, width, of_rate.slope, row_r);
        by_rate[0] = per * (rf_dot(row_r, phi.value) + at->chi * moved[0]);
        by_rate[1] = per * (phi.per * rf_dot(row_r, phi.slope) + at->chi * moved[1] * by_b);
    }
    return outside;
}

/* Along e. With chi factored out nothing is divided by it. With a growth `by_rate` has what `grow` tells, and 1 more
   where the Reynolds number is beyond its nodes, else 0. */
static rf_exponent exponent(const rf_map *map, const rf_frame *at, double x, double slope, int order, double rate,
                            double by_rate[3])
{
    const double q = map->squeeze, c = at->cos, s = -at->sin, chi = at->chi, bent = c * c + q * q * s * s;
    const double by_b = q / bent, by_bb = 2.0 * q * (1.0 - q * q) * s * c / (bent * bent);
    const size_t strides[] = {rf_width(&map->y) * rf_width(&map->s), rf_width(&map->s)};
    double zero[3] = {0.0, 0.0, 0.0};
    rf_weights by[3];
    rf_spline m = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    rf_weigh_from_zero(&map->x, x, order > 0, by);
    const double angles[3] = {atan2(at->ry, at->rx) - map->axis, atan2(q * s, c), atan2(at->ny, at->nx) - map->axis};
    rf_weigh_angle(&map->y, angles[0], order > 0, by + 1);
    rf_weigh_angle(&map->s, angles[1], order > 0 ? 2 : 1, by + 2);
    rf_evaluate(map->coefficients, 3, order, strides, by, &m);
    center(map, angles[2], order, zero);
    by_rate[2] = 0.0;
    if (map->growth.coefficients)
        by_rate[2] = grow(map, at, x, angles, by_b, rate, order, zero, &m, by_rate);
    rf_exponent of = {zero[0] + chi * m.m, 0.0, 0.0, zero[1] + chi * (m.m_s * by_b), 0.0, 0.0, 0.0};
    if (order > 0) {
        const double m_b = m.m_s * by_b, m_bb = m.m_ss * by_b * by_b + m.m_s * by_bb;
        of.along = m.m + chi * slope * m.m_x;
        of.across = m.m_y - m_b;
        of.turn_along = m_b + chi * slope * m.m_xs * by_b;
        of.turn_across = m.m_ys * by_b - m_bb;
        of.turn_turn = zero[2] + chi * m_bb;
    }
    return of;
}

/* The share that openings leave at chi from that at chi_end. It is s/(1 + s), s = (y + sqrt(1 + y^2))^3, y = EDGE + a
   distance to the edge in widths of the film, as of a long film: to infinity on land, to minus infinity in an opening. */
static rf_share left(double kept, double kept_side, double chi_end, double chi)
{
    const double bounded = fmin(fmax(kept, LEAST), MOST), g = (1.0 - chi) * (1.0 + chi);
    const double z = log(bounded / (1.0 - bounded)) / 3.0, distance = sinh(z) - EDGE;
    const double narrowing = sqrt((1.0 - chi_end) * (1.0 + chi_end) / g), y = EDGE + distance * narrowing;
    const double root = sqrt(1.0 + y * y), base = y > 0.0 ? root + y : 1.0 / (root - y);
    const double value = 1.0 / (1.0 + 1.0 / (base * base * base)), by_y = 3.0 * value * (1.0 - value) / root;
    const double by_kept = bounded == kept ? cosh(z) / (3.0 * kept * (1.0 - kept)) : 0.0;
    const rf_share at = {value, by_y * narrowing * by_kept * kept_side, by_y * distance * narrowing * chi / g};
    return at;
}

static int beyond(const rf_map *map, const rf_frame *at, double rate, double *f, double *jacobian)
{
    const double end = rf_unstretch(map->x.last);
    rf_frame edge = *at, straight = *at;
    rf_potential full;
    double here_by_rate[3] = {0.0, 0.0, 0.0}, by_rate[3] = {0.0, 0.0, 0.0};
    edge.chi = straight.chi = end;
    straight.nx = at->rx;
    straight.ny = at->ry;
    straight.cos = 1.0;
    straight.sin = 0.0;
    const rf_exponent here = exponent(map, &edge, map->x.last, 0.0, 2, rate, here_by_rate);
    const rf_exponent towards = exponent(map, &straight, map->x.last, 0.0, 2, rate, by_rate);
    rf_at_wall(map->slenderness, end, 1.0, 0.0, &full);
    const double kept = -exp(towards.value) / full.value;
    const rf_share part = left(kept, kept * (end * towards.across + towards.turn), end, at->chi);
    const double of_rate[3] = {here_by_rate[0], here_by_rate[1], left(kept, kept * by_rate[0], end, at->chi).side};
    const double value = -exp(here.value), turn = value * here.turn;
    const double turned[2] = {end * value * here.across + turn, end * (turn * here.across + value * here.turn_across)
                              + value * (here.turn * here.turn + here.turn_turn)};
    const double *growing = map->growth.coefficients ? of_rate : NULL;
    return rf_go_to_wall(map->slenderness, end, at, &here, &part, turned, growing, f, jacobian);
}

int rf_groove_film(const void *of, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_map *map = of;
    const int grown = map->growth.coefficients != NULL;
    rf_frame at;
    double slope = 0.0, by_rate[3];
    const double rate = grown ? w[2] : 0.0;
    const int status = isfinite(rate) ? rf_orient(e, w, &at) : RF_NOT_FINITE;
    for (int k = 8; jacobian && grown && k < 10; ++k)
        jacobian[k] = 0.0;
    if (status == RF_UNDEFINED)
        return rf_rest(f, jacobian);
    if (status != RF_OK)
        return rf_fail(status, f, jacobian, 8);
    const double x = rf_stretch(at.chi, jacobian ? &slope : NULL);
    if (x > map->x.last * (1.0 + RF_ROUNDING))
        return beyond(map, &at, rate, f, jacobian);
    const rf_exponent here = exponent(map, &at, x, slope, jacobian ? 2 : 0, rate, by_rate);
    rf_set_answer(&at, -exp(here.value), &here, at.rx, at.ry, f, jacobian);
    if (jacobian && grown)
        rf_set_rate(&at, -exp(here.value), by_rate, f, jacobian);
    return rf_judge(by_rate[2] > 0.0 ? HUGE_VAL : x, map->x.last, f, jacobian);
}
