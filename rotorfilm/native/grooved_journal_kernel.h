/* A grooved journal bearing in SI units over its impedance map, as journal_kernel.h has the plain one. */
#ifndef ROTORFILM_GROOVED_JOURNAL_KERNEL_H
#define ROTORFILM_GROOVED_JOURNAL_KERNEL_H

#include "groove_kernel.h"

typedef struct rf_grooved_journal {
    rf_groove_map map;
    double clearance;   /* m */
    double force_scale; /* viscosity * length * radius^3 / clearance^2 [N s] */
} rf_grooved_journal;

RF_EXPORT int rf_grooved_journal_force(const rf_grooved_journal *journal, const double *state, double *f);
RF_EXPORT int rf_grooved_journal_jacobian(const rf_grooved_journal *journal, const double *state,
                                          double *f, double *jacobian);
RF_EXPORT int rf_grooved_journal_call(const rf_grooved_journal *journal, double x, double y, double vx,
                                      double vy, double speed, double *f);
RF_EXPORT int rf_grooved_journal_force_batch(const rf_grooved_journal *journal, size_t n,
                                             const double *position, size_t position_stride,
                                             const double *velocity, size_t velocity_stride,
                                             const double *speed, size_t speed_step, double *f,
                                             size_t f_stride, size_t *first);
RF_EXPORT int rf_grooved_journal_jacobian_batch(const rf_grooved_journal *journal, size_t n,
                                                const double *position, size_t position_stride,
                                                const double *velocity, size_t velocity_stride,
                                                const double *speed, size_t speed_step, double *f,
                                                size_t f_stride, double *jacobian,
                                                size_t jacobian_stride, size_t *first);

#endif
