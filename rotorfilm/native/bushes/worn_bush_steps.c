#include "worn_bush.h"

#include <math.h>
#include <string.h>

#define TYPICAL_PRESSURE 4e-2 /* in shear moduli */
#define TOLERANCE 1e-10       /* of the local error, relative to each depth and to a typical one */
#define MOST_PARTS 2000

/* The matrix I - h A at the last contact: A = D K + g r^T, K of tridiagonal form but for one element of a closed
   arc, which is left out. Extrapolation does not ask for the exact A. */
typedef struct matrix {
    double *lower, *middle, *upper, *g, *r, *z; /* z = (I - h D K)^-1 g */
    double share;
} matrix;

static void eliminate(size_t n, const matrix *a, double *v)
{
    for (size_t i = 1; i < n; ++i)
        v[i] -= a->lower[i] * v[i - 1];
    for (size_t i = n; i-- > 0;)
        v[i] = (v[i] - (i + 1 < n ? a->upper[i] * v[i + 1] : 0.0)) / a->middle[i];
}

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

/* g and r of the last contact; lower and upper are the entries of h D K for h = 1 afterwards. */
static void take_slopes(const rf_worn_bush *m, matrix *a)
{
    const rf_bush_profile *p = &m->profile;
    const double per = -1.0 / m->bush.is.radius;
    for (size_t i = 0; i < p->n; ++i) {
        const size_t before = i ? i - 1 : p->n - 1;
        a->r[i] = p->total > 0.0 ? rf_worn_whole_change(m, per * (p->diagonal[i] + p->beside[i] + p->beside[before]),
                                                per * p->angle_slope[i])
                                 : 0.0;
    }
}

static void factor(const rf_worn_bush *m, double h, matrix *a)
{
    const rf_bush_profile *p = &m->profile;
    for (size_t i = 0; i < p->n; ++i) {
        double own;
        rf_worn_rate_slopes(m, i, &own, a->g + i);
        own *= h / m->bush.is.radius;
        a->middle[i] = 1.0 + own * p->diagonal[i];
        a->upper[i] = own * p->beside[i];
        a->lower[i] = i ? own * p->beside[i - 1] / a->middle[i - 1] : 0.0;
        a->middle[i] -= i ? a->lower[i] * a->upper[i - 1] : 0.0;
    }
    memcpy(a->z, a->g, p->n * sizeof(double));
    eliminate(p->n, a, a->z);
    const double rest = 1.0 - h * dot(p->n, a->r, a->z);
    a->share = rest > 0.1 ? h / rest : 0.0;
}

/* v becomes (I - h A)^-1 v. */
static void solve(size_t n, const matrix *a, double *v)
{
    eliminate(n, a, v);
    const double more = a->share * dot(n, a->r, v);
    for (size_t i = 0; i < n; ++i)
        v[i] += more * a->z[i];
}

/* Root mean square of the difference in tolerances. */
static double difference(const rf_worn_bush *m, const double *a, const double *b)
{
    const double typical = m->bush.is.radius * m->bush.is.compliance * TYPICAL_PRESSURE;
    double sum = 0.0;
    for (size_t i = 0; i < m->profile.n; ++i) {
        const double share = (a[i] - b[i]) / (TOLERANCE * (typical + fabs(a[i])));
        sum += share * share;
    }
    return sqrt(sum / (double)m->profile.n);
}

/* One step by 1, 2, 3 ... linearly implicit Euler steps, extrapolated until two answers agree (Deuflhard 1985).
   The answer is left in table[row]; the error in tolerances is returned. */
static double extrapolate(rf_worn_bush *m, const double *x, const double *u, double h, int *rows)
{
    const size_t n = m->profile.n;
    double **const s = m->scratch, **const table = s + 8, *y = s[6], *move = s[7], error = HUGE_VAL;
    matrix a = {s[0], s[1], s[2], s[3], s[4], s[5], 0.0};
    for (int k = 0; k < RF_WEAR_ROWS; ++k) {
        const double part = h / (k + 1);
        rf_worn_press(m, x, u);
        take_slopes(m, &a);
        factor(m, part, &a);
        memcpy(y, x, n * sizeof *y);
        for (int j = 0; j <= k; ++j) {
            if (j)
                rf_worn_press(m, y, u);
            for (size_t i = 0; i < n; ++i)
                move[i] = part * rf_worn_rate(m, i);
            solve(n, &a, move);
            for (size_t i = 0; i < n; ++i)
                y[i] += move[i];
        }
        for (int j = 1; j <= k; ++j)
            for (size_t i = 0; i < n; ++i) {
                move[i] = table[j - 1][i]; /* in the end the last answer with one row less */
                table[j - 1][i] = y[i];
                y[i] += (y[i] - move[i]) * (double)(k + 1 - j) / (double)j;
            }
        memcpy(table[k], y, n * sizeof *y);
        *rows = k + 1;
        if (k && (error = difference(m, y, move)) <= 1.0)
            break;
    }
    return error;
}

int rf_worn_advance(rf_worn_bush *m, const double *u, double dt, double *x, rf_message *why)
{
    const size_t n = m->profile.n;
    double left = dt, h = dt;
    memcpy(m->scratch[RF_WEAR_WORK - 1], x, n * sizeof *x);
    for (int part = 0; part < MOST_PARTS && left > 0.0; ++part) {
        int rows;
        const double error = extrapolate(m, x, u, h, &rows);
        if (error <= 1.0) {
            for (size_t i = 0; i < n; ++i)
                x[i] = fmax(x[i], m->scratch[8 + rows - 1][i]); /* wear does not fall */
            left -= h;
        }
        const double most = error <= 1.0 ? (rows < RF_WEAR_ROWS ? 4.0 : 1.0) : 0.5;
        h = fmin(left, h * (error < HUGE_VAL ? fmin(fmax(0.8 * pow(error + 1e-30, -1.0 / rows), 0.1), most) : 0.1));
        if (left > 0.0 && !(h >= 1e-16 * left))
            break;
    }
    if (!(left > 0.0))
        return RF_OK;
    memcpy(x, m->scratch[RF_WEAR_WORK - 1], n * sizeof *x);
    return rf_say(why, RF_STUCK, "the wear cannot go on beyond %.9g of a step", 1.0 - left / dt);
}
