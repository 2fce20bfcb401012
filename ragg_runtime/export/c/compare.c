/* compare ONE.csv OTHER.csv TOLERANCE: the largest difference of two series `time,G_out`; exit status 1 if it is larger. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(int count, char **arguments) {
    if (count != 4) {
        fprintf(stderr, "usage: compare ONE.csv OTHER.csv TOLERANCE\n");
        return 2;
    }
    FILE *files[2];
    char lines[2][256];
    for (int k = 0; k < 2; ++k) {
        files[k] = fopen(arguments[k + 1], "r");
        if (!files[k] || !fgets(lines[k], sizeof lines[k], files[k])) {
            fprintf(stderr, "compare: %s cannot be read\n", arguments[k + 1]);
            return 2;
        }
    }
    double largest = 0.0;
    size_t rows = 0;
    for (;; ++rows) {
        double time[2], G[2];
        int there = 0;
        for (int k = 0; k < 2; ++k) {
            if (fgets(lines[k], sizeof lines[k], files[k])) {
                ++there;
                if (sscanf(lines[k], "%lf,%lf", &time[k], &G[k]) != 2) {
                    fprintf(stderr, "compare: %s: row %zu is no pair of numbers\n", arguments[k + 1], rows + 1);
                    return 2;
                }
            }
        }
        if (there == 0) {
            break;
        }
        const double difference = there == 2 && time[0] == time[1] ? fabs(G[0] - G[1]) : INFINITY;
        if (!(difference <= largest)) {
            largest = isnan(difference) ? INFINITY : difference;
        }
    }
    const double tolerance = strtod(arguments[3], NULL);
    printf("%zu rows, largest difference %.3g V, allowed %.3g V\n", rows, largest, tolerance);
    return rows > 0 && largest <= tolerance ? 0 : 1;
}
