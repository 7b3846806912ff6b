#include "ball.h"

#include <math.h>
#include <string.h>

#include "ball_contact.h"
#include "ball_inertia.h"
#include "ball_traction.h"

#define STEPS 60
#define HALVINGS 30
#define EXACT 1e-14  /* residual over the loads at which a balance ends */
#define ENOUGH 1e-11 /* below which only roundoff may keep a step from making it smaller */
#define ROUNDOFF 1e-15 /* of the center of a ball, over the distance of the centers of curvature */
#define STILL 1e-13    /* a centrifugal approach, over the same, below which a ball is taken as static */
#define FAR 0.9        /* distance of the centers of curvature over that at touch, below which the rings are far apart */

/* The balance of a ball with its center at x: residual and its derivatives by x, by a and by log(speed)/2. */
typedef struct balance {
    rf_ball_contact in, out;
    rf_ball_inertia inertia;
    double share[2]; /* of the gyroscopic moment in the friction at both contacts */
    double rest[2], by_x[4], by_a[4], by_speed[2];
    double size;
} balance;

static void balance_at(const rf_ball_row *row, int inertia, const double *a, const double *x, double speed, balance *at)
{
    at->in = rf_ball_press(a[0] - x[0], a[1] - x[1], row->inner, row->inner_stiffness);
    at->out = rf_ball_press(x[0], x[1], row->outer, row->outer_stiffness);
    const rf_ball_contact *in = &at->in, *out = &at->out;
    rf_ball_inertia_at(row, inertia, in->e, out->e, speed, &at->inertia);
    const double *fc = at->inertia.force, *m = at->inertia.moment;
    at->share[0] = inertia == RF_BALLS_INNER_CONTROL ? 1.0 : 0.0;
    at->share[1] = 2.0 - at->share[0];
    for (int i = 0; i < 2; ++i) {
        const double lever = at->share[0] * in->t[i] - at->share[1] * out->t[i], up = (double)i;
        const double by_in = -m[1] * lever + m[0] * at->share[0] * in->e[i] + fc[1] * up;
        const double by_out = -m[2] * lever - m[0] * at->share[1] * out->e[i] + fc[2] * up;
        at->by_speed[i] = fc[0] * up - m[0] * lever;
        at->rest[i] = in->load * in->e[i] - out->load * out->e[i] + at->by_speed[i];
        for (int j = 0; j < 2; ++j) {
            const int k = 2 * i + j;
            at->by_a[k] = in->by[k] + by_in * in->t[j] / in->length;
            at->by_x[k] = by_out * out->t[j] / out->length - out->by[k] - at->by_a[k];
        }
    }
    at->size = in->load + out->load + fc[0] + fabs(m[0]);
}

/* The solution of q s = -r for a 2 x 2 matrix; 0 where it is singular. */
static int solve(const double *q, const double *r, double *s)
{
    const double det = q[0] * q[3] - q[1] * q[2];
    s[0] = (q[1] * r[1] - q[3] * r[0]) / det;
    s[1] = (q[2] * r[0] - q[0] * r[1]) / det;
    return isfinite(s[0]) && isfinite(s[1]);
}

/* The center of a ball that rests on the outer race only; whether the inner one is then open. Steep contacts are pressed
   with the center of curvature of the inner groove below that of the ball, but not where the grooves are far apart. */
static int is_free(const rf_ball_row *row, int inertia, const double *a, double speed, double *x, balance *at)
{
    const double up[2] = {0.0, 1.0};
    double kept = 0.0;
    x[0] = 0.0;
    x[1] = row->outer;
    for (int k = 0; k < STEPS && x[1] != kept; ++k) {
        const rf_ball_contact in = rf_ball_press(a[0] - x[0], fmax(a[1] - x[1], 0.0), row->inner, row->inner_stiffness);
        rf_ball_inertia_at(row, inertia, in.e, up, speed, &at->inertia);
        kept = x[1];
        x[1] = row->outer + pow(at->inertia.force[0] / row->outer_stiffness, 2.0 / 3.0);
    }
    at->in = rf_ball_press(a[0] - x[0], a[1] - x[1], row->inner, row->inner_stiffness);
    at->out = rf_ball_press(x[0], x[1], row->outer, row->outer_stiffness);
    const int is_far = hypot(a[0], a[1]) < FAR * (row->inner + row->outer);
    return !(at->in.length > row->inner) || a[1] <= (is_far ? x[1] : 0.0);
}

/* A residual that may be left. */
static double slack(const rf_ball_row *row, const balance *at)
{
    const double *k = at->by_x, stiffest = fabs(k[0]) + fabs(k[1]) + fabs(k[2]) + fabs(k[3]);
    return ENOUGH * at->size + ROUNDOFF * (row->inner + row->outer) * stiffest;
}

/* Newton's method with steps that shorten until the residual falls. */
static int find(const rf_ball_row *row, int inertia, const double *a, double speed, double *x, balance *at)
{
    balance_at(row, inertia, a, x, speed, at);
    for (int k = 0; k < STEPS; ++k) {
        const double norm = hypot(at->rest[0], at->rest[1]);
        double step[2];
        if (norm <= EXACT * at->size || !solve(at->by_x, at->rest, step))
            return norm <= slack(row, at);
        balance next;
        double share = 1.0;
        int better = 0, tries = norm <= slack(row, at) ? 1 : HALVINGS;
        for (; tries > 0 && !better; --tries, share *= 0.5) {
            const double trial[2] = {x[0] + share * step[0], x[1] + share * step[1]};
            balance_at(row, inertia, a, trial, speed, &next);
            better = hypot(next.rest[0], next.rest[1]) < norm;
        }
        if (!better)
            return norm <= slack(row, at);
        share *= 2.0;
        x[0] += share * step[0];
        x[1] += share * step[1];
        *at = next;
    }
    return 0;
}

/* Force on the inner ring -(load e - share moment t), and its derivatives with the ball's center in balance. */
static void answer(const balance *at, double speed, rf_ball *ball)
{
    const rf_ball_contact *in = &at->in, *out = &at->out;
    const double s = at->share[0], *m = at->inertia.moment;
    double inner[4], through[4], moved[6];
    for (int i = 0; i < 2; ++i) {
        ball->force[i] = -(in->load * in->e[i] - s * m[0] * in->t[i]);
        for (int j = 0; j < 2; ++j) {
            const int k = 2 * i + j;
            inner[k] = -in->by[k] + s * (m[1] * in->t[i] - m[0] * in->e[i]) * in->t[j] / in->length;
            through[k] = s * m[2] * in->t[i] * out->t[j] / out->length - inner[k];
        }
    }
    for (int j = 0; j < 3; ++j) {
        const double r[2] = {j < 2 ? at->by_a[j] : at->by_speed[0], j < 2 ? at->by_a[2 + j] : at->by_speed[1]};
        double x[2];
        solve(at->by_x, r, x);
        moved[j] = x[0];
        moved[3 + j] = x[1];
    }
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j)
            ball->by_place[2 * i + j] = inner[2 * i + j] + through[2 * i] * moved[j] + through[2 * i + 1] * moved[3 + j];
        const double own = s * m[0] * in->t[i] + through[2 * i] * moved[2] + through[2 * i + 1] * moved[5];
        ball->by_speed[i] = speed != 0.0 ? 2.0 / speed * own : 0.0;
    }
}

/* What a ball is under, besides the force on the ring. */
static void tell(const rf_ball_row *row, const balance *at, double speed, rf_ball *ball)
{
    const double m = fabs(at->inertia.moment[0]);
    ball->load[0] = at->in.load;
    ball->load[1] = at->out.load;
    ball->angle[0] = atan2(at->in.e[0], at->in.e[1]);
    ball->angle[1] = atan2(at->out.e[0], at->out.e[1]);
    ball->centrifugal = at->inertia.force[0];
    ball->gyroscopic = at->inertia.moment[0] * row->diameter;
    ball->orbit = at->inertia.orbit * speed;
    ball->gap = at->in.length - row->inner;
    const double inner = at->share[0] * m, outer = at->share[1] * m;
    ball->traction = outer > 0.0 ? outer / at->out.load : 0.0;
    if (inner > 0.0)
        ball->traction = fmax(ball->traction, inner / at->in.load);
}

static void stand(const rf_ball_row *row, const double *a, double speed, rf_ball *ball)
{
    const double per = pow(row->inner_stiffness, -2.0 / 3.0) + pow(row->outer_stiffness, -2.0 / 3.0);
    const rf_ball_contact c = rf_ball_press(a[0], a[1], a[1] > 0.0 ? row->inner + row->outer : HUGE_VAL, pow(per, -1.5));
    memset(ball, 0, sizeof *ball);
    for (int k = 0; k < 2; ++k) {
        ball->force[k] = -c.load * c.e[k];
        ball->load[k] = c.load;
        ball->angle[k] = atan2(c.e[0], c.e[1]);
    }
    for (int k = 0; k < 4; ++k)
        ball->by_place[k] = -c.by[k];
    ball->orbit = 0.5 * speed * (1.0 - row->ratio * c.e[1]);
    ball->gap = (a[1] > 0.0 ? c.length : 0.0) - row->inner - row->outer;
}

static int run(const rf_ball_row *row, const rf_ball_law *law, int inertia, const double *a, double speed, rf_ball *ball)
{
    balance at;
    double x[2];
    memset(ball, 0, sizeof *ball);
    memset(&at, 0, sizeof at);
    if (is_free(row, inertia, a, speed, x, &at)) {
        at.in.load = 0.0;
        memset(at.inertia.moment, 0, sizeof at.inertia.moment);
    } else {
        rf_ball_guess(row, a, at.inertia.force[0], x);
        if (inertia == RF_BALLS_TRACTION) {
            if (rf_ball_held(row, law, a, speed, x, ball))
                return RF_OK;
            /* Then from where the ball rests without its moment. */
            return find(row, RF_BALLS_LOOSE, a, speed, x, &at) && rf_ball_held(row, law, a, speed, x, ball) ? RF_OK : RF_STUCK;
        }
        if (!find(row, inertia, a, speed, x, &at) || !(at.in.load > 0.0))
            return RF_STUCK;
        answer(&at, speed, ball);
    }
    tell(row, &at, speed, ball);
    return RF_OK;
}

/* Whether the centrifugal force moves a ball by less than what roundoff of its place may do. */
static int is_slow(const rf_ball_row *row, double speed)
{
    const double force = 0.5 * row->mass * row->diameter / row->ratio * speed * speed;
    return force <= row->outer_stiffness * pow(STILL * (row->inner + row->outer), 1.5);
}

int rf_ball_at(const rf_ball_row *row, const rf_ball_law *law, const double *a, double speed, rf_ball *ball)
{
    int status = RF_OK;
    const int inertia = law->inertia;
    if (inertia == RF_BALLS_STATIC || is_slow(row, speed))
        stand(row, a, speed, ball);
    else
        status = run(row, law, inertia, a, speed, ball);
    /* An inner contact with next to no load holds no moment: then the outer race controls. */
    if (status == RF_STUCK && inertia == RF_BALLS_INNER_CONTROL)
        status = run(row, law, RF_BALLS_OUTER_CONTROL, a, speed, ball);
    /* Nor does the outer one of a ball that the moment would carry away from the inner race, which then holds none. */
    if (status == RF_STUCK && (inertia == RF_BALLS_INNER_CONTROL || inertia == RF_BALLS_OUTER_CONTROL))
        status = run(row, law, RF_BALLS_LOOSE, a, speed, ball);
    const double most = inertia == RF_BALLS_TRACTION ? RF_MOST_SHARE * law->traction : RF_MOST_TRACTION;
    if (status == RF_OK && (ball->traction > most || !(fmax(ball->load[0], ball->load[1]) <= row->largest)))
        return RF_OUTSIDE;
    return status;
}
