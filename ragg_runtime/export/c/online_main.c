/* ragg_online NOISE WALK FORGET < SAMPLES.csv > OUT.csv: an example of online.h.
 *
 * SAMPLES.csv: a line of names, then `time, inputs of the model in their order, G_out`, SI units, nan where one is missing.
 * OUT.csv: time,inline,cross,inline_std,cross_std (Eo) at every step of the gradient's walk; at last the parameters, one a
 * line after #. With a fourth argument N the samples are taken N times over, and their time is told on stderr instead. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "online.h"

enum { MOST = 65536, COLUMNS = ONLINE_INPUTS + 2 };

static double samples[MOST][COLUMNS];

int main(int count, char **arguments) {
    if (count < 4) {
        fprintf(stderr, "usage: ragg_online NOISE_V WALK_EO FORGET_S [TIMES] < SAMPLES.csv > OUT.csv\n");
        return 2;
    }
    static ragg_online o;
    ragg_online_start(&o, strtod(arguments[1], NULL), strtod(arguments[2], NULL), strtod(arguments[3], NULL));
    static char line[65536];
    if (!fgets(line, sizeof line, stdin)) {
        return 2;
    }
    int n = 0;
    for (; n < MOST && fgets(line, sizeof line, stdin); ++n) {
        char *at = line;
        for (int k = 0; k < COLUMNS; ++k) {
            samples[n][k] = strtod(at, &at);
            at += *at == ',';
        }
    }
    const long times = count > 4 ? strtol(arguments[4], NULL, 10) : 1;
    const double length = n > 1 ? samples[n - 1][0] + samples[1][0] - 2.0 * samples[0][0] : 0.0;
    const clock_t begun = clock();
    if (times == 1) {
        puts("time,inline,cross,inline_std,cross_std");
    }
    for (long k = 0; k < times; ++k) {
        for (int i = 0; i < n; ++i) {
            const double t = samples[i][0] - samples[0][0] + (double)k * length;
            const int stepped = ragg_online_step(&o, t, samples[i] + 1, (double)NAN, samples[i][COLUMNS - 1]);
            if (stepped && times == 1) {
                const ragg_gradient g = ragg_online_gradient(&o);
                printf("%.17g,%.17g,%.17g,%.17g,%.17g\n", t, g.inline_Eo, g.cross_Eo, g.inline_std, g.cross_std);
            }
        }
    }
    if (times > 1) {
        const double seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
        fprintf(stderr, "%ld samples, %.3g microseconds a sample\n", times * n, 1e6 * seconds / (double)(times * n));
    }
    double p[ONLINE_PARAMETERS];
    ragg_online_parameters(&o, p);
    for (int k = 0; k < ONLINE_PARAMETERS; ++k) {
        printf("# %.17g\n", p[k]);
    }
    return 0;
}
