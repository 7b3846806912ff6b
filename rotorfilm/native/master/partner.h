/* A partner of a co-simulation as the loop calls it: an FMU that is instantiated already, of FMI 2 or 3, or a
   kernel of this library. Functions answer 0, or the status that stops the run, which the partner then keeps
   beside the call that had it. */
#ifndef ROTORFILM_PARTNER_H
#define ROTORFILM_PARTNER_H

#include "../export.h"
#include "../kernels/kernel.h"

enum { RF_IS_FMI2, RF_IS_FMI3, RF_IS_KERNEL };

/* What is called, and counted. */
typedef enum rf_call {
    RF_PUT, RF_TAKE, RF_STRIDE, RF_SLOPE, RF_MOVE, RF_RATE, RF_SAVE, RF_RESTORE, RF_CALLS
} rf_call;

/* A kernel with its numbers. Its inputs are references to be put, its outputs to be taken; of slopes, outputs
   come before derivatives, and states before inputs. */
typedef struct rf_own {
    const rf_kernel_type *type;
    void *kernel;
    rf_tables tables;
    rf_sizes sizes;
    double t;
    double *x, *u, *y;
    rf_jacobian slopes;
    int32_t outside; /* answers beyond the verified range of the model, */
    double *beyond;  /* and the inputs of the first of them */
    rf_message why;
} rf_own;

typedef struct rf_partner {
    int32_t kind;
    int32_t status, failed; /* of the call that stopped the run, and which it was */
    void *component;        /* of the FMU; rf_own of a kernel */
    void (*put)(void);
    void (*take)(void);
    void (*stride)(void);
    void (*slope)(void);
    void (*set_time)(void);
    void (*set_states)(void);
    void (*rate)(void);
    void (*save)(void);
    void (*restore)(void);
    void (*forget)(void);
    void *saved; /* state of an FMU that can go back; a kernel that is stepped has none */
    size_t states;
    int64_t calls[RF_CALLS];
} rf_partner;

int rf_put(rf_partner *p, const uint32_t *references, size_t count, const double *values);
int rf_take(rf_partner *p, const uint32_t *references, size_t count, double *values);
int rf_stride(rf_partner *p, double t, double dt);

/* d(unknowns)/d(knowns), row by row; `column` has room for the unknowns. */
int rf_slopes(rf_partner *p, const uint32_t *unknowns, size_t rows, const uint32_t *knowns, size_t columns,
              double *matrix, double *column);

/* Of rotors that the loop integrates: go to a time and a state; the rates there. */
int rf_move(rf_partner *p, double t, const double *x);
int rf_rate(rf_partner *p, double *rates);

/* Keep the state at present in place of the one kept before; go back to it; forget it. */
int rf_save_partner(rf_partner *p);
int rf_restore_partner(rf_partner *p);
void rf_forget_partner(rf_partner *p);

/* A kernel with these tables, which outlive it, and parameters; NULL with the message where they do not fit. */
RF_EXPORT_MASTER rf_own *rf_open_kernel(const char *name, const rf_tables *tables, const double *parameters,
                                 rf_message *why);
RF_EXPORT_MASTER void rf_close_kernel(rf_own *own);

#endif
