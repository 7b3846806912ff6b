/* A rotor that turns at another speed than that of its modes, as in a run-up.

   With the modes of the speed w0 the gyroscopic effect and the rotating damping leave

       z' = Lambda z + B u + g,    g = (w(t) - w0) (S z + S_0).

   The drive g is a polynomial through the nodes of a step as the forces are, one for each mode. It is small, so
   that it is found along with Newton's method by substitution; its gap at the start of a step counts in the
   local error. */
#ifndef ROTORFILM_SPIN_H
#define ROTORFILM_SPIN_H

#include "march_step.h"

/* The drive at the time of the march, in at->drive_start. */
void rf_set_drive_start(const rf_march *march, double speed, rf_scratch *at);

/* Motion of the journals at the nodes under the forces in at->guess and the drive in at->drive, which is then
   that of this motion. */
void rf_set_spinning_motion(const rf_march *march, const rf_step_table *table, rf_scratch *at, double *motion);

/* Modal coordinates at the end of the step under the forces in at->guess and the drive in at->drive. */
void rf_advance_spinning(rf_march *march, const rf_step_table *table, rf_scratch *at);

/* Motion at the nodes that the gap between the drive at the start and its polynomial makes, s x rows. */
void rf_set_spinning_gap(const rf_march *march, const rf_step_table *table, rf_scratch *at, double *motion);

#endif
