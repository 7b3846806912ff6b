#include <math.h>

#include "balls.h"

#define N RF_BALL_DEGREES
#define MOST_STEPS 200
#define NEAR 1e-9      /* step over the distance of the groove centers after which one more is exact */
#define FIRST_WAY 0.02 /* largest first step over that distance */

/* Find z: the axial force falls with it. Newton's method between bounds, and longer steps where nothing touches. */
static int rest_axially(const rf_balls *balls, double thrust, double speed, double *motion, double *wrench, double *by)
{
    const double unit = balls->rows->inner + balls->rows->outer;
    double low = -HUGE_VAL, high = HUGE_VAL, reach = FIRST_WAY * unit;
    for (int k = 0, last = 0; k < MOST_STEPS; ++k) {
        const int status = rf_balls_at(balls, motion, speed, wrench, by, NULL);
        const double rest = wrench[2] + thrust, slope = by[2 * RF_BALL_SLOPES + 2];
        if (status > RF_OUTSIDE || last || rest == 0.0)
            return status;
        *(rest > 0.0 ? &low : &high) = motion[2];
        double step = -rest / slope;
        last = slope < 0.0 && fabs(step) <= NEAR * unit;
        if (!(slope < 0.0 && fabs(step) <= reach)) {
            step = copysign(reach, rest);
            reach *= 2.0;
        }
        /* The last step, which may be lost in roundoff, needs no bounds, one of which may still be infinite. */
        const double next = motion[2] + step;
        motion[2] = last || (next > low && next < high) ? next : 0.5 * (low + high);
    }
    return RF_STUCK;
}

int rf_ball_journal_at(const rf_ball_journal *journal, const double *state, double *f, double *jacobian, double *z)
{
    const double *fixed = journal->place;
    double motion[N] = {state[0], state[1], fixed[0], fixed[1], fixed[2]}, wrench[N], by[N * RF_BALL_SLOPES];
    const int status = journal->is_free
                           ? rest_axially(&journal->balls, journal->thrust, state[4], motion, wrench, by)
                           : rf_balls_at(&journal->balls, motion, state[4], wrench, by, NULL);
    if (z)
        *z = motion[2];
    const double *along = by + 2 * RF_BALL_SLOPES;
    for (int i = 0; i < 2; ++i) {
        f[i] = wrench[i] - journal->damping * state[2 + i];
        const double *own = by + i * RF_BALL_SLOPES;
        const double yields = jacobian && journal->is_free && along[2] != 0.0 ? own[2] / along[2] : 0.0;
        for (int j = 0; jacobian && j < 2; ++j) {
            jacobian[5 * i + j] = own[j] - yields * along[j];
            jacobian[5 * i + 2 + j] = i == j ? -journal->damping : 0.0;
        }
        if (jacobian)
            jacobian[5 * i + 4] = own[N] - yields * along[N];
    }
    return isfinite(f[0] + f[1]) ? status : RF_NOT_FINITE;
}
