#include "energy.h"

#include <math.h>
#include <stdlib.h>

#include "energy_rows.h"
#include "groove_losses.h"

void rf_layer_shares(size_t columns, size_t layers, const double *fluidity, double *F0, double *F2, double *dragged,
                     double *pressed, double *sheared, double *squeezed, double *crossed)
{
    const double d = 1.0 / (double)layers;
    for (size_t c = 0; c < columns; ++c) {
        const double *f = fluidity + c * layers;
        double zeroth = 0.0, first = 0.0, second = 0.0, below = 0.0, moment = 0.0;
        for (size_t k = 0; k < layers; ++k) {
            zeroth += f[k] * d;
            first += f[k] * d * ((double)k + 0.5) * d;
        }
        const double y = first / zeroth;
        for (size_t k = 0; k < layers; ++k) {
            const size_t at = c * layers + k;
            const double low = (double)k * d, high = low + d, middle = low + 0.5 * d, cubes = high * high * high - low * low * low;
            const double a = high - y, b = low - y;
            dragged[at] = d * (below + 0.5 * d * f[k]) / zeroth;
            pressed[at] = -d * moment - f[k] * (cubes / 6.0 - 0.5 * low * low * d - 0.5 * y * d * d);
            sheared[at] = d * f[k] / zeroth;
            squeezed[at] = f[k] * (a * a * a - b * b * b) / 3.0;
            crossed[at] = d * f[k] * (middle - y) / zeroth;
            second += f[k] * (cubes - 1.5 * y * (high * high - low * low)) / 3.0;
            below += f[k] * d;
            moment += f[k] * (middle - y) * d;
        }
        for (size_t k = 0; k < layers; ++k)
            squeezed[c * layers + k] /= second;
        F0[c] = zeroth;
        F2[c] = second;
    }
}

typedef struct heat {
    const rf_energy *given;
    rf_sparse matrix;
    size_t to_bush, openings, journal, bush, mean;      /* the first unknown of each after those of the oil */
    size_t *of;                                         /* N M K: unknown of the oil in a cell */
    double *fluidity, *dragged, *pressed, *sheared, *squeezed, *crossed, *F0, *F2; /* N M K; the last two N M */
    double *around, *axial, *central;                   /* N M K: flows through the faces after a line, after a cell; N K */
    double *fed, *made;                                 /* N M K: oil from outside, lost to there if below 0; heat */
    double *arriving, *given_off, *x;                   /* of each unknown */
    void *memory;
} heat;

static int is_opening(const heat *h, size_t unknown)
{
    return unknown >= h->openings && unknown < h->openings + h->given->openings;
}

static int is_film(const heat *h, size_t i, size_t j)
{
    return h->given->opening[i * h->given->cells + j] < 0;
}

static size_t at(const heat *h, size_t i, size_t j, size_t k)
{
    return (i * h->given->cells + j) * h->given->layers + k;
}

/* How many cells of a line are film; there are more than M beyond the last line. */
static size_t film_cells(const heat *h, size_t i)
{
    size_t count = 0;
    for (size_t j = 0; j < h->given->cells; ++j)
        count += is_film(h, i, j);
    return count;
}

static size_t number_line(heat *h, size_t i, size_t next)
{
    const rf_energy *g = h->given;
    for (size_t j = 0; j < g->cells; ++j)
        for (size_t k = 0; k < g->layers; ++k)
            h->of[at(h, i, j, k)] = is_film(h, i, j) ? next++ : h->openings + (size_t)g->opening[i * g->cells + j];
    return next;
}

/* Number the unknowns along the oil, the ring cut at the line with the fewest cells of film, and then what borders. The
   order of the border leaves no pivot 0: each unknown after those that it is made from. */
static void number_unknowns(heat *h)
{
    const rf_energy *g = h->given;
    const size_t N = g->lines, walls = g->walls ? N : 0;
    size_t cut = 0, film = 0;
    for (size_t i = 0; i < N; ++i) {
        const size_t count = film_cells(h, i);
        cut = count < film_cells(h, cut) ? i : cut;
        film += count;
    }
    h->matrix.band = (film - film_cells(h, cut)) * g->layers;
    h->to_bush = h->matrix.band;
    h->openings = h->to_bush + walls;
    h->journal = h->openings + g->openings;
    const size_t last = h->journal + (walls > 0);
    size_t next = 0;
    for (size_t s = 1; s < N; ++s)
        next = number_line(h, (cut + (g->backward ? N - s : s)) % N, next);
    h->bush = number_line(h, cut, last);
    h->mean = h->bush + walls;
    h->matrix.size = h->mean + (walls > 0);
}

/* Let oil flow from one unknown to another; backwards if the flow is negative. */
static void carry(heat *h, size_t from, size_t to, double flow)
{
    const size_t donor = flow > 0.0 ? from : to, receiver = flow > 0.0 ? to : from;
    if (flow == 0.0 || donor == receiver)
        return;
    rf_put(&h->matrix, receiver, donor, -fabs(flow));
    h->arriving[receiver] += fabs(flow);
    h->given_off[donor] += fabs(flow);
}

/* Share a flow by layers in proportion to the sums of two columns; of one if they are the same. */
static void share(size_t layers, double flow, const double *here, const double *there, double *of)
{
    double sum = 0.0;
    for (size_t k = 0; k < layers; ++k)
        sum += here[k] + there[k];
    for (size_t k = 0; k < layers; ++k)
        of[k] += flow * ((here[k] + there[k]) / sum);
}

static void set_layer_flows(heat *h)
{
    const rf_energy *g = h->given;
    const size_t M = g->cells, K = g->layers, all = g->lines * M;
    for (size_t c = 0; c < all; ++c) {
        const size_t after = (c + M) % all * K, here = c * K, beside = (c + 1) % M ? here + K : here;
        share(K, g->dragged[c], h->dragged + here, h->dragged + after, h->around + here);
        share(K, g->pressed[c], h->pressed + here, h->pressed + after, h->around + here);
        share(K, g->axial[c], h->pressed + here, h->pressed + beside, h->axial + here);
        share(K, g->leaving[c] - g->entering[c], h->dragged + here, h->dragged + here, h->fed + here);
        if (g->central && c % M == 0)
            share(K, g->central[c / M], h->pressed + here, h->pressed + here, h->central + c / M * K);
    }
}

/* The heat that each layer makes. */
static void set_made(const heat *h)
{
    const rf_energy *g = h->given;
    for (size_t c = 0; c < g->lines * g->cells; ++c) {
        const double drag = g->speed * g->speed * g->shear[c] / h->F0[c], both = 24.0 * g->speed * g->climb[c];
        const double film = g->opening[c] < 0 ? g->heat_scale : 0.0;
        for (size_t p = c * g->layers; p < (c + 1) * g->layers; ++p)
            h->made[p] = film * (drag * h->sheared[p] + g->dissipation[c] * h->squeezed[p] + both * h->crossed[p]);
    }
}

/* What leaves the film through its end in a layer; drawn in if below 0. */
static double end_flow(const heat *h, size_t i, size_t j, size_t k)
{
    return j + 1 == h->given->cells ? h->axial[at(h, i, j, k)] : 0.0;
}

/* Let oil flow out of a cell of a line to the next ones, into it from mid-length, and between its layers. */
static void carry_cell(heat *h, size_t i, size_t j)
{
    const rf_energy *g = h->given;
    const size_t N = g->lines, K = g->layers, groove = h->openings + g->openings - 1;
    double upward = 0.0;
    for (size_t k = 0; k < K; ++k) {
        const size_t p = at(h, i, j, k), own = h->of[p];
        const double inward = j > 0 ? h->axial[p - K] : h->central[i * K + k];
        carry(h, own, h->of[at(h, (i + 1) % N, j, k)], h->around[p]);
        if (j > 0 || g->central)
            carry(h, j > 0 ? h->of[p - K] : groove, own, inward);
        if (k > 0)
            carry(h, h->of[p - 1], own, upward);
        upward += h->around[at(h, (i + N - 1) % N, j, k)] - h->around[p] + inward - h->axial[p] + h->fed[p];
    }
}

/* The heat of a layer of film: what it makes, less as it warms, what passes through it, what it conducts. */
static void warm_cell(heat *h, size_t i, size_t j)
{
    const rf_energy *g = h->given;
    const size_t K = g->layers;
    const double conducts = (double)K * g->diffusion * g->shear[i * g->cells + j];
    for (size_t k = 0; k < K; ++k) {
        const size_t p = at(h, i, j, k), own = h->of[p];
        const double less = h->made[p] * g->thinning[p];
        const double through = h->arriving[own] + fmax(h->fed[p], 0.0) + fmax(-end_flow(h, i, j, k), 0.0) + less;
        h->x[own] = h->made[p] + less * g->temperature[p];
        rf_put(&h->matrix, own, own, through > 0.0 ? through : 1.0);
        for (size_t side = 0; side < 2; ++side)
            if (side ? k + 1 < K : k > 0) {
                rf_put(&h->matrix, own, own, conducts);
                rf_put(&h->matrix, own, h->of[side ? p + 1 : p - 1], -conducts);
            }
    }
}

/* Openings: of their unknown, the mean of what arrives, what leaves them has a share. */
static void mix_openings(heat *h, double *shares)
{
    const rf_energy *g = h->given;
    double z;
    for (size_t o = 0; o < g->openings; ++o) {
        const size_t own = h->openings + o;
        const double in = h->arriving[own], out = h->given_off[own];
        shares[o] = g->carry_over >= 0.0 ? rf_carried_share(out, in, g->carry_over, &z) : out > 0.0 ? in / out : 1.0;
    }
    for (size_t n = 0; n < h->matrix.count && n < h->matrix.room; ++n)
        if (is_opening(h, h->matrix.entries[n].column))
            h->matrix.entries[n].value *= shares[h->matrix.entries[n].column - h->openings];
    for (size_t own = h->openings; own < h->openings + g->openings; ++own)
        rf_put(&h->matrix, own, own, h->arriving[own] > 0.0 ? h->arriving[own] : 1.0);
}

/* The heat that a cell gives to the bush, or on the other side to the journal, as unknowns times numbers; the row is
   that of its own oil. */
static void set_wall_terms(const heat *h, size_t i, size_t j, int journal, rf_entry terms[3])
{
    const rf_energy *g = h->given;
    const size_t K = g->layers, wall = at(h, i, j, journal ? K - 1 : 0);
    const uint32_t own = (uint32_t)h->of[wall], bush = (uint32_t)(h->bush + i), shaft = (uint32_t)h->journal;
    const double into = (double)K * g->diffusion * g->shear[i * g->cells + j];
    const rf_entry oil = {own, own, (K > 1 ? 3.0 : 6.0) * into};
    const rf_entry near = {own, journal ? shaft : bush, (K > 1 ? -8.0 / 3.0 : -4.0) * into};
    const rf_entry other = {own, journal ? bush : shaft, -2.0 * into};
    const rf_entry next = {own, (uint32_t)h->of[K > 1 ? (journal ? wall - 1 : wall + 1) : wall], -into / 3.0};
    terms[0] = oil;
    terms[1] = near;
    terms[2] = K > 1 ? next : other;
}

static void lose_to_walls(heat *h, size_t i, size_t j)
{
    rf_entry terms[3];
    for (int journal = 0; journal < 2; ++journal) {
        set_wall_terms(h, i, j, journal, terms);
        for (size_t n = 0; n < 3; ++n) {
            rf_put(&h->matrix, terms[n].row, terms[n].column, terms[n].value);
            rf_put(&h->matrix, journal ? h->journal : h->to_bush + i, terms[n].column,
                   -terms[n].value * (journal ? h->given->shaft_take : 1.0));
        }
    }
}

static void close_walls(heat *h)
{
    const rf_energy *g = h->given;
    for (size_t i = 0; i < g->lines; ++i) {
        rf_put(&h->matrix, h->to_bush + i, h->to_bush + i, 1.0);
        rf_put(&h->matrix, h->bush + i, h->bush + i, 1.0);
        rf_put(&h->matrix, h->bush + i, h->mean, -1.0);
        rf_put(&h->matrix, h->mean, h->to_bush + i, -g->take);
        for (size_t m = 0; m < g->lines; ++m)
            rf_put(&h->matrix, h->bush + i, h->to_bush + m, -g->spread[i * g->lines + m]);
    }
    rf_put(&h->matrix, h->mean, h->mean, g->give);
    rf_put(&h->matrix, h->journal, h->journal, g->shaft_give);
    h->x[h->mean] = g->give * g->ambient;
    h->x[h->journal] = g->shaft_give * g->shaft_ambient;
}

static void account_for_cell(const heat *h, size_t i, size_t j, const double *oil, rf_heat_account *account)
{
    const rf_energy *g = h->given;
    rf_entry terms[3];
    for (size_t k = 0; k < g->layers; ++k) {
        const size_t p = at(h, i, j, k);
        h->made[p] -= h->made[p] * g->thinning[p] * (oil[p] - g->temperature[p]);
        account->made += h->made[p];
        account->leaked += (fmax(-h->fed[p], 0.0) + fmax(end_flow(h, i, j, k), 0.0)) * oil[p];
    }
    for (int journal = 0; g->walls && journal < 2; ++journal) {
        set_wall_terms(h, i, j, journal, terms);
        for (size_t n = 0; n < 3; ++n)
            *(journal ? &account->to_journal : &account->to_bush) += terms[n].value * h->x[terms[n].column];
    }
}

static void answer(const heat *h, double *oil, double *openings, double *bush, rf_heat_account *account)
{
    const rf_energy *g = h->given;
    const rf_heat_account none = {0.0, 0.0, 0.0, 0.0, 0.0, g->walls ? h->x[h->journal] : 0.0};
    *account = none;
    for (size_t o = 0; o < g->openings; ++o) {
        const double arrived = h->x[h->openings + o], leaves = openings[o] * arrived;
        account->drained += h->arriving[h->openings + o] * arrived - h->given_off[h->openings + o] * leaves;
        openings[o] = leaves;
    }
    for (size_t i = 0; i < g->lines; ++i) {
        for (size_t j = 0; j < g->cells; ++j) {
            for (size_t p = at(h, i, j, 0); p < at(h, i, j + 1, 0); ++p)
                oil[p] = is_opening(h, h->of[p]) ? openings[h->of[p] - h->openings] : h->x[h->of[p]];
            if (is_film(h, i, j))
                account_for_cell(h, i, j, oil, account);
        }
        if (g->walls)
            bush[i] = h->x[h->bush + i];
    }
}

static int open_heat(heat *h, const rf_energy *given)
{
    const size_t lines = given->lines, columns = lines * given->cells, all = columns * given->layers;
    const size_t most = all + given->openings + 2 * lines + 2;
    h->given = given;
    h->matrix.count = 0;
    h->matrix.room = 8 * all + 12 * columns + lines * (lines + given->layers + 4) + most;
    const size_t numbers = 9 * all + 2 * columns + lines * given->layers + 3 * most;
    h->memory = calloc(1, numbers * sizeof(double) + all * sizeof(size_t) + h->matrix.room * sizeof(rf_entry));
    double **const fields[] = {&h->fluidity, &h->dragged, &h->pressed, &h->sheared, &h->squeezed, &h->crossed, &h->around,
                               &h->axial,    &h->fed};
    double *next = h->memory;
    if (!next)
        return RF_MEMORY;
    for (size_t k = 0; k < 9; ++k, next += all)
        *fields[k] = next;
    h->F0 = next;
    h->F2 = next + columns;
    h->central = next + 2 * columns;
    h->arriving = h->central + lines * given->layers;
    h->given_off = h->arriving + most;
    h->x = h->given_off + most;
    h->of = (size_t *)(h->x + most);
    h->matrix.entries = (rf_entry *)(h->of + all);
    for (size_t p = 0; p < all; ++p)
        h->fluidity[p] = 1.0 / given->viscosity[p];
    return RF_OK;
}

/* Do something for each cell of film. */
static void each_film(heat *h, void (*visit)(heat *, size_t, size_t))
{
    for (size_t i = 0; i < h->given->lines; ++i)
        for (size_t j = 0; j < h->given->cells; ++j)
            if (is_film(h, i, j))
                visit(h, i, j);
}

int rf_solve_energy(const rf_energy *given, double *oil, double *openings, double *bush, double *made,
                    rf_heat_account *account)
{
    heat h;
    if (open_heat(&h, given) != RF_OK)
        return RF_MEMORY;
    rf_layer_shares(given->lines * given->cells, given->layers, h.fluidity, h.F0, h.F2, h.dragged, h.pressed, h.sheared,
                    h.squeezed, h.crossed);
    number_unknowns(&h);
    set_layer_flows(&h);
    for (size_t i = 0; i < given->lines; ++i)
        for (size_t j = 0; j < given->cells; ++j)
            carry_cell(&h, i, j);
    mix_openings(&h, openings);
    h.made = made;
    set_made(&h);
    each_film(&h, warm_cell);
    if (given->walls) {
        each_film(&h, lose_to_walls);
        close_walls(&h);
    }
    const int status = rf_solve_sparse(&h.matrix, h.x);
    if (status == RF_OK)
        answer(&h, oil, openings, bush, account);
    free(h.memory);
    return status;
}
