/* Uses the four generated models as a program of a user would: the instrument of Table V in the motion of
 * Table VI. Prints one line for each instant: t, G_out of the analytical, the simplified and the chain model,
 * dG_out/dK1 of A1, and A_0; then the signature of the first candidate effect in V_1. */
#include "analytical.h"
#include "chain.h"
#include "signatures.h"
#include "simplified.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 16, K1_OF_A1 = 30 };

static const double G0 = 9.8, ARCSEC = 4.84813681109536e-6, PI = 3.14159265358979323846;

int main(void) {
    /* One value of radius and spin frequency, then four of each, in the order of the header. */
    static const double table[][5] = { /* unit, A1 ... A4 */
        { 1e-6, 0, 30, 35, 25 },                                   /* dR */
        { 0, 21, 14, 17, 19 }, { 0, 18, 8, 10, 20 },               /* beta_x, beta_z, arcsec */
        { 0, 0, 0, 0, 0 }, { 0, 21, 10, 7, 19 }, { 0, 30, 19, 20, 9 }, /* vartheta_x, _y, _z, arcsec */
        { 9.8e-6, 10, 2, 5, 8 },                                   /* K0 */
        { 1e-3 / 9.8, 10, 11, 11.5, 12 },                          /* K1 */
        { 1e-6 / 9.8, 5, 1, 8, 7 }, { 1e-6 / 9.8, 6, 12, 5, 16 },  /* K2, K4 */
        { 1e-6 / 9.8, 4, 11, 9, 13 }, { 1e-6 / 9.8, 3, 12, 8, 10 }, /* K5, K6 */
        { 1e-6 / 9.8, 5, 15, 7, 17 }, { 1e-6 / 9.8, 0, 7, 11, 20 }, /* K7, K8 */
        { 1e9, 1, 1, 1, 1 },                                       /* k_VI */
    };
    double p[RAGG_ANALYTICAL_PARAMETERS] = { 0.1, 0.25 };
    for (size_t k = 0; k < sizeof table / sizeof table[0]; ++k) {
        const double unit = table[k][0] > 0 ? table[k][0] : ARCSEC;
        for (size_t j = 0; j < 4; ++j) {
            p[2 + 4 * k + j] = unit * table[k][1 + j];
        }
    }

    double t[N], motion[RAGG_ANALYTICAL_INPUTS][N];
    const double *in[RAGG_SIGNATURES_INPUTS];
    const double mean[6] = { 0.08 * G0, 0.06 * G0, 0.1 * G0, 1000 * ARCSEC, 1500 * ARCSEC, 2000 * ARCSEC };
    const double wave[6] = { 0.005 * G0, 0.006 * G0, 0.05 * G0, 700 * ARCSEC, 900 * ARCSEC, 800 * ARCSEC };
    const double spin = 2 * PI * p[1];
    for (size_t i = 0; i < N; ++i) {
        t[i] = 1e5 + 0.3 * (double)i;
        for (size_t k = 0; k < 6; ++k) { /* deg/h = arcsec/s */
            motion[k][i] = mean[k] + wave[k] * sin(spin * t[i]);
        }
        for (size_t k = 6; k < 9; ++k) {
            motion[k][i] = wave[k - 3] * spin * cos(spin * t[i]);
        }
        for (size_t k = 9; k < RAGG_ANALYTICAL_INPUTS; ++k) {
            motion[k][i] = 1e-9 * (double)(100 * k);
        }
    }
    /* The signatures need more than the motion: derivatives and auxiliary channels, here zero. */
    static const double zero[N];
    for (size_t k = 0; k < RAGG_SIGNATURES_INPUTS; ++k) {
        in[k] = k < RAGG_ANALYTICAL_INPUTS ? motion[k] : zero;
    }
    static double q[RAGG_SIGNATURES_PARAMETERS]; /* candidates are at their neutral values: zero */
    for (size_t k = 0; k < RAGG_ANALYTICAL_PARAMETERS; ++k) {
        q[k] = p[k];
    }

    double analytical[N], simplified[N], chain[N];
    ragg_analytical_output(N, t, in, p, NULL, analytical);
    ragg_simplified_output(N, t, in, p, NULL, simplified);
    ragg_chain_output(N, t, in, p, NULL, chain);

    /* On the heap and just large enough, so that a sanitizer sees a row too many. */
    double *J = malloc(sizeof(double) * RAGG_ANALYTICAL_PARAMETERS * N);
    double *D = malloc(sizeof(double) * RAGG_SIGNATURES_ROWS * N);
    if (!J || !D) {
        free(J);
        free(D);
        return 1;
    }
    ragg_analytical_jacobian(N, t, in, p, NULL, J);
    ragg_signatures_derivatives(0, N, t, in, q, NULL, D);
    for (size_t i = 0; i < N; ++i) {
        double x[RAGG_ANALYTICAL_INPUTS], A[RAGG_ANALYTICAL_AMPLITUDES];
        for (size_t k = 0; k < RAGG_ANALYTICAL_INPUTS; ++k) {
            x[k] = in[k][i];
        }
        ragg_analytical_amplitudes(x, p, A);
        printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", t[i], analytical[i], simplified[i], chain[i],
               J[K1_OF_A1 * N + i], A[0], D[i]);
    }
    free(J);
    free(D);
    return 0;
}
