/* Scaling and squaring with the diagonal Pade approximant (Golub & Van Loan, Matrix Computations, 11.3), of a
   matrix balanced by powers of 2 before: states in SI units differ by many orders of magnitude. */
#include "exponential.h"

#include <math.h>
#include <string.h>

#include "dense.h"

#define DEGREE 8 /* error below 1e-20 where the norm is 1/2 at most */
#define ROUNDS 20

size_t rf_exponential_work(size_t n)
{
    return 4 * n * n + n;
}

static double norm(size_t n, const double *a)
{
    double largest = 0.0;
    for (size_t i = 0; i < n; ++i) {
        double sum = 0.0;
        for (size_t j = 0; j < n; ++j)
            sum += fabs(a[i * n + j]);
        largest = sum > largest || sum != sum ? sum : largest;
    }
    return largest;
}

static void multiply(size_t n, const double *a, const double *b, double *product)
{
    memset(product, 0, n * n * sizeof *product);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < n; ++k)
            for (size_t j = 0; j < n; ++j)
                product[i * n + j] += a[i * n + k] * b[k * n + j];
}

/* Exponent of the power of 2 that makes row and column i alike; a row or column of zeros is left alone. */
static int imbalance(size_t n, const double *a, size_t i)
{
    double row = 0.0, column = 0.0;
    for (size_t j = 0; j < n; ++j)
        if (j != i) {
            row += fabs(a[i * n + j]);
            column += fabs(a[j * n + i]);
        }
    if (!(row > 0.0 && column > 0.0))
        return 0;
    int exponent;
    (void)frexp(row / column, &exponent);
    return (exponent - 1) / 2;
}

/* a becomes d^-1 a d, exactly. */
static void balance(size_t n, double *a, double *d)
{
    int moved = 1;
    for (size_t i = 0; i < n; ++i)
        d[i] = 1.0;
    for (int round = 0; moved && round < ROUNDS; ++round) {
        moved = 0;
        for (size_t i = 0; i < n; ++i) {
            const int exponent = imbalance(n, a, i);
            moved |= exponent != 0;
            d[i] = ldexp(d[i], exponent);
            for (size_t j = 0; exponent && j < n; ++j) {
                a[i * n + j] = ldexp(a[i * n + j], i == j ? 0 : -exponent);
                a[j * n + i] = ldexp(a[j * n + i], i == j ? 0 : exponent);
            }
        }
    }
}

/* p = N(a), q = N(-a) of the Pade approximant N(a)/N(-a), by rising powers of a. */
static void pade(size_t n, const double *a, double *p, double *q, double *power, double *next)
{
    double c = 1.0;
    memset(p, 0, n * n * sizeof *p);
    memset(power, 0, n * n * sizeof *power);
    for (size_t i = 0; i < n; ++i)
        p[i * n + i] = power[i * n + i] = 1.0;
    memcpy(q, p, n * n * sizeof *q);
    for (int k = 1; k <= DEGREE; ++k) {
        c *= (double)(DEGREE - k + 1) / (double)((2 * DEGREE - k + 1) * k);
        multiply(n, power, a, next);
        memcpy(power, next, n * n * sizeof *power);
        for (size_t i = 0; i < n * n; ++i) {
            p[i] += c * power[i];
            q[i] += (k % 2 ? -c : c) * power[i];
        }
    }
}

int rf_exponential(size_t n, double *a, double *work)
{
    double *p = work, *q = p + n * n, *power = q + n * n, *next = power + n * n, *d = next + n * n;
    int squarings = 0;
    balance(n, a, d);
    const double size = norm(n, a);
    if (!isfinite(size))
        return 1;
    if (size > 0.5)
        (void)frexp(size, &squarings), squarings += 1;
    for (size_t i = 0; i < n * n; ++i)
        a[i] = ldexp(a[i], -squarings);
    pade(n, a, p, q, power, next);
    rf_eliminate(n, q, n, p); /* the denominator is well conditioned */
    for (int k = 0; k < squarings; ++k) {
        multiply(n, p, p, next);
        memcpy(p, next, n * n * sizeof *p);
    }
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j)
            a[i * n + j] = p[i * n + j] * (d[i] / d[j]);
    return !isfinite(norm(n, a));
}
