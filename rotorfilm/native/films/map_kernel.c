#include "map_kernel.h"

#include <math.h>

#include "map_frame.h"
#include "map_spline.h"
#include "wall.h"

#define SAME 0.05   /* relative difference from the film at the wall, of a map that has it as its limit */
#define CENTER 1e-8 /* eccentricity ratio below which w = 0 has a derivative, by isotropy */

/* M of a plain map at X and cos; beyond the last node linear in ln X, so that J is a power of X, as in thin films. */
static RF_INLINE rf_spline plain_spline(const rf_map *map, double x, const double *y, double c, int order)
{
    const int outside = x > map->x.last, axes = y ? 3 : 2;
    const rf_axis cosine = {map->s.cells, -1.0, 1.0};
    const size_t width = rf_width(&map->s), stride[2] = {y ? width * rf_width(&map->y) : width, width};
    rf_weights by[3];
    rf_spline m;
    rf_weigh_from_zero(&map->x, outside ? map->x.last : x, order > 0, by);
    if (order > 0 && outside) {
        rf_weigh_beyond(map->x.cells * log(x / map->x.last), by);
        by->per = map->x.cells / x;
    }
    rf_weigh_between(&cosine, c, order > 0 ? 2 : 1, by + 2);
    if (y)
        rf_weigh_from_zero(&map->y, *y, order > 0, by + 1);
    rf_evaluate(map->coefficients, axes, order, stride, by, &m);
    return m;
}

/* Of a plain film, along the source. In sin and cos of the angle from w to e nothing is divided by chi. */
static RF_INLINE rf_exponent exponent_of(double center, const rf_spline *of_m, const rf_frame *at, double slope, int order)
{
    const double c = at->cos, s = at->sin, chi = at->chi;
    const rf_spline m = *of_m;
    const double turn = m.m_s * chi * s;
    rf_exponent of = {center + chi * m.m, 0.0, 0.0, turn, 0.0, 0.0, 0.0};
    if (order > 0) {
        const double radial = m.m + chi * m.m_x * slope, bent = chi * slope * m.m_xs;
        of.along = radial * c + m.m_s * s * s;
        of.across = (radial - m.m_s * c) * s;
        of.turn_along = s * (bent * c + m.m_ss * s * s);
        of.turn_across = m.m_s + s * s * (bent - m.m_ss * c);
        of.turn_turn = chi * (m.m_ss * s * s - m.m_s * c);
    }
    return of;
}

static RF_INLINE rf_exponent plain_exponent(const rf_map *map, const rf_frame *at, double x, double slope, int order)
{
    const rf_spline m = plain_spline(map, x, NULL, at->cos, order);
    return exponent_of(map->center[0], &m, at, slope, order);
}

/* L at the last node. */
static RF_ONCE rf_exponent plain_end(const rf_map *map, double chi, double c, double s)
{
    const rf_frame edge = {0.0, 0.0, 0.0, chi, 0.0, 0.0, c, s};
    return plain_exponent(map, &edge, map->x.last, 0.0, 2);
}

static int plain_beyond(const rf_map *map, const rf_frame *at, double *f, double *jacobian)
{
    const double end = rf_unstretch(map->x.last);
    const rf_exponent here = plain_end(map, end, at->cos, at->sin);
    const rf_share part = {map->share, 0.0, 0.0};
    const double turned[2] = {0.0, 0.0};
    return rf_go_to_wall(map->slenderness, end, at, &here, &part, turned, NULL, f, jacobian);
}

/* Without source: isotropic damping at the center, no derivative elsewhere. */
static int resting(double center, double chi, double *f, double *jacobian)
{
    if (!jacobian || chi > CENTER)
        return rf_rest(f, jacobian);
    f[0] = f[1] = 0.0;
    for (int i = 0; i < 8; ++i)
        jacobian[i] = 0.0;
    jacobian[2] = jacobian[7] = -2.0 * exp(center);
    return RF_OK;
}

int rf_map_film(const void *of, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_map *map = of;
    rf_frame at;
    double slope = 0.0;
    const int status = rf_orient(e, w, &at);
    if (status == RF_UNDEFINED)
        return resting(map->center[0], at.chi, f, jacobian);
    if (status != RF_OK)
        return rf_fail(status, f, jacobian, 8);
    const double x = rf_stretch(at.chi, jacobian ? &slope : NULL);
    const int outside = x > map->x.last * (1.0 + RF_ROUNDING);
    if (outside && map->slenderness > 0.0)
        return plain_beyond(map, &at, f, jacobian);
    const rf_exponent here = plain_exponent(map, &at, x, slope, jacobian || x > map->x.last ? 2 : 0);
    rf_set_answer(&at, -exp(here.value), &here, at.nx, at.ny, f, jacobian);
    return rf_judge(x, map->x.last, f, jacobian);
}

int rf_sped_film(const void *of, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_map *map = of;
    rf_frame at;
    rf_weights by;
    double slope = 0.0;
    const int status = rf_orient(e, w, &at);
    const double reynolds = fabs(w[2]) * map->per_rate, y = log1p(reynolds / map->scale), held = fmin(y, map->y.last);
    rf_weigh_from_zero(&map->y, held, 1, &by);
    const double center = rf_dot(map->center + by.cell, by.value);
    if (status != RF_UNDEFINED && (status != RF_OK || !isfinite(w[2])))
        return rf_fail(status == RF_OK ? RF_NOT_FINITE : status, f, jacobian, 10);
    for (int k = 8; jacobian && k < 10; ++k)
        jacobian[k] = 0.0;
    if (status == RF_UNDEFINED)
        return resting(center, at.chi, f, jacobian);
    const double x = rf_stretch(at.chi, jacobian ? &slope : NULL);
    const rf_spline m = plain_spline(map, x, &held, at.cos, 2);
    const rf_exponent here = exponent_of(center, &m, &at, slope, 2);
    const double potential = -exp(here.value);
    rf_set_answer(&at, potential, &here, at.nx, at.ny, f, jacobian);
    if (jacobian && y <= map->y.last && w[2] != 0.0) {
        const double per = copysign(map->per_rate / (map->scale + reynolds), w[2]);
        const double grown = per * (by.per * rf_dot(map->center + by.cell, by.slope) + at.chi * m.m_y);
        const double by_rate[2] = {grown, per * at.chi * at.sin * m.m_ys};
        rf_set_rate(&at, potential, by_rate, f, jacobian);
    }
    return rf_judge(fmax(x / map->x.last, y / map->y.last), 1.0, f, jacobian);
}

void rf_map_to_wall(rf_map *map)
{
    rf_potential full;
    const double end = rf_unstretch(map->x.last), slenderness = map->slenderness;
    const double towards = exp(plain_end(map, end, 1.0, 0.0).value), away = exp(plain_end(map, end, -1.0, 0.0).value);
    map->slenderness = 0.0;
    if (!(slenderness > 0.0))
        return;
    rf_at_wall(slenderness, end, 1.0, 0.0, &full);
    if (fabs(towards / (-map->share * full.value) - 1.0) < SAME && away < 0.5 * towards)
        map->slenderness = slenderness;
}

int rf_map_error(const rf_map *map)
{
    return map->slenderness > 0.0 && !map->eased ? rf_wall_error(map->x.last) : 0;
}

/* u and Y of a place, and their derivatives: u does not depend on eta. */
typedef struct place {
    double u, u_xi, y, y_xi, y_eta;
} place;

/* The journal's place on a pad, or RF_AT_WALL. */
static inline int set_place(const rf_map *map, const double *e, int full, place *at)
{
    const double xi = e[0], eta = e[1], gap = 1.0 - xi;
    const int round = xi > map->cosine;
    if (!(gap > 0.0))
        return RF_AT_WALL;
    const double wall = round ? sqrt(gap * (1.0 + xi)) : (1.0 - xi * map->cosine) / map->sine;
    const double low = wall + eta, high = wall - eta;
    if (!(low > 0.0 && high > 0.0))
        return RF_AT_WALL;
    at->u = -log(gap);
    at->y = 0.5 * log(low / high);
    if (full) {
        const double bent = round ? -xi / wall : -map->cosine / map->sine;
        at->u_xi = 1.0 / gap;
        at->y_eta = wall / (low * high);
        at->y_xi = -eta * bent / (low * high);
    }
    return RF_OK;
}

/* Whether a place is beyond the nodes of an axis, on which splines then go on linearly. */
static inline int weigh_open(const rf_axis *axis, double at, int order, rf_weights *by)
{
    const double within = fmin(fmax(at, axis->first), axis->last);
    const int outside = fabs(at - within) > RF_ROUNDING;
    rf_weigh_between(axis, within, order > 0 || outside, by);
    if (outside)
        rf_weigh_beyond((at - within) * by->per, by);
    return outside;
}

/* The same of cubic splines. */
static void weigh_growth(const rf_axis *axis, double at, rf_weights *by)
{
    const double within = fmin(fmax(at, axis->first), axis->last), per = axis->cells / (axis->last - axis->first);
    rf_weigh_cubic((within - axis->first) * per, axis->cells, per, by);
    for (int j = 0; j < RF_CUBIC; ++j)
        by->value[j] += (at - within) * per * by->slope[j];
}

/* At order 2 or 0, with L = 5 ln s + M. */
static inline int pad_film(const rf_map *map, const double *e, const double *w, int order, double *f, double *jacobian)
{
    const double state[4] = {e[0], e[1], w[0], w[1]};
    const size_t strides[] = {rf_width(&map->y) * rf_width(&map->s), rf_width(&map->s)};
    rf_frame to;
    place at = {0.0, 0.0, 0.0, 0.0, 0.0};
    rf_weights by[3];
    rf_spline m = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    if (rf_is_broken(state, 4) || (map->growth.coefficients && !isfinite(w[2])))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 8);
    for (int k = 8; jacobian && map->growth.coefficients && k < 10; ++k)
        jacobian[k] = 0.0;
    if (set_place(map, e, order > 0, &at) != RF_OK)
        return rf_fail(RF_AT_WALL, f, jacobian, 8);
    to.size = rf_length(w[0], w[1]);
    if (to.size == 0.0)
        return rf_rest(f, jacobian);
    to.nx = w[0] / to.size;
    to.ny = w[1] / to.size;
    const double s = to.nx + map->sine;
    if (!(s > 0.0)) {
        f[0] = f[1] = 0.0;
        for (int k = 0; order > 0 && k < 8; ++k)
            jacobian[k] = 0.0;
        return RF_OK;
    }
    int outside = weigh_open(&map->x, at.u, order, by);
    outside |= weigh_open(&map->y, at.y, order, by + 1);
    const double phi = 2.0 * atan(to.ny / (1.0 + to.nx));
    rf_weigh_between(&map->s, phi, order > 0 ? 2 : 1, by + 2);
    rf_evaluate(map->coefficients, 3, order, strides, by, &m);
    double per = 0.0, by_rate[2] = {0.0, 0.0};
    if (map->growth.coefficients) {
        const rf_map_growth *growth = &map->growth;
        rf_weights rate;
        outside |= rf_weigh_rate(growth, w[2], &rate, &per);
        weigh_growth(&growth->x, at.u, by);
        weigh_growth(&growth->y, at.y, by + 1);
        rf_weigh_between(&growth->s, phi, order > 0 ? 2 : 1, by + 2);
        rf_grow(growth, by, &rate, order, &m, by_rate);
    }
    const rf_exponent slopes = {m.m, m.m_x * at.u_xi + m.m_y * at.y_xi, m.m_y * at.y_eta, m.m_s - 5.0 * to.ny / s,
                                m.m_xs * at.u_xi + m.m_ys * at.y_xi, m.m_ys * at.y_eta,
                                m.m_ss - 5.0 * (1.0 + to.nx * map->sine) / (s * s)};
    const double potential = -(s * s) * (s * s) * s * exp(m.m);
    rf_set_answer(&to, potential, &slopes, 1.0, 0.0, f, jacobian);
    if (order > 0 && map->growth.coefficients) {
        by_rate[0] *= per;
        by_rate[1] *= per;
        rf_set_rate(&to, potential, by_rate, f, jacobian);
    }
    return rf_judge(outside, 0.0, f, jacobian);
}

int rf_pad_film(const void *map, const double *e, const double *w, double *f, double *jacobian)
{
    return jacobian ? pad_film(map, e, w, 2, f, jacobian) : pad_film(map, e, w, 0, f, NULL);
}
