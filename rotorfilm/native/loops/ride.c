#include "ride.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../status.h"

static double force(const rf_ride_law *law, const double *y)
{
    const double depth = fmax(law->offset - y[0], 0.0) / law->span;
    double answer = pow(depth, law->exponent) + law->D * (fmin(y[0], law->offset) - law->operating);
    for (int32_t k = 0; k < law->order; ++k)
        answer += law->C[k] * y[2 + k];
    return fmax(answer, 0.0);
}

static void set_rates(const rf_ride_law *law, const double *y, double push, double *out)
{
    /* A ball that has left no longer drives the film. */
    const double drive = fmin(y[0], law->offset) - law->operating;
    out[0] = y[1];
    out[1] = (force(law, y) - push) / law->W;
    for (int32_t i = 0; i < law->order; ++i) {
        double total = law->B[i] * drive;
        for (int32_t j = 0; j < law->order; ++j)
            total += law->A[i * law->order + j] * y[2 + j];
        out[2 + i] = total;
    }
}

/* to = y + h rates */
static void move(int32_t size, const double *y, double h, const double *rates, double *to)
{
    for (int32_t i = 0; i < size; ++i)
        to[i] = y[i] + h * rates[i];
}

int rf_ride(const rf_ride_law *law, const double *start, double step, int64_t n, const double *pushes, double *out)
{
    const int32_t size = 2 + law->order;
    double *k = malloc(5 * (size_t)size * sizeof *k);
    if (!k)
        return RF_MEMORY;
    double *now = k + 4 * size;
    memcpy(out, start, (size_t)size * sizeof *out);
    for (int64_t m = 0; m < n; ++m) {
        const double *y = out + m * size, *push = pushes + 2 * m;
        double *next = out + (m + 1) * size;
        set_rates(law, y, push[0], k);
        move(size, y, 0.5 * step, k, now);
        set_rates(law, now, push[1], k + size);
        move(size, y, 0.5 * step, k + size, now);
        set_rates(law, now, push[1], k + 2 * size);
        move(size, y, step, k + 2 * size, now);
        set_rates(law, now, push[2], k + 3 * size);
        for (int32_t i = 0; i < size; ++i)
            next[i] = y[i] + step / 6.0 * (k[i] + 2.0 * k[size + i] + 2.0 * k[2 * size + i] + k[3 * size + i]);
    }
    free(k);
    return RF_OK;
}
