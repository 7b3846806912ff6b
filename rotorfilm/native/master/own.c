#include "own.h"

#include <stdlib.h>
#include <string.h>

static rf_point point(const rf_own *own)
{
    const rf_point at = {own->t, own->x, own->u};
    return at;
}

static int judged(rf_own *own, int status)
{
    if (status == RF_OUTSIDE && own->outside++ == 0)
        memcpy(own->beyond, own->u, own->sizes.inputs * sizeof *own->u);
    return status == RF_OUTSIDE ? RF_OK : status;
}

int rf_own_put(rf_own *own, const uint32_t *references, size_t count, const double *values)
{
    for (size_t i = 0; i < count; ++i)
        own->u[references[i]] = values[i];
    return RF_OK;
}

int rf_own_take(rf_own *own, const uint32_t *references, size_t count, double *values)
{
    const rf_point at = point(own);
    const int status = judged(own, own->type->output(own->kernel, &at, own->y, &own->why));
    for (size_t i = 0; i < count; ++i)
        values[i] = own->y[references[i]];
    return status;
}

int rf_own_rate(rf_own *own, double *rates)
{
    const rf_point at = point(own);
    return judged(own, own->type->derivative(own->kernel, &at, rates, &own->why));
}

int rf_own_slopes(rf_own *own, const uint32_t *unknowns, size_t rows, const uint32_t *knowns, size_t columns,
                  double *matrix)
{
    const size_t n = own->sizes.states, m = own->sizes.inputs, q = own->sizes.outputs;
    const rf_point at = point(own);
    const int status = judged(own, own->type->jacobian(own->kernel, &at, &own->slopes, &own->why));
    for (size_t i = 0; i < rows; ++i) {
        const size_t row = unknowns[i] < q ? unknowns[i] : unknowns[i] - q;
        const double *by_state = (unknowns[i] < q ? own->slopes.C : own->slopes.A) + row * n;
        const double *by_input = (unknowns[i] < q ? own->slopes.D : own->slopes.B) + row * m;
        for (size_t j = 0; j < columns; ++j)
            matrix[i * columns + j] = knowns[j] < n ? by_state[knowns[j]] : by_input[knowns[j] - n];
    }
    return status;
}

static int allocate(rf_own *own)
{
    const size_t n = own->sizes.states, m = own->sizes.inputs, q = own->sizes.outputs;
    double *at = calloc((n + q) * (n + m) + n + 2 * m + q + 1, sizeof *at);
    if (!at)
        return 0;
    own->x = at, at += n;
    own->u = at, at += m;
    own->beyond = at, at += m;
    own->y = at, at += q;
    own->slopes.A = at, at += n * n;
    own->slopes.B = at, at += n * m;
    own->slopes.C = at, at += q * n;
    own->slopes.D = at;
    return 1;
}

rf_own *rf_open_kernel(const char *name, const rf_tables *tables, const double *parameters, rf_message *why)
{
    rf_own *own = calloc(1, sizeof *own);
    if (!own) {
        rf_say(why, RF_MEMORY, "no memory for a kernel");
        return NULL;
    }
    own->type = rf_find_kernel(name);
    own->tables = *tables;
    if (!own->type)
        rf_say(why, RF_INVALID, "this library has no kernel %s", name);
    own->kernel = own->type ? rf_create_kernel(own->type, &own->tables, &own->sizes, why) : NULL;
    if (own->kernel
        && (!own->type->set_parameters || own->type->set_parameters(own->kernel, parameters, why) == RF_OK)
        && allocate(own))
        return own;
    rf_close_kernel(own);
    return NULL;
}

void rf_close_kernel(rf_own *own)
{
    rf_destroy_kernel(own->type, own->kernel);
    free(own->x);
    free(own);
}
