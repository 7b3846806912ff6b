#include "mobility.h"

#include <math.h>
#include <string.h>

#include "../films/map_spline.h"

#define LEAST 6u
#define MOST 100000u

double rf_growth(const rf_mobility *mobility, double rate)
{
    return mobility->per_rate > 0.0 ? fabs(rate) * mobility->per_rate : mobility->fixed;
}

double rf_ease(const rf_mobility *mobility, rf_factor factor, double X, double *slope)
{
    const rf_axis axis = {mobility->cells, 0.0, mobility->last};
    const double over = fmax(X, 0.0) / mobility->scale, place = log1p(over), within = fmin(place, mobility->last);
    const double *c = mobility->coefficients + (size_t)factor * rf_width(&axis);
    rf_weights by;
    rf_weigh_between(&axis, within, 1, &by);
    const double bend = by.per * rf_dot(c + by.cell, by.slope);
    const double value = exp(rf_dot(c + by.cell, by.value) + bend * (place - within));
    *slope = value * bend / (mobility->scale * (1.0 + over));
    return value;
}

int rf_take_mobility(rf_mobility *mobility, const rf_tables *tables, rf_message *why)
{
    const rf_mobility none = {NULL, 0, 0, 1, 1.0, 1.0, 1.0, 0.0, 0.0};
    const rf_table *factors = rf_seek_table(tables, "mobility");
    *mobility = none;
    if (!factors)
        return RF_OK;
    const double *numbers = rf_numbers(tables, "mobility_scale", 5, why);
    const uint32_t *n = factors->extent;
    if (!numbers)
        return RF_INVALID;
    if (factors->axes != 2 || n[0] != RF_FACTORS || n[1] < LEAST || n[1] > MOST || !(numbers[0] > 0.0 && numbers[1] > 0.0)
        || !(numbers[2] >= 0.0 && numbers[3] >= 0.0))
        return rf_say(why, RF_INVALID, "table mobility must be 4 x %u at least with positive scales, got scale %.9g",
                      LEAST, numbers[0]);
    mobility->coefficients = factors->numbers;
    mobility->cells = (int32_t)n[1] - 5;
    for (uint32_t k = 0; k < n[1]; ++k)
        mobility->drags |= factors->numbers[RF_OF_DRAG * n[1] + k] != 0.0;
    mobility->scale = numbers[0];
    mobility->last = numbers[1];
    mobility->fixed = numbers[2];
    mobility->density = numbers[3];
    mobility->local = numbers[4] != 0.0;
    return RF_OK;
}

void rf_scale_mobility(rf_mobility *mobility, double radius, double clearance, double viscosity)
{
    mobility->per_rate = 2.0 * mobility->density * radius * clearance / viscosity;
}
