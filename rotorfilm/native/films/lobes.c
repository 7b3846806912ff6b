#include "lobes.h"

#include "map_frame.h"

/* Turn a vector from the frame of a pad to that of the bearing. */
static void turn_out(const rf_lobe *lobe, double along, double across, double *x, double *y)
{
    *x = lobe->cos * along - lobe->sin * across;
    *y = lobe->sin * along + lobe->cos * across;
}

/* Turn a vector from the frame of the bearing to that of a pad. */
static void turn_in(const rf_lobe *lobe, double x, double y, double *along, double *across)
{
    *along = lobe->cos * x + lobe->sin * y;
    *across = lobe->cos * y - lobe->sin * x;
}

/* Add f[2] and, unless NULL, by[2][5] = d f/d(state) in the frame of a pad. */
static void add(const rf_lobe *lobe, const double *own, const double *by, double *f, double *jacobian)
{
    double x, y;
    turn_out(lobe, own[0], own[1], &x, &y);
    f[0] += x;
    f[1] += y;
    for (int k = 0; jacobian && k < 5; ++k) {
        turn_out(lobe, by[k], by[5 + k], &x, &y);
        jacobian[k] += x;
        jacobian[5 + k] += y;
    }
}

int rf_lobes_at(const void *of, const double *state, double *f, double *jacobian)
{
    const rf_lobes *lobes = of;
    int worst = RF_OK;
    f[0] = f[1] = 0.0;
    for (int k = 0; jacobian && k < 10; ++k)
        jacobian[k] = 0.0;
    for (size_t i = 0; i < lobes->count; ++i) {
        const rf_lobe *lobe = &lobes->list[i];
        double own[5] = {0.0, 0.0, 0.0, 0.0, state[4]}, force[2], by[10];
        turn_in(lobe, state[0] - lobe->x, state[1] - lobe->y, own, own + 1);
        turn_in(lobe, state[2], state[3], own + 2, own + 3);
        const int status = rf_journal_at(&lobe->film, own, force, jacobian ? by : NULL);
        worst = status > worst ? status : worst;
        /* Derivatives by the position, row by row: turned on both sides. */
        for (int row = 0; jacobian && row < 10; row += 5)
            for (int k = 0; k < 4; k += 2)
                turn_out(lobe, by[row + k], by[row + k + 1], by + row + k, by + row + k + 1);
        add(lobe, force, by, f, jacobian);
    }
    if (worst == RF_UNDEFINED)
        return worst;
    if (worst > RF_OUTSIDE)
        return rf_fail(worst, f, jacobian, 10);
    return rf_is_broken(f, 2) || (jacobian && rf_is_broken(jacobian, 10)) ? rf_fail(RF_NOT_FINITE, f, jacobian, 10)
                                                                          : worst;
}
