#include "wall.h"

#define FACTOR 48.0
#define MEASURED 1.96 /* X just below that of .97, the last node farthest from the wall beyond which forces were measured */
#define NEAR 4.5      /* X between those of .99 and .999: from the latter on the film at the wall errs less */
#define LARGEST 1e15 /* tangent where the film at the wall is far from the wall and E is nothing */

static RF_ONCE void values(double u, double b[RF_ORDER])
{
    rf_values(u, b);
}

static RF_ONCE void slopes(double u, double b[RF_ORDER])
{
    rf_slopes(u, b);
}

/* Lambda and its derivatives in q and l. */
typedef struct lambda {
    double value, q, qq, l, ql;
} lambda;

/* In both directions Lambda goes on linearly beyond the nodes, as it does for ever. */
static lambda look_up(double q, double l)
{
    const double end = log(RF_WALL_LONG / RF_WALL_SHORT), first = log(RF_WALL_SHORT);
    const double per_q = RF_WALL_CELLS_Q / RF_WALL_END_Q, per_l = RF_WALL_CELLS_L / end;
    const double past = fmax(q - RF_WALL_END_Q, 0.0), before = fmin(l - first, 0.0);
    double u, v, b[RF_ORDER], b_l[RF_ORDER], row[3][RF_ORDER];
    const int32_t i = rf_cell((q - past) * per_q, RF_WALL_CELLS_Q, &u);
    const int32_t j = rf_cell((l - before - first) * per_l, RF_WALL_CELLS_L, &v);
    const float *c = rf_wall_table + (size_t)i * RF_WALL_LAYER + (size_t)j;
    values(v, b);
    slopes(v, b_l);
    double along[RF_ORDER], along_l[RF_ORDER];
    for (int k = 0; k < RF_ORDER; ++k, c += RF_WALL_LAYER) {
        along[k] = along_l[k] = 0.0;
        for (int m = 0; m < RF_ORDER; ++m) {
            along[k] += c[m] * b[m];
            along_l[k] += c[m] * b_l[m];
        }
    }
    values(u, row[0]);
    slopes(u, row[1]);
    rf_curvatures(u, row[2]);
    lambda at = {rf_dot(row[0], along), per_q * rf_dot(row[1], along), per_q * per_q * rf_dot(row[2], along),
                 per_l * rf_dot(row[0], along_l), per_q * per_l * rf_dot(row[1], along_l)};
    if (before < 0.0) {
        at.value += 2.0 * before;
        at.l = 2.0;
        at.ql = 0.0;
    }
    if (past > 0.0) {
        at.value += past * at.q;
        at.l += past * at.ql;
        at.qq = 0.0;
    }
    return at;
}

void rf_at_wall(double slenderness, double chi, double c, double s, rf_potential *e)
{
    const double sign = s < 0.0 ? -1.0 : 1.0, g = (1.0 - chi) * (1.0 + chi), root = sqrt(g);
    s = fabs(s);
    const double n = c * c + g * s * s, size = sqrt(n), length = 2.0 * slenderness / root;
    /* psi, the angle from e to u, without cancellation; q = ln(1 + tan_half^2) */
    const double tan_half = fmin(c > 0.0 ? root * s / (size + c) : (size - c) / (root * s), LARGEST);
    const double taper = 1.0 / (1.0 + length / RF_WALL_LONG);
    const lambda at = look_up(log(1.0 + tan_half * tan_half), log(length * taper));
    /* Of psi in the angle t of w, and in g. */
    const double psi_t = root / n, n_t = 2.0 * s * c * (g - 1.0), n_tt = 2.0 * (c * c - s * s) * (g - 1.0);
    const double psi_tt = -root * n_t / (n * n), psi_g = s * c / (2.0 * root * n);
    const double psi_tg = 1.0 / (2.0 * root * n) - root * s * s / (n * n);
    const double bend = 0.5 * (1.0 + tan_half * tan_half); /* of q in psi; the slope is tan_half */
    const double l_g = -taper / (2.0 * g), q_t = tan_half * psi_t, q_g = tan_half * psi_g;
    const double t = n_t / n + at.q * q_t, by_g = -1.5 / g + s * s / n + at.q * q_g + at.l * l_g;
    const double tt = n_tt / n - n_t * n_t / (n * n) + at.qq * q_t * q_t
                      + at.q * (bend * psi_t * psi_t + tan_half * psi_tt);
    const double tg = 2.0 * s * c / n - n_t * s * s / (n * n) + at.qq * q_t * q_g + at.ql * q_t * l_g
                      + at.q * (bend * psi_t * psi_g + tan_half * psi_tg);
    const double value = -FACTOR * n * exp(at.value) / (g * root);
    e->value = value;
    e->turn = sign * value * t;
    e->turn_turn = value * (tt + t * t);
    e->slope = -2.0 * chi * value * by_g;
    e->turn_slope = -2.0 * chi * sign * value * (tg + t * by_g);
}

int rf_go_to_wall(double slenderness, double chi_end, const rf_frame *at, const rf_exponent *from, const rf_share *share,
                  const double *turned, const double *by_rate, double *f, double *jacobian)
{
    rf_potential gain, end;
    rf_at_wall(slenderness, at->chi, at->cos, -at->sin, &gain);
    rf_at_wall(slenderness, chi_end, at->cos, -at->sin, &end);
    gain.value -= end.value;
    gain.turn -= end.turn;
    gain.turn_turn -= end.turn_turn;
    const double first = -exp(from->value), part = share->value, per = at->size / at->chi;
    const double value = first + part * gain.value, by_w = first * from->turn + part * gain.turn;
    const double by_ww = first * (from->turn * from->turn + from->turn_turn) + part * gain.turn_turn;
    rf_set_force(at, value, by_w / value, f);
    if (jacobian) {
        const double turn = by_w / value;
        const double by_e[4] = {2.0 * at->size * (part * gain.slope + share->slope * gain.value),
                                2.0 * per * (turned[0] + share->side * gain.value - by_w),
                                at->size * (part * gain.turn_slope + share->slope * gain.turn),
                                per * (turned[1] + share->side * gain.turn - by_ww)};
        rf_set_columns(at, at->rx, at->ry, by_e, 0, jacobian);
        rf_set_damping(at, value, turn, by_ww / value - turn * turn, jacobian);
    }
    if (jacobian && by_rate) {
        const double along = 2.0 * at->size * (first * by_rate[0] + by_rate[2] * gain.value);
        const double across = at->size * (first * (by_rate[0] * from->turn + by_rate[1]) + by_rate[2] * gain.turn);
        jacobian[8] = along * at->nx - across * at->ny;
        jacobian[9] = along * at->ny + across * at->nx;
    }
    return rf_judge(1.0, 0.0, f, jacobian);
}

int rf_wall_error(double x_end)
{
    return x_end < MEASURED ? 0 : x_end < NEAR ? 5 : 2;
}
