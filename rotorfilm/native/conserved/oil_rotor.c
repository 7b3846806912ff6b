#include "oil_rotor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../solvers/dense.h"

#define CONVERGED 1e-9 /* last Newton step, in `scale` */
#define MOST_ROUNDS 12
#define SMALL 1e-3  /* first Newton step, in `scale`, after which the second one has the same stiffness */
#define NEAREST 0.1 /* part of the gap that a Newton step leaves */

/* The work of a step; matrices and vectors of the journals have two rows for each film. */
typedef struct meeting {
    const rf_oil_rotor *rotor;
    rf_oil_traveler *travelers;
    size_t rows, *block; /* where the block of each film begins */
    double *tried;       /* blocks of the last trial */
    double *free, *x, *moved;
    double *here, *there; /* motions */
    double *force, *stiffness, *compliance, *matrix, *change;
    void *memory;
} meeting;

static size_t reserve(double **part, double *memory, size_t at, size_t count)
{
    *part = memory ? memory + at : NULL;
    return at + count;
}

/* Set the places of all parts, and return how many numbers they are. */
static size_t lay_out(meeting *self, double *memory, size_t blocks)
{
    const size_t n = self->rotor->states, rows = self->rows, motions = RF_MOTION * self->rotor->films;
    size_t at = reserve(&self->tried, memory, 0, blocks);
    at = reserve(&self->free, memory, at, n);
    at = reserve(&self->x, memory, at, n);
    at = reserve(&self->moved, memory, at, n);
    at = reserve(&self->here, memory, at, motions);
    at = reserve(&self->there, memory, at, motions);
    at = reserve(&self->force, memory, at, rows);
    at = reserve(&self->stiffness, memory, at, 2 * rows);
    at = reserve(&self->compliance, memory, at, rows * rows);
    at = reserve(&self->matrix, memory, at, rows * rows);
    return reserve(&self->change, memory, at, rows);
}

static void close_meeting(meeting *self)
{
    for (size_t k = 0; self->travelers && k < self->rotor->films; ++k)
        rf_close_traveler(self->travelers + k);
    free(self->travelers);
    free(self->block);
    free(self->memory);
}

/* How the journals give way to the forces on them in a step. */
static void set_compliance(meeting *self)
{
    const rf_oil_rotor *rotor = self->rotor;
    for (size_t i = 0; i < self->rows; ++i)
        for (size_t j = 0; j < self->rows; ++j) {
            const double *sense = rotor->sense + (i / 2 * RF_MOTION + i % 2) * rotor->states;
            double sum = 0.0;
            for (size_t k = 0; k < rotor->states; ++k)
                sum += sense[k] * rotor->gain[k * self->rows + j];
            self->compliance[i * self->rows + j] = sum;
        }
}

static int open_meeting(meeting *self, const rf_oil_rotor *rotor, rf_message *why)
{
    size_t blocks = 0;
    memset(self, 0, sizeof *self);
    self->rotor = rotor;
    self->rows = 2 * rotor->films;
    self->travelers = calloc(rotor->films, sizeof *self->travelers);
    self->block = calloc(rotor->films, sizeof *self->block);
    int status = self->travelers && self->block ? RF_OK : RF_MEMORY;
    for (size_t k = 0; k < rotor->films && status == RF_OK; ++k) {
        self->block[k] = blocks;
        blocks += rf_oil_numbers(&rotor->film[k]->shape);
        status = rf_open_traveler(self->travelers + k, rotor->film[k], why);
    }
    if (status == RF_OK)
        self->memory = malloc(lay_out(self, NULL, blocks) * sizeof(double));
    if (!self->memory)
        return rf_say(why, RF_MEMORY, "no memory for a film");
    lay_out(self, self->memory, blocks);
    set_compliance(self);
    return RF_OK;
}

static void set_motion(const meeting *self, const double *offset, const double *x, double *motion)
{
    memcpy(motion, offset, RF_MOTION * self->rotor->films * sizeof *motion);
    rf_add_product(RF_MOTION * self->rotor->films, self->rotor->states, 1.0, self->rotor->sense, x, motion);
}

/* Go from x towards what moved it, no further than to where all journals keep part of their gap; returns the largest
   change in `scale`. */
static int go_within(meeting *self, const double *offset, double time, double *size, rf_message *why)
{
    const rf_oil_rotor *rotor = self->rotor;
    double share = 1.0;
    set_motion(self, offset, self->x, self->here);
    set_motion(self, offset, self->moved, self->there);
    for (size_t k = 0; k < rotor->films; ++k) {
        const double c = rotor->film[k]->clearance, *begin = self->here + RF_MOTION * k, *end = self->there + RF_MOTION * k;
        const double least = NEAREST * (c - hypot(begin[0], begin[1]));
        if (least <= 0.0)
            return rf_say(why, RF_AT_WALL, "the journal must stay inside the clearance at t = %.9g s", time);
        while (c - hypot(begin[0] + share * (end[0] - begin[0]), begin[1] + share * (end[1] - begin[1])) < least)
            share *= 0.5;
    }
    *size = 0.0;
    for (size_t k = 0; k < rotor->states; ++k) {
        const double change = share * (self->moved[k] - self->x[k]);
        self->x[k] += change;
        *size = fabs(change) / rotor->scale[k] > *size || isnan(change) ? fabs(change) / rotor->scale[k] : *size;
    }
    return RF_OK;
}

/* Forces of films and springs where the state is, and, unless it stays, their stiffness. */
static int try_films(meeting *self, const double *offset, double dt, const double *blocks, const double *near, int stays,
                     int64_t *solutions)
{
    const rf_oil_rotor *rotor = self->rotor;
    int status = RF_OK;
    set_motion(self, offset, self->x, self->here);
    for (size_t k = 0; k < rotor->films && status == RF_OK; ++k) {
        double *end = self->tried + self->block[k], *stiffness = self->stiffness + 4 * k;
        status = rf_try_oil(self->travelers + k, blocks + self->block[k], near + self->block[k],
                            self->here + RF_MOTION * k, dt, end, stays ? NULL : stiffness, solutions);
        for (size_t i = 0; i < 2; ++i) {
            self->force[2 * k + i] = end[RF_OIL_ANSWER + i] - rotor->springs[k] * self->here[RF_MOTION * k + i];
            stiffness[3 * i] += stays ? 0.0 : rotor->springs[k];
        }
        *solutions += !stays;
    }
    return status;
}

/* Where the rotor would go under these forces and their slopes: (1 + H K) dz = z(free) + H F - z(x). */
static void set_moved(meeting *self)
{
    const rf_oil_rotor *rotor = self->rotor;
    const size_t rows = self->rows, n = rotor->states;
    for (size_t k = 0; k < n; ++k)
        self->moved[k] = self->free[k] - self->x[k];
    for (size_t i = 0; i < rows; ++i) {
        self->change[i] = 0.0;
        rf_add_product(1, n, 1.0, rotor->sense + (i / 2 * RF_MOTION + i % 2) * n, self->moved, self->change + i);
        rf_add_product(1, rows, 1.0, self->compliance + i * rows, self->force, self->change + i);
        for (size_t j = 0; j < rows; ++j) {
            const double *stiffness = self->stiffness + j / 2 * 4, *flexible = self->compliance + i * rows + j / 2 * 2;
            self->matrix[i * rows + j] =
                (i == j) + flexible[0] * stiffness[j % 2] + flexible[1] * stiffness[2 + j % 2];
        }
    }
    rf_eliminate(rows, self->matrix, 1, self->change);
    for (size_t i = 0; i < rows; ++i)
        rf_add_product(1, 2, -1.0, self->stiffness + 2 * i, self->change + i / 2 * 2, self->force + i);
    memcpy(self->moved, self->free, n * sizeof *self->moved);
    rf_add_product(n, rows, 1.0, rotor->gain, self->force, self->moved);
}

/* One step to `time`; x is then its end, and the blocks tried are those there. */
static int meet(meeting *self, const double *offset, double dt, double time, const double *blocks, int64_t *done,
                rf_message *why)
{
    double size = 0.0;
    int status = go_within(self, offset, time, &size, why);
    for (int round = 0; round < MOST_ROUNDS && status == RF_OK; ++round) {
        const double *near = round > 0 ? self->tried : blocks;
        status = try_films(self, offset, dt, blocks, near, round == 1 && size < SMALL, done + 2);
        if (status != RF_OK)
            return rf_say(why, status, "the search for the ruptured zone of a mass-conserving film did not end: "
                          "the film may have no supply, or be too thin for the cells");
        set_moved(self);
        status = go_within(self, offset, time, &size, why);
        ++done[1];
        if (status == RF_OK && size <= CONVERGED)
            return RF_OK;
        if (!isfinite(size))
            break;
    }
    if (status != RF_OK)
        return status;
    return rf_say(why, RF_STUCK, "Newton's method must end in the step to t = %.9g s", time);
}

/* What a step of the rotor is without films, and where it begins to look: on the line through the last two states, after
   `equal` steps of one length on the polynomial through up to four. */
static void prepare(meeting *self, const double *drive, const double *start, const double *now, size_t equal)
{
    const rf_oil_rotor *rotor = self->rotor;
    const size_t n = rotor->states;
    const double *before = now - n;
    for (size_t k = 0; k < n; ++k) {
        const double bent = equal > 1 ? now[k] - 2.0 * before[k] + *(before + k - n) : 0.0;
        const double turned = equal > 2 ? bent - (before[k] - 2.0 * *(before + k - n) + *(before + k - 2 * n)) : 0.0;
        self->x[k] = drive[k] - rotor->last * now[k] - rotor->older * before[k];
        self->moved[k] = start ? start[k] : now[k] + rotor->growth * (now[k] - before[k]) + bent + turned;
    }
    memset(self->free, 0, n * sizeof *self->free);
    if (rotor->inverse)
        rf_add_product(n, n, 1.0, rotor->inverse, self->x, self->free);
    else
        memcpy(self->free, drive, n * sizeof *self->free);
    memcpy(self->x, now, n * sizeof *now);
}

static void set_answers(const meeting *self, double *answers)
{
    for (size_t k = 0; k < self->rotor->films; ++k, answers += RF_OIL_ANSWERS) {
        const double *block = self->tried + self->block[k];
        memcpy(answers, block + RF_OIL_ANSWER, RF_OIL_ANSWERS * sizeof *answers);
        for (size_t i = 0; i < 2; ++i)
            answers[i] -= self->rotor->springs[k] * block[RF_OIL_MOTION + i];
    }
}

int rf_oil_march(const rf_oil_rotor *rotor, size_t count, const double *lengths, const double *time, const double *drive,
                 const double *offset, const double *start, double *states, double *blocks, double *answers,
                 int64_t *done, rf_message *why)
{
    const size_t n = rotor->states, motions = RF_MOTION * rotor->films;
    meeting self;
    int status = open_meeting(&self, rotor, why);
    memset(done, 0, 3 * sizeof *done);
    for (size_t k = 0; k < count && status == RF_OK; ++k) {
        prepare(&self, drive + k * n, k > 0 ? NULL : start, states + (k + 1) * n, rotor->growth == 1.0 ? k + 1 : 0);
        status = meet(&self, offset + k * motions, lengths[k], time[k], blocks, done, why);
        if (status != RF_OK)
            break;
        memcpy(states + (k + 2) * n, self.x, n * sizeof *states);
        memcpy(blocks, self.tried, (size_t)(self.free - self.tried) * sizeof *blocks);
        set_answers(&self, answers + k * rotor->films * RF_OIL_ANSWERS);
        done[0] = (int64_t)k + 1;
    }
    close_meeting(&self);
    return status;
}
