/* Contact of a shaft with a liner whose worn profile is given at nodes (bearings/bush/bush_reaction.py). */
#ifndef ROTORFILM_BUSH_PROFILE_H
#define ROTORFILM_BUSH_PROFILE_H

#include <stddef.h>

/* All arrays have n numbers; an element lies between a node and the next one. */
typedef struct rf_bush_profile {
    size_t n;
    int closed;  /* all around: the last node is next to the first */
    double step; /* angle between neighbors */
    double *cosine, *sine, *weight;
    /* Of the last depths: the integral of the positive depth against each hat function, d(load)/d(depth) by its
       diagonal and the entries of each element, half the angle in contact and its derivatives. */
    double *depth, *load, *diagonal, *beside, *angle_slope;
    double angle, total; /* total = sum of the loads */
} rf_bush_profile;

/* Set out the nodes on an arc of width `extent` about `center`. */
void rf_bush_profile_nodes(rf_bush_profile *p, double center, double extent);
/* Press the shaft into the liner to the depths p->depth. */
void rf_bush_profile_press(rf_bush_profile *p);
/* d(load)/d(depth) times a change of depth; the sum of it over the nodes is returned. */
double rf_bush_profile_stiffness(const rf_bush_profile *p, const double *change, double *load);

#endif
