/* ragg_model < MOTION.csv > OUT.csv: the outputs of the gradiometer, V, from a record of its motion (see record.h).
 *
 * OUT.csv: time and the outputs with 17 digits; nan where a value that is needed is missing. With --check TOLERANCE the record
 * holds the outputs as well: exit status 1 if they differ by more, V. Exit status 2: bad input, one message on stderr. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "record.h"

const char *const ragg_program = "ragg_model";

/* The outputs of sample i, V. */
static void predict(const ragg_record *r, size_t i, double G[OUTPUTS]) {
    for (size_t which = 0; which < OUTPUTS; ++which) {
        const double *in[INPUTS], *angle = ragg_inputs(r, which, i, in);
        int whole = !isnan(*angle);
        for (size_t k = 0; k < INPUTS; ++k) {
            whole = whole && !isnan(*in[k]);
        }
        MODEL(which, 1, r->seconds + i, in, PARAMETER, angle, G + which);
        G[which] = whole ? G[which] : (double)NAN;
    }
}

static int write_outputs(const ragg_record *r) {
    double G[OUTPUTS];
    fputs("time", stdout);
    for (size_t k = 0; k < OUTPUTS; ++k) {
        printf(",%s", OUTPUT[k].name);
    }
    for (size_t i = 0; i < r->n; ++i) {
        predict(r, i, G);
        printf("\n%.17g", r->column[TIME][i]);
        for (size_t k = 0; k < OUTPUTS; ++k) {
            printf(",%.17g", G[k]);
        }
    }
    puts("");
    return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 2;
}

static int check(const ragg_record *r, double tolerance) {
    double G[OUTPUTS], largest = 0.0;
    for (size_t i = 0; i < r->n; ++i) {
        predict(r, i, G);
        for (size_t k = 0; k < OUTPUTS; ++k) {
            const double gap = fabs(G[k] - r->column[FIRST_OUTPUT + k][i]);
            largest = gap <= largest ? largest : isnan(gap) ? (double)INFINITY : gap;
        }
    }
    printf("%zu rows, largest difference %.3g V, allowed %.3g V\n", r->n, largest, tolerance);
    return largest <= tolerance ? 0 : 1;
}

int main(int count, char **arguments) {
    static ragg_record r;
    if (count == 2 && strcmp(arguments[1], "--values") == 0) {
        for (size_t k = 0; k < PARAMETERS; ++k) {
            printf("%s = %.17g %s\n", PARAMETER_LABEL[k].name, PARAMETER[k], PARAMETER_LABEL[k].unit);
        }
        return 0;
    }
    const int checks = count == 3 && strcmp(arguments[1], "--check") == 0;
    if (count > 1 && !checks) {
        ragg_fail("unknown argument", arguments[1], "--values, --check TOLERANCE, or none");
    }
    ragg_read(&r, stdin, checks);
    return checks ? check(&r, strtod(arguments[2], NULL)) : write_outputs(&r);
}
