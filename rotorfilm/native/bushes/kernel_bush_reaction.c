/* Kernel "bush_reaction": a polymer bush with a worn profile at nodes (bearings/bush/bush_reaction.py).

   Parameters and table "bush" in bush.h. Table "profile": nodes, center and extent of their arc [rad], whether
   each point melts by itself (LocalMelting), and whether the temperature was given. Inputs x, y [m], vx, vy [m/s], speed [rad/s]; states the wear
   depths [m]; outputs force_x, force_y [N], friction_torque [N m], contact_angle [rad], maximum_pressure [Pa].
   Events: depths at the nodes, margins of melting, speed. */

/* Documentation of the FMU

   Model: Force and friction torque of a polymer bush on the shaft in it, with wear depths at nodes of the
   liner: loads may fall and turn, the shaft may leave the liner and come back. The contact is held at the
   melting point. Where the depth d of the shaft in the liner is positive it carries pressure q; what
   friction heat leaves over melts the liner. In Co-Simulation the wear is advanced by extrapolated implicit
   Euler steps with error control under held inputs; nodes that enter or leave the contact, melting, and the
   sense of rotation are event indicators.

   Equations:
   q = (G/a_1) max(0, d),  d = (e.n - Delta)/R + ln(R_2/R) B T_* - v/R
   e = (x, y) + retardation (vx, vy)
   dv/dt = q f omega R_1 (1 - omega_c/omega)/melting_heat where the contact melts

   Validity: Evtushenko & Kovalenko (1993), re-derived. Second order in the distance of the nodes. Below the
   critical speed a real contact is colder and carries less. The tables `bush` and `profile` hold what is
   fixed. No abrasive wear, no heat stored. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "worn_bush.h"

#define MOST_NODES 10000
#define FULL_TURN 6.28318530717958647692
#define COVERED_TO 0.05 /* share of the losses by which friction heat may fall short without a word */

enum { ARRAYS = 8 }; /* of the profile */

/* Kernels are given as constant, but their scratch space is written. */
static rf_worn_bush *writable(const void *kernel)
{
    return (rf_worn_bush *)kernel;
}

/* Raise unless the shaft is within the housing and its contact on the arc of nodes. */
static int require_place(const rf_worn_bush *m, const double *u, rf_message *why)
{
    const rf_bush_profile *p = &m->profile;
    const double housing = m->bush.is.radius + m->bush.is.thickness - m->bush.is.shaft_radius;
    const double moved = hypot(u[0], u[1]), mx = u[0] + m->retardation * u[2], my = u[1] + m->retardation * u[3];
    if (!(moved < housing))
        return rf_say(why, RF_AT_WALL,
                      "position must keep the journal inside the clearance %.6g m, got an eccentricity of %.6g m",
                      housing, moved);
    const double reach = hypot(mx, my), along = cos(m->center) * mx + sin(m->center) * my;
    const int beyond = along < reach * cos(0.5 * m->extent) && reach > m->gap * m->bush.is.radius;
    if (p->closed || (!beyond && !(p->depth[0] > 0.0) && !(p->depth[p->n - 1] > 0.0)))
        return RF_OK;
    return rf_say(why, RF_AT_WALL,
                  "contact must stay on the arc of nodes, %.6g rad about %.6g rad, got a shaft moved by %.6g m",
                  m->extent, m->center, reach);
}

static int enter(rf_worn_bush *m, const rf_point *at, rf_message *why)
{
    for (size_t i = 0; i < m->profile.n; ++i)
        if (!isfinite(at->x[i]))
            return rf_say(why, RF_NOT_FINITE, "wear depth %zu must be finite", i);
    rf_worn_press(m, at->x, at->u);
    return require_place(m, at->u, why);
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    rf_worn_bush *m = writable(kernel);
    const int status = enter(m, at, why);
    for (size_t i = 0; status == RF_OK && i < m->profile.n; ++i)
        dx[i] = rf_worn_rate(m, i);
    return status;
}

/* Force on the journal and friction torque of the loads at the nodes. */
static void add_force(const rf_worn_bush *m, const double *load, double *y, size_t stride)
{
    double px = 0.0, py = 0.0, sum = 0.0;
    for (size_t i = 0; i < m->profile.n; ++i) {
        px -= m->unit * m->profile.cosine[i] * load[i];
        py -= m->unit * m->profile.sine[i] * load[i];
        sum += load[i];
    }
    y[0] = px - m->friction * py;
    y[stride] = py + m->friction * px;
    y[2 * stride] = m->friction * m->unit * m->bush.is.shaft_radius * sum;
}

static size_t deepest(const rf_bush_profile *p)
{
    size_t top = 0;
    for (size_t i = 1; i < p->n; ++i)
        top = p->depth[i] > p->depth[top] ? i : top;
    return top;
}

/* Friction heat over the losses, where it is largest. */
static double covered(const rf_worn_bush *m)
{
    const rf_bush_profile *p = &m->profile;
    double most = m->local ? 0.0 : p->total / (2.0 * p->angle * m->bush.is.compliance);
    for (size_t i = 0; m->local && i < p->n; ++i)
        most = fmax(most, rf_worn_pressure(m, i));
    return m->losses > 0.0 ? m->work * most / m->losses : HUGE_VAL;
}

/* Tell of a worn contact that is held at the melting point for nothing. */
static int require_heat(const rf_worn_bush *m, const double *wear, rf_message *why)
{
    int worn = 0;
    for (size_t i = 0; i < m->profile.n; ++i)
        worn |= wear[i] > 0.0;
    if (!worn || m->given || !rf_worn_melts(m) || !(m->profile.angle > 0.0) || covered(m) >= 1.0 - COVERED_TO)
        return RF_OK;
    return rf_say(why, RF_OUTSIDE,
                  "friction must cover the heat losses of a worn contact at its melting point, got about "
                  "%.0f %% of them, so the contact cools: parameter temperature prescribes a lower temperature",
                  100.0 * covered(m));
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    rf_worn_bush *m = writable(kernel);
    const rf_bush_profile *p = &m->profile;
    const int status = enter(m, at, why);
    if (status != RF_OK)
        return status;
    add_force(m, p->load, y, 1);
    y[3] = p->angle;
    y[4] = m->bush.is.modulus / m->bush.is.compliance * fmax(p->depth[deepest(p)], 0.0);
    return require_heat(m, at->x, why);
}

static int events(const void *kernel, const rf_point *at, double *z, rf_message *why)
{
    rf_worn_bush *m = writable(kernel);
    const size_t n = m->profile.n;
    (void)why;
    rf_worn_press(m, at->x, at->u);
    memcpy(z, m->profile.depth, n * sizeof *z);
    z += n;
    if (m->local)
        for (size_t i = 0; i < n; ++i)
            *z++ = m->work * rf_worn_pressure(m, i) - m->losses;
    else
        *z++ = m->work * m->profile.total / m->bush.is.compliance
               - 2.0 * fmax(m->profile.angle, RF_LEAST_ANGLE) * m->losses;
    *z = at->u[4];
    return RF_OK;
}

/* Columns of the Jacobian for a change of the depths: rates with their stride, outputs with theirs. */
static void column(const rf_worn_bush *m, const double *change, double *rates, size_t stride, double *outputs,
                   size_t output_stride)
{
    const rf_bush_profile *p = &m->profile;
    double *load = m->scratch[1], angle = 0.0, own, whole;
    const double total = rf_bush_profile_stiffness(p, change, load);
    for (size_t i = 0; i < p->n; ++i)
        angle += p->angle_slope[i] * change[i];
    const double all = p->total > 0.0 ? rf_worn_whole_change(m, total, angle) : 0.0;
    for (size_t i = 0; i < p->n; ++i) {
        rf_worn_rate_slopes(m, i, &own, &whole);
        rates[i * stride] = own * load[i] + whole * all;
    }
    add_force(m, load, outputs, output_stride);
    outputs[3 * output_stride] = angle;
    const size_t top = deepest(p);
    outputs[4 * output_stride] =
        p->depth[top] > 0.0 ? m->bush.is.modulus / m->bush.is.compliance * change[top] : 0.0;
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    rf_worn_bush *m = writable(kernel);
    const rf_bush_profile *p = &m->profile;
    const size_t n = p->n;
    double *change = m->scratch[0], own, whole;
    const int status = enter(m, at, why);
    if (status != RF_OK)
        return status;
    for (size_t k = 0; k < n; ++k) {
        memset(change, 0, n * sizeof *change);
        change[k] = -1.0 / m->bush.is.radius;
        column(m, change, answer->A + k, n, answer->C + k, n);
    }
    for (size_t k = 0; k < 2; ++k) {
        for (size_t i = 0; i < n; ++i)
            change[i] = (k ? p->sine : p->cosine)[i] / m->bush.is.radius;
        column(m, change, answer->B + k, 5, answer->D + k, 5);
        for (size_t i = 0; i < n; ++i)
            answer->B[5 * i + 2 + k] = m->retardation * answer->B[5 * i + k];
        for (size_t i = 0; i < 5; ++i)
            answer->D[5 * i + 2 + k] = m->retardation * answer->D[5 * i + k];
    }
    for (size_t i = 0; i < n; ++i) {
        rf_worn_rate_slopes(m, i, &own, &whole);
        answer->B[5 * i + 4] = (own > 0.0 ? rf_worn_pressure(m, i) : 0.0) * m->bush.is.pressure_work * m->grip
                               * copysign(1.0, at->u[4]) / m->bush.melting_heat;
    }
    for (size_t i = 0; i < 5; ++i)
        answer->D[5 * i + 4] = 0.0;
    return RF_OK;
}

static int step(void *kernel, const rf_point *at, double dt, double *x, rf_message *why)
{
    const int status = enter(kernel, at, why);
    return status == RF_OK ? rf_worn_advance(kernel, at->u, dt, x, why) : status;
}

static void release(void *kernel)
{
    free(((rf_worn_bush *)kernel)->profile.cosine);
}

static int take_profile(rf_worn_bush *m, const rf_tables *tables, rf_message *why)
{
    const rf_table *table = rf_find_table(tables, "profile", 1, why);
    if (!table)
        return RF_INVALID;
    const double *is = table->numbers;
    if (table->extent[0] != 5 || !(is[0] >= 3.0 && is[0] <= MOST_NODES && is[2] > 0.0 && is[2] <= FULL_TURN))
        return rf_say(why, RF_INVALID, "the table of a profile must have 3 to %d nodes on 2 pi at most",
                      MOST_NODES);
    m->profile.n = (size_t)is[0];
    m->center = is[1];
    m->extent = is[2];
    m->local = is[3] != 0.0;
    m->given = is[4] != 0.0;
    m->profile.closed = is[2] >= FULL_TURN;
    return RF_OK;
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    rf_worn_bush *m = kernel;
    rf_bush_profile *p = &m->profile;
    if (rf_bush_tables(&m->bush, tables, why) != RF_OK || take_profile(m, tables, why) != RF_OK)
        return RF_INVALID;
    double *block = malloc((ARRAYS + RF_WEAR_WORK) * p->n * sizeof *block);
    double **const arrays[ARRAYS] = {&p->cosine, &p->sine,     &p->weight, &p->depth,
                                     &p->load,   &p->diagonal, &p->beside, &p->angle_slope};
    if (!block)
        return rf_say(why, RF_MEMORY, "no memory for a bush of %zu nodes", p->n);
    for (size_t k = 0; k < ARRAYS; ++k)
        *arrays[k] = block + k * p->n;
    for (size_t k = 0; k < RF_WEAR_WORK; ++k)
        m->scratch[k] = block + (ARRAYS + k) * p->n;
    rf_bush_profile_nodes(p, m->center, m->extent);
    m->unit = m->bush.is.force_unit / m->bush.is.compliance;
    *sizes = (rf_sizes){RF_REACTION_PARAMETERS, 5, 5, p->n, p->n + (m->local ? p->n : 1) + 1};
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    rf_worn_bush *m = kernel;
    if (!(p[RF_RETARDATION] >= 0.0 && p[RF_RETARDATION] < HUGE_VAL))
        return rf_say(why, RF_INVALID, "retardation must be finite and not negative, got %.9g",
                      p[RF_RETARDATION]);
    const double held = p[RF_TEMPERATURE];
    if (!(held <= m->bush.is.melting && held > -HUGE_VAL))
        return rf_say(why, RF_INVALID, "temperature must not exceed the melting point %.9g, got %.9g",
                      m->bush.is.melting, held);
    const int status = rf_bush_parameters(&m->bush, p, why);
    if (status != RF_OK)
        return status;
    m->retardation = p[RF_RETARDATION];
    m->held = held;
    m->gap = m->bush.is.clearance - m->bush.is.closing * held;
    m->grip = rf_bush_friction(&m->bush, held);
    return RF_OK;
}

const rf_kernel_type rf_bush_reaction_type = {
    .bytes = sizeof(rf_worn_bush),
    .take = take_tables,
    .release = release,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .step = step,
    .events = events,
};
