/* What the files of an instance share: its messages, and the values that follow from its state. */
#ifndef ROTORFILM_EVALUATE_H
#define ROTORFILM_EVALUATE_H

#include "instance.h"

/* Bits of the categories of messages. */
enum {
    ALL_CATEGORIES = (1 << RF_CATEGORIES) - 1,
    FAILURES = 1 << RF_LOG_WARNING | 1 << RF_LOG_DISCARD | 1 << RF_LOG_ERROR
};

const char *rf_phase_name(uint32_t phase);

/* Nothing is known any more of what follows from the state. */
void rf_forget(rf_instance *c);

/* What the simulator gets for a status. In continuous-time mode a smaller step may help, and the standards
   then want Discard ("a function is outside of its domain"); it does not mend parameters. */
rf_answer rf_failed(rf_instance *c, int status, const char *what, const rf_message *why);
/* The same of a status that may be none; an answer beyond the verified range is worth one warning. */
rf_answer rf_judged(rf_instance *c, int status, const char *what, const rf_message *why);

int rf_apply_parameters(rf_instance *c, rf_message *why);
/* In continuous-time mode a time event still lies ahead: what counts there is the limit from before. */
rf_point rf_present_point(const rf_instance *c);
/* Compute the values of this role unless they are known. */
int rf_evaluate(rf_instance *c, rf_role role, rf_message *why);

#endif
