#include "damper_model.h"

#include <math.h>

int rf_scale_damper(void *kernel, const double *p, rf_message *why)
{
    rf_damper *damper = kernel;
    const double stiffness = p[RF_STIFFNESS];
    if (!(stiffness >= 0.0 && stiffness < HUGE_VAL))
        return rf_say(why, RF_INVALID, "stiffness must be finite and not negative, got %.9g", stiffness);
    if (rf_scale_journal(&damper->journal, p, why) != RF_OK)
        return RF_INVALID;
    /* As Python multiplies. */
    const double length = p[RF_LENGTH], c = p[RF_CLEARANCE];
    const double scale = p[RF_VISCOSITY] * p[RF_RADIUS] * (length * length * length) / (c * c);
    if (!(scale > 0.0 && scale < HUGE_VAL))
        return rf_say(why, RF_INVALID, "viscosity radius length^3 / clearance^2 must be finite, got %.9g", scale);
    damper->journal.force_scale = scale;
    damper->stiffness = stiffness;
    return RF_OK;
}

/* Force and, unless NULL, D[2][4]. The race does not spin: speed 0. */
static int answer(const void *kernel, const rf_point *at, double *y, double *D, rf_message *why)
{
    const rf_damper *self = kernel;
    const double k = self->stiffness, u[5] = {at->u[0], at->u[1], at->u[2], at->u[3], 0.0};
    const rf_point still = {at->t, at->x, u};
    double jacobian[10];
    rf_jacobian film = {NULL, NULL, NULL, jacobian};
    const int status = D ? rf_journal_derivatives(kernel, &still, &film, why)
                         : rf_journal_output(kernel, &still, y, why);
    for (int i = 0; i < 2; ++i) {
        if (!D)
            y[i] -= k * u[i];
        for (int j = 0; D && j < RF_DAMPER_INPUTS; ++j)
            D[RF_DAMPER_INPUTS * i + j] = jacobian[5 * i + j] - (i == j ? k : 0.0);
    }
    return status;
}

int rf_damper_output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    return answer(kernel, at, y, NULL, why);
}

int rf_damper_derivatives(const void *kernel, const rf_point *at, rf_jacobian *given, rf_message *why)
{
    return answer(kernel, at, NULL, given->D, why);
}
