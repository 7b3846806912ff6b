#include "ring_losses.h"

#include <math.h>
#include <stdlib.h>

#include "streamers.h"

#define MOST_STARTS 1000 /* times that the film is solved while its first nodes are shut */
#define EXCESS 1e-9      /* of the flow that a film may take beyond what arrives */

double rf_flow_out_of_ends(const rf_levels *film)
{
    const rf_grid *grid = &film->ring->grids[0];
    const size_t last = grid->nodes - 1;
    double rest = 1.0, flow = 0.0;
    for (size_t j = 0; j < grid->nodes; ++j)
        rest -= grid->width[j];
    for (size_t i = 0; i < grid->lines; ++i) {
        const size_t at = i * grid->nodes + last;
        const double inward = film->cells[0].along[at] * film->pressure[at];
        const double made = film->source[at] / grid->width[last] * rest;
        if (film->pressure[at] > 0.0 && (size_t)grid->held[i] <= last)
            flow += fmax(inward + made, 0.0);
    }
    return flow;
}

/* Follow the oil once around, from streamers that fill the gap, and then once more. */
static void add_shear(rf_stream *oil, double *film, double *streamers)
{
    for (size_t j = 0; j < oil->grid->nodes; ++j)
        oil->brought[j] = 2.0;
    for (int round = 0; round < 2; ++round) {
        *film = *streamers = 0.0;
        size_t i = 0;
        for (size_t k = 0; k < oil->grid->lines; ++k, i = rf_next_line(oil, i, 1))
            rf_cross_cells(oil, i, film, streamers);
    }
}

/* Shut every node at which the film takes more than the oil brings; return whether there was one. */
static int shut_starts(rf_stream *oil, rf_levels *film)
{
    const size_t nodes = oil->grid->nodes;
    int shut = 0;
    for (size_t j = 0; j < nodes; ++j)
        oil->brought[j] = 2.0;
    size_t i = 0;
    for (size_t k = 0; k < 2 * oil->grid->lines; ++k, i = rf_next_line(oil, i, 1)) {
        const size_t last = rf_next_line(oil, i, 0);
        const double in = oil->face[rf_next_face(oil, i, 0)].thickness, out = oil->face[rf_next_face(oil, i, 1)].thickness;
        for (size_t j = 0; j < nodes; ++j) {
            const size_t at = i * nodes + j;
            if (j < rf_held(oil, i)) {
                oil->brought[j] = oil->line[i].thickness;
            } else if (rf_is_film(oil, at)) {
                const double taken = oil->rate * in * oil->grid->width[j] + rf_drawn(oil, i, j, 0);
                const double come = oil->rate * oil->brought[j] * oil->grid->width[j];
                if (k >= oil->grid->lines && j >= rf_held(oil, last) && !rf_is_film(oil, last * nodes + j)
                    && taken > come * (1.0 + EXCESS)) {
                    film->held[at] = 1;
                    shut = 1;
                }
                oil->brought[j] = out;
            } else {
                double share[3];
                rf_reach(oil, i, j, share);
                oil->brought[j] += (share[0] + share[2]) * (out - in);
            }
        }
    }
    return shut;
}

/* What runs out of and into the opening at line i, through the face after it in the direction of the oil or, with 0,
   the one before it. */
static void cross_edge(const rf_stream *oil, size_t i, int after, double *out, double *in)
{
    const size_t nodes = oil->grid->nodes, beside = rf_next_line(oil, i, after);
    const double face = oil->face[rf_next_face(oil, i, after)].thickness;
    for (size_t j = rf_held(oil, beside); j < rf_held(oil, i); ++j) {
        const int film = rf_is_film(oil, beside * nodes + j);
        const double h = film ? face : after ? oil->line[i].thickness : fmin(oil->brought[j], face);
        const double run = oil->rate * h * oil->width[j], pressed = -rf_drawn(oil, i, j, after);
        const double flow = after ? run + pressed : pressed - run;
        *(flow > 0.0 ? out : in) += fabs(flow);
    }
}

/* The same through the end of an opening within the bearing. */
static void cross_end(const rf_stream *oil, size_t i, double *out, double *in)
{
    const size_t held = rf_held(oil, i), nodes = oil->grid->nodes;
    if (held == 0 || held == nodes)
        return;
    const double *p = oil->film->pressure + i * nodes + held;
    const double flow = oil->film->cells[0].along[i * nodes + held - 1] * (p[-1] - p[0]);
    *(flow > 0.0 ? out : in) += fabs(flow);
}

/* Nodes that are held on every line: 1 with a groove all round, else 0. */
static int32_t held_all_round(const rf_grid *grid)
{
    int32_t least = grid->held[0];
    for (size_t i = 1; i < grid->lines; ++i)
        least = grid->held[i] < least ? grid->held[i] : least;
    return least;
}

/* Openings begin where more nodes are held than all round. */
static int begins(const rf_grid *grid, size_t i, int32_t all_round)
{
    return grid->held[i] > all_round && grid->held[i > 0 ? i - 1 : grid->lines - 1] <= all_round;
}

static size_t openings_of(const rf_grid *grid)
{
    const int32_t all_round = held_all_round(grid);
    size_t count = all_round > 0;
    for (size_t i = 0; i < grid->lines; ++i)
        count += (size_t)begins(grid, i, all_round);
    return count;
}

/* The place of the opening at line i: in the order of their lines, the groove all round last. */
static size_t opening_at(const rf_grid *grid, size_t i, size_t openings)
{
    const int32_t all_round = held_all_round(grid);
    const size_t runs = openings - (all_round > 0);
    size_t opening = 0; /* the first one begins with line 0 */
    for (size_t q = 1; q <= i; ++q)
        opening += (size_t)begins(grid, q, all_round);
    if (grid->held[i] <= all_round)
        return openings - 1;
    return opening % runs; /* the last one may end where the first begins */
}

/* The flows of the openings: `out` and `in` (openings) n apart. */
static void add_flows(rf_stream *oil, size_t n, size_t openings, double *out, double *in)
{
    const size_t lines = oil->grid->lines;
    for (size_t k = 0; k < openings; ++k)
        out[k * n] = in[k * n] = 0.0;
    /* The thickness that arrives at each line is known after a turn. */
    size_t i = 0;
    for (size_t k = 0; k < 2 * lines; ++k, i = rf_next_line(oil, i, 1)) {
        double ignored = 0.0, also = 0.0;
        if (k >= lines && rf_held(oil, i) > 0) {
            const size_t at = n * opening_at(oil->grid, i, openings);
            cross_edge(oil, i, 0, &out[at], &in[at]);
            cross_edge(oil, i, 1, &out[at], &in[at]);
            cross_end(oil, i, &out[at], &in[at]);
        }
        rf_cross_cells(oil, i, &ignored, &also);
    }
}

/* Whether streamers from openings decide where a film begins. Openings that end within the bearing feed the film beyond
   their end from the side: there it begins where Reynolds' equation says. */
static int is_fed(const rf_grid *grid)
{
    int fed = 0, ends = 0;
    for (size_t i = 0; i < grid->lines; ++i) {
        fed |= grid->held[i] > 0;
        ends |= grid->held[i] > 0 && (size_t)grid->held[i] < grid->nodes;
    }
    return fed && !ends;
}

static int solve(rf_stream *oil, rf_levels *film, const double *q, const double *drive)
{
    const int fed = is_fed(oil->grid) && film->ring->ruptured;
    double f[RF_FREEDOMS];
    rf_place_journal(film, q);
    rf_place_stream(oil, q);
    int status = rf_solve_down_to(film, 0, drive);
    for (int k = 0; fed && k < MOST_STARTS && status == RF_OK && shut_starts(oil, film); ++k)
        status = rf_solve_again(film);
    rf_take_force(film, f);
    return status;
}

int rf_ring_losses(const rf_ring *ring, size_t n, const double *e, const double *w, const double *rate, double *losses,
                   size_t *first)
{
    rf_levels film;
    rf_stream oil;
    oil.line = NULL;
    int status = rf_open_levels(&film, ring);
    if (status == RF_OK)
        status = rf_open_stream(&oil, &film);
    const size_t openings = openings_of(ring->grids);
    *first = 0;
    for (size_t i = 0; i < n && status == RF_OK; ++i) {
        const double q[RF_FREEDOMS] = {e[i], e[n + i], 0.0, 0.0};
        const double drive[RF_DRIVES] = {w[i], w[n + i], 0.0, 0.0, rate[i]};
        *first = i;
        status = rf_judge_state(ring, q, drive);
        if (status != RF_OK)
            break;
        oil.rate = fabs(rate[i]);
        oil.backward = rate[i] < 0.0;
        status = solve(&oil, &film, q, drive);
        add_shear(&oil, &losses[i], &losses[n + i]);
        losses[2 * n + i] = rf_flow_out_of_ends(&film);
        add_flows(&oil, n, openings, &losses[RF_RING_LOSSES * n + i],
                  &losses[(RF_RING_LOSSES + openings) * n + i]);
    }
    free(oil.line);
    rf_close_levels(&film);
    return status;
}
