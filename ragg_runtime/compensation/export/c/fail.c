/* See fail.h. */
#include "fail.h"

#include <stdio.h>
#include <stdlib.h>

enum { BAD = 2 };

void ragg_fail(const char *what, const char *where, const char *expected) {
    fprintf(stderr, "%s: %s: %s\n  expected: %s\n", ragg_program, where, what, expected);
    exit(BAD);
}

void *ragg_bigger(void *old, size_t count, size_t size) {
    void *found = count > (size_t)-1 / size ? NULL : realloc(old, count * size);
    if (!found) {
        ragg_fail("there is not enough memory", "standard input", "a shorter record");
    }
    return found;
}
