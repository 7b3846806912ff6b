/* A kernel: the physics of one kind of model behind one table of functions. It knows no simulator.

   A new kernel is one file with an rf_kernel_type and one row in kernel_list.h. Functions that a kernel does
   not need are NULL. Every function answers an rf_status and writes `why` unless that is RF_OK; what it
   answers together with RF_UNDEFINED or worse is not to be used. */
#ifndef ROTORFILM_KERNEL_H
#define ROTORFILM_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#include "../status.h"

#define RF_MOST_AXES 4

/* Numbers by name, row-major. */
typedef struct rf_table {
    char name[32];
    uint32_t axes;
    uint32_t extent[RF_MOST_AXES];
    const double *numbers;
} rf_table;

typedef struct rf_tables {
    const rf_table *list;
    size_t count;
} rf_tables;

/* The table of this name, or NULL. */
const rf_table *rf_seek_table(const rf_tables *tables, const char *name);

/* The table of this name if it has so many axes; NULL, with the message written, otherwise. */
const rf_table *rf_find_table(const rf_tables *tables, const char *name, uint32_t axes, rf_message *why);

/* The numbers of a table with one axis of `count`; NULL, with the message written, otherwise. */
const double *rf_numbers(const rf_tables *tables, const char *name, uint32_t count, rf_message *why);

typedef struct rf_sizes {
    size_t parameters, inputs, outputs, states, events;
} rf_sizes;

/* Time [s], states or memory, and inputs. */
typedef struct rf_point {
    double t;
    const double *x;
    const double *u;
} rf_point;

/* Exact derivatives, row-major: dx' = A dx + B du, dy = C dx + D du. */
typedef struct rf_jacobian {
    double *A, *B, *C, *D;
} rf_jacobian;

typedef struct rf_kernel_type {
    /* Size of a kernel, whose bytes are zero before `take` reads the tables, which outlive it. `take` sets the sizes, and
       answers RF_OK, or RF_INVALID or RF_MEMORY with the message written. `release` frees what `take` allocated. */
    size_t bytes;
    int (*take)(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why);
    void (*release)(void *kernel);

    /* Take all parameters, or answer RF_INVALID: then nothing is asked before a call that succeeds. */
    int (*set_parameters)(void *kernel, const double *parameters, rf_message *why);

    int (*output)(const void *kernel, const rf_point *at, double *y, rf_message *why);
    int (*jacobian)(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why);

    /* Whether `output` may add a mass to the force of two numbers: mass_xx, mass_xy, mass_yy, where it has five. */
    int adds_mass;

    /* Of kernels with states. At a kink in time the derivative is the one just after it. */
    int (*derivative)(const void *kernel, const rf_point *at, double *dx, rf_message *why);

    /* Of stiff kernels, stepped by rodas.c in place of the method of integrate.c: prepare for solutions of
       (shift I - df/dx) b' = b at a point, and the slope df/dt at fixed states. */
    const struct rf_method *method;
    int (*factorize)(void *kernel, const rf_point *at, double shift, rf_message *why);
    void (*solve)(void *kernel, double *b);
    void (*drift)(const void *kernel, const rf_point *at, double *slope);

    /* Of kernels that step by themselves, which have no states: how many numbers they remember, which only they read, and
       these numbers of a model at rest under the inputs. Outputs follow from them; inputs act in the next step. */
    size_t (*memory)(const void *kernel);
    int (*rest)(const void *kernel, const rf_point *at, double *memory, rf_message *why);

    /* Advance x by dt under held inputs, where the kernel does that better than integrate.h, or has a memory. What is
       worse than RF_OUTSIDE leaves x as it was. */
    int (*step)(void *kernel, const rf_point *at, double dt, double *x, rf_message *why);

    /* The switching functions: the kernel is smooth while none of them changes its sign. */
    int (*events)(const void *kernel, const rf_point *at, double *z, rf_message *why);

    /* The first time after t at which the derivative has a kink; HUGE_VAL if there is none. */
    double (*next_event)(const void *kernel, double t);
} rf_kernel_type;

#define RF_KERNEL(name, libraries, picture) extern const rf_kernel_type rf_##name##_type;
#include "kernel_list.h"

/* Make a kernel from its tables: NULL, with the message written, where they do not fit or memory is short. */
void *rf_create_kernel(const rf_kernel_type *type, const rf_tables *tables, rf_sizes *sizes, rf_message *why);
void rf_destroy_kernel(const rf_kernel_type *type, void *kernel);

/* The kernel of this name, NULL if this library has none. */
const rf_kernel_type *rf_find_kernel(const char *name);

#endif
