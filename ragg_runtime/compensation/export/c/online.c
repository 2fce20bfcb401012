/* See online.h. The filter is that of ragg_runtime.compensation.recursive (ragg), the gradient before the parameters. */
#include "chain.h"

#include "online.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { INLINE = 0, CROSS = 1, PARAMETER_0 = 2, STATES = RAGG_ONLINE_STATES, WIDTH = RAGG_ONLINE_WIDTH };

static const double UPDATE = 0.25;     /* s; the gradient takes a step of its walk */
static const double FADE = 10.0;       /* s; the parameters forget a step */
static const double STEEPER = 2.0;     /* walk of inline over that of cross */
static const double UNKNOWN_EO = 1e4; /* of the gradient before anything is known */
static const double LEAST = 1e-100;   /* information that may be left of a state: what divides by it stays a number */

/* One more row of the least squares, of a right-hand side of this variance, with zeros before column first: rotations without
 * roots (Gentleman, J. Inst. Math. Appl. 12 (1973) 329) turn it into the triangle. */
static void fold(ragg_online *o, double *restrict row, double variance, int first) {
    for (int i = first; i < STATES; ++i) {
        double *restrict U = o->U[i];
        const double x = row[i], share = x / o->D[i];
        o->D[i] += x * x / variance;
        variance += share * x;
        const double step = share / variance;
        for (int k = i; k < WIDTH; ++k) {
            row[k] -= x * U[k];
            U[k] += step * row[k];
        }
    }
}

/* g' = g + w, w of variance walk^2 t (inline STEEPER times the walk): the gradient stands before the parameters, so that its
 * two rows alone change. */
static void walk(ragg_online *o, double t) {
    const double cross = o->walk * o->walk * t, inline_ = STEEPER * STEEPER * cross;
    double *D = o->D, *restrict into = o->U[0], *restrict from = o->U[1];
    const double kept = 1.0 / (1.0 + cross * D[1]), coupling = into[1], share = coupling * cross * D[1] * kept;
    for (int k = 1; k < WIDTH; ++k) {
        into[k] -= share * from[k];
    }
    D[0] = 1.0 / (1.0 / D[0] + inline_ + coupling * coupling * cross * kept);
    D[1] *= kept;
}

/* What flights said fades; what the sheet says comes back. */
static void fade(ragg_online *o, double t) {
    const double kept = exp(-t / o->forget);
    if (kept == 1.0) {
        return;
    }
    for (int i = 0; i < STATES; ++i) {
        o->D[i] = o->D[i] * kept + LEAST;
    }
    for (int i = 0; i < STATES; ++i) {
        double row[WIDTH] = {0.0};
        row[i] = i < PARAMETER_0 ? 1.0 / UNKNOWN_EO : 1.0;
        row[STATES] = i < PARAMETER_0 ? 0.0 : FITTED[o->output][i - PARAMETER_0].sheet;
        fold(o, row, 1.0 / (1.0 - kept), i);
    }
}

void ragg_online_start(ragg_online *o, int output, double noise, double walk_, double forget) {
    memset(o, 0, sizeof *o);
    o->output = output, o->noise = noise, o->walk = walk_, o->forget = forget;
    for (int i = 0; i < STATES; ++i) {
        o->U[i][i] = 1.0;
        o->D[i] = i < PARAMETER_0 ? 1.0 / (UNKNOWN_EO * UNKNOWN_EO) : 1.0;
    }
    const double *root = START[output];
    for (int i = PARAMETER_0; i < STATES; ++i) {
        o->D[i] = *root * *root;
        for (int k = STATES - 1; k >= i; --k) {
            o->U[i][k] = root[k - i] / *root;
        }
        root += STATES - i;
    }
}

/* The sample as a row; 0 where something in it is no number. */
static int row_of(const ragg_online *o, double t, const double in[ONLINE_INPUTS], double angle, double G, double *restrict row) {
    const double *series[ONLINE_INPUTS], *encoder = isnan(angle) ? NULL : &angle;
    const int output = o->output;
    const int first = SPAN[output].first, count = SPAN[output].count;
    double predicted = 0.0, V[ACCELEROMETERS], D[RAGG_CHAIN_ROWS * ACCELEROMETERS];
    for (int k = 0; k < ONLINE_INPUTS; ++k) {
        series[k] = in + k;
    }
    ragg_chain_sample((size_t)first, (size_t)count, &t, series, POINT, encoder, V, D);
    for (int m = 0; m < ONLINE_OUTPUT[output].members; ++m) {
        predicted += MEMBER[output][m].sign * V[MEMBER[output][m].j - first];
    }
    for (int n = 0; n < FITTED_PARAMETERS; ++n) {
        const int own = FITTED[output][n].member, k = FITTED[output][n].row;
        double sum = 0.0;
        for (int m = own < 0 ? 0 : own; m < (own < 0 ? ONLINE_OUTPUT[output].members : own + 1); ++m) {
            sum += MEMBER[output][m].sign * FITTED[output][n].scale * D[k * count + MEMBER[output][m].j - first];
        }
        row[PARAMETER_0 + n] = sum;
    }
    const double turns = POINT[SPIN[output]] * t;
    const double phi = encoder ? angle : 6.283185307179586 * (turns - rint(turns));
    const double carrier = 2.0 * phi + ONLINE_OUTPUT[output].phase;
    row[INLINE] = 0.5 * ONLINE_OUTPUT[output].scale_factor * sin(carrier);
    row[CROSS] = -ONLINE_OUTPUT[output].scale_factor * cos(carrier);
    row[STATES] = G - predicted;
    int whole = 1;
    for (int k = 0; k < WIDTH; ++k) {
        whole &= fabs(row[k]) <= DBL_MAX;
    }
    return whole;
}

int ragg_online_step(ragg_online *o, double t, const double in[ONLINE_INPUTS], double angle, double G) {
    if (!isfinite(t)) {
        return 0;
    }
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
    double row[WIDTH] = {0.0};
    if (row_of(o, t, in, angle, G, row)) {
        fold(o, row, o->noise * o->noise, 0);
    }
    return stepped;
}

ragg_gradient ragg_online_gradient(const ragg_online *o) {
    /* Rows of the inverse of the triangle, of inline and of cross: what they leave of the right-hand side is the state, and their
     * squares over D are its variance. */
    double one[WIDTH] = {[INLINE] = 1.0}, other[WIDTH] = {[CROSS] = 1.0}, square[2] = {0.0, 0.0};
    for (int i = 0; i < STATES; ++i) {
        const double a = one[i], b = other[i];
        square[0] += a * a / o->D[i];
        square[1] += b * b / o->D[i];
        for (int k = i; k < WIDTH; ++k) {
            one[k] -= a * o->U[i][k];
            other[k] -= b * o->U[i][k];
        }
    }
    const ragg_gradient g = {-one[STATES], -other[STATES], sqrt(square[0]), sqrt(square[1])};
    return g;
}

void ragg_online_parameters(const ragg_online *o, double p[ONLINE_PARAMETERS]) {
    double x[STATES];
    memcpy(p, POINT, sizeof POINT);
    for (int i = STATES - 1; i >= PARAMETER_0; --i) {
        x[i] = o->U[i][STATES];
        for (int k = i + 1; k < STATES; ++k) {
            x[i] -= o->U[i][k] * x[k];
        }
        const int n = i - PARAMETER_0;
        p[FITTED[o->output][n].place] += x[i] * FITTED[o->output][n].scale;
    }
}
