/* The film on the grids of a ring, solved on the coarsest first. */
#ifndef ROTORFILM_LEVELS_H
#define ROTORFILM_LEVELS_H

#include "cells.h"

/* What the grids of a ring are solved with and leave behind. */
typedef struct rf_levels {
    const rf_ring *ring;
    rf_cells cells[RF_LEVELS];
    rf_stencil film;  /* of the grid that was solved last, and its level */
    int level;
    int keeps; /* whether drives at one place of the journal share what is factorized */
    rf_search search[RF_LEVELS];
    double *source, *pressure, *answer, *flow; /* N x M of that grid; the last two are scratch */
    uint8_t *full, *held; /* N x M: nodes that are full, and those that are held ... */
    uint8_t *known;       /* ... and those that are full on the next coarser grid */
    void *memory;
} rf_levels;

/* Memory for the grids of a ring; RF_MEMORY where there is none. */
int rf_open_levels(rf_levels *levels, const rf_ring *ring);
void rf_close_levels(rf_levels *levels);

/* Put the journal at q = (e, tau), turning at a rate, on all grids. */
void rf_place_journal(rf_levels *levels, const double *q, double rate);

/* Set the pressure on one grid for drive[5]; RF_STUCK. Where the film is searched for, the next coarser grid is to be
   solved before. */
int rf_solve_level(rf_levels *levels, int level, const double *drive);

/* The same after solving on all coarser grids, where the film is searched for. */
int rf_solve_down_to(rf_levels *levels, int level, const double *drive);

/* Go on on the finest grid without nodes that are held since. */
int rf_solve_again(rf_levels *levels);

/* Force and moment f[4] of the grid that was solved last; a clipped film then has no pressure below zero. */
void rf_take_force(rf_levels *levels, double *f);

/* d f/d(e, tau, drive), by[4][9], of the same at a rate, full nodes and lines held; before its force. */
void rf_take_derivatives(rf_levels *levels, double rate, double *by);

/* Force and derivatives of the finest grid or, where it is extrapolated, of two, of a journal that is placed. */
int rf_take_film(rf_levels *levels, const double *drive, double *f, double *by);

#endif
