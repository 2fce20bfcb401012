/* compare ONE.csv OTHER.csv TOLERANCE: the largest difference of the numbers of two tables; exit status 1 if it is larger. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 16384 };

int main(int count, char **arguments) {
    if (count != 4) {
        fprintf(stderr, "usage: compare ONE.csv OTHER.csv TOLERANCE\n");
        return 2;
    }
    FILE *files[2];
    static char lines[2][MOST];
    for (int k = 0; k < 2; ++k) {
        files[k] = fopen(arguments[k + 1], "r");
        if (!files[k] || !fgets(lines[k], MOST, files[k])) {
            fprintf(stderr, "compare: %s cannot be read\n", arguments[k + 1]);
            return 2;
        }
    }
    double largest = strcmp(lines[0], lines[1]) == 0 ? 0.0 : INFINITY; /* the same columns */
    size_t rows = 0;
    for (;; ++rows) {
        char *one = fgets(lines[0], MOST, files[0]), *other = fgets(lines[1], MOST, files[1]);
        if (!one && !other) {
            break;
        }
        for (int more = 1; more;) {
            char *ends[2] = {one, other};
            const double a = one ? strtod(one, &ends[0]) : INFINITY, b = other ? strtod(other, &ends[1]) : 0.0;
            const double difference = fabs(a - b);
            if (!(difference <= largest)) {
                largest = isnan(difference) ? INFINITY : difference;
            }
            more = one && other && ends[0] > one && ends[1] > other && *ends[0] == ',' && *ends[1] == ',';
            if (one && other && !more && (ends[0] == one || *ends[0] != *ends[1])) {
                largest = INFINITY; /* no number, or not as many */
            }
            one = more ? ends[0] + 1 : one;
            other = more ? ends[1] + 1 : other;
        }
    }
    const double tolerance = strtod(arguments[3], NULL);
    printf("%zu rows, largest difference %.3g V, allowed %.3g V\n", rows, largest, tolerance);
    return rows > 0 && largest <= tolerance ? 0 : 1;
}
