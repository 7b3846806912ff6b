#include "groove_model.h"

#include <math.h>

#include "journal_model.h"

#define ROUNDOFF 1e-12 /* relative, by which length/diameter may differ from that of the map */

int rf_take_groove_map(const rf_tables *tables, rf_groove_map *groove_map, rf_message *why)
{
    const rf_table *c = rf_find_table(tables, "coefficients", 3, why);
    const rf_table *center = c ? rf_find_table(tables, "center", 1, why) : NULL;
    const rf_table *map = center ? rf_find_table(tables, "map", 1, why) : NULL;
    if (!map)
        return RF_INVALID;
    const uint32_t x = c->extent[0], e = c->extent[1], s = c->extent[2], w = center->extent[0];
    if (x < 6 || e < 6 || s < 6 || w < 6 || x > 10000 || e > 10000 || s > 10000 || w > 10000
        || map->extent[0] != 4)
        return rf_say(why, RF_INVALID, "the tables of a journal must fit each other, got %u x %u x %u and %u",
                      (unsigned)x, (unsigned)e, (unsigned)s, (unsigned)w);
    const double *n = map->numbers;
    if (!(n[0] > 0.0 && n[1] > 0.0 && n[2] > 0.0 && n[2] <= 1.0))
        return rf_say(why, RF_INVALID,
                      "length/diameter and reach must be positive and squeeze in (0, 1], got %.9g, %.9g, %.9g",
                      n[0], n[1], n[2]);
    *groove_map = (rf_groove_map){(int32_t)x - 5, (int32_t)e - 5, (int32_t)s - 5, (int32_t)w - 5,
                                  n[1], n[2], n[3], center->numbers, c->numbers, n[0]};
    return RF_OK;
}

int rf_judge_slenderness(const rf_groove_map *map, const double *p, rf_message *why)
{
    const double slenderness = rf_slenderness(p);
    if (!(fabs(slenderness - map->slenderness) <= ROUNDOFF * map->slenderness))
        return rf_say(why, RF_INVALID, "length/diameter must be that of the map of the film, %.9g, got %.9g",
                      map->slenderness, slenderness);
    return RF_OK;
}
