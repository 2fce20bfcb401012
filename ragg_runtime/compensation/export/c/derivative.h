/* Derivatives by time of a run of n evenly spaced samples, rate in Hz: what Python does (ragg_runtime/signals/derivative.py). */
#ifndef RAGG_DERIVATIVE_H
#define RAGG_DERIVATIVE_H

#include <math.h>
#include <stddef.h>

#include "values.h"

static const double TURN = 6.283185307179586;

/* By least squares over WINDOW samples; towards the end of the run the window is that at its beginning, turned round. */
static void short_slope(size_t n, double rate, const double *x, double *slope) {
    const size_t half = WINDOW / 2;
    for (size_t i = 0; i < n; ++i) {
        const int turned = i + half >= n;
        const size_t at = turned ? n - 1 - i : i < half ? i : half;
        double sum = n < WINDOW ? (double)NAN : 0.0;
        for (size_t k = 0; k < WINDOW && n >= WINDOW; ++k) {
            sum += DERIVATIVE[at][k] * (x[turned ? n - 1 - k : i - at + k] - x[0]);
        }
        slope[i] = (turned ? -sum : sum) * rate;
    }
}

/* Weights of an odd (sign -1) or even (1) window at a sample, of those up to the middle one; pairs are joined first. */
static double weigh(const double *weights, size_t half, double sign, const double *x, double level) {
    double sum = (x[0] - level) * weights[half];
    for (size_t k = half; k > 0; --k) {
        sum += ((*(x - k) - level) + sign * (x[k] - level)) * weights[half - k];
    }
    return sum;
}

/* Of an angular rate: amid the run by a longer window, good to 90 % of the Nyquist frequency. */
static void long_slope(size_t n, double rate, const double *x, double *slope) {
    short_slope(n, rate, x, slope);
    for (size_t i = REACH; i + REACH < n; ++i) {
        slope[i] = weigh(WIDE, REACH, -1.0, x + i, x[0]) * rate;
    }
}

/* Gram polynomials of 2 half + 1 points at t, and their first two derivatives (Gorry, Anal. Chem. 62 (1990) 570). */
static void gram(double half, double t, int degree, double found[MOST_DEGREE + 1][3]) {
    found[0][0] = 1.0;
    found[0][1] = found[0][2] = 0.0;
    for (int k = 1; k <= degree; ++k) {
        const double whole = k * (2.0 * half - k + 1.0);
        const double a = (4.0 * k - 2.0) / whole, b = (k - 1.0) * (2.0 * half + k) / whole;
        for (int s = 0; s < 3; ++s) {
            const double below = s == 0 ? 0.0 : s * found[k - 1][s - 1], before = k > 1 ? found[k - 2][s] : 0.0;
            found[k][s] = a * (t * found[k - 1][s] + below) - b * before;
        }
    }
}

/* Weights of 2 half + 1 samples for the derivative at a sample counted from the middle one; of even weights about the middle one
 * itself makes the sum zero. */
static void polynomial_weights(int half, int at, int order, int degree, double *weights) {
    double there[MOST_DEGREE + 1][3], here[MOST_DEGREE + 1][3], sum = 0.0;
    gram(half, at, degree, there);
    for (int i = -half; i <= half; ++i) {
        double total = 0.0, below = 1.0;
        gram(half, i, degree, here);
        for (int k = 0; k <= degree; ++k) {
            double above = 2.0 * half + k + 1.0;
            for (int m = 1; m <= k; ++m) {
                above *= 2.0 * half + k + 1.0 - m;
            }
            total += (2.0 * k + 1.0) * below / above * here[k][0] * there[k][order];
            below *= 2.0 * half - k;
        }
        weights[i + half] = total;
        sum += i < 0 ? total : 0.0;
    }
    if (at == 0 && order != 1) {
        weights[half] = -2.0 * sum;
    }
}

/* The degree with the least expected error of the second derivative. */
static int best_degree(size_t n, const double *x, int half) {
    double weights[2 * SPIN_MOST + 1], next[2 * SPIN_MOST + 1], grows[DEGREES], noise = 0.0, error = 0.0, least = 0.0;
    int degrees = 0, best = LEAST_DEGREE;
    while (degrees < DEGREES && DEGREE[degrees] < 2 * half && n >= 2 * (2 * (size_t)half + 1)) {
        ++degrees;
    }
    for (int k = degrees - 1; k >= 0; --k) {
        const int last = k == degrees - 1; /* what the highest degree leaves; else what a step of the degree changes */
        double gain = 0.0, square = 0.0;
        polynomial_weights(half, 0, last ? 0 : 2, DEGREE[k], weights);
        polynomial_weights(half, 0, 2, DEGREE[last ? k : k + 1], next);
        for (int i = 0; i <= 2 * half; ++i) {
            weights[i] = last ? weights[i] : next[i] - weights[i];
            gain += weights[i] * weights[i];
        }
        for (size_t i = (size_t)half; i + (size_t)half < n; ++i) {
            const double change = weigh(weights, (size_t)half, 1.0, x + i, 0.0);
            square += change * change;
        }
        grows[k] = 2.0 * noise * gain - square;
        noise = fmax(noise, square / gain);
    }
    for (int k = 0; k + 1 < degrees; ++k) {
        error += grows[k];
        best = error < least ? DEGREE[k + 1] : best;
        least = fmin(error, least);
    }
    return best;
}

/* Rate (order 1) or acceleration (2) of an encoder's angle, rad, in which whole turns may be missing, by polynomials through the
 * samples around each. x holds n numbers: what the angle has beyond its mean step. */
static void smooth_slope(size_t n, double rate, const double *angle, int order, double *slope, double *x) {
    const size_t most = (size_t)fmax(LEAST_DEGREE, fmin(nearbyint(SPIN_WINDOW * rate), SPIN_MOST));
    const size_t half = (n - 1) / 2 < most ? (n - 1) / 2 : most;
    double weights[2 * SPIN_MOST + 1], steady = 0.0;
    for (size_t i = 1; i < n; ++i) {
        const double d = angle[i] - angle[i - 1];
        x[i] = d - TURN * nearbyint(d / TURN);
        steady += x[i];
    }
    steady /= (double)(n - 1);
    x[0] = 0.0;
    for (size_t i = 1; i < n; ++i) {
        x[i] = x[i - 1] + (x[i] - steady);
    }
    const int short_ = 2 * half < LEAST_DEGREE, degree = short_ ? 0 : best_degree(n, x, (int)half);
    for (size_t i = 0; i < n; ++i) {
        const int inside = i >= half && i + half < n;
        const size_t first = i < half ? 0 : inside ? i - half : n - 1 - 2 * half;
        if (i <= half || !inside) { /* amid the run the weights are always the same */
            polynomial_weights((int)half, (int)i - (int)(first + half), order, degree, weights);
        }
        double sum = inside ? weigh(weights, half, order == 1 ? -1.0 : 1.0, x + i, 0.0) : 0.0;
        for (size_t k = 0; k <= 2 * half && !inside; ++k) {
            sum += weights[k] * x[first + k];
        }
        slope[i] = short_ ? (double)NAN : order == 1 ? (sum + steady) * rate : sum * rate * rate;
    }
}

#endif
