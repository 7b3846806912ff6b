/* Whatever numbers a loop over films is given, it answers a status: no bad access, no leak, no not-a-number
   with RF_OK. stress_loops GRID COUNT, GRID a file of numbers: length/diameter, flags, spans and grids. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "films/journal_kernel.h"
#include "films/short_kernel.h"
#include "grids/ring.h"
#include "heat/energy.h"
#include "loops/march.h"
#include "loops/motor.h"
#include "loops/ride.h"
#include "loops/shake.h"
#include "loops/springs.h"

enum { STAGES = 2, JOURNALS = 2, SAMPLES = 9, MOST_STATES = 3, MOST_MODES = 4 + MOST_STATES,
       MOST_ROWS = 4 * JOURNALS + 2 + MOST_STATES, MOST_CHANNELS = 2 * JOURNALS + 3 + MOST_STATES };

/* States of both films together, and with them modes, rows and channels of the rotor. */
static int states;
#define MODES (4 + states)
#define ROWS (4 * JOURNALS + 2 + states)
#define CHANNELS (2 * JOURNALS + 3 + states)

static uint64_t seed = 88172645463325252u;

static double uniform(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* A number of about this size, now and then one that is out of all bounds. */
static double about(double size, double odd)
{
    static const double strange[] = {0.0, 1e300, -1e300, HUGE_VAL, -HUGE_VAL, NAN, 1e-300};
    if (uniform() < odd)
        return strange[(int)(uniform() * 7.0)];
    return size * (2.0 * uniform() - 1.0);
}

static void fail(const char *what, double detail)
{
    fprintf(stderr, "%s (%.17g)\n", what, detail);
    exit(1);
}

static void require_finite(const double *numbers, size_t count, const char *what)
{
    for (size_t k = 0; k < count; ++k)
        if (!isfinite(numbers[k]))
            fail(what, numbers[k]);
}

static double next_number(FILE *file)
{
    double number;
    if (fscanf(file, "%lf", &number) != 1)
        fail("the grid is too short", 0.0);
    return number;
}

static double *numbers_of(FILE *file, size_t count)
{
    double *numbers = malloc(count * sizeof *numbers);
    for (size_t k = 0; numbers && k < count; ++k)
        numbers[k] = next_number(file);
    if (!numbers)
        fail("no memory", 0.0);
    return numbers;
}

static void read_ring(const char *path, rf_ring *ring)
{
    FILE *file = fopen(path, "r");
    if (!file)
        fail(path, 0.0);
    ring->slenderness = next_number(file);
    ring->ruptured = next_number(file) != 0.0;
    ring->clipped = next_number(file) != 0.0;
    ring->pinned = next_number(file) != 0.0;
    ring->turning = next_number(file) != 0.0;
    ring->extrapolated = next_number(file) != 0.0;
    ring->spans = (int32_t)next_number(file);
    ring->levels = RF_LEVELS;
    ring->recess = -1;
    ring->pad = ring->spans == 2 && uniform() < 0.5;
    ring->start = numbers_of(file, (size_t)ring->spans);
    ring->extent = numbers_of(file, (size_t)ring->spans);
    for (int level = 0; level < RF_LEVELS; ++level) {
        rf_grid *grid = &ring->grids[level];
        grid->lines = (size_t)next_number(file);
        grid->nodes = (size_t)next_number(file);
        double *span = numbers_of(file, grid->lines);
        grid->line = numbers_of(file, grid->lines);
        grid->face = numbers_of(file, grid->lines);
        double *held = numbers_of(file, grid->lines);
        grid->value = numbers_of(file, grid->lines);
        grid->width = numbers_of(file, grid->nodes);
        grid->conductance = numbers_of(file, grid->nodes);
        int32_t *spans = malloc(grid->lines * sizeof *spans);
        int32_t *is_held = malloc(grid->lines * sizeof *is_held);
        for (size_t k = 0; spans && is_held && k < grid->lines; ++k) {
            spans[k] = (int32_t)span[k];
            is_held[k] = (int32_t)held[k];
        }
        grid->span = spans;
        grid->held = is_held;
        free(span);
        free(held);
    }
    fclose(file);
}

static void free_ring(rf_ring *ring)
{
    free((void *)ring->start);
    free((void *)ring->extent);
    for (int level = 0; level < RF_LEVELS; ++level) {
        const rf_grid *grid = &ring->grids[level];
        const void *const all[] = {grid->span, grid->line, grid->face, grid->held,
                                   grid->value, grid->width, grid->conductance};
        for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
            free((void *)all[k]);
    }
}

/* Films whose states may be anything, and what only ever sees journals off the wall. */
static void try_ring(const rf_ring *ring)
{
    double e[2], w[2], f[2], jacobian[8];
    for (int k = 0; k < 2; ++k) {
        e[k] = about(1.0, 0.05);
        w[k] = about(100.0, 0.05);
    }
    if (rf_ring_film(ring, e, w, f, uniform() < 0.5 ? jacobian : NULL) <= RF_OUTSIDE)
        require_finite(f, 2, "force of a ring");
    const double size = 0.95 * uniform() / fmax(1e-6, sqrt(2.0) * fmax(fabs(e[0]), fabs(e[1])));
    const double inside[2] = {isfinite(size * e[0]) ? size * e[0] : 0.3, isfinite(size * e[1]) ? size * e[1] : 0.0};
    const double source[2] = {about(100.0, 0.0), about(100.0, 0.0)};
    double fine[2], coarse[2], slopes[8], J[RF_LEVELS], slope[2 * RF_LEVELS], side_flow;
    rf_grid_work work;
    size_t first;
    if (rf_ring_pair(ring, 1, inside, source, fine, coarse, uniform() < 0.5 ? slopes : NULL, &first) == RF_OK)
        require_finite(fine, 2, "pair of a ring");
    const double place[RF_FREEDOMS] = {inside[0], inside[1], about(0.1, 0.05), about(0.1, 0.05)};
    const double drive[RF_DRIVES] = {source[0], source[1], about(9.0, 0.05), about(9.0, 0.05), about(9.0, 0.05)};
    double wrench[RF_FREEDOMS], by[RF_FREEDOMS * RF_COLUMNS];
    if (rf_ring_wrench(ring, place, drive, wrench, uniform() < 0.5 ? by : NULL) == RF_OK)
        require_finite(wrench, RF_FREEDOMS, "force and moment of a ring");
    if (rf_ring_potential(ring, inside, 1, source, J, slope, &work, &first) == RF_OK)
        require_finite(J, RF_LEVELS, "potential of a ring");
    const rf_grid *grid = &ring->grids[0];
    double *field = malloc((2 + grid->nodes) * grid->lines * sizeof *field);
    if (field && rf_ring_field(ring, inside, source, field, field + grid->lines, field + 2 * grid->lines, &side_flow) == RF_OK)
        require_finite(&side_flow, 1, "side flow of a ring");
    free(field);
}

#define DECAY 1.0

/* Two masses m on a spring and a damper in either direction: z' = lambda z - i f/(m Im lambda), x = Re z. The last
   two rows are the acceleration of the unbalance on the first one, which a motor may turn. */
typedef struct masses {
    rf_complex values[MOST_MODES], push[MOST_MODES * MOST_CHANNELS], sense[MOST_ROWS * MOST_MODES], rates[2 * MOST_MODES];
    double direct[MOST_ROWS * MOST_CHANNELS];
} masses;

static void set_masses(masses *of, double mass, double decay, double turn)
{
    memset(of, 0, sizeof *of);
    for (int m = 0; m < 4; ++m) {
        const rf_complex value = {-decay, turn}, one = {1.0, 0.0}, push = {0.0, -1.0 / (mass * turn)};
        of->values[m] = value;
        of->push[m * CHANNELS + m] = push;
        if (m < 2) {
            const rf_complex squared = {1e-3 * (decay * decay - turn * turn), -2e-3 * decay * turn};
            double *direct = of->direct + (4 * JOURNALS + states + m) * CHANNELS;
            of->push[m * CHANNELS + 2 * JOURNALS + states + m].im = 1e-3 * push.im;
            of->rates[m * MODES + m].re = 1e-3 * value.re;
            of->rates[m * MODES + m].im = 1e-3 * value.im;
            of->sense[(4 * JOURNALS + states + m) * MODES + m] = squared;
            direct[m] = 1e-3 / mass;
            direct[2 * JOURNALS + states + m] = 1e-6 / mass;
        }
        of->sense[(4 * (m / 2) + m % 2) * MODES + m] = one;
        of->sense[(4 * (m / 2) + 2 + m % 2) * MODES + m] = value;
    }
    for (int k = 0; k < states; ++k) {
        of->values[4 + k].re = -DECAY;
        of->push[(4 + k) * CHANNELS + 2 * JOURNALS + k].re = of->sense[(4 * JOURNALS + k) * MODES + 4 + k].re = 1.0;
    }
}

static const double NODES[] = {1.0 / 3.0, 1.0}, LAGRANGE[] = {1.5, -1.5, -0.5, 1.5}, REMAINDER[] = {1.0, -4.0, 3.0};

static rf_step_table new_table(void)
{
    const size_t s = STAGES;
    const rf_step_table table = {
        calloc(s * ROWS * 2 * MODES, sizeof(double)),  calloc(s * s * ROWS * CHANNELS, sizeof(double)),
        calloc(s * ROWS * CHANNELS, sizeof(double)),   calloc(MODES, sizeof(rf_complex)),
        calloc(2 * MODES * s * CHANNELS, sizeof(double)), calloc(s * MODES, sizeof(rf_complex)),
        calloc(s * (s + 1) * MODES, sizeof(rf_complex)),
    };
    return table;
}

static void free_table(const rf_step_table *table)
{
    free(table->move);
    free(table->gain);
    free(table->defect);
    free(table->keep);
    free(table->forced);
    free(table->turn);
    free(table->weights);
}

/* A march over `duration`; films that are springs without stiffness leave the closed form of free motion. */
static void try_march(const rf_response *films, const void *const *of, int is_free, double odd)
{
    rf_step_table tables[RF_SLOTS + 1];
    masses rotor;
    double rest[MOST_ROWS] = {0.0}, spring[4] = {0.0}, damper[4] = {0.0}, lengths[] = {1e-4, 1e-4}, scales[MOST_ROWS];
    const double walls[] = {1e-4, is_free ? HUGE_VAL : 1e-4}, arms[JOURNALS] = {0.0}, duration = 0.02;
    const double speeds[] = {about(300.0, odd), about(300.0, odd)}, times[] = {0.0, 0.5 * duration};
    const double slopes[] = {(speeds[1] - speeds[0]) / times[1], 0.0};
    const double angles[] = {0.0, 0.5 * times[1] * (speeds[0] + speeds[1])};
    rf_complex z[MOST_MODES], begun[MOST_MODES], out[SAMPLES * MOST_MODES];
    double grid[SAMPLES], turns[3 * SAMPLES], turned[4 * MOST_MODES * MOST_MODES] = {0.0}, turned_rest[2 * MOST_MODES] = {0.0};
    const int32_t first[] = {0, 1, MOST_STATES};
    for (int k = 0; k < 4 * MODES * MODES; ++k)
        turned[k] = k / (2 * MODES) % MODES < 4 ? about(0.5, odd) : 0.0; /* the speed does nothing to a film's states */
    for (int k = 0; k < 2 * MODES; ++k)
        turned_rest[k] = k % MODES < 4 ? about(1e-6, odd) : 0.0;
    for (int k = 0; k <= RF_SLOTS; ++k)
        tables[k] = new_table();
    const double decay = 400.0 * uniform(), turn = 100.0 + 900.0 * uniform();
    set_masses(&rotor, is_free ? 1.0 : 50.0 * uniform() + 0.1, decay, turn);
    if (is_free)
        memset(rotor.push, 0, sizeof rotor.push);
    for (int q = 0; q < ROWS; ++q)
        scales[q] = q >= ROWS - 2 ? 0.0 : q >= 4 * JOURNALS ? 1e4 : q % 4 < 2 ? 1e4 : 1e2;
    for (int m = 0; m < MODES; ++m) {
        z[m].re = begun[m].re = about(5e-5, odd);
        z[m].im = begun[m].im = about(5e-5, odd);
    }
    for (int n = 0; n < SAMPLES; ++n)
        grid[n] = duration * (n + 1) / SAMPLES;
    rf_march march = {
        {MODES, CHANNELS, ROWS, rotor.values, rotor.push, rotor.sense, rotor.direct, rotor.rates},
        {STAGES, NODES, LAGRANGE, REMAINDER},
        {JOURNALS, 1, films, of, rest, spring, damper, lengths, walls, arms, NULL, NULL,
         states ? first : NULL, states ? 2 : 0, DECAY},
        {2, times, speeds, slopes, angles},
        {about(300.0, odd), is_free || uniform() < 0.5 ? NULL : turned, turned_rest},
        .scales = scales, .longest = duration / 3.0, .shortest = 1e-13 * duration,
        .rtol = pow(10.0, -6.0 * uniform()), .newton = 1e-9, .tables = tables, .step = (int32_t)(20.0 * uniform()), .z = z,
    };
    const double line[] = {about(2.0, odd), about(0.01, odd), 2.0, 0.0, duration, 300.0, 200.0};
    const rf_motor motor = {rf_line_torque_at, line, NULL, turns, 1e-4 + uniform(), 300.0, about(100.0, odd),
                            {0.0, -9.81e-3}, 0.0, speeds[0], 0.0};
    if (!is_free && uniform() < 0.5)
        march.motor = motor;
    memset(march.slot_of, -1, sizeof march.slot_of);
    memset(march.step_of, -1, sizeof march.step_of);
    int64_t place = 0;
    int end = rf_march_to(&march, times[1], 400, grid, SAMPLES, &place, out);
    if (end == RF_MARCH_DONE)
        end = rf_march_to(&march, duration, 400, grid, SAMPLES, &place, out);
    if (end < RF_MARCH_DONE || end > RF_MARCH_BAND || place > SAMPLES)
        fail("end of a march", end);
    if (end == RF_MARCH_DONE)
        require_finite((const double *)out, 2 * MODES * (size_t)place, "samples of a march");
    if (end == RF_MARCH_DONE && march.motor.torque)
        require_finite(turns, 3 * (size_t)place, "angles of a march");
    for (int n = 0; is_free && end == RF_MARCH_DONE && n < SAMPLES; ++n) {
        const double size = exp(-decay * grid[n]), c = size * cos(turn * grid[n]), s = size * sin(turn * grid[n]);
        if (!(fabs(out[n * MODES].re - (c * begun[0].re - s * begun[0].im)) < 1e-14))
            fail("free motion", out[n * MODES].re);
    }
    if (is_free && odd == 0.0 && end != RF_MARCH_DONE)
        fail("free motion must end", end);
    for (int k = 0; k <= RF_SLOTS; ++k)
        free_table(&tables[k]);
}

static void try_shaken(rf_response film, const void *of, double odd)
{
    enum { STEPS = 20 };
    double pulls[2 * (STEPS + 1)], motion[4 * (STEPS + 1)] = {0.0};
    for (int k = 0; k < 2 * (STEPS + 1); ++k)
        pulls[k] = about(2000.0, odd);
    motion[0] = about(9e-5, odd);
    rf_shaken rotor = {film, of, fabs(about(50.0, odd)), about(300.0, odd), 1e-4, fabs(about(1e-3, odd)), 0, 0, 0,
                       NULL, NULL};
    const int status = rf_follow_shaken(&rotor, STEPS, pulls, motion);
    if (rotor.done > STEPS || (status == RF_OK) != (rotor.done == STEPS))
        fail("steps of a shaken rotor", (double)rotor.done);
    require_finite(motion + 4, 4 * (size_t)rotor.done, "motion of a shaken rotor");
}

static void try_ride(double odd)
{
    enum { STEPS = 30 };
    const double A[] = {-1.0, about(1.0, odd), about(1.0, odd), -2.0}, B[] = {1.0, 0.5}, C[] = {0.1, about(1.0, odd)};
    const rf_ride_law law = {2, A, B, C, about(1.0, odd), 1.0, 1.0, 1.5, 0.2, 1.0};
    double start[4], pushes[2 * STEPS + 1], out[4 * (STEPS + 1)];
    for (int k = 0; k < 4; ++k)
        start[k] = about(1.0, odd);
    for (int k = 0; k <= 2 * STEPS; ++k)
        pushes[k] = about(1.0, odd);
    if (rf_ride(&law, start, 0.01, STEPS, pushes, out) != RF_OK)
        fail("ride", 0.0);
    if (odd == 0.0)
        require_finite(out, 4 * (STEPS + 1), "ride");
}

static void try_energy(double odd)
{
    enum { LINES = 7, CELLS = 2, LAYERS = 3, COLUMNS = LINES * CELLS, ALL = COLUMNS * LAYERS };
    const size_t layers = uniform() < 0.5 ? 1 : LAYERS;
    const int grooved = uniform() < 0.3, opened = uniform() < 0.7;
    double fields[7][ALL], spread[LINES * LINES], oil[ALL], openings[3], bush[LINES], account[4];
    int32_t opening[COLUMNS];
    for (int k = 0; k < 7; ++k)
        for (int p = 0; p < ALL; ++p)
            fields[k][p] = k < 4 ? about(1.0, odd) : fabs(about(1.0, odd));
    for (int c = 0; c < COLUMNS; ++c)
        opening[c] = opened && uniform() < 0.3 ? (int)(2.0 * uniform()) : -1;
    for (int k = 0; k < LINES * LINES; ++k)
        spread[k] = about(1e-3, odd);
    const rf_energy given = {LINES, CELLS, layers, 2 + (size_t)grooved, uniform() < 0.5, uniform() < 0.5, about(1.0, odd),
                             opening, grooved ? fields[0] : NULL, fields[1], fields[2], fields[3], fields[4], fields[5],
                             fields[5], fields[6], spread,
                             1.0, 1.0, about(10.0, odd), about(1.0, odd), 1.0, about(10.0, odd)};
    if (rf_solve_energy(&given, oil, openings, bush, account) != RF_OK)
        return;
    require_finite(oil, COLUMNS * layers, "oil that warms");
    if (odd == 0.0)
        require_finite(account, 4, "account of heat");
}

static int plain(const void *of, const double *state, double *f, double *jacobian)
{
    return rf_journal_at(of, state, f, jacobian);
}

/* A film with states: they push the journal a little, and follow it. */
typedef struct following {
    const rf_journal *film;
    int states;
} following;

static int follow(const void *of, const double *state, double *f, double *by)
{
    const following *self = of;
    const int n = self->states, width = 5 + n;
    double slopes[10] = {0.0};
    const int status = rf_journal_at(self->film, state, f, slopes);
    memset(by, 0, (size_t)((2 + n) * width) * sizeof *by);
    for (int i = 0; i < 2; ++i) {
        memcpy(by + i * width, slopes + 5 * i, 5 * sizeof *by);
        for (int k = 0; k < n; ++k) {
            f[i] += 10.0 * state[5 + k];
            by[i * width + 5 + k] = 10.0;
        }
    }
    for (int k = 0; k < n; ++k) {
        double *row = by + (2 + k) * width;
        f[2 + k] = 300.0 * (state[k] - state[5 + k]) + 1e-4 * state[4];
        row[k] = 300.0;
        row[5 + k] = -300.0;
        row[4] = 1e-4;
    }
    return status;
}

int main(int argc, char **argv)
{
    const long count = argc > 2 ? atol(argv[2]) : 0;
    rf_ring ring = {0};
    const rf_short thin = {1.44};
    const double none[8] = {0.0};
    read_ring(argv[1], &ring);
    const rf_journal journal = {rf_short_film, &thin, 1e-4, 0.4, 0.0, 0}, round = {rf_ring_film, &ring, 1e-4, 0.4, 0.0, 0};
    const rf_sprung sprung = {plain, &journal, 1e6, 1};
    const following one = {&journal, 1}, two = {&journal, 2};
    const rf_response with_states[] = {follow, follow};
    const void *const of_states[] = {&one, &two};
    for (long n = 0; n < count; ++n) {
        const double odd = n % 2 ? 0.05 : 0.0;
        const rf_response films[] = {plain, rf_sprung_at}, none_of[] = {rf_springs_at, rf_springs_at};
        const void *const of[] = {n % 8 ? &journal : &round, &sprung}, *const nothing[] = {none, none};
        try_ring(&ring);
        try_march(none_of, nothing, 1, odd);
        try_march(films, of, 0, odd);
        states = MOST_STATES;
        try_march(with_states, of_states, 0, odd);
        states = 0;
        try_shaken(rf_sprung_at, &sprung, odd);
        try_shaken(plain, n % 8 ? &journal : &round, odd);
        try_ride(odd);
        try_energy(odd);
    }
    free_ring(&ring);
    return 0;
}
