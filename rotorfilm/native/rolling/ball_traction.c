/* The balance of traction of a ball.

   The ball rolls along its orbit without slip at both races. Two motions remain: the spin about the contact normals and
   the slip across the way that it rolls, g D/2 with g the spin about the direction of travel. With the angles A_i, A_o,
   c, s their cosines and sines, theta = A_i - A_o, d = 1 + cos(theta), everything over the speed:

   spin at the outer race h, at the inner one h - [sin(theta) dm/D + s_i + s_o]/d,
   orbit [1 - (D/dm) c_i - (D/dm) h sin(theta)]/d,  spin about the radial direction [s_o (dm/D - c_i) + h (c_i + c_o)]/d.

   Friction of a contact comes from a potential, mu Q S, S^2 = v0^2 + slip^2 + (rho spin)^2, v0 = (slide-to-roll ratio)
   dm/4, rho = (3/8) a E(m) of a Hertzian ellipse: the limit surface of Goyal, Ruina and Papadopoulos (1991), an ellipsoid.
   It holds the gyroscopic moments about the direction of travel and about the radial one. */
#include "ball_traction.h"

#include <math.h>
#include <string.h>

#include "../solvers/dense.h"
#include "ball_contact.h"

#define STEPS 60
#define HALVINGS 30
#define EXACT 1e-14    /* residual over the loads at which a balance ends */
#define ENOUGH 1e-11   /* below which only roundoff may keep a step from making it smaller */
#define ROUNDOFF 1e-15 /* of the center of a ball, over the distance of the centers of curvature */
#define LEAST 0.02     /* orbit: a ball that stands still and is not pressed would be in balance too */
#define SOFTER 8192.0  /* of the slide-to-roll ratio, where a search begins that goes down from there in halves */

/* Unknowns: center of the ball, spin at the outer race, slip. What a balance is first differentiated by. */
enum { SPIN = 2, SLIP, UNKNOWNS };
enum { ANGLE_IN, ANGLE_OUT, LOAD_IN, LOAD_OUT, BY_SPIN, BY_SLIP, PARTS };

/* A number with its derivatives by both angles and the spin at the outer race. */
typedef struct rolled {
    double value, by[3];
} rolled;

/* What rolling makes of the angles and of the spin at the outer race. */
typedef struct rolling {
    rolled orbit, radial; /* angular speed about the shaft; spin about the radial direction */
    rolled apart, lean;   /* spin at the outer race less that at the inner one; (c_i + c_o)/d */
} rolling;

static rolling roll(double g, const double *ei, const double *eo, double h)
{
    const double si = ei[0], ci = ei[1], so = eo[0], co = eo[1], sine = si * co - ci * so, cosine = ci * co + si * so;
    const double d = 1.0 + cosine, free = (1.0 - g * ci) / d, lean = (ci + co) / d;
    const double radial = (so * (1.0 / g - ci) + h * (ci + co)) / d, apart = (sine / g + si + so) / d;
    const rolling found = {
        {free - g * h * sine / d, {(g * si + free * sine - g * h) / d, (g * h - free * sine) / d, -g * sine / d}},
        {radial, {(so * si - h * si + radial * sine) / d, (co * (1.0 / g - ci) - h * so - radial * sine) / d, lean}},
        {apart, {(cosine / g + ci + apart * sine) / d, (co - cosine / g - apart * sine) / d, 0.0}},
        {lean, {(lean * sine - si) / d, -(lean * sine + so) / d, 0.0}},
    };
    return found;
}

/* Friction of a contact across the way that the ball rolls [N], and its moment against spin [N m]; derivatives. */
typedef struct grip {
    double force, moment, by_load[2], by_spin[2], by_slip[2];
} grip;

static grip hold(const rf_ball_law *law, double still, double reach, double load, double spin, double slip)
{
    const double rho = reach * cbrt(load), turn = rho * spin, square = still * still + slip * slip + turn * turn;
    const double per = law->traction / sqrt(square), own = turn * turn / (3.0 * square), cross = load * per / square;
    const grip found = {
        load * per * slip,
        load * per * rho * turn,
        {per * slip * (1.0 - own), per * rho * turn * (5.0 / 3.0 - own)},
        {-cross * slip * rho * turn, cross * rho * rho * (still * still + slip * slip)},
        {cross * (still * still + turn * turn), -cross * slip * rho * turn},
    };
    return found;
}

/* Residuals [N] at z[UNKNOWNS]: force along the shaft and outwards, moments about the normals and the direction of
   travel over lengths; the force on the inner ring; their derivatives by the parts, and by log(speed)/2. */
typedef struct balance {
    rf_ball_contact in, out;
    rolling roll;
    grip inner, outer;
    double rest[UNKNOWNS], by[UNKNOWNS][PARTS], pull[2], pull_by[2][PARTS], by_speed[UNKNOWNS], size, norm;
} balance;

static void balance_forces(double unit, balance *at)
{
    const rf_ball_contact *in = &at->in, *out = &at->out;
    const grip *i = &at->inner, *o = &at->outer;
    const rolled *c = &at->roll.orbit;
    const double *apart = at->roll.apart.by;
    for (int k = 0; k < 2; ++k) {
        const double te = in->t[k], up = k ? 2.0 * unit * c->value : 0.0;
        const double pull[PARTS] = {in->load * te + i->force * in->e[k] + i->by_spin[0] * apart[0] * te,
                                    i->by_spin[0] * apart[1] * te, in->e[k] - i->by_load[0] * te, 0.0,
                                    -i->by_spin[0] * te, -i->by_slip[0] * te};
        const double push[PARTS] = {0.0, out->load * out->t[k] + o->force * out->e[k], 0.0,
                                    out->e[k] - o->by_load[0] * out->t[k], -o->by_spin[0] * out->t[k],
                                    -o->by_slip[0] * out->t[k]};
        const double outwards[PARTS] = {up * c->by[0], up * c->by[1], 0.0, 0.0, up * c->by[2], 0.0};
        at->by_speed[k] = 0.5 * up * c->value;
        at->pull[k] = in->load * in->e[k] - i->force * te;
        at->rest[k] = at->pull[k] - out->load * out->e[k] + o->force * out->t[k] + at->by_speed[k];
        for (int p = 0; p < PARTS; ++p) {
            at->pull_by[k][p] = pull[p];
            at->by[k][p] = pull[p] - push[p] + outwards[p];
        }
    }
}

static void balance_moments(double inertia, double diameter, double slip, balance *at)
{
    const grip *i = &at->inner, *o = &at->outer;
    const rolled *c = &at->roll.orbit, *p = &at->roll.radial, *b = &at->roll.lean;
    const double *apart = at->roll.apart.by, turn = inertia * slip;
    at->by_speed[SPIN] = -turn * c->value * b->value / diameter;
    at->by_speed[SLIP] = inertia * c->value * p->value;
    at->rest[SPIN] = (i->moment + o->moment) / diameter + at->by_speed[SPIN];
    at->rest[SLIP] = i->force + o->force + at->by_speed[SLIP];
    double *spin = at->by[SPIN], *slips = at->by[SLIP];
    for (int k = 0; k < 3; ++k) {
        const int part = k < 2 ? k : BY_SPIN;
        const double with = k < 2 ? -apart[k] : 1.0, own = k < 2 ? 0.0 : 1.0;
        const double lean = c->by[k] * b->value + c->value * b->by[k];
        spin[part] = (with * i->by_spin[1] + own * o->by_spin[1] - turn * lean) / diameter;
        slips[part] = with * i->by_spin[0] + own * o->by_spin[0] + inertia * (c->by[k] * p->value + c->value * p->by[k]);
    }
    spin[LOAD_IN] = i->by_load[1] / diameter;
    spin[LOAD_OUT] = o->by_load[1] / diameter;
    spin[BY_SLIP] = (i->by_slip[1] + o->by_slip[1] - inertia * c->value * b->value) / diameter;
    slips[LOAD_IN] = i->by_load[0];
    slips[LOAD_OUT] = o->by_load[0];
    slips[BY_SLIP] = i->by_slip[0] + o->by_slip[0];
}

static void balance_at(const rf_ball_row *row, const rf_ball_law *law, const double *a, const double *z, double speed,
                       balance *at)
{
    const double unit = row->mass * row->diameter * speed * speed, pitch = row->diameter / row->ratio;
    const double still = 0.25 * law->slide * pitch;
    at->in = rf_ball_press(a[0] - z[0], a[1] - z[1], row->inner, row->inner_stiffness);
    at->out = rf_ball_press(z[0], z[1], row->outer, row->outer_stiffness);
    at->roll = roll(row->ratio, at->in.e, at->out.e, z[SPIN]);
    at->inner = hold(law, still, row->inner_reach, at->in.load, z[SPIN] - at->roll.apart.value, z[SLIP]);
    at->outer = hold(law, still, row->outer_reach, at->out.load, z[SPIN], z[SLIP]);
    balance_forces(0.5 * unit / row->ratio, at);
    balance_moments(0.2 * unit, row->diameter, z[SLIP], at);
    at->size = at->in.load + at->out.load + at->by_speed[1] + fabs(at->by_speed[SLIP]);
    at->norm = 0.0;
    for (int k = 0; k < UNKNOWNS; ++k)
        at->norm += at->rest[k] * at->rest[k];
    at->norm = sqrt(at->norm);
}

/* Derivatives by the unknowns and by the distance a of what has these derivatives by the parts. */
static void through(const balance *at, const double *parts, double *by_z, double *by_a)
{
    for (int j = 0; j < 2; ++j) {
        by_a[j] = parts[ANGLE_IN] * at->in.t[j] / at->in.length + parts[LOAD_IN] * at->in.slope * at->in.e[j];
        by_z[j] = parts[ANGLE_OUT] * at->out.t[j] / at->out.length + parts[LOAD_OUT] * at->out.slope * at->out.e[j] -
                  by_a[j];
    }
    by_z[SPIN] = parts[BY_SPIN];
    by_z[SLIP] = parts[BY_SLIP];
}

/* A residual that may be left. */
static double slack(const rf_ball_row *row, const balance *at)
{
    const double stiffest = at->in.slope + at->out.slope;
    return ENOUGH * at->size + ROUNDOFF * (row->inner + row->outer) * stiffest;
}

/* Newton's method with steps that shorten until the residual falls. */
static int find(const rf_ball_row *row, const rf_ball_law *law, const double *a, double speed, double *z, balance *at)
{
    balance_at(row, law, a, z, speed, at);
    for (int k = 0; k < STEPS && at->norm > EXACT * at->size; ++k) {
        double q[UNKNOWNS * UNKNOWNS], step[UNKNOWNS], by_a[2], share = 1.0, trial[UNKNOWNS];
        balance next;
        int better = 0, tries = at->norm <= slack(row, at) ? 1 : HALVINGS;
        for (int i = 0; i < UNKNOWNS; ++i) {
            step[i] = -at->rest[i];
            through(at, at->by[i], q + UNKNOWNS * i, by_a);
        }
        rf_eliminate(UNKNOWNS, q, 1, step);
        for (; tries > 0 && !better; --tries, share *= 0.5) {
            for (int i = 0; i < UNKNOWNS; ++i)
                trial[i] = z[i] + share * step[i];
            balance_at(row, law, a, trial, speed, &next);
            better = next.norm < at->norm && next.roll.orbit.value > LEAST;
        }
        if (!better)
            break;
        memcpy(z, trial, sizeof trial);
        *at = next;
    }
    return at->norm <= slack(row, at);
}

/* Between the spins at which either race alone would hold the ball, by what each resists. */
static void begin(const rf_ball_row *row, const double *a, const double *x, double *z)
{
    const rf_ball_contact in = rf_ball_press(a[0] - x[0], a[1] - x[1], row->inner, row->inner_stiffness);
    const rf_ball_contact out = rf_ball_press(x[0], x[1], row->outer, row->outer_stiffness);
    const double inner = pow(in.load, 5.0 / 3.0) * row->inner_reach * row->inner_reach;
    const double outer = pow(out.load, 5.0 / 3.0) * row->outer_reach * row->outer_reach;
    z[0] = x[0];
    z[1] = x[1];
    z[SPIN] = inner > 0.0 ? roll(row->ratio, in.e, out.e, 0.0).apart.value * inner / (inner + outer) : 0.0;
    z[SLIP] = 0.0;
}

/* The force on the inner ring with the ball in balance, its derivatives, and what the ball is under. */
static void answer(const rf_ball_row *row, const balance *at, double speed, const double *z, rf_ball *ball)
{
    double q[UNKNOWNS * UNKNOWNS], moved[3 * UNKNOWNS], by_z[UNKNOWNS], by_a[2];
    for (int i = 0; i < UNKNOWNS; ++i) {
        through(at, at->by[i], q + UNKNOWNS * i, by_a);
        moved[3 * i] = -by_a[0];
        moved[3 * i + 1] = -by_a[1];
        moved[3 * i + 2] = -at->by_speed[i];
    }
    rf_eliminate(UNKNOWNS, q, 3, moved);
    for (int i = 0; i < 2; ++i) {
        double by[3] = {0.0, 0.0, 0.0};
        through(at, at->pull_by[i], by_z, by_a);
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < UNKNOWNS; ++k)
                by[j] += by_z[k] * moved[3 * k + j];
        ball->force[i] = -at->pull[i];
        for (int j = 0; j < 2; ++j)
            ball->by_place[2 * i + j] = -by_a[j] - by[j];
        ball->by_speed[i] = speed != 0.0 ? -2.0 / speed * by[2] : 0.0;
    }
    const rf_ball_contact *in = &at->in, *out = &at->out;
    ball->load[0] = in->load;
    ball->load[1] = out->load;
    ball->angle[0] = atan2(in->e[0], in->e[1]);
    ball->angle[1] = atan2(out->e[0], out->e[1]);
    ball->centrifugal = at->by_speed[1];
    ball->gyroscopic = -0.5 * row->diameter * at->by_speed[SLIP];
    ball->orbit = at->roll.orbit.value * speed;
    ball->gap = in->length - row->inner;
    ball->traction = fmax(fabs(at->inner.force) / in->load, fabs(at->outer.force) / out->load);
    ball->slip = z[SLIP] * speed;
}

int rf_ball_held(const rf_ball_row *row, const rf_ball_law *law, const double *a, double speed, const double *x,
                 rf_ball *ball)
{
    balance at;
    double z[UNKNOWNS];
    begin(row, a, x, z);
    int found = find(row, law, a, speed, z, &at);
    if (!found) {
        begin(row, a, x, z);
        z[SPIN] = 0.0; /* as if the outer race controlled */
        found = find(row, law, a, speed, z, &at);
    }
    if (!found) {
        rf_ball_law softer = *law;
        begin(row, a, x, z);
        for (double factor = SOFTER; factor >= 1.0; factor *= 0.5) {
            softer.slide = factor * law->slide;
            found = find(row, &softer, a, speed, z, &at);
        }
    }
    if (!found || !(at.in.load > 0.0))
        return 0;
    answer(row, &at, speed, z, ball);
    return 1;
}
