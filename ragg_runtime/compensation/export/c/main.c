/* ragg_model < MOTION.csv > OUT.csv: the outputs of the gradiometer, V, from a record of its motion (see record.h).
 *
 * OUT.csv: time and the outputs with 17 digits; nan where a value that is needed is missing. Exit status: 0 done, 2 bad
 * input (one message on stderr). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "record.h"

const char *const ragg_program = "ragg_model";

enum { BLOCK = 4096 };

/* The parameters that are built in: name, value, unit. */
static int tell(void) {
    for (size_t k = 0; k < PARAMETERS; ++k) {
        printf("%s = %.17g %s\n", PARAMETER_NAME[k], PARAMETER[k], PARAMETER_UNIT[k]);
    }
    return fflush(stdout) == 0 ? 0 : 1;
}

/* An output at size samples from at on. */
static void output(const ragg_record *r, size_t which, size_t at, size_t size, double *G) {
    const double *in[INPUTS], *angle = ragg_inputs(r, which, at, in);
    MODEL(which, size, r->seconds + at, in, PARAMETER, angle, G);
    for (size_t i = 0; i < size; ++i) {
        int whole = !isnan(angle[i]);
        for (size_t k = 0; k < INPUTS; ++k) {
            whole = whole && !isnan(in[k][i]);
        }
        G[i] = whole ? G[i] : (double)NAN;
    }
}

int main(int count, char **arguments) {
    if (count == 2 && strcmp(arguments[1], "--values") == 0) {
        return tell();
    }
    if (count > 1) {
        ragg_fail("unknown argument", arguments[1], "ragg_model < MOTION.csv > OUT.csv, or ragg_model --values");
    }
    static ragg_record r;
    static double G[OUTPUTS][BLOCK];
    ragg_read(&r, stdin, 0);
    int written = fputs("time", stdout);
    for (size_t k = 0; k < OUTPUTS; ++k) {
        printf(",%s", OUTPUT[k].name);
    }
    for (size_t at = 0; at < r.n && written >= 0; at += BLOCK) {
        const size_t size = r.n - at < BLOCK ? r.n - at : BLOCK;
        for (size_t k = 0; k < OUTPUTS; ++k) {
            output(&r, k, at, size, G[k]);
        }
        for (size_t i = 0; i < size && written >= 0; ++i) {
            written = printf("\n%.17g", r.column[TIME][at + i]);
            for (size_t k = 0; k < OUTPUTS; ++k) {
                printf(",%.17g", G[k][i]);
            }
        }
    }
    written = written < 0 ? written : puts("");
    ragg_free(&r);
    return written >= 0 && fflush(stdout) == 0 ? 0 : 1;
}
