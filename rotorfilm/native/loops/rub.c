#include "rub.h"

#include <math.h>
#include <string.h>

int rf_rub_at(const void *of, const double *state, double *f, double *jacobian)
{
    const rf_rub *ring = of;
    const double x = state[0] - ring->center[0], y = state[1] - ring->center[1], e = hypot(x, y);
    f[0] = f[1] = 0.0;
    if (jacobian)
        memset(jacobian, 0, 10 * sizeof *jacobian);
    if (!(e > ring->gap))
        return isfinite(e) ? RF_OK : RF_NOT_FINITE;
    const double n[2] = {x / e, y / e}, t[2] = {-y / e, x / e};
    const double sinking = n[0] * state[2] + n[1] * state[3], sliding = t[0] * state[2] + t[1] * state[3];
    const double depth = e - ring->gap, lost = ring->dissipation;
    const double normal = ring->stiffness * depth * (1.0 + lost * sinking);
    if (normal <= 0.0)
        return RF_OK;
    const double slip = sliding + ring->radius * state[4], size = hypot(slip, ring->slip_velocity);
    const double rubbed = ring->friction * slip / size;
    for (int i = 0; i < 2; ++i)
        f[i] = -normal * (n[i] + rubbed * t[i]);
    if (!jacobian)
        return RF_OK;
    const double v = ring->slip_velocity, sharper = ring->friction * v * v / (size * size * size);
    const double by_rate = ring->stiffness * depth * lost;
    const double by_out = ring->stiffness * (1.0 + lost * sinking), by_along = by_rate * sliding / e;
    for (int i = 0; i < 2; ++i) {
        const double push = n[i] + rubbed * t[i];
        const double turned = normal / e * (t[i] - rubbed * n[i] - sharper * sinking * t[i]);
        for (int j = 0; j < 2; ++j) {
            jacobian[5 * i + j] = -push * (by_out * n[j] + by_along * t[j]) - turned * t[j];
            jacobian[5 * i + 2 + j] = -push * by_rate * n[j] - normal * sharper * t[i] * t[j];
        }
        jacobian[5 * i + 4] = -normal * sharper * ring->radius * t[i];
    }
    return RF_OK;
}

int rf_both_at(const void *of, const double *state, double *f, double *jacobian)
{
    const rf_both *both = of;
    double other[2], slopes[10];
    const int first = both->first(both->of_first, state, f, jacobian);
    const int second = both->second(both->of_second, state, other, jacobian ? slopes : NULL);
    const int worst = first > second ? first : second;
    if (worst > RF_OUTSIDE)
        return worst;
    for (int i = 0; i < 2; ++i)
        f[i] += other[i];
    for (int i = 0; jacobian && i < 10; ++i)
        jacobian[i] += slopes[i];
    return worst;
}
