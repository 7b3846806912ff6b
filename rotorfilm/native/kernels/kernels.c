#include "kernel.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The kernels of this library. Compiled without RF_SUBSET, as from the sources in an FMU, it has all. */
extern const rf_kernel_type rf_bush_reaction_type, rf_bush_wear_type, rf_contact_type, rf_damper_type;
extern const rf_kernel_type rf_grooved_journal_type, rf_journal_type, rf_linear_type, rf_rigid_rotor_type,
    rf_rotor_system_type, rf_short_journal_type;

static const rf_kernel_type *const KERNELS[] = {
#if !defined(RF_SUBSET) || RF_SUBSET == 1
    &rf_damper_type,
#endif
#if !defined(RF_SUBSET) || RF_SUBSET == 2
    &rf_contact_type,
    &rf_linear_type,
    &rf_rigid_rotor_type,
#endif
#if !defined(RF_SUBSET) || RF_SUBSET == 4
    &rf_bush_reaction_type,
    &rf_bush_wear_type,
#endif
#if !defined(RF_SUBSET) || RF_SUBSET == 1 || RF_SUBSET == 3
    &rf_grooved_journal_type,
    &rf_journal_type,
    &rf_short_journal_type,
#endif
#if !defined(RF_SUBSET) || RF_SUBSET == 3
    &rf_rotor_system_type,
#endif
    NULL,
};

const rf_kernel_type *rf_find_kernel(const char *name)
{
    const rf_kernel_type *const *kernel = KERNELS;
    while (*kernel && strcmp((*kernel)->name, name) != 0)
        ++kernel;
    return *kernel;
}

const rf_table *rf_find_table(const rf_tables *tables, const char *name, uint32_t axes, rf_message *why)
{
    for (size_t i = 0; i < tables->count; ++i) {
        const rf_table *table = tables->list + i;
        if (strcmp(table->name, name) != 0)
            continue;
        if (table->axes == axes)
            return table;
        rf_say(why, RF_INVALID, "table %s must have %u axes, got %u", name, (unsigned)axes,
               (unsigned)table->axes);
        return NULL;
    }
    rf_say(why, RF_INVALID, "tables must contain %s, got %zu others", name, tables->count);
    return NULL;
}

int rf_say(rf_message *message, int status, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vsnprintf(message->text, sizeof message->text, format, values);
    va_end(values);
    return status;
}
