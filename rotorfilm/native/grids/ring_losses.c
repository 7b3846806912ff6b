#include "ring_losses.h"

#include <math.h>
#include <stdlib.h>

#include "../films/quintic.h"

#define MOST_STARTS 1000 /* times that the film is solved while its first nodes are shut */
#define EXCESS 1e-9      /* of the flow that a film may take beyond what arrives */
#define PI 3.14159265358979323846

double rf_flow_out_of_ends(const rf_search *search, const rf_grid *grid)
{
    const size_t last = grid->nodes - 1;
    double rest = 1.0, flow = 0.0;
    for (size_t j = 0; j < grid->nodes; ++j)
        rest -= grid->width[j];
    for (size_t i = 0; i < grid->lines; ++i) {
        const size_t at = i * grid->nodes + last;
        const double inward = search->cells[0].along[i] * grid->conductance[last] * search->pressure[at];
        const double made = search->source[at] / grid->width[last] * rest;
        if (search->pressure[at] > 0.0 && !grid->held[i])
            flow += fmax(inward + made, 0.0);
    }
    return flow;
}

/* The gap at an angle, and the integrals of 1/H and 1/H^2 from the line of maximum film. */
typedef struct section {
    double thickness, film, square;
} section;

/* One state, seen in the direction in which the oil runs. */
typedef struct stream {
    const rf_search *search;
    const rf_grid *grid;
    section *line;      /* N: at the lines */
    section *face;      /* N: behind each line, in the order of the grid */
    double *brought;    /* M: thickness of what runs in each row */
    double *width;      /* M: of the cells, the last one with the half cell at the end */
    double rate, turn;  /* of the oil, without its sign; of all integrals of 1/H */
    double square_turn; /* the same of 1/H^2 */
    int backward;
} stream;

static section section_at(const double *e, double chi, double angle)
{
    const double away = chi > 0.0 ? atan2(-e[1], -e[0]) : 0.0, t = remainder(angle - away, 2.0 * PI);
    const double gap = (1.0 - chi) * (1.0 + chi), h = 1.0 + chi * cos(t);
    const double bent = atan2(sqrt((1.0 - chi) / (1.0 + chi)) * sin(0.5 * t), cos(0.5 * t));
    const double film = 2.0 * bent / sqrt(gap);
    const section at = {h, film, (film - chi * sin(t) / h) / gap};
    return at;
}

static void place_stream(stream *oil, const double *e)
{
    const rf_grid *grid = oil->grid;
    const double chi = rf_length(e[0], e[1]), gap = (1.0 - chi) * (1.0 + chi);
    oil->turn = 2.0 * PI / sqrt(gap);
    oil->square_turn = oil->turn / gap;
    for (size_t i = 0; i < grid->lines; ++i) {
        oil->face[i] = section_at(e, chi, oil->search->cells[0].face[i]);
        oil->line[i] = section_at(e, chi, oil->search->cells[0].theta[i]);
    }
}

static size_t before(const stream *oil, size_t i)
{
    return i > 0 ? i - 1 : oil->grid->lines - 1;
}

/* The line that the oil meets after or, with 0, before this one. */
static size_t next_line(const stream *oil, size_t i, int after)
{
    return (after != 0) != oil->backward ? (i + 1 < oil->grid->lines ? i + 1 : 0) : before(oil, i);
}

/* The face between a line and the one that the oil meets after or before it. */
static size_t next_face(const stream *oil, size_t i, int after)
{
    return (after != 0) != oil->backward ? i : before(oil, i);
}

static int is_film(const stream *oil, size_t at)
{
    return oil->search->ring->clipped ? oil->search->pressure[at] > 0.0 : oil->search->free[at];
}

/* The pressure flow through the face after or before a node, towards it. */
static double drawn(const stream *oil, size_t i, size_t j, int after)
{
    const size_t nodes = oil->grid->nodes, face = next_face(oil, i, after);
    const double *p = oil->search->pressure;
    return oil->search->cells[0].around[face] * oil->grid->width[j] * (p[next_line(oil, i, after) * nodes + j]
                                                                       - p[i * nodes + j]);
}

/* The pressure flow into a node along the film. */
static double drawn_along(const stream *oil, size_t i, size_t j)
{
    const size_t nodes = oil->grid->nodes, at = i * nodes + j;
    const double *p = oil->search->pressure, *c = oil->grid->conductance, along = oil->search->cells[0].along[i];
    const double inner = j > 0 ? c[j - 1] * (p[at - 1] - p[at]) : 0.0;
    return along * (inner + (j + 1 < nodes ? c[j] * (p[at + 1] - p[at]) : 0.0));
}

/* Shares of an empty cell that the film reaches into: from upstream, from downstream and from the side. Where its
   source takes away what flows in, the film has its edge. */
static void reach(const stream *oil, size_t i, size_t j, double share[3])
{
    const double taken = -oil->search->source[i * oil->grid->nodes + j];
    const double inflow[3] = {drawn(oil, i, j, 0), drawn(oil, i, j, 1), drawn_along(oil, i, j)};
    double left = oil->search->ring->ruptured ? 1.0 : 0.0;
    for (int k = 0; k < 3; ++k) {
        share[k] = taken > 0.0 ? fmin(fmax(inflow[k] / taken, 0.0), left) : 0.0;
        left -= share[k];
    }
}

/* Integrals from one place on the ring to the next. */
static section over(const stream *oil, const section *from, const section *to)
{
    section at = {0.0, to->film - from->film, to->square - from->square};
    if (at.film < 0.0) {
        at.film += oil->turn;
        at.square += oil->square_turn;
    }
    return at;
}

/* Those over the half of a cell that the oil meets after or before its line. */
static section over_half(const stream *oil, size_t i, int after)
{
    const section *face = &oil->face[next_face(oil, i, after)], *line = &oil->line[i];
    return (after != 0) != oil->backward ? over(oil, line, face) : over(oil, face, line);
}

/* Whether the gap between a line and the one after or before it is an opening. */
static int opens(const stream *oil, size_t i, int after)
{
    return oil->grid->held[next_line(oil, i, after)] && oil->grid->held[i];
}

/* What a held line adds: the halves of its cell that are no opening, behind it full of oil. */
static void cross_line(stream *oil, size_t i, double *film, double *streamers)
{
    const double h = oil->line[i].thickness;
    for (size_t j = 0; j < oil->grid->nodes; ++j) {
        for (int after = 0; after < 2; ++after) {
            const section half = over_half(oil, i, after);
            const int full = is_film(oil, next_line(oil, i, after) * oil->grid->nodes + j);
            const double thin = after ? h : oil->brought[j];
            if (!opens(oil, i, after))
                *(full ? film : streamers) += oil->width[j] * (!full && thin < h ? thin * half.square : half.film);
        }
        oil->brought[j] = h;
    }
}

/* Follow the oil over the cells of a line, and add their shear. */
static void cross_cells(stream *oil, size_t i, double *film, double *streamers)
{
    const section cell = over(oil, &oil->face[before(oil, i)], &oil->face[i]);
    const double in = oil->face[next_face(oil, i, 0)].thickness, out = oil->face[next_face(oil, i, 1)].thickness;
    for (size_t j = 0; j < oil->grid->nodes; ++j) {
        double share[3] = {1.0, 0.0, 0.0};
        if (is_film(oil, i * oil->grid->nodes + j)) {
            oil->brought[j] = out;
        } else {
            reach(oil, i, j, share);
            oil->brought[j] += (share[0] + share[2]) * (out - in);
        }
        const double full = share[0] + share[1] + share[2], h = oil->line[i].thickness, thin = oil->brought[j];
        *film += oil->width[j] * full * cell.film;
        *streamers += oil->width[j] * (1.0 - full) * (thin < h ? thin * cell.square : cell.film);
    }
}

/* Follow the oil once around, from streamers that fill the gap, and then once more. */
static void add_shear(stream *oil, double *film, double *streamers)
{
    for (size_t j = 0; j < oil->grid->nodes; ++j)
        oil->brought[j] = 2.0;
    for (int round = 0; round < 2; ++round) {
        *film = *streamers = 0.0;
        size_t i = 0;
        for (size_t k = 0; k < oil->grid->lines; ++k, i = next_line(oil, i, 1))
            if (oil->grid->held[i])
                cross_line(oil, i, film, streamers);
            else
                cross_cells(oil, i, film, streamers);
    }
}

/* Shut every node at which the film takes more than the oil brings; return whether there was one. */
static int shut_starts(stream *oil, rf_search *search)
{
    const size_t nodes = oil->grid->nodes;
    int shut = 0;
    for (size_t j = 0; j < nodes; ++j)
        oil->brought[j] = 2.0;
    size_t i = 0;
    for (size_t k = 0; k < 2 * oil->grid->lines; ++k, i = next_line(oil, i, 1)) {
        const size_t last = next_line(oil, i, 0);
        const double in = oil->face[next_face(oil, i, 0)].thickness, out = oil->face[next_face(oil, i, 1)].thickness;
        for (size_t j = 0; j < nodes; ++j) {
            const size_t at = i * nodes + j;
            if (oil->grid->held[i]) {
                oil->brought[j] = oil->line[i].thickness;
            } else if (is_film(oil, at)) {
                const double taken = oil->rate * in * oil->grid->width[j] + drawn(oil, i, j, 0);
                const double come = oil->rate * oil->brought[j] * oil->grid->width[j];
                if (k >= oil->grid->lines && !oil->grid->held[last] && !is_film(oil, last * nodes + j)
                    && taken > come * (1.0 + EXCESS)) {
                    search->shut[at] = 1;
                    shut = 1;
                }
                oil->brought[j] = out;
            } else {
                double share[3];
                reach(oil, i, j, share);
                oil->brought[j] += (share[0] + share[2]) * (out - in);
            }
        }
    }
    return shut;
}

/* What runs out of and into the opening at line i, through the face after it in the direction of the oil or, with 0,
   the one before it. */
static void cross_edge(const stream *oil, size_t i, int after, double *out, double *in)
{
    const size_t nodes = oil->grid->nodes, beside = next_line(oil, i, after);
    const double face = oil->face[next_face(oil, i, after)].thickness;
    for (size_t j = 0; j < nodes; ++j) {
        const int film = is_film(oil, beside * nodes + j);
        const double h = film ? face : after ? oil->line[i].thickness : fmin(oil->brought[j], face);
        const double run = oil->rate * h * oil->width[j], pressed = -drawn(oil, i, j, after);
        const double flow = after ? run + pressed : pressed - run;
        *(flow > 0.0 ? out : in) += fabs(flow);
    }
}

/* The flows of the openings, in the order of their lines: `out` and `in` (openings) n apart. */
static void add_flows(stream *oil, size_t n, size_t openings, double *out, double *in)
{
    const size_t nodes = oil->grid->nodes, lines = oil->grid->lines;
    for (size_t k = 0; k < openings; ++k)
        out[k * n] = in[k * n] = 0.0;
    /* The thickness that arrives at each line is known after a turn. */
    size_t i = 0;
    for (size_t k = 0; k < 2 * lines; ++k, i = next_line(oil, i, 1)) {
        double ignored = 0.0, also = 0.0;
        if (!oil->grid->held[i]) {
            cross_cells(oil, i, &ignored, &also);
            continue;
        }
        size_t opening = 0; /* the first one begins with line 0 */
        for (size_t q = 1; q <= i; ++q)
            opening += oil->grid->held[q] && !oil->grid->held[q - 1];
        opening %= openings; /* the last one may end where the first begins */
        for (int after = 0; after < 2 && k >= lines; ++after)
            if (!opens(oil, i, after))
                cross_edge(oil, i, after, &out[opening * n], &in[opening * n]);
        for (size_t j = 0; j < nodes; ++j)
            oil->brought[j] = oil->line[i].thickness;
    }
}

static size_t openings_of(const rf_grid *grid)
{
    size_t count = 0;
    for (size_t i = 0; i < grid->lines; ++i)
        count += grid->held[i] && !grid->held[i > 0 ? i - 1 : grid->lines - 1];
    return count;
}

static int solve(stream *oil, rf_search *search, const double *e, const double *w)
{
    const int fed = openings_of(oil->grid) > 0 && search->ring->ruptured;
    rf_place_journal(search, e);
    place_stream(oil, e);
    for (size_t q = 0; q < oil->grid->lines * oil->grid->nodes; ++q)
        search->shut[q] = 0;
    int status = rf_search_down_to(search, 0, w);
    for (int k = 0; fed && k < MOST_STARTS && status == RF_OK && shut_starts(oil, search); ++k)
        status = rf_search_without(search);
    for (size_t q = 0; search->ring->clipped && q < oil->grid->lines * oil->grid->nodes; ++q)
        search->pressure[q] = fmax(search->pressure[q], 0.0);
    return status;
}

static int open_stream(stream *oil, const rf_search *search)
{
    const rf_grid *grid = search->ring->grids;
    double rest = 1.0;
    oil->search = search;
    oil->grid = grid;
    oil->line = malloc(2 * grid->lines * sizeof(section) + 2 * grid->nodes * sizeof(double));
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

int rf_ring_losses(const rf_ring *ring, size_t n, const double *e, const double *w, const double *rate, double *losses,
                   size_t *first)
{
    rf_search search;
    stream oil;
    oil.line = NULL;
    int status = rf_open_search(&search, ring);
    if (status == RF_OK)
        status = open_stream(&oil, &search);
    const size_t openings = openings_of(ring->grids);
    *first = 0;
    for (size_t i = 0; i < n && status == RF_OK; ++i) {
        const double here[2] = {e[i], e[n + i]}, source[2] = {w[i], w[n + i]};
        *first = i;
        status = rf_judge_state(here, source);
        if (status != RF_OK)
            break;
        oil.rate = fabs(rate[i]);
        oil.backward = rate[i] < 0.0;
        status = solve(&oil, &search, here, source);
        add_shear(&oil, &losses[i], &losses[n + i]);
        losses[2 * n + i] = rf_flow_out_of_ends(&search, oil.grid);
        add_flows(&oil, n, openings, &losses[RF_RING_LOSSES * n + i],
                  &losses[(RF_RING_LOSSES + openings) * n + i]);
    }
    free(oil.line);
    rf_close_search(&search);
    return status;
}
