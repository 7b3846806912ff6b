#include "pad_tables.h"

#include <stdio.h>

#define LEAST 6u
#define MOST 10000u

static const rf_table *find(const char *of, const char *name, uint32_t axes, const rf_tables *tables, rf_message *why)
{
    char whole[32];
    snprintf(whole, sizeof whole, "%s%s", of, name);
    return rf_find_table(tables, whole, axes, why);
}

int rf_take_pad_map(rf_pad_map *map, const char *of, const rf_tables *tables, rf_message *why)
{
    const rf_table *c = find(of, "coefficients", 3, tables, why);
    const rf_table *shape = c ? find(of, "shape", 1, tables, why) : NULL;
    if (!shape)
        return RF_INVALID;
    const uint32_t u = c->extent[0], y = c->extent[1], phi = c->extent[2];
    if (u < LEAST || y < LEAST || phi < LEAST || u > MOST || y > MOST || phi > MOST)
        return rf_say(why, RF_INVALID, "%scoefficients must be 6 x 6 x 6 at least, got %u x %u x %u", of, (unsigned)u,
                      (unsigned)y, (unsigned)phi);
    const double *n = shape->numbers;
    if (shape->extent[0] != 4 || !(n[0] > 0.0 && n[0] < 3.2 && n[1] < n[2] && n[3] > 0.0))
        return rf_say(why, RF_INVALID, "%sshape must be four numbers of a map of a pad, got %u and an extent of %.9g", of,
                      (unsigned)shape->extent[0], n[0]);
    *map = (rf_pad_map){(int32_t)u - 5, (int32_t)y - 5, (int32_t)phi - 5, n[1], n[2], n[3], 0.0, 0.0, 0.0,
                        c->numbers};
    rf_shape_pad(map, n[0]);
    return RF_OK;
}
