#include "film_states.h"

#include <string.h>

#include "../solvers/dense.h"

/* Static condensation: unknowns at s nodes, `each` of them, of which `rest` stay, forces and the acceleration of a motor. */
typedef struct sizes {
    int32_t s, each, forces, rest, kept; /* kept: s rest */
} sizes;

static sizes sizes_of(const rf_journals *journals, int32_t s, int32_t each)
{
    const int32_t rest = each - journals->first[journals->count];
    const sizes found = {s, each, 2 * journals->count, rest, s * rest};
    return found;
}

size_t rf_states_size(const rf_journals *journals, size_t s, size_t each)
{
    if (!journals->first)
        return 0;
    const sizes of = sizes_of(journals, (int32_t)s, (int32_t)each);
    const size_t kept = (size_t)of.kept, most = s * (size_t)journals->most;
    return most * most + (s * each - kept) * (kept + 1) + kept * kept + kept;
}

/* Place among all unknowns of number r of the rest at a node. */
static int32_t place_of(const sizes *of, int32_t node, int32_t r)
{
    return node * of->each + (r < of->forces ? r : of->each - 1);
}

/* What of a row of all unknowns is of the rest. */
static void copy_rest(const sizes *of, const double *row, double *to)
{
    for (int32_t j = 0; j < of->s; ++j)
        for (int32_t r = 0; r < of->rest; ++r)
            to[j * of->rest + r] = row[place_of(of, j, r)];
}

/* The rates of n states, `first` among the unknowns at each node, by those of the rest and, behind these, at their zero. */
static void solve_rates(const sizes *of, int32_t first, int32_t n, const double *matrix, const double *right, double *own,
                        double *rates)
{
    const int32_t wide = of->kept + 1;
    for (int32_t i = 0; i < of->s; ++i)
        for (int32_t k = 0; k < n; ++k) {
            const int32_t place = i * of->each + first + k, p = i * n + k;
            const double *row = matrix + place * of->s * of->each;
            for (int32_t j = 0; j < of->s; ++j)
                memcpy(own + (p * of->s + j) * n, row + j * of->each + first, (size_t)n * sizeof *own);
            copy_rest(of, row, rates + p * wide);
            rates[p * wide + of->kept] = right[place];
        }
    rf_eliminate((size_t)(of->s * n), own, (size_t)wide, rates);
}

/* Take them out of the equations of the forces, a row of all unknowns of these. */
static void take_rates(const sizes *of, int32_t first, int32_t n, const double *row, const double *rates, double *reduced,
                       double *right)
{
    const int32_t wide = of->kept + 1;
    for (int32_t j = 0; j < of->s; ++j)
        for (int32_t k = 0; k < n; ++k) {
            const double by = row[j * of->each + first + k], *rate = rates + (j * n + k) * wide;
            if (by == 0.0)
                continue;
            for (int32_t c = 0; c < of->kept; ++c)
                reduced[c] -= by * rate[c];
            *right -= by * rate[of->kept];
        }
}

void rf_solve_with_states(const rf_journals *journals, int32_t s, int32_t each, const double *matrix, double *right,
                          double *memory)
{
    const sizes of = sizes_of(journals, s, each);
    const int32_t kept = of.kept, most = s * journals->most;
    double *const own = memory, *const reduced = own + most * most, *const solved = reduced + kept * kept;
    double *const rates = solved + kept;
    for (int32_t b = 0; b < journals->count; ++b) {
        const int32_t first = journals->first[b];
        solve_rates(&of, of.forces + first, rf_film_states(journals, b), matrix, right, own, rates + s * first * (kept + 1));
    }
    for (int32_t i = 0, q = 0; i < s; ++i)
        for (int32_t r = 0; r < of.rest; ++r, ++q) {
            const int32_t place = place_of(&of, i, r), b = r / 2;
            const double *row = matrix + place * s * each;
            copy_rest(&of, row, reduced + q * kept);
            solved[q] = right[place];
            if (b < journals->count)
                take_rates(&of, of.forces + journals->first[b], rf_film_states(journals, b), row,
                           rates + s * journals->first[b] * (kept + 1), reduced + q * kept, solved + q);
        }
    rf_eliminate((size_t)kept, reduced, 1, solved);
    for (int32_t q = 0; q < kept; ++q)
        right[place_of(&of, q / of.rest, q % of.rest)] = solved[q];
    for (int32_t b = 0; b < journals->count; ++b)
        for (int32_t p = 0, n = rf_film_states(journals, b); p < s * n; ++p) {
            const double *rate = rates + (s * journals->first[b] + p) * (kept + 1);
            double *to = right + p / n * each + of.forces + journals->first[b] + p % n;
            *to = rate[kept];
            for (int32_t c = 0; c < kept; ++c)
                *to -= rate[c] * solved[c];
        }
}
