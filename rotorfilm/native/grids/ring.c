#include "ring.h"

#include <math.h>
#include <string.h>

#include "../films/map_frame.h"
#include "losses.h"

#define CENTER 1e-8 /* eccentricity ratio below which a plain film without source has a derivative */

static int is_supplied(const rf_ring *ring)
{
    for (size_t i = 0; i < ring->grids[0].lines; ++i)
        if (ring->grids[0].value[i] != 0.0)
            return 1;
    return 0;
}

/* Whether nothing drives the film, so that one that ruptures has no derivative. */
static int is_at_rest(const rf_ring *ring, const double *drive)
{
    for (int k = 0; k < RF_DRIVES; ++k)
        if (drive[k] != 0.0 && (k + 1 < RF_DRIVES || ring->recess >= 0 || ring->mobility.drags))
            return 0;
    return (ring->ruptured || ring->clipped) && !is_supplied(ring);
}

/* Make d f/de with the lines held that of lines which turn with the journal: at right angles to e the film turns as a
   whole, f(R e, R w) = R f(e, w). */
static void turn_lines(const rf_ring *ring, const double *e, const double *w, const double *f, double *jacobian)
{
    const double chi = rf_length(e[0], e[1]), unit[2] = {chi > 0.0 ? e[0] / chi : 1.0, chi > 0.0 ? e[1] / chi : 0.0};
    const double along[2] = {-unit[1], unit[0]}, turned[2] = {-f[1], f[0]};
    for (size_t k = 0; k < 2 && ring->turning; ++k) {
        double *row = jacobian + 4 * k;
        const double by_angle = turned[k] + row[2] * w[1] - row[3] * w[0];
        const double more = by_angle / fmax(chi, CENTER) - row[0] * along[0] - row[1] * along[1];
        row[0] += more * along[0];
        row[1] += more * along[1];
    }
}

/* Force and, unless NULL, derivatives by e and w, of the film of a journal that is not tilted. */
static void take_aligned(const rf_ring *ring, const double *e, const double *w, const double *wrench, const double *by,
                         double *f, double *jacobian)
{
    for (int k = 0; k < 2; ++k) {
        f[k] = wrench[k];
        for (int m = 0; m < 2 && jacobian; ++m) {
            jacobian[4 * k + m] = by[RF_COLUMNS * k + m];
            jacobian[4 * k + 2 + m] = by[RF_COLUMNS * k + RF_FREEDOMS + m];
        }
        if (jacobian && rf_is_sped(ring))
            jacobian[8 + k] = by[RF_COLUMNS * (k + 1) - 1];
    }
    if (jacobian)
        turn_lines(ring, e, w, f, jacobian);
}

int rf_is_sped(const rf_ring *ring)
{
    return ring->mobility.drags || ring->mobility.per_rate > 0.0;
}

/* The rate of a journal at rest, where the film knows it. */
static double rest_rate(const rf_ring *ring, const double *e, const double *w)
{
    const double squared = e[0] * e[0] + e[1] * e[1];
    return rf_is_sped(ring) && squared > 0.0 ? (e[1] * w[0] - e[0] * w[1]) / squared : 0.0;
}

static int film_of(rf_levels *levels, const double *e, const double *w, double *f, double *jacobian)
{
    const double q[RF_FREEDOMS] = {e[0], e[1], 0.0, 0.0}, rate = rf_is_sped(levels->ring) ? w[2] : 0.0;
    const double drive[RF_DRIVES] = {w[0], w[1], 0.0, 0.0, rate};
    double wrench[RF_FREEDOMS], by[RF_FREEDOMS * RF_COLUMNS];
    rf_place_journal(levels, q, drive[4]);
    const int status = rf_take_film(levels, drive, wrench, jacobian ? by : NULL);
    if (status != RF_OK)
        return rf_fail(status, f, jacobian, 8);
    take_aligned(levels->ring, e, w, wrench, by, f, jacobian);
    return RF_OK;
}

/* A plain centered film is linear in w, so any direction gives its damping. */
static int film_at_center(rf_levels *levels, const double *e, double rate, double *f, double *jacobian)
{
    const double any[3] = {1.0, 0.0, rate};
    const int status = film_of(levels, e, any, f, jacobian);
    if (status != RF_OK)
        return status;
    f[0] = f[1] = jacobian[0] = jacobian[1] = jacobian[4] = jacobian[5] = 0.0;
    for (int k = 8; k < 10 && rf_is_sped(levels->ring); ++k)
        jacobian[k] = 0.0;
    return RF_OK;
}

int rf_judge_state(const rf_ring *ring, const double *q, const double *drive)
{
    double at[2];
    if (rf_is_broken(q, RF_FREEDOMS) || rf_is_broken(drive, RF_DRIVES))
        return RF_NOT_FINITE;
    return rf_least_film(ring, q, at) > 0.0 ? RF_OK : RF_AT_WALL;
}

/* The same of a journal that is not tilted. */
static int judge(const rf_ring *ring, const double *e, const double *w)
{
    const double q[RF_FREEDOMS] = {e[0], e[1], 0.0, 0.0}, drive[RF_DRIVES] = {w[0], w[1], 0.0, 0.0, 0.0};
    return rf_judge_state(ring, q, drive);
}

int rf_ring_wrench(const rf_ring *ring, const double *q, const double *drive, double *f, double *by)
{
    rf_levels levels;
    int status = rf_judge_state(ring, q, drive);
    memset(f, 0, RF_FREEDOMS * sizeof(double));
    if (status != RF_OK)
        return status;
    if (is_at_rest(ring, drive))
        return by ? RF_UNDEFINED : RF_OK;
    status = rf_open_levels(&levels, ring);
    if (status == RF_OK) {
        rf_place_journal(&levels, q, drive[4]);
        status = rf_take_film(&levels, drive, f, by);
    }
    rf_close_levels(&levels);
    return status;
}

int rf_ring_film(const void *data, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_ring *ring = data;
    const int judged = judge(ring, e, w);
    if (judged != RF_OK)
        return rf_fail(judged, f, jacobian, 8);
    const double drive[RF_DRIVES] = {w[0], w[1], 0.0, 0.0, rf_is_sped(ring) ? w[2] : 0.0};
    const int resting = is_at_rest(ring, drive);
    const int centered = rf_length(e[0], e[1]) <= CENTER && !ring->pinned && !ring->turning;
    if (resting && !(jacobian && centered))
        return rf_rest(f, jacobian);
    rf_levels levels;
    int status = rf_open_levels(&levels, ring);
    if (status == RF_OK)
        status = resting ? film_at_center(&levels, e, drive[4], f, jacobian) : film_of(&levels, e, w, f, jacobian);
    rf_close_levels(&levels);
    return status == RF_OK ? rf_judge(0.0, 1.0, f, jacobian) : rf_fail(status, f, jacobian, 8);
}

int rf_ring_pair(const rf_ring *ring, size_t n, const double *e, const double *w, double *fine, double *coarse,
                 double *jacobian, size_t *first)
{
    rf_levels levels;
    int status = rf_open_levels(&levels, ring);
    *first = 0;
    for (size_t i = 0; i < n && status == RF_OK; ++i) {
        const double q[RF_FREEDOMS] = {e[i], e[n + i], 0.0, 0.0}, source[2] = {w[i], w[n + i]};
        const double drive[RF_DRIVES] = {w[i], w[n + i], 0.0, 0.0, rest_rate(ring, q, source)};
        double f[RF_FREEDOMS] = {0.0}, by[RF_FREEDOMS * RF_COLUMNS], slopes[10];
        *first = i;
        status = rf_judge_state(ring, q, drive);
        if (status != RF_OK)
            break;
        rf_place_journal(&levels, q, drive[4]);
        for (int level = 1; level >= 0 && status == RF_OK; --level) {
            double *answer = level == 1 ? coarse : fine;
            status = level == 1 ? rf_solve_down_to(&levels, 1, drive) : rf_solve_level(&levels, 0, drive);
            if (jacobian && level == 0 && status == RF_OK)
                rf_take_derivatives(&levels, drive[4], by);
            rf_take_force(&levels, f);
            answer[i] = f[0];
            answer[n + i] = f[1];
        }
        if (jacobian && status == RF_OK)
            take_aligned(ring, q, drive, f, by, f, slopes);
        for (size_t k = 0; k < 8 && jacobian && status == RF_OK; ++k)
            jacobian[k * n + i] = slopes[k];
    }
    rf_close_levels(&levels);
    return status;
}

int rf_ring_field(const rf_ring *ring, const double *e, const double *w, double *theta, double *face,
                  double *pressure, double *side_flow)
{
    const double q[RF_FREEDOMS] = {e[0], e[1], 0.0, 0.0};
    const double drive[RF_DRIVES] = {w[0], w[1], 0.0, 0.0, rest_rate(ring, e, w)};
    const size_t lines = ring->grids[0].lines;
    rf_levels levels;
    double f[RF_FREEDOMS];
    int status = rf_open_levels(&levels, ring);
    if (status == RF_OK)
        status = rf_judge_state(ring, q, drive);
    if (status == RF_OK) {
        rf_place_journal(&levels, q, drive[4]);
        status = rf_solve_down_to(&levels, 0, drive);
        rf_take_force(&levels, f);
        memcpy(theta, levels.cells[0].theta, lines * sizeof(double));
        memcpy(face, levels.cells[0].face, lines * sizeof(double));
        memcpy(pressure, levels.pressure, lines * ring->grids[0].nodes * sizeof(double));
        *side_flow = rf_flow_out_of_ends(&levels);
    }
    rf_close_levels(&levels);
    return status;
}

/* J, and dJ/de unless `slope` is NULL, of the grid that was solved last; entries of the slope `stride` apart.

   The discrete film minimizes 12 (P.A P/2 - P.N w) over P >= 0, and J is the minimum. */
static double potential_of(const rf_levels *levels, const double *w, size_t stride, double *slope)
{
    const rf_cells *cells = &levels->cells[levels->level];
    double bent[RF_FREEDOMS + 1], products[RF_DRIVES];
    if (slope)
        rf_bend(cells, levels->pressure, levels->pressure, 0.0, bent);
    for (size_t m = 0; m < 2 && slope; ++m)
        slope[m * stride] = 6.0 * bent[m];
    rf_multiply(cells, levels->pressure, products);
    return -6.0 * (products[0] * w[0] + products[1] * w[1]);
}

int rf_ring_potential(const rf_ring *ring, const double *e, size_t n, const double *w, double *J, double *slope,
                      rf_grid_work *work, size_t *first)
{
    const double q[RF_FREEDOMS] = {e[0], e[1], 0.0, 0.0};
    rf_levels levels;
    int status = rf_open_levels(&levels, ring);
    levels.keeps = 1;
    *first = 0;
    if (status == RF_OK && (status = judge(ring, e, e)) == RF_OK)
        rf_place_journal(&levels, q, 0.0);
    for (size_t d = 0; d < n && status == RF_OK; ++d) {
        const double drive[RF_DRIVES] = {w[d], w[n + d], 0.0, 0.0, 0.0};
        *first = d;
        if (rf_is_broken(drive, 2)) {
            status = RF_NOT_FINITE;
            break;
        }
        for (int level = RF_LEVELS - 1; level >= 0 && status == RF_OK; --level) {
            const size_t at = (size_t)level * n + d;
            status = rf_solve_level(&levels, level, drive);
            J[at] = potential_of(&levels, drive, n, slope ? slope + at + (size_t)level * n : NULL);
        }
    }
    memset(work, 0, sizeof *work);
    for (int level = 0; level < ring->levels; ++level) {
        work->solutions += levels.search[level].work.solutions;
        work->lines += levels.search[level].work.lines;
    }
    rf_close_levels(&levels);
    return status;
}
