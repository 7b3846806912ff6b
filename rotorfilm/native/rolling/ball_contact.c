#include "ball_contact.h"

#include <math.h>

rf_ball_contact rf_ball_press(double axial, double radial, double touch, double stiffness)
{
    rf_ball_contact c;
    c.length = hypot(axial, radial);
    c.e[0] = c.length > 0.0 ? axial / c.length : 0.0;
    c.e[1] = c.length > 0.0 ? radial / c.length : 1.0;
    c.t[0] = c.e[1];
    c.t[1] = -c.e[0];
    const double depth = c.length - touch, root = depth > 0.0 ? sqrt(depth) : 0.0;
    c.load = stiffness * root * root * root;
    c.slope = 1.5 * stiffness * root;
    const double across = c.length > 0.0 ? c.load / c.length : 0.0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            c.by[2 * i + j] = c.slope * c.e[i] * c.e[j] + across * c.t[i] * c.t[j];
    return c;
}

/* Where both contacts of a ball between open rings carry the centrifugal force, if it can be wedged so. */
static int wedge(const rf_ball_row *row, const double *a, double centrifugal, double *x)
{
    const double inner = row->inner + pow(centrifugal / row->inner_stiffness, 2.0 / 3.0);
    const double outer = row->outer + pow(centrifugal / row->outer_stiffness, 2.0 / 3.0);
    const double length = hypot(a[0], a[1]), along = 0.5 * (length + (outer * outer - inner * inner) / length);
    const double across = sqrt(outer * outer - along * along), up = copysign(across / length, a[0]);
    x[0] = along * a[0] / length - up * a[1];
    x[1] = along * a[1] / length + up * a[0];
    return isfinite(x[0] + x[1]);
}

void rf_ball_guess(const rf_ball_row *row, const double *a, double centrifugal, double *x)
{
    const double per = pow(row->inner_stiffness, -2.0 / 3.0) + pow(row->outer_stiffness, -2.0 / 3.0);
    const rf_ball_contact through = rf_ball_press(a[0], a[1], row->inner + row->outer, pow(per, -1.5));
    if (!(through.load > 0.0) && wedge(row, a, centrifugal, x))
        return;
    const double fx = through.load * through.e[0], fy = through.load * through.e[1] + centrifugal;
    const double size = hypot(fx, fy), length = row->outer + pow(size / row->outer_stiffness, 2.0 / 3.0);
    x[0] = size > 0.0 ? length * fx / size : length * through.e[0];
    x[1] = size > 0.0 ? length * fy / size : length * through.e[1];
}
