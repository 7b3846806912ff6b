#include "balls.h"

#include <math.h>
#include <string.h>

#define N RF_BALL_DEGREES
#define TURN 6.28318530717958647692

/* Where a ball is: the distance a of the centers of curvature there, its derivatives by the motion, row by row (they are
   linear), those turned on by the cage, and the derivatives of a by the angles of cage and shaft. */
typedef struct spot {
    double a[2], move[2 * N], turned[2 * N], by_cage[2], by_shaft[2];
} spot;

static void place(const rf_balls *balls, const rf_ball_row *row, const double *motion, double angle, spot *at)
{
    const double c = cos(angle), s = sin(angle), side = row->direction, arm = side * row->arm, far = row->place;
    const double move[2 * N] = {0.0, 0.0, side, arm * s, -arm * c, c, s, 0.0, -far * s, far * c};
    const double turned[2 * N] = {0.0, 0.0, 0.0, arm * c, arm * s, -s, c, 0.0, -far * c, -far * s};
    memcpy(at->move, move, sizeof move);
    memcpy(at->turned, turned, sizeof turned);
    at->a[0] = row->axial;
    at->a[1] = row->radial + balls->growth;
    for (int i = 0; i < 2; ++i) {
        at->by_cage[i] = at->by_shaft[i] = 0.0;
        for (int k = 0; k < N; ++k) {
            at->a[i] += move[N * i + k] * motion[k];
            at->by_cage[i] += turned[N * i + k] * motion[k];
        }
    }
}

/* Add the waves of both rings at a ball. */
static void wave(const rf_balls *balls, double angle, spot *at)
{
    for (const rf_ball_wave *one = balls->waves; one != balls->waves + balls->wave_count; ++one) {
        const double along = one->lobes * (angle - one->turns * balls->shaft) + one->phase;
        const double height[2] = {one->axial, one->radial};
        for (int i = 0; i < 2; ++i) {
            const double slope = -one->lobes * height[i] * sin(along);
            at->a[i] += height[i] * cos(along);
            at->by_cage[i] += slope;
            at->by_shaft[i] -= one->turns * slope;
        }
    }
}

/* Add what one ball does: the force moves with the center of curvature. */
static void add(const rf_ball *ball, const spot *at, double *wrench, double *by)
{
    for (int i = 0; i < N; ++i) {
        const double axial = at->move[i], radial = at->move[N + i];
        wrench[i] += axial * ball->force[0] + radial * ball->force[1];
        if (!by)
            continue;
        double *own = by + RF_BALL_SLOPES * i;
        const double a = axial * ball->by_place[0] + radial * ball->by_place[2];
        const double r = axial * ball->by_place[1] + radial * ball->by_place[3];
        for (int j = 0; j < N; ++j)
            own[j] += a * at->move[j] + r * at->move[N + j];
        own[N] += axial * ball->by_speed[0] + radial * ball->by_speed[1];
        own[N + 1] += a * at->by_cage[0] + r * at->by_cage[1];
        own[N + 1] += at->turned[i] * ball->force[0] + at->turned[N + i] * ball->force[1];
        own[N + 2] += a * at->by_shaft[0] + r * at->by_shaft[1];
    }
}

int rf_balls_at(const rf_balls *balls, const double *motion, double speed, double *wrench, double *by, rf_ball *each)
{
    int worst = RF_OK;
    double sum = speed + balls->cage + balls->shaft;
    memset(wrench, 0, N * sizeof *wrench);
    if (by)
        memset(by, 0, N * RF_BALL_SLOPES * sizeof *by);
    for (int k = 0; k < N; ++k)
        sum += motion[k];
    if (!isfinite(sum))
        return RF_NOT_FINITE;
    for (const rf_ball_row *row = balls->rows; row != balls->rows + balls->count; ++row)
        for (int k = 0; k < (int)row->count; ++k) {
            const double angle = row->turn + balls->cage + TURN * k / row->count;
            spot at;
            rf_ball ball;
            place(balls, row, motion, angle, &at);
            wave(balls, angle, &at);
            const int status = rf_ball_at(row, &balls->law, at.a, speed, &ball);
            worst = status > worst ? status : worst;
            add(&ball, &at, wrench, by);
            if (each)
                *each++ = ball;
        }
    return worst;
}
