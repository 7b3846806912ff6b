#include "groove_kernel.h"

#include <math.h>

#include "wall.h"
#include "map_frame.h"

#define EDGE (-0.414) /* sinh(ln(s)/3) of a contact at the edge: .23 of a film between parabola and edge is left */
#define LEAST 1e-9    /* share of the film at the wall */
#define MOST 0.999

/* Of ln(-J/|w|^2) = L: its derivatives along and across e, those of L in the angle of w, and both. With
   chi factored out nothing is divided by it. */
typedef struct field {
    double value, along, across, turn, turn_along, turn_across, turn_turn;
} field;

/* M and its derivatives in X, theta and s. */
typedef struct spline {
    double m, m_x, m_e, m_s, m_xs, m_es, m_ss;
} spline;

static RF_ONCE void values(double u, double b[RF_ORDER])
{
    rf_values(u, b);
}

static RF_ONCE void slopes(double u, double b[RF_ORDER])
{
    rf_slopes(u, b);
}

static RF_ONCE void rows(const double *block, const double b[RF_ORDER], double sum[RF_ORDER])
{
    rf_rows(block, RF_ORDER, b, sum);
}

/* Sums over X of a block of 6 x 6 coefficients under theta and s. */
static RF_ONCE void layers(const double *c, size_t layer, size_t row, const double b[RF_ORDER],
                   double sum[RF_ORDER * RF_ORDER])
{
    for (size_t j = 0; j < RF_ORDER; ++j)
        rf_rows(c + j * row, layer, b, sum + j * RF_ORDER);
}

static const double *place(const rf_groove_map *map, double x, double theta, double s, double rest[3])
{
    const size_t row = (size_t)map->cells_s + RF_ORDER - 1;
    const size_t layer = ((size_t)map->cells_e + RF_ORDER - 1) * row;
    const size_t i = (size_t)rf_cell(x / map->x_end * map->cells_x, map->cells_x, rest);
    const size_t j = (size_t)rf_turned(theta, map->cells_e, rest + 1);
    const size_t k = (size_t)rf_turned(s, map->cells_s, rest + 2);
    return map->coefficients + i * layer + j * row + k;
}

/* M and m_s, and the rest if `full`. */
static spline look_up(const rf_groove_map *map, double x, double theta, double s, int full)
{
    double rest[3], b[RF_ORDER], b_s[RF_ORDER], row[RF_ORDER], row_x[RF_ORDER], row_e[RF_ORDER];
    double block[RF_ORDER * RF_ORDER], block_x[RF_ORDER * RF_ORDER];
    const double *c = place(map, x, theta, s, rest);
    const size_t width = (size_t)map->cells_s + RF_ORDER - 1;
    const size_t layer = ((size_t)map->cells_e + RF_ORDER - 1) * width;
    const double per_x = map->cells_x / map->x_end;
    const double per_e = map->cells_e / RF_TURN, per_s = map->cells_s / RF_TURN;
    spline at = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    values(rest[0], b);
    layers(c, layer, width, b, block);
    if (full) {
        slopes(rest[0], b);
        layers(c, layer, width, b, block_x);
    }
    values(rest[1], b);
    rows(block, b, row);
    if (full) {
        rows(block_x, b, row_x);
        slopes(rest[1], b);
        rows(block, b, row_e);
    }
    values(rest[2], b);
    slopes(rest[2], b_s);
    at.m = rf_dot(row, b);
    at.m_s = per_s * rf_dot(row, b_s);
    if (full) {
        at.m_x = per_x * rf_dot(row_x, b);
        at.m_e = per_e * rf_dot(row_e, b);
        at.m_xs = per_x * per_s * rf_dot(row_x, b_s);
        at.m_es = per_e * per_s * rf_dot(row_e, b_s);
        rf_curvatures(rest[2], b);
        at.m_ss = per_s * per_s * rf_dot(row, b);
    }
    return at;
}

/* L0 and its first two derivatives. */
static void center(const rf_groove_map *map, double phi, double out[3])
{
    double rest, b[RF_ORDER];
    const double *c = map->center + rf_turned(phi, map->cells_w, &rest);
    const double per = map->cells_w / RF_TURN;
    values(rest, b);
    out[0] = rf_dot(c, b);
    slopes(rest, b);
    out[1] = per * rf_dot(c, b);
    rf_curvatures(rest, b);
    out[2] = per * per * rf_dot(c, b);
}

static field film(const rf_groove_map *map, const rf_frame *at, double x, double slope, int full)
{
    const double q = map->squeeze, c = at->cos, s = -at->sin, chi = at->chi;
    const double bent = c * c + q * q * s * s;
    const double by_b = q / bent, by_bb = 2.0 * q * (1.0 - q * q) * s * c / (bent * bent);
    const double theta = atan2(at->ry, at->rx) - map->axis, angle = atan2(q * s, c);
    const spline m = look_up(map, x, theta, angle, full);
    const double m_b = m.m_s * by_b, m_bb = m.m_ss * by_b * by_b + m.m_s * by_bb;
    double zero[3];
    center(map, atan2(at->ny, at->nx) - map->axis, zero);
    const field all = {
        zero[0] + chi * m.m,
        m.m + chi * slope * m.m_x,
        m.m_e - m_b,
        zero[1] + chi * m_b,
        m_b + chi * slope * m.m_xs * by_b,
        m.m_es * by_b - m_bb,
        zero[2] + chi * m_bb,
    };
    return all;
}

/* The share of the film at the wall that the openings leave, and its derivatives in the angle of e and in chi. */
typedef struct share {
    double value, side, slope;
} share;

/* The share at chi from that at chi_end. It is s/(1 + s), s = (y + sqrt(1 + y^2))^3, y = EDGE + a distance to the
   edge in widths of the film, as of a long film: to infinity on land, to minus infinity in an opening. */
static share left(double kept, double kept_side, double chi_end, double chi)
{
    const double bounded = fmin(fmax(kept, LEAST), MOST), g = (1.0 - chi) * (1.0 + chi);
    const double z = log(bounded / (1.0 - bounded)) / 3.0, distance = sinh(z) - EDGE;
    const double narrowing = sqrt((1.0 - chi_end) * (1.0 + chi_end) / g), y = EDGE + distance * narrowing;
    const double root = sqrt(1.0 + y * y), base = y > 0.0 ? root + y : 1.0 / (root - y);
    const double value = 1.0 / (1.0 + 1.0 / (base * base * base)), by_y = 3.0 * value * (1.0 - value) / root;
    const double by_kept = bounded == kept ? cosh(z) / (3.0 * kept * (1.0 - kept)) : 0.0;
    const share at = {value, by_y * narrowing * by_kept * kept_side, by_y * distance * narrowing * chi / g};
    return at;
}

/* Beyond the last node: J there, and what the openings leave of the gain of the film at the wall. */
static int beyond(const rf_groove_map *map, const rf_frame *at, double x, double *f, double *jacobian)
{
    const double end = rf_unstretch(map->x_end), S = map->slenderness;
    rf_frame edge = *at, straight = *at;
    edge.chi = straight.chi = end;
    straight.nx = at->rx;
    straight.ny = at->ry;
    straight.cos = 1.0;
    straight.sin = 0.0;
    const field here = film(map, &edge, map->x_end, 0.0, 1), towards = film(map, &straight, map->x_end, 0.0, 1);
    const double value = -exp(here.value), turn = value * here.turn;
    rf_potential e = {value, turn, turn * here.turn + value * here.turn_turn, 0.0, 0.0}, full, gain;
    rf_at_wall(S, end, 1.0, 0.0, &full);
    rf_wall_gain(S, end, at->chi, at->cos, -at->sin, &gain);
    const double kept = -exp(towards.value) / full.value;
    const share part = left(kept, kept * (end * towards.across + towards.turn), end, at->chi);
    const double side = end * value * here.across + turn + part.side * gain.value;
    const double side_turn = end * (turn * here.across + value * here.turn_across) + e.turn_turn
                             + part.side * gain.turn;
    rf_add_gain(&gain, part.value, &e);
    e.slope += part.slope * gain.value;
    e.turn_slope += part.slope * gain.turn;
    rf_set_film(at, &e, side, side_turn, f, jacobian);
    return rf_judge(x, map->x_end, f, jacobian);
}

int rf_groove_error(const rf_groove_map *map)
{
    return rf_wall_error(map->x_end);
}

int rf_groove_film(const void *of, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_groove_map *map = of;
    rf_frame at;
    const int status = rf_orient(e, w, &at);
    if (status == RF_UNDEFINED)
        return rf_rest(f, jacobian);
    if (status != RF_OK)
        return rf_fail(status, f, jacobian, 8);
    double slope = 0.0;
    const double x = rf_stretch(at.chi, jacobian ? &slope : NULL);
    if (x > map->x_end * (1.0 + 1e-12))
        return beyond(map, &at, x, f, jacobian);
    const field here = film(map, &at, x, slope, jacobian != NULL);
    const double potential = -exp(here.value), k = at.size * potential, turn = here.turn;
    const double by_e[4] = {2.0 * k * here.along, 2.0 * k * here.across,
                            k * (here.along * turn + here.turn_along),
                            k * (here.across * turn + here.turn_across)};
    rf_set_force(&at, potential, turn, f);
    if (jacobian) {
        rf_set_columns(&at, at.rx, at.ry, by_e, 0, jacobian);
        rf_set_damping(&at, potential, turn, here.turn_turn, jacobian);
    }
    return rf_judge(x, map->x_end, f, jacobian);
}
