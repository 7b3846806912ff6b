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
#define LAST_SPRING 1e-12
#define MOST_LEFT 0.9      /* of the force along a way, where it was shortened */
#define MOST_OVERSHOOT 0.5 /* force back, over that along the way at its beginning */

/* The load of a search, and what motions count for: tilts as the way of the inner groove, held degrees not at all. */
typedef struct search {
    const rf_balls *balls;
    const double *load;
    double speed, scale[N];
    int32_t steps;
} search;

/* A trial motion: wrench + load, scaled, its derivatives, and the size of the residual. */
typedef struct trial {
    double motion[N], by[N * RF_BALL_SLOPES], rest[N], size;
    int status;
} trial;

static void try_motion(search *self, trial *at)
{
    double wrench[N];
    ++self->steps;
    at->status = rf_balls_at(self->balls, at->motion, self->speed, wrench, at->by, NULL);
    at->size = 0.0;
    for (int k = 0; k < N; ++k) {
        at->rest[k] = self->scale[k] * (wrench[k] + self->load[k]);
        at->size += at->rest[k] * at->rest[k];
    }
    at->size = at->status > RF_OUTSIDE ? HUGE_VAL : sqrt(at->size);
}

/* The way of Newton's method, as if the shaft hung on springs besides. */
static void aim(const search *self, const trial *from, double spring, double *way)
{
    double q[N * N];
    memcpy(way, from->rest, sizeof from->rest);
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j)
            q[N * i + j] = -self->scale[i] * from->by[RF_BALL_SLOPES * i + j] * self->scale[j] + (i == j ? spring : 0.0);
    rf_eliminate(N, q, 1, way);
}

/* Force along a way; where a ball finds no balance, as if the way had gone too far. */
static double along(const trial *at, const double *way)
{
    double sum = 0.0;
    for (int k = 0; k < N; ++k)
        sum += at->rest[k] * way[k];
    return at->status > RF_OUTSIDE ? -HUGE_VAL : sum;
}

/* Go along a way, or the part of it after which the force along it is about gone: the energy is convex, and that force
   only falls. The part, 0 if there is none. */
static double go(search *self, const trial *from, const double *way, trial *to)
{
    const double full = along(from, way);
    double low = 0.0, high = 1.0, part = 1.0;
    while (self->steps < MOST_STEPS) {
        for (int k = 0; k < N; ++k)
            to->motion[k] = from->motion[k] + part * self->scale[k] * way[k];
        if (memcmp(to->motion, from->motion, sizeof to->motion) == 0)
            break;
        try_motion(self, to);
        const double left = along(to, way);
        if (left >= -MOST_OVERSHOOT * full && (part == 1.0 || left <= MOST_LEFT * full))
            return part;
        *(left < 0.0 ? &high : &low) = part;
        part = 0.5 * (low + high);
    }
    return 0.0;
}

/* The stiffness of a bearing whose balls are pressed by a thousandth of the distance from the grooves. */
static double typical(const rf_balls *balls)
{
    const rf_ball_row *row = balls->rows;
    return row->count * row->inner_stiffness * sqrt(1e-3 * row->inner);
}

/* A residual that roundoff of the places leaves. */
static double noise(const search *self, const trial *at)
{
    double stiffest = 0.0;
    for (int k = 0; k < N; ++k)
        stiffest = fmax(stiffest, -at->by[(RF_BALL_SLOPES + 1) * k] * pow(self->scale[k], 2.0));
    return ROUNDOFF * (self->balls->rows->inner + self->balls->rows->outer) * stiffest;
}

static void settle(search *self, double whole, trial *now)
{
    const double unit = typical(self->balls);
    double share = FIRST_SPRING, way[N];
    try_motion(self, now);
    while (self->steps < MOST_STEPS && now->size > EXACT * whole + noise(self, now)) {
        trial next;
        aim(self, now, unit * share, way);
        const double part = go(self, now, way, &next);
        const int is_enough = now->size <= ENOUGH * whole + noise(self, now);
        if (part == 0.0 || (is_enough && next.size >= now->size))
            return;
        *now = next;
        if (part == 1.0)
            share = fmax(fmin(0.1 * share, whole > 0.0 ? now->size / whole : 1.0), LAST_SPRING);
    }
}

int rf_balls_rest(const rf_balls *balls, const double *load, double speed, const int32_t *held, double *motion, double *by,
                  int32_t *steps)
{
    search self = {.balls = balls, .load = load, .speed = speed};
    double whole = 0.0;
    trial now;
    for (int k = 0; k < N; ++k) {
        self.scale[k] = held && held[k] ? 0.0 : k < 3 ? 1.0 : 1.0 / balls->rows->arm;
        whole += pow(self.scale[k] * load[k], 2.0);
    }
    whole = sqrt(whole);
    memcpy(now.motion, motion, sizeof now.motion);
    settle(&self, whole, &now);
    memcpy(motion, now.motion, sizeof now.motion);
    memcpy(by, now.by, sizeof now.by);
    *steps = self.steps;
    return now.size <= ENOUGH * whole + 1e3 * noise(&self, &now) ? now.status : now.status > RF_OUTSIDE ? now.status : RF_STUCK;
}
