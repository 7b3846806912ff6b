#include "map_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "quintic.h"

#define ROUNDOFF 1e-12 /* relative, by which length/diameter may leave the table */
#define LEAST 6u
#define MOST 10000u
#define HALF_PI 1.57079632679489661923

static const rf_table *find(const char *of, const char *name, uint32_t axes, const rf_tables *tables, rf_message *why)
{
    char whole[32];
    snprintf(whole, sizeof whole, "%s%s", of, name);
    return rf_find_table(tables, whole, axes, why);
}

/* Coordinates from so many numbers of a map; 0 where they are none. */
static int set_coordinates(rf_map *map, int32_t kind, uint32_t given, const double *n)
{
    const double b = 0.5 * n[0];
    if (kind == RF_GROOVED) {
        map->slenderness = n[0];
        map->x.last = n[1];
        map->squeeze = n[2];
        map->axis = n[3];
        map->eased = given == 5 && n[4] == 0.0;
        return n[0] > 0.0 && n[1] > 0.0 && n[2] > 0.0 && n[2] <= 1.0;
    }
    if (kind == RF_SPED) {
        map->x.last = n[0];
        map->scale = n[1];
        map->y.last = n[2];
        map->per_rate = n[3];
        return n[0] > 0.0 && n[1] > 0.0 && n[2] > 0.0 && n[3] > 0.0 && map->cells_w == map->y.cells;
    }
    if (kind == RF_PAD) {
        map->x.first = n[1];
        map->x.last = n[2];
        map->y.last = n[3];
        map->y.first = -n[3];
        map->s.last = (HALF_PI + b) * map->s.cells / (map->s.cells + 1);
        map->s.first = -map->s.last;
        map->sine = sin(b);
        map->cosine = cos(b);
        return n[0] > 0.0 && n[0] < 3.2 && n[1] < n[2] && n[3] > 0.0;
    }
    map->x.last = n[0];
    map->slenderness = given == 3 ? n[1] : 0.0;
    map->share = given == 3 ? n[2] : 1.0;
    return n[0] > 0.0;
}

int rf_take_map(rf_map *map, int32_t kind, const char *of, const rf_tables *tables, rf_message *why)
{
    const int plain = kind <= RF_LAYERED;
    const rf_table *c = find(of, "coefficients", 3, tables, why);
    const rf_table *center = c && kind != RF_PAD ? find(of, "center", 1, tables, why) : c;
    const rf_table *numbers = center ? find(of, "map", 1, tables, why) : NULL;
    if (!numbers)
        return RF_INVALID;
    const uint32_t *n = c->extent, layers = plain ? n[0] : LEAST, count = kind == RF_PAD ? LEAST : center->extent[0];
    const uint32_t given = numbers->extent[0];
    int fits = plain ? count == layers && (layers == 1 || (kind == RF_LAYERED && layers >= LEAST)) : count >= LEAST;
    fits = fits && layers <= MOST && count <= MOST && (plain ? given == 1 || given == 3 : given == 4 || (given == 5 && kind == RF_GROOVED));
    for (int k = plain; k < 3; ++k)
        fits = fits && n[k] >= LEAST && n[k] <= MOST;
    if (!fits)
        return rf_say(why, RF_INVALID, "%smap must have coefficients of 6 x 6 at least that fit each other, got %u x %u x %u, %u and %u",
                      of, (unsigned)n[0], (unsigned)n[1], (unsigned)n[2], (unsigned)count, (unsigned)given);
    const rf_map found = {{(int32_t)n[plain] - 5, 0.0, 0.0}, {plain ? 0 : (int32_t)n[1] - 5, 0.0, RF_TURN},
                          {(int32_t)n[2] - 5, 0.0, RF_TURN}, c->numbers, center->numbers, (int32_t)count - 5,
                          0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0};
    *map = found;
    if (!set_coordinates(map, kind, given, numbers->numbers))
        return rf_say(why, RF_INVALID, "%smap must be numbers of a film, got %.9g and others", of, numbers->numbers[0]);
    return RF_OK;
}

int rf_map_slice(const double *numbers, size_t layers, size_t size, const double *range, double slenderness, double *own)
{
    const double low = range[0], high = range[1];
    if (!(slenderness >= low * (1.0 - ROUNDOFF) && slenderness <= high * (1.0 + ROUNDOFF)))
        return RF_INVALID;
    if (layers == 1) {
        memcpy(own, numbers, size * sizeof *own);
        return RF_OK;
    }
    double rest, weights[RF_ORDER];
    const int32_t cells = (int32_t)layers - 5;
    const size_t first = (size_t)rf_cell(log(slenderness / low) / log(high / low) * cells, cells, &rest);
    rf_values(rest, weights);
    memset(own, 0, size * sizeof *own);
    for (size_t k = 0; k < RF_ORDER; ++k)
        for (size_t i = 0; i < size; ++i)
            own[i] += weights[k] * numbers[(first + k) * size + i];
    return RF_OK;
}
