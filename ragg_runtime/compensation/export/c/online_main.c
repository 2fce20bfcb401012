/* ragg_online NOISE_V WALK_EO FORGET_S < FLIGHT.csv > OUT.csv: an example of online.h.
 *
 * FLIGHT.csv: the columns of a record (record.h) and the recorded outputs, in SI units. Every output that sees a gradient
 * and is there is filtered; recorded gradients do not enter. OUT.csv: time,inline,cross,inline_std,cross_std (Eo; of several
 * outputs each with its ending) at every step of the gradient's walk; at last the parameters, one a line after #. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "record.h"

#include "online.h"

const char *const ragg_program = "ragg_online";

/* Take sample i of an output; whether the gradient has taken a step. */
static int take(ragg_online *o, const ragg_record *r, int which, size_t i) {
    const double *in[INPUTS], *angle = ragg_inputs(r, (size_t)which, i, in);
    double x[ONLINE_INPUTS];
    for (size_t k = 0; k < INPUTS; ++k) {
        const int gradient = INPUT[k].column >= 0 && strncmp(COLUMN[INPUT[k].column].name, "Gamma_", 6) == 0;
        x[k] = gradient ? 0.0 : *in[k];
    }
    const double G = r->column[FIRST_OUTPUT + which][i];
    return ragg_online_step(o, r->seconds[i], x, *angle, isnan(*angle) ? (double)NAN : G);
}

int main(int count, char **arguments) {
    static ragg_record r;
    static ragg_online filters[ONLINE_OUTPUTS];
    int outputs[ONLINE_OUTPUTS], n = 0; /* those that are recorded */
    if (count != 4) {
        fprintf(stderr, "usage: ragg_online NOISE_V WALK_EO FORGET_S < FLIGHT.csv > OUT.csv\n");
        return 2;
    }
    ragg_read(&r, stdin, 1);
    fputs("time", stdout);
    for (int k = 0; k < ONLINE_OUTPUTS; ++k) {
        if (r.there[FIRST_OUTPUT + ONLINE_OUTPUT[k].which]) {
            const char *end = ONLINE_OUTPUT[k].ending;
            printf(",inline%s,cross%s,inline%s_std,cross%s_std", end, end, end, end);
            ragg_online_start(filters + n, k, strtod(arguments[1], NULL), strtod(arguments[2], NULL), strtod(arguments[3], NULL));
            outputs[n++] = ONLINE_OUTPUT[k].which;
        }
    }
    if (n == 0) {
        ragg_fail("the column is missing", ONLINE_OUTPUT[0].name, "a recorded output in V");
    }
    for (size_t i = 0; i < r.n; ++i) {
        int stepped = 0;
        for (int k = 0; k < n; ++k) {
            stepped |= take(filters + k, &r, outputs[k], i);
        }
        if (stepped) {
            printf("\n%.17g", r.column[TIME][i]);
        }
        for (int k = 0; k < n && stepped; ++k) {
            const ragg_gradient g = ragg_online_gradient(filters + k);
            printf(",%.17g,%.17g,%.17g,%.17g", g.inline_Eo, g.cross_Eo, g.inline_std, g.cross_std);
        }
    }
    for (int k = 0; k < n; ++k) {
        double p[ONLINE_PARAMETERS];
        ragg_online_parameters(filters + k, p);
        for (int j = 0; j < ONLINE_PARAMETERS; ++j) {
            printf("\n# %.17g", p[j]);
        }
    }
    puts("");
    return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 2;
}
