#include "energy.h"

#include <math.h>
#include <stdlib.h>

#include "energy_rows.h"
#include "groove_losses.h"

/* The equations. Of an opening the unknown is the temperature of what arrives, of which that of what leaves has a share.
   After the oil of the band come the unknowns that border it, the first of each kind given. */
typedef struct heat {
    const rf_energy *given;
    rf_sparse matrix;
    size_t to_walls, openings, shaft, bush, mean; /* heat of all lines and of the journal; temperatures */
    size_t *of;                                   /* N M K: the unknown of the oil in a cell */
    double *arriving, *leaving, *x;               /* oil of each unknown, and the solution */
} heat;

static size_t is_film(const rf_energy *g, size_t i, size_t j)
{
    return g->opening[i * g->cells + j] < 0;
}

static size_t film_cells(const rf_energy *g, size_t i)
{
    size_t count = 0;
    for (size_t j = 0; j < g->cells; ++j)
        count += is_film(g, i, j);
    return count;
}

static void number_line(heat *h, size_t i, size_t *next)
{
    const rf_energy *g = h->given;
    for (size_t c = i * g->cells; c < (i + 1) * g->cells; ++c)
        for (size_t p = c * g->layers; p < (c + 1) * g->layers; ++p)
            h->of[p] = g->opening[c] < 0 ? (*next)++ : h->openings + (size_t)g->opening[c];
}

/* Number the unknowns along the oil, the ring cut at the line with the fewest cells of film, and then what borders. The
   order of the border leaves no pivot 0: each unknown after those that it is made from. */
static void number_unknowns(heat *h)
{
    const rf_energy *g = h->given;
    const size_t N = g->lines, walls = g->walls != 0;
    size_t cut = 0, film = 0, next = 0;
    for (size_t i = 0; i < N; film += film_cells(g, i++))
        cut = film_cells(g, i) < film_cells(g, cut) ? i : cut;
    h->to_walls = h->matrix.band = (film - film_cells(g, cut)) * g->layers;
    h->openings = h->to_walls + walls * (N + 1);
    h->shaft = h->openings + g->openings;
    for (size_t s = 1; s < N; ++s)
        number_line(h, (cut + (g->backward ? N - s : s)) % N, &next);
    h->bush = h->shaft + walls;
    number_line(h, cut, &h->bush);
    h->mean = h->bush + walls * N;
    h->matrix.size = h->mean + walls;
}

/* Let oil flow from one unknown to another; backwards if the flow is negative. */
static void carry(heat *h, size_t from, size_t to, double flow)
{
    const size_t donor = flow > 0.0 ? from : to, receiver = flow > 0.0 ? to : from;
    if (flow == 0.0 || donor == receiver)
        return;
    rf_put(&h->matrix, receiver, donor, -fabs(flow));
    h->arriving[receiver] += fabs(flow);
    h->leaving[donor] += fabs(flow);
}

/* Let oil flow out of a cell to the next line, into it from mid-length, and between its layers as their balance asks. */
static void carry_oil(heat *h, size_t i, size_t j)
{
    const rf_energy *g = h->given;
    const size_t K = g->layers, row = g->cells * K, first = i * row + j * K, groove = h->shaft - 1;
    double upward = 0.0;
    for (size_t k = 0, p = first; k < K; ++k, ++p) {
        const size_t after = (p + row) % (g->lines * row), before = (p + (g->lines - 1) * row) % (g->lines * row);
        const double inward = j > 0 ? g->axial[p - K] : g->central ? g->central[i * K + k] : 0.0;
        carry(h, h->of[p], h->of[after], g->around[p]);
        carry(h, j > 0 ? h->of[p - K] : groove, h->of[p], inward);
        carry(h, h->of[k > 0 ? p - 1 : p], h->of[p], upward);
        upward += g->around[before] - g->around[p] + inward - g->axial[p] + g->fresh[p];
    }
}

/* What passes through a layer, makes heat in it and is conducted to the next ones. */
static void warm_oil(heat *h, size_t i, size_t j)
{
    const rf_energy *g = h->given;
    const size_t K = g->layers, c = i * g->cells + j;
    for (size_t k = 0, p = c * K; k < K && is_film(g, i, j); ++k, ++p) {
        const size_t own = h->of[p];
        const double drawn = j + 1 == g->cells ? fmax(-g->axial[p], 0.0) : 0.0;
        const double through = h->arriving[own] + fmax(g->fresh[p], 0.0) + drawn + g->less[p];
        rf_put(&h->matrix, own, own, through > 0.0 ? through : 1.0);
        h->x[own] = g->heat[p];
        for (int side = -1; side <= 1; side += 2)
            if (side < 0 ? k > 0 : k + 1 < K) {
                const double conducted = g->between[c * (K - 1) + (side < 0 ? k - 1 : k)];
                rf_put(&h->matrix, own, own, conducted);
                rf_put(&h->matrix, own, h->of[side < 0 ? p - 1 : p + 1], -conducted);
            }
    }
}

static void mix_openings(heat *h, double *shares)
{
    const rf_energy *g = h->given;
    double z;
    for (size_t o = 0; o < g->openings; ++o) {
        const size_t own = h->openings + o;
        const double in = h->arriving[own], out = h->leaving[own];
        shares[o] = g->carry_over >= 0.0 ? rf_carried_share(out, in, g->carry_over, &z) : out > 0.0 ? in / out : 1.0;
    }
    for (size_t k = 1; k < h->matrix.count; ++k)
        if (h->matrix.entries[k].column >= h->openings && h->matrix.entries[k].column < h->shaft)
            h->matrix.entries[k].value *= shares[h->matrix.entries[k].column - h->openings];
    for (size_t own = h->openings; own < h->shaft; ++own)
        rf_put(&h->matrix, own, own, h->arriving[own] > 0.0 ? h->arriving[own] : 1.0);
}

/* Take from a layer beside a wall what goes there: a sum of unknowns, the third one the layer beyond or the other wall,
   and a share of the heat that it makes. */
static void cool_at_walls(heat *h, size_t i, size_t j)
{
    const rf_energy *g = h->given;
    const size_t K = g->layers, c = i * g->cells + j, bush = h->bush + i;
    const double *beside = g->beside + 3 * c;
    for (int journal = 0; journal < 2 && is_film(g, i, j); ++journal) {
        const size_t at = journal ? (c + 1) * K - 1 : c * K, own = h->of[at];
        const size_t wall = h->to_walls + (journal ? g->lines : i);
        const size_t beyond = K > 1 ? h->of[journal ? at - 1 : at + 1] : journal ? bush : h->shaft;
        const size_t of[3] = {own, journal ? h->shaft : bush, beyond};
        const double flow[3] = {beside[0] - beside[2] * g->less[at], -beside[0] - beside[1], beside[1]};
        for (int n = 0; n < 3; ++n) {
            rf_put(&h->matrix, own, of[n], flow[n]);
            rf_put(&h->matrix, wall, of[n], -flow[n]);
        }
        h->x[own] -= beside[2] * g->heat[at];
        h->x[wall] += beside[2] * g->heat[at];
    }
}

static void close_walls(heat *h)
{
    const rf_energy *g = h->given;
    rf_sparse *m = &h->matrix;
    for (size_t i = 0; i < g->lines; ++i) {
        rf_put(m, h->to_walls + i, h->to_walls + i, 1.0);
        rf_put(m, h->bush + i, h->bush + i, 1.0);
        rf_put(m, h->bush + i, h->mean, -1.0);
        rf_put(m, h->mean, h->to_walls + i, -g->take);
        for (size_t k = 0; k < g->lines; ++k)
            rf_put(m, h->bush + i, h->to_walls + k, -g->spread[i * g->lines + k]);
    }
    rf_put(m, h->to_walls + g->lines, h->to_walls + g->lines, 1.0);
    rf_put(m, h->shaft, h->to_walls + g->lines, -g->shaft_take);
    rf_put(m, h->shaft, h->shaft, g->shaft_give);
    rf_put(m, h->mean, h->mean, g->give);
    h->x[h->shaft] = g->shaft_give * g->shaft_ambient;
    h->x[h->mean] = g->give * g->ambient;
}

static void for_each_cell(heat *h, void (*add)(heat *, size_t, size_t))
{
    for (size_t i = 0; i < h->given->lines; ++i)
        for (size_t j = 0; j < h->given->cells; ++j)
            add(h, i, j);
}

static void answer(const heat *h, double *oil, double *openings, double *bush, double *account)
{
    const rf_energy *g = h->given;
    account[0] = account[1] = account[2] = account[3] = 0.0;
    for (size_t o = 0, own = h->openings; own < h->shaft; ++o, ++own) {
        openings[o] *= h->x[own];
        account[0] += h->arriving[own] * h->x[own] - h->leaving[own] * openings[o];
    }
    for (size_t p = 0; p < g->lines * g->cells * g->layers; ++p)
        oil[p] = h->of[p] >= h->openings && h->of[p] < h->shaft ? openings[h->of[p] - h->openings] : h->x[h->of[p]];
    for (size_t i = 0; g->walls && i < g->lines; ++i) {
        bush[i] = h->x[h->bush + i];
        account[1] += h->x[h->to_walls + i];
    }
    if (g->walls) {
        account[2] = h->x[h->to_walls + g->lines];
        account[3] = h->x[h->shaft];
    }
}

int rf_solve_energy(const rf_energy *given, double *oil, double *openings, double *bush, double *account)
{
    const size_t N = given->lines, columns = N * given->cells, all = columns * given->layers;
    const size_t most = all + given->openings + 2 * N + 3;
    const size_t entries = 9 * all + 12 * columns + N * (N + 4) + given->openings + 6;
    double *memory = calloc(1, 3 * most * sizeof(double) + (all + most) * sizeof(size_t) + entries * sizeof(rf_entry));
    if (!memory)
        return RF_MEMORY;
    size_t *places = (size_t *)(memory + 3 * most);
    heat h = {given, {0, 0, 1, places + all, (rf_entry *)(places + all + most)}, 0, 0, 0, 0, 0, places,
              memory, memory + most, memory + 2 * most};
    number_unknowns(&h);
    for_each_cell(&h, carry_oil);
    mix_openings(&h, openings);
    for_each_cell(&h, warm_oil);
    if (given->walls) {
        for_each_cell(&h, cool_at_walls);
        close_walls(&h);
    }
    const int status = rf_solve_sparse(&h.matrix, h.x);
    if (status == RF_OK)
        answer(&h, oil, openings, bush, account);
    free(memory);
    return status;
}
