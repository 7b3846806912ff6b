#include "tilted_journal.h"

#include <math.h>
#include <string.h>

#include "map_frame.h"

#define STATE RF_TILTED_STATE
#define STEP 1e-5 /* of differences, over the clearance or the speed */

enum { X, Y, TILT_X, TILT_Y, VX, VY, RATE_X, RATE_Y, SPEED };

static const int PLANAR[5] = {X, Y, VX, VY, SPEED};

static int worse(int a, int b)
{
    return a > b ? a : b;
}

/* Shift of the end and its rate, from tilts and theirs. */
static void set_shift(const rf_tilted *journal, const double *state, double *d, double *v)
{
    d[0] = journal->arm * state[TILT_Y];
    d[1] = -journal->arm * state[TILT_X];
    v[0] = journal->arm * state[RATE_Y];
    v[1] = -journal->arm * state[RATE_X];
}

/* Whether the source of a displacement d with the rate v is not zero. */
static int is_driven(const double *d, const double *v, double speed)
{
    return v[0] + 0.5 * speed * d[1] != 0.0 || v[1] - 0.5 * speed * d[0] != 0.0;
}

/* T of the closed form, for derivatives by[2][5] of the force. */
static void closed_form(const rf_tilted *journal, const double *by, double speed, const double *d, const double *v, double *T)
{
    const double half = 0.5 * speed;
    for (int i = 0; i < 2; ++i) {
        const double *row = by + 5 * i;
        const double turned = row[2] * d[1] - row[3] * d[0];
        T[i] = journal->share * (row[2] * v[0] + row[3] * v[1] + 2.0 * (row[0] * d[0] + row[1] * d[1]) - half * turned);
    }
}

/* Derivatives of that T by the five numbers of a state without tilt. */
static int closed_slopes(const rf_tilted *journal, const double *own, const double *d, const double *v, double slopes[2][5])
{
    const double c = journal->clearance, size = fmax(fabs(own[4]), (fabs(own[2]) + fabs(own[3])) / c);
    const double steps[5] = {STEP * c, STEP * c, STEP * c * size, STEP * c * size, STEP * size};
    int status = RF_OK;
    for (int k = 0; k < 5; ++k) {
        double T[2][2] = {{0.0}};
        for (int side = 0; side < 2; ++side) {
            double at[5], f[2], by[10];
            memcpy(at, own, sizeof at);
            at[k] += side ? steps[k] : -steps[k];
            status = worse(status, journal->aligned(journal->of, at, f, by));
            closed_form(journal, by, at[4], d, v, T[side]);
        }
        for (int i = 0; i < 2; ++i)
            slopes[i][k] = (T[1][i] - T[0][i]) / (2.0 * steps[k]);
    }
    return status;
}

/* T and its derivatives as moments, rows 2 and 3. T[2] by the shift d and its rate. */
static void set_moments(const rf_tilted *journal, const double *T, double T_state[2][5], double T_d[2][2], double T_v[2][2],
                        double *f, double *jacobian)
{
    const double arm = journal->arm;
    f[2] = -arm * T[1];
    f[3] = arm * T[0];
    for (int i = 0; i < 2 && jacobian; ++i) {
        double *row = jacobian + STATE * (3 - i);
        const double sign = i ? -arm : arm;
        for (int k = 0; k < 5; ++k)
            row[PLANAR[k]] = sign * T_state[i][k];
        row[TILT_Y] = sign * arm * T_d[i][0];
        row[TILT_X] = -sign * arm * T_d[i][1];
        row[RATE_Y] = sign * arm * T_v[i][0];
        row[RATE_X] = -sign * arm * T_v[i][1];
    }
}

static int by_closed_form(const rf_tilted *journal, const double *own, const double *by, const double *d, const double *v,
                          double *f, double *jacobian)
{
    const double share = journal->share, half = 0.5 * own[4];
    double T[2] = {0.0, 0.0}, T_state[2][5] = {{0.0}}, T_d[2][2] = {{0.0}}, T_v[2][2] = {{0.0}};
    int status = RF_OK;
    if (share > 0.0)
        closed_form(journal, by, own[4], d, v, T);
    for (int i = 0; i < 2 && jacobian && share > 0.0; ++i) {
        const double *row = by + 5 * i;
        T_v[i][0] = share * row[2];
        T_v[i][1] = share * row[3];
        T_d[i][0] = share * (2.0 * row[0] + half * row[3]);
        T_d[i][1] = share * (2.0 * row[1] - half * row[2]);
    }
    if (jacobian && share > 0.0)
        status = closed_slopes(journal, own, d, v, T_state);
    set_moments(journal, T, T_state, T_d, T_v, f, jacobian);
    return status;
}

/* Add what the map of tilts has to the force, and set the moments. */
static int by_map(const rf_tilted *journal, const double *own, const double *d, const double *v, double *f, double *jacobian)
{
    const double c = journal->clearance, rate = 0.5 * own[4], scale = journal->force_scale;
    const double q[4] = {own[0] / c, own[1] / c, d[0] / c, d[1] / c};
    const double drive[4] = {own[2] / c + rate * q[1], own[3] / c - rate * q[0], v[0] / c + rate * q[3], v[1] / c - rate * q[2]};
    double g[4], by[32], slopes[4][STATE];
    const int status = rf_tilt_wrench(journal->map, q, drive, g, jacobian ? by : NULL);
    if (status > RF_UNDEFINED || (status == RF_UNDEFINED && jacobian))
        return status;
    for (int i = 0; i < 4 && jacobian; ++i) {
        const double *e = by + 8 * i, *w = e + 4;
        for (int k = 0; k < 4; k += 2) {
            slopes[i][k] = scale / c * (e[k] - rate * w[k + 1]);
            slopes[i][k + 1] = scale / c * (e[k + 1] + rate * w[k]);
            slopes[i][4 + k] = scale / c * w[k];
            slopes[i][5 + k] = scale / c * w[k + 1];
        }
        slopes[i][SPEED] = 0.5 * scale * (w[0] * q[1] - w[1] * q[0] + w[2] * q[3] - w[3] * q[2]);
    }
    const double T[2] = {scale * g[2], scale * g[3]};
    double T_state[2][5], T_d[2][2], T_v[2][2];
    for (int i = 0; i < 2; ++i) {
        f[i] += scale * g[i];
        for (int k = 0; k < 2 && jacobian; ++k) {
            T_d[i][k] = slopes[2 + i][2 + k];
            T_v[i][k] = slopes[2 + i][6 + k];
        }
        if (!jacobian)
            continue;
        for (int k = 0; k < 5; ++k) {
            T_state[i][k] = slopes[2 + i][PLANAR[k]];
            jacobian[STATE * i + PLANAR[k]] += slopes[i][PLANAR[k]];
        }
        jacobian[STATE * i + TILT_Y] = journal->arm * slopes[i][2];
        jacobian[STATE * i + TILT_X] = -journal->arm * slopes[i][3];
        jacobian[STATE * i + RATE_Y] = journal->arm * slopes[i][6];
        jacobian[STATE * i + RATE_X] = -journal->arm * slopes[i][7];
    }
    set_moments(journal, T, T_state, T_d, T_v, f, jacobian);
    return status;
}

int rf_tilted_at(const rf_tilted *journal, const double *state, double *f, double *jacobian)
{
    double own[5], d[2], v[2], by[10] = {0.0};
    memset(f, 0, 4 * sizeof *f);
    if (jacobian)
        memset(jacobian, 0, 4 * STATE * sizeof *jacobian);
    if (rf_is_broken(state, STATE))
        return RF_NOT_FINITE;
    for (int k = 0; k < 5; ++k)
        own[k] = state[PLANAR[k]];
    set_shift(journal, state, d, v);
    const int differentiated = jacobian || (!journal->map && journal->share > 0.0);
    int status = journal->aligned(journal->of, own, f, differentiated ? by : NULL);
    const int aside = own[0] != 0.0 || own[1] != 0.0;
    const int still = !jacobian && (status == RF_UNDEFINED || (status == RF_OK && aside && !is_driven(own, own + 2, own[4])));
    if (still && !journal->map)
        return rf_is_broken(f, 2) ? RF_NOT_FINITE : is_driven(d, v, own[4]) ? RF_OUTSIDE : RF_OK;
    if (status >= RF_UNDEFINED && !still)
        return status;
    status = still ? RF_OK : status;
    for (int i = 0; i < 2 && jacobian; ++i)
        for (int k = 0; k < 5; ++k)
            jacobian[STATE * i + PLANAR[k]] = by[5 * i + k];
    status = worse(status, journal->map ? by_map(journal, own, d, v, f, jacobian)
                                        : by_closed_form(journal, own, by, d, v, f, jacobian));
    if (status == RF_UNDEFINED && !jacobian)
        return RF_OK;
    return status <= RF_OUTSIDE && (rf_is_broken(f, 4) || (jacobian && rf_is_broken(jacobian, 4 * STATE))) ? RF_NOT_FINITE : status;
}

int rf_tilted_batch(const rf_tilted *journal, size_t n, const double *states, double *f, double *jacobian, size_t *first)
{
    double state[STATE], one[4], by[4 * STATE];
    int worst = RF_OK;
    *first = 0;
    for (size_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < STATE; ++k)
            state[k] = states[k * n + i];
        const int status = rf_tilted_at(journal, state, one, jacobian ? by : NULL);
        if (status > worst) {
            worst = status;
            *first = i;
        }
        for (size_t k = 0; k < 4; ++k)
            f[k * n + i] = one[k];
        for (size_t k = 0; jacobian && k < 4 * STATE; ++k)
            jacobian[k * n + i] = by[k];
    }
    return worst;
}
