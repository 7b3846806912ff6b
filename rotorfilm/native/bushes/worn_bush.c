#include "worn_bush.h"

#include <math.h>

double rf_worn_pressure(const rf_worn_bush *m, size_t i)
{
    return m->profile.load[i] / (m->bush.is.compliance * m->profile.weight[i]);
}

int rf_worn_melts(const rf_worn_bush *m)
{
    return m->held >= m->bush.is.melting;
}

void rf_worn_press(rf_worn_bush *m, const double *x, const double *u)
{
    rf_bush_profile *p = &m->profile;
    const rf_bush *b = &m->bush;
    const double mx = u[0] + m->retardation * u[2], my = u[1] + m->retardation * u[3];
    for (size_t i = 0; i < p->n; ++i)
        p->depth[i] = (p->cosine[i] * mx + p->sine[i] * my - x[i]) / b->is.radius - m->gap;
    rf_bush_profile_press(p);
    const double a = fmax(p->angle, RF_LEAST_ANGLE), s = sin(a);
    m->friction = u[4] > 0.0 ? m->grip : u[4] < 0.0 ? -m->grip : 0.0;
    m->work = b->is.pressure_work * m->grip * fabs(u[4]);
    m->losses = rf_bush_losses(b, a, s, m->held);
    double segment, moment;
    rf_arc(a, s, cos(a), &segment, &moment);
    m->losses_slope = rf_bush_losses_slope(b, a, moment, m->held);
    const double total = p->total / b->is.compliance;
    m->kept = total > 0.0 && rf_worn_melts(m) ? fmax(m->work - 2.0 * a * m->losses / total, 0.0) : 0.0;
}

double rf_worn_rate(const rf_worn_bush *m, size_t i)
{
    const double own = rf_worn_melts(m) ? fmax(m->work * rf_worn_pressure(m, i) - m->losses, 0.0) : 0.0;
    return (m->local ? own : m->kept * rf_worn_pressure(m, i)) / m->bush.melting_heat;
}

void rf_worn_rate_slopes(const rf_worn_bush *m, size_t i, double *own, double *whole)
{
    const int on = m->local ? rf_worn_melts(m) && m->work * rf_worn_pressure(m, i) > m->losses : m->kept > 0.0;
    const double per = 1.0 / m->bush.melting_heat;
    *own = on ? per * (m->local ? m->work : m->kept) / (m->profile.weight[i] * m->bush.is.compliance) : 0.0;
    *whole = on ? per * (m->local ? 1.0 : rf_worn_pressure(m, i)) : 0.0;
}

double rf_worn_whole_change(const rf_worn_bush *m, double total, double angle)
{
    if (m->local)
        return -m->losses_slope * angle;
    const double Q = m->profile.total / m->bush.is.compliance, a = fmax(m->profile.angle, RF_LEAST_ANGLE);
    return 2.0 * (a * m->losses * total / (m->bush.is.compliance * Q) - (m->losses + a * m->losses_slope) * angle)
           / Q;
}
