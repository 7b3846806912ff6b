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
                  const double *w, size_t w_stride, const double *rate, double *f, size_t f_stride, double *jacobian,
                  size_t jacobian_stride, size_t *first)
{
    const bound self = {film, data};
    const rf_states states = {{e, e + e_stride, w, w + w_stride, rate ? rate : w}, {1, 1, 1, 1, rate ? 1 : 0}};
    const rf_answers answers = {f, f_stride, jacobian, jacobian_stride};
    return rf_each(respond, &self, &states, rate ? 5 : 4, n, &answers, first);
}

int rf_response_call(rf_response respond_to, const void *of, double x, double y, double vx, double vy, double speed,
                     double *f)
{
    const double state[5] = {x, y, vx, vy, speed};
    return respond_to(of, state, f, NULL);
}

int rf_response_batch(rf_response respond_to, const void *of, size_t n, const double *position,
                      size_t position_stride, const double *velocity, size_t velocity_stride, const double *speed,
                      size_t speed_step, double *f, size_t f_stride, double *jacobian, size_t jacobian_stride,
                      size_t *first)
{
    const rf_states states = {
        {position, position + position_stride, velocity, velocity + velocity_stride, speed},
        {1, 1, 1, 1, speed_step},
    };
    const rf_answers answers = {f, f_stride, jacobian, jacobian_stride};
    return rf_each(respond_to, of, &states, 5, n, &answers, first);
}
