#include "loss_kernel.h"

#include <math.h>

#include "loss_frame.h"

#define PI 3.14159265358979323846

int rf_orient_loss(const double *e, const double *w, rf_frame *at)
{
    const int status = rf_orient(e, w, at);
    if (status != RF_UNDEFINED)
        return status;
    at->size = 0.0;
    at->rx = at->chi > 0.0 ? e[0] / at->chi : 1.0;
    at->ry = at->chi > 0.0 ? e[1] / at->chi : 0.0;
    at->nx = at->ry;
    at->ny = -at->rx;
    at->cos = 0.0;
    at->sin = 1.0;
    return RF_OK;
}

int rf_fail_losses(int status, double *losses, double *slopes)
{
    for (int k = 0; k < RF_LOSSES; ++k)
        losses[k] = NAN;
    for (int k = 0; slopes && k < 4 * RF_LOSSES; ++k)
        slopes[k] = NAN;
    return status;
}

int rf_answer_losses(const rf_frame *at, const rf_polar *of, int first, double *losses, double *slopes)
{
    for (int k = first; k < RF_LOSSES; ++k)
        losses[k] = of[k].value * (k == RF_LOSSES - 1 ? at->size : 1.0);
    if (!slopes)
        return RF_OK;
    if (at->size == 0.0) {
        for (int k = 0; k < 4 * RF_LOSSES; ++k)
            slopes[k] = NAN;
        return RF_UNDEFINED;
    }
    for (int k = first; k < RF_LOSSES; ++k) {
        const int flows = k == RF_LOSSES - 1;
        const double size = flows ? at->size : 1.0, along = flows ? of[k].value : 0.0;
        const double chi = size * of[k].by_chi, turn = size * of[k].by_turn, across = at->chi * turn / at->size;
        const double side = turn - size * of[k].by_side;
        double *row = slopes + 4 * k;
        row[0] = chi * at->rx + side * at->ry;
        row[1] = chi * at->ry - side * at->rx;
        row[2] = along * at->nx - across * at->ny;
        row[3] = along * at->ny + across * at->nx;
    }
    return RF_OK;
}

/* Weights and slopes of the splines under one point, over X and over s. */
typedef struct weights {
    double x[RF_ORDER], x_slope[RF_ORDER], s[RF_ORDER], s_slope[RF_ORDER];
    double per_x, per_t, beyond; /* cells per X and per t */
} weights;

/* L and, if `full`, its derivatives in chi and, over chi, in t. */
static rf_polar exponent(const rf_loss_map *map, const double *c, const weights *by, const rf_frame *at, double slope,
                      double center, int full)
{
    const size_t stride = (size_t)map->cells_s + RF_ORDER - 1;
    double row[RF_ORDER], row_x[RF_ORDER];
    rf_polar at_state = {0.0, 0.0, 0.0, 0.0};
    rf_rows(c, stride, by->x, row);
    if (full || by->beyond > 0.0)
        rf_rows(c, stride, by->x_slope, row_x);
    for (int j = 0; by->beyond > 0.0 && j < RF_ORDER; ++j)
        row[j] += by->beyond * row_x[j];
    const double m = rf_dot(row, by->s);
    at_state.value = center + at->chi * m;
    if (full) {
        at_state.by_chi = m + at->chi * slope * by->per_x * rf_dot(row_x, by->s);
        at_state.by_turn = by->per_t * rf_dot(row, by->s_slope);
    }
    return at_state;
}

int rf_map_losses(const void *of, const double *e, const double *w, int first, double *losses, double *slopes)
{
    const rf_loss_map *map = of;
    rf_frame at;
    rf_polar loss[RF_LOSSES];
    const int status = rf_orient_loss(e, w, &at);
    if (status != RF_OK)
        return rf_fail_losses(status, losses, slopes);
    double u, v, slope;
    weights by;
    const double x = rf_stretch(at.chi, &slope), within = fmin(x, map->x_end), gap = (1.0 - at.chi) * (1.0 + at.chi);
    const size_t width = (size_t)map->cells_s + RF_ORDER - 1, all = ((size_t)map->cells_x + RF_ORDER - 1) * width;
    const int32_t i = rf_cell(within / map->x_end * map->cells_x, map->cells_x, &u);
    const double q = map->squeeze, across = fabs(at.sin), s = atan2(q * across, at.cos);
    const int32_t j = rf_cell(s / PI * map->cells_s, map->cells_s, &v);
    rf_values(u, by.x);
    rf_values(v, by.s);
    by.beyond = x > within ? map->cells_x * log(x / within) : 0.0;
    if (slopes || by.beyond > 0.0)
        rf_slopes(u, by.x_slope);
    if (slopes)
        rf_slopes(v, by.s_slope);
    by.per_x = map->cells_x / fmax(x, map->x_end);
    by.per_t = (at.sin > 0.0 ? -1.0 : 1.0) * map->cells_s / PI * q / (at.cos * at.cos + q * q * across * across);
    for (size_t k = (size_t)first; k < RF_LOSSES; ++k) {
        const double *c = map->coefficients + k * all + (size_t)i * width + (size_t)j;
        const rf_polar power = exponent(map, c, &by, &at, slope, map->center[k], slopes != NULL);
        const int shears = k + 1 < RF_LOSSES;
        const double value = exp(power.value) / (shears ? sqrt(gap) : 1.0);
        loss[k].value = value;
        loss[k].by_chi = value * (power.by_chi + (shears ? at.chi / gap : 0.0));
        loss[k].by_turn = value * power.by_turn;
        loss[k].by_side = 0.0;
    }
    return rf_answer_losses(&at, loss, first, losses, slopes);
}

/* Integrals from 0 to an angle of the gap H = 1 + chi cos: of 1/H and 1/H^2, and their derivatives in chi. */
typedef struct integrals {
    double film, square, film_chi, square_chi;
} integrals;

/* To an angle with this sine and cosine, `bent` being atan(sqrt((1 - chi)/(1 + chi)) tan(angle/2)) with its turns. */
static integrals integrate(double chi, double bent, double s, double c)
{
    const double gap = (1.0 - chi) * (1.0 + chi), h = 1.0 + chi * c;
    const double film = 2.0 * bent / sqrt(gap), square = (film - chi * s / h) / gap;
    const double bow = s / h - chi * square; /* of cos/H^2 */
    const integrals at = {film, square, -bow, -(s / (h * h) + bow - 2.0 * chi * square) / gap};
    return at;
}

static integrals between(const integrals *from, const integrals *to)
{
    const integrals at = {to->film - from->film, to->square - from->square, to->film_chi - from->film_chi,
                          to->square_chi - from->square_chi};
    return at;
}

double rf_gap_integral(double chi, double angle, double *by_chi)
{
    const double turns = floor(angle / (2.0 * PI) + 0.5), half = 0.5 * angle - PI * turns;
    const double bent = atan2(sqrt((1.0 - chi) / (1.0 + chi)) * sin(half), cos(half)) + PI * turns;
    const integrals at = integrate(chi, bent, sin(angle), cos(angle));
    *by_chi = at.film_chi;
    return at.film;
}

/* The oil runs to the end at t + 3 pi/2, t in [-pi, 0]; the next film begins half a turn later. The streamers fill the
   gap until it is as wide as at that end again. */
int rf_short_losses(const void *none, const double *e, const double *w, int first, double *losses, double *slopes)
{
    rf_frame at;
    rf_polar loss[RF_LOSSES] = {{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, {2.0, 0.0, 0.0, 0.0}};
    const int status = rf_orient_loss(e, w, &at);
    (void)none;
    if (status != RF_OK)
        return rf_fail_losses(status, losses, slopes);
    const double chi = at.chi, side = at.sin < 0.0 ? -1.0 : 1.0, c = -fabs(at.sin), s = -at.cos;
    const double end = 1.0 + chi * c, start = 1.0 - chi * c; /* thickness at the ends of the film */
    const double root = sqrt((1.0 - chi) / (1.0 + chi)), half = at.cos / (1.0 - c);
    const double before = atan(root * half), behind = 0.5 * PI + atan(half / root);
    const double bent = s > 0.0 ? PI - behind : behind;
    const integrals a = integrate(chi, before, -s, -c), b = integrate(chi, behind, s, c);
    const integrals film = between(&a, &b), z = integrate(chi, before + PI, -s, -c);
    const integrals m = integrate(chi, bent, -fabs(s), c), full = between(&b, &m), torn = between(&m, &z);
    loss[0].value = film.film;
    loss[0].by_chi = film.film_chi;
    loss[0].by_turn = side * -2.0 * c / (end * start);
    loss[1].value = film.film + full.film + end * torn.square;
    loss[1].by_chi = film.film_chi + full.film_chi + c * torn.square + end * torn.square_chi;
    loss[1].by_turn = loss[0].by_turn
                      + side * (2.0 * c * (end + start) / (end * start * start) - s * torn.square);
    return rf_answer_losses(&at, loss, first, losses, slopes);
}

int rf_loss_batch(rf_loss film, const void *data, size_t n, const double *e, const double *w, double *losses,
                  double *slopes, size_t *first)
{
    double loss[RF_LOSSES], slope[4 * RF_LOSSES];
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double here[2] = {e[i], e[n + i]}, source[2] = {w[i], w[n + i]};
        const int status = film(data, here, source, 0, loss, slopes ? slope : NULL);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        loss[1] -= loss[0];
        for (size_t k = 0; slopes && k < 4; ++k)
            slope[4 + k] -= slope[k];
        for (size_t k = 0; k < RF_LOSSES; ++k)
            losses[k * n + i] = loss[k];
        for (size_t k = 0; slopes && k < 4 * RF_LOSSES; ++k)
            slopes[k * n + i] = slope[k];
    }
    return worst;
}
