/* The equations of a step with films that have states. */
#ifndef ROTORFILM_FILM_STATES_H
#define ROTORFILM_FILM_STATES_H

#include <stddef.h>

#include "journals.h"

/* Numbers of memory that rf_solve_with_states needs. */
size_t rf_states_size(const rf_journals *journals, size_t s, size_t each);

/* Solve matrix x = right in place for `each` unknowns at s nodes: the forces, the rates of the states of films, the
   acceleration of a motor. The rates of one film do not know those of the others: they are eliminated film by film, by
   static condensation. */
void rf_solve_with_states(const rf_journals *journals, int32_t s, int32_t each, const double *matrix, double *right,
                          double *memory);

#endif
