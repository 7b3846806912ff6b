/* The film at the wall: near the wall it is that between a plane and a parabola, of the bearing's length.

   With G = 1 - chi^2 the film is G (1 + tau^2)/2 at the distance sqrt(G) tau, in units of the radius, from its minimum,
   the length is l = 2 (L/D)/sqrt(G) in units of sqrt(G), and the source u = (w_r, sqrt(G) w_t). So

       J/|w|^2 = -48 G^(-3/2) |u|^2/|w|^2 exp(Lambda(q, ln(l/(1 + l/200)))),   q = -ln((1 + u_r/|u|)/2),

   with one table Lambda for every bearing (tools/build_wall.py). It leaves out what does not grow without bound. */
#ifndef ROTORFILM_WALL_H
#define ROTORFILM_WALL_H

#include "map_frame.h"

#define RF_WALL_CELLS_Q 24
#define RF_WALL_CELLS_L 16
#define RF_WALL_END_Q 9.6
#define RF_WALL_SHORT 0.1  /* l of the first node; Lambda goes on as 2 ln l below it */
#define RF_WALL_LONG 200.0 /* l/(1 + l/200) of the last one, at an infinite length */
#define RF_WALL_LAYER (RF_WALL_CELLS_L + RF_ORDER - 1)

extern const float rf_wall_table[(RF_WALL_CELLS_Q + RF_ORDER - 1) * RF_WALL_LAYER];

/* E = J/|w|^2 and its derivatives: in the angle of w (turn), in chi (slope). */
typedef struct rf_potential {
    double value, turn, turn_turn, slope, turn_slope;
} rf_potential;

/* E of the film at the wall; cos and sin of the angle from e to w. */
void rf_at_wall(double slenderness, double chi, double cos, double sin, rf_potential *e);

/* A share of what E of the film at the wall gains from the last node of a map on, and its derivatives in the angle of e and in chi. */
typedef struct rf_share {
    double value, side, slope;
} rf_share;

/* The film of a map beyond its last node chi_end, where it has L: E there, and a share of the gain. E there may depend on
   the direction of e by itself: turned[2] are the derivatives of E and of its turn where e and w turn together. It may also
   depend on the rate: by_rate[3] are the derivatives of L, of its turn and of the share; NULL where none does. */
int rf_go_to_wall(double slenderness, double chi_end, const rf_frame *at, const rf_exponent *end, const rf_share *share,
                  const double *turned, const double *by_rate, double *f, double *jacobian);

/* Largest error of a force that was measured beyond a last node x_end of a map [%] (docs/map.md): 0 for last nodes
   nearer the center than any that was. */
int rf_wall_error(double x_end);

#endif
