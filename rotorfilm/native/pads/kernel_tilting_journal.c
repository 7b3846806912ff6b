/* Kernel "tilting_journal": a journal bearing of equal tilting pads without inertia
   (bearings/pads/tilting_bearing.py); parameters, states and tables as in tilting_model.h. */

/* Documentation of the FMU

   Model: Film force of a journal bearing of equal tilting pads; Reynolds equation with Reynolds rupture over
   each pad, ambient pressure at its ends and sides. x and y are Cartesian from the bearing center, rotation is positive
   about +z (from x to y), the force acts on the journal. The pads have no inertia: they tilt so that the film has no
   moment about their pivots, and pivots on springs give way. The states are their tilts q, as lengths at the film,
   and with springs the places s of their pivots. In the frame n, t of a pivot the film knows only e and w; its force
   is the gradient of the potential J of a table:

   Equations:
   e = ((x, y).n/clearance + preload + s/clearance, ((x, y).t + q)/clearance)
   w = ((vx, vy).n + ds/dt, (vx, vy).t + dq/dt)/clearance - (speed/2) z^ x e
   0 = dJ/dw_t,  pivot_stiffness s = scale dJ/dw_n,  scale = viscosity length radius^3 / clearance^2
   F = scale sum (dJ/dw_n n + dJ/dw_t t)

   Validity: The map is made for this extent and length / diameter: radius and length are fixed, the clearance of
   the pads and the viscosity tunable. A pad that loses its film stays as it is until the journal returns. Beyond the
   map the force is extrapolated, with a warning. Friction of film and pivots on the tilt is left out. Laminar,
   isothermal, aligned. */
#include "tilting_model.h"

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    return rf_take_tilting(kernel, tables, 0, sizes, why);
}

const rf_kernel_type rf_tilting_journal_type = {
    .bytes = sizeof(rf_tilting_model),
    .take = take_tables,
    .release = rf_release_tilting,
    .set_parameters = rf_set_tilting,
    .output = rf_tilting_output,
    .jacobian = rf_tilting_derivatives,
    .derivative = rf_tilting_derivative,
};
