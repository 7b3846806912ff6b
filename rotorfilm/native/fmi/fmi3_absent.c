/* FMI 3.0: what this FMU does not have. Asking for none of it is fine. */
#include "fmi3_call.h"

static fmi3Status refuse(fmi3Instance instance, const char *function, size_t count, const char *what)
{
    rf_instance *const c = instance;
    if (!c || rf_allow(c, function, ANY) != RF_FINE)
        return fmi3Error;
    return count ? (fmi3Status)rf_log(c, RF_ERROR, RF_LOG_ERROR, "%s: %s", function, what) : fmi3OK;
}

#define NO_TYPE "all variables of this FMU are of type Float64"
#define NO_CLOCK "this FMU has no clocks"

#define NONE(name, type) \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference vr[], size_t count, type values[], \
                    size_t value_count) \
    { \
        (void)vr, (void)values, (void)value_count; \
        return refuse(instance, #name, count, NO_TYPE); \
    }

NONE(fmi3GetFloat32, fmi3Float32)
NONE(fmi3GetInt8, fmi3Int8)
NONE(fmi3GetUInt8, fmi3UInt8)
NONE(fmi3GetInt16, fmi3Int16)
NONE(fmi3GetUInt16, fmi3UInt16)
NONE(fmi3GetInt32, fmi3Int32)
NONE(fmi3GetUInt32, fmi3UInt32)
NONE(fmi3GetInt64, fmi3Int64)
NONE(fmi3GetUInt64, fmi3UInt64)
NONE(fmi3GetBoolean, fmi3Boolean)
NONE(fmi3GetString, fmi3String)
NONE(fmi3SetFloat32, const fmi3Float32)
NONE(fmi3SetInt8, const fmi3Int8)
NONE(fmi3SetUInt8, const fmi3UInt8)
NONE(fmi3SetInt16, const fmi3Int16)
NONE(fmi3SetUInt16, const fmi3UInt16)
NONE(fmi3SetInt32, const fmi3Int32)
NONE(fmi3SetUInt32, const fmi3UInt32)
NONE(fmi3SetInt64, const fmi3Int64)
NONE(fmi3SetUInt64, const fmi3UInt64)
NONE(fmi3SetBoolean, const fmi3Boolean)
NONE(fmi3SetString, const fmi3String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference vr[], size_t count, size_t sizes[],
                         fmi3Binary values[], size_t value_count)
{
    (void)vr, (void)sizes, (void)values, (void)value_count;
    return refuse(instance, "fmi3GetBinary", count, NO_TYPE);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                         const size_t sizes[], const fmi3Binary values[], size_t value_count)
{
    (void)vr, (void)sizes, (void)values, (void)value_count;
    return refuse(instance, "fmi3SetBinary", count, NO_TYPE);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                        fmi3Clock values[])
{
    (void)vr, (void)values;
    return refuse(instance, "fmi3GetClock", count, NO_CLOCK);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                        const fmi3Clock values[])
{
    (void)vr, (void)values;
    return refuse(instance, "fmi3SetClock", count, NO_CLOCK);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference vr, size_t *count)
{
    (void)vr, (void)count;
    return refuse(instance, "fmi3GetNumberOfVariableDependencies", 1,
                  "dependencies are those of the description");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent, size_t of[],
                                       fmi3ValueReference independents[], size_t on[],
                                       fmi3DependencyKind kinds[], size_t count)
{
    (void)dependent, (void)of, (void)independents, (void)on, (void)kinds;
    return refuse(instance, "fmi3GetVariableDependencies", count,
                  "dependencies are those of the description");
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                  fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    (void)vr, (void)intervals, (void)qualifiers;
    return refuse(instance, "fmi3GetIntervalDecimal", count, NO_CLOCK);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                   fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[])
{
    (void)vr, (void)counters, (void)resolutions, (void)qualifiers;
    return refuse(instance, "fmi3GetIntervalFraction", count, NO_CLOCK);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                               fmi3Float64 shifts[])
{
    (void)vr, (void)shifts;
    return refuse(instance, "fmi3GetShiftDecimal", count, NO_CLOCK);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    return refuse(instance, "fmi3GetShiftFraction", count, NO_CLOCK);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                  const fmi3Float64 intervals[])
{
    (void)vr, (void)intervals;
    return refuse(instance, "fmi3SetIntervalDecimal", count, NO_CLOCK);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                   const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    return refuse(instance, "fmi3SetIntervalFraction", count, NO_CLOCK);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                               const fmi3Float64 shifts[])
{
    (void)vr, (void)shifts;
    return refuse(instance, "fmi3SetShiftDecimal", count, NO_CLOCK);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference vr[], size_t count,
                                const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    return refuse(instance, "fmi3SetShiftFraction", count, NO_CLOCK);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)clock, (void)time;
    return refuse(instance, "fmi3ActivateModelPartition", 1, NO_CLOCK);
}
