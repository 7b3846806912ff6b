#include "kernel.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef RF_SUBSET
#define RF_SUBSET ~0
#endif

const rf_kernel_type *rf_find_kernel(const char *name)
{
#define RF_KERNEL(kernel, libraries, picture)                                                              \
    if (((libraries) & (RF_SUBSET)) != 0 && strcmp(name, #kernel) == 0)                                    \
        return &rf_##kernel##_type;
#include "kernel_list.h"
    return NULL;
}

const rf_table *rf_seek_table(const rf_tables *tables, const char *name)
{
    for (size_t i = 0; i < tables->count; ++i)
        if (strcmp(tables->list[i].name, name) == 0)
            return tables->list + i;
    return NULL;
}

const rf_table *rf_find_table(const rf_tables *tables, const char *name, uint32_t axes, rf_message *why)
{
    const rf_table *table = rf_seek_table(tables, name);
    if (table && table->axes == axes)
        return table;
    if (table)
        rf_say(why, RF_INVALID, "table %s must have %u axes, got %u", name, (unsigned)axes, (unsigned)table->axes);
    else
        rf_say(why, RF_INVALID, "tables must contain %s, got %zu others", name, tables->count);
    return NULL;
}

const double *rf_numbers(const rf_tables *tables, const char *name, uint32_t count, rf_message *why)
{
    const rf_table *found = rf_find_table(tables, name, 1, why);
    if (found && found->extent[0] != count) {
        rf_say(why, RF_INVALID, "table %s must have %u numbers, got %u", name, (unsigned)count,
               (unsigned)found->extent[0]);
        return NULL;
    }
    return found ? found->numbers : NULL;
}

void *rf_create_kernel(const rf_kernel_type *type, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    void *kernel = calloc(1, type->bytes);
    if (!kernel)
        rf_say(why, RF_MEMORY, "no memory for a kernel");
    else if (type->take(kernel, tables, sizes, why) == RF_OK)
        return kernel;
    rf_destroy_kernel(type, kernel);
    return NULL;
}

void rf_destroy_kernel(const rf_kernel_type *type, void *kernel)
{
    if (kernel && type->release)
        type->release(kernel);
    free(kernel);
}

int rf_say(rf_message *message, int status, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vsnprintf(message->text, sizeof message->text, format, values);
    va_end(values);
    return status;
}
