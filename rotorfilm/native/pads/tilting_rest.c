#include <math.h>

#include "../films/map_frame.h"
#include "tilting.h"

#define MOST 200
#define FREE 8 /* steps of Newton's method before those that do not halve what is left are replaced */
#define ROUNDOFF 1e-14

/* The place of a pivot on a spring that balances the film, xi <= `rigid`, where it would be rigid. */
static int find_sprung(const rf_tilting *b, double rigid, double speed, double *xi, rf_pad_rest *rest)
{
    const double film = b->force_scale * fabs(speed), k = b->spring * b->clearance;
    double low = -HUGE_VAL, high = rigid < 1.0 ? rigid : 1.0, at = rigid < 1.0 ? rigid : fmin(0.9, rigid);
    for (int step = 0; step < MOST; ++step) {
        const int status = rf_find_pad_rest(&b->pad, at, speed, rest);
        if (status > RF_OUTSIDE)
            return status;
        const double excess = film * rest->force - k * (at - rigid), width = high - low;
        *(excess > 0.0 ? &low : &high) = at;
        double next = at - excess / (film * rest->slope - k);
        const int slow = step >= FREE && high - low > 0.5 * width && fabs(next - at) > ROUNDOFF * (1.0 + fabs(at));
        if (!(next >= low && next <= high) || (slow && isfinite(low)))
            next = isfinite(low) ? 0.5 * (low + high) : at - 0.5;
        if (excess == 0.0 || fabs(next - at) <= ROUNDOFF * (1.0 + fabs(at))) {
            *xi = at;
            return status;
        }
        at = next;
    }
    return RF_STUCK;
}

static int rest_one(const rf_tilting *b, const double *n, const double *position, double speed, rf_tilting_rest *out)
{
    const double c = b->clearance, sense = speed < 0.0 ? -1.0 : 1.0, film = b->force_scale * fabs(speed);
    const double along = (n[0] * position[0] + n[1] * position[1]) / c;
    const double across = (n[0] * position[1] - n[1] * position[0]) / c, rigid = along + b->preload;
    const int sprung = b->spring > 0.0;
    rf_pad_rest rest;
    double xi = rigid;
    const int status = sprung ? find_sprung(b, rigid, speed, &xi, &rest)
                              : rf_find_pad_rest(&b->pad, xi, speed, &rest);
    const double e[2] = {xi, rest.eta}, own = -film * rest.slope / c;
    const double share = sprung ? b->spring / (b->spring + own) : 1.0;
    out->tilt = c * (rest.eta - across);
    out->pivot = c * (xi - rigid);
    out->load = 0.0 - film * rest.force;
    out->stiffness = own * share;
    out->by_speed = -(sense * b->force_scale * rest.force + 0.5 * film * rest.by_rate) * share;
    out->least = c * rf_pad_least(&b->pad, e);
    out->unloaded = rest.unloaded;
    return status;
}

int rf_tilting_at_rest(const rf_tilting *bearing, const double *position, double speed, double *force, double *by,
                       rf_tilting_rest *pads, size_t *pad)
{
    int worst = RF_OK;
    force[0] = force[1] = 0.0;
    *pad = 0;
    for (int k = 0; by && k < 10; ++k)
        by[k] = 0.0;
    if (rf_is_broken(position, 2) || rf_is_broken(&speed, 1))
        return RF_NOT_FINITE;
    for (size_t k = 0; k < bearing->count; ++k) {
        const double *n = bearing->pivot + 2 * k;
        rf_tilting_rest rest;
        const int status = rest_one(bearing, n, position, speed, &rest);
        if (pads)
            pads[k] = rest;
        if (status > worst) {
            worst = status;
            *pad = k;
        }
        for (int i = 0; i < 2; ++i) {
            force[i] -= n[i] * rest.load;
            for (int j = 0; by && j < 2; ++j)
                by[5 * i + j] -= n[i] * n[j] * rest.stiffness;
            if (by)
                by[5 * i + 4] -= n[i] * rest.by_speed;
        }
    }
    return worst;
}

int rf_tilting_still(const void *of, const double *state, double *force, double *by)
{
    size_t pad;
    return state[2] || state[3] ? RF_NOT_FINITE : rf_tilting_at_rest(of, state, state[4], force, by, NULL, &pad);
}
