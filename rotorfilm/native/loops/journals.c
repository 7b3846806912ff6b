#include "journals.h"

#include <math.h>
#include <stdlib.h>

#include "../films/map_frame.h"

#define NUDGE 1e-6 /* of a clearance and a radian: the velocity with which a film at rest is asked */

int rf_set_forces(const rf_journals *journals, const double *motion, double speed, double *force, double *slope)
{
    int worst = RF_OK;
    for (int32_t b = 0; b < journals->count; ++b) {
        double state[5], answer[2], jacobian[10];
        for (int k = 0; k < 4; ++k)
            state[k] = journals->rest[4 * b + k] + motion[4 * b + k];
        state[4] = speed;
        if (hypot(state[0], state[1]) >= journals->walls[b])
            return RF_AT_WALL;
        int status = journals->films[b](journals->of[b], state, answer, jacobian);
        if (status == RF_UNDEFINED) {
            /* The limit along a trace of velocity: no film has a derivative without a source. */
            state[2] += NUDGE * journals->lengths[b] * (fabs(speed) + 1.0);
            status = journals->films[b](journals->of[b], state, answer, jacobian);
            state[2] = journals->rest[4 * b + 2] + motion[4 * b + 2];
            status = status == RF_UNDEFINED ? RF_OK : status;
        }
        if (status < RF_AT_WALL && (rf_is_broken(answer, 2) || rf_is_broken(jacobian, 10)))
            status = RF_NOT_FINITE;
        worst = status > worst ? status : worst;
        if (status >= RF_AT_WALL)
            return status;
        for (int i = 0; i < 2; ++i) {
            const int32_t row = 2 * b + i;
            const double k = journals->spring[row], c = journals->damper[row];
            force[row] = answer[i] + k * state[i] + c * state[2 + i];
            for (int j = 0; j < 4; ++j)
                slope[4 * row + j] = jacobian[5 * i + j];
            slope[4 * row + i] += k;
            slope[4 * row + 2 + i] += c;
        }
    }
    return worst;
}

int rf_journal_forces(const rf_journals *journals, int64_t samples, const double *motion, double speed,
                      double *force, double *slope)
{
    const int32_t forces = 2 * journals->count;
    double *now = malloc((size_t)(2 * forces + forces + 4 * forces) * sizeof *now);
    double *answer = now ? now + 2 * forces : NULL, *by = now ? answer + forces : NULL;
    int worst = now ? RF_OK : RF_MEMORY;
    for (int64_t n = 0; n < samples && worst < RF_AT_WALL; ++n) {
        for (int32_t q = 0; q < 2 * forces; ++q)
            now[q] = motion[q * samples + n];
        const int status = rf_set_forces(journals, now, speed, answer, by);
        worst = status > worst ? status : worst;
        for (int32_t q = 0; q < forces; ++q)
            force[q * samples + n] = answer[q];
        for (int32_t q = 0; q < 4 * forces; ++q)
            slope[q * samples + n] = by[q];
    }
    free(now);
    return worst;
}
