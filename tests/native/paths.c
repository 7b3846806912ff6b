/* Prints the file that each argument means as the resources of an FMU, or why there is none. */
#include <stdio.h>
#include <stdlib.h>

#include "fmi/resource.h"

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; ++i) {
        rf_message why = {""};
        char *path = rf_resource_path(argv[i], &why);
        puts(path ? path : why.text);
        free(path);
    }
    return 0;
}
