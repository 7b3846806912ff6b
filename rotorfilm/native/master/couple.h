/* The loop over the macro steps of a rotor and its films, as cosim/schemes take them. */
#ifndef ROTORFILM_COUPLE_H
#define ROTORFILM_COUPLE_H

#include "rotor.h"

enum { RF_GAUSS_SEIDEL, RF_JACOBI, RF_TANGENTIAL, RF_NEWTON };

/* The film of a station. */
typedef struct rf_station {
    rf_partner *partner;
    size_t inputs, outputs, known;
    const uint32_t *input_refs, *output_refs;
    const int32_t *feeds; /* of each input: the rotor's output, or -1 - number of the journal's motion */
    const uint32_t *force_refs, *known_refs;
    const int32_t *knowns; /* those of the journal's motion that it knows its derivatives by */
    int32_t force_at[2];   /* among its outputs */
} rf_station;

/* Where the loop ends before it is asked to; the latest point then is the last one in the record. */
typedef enum rf_coupled {
    RF_COUPLED = 0,
    RF_ROTOR_FAILED = 1,
    RF_FILM_FAILED = 2,   /* `who` says which */
    RF_NOT_NUMBERS = 3,   /* outputs of the rotor (`who` = -1) or of a film are not finite */
    RF_ROTOR_WAITING = 4, /* a step that cannot be made here, as of the rotor; all are where they were */
    RF_FULL = 5           /* the record has no room */
} rf_coupled;

typedef struct rf_coupling {
    int32_t scheme, degree, gentle, behind; /* gentle: short steps at the start; behind: see rf_tangential_law */
    int32_t stations, who;
    int32_t adaptive, most; /* steps of the length that the error asks for; most iterations of Newton's method */
    double tolerance;       /* of both */
    double probed;          /* length of the step of which the sensitivity of the rotor is known */
    double *sensitivity;    /* d(position, velocity)/d(held force), (2 m, m) */
    double *kept;           /* the state of a rotor that is integrated here, before a step that may be repeated */
    rf_rotor *rotor;
    rf_station *films;
    rf_record record;
    const double *points; /* of the macro steps */
    double macro_step, t, reached; /* the time reached, and the end of the step that is being made */
    int64_t step;         /* macro steps done */
    int64_t done[5];      /* work: steps, evaluations, derivatives, steps of the rotor, rollbacks */
    double *laws;         /* of each step: time and RF_LAW_SIZE numbers; NULL if not asked for */
    /* What the distance from the limit follows from, every so many points; at most so many of them. */
    int32_t every, checking;
    int64_t checks;
    int64_t *checked; /* the points */
    double *check_tangents, *check_slopes;
    double *work; /* rf_coupling_work numbers */
} rf_coupling;

RF_EXPORT_MASTER size_t rf_coupling_work(const rf_coupling *c, size_t widest);

/* Go on until so many macro steps are done. */
RF_EXPORT_MASTER int rf_couple(rf_coupling *c, int64_t steps);

#endif
