#include "ring.h"

#include <math.h>

#include "../films/map_frame.h"
#include "ring_losses.h"

#define CENTER 1e-8 /* eccentricity ratio below which a plain film without source has a derivative */

static size_t nodes_of(const rf_grid *grid)
{
    return grid->lines * grid->nodes;
}

/* The force of the grid that was solved last; a clipped film then has no pressure below zero. */
static void take_force(rf_search *search, int level, double *f)
{
    const rf_grid *grid = &search->ring->grids[level];
    for (size_t q = 0; search->ring->clipped && q < nodes_of(grid); ++q)
        search->pressure[q] = fmax(search->pressure[q], 0.0);
    rf_set_film_force(grid, &search->cells[level], search->pressure, f);
}

static double sum_of_products(size_t n, const double *x, const double *y)
{
    double sum = 0.0;
    for (size_t q = 0; q < n; ++q)
        sum += x[q] * y[q];
    return sum;
}

/* (dA/de_m) P on a grid. */
static void set_bent_flow(const rf_search *search, int level, size_t m, double *flow)
{
    const rf_cells *cells = &search->cells[level];
    rf_set_flow(&search->ring->grids[level], cells->around_slope[m], cells->along_slope[m], search->pressure, flow);
}

/* d f/d(e, w) at the solution on a grid, free nodes and lines held.

   With the free nodes I and N = integral of n over the cells, A_II P_I = (N w - A P_held)_I and F = -12 N^T P.
   A is symmetric, so two solutions V = A_II^-1 N_I make dF/dw = -12 V^T N and dF/de = 12 V^T dA P. The
   pressure and its slope vanish at the edge of a ruptured zone, so moving the edge adds nothing. */
static void set_derivatives(rf_search *search, int level, double *jacobian)
{
    const rf_grid *grid = &search->ring->grids[level];
    const size_t all = nodes_of(grid);
    double *of_force = search->source, *other = search->flow;
    for (size_t k = 0; k < 2; ++k) {
        const double unit[2] = {k == 0, k == 1};
        rf_set_source(grid, &search->cells[level], unit, of_force);
        for (size_t q = 0; search->ring->clipped && q < all; ++q)
            of_force[q] = search->pressure[q] > 0.0 ? of_force[q] : 0.0;
        rf_solve_free(search, of_force, of_force);
        for (size_t m = 0; m < 2; ++m) {
            const double along[2] = {m == 0, m == 1};
            set_bent_flow(search, level, m, other);
            jacobian[4 * k + m] = 12.0 * sum_of_products(all, of_force, other);
            rf_set_source(grid, &search->cells[level], along, other);
            jacobian[4 * k + 2 + m] = -12.0 * sum_of_products(all, of_force, other);
        }
    }
}

static int is_supplied(const rf_ring *ring)
{
    for (size_t i = 0; i < ring->grids[0].lines; ++i)
        if (ring->grids[0].value[i] != 0.0)
            return 1;
    return 0;
}

/* Whether nothing drives the film, so that one that ruptures has no derivative. */
static int is_at_rest(const rf_ring *ring, const double *w)
{
    return w[0] == 0.0 && w[1] == 0.0 && (ring->ruptured || ring->clipped) && !is_supplied(ring);
}

/* Force and, unless NULL, derivatives of the grid that was solved last. */
static void take_answer(rf_search *search, int level, double *f, double *jacobian)
{
    if (jacobian)
        set_derivatives(search, level, jacobian);
    take_force(search, level, f);
}

static void extrapolate(size_t n, double *fine, const double *coarse)
{
    for (size_t k = 0; k < n; ++k)
        fine[k] += (fine[k] - coarse[k]) / 3.0;
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

static int film_of(rf_search *search, const double *e, const double *w, double *f, double *jacobian)
{
    const int extrapolated = search->ring->extrapolated != 0;
    double coarse[2] = {0.0, 0.0}, by[8];
    rf_place_journal(search, e);
    int status = rf_search_down_to(search, extrapolated, w);
    if (status == RF_OK && extrapolated) {
        take_answer(search, 1, coarse, jacobian ? by : NULL);
        status = rf_search_film(search, 0, w);
    }
    if (status != RF_OK)
        return rf_fail(status, f, jacobian, 8);
    take_answer(search, 0, f, jacobian);
    if (extrapolated)
        extrapolate(2, f, coarse);
    if (extrapolated && jacobian)
        extrapolate(8, jacobian, by);
    if (jacobian)
        turn_lines(search->ring, e, w, f, jacobian);
    return RF_OK;
}

/* A plain centered film is linear in w, so any direction gives its damping. */
static int film_at_center(rf_search *search, const double *e, double *f, double *jacobian)
{
    const double any[2] = {1.0, 0.0};
    const int status = film_of(search, e, any, f, jacobian);
    if (status != RF_OK)
        return status;
    f[0] = f[1] = jacobian[0] = jacobian[1] = jacobian[4] = jacobian[5] = 0.0;
    return RF_OK;
}

int rf_judge_state(const rf_ring *ring, const double *e, const double *w)
{
    const double state[4] = {e[0], e[1], w[0], w[1]};
    double at[2];
    if (rf_is_broken(state, 4))
        return RF_NOT_FINITE;
    return rf_least_film(ring, e, at) > 0.0 ? RF_OK : RF_AT_WALL;
}

int rf_ring_film(const void *data, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_ring *ring = data;
    const int judged = rf_judge_state(ring, e, w);
    if (judged != RF_OK)
        return rf_fail(judged, f, jacobian, 8);
    const int resting = is_at_rest(ring, w), centered = rf_length(e[0], e[1]) <= CENTER && !ring->pinned && !ring->turning;
    if (resting && !(jacobian && centered))
        return rf_rest(f, jacobian);
    rf_search search;
    if (rf_open_search(&search, ring) != RF_OK)
        return rf_fail(RF_MEMORY, f, jacobian, 8);
    const int status = resting ? film_at_center(&search, e, f, jacobian) : film_of(&search, e, w, f, jacobian);
    rf_close_search(&search);
    return status == RF_OK ? rf_judge(0.0, 1.0, f, jacobian) : status;
}

int rf_ring_pair(const rf_ring *ring, size_t n, const double *e, const double *w, double *fine, double *coarse,
                 double *jacobian, size_t *first)
{
    rf_search search;
    int status = rf_open_search(&search, ring);
    *first = 0;
    for (size_t i = 0; i < n && status == RF_OK; ++i) {
        const double here[2] = {e[i], e[n + i]}, source[2] = {w[i], w[n + i]};
        double f[2][2] = {{0.0, 0.0}, {0.0, 0.0}}, slopes[8];
        *first = i;
        status = rf_judge_state(ring, here, source);
        if (status != RF_OK)
            break;
        rf_place_journal(&search, here);
        for (int level = 1; level >= 0 && status == RF_OK; --level) {
            status = level == 1 ? rf_search_down_to(&search, 1, source) : rf_search_film(&search, 0, source);
            if (jacobian && level == 0 && status == RF_OK)
                set_derivatives(&search, 0, slopes);
            take_force(&search, level, f[level]);
        }
        for (size_t k = 0; k < 2; ++k) {
            fine[k * n + i] = f[0][k];
            coarse[k * n + i] = f[1][k];
        }
        if (jacobian && status == RF_OK)
            turn_lines(ring, here, source, f[0], slopes);
        for (size_t k = 0; k < 8 && jacobian && status == RF_OK; ++k)
            jacobian[k * n + i] = slopes[k];
    }
    rf_close_search(&search);
    return status;
}

int rf_ring_field(const rf_ring *ring, const double *e, const double *w, double *theta, double *face,
                  double *pressure, double *side_flow)
{
    rf_search search;
    double f[2];
    int status = rf_open_search(&search, ring);
    if (status == RF_OK)
        status = rf_judge_state(ring, e, w);
    if (status == RF_OK) {
        rf_place_journal(&search, e);
        status = rf_search_down_to(&search, 0, w);
        take_force(&search, 0, f);
        for (size_t i = 0; i < ring->grids[0].lines; ++i) {
            theta[i] = search.cells[0].theta[i];
            face[i] = search.cells[0].face[i];
        }
        for (size_t q = 0; q < nodes_of(ring->grids); ++q)
            pressure[q] = search.pressure[q];
        *side_flow = rf_flow_out_of_ends(&search, ring->grids);
    }
    rf_close_search(&search);
    return status;
}

/* J, and dJ/de unless `slope` is NULL, of the grid that was solved last; entries of the slope `stride` apart.

   The discrete film minimizes 12 (P.A P/2 - P.N w) over P >= 0, and J is the minimum. */
static double potential_of(const rf_search *search, int level, size_t stride, double *slope)
{
    const size_t all = nodes_of(&search->ring->grids[level]);
    for (size_t m = 0; m < 2 && slope; ++m) {
        set_bent_flow(search, level, m, search->flow);
        slope[m * stride] = 6.0 * sum_of_products(all, search->pressure, search->flow);
    }
    return -6.0 * sum_of_products(all, search->pressure, search->source);
}

int rf_ring_potential(const rf_ring *ring, const double *e, size_t n, const double *w, double *J, double *slope,
                      rf_grid_work *work, size_t *first)
{
    rf_search search;
    int status = rf_open_search(&search, ring);
    *first = 0;
    if (status == RF_OK && (status = rf_judge_state(ring, e, e)) == RF_OK)
        rf_place_journal(&search, e);
    for (size_t d = 0; d < n && status == RF_OK; ++d) {
        const double source[2] = {w[d], w[n + d]};
        *first = d;
        if (rf_is_broken(source, 2)) {
            status = RF_NOT_FINITE;
            break;
        }
        for (int level = RF_LEVELS - 1; level >= 0 && status == RF_OK; --level) {
            const size_t at = (size_t)level * n + d;
            status = rf_search_film(&search, level, source);
            J[at] = potential_of(&search, level, n, slope ? slope + at + (size_t)level * n : NULL);
        }
    }
    *work = search.work;
    rf_close_search(&search);
    return status;
}
