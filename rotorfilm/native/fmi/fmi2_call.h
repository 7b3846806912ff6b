/* FMI 2.0: how its functions begin, and when they may be called. */
#ifndef ROTORFILM_FMI2_CALL_H
#define ROTORFILM_FMI2_CALL_H

#include "fmi2Functions.h"

#include "instance.h"

#define CALL(name, phases) \
    rf_instance *const c = component; \
    if (!c || rf_allow(c, #name, (phases)) != RF_FINE) \
    return fmi2Error

enum {
    ANY = RF_INSTANTIATED | RF_INITIALIZING | RF_EVENT | RF_CONTINUOUS | RF_STEPPING | RF_STEP_FAILED
        | RF_TERMINATED,
    AFTER_START = ANY & ~RF_INSTANTIATED,
    RUNNING = RF_EVENT | RF_CONTINUOUS | RF_STEPPING
};

#endif
