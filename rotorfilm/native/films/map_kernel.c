#include "map_kernel.h"

#include <math.h>

#include "wall.h"
#include "map_frame.h"

#define SAME 0.05         /* relative difference from the film at the wall, of a map that has it as its limit */
#define CENTER 1e-8       /* eccentricity ratio below which w = 0 has a derivative, by isotropy */

/* M and the derivatives of it that the force and its Jacobian need; s = cos = 2 T - 1. */
typedef struct field {
    double m, m_x, m_s, m_xs, m_ss;
} field;

static const double *place(const rf_map *map, double x, double s, double *u, double *v)
{
    const int32_t i = rf_cell(x / map->x_end * map->cells_x, map->cells_x, u);
    const int32_t j = rf_cell(0.5 * (1.0 + s) * map->cells_t, map->cells_t, v);
    return map->coefficients + (size_t)i * (size_t)(map->cells_t + RF_ORDER - 1) + (size_t)j;
}

/* What the force needs, and the rest if `full`, as it must be beyond the last node: there M goes on linearly
   in ln X: J is a power of X, as in thin films. */
static field look_up(const rf_map *map, double x, double s, int full)
{
    const int outside = x > map->x_end;
    double u, v, b[RF_ORDER], b_s[RF_ORDER], row[RF_ORDER], row_x[RF_ORDER];
    const double *c = place(map, outside ? map->x_end : x, s, &u, &v);
    const size_t stride = (size_t)(map->cells_t + RF_ORDER - 1);
    const double per_x = map->cells_x / (outside ? x : map->x_end), per_s = 0.5 * map->cells_t;
    field at;
    rf_values(u, b);
    rf_rows(c, stride, b, row);
    if (full) {
        rf_slopes(u, b);
        rf_rows(c, stride, b, row_x);
        for (int j = 0; outside && j < RF_ORDER; ++j)
            row[j] += map->cells_x * log(x / map->x_end) * row_x[j];
    }
    rf_values(v, b);
    rf_slopes(v, b_s);
    at.m = rf_dot(row, b);
    at.m_s = per_s * rf_dot(row, b_s);
    if (full) {
        at.m_x = per_x * rf_dot(row_x, b);
        at.m_xs = per_x * per_s * rf_dot(row_x, b_s);
        rf_curvatures(v, b);
        at.m_ss = per_s * per_s * rf_dot(row, b);
    }
    return at;
}

/* At the last node. */
static RF_ONCE field at_end(const rf_map *map, double s)
{
    return look_up(map, map->x_end, s, 1);
}

/* Derivatives of the force. With Phi = chi M and D = dPhi/dangle = M_s chi sin, the angle being that of w,
   F = |w| E (2 n + D m). Written in sin and cos of the angle from w to e nothing is divided by chi. */
static void set_jacobian(const rf_frame *at, double slope, const field *m, double potential, double *jacobian)
{
    const double c = at->cos, s = at->sin, chi = at->chi;
    const double radial = m->m + chi * m->m_x * slope;
    const double phi_n = radial * c + m->m_s * s * s, phi_m = (radial - m->m_s * c) * s;
    const double turn = m->m_s * chi * s, bent = chi * slope * m->m_xs;
    const double turn_n = s * (bent * c + m->m_ss * s * s);
    const double turn_m = m->m_s + s * s * (bent - m->m_ss * c);
    const double k = at->size * potential;
    const double by_e[4] = {2.0 * k * phi_n, 2.0 * k * phi_m, k * (phi_n * turn + turn_n),
                            k * (phi_m * turn + turn_m)};
    rf_set_columns(at, at->nx, at->ny, by_e, 0, jacobian);
    rf_set_damping(at, potential, turn, chi * (m->m_ss * s * s - m->m_s * c), jacobian);
}

/* Without source: isotropic damping at the center, no derivative elsewhere. */
static int resting(const rf_map *map, double chi, double *f, double *jacobian)
{
    if (!jacobian || chi > CENTER)
        return rf_rest(f, jacobian);
    f[0] = f[1] = 0.0;
    for (int i = 0; i < 8; ++i)
        jacobian[i] = 0.0;
    jacobian[2] = jacobian[7] = -2.0 * exp(map->center);
    return RF_OK;
}

/* Beyond the last node: J there, and what the film at the wall gains from there on. */
static RF_ONCE int beyond(const rf_map *map, const rf_frame *at, double x, double *f, double *jacobian)
{
    const double end = rf_unstretch(map->x_end), c = at->cos, s = -at->sin;
    const field m = at_end(map, c);
    const double value = -exp(map->center + end * m.m), turn = -end * m.m_s * s;
    rf_potential e = {value, value * turn, value * (turn * turn + end * (m.m_ss * s * s - m.m_s * c)), 0.0, 0.0};
    rf_potential gain;
    rf_wall_gain(map->slenderness, end, at->chi, c, s, &gain);
    rf_add_gain(&gain, map->share, &e);
    rf_set_film(at, &e, 0.0, 0.0, f, jacobian);
    return rf_judge(x, map->x_end, f, jacobian);
}

void rf_map_to_wall(rf_map *map, double slenderness, double share)
{
    rf_potential full;
    const double end = rf_unstretch(map->x_end);
    const double towards = exp(map->center + end * at_end(map, 1.0).m);
    const double away = exp(map->center + end * at_end(map, -1.0).m);
    map->slenderness = 0.0;
    map->share = share;
    if (!(slenderness > 0.0))
        return;
    rf_at_wall(slenderness, end, 1.0, 0.0, &full);
    if (fabs(towards / (-share * full.value) - 1.0) < SAME && away < 0.5 * towards)
        map->slenderness = slenderness;
}

int rf_map_error(const rf_map *map)
{
    return map->slenderness > 0.0 ? rf_wall_error(map->x_end) : 0;
}

int rf_map_film(const void *of, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_map *map = of;
    rf_frame at;
    const int status = rf_orient(e, w, &at);
    if (status == RF_UNDEFINED)
        return resting(map, at.chi, f, jacobian);
    if (status != RF_OK)
        return rf_fail(status, f, jacobian, 8);
    double slope = 0.0;
    const double x = rf_stretch(at.chi, jacobian ? &slope : NULL);
    if (x > map->x_end * (1.0 + 1e-12) && map->slenderness > 0.0)
        return beyond(map, &at, x, f, jacobian);
    const field m = look_up(map, x, at.cos, jacobian || x > map->x_end);
    const double potential = -exp(map->center + at.chi * m.m);
    rf_set_force(&at, potential, m.m_s * at.chi * at.sin, f);
    if (jacobian)
        set_jacobian(&at, slope, &m, potential, jacobian);
    return rf_judge(x, map->x_end, f, jacobian);
}
