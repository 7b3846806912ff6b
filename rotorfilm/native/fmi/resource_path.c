/* Where the resources of an FMU lie: URIs of FMI 2 and paths of FMI 3. */
#include "resource.h"

#include <stdlib.h>
#include <string.h>

static int digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Decode %xx in place; 0 if one is not hexadecimal, or a zero. */
static int decode(char *text)
{
    char *to = text;
    for (; *text; ++text, ++to) {
        *to = *text;
        if (*text != '%')
            continue;
        const int high = digit(text[1]), low = high < 0 ? -1 : digit(text[2]);
        if (low < 0 || high + low == 0)
            return 0;
        *to = (char)(unsigned char)(16 * high + low);
        text += 2;
    }
    *to = '\0';
    return 1;
}

static int is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* The path in file:/path, file:///path, file://host/path or file:///C:/path; NULL if there is none. */
static const char *local_part(const char *after_scheme)
{
    const char *path = after_scheme;
    if (path[0] == '/' && path[1] == '/') {
        path += 2;
        if (strncmp(path, "localhost/", 10) == 0)
            path += 9;
        else if (path[0] && path[0] != '/' && !(is_letter(path[0]) && path[1] == ':'))
            return after_scheme; /* a Windows share: //host/path */
    }
    if (path[0] == '/' && is_letter(path[1]) && path[2] == ':')
        ++path;
    return path[0] ? path : NULL;
}

char *rf_resource_path(const char *folder, rf_message *why)
{
    const int is_uri = folder && strncmp(folder, "file:", 5) == 0;
    const char *given = is_uri ? local_part(folder + 5) : folder;
    char *path = given && *given ? malloc(strlen(given) + sizeof RF_RESOURCE_FILE + 2) : NULL;
    if (path)
        strcpy(path, given);
    if (!path || (is_uri && !decode(path))) {
        rf_say(why, RF_INVALID, "the resources of the FMU must be a file URI or a path, got '%.200s'",
               folder ? folder : "");
        free(path);
        return NULL;
    }
    const size_t length = strlen(path);
    if (path[length - 1] != '/' && path[length - 1] != '\\')
        strcat(path, "/");
    return strcat(path, RF_RESOURCE_FILE);
}
