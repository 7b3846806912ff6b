#include "loss_kernel.h"

#include <math.h>

#include "groove_losses.h"
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

int rf_take_losses(rf_loss_map *map, int32_t opened, const rf_tables *tables, rf_message *why)
{
    const rf_table *c = rf_find_table(tables, "loss_coefficients", opened ? 4 : 3, why);
    const double *numbers = c ? rf_numbers(tables, "loss_map", opened ? 3 : 2 + RF_LOSSES, why) : NULL;
    const rf_table *flows = numbers && opened ? rf_find_table(tables, "loss_flows", 3, why) : c;
    const rf_table *edges = flows && opened ? rf_find_table(tables, "loss_edges", 2, why) : c;
    if (!numbers || !flows || !edges)
        return RF_INVALID;
    const uint32_t *n = c->extent;
    int fits = n[0] == (opened ? 2 : 1) * RF_LOSSES && numbers[0] > 0.0 && numbers[1] > 0.0;
    for (uint32_t axis = 1; axis < c->axes; ++axis)
        fits = fits && n[axis] >= 6 && n[axis] <= 10000;
    if (opened)
        fits = fits && flows->extent[0] % 4 == 0 && flows->extent[0] <= 10000 && flows->extent[1] == n[1]
               && flows->extent[2] == n[2] && edges->extent[0] <= 10000 && edges->extent[1] == 2;
    if (!fits)
        return rf_say(why, RF_INVALID, "the losses of a film must fit each other, for all senses and 6 x 6 nodes at least");
    *map = (rf_loss_map){{(int32_t)n[1] - 5, 0.0, numbers[0]}, {0, 0.0, RF_TURN}, {(int32_t)n[c->axes - 1] - 5, 0.0, PI},
                         numbers[1], 0.0, numbers + 2, c->numbers, 0, 0, NULL, NULL};
    if (opened) {
        map->y.cells = (int32_t)n[2] - 5;
        map->axis = numbers[2];
        map->center = NULL;
        map->openings = (int32_t)flows->extent[0] / 4;
        map->lands = (int32_t)edges->extent[0];
        map->flows = flows->numbers;
        map->edges = edges->numbers;
    }
    return RF_OK;
}

/* Loss k and its derivatives from its spline at a state. */
static rf_polar loss_of(const rf_loss_map *map, size_t k, const rf_spline *m, const rf_frame *at, double slope)
{
    const double chi = at->chi, gap = (1.0 - chi) * (1.0 + chi), off = fmax(chi, RF_NEAR);
    const int shears = k + 1 < RF_LOSSES;
    const double root = shears ? sqrt(gap) : 1.0, bent = shears ? chi / gap : 0.0;
    if (map->center) {
        const double value = exp(map->center[k] + chi * m->m) / root;
        const rf_polar power = {value, value * (m->m + chi * slope * m->m_x + bent), value * m->m_s, 0.0};
        return power;
    }
    const double value = fmax(m->m, 0.0) / root, per = m->m > 0.0 ? 1.0 / root : 0.0;
    const rf_polar here = {value, per * slope * m->m_x + value * bent, per * m->m_s / off, per * m->m_y / off};
    return here;
}

int rf_map_losses(const void *of, const double *e, const double *w, int first, double *losses, double *slopes)
{
    const rf_loss_map *map = of;
    const int opened = map->y.cells > 0, order = slopes ? 1 : -1;
    rf_frame at;
    rf_polar loss[RF_LOSSES];
    const int status = rf_orient_loss(e, w, &at);
    if (status != RF_OK)
        return rf_fail_losses(status, losses, slopes);
    double slope;
    rf_weights by[3];
    rf_spline m = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    const double x = rf_stretch(at.chi, &slope), q = map->squeeze, across = fabs(at.sin);
    const size_t width = rf_width(&map->s), strides[] = {opened ? rf_width(&map->y) * width : width, width};
    const size_t all = rf_width(&map->x) * strides[0];
    rf_weigh_from_zero(&map->x, fmin(x, map->x.last), x > map->x.last ? 1 : order, by);
    if (opened)
        rf_weigh_angle(&map->y, atan2(at.ry, at.rx) - map->axis, order, by + 1);
    rf_weigh_from_zero(&map->s, atan2(q * across, at.cos), order, by + 2);
    by[2].per = (at.sin > 0.0 ? -by[2].per : by[2].per) * q / (at.cos * at.cos + q * q * across * across);
    if (x > map->x.last && opened)
        slope = 0.0;
    else if (x > map->x.last) {
        rf_weigh_beyond(map->x.cells * log(x / map->x.last), by);
        by->per = map->x.cells / x;
    }
    for (size_t k = (size_t)first; k < RF_LOSSES; ++k) {
        if (opened)
            rf_opened_spline(map->coefficients + (k + (at.sin >= 0.0 ? 0 : RF_LOSSES)) * all, order, strides, by, &m);
        else if (slopes)
            rf_evaluate(map->coefficients + k * all, 2, 1, strides, by, &m);
        else
            rf_evaluate(map->coefficients + k * all, 2, -1, strides, by, &m);
        loss[k] = loss_of(map, k, &m, &at, slope);
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
