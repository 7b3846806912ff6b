#include "static_place.h"

#include <math.h>
#include <string.h>

#include "../films/map_frame.h"

#define PI 3.14159265358979323846
#define LARGEST_S log(0.9999 / (1.0 - 0.9999)) /* a heavier load counts as more than the film can carry */
#define MOST_LEFT 1e-6 /* imbalance beyond which no place counts, whatever roundoff leaves */
#define TOLERANCE 1e-12
#define ROUNDOFF_STOP 1e-13
#define ROUNDOFF 1e-15 /* of a place, in clearances */
#define LARGEST_LOG 300.0
#define STEPS 60
#define NEUTRAL_SLOPE 1e-6
#define NEUTRAL 1e-11
#define MOST_S 6.0
#define MOST_PHI 1.0
#define HALVINGS 26 /* the load of a tilting pad begins as the root of the way: steps beyond its edge are too long */
#define STARTS 14
#define ALONG 0.1   /* angle to the load [rad], and */
#define FEEBLE -0.1  /* logarithm of the share of the load, of a force at the wall that shows that none will do */

static double size_of(const double *v)
{
    return hypot(v[0], v[1]);
}

/* |force - wanted| / |wanted| from the logarithm, so that small ones keep their digits, and what roundoff leaves. */
static void judge(const rf_static_target *target, rf_static_point *p)
{
    const double ratio = fmin(p->ratio, LARGEST_LOG), wanted = size_of(target->force);
    const double gap = exp(ratio) * (1.0 + exp(p->s));
    double steepest = 0.0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            steepest = fmax(steepest, fabs(p->slopes[5 * i + j]));
    p->imbalance = hypot(expm1(ratio), 2.0 * exp(0.5 * ratio) * sin(0.5 * p->angle));
    p->unavoidable = ROUNDOFF * fmax(gap, target->clearance * steepest / wanted) + target->noise / wanted;
    const double a = p->slopes[0], d = p->slopes[6], turn = 0.25 * (a - d) * (a - d) + p->slopes[1] * p->slopes[5];
    p->unstable = turn >= 0.0 && 0.5 * (a + d) + sqrt(turn) > NEUTRAL_SLOPE * steepest;
    p->found = p->imbalance <= fmin(fmax(TOLERANCE, p->unavoidable), MOST_LEFT);
}

int rf_static_trial(const rf_static_target *target, double s, double phi, int32_t steps, rf_static_point *p)
{
    const double distance = target->clearance / (1.0 + exp(-s)), x = distance * cos(phi), y = distance * sin(phi);
    const double state[5] = {x, y, 0.0, 0.0, target->speed}, *wanted = target->force;
    memset(p, 0, sizeof *p);
    p->s = s;
    p->phi = phi;
    p->steps = steps;
    p->position[0] = x;
    p->position[1] = y;
    p->ratio = p->norm = p->imbalance = p->unavoidable = HUGE_VAL;
    p->status = target->film(target->of, state, p->force, p->slopes);
    if (p->status > RF_OUTSIDE)
        return p->status == RF_UNDEFINED || p->status == RF_AT_WALL || p->status == RF_STUCK ? RF_OK : p->status;
    const double *f = p->force, *D = p->slopes, size = size_of(f), gap = 1.0 / (1.0 + exp(s));
    if (!(size > 0.0 && size < HUGE_VAL))
        return RF_OK;
    /* d(position)/ds = (1 - chi) position, d(position)/dphi = position turned by 90 degrees. */
    const double x_s = gap * (D[0] * x + D[1] * y), y_s = gap * (D[5] * x + D[6] * y);
    const double x_phi = D[1] * x - D[0] * y, y_phi = D[6] * x - D[5] * y, ux = f[0] / size, uy = f[1] / size;
    p->ratio = log(size / size_of(wanted));
    p->angle = atan2(wanted[0] * uy - wanted[1] * ux, wanted[0] * ux + wanted[1] * uy);
    p->norm = hypot(p->ratio, p->angle);
    p->matrix[0] = (ux * x_s + uy * y_s) / size;
    p->matrix[1] = (ux * x_phi + uy * y_phi) / size;
    p->matrix[2] = (ux * y_s - uy * x_s) / size;
    p->matrix[3] = (ux * y_phi - uy * x_phi) / size;
    judge(target, p);
    return RF_OK;
}

/* Take the first of ever shorter steps that lowers the residual; *taken says whether there is one. */
static int damped(const rf_static_target *target, double by_s, double by_phi, rf_static_point *p, int *taken)
{
    const double share = fmin(1.0, fmin(MOST_S / fmax(fabs(by_s), 1e-300), MOST_PHI / fmax(fabs(by_phi), 1e-300)));
    double part = share;
    *taken = 0;
    for (int k = 0; k < HALVINGS && !*taken; ++k, part *= 0.5) {
        rf_static_point trial;
        const double s = fmin(p->s + part * by_s, LARGEST_S);
        const int status = rf_static_trial(target, s, p->phi + part * by_phi, p->steps + 1, &trial);
        if (status)
            return *p = trial, status;
        if (trial.norm < p->norm) {
            *p = trial;
            *taken = 1;
        }
    }
    return RF_OK;
}

int rf_static_newton(const rf_static_target *target, double s, double phi, int32_t most, rf_static_point *p)
{
    int taken = 1, status = rf_static_trial(target, s, phi, 0, p);
    while (!status && taken && p->steps < most && p->norm > ROUNDOFF_STOP && p->norm < HUGE_VAL) {
        const double a = p->matrix[0], b = p->matrix[1], c = p->matrix[2], d = p->matrix[3];
        const double all = a * a + b * b + c * c + d * d, size = all > 0.0 ? all : 1.0;
        double det = a * d - b * c, by_s = b * p->angle - d * p->ratio, by_phi = c * p->ratio - a * p->angle;
        if (fabs(det) < NEUTRAL * size) { /* nothing holds the journal in one direction: the shortest step */
            det = -size;
            by_s = a * p->ratio + c * p->angle;
            by_phi = b * p->ratio + d * p->angle;
        }
        status = damped(target, by_s / det, by_phi / det, p, &taken);
    }
    return status;
}

/* Where the search starts, number k of STARTS: where the film says, half of the way to the wall in the direction in
   which most films carry, and all round. */
static int start_at(const rf_static_target *target, int k, double *s, double *phi)
{
    const double along = atan2(-target->force[1], -target->force[0]);
    const double half = log(target->relative_clearance / (2.0 - target->relative_clearance));
    if (k == 0) {
        const double way = size_of(target->near) / target->clearance, chi = way > 0.0 ? way : 1e-300;
        *s = chi < 0.9999 ? log(chi / (1.0 - chi)) : LARGEST_S;
        *phi = atan2(target->near[1], target->near[0]);
        return !rf_is_broken(target->near, 2);
    }
    *s = k == 1 ? half : half + (k < 8 ? -2.0 : 2.0);
    *phi = along + (k == 1 ? target->lead : (k - 2) % 6 * (PI / 3.0));
    return 1;
}

static int search(const rf_static_target *target, rf_static_point *best)
{
    rf_static_point tried;
    int first = 1;
    for (int k = 0; k < STARTS; ++k) {
        double s, phi;
        if (!start_at(target, k, &s, &phi))
            continue;
        const int status = rf_static_newton(target, s, phi, STEPS, &tried);
        if (first || status || tried.found || tried.norm < best->norm)
            *best = tried;
        const int spent = tried.s >= LARGEST_S && tried.ratio < FEEBLE && fabs(tried.angle) < ALONG;
        if (spent && !best->found)
            *best = tried;
        if (status || best->found || spent)
            return status;
        first = 0;
    }
    return RF_OK;
}

int rf_static_places(const rf_static_target *targets, int64_t n, rf_static_point *points)
{
    int worst = RF_OK;
    for (int64_t i = 0; i < n; ++i) {
        const int status = search(targets + i, points + i);
        worst = status > worst ? status : worst;
    }
    return worst;
}
