/* The speed of a shaft over time: linear between points, constant outside, with its exact angle. */
#ifndef ROTORFILM_PROFILE_H
#define ROTORFILM_PROFILE_H

#include "../kernels/kernel.h"

typedef struct rf_profile {
    size_t points;
    double *times, *speeds, *angles; /* the angle turned since the first point, at each point */
} rf_profile;

/* Take the tables `times` [s] and `speeds` [rad/s]; answers an rf_status. To be freed. */
int rf_take_profile(rf_profile *profile, const rf_tables *tables, rf_message *why);
void rf_free_profile(rf_profile *profile);

/* Angular speed, the acceleration just after t, and the angle turned since t = 0. */
typedef struct rf_spin {
    double speed, acceleration, angle;
} rf_spin;
rf_spin rf_spin_at(const rf_profile *profile, double t);

/* What an unbalance turns into: w^2 cos p + a sin p, w^2 sin p - a cos p. */
void rf_shake(const rf_spin *spin, double *shake);

/* The first point after t, HUGE_VAL if there is none or the speed is constant. */
double rf_next_point(const rf_profile *profile, double t);

#endif
