/* A co-simulation host without Python:  host VERSION LIBRARY RESOURCES TOKEN INPUTS OUTPUTS < steps

   VERSION is 2 or 3, INPUTS and OUTPUTS are value references separated by commas. Every line of the steps is
   the size of a step and the inputs to hold over it; the first line is set during initialization and has the
   size 0. Prints the outputs after initialization and after every step, with all their digits, and at the end to
   stderr what the calls after initialization allocated and how long a step took: set, step and get. */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi/fmi2FunctionTypes.h"
#include "fmi/fmi3PlatformTypes.h"

#include "fmi/fmi3FunctionTypes.h"

enum { MOST = 64 };

typedef struct references {
    unsigned vr[MOST];
    size_t count;
} references;

static void *library, *instance;
static int version;

/* Allocations while an FMU runs; the library takes these functions in place of those of libc. */
static size_t allocations;
static int running;

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);

void *malloc(size_t size)
{
    allocations += (size_t)running;
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    allocations += (size_t)running;
    return __libc_calloc(count, size);
}

void *realloc(void *block, size_t size)
{
    allocations += (size_t)running;
    return __libc_realloc(block, size);
}
#endif

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void *function(const char *name)
{
    void *found = dlsym(library, name);
    if (!found) {
        fprintf(stderr, "no function %s\n", name);
        exit(2);
    }
    return found;
}

/* ISO C has no cast from an object to a function. */
#define LOAD(type, name) \
    type##TYPE *name; \
    *(void **)&name = function(#type)

static void require(int status, const char *what)
{
    if (status > 1) {
        fprintf(stderr, "%s answered %d\n", what, status);
        exit(3);
    }
}

static void hear2(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                  fmi2String category, fmi2String message, ...)
{
    va_list values;
    (void)environment, (void)name;
    fprintf(stderr, "%d %s: ", (int)status, category);
    va_start(values, message);
    vfprintf(stderr, message, values);
    va_end(values);
    fputc('\n', stderr);
}

static void hear3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                  fmi3String message)
{
    (void)environment;
    fprintf(stderr, "%d %s: %s\n", (int)status, category, message);
}

static void instantiate(const char *resources, const char *token)
{
    static const fmi2CallbackFunctions CALLBACKS = {hear2, calloc, free, NULL, NULL};
    char uri[4096];
    if (version == 2) {
        LOAD(fmi2Instantiate, make);
        snprintf(uri, sizeof uri, "file://%s", resources);
        instance = make("host", fmi2CoSimulation, token, uri, &CALLBACKS, 0, 0);
    } else {
        LOAD(fmi3InstantiateCoSimulation, make);
        instance = make("host", token, resources, 0, 0, 0, 0, NULL, 0, NULL, hear3, NULL);
    }
    require(instance ? 0 : 3, "instantiate");
}

static void set(const references *to, const double *values)
{
    if (version == 2) {
        LOAD(fmi2SetReal, put);
        require(put(instance, to->vr, to->count, values), "fmi2SetReal");
    } else {
        LOAD(fmi3SetFloat64, put);
        require(put(instance, to->vr, to->count, values, to->count), "fmi3SetFloat64");
    }
}

static void take(const references *from, double *values)
{
    if (version == 2) {
        LOAD(fmi2GetReal, get);
        require(get(instance, from->vr, from->count, values), "fmi2GetReal");
    } else {
        LOAD(fmi3GetFloat64, get);
        require(get(instance, from->vr, from->count, values, from->count), "fmi3GetFloat64");
    }
}

static void print(const references *from, const double *values)
{
    for (size_t i = 0; i < from->count; ++i)
        printf("%.17g%c", values[i], i + 1 < from->count ? ' ' : '\n');
}

static void initialize(const references *inputs, const double *values)
{
    if (version == 2) {
        LOAD(fmi2SetupExperiment, setup);
        LOAD(fmi2EnterInitializationMode, enter);
        LOAD(fmi2ExitInitializationMode, leave);
        require(setup(instance, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment");
        require(enter(instance), "fmi2EnterInitializationMode");
        set(inputs, values);
        require(leave(instance), "fmi2ExitInitializationMode");
    } else {
        LOAD(fmi3EnterInitializationMode, enter);
        LOAD(fmi3ExitInitializationMode, leave);
        require(enter(instance, 0, 0.0, 0.0, 0, 0.0), "fmi3EnterInitializationMode");
        set(inputs, values);
        require(leave(instance), "fmi3ExitInitializationMode");
    }
}

static double step(double t, double dt)
{
    fmi3Boolean event, ended, early;
    double last = t + dt;
    if (version == 2) {
        LOAD(fmi2DoStep, advance);
        require(advance(instance, t, dt, 1), "fmi2DoStep");
    } else {
        LOAD(fmi3DoStep, advance);
        require(advance(instance, t, dt, 1, &event, &ended, &early, &last), "fmi3DoStep");
    }
    return last;
}

static references parse(char *text)
{
    references found = {{0}, 0};
    for (char *part = strtok(text, ","); part && found.count < MOST; part = strtok(NULL, ","))
        found.vr[found.count++] = (unsigned)strtoul(part, NULL, 10);
    return found;
}

/* A line of the table; 0 at its end. */
static int read_line(size_t count, double *dt, double *values)
{
    if (scanf("%lf", dt) != 1)
        return 0;
    for (size_t i = 0; i < count; ++i)
        require(scanf("%lf", values + i) == 1 ? 0 : 3, "the table of steps");
    return 1;
}

int main(int argc, char **argv)
{
    double dt, t = 0.0, values[MOST];
    if (argc != 7 || !(library = dlopen(argv[2], RTLD_NOW | RTLD_LOCAL))) {
        fprintf(stderr, "%s\n",
                argc == 7 ? dlerror() : "host VERSION LIBRARY RESOURCES TOKEN INPUTS OUTPUTS");
        return 2;
    }
    version = atoi(argv[1]);
    const references inputs = parse(argv[5]), outputs = parse(argv[6]);
    instantiate(argv[3], argv[4]);
    require(read_line(inputs.count, &dt, values) ? 0 : 3, "the table of steps");
    initialize(&inputs, values);
    take(&outputs, values);
    print(&outputs, values);
    double longest = 0.0, total = 0.0;
    size_t steps = 0;
    for (; read_line(inputs.count, &dt, values); ++steps) {
        const double began = seconds();
        running = 1;
        set(&inputs, values);
        t = step(t, dt);
        take(&outputs, values);
        running = 0;
        const double taken = seconds() - began;
        longest = taken > longest ? taken : longest;
        total += taken;
        print(&outputs, values);
    }
    fprintf(stderr, "allocations %zu, mean step %.3g us, longest %.3g us\n", allocations,
            1e6 * total / (double)(steps + !steps), 1e6 * longest);
    if (version == 2) {
        LOAD(fmi2FreeInstance, release);
        release(instance);
    } else {
        LOAD(fmi3FreeInstance, release);
        release(instance);
    }
    return dlclose(library);
}
