#include "tilting.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/map_frame.h"

/* What a pad is given: its place, what of its source is known, and how its pivot lies. */
enum { XI, ETA, GIVEN_N, GIVEN_T, RATE, PIVOT, LOCALS };

/* What a pad answers, with derivatives by what it is given: forces along n and t [N], and the rates of its
   coordinates or, with inertia, of their rates. */
enum { ALONG, ACROSS, TURNS, GIVES, ANSWERS };

typedef struct local {
    double value[ANSWERS];
    double by[ANSWERS][LOCALS];
} local;

size_t rf_tilting_states(const rf_tilting *bearing)
{
    return bearing->count * (bearing->spring > 0.0 ? 2 : 1) * (bearing->inertia > 0.0 ? 2 : 1);
}

/* d f/d(e, rate) out of a jacobian, the source held. */
static double direct(const double *J, int i, int k)
{
    return k < GIVEN_N ? J[4 * i + k] : k == RATE ? J[8 + i] : 0.0;
}

/* Forces, and their derivatives by e and w; `by_w[2][LOCALS]` are those of the source. */
static void take_force(const rf_tilting *b, const double *f, const double *J, double by_w[2][LOCALS], local *out)
{
    for (int i = 0; i < 2; ++i) {
        out->value[i] = b->force_scale * f[i];
        for (int k = 0; k < LOCALS; ++k) {
            const double moved = direct(J, i, k);
            out->by[i][k] = b->force_scale * (moved + J[4 * i + 2] * by_w[0][k] + J[4 * i + 3] * by_w[1][k]);
        }
    }
}

/* Pads with inertia: nothing is to be found. */
static int with_inertia(const rf_tilting *b, const double *z, local *out)
{
    double f[2], J[10] = {0.0}, by_w[2][LOCALS] = {{0.0}};
    const int status = rf_pivoted_film(&b->pad, z, z + GIVEN_N, f, J);
    by_w[0][GIVEN_N] = by_w[1][GIVEN_T] = 1.0;
    take_force(b, f, J, by_w, out);
    for (int k = 0; k < LOCALS; ++k) {
        out->by[TURNS][k] = out->by[ACROSS][k] / b->inertia;
        out->by[GIVES][k] = b->mass > 0.0 ? (out->by[ALONG][k] - (k == PIVOT ? b->spring : 0.0)) / b->mass : 0.0;
    }
    out->value[TURNS] = out->value[ACROSS] / b->inertia;
    out->value[GIVES] = b->mass > 0.0 ? (out->value[ALONG] - b->spring * z[PIVOT]) / b->mass : 0.0;
    return status == RF_UNDEFINED ? RF_OK : status;
}

/* The source of a pad without inertia and film, w_n <= 0 of its own. */
static void idle(const rf_tilting *b, const double *z, double w_n, double *w, double by_w[2][LOCALS])
{
    w[0] = w_n;
    w[1] = rf_pad_idle(&b->pad, w_n, z[GIVEN_T]);
    const double by_n = w_n == 0.0 || w[1] == z[GIVEN_T] ? 0.0 : w[1] / w_n;
    by_w[0][GIVEN_N] = w_n == z[GIVEN_N] ? 1.0 : 0.0;
    by_w[1][GIVEN_N] = by_n * by_w[0][GIVEN_N];
    by_w[1][GIVEN_T] = w[1] == z[GIVEN_T] ? 1.0 : 0.0;
}

/* The source of a pad without inertia that has a film: along n it is given, or pushes the spring of the pivot. */
static int follow(const rf_tilting *b, const double *z, const double *rates, int sprung, double *w, double *f, double *J,
                  double by_w[2][LOCALS])
{
    w[0] = sprung ? 1.0 : z[GIVEN_N];
    double near = 0.0;
    if (rates) {
        const double along = z[GIVEN_N] + rates[1] / b->clearance;
        near = (z[GIVEN_T] + rates[0] / b->clearance) / (sprung ? along : 1.0);
        rates = along > 0.0 ? rates : NULL;
    }
    const int status = rf_pad_follow(&b->pad, z, rates ? &near : NULL, w, f, J);
    if (status > RF_OUTSIDE)
        return status;
    const double turn = w[1] / w[0], by_turn = -J[6] / J[7];
    double by_T[LOCALS];
    for (int k = 0; k < LOCALS; ++k)
        by_T[k] = -direct(J, 1, k) / (J[7] * w[0]);
    if (sprung) {
        /* Force k s = scale w_n G(xi, eta), with G the force of a source 1 along n. */
        const double G = f[0], size = b->spring * z[PIVOT] / (b->force_scale * G);
        for (int k = 0; k < LOCALS; ++k)
            by_w[0][k] = -size * (direct(J, 0, k) + J[3] * by_T[k]) / G;
        by_w[0][PIVOT] = b->spring / (b->force_scale * G);
        for (int i = 0; i < 2; ++i) {
            for (int k = 0; k < 2; ++k)
                J[4 * i + k] *= size;
            J[8 + i] *= size;
        }
        w[0] = size;
        w[1] = turn * size;
        f[0] *= size;
    } else
        by_w[0][GIVEN_N] = 1.0;
    for (int k = 0; k < LOCALS; ++k)
        by_w[1][k] = by_turn * by_w[0][k] + w[0] * by_T[k];
    return status;
}

/* Pads without inertia: no moment, and on springs no more force than they have. `rates` of tilt and pivot are about what
   is to be found, or NULL. */
static int without_inertia(const rf_tilting *b, const double *z, const double *rates, local *out)
{
    const int sprung = b->spring > 0.0;
    double w[3] = {0.0, 0.0, z[RATE]}, f[2] = {0.0, 0.0}, J[10] = {0.0}, by_w[2][LOCALS] = {{0.0}};
    int status = rf_pad_least(&b->pad, z) > 0.0 ? RF_OK : RF_AT_WALL;
    if (status != RF_OK)
        return status;
    if (sprung ? z[PIVOT] < 0.0 : z[GIVEN_N] > 0.0)
        status = follow(b, z, rates, sprung, w, f, J, by_w);
    else
        idle(b, z, fmin(z[GIVEN_N], 0.0), w, by_w);
    take_force(b, f, J, by_w, out);
    for (int k = 0; k < LOCALS; ++k) {
        out->by[TURNS][k] = b->clearance * (by_w[1][k] - (k == GIVEN_T));
        out->by[GIVES][k] = b->clearance * (by_w[0][k] - (k == GIVEN_N));
    }
    out->value[TURNS] = b->clearance * (w[1] - z[GIVEN_T]);
    out->value[GIVES] = b->clearance * (w[0] - z[GIVEN_N]);
    return status;
}

/* What a pad is given at a state, and its derivatives by u (5) and its own coordinates q, s and their rates (4). */
#define GLOBALS 9

static void set_local(const rf_tilting *b, size_t k, const double *u, const double *own, double *z,
                      double by[LOCALS][GLOBALS])
{
    const double *n = b->pivot + 2 * k, t[2] = {-n[1], n[0]}, c = b->clearance, half = 0.5 * u[4];
    memset(by, 0, LOCALS * sizeof *by);
    z[XI] = (n[0] * u[0] + n[1] * u[1] + own[1]) / c + b->preload;
    z[ETA] = (t[0] * u[0] + t[1] * u[1] + own[0]) / c;
    z[GIVEN_N] = (n[0] * u[2] + n[1] * u[3] + own[3]) / c + half * z[ETA];
    z[GIVEN_T] = (t[0] * u[2] + t[1] * u[3] + own[2]) / c - half * z[XI];
    z[RATE] = half;
    z[PIVOT] = own[1];
    for (int i = 0; i < 2; ++i) {
        by[XI][i] = by[GIVEN_N][2 + i] = n[i] / c;
        by[ETA][i] = by[GIVEN_T][2 + i] = t[i] / c;
    }
    by[XI][6] = by[ETA][5] = by[GIVEN_N][8] = by[GIVEN_T][7] = 1.0 / c;
    by[PIVOT][6] = 1.0;
    for (int g = 0; g < GLOBALS; ++g) {
        by[GIVEN_N][g] += half * by[ETA][g];
        by[GIVEN_T][g] -= half * by[XI][g];
    }
    by[GIVEN_N][4] = 0.5 * z[ETA];
    by[GIVEN_T][4] = -0.5 * z[XI];
    by[RATE][4] = 0.5;
}

/* Places of a pad's coordinates q, s and their rates among the states; `none` for what it has not. */
static void set_places(const rf_tilting *b, size_t k, size_t none, size_t *place)
{
    const size_t N = b->count, coordinates = b->spring > 0.0 ? 2 : 1;
    for (size_t i = 0; i < 2; ++i) {
        place[i] = i < coordinates ? i * N + k : none;
        place[2 + i] = i < coordinates && b->inertia > 0.0 ? (coordinates + i) * N + k : none;
    }
}

/* Derivatives of one answer of a pad by u and states, times a factor, into a row of each. */
static void add_row(const double *by_local, double by[LOCALS][GLOBALS], double factor, const size_t *place, size_t none,
                    double *by_x, double *by_u)
{
    for (int g = 0; g < GLOBALS; ++g) {
        double sum = 0.0;
        for (int i = 0; i < LOCALS; ++i)
            sum += by_local[i] * by[i][g];
        if (g < 5)
            by_u[g] += factor * sum;
        else if (place[g - 5] != none)
            by_x[place[g - 5]] += factor * sum;
    }
}

static void add_slopes(const rf_tilting *b, size_t k, const local *found, double by[LOCALS][GLOBALS],
                       const size_t *place, const rf_tilting_slopes *to)
{
    const size_t states = rf_tilting_states(b), none = states;
    const double *n = b->pivot + 2 * k, t[2] = {-n[1], n[0]};
    for (size_t i = 0; i < 2; ++i) {
        add_row(found->by[ALONG], by, n[i], place, none, to->C + i * states, to->D + 5 * i);
        add_row(found->by[ACROSS], by, t[i], place, none, to->C + i * states, to->D + 5 * i);
        if (place[i] == none)
            continue;
        const size_t driven = b->inertia > 0.0 ? place[2 + i] : place[i];
        add_row(found->by[TURNS + i], by, 1.0, place, none, to->A + driven * states, to->B + 5 * driven);
        if (b->inertia > 0.0)
            to->A[place[i] * states + place[2 + i]] = 1.0;
    }
    add_row(found->by[ALONG], by, -1.0, place, none, to->C + (2 + k) * states, to->D + 5 * (2 + k));
}

/* As rf_tilting_at, with rates near those of the states, or NULL. */
static int tilting_near(const rf_tilting *bearing, const double *u, const double *x, const double *near, double *dx, double *y,
                        const rf_tilting_slopes *slopes, size_t *pad)
{
    const size_t states = rf_tilting_states(bearing), outputs = 2 + bearing->count;
    int worst = RF_OK;
    *pad = 0;
    y[0] = y[1] = 0.0;
    if (slopes) {
        memset(slopes->A, 0, states * states * sizeof(double));
        memset(slopes->B, 0, states * 5 * sizeof(double));
        memset(slopes->C, 0, outputs * states * sizeof(double));
        memset(slopes->D, 0, outputs * 5 * sizeof(double));
    }
    for (size_t k = 0; k < bearing->count; ++k) {
        size_t place[4];
        double own[4], z[LOCALS], by[LOCALS][GLOBALS], rates[2] = {0.0, 0.0};
        local found;
        set_places(bearing, k, states, place);
        for (int i = 0; i < 4; ++i)
            own[i] = place[i] < states ? x[place[i]] : 0.0;
        for (int i = 0; near && i < 2; ++i)
            rates[i] = place[i] < states ? near[place[i]] : 0.0;
        set_local(bearing, k, u, own, z, by);
        const int status = rf_is_broken(z, LOCALS) ? RF_NOT_FINITE
                           : bearing->inertia > 0.0 ? with_inertia(bearing, z, &found)
                                                    : without_inertia(bearing, z, near ? rates : NULL, &found);
        if (status > worst) {
            worst = status;
            *pad = k;
        }
        if (status > RF_OUTSIDE)
            continue;
        const double *n = bearing->pivot + 2 * k;
        y[0] += n[0] * found.value[ALONG] - n[1] * found.value[ACROSS];
        y[1] += n[1] * found.value[ALONG] + n[0] * found.value[ACROSS];
        y[2 + k] = 0.0 - found.value[ALONG];
        for (int i = 0; i < 2 && place[i] < states; ++i) {
            dx[bearing->inertia > 0.0 ? place[2 + i] : place[i]] = found.value[TURNS + i];
            if (bearing->inertia > 0.0)
                dx[place[i]] = own[2 + i];
        }
        if (slopes)
            add_slopes(bearing, k, &found, by, place, slopes);
    }
    return worst;
}

int rf_tilting_at(const rf_tilting *bearing, const double *u, const double *x, double *dx, double *y,
                  const rf_tilting_slopes *slopes, size_t *pad)
{
    return tilting_near(bearing, u, x, NULL, dx, y, slopes, pad);
}

int rf_tilting_moving(const void *of, const double *state, double *answer, double *by)
{
    const rf_tilting *bearing = of;
    const size_t n = rf_tilting_states(bearing), outputs = 2 + bearing->count, all = n + outputs;
    double *y = malloc((outputs + all * (n + 5)) * sizeof *y);
    if (!y)
        return RF_MEMORY;
    double *const C = y + outputs, *const A = C + outputs * n, *const D = A + n * n, *const B = D + 5 * outputs;
    const rf_tilting_slopes slopes = {A, B, C, D};
    const double *near = isnan(state[5 + n]) ? NULL : state + 5 + n;
    size_t pad;
    const int status = tilting_near(bearing, state, state + 5, near, answer + 2, y, &slopes, &pad);
    memcpy(answer, y, 2 * sizeof *answer);
    for (size_t i = 0; i < 2 + n; ++i) {
        const double *by_u = i < 2 ? D + 5 * i : B + 5 * (i - 2), *by_x = i < 2 ? C + n * i : A + n * (i - 2);
        memcpy(by + (5 + n) * i, by_u, 5 * sizeof *by);
        memcpy(by + (5 + n) * i + 5, by_x, n * sizeof *by);
    }
    free(y);
    /* Pads with inertia at rest have a force, but no slopes. */
    return status <= RF_OUTSIDE && rf_is_broken(by, (int32_t)((2 + n) * (5 + n))) ? RF_UNDEFINED : status;
}

int rf_tilting_forces(const rf_tilting *bearing, size_t n, const double *u, const double *q, const double *rate,
                      double *f, size_t *first)
{
    const double c = bearing->clearance;
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double half = 0.5 * u[4 * n + i];
        double sum[2] = {0.0, 0.0};
        for (size_t k = 0; k < bearing->count; ++k) {
            const double *d = bearing->pivot + 2 * k;
            double one[2];
            const double e[2] = {(d[0] * u[i] + d[1] * u[n + i]) / c + bearing->preload,
                                 (d[0] * u[n + i] - d[1] * u[i] + q[k * n + i]) / c};
            const double w[3] = {(d[0] * u[2 * n + i] + d[1] * u[3 * n + i]) / c + half * e[1],
                                 (d[0] * u[3 * n + i] - d[1] * u[2 * n + i] + rate[k * n + i]) / c - half * e[0], half};
            const int status = rf_pivoted_film(&bearing->pad, e, w, one, NULL);
            if (status > worst) {
                worst = status;
                *first = i * bearing->count + k;
            }
            sum[0] += d[0] * one[0] - d[1] * one[1];
            sum[1] += d[1] * one[0] + d[0] * one[1];
        }
        f[i] = bearing->force_scale * sum[0];
        f[n + i] = bearing->force_scale * sum[1];
    }
    return worst;
}
