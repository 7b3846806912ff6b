#include "journal_kernel.h"

#include <math.h>

#include "map_frame.h"

#define ROUNDOFF 1e-14 /* a source below this fraction of its two terms is their cancellation */

/* Eccentricity e[2] and source w[2] of a state. */
static void set_kinematics(double clearance, const double *state, double *e, double *w)
{
    const double half = 0.5 * state[4];
    e[0] = state[0] / clearance;
    e[1] = state[1] / clearance;
    const double squeeze[2] = {state[2] / clearance, state[3] / clearance};
    const double wedge[2] = {half * e[1], -half * e[0]};
    w[0] = squeeze[0] + wedge[0];
    w[1] = squeeze[1] + wedge[1];
    const double terms = fmax(fabs(squeeze[0]) + fabs(wedge[0]), fabs(squeeze[1]) + fabs(wedge[1]));
    if (fmax(fabs(w[0]), fabs(w[1])) <= ROUNDOFF * terms)
        w[0] = w[1] = 0.0;
}

/* Turn film[10] = d f/d(e, w) and d f/d(rate) into jacobian[2][5]. */
static void set_jacobian(const rf_journal *journal, const double *e, double speed, const double *film,
                         double *jacobian)
{
    const double scale = journal->force_scale, per_c = scale / journal->clearance, half = 0.5 * speed;
    for (int i = 0; i < 2; ++i) {
        const double *by = film + 4 * i;
        double *row = jacobian + 5 * i;
        /* w = v/c + (speed/2) (e_y, -e_x) */
        row[0] = per_c * (by[0] - half * by[3]);
        row[1] = per_c * (by[1] + half * by[2]);
        row[2] = per_c * by[2];
        row[3] = per_c * by[3];
        row[4] = 0.5 * scale * (by[2] * e[1] - by[3] * e[0] + film[8 + i]);
    }
}

int rf_journal_at(const void *of, const double *state, double *f, double *jacobian)
{
    const rf_journal *journal = of;
    double e[2], w[3], film[10] = {0.0};
    if (rf_is_broken(state, 5))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 10);
    set_kinematics(journal->clearance, state, e, w);
    w[2] = 0.5 * state[4];
    const int status = journal->film(journal->data, e, w, f, jacobian ? film : NULL);
    f[0] *= journal->force_scale;
    f[1] *= journal->force_scale;
    if (jacobian)
        set_jacobian(journal, e, state[4], film, jacobian);
    /* Finite factors may overflow. */
    if (status <= RF_OUTSIDE && (rf_is_broken(f, 2) || (jacobian && rf_is_broken(jacobian, 10))))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 10);
    return status;
}
