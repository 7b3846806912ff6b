#include "march.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/map_frame.h"

#define NUDGE 1e-6     /* of a clearance and a radian: the velocity with which a film at rest is asked */
#define NEWTON_STEPS 8
#define HUGE_CHANGE 1e300
#define WHOLE 1.0001 /* of a step that must fit before the stop */

/* What a call of rf_march_to needs beside the tables. */
typedef struct scratch {
    double *u, *guess;     /* s x channels: forces at the nodes of the last step and of this one */
    double *start;         /* channels: at its start */
    double *both;          /* 2 modes */
    double *free, *motion; /* s x rows: without the films' forces, and with them */
    double *force, *slope; /* s x 2 n, s x 2 n x 4 */
    double *matrix, *right; /* (s 2 n) squared, and as many as one row or all channels */
    double *forced;        /* 2 modes x s: by mode and node, for samples within a step */
    rf_complex *weights;   /* s x modes */
    double *memory;
} scratch;

static int open_scratch(scratch *at, const rf_march *march)
{
    const size_t s = (size_t)march->scheme.stages, channels = (size_t)march->rotor.channels;
    const size_t rows = (size_t)march->rotor.rows, modes = (size_t)march->rotor.modes;
    const size_t forces = 2 * (size_t)march->journals.count, all = s * forces;
    const size_t sizes[] = {s * channels, s * channels, channels,  2 * modes, s * rows, s * rows,
                            all,          4 * all,      all * all, all,       2 * modes * s, 2 * modes * s};
    double **const places[] = {&at->u,     &at->guess, &at->start,  &at->both,  &at->free,  &at->motion,
                               &at->force, &at->slope, &at->matrix, &at->right, &at->forced, NULL};
    size_t total = 0;
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k)
        total += sizes[k];
    double *next = at->memory = malloc(total * sizeof *next);
    if (!next)
        return RF_MEMORY;
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; next += sizes[k++])
        if (places[k])
            *places[k] = next;
        else
            at->weights = (rf_complex *)next;
    return RF_OK;
}

/* Set pair to (w^2 cos p + a sin p, w^2 sin p - a cos p) and return the speed w at a time. */
static double unbalance(const rf_speeds *profile, double t, double pair[2])
{
    int32_t k = 0;
    while (k + 1 < profile->count && profile->times[k + 1] <= t)
        ++k;
    const double passed = t - profile->times[k], a = passed >= 0.0 ? profile->slopes[k] : 0.0;
    const double w = profile->speeds[k] + a * passed;
    const double p = profile->angles[k] + passed * (profile->speeds[k] + 0.5 * a * passed);
    const double c = cos(p), s = sin(p);
    pair[0] = w * w * c + a * s;
    pair[1] = w * w * s - a * c;
    return w;
}

/* Films' forces and springs (2 n), and slopes by the motion (2 n x 4). */
static int set_forces(const rf_journals *journals, const double *motion, double speed, double *force,
                      double *slope)
{
    int worst = RF_OK;
    for (int32_t b = 0; b < journals->count; ++b) {
        double state[5], answer[2], jacobian[10];
        for (int k = 0; k < 4; ++k)
            state[k] = journals->rest[4 * b + k] + motion[4 * b + k];
        state[4] = speed;
        int status = journals->films[b](journals->of[b], state, answer, jacobian);
        if (status == RF_UNDEFINED) {
            /* The limit along a trace of velocity: no film has a derivative without a source. */
            state[2] += NUDGE * journals->lengths[b] * (fabs(speed) + 1.0);
            status = journals->films[b](journals->of[b], state, answer, jacobian);
            state[2] = journals->rest[4 * b + 2] + motion[4 * b + 2];
            status = status == RF_UNDEFINED ? RF_OK : status;
        }
        if (status < RF_AT_WALL && (rf_is_broken(answer, 2) || rf_is_broken(jacobian, 10)))
            status = RF_NOT_FINITE;
        worst = status > worst ? status : worst;
        if (status >= RF_AT_WALL)
            return status;
        for (int i = 0; i < 2; ++i) {
            const int32_t row = 2 * b + i;
            const double k = journals->spring[row], c = journals->damper[row];
            force[row] = answer[i] + k * state[i] + c * state[2 + i];
            for (int j = 0; j < 4; ++j)
                slope[4 * row + j] = jacobian[5 * i + j];
            slope[4 * row + i] += k;
            slope[4 * row + 2 + i] += c;
        }
    }
    return worst;
}

/* Overwrite right[n] by the solution of a small system; whether there is one. */
static int solve(size_t n, double *matrix, double *right)
{
    for (size_t k = 0; k < n; ++k) {
        size_t p = k;
        for (size_t i = k + 1; i < n; ++i)
            if (fabs(matrix[i * n + k]) > fabs(matrix[p * n + k]))
                p = i;
        if (!(fabs(matrix[p * n + k]) > 0.0))
            return 0;
        for (size_t j = k; j < n && p != k; ++j) {
            const double kept = matrix[k * n + j];
            matrix[k * n + j] = matrix[p * n + j];
            matrix[p * n + j] = kept;
        }
        const double kept = right[k], inverse = 1.0 / matrix[k * n + k];
        right[k] = right[p];
        right[p] = p != k ? kept : right[p];
        for (size_t i = k + 1; i < n; ++i) {
            const double f = matrix[i * n + k] * inverse;
            if (f == 0.0)
                continue;
            for (size_t j = k + 1; j < n; ++j)
                matrix[i * n + j] -= f * matrix[k * n + j];
            right[i] -= f * right[k];
        }
    }
    for (size_t k = n; k-- > 0;) {
        double total = right[k];
        for (size_t j = k + 1; j < n; ++j)
            total -= matrix[k * n + j] * right[j];
        right[k] = total / matrix[k * n + k];
    }
    return 1;
}

/* What forces at the nodes, rows of `width`, add to the motion of one journal coordinate at node i. */
static double gained(const rf_march *march, const rf_step_table *table, int32_t i, int32_t q, const double *u,
                     int32_t width)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, rows = march->rotor.rows;
    double total = 0.0;
    for (int32_t j = 0; j < s; ++j) {
        const double *gain = table->gain + ((i * s + j) * rows + q) * channels;
        for (int32_t c = 0; c < channels - 2; ++c)
            total += gain[c] * u[j * width + c];
    }
    return total;
}

/* Films at the motion of all nodes. */
static int set_node_forces(rf_march *march, const rf_step_table *table, double t, double h, double last,
                           scratch *at)
{
    const int32_t rows = march->rotor.rows, forces = 2 * march->journals.count;
    int worst = RF_OK;
    for (int32_t i = 0; i < march->scheme.stages; ++i) {
        double pair[2];
        for (int32_t q = 0; q < rows; ++q)
            at->motion[i * rows + q] =
                at->free[i * rows + q] + gained(march, table, i, q, at->guess, march->rotor.channels);
        const double w = unbalance(&march->profile, fmin(t + h * march->scheme.nodes[i], last), pair);
        const int status = set_forces(&march->journals, at->motion + i * rows, w, at->force + i * forces,
                                      at->slope + 4 * i * forces);
        march->films += 1;
        if (status >= RF_AT_WALL)
            return status;
        worst = status > worst ? status : worst;
    }
    return worst;
}

/* The linear equations of Newton's method for the forces at the nodes. */
static void set_equations(const rf_march *march, const rf_step_table *table, scratch *at)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, rows = march->rotor.rows;
    const int32_t forces = channels - 2;
    const int32_t size = s * forces;
    for (int32_t i = 0; i < s; ++i)
        for (int32_t r = 0; r < forces; ++r) {
            const int32_t row = i * forces + r;
            const double *slope = at->slope + 4 * row;
            at->right[row] = at->force[row] - at->guess[i * channels + r];
            for (int32_t j = 0; j < s; ++j) {
                const double *gain = table->gain + ((i * s + j) * rows + 4 * (r / 2)) * channels;
                for (int32_t c = 0; c < forces; ++c) {
                    double total = 0.0;
                    for (int k = 0; k < 4; ++k)
                        total += slope[k] * gain[k * channels + c];
                    at->matrix[row * size + j * forces + c] = -total;
                }
            }
            at->matrix[row * size + row] += 1.0;
        }
}

/* Solve for the films' forces at the nodes, in at->guess. */
static int newton(rf_march *march, const rf_step_table *table, double t, double h, double last, scratch *at)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, rows = march->rotor.rows;
    const int32_t forces = channels - 2;
    double before = HUGE_VAL;
    int worst = RF_OK;
    for (int step = 0; step < NEWTON_STEPS; ++step) {
        const int status = set_node_forces(march, table, t, h, last, at);
        if (status >= RF_AT_WALL)
            return status;
        worst = status > worst ? status : worst;
        set_equations(march, table, at);
        march->jacobians += 1;
        if (!solve((size_t)s * (size_t)forces, at->matrix, at->right))
            return RF_NOT_FINITE;
        double change = 0.0;
        for (int32_t i = 0; i < s; ++i)
            for (int32_t q = 0; q < rows; ++q)
                change = fmax(change, fabs(gained(march, table, i, q, at->right, forces)) * march->scales[q]);
        if (!(change < HUGE_CHANGE) || (step > 1 && change > before))
            return RF_NOT_FINITE;
        for (int32_t j = 0; j < s; ++j)
            for (int32_t c = 0; c < forces; ++c)
                at->guess[j * channels + c] += at->right[j * forces + c];
        if (change < march->newton)
            return worst;
        before = change;
    }
    return RF_NOT_FINITE;
}

/* The largest motion that the gap between the force at the start and its polynomial makes, scaled. */
static double local_error(const rf_march *march, const rf_step_table *table, scratch *at)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, rows = march->rotor.rows;
    double *gap = at->right, worst = 0.0;
    for (int32_t c = 0; c < channels; ++c) {
        gap[c] = at->start[c];
        for (int32_t j = 0; j < s; ++j)
            gap[c] -= march->scheme.lagrange[j * s] * at->guess[j * channels + c];
    }
    for (int32_t i = 0; i < s; ++i)
        for (int32_t q = 0; q < rows; ++q) {
            const double *defect = table->defect + (i * rows + q) * channels;
            double total = 0.0;
            for (int32_t c = 0; c < channels; ++c)
                total += defect[c] * gap[c];
            worst = fmax(worst, fabs(total) * march->scales[q]);
        }
    return worst;
}

/* Solve one step for the forces in at->guess; a status, and the local error over rtol. */
static int try_step(rf_march *march, const rf_step_table *table, double h, double last, scratch *at,
                    double *error)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, rows = march->rotor.rows;
    const int32_t modes = march->rotor.modes;
    for (int32_t i = 0; i < s; ++i)
        unbalance(&march->profile, fmin(march->time + h * march->scheme.nodes[i], last),
                  at->guess + i * channels + channels - 2);
    for (int32_t m = 0; m < modes; ++m) {
        at->both[m] = march->z[m].re;
        at->both[modes + m] = march->z[m].im;
    }
    for (int32_t i = 0; i < s; ++i)
        for (int32_t q = 0; q < rows; ++q) {
            const double *move = table->move + (i * rows + q) * 2 * modes;
            double total = 0.0;
            for (int32_t m = 0; m < 2 * modes; ++m)
                total += move[m] * at->both[m];
            for (int32_t j = 0; j < s; ++j) {
                const double *gain = table->gain + ((i * s + j) * rows + q) * channels + channels - 2;
                const double *pair = at->guess + j * channels + channels - 2;
                total += gain[0] * pair[0] + gain[1] * pair[1];
            }
            at->free[i * rows + q] = total;
        }
    const int status = newton(march, table, march->time, h, last, at);
    *error = status >= RF_AT_WALL ? 0.0 : local_error(march, table, at) / march->rtol;
    return status;
}

/* The forces of the last step, continued to the nodes of one that is `ratio` as long. */
static void extrapolate(const rf_march *march, double ratio, const double *u, double *out)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels;
    for (int32_t i = 0; i < s; ++i) {
        const double at = 1.0 + ratio * march->scheme.nodes[i];
        double *row = out + i * channels;
        memset(row, 0, (size_t)channels * sizeof *row);
        for (int32_t j = 0; j < s; ++j) {
            const double *lagrange = march->scheme.lagrange + j * s;
            double value = 0.0;
            for (int32_t k = s - 1; k >= 0; --k)
                value = value * at + lagrange[k];
            for (int32_t c = 0; c < channels; ++c)
                row[c] += value * u[j * channels + c];
        }
    }
}

/* Films' forces and unbalance at the time of the march. */
static int set_start(const rf_march *march, scratch *at)
{
    const int32_t rows = march->rotor.rows, modes = march->rotor.modes, forces = march->rotor.channels - 2;
    for (int32_t q = 0; q < rows; ++q) {
        const rf_complex *sense = march->rotor.sense + q * modes;
        double total = 0.0;
        for (int32_t m = 0; m < modes; ++m)
            total += sense[m].re * march->z[m].re - sense[m].im * march->z[m].im;
        at->motion[q] = total;
    }
    const double w = unbalance(&march->profile, march->time, at->start + forces);
    return set_forces(&march->journals, at->motion, w, at->start, at->slope);
}

static double length_of(const rf_march *march, int32_t step)
{
    return march->longest * pow(2.0, -0.25 * step);
}

/* The tables of a length of step, filled if they are not there yet; NULL without memory. */
static const rf_step_table *table_of(rf_march *march, int32_t step)
{
    if (march->slot_of[step] >= 0)
        return &march->tables[march->slot_of[step]];
    const int32_t slot = march->next_slot;
    march->next_slot = (slot + 1) % RF_SLOTS;
    if (march->step_of[slot] >= 0)
        march->slot_of[march->step_of[slot]] = -1;
    march->step_of[slot] = march->slot_of[step] = -1;
    if (rf_set_step_table(&march->rotor, &march->scheme, length_of(march, step), &march->tables[slot]) != RF_OK)
        return NULL;
    march->step_of[slot] = step;
    march->slot_of[step] = slot;
    return &march->tables[slot];
}

static const rf_step_table *table_once(rf_march *march, double h)
{
    rf_step_table *table = &march->tables[RF_SLOTS];
    return rf_set_step_table(&march->rotor, &march->scheme, h, table) == RF_OK ? table : NULL;
}

/* Modal coordinates at the times of the grid within the step that is done. */
static int64_t sample(const rf_march *march, double h, const double *grid, int64_t count, int64_t place,
                      scratch *at, rf_complex *out)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels, modes = march->rotor.modes;
    if (place >= count || grid[place] > march->time + h)
        return place;
    for (int32_t m = 0; m < modes; ++m)
        for (int32_t j = 0; j < s; ++j) {
            double re = 0.0, im = 0.0;
            for (int32_t c = 0; c < channels; ++c) {
                re += march->rotor.push[m * channels + c].re * at->guess[j * channels + c];
                im += march->rotor.push[m * channels + c].im * at->guess[j * channels + c];
            }
            at->forced[2 * (m * s + j)] = re;
            at->forced[2 * (m * s + j) + 1] = im;
        }
    for (; place < count && grid[place] <= march->time + h; ++place) {
        const double passed = grid[place] - march->time;
        rf_set_weights(&march->rotor, h, passed / h, march->scheme.lagrange, s, s, at->weights);
        for (int32_t m = 0; m < modes; ++m) {
            rf_complex total = rf_turned(march->rotor.values[m], passed, march->z[m]);
            for (int32_t j = 0; j < s; ++j) {
                const rf_complex w = at->weights[j * modes + m];
                const double re = at->forced[2 * (m * s + j)], im = at->forced[2 * (m * s + j) + 1];
                total.re += w.re * re - w.im * im;
                total.im += w.re * im + w.im * re;
            }
            out[place * modes + m] = total;
        }
    }
    return place;
}

static void advance(rf_march *march, const rf_step_table *table, const double *u)
{
    const int32_t modes = march->rotor.modes, wide = march->scheme.stages * march->rotor.channels;
    for (int32_t m = 0; m < modes; ++m) {
        const double *by_re = table->forced + m * wide, *by_im = table->forced + (modes + m) * wide;
        double re = 0.0, im = 0.0;
        for (int32_t k = 0; k < wide; ++k) {
            re += by_re[k] * u[k];
            im += by_im[k] * u[k];
        }
        const rf_complex keep = table->keep[m], z = march->z[m];
        march->z[m].re = keep.re * z.re - keep.im * z.im + re;
        march->z[m].im = keep.re * z.im + keep.im * z.re + im;
    }
}

/* How many lengths shorter the step that follows a failed one is. */
static int32_t shorter_by(const rf_march *march, int status, double error)
{
    const double order = march->scheme.stages + 1.0, most = 40.0;
    const double change = 4.0 * log2(error / pow(0.9, order)) / order;
    return status >= RF_AT_WALL ? 8 : 1 + (int32_t)(change < most ? change : most);
}

static int32_t longer_by(const rf_march *march, double error)
{
    const double rise = floor(4.0 * log2(0.8 * pow(fmax(error, 1e-12), -1.0 / (march->scheme.stages + 1.0))));
    return rise < 0.0 ? 0 : rise > 4.0 ? 4 : (int32_t)rise;
}

/* Why a march ends where a film answers this status. */
static int end_of(int status)
{
    return status == RF_AT_WALL ? RF_MARCH_WALL : status == RF_MEMORY ? RF_MARCH_MEMORY : RF_MARCH_BROKEN;
}

static int march_on(rf_march *march, double stop, int64_t budget, const double *grid, int64_t count,
                    int64_t *place, rf_complex *out, scratch *at)
{
    const int32_t s = march->scheme.stages, channels = march->rotor.channels;
    const size_t forces = (size_t)s * (size_t)channels * sizeof *at->u;
    const double last = nextafter(stop, -HUGE_VAL);
    double before = 0.0; /* length of the step whose forces are known */
    const int start = set_start(march, at);
    if (start >= RF_AT_WALL)
        return end_of(start);
    while (march->time < stop && budget-- > 0) {
        double h = length_of(march, march->step), error;
        const int whole = march->time + WHOLE * h < stop;
        h = whole ? h : stop - march->time;
        const rf_step_table *table = whole ? table_of(march, march->step) : table_once(march, h);
        if (!table)
            return RF_MARCH_MEMORY;
        if (before > 0.0)
            extrapolate(march, h / before, at->u, at->guess);
        else
            for (int32_t i = 0; i < s; ++i)
                memcpy(at->guess + i * channels, at->start, (size_t)channels * sizeof *at->guess);
        const int status = try_step(march, table, h, last, at, &error);
        if (status == RF_MEMORY)
            return RF_MARCH_MEMORY;
        if (status >= RF_AT_WALL || !(error <= 1.0)) {
            if (h < march->shortest)
                return status >= RF_AT_WALL ? end_of(status) : RF_MARCH_SHORT;
            const int32_t of_length = (int32_t)ceil(-4.0 * log2(h / march->longest) - 1e-9);
            const int32_t step = of_length > march->step ? of_length : march->step;
            const int32_t next = step + shorter_by(march, status, error);
            march->step = next < RF_STEPS ? next : RF_STEPS - 1;
            march->rejected += 1;
            before = status >= RF_AT_WALL ? 0.0 : before;
            continue;
        }
        march->steps += 1;
        march->left_map |= status == RF_OUTSIDE;
        *place = sample(march, h, grid, count, *place, at, out);
        advance(march, table, at->guess);
        memcpy(at->u, at->guess, forces);
        memcpy(at->start, at->guess + (s - 1) * channels, (size_t)channels * sizeof *at->start);
        march->time = whole ? march->time + h : stop;
        before = h;
        if (whole) {
            const int32_t next = march->step - longer_by(march, error);
            march->step = next > 0 ? next : 0;
        }
    }
    return march->time >= stop ? RF_MARCH_DONE : RF_MARCH_BUSY;
}

int rf_march_to(rf_march *march, double stop, int64_t budget, const double *grid, int64_t count,
                int64_t *place, rf_complex *out)
{
    scratch at;
    if (open_scratch(&at, march) != RF_OK)
        return RF_MARCH_MEMORY;
    const int end = march_on(march, stop, budget, grid, count, place, out, &at);
    free(at.memory);
    return end;
}

int rf_journal_forces(const rf_journals *journals, int64_t samples, const double *motion, double speed,
                      double *force, double *slope)
{
    const int32_t forces = 2 * journals->count;
    double *now = malloc((size_t)(2 * forces + forces + 4 * forces) * sizeof *now);
    double *answer = now ? now + 2 * forces : NULL, *by = now ? answer + forces : NULL;
    int worst = now ? RF_OK : RF_MEMORY;
    for (int64_t n = 0; n < samples && worst < RF_AT_WALL; ++n) {
        for (int32_t q = 0; q < 2 * forces; ++q)
            now[q] = motion[q * samples + n];
        const int status = set_forces(journals, now, speed, answer, by);
        worst = status > worst ? status : worst;
        for (int32_t q = 0; q < forces; ++q)
            force[q * samples + n] = answer[q];
        for (int32_t q = 0; q < 4 * forces; ++q)
            slope[q * samples + n] = by[q];
    }
    free(now);
    return worst;
}
