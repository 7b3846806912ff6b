/* Saving, restoring and serializing the condition of an instance: one block of bytes for all three. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

#define MAGIC 0x54534652u /* "RFST" */

typedef struct header {
    uint32_t magic, checksum; /* of the resource: a block belongs to its FMU */
    uint64_t size;
    rf_condition now;
    double stop_time, tolerance, last_good_time;
    int32_t stop_defined, terminated, resume, co_simulation;
} header;

size_t rf_saved_size(const rf_instance *c)
{
    return sizeof(header) + c->value_count * sizeof(double);
}

static int belongs(const rf_instance *c, const void *bytes)
{
    header h;
    double value;
    memcpy(&h, bytes, sizeof h);
    if (h.magic != MAGIC || h.checksum != c->resource->checksum || h.size != rf_saved_size(c)
        || h.co_simulation != c->co_simulation || !isfinite(h.now.time))
        return 0;
    for (size_t i = 0; i < c->value_count; ++i) {
        memcpy(&value, (const char *)bytes + sizeof h + i * sizeof value, sizeof value);
        if (!isfinite(value))
            return 0;
    }
    return 1;
}

static rf_answer refuse(rf_instance *c)
{
    return rf_log(c, RF_ERROR, RF_LOG_ERROR, "the FMU state must come from this FMU, of %zu bytes",
                  rf_saved_size(c));
}

rf_answer rf_save(rf_instance *c, void **saved)
{
    header h;
    if (!saved)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "the FMU state must have a place");
    /* A block that the simulator hands in again is written over, as the standards want. */
    if (!*saved)
        *saved = malloc(rf_saved_size(c));
    if (!*saved)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "no memory for an FMU state");
    memset(&h, 0, sizeof h);
    h.magic = MAGIC;
    h.checksum = c->resource->checksum;
    h.size = rf_saved_size(c);
    h.now = c->now;
    h.stop_time = c->stop_time;
    h.tolerance = c->tolerance;
    h.last_good_time = c->last_good_time;
    h.stop_defined = c->stop_defined;
    h.terminated = c->terminated;
    h.resume = (int32_t)c->resume;
    h.co_simulation = c->co_simulation;
    memcpy(*saved, &h, sizeof h);
    memcpy((char *)*saved + sizeof h, c->values[RF_PARAMETER], c->value_count * sizeof(double));
    return RF_FINE;
}

rf_answer rf_restore(rf_instance *c, const void *saved)
{
    header h;
    if (!saved || !belongs(c, saved))
        return refuse(c);
    memcpy(&h, saved, sizeof h);
    memcpy(c->values[RF_PARAMETER], (const char *)saved + sizeof h, c->value_count * sizeof(double));
    c->now = h.now;
    c->stop_time = h.stop_time;
    c->tolerance = h.tolerance;
    c->last_good_time = h.last_good_time;
    c->stop_defined = h.stop_defined;
    c->terminated = h.terminated;
    c->resume = (rf_phase)h.resume;
    c->parameters_changed = 1;
    c->known = 0;
    return RF_FINE;
}

rf_answer rf_serialize(rf_instance *c, const void *saved, void *bytes, size_t size)
{
    if (!saved || !bytes || size < rf_saved_size(c))
        return refuse(c);
    memcpy(bytes, saved, rf_saved_size(c));
    return RF_FINE;
}

rf_answer rf_deserialize(rf_instance *c, const void *bytes, size_t size, void **saved)
{
    if (!bytes || !saved || size != rf_saved_size(c) || !belongs(c, bytes))
        return refuse(c);
    void *made = malloc(size);
    if (!made)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "no memory for an FMU state");
    *saved = memcpy(made, bytes, size);
    return RF_FINE;
}
