/* What the kernels of journal bearings share. Their models begin with the rf_journal.

   Parameters radius, length, clearance [m], viscosity [Pa s]; inputs x, y [m], vx, vy [m/s], speed [rad/s];
   outputs force_x, force_y [N]. */
#ifndef ROTORFILM_JOURNAL_MODEL_H
#define ROTORFILM_JOURNAL_MODEL_H

#include "journal_kernel.h"
#include "../kernels/kernel.h"

extern const rf_sizes RF_JOURNAL_SIZES;

/* Length / diameter of these parameters. */
double rf_slenderness(const double *parameters);

/* RF_INVALID unless the parameters have that of a map, by its name. */
int rf_judge_slenderness(double own, const char *map, const double *parameters, rf_message *why);

/* Clearance and unit of force from the parameters, or RF_INVALID and nothing changed. */
int rf_scale_journal(rf_journal *journal, const double *parameters, rf_message *why);

/* The status of a film at an input, with its message. */
int rf_explain_journal(const rf_journal *journal, int status, const double *input, rf_message *why);

/* The functions `output` and `jacobian` of an rf_kernel_type. */
int rf_journal_output(const void *kernel, const rf_point *at, double *y, rf_message *why);
int rf_journal_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why);

#endif
