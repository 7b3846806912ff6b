/* FMI 3.0: how its functions begin, and when they may be called. */
#ifndef ROTORFILM_FMI3_CALL_H
#define ROTORFILM_FMI3_CALL_H

#if defined(__clang__)
#pragma clang diagnostic ignored "-Wstrict-prototypes" /* in the header of the standard */
#endif
#include "fmi3Functions.h"

#include "instance.h"

#define CALL(name, phases) \
    rf_instance *const c = instance; \
    if (!c || rf_allow(c, #name, (phases)) != RF_FINE) \
    return fmi3Error

enum {
    RUNNING = RF_EVENT | RF_CONTINUOUS | RF_STEPPING,
    AFTER_START = RF_INITIALIZING | RUNNING | RF_STEP_FAILED | RF_TERMINATED,
    ANY = RF_INSTANTIATED | RF_CONFIGURING | RF_RECONFIGURING | AFTER_START
};

/* Tell the host of a step within one of its own; answers where to end. */
double rf_within_step(rf_instance *c, double t, double end);

#endif
