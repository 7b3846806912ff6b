/* Small dense matrices, row-major. */
#ifndef ROTORFILM_DENSE_H
#define ROTORFILM_DENSE_H

#include <stddef.h>

/* Solve q X = p in place by elimination with pivoting: p[n][m] becomes X, q is spent. A singular q leaves
   what is not finite. */
void rf_eliminate(size_t n, double *q, size_t m, double *p);

/* sum[rows] += scale * a[rows][columns] v. */
void rf_add_product(size_t rows, size_t columns, double scale, const double *a, const double *v, double *sum);

#endif
