#include "pad_kernel.h"

#include <math.h>

#include "map_frame.h"

#define HALF_PI 1.57079632679489661923
#define ROUNDING 1e-12

/* u and Y of a place, and their derivatives: u does not depend on eta. */
typedef struct place {
    double u, u_xi, y, y_xi, y_eta;
} place;

/* M and its derivatives in u, Y and phi. */
typedef struct exponent {
    double m, m_p, m_pp, m_u, m_up, m_y, m_yp;
} exponent;

/* A cell of an axis, the splines there, and their slopes by the axis. Beyond the nodes they go on linearly. */
typedef struct axis {
    size_t cell;
    double value[RF_ORDER], slope[RF_ORDER];
} axis;

static inline int set_axis(double at, double first, double last, int32_t cells, int full, axis *of)
{
    const double per = cells / (last - first), within = fmin(fmax(at, first), last);
    const int outside = fabs(at - within) > ROUNDING;
    double rest;
    of->cell = (size_t)rf_cell((within - first) * per, cells, &rest);
    rf_values(rest, of->value);
    if (!full && !outside)
        return 0;
    rf_slopes(rest, of->slope);
    for (int j = 0; j < RF_ORDER; ++j) {
        of->slope[j] *= per;
        if (outside)
            of->value[j] += (at - within) * of->slope[j];
    }
    return outside;
}

/* The journal's place, or RF_AT_WALL. */
static inline int set_place(const rf_pad_map *map, const double *e, int full, place *at)
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

/* Sums over u of the 6 x 6 rows of coefficients under Y and phi. */
static inline void sum_layers(const double *c, size_t layer, size_t row, const double b[RF_ORDER], double sum[][RF_ORDER])
{
    for (size_t j = 0; j < RF_ORDER; ++j)
        rf_rows(c + j * row, layer, b, sum[j]);
}

/* Whether the place is beyond the nodes; M and m_p, and the rest if `full`. */
static inline int look_up(const rf_pad_map *map, const place *at, double phi, int full, exponent *out)
{
    const size_t row = (size_t)map->cells_phi + RF_ORDER - 1, layer = ((size_t)map->cells_y + RF_ORDER - 1) * row;
    const double per = (map->cells_phi + 1) / (2.0 * map->reach);
    double rest, b[RF_ORDER], b_p[RF_ORDER], sum[RF_ORDER][RF_ORDER], sum_y[RF_ORDER];
    axis u, y;
    int outside = set_axis(at->u, map->u_first, map->u_last, map->cells_u, full, &u);
    outside |= set_axis(at->y, -map->y_end, map->y_end, map->cells_y, full, &y);
    const size_t k = (size_t)rf_cell((phi + map->reach) * per - 0.5, map->cells_phi, &rest);
    const double *c = map->coefficients + u.cell * layer + y.cell * row + k;
    rf_values(rest, b);
    rf_slopes(rest, b_p);
    sum_layers(c, layer, row, u.value, sum);
    rf_rows(sum[0], RF_ORDER, y.value, sum_y);
    out->m = rf_dot(sum_y, b);
    out->m_p = per * rf_dot(sum_y, b_p);
    if (full) {
        double b_pp[RF_ORDER];
        rf_curvatures(rest, b_pp);
        out->m_pp = per * per * rf_dot(sum_y, b_pp);
        rf_rows(sum[0], RF_ORDER, y.slope, sum_y);
        out->m_y = rf_dot(sum_y, b);
        out->m_yp = per * rf_dot(sum_y, b_p);
        sum_layers(c, layer, row, u.slope, sum);
        rf_rows(sum[0], RF_ORDER, y.value, sum_y);
        out->m_u = rf_dot(sum_y, b);
        out->m_up = per * rf_dot(sum_y, b_p);
    }
    return outside;
}

static int no_film(double *f, double *jacobian)
{
    f[0] = f[1] = 0.0;
    for (int k = 0; jacobian && k < 8; ++k)
        jacobian[k] = 0.0;
    return RF_OK;
}

/* F = |w| E (2 n + L' m) of map_frame.h, with L = 5 ln s + M. */
static inline int film(const rf_pad_map *map, const double *e, const double *w, int full, double *f, double *jacobian)
{
    const double state[4] = {e[0], e[1], w[0], w[1]};
    rf_frame to;
    place at = {0.0, 0.0, 0.0, 0.0, 0.0};
    exponent by = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    if (rf_is_broken(state, 4))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 8);
    if (set_place(map, e, full, &at) != RF_OK)
        return rf_fail(RF_AT_WALL, f, jacobian, 8);
    to.size = rf_length(w[0], w[1]);
    if (to.size == 0.0)
        return rf_rest(f, jacobian);
    to.nx = w[0] / to.size;
    to.ny = w[1] / to.size;
    const double s = to.nx + map->sine;
    if (!(s > 0.0))
        return no_film(f, jacobian);
    const int outside = look_up(map, &at, 2.0 * atan(to.ny / (1.0 + to.nx)), full, &by);
    const double potential = -(s * s) * (s * s) * s * exp(by.m), turn = by.m_p - 5.0 * to.ny / s;
    rf_set_force(&to, potential, turn, f);
    if (full) {
        const double k = to.size * potential, along_xi = by.m_u * at.u_xi + by.m_y * at.y_xi;
        const double along_eta = by.m_y * at.y_eta;
        const double by_e[4] = {2.0 * k * along_xi, 2.0 * k * along_eta,
                                k * (along_xi * turn + by.m_up * at.u_xi + by.m_yp * at.y_xi),
                                k * (along_eta * turn + by.m_yp * at.y_eta)};
        rf_set_columns(&to, 1.0, 0.0, by_e, 0, jacobian);
        rf_set_damping(&to, potential, turn, by.m_pp - 5.0 * (1.0 + to.nx * map->sine) / (s * s), jacobian);
    }
    return rf_judge(outside, 0.0, f, jacobian);
}

void rf_shape_pad(rf_pad_map *map, double extent)
{
    map->reach = HALF_PI + 0.5 * extent;
    map->sine = sin(0.5 * extent);
    map->cosine = cos(0.5 * extent);
}

int rf_pad_film(const void *map, const double *e, const double *w, double *f, double *jacobian)
{
    return jacobian ? film(map, e, w, 1, f, jacobian) : film(map, e, w, 0, f, NULL);
}
