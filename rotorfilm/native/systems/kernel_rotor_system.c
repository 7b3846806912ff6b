/* Kernel "rotor_system": a rotor with its bearings, as one system (rotors/mounted.py).

   With x = (q, q') of N coordinates, the angular speed w and the forces f of the bearings

       q'' = (steady + w spin) x + push u + carry f + weight + unbalance (w^2 cos p + a sin p, w^2 sin p - a cos p)

   with the angle p, p' = w, w' = a; a bearing answers f at (motion x, w), its four rows of it. Tables: steady,
   spin (N, 2N), push (N, inputs), carry (N, 2 bearings), weight (N), unbalance (N, 2), sense (m, 2N), motion
   (4 bearings, 2N); times, speeds: the profile of the speed; bearings (b, 2): kind, as in KINDS, and set k of
   its tables, which are named "k.name"; planes (N, 2 m): accelerations by unit forces x, y in planes of unbalance,
   whose amounts and angles are added to the unbalance. Parameters: those of the bearings in turn; constant_speed
   where the profile has one point; amount and angle of each plane. Outputs: sense x, w, f. Without the tables times and
   speeds, w and a are two inputs more, the last ones, and p is the last state. */

/* Documentation of the FMU

   Model: A rotor and the film bearings it runs in, as one system. x and y are Cartesian, rotation is
   positive about +z (from x to y); a film force acts on the journal. With the angular speed w, the angle
   p(t) turned, w = dp/dt, a = dw/dt, and the motion of the journals in their housings:

   Equations:
   q'' = (steady + w spin) (q, q') + push u + carry f + weight
         + unbalance (w^2 cos p + a sin p, w^2 sin p - a cos p)
   f = film force of each bearing at (motion (q, q'), w), less M a of one that adds the mass M of its oil

   Validity: Small displacements of the rotor, a speed given over time (piecewise linear), or by the inputs
   prescribed_speed, w, and prescribed_acceleration, a, which a step of Co-Simulation holds; each film as the
   FMU of that bearing says. q are the coordinates of the rotor, reduced or not. Co-Simulation integrates
   rotor and films together by RODAS, of order 4, L-stable, with the exact Jacobian: no macro step is too
   long for stability. */
#include <math.h>
#include <string.h>

#include "../solvers/dense.h"
#include "../solvers/integrate.h"
#include "mounted.h"

/* The unbalance of all planes, amounts and angles p, beside the fixed one. */
static void set_unbalance(rf_mounted *self, const double *p)
{
    const size_t columns = 2 * self->plane_count;
    memcpy(self->turned, self->fixed, 2 * self->n * sizeof *p);
    for (size_t k = 0; k < columns; k += 2) {
        const double c = p[k] * cos(p[k + 1]), s = p[k] * sin(p[k + 1]);
        for (size_t i = 0; i < self->n; ++i) {
            const double *const by = self->planes + i * columns + k;
            self->turned[2 * i] += by[0] * c + by[1] * s;
            self->turned[2 * i + 1] += by[1] * c - by[0] * s;
        }
    }
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    rf_mounted *self = kernel;
    for (size_t k = 0; k < self->bearings; p += self->bearing[k++].parameters)
        if (self->bearing[k].type->set_parameters(self->bearing[k].kernel, p, why) != RF_OK)
            return RF_INVALID;
    if (self->profile.points == 1) {
        if (!isfinite(*p))
            return rf_say(why, RF_INVALID, "constant_speed must be finite, got %.9g", *p);
        self->profile.speeds[0] = *p++;
    }
    self->shift = 0.0;
    set_unbalance(self, p);
    return RF_OK;
}

/* The speed, its rate and the angle turned: those of the profile, or the inputs and the last state. */
static rf_spin spin_at(const rf_mounted *self, const rf_point *at)
{
    if (!self->driven)
        return rf_spin_at(&self->profile, at->t);
    const rf_spin given = {at->u[self->inputs], at->u[self->inputs + 1], at->x[2 * self->n]};
    return given;
}

/* What accelerations depend on beside the states and forces. */
enum { SPEED, ACCELERATION, ANGLE };

/* The slope of acceleration i by one of them, without that of the bearings. */
static double turned(const rf_mounted *self, const rf_point *at, size_t i, int by)
{
    const rf_spin spin = spin_at(self, at);
    const double w = spin.speed, a = spin.acceleration, c = cos(spin.angle), s = sin(spin.angle);
    const double shakes[3][2] = {{2.0 * w * c, 2.0 * w * s}, {s, -c}, {a * c - w * w * s, a * s + w * w * c}};
    double slope = self->unbalance[2 * i] * shakes[by][0] + self->unbalance[2 * i + 1] * shakes[by][1];
    for (size_t j = 0; by == SPEED && j < 2 * self->n; ++j)
        slope += self->spin[2 * self->n * i + j] * at->x[j];
    return slope;
}

/* Force, mass and their derivatives of bearing k. */
static int react_one(const rf_mounted *self, size_t k, double speed, int derivatives, rf_message *why)
{
    const double *m = self->moved + 4 * k, u[5] = {m[0], m[1], m[2], m[3], speed};
    const rf_point at = {0.0, NULL, u};
    const rf_mounted_bearing *one = self->bearing + k;
    double y[5] = {0.0}, D[25] = {0.0};
    rf_jacobian jacobian = {NULL, NULL, NULL, D};
    int status = one->type->output(one->kernel, &at, y, why);
    if (derivatives && status <= RF_OUTSIDE)
        status = one->type->jacobian(one->kernel, &at, &jacobian, why);
    memcpy(self->force + 2 * k, y, 2 * sizeof *y);
    memcpy(self->mass + 3 * k, y + 2, 3 * sizeof *y);
    for (size_t i = 0; derivatives && i < 2; ++i) {
        for (size_t c = 0; c < 4; ++c)
            self->by_motion[10 * k + 5 * i + c] = D[one->inputs * i + c];
        self->by_speed[2 * k + i] = one->inputs > 4 ? D[one->inputs * i + 4] : 0.0;
    }
    for (size_t i = 0; derivatives && one->heavy && i < 3; ++i)
        memcpy(self->mass_by + 12 * k + 4 * i, D + one->inputs * (2 + i), 4 * sizeof *D);
    return status;
}

/* Forces and masses of all bearings without that of their masses, and their derivatives if asked for. */
static int react(const rf_mounted *self, double speed, const double *x, int derivatives, rf_message *why)
{
    int worst = RF_OK;
    const size_t b = self->bearings;
    memset(self->moved, 0, 4 * b * sizeof *self->moved);
    rf_add_product(4 * b, 2 * self->n, 1.0, self->motion, x, self->moved);
    for (size_t k = 0; k < b; ++k) {
        const int status = react_one(self, k, speed, derivatives, why);
        if (status > RF_OUTSIDE)
            return status;
        worst = status > worst ? status : worst;
    }
    return worst;
}

static int say_unsolved(double t, rf_message *why)
{
    return rf_say(why, RF_NOT_FINITE, "the forces with the masses of the oil are not finite at t = %.9g s", t);
}

/* x' by the forces of the bearings, which become those with their masses. */
static int set_rates(const rf_mounted *self, const rf_point *at, double *dx)
{
    const size_t n = self->n;
    const rf_spin spin = spin_at(self, at);
    double shake[2], *rate = dx + n;
    rf_shake(&spin, shake);
    memcpy(dx, at->x + n, n * sizeof *dx);
    memcpy(rate, self->weight, n * sizeof *dx);
    rf_add_product(n, 2 * n, 1.0, self->steady, at->x, rate);
    rf_add_product(n, 2 * n, spin.speed, self->spin, at->x, rate);
    rf_add_product(n, self->inputs, 1.0, self->push, at->u, rate);
    rf_add_product(n, 2, 1.0, self->unbalance, shake, rate);
    const int status = rf_mounted_load(self, dx);
    rf_add_product(n, 2 * self->bearings, 1.0, self->carry, self->force, rate);
    if (self->driven)
        dx[2 * n] = spin.speed;
    return status;
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    const rf_mounted *self = kernel;
    const int status = react(self, spin_at(self, at).speed, at->x, 0, why);
    if (status > RF_OUTSIDE)
        return status;
    if (set_rates(self, at, dx) != RF_OK)
        return say_unsolved(at->t, why);
    for (size_t i = 0; i < self->n; ++i)
        if (!isfinite(dx[self->n + i]))
            return rf_say(why, RF_NOT_FINITE, "acceleration %zu is not finite at t = %.9g s", i, at->t);
    return status;
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const rf_mounted *self = kernel;
    const double speed = spin_at(self, at).speed;
    const int status = react(self, speed, at->x, 0, why);
    double *masses = y + self->sensed + 1 + 2 * self->bearings;
    if (self->masses && status <= RF_OUTSIDE && set_rates(self, at, self->right) != RF_OK)
        return say_unsolved(at->t, why);
    memset(y, 0, self->sensed * sizeof *y);
    rf_add_product(self->sensed, 2 * self->n, 1.0, self->sense, at->x, y);
    y[self->sensed] = speed;
    memcpy(y + self->sensed + 1, self->force, 2 * self->bearings * sizeof *y);
    for (size_t k = 0; k < self->bearings; ++k)
        if (self->bearing[k].heavy) {
            memcpy(masses, self->mass + 3 * k, 3 * sizeof *y);
            masses += 3;
        }
    return status;
}

/* forced[2b][states]: derivative of the forces by the states. */
static void chain(const rf_mounted *self, double *forced)
{
    const size_t twice = 2 * self->n, states = twice + self->driven;
    memset(forced, 0, 2 * self->bearings * states * sizeof *forced);
    for (size_t k = 0; k < self->bearings; ++k)
        for (size_t i = 0; i < 2; ++i)
            for (size_t c = 0; c < 4; ++c) {
                const double by = self->by_motion[10 * k + 5 * i + c];
                for (size_t j = 0; j < twice; ++j)
                    forced[(2 * k + i) * states + j] += by * self->motion[(4 * k + c) * twice + j];
            }
}

/* The slope of acceleration i by state j, or by input j - states, with the bearings' forces held. */
static double accelerated(const rf_mounted *self, const rf_point *at, double speed, size_t i, size_t j)
{
    const size_t twice = 2 * self->n, states = twice + self->driven, m = self->inputs;
    if (j < twice)
        return self->steady[i * twice + j] + speed * self->spin[i * twice + j];
    if (j < states)
        return turned(self, at, i, ANGLE);
    if (j < states + m)
        return self->push[i * m + (j - states)];
    return turned(self, at, i, j == states + m ? SPEED : ACCELERATION);
}

/* The slopes of the forces by states and inputs, with those of their masses, and the rows of the masses. */
static int load_slopes(const rf_mounted *self, const rf_point *at, rf_jacobian *answer)
{
    const size_t n = self->n, twice = 2 * n, states = twice + self->driven, m = self->inputs + 2 * self->driven;
    const size_t f = 2 * self->bearings, s = self->sensed + 1;
    const double speed = spin_at(self, at).speed;
    double *const dx = self->right, *row = answer->C + (s + f) * states;
    for (size_t j = 0; j < states + m; ++j) {
        double *const forced = j < states ? answer->C + s * states + j : answer->D + s * m + (j - states);
        const size_t step = j < states ? states : m;
        memset(dx, 0, twice * sizeof *dx);
        if (j >= n && j < twice)
            dx[j - n] = 1.0;
        for (size_t i = 0; i < n; ++i)
            dx[n + i] = accelerated(self, at, speed, i, j);
        for (size_t k = 0; k < f; ++k)
            self->force[k] = forced[k * step];
        if (rf_mounted_load(self, dx) != RF_OK)
            return RF_NOT_FINITE;
        for (size_t k = 0; k < f; ++k)
            forced[k * step] = self->force[k];
    }
    for (size_t k = 0; k < self->bearings; ++k)
        for (size_t i = 0; self->bearing[k].heavy && i < 3; ++i, row += states) {
            memset(row, 0, states * sizeof *row);
            for (size_t c = 0; c < 4; ++c)
                for (size_t j = 0; j < twice; ++j)
                    row[j] += self->mass_by[12 * k + 4 * i + c] * self->motion[(4 * k + c) * twice + j];
        }
    return RF_OK;
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const rf_mounted *self = kernel;
    const size_t n = self->n, twice = 2 * n, states = twice + self->driven, m = self->inputs + 2 * self->driven;
    const size_t b = self->bearings, s = self->sensed;
    const double speed = spin_at(self, at).speed;
    double *const forced = answer->C + (s + 1) * states, *const driven = answer->D + (s + 1) * m;
    const int status = react(self, speed, at->x, 1, why);
    if (status > RF_OUTSIDE)
        return status;
    memset(answer->A, 0, states * states * sizeof(double));
    memset(answer->B, 0, states * m * sizeof(double));
    memset(answer->D, 0, (s + 1 + 2 * b + 3 * self->masses) * m * sizeof(double));
    memset(answer->C, 0, (s + 1) * states * sizeof(double));
    for (size_t i = 0; i < s; ++i)
        memcpy(answer->C + i * states, self->sense + i * twice, twice * sizeof(double));
    if (self->masses) {
        if (set_rates(self, at, self->right) != RF_OK)
            return say_unsolved(at->t, why);
        rf_mounted_slope_masses(self, self->right, 0.0);
    }
    chain(self, forced);
    if (self->driven) {
        answer->B[twice * m + self->inputs] = 1.0;
        answer->D[s * m + self->inputs] = 1.0;
        for (size_t k = 0; k < 2 * b; ++k)
            driven[k * m + self->inputs] = self->by_speed[k];
    }
    if (self->masses && load_slopes(self, at, answer) != RF_OK)
        return say_unsolved(at->t, why);
    for (size_t i = 0; i < n; ++i) {
        double *const row = answer->A + (n + i) * states, *const by = answer->B + (n + i) * m;
        answer->A[i * states + n + i] = 1.0;
        for (size_t j = 0; j < states; ++j)
            row[j] = accelerated(self, at, speed, i, j);
        for (size_t j = 0; j < m; ++j)
            by[j] = accelerated(self, at, speed, i, states + j);
        for (size_t k = 0; k < 2 * b; ++k) {
            const double carry = self->carry[i * 2 * b + k];
            for (size_t j = 0; j < states; ++j)
                row[j] += carry * forced[k * states + j];
            for (size_t j = 0; j < m; ++j)
                by[j] += carry * driven[k * m + j];
        }
    }
    return status;
}

static void drift(const void *kernel, const rf_point *at, double *slope)
{
    const rf_mounted *self = kernel;
    const size_t n = self->n;
    const rf_spin spin = spin_at(self, at);
    const double w = spin.speed, a = spin.acceleration, c = cos(spin.angle), s = sin(spin.angle);
    const double shake[2] = {3.0 * w * a * c - w * w * w * s, 3.0 * w * a * s + w * w * w * c};
    memset(slope, 0, (2 * n + self->driven) * sizeof *slope);
    if (self->driven)
        return; /* by time nothing moves: inputs are held, and the angle is a state */
    rf_add_product(n, 2, 1.0, self->unbalance, shake, slope + n);
    if (a != 0.0)
        rf_add_product(n, 2 * n, a, self->spin, at->x, slope + n);
    if (a != 0.0 || self->masses) {
        for (size_t k = 0; k < 2 * self->bearings; ++k)
            self->force[k] = a * self->by_speed[k];
        (void)rf_mounted_load(self, slope); /* factorize, before it, has solved the same matrix */
        rf_add_product(n, 2 * self->bearings, 1.0, self->carry, self->force, slope + n);
    }
}

static int factorize(void *kernel, const rf_point *at, double shift, rf_message *why)
{
    rf_mounted *self = kernel;
    const double speed = spin_at(self, at).speed;
    const int status = react(self, speed, at->x, 1, why);
    if (status > RF_OUTSIDE)
        return status;
    if (self->masses) {
        if (set_rates(self, at, self->right) != RF_OK)
            return say_unsolved(at->t, why);
        rf_mounted_slope_masses(self, self->right, shift);
    }
    for (size_t i = 0; self->driven && i < self->n; ++i)
        self->turning[i] = turned(self, at, i, ANGLE);
    if (shift != self->shift || speed != self->speed)
        rf_mounted_invert(self, shift, speed);
    return rf_mounted_close_loop(self, why) == RF_OK ? status : RF_NOT_FINITE;
}

static double next_event(const void *kernel, double t)
{
    return rf_next_point(&((const rf_mounted *)kernel)->profile, t);
}

const rf_kernel_type rf_rotor_system_type = {
    .bytes = sizeof(rf_mounted),
    .take = rf_mounted_take,
    .release = rf_mounted_release,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .method = &rf_rodas,
    .factorize = factorize,
    .solve = rf_mounted_solve,
    .drift = drift,
    .next_event = next_event,
};
