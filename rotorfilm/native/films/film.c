#include "film.h"

typedef struct bound {
    rf_film film;
    const void *data;
} bound;

static int respond(const void *of, const double *state, double *f, double *jacobian)
{
    const bound *self = of;
    return self->film(self->data, state, state + 2, f, jacobian);
}

int rf_film_batch(rf_film film, const void *data, size_t n, const double *e, size_t e_stride,
                  const double *w, size_t w_stride, double *f, size_t f_stride, double *jacobian,
                  size_t jacobian_stride, size_t *first)
{
    const bound self = {film, data};
    const rf_states states = {{e, e + e_stride, w, w + w_stride, w}, {1, 1, 1, 1, 0}};
    const rf_answers answers = {f, f_stride, jacobian, jacobian_stride};
    return rf_each(respond, &self, &states, 4, n, &answers, first);
}
