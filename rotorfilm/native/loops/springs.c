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
