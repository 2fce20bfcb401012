/* ragg_model < MOTION.csv > OUT.csv: the outputs of the gradiometer, V, from a record of its motion.
 *
 * MOTION.csv has a header, one `name [unit]` a column, in SI units; the columns that are needed stand in values.h, others are
 * passed over. Gradients that are not there are zero; omegadot, where it is not there, is derived from omega as Python
 * derives it; without a disc's encoder its angle is 2 pi spin_frequency t, from t = 0 or from the first row (FROM_FIRST).
 *
 * OUT.csv: time and the outputs with 17 digits; nan where a value that is needed is missing. With --check TOLERANCE the record
 * holds the outputs as well: exit status 1 if they differ by more, V. Exit status 2: bad input, one message on stderr. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "derivative.h"
#include "values.h"

enum { MOST_FIELDS = 4096, MOST_CHARACTERS = 1 << 17 };

static const double ENDLESS = 1e20; /* from there on a value counts as missing */
static const double UNEVEN = 0.01;  /* share of the interval by which a step may differ from whole intervals */
static const double JITTER = 1e-3;  /* from which Python resamples before it derives the angular acceleration */

/* The record, a number a row: nan where a value is missing, 0 where a column is. */
static size_t rows;
static double *column[COLUMNS], *seconds;
static int there[COLUMNS];
/* The inputs of the model; rate and acceleration of the discs' angles. */
static double *series[INPUTS], *spin[DISCS][2];

static void fail(const char *what, const char *where, const char *expected) {
    fprintf(stderr, "ragg_model: %s: %s\n  expected: %s\n", where, what, expected);
    exit(2);
}

/* n numbers, old ones kept, or the end. */
static double *numbers(double *old, size_t n) {
    double *found = n > (size_t)-1 / sizeof *found ? NULL : realloc(old, n * sizeof *found);
    if (!found) {
        fail("there is not enough memory", "standard input", "a shorter record");
    }
    return found;
}

/* The next line that is not empty, its quotes as spaces; NULL at the end. */
static char *next_line(void) {
    static char line[MOST_CHARACTERS];
    do {
        if (!fgets(line, sizeof line, stdin)) {
            return NULL;
        }
        if (!strchr(line, '\n') && !feof(stdin)) {
            fail("the line is too long", "standard input", "at most 131,070 characters");
        }
        for (char *quote = strchr(line, '"'); quote; quote = strchr(quote, '"')) {
            *quote = ' ';
        }
    } while (line[strspn(line, " \t\r\n")] == '\0');
    return line;
}

/* Text without spaces around it, cut off in place. */
static char *trim(char *text) {
    text += strspn(text, " \t\r\n");
    for (char *end = text + strlen(text); end > text && isspace((unsigned char)end[-1]);) {
        *--end = '\0';
    }
    return text;
}

/* Cut a line at its delimiters in place. Returns how many fields. */
static size_t cut(char *line, char delimiter, char *fields[MOST_FIELDS]) {
    for (size_t n = 0; n < MOST_FIELDS;) {
        char *end = strchr(line, delimiter);
        if (end) {
            *end = '\0';
        }
        fields[n++] = trim(line);
        if (!end) {
            return n;
        }
        line = end + 1;
    }
    fail("too many columns", "header", "at most 4096");
    return 0;
}

/* Which field of the header holds each column; those that none does are left as they are, -1. */
static void find_columns(char *fields[], size_t count, int outputs, int place[COLUMNS]) {
    char spelt[64], accepted[256];
    for (size_t n = 0; n < count; ++n) {
        char *unit = strchr(fields[n], '[');
        if (unit) {
            *unit++ = '\0';
            unit[strcspn(unit, "]")] = '\0';
            snprintf(spelt, sizeof spelt, "|%.60s|", trim(unit));
        }
        const char *name = trim(fields[n]);
        for (size_t k = 0; k < (outputs ? COLUMNS : FIRST_OUTPUT); ++k) {
            if (strcmp(COLUMN[k].name, name) != 0) {
                continue;
            }
            if (place[k] >= 0) {
                fail("the column appears twice", name, "each column once");
            }
            snprintf(accepted, sizeof accepted, "|%s|", COLUMN[k].units);
            if (!unit || !strstr(accepted, spelt)) {
                fail(unit ? "the column is not in SI units" : "the column has no unit", name, COLUMN[k].units);
            }
            place[k] = (int)n;
        }
    }
    for (size_t k = 0; k < COLUMNS; ++k) {
        there[k] = place[k] >= 0;
        if (!there[k] && COLUMN[k].needed) {
            fail("the column is missing", COLUMN[k].name, COLUMN[k].units);
        }
    }
}

/* A number of a column; nan of nothing, of words such as NA or null, and of codes of missing values. */
static double number(const char *text, size_t of) {
    char *end, where[128];
    const double x = strtod(text, &end);
    if (end == text && (*text == '\0' || strchr("nN", *text))) {
        return NAN;
    }
    if (*end != '\0') {
        snprintf(where, sizeof where, "row %zu after the header, column %.60s", rows + 1, COLUMN[of].name);
        fail("not a number", where, "a number with a decimal point, or nothing where it is missing");
    }
    int missing = !(fabs(x) < ENDLESS);
    for (size_t k = 0; k < CODES; ++k) {
        const double off = fabs(x - CODE[k].value);
        missing |= (CODE[k].column < 0 ? of != TIME : CODE[k].column == (int)of) && off <= 1e-6 * fabs(CODE[k].value);
    }
    return missing ? (double)NAN : x;
}

static void read_table(int outputs) {
    char *fields[MOST_FIELDS], *line = next_line(), where[64];
    int place[COLUMNS];
    memset(place, -1, sizeof place);
    if (line && strncmp(line, "\xef\xbb\xbf", 3) == 0) {
        memset(line, ' ', 3);
    }
    while (line && line[strspn(line, " ")] == '#') {
        line = next_line();
    }
    if (!line) {
        fail("the record is empty", "standard input", "a header of `name [unit]`, then rows of numbers");
    }
    const char *mark = strpbrk(line, ",;\t"), delimiter = mark ? *mark : ',';
    const size_t width = cut(line, delimiter, fields);
    find_columns(fields, width, outputs, place);
    for (size_t capacity = 0; (line = next_line()); ++rows) {
        if (cut(line, delimiter, fields) != width) {
            snprintf(where, sizeof where, "row %zu after the header", rows + 1);
            fail("the row has the wrong number of values", where, "as many as the header");
        }
        if (rows == capacity) {
            capacity = 2 * capacity + 1024;
            for (size_t k = 0; k < COLUMNS; ++k) {
                column[k] = numbers(column[k], capacity);
            }
        }
        for (size_t k = 0; k < COLUMNS; ++k) {
            column[k][rows] = there[k] ? number(fields[place[k]], k) : 0.0;
        }
    }
    if (rows == 0) {
        fail("the record holds no rows", "standard input", "rows of numbers after the header");
    }
}

/* The sampling interval; a derivative needs steps that differ from whole intervals by less than a share of one. */
static double interval(double uneven, const char *remedy) {
    const double *time = column[TIME];
    double least = INFINITY, step = 0.0, count = 0.0;
    if (rows < 2) {
        fail("the record is too short", "standard input", "at least two rows");
    }
    for (size_t i = 1; i < rows; ++i) {
        if (!(time[i] > time[i - 1])) {
            fail("the time does not increase", "time", "one row after the other");
        }
        least = fmin(least, time[i] - time[i - 1]);
    }
    for (size_t i = 1; i < rows; ++i) {
        const double d = time[i] - time[i - 1];
        step += d < 1.5 * least ? d : 0.0;
        count += d < 1.5 * least;
    }
    step /= count;
    for (size_t i = 1; i < rows; ++i) {
        const double d = (time[i] - time[i - 1]) / step;
        if (fabs(d - nearbyint(d)) > uneven) {
            fail("the samples are not evenly spaced in time, and something must be differentiated", "time", remedy);
        }
    }
    return step;
}

enum kind { SLOPE, ACCELERATION, SPIN_RATE, SPIN_ACCELERATION };

/* Of a column, each run of samples without a gap in it or in time by itself; runs that are too short have none (nan). */
static double *derivative(double step, const double *x, enum kind kind) {
    const double *time = column[TIME];
    double *slope = numbers(NULL, rows), *room = numbers(NULL, rows);
    for (size_t a = 0, b; a < rows; a = b) {
        for (b = a + 1; b < rows && !isnan(x[a]) && !isnan(x[b]) && time[b] - time[b - 1] < 1.5 * step; ++b) {
        }
        if (isnan(x[a])) {
            slope[a] = NAN;
        } else if (kind == SLOPE) {
            short_slope(b - a, 1.0 / step, x + a, slope + a);
        } else if (kind == ACCELERATION) {
            long_slope(b - a, 1.0 / step, x + a, slope + a);
        } else {
            smooth_slope(b - a, 1.0 / step, x + a, kind == SPIN_RATE ? 1 : 2, slope + a, room);
        }
    }
    free(room);
    return slope;
}

/* Where the angular acceleration is not recorded it is derived from the rate, as Python does it. */
static void derive_acceleration(void) {
    const int found = OMEGADOT < 0 ? 3 : there[OMEGADOT] + there[OMEGADOT + 1] + there[OMEGADOT + 2];
    const double step = found ? 0.0 : interval(JITTER, "even steps, or columns omegadot_x, omegadot_y, omegadot_z");
    for (int k = OMEGADOT; k < OMEGADOT + 3 && found < 3; ++k) {
        if (!found) {
            free(column[k]);
            column[k] = derivative(step, column[k - OMEGADOT + OMEGA], ACCELERATION);
        } else if (!there[k]) {
            fail("the column is missing", COLUMN[k].name,
                 "omegadot_x, omegadot_y and omegadot_z in rad/s^2, or none of them: then they are derived");
        }
    }
}

/* Rate (order 1) or acceleration (2) of a disc's angle: of its encoder, or steady. */
static double *spin_of(size_t disc, int order, const char *remedy) {
    const size_t encoder = (size_t)DISC[disc].column;
    if (there[encoder]) {
        return derivative(interval(UNEVEN, remedy), column[encoder], order == 1 ? SPIN_RATE : SPIN_ACCELERATION);
    }
    double *x = numbers(NULL, rows);
    for (size_t i = 0; i < rows; ++i) {
        x[i] = order == 1 ? TURN * PARAMETER[DISC[disc].spin] : 0.0;
    }
    return x;
}

static void derive_inputs(void) {
    static const char *const remedy = "even steps, or gaps of whole steps";
    for (size_t k = 0; k < INPUTS; ++k) {
        if (INPUT[k].column == DISC_ANGLE) {
            for (size_t d = 0; d < DISCS; ++d) {
                spin[d][INPUT[k].derivative - 1] = spin_of(d, INPUT[k].derivative, remedy);
            }
            continue;
        }
        series[k] = column[INPUT[k].column];
        for (int order = 0; order < INPUT[k].derivative; ++order) {
            double *before = order ? series[k] : NULL;
            series[k] = derivative(interval(UNEVEN, remedy), series[k], SLOPE);
            free(before);
        }
    }
}

/* 2 pi frac(f t), with the rounding error of the product kept. */
static double turned(double f, double t) {
    const double turns = f * t;
    return TURN * ((turns - nearbyint(turns)) + fma(f, t, -turns));
}

static void read_record(int outputs) {
    read_table(outputs);
    seconds = numbers(NULL, rows);
    for (size_t i = 0; i < rows; ++i) {
        if (isnan(column[TIME][i])) {
            fail("a time is missing", "time", "a time in every row");
        }
        seconds[i] = column[TIME][i] - column[TIME][0];
    }
    derive_acceleration();
    derive_inputs();
    for (size_t d = 0; d < DISCS; ++d) {
        const double f = PARAMETER[DISC[d].spin], first = turned(f, FROM_FIRST ? 0.0 : column[TIME][0]);
        for (size_t i = 0; i < rows && !there[DISC[d].column]; ++i) {
            column[DISC[d].column][i] = turned(f, seconds[i]) + first;
        }
    }
}

/* An output at all rows, V. */
static double *predict(size_t which) {
    const size_t disc = (size_t)OUTPUT[which].disc;
    const double *in[INPUTS];
    double *G = numbers(NULL, rows);
    for (size_t k = 0; k < INPUTS; ++k) {
        in[k] = INPUT[k].column == DISC_ANGLE ? spin[disc][INPUT[k].derivative - 1] : series[k];
    }
    MODEL(which, rows, seconds, in, PARAMETER, column[DISC[disc].column], G);
    return G;
}

static int write_outputs(double *const G[OUTPUTS]) {
    fputs("time", stdout);
    for (size_t k = 0; k < OUTPUTS; ++k) {
        printf(",%s", OUTPUT[k].name);
    }
    for (size_t i = 0; i < rows; ++i) {
        printf("\n%.17g", column[TIME][i]);
        for (size_t k = 0; k < OUTPUTS; ++k) {
            printf(",%.17g", G[k][i]);
        }
    }
    puts("");
    return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 2;
}

static int check(double *const G[OUTPUTS], double tolerance) {
    double largest = 0.0;
    for (size_t i = 0; i < rows; ++i) {
        for (size_t k = 0; k < OUTPUTS; ++k) {
            const double gap = fabs(G[k][i] - column[FIRST_OUTPUT + k][i]);
            largest = gap <= largest ? largest : isnan(gap) ? (double)INFINITY : gap;
        }
    }
    printf("%zu rows, largest difference %.3g V, allowed %.3g V\n", rows, largest, tolerance);
    return largest <= tolerance ? 0 : 1;
}

int main(int count, char **arguments) {
    static double *G[OUTPUTS];
    if (count == 2 && strcmp(arguments[1], "--values") == 0) {
        for (size_t k = 0; k < PARAMETERS; ++k) {
            printf("%s = %.17g %s\n", PARAMETER_LABEL[k].name, PARAMETER[k], PARAMETER_LABEL[k].unit);
        }
        return 0;
    }
    const int checks = count == 3 && strcmp(arguments[1], "--check") == 0;
    if (count > 1 && !checks) {
        fail("unknown argument", arguments[1], "--values, --check TOLERANCE, or none");
    }
    read_record(checks);
    for (size_t k = 0; k < OUTPUTS; ++k) {
        G[k] = predict(k);
    }
    return checks ? check(G, strtod(arguments[2], NULL)) : write_outputs(G);
}
