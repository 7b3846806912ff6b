/* Fixed pads about one journal, each a film in its own frame about its own center of curvature. */
#ifndef ROTORFILM_LOBES_H
#define ROTORFILM_LOBES_H

#include "journal_kernel.h"

/* In its frame the middle of the pad is at the angle 0. */
typedef struct rf_lobe {
    rf_journal film; /* of a journal about the center of curvature */
    double cos, sin; /* of the angle of its middle */
    double x, y;     /* its center of curvature [m] */
} rf_lobe;

typedef struct rf_lobes {
    size_t count;
    const rf_lobe *list;
} rf_lobes;

/* The sum of their forces, an rf_response of rf_lobes; the most severe status. A film that nothing drives has a
   force of zero, but RF_UNDEFINED for its derivatives. */
RF_EXPORT_LOOP int rf_lobes_at(const void *lobes, const double *state, double *f, double *jacobian);

#endif
