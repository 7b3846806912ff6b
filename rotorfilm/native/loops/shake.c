#include "shake.h"

#include <math.h>

#include "journals.h"

#define NEWTON_STEPS 20
#define TOLERANCE 1e-10     /* last Newton step, in clearances */
#define NEAR 0.9999         /* eccentricity ratio from which Newton's method that does not end was led to the wall */
#define SMALLEST_SHARE 1e-6 /* of a Newton step */

/* Position, velocity and acceleration. */
typedef struct point {
    double q[2], v[2], a[2];
} point;

/* Let velocity and acceleration at the end of a step follow from the position there. */
static void set_rates(const rf_shaken *rotor, const point *from, point *to)
{
    const double dt = rotor->step;
    for (int i = 0; i < 2; ++i) {
        const double moved = to->q[i] - from->q[i];
        to->v[i] = 2.0 / dt * moved - from->v[i];
        to->a[i] = 4.0 / (dt * dt) * (moved - dt * from->v[i]) - from->a[i];
    }
}

/* A film that is not inside of a circle says itself where it is touched: half of the way back to where it was not. */
static void turn_back(const double *free, point *to, double *change)
{
    *change = HUGE_VAL;
    for (int i = 0; i < 2; ++i)
        to->q[i] = 0.5 * (free[i] + to->q[i]);
}

/* The mass xx, xy, yy of rotor and oil; unless NULL the slopes of that of the oil, else zeros. */
static int whole_mass(const rf_shaken *rotor, const double *state, double *mass, double *slopes)
{
    int status = RF_OK;
    for (int i = 0; i < 3; ++i)
        mass[i] = 0.0;
    for (int i = 0; slopes && i < 12; ++i)
        slopes[i] = 0.0;
    if (rotor->heavy)
        status = rotor->heavy(rotor->loaded, state, mass, slopes);
    mass[0] += rotor->mass;
    mass[2] += rotor->mass;
    return status;
}

/* Newton's step at the end of a time step, less the part of it that would leave less than a tenth of the gap;
   its length before that in *change. Where the last one led onto a pad it is cut, `free` is where it began. */
static int correct(rf_shaken *rotor, const point *from, const double *pull, double *free, point *to, double *change)
{
    const double dt = rotor->step, k1 = 2.0 / dt, k2 = 4.0 / (dt * dt);
    double f[2], D[10], mass[3], slopes[12];
    set_rates(rotor, from, to);
    const double state[5] = {to->q[0], to->q[1], to->v[0], to->v[1], rotor->speed};
    int status = rotor->film(rotor->of, state, f, D);
    if (status <= RF_OUTSIDE) {
        const int of_mass = whole_mass(rotor, state, mass, slopes);
        status = of_mass > status ? of_mass : status;
    }
    rotor->calls += 1;
    if (status == RF_AT_WALL)
        turn_back(free, to, change);
    if (status > RF_OUTSIDE)
        return status;
    free[0] = to->q[0];
    free[1] = to->q[1];
    rotor->left_map |= status == RF_OUTSIDE;
    rf_add_inertia(mass, slopes, to->a, 5, f, D);
    const double rx = f[0] + pull[0], ry = f[1] + pull[1];
    const double a = mass[0] * k2 - D[0] - k1 * D[2], b = mass[1] * k2 - D[1] - k1 * D[3];
    const double c = mass[1] * k2 - D[5] - k1 * D[7], d = mass[2] * k2 - D[6] - k1 * D[8], det = a * d - b * c;
    const double dx = (d * rx - b * ry) / det, dy = (a * ry - c * rx) / det;
    const double gap = rotor->clearance - hypot(to->q[0], to->q[1]), limit = rotor->clearance - 0.1 * gap;
    double share = 1.0;
    while (hypot(to->q[0] + share * dx, to->q[1] + share * dy) > limit) {
        share *= 0.5;
        if (share < SMALLEST_SHARE)
            return RF_AT_WALL;
    }
    to->q[0] += share * dx;
    to->q[1] += share * dy;
    *change = fabs(dx) + fabs(dy);
    return isfinite(*change) ? RF_OK : RF_NOT_FINITE;
}

static int step(rf_shaken *rotor, const point *from, const double *pull, point *to)
{
    const double dt = rotor->step;
    /* With its acceleration, since a cavitated film has no derivative at rest. */
    for (int i = 0; i < 2; ++i)
        to->q[i] = from->q[i] + dt * (from->v[i] + 0.5 * dt * from->a[i]);
    if (hypot(to->q[0], to->q[1]) > 0.5 * (rotor->clearance + hypot(from->q[0], from->q[1])))
        for (int i = 0; i < 2; ++i)
            to->q[i] = from->q[i];
    double free[2] = {from->q[0], from->q[1]};
    int touched = 0;
    for (int n = 0; n < NEWTON_STEPS; ++n) {
        double change = 0.0;
        const int status = correct(rotor, from, pull, free, to, &change);
        if (status == RF_AT_WALL && isinf(change)) {
            touched = 1;
            continue;
        }
        if (status != RF_OK)
            return status;
        if (change < TOLERANCE * rotor->clearance) {
            set_rates(rotor, from, to);
            return RF_OK;
        }
    }
    return touched || hypot(to->q[0], to->q[1]) > NEAR * rotor->clearance ? RF_AT_WALL : RF_STUCK;
}

int rf_follow_shaken(rf_shaken *rotor, int64_t count, const double *pulls, double *motion)
{
    double mass[3];
    const int start = whole_mass(rotor, motion, mass, NULL);
    if (start > RF_OUTSIDE)
        return start;
    const double det = mass[0] * mass[2] - mass[1] * mass[1];
    point now = {{motion[0], motion[1]},
                 {motion[2], motion[3]},
                 {(mass[2] * pulls[0] - mass[1] * pulls[1]) / det, (mass[0] * pulls[1] - mass[1] * pulls[0]) / det}};
    for (int64_t n = 1; n <= count; ++n) {
        point next;
        const int status = step(rotor, &now, pulls + 2 * n, &next);
        if (status != RF_OK)
            return status;
        rotor->done = n;
        now = next;
        for (int i = 0; i < 2; ++i) {
            motion[4 * n + i] = now.q[i];
            motion[4 * n + 2 + i] = now.v[i];
        }
    }
    return RF_OK;
}
