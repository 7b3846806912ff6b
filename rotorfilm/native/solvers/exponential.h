/* The exponential of a small matrix. */
#ifndef ROTORFILM_EXPONENTIAL_H
#define ROTORFILM_EXPONENTIAL_H

#include <stddef.h>

/* Doubles that rf_exponential works in. */
size_t rf_exponential_work(size_t n);

/* Replace a[n][n] by its exponential; 0, or 1 if that is not finite. */
int rf_exponential(size_t n, double *a, double *work);

#endif
