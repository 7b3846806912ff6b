#include "springs.h"

#include "../status.h"

int rf_springs_at(const void *of, const double *state, double *f, double *jacobian)
{
    const double *K = of, *C = K + 4;
    for (int i = 0; i < 2; ++i) {
        f[i] = -(K[2 * i] * state[0] + K[2 * i + 1] * state[1] + C[2 * i] * state[2] + C[2 * i + 1] * state[3]);
        for (int j = 0; jacobian && j < 2; ++j) {
            jacobian[5 * i + j] = -K[2 * i + j];
            jacobian[5 * i + 2 + j] = -C[2 * i + j];
        }
        if (jacobian)
            jacobian[5 * i + 4] = 0.0;
    }
    return RF_OK;
}

int rf_sprung_at(const void *sprung, const double *state, double *f, double *jacobian)
{
    const rf_sprung *of = sprung;
    const double at[5] = {state[0], state[1], state[2], state[3], of->still ? 0.0 : state[4]};
    const int status = of->film(of->of, at, f, jacobian);
    for (int i = 0; i < 2; ++i) {
        f[i] -= of->stiffness * at[i];
        if (jacobian)
            jacobian[6 * i] -= of->stiffness;
        if (jacobian && of->still)
            jacobian[5 * i + 4] = 0.0;
    }
    return status;
}
