#include "streamers.h"

#include <math.h>
#include <stdlib.h>

#include "../films/quintic.h"

#define UNIT 1e-9 /* distance that |e| keeps from 1 */
#define PI 3.14159265358979323846

/* |e|, not quite 1: a journal on a pad may cross the unit circle, where the integrals below are limits. */
static double off_unit(const double *e)
{
    const double chi = rf_length(e[0], e[1]);
    return fabs(chi - 1.0) > UNIT ? chi : chi < 1.0 ? 1.0 - UNIT : 1.0 + UNIT;
}

/* Beyond the unit circle, where a pad has a film, its angle from the maximum film does not wrap. */
static rf_section section_at(const double *e, double chi, double angle)
{
    const double away = chi > 0.0 ? atan2(-e[1], -e[0]) : 0.0, t = remainder(angle - away, 2.0 * PI);
    const double gap = (1.0 - chi) * (1.0 + chi), h = 1.0 + chi * cos(t), root = sqrt(fabs((1.0 - chi) / (1.0 + chi)));
    const double bent = gap > 0.0 ? atan2(root * sin(0.5 * t), cos(0.5 * t)) : atanh(root * tan(0.5 * t));
    const double film = 2.0 * bent / sqrt(fabs(gap));
    const rf_section at = {h, film, (film - chi * sin(t) / h) / gap, 1.0};
    return at;
}

void rf_place_stream(rf_stream *oil, const double *e)
{
    const rf_grid *grid = oil->grid;
    const rf_ring *ring = oil->film->ring;
    const double chi = off_unit(e), gap = (1.0 - chi) * (1.0 + chi);
    oil->turn = gap > 0.0 ? 2.0 * PI / sqrt(gap) : 0.0;
    oil->square_turn = oil->turn / gap;
    for (size_t i = 0; i < grid->lines; ++i) {
        oil->face[i] = section_at(e, chi, oil->film->cells[0].face[i]);
        oil->line[i] = section_at(e, chi, oil->film->cells[0].theta[i]);
        if (ring->mobility) {
            double factor[3], slope[3];
            ring->mobility(ring->mobile, oil->line[i].thickness, factor, slope);
            oil->line[i].sheared = factor[2];
        }
    }
}

static size_t before(const rf_stream *oil, size_t i)
{
    return i > 0 ? i - 1 : oil->grid->lines - 1;
}

size_t rf_next_line(const rf_stream *oil, size_t i, int after)
{
    return (after != 0) != oil->backward ? (i + 1 < oil->grid->lines ? i + 1 : 0) : before(oil, i);
}

size_t rf_next_face(const rf_stream *oil, size_t i, int after)
{
    return (after != 0) != oil->backward ? i : before(oil, i);
}

size_t rf_held(const rf_stream *oil, size_t i)
{
    return (size_t)oil->grid->held[i];
}

int rf_is_film(const rf_stream *oil, size_t at)
{
    return oil->film->ring->clipped ? oil->film->pressure[at] > 0.0 : oil->film->full[at];
}

double rf_drawn(const rf_stream *oil, size_t i, size_t j, int after)
{
    const size_t nodes = oil->grid->nodes, face = rf_next_face(oil, i, after);
    const double *p = oil->film->pressure;
    return oil->film->cells[0].around[face * nodes + j] * (p[rf_next_line(oil, i, after) * nodes + j] - p[i * nodes + j]);
}

/* The pressure flow into a node along the film. */
static double drawn_along(const rf_stream *oil, size_t i, size_t j)
{
    const size_t nodes = oil->grid->nodes, at = i * nodes + j;
    const double *p = oil->film->pressure, *along = oil->film->cells[0].along;
    const double inner = j > 0 ? along[at - 1] * (p[at - 1] - p[at]) : 0.0;
    return inner + (j + 1 < nodes ? along[at] * (p[at + 1] - p[at]) : 0.0);
}

void rf_reach(const rf_stream *oil, size_t i, size_t j, double share[3])
{
    const double taken = -oil->film->source[i * oil->grid->nodes + j];
    const double inflow[3] = {rf_drawn(oil, i, j, 0), rf_drawn(oil, i, j, 1), drawn_along(oil, i, j)};
    double left = oil->film->ring->ruptured ? 1.0 : 0.0;
    for (int k = 0; k < 3; ++k) {
        share[k] = taken > 0.0 ? fmin(fmax(inflow[k] / taken, 0.0), left) : 0.0;
        left -= share[k];
    }
}

/* Integrals from one place on the ring to the next. */
static rf_section over(const rf_stream *oil, const rf_section *from, const rf_section *to)
{
    rf_section at = {0.0, to->film - from->film, to->square - from->square, 1.0};
    if (at.film < 0.0) {
        at.film += oil->turn;
        at.square += oil->square_turn;
    }
    return at;
}

/* Those over the half of a cell that the oil meets after or before its line. */
static rf_section over_half(const rf_stream *oil, size_t i, int after)
{
    const rf_section *face = &oil->face[rf_next_face(oil, i, after)], *line = &oil->line[i];
    return (after != 0) != oil->backward ? over(oil, line, face) : over(oil, face, line);
}

/* Width of row j that is an opening, where the first `held` nodes of a line are: up to the last of them. */
static double open_width(const rf_stream *oil, size_t j, size_t held)
{
    const int inside = j + 1 == held && held < oil->grid->nodes;
    return j < held ? oil->width[j] - (inside ? 0.5 / oil->grid->conductance[j] : 0.0) : 0.0;
}

/* What a node in an opening or at its edge adds: the parts of its cell that are no opening, behind it full of oil. */
static void cross_held(rf_stream *oil, size_t i, size_t j, double *film, double *streamers)
{
    const double h = oil->line[i].thickness;
    for (int after = 0; after < 2; ++after) {
        const size_t beside = rf_next_line(oil, i, after), its = rf_held(oil, beside), own = rf_held(oil, i);
        const size_t held = its < own ? its : own;
        const rf_section half = over_half(oil, i, after);
        const int full = j < held || rf_is_film(oil, beside * oil->grid->nodes + j);
        const double thin = after ? h : oil->brought[j];
        const double width = (oil->width[j] - open_width(oil, j, held)) * oil->line[i].sheared;
        if (width > 0.0) /* in the opening beside a pad there may be no gap */
            *(full ? film : streamers) += width * (!full && thin < h ? thin * half.square : half.film);
    }
    oil->brought[j] = h;
}

static void cross_free(rf_stream *oil, size_t i, size_t j, double *film, double *streamers)
{
    const rf_section cell = over(oil, &oil->face[before(oil, i)], &oil->face[i]);
    const double in = oil->face[rf_next_face(oil, i, 0)].thickness, out = oil->face[rf_next_face(oil, i, 1)].thickness;
    double share[3] = {1.0, 0.0, 0.0};
    if (rf_is_film(oil, i * oil->grid->nodes + j)) {
        oil->brought[j] = out;
    } else {
        rf_reach(oil, i, j, share);
        oil->brought[j] += (share[0] + share[2]) * (out - in);
    }
    const double full = share[0] + share[1] + share[2], h = oil->line[i].thickness, thin = oil->brought[j];
    const double width = oil->width[j] * oil->line[i].sheared;
    *film += width * full * cell.film;
    *streamers += width * (1.0 - full) * (thin < h ? thin * cell.square : cell.film);
}

void rf_cross_cells(rf_stream *oil, size_t i, double *film, double *streamers)
{
    for (size_t j = 0; j < oil->grid->nodes; ++j)
        (j < rf_held(oil, i) ? cross_held : cross_free)(oil, i, j, film, streamers);
}

int rf_open_stream(rf_stream *oil, const rf_levels *film)
{
    const rf_grid *grid = film->ring->grids;
    double rest = 1.0;
    oil->film = film;
    oil->grid = grid;
    oil->line = malloc(2 * grid->lines * sizeof(rf_section) + 2 * grid->nodes * sizeof(double));
    if (!oil->line)
        return RF_MEMORY;
    oil->face = oil->line + grid->lines;
    oil->brought = (double *)(oil->face + grid->lines);
    oil->width = oil->brought + grid->nodes;
    for (size_t j = 0; j < grid->nodes; ++j) {
        oil->width[j] = grid->width[j];
        rest -= grid->width[j];
    }
    oil->width[grid->nodes - 1] += rest;
    return RF_OK;
}
