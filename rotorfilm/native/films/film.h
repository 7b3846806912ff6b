/* What every film answers, dimensionless, and batches of answers.

   With the eccentricity e = position/clearance and the source w = velocity/clearance - (speed/2) z^ x e [1/s]
   forces are in units of viscosity * length * radius^3 / clearance^2. */
#ifndef ROTORFILM_FILM_H
#define ROTORFILM_FILM_H

#include <stddef.h>

#include "../export.h"
#include "../status.h"

/* Force f[2] at e[2], w[3], the source and the rate, half the speed, and, unless `jacobian` is NULL, jacobian[10]:
   d f/d(e, w) as [2][4], and behind it d f/d(rate), w held. Only a film that knows the rate by more than its source
   reads it, and writes that derivative; else it stays as it is. `data` is what the film reads. Without source the force is zero; where it has no derivative there: RF_UNDEFINED. What fails
   answers not-a-number together with its status. */
typedef int (*rf_film)(const void *data, const double *e, const double *w, double *f, double *jacobian);

/* The same of anything: f[2] and, unless NULL, jacobian[2][components] at a state of some components. */
typedef int (*rf_response)(const void *of, const double *state, double *f, double *jacobian);

/* An added mass at such a state: xx, xy, yy and, unless NULL, slopes[3][4] by position and velocity. */
typedef int (*rf_mass_response)(const void *of, const double *state, double *mass, double *slopes);

/* A batch of states of up to five components: number i of component k is rows[k][steps[k] * i]. */
typedef struct rf_states {
    const double *rows[5];
    size_t steps[5];
} rf_states;

/* Answers for a batch, by components: one contiguous row of n for each, rows one stride apart. */
typedef struct rf_answers {
    double *f;
    size_t f_stride;
    double *jacobian; /* 2 x components rows, or NULL */
    size_t jacobian_stride;
} rf_answers;

/* Answer n states. The most severe status; `first` receives the index of the first state that has it. */
static inline int rf_each(rf_response respond, const void *of, const rf_states *states, size_t components,
                          size_t n, const rf_answers *answers, size_t *first)
{
    const double *const *row = states->rows;
    const size_t *step = states->steps;
    double f[2], jacobian[10];
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        /* Not in a loop: that costs as much as a quarter of a film. */
        const double state[5] = {row[0][i * step[0]], row[1][i * step[1]], row[2][i * step[2]],
                                 row[3][i * step[3]], row[4][i * step[4]]};
        const int status = respond(of, state, f, answers->jacobian ? jacobian : NULL);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        answers->f[i] = f[0];
        answers->f[answers->f_stride + i] = f[1];
        for (size_t k = 0; answers->jacobian && k < 2 * components; ++k)
            answers->jacobian[k * answers->jacobian_stride + i] = jacobian[k];
    }
    return worst;
}

/* A batch of n states: the components lead, one contiguous row of n each, the rows of e, w, f and jacobian
   (2 x 4 rows, or NULL) one stride apart. The rates are NULL where no film reads them; with them there are two more
   rows, of the derivatives by the rate. */
RF_EXPORT int rf_film_batch(rf_film film, const void *data, size_t n, const double *e, size_t e_stride,
                            const double *w, size_t w_stride, const double *rate, double *f, size_t f_stride,
                            double *jacobian, size_t jacobian_stride, size_t *first);

/* Scalar call of a force at (x, y, vx, vy, speed), for hosts that hold numbers, not arrays. */
RF_EXPORT int rf_response_call(rf_response respond, const void *of, double x, double y, double vx, double vy,
                               double speed, double *f);

/* A batch of n such states, with 2 x 5 rows of jacobian or NULL; `speed` advances by speed_step: 1, or 0 for one
   speed. */
RF_EXPORT int rf_response_batch(rf_response respond, const void *of, size_t n, const double *position,
                                size_t position_stride, const double *velocity, size_t velocity_stride,
                                const double *speed, size_t speed_step, double *f, size_t f_stride,
                                double *jacobian, size_t jacobian_stride, size_t *first);

#endif
