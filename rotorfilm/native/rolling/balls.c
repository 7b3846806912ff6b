#include "balls.h"

#include <math.h>
#include <string.h>

#define N RF_BALL_DEGREES
#define TURN 6.28318530717958647692

/* The distance a of the centers of curvature at a ball and, row by row, its derivatives by the motion: they are linear. */
static void place(const rf_balls *balls, const rf_ball_row *row, const double *motion, double angle, double *a, double *by)
{
    const double c = cos(angle), s = sin(angle), side = row->direction;
    const double axial[N] = {0.0, 0.0, side, side * row->arm * s, -side * row->arm * c};
    const double radial[N] = {c, s, 0.0, -row->place * s, row->place * c};
    a[0] = row->axial;
    a[1] = row->radial + balls->growth;
    for (int k = 0; k < N; ++k) {
        a[0] += axial[k] * motion[k];
        a[1] += radial[k] * motion[k];
        by[k] = axial[k];
        by[N + k] = radial[k];
    }
}

/* Add what one ball does: the force moves with the center of curvature. */
static void add(const rf_ball *ball, const double *move, double *wrench, double *by)
{
    for (int i = 0; i < N; ++i) {
        const double axial = move[i], radial = move[N + i];
        wrench[i] += axial * ball->force[0] + radial * ball->force[1];
        if (!by)
            continue;
        const double a = axial * ball->by_place[0] + radial * ball->by_place[2];
        const double r = axial * ball->by_place[1] + radial * ball->by_place[3];
        for (int j = 0; j < N; ++j)
            by[(N + 1) * i + j] += a * move[j] + r * move[N + j];
        by[(N + 1) * i + N] += axial * ball->by_speed[0] + radial * ball->by_speed[1];
    }
}

int rf_balls_at(const rf_balls *balls, const double *motion, double speed, double *wrench, double *by, rf_ball *each)
{
    int worst = RF_OK;
    double sum = speed;
    memset(wrench, 0, N * sizeof *wrench);
    if (by)
        memset(by, 0, N * (N + 1) * sizeof *by);
    for (int k = 0; k < N; ++k)
        sum += motion[k];
    if (!isfinite(sum))
        return RF_NOT_FINITE;
    for (const rf_ball_row *row = balls->rows; row != balls->rows + balls->count; ++row)
        for (int k = 0; k < (int)row->count; ++k) {
            double a[2], move[2 * N];
            rf_ball ball;
            place(balls, row, motion, row->turn + TURN * k / row->count, a, move);
            const int status = rf_ball_at(row, balls->inertia, a, speed, &ball);
            worst = status > worst ? status : worst;
            add(&ball, move, wrench, by);
            if (each)
                *each++ = ball;
        }
    return worst;
}
