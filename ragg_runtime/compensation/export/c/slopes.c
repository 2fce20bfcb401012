/* See slopes.h. */
#include "slopes.h"

#include <math.h>
#include <stdlib.h>

#include "fail.h"
#include "values.h"

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

void ragg_differentiate(size_t n, double step, const double *time, const double *x, double *slope) {
    by_runs(n, step, time, x, short_windows, 1, slope);
}

void ragg_acceleration(size_t n, double step, const double *time, const double *x, double *slope) {
    by_runs(n, step, time, x, long_windows, 1, slope);
}

void ragg_spin(size_t n, double step, const double *time, const double *angle, int order, double *slope) {
    by_runs(n, step, time, angle, smooth, order, slope);
}
