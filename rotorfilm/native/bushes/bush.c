#include "bush.h"

#include <math.h>
#include <string.h>

#define HALF_TURN 3.14159265358979323846
#define SERIES_LIMIT 0.5
#define TERMS 9

/* Of both functions by odd powers of a, from the third (bearings/bush/contact_arc.py). */
static const double SEGMENT[TERMS] = {2.0 / 3,      -2.0 / 15,       4.0 / 315,         -2.0 / 2835,
                                      4.0 / 155925, -4.0 / 6081075,  8.0 / 638512875,   -2.0 / 10854718875,
                                      4.0 / 1856156927625};
static const double MOMENT[TERMS] = {1.0 / 3,           -1.0 / 30,        1.0 / 840,
                                     -1.0 / 45360,      1.0 / 3991680,    -1.0 / 518918400,
                                     1.0 / 93405312000, -1.0 / 22230464256000, 1.0 / 6758061133824000};

void rf_arc(double a, double sin_a, double cos_a, double *segment, double *moment)
{
    const double square = a * a;
    double s = SEGMENT[TERMS - 1], m = MOMENT[TERMS - 1];
    for (int k = TERMS - 1; k-- > 0;) {
        s = s * square + SEGMENT[k];
        m = m * square + MOMENT[k];
    }
    *segment = a < SERIES_LIMIT ? s * square * a : a - sin_a * cos_a;
    *moment = a < SERIES_LIMIT ? m * square * a : sin_a - a * cos_a;
}

double rf_bush_friction(const rf_bush *b, double T)
{
    return b->friction[0] + T * (b->friction[1] + T * b->friction[2]);
}

double rf_bush_conductance(const rf_bush *b, double a)
{
    return (b->is.whole != 0.0 ? HALF_TURN / a : 1.0) * b->is.shaft + b->is.liner;
}

double rf_bush_losses(const rf_bush *b, double a, double sin_a, double temperature)
{
    return rf_bush_conductance(b, a) * temperature
           - b->is.liner * (b->outer[0] + b->outer[1] * sin_a / a);
}

double rf_bush_losses_slope(const rf_bush *b, double a, double moment, double temperature)
{
    const double share_slope = b->is.whole != 0.0 ? -HALF_TURN / (a * a) : 0.0;
    return share_slope * b->is.shaft * temperature + b->is.liner * b->outer[1] * moment / (a * a);
}

int rf_bush_tables(rf_bush *b, const rf_tables *tables, rf_message *why)
{
    enum { COUNT = sizeof b->is / sizeof(double) };
    const rf_table *table = rf_find_table(tables, "bush", 1, why);
    if (!table)
        return RF_INVALID;
    if (table->extent[0] != COUNT)
        return rf_say(why, RF_INVALID, "the table of a bush must have %d numbers, got %u", (int)COUNT,
                      (unsigned)table->extent[0]);
    memcpy(&b->is, table->numbers, sizeof b->is);
    b->gap = b->is.clearance - b->is.closing * b->is.melting;
    for (size_t i = 0; i < COUNT; ++i)
        if (!(table->numbers[i] >= 0.0))
            return rf_say(why, RF_INVALID, "number %zu of a bush must not be negative, got %.9g", i,
                          table->numbers[i]);
    if (b->gap > 0.0 && b->is.compliance > 0.0 && b->is.radius > 0.0 && b->is.force_unit > 0.0)
        return RF_OK;
    return rf_say(why, RF_INVALID, "a bush must keep a clearance at its melting point, got %.9g", b->gap);
}

int rf_bush_parameters(void *bush, const double *p, rf_message *why)
{
    rf_bush *b = bush;
    rf_bush next = *b;
    const double T = b->is.melting, f1 = p[RF_FRICTION + 1], f2 = p[RF_FRICTION + 2];
    const double inner = f2 > 0.0 ? fmin(fmax(-0.5 * f1 / f2, 0.0), T) : 0.0;
    memcpy(next.friction, p + RF_FRICTION, sizeof next.friction);
    memcpy(next.outer, p + RF_OUTER, sizeof next.outer);
    next.melting_heat = p[RF_MELTING_HEAT];
    next.grip = rf_bush_friction(&next, T);
    const double least = fmin(fmin(rf_bush_friction(&next, 0.0), rf_bush_friction(&next, inner)), next.grip);
    if (!(least > 0.0 && next.grip < HUGE_VAL))
        return rf_say(why, RF_INVALID, "friction must be positive up to the melting point, got %.9g", least);
    if (!(p[RF_OUTER + 1] >= 0.0 && p[RF_OUTER] + p[RF_OUTER + 1] < T))
        return rf_say(why, RF_INVALID,
                      "outer_mean + outer_swing must be below the melting point %.9g, got %.9g and %.9g", T,
                      p[RF_OUTER], p[RF_OUTER + 1]);
    if (!(p[RF_MELTING_HEAT] > 0.0 && p[RF_MELTING_HEAT] < HUGE_VAL))
        return rf_say(why, RF_INVALID, "melting_heat must be finite and positive, got %.9g",
                      p[RF_MELTING_HEAT]);
    *b = next;
    return RF_OK;
}
