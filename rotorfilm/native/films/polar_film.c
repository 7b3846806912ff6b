#include "polar_film.h"

#include <math.h>

#include "chebyshev.h"
#include "map_frame.h"

#define CENTER 1e-8 /* eccentricity ratio below which the derivative is that on this circle, along x */
#define LEAST_TERMS 2
#define MOST_TERMS 1000

enum { SS, SC, CS, CC, LIFT, COLUMNS };

int rf_take_polar(rf_polar_table *film, const rf_tables *tables, rf_message *why)
{
    const double *reach = rf_numbers(tables, "reach", 2, why);
    const rf_table *polar = reach ? rf_find_table(tables, "polar", 2, why) : NULL;
    if (!polar)
        return RF_INVALID;
    if (polar->extent[0] < LEAST_TERMS || polar->extent[0] > MOST_TERMS || polar->extent[1] != COLUMNS)
        return rf_say(why, RF_INVALID, "the table of a film must have %d columns, got %u x %u", COLUMNS,
                      (unsigned)polar->extent[0], (unsigned)polar->extent[1]);
    if (!(reach[0] > 0.0 && reach[0] < 1.0 && reach[1] > 0.0))
        return rf_say(why, RF_INVALID, "the reach of a film must be between 0 and 1, got %.9g", reach[0]);
    *film = (rf_polar_table){polar->numbers, reach[0], reach[1], (int32_t)polar->extent[0]};
    return RF_OK;
}

/* The five functions and their slopes at chi. */
static void set_functions(const rf_polar_table *film, double chi, double *value, double *slope)
{
    const double last = atanh(film->reach), x = 2.0 * atanh(chi) / last - 1.0, q2 = (1.0 - chi) * (1.0 + chi);
    const double scale = 1.0 / (q2 * sqrt(q2)), inside = x > 1.0 ? 0.0 : 2.0 / last;
    rf_chebyshev(film->table, film->terms, COLUMNS, x > 1.0 ? 1.0 : x, value, slope);
    for (int k = 0; k < COLUMNS; ++k) {
        slope[k] = scale / q2 * (inside * slope[k] + 3.0 * chi * value[k]);
        value[k] *= scale;
    }
}

int rf_polar_film(const void *of, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_polar_table *film = of;
    const double mirror = w[2] < 0.0 ? -1.0 : 1.0, chi = rf_length(e[0], e[1]);
    double c = 1.0, s = 0.0, wx = w[0], wy = mirror * w[1], at = chi, a[COLUMNS], by[COLUMNS];
    if (chi >= 1.0)
        return rf_fail(RF_AT_WALL, f, jacobian, 8);
    if (jacobian && chi < CENTER) { /* the source moves with the journal */
        wx -= w[2] * e[1];
        wy += mirror * w[2] * (e[0] - CENTER);
        at = CENTER;
    } else if (chi > 0.0) {
        c = e[0] / chi;
        s = mirror * e[1] / chi;
    }
    set_functions(film, at, a, by);
    const double g_s = c * wy - s * wx, g_c = c * wx + s * wy;
    const double across = -(a[SS] * g_s + a[SC] * g_c), along = -(a[CS] * g_s + a[CC] * g_c) - a[LIFT] * at;
    f[0] = c * along - s * across;
    f[1] = mirror * (s * along + c * across);
    if (jacobian) {
        const rf_frame frame = {.nx = c, .ny = s};
        const double both = a[SC] + a[CS], less = a[SS] - a[CC];
        const double by_e[4] = {-(by[CS] * g_s + by[CC] * g_c) - by[LIFT] * at - a[LIFT], (less * g_s + both * g_c) / at,
                                -(by[SS] * g_s + by[SC] * g_c), (less * g_c - both * g_s) / at - a[LIFT]};
        const double by_w[4] = {-a[CC], -a[CS], -a[SC], -a[SS]};
        rf_set_columns(&frame, c, s, by_e, 0, jacobian);
        rf_set_columns(&frame, c, s, by_w, 2, jacobian);
        for (int k = 1; k < 7; k += k == 3 ? 1 : 2) /* the entries with one y */
            jacobian[k] *= mirror;
    }
    return rf_judge(chi, film->reach, f, jacobian);
}
