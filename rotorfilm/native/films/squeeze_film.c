#include "squeeze_film.h"

#include <math.h>
#include <string.h>

#include "map_frame.h"

#define PI 3.14159265358979323846
#define SMALLEST 1e-200 /* eccentricity ratio below which its direction counts for nothing */
#define CELLS 32        /* around a fed film */
#define ROOT_STEPS 12   /* in search of the edge of its pressure */

rf_arc rf_set_arc(double eps, double depth)
{
    const double rho = sqrt((1.0 - eps + depth) / (1.0 + eps + depth));
    const rf_arc arc = {eps, (1.0 - rho) / (1.0 + rho)};
    return arc;
}

double rf_spread(const rf_arc *arc, double psi)
{
    return psi + 2.0 * atan2(arc->b * sin(psi), 1.0 - arc->b * cos(psi));
}

rf_place rf_place_at(const rf_arc *arc, double xi)
{
    const double b = arc->b, den = 1.0 + b * b + 2.0 * b * cos(xi), across = 1.0 - b * b;
    const double root = (1.0 - b) * sin(0.5 * xi), less = 2.0 * root * root / den; /* 1 - cos psi */
    const rf_place at = {1.0 - less, across * sin(xi) / den, (1.0 - arc->eps) + arc->eps * less, across / den};
    return at;
}

/* The full film in closed form: h^3 + c = (h - h_1)(h - h_2)(h - h_3), with p_k = 1/(a_k + S_k), a_k = 1 - h_k and
   S_k^2 = a_k^2 - E. Its harmonics are the covariances of an autoregressive process of third order: no partial
   fractions, which lose digits as c -> 0, and no 1/eps. */

typedef struct pole {
    double p, pi, S, Si; /* p and S with their imaginary parts */
} pole;

/* The pole of a = 1 + shift, the root S with |eps p| < 1; 1 - E is kept apart. */
static pole set_pole(double E, double x, double y)
{
    const double a = 1.0 + x, aa = a * a - y * y, ai = 2.0 * a * y, size = aa * aa + ai * ai;
    const double n = (1.0 - E) + x * (2.0 + x) - y * y, ni = y * (2.0 + x) + x * y;
    const double z = (n * aa + ni * ai) / size, zi = (ni * aa - n * ai) / size, t = sqrt(0.5 * (fabs(z) + hypot(z, zi)));
    const double root = z >= 0.0 ? t : fabs(zi) / (2.0 * t), half = zi / (2.0 * t);
    const double rooti = z >= 0.0 ? half : copysign(t, zi);
    const double S = a * root - y * rooti, Si = a * rooti + y * root, sum = a + S, sumi = y + Si, per = sum * sum + sumi * sumi;
    const pole at = {sum / per, -sumi / per, S, Si};
    return at;
}

/* Integrals over the circle, across, excess and lift, and their slopes by E. */
typedef struct circle {
    double at[3], slope[3];
} circle;

static circle around(double E, double leak)
{
    const double kappa = cbrt(leak);
    const pole one = set_pole(E, kappa, 0.0), two = set_pole(E, -0.5 * kappa, -0.5 * sqrt(3.0) * kappa);
    const double p1 = one.p, S1 = one.S, p1_E = 0.5 * p1 * p1 / S1, p = two.p, pi = two.pi;
    const double SS = two.S * two.S + two.Si * two.Si, qr = (p * two.S + pi * two.Si) / SS, qi = (pi * two.S - p * two.Si) / SS;
    const double p_E = 0.5 * (p * qr - pi * qi), pi_E = 0.5 * (p * qi + pi * qr); /* p^2/(2 S) */
    const double m = p * p + pi * pi, m_E = 2.0 * (p_E * p + pi_E * pi);
    const double s1 = p1 + 2.0 * p, s1_E = p1_E + 2.0 * p_E;
    const double s2 = 2.0 * p1 * p + m, s2_E = 2.0 * (p1_E * p + p1 * p_E) + m_E;
    const double s3 = p1 * m, s3_E = p1_E * m + p1 * m_E;
    const double near = 1.0 - E * p1 * p, neari = -E * p1 * pi, nears = near * near + neari * neari;
    const double near_E = -(p1 * p + E * (p1_E * p + p1 * p_E)), neari_E = -(p1 * pi + E * (p1_E * pi + p1 * pi_E));
    const double pair = 1.0 - E * m, pair_E = -(m + E * m_E);
    const double across = 8.0 * PI * s3 / (nears * pair);
    const double across_log = s3_E / s3 - 2.0 * (near_E * near + neari_E * neari) / nears - pair_E / pair;
    const double common = across / (4.0 * p1 * S1 * m * SS);
    const double inverse = (two.S * two.S - two.Si * two.Si) / (SS * SS); /* real part of 1/S^2 */
    const double poles_log = p1_E / p1 - 0.5 / (S1 * S1) + 2.0 * (0.5 * qr - 0.5 * inverse);
    const double common_log = across_log - poles_log;
    const double even = s1 * s1 - s2 + E * (s1 * s3 - s2 * s2);
    const double even_E = 2.0 * s1 * s1_E - s2_E + s1 * s3 - s2 * s2 + E * (s1_E * s3 + s1 * s3_E - 2.0 * s2 * s2_E);
    const double odd = s1 - E * E * s2 * s3, odd_E = s1_E - 2.0 * E * s2 * s3 - E * E * (s2_E * s3 + s2 * s3_E);
    const circle found = {{across, common * even, common * odd},
                          {across * across_log, common * (even * common_log + even_E), common * (odd * common_log + odd_E)}};
    return found;
}

static void set_full(const rf_squeeze *of, const double *e, const double *w, double *f, double *jacobian)
{
    const double E = e[0] * e[0] + e[1] * e[1], ew = e[0] * w[0] + e[1] * w[1];
    double a = 0.0, b = 0.0, k = 0.0, a_E = 0.0, b_E = 0.0, k_E = 0.0;
    for (int32_t n = 0; n < of->groups; ++n) {
        const circle one = around(E, of->leak[n]);
        a += of->weight[n] * one.at[0], a_E += of->weight[n] * one.slope[0];
        b += of->weight[n] * one.at[1], b_E += of->weight[n] * one.slope[1];
        k += of->feed[n] * one.at[2], k_E += of->feed[n] * one.slope[2];
    }
    for (int i = 0; i < 2; ++i) {
        f[i] = -a * w[i] - (b * ew + k) * e[i];
        for (int j = 0; jacobian && j < 2; ++j) {
            const double grown = a_E * w[i] + (b_E * ew + k_E) * e[i];
            jacobian[4 * i + j] = -(b * ew + k) * (i == j) - b * e[i] * w[j] - 2.0 * grown * e[j];
            jacobian[4 * i + 2 + j] = -a * (i == j) - b * e[i] * e[j];
        }
    }
}

/* Add a push along u, and push_by_w u u and push_by_e u u to its derivatives. */
static void add(const double *u, double push, double by_e, double by_w, double *f, double *jacobian)
{
    for (int i = 0; i < 2; ++i) {
        f[i] += push * u[i];
        for (int j = 0; jacobian && j < 2; ++j) {
            jacobian[4 * i + j] += by_e * u[i] * u[j];
            jacobian[4 * i + 2 + j] += by_w * u[i] * u[j];
        }
    }
}

/* The direction of the eccentricity, where the film is thinnest. */
static double toward(const double *e, double eps)
{
    return eps > SMALLEST ? atan2(e[1], e[0]) : 0.0;
}

static void turn(double cm, double sm, const rf_place *at, double *u)
{
    u[0] = cm * at->cos - sm * at->sin;
    u[1] = sm * at->cos + cm * at->sin;
}

static void add_ruptured(const rf_squeeze *of, const double *e, const double *w, double *f, double *jacobian)
{
    const double eps = rf_length(e[0], e[1]), axis = toward(e, eps), cm = cos(axis), sm = sin(axis);
    const double heading = atan2(cm * w[1] - sm * w[0], cm * w[0] + sm * w[1]);
    const rf_arc arc = rf_set_arc(eps, of->depth);
    const double first = rf_spread(&arc, heading - 0.5 * PI), last = rf_spread(&arc, heading + 0.5 * PI);
    for (int32_t k = 0; k < of->count; ++k) {
        const rf_place at = rf_place_at(&arc, 0.5 * (first + last) + 0.5 * (last - first) * of->nodes[k]);
        const double share = 0.5 * (last - first) * of->weights[k] * at.stretch, h = at.h;
        double u[2], G = 0.0, G_h = 0.0;
        for (int32_t n = 0; n < of->groups; ++n) {
            const double inverse = 1.0 / (h * h * h + of->leak[n]);
            G += of->weight[n] * inverse;
            G_h -= 3.0 * h * h * of->weight[n] * inverse * inverse;
        }
        turn(cm, sm, &at, u);
        const double rate = share * (w[0] * u[0] + w[1] * u[1]);
        add(u, -G * rate, G_h * rate, -G * share, f, jacobian);
    }
}

/* A fed film: a place of it, with 1/(h^3 + leak) of each group. */
typedef struct spot {
    double u[2], rate, h, stretch, inverse[RF_MOST_GROUPS];
} spot;

typedef struct fed {
    const rf_squeeze *of;
    const double *w;
    rf_arc arc;
    double cm, sm;
} fed;

static void set_spot(const fed *film, double xi, spot *to)
{
    const rf_place at = rf_place_at(&film->arc, xi);
    turn(film->cm, film->sm, &at, to->u);
    to->rate = film->w[0] * to->u[0] + film->w[1] * to->u[1];
    to->h = at.h;
    to->stretch = at.stretch;
    for (int32_t n = 0; n < film->of->groups; ++n)
        to->inverse[n] = 1.0 / (at.h * at.h * at.h + film->of->leak[n]);
}

/* The pressure at a place on a row, and its slopes by the rate and by h. */
static double pressure(const fed *film, const spot *at, int row, double *by_rate, double *by_h)
{
    const rf_squeeze *of = film->of;
    const double Z = of->axial[row], *shape = of->axial + 2 * RF_AXIAL_NODES + row, part = -3.0 * at->h * at->h;
    double found = of->ends[0] + 0.5 * (1.0 + Z) * (of->ends[1] - of->ends[0]), thinner = 0.0, slope = 0.0;
    for (int32_t n = 0; n < of->groups; ++n, shape += RF_AXIAL_NODES) {
        const double each = *shape * at->inverse[n], source = at->rate + of->feed[n] / of->weight[n];
        slope += each;
        found += each * source;
        thinner += part * each * at->inverse[n] * source;
    }
    *by_rate = slope;
    *by_h = thinner;
    return found;
}

static double pressure_at(const fed *film, double xi, int row)
{
    double slope, thinner;
    spot at;
    set_spot(film, xi, &at);
    return pressure(film, &at, row, &slope, &thinner);
}

/* The zero of the pressure between two angles, by the Illinois variant of the false position. */
static double edge(const fed *film, int row, double low, double high, double at_low, double at_high)
{
    for (int k = 0; k < ROOT_STEPS; ++k) {
        const double change = at_high - at_low, middle = change == 0.0 ? 0.5 * (low + high) : high - at_high * (high - low) / change;
        const double value = pressure_at(film, middle, row);
        if ((value > 0.0) != (at_high > 0.0)) {
            low = high;
            at_low = at_high;
        } else {
            at_low *= 0.5;
        }
        high = middle;
        at_high = value;
    }
    return high;
}

/* Add the film between two angles on the rows that a mask has. */
static void add_cell(const fed *film, const int *mask, double low, double high, double *f, double *jacobian)
{
    const rf_squeeze *of = film->of;
    spot at;
    for (int32_t k = 0; k < of->count; ++k) {
        double push = 0.0, by_e = 0.0, by_w = 0.0, slope, thinner;
        set_spot(film, 0.5 * (low + high) + 0.5 * (high - low) * of->nodes[k], &at);
        for (int row = 0; row < RF_AXIAL_NODES; ++row) {
            if (!mask[row])
                continue;
            const double share = 1.5 * of->axial[RF_AXIAL_NODES + row] * 0.5 * (high - low) * of->weights[k] * at.stretch;
            push -= share * pressure(film, &at, row, &slope, &thinner);
            by_w -= share * slope;
            by_e += share * thinner; /* dh/de = -u */
        }
        add(at.u, push, by_e, by_w, f, jacobian);
    }
}

/* The cells of a film whose pressure is positive, cut where it vanishes: so the derivative of the force is the integral
   of the derivative. */
static void add_fed(const rf_squeeze *of, const double *e, const double *w, double *f, double *jacobian)
{
    const double eps = rf_length(e[0], e[1]), axis = toward(e, eps);
    const fed film = {of, w, rf_set_arc(eps, of->depth), cos(axis), sin(axis)};
    double left[RF_AXIAL_NODES], right[RF_AXIAL_NODES], slope, thinner;
    spot at;
    for (int cell = 0; cell <= CELLS; ++cell) {
        const double high = PI * (2.0 * cell / CELLS - 1.0), low = high - 2.0 * PI / CELLS;
        int whole[RF_AXIAL_NODES] = {0};
        set_spot(&film, high, &at);
        for (int row = 0; row < RF_AXIAL_NODES; ++row)
            right[row] = pressure(&film, &at, row, &slope, &thinner);
        for (int row = 0; cell > 0 && row < RF_AXIAL_NODES; ++row) {
            const int from = left[row] > 0.0, to = right[row] > 0.0;
            whole[row] = from && to;
            if (from == to)
                continue;
            int own[RF_AXIAL_NODES] = {0};
            const double cut = edge(&film, row, low, high, left[row], right[row]);
            own[row] = 1;
            add_cell(&film, own, to ? cut : low, to ? high : cut, f, jacobian);
        }
        if (cell > 0)
            add_cell(&film, whole, low, high, f, jacobian);
        memcpy(left, right, sizeof left);
    }
}

/* Whether anything drives a film. */
static int is_driven(const rf_squeeze *of, const double *w)
{
    int any = w[0] != 0.0 || w[1] != 0.0;
    for (int32_t n = 0; of->axial && n < of->groups; ++n)
        any = any || of->feed[n] != 0.0;
    return any || (of->axial && (of->ends[0] != 0.0 || of->ends[1] != 0.0));
}

int rf_squeeze_film(const void *film, const double *e, const double *w, double *f, double *jacobian)
{
    const rf_squeeze *of = film;
    if (rf_is_broken(e, 2) || rf_is_broken(w, 2))
        return rf_fail(RF_NOT_FINITE, f, jacobian, 8);
    if (rf_length(e[0], e[1]) >= 1.0)
        return rf_fail(RF_AT_WALL, f, jacobian, 8);
    if (of->nodes && !is_driven(of, w))
        return rf_rest(f, jacobian);
    f[0] = f[1] = 0.0;
    for (int i = 0; jacobian && i < 8; ++i)
        jacobian[i] = 0.0;
    (of->axial ? add_fed : of->nodes ? add_ruptured : set_full)(of, e, w, f, jacobian);
    return rf_judge(0.0, 1.0, f, jacobian);
}

int rf_take_squeeze(rf_squeeze *film, const rf_tables *tables, rf_message *why)
{
    const rf_table *groups = rf_find_table(tables, "groups", 2, why), *nodes = rf_seek_table(tables, "arc");
    const rf_table *axial = rf_seek_table(tables, "axial");
    if (!groups)
        return RF_INVALID;
    const uint32_t count = groups->extent[1];
    if (groups->extent[0] != 3 || count < 1 || count > RF_MOST_GROUPS)
        return rf_say(why, RF_INVALID, "groups of a film must be 3 x %d at most, got %u x %u", RF_MOST_GROUPS,
                      (unsigned)groups->extent[0], (unsigned)count);
    if (nodes && (nodes->axes != 2 || nodes->extent[0] != 2 || nodes->extent[1] < 1 || nodes->extent[1] > 1000))
        return rf_say(why, RF_INVALID, "arc of a film must be 2 x 1 to 1000, got %u x %u", (unsigned)nodes->extent[0],
                      (unsigned)nodes->extent[1]);
    if (axial && (!nodes || axial->axes != 2 || axial->extent[0] != count + 2 || axial->extent[1] != RF_AXIAL_NODES))
        return rf_say(why, RF_INVALID, "axial of a film must be %u x %d, beside arc, got %u x %u", (unsigned)count + 2,
                      RF_AXIAL_NODES, (unsigned)axial->extent[0], (unsigned)axial->extent[1]);
    const double *weight = groups->numbers, *leak = weight + count;
    double mean = 0.0;
    for (uint32_t n = 0; n < count; ++n) {
        if (!(leak[n] >= 0.0) || weight[n] == 0.0)
            return rf_say(why, RF_INVALID, "groups of a film must have weights and no negative leaks, got %.9g and %.9g",
                          weight[n], leak[n]);
        mean += weight[n] * leak[n];
    }
    const rf_squeeze found = {weight, leak, leak + count, nodes ? nodes->numbers : NULL,
                              nodes ? nodes->numbers + nodes->extent[1] : NULL, axial ? axial->numbers : NULL,
                              (int32_t)count, nodes ? (int32_t)nodes->extent[1] : 0, mean > 0.0 ? 0.5 * cbrt(mean) : 0.0, {0.0, 0.0}};
    *film = found;
    return RF_OK;
}
