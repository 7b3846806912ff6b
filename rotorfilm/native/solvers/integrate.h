/* Time integration of a kernel's states under held inputs. */
#ifndef ROTORFILM_INTEGRATE_H
#define ROTORFILM_INTEGRATE_H

#include "../kernels/kernel.h"

#define RF_MOST_STAGES 7

/* Who is told of each step within an integration, the last one left out: the states are those at t. Answers up to
   where to go on, at most `end`. */
typedef struct rf_watch {
    double (*passed)(void *host, double t, double end);
    void *host;
} rf_watch;

typedef struct rf_integration {
    const rf_kernel_type *type;
    void *kernel;
    size_t states;
    const double *nominal; /* typical magnitude of each state */
    double tolerance;      /* of the local error, relative to each state and to its nominal value */
    double *stride;        /* of a stiff kernel: the step size to begin with, 0 if unknown; then the one for more */
    double *work;          /* rf_integration_work(states) doubles */
    rf_watch watch;        /* `passed` may be NULL */
} rf_integration;

size_t rf_integration_work(size_t states);

/* One piece between two kinks; its end belongs to it with the derivative from before. */
typedef struct rf_piece {
    const rf_integration *job;
    const double *u;
    double end, goal; /* of the piece, of the integration */
    enum { RF_FIRST, RF_ACCEPTED, RF_REJECTED } last; /* what came of the attempt before */
    double *next, *error;                             /* of an attempt: the state after it, its local error */
    double *stages[RF_MOST_STAGES], *slope;
} rf_piece;

/* A one-step method. An attempt from x at t answers an rf_status. */
typedef struct rf_method {
    double order;     /* of the solution that the error is taken of, and 1 */
    double tolerance; /* unless the simulator asks for another */
    int costly;       /* whether a new step size costs more than a step */
    int (*attempt)(const rf_piece *piece, double t, double h, const double *x, rf_message *why);
} rf_method;

extern const rf_method rf_rodas;

/* Of the local error, unless the simulator asks for another. */
double rf_default_tolerance(const rf_kernel_type *type);

/* The derivative within a piece. */
int rf_derive(const rf_piece *piece, double t, const double *x, double *dx, rf_message *why);

/* Advance *t, x to `end`, or to where the watch lets it. Where that fails, *t and x stay at the last good step. */
int rf_integrate(const rf_integration *job, double *t, double *x, const double *u, double end,
                 rf_message *why);

#endif
