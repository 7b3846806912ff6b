/* Preloaded: a freed object of C++ that is used once more ends the process by a signal, every time.

   Of the size of PythonFMU's share of Python, which counts its users behind its first pointer: the count says
   that there is one, and the pointer to its functions is none. */
#include <stddef.h>
#include <string.h>

enum { SHARE = 128 };

void _ZdlPvm(void *object, size_t size);

void _ZdlPvm(void *object, size_t size)
{
    const int users = 1;
    if (size == SHARE) {
        memset(object, 0, size);
        memcpy((char *)object + sizeof(void *), &users, sizeof users);
    }
}
