#include "damper_map.h"

int rf_take_damper_map(rf_map *map, const rf_tables *tables, rf_message *why)
{
    const rf_table *c = rf_find_table(tables, "coefficients", 2, why);
    const rf_table *center = c ? rf_find_table(tables, "center", 1, why) : NULL;
    const rf_table *reach = center ? rf_find_table(tables, "reach", 1, why) : NULL;
    const rf_table *wall = reach ? rf_find_table(tables, "wall", 1, why) : NULL;
    if (!wall)
        return RF_INVALID;
    const uint32_t x = c->extent[0], t = c->extent[1];
    if (x < 6 || t < 6 || x > 10000 || t > 10000 || center->extent[0] != 1 || reach->extent[0] != 1
        || !(reach->numbers[0] > 0.0) || wall->extent[0] != 2)
        return rf_say(why, RF_INVALID, "the tables of a damper must fit each other, got %u x %u", (unsigned)x,
                      (unsigned)t);
    const rf_map found = {(int32_t)x - 5, (int32_t)t - 5, reach->numbers[0], center->numbers[0],
                          c->numbers, 0.0, 0.0};
    *map = found;
    rf_map_to_wall(map, wall->numbers[0], wall->numbers[1]);
    return RF_OK;
}
