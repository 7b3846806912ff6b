#include "resource.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAGIC "RFILMRES"
#define VERSION 2
#define MOST_BYTES ((size_t)1 << 30)

enum { HEADER = 24, MODEL = 176, VARIABLE = 96, TABLE = 64 }; /* bytes of each record */

static uint32_t read_u32(const unsigned char *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static uint64_t read_u64(const unsigned char *at)
{
    return (uint64_t)read_u32(at) | (uint64_t)read_u32(at + 4) << 32;
}

static double read_double(const unsigned char *at)
{
    const uint64_t bits = read_u64(at);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* By half bytes. */
uint32_t rf_checksum(const unsigned char *bytes, size_t count)
{
    static const uint32_t STEP[16] = {0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4,
                                      0x4db26158, 0x5005713c, 0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                      0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};
    uint32_t sum = 0xffffffffu;
    for (size_t i = 0; i < count; ++i) {
        sum = STEP[(sum ^ bytes[i]) & 15] ^ sum >> 4;
        sum = STEP[(sum ^ (uint32_t)(bytes[i] >> 4)) & 15] ^ sum >> 4;
    }
    return ~sum;
}

/* A text that fills its field with zeros behind it; 0 if it does not. */
static int read_text(const unsigned char *at, char *text, size_t size)
{
    memcpy(text, at, size);
    return text[size - 1] == '\0';
}

static int read_variable(const unsigned char *at, rf_resource *to, rf_variable *v, rf_message *why)
{
    const uint32_t role = read_u32(at);
    v->index = read_u32(at + 4);
    v->flags = read_u32(at + 8);
    v->more = read_u32(at + 12);
    v->start = read_double(at + 16);
    v->minimum = read_double(at + 24);
    v->maximum = read_double(at + 32);
    v->nominal = read_double(at + 40);
    if (!read_text(at + 48, v->name, sizeof v->name) || role >= RF_ROLES || v->index != to->count[role]
        || !isfinite(v->start) || !(v->nominal > 0.0 && v->nominal < HUGE_VAL))
        return rf_say(why, RF_INVALID, "variable %zu of %s is no variable", to->variable_count, RF_RESOURCE_FILE);
    v->role = (rf_role)role;
    to->count[role] += 1;
    to->variable_count += 1;
    return RF_OK;
}

/* Numbers of a table, or 0 if it does not lie within the file. */
static int measure(const unsigned char *at, size_t size, rf_table *table, size_t *numbers)
{
    const uint64_t offset = read_u64(at + 56);
    size_t count = 1;
    table->axes = read_u32(at + 32);
    if (!read_text(at, table->name, sizeof table->name) || table->axes > RF_MOST_AXES || offset > size)
        return 0;
    for (uint32_t k = 0; k < RF_MOST_AXES; ++k) {
        table->extent[k] = read_u32(at + 36 + 4 * k);
        if (k < table->axes && table->extent[k] && count > MOST_BYTES / table->extent[k])
            return 0;
        count *= k < table->axes ? table->extent[k] : 1;
    }
    *numbers = count;
    const size_t room = (size_t)(size - offset);
    return read_u32(at + 52) ? room >= 8 && count <= (room - 8) / 4 : count <= room / 8;
}

static void read_doubles(const unsigned char *from, size_t count, double *numbers)
{
    for (size_t k = 0; k < count; ++k)
        numbers[k] = read_double(from + 8 * k);
}

/* A quantum, and the third differences of its multiples modulo 2^32, the lowest bytes of all first. */
static void read_quanta(const unsigned char *from, size_t count, double *numbers)
{
    const double quantum = read_double(from);
    uint32_t sum[3] = {0, 0, 0};
    from += 8;
    for (size_t k = 0; k < count; ++k) {
        uint32_t step = 0;
        for (size_t plane = 0; plane < 4; ++plane)
            step |= (uint32_t)from[plane * count + k] << 8 * plane;
        sum[0] += step;
        sum[1] += sum[0];
        sum[2] += sum[1];
        numbers[k] = quantum * (int32_t)sum[2];
    }
}

static int read_tables(const unsigned char *bytes, size_t size, size_t directory, rf_resource *to,
                       rf_message *why)
{
    rf_table *list = calloc(to->tables.count + 1, sizeof *list);
    size_t total = 0, count;
    to->tables.list = list;
    if (!list)
        return rf_say(why, RF_MEMORY, "no memory for the tables of %s", RF_RESOURCE_FILE);
    for (size_t i = 0; i < to->tables.count; ++i) {
        if (!measure(bytes + directory + i * TABLE, size, list + i, &count))
            return rf_say(why, RF_INVALID, "table %zu of %s is no table", i, RF_RESOURCE_FILE);
        total += count;
    }
    to->numbers = total <= size ? malloc((total + 1) * sizeof *to->numbers) : NULL;
    if (!to->numbers)
        return rf_say(why, RF_MEMORY, "no memory for the %zu numbers of %s", total, RF_RESOURCE_FILE);
    double *next = to->numbers;
    for (size_t i = 0; i < to->tables.count; ++i) {
        const unsigned char *entry = bytes + directory + i * TABLE, *from = bytes + read_u64(entry + 56);
        (void)measure(entry, size, list + i, &count);
        list[i].numbers = next;
        (read_u32(entry + 52) ? read_quanta : read_doubles)(from, count, next);
        for (const double *end = next + count; next < end; ++next)
            if (!isfinite(*next))
                return rf_say(why, RF_INVALID, "table %s of %s must be finite", list[i].name, RF_RESOURCE_FILE);
    }
    return RF_OK;
}

static int read_model(const unsigned char *bytes, size_t size, rf_resource *to, rf_message *why)
{
    const unsigned char *model = bytes + HEADER;
    const size_t variables = read_u32(model + 160), tables = read_u32(model + 164);
    if (!read_text(model, to->token, sizeof to->token)
        || !read_text(model + 128, to->kernel, sizeof to->kernel) || variables > size / VARIABLE
        || tables > size / TABLE || HEADER + MODEL + variables * VARIABLE + tables * TABLE > size)
        return rf_say(why, RF_INVALID, "%s has no room for %zu variables and %zu tables", RF_RESOURCE_FILE,
                      variables, tables);
    to->variables = calloc(variables + 1, sizeof *to->variables);
    if (!to->variables)
        return rf_say(why, RF_MEMORY, "no memory for the variables of %s", RF_RESOURCE_FILE);
    for (size_t i = 0; i < variables; ++i)
        if (read_variable(model + MODEL + i * VARIABLE, to, to->variables + i, why) != RF_OK)
            return RF_INVALID;
    for (size_t i = 0; i < variables; ++i)
        if (to->variables[i].more >= variables - i
            || to->variables[i + to->variables[i].more].role != to->variables[i].role)
            return rf_say(why, RF_INVALID, "array %zu of %s is longer than its role", i, RF_RESOURCE_FILE);
    to->tables.count = tables;
    return read_tables(bytes, size, HEADER + MODEL + variables * VARIABLE, to, why);
}

static int check(const unsigned char *bytes, size_t size, rf_message *why)
{
    if (size < HEADER + MODEL || memcmp(bytes, MAGIC, 8) != 0)
        return rf_say(why, RF_INVALID, "%s must begin with %s, got %zu bytes of something else", RF_RESOURCE_FILE,
                      MAGIC, size);
    if (read_u32(bytes + 8) != VERSION)
        return rf_say(why, RF_INVALID, "%s must be of version %u, got %u", RF_RESOURCE_FILE, VERSION,
                      (unsigned)read_u32(bytes + 8));
    if (read_u64(bytes + 16) != size)
        return rf_say(why, RF_INVALID, "%s must have %.0f bytes, got %zu", RF_RESOURCE_FILE,
                      (double)read_u64(bytes + 16), size);
    if (read_u32(bytes + 12) != rf_checksum(bytes + HEADER, size - HEADER))
        return rf_say(why, RF_INVALID, "%s is damaged, its checksum is wrong", RF_RESOURCE_FILE);
    return RF_OK;
}

static rf_resource *parse(const unsigned char *bytes, size_t size, rf_message *why)
{
    if (check(bytes, size, why) != RF_OK)
        return NULL;
    rf_resource *made = calloc(1, sizeof *made);
    if (!made) {
        rf_say(why, RF_MEMORY, "no memory for %s", RF_RESOURCE_FILE);
        return NULL;
    }
    made->checksum = read_u32(bytes + 12);
    if (read_model(bytes, size, made, why) != RF_OK) {
        rf_free_resource(made);
        return NULL;
    }
    return made;
}

/* All bytes of a file, to be freed. */
static unsigned char *slurp(FILE *file, size_t *size)
{
    if (fseek(file, 0, SEEK_END) != 0)
        return NULL;
    const long end = ftell(file);
    if (end < 0 || (unsigned long)end > MOST_BYTES || fseek(file, 0, SEEK_SET) != 0)
        return NULL;
    *size = (size_t)end;
    unsigned char *bytes = malloc(*size + 1);
    if (bytes && fread(bytes, 1, *size, file) != *size) {
        free(bytes);
        bytes = NULL;
    }
    return bytes;
}

rf_resource *rf_read_resource(const char *path, rf_message *why)
{
    size_t size = 0;
    FILE *file = fopen(path, "rb");
    unsigned char *bytes = file ? slurp(file, &size) : NULL;
    if (file)
        fclose(file);
    if (!bytes) {
        rf_say(why, RF_INVALID, "the file %.200s of the FMU cannot be read", path);
        return NULL;
    }
    rf_resource *made = parse(bytes, size, why);
    free(bytes);
    return made;
}

void rf_free_resource(rf_resource *resource)
{
    if (!resource)
        return;
    free(resource->variables);
    free((void *)resource->tables.list);
    free(resource->numbers);
    free(resource);
}
