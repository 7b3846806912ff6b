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

/* What the Reynolds number adds, where the tables have it. */
static int take_growth(rf_map *map, int32_t kind, const char *of, const rf_tables *tables, rf_message *why)
{
    rf_message none;
    const rf_table *c = find(of, "growth", 4, tables, &none);
    if (!c)
        return RF_OK;
    const rf_table *numbers = find(of, "growth_map", 1, tables, why);
    const rf_table *center = numbers && kind == RF_GROOVED ? find(of, "growth_center", 2, tables, why) : numbers;
    if (!center)
        return RF_INVALID;
    int fits = numbers->extent[0] == 4;
    for (int k = 0; k < 4; ++k)
        fits = fits && c->extent[k] >= LEAST && c->extent[k] <= MOST;
    for (int k = 0; fits && k < 4; ++k)
        fits = numbers->numbers[k] > 0.0 && numbers->numbers[k] < HUGE_VAL;
    if (kind == RF_GROOVED)
        fits = fits && center->extent[0] == c->extent[2] && (int32_t)center->extent[1] == map->cells_w + 5;
    if (!fits)
        return rf_say(why, RF_INVALID, "%sgrowth must have coefficients that fit each other and four positive numbers", of);
    rf_map_growth *to = &map->growth;
    to->x = map->x;
    to->y = map->y;
    to->s = map->s;
    to->x.cells = (int32_t)c->extent[0] - 3;
    to->y.cells = (int32_t)c->extent[1] - 3;
    to->r.cells = (int32_t)c->extent[2] - 3;
    to->s.cells = (int32_t)c->extent[3] - 5;
    if (kind == RF_PAD) {
        to->s.last = map->s.last * (map->s.cells + 1) / map->s.cells * to->s.cells / (to->s.cells + 1);
        to->s.first = -to->s.last;
    }
    to->coefficients = c->numbers;
    to->center = center->numbers;
    to->scale = numbers->numbers[0];
    to->r.last = numbers->numbers[1];
    to->per_rate = numbers->numbers[2];
    to->density = numbers->numbers[3];
    return RF_OK;
}

void rf_scale_growth(rf_map *map, const double *p)
{
    map->growth.per_rate = 2.0 * map->growth.density * (p[0] * p[2] / p[3]);
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
                          0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, {{0, 0.0, 0.0}, {0, 0.0, 0.0}, {0, 0.0, 0.0},
                          {0, 0.0, 0.0}, NULL, NULL, 0.0, 0.0, 0.0}};
    *map = found;
    if (!set_coordinates(map, kind, given, numbers->numbers))
        return rf_say(why, RF_INVALID, "%smap must be numbers of a film, got %.9g and others", of, numbers->numbers[0]);
    return kind == RF_GROOVED || kind == RF_PAD ? take_growth(map, kind, of, tables, why) : RF_OK;
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
