/* A record of motion from a CSV, with what the model needs of derivatives.
 *
 * The CSV has a header, one `name [unit]` a column, in SI units; the columns that are needed stand in values.h, others are
 * passed over. Gradients that are not there are zero; omegadot, where it is not there, is derived from omega as Python
 * derives it; without a disc's encoder its angle is 2 pi spin_frequency t, from t = 0 or from the first row (FROM_FIRST). */
#ifndef RAGG_RECORD_H
#define RAGG_RECORD_H

#include <stddef.h>
#include <stdio.h>

#include "values.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How the programs end at what they cannot do: one message on stderr, and exit status 2. */
extern const char *const ragg_program;
void ragg_fail(const char *what, const char *where, const char *expected);

typedef struct {
    size_t n;
    double *column[COLUMNS], *seconds; /* n numbers each; nan where a value is missing, 0 where a column is */
    int there[COLUMNS];
    double *series[INPUTS], *spin[DISCS][2]; /* inputs of the model; rate and acceleration of the discs' angles */
} ragg_record;

/* Read a record, with the columns of the outputs if they are wanted. Ends the program at bad input. */
void ragg_read(ragg_record *r, FILE *file, int outputs);

/* The inputs of an output from sample at on; returns the angles of its disc. */
const double *ragg_inputs(const ragg_record *r, size_t output, size_t at, const double *in[INPUTS]);

#ifdef __cplusplus
}
#endif

#endif
