/* Time integration of a kernel's states under held inputs. */
#ifndef ROTORFILM_INTEGRATE_H
#define ROTORFILM_INTEGRATE_H

#include "kernel.h"

typedef struct rf_integration {
    const rf_kernel_type *type;
    void *kernel;
    size_t states;
    const double *nominal; /* typical magnitude of each state */
    double tolerance;      /* of the local error, relative to each state and to its nominal value */
    double *work;          /* rf_integration_work(states) doubles */
} rf_integration;

size_t rf_integration_work(size_t states);

/* Advance *t, x to `end`. Where that fails, *t and x stay at the last good step. */
int rf_integrate(const rf_integration *job, double *t, double *x, const double *u, double end,
                 rf_message *why);

#endif
