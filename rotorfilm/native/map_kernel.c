#include "map_kernel.h"

#include <math.h>

#include "quintic.h"

#define CENTER 1e-8       /* eccentricity ratio below which w = 0 has a derivative, by isotropy */

/* M and the derivatives of it that the force and its Jacobian need; s = cos = 2 T - 1. */
typedef struct field {
    double m, m_x, m_s, m_xs, m_ss;
} field;

/* e and w in the axes n = w/|w| and z^ x n. */
typedef struct frame {
    double size, nx, ny, chi, cos, sin;
} frame;

size_t rf_spline_weights(double at, int32_t cells, double weights[RF_ORDER])
{
    double rest;
    const int32_t first = rf_cell(at, cells, &rest);
    rf_values(rest, weights);
    return (size_t)first;
}

static const double *place(const rf_map *map, double x, double s, double *u, double *v)
{
    const int32_t i = rf_cell(x / map->x_end * map->cells_x, map->cells_x, u);
    const int32_t j = rf_cell(0.5 * (1.0 + s) * map->cells_t, map->cells_t, v);
    return map->coefficients + (size_t)i * (size_t)(map->cells_t + RF_ORDER - 1) + (size_t)j;
}

static field value_field(const rf_map *map, double x, double s)
{
    double u, v, b[RF_ORDER], row[RF_ORDER];
    const double *c = place(map, x, s, &u, &v);
    field at = {0.0, 0.0, 0.0, 0.0, 0.0};
    rf_values(u, b);
    rf_rows(c, (size_t)(map->cells_t + RF_ORDER - 1), b, row);
    rf_values(v, b);
    at.m = rf_dot(row, b);
    rf_slopes(v, b);
    at.m_s = 0.5 * map->cells_t * rf_dot(row, b);
    return at;
}

static field full_field(const rf_map *map, double x, double s)
{
    double u, v, b[RF_ORDER], b_s[RF_ORDER], b_ss[RF_ORDER], row[RF_ORDER], row_x[RF_ORDER];
    const double *c = place(map, x, s, &u, &v);
    const size_t stride = (size_t)(map->cells_t + RF_ORDER - 1);
    const double per_x = map->cells_x / map->x_end, per_s = 0.5 * map->cells_t;
    field at;
    rf_values(u, b);
    rf_rows(c, stride, b, row);
    rf_slopes(u, b);
    rf_rows(c, stride, b, row_x);
    rf_values(v, b);
    rf_slopes(v, b_s);
    rf_curvatures(v, b_ss);
    at.m = rf_dot(row, b);
    at.m_s = per_s * rf_dot(row, b_s);
    at.m_ss = per_s * per_s * rf_dot(row, b_ss);
    at.m_x = per_x * rf_dot(row_x, b);
    at.m_xs = per_x * per_s * rf_dot(row_x, b_s);
    return at;
}

/* Beyond the last node M goes on linearly in ln X: J is a power of X, as in thin films. */
static field continued_field(const rf_map *map, double x, double s)
{
    double u, v, b[RF_ORDER], row[RF_ORDER];
    const double *c = place(map, map->x_end, s, &u, &v);
    const double per_s = 0.5 * map->cells_t, far = map->x_end * log(x / map->x_end);
    field at = full_field(map, map->x_end, s);
    rf_slopes(u, b);
    rf_rows(c, (size_t)(map->cells_t + RF_ORDER - 1), b, row);
    rf_curvatures(v, b);
    at.m += far * at.m_x;
    at.m_s += far * at.m_xs;
    at.m_ss += far * map->cells_x / map->x_end * per_s * per_s * rf_dot(row, b);
    at.m_x *= map->x_end / x;
    at.m_xs *= map->x_end / x;
    return at;
}

static int orient(const double *e, const double *w, frame *at)
{
    if (!isfinite(e[0]) || !isfinite(e[1]) || !isfinite(w[0]) || !isfinite(w[1]))
        return RF_NOT_FINITE;
    at->chi = rf_length(e[0], e[1]);
    if (at->chi >= 1.0)
        return RF_CONTACT;
    at->size = rf_length(w[0], w[1]);
    if (at->size == 0.0)
        return RF_UNDEFINED;
    at->nx = w[0] / at->size;
    at->ny = w[1] / at->size;
    /* At the center no direction is special, and M(0, T), linear in T, makes any one do. */
    at->cos = at->chi > 0.0 ? (e[0] * at->nx + e[1] * at->ny) / at->chi : 1.0;
    at->sin = at->chi > 0.0 ? (e[1] * at->nx - e[0] * at->ny) / at->chi : 0.0;
    return RF_OK;
}

static int fail(int status, double *values_out, int count)
{
    for (int i = 0; i < count; ++i)
        values_out[i] = NAN;
    return status;
}

/* F = |w| E (2 n + M_s (e.m) m), m = z^ x n, E = J/|w|^2. */
static void set_force(const frame *at, double potential, double turn, double *f)
{
    const double along = 2.0 * at->size * potential, across = at->size * potential * turn;
    f[0] = along * at->nx - across * at->ny;
    f[1] = along * at->ny + across * at->nx;
}

static int force(const rf_map *map, const double *e, const double *w, double *f)
{
    frame at;
    const int status = orient(e, w, &at);
    if (status == RF_UNDEFINED) {
        f[0] = f[1] = 0.0;
        return RF_OK;
    }
    if (status != RF_OK)
        return fail(status, f, 2);
    const double x = rf_stretch(at.chi, NULL);
    const int outside = x > map->x_end * (1.0 + 1e-12);
    const field m = outside ? continued_field(map, x, at.cos) : value_field(map, x, at.cos);
    set_force(&at, -exp(map->center + at.chi * m.m), m.m_s * at.chi * at.sin, f);
    if (!isfinite(f[0]) || !isfinite(f[1]))
        return fail(RF_NOT_FINITE, f, 2);
    return outside ? RF_OUTSIDE : RF_OK;
}

/* Turn a tensor from the axes (n, m) to (x, y); columns `first` and `first` + 1 of the Jacobian. */
static void set_columns(const frame *at, const double t[4], int first, double *jacobian)
{
    const double c = at->nx, s = at->ny;
    const double nx = t[0] * c - t[1] * s, ny = t[0] * s + t[1] * c;
    const double mx = t[2] * c - t[3] * s, my = t[2] * s + t[3] * c;
    jacobian[first] = c * nx - s * mx;
    jacobian[first + 1] = c * ny - s * my;
    jacobian[first + 4] = s * nx + c * mx;
    jacobian[first + 5] = s * ny + c * my;
}

/* Derivatives of the force. With Phi = chi M and D = dPhi/dangle = M_s chi sin, the angle being that of w,
   F = |w| E (2 n + D m). Written in sin and cos of the angle from w to e nothing is divided by chi. */
static void set_jacobian(const frame *at, double slope, const field *m, double potential, double *jacobian)
{
    const double c = at->cos, s = at->sin, chi = at->chi;
    const double radial = m->m + chi * m->m_x * slope;
    const double phi_n = radial * c + m->m_s * s * s, phi_m = (radial - m->m_s * c) * s;
    const double turn = m->m_s * chi * s, bent = chi * slope * m->m_xs;
    const double turn_n = s * (bent * c + m->m_ss * s * s);
    const double turn_m = m->m_s + s * s * (bent - m->m_ss * c);
    const double turn_turn = chi * (m->m_ss * s * s - m->m_s * c);
    const double k = at->size * potential;
    const double by_e[4] = {2.0 * k * phi_n, 2.0 * k * phi_m, k * (phi_n * turn + turn_n),
                            k * (phi_m * turn + turn_m)};
    const double by_w[4] = {2.0 * potential, potential * turn, potential * turn,
                            potential * (2.0 + turn * turn + turn_turn)};
    set_columns(at, by_e, 0, jacobian);
    set_columns(at, by_w, 2, jacobian);
}

/* Without source: isotropic damping at the center, no derivative elsewhere. */
static int resting(const rf_map *map, double chi, double *f, double *jacobian)
{
    f[0] = f[1] = 0.0;
    if (chi > CENTER)
        return fail(RF_UNDEFINED, jacobian, 8);
    for (int i = 0; i < 8; ++i)
        jacobian[i] = 0.0;
    jacobian[2] = jacobian[7] = -2.0 * exp(map->center);
    return RF_OK;
}

static int is_finite(const double *x, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += 0.0 * x[i];
    return sum == 0.0;
}

static int derive(const rf_map *map, const double *e, const double *w, double *f, double *jacobian)
{
    frame at;
    double slope;
    const int status = orient(e, w, &at);
    if (status == RF_UNDEFINED)
        return resting(map, at.chi, f, jacobian);
    if (status != RF_OK) {
        fail(status, f, 2);
        return fail(status, jacobian, 8);
    }
    const double x = rf_stretch(at.chi, &slope);
    const int outside = x > map->x_end * (1.0 + 1e-12);
    const field m = outside ? continued_field(map, x, at.cos) : full_field(map, x, at.cos);
    const double potential = -exp(map->center + at.chi * m.m);
    set_force(&at, potential, m.m_s * at.chi * at.sin, f);
    set_jacobian(&at, slope, &m, potential, jacobian);
    if (!is_finite(f, 2) || !is_finite(jacobian, 8)) {
        fail(RF_NOT_FINITE, f, 2);
        return fail(RF_NOT_FINITE, jacobian, 8);
    }
    return outside ? RF_OUTSIDE : RF_OK;
}

int rf_map_force(const rf_map *map, const double *e, const double *w, double *f)
{
    return force(map, e, w, f);
}

int rf_map_jacobian(const rf_map *map, const double *e, const double *w, double *f, double *jacobian)
{
    return derive(map, e, w, f, jacobian);
}

int rf_map_force_batch(const rf_map *map, size_t n, const double *e, size_t e_stride, const double *w,
                       size_t w_stride, double *f, size_t f_stride, size_t *first)
{
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double at[2] = {e[i], e[e_stride + i]}, source[2] = {w[i], w[w_stride + i]};
        double one[2];
        const int status = force(map, at, source, one);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        f[i] = one[0];
        f[f_stride + i] = one[1];
    }
    return worst;
}

int rf_map_jacobian_batch(const rf_map *map, size_t n, const double *e, size_t e_stride, const double *w,
                          size_t w_stride, double *f, size_t f_stride, double *jacobian,
                          size_t jacobian_stride, size_t *first)
{
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double at[2] = {e[i], e[e_stride + i]}, source[2] = {w[i], w[w_stride + i]};
        double one[2], all[8];
        const int status = derive(map, at, source, one, all);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        f[i] = one[0];
        f[f_stride + i] = one[1];
        for (size_t k = 0; k < 8; ++k)
            jacobian[k * jacobian_stride + i] = all[k];
    }
    return worst;
}
