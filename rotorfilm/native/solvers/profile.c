#include "profile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of the profile not after t. */
static size_t passed(const rf_profile *self, double t)
{
    size_t low = 0, high = self->points;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (self->times[middle] <= t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The angle counts from the first point. */
static rf_spin spin_since_start(const rf_profile *self, double t)
{
    const size_t k = passed(self, t), from = k ? k - 1 : 0;
    const double elapsed = t - self->times[from];
    rf_spin spin = {self->speeds[from], 0.0, 0.0};
    if (k != 0 && k != self->points)
        spin.acceleration =
            (self->speeds[k] - self->speeds[k - 1]) / (self->times[k] - self->times[k - 1]);
    spin.angle = self->angles[from] + elapsed * (spin.speed + 0.5 * spin.acceleration * elapsed);
    spin.speed += spin.acceleration * elapsed;
    return spin;
}

rf_spin rf_spin_at(const rf_profile *self, double t)
{
    rf_spin spin = spin_since_start(self, t);
    spin.angle -= spin_since_start(self, 0.0).angle;
    return spin;
}

void rf_shake(const rf_spin *spin, double *shake)
{
    const double c = cos(spin->angle), s = sin(spin->angle), square = spin->speed * spin->speed;
    shake[0] = square * c + spin->acceleration * s;
    shake[1] = square * s - spin->acceleration * c;
}

double rf_next_point(const rf_profile *self, double t)
{
    const size_t k = passed(self, t);
    return self->points > 1 && k < self->points ? self->times[k] : HUGE_VAL;
}

static int check(const rf_table *times, const rf_table *speeds, rf_message *why)
{
    const size_t n = times->extent[0];
    if (n == 0 || speeds->extent[0] != n)
        return rf_say(why, RF_INVALID, "speeds must be as many as times, one at least, got %u and %u",
                      (unsigned)speeds->extent[0], (unsigned)n);
    for (size_t k = 1; k < n; ++k)
        if (!(times->numbers[k] > times->numbers[k - 1]))
            return rf_say(why, RF_INVALID, "times must increase strictly, got %.9g after %.9g",
                          times->numbers[k], times->numbers[k - 1]);
    return RF_OK;
}

int rf_take_profile(rf_profile *self, const rf_tables *tables, rf_message *why)
{
    const rf_table *times = rf_find_table(tables, "times", 1, why);
    const rf_table *speeds = times ? rf_find_table(tables, "speeds", 1, why) : NULL;
    if (!speeds || check(times, speeds, why) != RF_OK)
        return RF_INVALID;
    const size_t n = times->extent[0];
    self->times = malloc(3 * n * sizeof(double));
    if (!self->times)
        return rf_say(why, RF_MEMORY, "no memory for a speed profile of %zu points", n);
    self->points = n;
    self->speeds = self->times + n;
    self->angles = self->speeds + n;
    memcpy(self->times, times->numbers, n * sizeof(double));
    memcpy(self->speeds, speeds->numbers, n * sizeof(double));
    self->angles[0] = 0.0;
    for (size_t k = 1; k < n; ++k)
        self->angles[k] =
            self->angles[k - 1]
            + 0.5 * (self->speeds[k] + self->speeds[k - 1]) * (self->times[k] - self->times[k - 1]);
    return RF_OK;
}

void rf_free_profile(rf_profile *self)
{
    free(self->times);
}
