#include "tilting_pad.h"

#include <math.h>

#include "../films/map_frame.h"

#define FREE 8       /* steps of Newton's method before those that do not halve what is left are replaced */
#define HALVINGS 200
#define SCAN 32
#define TIP 0.995 /* of the way to trailing contact: where the scan for the tilt begins */
#define ROUNDOFF 1e-13

void rf_set_tilting_pad(rf_tilting_pad *pad, rf_film film, const void *data, double extent, double offset)
{
    const double back = offset * extent;
    pad->film = film;
    pad->data = data;
    pad->turn[0] = cos(back - 0.5 * extent);
    pad->turn[1] = sin(back - 0.5 * extent);
    pad->lead[0] = cos(back);
    pad->lead[1] = sin(back);
    pad->trail[0] = cos(extent - back);
    pad->trail[1] = sin(extent - back);
    for (int k = 0; k < RF_PAD_NODES; ++k) {
        const double angle = (k + 0.5) / RF_PAD_NODES * extent - back;
        pad->node[k][0] = cos(angle);
        pad->node[k][1] = sin(angle);
    }
}

double rf_pad_least(const rf_tilting_pad *pad, const double *e)
{
    const double *a = pad->lead, *b = pad->trail;
    /* Both turns are positive where e points to the arc, which is less than half a circle. */
    if (a[0] * e[1] + a[1] * e[0] >= 0.0 && b[1] * e[0] - b[0] * e[1] >= 0.0)
        return 1.0 - rf_length(e[0], e[1]);
    return fmin(1.0 - a[0] * e[0] + a[1] * e[1], 1.0 - b[0] * e[0] - b[1] * e[1]);
}

/* Whether w.n <= 0 on the whole arc: then there is no film. */
static int is_idle(const rf_tilting_pad *pad, const double *w)
{
    return pad->lead[0] * w[0] - pad->lead[1] * w[1] <= 0.0 && pad->trail[0] * w[0] + pad->trail[1] * w[1] <= 0.0;
}

/* From (n, t) of the pivot to the frame of the middle, or back for sense -1. */
static void turned(const double *turn, double sense, const double *from, double *to)
{
    to[0] = turn[0] * from[0] - sense * turn[1] * from[1];
    to[1] = sense * turn[1] * from[0] + turn[0] * from[1];
}

int rf_pivoted_film(const rf_tilting_pad *pad, const double *e, const double *w, double *f, double *jacobian)
{
    double place[2], source[3] = {0.0, 0.0, w[2]}, force[2], by[10] = {0.0};
    if (rf_is_broken(e, 2) || rf_is_broken(w, 2))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 8);
    if (!(rf_pad_least(pad, e) > 0.0))
        return rf_fail(RF_AT_WALL, f, jacobian, 8);
    if (w[0] == 0.0 && w[1] == 0.0)
        return rf_rest(f, jacobian);
    if (is_idle(pad, w)) {
        f[0] = f[1] = 0.0;
        for (int k = 0; jacobian && k < 10; ++k)
            jacobian[k] = 0.0;
        return RF_OK;
    }
    turned(pad->turn, 1.0, e, place);
    turned(pad->turn, 1.0, w, source);
    const int status = pad->film(pad->data, place, source, force, jacobian ? by : NULL);
    turned(pad->turn, -1.0, force, f);
    if (jacobian)
        turned(pad->turn, -1.0, by + 8, jacobian + 8);
    for (int block = 0; jacobian && block < 4; block += 2) {
        double rows[2][2];
        for (int i = 0; i < 2; ++i)
            turned(pad->turn, -1.0, by + 4 * i + block, rows[i]);
        for (int j = 0; j < 2; ++j) {
            const double column[2] = {rows[0][j], rows[1][j]};
            double back[2];
            turned(pad->turn, -1.0, column, back);
            jacobian[block + j] = back[0];
            jacobian[4 + block + j] = back[1];
        }
    }
    return status;
}

/* The w_t of a film so narrow that its pressure is the source over H^3. */
static double narrow_follow(const rf_tilting_pad *pad, const double *e, double w_n)
{
    double w_t = 0.0;
    for (int round = 0; round < 2; ++round) {
        double mixed = 0.0, square = 0.0;
        for (int k = 0; k < RF_PAD_NODES; ++k) {
            const double *n = pad->node[k];
            const double H = 1.0 - e[0] * n[0] - e[1] * n[1], source = w_n * n[0] + w_t * n[1];
            if (round && source <= 0.0)
                continue;
            mixed += n[0] * n[1] / (H * H * H);
            square += n[1] * n[1] / (H * H * H);
        }
        if (square > 0.0)
            w_t = -w_n * mixed / square;
    }
    return w_t;
}

int rf_pad_follow(const rf_tilting_pad *pad, const double *e, const double *near, double *w, double *f, double *jacobian)
{
    double low = -HUGE_VAL, high = HUGE_VAL, by[10] = {0.0};
    if (!(rf_pad_least(pad, e) > 0.0))
        return rf_fail(RF_AT_WALL, f, jacobian, 8);
    if (near) {
        w[1] = *near;
        const int status = rf_pivoted_film(pad, e, w, f, jacobian);
        const double step = -f[1] / jacobian[7];
        if (status <= RF_OUTSIDE && fabs(step) <= RF_PAD_NEAR * (fabs(w[1]) + w[0])) {
            w[1] += step;
            f[0] += jacobian[3] * step;
            f[1] = 0.0;
            return status;
        }
    }
    w[1] = narrow_follow(pad, e, w[0]);
    for (int step = 0; step < HALVINGS; ++step) {
        const double width = high - low;
        const int status = rf_pivoted_film(pad, e, w, f, by);
        if (status > RF_OUTSIDE)
            return rf_fail(status, f, jacobian, 8);
        /* The moment falls with w_t all along. */
        *(f[1] > 0.0 ? &low : &high) = w[1];
        double next = w[1] - f[1] / by[7];
        const double tolerance = ROUNDOFF * (fabs(w[1]) + w[0]);
        const int bounded = isfinite(low) && isfinite(high);
        const int slow = bounded && step >= FREE && high - low > 0.5 * width && !(fabs(next - w[1]) <= tolerance);
        if (slow || !(next >= low && next <= high))
            next = bounded ? 0.5 * (low + high) : w[1] + copysign(w[0] + fabs(w[1]), f[1]);
        if (f[1] == 0.0 || fabs(next - w[1]) <= tolerance) {
            for (int k = 0; jacobian && k < 10; ++k)
                jacobian[k] = by[k];
            f[1] = 0.0;
            return status;
        }
        w[1] = next;
    }
    return rf_fail(RF_STUCK, f, jacobian, 8);
}

double rf_pad_idle(const rf_tilting_pad *pad, double w_n, double wanted)
{
    return fmin(fmax(wanted, w_n * pad->lead[0] / pad->lead[1]), -w_n * pad->trail[0] / pad->trail[1]);
}

/* How far eta may go towards an end before something touches. */
static double wall(const double *end, double xi)
{
    return xi > end[0] ? sqrt(1.0 - xi * xi) : (1.0 - xi * end[0]) / end[1];
}

/* Force of a pad that stands still, over the speed, and derivatives by (xi, eta), by[2][2], and behind these by the
   rate. */
static int standing(const rf_tilting_pad *pad, double xi, double eta, double speed, double *f, double *by)
{
    const double half = speed < 0.0 ? -0.5 : 0.5, e[2] = {xi, eta}, w[3] = {half * eta, -half * xi, 0.5 * speed};
    double J[10] = {0.0};
    const int status = rf_pivoted_film(pad, e, w, f, by ? J : NULL);
    for (int i = 0; by && i < 2; ++i) {
        by[2 * i] = J[4 * i] - half * J[4 * i + 3];
        by[2 * i + 1] = J[4 * i + 1] + half * J[4 * i + 2];
        by[4 + i] = J[8 + i];
    }
    return status;
}

/* The root of the moment between two tilts, along a = sense * eta, where it is positive at low and negative at high.
   Newton's method, halving where that leaves more than half of what was left: at the edge of a film the moment falls as
   a fifth power, and Newton's steps would end before the root. */
static int refine(const rf_tilting_pad *pad, double xi, double speed, double low, double high, rf_pad_rest *rest)
{
    double f[2], by[6], a = 0.5 * (low + high);
    const double sense = speed < 0.0 ? -1.0 : 1.0;
    for (int step = 0; step < HALVINGS; ++step) {
        const int status = standing(pad, xi, sense * a, speed, f, by);
        if (status > RF_OUTSIDE)
            return status;
        const double moment = sense * f[1], width = high - low;
        *(moment > 0.0 ? &low : &high) = a;
        double next = a - moment / by[3];
        const int near = fabs(next - a) <= ROUNDOFF * (1.0 + fabs(a));
        if (!(next >= low && next <= high) || (!near && step >= FREE && high - low > 0.5 * width))
            next = 0.5 * (low + high);
        if (moment == 0.0 || fabs(next - a) <= ROUNDOFF * (1.0 + fabs(a))) {
            rest->eta = sense * a;
            rest->force = f[0];
            rest->slope = by[0] - by[1] * by[2] / by[3];
            rest->by_rate = by[4] - by[1] * by[5] / by[3];
            return status;
        }
        a = next;
    }
    return RF_STUCK;
}

/* Scan down from *above to *below for the first positive moment: 1, and between both it turns its sign. Otherwise 0, and
   between both it is largest. */
static int scan(const rf_tilting_pad *pad, double xi, double speed, double *below, double *above, int *status)
{
    const double sense = speed < 0.0 ? -1.0 : 1.0;
    const double high = *above, step = (high - *below) / SCAN;
    double best = -HUGE_VAL, f[2];
    int at = 1, found = 0;
    for (int k = 0; k < SCAN && !found; ++k) {
        *status = standing(pad, xi, sense * (high - k * step), speed, f, NULL);
        const double moment = sense * f[1];
        if (*status > RF_OUTSIDE || (k == 0 && moment > 0.0)) {
            *status = k == 0 && *status <= RF_OUTSIDE ? RF_AT_WALL : *status;
            return 0;
        }
        found = moment > 0.0;
        if (found || (moment > best && moment < 0.0 && k)) {
            best = moment;
            at = k;
        }
    }
    *above = high - (at - 1) * step;
    *below = high - (found ? at : at + 1) * step;
    return found;
}

/* A pad whose pivot is not nearer than the center of its arc: it may be without film. */
static int find_light(const rf_tilting_pad *pad, double xi, double speed, const double *trail, const double *lead,
                      rf_pad_rest *rest)
{
    const double lowest = -TIP * wall(lead, xi), end = trail[0] > 0.0 ? xi * trail[1] / trail[0] : 2.0 * lowest;
    double below = fmax(end, lowest), above = TIP * wall(trail, xi);
    int status = RF_OK, found = 0;
    for (int round = 0; round < 2 && !found && status <= RF_OUTSIDE; ++round)
        found = scan(pad, xi, speed, &below, &above, &status);
    if (found)
        return refine(pad, xi, speed, below, above, rest);
    rest->unloaded = 1;
    rest->eta = speed < 0.0 ? -end : end;
    if (status > RF_OUTSIDE)
        return status;
    return end < lowest ? RF_AT_WALL : RF_OK; /* without film it is beyond no map */
}

int rf_find_pad_rest(const rf_tilting_pad *pad, double xi, double speed, rf_pad_rest *rest)
{
    const int backward = speed < 0.0;
    const double *trail = backward ? pad->lead : pad->trail, *lead = backward ? pad->trail : pad->lead;
    const rf_pad_rest none = {0.0, 0.0, 0.0, 0.0, 0};
    *rest = none;
    if (!(xi < 1.0))
        return xi >= 1.0 ? RF_AT_WALL : RF_NOT_FINITE;
    if (xi <= 0.0)
        return find_light(pad, xi, speed, trail, lead, rest);
    /* The source at the pivot presses the leading half: without tilt the moment is positive. */
    const double highest = TIP * wall(trail, xi);
    double below = 0.0, above = highest;
    int status;
    if (!scan(pad, xi, speed, &below, &above, &status)) {
        below = 0.0;
        above = highest / SCAN;
    }
    return status <= RF_OUTSIDE ? refine(pad, xi, speed, below, above, rest) : status;
}
