#include "sector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../grids/search.h"

#define LEVELS 4 /* at most */

/* One grid of a pad at one place. */
typedef struct polar {
    const rf_sector *pad;
    const double *q;
    size_t step;         /* cells of the finest grid in one of this */
    size_t lines, nodes; /* without the edges of the pad */
    double *around, *along, *entry;    /* conductances */
    double *around_by, *along_by, *entry_by; /* their derivatives by the gap */
    double *shape[RF_SECTOR_ROWS];     /* of the source, by w */
    double *source, *pressure, *answer;
    uint8_t *held, *full, *known;
    int still; /* whether nothing drives the film */
    void *memory;
    rf_stencil film;
    rf_search search;
} polar;

static double angle_of(const polar *at, size_t i)
{
    return at->pad->angle[i * at->step];
}

static double radius_of(const polar *at, size_t j)
{
    return at->pad->radius[j * at->step];
}

static size_t before(const polar *at, size_t i)
{
    return i > 0 ? i - 1 : at->lines - 1;
}

/* The profile at a corner of a cell of this grid: of its cell of the finest one that is there. */
static double corner(const polar *at, size_t i, size_t c, int later, int outer)
{
    const size_t last = at->step - 1, line = i * at->step + (later ? last : 0), cell = c * at->step + (outer ? last : 0);
    return at->pad->profile[(line * at->pad->nodes + cell) * 4 + 2 * (size_t)later + (size_t)outer];
}

/* Cosine and sine of an angle. */
typedef struct way {
    double x, y;
} way;

static way way_at(double phi)
{
    const way found = {cos(phi), sin(phi)};
    return found;
}

static way way_of(const polar *at, size_t i)
{
    return way_at(angle_of(at, i));
}

/* Half-way to the next line. */
static way way_past(const polar *at, size_t i)
{
    return way_at(0.5 * (angle_of(at, i) + angle_of(at, i + 1)));
}

static double plane(const double *q, double r, way n)
{
    return q[0] + r * (q[1] * n.y - q[2] * n.x);
}

/* Conductance coefficient h^3 with its derivative, and the profile times a width. */
static void add_face(double gap, double coefficient, double *conductance, double *slope)
{
    *conductance += coefficient * gap * gap * gap;
    *slope += 3.0 * coefficient * gap * gap;
}

/* Conductances from line to line, and the Couette flow of g per w3 there; at the node of index j of the radii. */
static double set_around(polar *at, size_t i, size_t j, way face)
{
    const double r = radius_of(at, j), width = angle_of(at, i + 1) - angle_of(at, i);
    const double tilted = plane(at->q, r, face);
    const size_t node = i * at->nodes + j - 1;
    double flow = 0.0;
    at->around[node] = at->around_by[node] = 0.0;
    for (size_t c = j - 1; c <= j; ++c) {
        const int outer = c < j;
        const double half = 0.5 * (radius_of(at, c + 1) - radius_of(at, c));
        const double g = 0.5 * (corner(at, i, c, 0, outer) + corner(at, i, c, 1, outer));
        add_face(g + tilted, half / (12.0 * at->pad->viscosity * r * width), &at->around[node], &at->around_by[node]);
        flow += g * r * half;
    }
    return flow;
}

/* Conductance across one cell along a line, on both sides of it. */
static void set_along(polar *at, size_t i, size_t c, way n, double *conductance, double *slope)
{
    const double r = 0.5 * (radius_of(at, c) + radius_of(at, c + 1)), width = radius_of(at, c + 1) - radius_of(at, c);
    const double tilted = plane(at->q, r, n);
    *conductance = *slope = 0.0;
    for (int later = 0; later < 2; ++later) {
        const size_t k = later ? before(at, i) : i;
        const double half = 0.5 * (angle_of(at, k + 1) - angle_of(at, k));
        const double g = 0.5 * (corner(at, k, c, later, 0) + corner(at, k, c, later, 1));
        add_face(g + tilted, r * half / (12.0 * at->pad->viscosity * width), conductance, slope);
    }
}

static void set_line(polar *at, size_t i)
{
    const size_t k = before(at, i), m = at->nodes;
    const double span = 0.5 * (angle_of(at, i + 1) - angle_of(at, i) + angle_of(at, k + 1) - angle_of(at, k));
    const way n = way_of(at, i), face = way_past(at, i);
    set_along(at, i, 0, n, &at->entry[i], &at->entry_by[i]);
    for (size_t j = 0; j < m; ++j) {
        const size_t node = i * m + j;
        const double r = radius_of(at, j + 1), area = 0.5 * r * span * (radius_of(at, j + 2) - radius_of(at, j));
        set_along(at, i, j + 1, n, &at->along[node], &at->along_by[node]);
        at->shape[0][node] = -area;
        at->shape[1][node] = -area * r * n.y;
        at->shape[2][node] = area * r * n.x;
        const double flow = set_around(at, i, j + 1, face);
        at->shape[3][node] -= flow;
        at->shape[3][(i + 1 < at->lines ? i + 1 : 0) * m + j] += flow;
    }
}

static int open_grid(polar *at, const rf_sector *pad, const double *q)
{
    const size_t lines = pad->lines, nodes = pad->nodes - 1, all = lines * nodes;
    double *next = malloc((11 * all + 2 * lines) * sizeof(double) + 3 * all);
    memset(at, 0, sizeof *at);
    at->pad = pad;
    at->q = q;
    at->memory = next;
    if (!next)
        return RF_MEMORY;
    double **fields[] = {&at->around, &at->along, &at->around_by, &at->along_by, &at->shape[0], &at->shape[1],
                         &at->shape[2], &at->shape[3], &at->source, &at->pressure, &at->answer};
    for (size_t k = 0; k < 11; ++k, next += all)
        *fields[k] = next;
    at->entry = next;
    at->entry_by = next + lines;
    at->held = (uint8_t *)(next + 2 * lines);
    at->full = at->held + all;
    at->known = at->full + all;
    return rf_open_search(&at->search, lines, nodes);
}

static void close_grid(polar *at)
{
    rf_close_search(&at->search);
    free(at->memory);
}

static void set_grid(polar *at, int level)
{
    at->step = (size_t)1 << level;
    at->lines = at->pad->lines >> level;
    at->nodes = (at->pad->nodes >> level) - 1;
    memset(at->held, 0, at->lines * at->nodes);
    memset(at->pressure, 0, at->lines * at->nodes * sizeof(double));
    memset(at->shape[3], 0, at->lines * at->nodes * sizeof(double));
    for (size_t i = 0; i < at->lines; ++i)
        set_line(at, i);
    for (size_t j = 0; j < at->nodes && !at->pad->ring; ++j) {
        at->held[j] = 1;
        for (int k = 0; k < RF_SECTOR_ROWS; ++k)
            at->shape[k][j] = 0.0;
    }
}

/* Whether a node of the coarser grid is full; lines and nodes counted with those at the edges. */
static int was_full(const polar *at, size_t i, size_t j)
{
    const size_t nodes = (at->nodes + 1) / 2 - 1, lines = at->lines / 2;
    return j > 0 && j <= nodes && at->known[i % lines * nodes + j - 1];
}

static int solve_grid(polar *at, int level, const double *w)
{
    const size_t all = (at->pad->lines >> level) * ((at->pad->nodes >> level) - 1);
    const int first = level + 1 == at->pad->levels || !at->pad->ruptured;
    set_grid(at, level);
    for (size_t q = 0; q < all; ++q) {
        at->source[q] = 0.0;
        for (int k = 0; k < RF_SECTOR_ROWS; ++k)
            at->source[q] += w[k] * at->shape[k][q];
    }
    for (size_t i = 0; i < at->lines; ++i)
        for (size_t j = 1; j <= at->nodes; ++j)
            at->full[i * at->nodes + j - 1] = (uint8_t)(first || was_full(at, i / 2, j / 2) || was_full(at, (i + 1) / 2, j / 2)
                                            || was_full(at, i / 2, (j + 1) / 2) || was_full(at, (i + 1) / 2, (j + 1) / 2));
    at->still = 1;
    for (size_t q = 0; q < all && at->still; ++q)
        at->still = at->source[q] == 0.0;
    const rf_stencil film = {at->lines, at->nodes, at->around, at->along, at->entry, at->source, at->held};
    at->film = film;
    const int status = rf_search_film(&at->search, &at->film, at->pad->ruptured, at->pressure, at->full);
    memcpy(at->known, at->full, all);
    return status;
}

/* Solve down to the finest grid but `last`. */
static int solve_to(polar *at, int last, const double *w)
{
    int status = RF_OK;
    for (int level = at->pad->ruptured ? at->pad->levels - 1 : last; level >= last && status == RF_OK; --level)
        status = solve_grid(at, level, w);
    return status;
}

static double product(const polar *at, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t q = 0; q < at->lines * at->nodes; ++q)
        sum += a[q] * b[q];
    return sum;
}

static void add_bent(double weight, double r, way n, double *by)
{
    by[0] += weight;
    by[1] += weight * r * n.y;
    by[2] -= weight * r * n.x;
}

/* V.(dA/dq) p: what a change of the place does to the flows of the pressure, felt by the answer V. */
static void bend(const polar *at, const double *answer, double *by)
{
    const size_t m = at->nodes;
    const double *p = at->pressure;
    memset(by, 0, RF_SECTOR_PLACES * sizeof(double));
    for (size_t i = 0; i < at->lines; ++i) {
        const size_t here = i * m, next = i + 1 < at->lines ? here + m : 0;
        const way n = way_of(at, i), face = way_past(at, i);
        double outer = 0.5 * (radius_of(at, 0) + radius_of(at, 1));
        add_bent(at->entry_by[i] * p[here] * answer[here], outer, n, by);
        for (size_t j = 0; j < m; ++j) {
            const size_t a = here + j, b = next + j;
            const double dp = p[a] - (j + 1 < m ? p[a + 1] : 0.0), dv = answer[a] - (j + 1 < m ? answer[a + 1] : 0.0);
            outer = 0.5 * (radius_of(at, j + 1) + radius_of(at, j + 2));
            add_bent(at->along_by[a] * dp * dv, outer, n, by);
            add_bent(at->around_by[a] * (p[a] - p[b]) * (answer[a] - answer[b]), radius_of(at, j + 1), face, by);
        }
    }
}

/* The integral of r^2/h over the pad and its derivatives by the place. */
static double shear(const polar *at, double *by)
{
    double sum = 0.0;
    memset(by, 0, RF_SECTOR_PLACES * sizeof(double));
    for (size_t i = 0; i < at->lines; ++i) {
        const double span = angle_of(at, i + 1) - angle_of(at, i);
        const way n = way_past(at, i);
        for (size_t c = 0; c <= at->nodes; ++c) {
            const double r = 0.5 * (radius_of(at, c) + radius_of(at, c + 1));
            const double width = radius_of(at, c + 1) - radius_of(at, c);
            const double g = 0.25 * (corner(at, i, c, 0, 0) + corner(at, i, c, 0, 1) + corner(at, i, c, 1, 0)
                                     + corner(at, i, c, 1, 1));
            const double h = g + plane(at->q, r, n), part = r * r * r * width * span / h;
            sum += part;
            add_bent(-part / h, r, n, by);
        }
    }
    return sum;
}

/* What drives the film by the speed alone, twice: the source of the torque. */
static void set_turning(const polar *at, double *turning)
{
    for (size_t k = 0; k < at->lines * at->nodes; ++k)
        turning[k] = at->shape[3][k] + at->q[2] * at->shape[1][k] - at->q[1] * at->shape[2][k];
}

/* A y = -r p with A p = s, so that dy = -V (ds - dA p), A V = r. The edge of a ruptured zone adds nothing: pressure
   and its slope vanish there. */
static void take_rows(polar *at, const double *w, double *y, double *by)
{
    double bent[RF_SECTOR_PLACES];
    const double sheared = shear(at, bent), drag = at->pad->viscosity * 2.0 * w[3];
    const size_t all = at->lines * at->nodes;
    for (int row = 0; row < RF_SECTOR_ROWS; ++row) {
        const int turns = row == 3;
        const double share = turns ? 0.5 : 1.0;
        double *v = at->answer, *slope = by ? by + RF_SECTOR_COLUMNS * row : NULL;
        if (turns)
            set_turning(at, v);
        else
            memcpy(v, at->shape[row], all * sizeof(double));
        y[row] = -share * product(at, v, at->pressure) - (turns ? drag * sheared : 0.0);
        if (!slope)
            continue;
        double curved[RF_SECTOR_PLACES];
        rf_solve_film(&at->search, v, v);
        bend(at, v, curved);
        for (int k = 0; k < RF_SECTOR_PLACES; ++k)
            slope[k] = share * curved[k] - (turns ? drag * bent[k] : 0.0);
        for (int k = 0; k < RF_SECTOR_ROWS; ++k)
            slope[RF_SECTOR_PLACES + k] = -share * product(at, v, at->shape[k]);
        if (turns) {
            slope[1] += 0.5 * product(at, at->shape[2], at->pressure);
            slope[2] -= 0.5 * product(at, at->shape[1], at->pressure);
            slope[6] -= 2.0 * at->pad->viscosity * sheared;
        }
    }
}

double rf_sector_least(const rf_sector *pad, const double *q)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < pad->lines; ++i) {
        const way n[2] = {way_at(pad->angle[i]), way_at(pad->angle[i + 1])};
        for (size_t c = 0; c < pad->nodes; ++c)
            for (size_t k = 0; k < 4; ++k) {
                const double g = pad->profile[(i * pad->nodes + c) * 4 + k];
                least = fmin(least, g + plane(q, pad->radius[c + k % 2], n[k / 2]));
            }
    }
    return least;
}

static void extrapolate(size_t n, double *fine, const double *coarse)
{
    for (size_t k = 0; k < n; ++k)
        fine[k] += (fine[k] - coarse[k]) / 3.0;
}

int rf_sector_film(const rf_sector *pad, const double *q, const double *w, double *y, double *by)
{
    const int extrapolated = pad->extrapolated != 0;
    double coarse[RF_SECTOR_ROWS], slopes[RF_SECTOR_ROWS * RF_SECTOR_COLUMNS];
    polar at;
    if (!(rf_sector_least(pad, q) > 0.0))
        return RF_AT_WALL;
    int status = open_grid(&at, pad, q);
    if (status == RF_OK)
        status = solve_to(&at, extrapolated, w);
    if (status == RF_OK && extrapolated) {
        take_rows(&at, w, coarse, by ? slopes : NULL);
        status = solve_grid(&at, 0, w);
    }
    const int undefined = by && at.still && pad->ruptured;
    if (status == RF_OK)
        take_rows(&at, w, y, undefined ? NULL : by);
    if (status == RF_OK && undefined)
        status = RF_UNDEFINED;
    if (status == RF_OK && extrapolated)
        extrapolate(RF_SECTOR_ROWS, y, coarse);
    if (status == RF_OK && extrapolated && by)
        extrapolate(RF_SECTOR_ROWS * RF_SECTOR_COLUMNS, by, slopes);
    close_grid(&at);
    return status;
}

/* Couette and pressure flow from line i to the next, with that of both half cells at the edges apart. */
static double flow_past(const polar *at, size_t i, double speed, double *edges)
{
    const size_t m = at->nodes, next = i + 1 < at->lines ? i + 1 : 0;
    double flow = 0.0;
    for (size_t j = 0; j < m; ++j)
        flow += at->around[i * m + j] * (at->pressure[i * m + j] - at->pressure[next * m + j]);
    for (size_t c = 0; c <= m; ++c)
        for (int outer = 0; outer < 2; ++outer) {
            const double r = radius_of(at, c + (size_t)outer), half = 0.5 * (radius_of(at, c + 1) - radius_of(at, c));
            const double g = 0.5 * (corner(at, i, c, 0, outer) + corner(at, i, c, 1, outer));
            const double part = 0.5 * speed * (g + plane(at->q, r, way_past(at, i))) * r * half;
            flow += part;
            if (c == 0 && !outer)
                edges[0] = part;
            if (c == m && outer)
                edges[1] = part;
        }
    return flow;
}

static void take_facts(polar *at, const double *w, double *facts)
{
    double bent[RF_SECTOR_PLACES], first[2], last[2];
    const size_t m = at->nodes, all = at->lines * m;
    const double speed = 2.0 * w[3], sheared = shear(at, bent);
    double inner = 0.0, outer = 0.0, highest = 0.0, full = 0.0;
    for (size_t i = 0; i < at->lines; ++i) {
        inner += at->entry[i] * at->pressure[i * m];
        outer += at->along[i * m + m - 1] * at->pressure[i * m + m - 1];
    }
    for (size_t q = 0; q < all; ++q) {
        highest = fmax(highest, at->pressure[q]);
        full += at->full[q];
    }
    const double into = flow_past(at, 0, speed, first), out = flow_past(at, at->lines - 1, speed, last);
    const double found[RF_SECTOR_FACTS] = {at->pad->viscosity * speed * speed * sheared,
                                           product(at, at->source, at->pressure),
                                           into, out, inner + first[0] - last[0], outer + first[1] - last[1],
                                           highest, rf_sector_least(at->pad, at->q),
                                           full / (double)(all - (at->pad->ring ? 0 : m))};
    memcpy(facts, found, sizeof found);
}

int rf_sector_field(const rf_sector *pad, const double *q, const double *w, double *pressure, double *facts)
{
    polar at;
    if (!(rf_sector_least(pad, q) > 0.0))
        return RF_AT_WALL;
    int status = open_grid(&at, pad, q);
    if (status == RF_OK)
        status = solve_to(&at, 0, w);
    if (status == RF_OK) {
        take_facts(&at, w, facts);
        memset(pressure, 0, (pad->lines + 1) * (pad->nodes + 1) * sizeof(double));
        for (size_t i = 0; i <= pad->lines; ++i)
            memcpy(pressure + i * (pad->nodes + 1) + 1, at.pressure + i % pad->lines * at.nodes, at.nodes * sizeof(double));
    }
    close_grid(&at);
    return status;
}
