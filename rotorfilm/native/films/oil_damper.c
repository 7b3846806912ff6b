#include "oil_damper.h"

#include <math.h>
#include <string.h>

#include "chebyshev.h"
#include "map_frame.h"
#include "squeeze_film.h"

#define CONVECTION (17.0 / 70.0)
#define PI 3.14159265358979323846

/* Position and velocity per clearance. */
typedef struct motion {
    double e[2], w[2], E, ew, ww;
} motion;

/* Functions of the radius and their slopes by e^2. */
typedef struct radial {
    double at[RF_RADIAL], slope[RF_RADIAL];
} radial;

static motion scaled(const rf_oil_damper *of, const double *state)
{
    const double c = of->journal.clearance;
    motion at = {{state[0] / c, state[1] / c}, {state[2] / c, state[3] / c}, 0.0, 0.0, 0.0};
    at.E = at.e[0] * at.e[0] + at.e[1] * at.e[1];
    at.ew = at.e[0] * at.w[0] + at.e[1] * at.w[1];
    at.ww = at.w[0] * at.w[0] + at.w[1] * at.w[1];
    return at;
}

/* Add the table; beyond its reach it goes on as powers of s. Answers whether it does. */
static int add_table(const rf_oil_damper *of, double E, radial *to)
{
    static const double POWERS[RF_RADIAL] = {1.0, 1.0, 1.0, 1.0, 3.0, 3.0, 5.0};
    const double s = sqrt(1.0 - E), least = of->least, x = (2.0 * s - 1.0 - least) / (1.0 - least);
    const int beyond = s < least * (1.0 - 1e-9);
    double value[RF_RADIAL], slope[RF_RADIAL];
    rf_chebyshev(of->table, of->terms, RF_RADIAL, x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x, value, slope);
    for (int k = 0; k < RF_RADIAL; ++k) {
        const double scale = pow(s, -POWERS[k]), inside = s < least ? 0.0 : 2.0 / (1.0 - least);
        const double by_s = slope[k] * inside - POWERS[k] * value[k] / s;
        to->at[k] = value[k] * scale;
        to->slope[k] = by_s * scale * (-0.5 / s);
    }
    return beyond;
}

/* The functions of a short film, in closed form. */
static void add_closed(double part, double E, radial *to)
{
    const double s = sqrt(1.0 - E), near = 1.0 + s, by_s = -0.5 / s, share = 2.0 * PI * CONVECTION;
    const double n = 0.2 * PI / (s * near * near), t = -share / (s * near * near);
    const double c = -share * (3.0 * s + 1.0) / (s * near * s * near * s * near);
    const double n_log = -(1.0 / s + 2.0 / near) * by_s;
    const double c_log = (3.0 / (3.0 * s + 1.0) - 3.0 / s - 3.0 / near) * by_s;
    const double at[5] = {0.2 * PI / near, n, t, 2.0 * t, c};
    const double slope[5] = {-0.2 * PI / (near * near) * by_s, n * n_log, t * n_log, 2.0 * t * n_log, c * c_log};
    for (int k = 0; k < 5; ++k) {
        to->at[k] += part * at[k];
        to->slope[k] += part * slope[k];
    }
}

/* The functions of the inertia all round; of the table the damping too. Answers whether the table ends. */
static int set_radial(const rf_oil_damper *of, double E, radial *to)
{
    memset(to, 0, sizeof *to);
    const int beyond = of->terms ? add_table(of, E, to) : 0;
    for (int k = 0; k < 5; ++k) {
        to->at[k] *= of->tabled;
        to->slope[k] *= of->tabled;
    }
    if (of->closed != 0.0)
        add_closed(of->closed, E, to);
    return beyond;
}

/* What the zone of a ruptured film sums up: by direction, the arc in Sommerfeld's angle. */
typedef struct zone {
    double mass[3], by_e[4], push[2], push_by_w[3], push_by_e[3]; /* symmetric ones as xx, xy, yy; by_e: xxx, xxy, xyy, yyy */
} zone;

static void set_zone(const rf_oil_damper *of, const motion *at, zone *to)
{
    const double eps = sqrt(at->E), minimum = atan2(at->e[1], at->e[0]), ahead = atan2(at->w[1], at->w[0]) - minimum;
    const rf_arc arc = rf_set_arc(eps, 0.0);
    const double first = rf_spread(&arc, ahead - 0.5 * PI), last = rf_spread(&arc, ahead + 0.5 * PI), half = 0.5 * (last - first);
    const double cm = cos(minimum), sm = sin(minimum);
    memset(to, 0, sizeof *to);
    for (int32_t k = 0; k < of->count; ++k) {
        const rf_place place = rf_place_at(&arc, 0.5 * (first + last) + half * of->nodes[k]);
        const double sine = place.sin, cosine = place.cos, h = place.h, weight = of->zone * half * of->weights[k] * place.stretch;
        const double x = cm * cosine - sm * sine, y = sm * cosine + cm * sine;
        const double toward = (at->w[0] * x + at->w[1] * y) / h, m = 0.1 * weight / h, m_h = m / h;
        const double q = CONVECTION * weight * toward * toward, r = -2.0 * CONVECTION * weight * toward / h;
        const double square[3] = {x * x, x * y, y * y};
        for (int i = 0; i < 3; ++i) {
            to->mass[i] += m * square[i];
            to->push_by_w[i] += r * square[i];
            to->push_by_e[i] += r * toward * square[i];
        }
        to->by_e[0] += m_h * x * x * x;
        to->by_e[1] += m_h * x * x * y;
        to->by_e[2] += m_h * x * y * y;
        to->by_e[3] += m_h * y * y * y;
        to->push[0] -= q * x;
        to->push[1] -= q * y;
    }
}

/* Add a vector function a w^2 e + b (e.w) w + c (e.w)^2 e and its slopes by e and w: the convection. */
static void add_convection(const motion *at, const radial *of, double scale, double per_c, double *f, double *jacobian)
{
    const double a = of->at[2], b = of->at[3], c = of->at[4], ew = at->ew, ww = at->ww;
    const double along = a * ww + c * ew * ew, grown = of->slope[2] * ww + of->slope[4] * ew * ew;
    for (int i = 0; i < 2; ++i) {
        f[i] += scale * (along * at->e[i] + b * ew * at->w[i]);
        for (int j = 0; jacobian && j < 2; ++j) {
            const double one = i == j, ei = at->e[i], ej = at->e[j], wi = at->w[i], wj = at->w[j];
            const double by_e = 2.0 * (grown * ei + of->slope[3] * ew * wi) * ej + along * one
                                + (2.0 * c * ew * ei + b * wi) * wj;
            const double by_w = 2.0 * a * ei * wj + (2.0 * c * ew * ei + b * wi) * ej + b * ew * one;
            jacobian[5 * i + j] += per_c * by_e;
            jacobian[5 * i + 2 + j] += per_c * by_w;
        }
    }
}

/* The viscous film of the table. */
static void set_viscous(const motion *at, const radial *of, double scale, double per_c, double *f, double *jacobian)
{
    const double c = of->at[5], d = of->at[6], ew = at->ew;
    for (int i = 0; i < 2; ++i) {
        f[i] = -scale * (c * at->w[i] + d * ew * at->e[i]);
        for (int j = 0; jacobian && j < 2; ++j) {
            const double grown = of->slope[5] * at->w[i] + of->slope[6] * ew * at->e[i];
            jacobian[5 * i + j] = -per_c * (2.0 * grown * at->e[j] + d * (ew * (i == j) + at->e[i] * at->w[j]));
            jacobian[5 * i + 2 + j] = -per_c * (c * (i == j) + d * at->e[i] * at->e[j]);
        }
    }
    if (jacobian)
        jacobian[4] = jacobian[9] = 0.0;
}

int rf_oil_damper_at(const void *damper, const double *state, double *f, double *jacobian)
{
    const rf_oil_damper *of = damper;
    const double still[5] = {state[0], state[1], state[2], state[3], 0.0}, c = of->journal.clearance;
    if (rf_is_broken(still, 5))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 10);
    const motion at = scaled(of, still);
    if (!(at.E < 1.0))
        return rf_fail(RF_AT_WALL, f, jacobian, 10);
    int status = RF_OK;
    radial all;
    const int beyond = set_radial(of, at.E, &all);
    if (of->mapped)
        status = rf_journal_at(&of->journal, still, f, jacobian);
    else
        set_viscous(&at, &all, of->viscous, of->viscous / c, f, jacobian);
    if (status > RF_OUTSIDE)
        return status;
    for (int i = 0; i < 2; ++i) {
        f[i] -= of->viscous * of->seal * at.w[i];
        if (jacobian)
            jacobian[5 * i + 2 + i] -= of->viscous / c * of->seal;
    }
    if (jacobian)
        jacobian[4] = jacobian[9] = 0.0;
    if (of->inertial > 0.0 && (of->closed != 0.0 || of->tabled != 0.0))
        add_convection(&at, &all, of->inertial, of->inertial / c, f, jacobian);
    if (of->inertial > 0.0 && of->zone != 0.0) {
        zone ruptured;
        set_zone(of, &at, &ruptured);
        for (int i = 0; i < 2; ++i) {
            f[i] += of->inertial * ruptured.push[i];
            for (int j = 0; jacobian && j < 2; ++j) {
                jacobian[5 * i + j] += of->inertial / c * ruptured.push_by_e[i + j];
                jacobian[5 * i + 2 + j] += of->inertial / c * ruptured.push_by_w[i + j];
            }
        }
    }
    if (rf_is_broken(f, 2) || (jacobian && rf_is_broken(jacobian, 10)))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 10);
    return beyond && status == RF_OK ? RF_OUTSIDE : status;
}

/* Slopes of m I + n e e by e, and of the zone by e and w, per clearance^2. */
static void set_mass_slopes(const motion *at, const radial *of, const zone *ruptured, double part, double *slopes)
{
    for (int i = 0, row = 0; i < 2; ++i)
        for (int j = i; j < 2; ++j, ++row)
            for (int k = 0; k < 2; ++k) {
                const double *e = at->e;
                double by = 2.0 * (of->slope[0] * (i == j) + of->slope[1] * e[i] * e[j]) * e[k];
                by += of->at[1] * ((i == k) * e[j] + (j == k) * e[i]);
                slopes[4 * row + k] = by + ruptured->by_e[i + j + k];
                slopes[4 * row + 2 + k] = 0.0;
            }
    const double size = sqrt(at->ww);
    if (part == 0.0 || !(size > 0.0))
        return;
    const double turn[2] = {-at->w[1] / size, at->w[0] / size}, across = at->e[0] * turn[0] + at->e[1] * turn[1];
    const double ends = 0.1 * part * (1.0 / (1.0 - across) - 1.0 / (1.0 + across)) / size;
    for (int i = 0, row = 0; i < 2; ++i)
        for (int j = i; j < 2; ++j, ++row)
            for (int k = 0; k < 2; ++k)
                slopes[4 * row + 2 + k] = ends * turn[i] * turn[j] * turn[k];
}

int rf_oil_damper_mass(const void *damper, const double *state, double *mass, double *slopes)
{
    const rf_oil_damper *of = damper;
    const motion at = scaled(of, state);
    const double c = of->journal.clearance, scale = of->inertial / c;
    zone ruptured = {{0.0}, {0.0}, {0.0}, {0.0}, {0.0}};
    radial all;
    if (rf_is_broken(state, 4) || !(at.E < 1.0)) {
        for (int i = 0; i < 3; ++i)
            mass[i] = NAN;
        return rf_is_broken(state, 4) ? RF_NOT_FINITE : RF_AT_WALL;
    }
    const int beyond = set_radial(of, at.E, &all);
    if (of->zone != 0.0)
        set_zone(of, &at, &ruptured);
    for (int i = 0, row = 0; i < 2; ++i)
        for (int j = i; j < 2; ++j, ++row)
            mass[row] = scale * (all.at[0] * (i == j) + all.at[1] * at.e[i] * at.e[j] + ruptured.mass[row]);
    if (slopes) {
        set_mass_slopes(&at, &all, &ruptured, of->zone, slopes);
        for (int k = 0; k < 12; ++k)
            slopes[k] *= scale / c;
    }
    return beyond ? RF_OUTSIDE : RF_OK;
}
