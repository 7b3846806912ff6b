/* A bearing of tilting pads in SI units: forces, rates of the pads, and pads at rest.

   Each pad has a tilt q [m], the angle times the distance of the journal's surface from the pivot's center of rotation,
   and on springs its pivot gives way by s [m], negative outward. Of N pads the states are q (N), then s (N) with
   springs, and, of pads with inertia, the rates of all of them. */
#ifndef ROTORFILM_TILTING_H
#define ROTORFILM_TILTING_H

#include <stddef.h>

#include "tilting_pad.h"

typedef struct rf_tilting {
    rf_tilting_pad pad;
    size_t count;
    const double *pivot; /* count x 2: cos and sin of the angles of the pivots */
    double preload;
    double clearance;   /* of a pad, c [m] */
    double force_scale; /* viscosity * length * radius^3 / c^2 [N s] */
    double spring;      /* of a pivot [N/m]; 0 for a rigid one */
    double inertia;     /* about the pivot, over the square of its distance from the journal [kg]; 0 for none */
    double mass;        /* that moves with the pivot [kg] */
} rf_tilting;

size_t rf_tilting_states(const rf_tilting *bearing);

/* Exact derivatives, row-major, by states and u: A (states x states), B (states x 5), C (2 + count x states), D. */
typedef struct rf_tilting_slopes {
    double *A, *B, *C, *D;
} rf_tilting_slopes;

/* Rates dx of the states x, and y: force_x, force_y [N] on the journal and the load of each pivot [N], at u = x, y [m],
   vx, vy [m/s], speed [rad/s]. `slopes` may be NULL. *pad gets the place of the pad with the worst status. */
RF_EXPORT_LOOP int rf_tilting_at(const rf_tilting *bearing, const double *u, const double *x, double *dx, double *y,
                            const rf_tilting_slopes *slopes, size_t *pad);

/* The same of an rf_tilting as a film with states (../loops/journals.h): at (x, y, vx, vy, speed, states, rates near
   those of the states), the force and the rates of the states, with slopes; RF_MEMORY too. */
RF_EXPORT_LOOP int rf_tilting_moving(const void *of, const double *state, double *answer, double *by);

/* Forces f (2 x n) on the journal for n rows of u (5 x n), tilts q and their rates (count x n), pivots in their place.
   *first gets the place of the pad with the worst status, state by state. */
RF_EXPORT_LOOP int rf_tilting_forces(const rf_tilting *bearing, size_t n, const double *u, const double *q, const double *rate,
                                double *f, size_t *first);

/* One pad at rest. */
typedef struct rf_tilting_rest {
    double tilt, pivot; /* q and s [m] */
    double load;        /* on its pivot [N] */
    double stiffness;   /* -d(force along n)/d(position along n), the pad free [N/m] */
    double by_speed;    /* d(load)/d(speed) [N s/rad] */
    double least;       /* film [m] */
    double unloaded;    /* 1 where there is no film */
} rf_tilting_rest;

/* All pads at rest under a journal at rest: force[2], its derivatives by[2][5] as of a reaction unless NULL, by the
   velocity 0, and unless NULL `pads`, count of them. */
RF_EXPORT_LOOP int rf_tilting_at_rest(const rf_tilting *bearing, const double *position, double speed, double *force,
                                 double *by, rf_tilting_rest *pads, size_t *pad);

/* The same of an rf_tilting as the response of a film (../films/film.h), whose journal must not move. */
RF_EXPORT_LOOP int rf_tilting_still(const void *of, const double *state, double *force, double *by);

#endif
