#include <math.h>
#include <string.h>

#include "../solvers/dense.h"
#include "balls.h"

#define N RF_BALL_DEGREES
#define EXACT 1e-13   /* residual over the load at which a search ends */
#define ENOUGH 1e-9   /* that may be left where it does not get smaller */
#define ROUNDOFF 4e-16 /* of a place, over the distance of the centers of curvature */
#define MOST_STEPS 400
#define FIRST_SPRING 1e-2
#define LEAST_SPRING 1e-12
#define STIFFEST 1e6

/* A trial motion: wrench + load, scaled, its derivatives, scaled, and the size of the residual. */
typedef struct trial {
    double motion[N], by[N * RF_BALL_SLOPES], rest[N], size;
    int status;
} trial;

/* Tilts count as the way of the inner groove. */
static double scale(const rf_balls *balls, int k)
{
    return k < 3 ? 1.0 : 1.0 / balls->rows->arm;
}

static void try_motion(const rf_balls *balls, const double *load, double speed, trial *at)
{
    double wrench[N];
    at->status = rf_balls_at(balls, at->motion, speed, wrench, at->by, NULL);
    at->size = 0.0;
    for (int k = 0; k < N; ++k) {
        at->rest[k] = scale(balls, k) * (wrench[k] + load[k]);
        at->size += at->rest[k] * at->rest[k];
    }
    at->size = at->status > RF_OUTSIDE ? HUGE_VAL : sqrt(at->size);
}

/* The motion a step further, as if the shaft hung on springs besides. */
static void step(const rf_balls *balls, const trial *from, double spring, double *motion)
{
    double q[N * N], way[N];
    for (int i = 0; i < N; ++i) {
        way[i] = from->rest[i];
        for (int j = 0; j < N; ++j)
            q[N * i + j] = -scale(balls, i) * from->by[RF_BALL_SLOPES * i + j] * scale(balls, j) + (i == j ? spring : 0.0);
    }
    rf_eliminate(N, q, 1, way);
    for (int k = 0; k < N; ++k)
        motion[k] = from->motion[k] + scale(balls, k) * way[k];
}

/* The stiffness of a bearing whose balls are pressed by a thousandth of the distance from the grooves. */
static double typical(const rf_balls *balls)
{
    const rf_ball_row *row = balls->rows;
    return row->count * row->inner_stiffness * sqrt(1e-3 * row->inner);
}

/* A residual that roundoff of the places leaves. */
static double noise(const rf_balls *balls, const trial *at)
{
    double stiffest = 0.0;
    for (int k = 0; k < N; ++k)
        stiffest = fmax(stiffest, -at->by[(RF_BALL_SLOPES + 1) * k] * pow(scale(balls, k), 2.0));
    return ROUNDOFF * (balls->rows->inner + balls->rows->outer) * stiffest;
}

int rf_balls_rest(const rf_balls *balls, const double *load, double speed, double *motion, double *by, int32_t *steps)
{
    const double unit = typical(balls);
    double share = FIRST_SPRING, whole = 0.0;
    trial now, next;
    for (int k = 0; k < N; ++k)
        whole += pow(scale(balls, k) * load[k], 2.0);
    whole = sqrt(whole);
    memcpy(now.motion, motion, sizeof now.motion);
    try_motion(balls, load, speed, &now);
    for (*steps = 1; *steps < MOST_STEPS && now.size > EXACT * whole + noise(balls, &now) && share < STIFFEST; ++*steps) {
        step(balls, &now, unit * share, next.motion);
        try_motion(balls, load, speed, &next);
        /* Where nothing touches, the residual does not change. */
        if (next.size <= now.size && memcmp(next.motion, now.motion, sizeof now.motion) != 0) {
            now = next;
            share = fmax(fmin(0.1 * share, whole > 0.0 ? now.size / whole : 1.0), LEAST_SPRING);
        } else
            share *= 8.0;
    }
    memcpy(motion, now.motion, sizeof now.motion);
    memcpy(by, now.by, sizeof now.by);
    return now.size <= ENOUGH * whole + 1e3 * noise(balls, &now) ? now.status : now.status > RF_OUTSIDE ? now.status : RF_STUCK;
}
