/* One step of a rotor in modes under forces that are polynomials of time.

   Over a step h from t the forces are polynomials through s collocation nodes c_i, and the rotor's answer to
   them is exact (variation of constants): with l_j the Lagrange polynomials of the nodes,

       z(t + c h) = exp(Lambda c h) z(t) + sum_j W_j(c) B u_j,
       W_j(c) = h int_0^c exp(Lambda h (c - s)) l_j(s) ds. */
#ifndef ROTORFILM_COLLOCATION_H
#define ROTORFILM_COLLOCATION_H

#include <stdint.h>

#include "../export.h"

typedef struct rf_complex {
    double re, im;
} rf_complex;

/* A rotor x' = A x + B u in modes, u = forces at the journals and the unbalance's pair. */
typedef struct rf_modes {
    int32_t modes;
    int32_t channels;         /* of u: two for each journal, two of the unbalance, those of an excitation */
    int32_t rows;             /* x, y, vx, vy of each journal, then accelerations */
    const rf_complex *values; /* modes */
    const rf_complex *push;   /* modes x channels */
    const rf_complex *sense;  /* rows x modes */
    /* Of ax, ay of each journal where films add masses, then of the unbalance where a motor drives it, else NULL: */
    const double *direct;     /* rows x channels: accelerations per force at the same moment */
    const rf_complex *rates;  /* accelerations x modes: per rate of the modal coordinates */
} rf_modes;

#define RF_MOST_NODES 15

/* Nodes of a step and polynomials on them, coefficients by rising power. */
typedef struct rf_scheme {
    int32_t stages;
    const double *nodes;     /* s */
    const double *lagrange;  /* s x s */
    const double *remainder; /* s + 1: vanishes at the nodes and is 1 at the start */
} rf_scheme;

/* What one length of a step needs. */
typedef struct rf_step_table {
    double *move;      /* s rows x 2 modes: motion at the nodes per real and imaginary modal coordinate */
    double *gain;      /* s x s x rows x channels: at node i per force at node j */
    double *defect;    /* s x rows x channels: per gap of the force at the start */
    rf_complex *keep;  /* modes: modal coordinates at the end per themselves */
    double *forced;    /* 2 modes x s channels: their real and imaginary parts per force at each node */
    /* Where the modes are not those of the speed (spin.h), else NULL: */
    rf_complex *turn;    /* s x modes: modal coordinates at the nodes per themselves */
    rf_complex *weights; /* s x (s + 1) x modes: at a node per drive at each node, and per gap at the start */
} rf_step_table;

/* Fill the tables of a step of length h; answers an rf_status. */
RF_EXPORT_LOOP int rf_set_step_table(const rf_modes *rotor, const rf_scheme *scheme, double h,
                                     const rf_step_table *table);

/* h int_0^c exp(Lambda h (c - s)) s^k ds for k = 0 ... count - 1, modes x count, and turn = exp(Lambda h c). */
void rf_set_integrals(const rf_modes *rotor, double h, double c, int32_t count, rf_complex *turn, rf_complex *out);

#endif
