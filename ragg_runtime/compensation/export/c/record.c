/* See record.h. */
#include "record.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FIELDS = 4096 };

static const double ENDLESS = 1e100; /* beyond it a value counts as missing */
static const double UNEVEN = 0.01;   /* share of the interval by which a step may differ from whole intervals */
static const double JITTER = 1e-3;   /* from which Python resamples before it derives the angular acceleration */

enum { BAD = 2 };

void ragg_fail(const char *what, const char *where, const char *expected) {
    fprintf(stderr, "%s: %s: %s\n  expected: %s\n", ragg_program, where, what, expected);
    exit(BAD);
}

void *ragg_bigger(void *old, size_t count, size_t size) {
    void *found = count > (size_t)-1 / size ? NULL : realloc(old, count * size);
    if (!found) {
        ragg_fail("there is not enough memory", "standard input", "a shorter record");
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
            *buffer = ragg_bigger(*buffer, *room, 1);
        }
        (*buffer)[n++] = (char)c;
    }
    if (n == 0 && c == EOF) {
        return NULL;
    }
    if (!*buffer) {
        *room = 256;
        *buffer = ragg_bigger(NULL, *room, 1);
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
            ragg_fail("too many columns", "header", "at most 4096");
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
static void places_of(char *fields[], size_t count, int outputs, int place[COLUMNS]) {
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
        for (size_t k = 0; k < (outputs ? COLUMNS : FIRST_OUTPUT); ++k) {
            if (strcmp(COLUMN[k].name, fields[n]) != 0) {
                continue;
            }
            if (place[k] >= 0) {
                ragg_fail("the column appears twice", fields[n], "each column once");
            }
            if (!unit || !is_si(unit, COLUMN[k].units)) {
                ragg_fail(unit ? "the column is not in SI units" : "the column has no unit", fields[n],
                     strcmp(COLUMN[k].units, "*") == 0 ? "SI units without prefixes" : COLUMN[k].units);
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
        ragg_fail("not a number", where, "a number with a decimal point, or nothing where it is missing");
    }
    return fabs(x) < ENDLESS ? x : NAN;
}

/* The columns of the whole record: column[k] has n rows. Returns n. */
static size_t read_table(FILE *file, int outputs, double *table[COLUMNS], int place[COLUMNS]) {
    char *buffer = NULL, *line, *fields[MOST_FIELDS];
    size_t room = 0, rows = 0, capacity = 0;
    do {
        line = line_of(file, &buffer, &room);
        if (!line) {
            ragg_fail("the record is empty", "standard input", "a header of `name [unit]`, then rows of numbers");
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
    places_of(fields, width, outputs, place);
    while ((line = line_of(file, &buffer, &room))) {
        if (line[strspn(line, " ")] == '\0') {
            continue;
        }
        const size_t found = fields_of(line, delimiter, fields);
        if (found != width) {
            char where[64];
            snprintf(where, sizeof where, "row %zu after the header", rows + 1);
            ragg_fail("the row has the wrong number of values", where, "as many as the header");
        }
        if (rows == capacity) {
            capacity = 2 * capacity + 1024;
            for (size_t k = 0; k < COLUMNS; ++k) {
                table[k] = ragg_bigger(table[k], capacity, sizeof **table);
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

/* Derivatives by time, run by run of samples without a gap; the steps and their order are those of Python. */

/* Derivative of a run of n samples, rate in Hz: DERIVATIVE[k] weighs a window of samples at its sample k. Towards the end
 * of the run the window is that at its beginning, turned round. */
static void short_windows(size_t n, double rate, const double *x, int order, double *slope) {
    (void)order;
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

/* Weights of an odd (sign -1) or even (1) window at sample i of x, of those up to the middle one; pairs are joined first. */
static double weighed(const double *weights, size_t half, double sign, const double *x) {
    double sum = x[0] * weights[half];
    for (size_t k = half; k > 0; --k) {
        sum += (*(x - k) + sign * x[k]) * weights[half - k];
    }
    return sum;
}

static void long_windows(size_t n, double rate, const double *x, int order, double *slope) {
    short_windows(n, rate, x, order, slope);
    if (n <= 2 * REACH) {
        return;
    }
    double *level = ragg_bigger(NULL, n, sizeof *level);
    for (size_t i = 0; i < n; ++i) {
        level[i] = x[i] - x[0];
    }
    for (size_t i = REACH; i < n - REACH; ++i) {
        slope[i] = weighed(WIDE, REACH, -1.0, level + i) * rate;
    }
    free(level);
}

/* Gram polynomials of 2 half + 1 points at t, and their first two derivatives (Gorry, Anal. Chem. 62 (1990) 570). */
static void gram(double half, double t, int degree, double found[MOST_DEGREE + 1][3]) {
    for (int k = 0; k <= degree; ++k) {
        for (int s = 0; s < 3; ++s) {
            if (k == 0) {
                found[k][s] = s == 0 ? 1.0 : 0.0;
                continue;
            }
            const double whole = k * (2.0 * half - k + 1.0);
            const double a = (4.0 * k - 2.0) / whole, b = (k - 1.0) * (2.0 * half + k) / whole;
            const double below = s == 0 ? 0.0 : s * found[k - 1][s - 1], before = k > 1 ? found[k - 2][s] : 0.0;
            found[k][s] = a * (t * found[k - 1][s] + below) - b * before;
        }
    }
}

/* Weights of 2 half + 1 samples for the derivative at a sample counted from the middle one. */
static void polynomial_weights(int half, int at, int order, int degree, double *weights) {
    double there[MOST_DEGREE + 1][3], here[MOST_DEGREE + 1][3];
    gram(half, at, degree, there);
    for (int i = -half; i <= half; ++i) {
        double total = 0.0, below = 1.0, above = 2.0 * half + 1.0;
        gram(half, i, degree, here);
        for (int k = 0; k <= degree; ++k) {
            total = total + (2.0 * k + 1.0) * below / above * here[k][0] * there[k][order];
            below *= 2.0 * half - k;
            above = 1.0;
            for (int m = 0; m < k + 2; ++m) {
                above *= 2.0 * half + k + 2.0 - m;
            }
        }
        weights[i + half] = total;
    }
}

/* A step of an angle, in which whole turns may be missing. */
static double step_of(const double *angle, size_t i) {
    const double turn = 2.0 * 3.141592653589793, d = angle[i] - angle[i - 1];
    return d - turn * nearbyint(d / turn);
}

/* What an angle has beyond its mean step a sample, which is *steady. */
static double *swing_of(size_t n, const double *angle, double *steady) {
    double *found = ragg_bigger(NULL, n, sizeof *found), sum = 0.0;
    for (size_t i = 1; i < n; ++i) {
        sum += step_of(angle, i);
    }
    *steady = sum / (double)(n - 1);
    found[0] = 0.0;
    for (size_t i = 1; i < n; ++i) {
        found[i] = found[i - 1] + (step_of(angle, i) - *steady);
    }
    return found;
}

/* A middle weight that makes the sum of even ones zero. */
static void without_mean(int half, double *weights) {
    double sum = 0.0;
    for (int i = 0; i < half; ++i) {
        sum += weights[i];
    }
    weights[half] = -2.0 * sum;
}

/* Weights that tell the degrees apart: of each step's change of the second derivative, and, last, of what the highest leaves.
 * Returns how many degrees a window bears. */
static int choices(int half, double weights[DEGREES][2 * SPIN_MOST + 1]) {
    double next[2 * SPIN_MOST + 1];
    int degrees = 0;
    for (; degrees < DEGREES && DEGREE[degrees] < 2 * half; ++degrees) {
        polynomial_weights(half, 0, 2, DEGREE[degrees], next);
        without_mean(half, next);
        for (int i = 0; i <= 2 * half; ++i) {
            if (degrees > 0) {
                weights[degrees - 1][i] = next[i] - weights[degrees - 1][i];
            }
            weights[degrees][i] = next[i];
        }
    }
    if (degrees > 0) {
        polynomial_weights(half, 0, 0, DEGREE[degrees - 1], weights[degrees - 1]);
        without_mean(half, weights[degrees - 1]);
    }
    return degrees;
}

/* The degree with the least expected error of the second derivative (best_degree of ragg_runtime/signals/derivative.py). */
static int best_degree(size_t n, const double *x, int half) {
    double weights[DEGREES][2 * SPIN_MOST + 1], grows[DEGREES], noise = 0.0, error = 0.0, least = 0.0;
    const int degrees = n < 2 * (2 * (size_t)half + 1) ? 0 : choices(half, weights);
    int best = LEAST_DEGREE;
    for (int k = degrees - 1; k >= 0; --k) {
        double gain = 0.0, square = 0.0;
        for (int i = 0; i <= 2 * half; ++i) {
            gain += weights[k][i] * weights[k][i];
        }
        for (size_t i = (size_t)half; i + (size_t)half < n; ++i) {
            const double change = weighed(weights[k], (size_t)half, 1.0, x + i);
            square += change * change;
        }
        grows[k] = 2.0 * noise * gain - square;
        noise = noise > square / gain ? noise : square / gain;
    }
    for (int k = 0; k + 1 < degrees; ++k) {
        error += grows[k];
        if (error < least) {
            least = error;
            best = DEGREE[k + 1];
        }
    }
    return best;
}

static void smooth(size_t n, double rate, const double *angle, int order, double *slope) {
    const double wanted = nearbyint(SPIN_WINDOW * rate);
    double most = wanted > LEAST_DEGREE ? wanted : LEAST_DEGREE;
    most = most < SPIN_MOST ? most : SPIN_MOST;
    const size_t half = (double)((n - 1) / 2) < most ? (n - 1) / 2 : (size_t)most, window = 2 * half + 1;
    if (2 * half < LEAST_DEGREE) {
        for (size_t i = 0; i < n; ++i) {
            slope[i] = NAN;
        }
        return;
    }
    double weights[2 * SPIN_MOST + 1], steady, *x = swing_of(n, angle, &steady);
    const int degree = best_degree(n, x, (int)half);
    polynomial_weights((int)half, 0, order, degree, weights);
    if (order == 2) {
        without_mean((int)half, weights);
    }
    const double scale = order == 1 ? rate : rate * rate, level = order == 1 ? steady : 0.0;
    for (size_t i = half; i + half < n; ++i) {
        slope[i] = (weighed(weights, half, order == 1 ? -1.0 : 1.0, x + i) + level) * scale;
    }
    for (size_t k = 0; k < half; ++k) {
        for (int end = 0; end < 2; ++end) {
            double sum = 0.0;
            polynomial_weights((int)half, end ? (int)(half - k) : (int)k - (int)half, order, degree, weights);
            for (size_t i = 0; i < window; ++i) {
                sum += weights[i] * x[end ? n - window + i : i];
            }
            slope[end ? n - 1 - k : k] = (sum + level) * scale;
        }
    }
    free(x);
}

typedef void (*derivative)(size_t n, double rate, const double *x, int order, double *slope);

/* Each run of samples without a gap in x or in time by itself. */
static void by_runs(size_t n, double step, const double *time, const double *x, derivative of, int order, double *slope) {
    for (size_t a = 0, b; a < n; a = b) {
        if (isnan(x[a])) {
            slope[a] = NAN;
            b = a + 1;
            continue;
        }
        for (b = a + 1; b < n && !isnan(x[b]) && time[b] - time[b - 1] < 1.5 * step; ++b) {
        }
        of(b - a, 1.0 / step, x + a, order, slope + a);
    }
}

/* Of a series; runs shorter than a window have none (nan). */
static void differentiate(size_t n, double step, const double *time, const double *x, double *slope) {
    by_runs(n, step, time, x, short_windows, 1, slope);
}

/* Of an angular rate: amid a run by a longer window, good to 90 % of the Nyquist frequency. */
static void acceleration(size_t n, double step, const double *time, const double *x, double *slope) {
    by_runs(n, step, time, x, long_windows, 1, slope);
}

/* Rate (order 1) or acceleration (2) of an encoder's angle, rad, smoothed by polynomials. */
static void spin(size_t n, double step, const double *time, const double *angle, int order, double *slope) {
    by_runs(n, step, time, angle, smooth, order, slope);
}

/* The sampling interval; a derivative needs steps that differ from whole intervals by less than a share of one. */
static double interval(const ragg_record *r, double uneven, const char *remedy) {
    const double *time = r->column[TIME];
    if (r->n < 2) {
        ragg_fail("the record is too short", "standard input", "at least two rows");
    }
    double least = time[1] - time[0], step = 0.0;
    for (size_t i = 1; i < r->n; ++i) {
        const double d = time[i] - time[i - 1];
        if (!(d > 0.0)) {
            ragg_fail("the time does not increase", "time", "one row after the other");
        }
        least = d < least ? d : least;
    }
    size_t count = 0;
    for (size_t i = 1; i < r->n; ++i) {
        const double d = time[i] - time[i - 1];
        if (d < 1.5 * least) {
            step += d;
            ++count;
        }
    }
    step /= (double)count;
    for (size_t i = 1; i < r->n; ++i) {
        const double d = (time[i] - time[i - 1]) / step;
        if (fabs(d - nearbyint(d)) > uneven) {
            ragg_fail("the samples are not evenly spaced in time, and something must be differentiated", "time", remedy);
        }
    }
    return step;
}

/* Where the angular acceleration is not recorded it is derived from the rate, as Python does it. */
static void derive_acceleration(ragg_record *r) {
    int there = 0;
    for (int k = 0; OMEGADOT > 0 && k < 3; ++k) {
        there += r->there[OMEGADOT + k];
    }
    for (int k = 0; there > 0 && k < 3; ++k) {
        if (!r->there[OMEGADOT + k]) {
            ragg_fail("the column is missing", COLUMN[OMEGADOT + k].name,
                      "omegadot_x, omegadot_y and omegadot_z in rad/s^2, or none of them: then they are derived");
        }
    }
    if (there > 0 || OMEGADOT < 0) {
        return;
    }
    const double step = interval(r, JITTER, "even steps, or columns omegadot_x, omegadot_y, omegadot_z");
    for (int k = 0; k < 3; ++k) {
        acceleration(r->n, step, r->column[TIME], r->column[OMEGA + k], r->column[OMEGADOT + k]);
    }
}

static void derive_series(ragg_record *r) {
    int disc = 0, other = 0;
    for (size_t k = 0; k < INPUTS; ++k) {
        disc |= INPUT[k].column == DISC_ANGLE;
        other |= INPUT[k].column != DISC_ANGLE && INPUT[k].derivative > 0;
    }
    for (size_t d = 0; d < DISCS; ++d) {
        other |= disc && r->there[DISC[d].column];
    }
    const double step = other ? interval(r, UNEVEN, "even steps, or gaps of whole steps") : 1.0;
    for (size_t k = 0; k < INPUTS; ++k) {
        if (INPUT[k].column == DISC_ANGLE) {
            continue;
        }
        r->series[k] = r->column[INPUT[k].column];
        for (int order = 0; order < INPUT[k].derivative; ++order) {
            double *slope = ragg_bigger(NULL, r->n, sizeof *slope);
            differentiate(r->n, step, r->column[TIME], r->series[k], slope);
            r->series[k] = r->derived[r->count++] = slope;
        }
    }
    for (size_t d = 0; disc && d < DISCS; ++d) {
        for (int order = 1; order <= 2; ++order) {
            double *slope = ragg_bigger(NULL, r->n, sizeof *slope);
            r->spin[d][order - 1] = r->derived[r->count++] = slope;
            if (r->there[DISC[d].column]) {
                spin(r->n, step, r->column[TIME], r->column[DISC[d].column], order, slope);
                continue;
            }
            for (size_t i = 0; i < r->n; ++i) {
                slope[i] = order == 1 ? 2.0 * 3.141592653589793 * PARAMETER[DISC[d].spin] : 0.0;
            }
        }
    }
}

/* 2 pi frac(f t), with the rounding error of the product kept. */
static double turned(double f, double t) {
    const double turns = f * t;
    return 2.0 * 3.141592653589793 * ((turns - nearbyint(turns)) + fma(f, t, -turns));
}

/* The angles of discs without an encoder. */
static void derive_angles(ragg_record *r) {
    for (size_t d = 0; d < DISCS; ++d) {
        const int k = DISC[d].column;
        const double f = PARAMETER[DISC[d].spin], first = turned(f, FROM_FIRST ? 0.0 : r->column[TIME][0]);
        for (size_t i = 0; i < r->n && !r->there[k]; ++i) {
            r->column[k][i] = turned(f, r->seconds[i]) + first;
        }
    }
}

void ragg_read(ragg_record *r, FILE *file, int outputs) {
    int place[COLUMNS];
    memset(r, 0, sizeof *r);
    r->n = read_table(file, outputs, r->column, place);
    if (r->n == 0) {
        ragg_fail("the record holds no rows", "standard input", "rows of numbers after the header");
    }
    r->seconds = ragg_bigger(NULL, r->n, sizeof *r->seconds);
    for (size_t k = 0; k < COLUMNS; ++k) {
        r->there[k] = place[k] >= 0;
    }
    for (size_t i = 0; i < r->n; ++i) {
        if (isnan(r->column[TIME][i])) {
            ragg_fail("a time is missing", "time", "a time in every row");
        }
        r->seconds[i] = r->column[TIME][i] - r->column[TIME][0];
    }
    derive_acceleration(r);
    derive_series(r);
    derive_angles(r);
}

const double *ragg_inputs(const ragg_record *r, size_t output, size_t at, const double *in[INPUTS]) {
    const size_t disc = (size_t)OUTPUT[output].disc;
    for (size_t k = 0; k < INPUTS; ++k) {
        in[k] = (INPUT[k].column == DISC_ANGLE ? r->spin[disc][INPUT[k].derivative - 1] : r->series[k]) + at;
    }
    return r->column[DISC[disc].column] + at;
}

void ragg_free(ragg_record *r) {
    for (size_t k = 0; k < r->count; ++k) {
        free(r->derived[k]);
    }
    for (size_t k = 0; k < COLUMNS; ++k) {
        free(r->column[k]);
    }
    free(r->seconds);
}
