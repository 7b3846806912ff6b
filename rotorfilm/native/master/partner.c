#include "partner.h"

#include <string.h>

#include "../fmi/fmi2FunctionTypes.h"
#include "../fmi/fmi3FunctionTypes.h"
#include "own.h"

/* Count the call and judge its answer: what is worse than a warning stops the run. */
static int answered(rf_partner *p, rf_call call, int status)
{
    ++p->calls[call];
    if (status <= 1)
        return 0;
    p->status = status;
    p->failed = (int32_t)call;
    return status;
}

int rf_put(rf_partner *p, const uint32_t *r, size_t n, const double *v)
{
    if (n == 0)
        return 0;
    if (p->kind == RF_IS_FMI2)
        return answered(p, RF_PUT, ((fmi2SetRealTYPE *)p->put)(p->component, r, n, v));
    if (p->kind == RF_IS_FMI3)
        return answered(p, RF_PUT, ((fmi3SetFloat64TYPE *)p->put)(p->component, r, n, v, n));
    return answered(p, RF_PUT, rf_own_put(p->component, r, n, v));
}

int rf_take(rf_partner *p, const uint32_t *r, size_t n, double *v)
{
    if (n == 0)
        return 0;
    if (p->kind == RF_IS_FMI2)
        return answered(p, RF_TAKE, ((fmi2GetRealTYPE *)p->take)(p->component, r, n, v));
    if (p->kind == RF_IS_FMI3)
        return answered(p, RF_TAKE, ((fmi3GetFloat64TYPE *)p->take)(p->component, r, n, v, n));
    return answered(p, RF_TAKE, rf_own_take(p->component, r, n, v));
}

int rf_stride(rf_partner *p, double t, double dt)
{
    fmi3Boolean event, terminate, early;
    fmi3Float64 reached;
    if (p->kind == RF_IS_FMI2)
        return answered(p, RF_STRIDE, ((fmi2DoStepTYPE *)p->stride)(p->component, t, dt, fmi2False));
    if (p->kind == RF_IS_FMI3)
        return answered(p, RF_STRIDE,
                        ((fmi3DoStepTYPE *)p->stride)(p->component, t, dt, fmi3False, &event, &terminate,
                                                      &early, &reached));
    ((rf_own *)p->component)->t = t + dt; /* it has no states to be stepped */
    return answered(p, RF_STRIDE, 0);
}

static int slope(rf_partner *p, const uint32_t *unknowns, size_t rows, const uint32_t *known, double *column)
{
    static const double seed = 1.0;
    if (p->kind == RF_IS_FMI2)
        return answered(p, RF_SLOPE,
                        ((fmi2GetDirectionalDerivativeTYPE *)p->slope)(p->component, unknowns, rows, known, 1,
                                                                       &seed, column));
    return answered(p, RF_SLOPE,
                    ((fmi3GetDirectionalDerivativeTYPE *)p->slope)(p->component, unknowns, rows, known, 1,
                                                                   &seed, 1, column, rows));
}

int rf_slopes(rf_partner *p, const uint32_t *unknowns, size_t rows, const uint32_t *knowns, size_t columns,
              double *matrix, double *column)
{
    if (p->kind == RF_IS_KERNEL)
        return answered(p, RF_SLOPE, rf_own_slopes(p->component, unknowns, rows, knowns, columns, matrix));
    for (size_t j = 0; j < columns; ++j) {
        const int status = slope(p, unknowns, rows, knowns + j, column);
        if (status)
            return status;
        for (size_t i = 0; i < rows; ++i)
            matrix[i * columns + j] = column[i];
    }
    return 0;
}

int rf_move(rf_partner *p, double t, const double *x)
{
    int status;
    if (p->kind == RF_IS_KERNEL) {
        rf_own *own = p->component;
        own->t = t;
        memcpy(own->x, x, p->states * sizeof *x);
        return answered(p, RF_MOVE, 0);
    }
    status = p->kind == RF_IS_FMI2 ? (int)((fmi2SetTimeTYPE *)p->set_time)(p->component, t)
                                   : (int)((fmi3SetTimeTYPE *)p->set_time)(p->component, t);
    if (answered(p, RF_MOVE, status))
        return status;
    status = p->kind == RF_IS_FMI2
                 ? (int)((fmi2SetContinuousStatesTYPE *)p->set_states)(p->component, x, p->states)
                 : (int)((fmi3SetContinuousStatesTYPE *)p->set_states)(p->component, x, p->states);
    return answered(p, RF_MOVE, status);
}

int rf_rate(rf_partner *p, double *rates)
{
    if (p->kind == RF_IS_FMI2)
        return answered(p, RF_RATE, ((fmi2GetDerivativesTYPE *)p->rate)(p->component, rates, p->states));
    if (p->kind == RF_IS_FMI3)
        return answered(p, RF_RATE, ((fmi3GetContinuousStateDerivativesTYPE *)p->rate)(p->component, rates,
                                                                                     p->states));
    return answered(p, RF_RATE, rf_own_rate(p->component, rates));
}

int rf_save_partner(rf_partner *p)
{
    if (p->kind == RF_IS_FMI2)
        return answered(p, RF_SAVE, ((fmi2GetFMUstateTYPE *)p->save)(p->component, &p->saved));
    if (p->kind == RF_IS_FMI3)
        return answered(p, RF_SAVE, ((fmi3GetFMUStateTYPE *)p->save)(p->component, &p->saved));
    return 0;
}

int rf_restore_partner(rf_partner *p)
{
    if (p->kind == RF_IS_FMI2)
        return answered(p, RF_RESTORE, ((fmi2SetFMUstateTYPE *)p->restore)(p->component, p->saved));
    if (p->kind == RF_IS_FMI3)
        return answered(p, RF_RESTORE, ((fmi3SetFMUStateTYPE *)p->restore)(p->component, p->saved));
    return 0;
}

void rf_forget_partner(rf_partner *p)
{
    if (!p->saved || p->status == fmi2Fatal) /* which forbids all further calls, as that of FMI 3 does */
        return;
    if (p->kind == RF_IS_FMI2)
        ((fmi2FreeFMUstateTYPE *)p->forget)(p->component, &p->saved);
    else
        ((fmi3FreeFMUStateTYPE *)p->forget)(p->component, &p->saved);
    p->saved = NULL;
}
