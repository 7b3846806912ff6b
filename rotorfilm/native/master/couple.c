#include "couple.h"

#include <math.h>
#include <string.h>

#include "../solvers/dense.h"

#define FIRST (1.0 / 63.0) /* first step of a gentle start, in macro steps */

/* As in cosim/schemes.py, with the same names. */
#define PROBE 1e3
#define SAFETY 0.8
#define LEAST 0.3
#define MOST 2.0
#define GIVE_UP 1e-6

/* What one step has computed before it is a point of the record. */
typedef struct rf_found {
    double *motion, *outputs, *force, *law, *values, *whole, *column, *held, *residual, *feedback;
} rf_found;

size_t rf_coupling_work(const rf_coupling *c, size_t widest)
{
    const size_t m = c->record.m;
    return 2 * m + 1 + c->record.columns + m + RF_LAW_SIZE(m) + 2 * widest + 10 + 2 * m + m * m;
}

static rf_found placed(const rf_coupling *c)
{
    const size_t m = c->record.m;
    rf_found f;
    f.motion = c->work;
    f.outputs = f.motion + 2 * m + 1;
    f.force = f.outputs + c->record.columns;
    f.law = f.force + m;
    f.whole = f.law + RF_LAW_SIZE(m);
    f.column = f.whole + 10;
    f.held = f.column + 2;
    f.residual = f.held + m;
    f.feedback = f.residual + m;
    f.values = f.feedback + m * m;
    return f;
}

static int all_finite(const double *values, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(values[i]))
            return 0;
    return 1;
}

static int failed(rf_coupling *c, int ended, int32_t who)
{
    c->who = who;
    return ended;
}

static int read_rotor(rf_coupling *c, const rf_found *f)
{
    if (rf_take(c->rotor->partner, c->rotor->output_refs, c->rotor->outputs, f->outputs))
        return failed(c, RF_ROTOR_FAILED, -1);
    return all_finite(f->outputs, c->rotor->outputs) ? RF_COUPLED : failed(c, RF_NOT_NUMBERS, -1);
}

static void place_motion(const rf_record *r, const double *outputs, double *motion)
{
    for (size_t i = 0; i < r->m; ++i) {
        motion[i] = outputs[r->position[i]];
        motion[r->m + i] = outputs[r->velocity[i]];
    }
    motion[2 * r->m] = r->speed < 0 ? 0.0 : outputs[r->speed];
}

/* Component 0 to 4 of the motion of the journal in a station. */
static double moved(const rf_record *r, const double *motion, int32_t station, int32_t component)
{
    const size_t m = r->m, first = 2 * (size_t)station;
    return component < 2   ? motion[first + (size_t)component]
           : component < 4 ? motion[m + first + (size_t)component - 2]
                           : motion[2 * m];
}

/* Step the films under a motion; other inputs are fed from the outputs of the rotor given. */
static int evaluate(rf_coupling *c, const rf_found *f, double t, double dt, const double *fed)
{
    double *outputs = f->outputs + c->rotor->outputs;
    for (int32_t k = 0; k < c->stations; ++k) {
        const rf_station *film = c->films + k;
        for (size_t i = 0; i < film->inputs; ++i)
            f->values[i] = film->feeds[i] >= 0 ? fed[film->feeds[i]]
                                               : moved(&c->record, f->motion, k, -1 - film->feeds[i]);
        if (rf_put(film->partner, film->input_refs, film->inputs, f->values)
            || rf_stride(film->partner, t, dt))
            return failed(c, RF_FILM_FAILED, k);
    }
    ++c->done[1];
    for (int32_t k = 0; k < c->stations; ++k) {
        const rf_station *film = c->films + k;
        if (rf_take(film->partner, film->output_refs, film->outputs, outputs))
            return failed(c, RF_FILM_FAILED, k);
        if (!all_finite(outputs, film->outputs))
            return failed(c, RF_NOT_NUMBERS, k);
        f->force[2 * k] = outputs[film->force_at[0]];
        f->force[2 * k + 1] = outputs[film->force_at[1]];
        outputs += film->outputs;
    }
    return RF_COUPLED;
}

/* Stiffness, damping and derivative by the speed of all films at present; the station that fails, or -1. */
static int32_t differentiate(rf_coupling *c, const rf_found *f, double *tangents)
{
    const size_t m = c->record.m;
    memset(tangents, 0, (2 * m * m + m) * sizeof *tangents);
    for (int32_t k = 0; k < c->stations; ++k) {
        const rf_station *film = c->films + k;
        if (rf_slopes(film->partner, film->force_refs, 2, film->known_refs, film->known, f->whole, f->column))
            return k;
        for (size_t i = 0; i < 2; ++i)
            for (size_t j = 0; j < film->known; ++j) {
                const size_t component = (size_t)film->knowns[j], row = 2 * (size_t)k + i;
                const double slope = f->whole[i * film->known + j];
                if (component == 4)
                    tangents[2 * m * m + row] = slope;
                else
                    tangents[component / 2 * m * m + row * m + 2 * (size_t)k + component % 2] = -slope;
            }
    }
    ++c->done[2];
    return -1;
}

/* A film that has no derivative at rest counts as held; of an FMU that is a failure. */
static int derive(rf_coupling *c, const rf_found *f, double *tangents)
{
    const size_t m = c->record.m;
    const int32_t who = differentiate(c, f, tangents);
    if (who < 0)
        return RF_COUPLED;
    if (c->films[who].partner->kind != RF_IS_KERNEL || c->films[who].partner->status != RF_UNDEFINED)
        return failed(c, RF_FILM_FAILED, who);
    memset(tangents, 0, (2 * m * m + m) * sizeof *tangents);
    return RF_COUPLED;
}

/* Now and then: the derivatives of films and rotor at the latest point. Where one has none, no more. */
static void check(rf_coupling *c, const rf_found *f)
{
    const rf_record *r = &c->record;
    const size_t m = r->m, n = c->rotor->partner->states, columns = 2 * m * m + m;
    const int64_t point = r->count - 1;
    if (!c->checking || point % c->every)
        return;
    double *tangents = c->check_tangents + (size_t)c->checks * columns;
    double *slopes = c->check_slopes + (size_t)c->checks * (n + 2 * m) * (n + m);
    if (r->derived)
        memcpy(tangents, r->tangents + (size_t)point * columns, columns * sizeof *tangents);
    if ((!r->derived && differentiate(c, f, tangents) >= 0)
        || rf_slopes(c->rotor->partner, c->rotor->rows, n + 2 * m, c->rotor->columns, n + m, slopes,
                     c->rotor->work)) {
        c->checking = 0;
        return;
    }
    c->checked[c->checks++] = point;
}

static void make_law(const rf_coupling *c, rf_law *law)
{
    if (c->scheme == RF_TANGENTIAL)
        rf_tangential_law(&c->record, c->behind, law);
    else
        rf_extrapolated_law(&c->record, c->degree, law);
}

static int drive(rf_coupling *c, const rf_law *law, double t, double dt)
{
    const int ended = rf_drive(c->rotor, t, dt, law);
    if (c->laws && !ended) {
        double *kept = c->laws + (size_t)(c->record.count - 1) * (1 + RF_LAW_SIZE(law->m));
        kept[0] = law->start;
        memcpy(kept + 1, law->force, RF_LAW_SIZE(law->m) * sizeof *kept);
    }
    if (!ended)
        return RF_COUPLED;
    return failed(c, c->rotor->mode == RF_INTEGRATED ? RF_ROTOR_WAITING : RF_ROTOR_FAILED, -1);
}

/* Rotor first, then the films at its new state. */
static int in_turn(rf_coupling *c, const rf_found *f, const rf_law *law, double t, double dt)
{
    int ended = drive(c, law, t, dt);
    if (ended == RF_ROTOR_WAITING)
        return ended;
    ++c->done[3];
    if (!ended)
        ended = read_rotor(c, f);
    if (ended)
        return ended;
    place_motion(&c->record, f->outputs, f->motion);
    return evaluate(c, f, t, dt, f->outputs);
}

/* Films first, at the motion extrapolated, unless the rotor may have to wait: neither knows of the other. */
static int in_parallel(rf_coupling *c, const rf_found *f, const rf_law *law, double t, double dt)
{
    const rf_record *r = &c->record;
    const double *latest = r->outputs + (size_t)(r->count - 1) * r->columns;
    const int early = c->rotor->mode == RF_INTEGRATED;
    int ended = early ? drive(c, law, t, dt) : RF_COUPLED;
    if (ended == RF_ROTOR_WAITING)
        return ended;
    rf_motion_ahead(r, c->degree, t + dt, f->motion);
    if (!ended)
        ended = evaluate(c, f, t, dt, latest);
    if (ended)
        return ended;
    ++c->done[3];
    if (!early)
        ended = drive(c, law, t, dt);
    return ended ? ended : read_rotor(c, f);
}

/* Rotor, films, and their derivatives where the next point of the record will be. */
static int by_law(rf_coupling *c, const rf_found *f, const rf_law *law, double t, double dt)
{
    const rf_record *r = &c->record;
    const int ended = c->scheme == RF_JACOBI ? in_parallel(c, f, law, t, dt) : in_turn(c, f, law, t, dt);
    if (ended || !r->derived)
        return ended;
    return derive(c, f, r->tangents + (size_t)r->count * (2 * r->m * r->m + r->m));
}

/* What was found, where the next point of the record will be. */
static void place(rf_coupling *c, const rf_found *f, double time)
{
    const rf_record *r = &c->record;
    r->time[r->count] = time;
    memcpy(r->outputs + (size_t)r->count * r->columns, f->outputs, r->columns * sizeof(double));
    memcpy(r->force + (size_t)r->count * r->m, f->force, r->m * sizeof(double));
}

static void keep(rf_coupling *c, const rf_found *f, double time)
{
    place(c, f, time);
    ++c->record.count;
    check(c, f);
    ++c->done[0];
    memcpy(c->record.work + 5 * (c->record.count - 1), c->done, sizeof c->done);
}

/* Call all partners with states of their own; that of a rotor that is integrated here goes from one to another. */
static int copy_states(rf_coupling *c, int (*call)(rf_partner *), const double *from, double *to)
{
    rf_rotor *rotor = c->rotor;
    if (rotor->mode == RF_INTEGRATED)
        memcpy(to, from, rotor->partner->states * sizeof(double));
    else if (call(rotor->partner))
        return failed(c, RF_ROTOR_FAILED, -1);
    for (int32_t k = 0; k < c->stations; ++k)
        if (call(c->films[k].partner))
            return failed(c, RF_FILM_FAILED, k);
    return RF_COUPLED;
}

/* The state of all before a step that may be repeated, and the way back. */
static int save(rf_coupling *c)
{
    return copy_states(c, rf_save_partner, c->rotor->x, c->kept);
}

static int restore(rf_coupling *c)
{
    ++c->done[4];
    return copy_states(c, rf_restore_partner, c->kept, c->rotor->x);
}

/* Schemes that go back: a step that they cannot end is left to Python, which says why. */

/* d(motion)/d(held force) from trial steps, kept while the step stays. */
static int probe(rf_coupling *c, const rf_found *f, rf_law *law, double t, double dt)
{
    const size_t m = c->record.m;
    if (fabs(dt - c->probed) <= 1e-9 * dt)
        return RF_COUPLED;
    c->probed = 0.0;
    for (size_t k = 0; k <= m; ++k) {
        memset(f->held, 0, m * sizeof(double));
        if (k > 0)
            f->held[k - 1] = PROBE;
        rf_held_law(&c->record, f->held, law);
        int ended = save(c);
        if (!ended)
            ended = drive(c, law, t, dt);
        if (!ended)
            ++c->done[3], ended = read_rotor(c, f);
        if (!ended)
            ended = restore(c);
        if (ended)
            return ended;
        place_motion(&c->record, f->outputs, f->motion);
        for (size_t i = 0; i < 2 * m; ++i) /* the motion without force waits in the last column */
            if (k > 0)
                c->sensitivity[i * m + k - 1] = f->motion[i] / PROBE - c->sensitivity[2 * m * m + i];
            else
                c->sensitivity[2 * m * m + i] = f->motion[i] / PROBE;
    }
    c->probed = dt;
    return RF_COUPLED;
}

/* Newton's step of the held force: the films' tangents through the rotor's sensitivity. */
static void correct(const rf_coupling *c, const rf_found *f)
{
    const rf_record *r = &c->record;
    const size_t m = r->m;
    const double *tangents = r->tangents + (size_t)r->count * (2 * m * m + m);
    for (size_t i = 0; i < m; ++i)
        for (size_t j = 0; j < m; ++j) {
            double sum = 0.0;
            for (size_t k = 0; k < m; ++k)
                sum += tangents[i * m + k] * c->sensitivity[k * m + j]
                       + tangents[(m + i) * m + k] * c->sensitivity[(m + k) * m + j];
            f->feedback[i * m + j] = (i == j ? 1.0 : 0.0) + 0.5 * sum;
        }
    rf_eliminate(m, f->feedback, 1, f->residual);
    for (size_t i = 0; i < m; ++i)
        f->held[i] -= f->residual[i];
}

/* The force held at the mean of both ends of the step. */
static int by_newton(rf_coupling *c, const rf_found *f, rf_law *law, double t, double dt)
{
    const rf_record *r = &c->record;
    const size_t m = r->m, now = (size_t)r->count - 1;
    const double *force = r->force + now * m;
    int ended = probe(c, f, law, t, dt);
    const double ahead = now > 0 ? (t + 0.5 * dt - r->time[now]) / (r->time[now] - r->time[now - 1]) : 0.0;
    for (size_t i = 0; i < m; ++i)
        f->held[i] = now > 0 ? force[i] + ahead * (force[i] - force[i - m]) : force[i];
    for (int32_t count = 0; !ended && count < c->most; ++count) {
        double size = 0.0, left = 0.0;
        if ((ended = save(c)))
            break;
        rf_held_law(r, f->held, law);
        if ((ended = by_law(c, f, law, t, dt)))
            break;
        for (size_t i = 0; i < m; ++i) {
            f->residual[i] = f->held[i] - 0.5 * (force[i] + f->force[i]);
            left = fmax(left, fabs(f->residual[i]));
            size = fmax(size, fabs(f->held[i]) + fabs(force[i]));
        }
        if (left <= c->tolerance * size)
            return RF_COUPLED;
        ended = restore(c);
        correct(c, f);
        if (!all_finite(f->held, m))
            break;
    }
    return ended ? ended : RF_ROTOR_WAITING;
}

/* The error of the force at a point of the record, in tolerances. */
static double error_at(const rf_coupling *c, const rf_found *f, int64_t point)
{
    const rf_record *r = &c->record;
    const size_t m = r->m;
    const double *now = r->force + (size_t)point * m;
    double left = 0.0, found = 0.0, before = 0.0;
    rf_defect(r, point - 1, point, f->residual);
    if (c->behind && point > 1) {
        const double ratio =
            (r->time[point] - r->time[point - 1]) / (r->time[point - 1] - r->time[point - 2]);
        rf_defect(r, point - 2, point - 1, f->held);
        for (size_t i = 0; i < m; ++i)
            f->residual[i] -= ratio * ratio * f->held[i];
    }
    for (size_t i = 0; i < m; ++i) {
        left += f->residual[i] * f->residual[i];
        found += now[i] * now[i];
        before += (now - m)[i] * (now - m)[i];
    }
    const double size = 0.5 * (sqrt(found) + sqrt(before));
    return size > 0.0 ? sqrt(left) / (c->tolerance * size) : 0.0;
}

/* The factor to the next step from an error in tolerances. */
static double factor_of(const rf_coupling *c, double error)
{
    return SAFETY * pow(error, c->behind ? -1.0 / 3.0 : -0.5);
}

/* A step of the length that the error asks for, dt at most. */
static int adapted(rf_coupling *c, const rf_found *f, rf_law *law, double t, double *dt)
{
    const rf_record *r = &c->record;
    const double shortest = GIVE_UP * *dt;
    if (r->count > 1) {
        const double last = r->time[r->count - 1] - r->time[r->count - 2];
        const double wanted = factor_of(c, fmax(error_at(c, f, r->count - 1), 1e-12));
        *dt = fmin(*dt, last * fmin(fmax(wanted, LEAST), MOST));
    }
    while (*dt >= shortest) {
        int ended = save(c);
        make_law(c, law);
        c->reached = t + *dt;
        if (!ended)
            ended = by_law(c, f, law, t, *dt);
        if (ended)
            return ended;
        place(c, f, t + *dt);
        const double error = error_at(c, f, r->count);
        if (error <= 1.0)
            return RF_COUPLED;
        if ((ended = restore(c)))
            return ended;
        *dt *= fmax(LEAST, factor_of(c, error));
    }
    return RF_ROTOR_WAITING;
}

static int one_step(rf_coupling *c, const rf_found *f, rf_law *law, double t, double *dt)
{
    if (c->adaptive)
        return adapted(c, f, law, t, dt);
    if (c->scheme == RF_NEWTON)
        return by_newton(c, f, law, t, *dt);
    make_law(c, law);
    return by_law(c, f, law, t, *dt);
}

/* Parabolas need a past: a gentle start doubles a short step. */
static double length_of(const rf_coupling *c, double dt)
{
    const rf_record *r = &c->record;
    if (!c->gentle)
        return dt;
    if (r->count < 2)
        return FIRST * dt;
    const double twice = 2.0 * (r->time[r->count - 1] - r->time[r->count - 2]);
    return dt <= twice ? dt : twice;
}

static int advance(rf_coupling *c, const rf_found *f, rf_law *law, double end)
{
    int64_t done[5];
    while (c->t < end) {
        double dt = length_of(c, end - c->t);
        if (c->record.count == c->record.room)
            return RF_FULL;
        c->reached = c->t + dt;
        memcpy(done, c->done, sizeof done);
        const int ended = one_step(c, f, law, c->t, &dt);
        if (ended == RF_ROTOR_WAITING)
            memcpy(c->done, done, sizeof done);
        if (ended)
            return ended;
        const double time = c->t + dt;
        keep(c, f, time);
        c->t = time >= end - 1e-9 * c->macro_step ? end : time;
    }
    return RF_COUPLED;
}

static void forget(rf_coupling *c)
{
    rf_forget_partner(c->rotor->partner);
    for (int32_t k = 0; k < c->stations; ++k)
        rf_forget_partner(c->films[k].partner);
}

int rf_couple(rf_coupling *c, int64_t steps)
{
    const rf_found f = placed(c);
    rf_law law;
    int ended = RF_COUPLED;
    rf_place_law(&law, c->record.m, f.law);
    while (!ended && c->step < steps) {
        const double begin = c->points[c->step], end = begin + (c->points[c->step + 1] - begin);
        if (c->t < begin)
            c->t = begin;
        ended = advance(c, &f, &law, end);
        if (!ended)
            c->t = c->points[++c->step];
    }
    forget(c);
    return ended;
}
