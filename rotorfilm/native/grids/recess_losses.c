#include "recess_losses.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/map_frame.h"
#include "recess_pad.h"

#define MOST_STARTS 1000 /* times that the film is solved while its first nodes are shut */
#define EXCESS 1e-9      /* of the flow that a film may take beyond what arrives */

/* The oil on a pad in the direction in which it runs: places 0 .. lines are the lines, both edges among them, and
   stretch k lies between places k and k + 1. Of each node there is a part in the share of the recess, and one beside. */
typedef struct oil {
    rf_over_pad *at;
    int backward;
    double rate;
    double *thin[2];  /* nodes: thickness of what runs in each part */
    double *width[2]; /* nodes: of the parts, the last one with the half cell at the end */
} oil;

static size_t lines_of(const oil *of)
{
    return of->at->film.film.lines - RF_GAP_LINES;
}

static size_t nodes_of(const oil *of)
{
    return of->at->film.film.nodes;
}

/* The line at a place; behind the last one that of the gap. */
static size_t line_of(const oil *of, size_t place)
{
    const size_t line = of->backward ? lines_of(of) - place : place;
    return line < lines_of(of) ? RF_GAP_LINES + line : 0;
}

static size_t stretch_of(const oil *of, size_t stretch)
{
    return RF_GAP_LINES + (of->backward ? lines_of(of) - 1 - stretch : stretch);
}

static double angle_of(const oil *of, size_t place)
{
    return of->at->film.cells[0].theta[line_of(of, place)];
}

static double gap(const oil *of, size_t stretch, int part, double angle)
{
    const rf_over_pad *at = of->at;
    const double depth = part == 0 ? rf_depth_behind(&at->film.cells[0], stretch_of(of, stretch)) : 0.0;
    return 1.0 + depth - at->q[0] * cos(angle) - at->q[1] * sin(angle);
}

static double face_gap(const oil *of, size_t stretch, int part)
{
    return gap(of, stretch, part, of->at->film.cells[0].face[stretch_of(of, stretch)]);
}

static int is_edge(const oil *of, size_t place)
{
    return place == 0 || place == lines_of(of);
}

static double pressure(const oil *of, size_t place, size_t j)
{
    return is_edge(of, place) ? 0.0 : of->at->film.pressure[line_of(of, place) * nodes_of(of) + j];
}

/* Of the halves at the edges of the pad there is film where the next node has it. */
static int is_film(const oil *of, size_t place, size_t j)
{
    const size_t lines = lines_of(of);
    return pressure(of, place == 0 ? 1 : place == lines ? lines - 1 : place, j) > 0.0;
}

/* The pressure flow into the node at a place through the stretch before or, with 1, after it. */
static double drawn(const oil *of, size_t place, size_t j, int after)
{
    const size_t stretch = after ? place : place - 1, other = after ? place + 1 : place - 1;
    const double way = of->at->film.film.around[stretch_of(of, stretch) * nodes_of(of) + j];
    return way * (pressure(of, other, j) - pressure(of, place, j));
}

static double drawn_along(const oil *of, size_t place, size_t j)
{
    const size_t nodes = nodes_of(of), q = line_of(of, place) * nodes + j;
    const double *along = of->at->film.film.along, *p = of->at->film.pressure;
    const double inner = j > 0 ? along[q - 1] * (p[q - 1] - p[q]) : 0.0, outer = j + 1 < nodes ? p[q + 1] : 0.0;
    return inner + along[q] * (outer - p[q]);
}

/* Shares of an empty cell that the film reaches into: of oil that runs on with it, and of what comes back. */
static void reach(const oil *of, size_t place, size_t j, double share[2])
{
    const double taken = -of->at->film.source[line_of(of, place) * nodes_of(of) + j];
    const double with = drawn(of, place, j, 0) + fmax(drawn_along(of, place, j), 0.0);
    share[0] = taken > 0.0 ? fmin(with / taken, 1.0) : 0.0;
    share[1] = taken > 0.0 ? fmin(drawn(of, place, j, 1) / taken, 1.0 - share[0]) : 0.0;
}

/* By Simpson's rule. */
static void add_half(const oil *of, size_t stretch, int part, size_t j, double from, double full, double *sums)
{
    const double to = of->at->film.cells[0].face[stretch_of(of, stretch)], step = fabs(to - from) / 6.0, thin = of->thin[part][j];
    const double angles[3] = {from, 0.5 * (from + to), to}, weights[3] = {1.0, 4.0, 1.0};
    for (int k = 0; k < 3; ++k) {
        const double h = gap(of, stretch, part, angles[k]), share = fmin(thin / h, 1.0);
        const double per = of->width[part][j] * weights[k] * step / h;
        sums[0] += per * (full + (1.0 - full) * share);
        sums[1] += per;
    }
}

/* Follow the oil over the node at a place, and add its shear, and that of a full gap. */
static void cross(oil *of, size_t place, size_t j, double *sums)
{
    const size_t lines = lines_of(of);
    const int film = is_film(of, place, j);
    double share[2] = {0.0, 0.0};
    if (!film && !is_edge(of, place))
        reach(of, place, j, share);
    const double full = film ? 1.0 : share[0] + share[1], line = angle_of(of, place);
    for (int part = 0; part < 2; ++part) {
        double *thin = &of->thin[part][j];
        if (place == 0)
            *thin = gap(of, 0, part, line);
        if (film && place < lines)
            *thin = face_gap(of, place, part);
        else if (!film && !is_edge(of, place))
            *thin += share[0] * (face_gap(of, place, part) - face_gap(of, place - 1, part));
        if (place > 0)
            add_half(of, place - 1, part, j, line, full, sums);
        if (place < lines)
            add_half(of, place, part, j, line, full, sums);
    }
}

/* What runs over an edge in both parts: a film by its face, streamers as thick as they are. */
static double over_edge(const oil *of, size_t place, size_t j)
{
    const size_t stretch = place == 0 ? 0 : place - 1;
    const int film = is_film(of, place, j);
    double flow = film ? place == 0 ? drawn(of, 0, j, 1) : drawn(of, place, j, 0) : 0.0;
    flow = place == 0 ? -flow : flow; /* in the direction of the oil */
    for (int part = 0; part < 2; ++part) {
        const double face = face_gap(of, stretch, part), edge = gap(of, 0, part, angle_of(of, 0));
        const double streamers = place == 0 ? edge : fmin(of->thin[part][j], face);
        flow += of->rate * of->width[part][j] * (film ? face : streamers);
    }
    return flow;
}

/* Shut every node at which the film takes more than the oil brings; return whether there was one. */
static int shut_starts(oil *of)
{
    int shut = 0;
    for (size_t j = 0; j < nodes_of(of); ++j)
        for (size_t place = 0; place < lines_of(of); ++place) {
            double unused[2] = {0.0, 0.0};
            if (place > 1 && is_film(of, place, j) && !is_film(of, place - 1, j)) {
                double taken = drawn(of, place, j, 0), come = 0.0;
                for (int part = 0; part < 2; ++part) {
                    taken += of->rate * of->width[part][j] * face_gap(of, place - 1, part);
                    come += of->rate * of->width[part][j] * of->thin[part][j];
                }
                if (taken > come * (1.0 + EXCESS)) {
                    of->at->film.held[line_of(of, place) * nodes_of(of) + j] = 1;
                    shut = 1;
                }
            }
            cross(of, place, j, unused);
        }
    return shut;
}

/* Sigma of film and streamers and of a full gap, then the flows over both edges, of a film that is found. */
static int follow(rf_over_pad *at, double *row)
{
    const rf_grid *grid = &at->ring.grids[0];
    const size_t nodes = grid->nodes;
    const rf_cells *cells = &at->film.cells[0];
    double *memory = calloc(4 * nodes, sizeof(double));
    if (!memory)
        return RF_MEMORY;
    oil of = {at, at->drive[4] < 0.0, fabs(at->drive[4]), {memory, memory + nodes}, {memory + 2 * nodes, memory + 3 * nodes}};
    int status = RF_OK;
    for (size_t j = 0; j < nodes; ++j) {
        of.width[0][j] = cells->deep[j];
        of.width[1][j] = grid->width[j] - cells->deep[j];
    }
    of.width[grid->within < nodes][nodes - 1] += 0.5 / grid->conductance[nodes - 1];
    for (int k = 0; k < MOST_STARTS && status == RF_OK && shut_starts(&of); ++k)
        status = rf_solve_again(&at->film);
    memset(row, 0, 4 * sizeof(double));
    for (size_t j = 0; j < nodes && status == RF_OK; ++j) {
        row[2] += over_edge(&of, 0, j);
        for (size_t place = 0; place <= lines_of(&of); ++place)
            cross(&of, place, j, row);
        row[3] += over_edge(&of, lines_of(&of), j);
    }
    free(memory);
    return status;
}

static int take_pad(rf_over_pad *at, int moves, double *row)
{
    const int extrapolated = at->ring.extrapolated != 0;
    int status = RF_OK;
    row[0] = row[1] = row[2] = 0.0;
    for (int level = 1; level >= 0 && status == RF_OK; --level) {
        const double share = level == 0 ? extrapolated ? 4.0 / 3.0 : 1.0 : extrapolated ? -1.0 / 3.0 : 0.0;
        double products[RF_DRIVES];
        status = rf_solve_level(&at->film, level, at->drive);
        rf_multiply(&at->film.cells[level], at->film.pressure, products);
        row[0] -= 12.0 * share * products[0];
        row[1] -= 12.0 * share * products[1];
        row[2] += 12.0 * share * products[4];
    }
    if (status == RF_OK && moves) { /* shear and flow are those of the journal at rest in its place */
        at->drive[0] = at->drive[4] * at->q[1];
        at->drive[1] = -at->drive[4] * at->q[0];
        status = rf_solve_down_to(&at->film, 0, at->drive);
    }
    return status == RF_OK ? follow(at, row + 3) : status;
}

int rf_recess_losses(const rf_recess *bearing, const double *state, double *losses)
{
    int status = rf_is_broken(state, 5) ? RF_NOT_FINITE : RF_OK;
    for (size_t k = 0; k < bearing->count && status == RF_OK; ++k) {
        rf_over_pad at;
        status = rf_open_pad(&at, bearing, bearing->pads + k, state);
        if (status == RF_OK)
            status = take_pad(&at, state[2] != 0.0 || state[3] != 0.0, losses + RF_RECESS_LOSSES * k);
        rf_close_pad(&at);
    }
    return status;
}
