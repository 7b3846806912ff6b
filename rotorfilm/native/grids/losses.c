#include "losses.h"

#include <math.h>
#include <stdlib.h>

#include "../films/quintic.h"

#define MOST_STARTS 1000 /* times that the film is solved while its first nodes are shut */
#define EXCESS 1e-9      /* of the flow that a film may take beyond what arrives */
#define UNIT 1e-9        /* distance that |e| keeps from 1 */
#define PI 3.14159265358979323846

/* The gap at an angle on land, and the integrals of 1/H and 1/H^2 from the line of maximum film. */
typedef struct section {
    double thickness, film, square;
} section;

/* One half of a cell: the integrals over it on land, and the gap at its line, middle and face in each part, the
   integral of 1/H there, and the factor of the shear. */
typedef struct half {
    section over;
    double step, gap[2][3], whole[2], factor[2];
} half;

/* One state, seen in the direction in which the oil runs. A row of nodes has two parts where there is a recess: that
   within its share of the length, and the land beside it. */
typedef struct stream {
    rf_levels *film;
    const rf_grid *grid;
    const rf_cells *cells;
    const double *q, *pressure;
    section *line, *face; /* N: at the lines, and behind each line, in the order of the grid */
    double *brought[2];   /* M: thickness of what runs in each part of a row, land first */
    double *width[2];     /* M: of the parts, the last one with the half cell at the end */
    double rate, turn;    /* of the oil, without its sign; of all integrals of 1/H */
    double square_turn;   /* the same of 1/H^2 */
    int parts, backward;
    int stepped;          /* whether it is a pad that may have steps: lines rest, shear is by Simpson's rule */
} stream;

static int open_stream(stream *oil, rf_levels *film)
{
    const rf_grid *grid = film->ring->grids;
    const size_t nodes = grid->nodes;
    double rest = 1.0;
    oil->film = film;
    oil->grid = grid;
    oil->cells = film->cells;
    oil->pressure = film->pressure;
    oil->parts = film->ring->recess >= 0 ? 2 : 1;
    oil->stepped = film->ring->resting;
    oil->line = malloc(2 * grid->lines * sizeof(section) + 4 * nodes * sizeof(double));
    if (!oil->line)
        return RF_MEMORY;
    oil->face = oil->line + grid->lines;
    double *next = (double *)(oil->face + grid->lines);
    for (int part = 0; part < 2; ++part, next += 2 * nodes) {
        oil->brought[part] = next;
        oil->width[part] = next + nodes;
    }
    for (size_t j = 0; j < nodes; ++j) {
        oil->width[1][j] = oil->parts == 2 ? oil->cells->deep[j] : 0.0;
        oil->width[0][j] = grid->width[j] - oil->width[1][j];
        rest -= grid->width[j];
    }
    oil->width[oil->parts == 2 && grid->within >= nodes][nodes - 1] += rest;
    return RF_OK;
}

/* |e|, not quite 1: a journal on a pad may cross the unit circle, where the integrals below are limits. */
static double off_unit(const double *e)
{
    const double chi = rf_length(e[0], e[1]);
    return fabs(chi - 1.0) > UNIT ? chi : chi < 1.0 ? 1.0 - UNIT : 1.0 + UNIT;
}

/* Beyond the unit circle, where a pad has a film, its angle from the maximum film does not wrap. */
static section section_at(const double *e, double chi, double angle)
{
    const double away = chi > 0.0 ? atan2(-e[1], -e[0]) : 0.0, t = remainder(angle - away, 2.0 * PI);
    const double gap = (1.0 - chi) * (1.0 + chi), h = 1.0 + chi * cos(t);
    const double root = sqrt(fabs((1.0 - chi) / (1.0 + chi)));
    const double bent = gap > 0.0 ? atan2(root * sin(0.5 * t), cos(0.5 * t)) : atanh(root * tan(0.5 * t));
    const double film = 2.0 * bent / sqrt(fabs(gap));
    const section at = {h, film, (film - chi * sin(t) / h) / gap};
    return at;
}

static void place_stream(stream *oil, const double *q)
{
    const double chi = off_unit(q), gap = (1.0 - chi) * (1.0 + chi);
    oil->turn = gap > 0.0 ? 2.0 * PI / sqrt(gap) : 0.0;
    oil->square_turn = oil->turn / gap;
    for (size_t i = 0; i < oil->grid->lines; ++i) {
        oil->face[i] = section_at(q, chi, oil->cells->face[i]);
        oil->line[i] = section_at(q, chi, oil->cells->theta[i]);
    }
}

/* A factor of the mobility where the gap is H. */
static double factor_at(const stream *oil, rf_factor which, double H)
{
    const rf_mobility *mobility = &oil->film->ring->mobility;
    double slope;
    return mobility->cells > 0 ? rf_ease(mobility, which, oil->cells->growth * rf_eased_at(mobility, H), &slope) : 1.0;
}

/* The rate at which oil runs along a gap H. */
static double run(const stream *oil, double H)
{
    return oil->film->ring->mobility.drags ? oil->rate * factor_at(oil, RF_OF_DRAG, H) : oil->rate;
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

/* How many nodes of a line are held, from the middle of the bearing. */
static size_t held_on(const stream *oil, size_t i)
{
    return (size_t)oil->grid->held[i];
}

static int is_film(const stream *oil, size_t at)
{
    return oil->film->ring->clipped ? oil->pressure[at] > 0.0 : oil->film->full[at];
}

/* How deep a part is at the face after or before a line. */
static double depth(const stream *oil, size_t i, int part, int after)
{
    return part == 1 ? rf_depth_behind(oil->cells, next_face(oil, i, after)) : 0.0;
}

/* The gap of a part there, and at the line itself on the side of that face. */
static double face_gap(const stream *oil, size_t i, int part, int after)
{
    return oil->face[next_face(oil, i, after)].thickness + depth(oil, i, part, after);
}

static double line_gap(const stream *oil, size_t i, int part, int after)
{
    return oil->line[i].thickness + depth(oil, i, part, after);
}

/* The pressure flow through the face after or before a node, towards it. */
static double drawn(const stream *oil, size_t i, size_t j, int after)
{
    const size_t nodes = oil->grid->nodes;
    const double *p = oil->pressure, way = oil->cells->around[next_face(oil, i, after) * nodes + j];
    return way * (p[next_line(oil, i, after) * nodes + j] - p[i * nodes + j]);
}

/* The pressure flow into a node along the film. */
static double drawn_along(const stream *oil, size_t i, size_t j)
{
    const size_t nodes = oil->grid->nodes, at = i * nodes + j;
    const double *p = oil->pressure, *along = oil->cells->along;
    const double inner = j > 0 ? along[at - 1] * (p[at - 1] - p[at]) : 0.0;
    return inner + (j + 1 < nodes ? along[at] * (p[at + 1] - p[at]) : 0.0);
}

/* Shares of an empty cell that the film reaches into: from upstream, from downstream and from the side. Where its
   source takes away what flows in, the film has its edge. */
static void reach(const stream *oil, size_t i, size_t j, double share[3])
{
    const double taken = -oil->film->source[i * oil->grid->nodes + j];
    const double inflow[3] = {drawn(oil, i, j, 0), drawn(oil, i, j, 1), drawn_along(oil, i, j)};
    double left = oil->film->ring->ruptured ? 1.0 : 0.0;
    for (int m = 0; m < 3; ++m) {
        const int k = oil->stepped && m ? 3 - m : m;
        share[k] = taken > 0.0 ? fmin(fmax(inflow[k] / taken, 0.0), left) : 0.0;
        left -= share[k];
    }
}

/* The gap of each part at the face before a line, at the one after it, and at the line on that side. */
typedef struct gaps {
    double in[2], out[2], line[2];
} gaps;

static gaps gaps_at(const stream *oil, size_t i)
{
    gaps at;
    for (int part = 0; part < oil->parts; ++part) {
        at.in[part] = face_gap(oil, i, part, 0);
        at.out[part] = face_gap(oil, i, part, 1);
        at.line[part] = line_gap(oil, i, part, 1);
    }
    return at;
}

/* Take the oil of a row over a node, and tell how much of its cell is film. An opening fills the gap. */
static double carry(stream *oil, const gaps *at, size_t i, size_t j)
{
    double share[3] = {1.0, 0.0, 0.0};
    if (j < held_on(oil, i)) {
        for (int part = 0; part < oil->parts; ++part)
            oil->brought[part][j] = at->line[part];
        return 0.0;
    }
    const int film = is_film(oil, i * oil->grid->nodes + j);
    if (!film)
        reach(oil, i, j, share);
    for (int part = 0; part < oil->parts; ++part) {
        double *brought = &oil->brought[part][j];
        *brought = film ? at->out[part] : *brought + (share[0] + share[2]) * (at->out[part] - at->in[part]);
    }
    return share[0] + share[1] + share[2];
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

/* The integral over one half of what streamers of a thickness fill of 1/H; of a step by Simpson's rule. */
static double sheared(const stream *oil, const half *at, size_t i, int part, double thin)
{
    if (!oil->stepped)
        return thin < oil->line[i].thickness ? thin * at->over.square : at->over.film;
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
        sum += (k == 1 ? 4.0 : 1.0) * fmin(thin / at->gap[part][k], 1.0) / at->gap[part][k];
    return at->step * sum;
}

/* The half of the cells of a line that the oil meets after or before it. */
static half half_at(const stream *oil, size_t i, int after)
{
    const size_t k = next_face(oil, i, after);
    const section *face = &oil->face[k], *line = &oil->line[i];
    const double from = oil->cells->theta[i], to = oil->cells->face[k];
    half at;
    for (int part = 0; part < 2; ++part)
        at.factor[part] = factor_at(oil, RF_OF_SHEAR, line_gap(oil, i, part, after));
    at.over = (after != 0) != oil->backward ? over(oil, line, face) : over(oil, face, line);
    at.whole[0] = at.over.film;
    if (!oil->stepped)
        return at;
    const double middle = 0.5 * (from + to), within = 1.0 - oil->q[0] * cos(middle) - oil->q[1] * sin(middle);
    at.step = fabs(to - from) / 6.0;
    for (int part = 0; part < 2; ++part) {
        at.gap[part][0] = line_gap(oil, i, part, after);
        at.gap[part][1] = within + depth(oil, i, part, after);
        at.gap[part][2] = face_gap(oil, i, part, after);
        at.whole[part] = sheared(oil, &at, i, part, HUGE_VAL);
    }
    return at;
}

/* Add one half of a cell, of which oil fills a share. */
static void add_half(const stream *oil, const half *at, size_t i, int part, double width, double full, double thin,
                     rf_pad_oil *sums)
{
    const double wide = width * at->factor[part], whole = wide * at->whole[part];
    sums->film += full * whole;
    sums->gap += whole;
    if (full < 1.0)
        sums->streamers += wide * (1.0 - full) * sheared(oil, at, i, part, thin);
}

/* Width of a part of row j that is an opening, where the first `held` nodes of a line are: up to the last of them. */
static double open_width(const stream *oil, size_t j, int part, size_t held)
{
    const int inside = j + 1 == held && held < oil->grid->nodes;
    return j < held ? oil->width[part][j] - (inside ? 0.5 / oil->grid->conductance[j] : 0.0) : 0.0;
}

/* What a node in an opening or at its edge adds: the parts of its cell that are no opening, behind it full of oil. */
static void cross_held(stream *oil, const half halves[2], size_t i, size_t j, rf_pad_oil *sums)
{
    for (int part = 0; part < oil->parts; ++part) {
        for (int after = 0; after < 2; ++after) {
            const size_t beside = next_line(oil, i, after), its = held_on(oil, beside), own = held_on(oil, i);
            const size_t held = its < own ? its : own;
            const int full = j < held || is_film(oil, beside * oil->grid->nodes + j);
            const double width = oil->width[part][j] - open_width(oil, j, part, held);
            if (after)
                oil->brought[part][j] = line_gap(oil, i, part, 1);
            if (width > 0.0) /* in the opening beside a pad there may be no gap */
                add_half(oil, &halves[after], i, part, width, full, oil->brought[part][j], sums);
        }
    }
}

/* Follow the oil over the cells of a line, and add their shear. */
static void cross_cells(stream *oil, size_t i, rf_pad_oil *sums)
{
    const half halves[2] = {half_at(oil, i, 0), half_at(oil, i, 1)};
    const gaps at = gaps_at(oil, i);
    for (size_t j = 0; j < oil->grid->nodes; ++j) {
        if (j < held_on(oil, i)) {
            cross_held(oil, halves, i, j, sums);
            continue;
        }
        const double full = carry(oil, &at, i, j);
        for (int part = 0; part < oil->parts; ++part)
            for (int after = 0; after < 2; ++after)
                add_half(oil, &halves[after], i, part, oil->width[part][j], full, oil->brought[part][j], sums);
    }
}

static void fill(stream *oil)
{
    for (int part = 0; part < 2; ++part)
        for (size_t j = 0; j < oil->grid->nodes; ++j)
            oil->brought[part][j] = 2.0;
}

/* Follow the oil once around, from streamers that fill the gap, and then once more. */
static void add_shear(stream *oil, rf_pad_oil *sums)
{
    static const rf_pad_oil none = {0.0, 0.0, 0.0, 0.0, 0.0};
    fill(oil);
    for (int round = 0; round < 2; ++round) {
        *sums = none;
        size_t i = 0;
        for (size_t k = 0; k < oil->grid->lines; ++k, i = next_line(oil, i, 1))
            cross_cells(oil, i, sums);
    }
}

/* Whether the film that begins at a node takes more than the oil brings. */
static int starves(const stream *oil, const gaps *at, size_t i, size_t j)
{
    double taken = drawn(oil, i, j, 0), come = 0.0;
    for (int part = 0; part < oil->parts; ++part) {
        const double width = oil->stepped ? oil->width[part][j] : oil->grid->width[j];
        taken += run(oil, at->in[part]) * width * at->in[part];
        come += run(oil, at->in[part]) * width * oil->brought[part][j];
    }
    return taken > come * (1.0 + EXCESS);
}

/* Shut every such node; return whether there was one. */
static int shut_starts(stream *oil)
{
    const size_t nodes = oil->grid->nodes, lines = oil->grid->lines;
    int shut = 0;
    fill(oil);
    size_t i = 0;
    for (size_t k = 0; k < 2 * lines; ++k, i = next_line(oil, i, 1)) {
        const size_t last = next_line(oil, i, 0);
        const gaps at = gaps_at(oil, i);
        for (size_t j = 0; j < nodes; ++j) {
            const size_t q = i * nodes + j;
            const int starts = k >= lines && j >= held_on(oil, i) && is_film(oil, q) && j >= held_on(oil, last)
                               && !is_film(oil, last * nodes + j);
            if (starts && starves(oil, &at, i, j))
                shut = oil->film->held[q] = 1;
            carry(oil, &at, i, j);
        }
    }
    return shut;
}

/* Take the oil over all nodes of a line. */
static void pass(stream *oil, size_t i)
{
    const gaps at = gaps_at(oil, i);
    for (size_t j = 0; j < oil->grid->nodes; ++j)
        carry(oil, &at, i, j);
}

/* What runs out of and into the opening at line i, through the face after it in the direction of the oil or, with 0,
   the one before it. */
static void cross_edge(const stream *oil, size_t i, int after, double *out, double *in)
{
    const size_t nodes = oil->grid->nodes, beside = next_line(oil, i, after);
    for (size_t j = held_on(oil, beside); j < held_on(oil, i); ++j) {
        double come = 0.0;
        for (int part = 0; part < oil->parts; ++part) {
            const double face = face_gap(oil, i, part, after);
            const double thin = after ? line_gap(oil, i, part, 1) : fmin(oil->brought[part][j], face);
            come += run(oil, face) * oil->width[part][j] * (is_film(oil, beside * nodes + j) ? face : thin);
        }
        const double pressed = -drawn(oil, i, j, after), flow = after ? come + pressed : pressed - come;
        *(flow > 0.0 ? out : in) += fabs(flow);
    }
}

/* The same through the end of an opening within the bearing. */
static void cross_end(const stream *oil, size_t i, double *out, double *in)
{
    const size_t held = held_on(oil, i), nodes = oil->grid->nodes;
    if (held == 0 || held == nodes)
        return;
    const double *p = oil->pressure + i * nodes + held;
    const double flow = oil->cells->along[i * nodes + held - 1] * (p[-1] - p[0]);
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
static void add_flows(stream *oil, size_t n, size_t openings, double *out, double *in)
{
    const size_t lines = oil->grid->lines;
    for (size_t k = 0; k < openings; ++k)
        out[k * n] = in[k * n] = 0.0;
    /* The thickness that arrives at each line is known after a turn. */
    size_t i = 0;
    for (size_t k = 0; k < 2 * lines; ++k, i = next_line(oil, i, 1)) {
        if (k >= lines && held_on(oil, i) > 0) {
            const size_t at = n * opening_at(oil->grid, i, openings);
            cross_edge(oil, i, 0, &out[at], &in[at]);
            cross_edge(oil, i, 1, &out[at], &in[at]);
            cross_end(oil, i, &out[at], &in[at]);
        }
        pass(oil, i);
    }
}

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

static int solve(stream *oil, const double *q, const double *drive)
{
    rf_levels *film = oil->film;
    const int fed = is_fed(oil->grid) && film->ring->ruptured;
    double f[RF_FREEDOMS];
    oil->q = q;
    oil->rate = fabs(drive[4]);
    oil->backward = drive[4] < 0.0;
    int status = rf_solve_down_to(film, 0, drive);
    for (int k = 0; fed && k < MOST_STARTS && status == RF_OK && shut_starts(oil); ++k)
        status = rf_solve_again(film);
    rf_take_force(film, f);
    return status;
}

int rf_ring_losses(const rf_ring *ring, size_t n, const double *e, const double *w, const double *rate, double *losses,
                   size_t *first)
{
    rf_levels film;
    stream oil;
    oil.line = NULL;
    int status = rf_open_levels(&film, ring);
    film.keeps = 1;
    if (status == RF_OK)
        status = open_stream(&oil, &film);
    const size_t openings = openings_of(ring->grids);
    *first = 0;
    for (size_t i = 0; i < n && status == RF_OK; ++i) {
        const double q[RF_FREEDOMS] = {e[i], e[n + i], 0.0, 0.0};
        const double drive[RF_DRIVES] = {w[i], w[n + i], 0.0, 0.0, rate[i]};
        rf_pad_oil sums;
        *first = i;
        status = rf_judge_state(ring, q, drive);
        if (status != RF_OK)
            break;
        if (i == 0 || e[i] != e[i - 1] || e[n + i] != e[n + i - 1] || rf_is_sped(ring)) {
            rf_place_journal(&film, q, rate[i]);
            place_stream(&oil, q);
        }
        status = solve(&oil, q, drive);
        add_shear(&oil, &sums);
        losses[i] = sums.film;
        losses[n + i] = sums.streamers;
        losses[2 * n + i] = rf_flow_out_of_ends(&film);
        add_flows(&oil, n, openings, &losses[RF_RING_LOSSES * n + i],
                  &losses[(RF_RING_LOSSES + openings) * n + i]);
    }
    free(oil.line);
    rf_close_levels(&film);
    return status;
}

int rf_follow_pad(rf_levels *film, const double *q, const double *drive, rf_pad_oil *sums)
{
    stream oil;
    int status = open_stream(&oil, film);
    if (status == RF_OK) {
        place_stream(&oil, q);
        status = solve(&oil, q, drive);
    }
    if (status == RF_OK) {
        double out[2] = {0.0, 0.0}, in[2] = {0.0, 0.0};
        size_t i = 0;
        add_shear(&oil, sums);
        for (size_t k = 0; k < oil.grid->lines; ++k, i = next_line(&oil, i, 1)) {
            for (int after = 0; after < 2; ++after)
                cross_edge(&oil, i, after, &out[after], &in[after]);
            pass(&oil, i);
        }
        sums->leaving = in[0] - out[0];
        sums->entering = out[1] - in[1];
    }
    free(oil.line);
    return status;
}
