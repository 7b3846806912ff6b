/* What the kernels of shear and flow share: losses in the axes of a state, and the gap around it. */
#ifndef ROTORFILM_LOSS_FRAME_H
#define ROTORFILM_LOSS_FRAME_H

#include "loss_kernel.h"
#include "../films/map_frame.h"
#include "../films/map_spline.h"

/* A loss as a function of chi, of the angle t from e to w, and of the angle of e with t held: its derivatives, those in
   the angles over chi. */
typedef struct rf_polar {
    double value, by_chi, by_turn, by_side;
} rf_polar;

#define RF_NEAR 1e-3 /* eccentricity ratio of the first node: nearer to the center the angles count as there */

/* The frame, with any direction across e where there is no source. */
int rf_orient_loss(const double *e, const double *w, rf_frame *at);

/* Losses and, unless NULL, slopes from those in polar axes. The flow, the last one, is that of a source of size 1. */
int rf_answer_losses(const rf_frame *at, const rf_polar *of, int first, double *losses, double *slopes);

/* A map of losses over X, theta and s, with first derivatives where the order is not -1. */
void rf_opened_spline(const double *coefficients, int order, const size_t *strides, const rf_weights *by, rf_spline *at);

/* Not-a-number, and the status. */
int rf_fail_losses(int status, double *losses, double *slopes);

/* The integral of 1/(1 + chi cos) from 0 to an angle of any size, and its derivative in chi. */
double rf_gap_integral(double chi, double angle, double *by_chi);

#endif
