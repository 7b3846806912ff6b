#include "collocation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../status.h"

#define SMALL 0.5 /* |z| per moment below which they are summed as a series, from the highest down */
#define MOST_TERMS 60

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

/* int_0^1 exp(z (1 - s)) s^k ds for k = 0 ... count - 1, and exp(z). */
static rf_complex set_moments(rf_complex z, int32_t count, rf_complex *out)
{
    const double small = SMALL * count;
    if (z.re * z.re + z.im * z.im >= small * small) {
        const rf_complex grown = exponential(z), gained = {grown.re - 1.0, grown.im};
        out[0] = quotient(gained, z);
        for (int32_t k = 1; k < count; ++k) {
            const rf_complex above = {k * out[k - 1].re - 1.0, k * out[k - 1].im};
            out[k] = quotient(above, z);
        }
        return grown;
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
    const rf_complex rest = product(z, out[0]), grown = {1.0 + rest.re, rest.im};
    return grown;
}

void rf_set_integrals(const rf_modes *rotor, double h, double c, int32_t count, rf_complex *turn, rf_complex *out)
{
    for (int32_t m = 0; m < rotor->modes; ++m, out += count) {
        const rf_complex z = {rotor->values[m].re * h * c, rotor->values[m].im * h * c};
        double power = h;
        turn[m] = set_moments(z, count, out);
        for (int32_t k = 0; k < count; ++k) {
            power *= c;
            out[k].re *= power;
            out[k].im *= power;
        }
    }
}

/* W(c) of one polynomial from the integrals of powers. */
static void set_weights(int32_t modes, int32_t count, const double *polynomial, const rf_complex *integrals,
                        rf_complex *out)
{
    for (int32_t m = 0; m < modes; ++m, integrals += count) {
        rf_complex total = {0.0, 0.0};
        for (int32_t k = 0; k < count; ++k) {
            total.re += polynomial[k] * integrals[k].re;
            total.im += polynomial[k] * integrals[k].im;
        }
        out[m] = total;
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

static void set_move(const rf_modes *rotor, const rf_complex *turn, double *move)
{
    const int32_t modes = rotor->modes;
    for (int32_t q = 0; q < rotor->rows; ++q)
        for (int32_t m = 0; m < modes; ++m) {
            const rf_complex seen = product(turn[m], rotor->sense[q * modes + m]);
            move[q * 2 * modes + m] = seen.re;
            move[q * 2 * modes + modes + m] = -seen.im;
        }
}

static void set_advance(const rf_modes *rotor, int32_t s, const rf_complex *w, const rf_step_table *table)
{
    const int32_t modes = rotor->modes, channels = rotor->channels, wide = s * channels;
    for (int32_t m = 0; m < modes; ++m)
        for (int32_t j = 0; j < s; ++j)
            for (int32_t c = 0; c < channels; ++c) {
                const rf_complex now = product(w[j * modes + m], rotor->push[m * channels + c]);
                table->forced[m * wide + j * channels + c] = now.re;
                table->forced[(modes + m) * wide + j * channels + c] = now.im;
            }
}

int rf_set_step_table(const rf_modes *rotor, const rf_scheme *scheme, double h, const rf_step_table *table)
{
    const int32_t s = scheme->stages, count = s + 1, modes = rotor->modes;
    const size_t block = (size_t)rotor->rows * (size_t)rotor->channels;
    double polynomial[RF_MOST_NODES + 1] = {0.0};
    if (s > RF_MOST_NODES)
        return RF_INVALID;
    rf_complex *w = malloc((size_t)(2 * count) * (size_t)modes * sizeof *w);
    if (!w)
        return RF_MEMORY;
    rf_complex *integrals = w + count * modes;
    for (int32_t i = 0; i < s; ++i) {
        /* At the last node, the end of the step, this is what the modes keep. */
        rf_set_integrals(rotor, h, scheme->nodes[i], count, table->keep, integrals);
        for (int32_t j = 0; j < s; ++j) {
            memcpy(polynomial, scheme->lagrange + j * s, (size_t)s * sizeof *polynomial);
            set_weights(modes, count, polynomial, integrals, w + j * modes);
            set_seen(rotor, w + j * modes, table->gain + (size_t)(i * s + j) * block);
        }
        for (size_t k = 0; rotor->direct && k < block; ++k)
            table->gain[(size_t)(i * s + i) * block + k] += rotor->direct[k];
        set_weights(modes, count, scheme->remainder, integrals, w + s * modes);
        set_seen(rotor, w + s * modes, table->defect + (size_t)i * block);
        set_move(rotor, table->keep, table->move + i * rotor->rows * 2 * modes);
        if (table->weights) {
            memcpy(table->turn + i * modes, table->keep, (size_t)modes * sizeof *w);
            memcpy(table->weights + i * count * modes, w, (size_t)(count * modes) * sizeof *w);
        }
    }
    set_advance(rotor, s, w, table);
    free(w);
    return RF_OK;
}
