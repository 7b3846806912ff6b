#include "journal_kernel.h"

#include <math.h>

#include "journal_state.h"

int rf_journal_force(const rf_journal *journal, const double *state, double *f)
{
    double e[2], w[2];
    if (rf_kinematics(journal->clearance, state, e, w) != RF_OK)
        return rf_break(f, 2);
    const int status = rf_map_force(&journal->map, e, w, f);
    return rf_dimensional_force(journal->force_scale, status, f);
}

int rf_journal_jacobian(const rf_journal *journal, const double *state, double *f, double *jacobian)
{
    double e[2], w[2], film[8];
    if (rf_kinematics(journal->clearance, state, e, w) != RF_OK) {
        rf_break(f, 2);
        return rf_break(jacobian, 10);
    }
    const int status = rf_map_jacobian(&journal->map, e, w, f, film);
    return rf_dimensional(journal->clearance, journal->force_scale, e, state[4], film, status, f, jacobian);
}

int rf_journal_call(const rf_journal *journal, double x, double y, double vx, double vy, double speed,
                    double *f)
{
    const double state[5] = {x, y, vx, vy, speed};
    return rf_journal_force(journal, state, f);
}

static int force_of(const void *film, const double *state, double *f)
{
    return rf_journal_force(film, state, f);
}

static int jacobian_of(const void *film, const double *state, double *f, double *jacobian)
{
    return rf_journal_jacobian(film, state, f, jacobian);
}

int rf_journal_force_batch(const rf_journal *journal, size_t n, const double *position,
                           size_t position_stride, const double *velocity, size_t velocity_stride,
                           const double *speed, size_t speed_step, double *f, size_t f_stride,
                           size_t *first)
{
    return rf_each_force(force_of, journal, n, position, position_stride, velocity, velocity_stride, speed,
                         speed_step, f, f_stride, first);
}

int rf_journal_jacobian_batch(const rf_journal *journal, size_t n, const double *position,
                              size_t position_stride, const double *velocity, size_t velocity_stride,
                              const double *speed, size_t speed_step, double *f, size_t f_stride,
                              double *jacobian, size_t jacobian_stride, size_t *first)
{
    return rf_each_jacobian(jacobian_of, journal, n, position, position_stride, velocity, velocity_stride,
                            speed, speed_step, f, f_stride, jacobian, jacobian_stride, first);
}
