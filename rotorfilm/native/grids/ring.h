/* Reynolds' equation in two dimensions on a ring of cells, by finite volumes of second order.

   The film is -(m H^3 P_theta)_theta - (L/D)^-2 (m H^3 P_z)_z = (w + z w').n - rate X_theta with
   p = 12 viscosity (R/c)^2 P and the gap H = A(z) - (e + z tau).n + D, n = (cos theta, sin theta). tau is what the
   end z = 1 of the journal lies beside its middle, per clearance, A the profile of the wall, D the depth of a recess;
   w = de/dt + rate (e_y, -e_x) and w' the same of tau, rate is half the speed. m is the mobility of the oil at H, and X
   what the walls drag beyond the smooth H: the depth D, and what a mobility changes. Conductance and Couette flux on
   either side of a node are those of the half cell there: what drives oil at a step is the difference of both
   (Rayleigh 1918).

   z runs from the middle, 0, to the end, 1, of the bearing, or over its whole length, from -1. Lines lie at
   exp(i theta) = (t + a)/(1 + conj(a) t), t = exp(i s), uniform in s on every span between two edges: a
   Moebius map of the circle that crowds them at the minimum film, a = e/(1 + (1 - |e|^2)^.35). Edges stay on
   lines, and the lines follow e unless they rest; the derivatives hold them. Nodes in openings are held at a
   pressure: an opening lies in the middle of the bearing, or is as long, and ends at a node.

   A ring is a bore that the journal touches at |e| = 1, or one pad, which it touches where H = 0 on its arc, so
   that |e| may be above 1. On a pad the lines crowd at its own minimum film, as if that were a bore's. */
#ifndef ROTORFILM_RING_H
#define ROTORFILM_RING_H

#include <stddef.h>
#include <stdint.h>

#include "../export.h"
#include "../status.h"
#include "mobility.h"
#include "search.h"

/* N lines around the ring with M unknown nodes on each. */
typedef struct rf_grid {
    size_t lines, nodes;
    const int32_t *span;       /* N: that a line and the face after it belong to */
    const double *line, *face; /* N: their places as fractions of the span */
    const double *value;       /* N: pressure of nodes that are held [1/s] */
    const int32_t *held;       /* N: how many nodes of a line are, from the middle of the bearing */
    const double *width;       /* M: of the cells as parts of half the length, or all; without the half cells at ends */
    const double *conductance; /* M: 1/distance to the next node towards the end, as part of the same */
    const double *place;       /* 2 M + 3: z of the end or middle, of faces and nodes in turn, and of the end ... */
    const double *wall;        /* ... and A there; both NULL where A = 1 and the bearing is not whole */
    size_t within;             /* distances between nodes that the recess takes, counted from the middle */
} rf_grid;

#define RF_LEVELS 3
#define RF_FREEDOMS 4 /* e and tau */
#define RF_DRIVES 5   /* w, w' and the rate */
#define RF_COLUMNS 9  /* of the derivatives: by freedoms and drives */

typedef struct rf_ring {
    rf_grid grids[RF_LEVELS];     /* the finest first, each with half the cells of the one before */
    const double *start, *extent; /* of the spans [rad] */
    double slenderness;           /* length / diameter */
    double depth;                 /* of the recess, per clearance */
    rf_mobility mobility;
    int32_t spans;
    int32_t recess; /* the span that has a recess; -1: none */
    int32_t whole;  /* whether the nodes cover the whole length, and the journal may be tilted */
    int32_t levels; /* grids in use */
    int32_t resting; /* whether the lines rest, uniform on every span */
    int32_t pinned;  /* whether there are edges: they keep their angles while the lines move */
    int32_t turning; /* whether line 0 lies at the widest gap, opposite to e, and turns with it */
    int32_t ruptured; /* whether the film is where P > 0, and P >= 0 elsewhere */
    int32_t clipped;  /* whether a full film's negative pressures are dropped */
    int32_t extrapolated; /* whether the force is f + (f - f2)/3 of the finest grid and the next (Richardson) */
    int32_t pad;          /* whether it is one pad: all spans but the first */
} rf_ring;

/* The least H at q = (e, tau) of the bore, or of the pad, and its place in the middle: `at` is the e of a bore with
   that film there. */
RF_EXPORT_LOOP double rf_least_film(const rf_ring *ring, const double *q, double *at);

/* RF_OK, or why there is no film at q[4] and drive[5]: RF_NOT_FINITE, RF_AT_WALL. */
int rf_judge_state(const rf_ring *ring, const double *q, const double *drive);

/* Force and moment f[4] = (F, T) at q[4] = (e, tau) and drive[5] = (w, w', rate), T in units of half the length, and
   unless NULL by[4][9] = d f/d(q, drive); rows and columns of tau are 0 unless the bearing is whole. RF_STUCK,
   RF_MEMORY; RF_UNDEFINED for the derivative where nothing drives the film. */
RF_EXPORT_LOOP int rf_ring_wrench(const rf_ring *ring, const double *q, const double *drive, double *f, double *by);

/* Whether the film knows the rate by more than its source. */
int rf_is_sped(const rf_ring *ring);

/* The force, on the finest grid unless it is extrapolated, as any film's (films/film.h); RF_STUCK where the search
   for the film does not end, RF_MEMORY. `data` is an rf_ring; it reads the rate only if it is sped. */
RF_EXPORT_LOOP int rf_ring_film(const void *data, const double *e, const double *w, double *f, double *jacobian);

/* Forces on the finest grid and the next, and d f/d(e, w) on the finest (8 rows) unless NULL, rows of n one stride
   apart, as rf_film_batch. */
RF_EXPORT_LOOP int rf_ring_pair(const rf_ring *ring, size_t n, const double *e, const double *w, double *fine,
                           double *coarse, double *jacobian, size_t *first);

/* One state on the finest grid: angles of lines and of faces (N), pressure (N x M) and the flow out of the
   ends of the film. */
RF_EXPORT_LOOP int rf_ring_field(const rf_ring *ring, const double *e, const double *w, double *theta, double *face,
                            double *pressure, double *side_flow);

/* The potential J = F.w/2 of a ruptured film whose openings are at pressure 0, and dJ/de, at one place for n
   sources w, rows of n: J (RF_LEVELS x n) and slope (RF_LEVELS x 2 x n, or NULL), the finest grid first. */
RF_EXPORT_LOOP int rf_ring_potential(const rf_ring *ring, const double *e, size_t n, const double *w, double *J,
                                double *slope, rf_grid_work *work, size_t *first);

#endif
