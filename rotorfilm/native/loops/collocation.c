#include "collocation.h"

#include <math.h>
#include <stdlib.h>

#include "../status.h"

#define SMALL 4.0 /* |z| below which the moments are summed as a series, from the highest down */
#define MOST_TERMS 60
#define MOST_COEFFICIENTS 16

static rf_complex product(rf_complex a, rf_complex b)
{
    const rf_complex of = {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    return of;
}

static rf_complex quotient(rf_complex a, rf_complex b)
{
    const double size = b.re * b.re + b.im * b.im;
    const rf_complex of = {(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
    return of;
}

static rf_complex exponential(rf_complex z)
{
    const double size = exp(z.re);
    const rf_complex of = {size * cos(z.im), size * sin(z.im)};
    return of;
}

rf_complex rf_turned(rf_complex value, double t, rf_complex z)
{
    const rf_complex argument = {value.re * t, value.im * t};
    return product(exponential(argument), z);
}

/* int_0^1 exp(z (1 - s)) s^k ds for k = 0 ... count - 1. */
static void set_moments(rf_complex z, int32_t count, rf_complex *out)
{
    if (z.re * z.re + z.im * z.im >= SMALL * SMALL) {
        const rf_complex grown = exponential(z), gained = {grown.re - 1.0, grown.im};
        out[0] = quotient(gained, z);
        for (int32_t k = 1; k < count; ++k) {
            const rf_complex above = {k * out[k - 1].re - 1.0, k * out[k - 1].im};
            out[k] = quotient(above, z);
        }
        return;
    }
    rf_complex term = {1.0 / count, 0.0}, total = term;
    for (int32_t j = 1; j < MOST_TERMS; ++j) {
        term = product(term, z);
        term.re /= count + j;
        term.im /= count + j;
        total.re += term.re;
        total.im += term.im;
        if (fabs(term.re) + fabs(term.im) < 1e-17 * (fabs(total.re) + fabs(total.im)))
            break;
    }
    out[count - 1] = total;
    for (int32_t k = count - 1; k > 0; --k) {
        const rf_complex below = product(z, out[k]);
        out[k - 1].re = (below.re + 1.0) / k;
        out[k - 1].im = below.im / k;
    }
}

void rf_set_weights(const rf_modes *rotor, double h, double c, const double *polynomials, int32_t s,
                    int32_t count, rf_complex *out)
{
    for (int32_t m = 0; m < rotor->modes; ++m) {
        const rf_complex z = {rotor->values[m].re * h * c, rotor->values[m].im * h * c};
        rf_complex integral[MOST_COEFFICIENTS];
        double power = h;
        set_moments(z, count, integral);
        for (int32_t k = 0; k < count; ++k) {
            power *= c;
            integral[k].re *= power;
            integral[k].im *= power;
        }
        for (int32_t j = 0; j < s; ++j) {
            rf_complex total = {0.0, 0.0};
            for (int32_t k = 0; k < count; ++k) {
                total.re += polynomials[j * count + k] * integral[k].re;
                total.im += polynomials[j * count + k] * integral[k].im;
            }
            out[j * rotor->modes + m] = total;
        }
    }
}

/* What the journals see of forces through these weights, rows x channels: the real part of sense w push. */
static void set_seen(const rf_modes *rotor, const rf_complex *w, double *out)
{
    for (int32_t q = 0; q < rotor->rows; ++q) {
        double *row = out + q * rotor->channels;
        for (int32_t c = 0; c < rotor->channels; ++c)
            row[c] = 0.0;
        for (int32_t m = 0; m < rotor->modes; ++m) {
            const rf_complex by = product(rotor->sense[q * rotor->modes + m], w[m]);
            const rf_complex *push = rotor->push + m * rotor->channels;
            for (int32_t c = 0; c < rotor->channels; ++c)
                row[c] += by.re * push[c].re - by.im * push[c].im;
        }
    }
}

static void set_move(const rf_modes *rotor, double t, double *move)
{
    const int32_t modes = rotor->modes;
    for (int32_t m = 0; m < modes; ++m)
        for (int32_t q = 0; q < rotor->rows; ++q) {
            const rf_complex seen = rf_turned(rotor->values[m], t, rotor->sense[q * modes + m]);
            move[q * 2 * modes + m] = seen.re;
            move[q * 2 * modes + modes + m] = -seen.im;
        }
}

static void set_advance(const rf_modes *rotor, int32_t s, double h, const rf_complex *w,
                        const rf_step_table *table)
{
    const int32_t modes = rotor->modes, channels = rotor->channels, wide = s * channels;
    const rf_complex one = {1.0, 0.0};
    for (int32_t m = 0; m < modes; ++m) {
        table->keep[m] = rf_turned(rotor->values[m], h, one);
        for (int32_t j = 0; j < s; ++j)
            for (int32_t c = 0; c < channels; ++c) {
                const rf_complex now = product(w[j * modes + m], rotor->push[m * channels + c]);
                table->forced[m * wide + j * channels + c] = now.re;
                table->forced[(modes + m) * wide + j * channels + c] = now.im;
            }
    }
}

int rf_set_step_table(const rf_modes *rotor, const rf_scheme *scheme, double h, const rf_step_table *table)
{
    const int32_t s = scheme->stages, modes = rotor->modes, block = rotor->rows * rotor->channels;
    if (s + 1 > MOST_COEFFICIENTS)
        return RF_INVALID;
    rf_complex *w = malloc((size_t)(s + 1) * (size_t)modes * sizeof *w);
    if (!w)
        return RF_MEMORY;
    for (int32_t i = 0; i < s; ++i) {
        rf_set_weights(rotor, h, scheme->nodes[i], scheme->lagrange, s, s, w);
        rf_set_weights(rotor, h, scheme->nodes[i], scheme->remainder, 1, s + 1, w + s * modes);
        set_move(rotor, h * scheme->nodes[i], table->move + i * rotor->rows * 2 * modes);
        for (int32_t j = 0; j < s; ++j)
            set_seen(rotor, w + j * modes, table->gain + (i * s + j) * block);
        set_seen(rotor, w + s * modes, table->defect + i * block);
    }
    /* The last node is the end of the step. */
    set_advance(rotor, s, h, w, table);
    free(w);
    return RF_OK;
}
