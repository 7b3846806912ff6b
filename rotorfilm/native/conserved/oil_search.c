#include "oil_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../status.h"
#include "coarser_oil.h"

#define MORE 60      /* solutions of a search beyond one for each line and node, by which an edge moves at least */
#define NOISE 1e-13  /* of the largest pressure, or of theta: no reason to move a cell */
#define SOLVED 1e-10 /* of Fischer's and Burmeister's function, from where the sets are right */

static size_t most_rounds(const rf_oil_cells *cells)
{
    return cells->lines + cells->nodes + MORE;
}

static size_t cells_of(const rf_oil_solver *solver)
{
    return solver->cells->lines * solver->cells->nodes;
}

int rf_open_oil_solver(rf_oil_solver *solver, const rf_oil_cells *cells, int is_complex)
{
    const size_t all = cells->lines * cells->nodes, parts = is_complex ? 2 : 1;
    memset(solver, 0, sizeof *solver);
    solver->cells = cells;
    solver->places.place = malloc((1 + RF_OIL_ENTRIES) * all * sizeof(int32_t));
    if (!solver->places.place)
        return RF_MEMORY;
    solver->places.entry = solver->places.place + all;
    rf_place_oil(cells, &solver->places, &solver->band);
    const size_t numbers = rf_band_numbers(&solver->band), unknowns = solver->band.size + solver->band.border;
    double *next = malloc((parts * (numbers + unknowns) + 3 * all) * sizeof(double));
    solver->memory = next;
    if (!next)
        return RF_MEMORY;
    solver->by_pressure = next;
    solver->by_theta = next + all;
    solver->flow = next + 2 * all;
    solver->band.rows = next + 3 * all;
    solver->band.last = solver->band.rows + solver->band.size * rf_band_stride(&solver->band);
    solver->right = solver->band.rows + numbers;
    if (is_complex) {
        solver->imaginary = solver->right + unknowns;
        solver->band.imaginary_rows = solver->imaginary + unknowns;
        solver->band.imaginary_last = solver->band.imaginary_rows + (solver->band.last - solver->band.rows);
    }
    return RF_OK;
}

void rf_close_oil_solver(rf_oil_solver *solver)
{
    free(solver->places.place);
    free(solver->memory);
}

static int is_free(const rf_oil_solver *solver, size_t q)
{
    return solver->places.place[q] >= 0;
}

/* Numbers of cells in the order of the matrix; cells that are one add up. */
static void gather(const rf_oil_solver *solver, const double *numbers, double *right)
{
    memset(right, 0, (solver->band.size + solver->band.border) * sizeof(double));
    for (size_t q = 0; q < cells_of(solver); ++q)
        if (is_free(solver, q))
            right[solver->places.place[q]] += numbers[q];
}

static void spread(const rf_oil_solver *solver, const double *answer, double *numbers)
{
    for (size_t q = 0; q < cells_of(solver); ++q)
        numbers[q] = is_free(solver, q) ? answer[solver->places.place[q]] : 0.0;
}

/* Go to where the flow out of every cell is nothing, along by_pressure and by_theta. */
static int step(rf_oil_solver *solver, double *pressure, double *theta)
{
    const rf_oil_cells *cells = solver->cells;
    rf_oil_outflow(cells, pressure, theta, solver->flow);
    gather(solver, solver->flow, solver->right);
    for (size_t k = 0; k < cells->openings; ++k)
        if (cells->fed[k])
            solver->right[solver->band.size + solver->band.border - cells->openings + k] -= cells->flow[k];
    rf_set_oil_matrix(cells, &solver->places, solver->by_pressure, solver->by_theta, NULL, NULL, &solver->band);
    const int status = rf_factorize_band(&solver->band, solver->right);
    if (status != RF_OK)
        return status;
    spread(solver, solver->right, solver->flow);
    for (size_t q = 0; q < cells_of(solver); ++q) {
        pressure[q] -= solver->by_pressure[q] * solver->flow[q];
        theta[q] -= solver->by_theta[q] * solver->flow[q];
    }
    ++solver->work.solutions;
    return RF_OK;
}

static double largest(size_t n, const double *numbers)
{
    double most = 0.0;
    for (size_t q = 0; q < n; ++q)
        most = fabs(numbers[q]) > most ? fabs(numbers[q]) : most;
    return most;
}

/* Set every cell that is not held full and without pressure; what flows out of them then is in `flow`. */
static void fill(rf_oil_solver *solver, double *pressure, double *theta)
{
    for (size_t q = 0; q < cells_of(solver); ++q)
        if (is_free(solver, q)) {
            pressure[q] = 0.0;
            theta[q] = 1.0;
        }
    rf_oil_outflow(solver->cells, pressure, theta, solver->flow);
}

/* Full where more oil comes than leaves; openings with a given flow too. */
static void guess_sets(rf_oil_solver *solver, uint8_t *full, double *pressure, double *theta)
{
    fill(solver, pressure, theta);
    const double noise = NOISE * largest(cells_of(solver), solver->flow);
    for (size_t q = 0; q < cells_of(solver); ++q)
        full[q] = (uint8_t)(solver->flow[q] <= noise || solver->cells->opening[q] != RF_FILM_CELL);
}

static void set_sets(rf_oil_solver *solver, const uint8_t *full, double *pressure, double *theta)
{
    for (size_t q = 0; q < cells_of(solver); ++q) {
        solver->by_pressure[q] = full[q] ? 1.0 : 0.0;
        solver->by_theta[q] = full[q] ? 0.0 : 1.0;
        if (is_free(solver, q)) {
            pressure[q] = 0.0;
            theta[q] = full[q] ? 1.0 : 0.0;
        }
    }
}

static int search_sets(rf_oil_solver *solver, uint8_t *full, double *pressure, double *theta)
{
    for (size_t set = 0; set < most_rounds(solver->cells); ++set) {
        set_sets(solver, full, pressure, theta);
        const int status = step(solver, pressure, theta);
        if (status != RF_OK)
            return status;
        const double noise = NOISE * largest(cells_of(solver), pressure);
        int changed = 0;
        for (size_t q = 0; q < cells_of(solver); ++q) {
            const int stays = full[q] ? pressure[q] >= -noise : theta[q] <= 1.0 + NOISE;
            if (!stays && is_free(solver, q)) {
                full[q] = !full[q];
                changed = 1;
            }
        }
        if (!changed)
            return RF_OK;
    }
    return RF_STUCK;
}

/* One cell of Newton's method: the directions of its one unknown, and P and theta moved to the tangent of
   P + psi = sqrt(P^2 + psi^2), P over `unit`; the function itself. */
static double set_tangent(rf_oil_solver *solver, size_t q, double unit, double *pressure, double *theta)
{
    const double p = pressure[q] / unit, psi = 1.0 - theta[q], r = hypot(p, psi), F = p + psi - r;
    const double by_p = r > 0.0 ? 1.0 - p / r : 1.0 - sqrt(0.5), by_psi = r > 0.0 ? 1.0 - psi / r : 1.0 - sqrt(0.5);
    const int is_pressure = by_p < by_psi;
    solver->by_pressure[q] = unit * (is_pressure ? 1.0 : by_psi / by_p);
    solver->by_theta[q] = is_pressure ? by_p / by_psi : 1.0;
    if (is_pressure)
        theta[q] += F / by_psi;
    else
        pressure[q] -= unit * F / by_p;
    return fabs(F);
}

static int search_by_newton(rf_oil_solver *solver, uint8_t *full, double *pressure, double *theta)
{
    const size_t all = cells_of(solver);
    fill(solver, pressure, theta);
    for (size_t q = 0; q < all; ++q) {
        const size_t nodes = solver->cells->nodes, before = q >= nodes ? q - nodes : q + all - nodes;
        const double of_faces = solver->cells->around[q] + solver->cells->around[before];
        if (solver->cells->opening[q] == RF_FILM_CELL)
            pressure[q] = fmax(-solver->flow[q], 0.0) / of_faces;
    }
    const double unit = fmax(largest(all, pressure), 1e-300);
    for (size_t round = 0; round < most_rounds(solver->cells); ++round) {
        double most = 0.0;
        memset(solver->by_pressure, 0, 2 * all * sizeof(double));
        for (size_t q = 0; q < all; ++q)
            if (is_free(solver, q))
                most = fmax(most, set_tangent(solver, q, unit, pressure, theta));
        for (size_t q = 0; q < all; ++q)
            full[q] = (uint8_t)(pressure[q] / unit > 1.0 - theta[q]);
        if (round > 0 && most < SOLVED)
            return RF_OK;
        const int status = step(solver, pressure, theta);
        if (status != RF_OK)
            return status;
        ++solver->work.newton;
    }
    return RF_STUCK;
}

/* Full where the film on half the cells is; RF_UNDEFINED without such cells, or such a film. */
static int guess_from_coarser(const rf_oil_cells *cells, uint8_t *full, const double *pressure, const double *theta)
{
    rf_coarser_oil coarser;
    rf_oil_work work;
    if (!rf_has_coarser_oil(cells))
        return RF_UNDEFINED;
    int status = rf_open_coarser_oil(&coarser, cells, pressure, theta);
    if (status == RF_OK)
        status = rf_oil_film(&coarser.cells, RF_BY_SETS, 0, coarser.full, coarser.pressure, coarser.theta, &work);
    if (status == RF_OK)
        rf_refine_full(&coarser, full);
    rf_close_coarser_oil(&coarser);
    return status == RF_OK ? RF_OK : RF_UNDEFINED;
}

int rf_search_oil(rf_oil_solver *solver, const rf_oil_cells *cells, int method, int guessed, uint8_t *full,
                  double *pressure, double *theta)
{
    const rf_oil_work none = {0, 0};
    solver->cells = cells;
    solver->work = none;
    if (!guessed && (method == RF_BY_NEWTON || guess_from_coarser(cells, full, pressure, theta) != RF_OK))
        guess_sets(solver, full, pressure, theta);
    int status = method == RF_BY_SETS ? search_sets(solver, full, pressure, theta) : RF_STUCK;
    if (status == RF_STUCK) {
        status = search_by_newton(solver, full, pressure, theta);
        if (status == RF_OK)
            status = search_sets(solver, full, pressure, theta);
    }
    return status;
}

int rf_oil_film(const rf_oil_cells *cells, int method, int guessed, uint8_t *full, double *pressure, double *theta,
                rf_oil_work *work)
{
    rf_oil_solver solver;
    int status = rf_open_oil_solver(&solver, cells, 0);
    if (status == RF_OK)
        status = rf_search_oil(&solver, cells, method, guessed, full, pressure, theta);
    *work = solver.work;
    rf_close_oil_solver(&solver);
    return status;
}

/* Solve for one right-hand side, N x M. */
static void respond(rf_oil_solver *solver, double *real, double *imaginary)
{
    gather(solver, real, solver->right);
    if (imaginary) {
        gather(solver, imaginary, solver->imaginary);
        rf_solve_complex_band(&solver->band, solver->right, solver->imaginary);
        spread(solver, solver->imaginary, imaginary);
    } else {
        rf_solve_band(&solver->band, solver->right);
    }
    spread(solver, solver->right, real);
}

void rf_follow_oil(rf_oil_solver *solver, size_t count, double *right)
{
    for (size_t k = 0; k < count; ++k)
        respond(solver, right + k * cells_of(solver), NULL);
}

/* y -= a x, number by number. */
static void subtract_products(size_t n, const double *const a[2], double *const x[2], double *const y[2])
{
    for (size_t q = 0; q < n; ++q) {
        y[0][q] -= a[0][q] * x[0][q] - (x[1] ? a[1][q] * x[1][q] : 0.0);
        if (x[1])
            y[1][q] -= a[0][q] * x[1][q] + a[1][q] * x[0][q];
    }
}

int rf_oil_response(const rf_oil_cells *cells, const uint8_t *full, const double *storage, const double *imaginary,
                    const double *coupling, size_t count, double *right, double *right_imaginary)
{
    rf_oil_solver solver;
    int status = rf_open_oil_solver(&solver, cells, imaginary != NULL);
    const size_t all = cells->lines * cells->nodes, rows = coupling ? 2 * count : count;
    const double *const by[2] = {coupling, coupling ? coupling + all : NULL};
    for (size_t q = 0; q < all && status == RF_OK; ++q) {
        solver.by_pressure[q] = full[q] ? 1.0 : 0.0;
        solver.by_theta[q] = full[q] ? 0.0 : 1.0;
    }
    if (status == RF_OK) {
        rf_set_oil_matrix(cells, &solver.places, solver.by_pressure, solver.by_theta, storage, imaginary, &solver.band);
        status = imaginary ? rf_factorize_complex_band(&solver.band) : rf_factorize_band(&solver.band, NULL);
    }
    for (size_t k = 0; k < rows && status == RF_OK; ++k) {
        double *const now[2] = {right + k * all, imaginary ? right_imaginary + k * all : NULL};
        if (k >= count) {
            double *const first[2] = {now[0] - count * all, imaginary ? now[1] - count * all : NULL};
            subtract_products(all, by, first, now);
        }
        respond(&solver, now[0], now[1]);
    }
    rf_close_oil_solver(&solver);
    return status;
}
