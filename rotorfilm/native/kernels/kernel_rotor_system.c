/* Kernel "rotor_system": a rotor with its bearings, as one system (rotors/mounted.py).

   With x = (q, q') of N coordinates, the angular speed w and the forces f of the bearings

       q'' = (steady + w spin) x + push u + carry f + weight + unbalance (w^2 cos p + a sin p, w^2 sin p - a cos p)

   with the angle p, p' = w, w' = a; a bearing answers f at (motion x, w), its four rows of it. Tables: steady,
   spin (N, 2N), push (N, inputs), carry (N, 2 bearings), weight (N), unbalance (N, 2), sense (m, 2N), motion
   (4 bearings, 2N); times, speeds: the profile of the speed; bearings (b, 2): kind, as in KINDS, and set k of
   its tables, which are named "k.name". Parameters: those of the bearings in turn; constant_speed where the
   profile has one point. Outputs: sense x, w, f. */

/* Documentation of the FMU

   Model: A rotor and the film bearings it runs in, as one system. x and y are Cartesian, rotation is
   positive about +z (from x to y); a film force acts on the journal. With the angular speed w, the angle
   p(t) turned, w = dp/dt, a = dw/dt, and the motion of the journals in their housings:

   Equations:
   q'' = (steady + w spin) (q, q') + push u + carry f + weight
         + unbalance (w^2 cos p + a sin p, w^2 sin p - a cos p)
   f = film force of each bearing at (motion (q, q'), w)

   Validity: Small displacements of the rotor, a speed given over time (piecewise linear); each film as the
   FMU of that bearing says. q are the coordinates of the rotor, reduced or not. Co-Simulation integrates
   rotor and films together by RODAS, of order 4, L-stable, with the exact Jacobian: no macro step is too
   long for stability. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../solvers/dense.h"
#include "../solvers/integrate.h"
#include "../solvers/profile.h"

#define MOST 500

static const rf_kernel_type *const KINDS[] = {
    &rf_journal_type,
    &rf_grooved_journal_type,
    &rf_short_journal_type,
#if !defined(RF_SUBSET) || (RF_SUBSET & RF_ROTORFILM_GRID_SYSTEMS)
    &rf_reynolds_journal_type,
    &rf_pressure_dam_type,
#endif
};
enum { KIND_COUNT = sizeof KINDS / sizeof *KINDS };

typedef struct bearing {
    const rf_kernel_type *type;
    void *kernel;
    rf_table *tables;
    size_t parameters;
} bearing;

typedef struct model {
    size_t n, bearings, inputs, sensed; /* n: coordinates */
    const double *steady, *spin, *push, *carry, *weight, *unbalance, *sense, *motion;
    rf_profile profile;
    bearing *bearing;
    double *numbers; /* one block behind all that follows */
    double *moved, *force, *by_motion, *by_speed;     /* of the bearings at one point: (4b), (2b), (b, 2, 5), (2b) */
    double *inverse, *response, *reaction;            /* (n, n); (2n, 2b) to forces; (2b, 2b) */
    double *rates, *spare, *right;                    /* (n, n), (n, n); (2n) */
    double shift, speed;                              /* of the inverse; shift 0 as long as there is none */
} model;

static void destroy(void *kernel)
{
    model *self = kernel;
    for (size_t k = 0; self->bearing && k < self->bearings; ++k) {
        if (self->bearing[k].kernel)
            self->bearing[k].type->destroy(self->bearing[k].kernel);
        free(self->bearing[k].tables);
    }
    free(self->bearing);
    rf_free_profile(&self->profile);
    free(self->numbers);
    free(self);
}

/* Numbers of a table of this shape, which may be 0 x columns; NULL with the message if there is none. */
static const double *take(const rf_tables *tables, const char *name, size_t rows, size_t columns,
                          rf_message *why)
{
    static const double NONE[1] = {0.0};
    const rf_table *table = rf_find_table(tables, name, 2, why);
    if (!table)
        return NULL;
    if (table->extent[0] == rows && table->extent[1] == columns)
        return rows == 0 || columns == 0 ? NONE : table->numbers;
    rf_say(why, RF_INVALID, "table %s must be %zu x %zu, got %u x %u", name, rows, columns,
           (unsigned)table->extent[0], (unsigned)table->extent[1]);
    return NULL;
}

static int take_matrices(model *self, const rf_tables *tables, rf_message *why)
{
    const rf_table *carry = rf_find_table(tables, "carry", 2, why);
    const rf_table *push = carry ? rf_find_table(tables, "push", 2, why) : NULL;
    const rf_table *sense = push ? rf_find_table(tables, "sense", 2, why) : NULL;
    if (!sense)
        return RF_INVALID;
    const size_t n = self->n = carry->extent[0], b = self->bearings = carry->extent[1] / 2;
    const size_t m = self->inputs = push->extent[1], s = self->sensed = sense->extent[0];
    if (n == 0 || n > MOST || b == 0 || b > MOST || m > MOST || s > MOST)
        return rf_say(why, RF_INVALID, "carry, push and sense must be of 1 to %d rows, got %zu, %zu, %zu, %zu",
                      MOST, n, b, m, s);
    const int whole = (self->steady = take(tables, "steady", n, 2 * n, why)) != NULL
                      && (self->spin = take(tables, "spin", n, 2 * n, why)) != NULL
                      && (self->push = take(tables, "push", n, m, why)) != NULL
                      && (self->carry = take(tables, "carry", n, 2 * b, why)) != NULL
                      && (self->weight = take(tables, "weight", n, 1, why)) != NULL
                      && (self->unbalance = take(tables, "unbalance", n, 2, why)) != NULL
                      && (self->sense = take(tables, "sense", s, 2 * n, why)) != NULL
                      && (self->motion = take(tables, "motion", 4 * b, 2 * n, why)) != NULL;
    return whole ? rf_take_profile(&self->profile, tables, why) : RF_INVALID;
}

static int allocate(model *self, rf_message *why)
{
    const size_t n = self->n, b = self->bearings;
    double *at = self->numbers =
        calloc(4 * b + 2 * b + 10 * b + 2 * b + 3 * n * n + 4 * n * b + 8 * b * b + 4 * n, sizeof *at);
    if (!at)
        return rf_say(why, RF_MEMORY, "no memory for a system of %zu coordinates", n);
    self->moved = at, at += 4 * b;
    self->force = at, at += 2 * b;
    self->by_motion = at, at += 10 * b;
    self->by_speed = at, at += 2 * b;
    self->inverse = at, at += n * n;
    self->rates = at, at += n * n;
    self->spare = at, at += n * n;
    self->response = at, at += 4 * n * b;
    self->reaction = at, at += 8 * b * b;
    self->right = at;
    return RF_OK;
}

/* The tables of set k under their own names. */
static rf_tables tables_of_set(const rf_tables *tables, unsigned k, rf_table *kept)
{
    char prefix[16];
    const size_t length = (size_t)snprintf(prefix, sizeof prefix, "%u.", k);
    rf_tables set = {kept, 0};
    for (size_t i = 0; i < tables->count; ++i)
        if (strncmp(tables->list[i].name, prefix, length) == 0) {
            kept[set.count] = tables->list[i];
            memmove(kept[set.count].name, kept[set.count].name + length,
                    sizeof kept->name - length);
            ++set.count;
        }
    return set;
}

static int take_bearing(bearing *self, const double *entry, const rf_tables *tables, rf_message *why)
{
    rf_sizes sizes;
    if (!(entry[0] >= 0.0 && entry[0] < KIND_COUNT && entry[1] >= 0.0 && entry[1] < MOST))
        return rf_say(why, RF_INVALID, "bearings must be of a kind below %d and a set of tables below %d",
                      KIND_COUNT, MOST);
    self->tables = calloc(tables->count, sizeof *self->tables);
    if (!self->tables)
        return rf_say(why, RF_MEMORY, "no memory for the tables of a bearing");
    const rf_tables set = tables_of_set(tables, (unsigned)entry[1], self->tables);
    self->type = KINDS[(size_t)entry[0]];
    self->kernel = self->type->create(&set, &sizes, why);
    self->parameters = sizes.parameters;
    return self->kernel ? RF_OK : RF_INVALID;
}

static int take_bearings(model *self, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    const double *list = take(tables, "bearings", self->bearings, 2, why);
    if (!list)
        return RF_INVALID;
    self->bearing = calloc(self->bearings, sizeof *self->bearing);
    if (!self->bearing)
        return rf_say(why, RF_MEMORY, "no memory for %zu bearings", self->bearings);
    for (size_t k = 0; k < self->bearings; ++k) {
        if (take_bearing(self->bearing + k, list + 2 * k, tables, why) != RF_OK)
            return RF_INVALID;
        sizes->parameters += self->bearing[k].parameters;
    }
    return RF_OK;
}

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = calloc(1, sizeof *self);
    if (!self) {
        rf_say(why, RF_MEMORY, "no memory for a system");
        return NULL;
    }
    sizes->parameters = 0;
    if (take_matrices(self, tables, why) != RF_OK || allocate(self, why) != RF_OK
        || take_bearings(self, tables, sizes, why) != RF_OK) {
        destroy(self);
        return NULL;
    }
    sizes->parameters += self->profile.points == 1;
    sizes->inputs = self->inputs;
    sizes->outputs = self->sensed + 1 + 2 * self->bearings;
    sizes->states = 2 * self->n;
    return self;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *self = kernel;
    for (size_t k = 0; k < self->bearings; p += self->bearing[k++].parameters)
        if (self->bearing[k].type->set_parameters(self->bearing[k].kernel, p, why) != RF_OK)
            return RF_INVALID;
    if (self->profile.points == 1) {
        if (!isfinite(*p))
            return rf_say(why, RF_INVALID, "constant_speed must be finite, got %.9g", *p);
        self->profile.speeds[0] = *p;
    }
    self->shift = 0.0;
    return RF_OK;
}

/* Forces of all bearings, and their derivatives if asked for. */
static int react(const model *self, double speed, const double *x, int derivatives, rf_message *why)
{
    int worst = RF_OK;
    const size_t b = self->bearings;
    memset(self->moved, 0, 4 * b * sizeof *self->moved);
    rf_add_product(4 * b, 2 * self->n, 1.0, self->motion, x, self->moved);
    for (size_t k = 0; k < b; ++k) {
        const double *m = self->moved + 4 * k, u[5] = {m[0], m[1], m[2], m[3], speed};
        const rf_point at = {0.0, NULL, u};
        const bearing *one = self->bearing + k;
        rf_jacobian jacobian = {NULL, NULL, NULL, self->by_motion + 10 * k};
        int status = one->type->output(one->kernel, &at, self->force + 2 * k, why);
        if (derivatives && status <= RF_OUTSIDE)
            status = one->type->jacobian(one->kernel, &at, &jacobian, why);
        if (status > RF_OUTSIDE)
            return status;
        worst = status > worst ? status : worst;
        for (size_t i = 0; derivatives && i < 2; ++i)
            self->by_speed[2 * k + i] = self->by_motion[10 * k + 5 * i + 4];
    }
    return worst;
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    const model *self = kernel;
    const size_t n = self->n;
    const rf_spin spin = rf_spin_at(&self->profile, at->t);
    double shake[2], *rate = dx + n;
    const int status = react(self, spin.speed, at->x, 0, why);
    if (status > RF_OUTSIDE)
        return status;
    rf_shake(&spin, shake);
    memcpy(dx, at->x + n, n * sizeof *dx);
    memcpy(rate, self->weight, n * sizeof *dx);
    rf_add_product(n, 2 * n, 1.0, self->steady, at->x, rate);
    rf_add_product(n, 2 * n, spin.speed, self->spin, at->x, rate);
    rf_add_product(n, self->inputs, 1.0, self->push, at->u, rate);
    rf_add_product(n, 2 * self->bearings, 1.0, self->carry, self->force, rate);
    rf_add_product(n, 2, 1.0, self->unbalance, shake, rate);
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(rate[i]))
            return rf_say(why, RF_NOT_FINITE, "acceleration %zu is not finite at t = %.9g s", i, at->t);
    return status;
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    const double speed = rf_spin_at(&self->profile, at->t).speed;
    const int status = react(self, speed, at->x, 0, why);
    memset(y, 0, self->sensed * sizeof *y);
    rf_add_product(self->sensed, 2 * self->n, 1.0, self->sense, at->x, y);
    y[self->sensed] = speed;
    memcpy(y + self->sensed + 1, self->force, 2 * self->bearings * sizeof *y);
    return status;
}

/* forced[2b][2n]: derivative of the forces by the states. */
static void chain(const model *self, double *forced)
{
    const size_t twice = 2 * self->n;
    memset(forced, 0, 2 * self->bearings * twice * sizeof *forced);
    for (size_t k = 0; k < self->bearings; ++k)
        for (size_t i = 0; i < 2; ++i)
            for (size_t c = 0; c < 4; ++c) {
                const double by = self->by_motion[10 * k + 5 * i + c];
                for (size_t j = 0; j < twice; ++j)
                    forced[(2 * k + i) * twice + j] += by * self->motion[(4 * k + c) * twice + j];
            }
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    const size_t n = self->n, twice = 2 * n, m = self->inputs, b = self->bearings, s = self->sensed;
    const double speed = rf_spin_at(&self->profile, at->t).speed;
    double *const forced = answer->C + (s + 1) * twice;
    const int status = react(self, speed, at->x, 1, why);
    if (status > RF_OUTSIDE)
        return status;
    memset(answer->A, 0, twice * n * sizeof(double));
    memset(answer->B, 0, n * m * sizeof(double));
    memset(answer->D, 0, (s + 1 + 2 * b) * m * sizeof(double));
    memcpy(answer->B + n * m, self->push, n * m * sizeof(double));
    memcpy(answer->C, self->sense, s * twice * sizeof(double));
    memset(answer->C + s * twice, 0, twice * sizeof(double));
    chain(self, forced);
    for (size_t i = 0; i < n; ++i) {
        double *row = answer->A + (n + i) * twice;
        answer->A[i * twice + n + i] = 1.0;
        for (size_t j = 0; j < twice; ++j)
            row[j] = self->steady[i * twice + j] + speed * self->spin[i * twice + j];
        for (size_t k = 0; k < 2 * b; ++k)
            for (size_t j = 0; j < twice; ++j)
                row[j] += self->carry[i * 2 * b + k] * forced[k * twice + j];
    }
    return status;
}

static void drift(const void *kernel, const rf_point *at, double *slope)
{
    const model *self = kernel;
    const size_t n = self->n;
    const rf_spin spin = rf_spin_at(&self->profile, at->t);
    const double w = spin.speed, a = spin.acceleration, c = cos(spin.angle), s = sin(spin.angle);
    const double shake[2] = {3.0 * w * a * c - w * w * w * s, 3.0 * w * a * s + w * w * w * c};
    memset(slope, 0, 2 * n * sizeof *slope);
    rf_add_product(n, 2, 1.0, self->unbalance, shake, slope + n);
    if (a != 0.0) {
        rf_add_product(n, 2 * n, a, self->spin, at->x, slope + n);
        rf_add_product(n, 2 * self->bearings, a, self->carry, self->by_speed, slope + n);
    }
}

/* Solve (shift I - A) b' = b of the rotor without bearings: q' = shift q - b1 leaves n equations for q. */
static void solve_free(const model *self, double *b)
{
    const size_t n = self->n;
    double *const right = self->right, *q = right + n;
    memcpy(right, b + n, n * sizeof *b);
    for (size_t i = 0; i < n; ++i)
        right[i] += self->shift * b[i];
    rf_add_product(n, n, -1.0, self->rates, b, right);
    memset(q, 0, n * sizeof *q);
    rf_add_product(n, n, 1.0, self->inverse, right, q);
    for (size_t i = 0; i < n; ++i) {
        b[n + i] = self->shift * q[i] - b[i];
        b[i] = q[i];
    }
}

/* What depends on shift and speed only: the inverse, and the response of the free rotor to the forces. */
static void invert(model *self, double shift, double speed)
{
    const size_t n = self->n, columns = 2 * self->bearings;
    double *const q = self->spare;
    memset(self->inverse, 0, n * n * sizeof *self->inverse);
    for (size_t i = 0; i < n; ++i) {
        const double *steady = self->steady + 2 * n * i, *spin = self->spin + 2 * n * i;
        for (size_t j = 0; j < n; ++j) {
            self->rates[i * n + j] = steady[n + j] + speed * spin[n + j];
            q[i * n + j] = -steady[j] - speed * spin[j] - shift * self->rates[i * n + j];
        }
        q[i * n + i] += shift * shift;
        self->inverse[i * n + i] = 1.0;
    }
    rf_eliminate(n, q, n, self->inverse);
    self->shift = shift;
    self->speed = speed;
    for (size_t k = 0; k < columns; ++k) {
        double *const column = self->response + 2 * n * k;
        memset(column, 0, n * sizeof *column);
        for (size_t i = 0; i < n; ++i)
            column[n + i] = self->carry[i * columns + k];
        solve_free(self, column);
    }
}

/* forces[2b] by the motion[4b] of the journals, linearized. */
static void add_linear_forces(const model *self, const double *motion, double *forces)
{
    for (size_t k = 0; k < self->bearings; ++k)
        for (size_t i = 0; i < 2; ++i)
            for (size_t c = 0; c < 4; ++c)
                forces[2 * k + i] += self->by_motion[10 * k + 5 * i + c] * motion[4 * k + c];
}

/* Inverse of I - (forces by motion) (motion by forces): the bearings close the loop. */
static int close_loop(const model *self, rf_message *why)
{
    const size_t f = 2 * self->bearings;
    double *const inverse = self->reaction, *const open = inverse + f * f;
    memset(inverse, 0, f * f * sizeof *inverse);
    for (size_t j = 0; j < f; ++j) {
        double *const forces = self->force; /* spent: the next derivative writes it anew */
        memset(self->moved, 0, 2 * f * sizeof *self->moved);
        memset(forces, 0, f * sizeof *forces);
        rf_add_product(2 * f, 2 * self->n, 1.0, self->motion, self->response + 2 * self->n * j, self->moved);
        add_linear_forces(self, self->moved, forces);
        for (size_t i = 0; i < f; ++i)
            open[i * f + j] = (i == j) - forces[i];
        inverse[j * f + j] = 1.0;
    }
    rf_eliminate(f, open, f, inverse);
    for (size_t i = 0; i < f * f; ++i)
        if (!isfinite(inverse[i]))
            return rf_say(why, RF_NOT_FINITE, "the step has no solution: its matrix is singular");
    return RF_OK;
}

static int factorize(void *kernel, const rf_point *at, double shift, rf_message *why)
{
    model *self = kernel;
    const double speed = rf_spin_at(&self->profile, at->t).speed;
    const int status = react(self, speed, at->x, 1, why);
    if (status > RF_OUTSIDE)
        return status;
    if (shift != self->shift || speed != self->speed)
        invert(self, shift, speed);
    return close_loop(self, why) == RF_OK ? status : RF_NOT_FINITE;
}

static void solve(void *kernel, double *b)
{
    const model *self = kernel;
    const size_t n = self->n, f = 2 * self->bearings;
    double *const forces = self->force, *const linear = self->moved + f; /* f of the 2f numbers of `moved` */
    solve_free(self, b);
    memset(self->moved, 0, 2 * f * sizeof *self->moved);
    rf_add_product(2 * f, 2 * n, 1.0, self->motion, b, self->moved);
    memset(forces, 0, f * sizeof *forces);
    add_linear_forces(self, self->moved, forces);
    memset(linear, 0, f * sizeof *linear);
    rf_add_product(f, f, 1.0, self->reaction, forces, linear);
    for (size_t k = 0; k < f; ++k)
        for (size_t i = 0; i < 2 * n; ++i)
            b[i] += linear[k] * self->response[2 * n * k + i];
}

static double next_event(const void *kernel, double t)
{
    return rf_next_point(&((const model *)kernel)->profile, t);
}

const rf_kernel_type rf_rotor_system_type = {
    .create = create,
    .destroy = destroy,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .method = &rf_rodas,
    .factorize = factorize,
    .solve = solve,
    .drift = drift,
    .next_event = next_event,
};
