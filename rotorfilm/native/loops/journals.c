#include "journals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../films/map_frame.h"

#define NUDGE 1e-6 /* of a clearance and a radian: the velocity with which a film at rest is asked */

/* The film of a journal at a state of so many freedoms: answers with so many slopes. */
static int film_at(const rf_journals *journals, int32_t b, int freedoms, double *state, int answers, double *answer,
                   int slopes, double *jacobian)
{
    int status = journals->films[b](journals->of[b], state, answer, jacobian);
    if (status == RF_UNDEFINED) {
        /* The limit along a trace of velocity: no film has a derivative without a source. */
        const double rate = state[freedoms];
        state[freedoms] += NUDGE * journals->lengths[journals->points * b] * (fabs(state[2 * freedoms]) + 1.0);
        status = journals->films[b](journals->of[b], state, answer, jacobian);
        state[freedoms] = rate;
        status = status == RF_UNDEFINED ? RF_OK : status;
    }
    if (status < RF_AT_WALL && (rf_is_broken(answer, answers) || rf_is_broken(jacobian, slopes)))
        status = RF_NOT_FINITE;
    return status;
}

/* What the mass that a film adds does at an acceleration, to force[2] and slope[2][width], whose last columns are its. */
static int weigh(const rf_journals *journals, int32_t b, const double *state, const double *a, double *force,
                 double *slope)
{
    double mass[3] = {0.0}, by[12] = {0.0};
    const rf_mass_response heavy = journals->masses[b];
    const int status = heavy ? heavy(journals->of_masses[b], state, mass, by) : RF_OK;
    if (status < RF_AT_WALL && (rf_is_broken(mass, 3) || rf_is_broken(by, 12)))
        return RF_NOT_FINITE;
    const int width = rf_slope_width(journals);
    rf_add_inertia(mass, by, a, width, force, slope);
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            slope[width * (i + 1) - 2 + j] = -mass[i + j];
    return status;
}

/* A film with n states: force[2] and slope[2][..], and at their numbers behind the forces of all journals their rates. */
static int with_states(const rf_journals *journals, int32_t b, int32_t n, double *state, double *force, double *slope,
                       double *by_speed)
{
    const int32_t width = rf_slope_width(journals), behind = 2 * (journals->count - b) + journals->first[b];
    double answer[2 + RF_FILM_STATES], jacobian[(2 + RF_FILM_STATES) * (5 + RF_FILM_STATES)];
    const int status = film_at(journals, b, 2, state, 2 + n, answer, (2 + n) * (5 + n), jacobian);
    if (status >= RF_AT_WALL)
        return status;
    for (int32_t i = 0; i < 2 + n; ++i) {
        const int32_t row = i < 2 ? i : behind + i - 2;
        const double *by = jacobian + (5 + n) * i;
        force[row] = answer[i];
        for (int32_t j = 0; j < 4 + n; ++j)
            slope[width * row + j] = by[j < 4 ? j : j + 1];
        if (by_speed)
            by_speed[row] = by[4];
    }
    for (int32_t i = 0; i < n; ++i) {
        force[behind + i] += journals->decay * state[5 + i];
        slope[width * (behind + i) + 4 + i] += journals->decay;
    }
    return status;
}

/* A journal without tilt at x, y, vx, vy, the states of its film and rates near theirs: force[2], slope[2][4], with more
   columns for the states and the acceleration. */
static int planar(const rf_journals *journals, int32_t b, const double *at, const double *a, const double *turning,
                  double *force, double *slope, double *by_speed)
{
    const int32_t width = rf_slope_width(journals), n = rf_film_states(journals, b);
    double state[5 + 2 * RF_FILM_STATES], jacobian[10];
    memcpy(state, at, 4 * sizeof *at);
    memcpy(state + 4, turning, 2 * sizeof *turning);
    if (n > 0) {
        memcpy(state + 5, at + 4, 2 * (size_t)n * sizeof *at);
        return with_states(journals, b, n, state, force, slope, by_speed);
    }
    const int status = film_at(journals, b, 2, state, 2, force, 10, jacobian);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 4; ++j)
            slope[width * i + j] = jacobian[5 * i + j];
        if (by_speed)
            by_speed[i] = jacobian[5 * i + 4];
    }
    if (!journals->masses || status >= RF_AT_WALL)
        return status;
    const int of_mass = weigh(journals, b, state, a, force, slope);
    return of_mass > status ? of_mass : status;
}

/* A journal at two points: force[4], slope[4][8]. Freedoms are (x, y, tilt_x, tilt_y) = part (x, y of both). */
static int tilted(const rf_journals *journals, int32_t b, const double *at, double speed, double *force, double *slope,
                  double *by_speed)
{
    const double h = journals->arms[b] > 0.0 ? 0.5 / journals->arms[b] : 0.0;
    const double part[4][4] = {{0.5, 0.0, 0.5, 0.0}, {0.0, 0.5, 0.0, 0.5}, {0.0, -h, 0.0, h}, {h, 0.0, -h, 0.0}};
    const int freedoms = h > 0.0 ? 4 : 2, width = 2 * freedoms + 1;
    double state[9] = {0.0}, answer[4], jacobian[36];
    for (int i = 0; i < freedoms; ++i)
        for (int j = 0; j < 4; ++j) {
            state[i] += part[i][j] * at[4 * (j / 2) + j % 2];
            state[freedoms + i] += part[i][j] * at[4 * (j / 2) + 2 + j % 2];
        }
    state[2 * freedoms] = speed;
    const int status = film_at(journals, b, freedoms, state, freedoms, answer, freedoms * width, jacobian);
    for (int r = 0; r < 4; ++r) {
        double turned = 0.0;
        force[r] = 0.0;
        for (int q = 0; q < 8; ++q)
            slope[8 * r + q] = 0.0;
        for (int i = 0; i < freedoms; ++i) {
            force[r] += part[i][r] * answer[i];
            turned += part[i][r] * jacobian[width * i + 2 * freedoms];
            for (int k = 0; k < 2 * freedoms; ++k)
                for (int j = 0; j < 4; ++j)
                    slope[8 * r + 4 * (j / 2) + 2 * (k / freedoms) + j % 2] +=
                        part[i][r] * jacobian[width * i + k] * part[k % freedoms][j];
        }
        if (by_speed)
            by_speed[r] = turned;
    }
    return status;
}

int rf_set_forces(const rf_journals *journals, const double *motion, double speed, double turned, const double *near,
                  double *force, double *slope, double *by_speed)
{
    const int32_t points = journals->points, rows = 4 * points, width = rf_slope_width(journals);
    const double turning[2] = {speed, turned};
    int worst = RF_OK;
    if (journals->first) { /* what a film does not set */
        memset(force, 0, (size_t)rf_force_count(journals) * sizeof *force);
        memset(slope, 0, (size_t)(rf_force_count(journals) * width) * sizeof *slope);
        if (by_speed)
            memset(by_speed, 0, (size_t)rf_force_count(journals) * sizeof *by_speed);
    }
    for (int32_t b = 0; b < journals->count / points; ++b) {
        const int32_t first = journals->first ? journals->first[b] : 0, inner = 4 * journals->count + first;
        const int32_t states = rf_film_states(journals, b);
        double at[8 + 2 * RF_FILM_STATES];
        for (int32_t k = 0; k < rows; ++k)
            at[k] = journals->rest[rows * b + k] + motion[rows * b + k];
        for (int32_t k = 0; k < states; ++k) {
            at[4 + k] = journals->rest[inner + k] + motion[inner + k];
            at[4 + states + k] = near ? near[2 * journals->count + first + k] - journals->decay * at[4 + k] : NAN;
        }
        for (int32_t p = 0; p < points; ++p)
            if (hypot(at[4 * p], at[4 * p + 1]) >= journals->walls[points * b + p])
                return RF_AT_WALL;
        double *const to = force + 2 * points * b, *const by = slope + 2 * points * width * b;
        const double *a = journals->masses ? motion + rf_state_count(journals) + 2 * b : NULL;
        double *const faster = by_speed ? by_speed + 2 * points * b : NULL;
        const int status = points == 1 ? planar(journals, b, at, a, turning, to, by, faster)
                                       : tilted(journals, b, at, speed, to, by, faster);
        worst = status > worst ? status : worst;
        if (status >= RF_AT_WALL)
            return status;
        for (int32_t i = 0; i < 2 * points; ++i) {
            const int32_t row = 2 * points * b + i, place = 4 * (i / 2) + i % 2;
            const double k = journals->spring[row], c = journals->damper[row];
            to[i] = to[i] + k * at[place] + c * at[place + 2];
            by[width * i + place] += k;
            by[width * i + place + 2] += c;
        }
    }
    return worst;
}

int rf_film_samples(rf_response film, const void *of, int32_t n, int64_t samples, const double *rows, double speed,
                    double *answer, double *slope)
{
    const int32_t answers = 2 + n, slopes = answers * (5 + n);
    double state[5 + 2 * RF_FILM_STATES], one[2 + RF_FILM_STATES], by[(2 + RF_FILM_STATES) * (5 + RF_FILM_STATES)];
    int worst = RF_OK;
    for (int64_t k = 0; k < samples && worst < RF_AT_WALL; ++k) {
        for (int32_t q = 0; q < 4 + n; ++q)
            state[q < 4 ? q : q + 1] = rows[q * samples + k];
        state[4] = speed;
        for (int32_t q = 0; q < n; ++q)
            state[5 + n + q] = NAN;
        const int status = film(of, state, one, by);
        worst = status > worst ? status : worst;
        for (int32_t q = 0; q < answers; ++q)
            answer[q * samples + k] = one[q];
        for (int32_t q = 0; q < slopes; ++q)
            slope[q * samples + k] = by[q];
    }
    return worst;
}

int rf_journal_forces(const rf_journals *journals, int64_t samples, const double *motion, double speed,
                      double *force, double *slope)
{
    const int32_t forces = 2 * journals->count, slopes = 4 * journals->points * forces;
    double *now = malloc((size_t)(2 * forces + forces + slopes) * sizeof *now);
    double *answer = now ? now + 2 * forces : NULL, *by = now ? answer + forces : NULL;
    int worst = now ? RF_OK : RF_MEMORY;
    for (int64_t n = 0; n < samples && worst < RF_AT_WALL; ++n) {
        for (int32_t q = 0; q < 2 * forces; ++q)
            now[q] = motion[q * samples + n];
        const int status = rf_set_forces(journals, now, speed, 0.0, NULL, answer, by, NULL);
        worst = status > worst ? status : worst;
        for (int32_t q = 0; q < forces; ++q)
            force[q * samples + n] = answer[q];
        for (int32_t q = 0; q < slopes; ++q)
            slope[q * samples + n] = by[q];
    }
    free(now);
    return worst;
}
