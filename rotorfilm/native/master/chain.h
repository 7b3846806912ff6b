/* The answer of a linear system to a polynomial in time. */
#ifndef ROTORFILM_CHAIN_H
#define ROTORFILM_CHAIN_H

#include <stddef.h>

/* y(1) of y' = loop y + sum_k powers[i][k] s^k, k up to RF_DEGREE, from y(0) = 0; loop (n, n). */
void rf_chain(size_t n, const double *loop, const double *powers, double *y, double *work);
size_t rf_chain_work(size_t n);

#endif
