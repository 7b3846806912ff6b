/* The film of one pad with a recess, on one of its grids. */
#ifndef ROTORFILM_RECESS_CELLS_H
#define ROTORFILM_RECESS_CELLS_H

#include "recess.h"
#include "stencil.h"

#define RF_PLATE_COLUMNS 5 /* of the derivatives: by e, by w, and by the rate that drives oil over a step */

/* One pad at one state. Lines lie across the film, the first on both edges of the pad; nodes from the middle. */
typedef struct rf_plate {
    const rf_recess_pad *pad;
    double slenderness;               /* length / diameter */
    double own;                       /* clearance c_p [m] of the pad */
    double e[2], w[2], rate, depth;   /* from its center of curvature; half the speed; the depth over `own` */
    rf_stencil stencil;
    double *around, *along, *source, *pressure, *answers; /* lines x nodes; of the answers two */
    double *around_slope, *along_slope;                   /* of the conductances by the thickness */
    double *theta, *face;                                 /* lines: angles, of the line and half way to the next */
    double *normal[2];                                    /* lines: integral of the normal over the cell */
    double *deep, *shallow;           /* nodes: width of the cell within the recess and beside it */
    double *spacing;                  /* nodes: to the next */
    uint8_t *held, *full, *recessed;  /* the last: lines with the recess behind them */
    uint8_t *known;                   /* nodes that are full on the grid with half the cells */
    void *memory;
} rf_plate;

/* Put the journal over a pad. */
void rf_place_plate(rf_plate *plate, const rf_recess *bearing, const rf_recess_pad *pad, const double *state);

/* Whether nothing drives its film. */
int rf_plate_rests(const rf_plate *plate);

/* The least 1 - e.n + D of its film. */
double rf_plate_least(const rf_plate *plate);

/* Memory for all grids of a pad that is placed; RF_MEMORY where there is none. */
int rf_open_plate(rf_plate *plate);
void rf_close_plate(rf_plate *plate);

/* Find the film on a grid, first 1, with half the cells, then 0; with what its derivatives need where they are
   asked for. RF_STUCK, RF_MEMORY. */
int rf_solve_plate(rf_plate *plate, int level, int differentiated);

/* Force f[2] of that film and, unless NULL, derivatives by[2][RF_PLATE_COLUMNS], in the units of films/film.h. */
void rf_take_plate(const rf_plate *plate, double *f, double *by);

/* What pressure does on the steps per rate: 12 P.b(0, 1), in the same units. */
double rf_plate_on_steps(const rf_plate *plate);

#endif
