#include "short_kernel.h"

#include <math.h>

#include "map_frame.h"

#define CENTER 1e-8   /* eccentricity ratio below which w = 0 has a derivative, by isotropy */
#define OPENING 0.25  /* (q/a)^2 below which a negative a needs the series */
#define TERMS 28      /* of it: OPENING^TERMS is roundoff */
#define PI 3.14159265358979323846

/* I and its derivatives. */
typedef struct integral {
    double i, a, b, aa, ab, bb;
} integral;

/* With a = -A the leading terms of t = atan(q/A) cancel, and I = S(z)/A^3, z = (q/A)^2, with
   S = sum (-z)^j (4 j + 4)/((2 j + 3)(2 j + 5)). */
static integral opening(double a, double b, double z)
{
    double s = 0.0, s1 = 0.0, s2 = 0.0;
    for (int j = TERMS; j >= 0; --j) { /* Horner, with two derivatives */
        const double c = (j % 2 ? -4.0 : 4.0) * (j + 1) / ((2.0 * j + 3.0) * (2.0 * j + 5.0));
        s2 = s2 * z + 2.0 * s1;
        s1 = s1 * z + s;
        s = s * z + c;
    }
    const double p = -1.0 / a, p3 = p * p * p, p4 = p3 * p, p5 = p4 * p, y = 2.0 * (1.0 + z);
    const double t = 3.0 * s + y * s1, t1 = 5.0 * s1 + y * s2;
    const integral at = {p3 * s,
                         p4 * t,
                         -2.0 * b * p5 * s1,
                         p5 * (4.0 * t + y * t1),
                         -2.0 * b * p5 * p * t1,
                         p5 * (4.0 * b * b * p * p * s2 - 2.0 * s1)};
    return at;
}

static integral closed(double a, double b, double q2)
{
    const double q = sqrt(q2), t = atan2(q, -a), c = 1.0 - b * b, r = 1.0 / q2, a2 = a * a, b2 = b * b;
    const double q3 = r / q, q5 = q3 * r, q7 = q5 * r, q9 = q7 * r, r2 = r * r, r3 = r2 * r, r4 = r3 * r;
    const double t_b = a * b / (q * c);
    const double t_bb = a / (q * c) + a * b2 * q3 / c + 2.0 * a * b2 / (q * c * c);
    const double g = q3 + 3.0 * a2 * q5, g_a = 9.0 * a * q5 + 15.0 * a2 * a * q7;
    const double g_b = 3.0 * b * q5 + 15.0 * a2 * b * q7;
    const double g_aa = 9.0 * q5 + 90.0 * a2 * q7 + 105.0 * a2 * a2 * q9;
    const double g_ab = 45.0 * a * b * q7 + 105.0 * a2 * a * b * q9;
    const double g_bb = 3.0 * q5 + 15.0 * (a2 + b2) * q7 + 105.0 * a2 * b2 * q9;
    const integral at = {t * g + 3.0 * a * r2,
                         t * g_a + 4.0 * r2 + 15.0 * a2 * r3,
                         t * g_b + t_b * g + 12.0 * a * b * r3,
                         t * g_aa + 55.0 * a * r3 + 105.0 * a2 * a * r4,
                         t * g_ab + t_b * g_a + 16.0 * b * r3 + 90.0 * a2 * b * r4,
                         t * g_bb + 2.0 * t_b * g_b + t_bb * g + 12.0 * a * r3 + 72.0 * a * b2 * r4};
    return at;
}

static integral integrate(double a, double b, double chi)
{
    const double q2 = (1.0 - chi) * (1.0 + chi);
    return a < 0.0 && q2 < OPENING * a * a ? opening(a, b, q2 / (a * a)) : closed(a, b, q2);
}

/* Without source: isotropic damping at the center, where I = pi/2, no derivative elsewhere. */
static int resting(double factor, double chi, double *f, double *jacobian)
{
    if (!jacobian || chi > CENTER)
        return rf_rest(f, jacobian);
    f[0] = f[1] = 0.0;
    for (int i = 0; i < 8; ++i)
        jacobian[i] = 0.0;
    jacobian[2] = jacobian[7] = -0.5 * PI * factor;
    return RF_OK;
}

int rf_short_film(const void *of, const double *e, const double *w, double *f, double *jacobian)
{
    const double factor = ((const rf_short *)of)->factor, k = -0.5 * factor;
    rf_frame at;
    const int status = rf_orient(e, w, &at);
    if (status == RF_UNDEFINED)
        return resting(factor, at.chi, f, jacobian);
    if (status != RF_OK)
        return rf_fail(status, f, jacobian, 8);
    const double a = at.chi * at.cos, b = at.chi * at.sin;
    const integral of_h = integrate(a, b, at.chi);
    /* Turning the source turns (a, b): a' = b, b' = -a. */
    const double turn = b * of_h.a - a * of_h.b;
    const double turn_a = b * of_h.aa - a * of_h.ab - of_h.b, turn_b = of_h.a + b * of_h.ab - a * of_h.bb;
    rf_set_force(&at, k * of_h.i, turn / of_h.i, f);
    if (jacobian) {
        const double s = k * at.size, turn_turn = b * turn_a - a * turn_b;
        const double by_e[4] = {2.0 * s * of_h.a, 2.0 * s * of_h.b, s * turn_a, s * turn_b};
        const double by_w[4] = {2.0 * k * of_h.i, k * turn, k * turn, k * (2.0 * of_h.i + turn_turn)};
        rf_set_columns(&at, at.nx, at.ny, by_e, 0, jacobian);
        rf_set_columns(&at, at.nx, at.ny, by_w, 2, jacobian);
    }
    return rf_judge(0.0, 1.0, f, jacobian);
}
