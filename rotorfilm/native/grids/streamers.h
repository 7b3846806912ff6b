/* The oil of the two-dimensional film, film and streamers, followed around in the direction in which it runs. */
#ifndef ROTORFILM_STREAMERS_H
#define ROTORFILM_STREAMERS_H

#include "levels.h"

/* The gap at an angle, the integrals of 1/H and 1/H^2 from the line of maximum film, and the factor of 1/H by the mobility. */
typedef struct rf_section {
    double thickness, film, square, sheared;
} rf_section;

/* One state, seen in the direction in which the oil runs. */
typedef struct rf_stream {
    const rf_levels *film;
    const rf_grid *grid;
    rf_section *line;      /* N: at the lines */
    rf_section *face;      /* N: behind each line, in the order of the grid */
    double *brought;    /* M: thickness of what runs in each row */
    double *width;      /* M: of the cells, the last one with the half cell at the end */
    double rate, turn;  /* of the oil, without its sign; of all integrals of 1/H */
    double square_turn; /* the same of 1/H^2 */
    int backward;
} rf_stream;

void rf_place_stream(rf_stream *oil, const double *e);
/* The line that the oil meets after or, with 0, before this one. */
size_t rf_next_line(const rf_stream *oil, size_t i, int after);
/* The face between a line and the one that the oil meets after or before it. */
size_t rf_next_face(const rf_stream *oil, size_t i, int after);
/* How many nodes of a line are held, from the middle of the bearing. */
size_t rf_held(const rf_stream *oil, size_t i);
int rf_is_film(const rf_stream *oil, size_t at);
/* The pressure flow through the face after or before a node, towards it. */
double rf_drawn(const rf_stream *oil, size_t i, size_t j, int after);
/* Shares of an empty cell that the film reaches into: from upstream, from downstream and from the side. Where its
   source takes away what flows in, the film has its edge. */
void rf_reach(const rf_stream *oil, size_t i, size_t j, double share[3]);
/* Follow the oil over the cells of a line, and add their shear. */
void rf_cross_cells(rf_stream *oil, size_t i, double *film, double *streamers);
int rf_open_stream(rf_stream *oil, const rf_levels *film);

#endif
