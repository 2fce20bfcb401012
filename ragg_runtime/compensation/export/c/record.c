/* See record.h. */
#include "record.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "derivative.h"

enum { MOST_FIELDS = 4096, MOST_CHARACTERS = 1 << 17 };

static const double ENDLESS = 1e100; /* beyond it a value counts as missing */
static const double UNEVEN = 0.01;   /* share of the interval by which a step may differ from whole intervals */
static const double JITTER = 1e-3;   /* from which Python resamples before it derives the angular acceleration */

void ragg_fail(const char *what, const char *where, const char *expected) {
    fprintf(stderr, "%s: %s: %s\n  expected: %s\n", ragg_program, where, what, expected);
    exit(2);
}

/* n numbers, old ones kept, or the end. */
static double *numbers(double *old, size_t n) {
    double *found = n > (size_t)-1 / sizeof *found ? NULL : realloc(old, n * sizeof *found);
    if (!found) {
        ragg_fail("there is not enough memory", "standard input", "a shorter record");
    }
    return found;
}

/* The next line that is not empty, its quotes as spaces; NULL at the end of the file. */
static char *line_of(FILE *file) {
    static char line[MOST_CHARACTERS];
    do {
        if (!fgets(line, sizeof line, file)) {
            return NULL;
        }
        if (!strchr(line, '\n') && !feof(file)) {
            ragg_fail("the line is too long", "standard input", "at most 131,070 characters");
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
static size_t fields_of(char *line, char delimiter, char *fields[MOST_FIELDS]) {
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
    ragg_fail("too many columns", "header", "at most 4096");
    return 0;
}

/* Whether a unit is one of those that a column takes, `a|b|c`. */
static int is_accepted(const char *unit, const char *accepted) {
    const size_t length = strlen(unit);
    for (const char *at = accepted; at; at = strchr(at, '|')) {
        at += *at == '|';
        if (strncmp(at, unit, length) == 0 && (at[length] == '|' || at[length] == '\0')) {
            return 1;
        }
    }
    return 0;
}

/* Which field of the header holds each column, -1: none. */
static void places_of(char *fields[], size_t count, int outputs, int place[COLUMNS]) {
    for (size_t k = 0; k < COLUMNS; ++k) {
        place[k] = -1;
    }
    for (size_t n = 0; n < count; ++n) {
        char *unit = strchr(fields[n], '[');
        if (unit) {
            *unit++ = '\0';
            unit[strcspn(unit, "]")] = '\0';
            unit = trim(unit);
        }
        const char *name = trim(fields[n]);
        for (size_t k = 0; k < (outputs ? COLUMNS : FIRST_OUTPUT); ++k) {
            if (strcmp(COLUMN[k].name, name) != 0) {
                continue;
            }
            if (place[k] >= 0) {
                ragg_fail("the column appears twice", name, "each column once");
            }
            if (!unit || !is_accepted(unit, COLUMN[k].units)) {
                ragg_fail(unit ? "the column is not in SI units" : "the column has no unit", name, COLUMN[k].units);
            }
            place[k] = (int)n;
        }
    }
    for (size_t k = 0; k < COLUMNS; ++k) {
        if (place[k] < 0 && COLUMN[k].needed) {
            ragg_fail("the column is missing", COLUMN[k].name, COLUMN[k].units);
        }
    }
}

/* A number; nan of nothing, and of words such as NA or null. */
static double number(const char *text, size_t row, const char *name) {
    char *end, where[128];
    const double x = strtod(text, &end);
    if (end == text && (*text == '\0' || strchr("nN", *text))) {
        return NAN;
    }
    if (*end != '\0') {
        snprintf(where, sizeof where, "row %zu after the header, column %.60s", row, name);
        ragg_fail("not a number", where, "a number with a decimal point, or nothing where it is missing");
    }
    return fabs(x) < ENDLESS ? x : (double)NAN;
}

static void read_table(ragg_record *r, FILE *file, int outputs) {
    char *fields[MOST_FIELDS], *line = line_of(file), where[64];
    int place[COLUMNS];
    if (line && strncmp(line, "\xef\xbb\xbf", 3) == 0) {
        memset(line, ' ', 3);
    }
    while (line && line[strspn(line, " ")] == '#') {
        line = line_of(file);
    }
    if (!line) {
        ragg_fail("the record is empty", "standard input", "a header of `name [unit]`, then rows of numbers");
    }
    const char *mark = strpbrk(line, ",;\t"), delimiter = mark ? *mark : ',';
    const size_t width = fields_of(line, delimiter, fields);
    places_of(fields, width, outputs, place);
    for (size_t capacity = 0; (line = line_of(file)); ++r->n) {
        if (fields_of(line, delimiter, fields) != width) {
            snprintf(where, sizeof where, "row %zu after the header", r->n + 1);
            ragg_fail("the row has the wrong number of values", where, "as many as the header");
        }
        if (r->n == capacity) {
            capacity = 2 * capacity + 1024;
            for (size_t k = 0; k < COLUMNS; ++k) {
                r->column[k] = numbers(r->column[k], capacity);
            }
        }
        for (size_t k = 0; k < COLUMNS; ++k) {
            r->there[k] = place[k] >= 0;
            r->column[k][r->n] = place[k] < 0 ? 0.0 : number(fields[place[k]], r->n + 1, COLUMN[k].name);
        }
    }
    if (r->n == 0) {
        ragg_fail("the record holds no rows", "standard input", "rows of numbers after the header");
    }
}

/* The sampling interval; a derivative needs steps that differ from whole intervals by less than a share of one. */
static double interval(const ragg_record *r, double uneven, const char *remedy) {
    const double *time = r->column[TIME];
    double least = INFINITY, step = 0.0, count = 0.0;
    for (size_t i = 1; i < r->n; ++i) {
        const double d = time[i] - time[i - 1];
        if (!(d > 0.0)) {
            ragg_fail("the time does not increase", "time", "one row after the other");
        }
        least = d < least ? d : least;
    }
    for (size_t i = 1; i < r->n; ++i) {
        const double d = time[i] - time[i - 1];
        step += d < 1.5 * least ? d : 0.0;
        count += d < 1.5 * least;
    }
    if (r->n < 2) {
        ragg_fail("the record is too short", "standard input", "at least two rows");
    }
    step /= count;
    for (size_t i = 1; i < r->n; ++i) {
        const double d = (time[i] - time[i - 1]) / step;
        if (fabs(d - nearbyint(d)) > uneven) {
            ragg_fail("the samples are not evenly spaced in time, and something must be differentiated", "time", remedy);
        }
    }
    return step;
}

enum kind { SLOPE, ACCELERATION, SPIN_RATE, SPIN_ACCELERATION };

/* Of a column, each run of samples without a gap in it or in time by itself; runs that are too short have none (nan). */
static double *derivative(const ragg_record *r, double step, const double *x, enum kind kind) {
    const double *time = r->column[TIME];
    double *slope = numbers(NULL, r->n), *room = numbers(NULL, r->n);
    for (size_t a = 0, b; a < r->n; a = b) {
        slope[a] = NAN;
        for (b = a + 1; b < r->n && !isnan(x[a]) && !isnan(x[b]) && time[b] - time[b - 1] < 1.5 * step; ++b) {
        }
        if (isnan(x[a])) {
            continue;
        }
        if (kind == SLOPE) {
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
static void derive_acceleration(ragg_record *r) {
    const int there = OMEGADOT < 0 ? 3 : r->there[OMEGADOT] + r->there[OMEGADOT + 1] + r->there[OMEGADOT + 2];
    const double step = there ? 0.0 : interval(r, JITTER, "even steps, or columns omegadot_x, omegadot_y, omegadot_z");
    for (int k = 0; k < 3 && there < 3; ++k) {
        if (there && !r->there[OMEGADOT + k]) {
            ragg_fail("the column is missing", COLUMN[OMEGADOT + k].name,
                      "omegadot_x, omegadot_y and omegadot_z in rad/s^2, or none of them: then they are derived");
        }
        if (!there) {
            free(r->column[OMEGADOT + k]);
            r->column[OMEGADOT + k] = derivative(r, step, r->column[OMEGA + k], ACCELERATION);
        }
    }
}

static void derive_inputs(ragg_record *r) {
    static const char *const remedy = "even steps, or gaps of whole steps";
    for (size_t k = 0; k < INPUTS; ++k) {
        if (INPUT[k].column == DISC_ANGLE) {
            for (size_t d = 0; d < DISCS; ++d) {
                const int encoder = r->there[DISC[d].column], order = INPUT[k].derivative;
                const double rate = order == 1 ? 2.0 * 3.141592653589793 * PARAMETER[DISC[d].spin] : 0.0;
                double *x = encoder ? derivative(r, interval(r, UNEVEN, remedy), r->column[DISC[d].column],
                                                 order == 1 ? SPIN_RATE : SPIN_ACCELERATION)
                                    : numbers(NULL, r->n);
                for (size_t i = 0; i < r->n && !encoder; ++i) {
                    x[i] = rate;
                }
                r->spin[d][order - 1] = x;
            }
            continue;
        }
        r->series[k] = r->column[INPUT[k].column];
        for (int order = 0; order < INPUT[k].derivative; ++order) {
            double *before = order ? r->series[k] : NULL;
            r->series[k] = derivative(r, interval(r, UNEVEN, remedy), r->series[k], SLOPE);
            free(before);
        }
    }
}

/* 2 pi frac(f t), with the rounding error of the product kept. */
static double turned(double f, double t) {
    const double turns = f * t;
    return 2.0 * 3.141592653589793 * ((turns - nearbyint(turns)) + fma(f, t, -turns));
}

void ragg_read(ragg_record *r, FILE *file, int outputs) {
    memset(r, 0, sizeof *r);
    read_table(r, file, outputs);
    r->seconds = numbers(NULL, r->n);
    for (size_t i = 0; i < r->n; ++i) {
        if (isnan(r->column[TIME][i])) {
            ragg_fail("a time is missing", "time", "a time in every row");
        }
        r->seconds[i] = r->column[TIME][i] - r->column[TIME][0];
    }
    derive_acceleration(r);
    derive_inputs(r);
    for (size_t d = 0; d < DISCS; ++d) {
        const double f = PARAMETER[DISC[d].spin], first = turned(f, FROM_FIRST ? 0.0 : r->column[TIME][0]);
        for (size_t i = 0; i < r->n && !r->there[DISC[d].column]; ++i) {
            r->column[DISC[d].column][i] = turned(f, r->seconds[i]) + first;
        }
    }
}

const double *ragg_inputs(const ragg_record *r, size_t output, size_t at, const double *in[INPUTS]) {
    const size_t disc = (size_t)OUTPUT[output].disc;
    for (size_t k = 0; k < INPUTS; ++k) {
        in[k] = (INPUT[k].column == DISC_ANGLE ? r->spin[disc][INPUT[k].derivative - 1] : r->series[k]) + at;
    }
    return r->column[DISC[disc].column] + at;
}
