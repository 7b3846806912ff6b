#include "ball_tables.h"

#include <math.h>
#include <string.h>

#define MOST_BALLS 1000.0

static int is_row(const double *row)
{
    int good = fabs(row[1]) == 1.0 && row[5] >= 1.0 && row[5] <= MOST_BALLS && row[5] == floor(row[5]);
    for (unsigned k = 7; k < RF_BALL_COLUMNS; ++k)
        good = good && row[k] > 0.0;
    return good && row[11] < 1.0;
}

static int is_extent(const rf_table *table, uint32_t most, uint32_t columns, rf_message *why)
{
    if (table->extent[0] >= 1 && table->extent[0] <= most && table->extent[1] == columns)
        return RF_OK;
    return rf_say(why, RF_INVALID, "table %s must be 1 to %u x %u, got %u x %u", table->name, (unsigned)most,
                  (unsigned)columns, (unsigned)table->extent[0], (unsigned)table->extent[1]);
}

int rf_take_balls(const rf_tables *tables, uint32_t numbers, rf_ball_tables *mine, rf_balls *balls, const double **law,
                  rf_message *why)
{
    const rf_table *rows = rf_find_table(tables, "rows", 2, why);
    const rf_table *waves = rows ? rf_find_table(tables, "waves", 2, why) : NULL;
    const rf_table *given = waves ? rf_find_table(tables, "law", 1, why) : NULL;
    if (!given || is_extent(rows, RF_MOST_ROWS, RF_BALL_COLUMNS, why) ||
        is_extent(waves, RF_MOST_WAVES, RF_WAVE_COLUMNS, why))
        return RF_INVALID;
    if (given->extent[0] != numbers)
        return rf_say(why, RF_INVALID, "table law must have %u numbers, got %u", (unsigned)numbers,
                      (unsigned)given->extent[0]);
    const uint32_t count = rows->extent[0], wavy = waves->extent[0];
    for (uint32_t k = 0; k < count; ++k)
        if (!is_row(rows->numbers + k * RF_BALL_COLUMNS))
            return rf_say(why, RF_INVALID, "row %u must be that of a ball bearing", (unsigned)k);
    const double inertia = given->numbers[0];
    if (!(inertia >= RF_BALLS_STATIC && inertia <= RF_BALLS_TRACTION && inertia == floor(inertia)))
        return rf_say(why, RF_INVALID, "inertia must be 0, 1, 2 or 3, got %.9g", inertia);
    memcpy(mine->rows, rows->numbers, count * sizeof *mine->rows);
    memcpy(mine->waves, waves->numbers, wavy * sizeof *mine->waves);
    const rf_balls found = {mine->rows, count, 0.0, {(int32_t)inertia, 0.0, 0.0}, 0.0, 0.0, mine->waves, wavy};
    *balls = found;
    *law = given->numbers;
    return RF_OK;
}

size_t rf_ball_law_parameters(const rf_balls *balls)
{
    return balls->law.inertia == RF_BALLS_TRACTION ? 2 : 0;
}

int rf_set_ball_law(rf_balls *balls, const double *p, rf_message *why)
{
    static const char *const names[] = {"traction_coefficient", "slide_to_roll_ratio"};
    static const double least[] = {1e-3, 1e-4}, most[] = {0.5, 1.0};
    for (size_t k = 0; k < rf_ball_law_parameters(balls); ++k)
        if (!(p[k] >= least[k] && p[k] <= most[k]))
            return rf_say(why, RF_INVALID, "%s must be %g to %g, got %.9g", names[k], least[k], most[k], p[k]);
    if (balls->law.inertia == RF_BALLS_TRACTION) {
        balls->law.traction = p[0];
        balls->law.slide = p[1];
    }
    return RF_OK;
}

int rf_check_balls(const double *p, int count, int damping, rf_message *why)
{
    for (int k = 0; k < count; ++k)
        if (!isfinite(p[k]))
            return rf_say(why, RF_INVALID, "parameter %d must be finite, got %.9g", k + 1, p[k]);
    if (p[damping] < 0.0)
        return rf_say(why, RF_INVALID, "damping must not be negative, got %.9g", p[damping]);
    return RF_OK;
}

const char *rf_ball_text(int status)
{
    static const char *const said[] = {
        "", "a ball must be pressed to 4200 MPa at most, and its gyroscopic moment must be held without sliding", "", "",
        "the force is not finite", "", "the balls must find a balance, and the search found none"};
    return status >= 0 && (size_t)status < sizeof said / sizeof *said ? said[status] : "";
}
