/* The tables of ball bearings, shared by their kernels: rows (n x 17: the numbers of an rf_ball_row, in its order), waves
   (n x 5: those of an rf_ball_wave), law (its first number is the inertia of the balls, one of those of ball.h). */
#ifndef ROTORFILM_BALL_TABLES_H
#define ROTORFILM_BALL_TABLES_H

#include "../kernels/kernel.h"
#include "balls.h"

#define RF_MOST_ROWS 16u
#define RF_MOST_WAVES 64u

typedef struct rf_ball_tables {
    rf_ball_row rows[RF_MOST_ROWS];
    rf_ball_wave waves[RF_MOST_WAVES];
} rf_ball_tables;

/* Copy the tables and let the bearing point to them; *law gets that table, of so many numbers. RF_INVALID, with the message
   written, where they do not fit. */
int rf_take_balls(const rf_tables *tables, uint32_t numbers, rf_ball_tables *mine, rf_balls *balls, const double **law,
                  rf_message *why);

/* How many parameters the law of the balls takes after those of the kernel: traction coefficient and slide-to-roll ratio of
   balls that friction holds. */
size_t rf_ball_law_parameters(const rf_balls *balls);

/* Take these; RF_INVALID, with the message written, where they break a rule. */
int rf_set_ball_law(rf_balls *balls, const double *p, rf_message *why);

/* RF_INVALID, with the message written, unless so many parameters are finite and the damping among them not negative. */
int rf_check_balls(const double *p, int count, int damping, rf_message *why);

/* What is said of a status of a wrench, in front of where it was. */
const char *rf_ball_text(int status);

#endif
