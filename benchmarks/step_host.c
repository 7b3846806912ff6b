/* What a step of any native FMU of FMI 2.0 costs in C:  host LIBRARY RESOURCES GUID INPUTS OUTPUTS DT TABLE ROUNDS

   INPUTS and OUTPUTS are value references, separated by commas; TABLE holds rows of inputs, binary. Each round
   starts anew, sets a row, steps by DT and gets the outputs, row after row. Prints the shortest time of a step
   [ns] and the outputs after the last one. */
#define _POSIX_C_SOURCE 199309L
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi/fmi2FunctionTypes.h"

enum { MOST = 64 };

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

static void tell(fmi2ComponentEnvironment e, fmi2String n, fmi2Status s, fmi2String c, fmi2String m, ...)
{
    (void)e, (void)n, (void)s;
    fprintf(stderr, "%s: %s\n", c, m);
}

static size_t references(const char *text, fmi2ValueReference *into)
{
    size_t count = 0;
    for (char *end; count < MOST && *text; text = *end ? end + 1 : end)
        into[count++] = (fmi2ValueReference)strtoul(text, &end, 10);
    return count;
}

#define LOAD(type, name) \
    type##TYPE *name; \
    *(void **)&name = function(library, #type)

int main(int argc, char **argv)
{
    void *library = argc == 9 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    FILE *file = library ? fopen(argv[7], "rb") : NULL;
    if (!file)
        return 2;
    LOAD(fmi2Instantiate, instantiate);
    LOAD(fmi2SetupExperiment, setup);
    LOAD(fmi2EnterInitializationMode, enter);
    LOAD(fmi2ExitInitializationMode, leave);
    LOAD(fmi2SetReal, set);
    LOAD(fmi2GetReal, get);
    LOAD(fmi2DoStep, step);
    LOAD(fmi2Reset, reset);
    fmi2ValueReference inputs[MOST], outputs[MOST];
    const size_t m = references(argv[4], inputs), q = references(argv[5], outputs);
    const double dt = strtod(argv[6], NULL);
    fseek(file, 0, SEEK_END);
    const size_t rows = (size_t)ftell(file) / sizeof(double) / m;
    rewind(file);
    double *table = malloc(rows * m * sizeof *table), y[MOST], fastest = INFINITY;
    if (!table || fread(table, sizeof *table, rows * m, file) != rows * m)
        return 2;
    const fmi2CallbackFunctions callbacks = {tell, calloc, free, NULL, NULL};
    fmi2Component c = instantiate("one", fmi2CoSimulation, argv[3], argv[2], &callbacks, 0, 0);
    for (int round = atoi(argv[8]); c && round > 0; --round) {
        if (reset(c) || setup(c, 0, 0.0, 0.0, 0, 0.0) || enter(c) || set(c, inputs, m, table) || leave(c))
            return 3;
        int worst = 0;
        const double begin = now();
        for (size_t k = 0; k < rows; ++k) {
            worst |= set(c, inputs, m, table + k * m) | step(c, dt * (double)k, dt, 1) | get(c, outputs, q, y);
        }
        fastest = fmin(fastest, (now() - begin) / (double)rows);
        if (worst)
            return 4;
    }
    printf("%.17g", fastest);
    for (size_t i = 0; c && i < q; ++i)
        printf(" %.17g", y[i]);
    puts("");
    return c ? 0 : 3;
}
