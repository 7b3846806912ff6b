#include "couple.h"

#include <math.h>
#include <string.h>

#define FIRST (1.0 / 63.0) /* first step of a gentle start, in macro steps */

/* What one step has computed before it is a point of the record. */
typedef struct rf_found {
    double *motion, *outputs, *force, *law, *values, *whole, *column;
} rf_found;

size_t rf_coupling_work(const rf_coupling *c, size_t widest)
{
    const size_t m = c->record.m;
    return 2 * m + 1 + c->record.columns + m + RF_LAW_SIZE(m) + widest + 10 + widest;
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
    f.values = f.column + 2;
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
        rf_tangential_law(&c->record, c->third, law);
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

static int keep(rf_coupling *c, const rf_found *f, double time)
{
    rf_record *r = &c->record;
    const size_t n = (size_t)r->count, m = r->m, columns = 2 * m * m + m;
    if (r->derived) {
        const int ended = derive(c, f, r->tangents + n * columns);
        if (ended)
            return ended;
    }
    r->time[n] = time;
    memcpy(r->outputs + n * r->columns, f->outputs, r->columns * sizeof(double));
    memcpy(r->force + n * m, f->force, m * sizeof(double));
    ++r->count;
    check(c, f);
    ++c->done[0];
    memcpy(r->work + 5 * n, c->done, sizeof c->done);
    return RF_COUPLED;
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
    while (c->t < end) {
        const double dt = length_of(c, end - c->t), time = c->t + dt;
        if (c->record.count == c->record.room)
            return RF_FULL;
        c->reached = time;
        make_law(c, law);
        int ended = c->scheme == RF_JACOBI ? in_parallel(c, f, law, c->t, dt) : in_turn(c, f, law, c->t, dt);
        if (!ended)
            ended = keep(c, f, time);
        if (ended)
            return ended;
        c->t = time >= end - 1e-9 * c->macro_step ? end : time;
    }
    return RF_COUPLED;
}

int rf_couple(rf_coupling *c, int64_t steps)
{
    const rf_found f = placed(c);
    rf_law law;
    rf_place_law(&law, c->record.m, f.law);
    while (c->step < steps) {
        const double begin = c->points[c->step], end = begin + (c->points[c->step + 1] - begin);
        if (c->t < begin)
            c->t = begin;
        const int ended = advance(c, &f, &law, end);
        if (ended)
            return ended;
        c->t = c->points[++c->step];
    }
    return RF_COUPLED;
}
