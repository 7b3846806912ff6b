/* A ball whose gyroscopic moment is held by friction at both races. */
#ifndef ROTORFILM_BALL_TRACTION_H
#define ROTORFILM_BALL_TRACTION_H

#include "ball.h"

/* The balance of a pressed ball with its center near x[2]; 0 where none was found. */
int rf_ball_held(const rf_ball_row *row, const rf_ball_law *law, const double *a, double speed, const double *x,
                 rf_ball *ball);

#endif
