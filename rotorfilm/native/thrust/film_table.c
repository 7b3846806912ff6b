#include "film_table.h"

#include <math.h>

#include "../films/quintic.h"

#define F RF_TABLE_WHOLE
#define P RF_TABLE_PAD
#define MOST P
#define COLUMNS RF_SECTOR_COLUMNS
#define ROWS RF_SECTOR_ROWS
#define SHARE 0.05 /* of the potential that sources of tilt rates may add, to which their second order is used */
#define RISING 0.25  /* rate at which a film opens over film and speed, to which its pads hardly rupture by it */
#define OPENING 0.25 /* opening source of a corner, over the largest closing one, with which no pad was seen to rupture */

/* Functions of a table and derivatives by its axes. */
typedef struct rf_functions {
    double f[MOST], x[MOST], y[MOST], xy[MOST], yy[MOST];
} rf_functions;

/* Order 0 sets f and y alone. Sums over x come first: what is under a place lies side by side over y and functions. */
static RF_INLINE void look_up(const rf_film_table *table, double at_x, double at_y, int count, int order, rf_functions *to)
{
    double u, v, bx[RF_ORDER], dx[RF_ORDER], by[RF_ORDER], dy[RF_ORDER], ddy[RF_ORDER];
    const double per_x = table->cells_x / (table->x1 - table->x0), per_y = table->cells_y / (table->y1 - table->y0);
    const size_t i = (size_t)rf_cell((at_x - table->x0) * per_x, table->cells_x, &u);
    const size_t j = (size_t)rf_cell((at_y - table->y0) * per_y, table->cells_y, &v);
    const size_t width = ((size_t)table->cells_y + RF_ORDER - 1) * (size_t)count;
    const double *c = table->coefficients + i * width + j * (size_t)count;
    double row[RF_ORDER * MOST] = {0.0}, row_x[RF_ORDER * MOST] = {0.0};
    rf_values(u, bx);
    rf_values(v, by);
    rf_slopes(v, dy);
    if (order > 0) {
        rf_slopes(u, dx);
        rf_curvatures(v, ddy);
    }
    for (size_t a = 0; a < RF_ORDER; ++a, c += width)
        for (int k = 0; k < RF_ORDER * count; ++k) {
            row[k] += bx[a] * c[k];
            if (order > 0)
                row_x[k] += dx[a] * c[k];
        }
    for (int k = 0; k < count; ++k) {
        double f = 0.0, y = 0.0, x = 0.0, xy = 0.0, yy = 0.0;
        for (int b = 0; b < RF_ORDER; ++b) {
            const double one = row[b * count + k];
            f += by[b] * one;
            y += dy[b] * one;
            if (order > 0) {
                yy += ddy[b] * one;
                x += by[b] * row_x[b * count + k];
                xy += dy[b] * row_x[b * count + k];
            }
        }
        to->f[k] = f;
        to->y[k] = y * per_y;
        to->x[k] = x * per_x;
        to->xy[k] = xy * per_x * per_y;
        to->yy[k] = yy * per_y * per_y;
    }
}

/* h = s^n f(x, y)/z^m and its derivatives by v = w0, speed and z. */
typedef struct rf_term {
    double h, v, o, z, vv, vo, oo, vz, oz;
} rf_term;

static RF_INLINE rf_term term_of(const rf_functions *at, int k, int n, int m, double z, double s, double c, double i)
{
    /* In the plane of (speed, X) at the angle y: A = dg/dX and B = dg/dspeed of g = s^n f, of degree n - 1. */
    const double f = at->f[k], fy = at->y[k], fyy = at->yy[k], fx = at->x[k], fxy = at->xy[k];
    const double per = RF_TABLE_RATIO / z, down = m > 1 ? 1.0 / (z * z * z) : 1.0 / z;
    const double s1 = n == 2 ? s : n == 1 ? 1.0 : 1.0 / s, s0 = s1 * s, s2 = s1 / s, X = s * i;
    const double a = n * i * f + c * fy, a_y = n * c * f + (n - 1) * i * fy + c * fyy;
    const double b = n * c * f - i * fy, b_y = -n * i * f + (n - 1) * c * fy - i * fyy;
    const double ax = n * i * fx + c * fxy, bx = n * c * fx - i * fxy;
    const double aX = (n - 1) * i * a + c * a_y, aO = (n - 1) * c * a - i * a_y, bO = (n - 1) * c * b - i * b_y;
    rf_term to;
    to.h = down * s0 * f;
    to.v = down * per * s1 * a;
    to.o = down * s1 * b;
    to.z = down / z * (s0 * (fx - m * f) - X * s1 * a);
    to.vv = down * per * per * s2 * aX;
    to.vo = down * per * s2 * aO;
    to.oo = down * s2 * bO;
    to.vz = down * per / z * (s1 * (ax - (m + 1.0) * a) - X * s2 * aX);
    to.oz = down / z * (s1 * (bx - m * b) - X * s2 * aO);
    return to;
}

int rf_whole_film(const rf_film_table *table, double viscosity, const double *q, const double *v, double speed, double *y,
                  double *by)
{
    const double z = q[0], a = q[1], b = q[2], X = RF_TABLE_RATIO * v[0] / z, s = rf_length(X, speed);
    const double x = z > 0.0 ? log(z) : -HUGE_VAL, tilt = a * a + b * b;
    if (!(x >= table->x0 && x <= table->x1) || !(tilt <= table->leading * table->leading * z * z) || !(s > 0.0))
        return RF_OUTSIDE;
    if (speed < 0.0 || v[0] > RISING * z * speed)
        return RF_OUTSIDE;
    const double angle = atan2(X, speed), c = speed / s, i = X / s, mu = viscosity;
    rf_functions at;
    rf_term t[F];
    if (by)
        look_up(table, x, angle < 0.0 ? angle + RF_TURN : angle, F, 1, &at);
    else
        look_up(table, x, angle < 0.0 ? angle + RF_TURN : angle, F, 0, &at);
    at.f[0] = -at.f[0];
    at.x[0] = -at.x[0];
    at.y[0] = -at.y[0];
    at.xy[0] = -at.xy[0];
    at.yy[0] = -at.yy[0];
    t[0] = term_of(&at, 0, 2, 1, z, s, c, i);
    t[1] = term_of(&at, 1, 2, 3, z, s, c, i);
    t[2] = term_of(&at, 2, 1, 3, z, s, c, i);
    t[3] = term_of(&at, 3, 1, 3, z, s, c, i);
    t[4] = term_of(&at, 4, 0, 3, z, s, c, i);
    /* J is the sum of the terms times m; m by a, b, and the rates of both, and the speed. */
    const double w1 = v[1] + 0.5 * speed * b, w2 = v[2] - 0.5 * speed * a, half = 0.5 * speed;
    if (!(-at.f[0] >= table->arm) || !(0.5 * fabs(t[4].h) * (w1 * w1 + w2 * w2) <= SHARE * fabs(t[0].h)))
        return RF_OUTSIDE;
    const double m[F] = {1.0, 0.5 * tilt, a * w1 + b * w2, a * w2 - b * w1, 0.5 * (w1 * w1 + w2 * w2)};
    double u, near[RF_ORDER], slope[RF_ORDER], shear[RF_TABLE_SHEARS] = {0.0}, shear_x[RF_TABLE_SHEARS] = {0.0};
    const double per_x = table->cells_x / (table->x1 - table->x0);
    const size_t cell = (size_t)rf_cell((x - table->x0) * per_x, table->cells_x, &u);
    rf_values(u, near);
    rf_slopes(u, slope);
    for (size_t j = 0; j < RF_ORDER; ++j)
        for (int k = 0; k < RF_TABLE_SHEARS; ++k) {
            const double coefficient = table->shears[(cell + j) * RF_TABLE_SHEARS + (size_t)k];
            shear[k] += near[j] * coefficient;
            shear_x[k] += per_x * slope[j] * coefficient;
        }
    const double beta = t[2].h, gamma = t[3].h, delta = t[4].h;
    const double along = beta * a - gamma * b + delta * w1, across = beta * b + gamma * a + delta * w2;
    const double z3 = z * z * z, sheared = shear[0] / z + 0.5 * tilt * shear[1] / z3;
    double force = 0.0, swirl = 0.0; /* dJ/dw0, and half of dJ/dw3 */
    for (int k = 0; k < F; ++k) {
        force += t[k].v * m[k];
        swirl += t[k].o * m[k];
    }
    y[0] = mu * force;
    y[1] = mu * along;
    y[2] = mu * across;
    y[3] = mu * (swirl - 0.5 * (a * across - b * along) - speed * sheared);
    if (!by)
        return RF_OK;
    const double n[F][COLUMNS] = {
        {0.0},
        {0.0, a, b},
        {0.0, w1 - half * b, w2 + half * a, 0.0, a, b},
        {0.0, w2 - half * a, -w1 - half * b, 0.0, -b, a, -0.5 * tilt},
        {0.0, -half * w2, half * w1, 0.0, w1, w2, 0.5 * (w1 * b - w2 * a)},
    };
    for (int j = 0; j < COLUMNS; ++j) {
        double by_force = 0.0, by_swirl = 0.0;
        for (int k = 0; k < F; ++k) {
            const double d[2] = {j == 0 ? t[k].vz : j == 3 ? t[k].vv : j == 6 ? t[k].vo : 0.0,
                                 j == 0 ? t[k].oz : j == 3 ? t[k].vo : j == 6 ? t[k].oo : 0.0};
            by_force += d[0] * m[k] + t[k].v * n[k][j];
            by_swirl += d[1] * m[k] + t[k].o * n[k][j];
        }
        double p[3]; /* beta, gamma and delta by this one */
        for (int k = 0; k < 3; ++k)
            p[k] = j == 0 ? t[k + 2].z : j == 3 ? t[k + 2].v : j == 6 ? t[k + 2].o : 0.0;
        const double of_a = j == 1, of_b = j == 2;
        const double of_w1 = j == 4 ? 1.0 : j == 2 ? half : j == 6 ? 0.5 * b : 0.0;
        const double of_w2 = j == 5 ? 1.0 : j == 1 ? -half : j == 6 ? -0.5 * a : 0.0;
        const double d_along = p[0] * a - p[1] * b + p[2] * w1 + beta * of_a - gamma * of_b + delta * of_w1;
        const double d_across = p[0] * b + p[1] * a + p[2] * w2 + beta * of_b + gamma * of_a + delta * of_w2;
        double d_sheared = (a * of_a + b * of_b) * shear[1] / z3;
        if (j == 0)
            d_sheared = (shear_x[0] - shear[0]) / (z * z) + 0.5 * tilt * (shear_x[1] - 3.0 * shear[1]) / (z3 * z);
        by[j] = mu * by_force;
        by[COLUMNS + j] = mu * d_along;
        by[2 * COLUMNS + j] = mu * d_across;
        by[3 * COLUMNS + j] = mu * (by_swirl - speed * d_sheared - (j == 6 ? sheared : 0.0)
                                    - 0.5 * (of_a * across - of_b * along + a * d_across - b * d_along));
    }
    return RF_OK;
}

/* Whether the source at the corners closes the gap, or hardly opens it: then no film of the pad ruptures. */
static int closes(const rf_sector *pad, const double *w)
{
    double most = -HUGE_VAL, least = HUGE_VAL;
    for (int k = 0; k < 4; ++k) {
        const double angle = pad->angle[k & 1 ? pad->lines : 0], r = pad->radius[k & 2 ? pad->nodes : 0];
        const double source = w[0] + r * (w[1] * sin(angle) - w[2] * cos(angle));
        most = fmax(most, source);
        least = fmin(least, source);
    }
    return most <= -OPENING * least && least < 0.0;
}

int rf_pad_table_film(const rf_film_table *table, const rf_sector *pad, const double *q, const double *w, double *y, double *by)
{
    const double h = q[0] - q[2] * table->pivot;
    if (!(h > 0.0) || !closes(pad, w))
        return RF_OUTSIDE;
    const double A = q[1] / h, R = -q[2] / h, lead = 1.0 + A * table->leading, trail = 1.0 + A * table->trailing;
    if (!(lead > 0.0) || !(trail > 0.0))
        return RF_OUTSIDE;
    const double room = lead * trail / (lead + trail), x = log(lead / trail), at_y = R * table->arm / room;
    if (!(x >= table->x0 && x <= table->x1) || !(at_y >= table->y0 && at_y <= table->y1))
        return RF_OUTSIDE;
    rf_functions at;
    if (by)
        look_up(table, x, at_y, P, 1, &at);
    else
        look_up(table, x, at_y, P, 0, &at);
    /* By A and R, and those by q. */
    const double x_A = table->leading / lead - table->trailing / trail;
    const double room_A = (table->leading * trail * trail + table->trailing * lead * lead) / ((lead + trail) * (lead + trail));
    const double y_R = table->arm / room, y_A = -at_y * room_A / room;
    const double h_q[3] = {1.0, 0.0, -table->pivot};
    const double A_q[3] = {-A / h, 1.0 / h, A * table->pivot / h}, R_q[3] = {-R / h, 0.0, -1.0 / h + R * table->pivot / h};
    static const int place[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    const double mu = pad->viscosity, unit = exp(at.f[0]) / (h * h * h), speed = 2.0 * w[3];
    double c[P], c_q[3][P];
    for (int k = 0; k < P; ++k) {
        const int last = k == P - 1;
        c[k] = last ? at.f[k] / h : k ? unit * at.f[k] : unit;
        for (int j = 0; by && j < 3; ++j) {
            const double dx = x_A * A_q[j], dy = y_A * A_q[j] + y_R * R_q[j], df = at.x[k] * dx + at.y[k] * dy;
            const double d0 = at.x[0] * dx + at.y[0] * dy - 3.0 * h_q[j] / h; /* of ln(unit) */
            c_q[j][k] = last ? (df - at.f[k] * h_q[j] / h) / h : c[k] * d0 + (k ? unit * df : 0.0);
        }
    }
    for (int i = 0; i < 3; ++i)
        y[i] = -mu * (c[place[i][0]] * w[0] + c[place[i][1]] * w[1] + c[place[i][2]] * w[2]);
    y[3] = -mu * speed * c[P - 1] - 0.5 * (q[1] * y[2] - q[2] * y[1]);
    for (int j = 0; by && j < COLUMNS; ++j) {
        double g[3];
        for (int i = 0; i < 3; ++i) {
            g[i] = j >= 6 ? 0.0 : j >= 3 ? -mu * c[place[i][j - 3]] : 0.0;
            for (int k = 0; k < 3 && j < 3; ++k)
                g[i] -= mu * c_q[j][place[i][k]] * w[k];
            by[i * COLUMNS + j] = g[i];
        }
        by[3 * COLUMNS + j] = -0.5 * (q[1] * g[2] - q[2] * g[1] + (j == 1 ? y[2] : j == 2 ? -y[1] : 0.0))
                              - mu * (j < 3 ? speed * c_q[j][P - 1] : j == 6 ? 2.0 * c[P - 1] : 0.0);
    }
    return RF_OK;
}
