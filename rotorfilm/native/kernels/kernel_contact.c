/* Kernel "contact": lubricated contacts by their static law and a state space, as bearings/contact/contact_law.py.

   Of each contact the approach is d = gap + (motion u), the force max(0, s(d) + y), where s(d) is the static
   law scale ((offset - d)/span)^exponent and y the answer of the state space (A, B, C, D), driven by
   min(d, offset) - operating. Outputs are `push` times the forces. Tables: A, B, C, D; motion (contacts,
   inputs); push (outputs, contacts); law (7: offset, span [m], exponent, scale [N], operating [m], smallest and
   largest load of the fit [N]). Parameter: gap [m]. */

/* Documentation of the FMU

   Model: Lubricated rolling contacts of balls by their reduced law. The approach d of a contact is gap +
   (motion u): the distance of the ball's center beyond first touch, negative in contact. The force of a
   contact is that of the stationary contact, and what the dynamic stiffness of the film adds to it; a film
   does not pull, and a ball beyond `offset` no longer drives the states. The outputs are push times the
   forces:

   Equations:
   dx/dt = A x + B (min(d, offset) - operating)
   force = max(0, scale ((offset - d)/span)^exponent + C x + D (min(d, offset) - operating))
   output = push force,  d = gap + motion u

   Validity: The table `law` is offset, span [m], exponent, scale [N], operating [m], and the smallest and
   largest load [N] of the fit; beyond these loads there is a warning. The state space is the linearized
   film under the load `scale`, fitted to six radians per transit time; its errors are those of the model
   that was exported. Isothermal, smooth surfaces, one rolling speed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernel.h"

#define MOST 64 /* contacts */

enum { OFFSET, SPAN, EXPONENT, SCALE, OPERATING, LOWEST, HIGHEST, LAW };

typedef struct model {
    void *linear; /* kernel "linear", its inputs the drives, its outputs the dynamic forces */
    size_t inputs, outputs, contacts, states;
    double gap;
    const double *motion, *push, *law;
    double *work; /* (states + contacts)^2: the derivatives of the state space */
} model;

/* The contacts at one point. */
typedef struct contacts {
    double drive[MOST], force[MOST], slope[MOST]; /* slope of the static law; 0 where it is open */
    double lift[MOST];                            /* approach beyond the offset, in spans */
    int near[MOST];                               /* whether the state space is driven */
} contacts;


static void release(void *kernel)
{
    model *self = kernel;
    rf_destroy_kernel(&rf_linear_type, self->linear);
    free(self->work);
}

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    model *self = kernel;
    const rf_table *motion = rf_find_table(tables, "motion", 2, why),
                   *push = motion ? rf_find_table(tables, "push", 2, why) : NULL,
                   *law = push ? rf_find_table(tables, "law", 1, why) : NULL;
    rf_sizes of_law = {0, 0, 0, 0, 0};
    if (!law || !(self->linear = rf_create_kernel(&rf_linear_type, tables, &of_law, why)))
        return RF_INVALID;
    if (motion->extent[0] > MOST)
        return rf_say(why, RF_INVALID, "contacts must be %d at most, got %u", MOST, (unsigned)motion->extent[0]);
    self->contacts = motion->extent[0], self->inputs = motion->extent[1];
    self->outputs = push->extent[0], self->states = of_law.states;
    if (push->extent[1] != self->contacts || of_law.inputs != self->contacts
        || of_law.outputs != self->contacts || law->extent[0] != LAW)
        return rf_say(why, RF_INVALID, "the tables of contacts must fit each other, got %zu and %u contacts",
                      self->contacts, (unsigned)push->extent[1]);
    self->motion = motion->numbers, self->push = push->numbers, self->law = law->numbers;
    *sizes = (rf_sizes){1, self->inputs, self->outputs, self->states, 2 * self->contacts};
    const size_t size = self->states + self->contacts;
    self->work = malloc((size * size + 1) * sizeof *self->work);
    return self->work ? RF_OK : rf_say(why, RF_MEMORY, "no memory for %zu contacts", self->contacts);
}

static int set_parameters(void *kernel, const double *parameters, rf_message *why)
{
    model *self = kernel;
    if (!isfinite(parameters[0]))
        return rf_say(why, RF_INVALID, "gap must be finite, got %.9g", parameters[0]);
    self->gap = parameters[0];
    return RF_OK;
}

/* Static forces, their slopes and the drives; RF_OUTSIDE where a load is beyond the fit. */
static int press(const model *self, const rf_point *at, contacts *now, rf_message *why)
{
    const double *law = self->law;
    int status = RF_OK;
    for (size_t i = 0; i < self->contacts; ++i) {
        double d = self->gap;
        for (size_t j = 0; j < self->inputs; ++j)
            d += self->motion[i * self->inputs + j] * at->u[j];
        if (!isfinite(d))
            return rf_say(why, RF_NOT_FINITE, "approach %zu is not finite at t = %.9g s", i, at->t);
        now->near[i] = d <= law[OFFSET];
        now->lift[i] = (d - law[OFFSET]) / law[SPAN];
        const double depth = now->near[i] ? (law[OFFSET] - d) / law[SPAN] : 0.0;
        now->drive[i] = (now->near[i] ? d : law[OFFSET]) - law[OPERATING];
        now->force[i] = law[SCALE] * pow(depth, law[EXPONENT]);
        now->slope[i] = -law[SCALE] * law[EXPONENT] / law[SPAN] * pow(depth, law[EXPONENT] - 1.0);
        if (now->force[i] > law[HIGHEST] || (now->near[i] && now->force[i] < law[LOWEST]))
            status = rf_say(why, RF_OUTSIDE,
                            "load %.9g N of contact %zu is outside %.9g to %.9g N, to which its law was fitted",
                            now->force[i], i, law[LOWEST], law[HIGHEST]);
    }
    return status;
}

/* The forces of static law and state space together, before they are clipped. */
static int add_dynamic(const model *self, const rf_point *at, contacts *now, rf_message *why)
{
    double dynamic[MOST];
    const rf_point driven = {at->t, at->x, now->drive};
    const int status = rf_linear_type.output(self->linear, &driven, dynamic, why);
    for (size_t i = 0; status == RF_OK && i < self->contacts; ++i)
        now->force[i] += dynamic[i];
    return status;
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    const model *self = kernel;
    contacts now;
    rf_message failed;
    const int status = press(self, at, &now, why);
    if (status > RF_OUTSIDE)
        return status;
    if (add_dynamic(self, at, &now, &failed) != RF_OK)
        return rf_say(why, RF_NOT_FINITE, "%s", failed.text);
    for (size_t k = 0; k < self->outputs; ++k) {
        y[k] = 0.0;
        for (size_t i = 0; i < self->contacts; ++i)
            y[k] += self->push[k * self->contacts + i] * (now.force[i] > 0.0 ? now.force[i] : 0.0);
    }
    return status;
}

/* Of each contact what changes sign where the ball leaves its film, and where its force vanishes. */
static int events(const void *kernel, const rf_point *at, double *z, rf_message *why)
{
    const model *self = kernel;
    contacts now;
    int status = press(self, at, &now, why);
    if (status > RF_OUTSIDE || (status = add_dynamic(self, at, &now, why)) != RF_OK)
        return status;
    for (size_t i = 0; i < self->contacts; ++i) {
        z[2 * i] = now.lift[i];
        z[2 * i + 1] = now.force[i] / self->law[SCALE];
    }
    return RF_OK;
}

static int derivative(const void *kernel, const rf_point *at, double *dx, rf_message *why)
{
    const model *self = kernel;
    contacts now;
    const int status = press(self, at, &now, why);
    if (status > RF_OUTSIDE)
        return status;
    const rf_point driven = {at->t, at->x, now.drive};
    return rf_linear_type.derivative(self->linear, &driven, dx, why);
}

static int step(void *kernel, const rf_point *at, double dt, double *x, rf_message *why)
{
    model *self = kernel;
    contacts now;
    const int status = press(self, at, &now, why);
    if (status > RF_OUTSIDE)
        return status;
    const rf_point driven = {at->t, at->x, now.drive};
    return rf_linear_type.step(self->linear, &driven, dt, x, why);
}

/* d force[i] / d drive[j], the static law's slope included, where neither is clipped. */
static double by_approach(const model *self, const contacts *now, const double *D, size_t i, size_t j)
{
    return (now->near[j] ? D[i * self->contacts + j] : 0.0) + (i == j ? now->slope[i] : 0.0);
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    const model *self = kernel;
    const size_t n = self->states, k = self->contacts, m = self->inputs, p = self->outputs;
    double *B = self->work, *C = B + n * k, *D = C + k * n;
    const rf_jacobian inner = {answer->A, B, C, D};
    rf_jacobian own = inner;
    contacts now;
    rf_message failed;
    const int status = press(self, at, &now, why);
    if (status > RF_OUTSIDE)
        return status;
    if (add_dynamic(self, at, &now, &failed) != RF_OK)
        return rf_say(why, RF_NOT_FINITE, "%s", failed.text);
    rf_linear_type.jacobian(self->linear, at, &own, &failed);
    memset(answer->B, 0, n * m * sizeof(double));
    memset(answer->C, 0, p * n * sizeof(double));
    memset(answer->D, 0, p * m * sizeof(double));
    for (size_t i = 0; i < k; ++i) {
        for (size_t r = 0; r < n; ++r)
            for (size_t c = 0; now.near[i] && c < m; ++c)
                answer->B[r * m + c] += B[r * k + i] * self->motion[i * m + c];
        for (size_t r = 0; now.force[i] >= 0.0 && r < p; ++r) {
            const double push = self->push[r * k + i];
            for (size_t c = 0; c < n; ++c)
                answer->C[r * n + c] += push * C[i * n + c];
            for (size_t j = 0; j < k; ++j)
                for (size_t c = 0; c < m; ++c)
                    answer->D[r * m + c] += push * by_approach(self, &now, D, i, j) * self->motion[j * m + c];
        }
    }
    return status;
}

const rf_kernel_type rf_contact_type = {
    .bytes = sizeof(model),
    .take = take_tables,
    .release = release,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
    .derivative = derivative,
    .step = step,
    .events = events,
};
