/* What a step of a journal bearing costs in C:  host LIBRARY RESOURCES GUID FIRST KERNEL STATES ROUNDS [INPUTS]

   LIBRARY is that of the FMU, FIRST the value reference of its first of INPUTS (5) inputs, which its two
   outputs follow. KERNEL holds the bearing's map for the bare kernel, STATES numbers of five each; both are binary.
   Prints the shortest time of a call [ns] of the bare kernel and of the FMU (set, doStep, get), taken in turn,
   and the largest difference of their forces relative to the largest force. */
#define _POSIX_C_SOURCE 199309L
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "fmi/fmi2FunctionTypes.h"
#include "films/journal_kernel.h"
#include "films/map_kernel.h"

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static void *function(void *library, const char *name)
{
    void *found = dlsym(library, name);
    if (!found) {
        fprintf(stderr, "no function %s\n", name);
        exit(2);
    }
    return found;
}

static double *read_numbers(const char *path, size_t *count)
{
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END)) {
        perror(path);
        exit(2);
    }
    *count = (size_t)ftell(file) / sizeof(double);
    rewind(file);
    double *numbers = malloc(*count * sizeof(double));
    if (!numbers || fread(numbers, sizeof(double), *count, file) != *count)
        exit(2);
    fclose(file);
    return numbers;
}

static void ignore(fmi2ComponentEnvironment e, fmi2String n, fmi2Status s, fmi2String c, fmi2String m, ...)
{
    (void)e, (void)n, (void)s, (void)c, (void)m;
}

#define LOAD(type, name) \
    type##TYPE *name; \
    *(void **)&name = function(library, #type)

int main(int argc, char **argv)
{
    if (argc != 8 && argc != 9)
        return 2;
    const unsigned width = argc == 9 ? (unsigned)atoi(argv[8]) : 5;
    void *library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        return 2;
    }
    LOAD(fmi2Instantiate, instantiate);
    LOAD(fmi2SetupExperiment, setup);
    LOAD(fmi2EnterInitializationMode, enter);
    LOAD(fmi2ExitInitializationMode, leave);
    LOAD(fmi2SetReal, set);
    LOAD(fmi2GetReal, get);
    LOAD(fmi2DoStep, step);
    int (*kernel)(rf_response, const void *, double, double, double, double, double, double *);
    rf_response at;
    *(void **)&kernel = function(library, "rf_response_call");
    *(void **)&at = function(library, "rf_journal_at");

    size_t size, count;
    const double *map = read_numbers(argv[5], &size), *states = read_numbers(argv[6], &count);
    const rf_map plain = {.x = {(int32_t)map[0], 0.0, map[2]}, .s = {(int32_t)map[1], -1.0, 1.0}, .center = map + 3, .coefficients = map + 6};
    rf_journal journal = {NULL, &plain, map[4], map[5]};
    *(void **)&journal.film = function(library, "rf_map_film");
    const unsigned first = (unsigned)atoi(argv[4]);
    const fmi2ValueReference inputs[5] = {first, first + 1, first + 2, first + 3, first + 4};
    const fmi2ValueReference outputs[2] = {first + width, first + width + 1};
    const fmi2CallbackFunctions callbacks = {ignore, calloc, free, NULL, NULL};
    fmi2Component c = instantiate("bearing", fmi2CoSimulation, argv[3], argv[2], &callbacks, 0, 0);
    if (!c || setup(c, 0, 0.0, 0.0, 0, 0.0) || enter(c) || set(c, inputs, width, states) || leave(c))
        return 3;

    const size_t n = count / 5;
    const int rounds = atoi(argv[7]);
    double fastest[2] = {INFINITY, INFINITY}, difference = 0.0, largest = 0.0, t = 0.0, sum = 0.0;
    double *forces = malloc(2 * n * sizeof(double));
    for (int round = 0; round < rounds; ++round) {
        double begin = now();
        for (size_t i = 0; i < n; ++i) {
            const double *u = states + 5 * i;
            sum += kernel(at, &journal, u[0], u[1], u[2], u[3], u[4], forces + 2 * i);
        }
        fastest[0] = fmin(fastest[0], (now() - begin) / (double)n);
        for (size_t i = 0; i < 2 * n; ++i)
            largest = fmax(largest, fabs(forces[i]));
        begin = now();
        for (size_t i = 0; i < n; ++i) {
            double f[2];
            int status = set(c, inputs, width, states + 5 * i) | step(c, t, 1e-4, 1) | get(c, outputs, 2, f);
            t += 1e-4;
            sum += status;
            difference = fmax(difference, fmax(fabs(f[0] - forces[2 * i]), fabs(f[1] - forces[2 * i + 1])));
        }
        fastest[1] = fmin(fastest[1], (now() - begin) / (double)n);
    }
    printf("%.17g %.17g %.17g\n", fastest[0], fastest[1], difference / largest);
    return sum == 0.0 ? 0 : 3;
}
