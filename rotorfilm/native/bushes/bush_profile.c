#include "bush_profile.h"

#include <math.h>
#include <string.h>

void rf_bush_profile_nodes(rf_bush_profile *p, double center, double extent)
{
    p->step = extent / (double)(p->closed ? p->n : p->n - 1);
    for (size_t i = 0; i < p->n; ++i) {
        const double angle = center - 0.5 * extent + p->step * (double)i;
        p->cosine[i] = cos(angle);
        p->sine[i] = sin(angle);
        p->weight[i] = !p->closed && (i == 0 || i == p->n - 1) ? 0.5 * p->step : p->step;
    }
}

void rf_bush_profile_press(rf_bush_profile *p)
{
    const size_t n = p->n, bytes = n * sizeof(double);
    memset(p->load, 0, bytes);
    memset(p->diagonal, 0, bytes);
    memset(p->beside, 0, bytes);
    memset(p->angle_slope, 0, bytes);
    p->angle = p->total = 0.0;
    for (size_t i = 0; i < (p->closed ? n : n - 1); ++i) {
        const size_t next = i + 1 < n ? i + 1 : 0;
        const int swap = p->depth[next] > p->depth[i];
        const size_t up = swap ? next : i, down = swap ? i : next; /* the deeper node first */
        const double high = p->depth[up], low = p->depth[down];
        if (!(high > 0.0))
            continue;
        const int partial = low < 0.0;
        const double part = partial ? high / (high - low) : 1.0, square = part * part;
        /* Integrals over the part s = 0 ... part in contact of (1 - s)^2, s (1 - s) and s^2. */
        const double near = p->step * (part - square + square * part / 3.0),
                     far = p->step * square * part / 3.0, cross = p->step * (0.5 * square) - far;
        p->diagonal[up] += near;
        p->diagonal[down] += far;
        p->beside[i] = cross;
        p->load[up] += near * high + cross * low;
        p->load[down] += far * low + cross * high;
        p->angle += 0.5 * p->step * part;
        if (partial) {
            const double scale = 0.5 * p->step / high;
            p->angle_slope[up] += scale * part * (1.0 - part);
            p->angle_slope[down] += scale * square;
        }
    }
    for (size_t i = 0; i < n; ++i)
        p->total += p->load[i];
}

double rf_bush_profile_stiffness(const rf_bush_profile *p, const double *change, double *load)
{
    double sum = 0.0;
    for (size_t i = 0; i < p->n; ++i)
        load[i] = p->diagonal[i] * change[i];
    for (size_t i = 0; i < p->n; ++i) {
        const size_t next = i + 1 < p->n ? i + 1 : 0; /* nothing is beside the last node of an open arc */
        load[i] += p->beside[i] * change[next];
        load[next] += p->beside[i] * change[i];
    }
    for (size_t i = 0; i < p->n; ++i)
        sum += load[i];
    return sum;
}
