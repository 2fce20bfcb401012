/* ragg_online NOISE_V WALK_EO FORGET_S < FLIGHT.csv > OUT.csv: an example of online.h.
 *
 * FLIGHT.csv: the columns of a record (record.h) and the recorded outputs, in SI units. Every output that sees a gradient
 * and is there is filtered; recorded gradients do not enter. OUT.csv: time,inline,cross,inline_std,cross_std (Eo; of several
 * outputs each with its ending) at every step of the gradient's walk, nan where nothing was recorded yet; at last the
 * parameters, one a line after #, output after output. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "record.h"

#include "online.h"

const char *const ragg_program = "ragg_online";

static ragg_online filters[ONLINE_OUTPUTS];
static ragg_gradient latest[ONLINE_OUTPUTS];
static int there[ONLINE_OUTPUTS], gradient[INPUTS]; /* outputs that are recorded; inputs that are recorded gradients */

/* Take sample i, at t s since the first; whether the gradient has taken a step. */
static int take(const ragg_record *r, size_t i, double t) {
    int any = 0;
    for (int n = 0; n < ONLINE_OUTPUTS; ++n) {
        if (!there[n]) {
            continue;
        }
        const size_t which = (size_t)ONLINE_OUTPUT[n].which;
        const double *in[INPUTS], *angle = ragg_inputs(r, which, i, in);
        double x[ONLINE_INPUTS];
        for (size_t k = 0; k < INPUTS; ++k) {
            x[k] = gradient[k] ? 0.0 : *in[k];
        }
        double G = r->column[FIRST_OUTPUT + (int)which][i];
        G = isnan(*angle) ? (double)NAN : G;
        if (ragg_online_step(&filters[n], t, x, *angle, G)) {
            latest[n] = ragg_online_gradient(&filters[n]);
            any = 1;
        }
    }
    return any;
}

static void header(void) {
    static const char *const names[] = {"inline", "cross", "inline", "cross"}, *const ends[] = {"", "", "_std", "_std"};
    fputs("time", stdout);
    for (int n = 0; n < ONLINE_OUTPUTS; ++n) {
        for (int k = 0; there[n] && k < 4; ++k) {
            printf(",%s%s%s", names[k], ONLINE_OUTPUT[n].ending, ends[k]);
        }
    }
    puts("");
}

static void tell(double t) {
    printf("%.17g", t);
    for (int n = 0; n < ONLINE_OUTPUTS; ++n) {
        if (there[n]) {
            const ragg_gradient g = latest[n];
            printf(",%.17g,%.17g,%.17g,%.17g", g.inline_Eo, g.cross_Eo, g.inline_std, g.cross_std);
        }
    }
    puts("");
}

int main(int count, char **arguments) {
    if (count != 4) {
        fprintf(stderr, "usage: ragg_online NOISE_V WALK_EO FORGET_S < FLIGHT.csv > OUT.csv\n");
        return 2;
    }
    static ragg_record r;
    ragg_read(&r, stdin, 1);
    for (size_t k = 0; k < INPUTS; ++k) {
        gradient[k] = INPUT[k].column != DISC_ANGLE && strncmp(COLUMN[INPUT[k].column].name, "Gamma_", 6) == 0;
    }
    int any = 0;
    for (int n = 0; n < ONLINE_OUTPUTS; ++n) {
        there[n] = r.there[FIRST_OUTPUT + ONLINE_OUTPUT[n].which];
        any |= there[n];
        ragg_online_start(&filters[n], n, strtod(arguments[1], NULL), strtod(arguments[2], NULL), strtod(arguments[3], NULL));
    }
    if (!any) {
        ragg_fail("the column is missing", ONLINE_OUTPUT[0].name, "a recorded output in V");
    }
    header();
    for (size_t i = 0; i < r.n; ++i) {
        if (take(&r, i, r.seconds[i])) {
            tell(r.column[TIME][i]);
        }
    }
    for (int n = 0; n < ONLINE_OUTPUTS; ++n) {
        double p[ONLINE_PARAMETERS];
        ragg_online_parameters(&filters[n], p);
        for (int k = 0; there[n] && k < ONLINE_PARAMETERS; ++k) {
            printf("# %.17g\n", p[k]);
        }
    }
    ragg_free(&r);
    return 0;
}
