#include "law.h"

#include <string.h>

void rf_place_law(rf_law *law, size_t m, double *numbers)
{
    law->m = m;
    law->force = numbers, numbers += m;
    law->slope = numbers, numbers += m;
    law->curvature = numbers, numbers += m;
    law->stiffness = numbers, numbers += m * m;
    law->damping = numbers, numbers += m * m;
    law->position = numbers, numbers += m;
    law->velocity = numbers;
}

void rf_law_at(const rf_law *law, double t, const double *position, const double *velocity, double *force)
{
    const double elapsed = t - law->start;
    for (size_t i = 0; i < law->m; ++i) {
        const double *K = law->stiffness + i * law->m, *C = law->damping + i * law->m;
        double pull = 0.0, drag = 0.0;
        for (size_t j = 0; j < law->m; ++j) {
            pull += K[j] * (position[j] - law->position[j]);
            drag += C[j] * (velocity[j] - law->velocity[j]);
        }
        force[i] = law->force[i] + elapsed * (law->slope[i] + elapsed * law->curvature[i]) - pull - drag;
    }
}

double rf_speed_of(const rf_record *r, int64_t point)
{
    return r->speed < 0 ? 0.0 : r->outputs[(size_t)point * r->columns + (size_t)r->speed];
}

/* Value, slope and curvature at the latest of up to three points. */
static void extrapolate(size_t count, const double *times, const double *values, double *parts)
{
    const double *t = times, *v = values;
    parts[0] = v[count - 1];
    parts[1] = parts[2] = 0.0;
    if (count < 2)
        return;
    const double last = t[count - 1] - t[count - 2];
    parts[1] = (v[count - 1] - v[count - 2]) / last;
    if (count < 3)
        return;
    const double before = (v[1] - v[0]) / (t[1] - t[0]);
    parts[2] = (parts[1] - before) / (t[2] - t[0]);
    parts[1] = parts[1] + parts[2] * last;
}

static size_t used(const rf_record *r, int degree)
{
    const size_t wanted = (size_t)degree + 1;
    return (int64_t)wanted > r->count ? (size_t)r->count : wanted;
}

void rf_extrapolated_law(const rf_record *r, int degree, rf_law *law)
{
    const size_t m = r->m, count = used(r, degree), first = (size_t)r->count - count;
    double values[3], parts[3];
    memset(law->force, 0, RF_LAW_SIZE(m) * sizeof(double));
    law->start = r->time[r->count - 1];
    for (size_t i = 0; i < m; ++i) {
        for (size_t k = 0; k < count; ++k)
            values[k] = r->force[(first + k) * m + i];
        extrapolate(count, r->time + first, values, parts);
        law->force[i] = parts[0], law->slope[i] = parts[1], law->curvature[i] = parts[2];
    }
}

void rf_motion_ahead(const rf_record *r, int degree, double t, double *motion)
{
    const size_t m = r->m, count = used(r, degree), first = (size_t)r->count - count;
    const double elapsed = t - r->time[r->count - 1];
    double values[3], parts[3];
    for (size_t i = 0; i <= 2 * m; ++i) {
        const int32_t at = i < m ? r->position[i] : i < 2 * m ? r->velocity[i - m] : r->speed;
        for (size_t k = 0; k < count; ++k)
            values[k] = at < 0 ? 0.0 : r->outputs[(first + k) * r->columns + (size_t)at];
        extrapolate(count, r->time + first, values, parts);
        motion[i] = 0.0 + parts[0] + elapsed * parts[1] + elapsed * elapsed * parts[2];
    }
}

static void take_motion(const rf_record *r, const double *outputs, rf_law *law)
{
    for (size_t i = 0; i < r->m; ++i) {
        law->position[i] = outputs[r->position[i]];
        law->velocity[i] = outputs[r->velocity[i]];
    }
}

void rf_held_law(const rf_record *r, const double *force, rf_law *law)
{
    memset(law->force, 0, RF_LAW_SIZE(r->m) * sizeof(double));
    law->start = r->time[r->count - 1];
    memcpy(law->force, force, r->m * sizeof(double));
}

void rf_defect(const rf_record *r, int64_t before, int64_t now, double *left)
{
    const size_t m = r->m;
    const double *old = r->outputs + (size_t)before * r->columns, *new = r->outputs + (size_t)now * r->columns;
    const double *stiffness = r->tangents + (size_t)now * (2 * m * m + m), *damping = stiffness + m * m;
    const double *by_speed = damping + m * m, speed = rf_speed_of(r, before) - rf_speed_of(r, now);
    for (size_t i = 0; i < m; ++i) {
        double pull = 0.0, drag = 0.0;
        for (size_t j = 0; j < m; ++j) {
            pull += stiffness[i * m + j] * (old[r->position[j]] - new[r->position[j]]);
            drag += damping[i * m + j] * (old[r->velocity[j]] - new[r->velocity[j]]);
        }
        left[i] = r->force[(size_t)before * m + i] - r->force[(size_t)now * m + i] + pull + drag
                  - speed * by_speed[i];
    }
}

void rf_tangential_law(const rf_record *r, int behind, rf_law *law)
{
    const size_t m = r->m, now = (size_t)r->count - 1;
    const double *tangents = r->tangents + now * (2 * m * m + m), *by_speed = tangents + 2 * m * m;
    rf_held_law(r, r->force + now * m, law);
    memcpy(law->stiffness, tangents, m * m * sizeof(double));
    memcpy(law->damping, tangents + m * m, m * m * sizeof(double));
    take_motion(r, r->outputs + now * r->columns, law);
    if (now == 0)
        return;
    const double dt = r->time[now] - r->time[now - 1];
    const double rate = (rf_speed_of(r, (int64_t)now) - rf_speed_of(r, (int64_t)now - 1)) / dt;
    if (behind == 1) {
        rf_defect(r, (int64_t)now - 1, (int64_t)now, law->curvature);
        for (size_t i = 0; i < m; ++i)
            law->curvature[i] /= dt * dt;
    } else if (behind == 2 && now > 1) { /* a T + b T^2 at both */
        const double first = r->time[now - 2] - r->time[now], last = -dt;
        rf_defect(r, (int64_t)now - 2, (int64_t)now, law->slope);
        rf_defect(r, (int64_t)now - 1, (int64_t)now, law->curvature);
        for (size_t i = 0; i < m; ++i) {
            const double far = law->slope[i] / first, near = law->curvature[i] / last;
            law->curvature[i] = (near - far) / (last - first);
            law->slope[i] = near - law->curvature[i] * last;
        }
    }
    for (size_t i = 0; i < m; ++i)
        law->slope[i] += rate * by_speed[i];
}
