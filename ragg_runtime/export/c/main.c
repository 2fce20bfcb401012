/* ragg_model < MOTION.csv > OUT.csv: the output of the gradiometer, G_out in V, from a record of its motion.
 *
 * MOTION.csv has a header, one `name [unit]` a column, in SI units; the columns that are needed stand in values.h, others
 * are passed over. Where omegadot is not there it is the derivative of omega; gradients that are not there are zero.
 * Without spin_angle the disc angle is 2 pi spin_frequency t from the first row on. OUT.csv: time,G_out with 17 digits;
 * nan where a value that is needed is missing. Exit status: 0 done, 2 bad input (one message on stderr). */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "values.h"

enum { BAD = 2, BLOCK = 4096, MOST_FIELDS = 4096 };

static const double ENDLESS = 1e100; /* beyond it a value counts as missing */
static const double UNEVEN = 0.01;   /* share of the interval by which a step may differ from whole intervals */

static void fail(const char *what, const char *where, const char *expected) {
    fprintf(stderr, "ragg_model: %s: %s\n  expected: %s\n", where, what, expected);
    exit(BAD);
}

static void *bigger(void *old, size_t count, size_t size) {
    void *found = count > (size_t)-1 / size ? NULL : realloc(old, count * size);
    if (!found) {
        fail("there is not enough memory", "standard input", "a shorter record");
    }
    return found;
}

/* One line without its end, in a buffer that grows; NULL at the end of the file. */
static char *line_of(FILE *file, char **buffer, size_t *room) {
    size_t n = 0;
    int c;
    while ((c = getc(file)) != EOF && c != '\n') {
        if (n + 2 > *room) {
            *room = 2 * *room + 256;
            *buffer = bigger(*buffer, *room, 1);
        }
        (*buffer)[n++] = (char)c;
    }
    if (n == 0 && c == EOF) {
        return NULL;
    }
    if (!*buffer) {
        *room = 256;
        *buffer = bigger(NULL, *room, 1);
    }
    if (n > 0 && (*buffer)[n - 1] == '\r') {
        --n;
    }
    (*buffer)[n] = '\0';
    return *buffer;
}

/* Cut a line at its delimiters in place; spaces and quotes around a field are dropped. Returns how many fields. */
static size_t fields_of(char *line, char delimiter, char *fields[MOST_FIELDS]) {
    size_t n = 0;
    for (char *at = line;; ++at) {
        while (*at == ' ' || (*at == '\t' && delimiter != '\t')) {
            ++at;
        }
        const int quoted = *at == '"';
        char *begin = at += quoted;
        while (*at && (quoted ? *at != '"' : *at != delimiter)) {
            ++at;
        }
        char *end = at;
        while (*at && *at != delimiter) {
            ++at;
        }
        const int last = *at == '\0';
        while (end > begin && isspace((unsigned char)end[-1])) {
            --end;
        }
        *end = '\0';
        if (n == MOST_FIELDS) {
            fail("too many columns", "header", "at most 4096");
        }
        fields[n++] = begin;
        if (last) {
            return n;
        }
    }
}

/* Whether a unit is one of those that a column takes, `a|b|c`; `*`: any product of SI units without prefixes. */
static int is_si(const char *unit, const char *accepted) {
    static const char *const symbols[] = {"m",   "s", "kg", "A", "K", "mol", "cd", "rad",
                                          "sr",  "N", "J",  "W", "V", "T",   "Pa", "Hz",
                                          "ohm", "C", "F",  "H", "Wb"};
    if (strcmp(accepted, "*") != 0) {
        const size_t length = strlen(unit);
        for (const char *at = accepted; at; at = strchr(at, '|')) {
            at += *at == '|';
            if (strncmp(at, unit, length) == 0 && (at[length] == '|' || at[length] == '\0')) {
                return 1;
            }
        }
        return 0;
    }
    for (const char *at = unit; *at;) {
        if (!isalpha((unsigned char)*at)) {
            if (!strchr("0123456789^*/.-+ ()", *at)) {
                return 0;
            }
            ++at;
            continue;
        }
        size_t length = 1, known = 0;
        while (isalpha((unsigned char)at[length])) {
            ++length;
        }
        for (size_t k = 0; k < sizeof symbols / sizeof *symbols; ++k) {
            known |= strlen(symbols[k]) == length && strncmp(symbols[k], at, length) == 0;
        }
        if (!known) {
            return 0;
        }
        at += length;
    }
    return *unit != '\0';
}

/* Which field of the header holds each column, -1: none. */
static void places_of(char *fields[], size_t count, int place[COLUMNS]) {
    for (size_t k = 0; k < COLUMNS; ++k) {
        place[k] = -1;
    }
    for (size_t n = 0; n < count; ++n) {
        char *bracket = strchr(fields[n], '['), *unit = NULL;
        if (bracket) {
            unit = bracket + 1;
            char *close = strchr(unit, ']');
            if (close) {
                *close = '\0';
            }
            while (isspace((unsigned char)*unit)) {
                ++unit;
            }
            for (char *end = unit + strlen(unit); end > unit && isspace((unsigned char)end[-1]);) {
                *--end = '\0';
            }
            *bracket = '\0';
            while (bracket > fields[n] && isspace((unsigned char)bracket[-1])) {
                *--bracket = '\0';
            }
        }
        for (size_t k = 0; k < COLUMNS; ++k) {
            if (strcmp(COLUMN[k].name, fields[n]) != 0) {
                continue;
            }
            if (place[k] >= 0) {
                fail("the column stands there twice", fields[n], "each column once");
            }
            if (!unit || !is_si(unit, COLUMN[k].units)) {
                fail(unit ? "the column is not in SI units" : "the column has no unit", fields[n],
                     strcmp(COLUMN[k].units, "*") == 0 ? "SI units without prefixes" : COLUMN[k].units);
            }
            place[k] = (int)n;
        }
    }
    for (size_t k = 0; k < COLUMNS; ++k) {
        if (place[k] < 0 && COLUMN[k].absent == NEEDED) {
            fail("the column is missing", COLUMN[k].name, COLUMN[k].units);
        }
    }
}

static int is_missing(const char *text) {
    static const char *const words[] = {"", "nan", "NaN", "NAN", "NA", "N/A", "null", "NULL", "None"};
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
        if (strcmp(text, words[k]) == 0) {
            return 1;
        }
    }
    return 0;
}

static double number(const char *text, size_t row, const char *name) {
    if (is_missing(text)) {
        return NAN;
    }
    char *end;
    const double x = strtod(text, &end);
    if (end == text || *end != '\0') {
        char where[128];
        snprintf(where, sizeof where, "row %zu after the header, column %.60s", row, name);
        fail("not a number", where, "a number with a decimal point, or nothing where it is missing");
    }
    return fabs(x) < ENDLESS ? x : NAN;
}

/* The columns of the whole record: table[k] has n rows. Returns n. */
static size_t read_table(FILE *file, double *table[COLUMNS], int place[COLUMNS]) {
    char *buffer = NULL, *line, *fields[MOST_FIELDS];
    size_t room = 0, rows = 0, capacity = 0;
    do {
        line = line_of(file, &buffer, &room);
        if (!line) {
            fail("the record is empty", "standard input", "a header of `name [unit]`, then rows of numbers");
        }
        if (strncmp(line, "\xef\xbb\xbf", 3) == 0) {
            line += 3;
        }
    } while (line[0] == '#' || line[strspn(line, " \t")] == '\0');
    size_t counts[3] = {0, 0, 0};
    for (const char *at = line; *at; ++at) {
        counts[0] += *at == ',', counts[1] += *at == ';', counts[2] += *at == '\t';
    }
    const char delimiter = counts[1] > counts[0] && counts[1] >= counts[2] ? ';' : counts[2] > counts[0] ? '\t' : ',';
    const size_t width = fields_of(line, delimiter, fields);
    places_of(fields, width, place);
    while ((line = line_of(file, &buffer, &room))) {
        if (line[strspn(line, " ")] == '\0') {
            continue;
        }
        const size_t found = fields_of(line, delimiter, fields);
        if (found != width) {
            char where[64];
            snprintf(where, sizeof where, "row %zu after the header", rows + 1);
            fail("the row has the wrong number of values", where, "as many as the header");
        }
        if (rows == capacity) {
            capacity = 2 * capacity + 1024;
            for (size_t k = 0; k < COLUMNS; ++k) {
                table[k] = bigger(table[k], capacity, sizeof **table);
            }
        }
        for (size_t k = 0; k < COLUMNS; ++k) {
            table[k][rows] = place[k] < 0 ? 0.0 : number(fields[place[k]], rows + 1, COLUMN[k].name);
        }
        ++rows;
    }
    free(buffer);
    return rows;
}

/* Derivative of a run of n samples, rate in Hz: DERIVATIVE[k] weighs a window of samples at its sample k. Towards the end
 * of the run the window is that at its beginning, turned round. */
static void differentiate_run(size_t n, double rate, const double *x, double *slope) {
    const size_t half = WINDOW / 2;
    for (size_t i = 0; i < n; ++i) {
        slope[i] = NAN;
        if (n < WINDOW) {
            continue;
        }
        const int turned = i + half >= n;
        const size_t at = turned ? n - 1 - i : i < half ? i : half;
        double sum = 0.0;
        for (size_t k = 0; k < WINDOW; ++k) {
            sum += DERIVATIVE[at][k] * (x[turned ? n - 1 - k : i - at + k] - x[0]);
        }
        slope[i] = (turned ? -sum : sum) * rate;
    }
}

/* The same of each run of samples without a gap in x or in time; runs shorter than a window have none. */
static void differentiate(size_t n, double step, const double *time, const double *x, double *slope) {
    for (size_t a = 0, b; a < n; a = b) {
        if (isnan(x[a])) {
            slope[a] = NAN;
            b = a + 1;
            continue;
        }
        for (b = a + 1; b < n && !isnan(x[b]) && time[b] - time[b - 1] < 1.5 * step; ++b) {
        }
        differentiate_run(b - a, 1.0 / step, x + a, slope + a);
    }
}

/* The sampling interval; a derivative needs an even one. */
static double interval(size_t n, const double *time) {
    if (n < 2) {
        fail("the record is too short", "standard input", "at least two rows");
    }
    double least = time[1] - time[0], step = 0.0;
    for (size_t i = 1; i < n; ++i) {
        const double d = time[i] - time[i - 1];
        if (!(d > 0.0)) {
            fail("the time does not increase", "time", "one row after the other");
        }
        least = d < least ? d : least;
    }
    size_t count = 0;
    for (size_t i = 1; i < n; ++i) {
        const double d = time[i] - time[i - 1];
        if (d < 1.5 * least) {
            step += d;
            ++count;
        }
    }
    step /= (double)count;
    for (size_t i = 1; i < n; ++i) {
        const double d = (time[i] - time[i - 1]) / step;
        if (fabs(d - nearbyint(d)) > UNEVEN) {
            fail("the samples are not evenly spaced in time, and something must be differentiated", "time",
                 "even steps, or gaps of whole steps");
        }
    }
    return step;
}

/* The parameters that are built in: name, value, unit. */
static int tell(void) {
    for (size_t k = 0; k < PARAMETERS; ++k) {
        printf("%s = %.17g %s\n", PARAMETER_NAME[k], PARAMETER[k], PARAMETER_UNIT[k]);
    }
    return fflush(stdout) == 0 ? 0 : 1;
}

int main(int count, char **arguments) {
    if (count == 2 && strcmp(arguments[1], "--values") == 0) {
        return tell();
    }
    if (count > 1) {
        fail("unknown argument", arguments[1], "ragg_model < MOTION.csv > OUT.csv, or ragg_model --values");
    }
    double *table[COLUMNS] = {NULL}, *series[INPUTS] = {NULL}, *slopes[2 * INPUTS] = {NULL};
    int place[COLUMNS];
    const size_t n = read_table(stdin, table, place);
    if (n == 0) {
        fail("the record holds no rows", "standard input", "rows of numbers after the header");
    }
    double *time = table[TIME], *seconds = bigger(NULL, n, sizeof *seconds);
    for (size_t i = 0; i < n; ++i) {
        if (isnan(time[i])) {
            fail("a time is missing", "time", "a time in every row");
        }
        seconds[i] = time[i] - time[0];
    }
    int needed = 0;
    for (size_t k = 0; k < COLUMNS; ++k) {
        needed |= place[k] < 0 && COLUMN[k].absent >= 0;
    }
    for (size_t k = 0; k < INPUTS; ++k) {
        needed |= INPUT[k].derivative > 0;
    }
    const double step = needed ? interval(n, time) : 1.0;
    for (size_t k = 0; k < COLUMNS; ++k) {
        if (place[k] < 0 && COLUMN[k].absent >= 0) {
            differentiate(n, step, time, table[COLUMN[k].absent], table[k]);
        }
    }
    size_t derived = 0;
    for (size_t k = 0; k < INPUTS; ++k) {
        series[k] = table[INPUT[k].column];
        for (int order = 0; order < INPUT[k].derivative; ++order) {
            double *slope = bigger(NULL, n, sizeof *slope);
            differentiate(n, step, time, series[k], slope);
            series[k] = slopes[derived++] = slope;
        }
    }
    if (puts("time,G_out") < 0) {
        return 1;
    }
    static double G[BLOCK];
    const double *in[INPUTS];
    for (size_t at = 0; at < n; at += BLOCK) {
        const size_t size = n - at < BLOCK ? n - at : BLOCK;
        for (size_t k = 0; k < INPUTS; ++k) {
            in[k] = series[k] + at;
        }
        MODEL(size, seconds + at, in, PARAMETER, place[SPIN_ANGLE] < 0 ? NULL : table[SPIN_ANGLE] + at, G);
        for (size_t i = 0; i < size; ++i) {
            int whole = place[SPIN_ANGLE] < 0 || !isnan(table[SPIN_ANGLE][at + i]);
            for (size_t k = 0; k < INPUTS; ++k) {
                whole = whole && !isnan(in[k][i]);
            }
            if (printf("%.17g,%.17g\n", time[at + i], whole ? G[i] : (double)NAN) < 0) {
                return 1;
            }
        }
    }
    for (size_t k = 0; k < derived; ++k) {
        free(slopes[k]);
    }
    for (size_t k = 0; k < COLUMNS; ++k) {
        free(table[k]);
    }
    free(seconds);
    return fflush(stdout) == 0 ? 0 : 1;
}
