/* The journals of a rotor: films at motions of all of them. */
#ifndef ROTORFILM_JOURNALS_H
#define ROTORFILM_JOURNALS_H

#include <stdint.h>

#include "../export.h"
#include "../films/film.h"

/* The journals: forces at states (x, y, vx, vy, speed) as of rf_journal_at, beside springs and dampers that
   the rotor rests on and that are given back here.

   Where one of them feels its tilt, each is two points of the shaft beside its middle, with half of the force
   and the moment over the arm: then films have states and forces as of rf_tilted_at, or with an arm of 0 as
   before.

   States of films, as a temperature or the tilts of pads, are behind the motion of all journals, and their rates behind
   the forces of all of them. A film with n states is asked at (x, y, vx, vy, speed, states, rates) and answers 2 forces
   and n rates with (2 + n) (5 + n) slopes. The rates that it is given are near those, or NaN, and it may begin there.
   Its states decay by themselves in the rotor, which is given back here as the springs are. No journal may feel its tilt
   beside them. */
typedef struct rf_journals {
    int32_t count;                 /* of points: n */
    int32_t points;                /* of each journal, 1 or 2 */
    const rf_response *films;
    const void *const *of;
    const double *rest;            /* rf_state_count: motion and states of films about which those of the rotor count */
    const double *spring, *damper; /* 2 n [N/m], [N s/m] */
    const double *lengths;         /* n: typical displacements [m] */
    const double *walls;           /* n: eccentricities at which a journal counts as touching [m] */
    const double *arms;            /* n/points: distance of both points from the middle [m] */
    const rf_mass_response *masses; /* n: of what a film adds, or NULL; NULL where no film does */
    const void *const *of_masses;
    const int32_t *first;          /* n + 1: among the states of all films, those of each; NULL where no film has any */
    int32_t most;                  /* states of one film, at most RF_FILM_STATES */
    double decay;                  /* of each of these states [1/s] */
} rf_journals;

#define RF_FILM_STATES 48

/* States of the film of a journal. */
static inline int32_t rf_film_states(const rf_journals *journals, int32_t b)
{
    return journals->first ? journals->first[b + 1] - journals->first[b] : 0;
}

/* Numbers by which the force of a journal changes: its motion, the states of its film, and with added masses its
   acceleration. */
static inline int32_t rf_slope_width(const rf_journals *journals)
{
    return 4 * journals->points + journals->most + (journals->masses ? 2 : 0);
}

/* Forces of all journals, and rates of the states of their films. */
static inline int32_t rf_force_count(const rf_journals *journals)
{
    return 2 * journals->count + (journals->first ? journals->first[journals->count] : 0);
}

/* Motion of all journals, and states of their films. */
static inline int32_t rf_state_count(const rf_journals *journals)
{
    return 4 * journals->count + (journals->first ? journals->first[journals->count] : 0);
}

/* Add the force of inertia -M a, of a mass (xx, xy, yy), and its slopes by x, y, vx, vy, rows `width` apart. */
static inline void rf_add_inertia(const double *mass, const double *slopes, const double *a, int width, double *f,
                                  double *by)
{
    for (int i = 0; i < 2; ++i) {
        f[i] -= mass[i] * a[0] + mass[i + 1] * a[1];
        for (int k = 0; k < 4; ++k)
            by[width * i + k] -= slopes[4 * i + k] * a[0] + slopes[4 * (i + 1) + k] * a[1];
    }
}

/* Films' forces and springs (rf_force_count) at one motion (rf_state_count, and with added masses 2 n accelerations),
   and slopes by that of the same journal (rf_force_count x rf_slope_width); the most severe status. `turned` is the
   angle of the shaft, which films without tilt find behind their state. `near` is about what `force` becomes, for films
   with states, or NULL. Slopes by the speed go to `by_speed` (as many as forces) unless it is NULL. */
int rf_set_forces(const rf_journals *journals, const double *motion, double speed, double turned, const double *near,
                  double *force, double *slope, double *by_speed);

/* Forces of films and springs (2 n rows) and slopes by x, y, vx, vy (2 n x 4 points rows) of motions (4 n
   rows), rows of `samples`, at one speed; the most severe status. */
RF_EXPORT_LOOP int rf_journal_forces(const rf_journals *journals, int64_t samples, const double *motion,
                                     double speed, double *force, double *slope);

/* Answers (2 + n rows) and slopes ((2 + n) (5 + n) rows) of a film with n states at motions and states (4 + n rows), rows of
   `samples`, at one speed; the most severe status. */
RF_EXPORT_LOOP int rf_film_samples(rf_response film, const void *of, int32_t n, int64_t samples, const double *rows,
                                   double speed, double *answer, double *slope);

#endif
