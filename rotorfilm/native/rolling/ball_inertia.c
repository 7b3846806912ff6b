#include "ball_inertia.h"

/* A number with its derivatives by the inner and the outer contact angle. */
typedef struct number {
    double value, inner, outer;
} number;

static number product(number a, number b)
{
    const number found = {a.value * b.value, a.inner * b.value + a.value * b.inner,
                          a.outer * b.value + a.value * b.outer};
    return found;
}

/* The orbit over the speed: no slip at both races, no spin at the controlling one. */
static number orbit_of(double g, int inertia, const double *ei, const double *eo)
{
    const double p = ei[0] * eo[1] - ei[1] * eo[0], q = ei[1] * eo[1] + ei[0] * eo[0], d = 1.0 + q;
    const int outer = inertia != RF_BALLS_INNER_CONTROL;
    const double n = outer ? 1.0 - g * ei[1] : q - g * eo[1], c = n / d;
    const number found = {c, ((outer ? g * ei[0] : -p) + c * p) / d, ((outer ? 0.0 : p + g * eo[0]) - c * p) / d};
    return found;
}

/* The spin about the radial direction over the speed; that about the shaft makes no moment. */
static number spin_of(double g, int inertia, const double *ei, const double *eo, number c)
{
    const number out = {eo[0] / g, 0.0, eo[1] / g}, in = {ei[0] / g, ei[1] / g, 0.0};
    const number left = {1.0 - c.value, -c.inner, -c.outer};
    return inertia != RF_BALLS_INNER_CONTROL ? product(c, out) : product(left, in);
}

static void scale(double factor, number from, double *to)
{
    to[0] = factor * from.value;
    to[1] = factor * from.inner;
    to[2] = factor * from.outer;
}

void rf_ball_inertia_at(const rf_ball_row *row, int inertia, const double *ei, const double *eo, double speed,
                        rf_ball_inertia *answer)
{
    const number c = orbit_of(row->ratio, inertia, ei, eo);
    const number s = spin_of(row->ratio, inertia, ei, eo, c);
    answer->orbit = c.value;
    const double unit = row->mass * row->diameter * speed * speed;
    scale(0.5 * unit / row->ratio, product(c, c), answer->force);
    scale(inertia == RF_BALLS_LOOSE ? 0.0 : -0.1 * unit, product(c, s), answer->moment);
}
