/* How the programs end at what they cannot do: one message on stderr, and exit status 2. */
#ifndef RAGG_FAIL_H
#define RAGG_FAIL_H

#include <stddef.h>

extern const char *const ragg_program;
_Noreturn void ragg_fail(const char *what, const char *where, const char *expected);

/* realloc of count things of a size, or the end. */
void *ragg_bigger(void *old, size_t count, size_t size);

#endif
