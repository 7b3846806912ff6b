/* The force on the journals of a rotor over a macro step, as cosim/schemes make it from the communication
   points behind; m is twice the number of stations. */
#ifndef ROTORFILM_LAW_H
#define ROTORFILM_LAW_H

#include <stddef.h>
#include <stdint.h>

#define RF_LAW_SIZE(m) (5 * (m) + 2 * (m) * (m)) /* numbers behind the time */

/* F(t, q, v) = force + slope T + curvature T^2 - stiffness (q - position) - damping (v - velocity) with
   T = t - start. The numbers are one block, in this order. */
typedef struct rf_law {
    size_t m;
    double start;
    double *force, *slope, *curvature, *stiffness, *damping, *position, *velocity;
} rf_law;

/* The communication points of a run, point by point. */
typedef struct rf_record {
    int64_t count, room;
    size_t m, columns; /* of outputs; those of the rotor come first */
    const int32_t *position, *velocity;
    int32_t speed; /* -1 where the rotor tells none */
    int32_t derived;
    double *time, *outputs, *force, *tangents; /* tangents: stiffness, damping, derivative by the speed */
    int64_t *work;
} rf_record;

void rf_place_law(rf_law *law, size_t m, double *numbers);
void rf_law_at(const rf_law *law, double t, const double *position, const double *velocity, double *force);

/* Forces extrapolated by a polynomial of this degree, or less at the start. */
void rf_extrapolated_law(const rf_record *r, int degree, rf_law *law);

/* A force held from the latest point on. */
void rf_held_law(const rf_record *r, const double *force, rf_law *law);

/* The law of the tangents at the latest point; with a parabola through what they leave of the force at so many
   points before, 0 to 2. */
void rf_tangential_law(const rf_record *r, int behind, rf_law *law);

/* What the tangents at a point leave of the force at one before, (m,). */
void rf_defect(const rf_record *r, int64_t before, int64_t now, double *left);

/* Positions, velocities and speed (2 m + 1 numbers) extrapolated to a time. */
void rf_motion_ahead(const rf_record *r, int degree, double t, double *motion);

double rf_speed_of(const rf_record *r, int64_t point);

#endif
