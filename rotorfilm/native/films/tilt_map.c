#include "tilt_map.h"

#include <string.h>

#include "map_frame.h"
#include "map_spline.h"

#define ROWS RF_TILT_ROWS
#define PAIRS 10
#define LEAST 1e-12 /* |w| over |w1|, below which only the direction of w counts */

/* Entries of S in turn: rows and columns of (tau_n, tau_m, w1_n, w1_m). */
static const int FIRST[PAIRS] = {0, 0, 1, 0, 0, 1, 1, 2, 2, 3}, SECOND[PAIRS] = {0, 1, 1, 2, 3, 2, 3, 2, 3, 3};
static const int IS_ODD[PAIRS] = {0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, POWER[PAIRS] = {2, 2, 2, 1, 1, 1, 1, 0, 0, 0};

/* M at a place, and its derivatives by X and c. */
typedef struct numbers {
    double m[ROWS], m_c[ROWS], m_x[ROWS], m_xc[ROWS], m_cc[ROWS];
} numbers;

/* Something of e and the angle of w: its value, derivatives by that angle, and by e along n and m. */
typedef struct jet {
    double value, turn, turn_turn, by[2], turn_by[2];
} jet;

/* A symmetric 4 x 4 matrix of jets. */
typedef struct matrices {
    double value[4][4], turn[4][4], turn_turn[4][4], by[2][4][4], turn_by[2][4][4];
} matrices;

static RF_INLINE void add_row(const double *restrict c, double by, double *restrict sum)
{
    for (int k = 0; k < ROWS; ++k)
        sum[k] += by * c[k];
}

/* Over X first: then each sum over c has six rows. */
static RF_INLINE void evaluate(const rf_tilt_map *map, const rf_weights *x, const rf_weights *s, int full, numbers *at)
{
    const size_t width = rf_width(&map->s) * ROWS;
    const double *first = map->coefficients + x->cell * width + s->cell * ROWS;
    memset(at, 0, sizeof *at);
    for (size_t j = 0; j < RF_ORDER; ++j, first += ROWS) {
        double value[ROWS] = {0.0}, slope[ROWS] = {0.0};
        for (size_t i = 0; i < RF_ORDER; ++i) {
            add_row(first + i * width, x->value[i], value);
            if (full)
                add_row(first + i * width, x->per * x->slope[i], slope);
        }
        add_row(value, s->value[j], at->m);
        add_row(value, s->per * s->slope[j], at->m_c);
        if (full) {
            add_row(value, s->per * s->per * s->bend[j], at->m_cc);
            add_row(slope, s->value[j], at->m_x);
            add_row(slope, s->per * s->slope[j], at->m_xc);
        }
    }
}

/* y of one row; `along` is chi dX/dchi. Nothing is divided by chi. */
static jet jet_of(const numbers *of, int k, double y0, int odd, const rf_frame *at, double along, int full)
{
    const double m = of->m[k], m_c = of->m_c[k], m_cc = of->m_cc[k], c = at->cos, s = at->sin, chi = at->chi;
    const double moved[2] = {along * of->m_x[k] * c + m_c * s * s, along * of->m_x[k] * s - m_c * s * c};
    const double turned[2] = {along * of->m_xc[k] * c + m_cc * s * s, along * of->m_xc[k] * s - m_cc * s * c};
    const double bent = m_cc * s * s - m_c * c;
    if (!full) {
        const jet short_of = {odd ? chi * s * m : y0 + chi * m, odd ? chi * (s * s * m_c - c * m) : chi * m_c * s,
                              0.0, {0.0, 0.0}, {0.0, 0.0}};
        return short_of;
    }
    if (!odd) {
        const jet even = {y0 + chi * m, chi * m_c * s, chi * bent, {m * c + moved[0], m * s + moved[1]},
                          {s * turned[0], m_c + s * turned[1]}};
        return even;
    }
    const double tip = s * m_c * c;
    const jet found = {chi * s * m, chi * (s * s * m_c - c * m), chi * s * (bent - m) - 2.0 * chi * c * s * m_c,
                       {s * moved[0], m + s * moved[1]},
                       {-m - c * moved[0] - tip * s + s * s * turned[0],
                        -c * moved[1] + s * m_c + tip * c + s * s * turned[1]}};
    return found;
}

/* exp(L) y, L changing by `wall` along e besides. */
static jet scaled(const jet *y, const jet *L, double size, double wall, const rf_frame *at, int full)
{
    jet found = {size * y->value, size * (y->turn + L->turn * y->value), 0.0, {0.0, 0.0}, {0.0, 0.0}};
    if (!full)
        return found;
    const double more[2] = {L->by[0] + wall * at->cos, L->by[1] + wall * at->sin};
    found.turn_turn = size * (y->turn_turn + 2.0 * L->turn * y->turn
                              + (L->turn_turn + L->turn * L->turn) * y->value);
    for (int k = 0; k < 2; ++k) {
        found.by[k] = size * (y->by[k] + more[k] * y->value);
        found.turn_by[k] = size * (y->turn_by[k] + more[k] * y->turn + L->turn * y->by[k]
                                   + (L->turn_by[k] + more[k] * L->turn) * y->value);
    }
    return found;
}

static void set_matrices(const rf_tilt_map *map, const numbers *of, const rf_frame *at, double along, int full,
                                   matrices *S)
{
    const double gap = (1.0 - at->chi) * (1.0 + at->chi), wall = 2.0 * at->chi / gap;
    const jet L = jet_of(of, 0, map->center[0], 0, at, along, full);
    const double potential = exp(L.value), scale[3] = {potential, potential / gap, potential / (gap * gap)};
    for (int k = 0; k < PAIRS; ++k) {
        const int i = FIRST[k], j = SECOND[k], p = POWER[k];
        const jet y = jet_of(of, k + 1, map->center[k + 1], IS_ODD[k], at, along, full);
        const jet found = scaled(&y, &L, scale[p], p * wall, at, full);
        S->value[i][j] = S->value[j][i] = found.value;
        S->turn[i][j] = S->turn[j][i] = found.turn;
        for (int b = 0; full && b < 2; ++b) {
            S->by[b][i][j] = S->by[b][j][i] = found.by[b];
            S->turn_by[b][i][j] = S->turn_by[b][j][i] = found.turn_by[b];
        }
        if (full)
            S->turn_turn[i][j] = S->turn_turn[j][i] = found.turn_turn;
    }
}

static void look_up(const rf_tilt_map *map, const rf_frame *at, double x, double along, int full, matrices *S)
{
    numbers of;
    rf_weights by_x, by_s;
    rf_weigh_from_zero(&map->x, x, full, &by_x);
    rf_weigh_between(&map->s, at->cos, full ? 2 : 1, &by_s);
    evaluate(map, &by_x, &by_s, full, &of);
    set_matrices(map, &of, at, along, full, S);
}

/* v turned by a right angle: what the frame does to both pairs, against its turn. */
static void turn_pairs(const double v[4], double turned[4])
{
    const double found[4] = {v[1], -v[0], v[3], -v[2]};
    memcpy(turned, found, sizeof found);
}

static void multiply(double S[4][4], const double v[4], double product[4])
{
    for (int i = 0; i < 4; ++i)
        product[i] = S[i][0] * v[0] + S[i][1] * v[1] + S[i][2] * v[2] + S[i][3] * v[3];
}

static double dot(const double a[4], const double b[4])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/* S v and, where w turns, its change: v are a tau and w1 in the frame, which turns with w. */
typedef struct products {
    double v[4], tau[4], turned[4], turned_tau[4]; /* v, its slope by a, and both turned against the frame */
    double S[4], S_tau[4], turn[4], turn_tau[4];   /* S v, S dv/da, and their slopes by the angle of w, before v */
} products;

static void set_products(matrices *S, double a, const double t[2], const double u[2], products *p)
{
    const double v[4] = {a * t[0], a * t[1], u[0], u[1]}, tau[4] = {t[0], t[1], 0.0, 0.0};
    memcpy(p->v, v, sizeof v);
    memcpy(p->tau, tau, sizeof tau);
    turn_pairs(v, p->turned);
    turn_pairs(tau, p->turned_tau);
    multiply(S->value, v, p->S);
    multiply(S->value, tau, p->S_tau);
    multiply(S->turn, v, p->turn);
    multiply(S->turn, tau, p->turn_tau);
}

/* Rows and columns (n, m) of a 2 x 2 block turned to (x, y), at rows first, columns `column` of by[4][8]. */
static void put(const rf_frame *at, double b[2][2], int first, int column, double *by)
{
    const double R[2][2] = {{at->nx, -at->ny}, {at->ny, at->nx}};
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            for (int k = 0; k < 2; ++k)
                for (int l = 0; l < 2; ++l)
                    by[8 * (first + i) + column + j] += R[i][k] * b[k][l] * R[j][l];
}

/* The second derivatives of J2: rows w, w1; columns e, tau, w, w1. */
static void set_slopes(matrices *S, const products *p, double a, const rf_frame *at, double *by)
{
    const double J_a = dot(p->tau, p->S), J_turn = 0.5 * dot(p->v, p->turn) + dot(p->turned, p->S);
    double F_e[2][2], F_t[2][2], F_w[2][2], F_u[2][2], T_e[2][2], T_t[2][2], T_w[2][2], T_u[2][2];
    double second[4], S_turned[4], back[4], product[4];
    multiply(S->turn_turn, p->v, second);
    multiply(S->value, p->turned, S_turned);
    turn_pairs(p->turned, back);
    const double bent = 0.5 * dot(p->v, second) + 2.0 * dot(p->turned, p->turn) + dot(p->turned, S_turned) + dot(back, p->S);
    const double mixed = dot(p->tau, p->turn) + dot(p->turned_tau, p->S) + dot(p->tau, S_turned);
    F_w[0][0] = dot(p->tau, p->S_tau);
    F_w[0][1] = F_w[1][0] = mixed / a - J_turn / (a * a);
    F_w[1][1] = bent / (a * a) + J_a / a;
    for (int k = 0; k < 2; ++k) {
        multiply(S->by[k], p->v, product);
        F_e[0][k] = dot(p->tau, product);
        T_e[0][k] = product[2];
        T_e[1][k] = product[3];
        F_e[1][k] = dot(p->turned, product);
        multiply(S->turn_by[k], p->v, product);
        F_e[1][k] = (F_e[1][k] + 0.5 * dot(p->v, product)) / a;
        /* By tau and w1 in the frame: v changes by a and by 1, the turned v by those turned. */
        const int other = 1 - k;
        const double sign = k == 0 ? -1.0 : 1.0; /* of the unit vector k turned against the frame */
        F_t[0][k] = p->S[k] + a * p->S_tau[k];
        F_u[0][k] = p->S_tau[2 + k];
        F_t[1][k] = p->turn[k] + S_turned[k] + sign * p->S[other];
        F_u[1][k] = (p->turn[2 + k] + S_turned[2 + k] + sign * p->S[2 + other]) / a;
        for (int i = 0; i < 2; ++i) {
            T_t[i][k] = a * S->value[2 + i][k];
            T_u[i][k] = S->value[2 + i][2 + k];
        }
    }
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k)
            T_w[i][k] = F_u[k][i];
    memset(by, 0, 32 * sizeof *by);
    put(at, F_e, 0, 0, by);
    put(at, F_t, 0, 2, by);
    put(at, F_w, 0, 4, by);
    put(at, F_u, 0, 6, by);
    put(at, T_e, 2, 0, by);
    put(at, T_t, 2, 2, by);
    put(at, T_w, 2, 4, by);
    put(at, T_u, 2, 6, by);
}

static int second_order(const rf_tilt_map *map, const double *q, const double *drive, double *f, double *by)
{
    rf_frame at;
    matrices S;
    products p;
    const double e[2] = {q[0], q[1]};
    double slope = 0.0;
    memset(f, 0, 4 * sizeof *f);
    if (rf_is_broken(q, 4) || rf_is_broken(drive, 4))
        return RF_NOT_FINITE;
    const double ends = fmax(rf_length(q[0] + q[2], q[1] + q[3]), rf_length(q[0] - q[2], q[1] - q[3]));
    if (!(ends < 1.0))
        return RF_AT_WALL;
    const int status = rf_orient(e, drive, &at);
    if (status != RF_OK)
        return status;
    const double X = rf_stretch(at.chi, by ? &slope : NULL), along = X > map->x.last ? 0.0 : at.chi * slope;
    look_up(map, &at, fmin(X, map->x.last), along, by != NULL, &S);
    const double t[2] = {at.nx * q[2] + at.ny * q[3], at.nx * q[3] - at.ny * q[2]};
    const double u[2] = {at.nx * drive[2] + at.ny * drive[3], at.nx * drive[3] - at.ny * drive[2]};
    set_products(&S, at.size, t, u, &p);
    const double F[2] = {dot(p.tau, p.S), (0.5 * dot(p.v, p.turn) + dot(p.turned, p.S)) / at.size};
    f[0] = at.nx * F[0] - at.ny * F[1];
    f[1] = at.ny * F[0] + at.nx * F[1];
    f[2] = at.nx * p.S[2] - at.ny * p.S[3];
    f[3] = at.ny * p.S[2] + at.nx * p.S[3];
    if (by)
        set_slopes(&S, &p, at.size, &at, by);
    if (rf_is_broken(f, 4) || (by && rf_is_broken(by, 32)))
        return RF_NOT_FINITE;
    const int far = X > map->x.last * (1.0 + RF_ROUNDING) || rf_length(q[2], q[3]) > RF_TILT_SHARE * (1.0 - at.chi);
    return far ? RF_OUTSIDE : RF_OK;
}

/* F and its slopes of a source of the tilt that is held, w1 = (2 y - y^2) w1, in place of those found. */
static int hold_force(const rf_tilt_map *map, const double *q, const double *drive, double y, double *f, double *by)
{
    const double held = y * (2.0 - y), slope = 2.0 * y * (1.0 - y), *w = drive, *u = drive + 2;
    const double ww = w[0] * w[0] + w[1] * w[1], uu = u[0] * u[0] + u[1] * u[1];
    const double low[4] = {w[0], w[1], held * u[0], held * u[1]};
    double force[4], slopes[32];
    const int status = second_order(map, q, low, force, by ? slopes : NULL);
    memcpy(f, force, 2 * sizeof *f);
    for (int i = 0; by && i < 2; ++i) {
        double *row = memcpy(by + 8 * i, slopes + 8 * i, 8 * sizeof *by);
        const double along = slope * (row[6] * u[0] + row[7] * u[1]);
        for (int k = 0; k < 2; ++k) {
            row[4 + k] += along * w[k] / ww;
            row[6 + k] = held * row[6 + k] - along * u[k] / uu;
        }
    }
    return status > RF_OUTSIDE ? status : RF_OUTSIDE;
}

int rf_tilt_wrench(const rf_tilt_map *map, const double *q, const double *drive, double *f, double *by)
{
    double at[4] = {drive[0], drive[1], drive[2], drive[3]};
    const double size = rf_length(drive[0], drive[1]), other = rf_length(drive[2], drive[3]);
    if (size < LEAST * other && !(by && size == 0.0))
        for (int k = 0; k < 2; ++k)
            at[k] = size > 0.0 ? LEAST * other * (drive[k] / size) : LEAST * drive[2 + k];
    const int status = second_order(map, q, at, f, by);
    const double y = RF_TILT_DRIVE * rf_length(at[0], at[1]) / other;
    return status <= RF_OUTSIDE && y < 1.0 ? hold_force(map, q, at, y, f, by) : status;
}
