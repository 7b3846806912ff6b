/* One ball between the grooves of two rings: its contact loads, and what the inner ring feels.

   Vectors are (axial, radial). The centers of curvature of the grooves are apart by a vector a from the outer one; the
   ball's center lies between them. A contact carries K d^1.5, d being its approach. */
#ifndef ROTORFILM_BALL_H
#define ROTORFILM_BALL_H

#include <stdint.h>

#include "../status.h"

/* A row of equal balls. */
typedef struct rf_ball_row {
    double place;           /* along the shaft, from the point whose motion is given [m] */
    double direction;       /* 1 or -1: along z, of the thrust that the row carries */
    double axial;           /* of a where nothing is displaced [m] */
    double radial;          /* the same, without growth [m] */
    double arm;             /* radius on which the centers of curvature of the inner groove lie [m] */
    double count;           /* of balls */
    double turn;            /* angle of the first ball, from +x towards +y [rad] */
    double inner, outer;    /* distance of the ball's center from those of the grooves at first touch [m] */
    double inner_stiffness; /* K [N/m^1.5] */
    double outer_stiffness;
    double ratio;       /* ball diameter over pitch diameter */
    double diameter;    /* of a ball [m] */
    double mass;        /* of a ball [kg] */
    double largest;     /* load of a ball for which the law is meant [N] */
    double inner_reach; /* lever of friction against spin over the cube root of the load [m/N^(1/3)] */
    double outer_reach;
} rf_ball_row;

#define RF_BALL_COLUMNS 17

/* Traction coefficient beyond which a ball under race control would slide under its gyroscopic moment. */
#define RF_MOST_TRACTION 0.06

/* Share of the traction coefficient beyond which a ball that friction holds is taken to slide. */
#define RF_MOST_SHARE 0.9

/* Which inertia the balls have: none, or centrifugal force and gyroscopic moment, of balls that spin relative to the
   inner ring only (no spin at the outer one), or to the outer one only, or as the balance of friction at both has it; the
   last is for balls that hold no moment. */
enum {
    RF_BALLS_STATIC,
    RF_BALLS_OUTER_CONTROL,
    RF_BALLS_INNER_CONTROL,
    RF_BALLS_TRACTION,
    RF_BALLS_LOOSE
};

typedef struct rf_ball_law {
    int32_t inertia; /* one of these, but not the last */
    double traction; /* traction coefficient at full sliding, of balls that friction holds */
    double slide;    /* slide-to-roll ratio at which friction is 1/sqrt(2) of that */
} rf_ball_law;

typedef struct rf_ball {
    double force[2];     /* on the inner ring [N] */
    double by_place[4];  /* its derivatives by a, row-major [N/m] */
    double by_speed[2];  /* and by the speed [N s/rad] */
    double load[2];      /* of the contacts, inner and outer [N] */
    double angle[2];     /* of the contacts [rad]; that of an open inner one is where it would touch */
    double centrifugal;  /* force [N] */
    double gyroscopic;   /* moment, negative for positive angles [N m] */
    double orbit;        /* angular speed about the shaft [rad/s] */
    double gap;          /* approach of the inner contact, of static balls of both; negative where it is open [m] */
    double traction;     /* friction over load that the gyroscopic moment asks for, the larger of both contacts */
    double slip;         /* speed across the way that the ball rolls, at both contacts [m/s] */
} rf_ball;

/* A ball under a given distance of the centers at a speed of the inner ring [rad/s]. RF_OUTSIDE where traction or load
   are beyond what is meant, RF_STUCK where no balance was found. */
int rf_ball_at(const rf_ball_row *row, const rf_ball_law *law, const double *a, double speed, rf_ball *ball);

#endif
