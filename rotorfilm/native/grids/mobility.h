/* How easily oil flows where the film is thick or thin: turbulent, thinning, or with porous walls.

   Four factors of the local thickness H, or of its Reynolds number where they change with the speed: of H^3 in the
   flow that pressure drives around and along the bearing, of H in the Couette flux and of 1/H in the shear. Their logarithms are quintic splines
   over ln(1 + X/scale) from X = 0 on, and go on linearly beyond the last node. */
#ifndef ROTORFILM_MOBILITY_H
#define ROTORFILM_MOBILITY_H

#include <stdint.h>

#include "../kernels/kernel.h"

typedef enum rf_factor { RF_AROUND, RF_ALONG, RF_OF_DRAG, RF_OF_SHEAR, RF_FACTORS } rf_factor;

typedef struct rf_mobility {
    const double *coefficients; /* RF_FACTORS x 5 more than cells */
    int32_t cells;              /* 0: all factors are 1 */
    int32_t drags;              /* whether that of the Couette flux is not 1 */
    int32_t local;              /* whether X is that of the local H; else that of H = 1 everywhere */
    double scale, last;         /* the last node in ln(1 + X/scale) */
    double fixed, per_rate;     /* X/H is |rate| per_rate, or where that is 0 it is fixed */
    double density;             /* [kg/m3], of which per_rate is made; 0 where X/H is fixed */
} rf_mobility;

/* X/H at a rate, half the speed. */
double rf_growth(const rf_mobility *mobility, double rate);

/* A factor at X, which is not 0 cells, and its derivative by X. */
double rf_ease(const rf_mobility *mobility, rf_factor factor, double X, double *slope);

/* What oil of a thickness lets through, and its derivatives by the thickness and by the logarithm of X/H. */
typedef struct rf_through {
    double flow, slope, grown;
} rf_through;

/* The thickness that the factors are those of. */
static inline double rf_eased_at(const rf_mobility *mobility, double H)
{
    return mobility->local ? H : 1.0;
}

/* What pressure drives around or along the bearing: H^3 times the factor at X = growth H. */
static inline rf_through rf_pressed(const rf_mobility *mobility, rf_factor way, double growth, double H)
{
    rf_through found = {H * H * H, 3.0 * H * H, 0.0};
    if (mobility->cells > 0) {
        double eased;
        const double at = rf_eased_at(mobility, H), factor = rf_ease(mobility, way, growth * at, &eased);
        eased *= growth * found.flow;
        found.slope = factor * found.slope + (mobility->local ? eased : 0.0);
        found.flow *= factor;
        found.grown = eased * at;
    }
    return found;
}

/* What the walls drag in the mean flow beyond H. */
static inline rf_through rf_dragged_beyond(const rf_mobility *mobility, double growth, double H)
{
    rf_through found = {0.0, 0.0, 0.0};
    if (mobility->drags) {
        double eased;
        const double at = rf_eased_at(mobility, H), factor = rf_ease(mobility, RF_OF_DRAG, growth * at, &eased);
        eased *= growth * H;
        found.flow = (factor - 1.0) * H;
        found.slope = factor - 1.0 + (mobility->local ? eased : 0.0);
        found.grown = eased * at;
    }
    return found;
}

/* Take a mobility from the table `mobility` (4 x n) and the numbers `mobility_scale` (scale, last node, fixed X/H,
   density, whether local), where they stay, or none where there are no such tables; RF_INVALID, with the message. */
int rf_take_mobility(rf_mobility *mobility, const rf_tables *tables, rf_message *why);

/* Set what X grows by from the dimensions of a bearing: the Reynolds number is density speed radius clearance/viscosity. */
void rf_scale_mobility(rf_mobility *mobility, double radius, double clearance, double viscosity);

#endif
