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

#include "../films/bush.h"
#include "../films/bush_profile.h"

#define MOST_NODES 10000
#define LEAST_ANGLE 1e-9 /* stands for no contact in the heat balance */
#define FULL_TURN 6.28318530717958647692
#define TYPICAL_PRESSURE 4e-2 /* in shear moduli */
#define TOLERANCE 1e-10       /* of the local error, relative to each depth and to a typical one */
#define ROWS 8               /* of the extrapolation */
#define MOST_PARTS 2000
#define COVERED_TO 0.05 /* share of the losses by which friction heat may fall short without a word */

enum { ARRAYS = 8, WORK = 9 + ROWS };

typedef struct model {
    rf_bush bush;
    rf_bush_profile profile; /* scratch, as are the arrays behind it */
    int local, given; /* each point melts by itself; the temperature is one that the model was given */
    double center, extent, retardation;
    double held, gap, grip; /* temperature of the contact, clearance and friction there */
    double unit, friction; /* force of a unit of load; friction with its sign */
    double work, losses, losses_slope, kept;
    double *scratch[WORK];
} model;

/* Kernels are given as constant, but their scratch space is written. */
static model *writable(const void *kernel)
{
    return (model *)kernel;
}

static double pressure(const model *m, size_t i)
{
    return m->profile.load[i] / (m->bush.is.compliance * m->profile.weight[i]);
}

/* Only a contact that is held at the melting point wears. */
static int melts(const model *m)
{
    return m->held >= m->bush.is.melting;
}

/* Depths, loads and heat at wear depths x under the input u. */
static void press(model *m, const double *x, const double *u)
{
    rf_bush_profile *p = &m->profile;
    const rf_bush *b = &m->bush;
    const double mx = u[0] + m->retardation * u[2], my = u[1] + m->retardation * u[3];
    for (size_t i = 0; i < p->n; ++i)
        p->depth[i] = (p->cosine[i] * mx + p->sine[i] * my - x[i]) / b->is.radius - m->gap;
    rf_bush_profile_press(p);
    const double a = fmax(p->angle, LEAST_ANGLE), s = sin(a);
    m->friction = u[4] > 0.0 ? m->grip : u[4] < 0.0 ? -m->grip : 0.0;
    m->work = b->is.pressure_work * m->grip * fabs(u[4]);
    m->losses = rf_bush_losses(b, a, s, m->held);
    double segment, moment;
    rf_arc(a, s, cos(a), &segment, &moment);
    m->losses_slope = rf_bush_losses_slope(b, a, moment, m->held);
    const double total = p->total / b->is.compliance;
    m->kept = total > 0.0 && melts(m) ? fmax(m->work - 2.0 * a * m->losses / total, 0.0) : 0.0;
}

/* Raise unless the shaft is within the housing and its contact on the arc of nodes. */
static int require_place(const model *m, const double *u, rf_message *why)
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

static int enter(model *m, const rf_point *at, rf_message *why)
{
    for (size_t i = 0; i < m->profile.n; ++i)
        if (!isfinite(at->x[i]))
            return rf_say(why, RF_NOT_FINITE, "wear depth %zu must be finite", i);
    press(m, at->x, at->u);
    return require_place(m, at->u, why);
}

/* Rate of wear at node i. */
static double rate(const model *m, size_t i)
{
    const double own = melts(m) ? fmax(m->work * pressure(m, i) - m->losses, 0.0) : 0.0;
    return (m->local ? own : m->kept * pressure(m, i)) / m->bush.melting_heat;
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    model *m = writable(kernel);
    const int status = enter(m, at, why);
    for (size_t i = 0; status == RF_OK && i < m->profile.n; ++i)
        dx[i] = rate(m, i);
    return status;
}

/* Force on the journal and friction torque of the loads at the nodes. */
static void add_force(const model *m, const double *load, double *y, size_t stride)
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
static double covered(const model *m)
{
    const rf_bush_profile *p = &m->profile;
    double most = m->local ? 0.0 : p->total / (2.0 * p->angle * m->bush.is.compliance);
    for (size_t i = 0; m->local && i < p->n; ++i)
        most = fmax(most, pressure(m, i));
    return m->losses > 0.0 ? m->work * most / m->losses : HUGE_VAL;
}

/* Tell of a worn contact that is held at the melting point for nothing. */
static int require_heat(const model *m, const double *wear, rf_message *why)
{
    int worn = 0;
    for (size_t i = 0; i < m->profile.n; ++i)
        worn |= wear[i] > 0.0;
    if (!worn || m->given || !melts(m) || !(m->profile.angle > 0.0) || covered(m) >= 1.0 - COVERED_TO)
        return RF_OK;
    return rf_say(why, RF_OUTSIDE,
                  "friction must cover the losses of a worn contact at its melting point, got about %.0f %% of "
                  "them: it cools; parameter temperature holds it colder",
                  100.0 * covered(m));
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    model *m = writable(kernel);
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
    model *m = writable(kernel);
    const size_t n = m->profile.n;
    (void)why;
    press(m, at->x, at->u);
    memcpy(z, m->profile.depth, n * sizeof *z);
    z += n;
    if (m->local)
        for (size_t i = 0; i < n; ++i)
            *z++ = m->work * pressure(m, i) - m->losses;
    else
        *z++ = m->work * m->profile.total / m->bush.is.compliance
               - 2.0 * fmax(m->profile.angle, LEAST_ANGLE) * m->losses;
    *z = at->u[4];
    return RF_OK;
}

/* d(rate)/d(pressure of the node itself), and the part g of d(rates) = g (what the whole contact changes). */
static void rate_slopes(const model *m, size_t i, double *own, double *whole)
{
    const int on = m->local ? melts(m) && m->work * pressure(m, i) > m->losses : m->kept > 0.0;
    const double per = 1.0 / m->bush.melting_heat;
    *own = on ? per * (m->local ? m->work : m->kept) / (m->profile.weight[i] * m->bush.is.compliance) : 0.0;
    *whole = on ? per * (m->local ? 1.0 : pressure(m, i)) : 0.0;
}

/* What the whole contact changes where the sum of the loads changes by `total` and half the angle by `angle`. */
static double whole_change(const model *m, double total, double angle)
{
    if (m->local)
        return -m->losses_slope * angle;
    const double Q = m->profile.total / m->bush.is.compliance, a = fmax(m->profile.angle, LEAST_ANGLE);
    return 2.0 * (a * m->losses * total / (m->bush.is.compliance * Q) - (m->losses + a * m->losses_slope) * angle)
           / Q;
}

/* Columns of the Jacobian for a change of the depths: rates with their stride, outputs with theirs. */
static void column(const model *m, const double *change, double *rates, size_t stride, double *outputs,
                   size_t output_stride)
{
    const rf_bush_profile *p = &m->profile;
    double *load = m->scratch[1], angle = 0.0, own, whole;
    const double total = rf_bush_profile_stiffness(p, change, load);
    for (size_t i = 0; i < p->n; ++i)
        angle += p->angle_slope[i] * change[i];
    const double all = p->total > 0.0 ? whole_change(m, total, angle) : 0.0;
    for (size_t i = 0; i < p->n; ++i) {
        rate_slopes(m, i, &own, &whole);
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
    model *m = writable(kernel);
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
        rate_slopes(m, i, &own, &whole);
        answer->B[5 * i + 4] = (own > 0.0 ? pressure(m, i) : 0.0) * m->bush.is.pressure_work * m->grip
                               * copysign(1.0, at->u[4]) / m->bush.melting_heat;
    }
    for (size_t i = 0; i < 5; ++i)
        answer->D[5 * i + 4] = 0.0;
    return RF_OK;
}

/* The matrix I - h A at the last contact: A = D K + g r^T, K of tridiagonal form but for one element of a closed
   arc, which is left out. Extrapolation does not ask for the exact A. */
typedef struct matrix {
    double *lower, *middle, *upper, *g, *r, *z; /* z = (I - h D K)^-1 g */
    double share;
} matrix;

static void eliminate(size_t n, const matrix *a, double *v)
{
    for (size_t i = 1; i < n; ++i)
        v[i] -= a->lower[i] * v[i - 1];
    for (size_t i = n; i-- > 0;)
        v[i] = (v[i] - (i + 1 < n ? a->upper[i] * v[i + 1] : 0.0)) / a->middle[i];
}

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

/* g and r of the last contact; lower and upper are the entries of h D K for h = 1 afterwards. */
static void take_slopes(const model *m, matrix *a)
{
    const rf_bush_profile *p = &m->profile;
    const double per = -1.0 / m->bush.is.radius;
    for (size_t i = 0; i < p->n; ++i) {
        const size_t before = i ? i - 1 : p->n - 1;
        a->r[i] = p->total > 0.0 ? whole_change(m, per * (p->diagonal[i] + p->beside[i] + p->beside[before]),
                                                per * p->angle_slope[i])
                                 : 0.0;
    }
}

static void factor(const model *m, double h, matrix *a)
{
    const rf_bush_profile *p = &m->profile;
    for (size_t i = 0; i < p->n; ++i) {
        double own;
        rate_slopes(m, i, &own, a->g + i);
        own *= h / m->bush.is.radius;
        a->middle[i] = 1.0 + own * p->diagonal[i];
        a->upper[i] = own * p->beside[i];
        a->lower[i] = i ? own * p->beside[i - 1] / a->middle[i - 1] : 0.0;
        a->middle[i] -= i ? a->lower[i] * a->upper[i - 1] : 0.0;
    }
    memcpy(a->z, a->g, p->n * sizeof(double));
    eliminate(p->n, a, a->z);
    const double rest = 1.0 - h * dot(p->n, a->r, a->z);
    a->share = rest > 0.1 ? h / rest : 0.0;
}

/* v becomes (I - h A)^-1 v. */
static void solve(size_t n, const matrix *a, double *v)
{
    eliminate(n, a, v);
    const double more = a->share * dot(n, a->r, v);
    for (size_t i = 0; i < n; ++i)
        v[i] += more * a->z[i];
}

/* Root mean square of the difference in tolerances. */
static double difference(const model *m, const double *a, const double *b)
{
    const double typical = m->bush.is.radius * m->bush.is.compliance * TYPICAL_PRESSURE;
    double sum = 0.0;
    for (size_t i = 0; i < m->profile.n; ++i) {
        const double share = (a[i] - b[i]) / (TOLERANCE * (typical + fabs(a[i])));
        sum += share * share;
    }
    return sqrt(sum / (double)m->profile.n);
}

/* One step by 1, 2, 3 ... linearly implicit Euler steps, extrapolated until two answers agree (Deuflhard 1985).
   The answer is left in table[row]; the error in tolerances is returned. */
static double extrapolate(model *m, const double *x, const double *u, double h, int *rows)
{
    const size_t n = m->profile.n;
    double **const s = m->scratch, **const table = s + 8, *y = s[6], *move = s[7], error = HUGE_VAL;
    matrix a = {s[0], s[1], s[2], s[3], s[4], s[5], 0.0};
    for (int k = 0; k < ROWS; ++k) {
        const double part = h / (k + 1);
        press(m, x, u);
        take_slopes(m, &a);
        factor(m, part, &a);
        memcpy(y, x, n * sizeof *y);
        for (int j = 0; j <= k; ++j) {
            if (j)
                press(m, y, u);
            for (size_t i = 0; i < n; ++i)
                move[i] = part * rate(m, i);
            solve(n, &a, move);
            for (size_t i = 0; i < n; ++i)
                y[i] += move[i];
        }
        for (int j = 1; j <= k; ++j)
            for (size_t i = 0; i < n; ++i) {
                move[i] = table[j - 1][i]; /* in the end the last answer with one row less */
                table[j - 1][i] = y[i];
                y[i] += (y[i] - move[i]) * (double)(k + 1 - j) / (double)j;
            }
        memcpy(table[k], y, n * sizeof *y);
        *rows = k + 1;
        if (k && (error = difference(m, y, move)) <= 1.0)
            break;
    }
    return error;
}

static int step(void *kernel, const rf_point *at, double dt, double *x, rf_message *why)
{
    model *m = kernel;
    const size_t n = m->profile.n;
    double left = dt, h = dt;
    const int status = enter(m, at, why);
    if (status != RF_OK)
        return status;
    memcpy(m->scratch[WORK - 1], x, n * sizeof *x);
    for (int part = 0; part < MOST_PARTS && left > 0.0; ++part) {
        int rows;
        const double error = extrapolate(m, x, at->u, h, &rows);
        if (error <= 1.0) {
            for (size_t i = 0; i < n; ++i)
                x[i] = fmax(x[i], m->scratch[8 + rows - 1][i]); /* wear does not fall */
            left -= h;
        }
        const double most = error <= 1.0 ? (rows < ROWS ? 4.0 : 1.0) : 0.5;
        h = fmin(left, h * (error < HUGE_VAL ? fmin(fmax(0.8 * pow(error + 1e-30, -1.0 / rows), 0.1), most) : 0.1));
        if (left > 0.0 && !(h >= 1e-16 * left))
            break;
    }
    if (left > 0.0)
        memcpy(x, m->scratch[WORK - 1], n * sizeof *x);
    if (left > 0.0)
        return rf_say(why, RF_STUCK, "the wear cannot go on beyond %.9g of a step", 1.0 - left / dt);
    return RF_OK;
}

static void destroy(void *kernel)
{
    model *m = kernel;
    free(m->profile.cosine);
    free(m);
}

static int take_profile(model *m, const rf_tables *tables, rf_message *why)
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

static void *create(const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *m = calloc(1, sizeof *m);
    if (!m || rf_bush_tables(&m->bush, tables, why) != RF_OK || take_profile(m, tables, why) != RF_OK) {
        if (!m)
            rf_say(why, RF_MEMORY, "no memory for a bush");
        free(m);
        return NULL;
    }
    rf_bush_profile *p = &m->profile;
    double *block = malloc((ARRAYS + WORK) * p->n * sizeof *block);
    double **const arrays[ARRAYS] = {&p->cosine, &p->sine,     &p->weight, &p->depth,
                                     &p->load,   &p->diagonal, &p->beside, &p->angle_slope};
    if (!block) {
        rf_say(why, RF_MEMORY, "no memory for a bush of %zu nodes", p->n);
        free(m);
        return NULL;
    }
    for (size_t k = 0; k < ARRAYS; ++k)
        *arrays[k] = block + k * p->n;
    for (size_t k = 0; k < WORK; ++k)
        m->scratch[k] = block + (ARRAYS + k) * p->n;
    rf_bush_profile_nodes(p, m->center, m->extent);
    m->unit = m->bush.is.force_unit / m->bush.is.compliance;
    const rf_sizes mine = {RF_REACTION_PARAMETERS, 5, 5, p->n, p->n + (m->local ? p->n : 1) + 1};
    *sizes = mine;
    return m;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    model *m = kernel;
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
    .create = create,
    .destroy = destroy,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .step = step,
    .events = events,
};
