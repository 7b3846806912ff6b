/* Scaling and squaring of the system with the chain 1, s, s^2, ... behind it (Van Loan 1978): over a part of
   the step its Taylor series, over twice as much E E and E V + V N, where E carries the system, N the chain,
   known in closed form, and V the one from the other. */
#include "chain.h"

#include <math.h>
#include <string.h>

#include "rotor.h"

#define TERMS 17 /* error below 1e-18 where the norm is 1/2 at most */

size_t rf_chain_work(size_t n)
{
    return 3 * n * n + 3 * n * RF_NODES;
}

static int squarings_of(size_t n, const double *loop)
{
    double largest = 0.0;
    int exponent = 0;
    for (size_t i = 0; i < n; ++i) {
        double sum = 0.0;
        for (size_t j = 0; j < n; ++j)
            sum += fabs(loop[i * n + j]);
        largest = sum <= largest ? largest : sum;
    }
    if (largest > 0.5 && largest < HUGE_VAL)
        (void)frexp(largest, &exponent), exponent += 1;
    return exponent;
}

/* product[n][width] = a[n][inner] b[inner][width] */
static void multiply(size_t n, size_t inner, size_t width, const double *a, const double *b, double *product)
{
    memset(product, 0, n * width * sizeof *product);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < inner; ++k)
            for (size_t j = 0; j < width; ++j)
                product[i * width + j] += a[i * inner + k] * b[k * width + j];
}

static double binomial(size_t n, size_t k)
{
    double found = 1.0;
    for (size_t i = 1; i <= k; ++i)
        found = found * (double)(n - k + i) / (double)i;
    return found;
}

/* E and V over the part `size` of the step, by their series; term and next have room for either. */
static void series(size_t n, const double *loop, const double *powers, double size, double *E, double *V,
                   double *term, double *next)
{
    memset(E, 0, n * n * sizeof *E);
    for (size_t i = 0; i < n; ++i)
        E[i * n + i] = 1.0;
    memcpy(term, E, n * n * sizeof *E);
    for (int l = 1; l <= TERMS; ++l) {
        multiply(n, n, n, loop, term, next);
        for (size_t i = 0; i < n * n; ++i)
            E[i] += term[i] = next[i] * (size / l);
    }
    memset(V, 0, n * RF_NODES * sizeof *V);
    memset(term, 0, n * RF_NODES * sizeof *term);
    double power = 1.0; /* of size, to the number of the term */
    for (size_t l = 0; l <= TERMS; ++l, power *= size) {
        multiply(n, n, RF_NODES, loop, term, next);
        for (size_t i = 0; i < n; ++i)
            for (size_t k = 0; k < RF_NODES; ++k) {
                double pushed = next[i * RF_NODES + k];
                if (k + l < RF_NODES)
                    pushed += power * binomial(k + l, l) * powers[i * RF_NODES + k + l];
                V[i * RF_NODES + k] += term[i * RF_NODES + k] = pushed * (size / (double)(l + 1));
            }
    }
}

/* The chain over the part `size`: from 1 at number k, s^j binom(j, k) at number j. */
static void carry(double size, double *N)
{
    memset(N, 0, RF_NODES * RF_NODES * sizeof *N);
    for (size_t j = 0; j < RF_NODES; ++j) {
        double power = 1.0;
        for (size_t k = j + 1; k-- > 0; power *= size)
            N[j * RF_NODES + k] = power * binomial(j, k);
    }
}

void rf_chain(size_t n, const double *loop, const double *powers, double *y, double *work)
{
    double *E = work, *next = E + n * n, *term = next + n * n + n * RF_NODES, *V = term + n * n + n * RF_NODES;
    double N[RF_NODES * RF_NODES];
    const int squarings = squarings_of(n, loop);
    double size = ldexp(1.0, -squarings);
    series(n, loop, powers, size, E, V, term, next);
    for (int s = 0; s < squarings; ++s, size *= 2.0) {
        carry(size, N);
        multiply(n, RF_NODES, RF_NODES, V, N, term);
        multiply(n, n, RF_NODES, E, V, next);
        for (size_t i = 0; i < n * RF_NODES; ++i)
            V[i] = next[i] + term[i];
        multiply(n, n, n, E, E, next);
        memcpy(E, next, n * n * sizeof *E);
    }
    for (size_t i = 0; i < n; ++i)
        y[i] = V[i * RF_NODES];
}
