#include "journal_kernel.h"

#include <math.h>

#define ROUNDOFF 1e-14 /* a source below this fraction of its two terms is their cancellation */

static void kinematics(const rf_journal *journal, const double *state, double *e, double *w)
{
    const double c = journal->clearance, half = 0.5 * state[4];
    e[0] = state[0] / c;
    e[1] = state[1] / c;
    const double squeeze[2] = {state[2] / c, state[3] / c}, wedge[2] = {half * e[1], -half * e[0]};
    w[0] = squeeze[0] + wedge[0];
    w[1] = squeeze[1] + wedge[1];
    const double terms = fmax(fabs(squeeze[0]) + fabs(wedge[0]), fabs(squeeze[1]) + fabs(wedge[1]));
    if (fmax(fabs(w[0]), fabs(w[1])) <= ROUNDOFF * terms)
        w[0] = w[1] = 0.0;
}

/* Whether one is not finite: fmax above would hide a not-a-number, and finite factors may overflow. */
static int is_broken(const double *values, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += 0.0 * values[i];
    return !(sum == 0.0);
}

static int break_all(double *values, int count)
{
    for (int i = 0; i < count; ++i)
        values[i] = NAN;
    return RF_NOT_FINITE;
}

int rf_journal_force(const rf_journal *journal, const double *state, double *f)
{
    double e[2], w[2];
    if (is_broken(state, 5))
        return break_all(f, 2);
    kinematics(journal, state, e, w);
    const int status = rf_map_force(&journal->map, e, w, f);
    f[0] *= journal->force_scale;
    f[1] *= journal->force_scale;
    return status <= RF_UNDEFINED && is_broken(f, 2) ? break_all(f, 2) : status;
}

int rf_journal_jacobian(const rf_journal *journal, const double *state, double *f, double *jacobian)
{
    double e[2], w[2], film[8];
    if (is_broken(state, 5)) {
        break_all(f, 2);
        return break_all(jacobian, 10);
    }
    kinematics(journal, state, e, w);
    const int status = rf_map_jacobian(&journal->map, e, w, f, film);
    const double k = journal->force_scale, per_c = k / journal->clearance, half = 0.5 * state[4];
    for (int i = 0; i < 2; ++i) {
        const double *by = film + 4 * i;
        double *row = jacobian + 5 * i;
        f[i] *= k;
        /* w = v/c + (speed/2) (e_y, -e_x) */
        row[0] = per_c * (by[0] - half * by[3]);
        row[1] = per_c * (by[1] + half * by[2]);
        row[2] = per_c * by[2];
        row[3] = per_c * by[3];
        row[4] = 0.5 * k * (by[2] * e[1] - by[3] * e[0]);
    }
    if (status <= RF_OUTSIDE && (is_broken(f, 2) || is_broken(jacobian, 10))) {
        break_all(f, 2);
        return break_all(jacobian, 10);
    }
    return status;
}

int rf_journal_call(const rf_journal *journal, double x, double y, double vx, double vy, double speed,
                    double *f)
{
    const double state[5] = {x, y, vx, vy, speed};
    return rf_journal_force(journal, state, f);
}

int rf_journal_force_batch(const rf_journal *journal, size_t n, const double *position,
                           size_t position_stride, const double *velocity, size_t velocity_stride,
                           const double *speed, size_t speed_step, double *f, size_t f_stride,
                           size_t *first)
{
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double state[5] = {position[i], position[position_stride + i], velocity[i],
                                 velocity[velocity_stride + i], speed[speed_step * i]};
        double one[2];
        const int status = rf_journal_force(journal, state, one);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        f[i] = one[0];
        f[f_stride + i] = one[1];
    }
    return worst;
}

int rf_journal_jacobian_batch(const rf_journal *journal, size_t n, const double *position,
                              size_t position_stride, const double *velocity, size_t velocity_stride,
                              const double *speed, size_t speed_step, double *f, size_t f_stride,
                              double *jacobian, size_t jacobian_stride, size_t *first)
{
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        const double state[5] = {position[i], position[position_stride + i], velocity[i],
                                 velocity[velocity_stride + i], speed[speed_step * i]};
        double one[2], all[10];
        const int status = rf_journal_jacobian(journal, state, one, all);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        f[i] = one[0];
        f[f_stride + i] = one[1];
        for (size_t k = 0; k < 10; ++k)
            jacobian[k * jacobian_stride + i] = all[k];
    }
    return worst;
}
