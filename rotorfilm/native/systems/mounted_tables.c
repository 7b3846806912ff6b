#include "mounted.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 500

static const rf_kernel_type *const KINDS[] = {
    &rf_journal_type,
    &rf_grooved_journal_type,
    &rf_short_journal_type,
    &rf_damper_type,
    &rf_oil_damper_type,
    &rf_short_damper_type,
    &rf_polar_damper_type,
    &rf_polar_journal_type,
#if !defined(RF_SUBSET) || (RF_SUBSET & RF_ROTORFILM_GRID_SYSTEMS)
    &rf_reynolds_journal_type,
    &rf_pressure_dam_type,
    &rf_lobed_journal_type,
    &rf_turbulent_journal_type,
#endif
};
enum { KIND_COUNT = sizeof KINDS / sizeof *KINDS };

void rf_mounted_release(void *kernel)
{
    rf_mounted *self = kernel;
    for (size_t k = 0; self->bearing && k < self->bearings; ++k) {
        rf_destroy_kernel(self->bearing[k].type, self->bearing[k].kernel);
        free(self->bearing[k].tables);
    }
    free(self->bearing);
    rf_free_profile(&self->profile);
    free(self->numbers);
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

static int take_matrices(rf_mounted *self, const rf_tables *tables, rf_message *why)
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
    const rf_table *planes = rf_find_table(tables, "planes", 2, why);
    if (!planes)
        return RF_INVALID;
    self->plane_count = planes->extent[1] / 2;
    const int whole = (self->steady = take(tables, "steady", n, 2 * n, why)) != NULL
                      && (self->spin = take(tables, "spin", n, 2 * n, why)) != NULL
                      && (self->push = take(tables, "push", n, m, why)) != NULL
                      && (self->carry = take(tables, "carry", n, 2 * b, why)) != NULL
                      && (self->weight = take(tables, "weight", n, 1, why)) != NULL
                      && (self->fixed = take(tables, "unbalance", n, 2, why)) != NULL
                      && (self->planes = take(tables, "planes", n, 2 * self->plane_count, why)) != NULL
                      && (self->sense = take(tables, "sense", s, 2 * n, why)) != NULL
                      && (self->motion = take(tables, "motion", 4 * b, 2 * n, why)) != NULL;
    self->driven = rf_seek_table(tables, "times") == NULL;
    return !whole ? RF_INVALID : self->driven ? RF_OK : rf_take_profile(&self->profile, tables, why);
}

static int allocate(rf_mounted *self, rf_message *why)
{
    const size_t n = self->n, b = self->bearings;
    double *at = self->numbers =
        calloc(4 * b + 2 * b + 10 * b + 2 * b + 3 * n * n + 4 * n * b + 8 * b * b + 7 * n + 17 * b + 4 * b * b, sizeof *at);
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
    self->right = at, at += 4 * n;
    self->mass = at, at += 3 * b;
    self->mass_by = at, at += 12 * b;
    self->acceleration = at, at += 2 * b;
    self->joint = at, at += 4 * b * b;
    self->turning = at, at += n;
    self->unbalance = self->turned = at;
    memcpy(self->turned, self->fixed, 2 * n * sizeof *at);
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

static int take_bearing(rf_mounted_bearing *self, const double *entry, const rf_tables *tables, rf_message *why)
{
    rf_sizes sizes = {0, 0, 0, 0, 0};
    if (!(entry[0] >= 0.0 && entry[0] < KIND_COUNT && entry[1] >= 0.0 && entry[1] < MOST))
        return rf_say(why, RF_INVALID, "bearings must be of a kind below %d and a set of tables below %d",
                      KIND_COUNT, MOST);
    self->tables = calloc(tables->count, sizeof *self->tables);
    if (!self->tables)
        return rf_say(why, RF_MEMORY, "no memory for the tables of a bearing");
    const rf_tables set = tables_of_set(tables, (unsigned)entry[1], self->tables);
    self->type = KINDS[(size_t)entry[0]];
    self->kernel = rf_create_kernel(self->type, &set, &sizes, why);
    self->parameters = sizes.parameters;
    self->inputs = sizes.inputs;
    self->heavy = self->kernel && self->type->adds_mass && sizes.outputs == 5;
    return self->kernel ? RF_OK : RF_INVALID;
}

static int take_bearings(rf_mounted *self, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
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
        self->masses += self->bearing[k].heavy != 0;
    }
    return RF_OK;
}

int rf_mounted_take(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    rf_mounted *self = kernel;
    sizes->parameters = 0;
    if (take_matrices(self, tables, why) != RF_OK || allocate(self, why) != RF_OK
        || take_bearings(self, tables, sizes, why) != RF_OK)
        return RF_INVALID;
    sizes->parameters += (self->profile.points == 1) + 2 * self->plane_count;
    sizes->inputs = self->inputs + 2 * self->driven;
    sizes->outputs = self->sensed + 1 + 2 * self->bearings + 3 * self->masses;
    sizes->states = 2 * self->n + self->driven;
    return RF_OK;
}
