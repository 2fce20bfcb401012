/* See online.h. The steps and their order are those of ragg_runtime.compensation.recursive (ragg). */
#include "chain.h"

#include "online.h"

#include <math.h>
#include <string.h>

enum { FITTED_N = FITTED_PARAMETERS, STATES = RAGG_ONLINE_STATES, WIDTH = RAGG_ONLINE_WIDTH };

static const double UPDATE = 0.25;     /* s; the gradient takes a step of its walk */
static const double FADE = 10.0;       /* s; the parameters forget a step */
static const double STEEPER = 2.0;     /* walk of inline over that of cross */
static const double UNKNOWN_EO = 1e4;  /* of the gradient before anything is known */

/* Turn row and into, both zero before column first, so that row vanishes there; four columns at a time, for vectors. */
static void turn(double *restrict into, double *restrict row, int first) {
    if (row[first] == 0.0) {
        return;
    }
    const double length = sqrt(into[first] * into[first] + row[first] * row[first]);
    const double once = 1.0 / length, c = into[first] * once, s = row[first] * once;
    for (int k = first / 4 * 4; k < WIDTH; k += 4) {
        for (int m = k; m < k + 4; ++m) {
            const double x = into[m], y = row[m];
            into[m] = c * x + s * y;
            row[m] = c * y - s * x;
        }
    }
    row[first] = 0.0;
}

/* One more row of the least squares. */
static void fold(ragg_online *o, double row[WIDTH], int first) {
    for (int i = first; i < STATES; ++i) {
        turn(o->R[i], row, i);
    }
}

/* g' = g + w, w of variance walk^2 t (inline STEEPER times the walk): w is eliminated, column by column, from the last row up, so that the triangle stays. */
static void walk(ragg_online *o, double t) {
    double own[2][WIDTH] = {{0.0}}, coupled[STATES][2], pivot[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
    for (int k = 0; k < 2; ++k) {
        pivot[k][k] = 1.0 / ((k == 0 ? STEEPER : 1.0) * o->walk * sqrt(t));
    }
    for (int i = 0; i < STATES; ++i) {
        for (int k = 0; k < 2; ++k) {
            coupled[i][k] = -o->R[i][FITTED_N + k];
        }
    }
    for (int k = 0; k < 2; ++k) {
        for (int i = STATES - 1; i >= 0; --i) {
            if (coupled[i][k] == 0.0) {
                continue;
            }
            const double length = sqrt(pivot[k][k] * pivot[k][k] + coupled[i][k] * coupled[i][k]);
            const double c = pivot[k][k] / length, s = coupled[i][k] / length;
            for (int m = k; m < 2; ++m) {
                const double x = pivot[k][m], y = coupled[i][m];
                pivot[k][m] = c * x + s * y;
                coupled[i][m] = c * y - s * x;
            }
            double *restrict into = own[k], *restrict row = o->R[i];
            for (int m = i; m < WIDTH; ++m) {
                const double x = into[m], y = row[m];
                into[m] = c * x + s * y;
                row[m] = c * y - s * x;
            }
        }
    }
}

/* What flights said fades; what the sheet says comes back. */
static void fade(ragg_online *o, double t) {
    const double kept = exp(-t / o->forget);
    if (kept == 1.0) {
        return;
    }
    for (int i = 0; i < STATES; ++i) {
        for (int k = i; k < WIDTH; ++k) {
            o->R[i][k] *= sqrt(kept);
        }
    }
    for (int i = 0; i < FITTED_N; ++i) {
        double row[WIDTH] = {0.0};
        row[i] = sqrt(1.0 - kept);
        row[STATES] = sqrt(1.0 - kept) * FITTED[o->output][i].sheet;
        fold(o, row, i);
    }
}

void ragg_online_start(ragg_online *o, int output, double noise, double walk_, double forget) {
    memset(o, 0, sizeof *o);
    o->output = output, o->noise = noise, o->walk = walk_, o->forget = forget;
    for (int i = 0; i < FITTED_N; ++i) {
        for (int k = i; k < FITTED_N; ++k) {
            o->R[i][k] = START[output][i * FITTED_N - i * (i - 1) / 2 + k - i];
        }
        o->R[i][STATES] = START_AT_SHEET ? FITTED[output][i].sheet : 0.0;
    }
    for (int i = FITTED_N; i < STATES; ++i) {
        o->R[i][i] = 1.0 / UNKNOWN_EO;
    }
}

/* The sample as a row; 0 where something in it is no number. */
static int row_of(const ragg_online *o, double t, const double in[ONLINE_INPUTS], double angle, double G, double row[WIDTH]) {
    const double *series[ONLINE_INPUTS], *encoder = isnan(angle) ? NULL : &angle;
    const int output = o->output;
    enum { MEMBERS = sizeof MEMBER[0] / sizeof MEMBER[0][0] };
    double predicted, D[MEMBERS][RAGG_CHAIN_ROWS];
    for (int k = 0; k < ONLINE_INPUTS; ++k) {
        series[k] = in + k;
    }
    PREDICT((size_t)ONLINE_OUTPUT[output].which, &t, series, POINT, encoder, &predicted);
    for (int m = 0; m < ONLINE_OUTPUT[output].members; ++m) {
        ragg_chain_derivatives((size_t)MEMBER[output][m].j, 1, &t, series, POINT, encoder, D[m]);
    }
    for (int n = 0; n < FITTED_N; ++n) {
        const int own = FITTED[output][n].accelerometer, k = FITTED[output][n].row;
        row[n] = 0.0;
        for (int m = 0; m < ONLINE_OUTPUT[output].members; ++m) {
            if (own == -1 || own == MEMBER[output][m].j) {
                row[n] += MEMBER[output][m].sign * FITTED[output][n].scale * D[m][k];
            }
        }
    }
    const double turns = POINT[SPIN[output]] * t;
    const double phi = encoder ? angle : 6.283185307179586 * (turns - rint(turns));
    const double carrier = 2.0 * phi + ONLINE_OUTPUT[output].phase;
    row[FITTED_N] = 0.5 * ONLINE_OUTPUT[output].scale_factor * sin(carrier);
    row[FITTED_N + 1] = -ONLINE_OUTPUT[output].scale_factor * cos(carrier);
    row[STATES] = G - predicted;
    for (int k = STATES + 1; k < WIDTH; ++k) {
        row[k] = 0.0;
    }
    int whole = 1;
    for (int k = 0; k < WIDTH; ++k) {
        row[k] /= o->noise;
        whole = whole && isfinite(row[k]);
    }
    return whole;
}

int ragg_online_step(ragg_online *o, double t, const double in[ONLINE_INPUTS], double angle, double G) {
    const double dt = o->begun ? t - o->before : 0.0;
    int stepped = 0;
    o->begun = 1, o->before = t;
    o->waited += dt, o->faded += dt;
    if (o->waited >= UPDATE) {
        if (o->walk > 0.0) {
            walk(o, o->waited);
        }
        o->waited = 0.0;
        stepped = 1;
    }
    if (o->faded >= FADE) {
        fade(o, o->faded);
        o->faded = 0.0;
    }
    double row[WIDTH];
    if (row_of(o, t, in, angle, G, row)) {
        fold(o, row, 0);
    }
    return stepped;
}

ragg_gradient ragg_online_gradient(const ragg_online *o) {
    const double a = o->R[FITTED_N][FITTED_N], b = o->R[FITTED_N][FITTED_N + 1], c = o->R[FITTED_N + 1][FITTED_N + 1];
    ragg_gradient g;
    g.cross_Eo = o->R[FITTED_N + 1][STATES] / c;
    g.inline_Eo = (o->R[FITTED_N][STATES] - b * g.cross_Eo) / a;
    g.cross_std = 1.0 / fabs(c);
    g.inline_std = sqrt(1.0 / (a * a) + (b / (a * c)) * (b / (a * c)));
    return g;
}

void ragg_online_parameters(const ragg_online *o, double p[ONLINE_PARAMETERS]) {
    double x[STATES];
    for (int i = STATES - 1; i >= 0; --i) {
        double sum = o->R[i][STATES];
        for (int k = i + 1; k < STATES; ++k) {
            sum -= o->R[i][k] * x[k];
        }
        x[i] = sum / o->R[i][i];
    }
    memcpy(p, POINT, sizeof POINT);
    for (int n = 0; n < FITTED_N; ++n) {
        p[FITTED[o->output][n].place] += x[n] * FITTED[o->output][n].scale;
    }
}
