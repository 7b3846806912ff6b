#include "groove_kernel.h"

#include <math.h>

#include "quintic.h"

#define TURN 6.283185307179586476925286766559

/* e and w: |w|, n = w/|w|, r = e/chi, the angle from r to n, and the angles from the axis. */
typedef struct frame {
    double size, nx, ny, chi, rx, ry, cos, sin, theta, phi;
} frame;

/* Of ln(-J/|w|^2) = L: its derivatives along and across e, those of L in the angle of w, and both. With
   chi factored out nothing is divided by it. */
typedef struct field {
    double value, along, across, turn, turn_along, turn_across, turn_turn;
} field;

/* M and its derivatives in X, theta and s. */
typedef struct spline {
    double m, m_x, m_e, m_s, m_xs, m_es, m_ss;
} spline;

static int orient(const rf_groove_map *map, const double *e, const double *w, frame *at)
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
    /* At the center M is A(phi).r, a plane through any direction r. */
    at->rx = at->chi > 0.0 ? e[0] / at->chi : 1.0;
    at->ry = at->chi > 0.0 ? e[1] / at->chi : 0.0;
    at->cos = at->rx * at->nx + at->ry * at->ny;
    at->sin = at->rx * at->ny - at->ry * at->nx;
    at->theta = atan2(at->ry, at->rx) - map->axis;
    at->phi = atan2(at->ny, at->nx) - map->axis;
    return RF_OK;
}

/* Cell of an angle on a turn of uniform nodes. */
static int32_t turned(double angle, int32_t cells, double *rest)
{
    const double turns = angle / TURN;
    return rf_cell((turns - floor(turns)) * cells, cells, rest);
}

/* Sums over X of a block of 6 x 6 coefficients under theta and s. */
static void layers(const double *c, size_t layer, size_t row, const double b[RF_ORDER],
                   double sum[RF_ORDER * RF_ORDER])
{
    for (size_t j = 0; j < RF_ORDER * RF_ORDER; ++j)
        sum[j] = 0.0;
    for (size_t i = 0; i < RF_ORDER; ++i)
        for (size_t j = 0; j < RF_ORDER; ++j)
            for (size_t k = 0; k < RF_ORDER; ++k)
                sum[j * RF_ORDER + k] += b[i] * c[i * layer + j * row + k];
}

static const double *place(const rf_groove_map *map, double x, double theta, double s, double rest[3])
{
    const size_t row = (size_t)map->cells_s + RF_ORDER - 1;
    const size_t layer = ((size_t)map->cells_e + RF_ORDER - 1) * row;
    const size_t i = (size_t)rf_cell(x / map->x_end * map->cells_x, map->cells_x, rest);
    const size_t j = (size_t)turned(theta, map->cells_e, rest + 1);
    const size_t k = (size_t)turned(s, map->cells_s, rest + 2);
    return map->coefficients + i * layer + j * row + k;
}

/* What the force needs: M and its derivative in s. */
static spline value_spline(const rf_groove_map *map, double x, double theta, double s)
{
    double rest[3], b[RF_ORDER], block[RF_ORDER * RF_ORDER], row[RF_ORDER];
    const double *c = place(map, x, theta, s, rest);
    const size_t width = (size_t)map->cells_s + RF_ORDER - 1;
    spline at = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    rf_values(rest[0], b);
    layers(c, ((size_t)map->cells_e + RF_ORDER - 1) * width, width, b, block);
    rf_values(rest[1], b);
    rf_rows(block, RF_ORDER, b, row);
    rf_values(rest[2], b);
    at.m = rf_dot(row, b);
    rf_slopes(rest[2], b);
    at.m_s = map->cells_s / TURN * rf_dot(row, b);
    return at;
}

/* All of it. Beyond the last node M goes on linearly in ln X: J is a power of X, as in thin films. */
static spline full_spline(const rf_groove_map *map, double x, double theta, double s)
{
    const int outside = x > map->x_end;
    double rest[3], b[RF_ORDER], b_s[RF_ORDER], b_ss[RF_ORDER];
    double block[RF_ORDER * RF_ORDER], block_x[RF_ORDER * RF_ORDER];
    double row[RF_ORDER], row_x[RF_ORDER], row_e[RF_ORDER];
    const double *c = place(map, outside ? map->x_end : x, theta, s, rest);
    const size_t width = (size_t)map->cells_s + RF_ORDER - 1;
    const size_t layer = ((size_t)map->cells_e + RF_ORDER - 1) * width;
    const double per_x = map->cells_x / map->x_end * (outside ? map->x_end / x : 1.0);
    const double per_e = map->cells_e / TURN, per_s = map->cells_s / TURN;
    rf_values(rest[0], b);
    layers(c, layer, width, b, block);
    rf_slopes(rest[0], b);
    layers(c, layer, width, b, block_x);
    if (outside)
        for (int j = 0; j < RF_ORDER * RF_ORDER; ++j)
            block[j] += map->cells_x * log(x / map->x_end) * block_x[j];
    rf_values(rest[1], b);
    rf_rows(block, RF_ORDER, b, row);
    rf_rows(block_x, RF_ORDER, b, row_x);
    rf_slopes(rest[1], b);
    rf_rows(block, RF_ORDER, b, row_e);
    rf_values(rest[2], b);
    rf_slopes(rest[2], b_s);
    rf_curvatures(rest[2], b_ss);
    const spline at = {
        rf_dot(row, b),                   per_x * rf_dot(row_x, b),
        per_e * rf_dot(row_e, b),         per_s * rf_dot(row, b_s),
        per_x * per_s * rf_dot(row_x, b_s), per_e * per_s * rf_dot(row_e, b_s),
        per_s * per_s * rf_dot(row, b_ss),
    };
    return at;
}

/* L0 and its first two derivatives. */
static void center(const rf_groove_map *map, double phi, double out[3])
{
    double rest, b[RF_ORDER];
    const double *c = map->center + turned(phi, map->cells_w, &rest);
    const double per = map->cells_w / TURN;
    rf_values(rest, b);
    out[0] = rf_dot(c, b);
    rf_slopes(rest, b);
    out[1] = per * rf_dot(c, b);
    rf_curvatures(rest, b);
    out[2] = per * per * rf_dot(c, b);
}

static field film(const rf_groove_map *map, const frame *at, double x, double slope, int full)
{
    const double q = map->squeeze, c = at->cos, s = at->sin, chi = at->chi;
    const double bent = c * c + q * q * s * s;
    const double by_b = q / bent, by_bb = 2.0 * q * (1.0 - q * q) * s * c / (bent * bent);
    const double angle = atan2(q * s, c);
    const spline m = full ? full_spline(map, x, at->theta, angle) : value_spline(map, x, at->theta, angle);
    const double m_b = m.m_s * by_b, m_bb = m.m_ss * by_b * by_b + m.m_s * by_bb;
    double zero[3];
    center(map, at->phi, zero);
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

static int fail(int status, double *values_out, int count)
{
    for (int i = 0; i < count; ++i)
        values_out[i] = NAN;
    return status;
}

/* F = |w| E (2 n + L_phi m), m = z^ x n, E = J/|w|^2. */
static void set_force(const frame *at, double potential, double turn, double *f)
{
    const double along = 2.0 * at->size * potential, across = at->size * potential * turn;
    f[0] = along * at->nx - across * at->ny;
    f[1] = along * at->ny + across * at->nx;
}

int rf_groove_force(const rf_groove_map *map, const double *e, const double *w, double *f)
{
    frame at;
    const int status = orient(map, e, w, &at);
    if (status == RF_UNDEFINED) {
        f[0] = f[1] = 0.0;
        return RF_OK;
    }
    if (status != RF_OK)
        return fail(status, f, 2);
    const double x = rf_stretch(at.chi, NULL);
    const int outside = x > map->x_end * (1.0 + 1e-12);
    const field here = film(map, &at, x, 0.0, outside);
    set_force(&at, -exp(here.value), here.turn, f);
    if (!isfinite(f[0]) || !isfinite(f[1]))
        return fail(RF_NOT_FINITE, f, 2);
    return outside ? RF_OUTSIDE : RF_OK;
}

/* Turn a tensor with rows along (n, m) and columns along (a, z^ x a) to (x, y). */
static void set_columns(const frame *at, double ax, double ay, const double t[4], int first,
                        double *jacobian)
{
    const double nx = t[0] * ax - t[1] * ay, ny = t[0] * ay + t[1] * ax;
    const double mx = t[2] * ax - t[3] * ay, my = t[2] * ay + t[3] * ax;
    jacobian[first] = at->nx * nx - at->ny * mx;
    jacobian[first + 1] = at->nx * ny - at->ny * my;
    jacobian[first + 4] = at->ny * nx + at->nx * mx;
    jacobian[first + 5] = at->ny * ny + at->nx * my;
}

static int is_finite(const double *x, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += 0.0 * x[i];
    return sum == 0.0;
}

int rf_groove_jacobian(const rf_groove_map *map, const double *e, const double *w, double *f,
                       double *jacobian)
{
    frame at;
    double slope;
    const int status = orient(map, e, w, &at);
    if (status != RF_OK) {
        fail(status, f, 2);
        if (status == RF_UNDEFINED)
            f[0] = f[1] = 0.0;
        return fail(status, jacobian, 8);
    }
    const double x = rf_stretch(at.chi, &slope);
    const field here = film(map, &at, x, slope, 1);
    const double potential = -exp(here.value), k = at.size * potential, turn = here.turn;
    const double by_e[4] = {2.0 * k * here.along, 2.0 * k * here.across,
                            k * (here.along * turn + here.turn_along),
                            k * (here.across * turn + here.turn_across)};
    const double by_w[4] = {2.0 * potential, potential * turn, potential * turn,
                            potential * (2.0 + turn * turn + here.turn_turn)};
    set_force(&at, potential, turn, f);
    set_columns(&at, at.rx, at.ry, by_e, 0, jacobian);
    set_columns(&at, at.nx, at.ny, by_w, 2, jacobian);
    if (!is_finite(f, 2) || !is_finite(jacobian, 8)) {
        fail(RF_NOT_FINITE, f, 2);
        return fail(RF_NOT_FINITE, jacobian, 8);
    }
    return x > map->x_end * (1.0 + 1e-12) ? RF_OUTSIDE : RF_OK;
}

int rf_groove_force_batch(const rf_groove_map *map, size_t n, const double *e, size_t e_stride,
                          const double *w, size_t w_stride, double *f, size_t f_stride, size_t *first)
{
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double at[2] = {e[i], e[e_stride + i]}, source[2] = {w[i], w[w_stride + i]};
        double one[2];
        const int status = rf_groove_force(map, at, source, one);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        f[i] = one[0];
        f[f_stride + i] = one[1];
    }
    return worst;
}

int rf_groove_jacobian_batch(const rf_groove_map *map, size_t n, const double *e, size_t e_stride,
                             const double *w, size_t w_stride, double *f, size_t f_stride,
                             double *jacobian, size_t jacobian_stride, size_t *first)
{
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double at[2] = {e[i], e[e_stride + i]}, source[2] = {w[i], w[w_stride + i]};
        double one[2], all[8];
        const int status = rf_groove_jacobian(map, at, source, one, all);
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
