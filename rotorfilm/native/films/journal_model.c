#include "journal_model.h"

#include <math.h>

#define ROUNDOFF 1e-12 /* relative, by which length/diameter may differ from that of a map */

enum { RADIUS, LENGTH, CLEARANCE, VISCOSITY, PARAMETERS };

const rf_sizes RF_JOURNAL_SIZES = {PARAMETERS, 5, 2, 0, 0};

double rf_slenderness(const double *p)
{
    return p[LENGTH] / (2.0 * p[RADIUS]);
}

int rf_judge_slenderness(double own, const char *map, const double *p, rf_message *why)
{
    const double slenderness = rf_slenderness(p);
    if (!(fabs(slenderness - own) <= ROUNDOFF * own))
        return rf_say(why, RF_INVALID, "length/diameter must be that of the %s, %.9g, got %.9g", map, own, slenderness);
    return RF_OK;
}

int rf_scale_journal(rf_journal *journal, const double *p, rf_message *why)
{
    static const char *const NAMES[] = {"radius", "length", "clearance", "viscosity"};
    for (int i = 0; i < PARAMETERS; ++i)
        if (!(p[i] > 0.0 && p[i] < HUGE_VAL))
            return rf_say(why, RF_INVALID, "%s must be finite and positive, got %.9g", NAMES[i], p[i]);
    const double r = p[RADIUS], c = p[CLEARANCE], scale = p[VISCOSITY] * p[LENGTH] * (r * r * r) / (c * c);
    if (c >= r)
        return rf_say(why, RF_INVALID, "clearance must be below the radius %.9g, got %.9g", r, c);
    if (!(scale > 0.0 && scale < HUGE_VAL))
        return rf_say(why, RF_INVALID, "viscosity length radius^3 / clearance^2 must be finite, got %.9g",
                      scale);
    journal->clearance = c;
    journal->force_scale = scale;
    return RF_OK;
}

int rf_explain_journal(const rf_journal *journal, int status, const double *u, rf_message *why)
{
    const double c = journal->clearance, e = sqrt(u[0] * u[0] + u[1] * u[1]);
    switch (status) {
    case RF_OK: return RF_OK;
    case RF_OUTSIDE:
        return journal->error > 0.0
                   ? rf_say(why, status,
                            "eccentricity ratio %.6g is beyond the map of the film; its force is continued as that "
                            "of a film at the wall, within %g %%%s",
                            e / c, journal->error, journal->openings ? " where no opening is near" : "")
                   : rf_say(why, status,
                            "eccentricity ratio %.6g at a speed of %.6g rad/s is beyond the map of the film; its force "
                            "is extrapolated there, with an error that is not known",
                            e / c, u[4]);
    case RF_AT_WALL:
        return rf_say(why, status,
                      "the journal must stay inside the clearance %.9g m, got an eccentricity of %.9g m "
                      "(x = %.9g, y = %.9g)",
                      c, e, u[0], u[1]);
    case RF_STUCK:
        return rf_say(why, status, "the search for the ruptured zone of the film must end, and did not at x = %.9g, "
                      "y = %.9g m, vx = %.9g, vy = %.9g m/s, speed = %.9g rad/s", u[0], u[1], u[2], u[3], u[4]);
    case RF_MEMORY: return rf_say(why, status, "no memory for the grids of a film");
    default:
        return rf_say(
            why, status, "%s: x = %.9g, y = %.9g m, vx = %.9g, vy = %.9g m/s, speed = %.9g rad/s",
            status == RF_UNDEFINED ? "the film has no derivative where its source velocity/clearance - "
                                     "(speed/2) z x eccentricity vanishes"
                                   : "the force is not finite",
            u[0], u[1], u[2], u[3], u[4]);
    }
}

int rf_journal_output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    return rf_explain_journal(kernel, rf_journal_at(kernel, at->u, y, NULL), at->u, why);
}

int rf_journal_derivatives(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    double y[2];
    return rf_explain_journal(kernel, rf_journal_at(kernel, at->u, y, answer->D), at->u, why);
}
