/* What the kernels of squeeze-film dampers share: the film of a race that does not spin, and springs beside it.

   Their models begin with the rf_damper. Parameters of a journal (journal_model.h), stiffness [N/m] and others; inputs x, y [m],
   vx, vy [m/s]; outputs force_x, force_y [N]. */
#ifndef ROTORFILM_DAMPER_MODEL_H
#define ROTORFILM_DAMPER_MODEL_H

#include "journal_model.h"

enum { RF_RADIUS, RF_LENGTH, RF_CLEARANCE, RF_VISCOSITY, RF_STIFFNESS, RF_DAMPER_PARAMETERS, RF_DAMPER_INPUTS = 4 };

typedef struct rf_damper {
    rf_journal journal; /* its force_scale is viscosity radius length^3/clearance^2 */
    double stiffness;   /* of the springs [N/m] */
} rf_damper;

/* The functions `set_parameters`, which takes dimensions and springs, `output` and `jacobian` of an rf_kernel_type. */
int rf_scale_damper(void *kernel, const double *parameters, rf_message *why);
int rf_damper_output(const void *kernel, const rf_point *at, double *y, rf_message *why);
int rf_damper_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why);

#endif
