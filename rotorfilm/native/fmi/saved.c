/* Saving, restoring and serializing the condition of an instance: one block of bytes for all three. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

#define MAGIC 0x54534652u /* "RFST" */

typedef struct header {
    uint32_t magic;
    uint32_t checksum; /* of all bytes behind it; set and tested where a block is bytes */
    uint32_t resource; /* checksum of the resource: a block belongs to its FMU */
    int32_t co_simulation;
    uint64_t size;
    rf_condition now;
    double stop_time, tolerance, last_good_time;
    int32_t stop_defined, terminated;
    uint32_t resume, reserved;
} header;

enum { SEALED = offsetof(header, resource) }; /* bytes ahead of those that the checksum is of */

size_t rf_saved_size(const rf_instance *c)
{
    return sizeof(header) + c->value_count * sizeof(double);
}

static uint32_t seal(const void *bytes, size_t size)
{
    return rf_checksum((const unsigned char *)bytes + SEALED, size - SEALED);
}

static int is_phase(uint32_t phase, int co_simulation)
{
    const uint32_t known = RF_INSTANTIATED | RF_CONFIGURING | RF_INITIALIZING | RF_EVENT | RF_RECONFIGURING
                         | RF_TERMINATED | (co_simulation ? RF_STEPPING | RF_STEP_FAILED : RF_CONTINUOUS);
    return (phase & known) && !(phase & (phase - 1));
}

static rf_answer refuse(rf_instance *c)
{
    return rf_log(c, RF_ERROR, RF_LOG_ERROR, "the FMU state must come from this FMU, of %zu bytes",
                  rf_saved_size(c));
}

static rf_answer require_own(rf_instance *c, const void *bytes)
{
    header h;
    double value;
    memcpy(&h, bytes, sizeof h);
    int own = h.magic == MAGIC && h.resource == c->resource->checksum && h.size == rf_saved_size(c)
           && h.co_simulation == c->co_simulation;
    if (!own)
        return refuse(c);
    const double times[] = {h.now.time, h.now.stride, h.now.step};
    for (size_t i = 0; i < sizeof times / sizeof *times; ++i)
        if (!isfinite(times[i]))
            return rf_log(c, RF_ERROR, RF_LOG_ERROR, "times of the FMU state must be finite, got %.9g", times[i]);
    for (size_t i = 0; i < c->value_count; ++i) {
        memcpy(&value, (const char *)bytes + sizeof h + i * sizeof value, sizeof value);
        if (!isfinite(value))
            return rf_log(c, RF_ERROR, RF_LOG_ERROR, "value %zu of the FMU state must be finite, got %.9g", i,
                          value);
    }
    const uint32_t phase = is_phase(h.now.phase, c->co_simulation) ? h.resume : h.now.phase;
    if (is_phase(phase, c->co_simulation))
        return RF_FINE;
    return rf_log(c, RF_ERROR, RF_LOG_ERROR, "the FMU state must have a phase of this instance, got %u",
                  (unsigned)phase);
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
    h.resource = c->resource->checksum;
    h.size = rf_saved_size(c);
    h.now = c->now;
    h.stop_time = c->stop_time;
    h.tolerance = c->tolerance;
    h.last_good_time = c->last_good_time;
    h.stop_defined = c->stop_defined;
    h.terminated = c->terminated;
    h.resume = (uint32_t)c->resume;
    h.co_simulation = c->co_simulation;
    memcpy(*saved, &h, sizeof h);
    memcpy((char *)*saved + sizeof h, c->values[RF_PARAMETER], c->value_count * sizeof(double));
    return RF_FINE;
}

rf_answer rf_restore(rf_instance *c, const void *saved)
{
    header h;
    const rf_answer answer = saved ? require_own(c, saved) : refuse(c);
    if (answer != RF_FINE)
        return answer;
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
    header h;
    if (!saved || !bytes || size < rf_saved_size(c))
        return refuse(c);
    memcpy(bytes, saved, rf_saved_size(c));
    memcpy(&h, bytes, sizeof h);
    h.checksum = seal(bytes, rf_saved_size(c));
    memcpy(bytes, &h, sizeof h);
    return RF_FINE;
}

rf_answer rf_deserialize(rf_instance *c, const void *bytes, size_t size, void **saved)
{
    header h;
    if (!bytes || !saved || size != rf_saved_size(c))
        return refuse(c);
    memcpy(&h, bytes, sizeof h);
    if (h.checksum != seal(bytes, size))
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "the FMU state is damaged, its checksum is wrong");
    if (require_own(c, bytes) != RF_FINE)
        return RF_ERROR;
    void *made = malloc(size);
    if (!made)
        return rf_log(c, RF_ERROR, RF_LOG_ERROR, "no memory for an FMU state");
    *saved = memcpy(made, bytes, size);
    return RF_FINE;
}
