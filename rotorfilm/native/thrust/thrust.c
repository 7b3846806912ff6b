#include "thrust.h"

#include <math.h>
#include <string.h>

#include "../films/map_frame.h"

#define TURN 6.28318530717958647692
#define PLACES RF_SECTOR_PLACES
#define ROWS RF_SECTOR_ROWS
#define TILTS 2
#define MOST_STEPS 40
#define HALVINGS 30
#define BALANCED 1e-12 /* moment about a pivot that is left, over force and radius */

/* The film of one pad, in its frame. */
typedef struct pad_film {
    double q[PLACES], v[PLACES], rates[TILTS];
    double y[ROWS], by_place[ROWS][PLACES], by_rate[ROWS][PLACES], by_speed[ROWS];
    int still; /* whether nothing drives it */
} pad_film;

/* From the axes of the bearing to those of a pad, of (z, a, b); the back way by -angle. */
static void turn(double angle, const double *from, double *to)
{
    const double c = cos(angle), s = sin(angle), a = from[1], b = from[2];
    to[0] = from[0];
    to[1] = a * c + b * s;
    to[2] = b * c - a * s;
}

/* Add what tilts x of a pad do to its gap plane. */
static void lean(const rf_thrust *bearing, const double *x, double *q)
{
    if (bearing->tilts > 0)
        q[1] += x[0];
    if (bearing->tilts > 1) {
        q[0] -= bearing->pivot * x[1];
        q[2] -= x[1];
    }
}

/* The moments of (F, M_a, M_b) about the pivot. */
static void about_pivot(const rf_thrust *bearing, const double *g, double *moment)
{
    moment[0] = g[1];
    moment[1] = -bearing->pivot * g[0] - g[2];
}

static double frame_of(const rf_thrust *bearing, size_t pad)
{
    return bearing->first + TURN * (double)pad / (double)bearing->count;
}

static void place_pad(const rf_thrust *bearing, size_t pad, const double *x, const double *u, double *q, double *v)
{
    const double side = bearing->side, angle = frame_of(bearing, pad);
    const double place[PLACES] = {bearing->gap + side * u[0], side * u[1], side * u[2]};
    const double rate[PLACES] = {side * u[3], side * u[4], side * u[5]};
    turn(angle, place, q);
    turn(angle, rate, v);
    lean(bearing, x + pad * (size_t)bearing->tilts, q);
}

static void drive(const double *q, const double *v, double speed, double *w)
{
    w[0] = v[0];
    w[1] = v[1] + 0.5 * speed * q[2];
    w[2] = v[2] - 0.5 * speed * q[1];
    w[3] = 0.5 * speed;
}

void rf_thrust_place(const rf_thrust *bearing, size_t pad, const double *x, const double *rates, const double *u,
                     double *q, double *w)
{
    double v[PLACES];
    place_pad(bearing, pad, x, u, q, v);
    lean(bearing, rates + pad * (size_t)bearing->tilts, v);
    drive(q, v, u[6], w);
}

/* Force of a pad at q and v and, where `differentiated`, its derivatives. */
static int take_pad(const rf_thrust *bearing, pad_film *at, double speed, int differentiated)
{
    double w[ROWS], by[ROWS * RF_SECTOR_COLUMNS];
    drive(at->q, at->v, speed, w);
    int status = RF_OUTSIDE;
    if (bearing->table.functions == RF_TABLE_PAD)
        status = rf_pad_table_film(&bearing->table, &bearing->pad, at->q, w, at->y, differentiated ? by : NULL);
    if (status == RF_OUTSIDE)
        status = rf_sector_film(&bearing->pad, at->q, w, at->y, differentiated ? by : NULL);
    at->still = status == RF_UNDEFINED;
    for (int i = 0; i < ROWS && differentiated && status == RF_OK; ++i) {
        const double *row = by + RF_SECTOR_COLUMNS * i, *by_w = row + PLACES;
        for (int k = 0; k < PLACES; ++k) {
            at->by_place[i][k] = row[k];
            at->by_rate[i][k] = by_w[k];
        }
        at->by_place[i][1] -= 0.5 * speed * by_w[2];
        at->by_place[i][2] += 0.5 * speed * by_w[1];
        at->by_speed[i] = 0.5 * (at->q[2] * by_w[1] - at->q[1] * by_w[2] + by_w[3]);
    }
    return status;
}

/* Solve S s = m for the tilts; whether it has an answer. */
static int solve_tilts(int tilts, double S[TILTS][TILTS], const double *m, double *s)
{
    const double det = tilts > 1 ? S[0][0] * S[1][1] - S[0][1] * S[1][0] : S[0][0];
    s[0] = tilts > 1 ? (m[0] * S[1][1] - m[1] * S[0][1]) / det : m[0] / det;
    s[1] = tilts > 1 ? (m[1] * S[0][0] - m[0] * S[1][0]) / det : 0.0;
    return isfinite(s[0]) && isfinite(s[1]);
}

/* B' G B of derivatives G by (z, a, b). */
static void pivot_matrix(const rf_thrust *bearing, double by[ROWS][PLACES], double S[TILTS][TILTS])
{
    for (int k = 0; k < TILTS; ++k) {
        const double unit[TILTS] = {k == 0, k == 1};
        double way[PLACES] = {0.0}, g[PLACES] = {0.0}, moment[TILTS];
        const rf_thrust both = {.pivot = bearing->pivot, .tilts = TILTS};
        lean(&both, unit, way);
        for (int i = 0; i < PLACES; ++i)
            for (int j = 0; j < PLACES; ++j)
                g[i] += by[i][j] * way[j];
        about_pivot(bearing, g, moment);
        S[0][k] = moment[0];
        S[1][k] = moment[1];
    }
}

static int is_balanced(const rf_thrust *bearing, const pad_film *at, double *moment)
{
    const double size = fabs(at->y[0]) * bearing->pad.radius[bearing->pad.nodes];
    about_pivot(bearing, at->y, moment);
    return fabs(moment[0]) <= BALANCED * size && (bearing->tilts < 2 || fabs(moment[1]) <= BALANCED * size);
}

/* Set the rates of a pad: the film is linear in them until it ruptures elsewhere, and its moment falls with them. */
static int let_tilt(const rf_thrust *bearing, pad_film *at, double speed)
{
    const double held[PLACES] = {at->v[0], at->v[1], at->v[2]};
    double moment[TILTS], S[TILTS][TILTS], step[TILTS];
    at->rates[0] = at->rates[1] = 0.0;
    for (int k = 0; k < MOST_STEPS; ++k) {
        const int status = take_pad(bearing, at, speed, 1);
        if (status != RF_OK || is_balanced(bearing, at, moment))
            return status;
        pivot_matrix(bearing, at->by_rate, S);
        if (!solve_tilts(bearing->tilts, S, moment, step))
            return RF_STUCK;
        for (int i = 0; i < TILTS; ++i)
            at->rates[i] -= step[i];
        memcpy(at->v, held, sizeof held);
        lean(bearing, at->rates, at->v);
    }
    return RF_STUCK;
}

/* Where the slopes of one pad go: its column of tilts, and the way back to the axes of the bearing. */
static void add_slopes(const rf_thrust *bearing, size_t pad, const pad_film *at, const rf_thrust_slopes *to)
{
    const size_t tilts = (size_t)bearing->tilts, states = bearing->count * tilts, first = pad * tilts;
    const double angle = frame_of(bearing, pad);
    double S[TILTS][TILTS];
    pad_film own = *at;
    pivot_matrix(bearing, own.by_rate, S);
    for (size_t column = 0; column < RF_THRUST_INPUTS + tilts; ++column) {
        /* The columns z, a, b, their rates and the speed, and those of the tilts. */
        double q[PLACES] = {0.0}, v[PLACES] = {0.0}, unit[TILTS] = {0.0}, g[ROWS], back[PLACES], moment[TILTS];
        double rates[TILTS] = {0.0};
        const int spins = column == RF_THRUST_INPUTS - 1;
        if (column < RF_THRUST_INPUTS - 1) {
            double way[PLACES] = {0.0};
            way[column % PLACES] = bearing->side;
            turn(angle, way, column < PLACES ? q : v);
        } else if (!spins) {
            unit[column - RF_THRUST_INPUTS] = 1.0;
            lean(bearing, unit, q);
        }
        for (int round = 0; round < 2; ++round) { /* first with tilts that do not move, then with those that do */
            for (int i = 0; i < ROWS; ++i) {
                g[i] = spins ? at->by_speed[i] : 0.0;
                for (int j = 0; j < PLACES; ++j)
                    g[i] += at->by_place[i][j] * q[j] + at->by_rate[i][j] * v[j];
            }
            if (round > 0 || tilts == 0)
                break;
            about_pivot(bearing, g, moment);
            if (bearing->held || !solve_tilts(bearing->tilts, S, moment, rates))
                rates[0] = rates[1] = 0.0;
            rates[0] = -rates[0];
            rates[1] = -rates[1];
            lean(bearing, rates, v);
        }
        turn(-angle, g, back);
        for (int i = 0; i < ROWS; ++i) {
            const double part = i < PLACES ? bearing->side * back[i] : g[i];
            if (column < RF_THRUST_INPUTS)
                to->D[i * RF_THRUST_INPUTS + (int)column] += part;
            else
                to->C[(size_t)i * states + first + column - RF_THRUST_INPUTS] = part;
        }
        for (size_t i = 0; i < tilts; ++i) {
            if (column < RF_THRUST_INPUTS)
                to->B[(first + i) * RF_THRUST_INPUTS + column] = rates[i];
            else
                to->A[(first + i) * states + first + column - RF_THRUST_INPUTS] = rates[i];
        }
    }
}

static int same_place(const pad_film *a, const pad_film *b)
{
    int same = 1;
    for (int k = 0; k < PLACES; ++k)
        same = same && a->q[k] == b->q[k] && a->v[k] == b->v[k];
    return same;
}

/* The whole bearing from its table; RF_OUTSIDE beyond it. */
static int whole_at(const rf_thrust *bearing, const double *u, double *y, double *D)
{
    const double side = bearing->side, q[PLACES] = {bearing->gap + side * u[0], side * u[1], side * u[2]};
    const double v[PLACES] = {side * u[3], side * u[4], side * u[5]};
    const int status = rf_whole_film(&bearing->table, bearing->pad.viscosity, q, v, u[6], y, D);
    for (int i = 0; status == RF_OK && i < ROWS; ++i) {
        y[i] *= i < PLACES ? side : 1.0;
        for (int k = 0; D && k < RF_THRUST_INPUTS; ++k)
            D[i * RF_THRUST_INPUTS + k] *= (i < PLACES ? side : 1.0) * (k < 2 * PLACES ? side : 1.0);
    }
    return status;
}

int rf_thrust_at(const rf_thrust *bearing, const double *x, const double *u, double *y, double *rates,
                 const rf_thrust_slopes *slopes)
{
    const size_t tilts = (size_t)bearing->tilts, states = bearing->count * tilts;
    pad_film at, next;
    memset(&at, 0, sizeof at);
    if (rf_is_broken(u, RF_THRUST_INPUTS) || rf_is_broken(x, (int)states))
        return RF_NOT_FINITE;
    memset(y, 0, ROWS * sizeof(double));
    if (slopes) {
        memset(slopes->A, 0, states * states * sizeof(double));
        memset(slopes->D, 0, ROWS * RF_THRUST_INPUTS * sizeof(double));
    }
    if (bearing->table.functions == RF_TABLE_WHOLE && whole_at(bearing, u, y, slopes ? slopes->D : NULL) == RF_OK)
        return rf_is_broken(y, ROWS) ? RF_NOT_FINITE : RF_OK;
    for (size_t k = 0; k < bearing->count; ++k) {
        double back[PLACES];
        memset(&next, 0, sizeof next);
        place_pad(bearing, k, x, u, next.q, next.v);
        if (k == 0 || !same_place(&at, &next)) { /* pads alike are solved once */
            const double q[2 * PLACES] = {next.q[0], next.q[1], next.q[2], next.v[0], next.v[1], next.v[2]};
            const int status = tilts && !bearing->held ? let_tilt(bearing, &next, u[6]) : take_pad(bearing, &next, u[6], slopes != NULL);
            if (status > RF_UNDEFINED || (status == RF_UNDEFINED && slopes))
                return status;
            at = next;
            memcpy(at.q, q, sizeof at.q);
            memcpy(at.v, q + PLACES, sizeof at.v);
        }
        turn(-frame_of(bearing, k), at.y, back);
        for (int i = 0; i < PLACES; ++i)
            y[i] += bearing->side * back[i];
        y[3] += at.y[3];
        for (size_t i = 0; i < tilts && rates; ++i)
            rates[k * tilts + i] = at.rates[i];
        if (slopes)
            add_slopes(bearing, k, &at, slopes);
    }
    return rf_is_broken(y, ROWS) ? RF_NOT_FINITE : RF_OK;
}

/* Let one pad come to rest under a collar at rest, by Newton's method with halved steps. */
static int rest_pad(const rf_thrust *bearing, size_t pad, const double *u, double *x)
{
    const double still[RF_THRUST_INPUTS] = {u[0], u[1], u[2], 0.0, 0.0, 0.0, u[6]};
    const size_t tilts = (size_t)bearing->tilts;
    double *own = x + pad * tilts, moment[TILTS], step[TILTS], S[TILTS][TILTS], left = HUGE_VAL;
    double start[TILTS] = {own[0], tilts > 1 ? own[1] : 0.0};
    step[0] = step[1] = 0.0;
    for (int k = 0; k < MOST_STEPS; ++k) {
        int status = RF_AT_WALL, balanced = 0;
        pad_film at;
        for (int halving = 0; halving < HALVINGS; ++halving) {
            for (size_t i = 0; i < tilts; ++i)
                own[i] = start[i] - ldexp(step[i], -halving);
            memset(&at, 0, sizeof at);
            place_pad(bearing, pad, x, still, at.q, at.v);
            status = take_pad(bearing, &at, u[6], 1);
            if (status == RF_AT_WALL)
                continue;
            if (status != RF_OK)
                return status;
            balanced = is_balanced(bearing, &at, moment) && at.y[0] > 0.0; /* no film is no rest */
            const double size = hypot(moment[0], tilts > 1 ? moment[1] : 0.0);
            if (balanced || size < left) {
                left = size;
                break;
            }
            status = RF_STUCK;
        }
        if (status != RF_OK)
            return RF_STUCK;
        if (balanced)
            return RF_OK;
        memcpy(start, own, tilts * sizeof(double));
        pivot_matrix(bearing, at.by_place, S);
        if (!solve_tilts(bearing->tilts, S, moment, step))
            return RF_STUCK;
    }
    return RF_STUCK;
}

int rf_thrust_rest(const rf_thrust *bearing, const double *u, double *x)
{
    const size_t tilts = (size_t)bearing->tilts;
    int status = RF_OK;
    for (size_t k = 0; k < bearing->count && tilts && status == RF_OK; ++k) {
        if (k > 0 && u[1] == 0.0 && u[2] == 0.0)
            memcpy(x + k * tilts, x, tilts * sizeof(double));
        else
            status = rest_pad(bearing, k, u, x);
    }
    return status;
}

double rf_thrust_least(const rf_thrust *bearing, const double *x, const double *u)
{
    double least = HUGE_VAL, q[PLACES], v[PLACES];
    for (size_t k = 0; k < bearing->count; ++k) {
        place_pad(bearing, k, x, u, q, v);
        least = fmin(least, rf_sector_least(&bearing->pad, q));
    }
    return least;
}
