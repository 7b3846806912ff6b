/* The file that an FMU's kernel, variables and tables are read from; written by resource.py. */
#ifndef ROTORFILM_RESOURCE_H
#define ROTORFILM_RESOURCE_H

#include "../kernels/kernel.h"

typedef enum rf_role {
    RF_TIME,
    RF_PARAMETER,
    RF_INPUT,
    RF_OUTPUT,
    RF_STATE,
    RF_DERIVATIVE,
    RF_SWITCH, /* value of a switching function */
    RF_ROLES
} rf_role;

#define RF_RESOURCE_FILE "rotorfilm.bin"

enum { RF_TUNABLE = 1 };

/* A number; its value reference is its place in the list. An array has that of its first number. */
typedef struct rf_variable {
    rf_role role;
    uint32_t index; /* among those of its role */
    uint32_t flags;
    uint32_t more; /* numbers of the array behind this one, 0 for a scalar */
    double start, minimum, maximum, nominal;
    char name[48];
} rf_variable;

typedef struct rf_resource {
    char token[128];
    char kernel[32];
    uint32_t checksum;
    size_t count[RF_ROLES];
    size_t variable_count;
    rf_variable *variables;
    rf_tables tables;
    double *numbers; /* behind the tables */
} rf_resource;

/* CRC-32, that of zip files and zlib. */
uint32_t rf_checksum(const unsigned char *bytes, size_t count);

/* Read a file; NULL with the message where it is missing, damaged or of another version. */
rf_resource *rf_read_resource(const char *path, rf_message *why);
void rf_free_resource(rf_resource *resource);

/* The path of the file in a folder given as FMI 2 URI (file:///a%20b/resources) or FMI 3 path; NULL with the
   message where it is neither. To be freed. */
char *rf_resource_path(const char *folder, rf_message *why);

#endif
