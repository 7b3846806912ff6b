/* An instance of an FMU, whatever the version of FMI: its phase, its variables, and its kernel behind them.
   fmi2*.c and fmi3*.c add the names and the rules of call order. */
#ifndef ROTORFILM_INSTANCE_H
#define ROTORFILM_INSTANCE_H

#include "../solvers/integrate.h"
#include "../kernels/kernel.h"
#include "resource.h"

/* Numbered as fmi2Status and fmi3Status are. */
typedef enum rf_answer { RF_FINE = 0, RF_WARNING = 1, RF_DISCARD = 2, RF_ERROR = 3 } rf_answer;

/* Bits, so that a rule of call order is a mask. */
typedef enum rf_phase {
    RF_INSTANTIATED = 1,
    RF_CONFIGURING = 2,
    RF_INITIALIZING = 4,
    RF_EVENT = 8,
    RF_CONTINUOUS = 16,
    RF_STEPPING = 32,
    RF_STEP_FAILED = 64,
    RF_RECONFIGURING = 128,
    RF_TERMINATED = 256,
    RF_WITHIN_STEP = 512 /* while the host is told of a step within one of its own */
} rf_phase;

#define RF_ALWAYS (~0u) /* the rule of what mends an instance */

typedef enum rf_category {
    RF_LOG_WARNING,
    RF_LOG_DISCARD,
    RF_LOG_ERROR,
    RF_LOG_EVENTS,
    RF_LOG_ALL,
    RF_CATEGORIES
} rf_category;

typedef struct rf_instance rf_instance;

/* Where messages go: the callback of one version of FMI, behind a type that holds any function. */
typedef struct rf_host {
    void (*send)(const struct rf_host *host, const char *name, rf_answer answer, const char *category,
                 const char *text);
    void (*callback)(void);
    void *environment;
} rf_host;

/* What is saved and restored: numbers only. */
typedef struct rf_condition {
    double time;
    double kink;    /* next time event, as told to the simulator */
    double stride;  /* step size of a stiff integration; it belongs to the state, as results depend on it */
    uint32_t phase; /* rf_phase */
    uint32_t warned;
    double step;    /* length of the last step of Co-Simulation, 0 before */
} rf_condition;

struct rf_instance {
    char *name;
    rf_host host;
    unsigned categories; /* bits of those that are on */
    int co_simulation, event_mode, early_return;
    double (*within_step)(rf_instance *c, double t, double end); /* NULL, or who is told of steps within one */
    void (*update)(void);                                       /* the host's callback behind it */
    rf_resource *resource;
    const rf_kernel_type *type;
    void *kernel;
    rf_sizes sizes;
    size_t memory; /* numbers that the kernel remembers; it then has no states */
    rf_condition now;
    rf_phase resume; /* phase after reconfiguration */
    double stop_time, tolerance, last_good_time;
    int stop_defined, terminated;
    int parameters_changed;
    unsigned known; /* bits of the roles whose values are those of the present state */
    size_t value_count;
    double *values[RF_ROLES]; /* one block: parameters, inputs, states first, these are saved */
    rf_jacobian jacobian;
    double *work, *nominal, *drift; /* drift: twice the outputs */
};

/* Numbers of the states, or of a memory. */
static inline size_t rf_kept(const rf_instance *c)
{
    return c->sizes.states + c->memory;
}

/* The next ones answer NULL where it went wrong, with the message sent to the host. */
rf_instance *rf_make_instance(const char *name, const char *token, const char *folder, int logging,
                              int co_simulation, const rf_host *host);
void rf_free_instance(rf_instance *c);

/* Send a message; returns the answer. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
rf_answer rf_log(rf_instance *c, rf_answer answer, rf_category category, const char *format, ...);
rf_answer rf_set_logging(rf_instance *c, int on, size_t count, const char *const categories[]);

/* Whether a function may be called in the present phase; RF_ERROR, with a message, if not. */
rf_answer rf_allow(rf_instance *c, const char *function, unsigned phases);

rf_answer rf_set_experiment(rf_instance *c, int tolerance_defined, double tolerance, double start,
                            int stop_defined, double stop);
rf_answer rf_exit_initialization(rf_instance *c);
rf_answer rf_reset(rf_instance *c);

/* `numbers` are those of all elements. */
rf_answer rf_get(rf_instance *c, const unsigned *references, size_t count, double *values, size_t numbers);
rf_answer rf_set(rf_instance *c, const unsigned *references, size_t count, const double *values, size_t numbers);
/* Derivatives of outputs in time under held inputs, of order 1, at the end of a step of Co-Simulation. */
rf_answer rf_get_output_slopes(rf_instance *c, const unsigned *references, size_t count, const int *orders,
                               double *values, size_t numbers);
rf_answer rf_set_time(rf_instance *c, double time);
rf_answer rf_set_states(rf_instance *c, const double *x, size_t count);
rf_answer rf_get_states(rf_instance *c, double *x, size_t count);
rf_answer rf_get_derivatives(rf_instance *c, double *dx, size_t count);
rf_answer rf_get_switches(rf_instance *c, double *z, size_t count);
rf_answer rf_get_nominals(rf_instance *c, double *nominal, size_t count);

typedef struct rf_pair {
    const unsigned *unknowns;
    size_t unknown_count;
    const unsigned *knowns;
    size_t known_count;
} rf_pair;

/* Derivatives of the unknowns along a seed of the knowns; transposed, of the seeded sum of the unknowns by
   the knowns. */
rf_answer rf_differentiate(rf_instance *c, const rf_pair *pair, const double *seed, size_t seeds,
                           double *sensitivity, size_t sensitivities, int transposed);

void rf_enter(rf_instance *c, rf_phase phase);
/* Leave an event behind: the next one becomes known. */
void rf_pass_event(rf_instance *c);
int rf_has_kink(const rf_instance *c);
/* Advance by `step` from `from`; early returns end at a time event, or where within_step wants it: c->now.time. */
rf_answer rf_step(rf_instance *c, double from, double step);

/* Saved conditions are blocks of rf_saved_size() bytes; as bytes they carry a checksum. */
size_t rf_saved_size(const rf_instance *c);
rf_answer rf_save(rf_instance *c, void **saved);
rf_answer rf_restore(rf_instance *c, const void *saved);
rf_answer rf_serialize(rf_instance *c, const void *saved, void *bytes, size_t size);
rf_answer rf_deserialize(rf_instance *c, const void *bytes, size_t size, void **saved);

#endif
