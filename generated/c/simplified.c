/* The simplified analytical model of the RAGG (paper, Eq. 42-47).
 * Derived; do not edit: change the derivation and run `make derive`. */
#include "simplified.h"

#include <math.h>

enum { AMPLITUDES = 5, FOLDED = 45, BASIS = 29, SLOPES = 14 };

/* Disc angle, rad, within half a turn of 0; the turns are dropped exactly, whatever the time. */
static double disc_angle(double t, double spin_frequency) {
    const double turns = spin_frequency * t;
    const double error = fma(spin_frequency, t, -turns);
    return 6.283185307179586476925286766559 * ((turns - nearbyint(turns)) + error);
}

static double D12(const double x[4]) { return x[0] - x[1]; }
static double D34(const double x[4]) { return x[2] - x[3]; }
static double D1234(const double x[4]) { return (x[0] + x[1]) - (x[2] + x[3]); }
static double Sigma(const double x[4]) { return (x[0] + x[1]) + (x[2] + x[3]); }

/* Error-propagation coefficients: all that the instrument's parameters contribute. */
static void fold(const double *p, double c[FOLDED]) {
    double e[28][4];
    for (size_t j = 0; j < 4; ++j) {
        const double radius = p[0];
        const double dR = p[2 + j];
        const double beta_x = p[6 + j];
        const double beta_z = p[10 + j];
        const double vartheta_x = p[14 + j];
        const double vartheta_y = p[18 + j];
        const double vartheta_z = p[22 + j];
        const double K0 = p[26 + j];
        const double K1 = p[30 + j];
        const double K2 = p[34 + j];
        const double K4 = p[38 + j];
        const double K5 = p[42 + j];
        const double K6 = p[46 + j];
        const double K7 = p[50 + j];
        const double K8 = p[54 + j];
        const double k_VI = p[58 + j];
        const double R = radius + dR, k1 = k_VI * K1;
        (void)vartheta_x;

        e[0][j] = K0*k1;
        e[1][j] = k1*(-beta_x*vartheta_z + vartheta_y);
        e[2][j] = -R*k1*vartheta_z;
        e[3][j] = R*k1;
        e[4][j] = (0.5*k1)*(K2 + K5);
        e[5][j] = K7*k1;
        e[6][j] = k1*(beta_x*vartheta_y - beta_z + vartheta_z);
        e[7][j] = k1;
        e[8][j] = beta_z*k1*vartheta_z;
        e[9][j] = k1*(-beta_x*vartheta_y + beta_z - vartheta_z);
        e[10][j] = R*k1*vartheta_y;
        e[11][j] = -R*k1*vartheta_y;
        e[12][j] = -R*beta_x*k1;
        e[13][j] = -K8*k1;
        e[14][j] = -K4*k1;
        e[15][j] = K8*k1;
        e[16][j] = -k1;
        e[17][j] = -beta_z*k1*vartheta_z;
        e[18][j] = R*beta_x*k1;
        e[19][j] = K4*k1;
        e[20][j] = (R*k1)*(2.0*beta_z - vartheta_z);
        e[21][j] = (0.5*k1)*(-K2 + K5);
        e[22][j] = K6*k1;
        e[23][j] = (0.5*k1)*(K2 - K5);
        e[24][j] = (R*k1)*(-2.0*beta_z + vartheta_z);
        e[25][j] = -0.5*K6*k1;
        e[26][j] = k1*(-K2 + K5);
        e[27][j] = 0.5*K6*k1;
    }
    c[0] = D1234(e[0]); /* K0*k1 */
    c[1] = D1234(e[1]); /* k1*(-beta_x*vartheta_z + vartheta_y) */
    c[2] = D1234(e[2]); /* -R*k1*vartheta_z */
    c[3] = D1234(e[3]); /* R*k1 */
    c[4] = D1234(e[4]); /* (0.5*k1)*(K2 + K5) */
    c[5] = D1234(e[4]); /* (0.5*k1)*(K2 + K5) */
    c[6] = D1234(e[5]); /* K7*k1 */
    c[7] = D12(e[6]); /* k1*(beta_x*vartheta_y - beta_z + vartheta_z) */
    c[8] = D34(e[7]); /* k1 */
    c[9] = D34(e[8]); /* beta_z*k1*vartheta_z */
    c[10] = D12(e[7]); /* k1 */
    c[11] = D12(e[8]); /* beta_z*k1*vartheta_z */
    c[12] = D34(e[9]); /* k1*(-beta_x*vartheta_y + beta_z - vartheta_z) */
    c[13] = D34(e[10]); /* R*k1*vartheta_y */
    c[14] = D12(e[11]); /* -R*k1*vartheta_y */
    c[15] = D34(e[12]); /* -R*beta_x*k1 */
    c[16] = D12(e[12]); /* -R*beta_x*k1 */
    c[17] = D12(e[13]); /* -K8*k1 */
    c[18] = D34(e[14]); /* -K4*k1 */
    c[19] = D12(e[14]); /* -K4*k1 */
    c[20] = D34(e[15]); /* K8*k1 */
    c[21] = D12(e[16]); /* -k1 */
    c[22] = D12(e[17]); /* -beta_z*k1*vartheta_z */
    c[23] = D34(e[6]); /* k1*(beta_x*vartheta_y - beta_z + vartheta_z) */
    c[24] = D12(e[6]); /* k1*(beta_x*vartheta_y - beta_z + vartheta_z) */
    c[25] = D34(e[7]); /* k1 */
    c[26] = D34(e[8]); /* beta_z*k1*vartheta_z */
    c[27] = D12(e[11]); /* -R*k1*vartheta_y */
    c[28] = D34(e[11]); /* -R*k1*vartheta_y */
    c[29] = D12(e[18]); /* R*beta_x*k1 */
    c[30] = D34(e[12]); /* -R*beta_x*k1 */
    c[31] = D12(e[19]); /* K4*k1 */
    c[32] = D34(e[13]); /* -K8*k1 */
    c[33] = D12(e[13]); /* -K8*k1 */
    c[34] = D34(e[14]); /* -K4*k1 */
    c[35] = Sigma(e[20]); /* (R*k1)*(2.0*beta_z - vartheta_z) */
    c[36] = Sigma(e[3]); /* R*k1 */
    c[37] = Sigma(e[21]); /* (0.5*k1)*(-K2 + K5) */
    c[38] = Sigma(e[22]); /* K6*k1 */
    c[39] = Sigma(e[23]); /* (0.5*k1)*(K2 - K5) */
    c[40] = Sigma(e[3]); /* R*k1 */
    c[41] = Sigma(e[24]); /* (R*k1)*(-2.0*beta_z + vartheta_z) */
    c[42] = Sigma(e[25]); /* -0.5*K6*k1 */
    c[43] = Sigma(e[26]); /* k1*(-K2 + K5) */
    c[44] = Sigma(e[27]); /* 0.5*K6*k1 */
}

static void evaluate(const double *in, const double c[FOLDED], double A[AMPLITUDES]) {
    const double a_x = in[0];
    const double a_y = in[1];
    const double a_z = in[2];
    const double omega_x = in[3];
    const double omega_y = in[4];
    const double omega_z = in[5];
    const double omegadot_x = in[6];
    const double omegadot_y = in[7];
    const double omegadot_z = in[8];
    const double Gamma_xx = in[9];
    const double Gamma_xy = in[10];
    const double Gamma_xz = in[11];
    const double Gamma_yy = in[12];
    const double Gamma_yz = in[13];
    const double Gamma_zz = in[14];
    const double T_1 = 0.5*Gamma_xx - 0.5*Gamma_yy - 0.5*(omega_x*omega_x) + 0.5*(omega_y*omega_y);
    const double T_2 = -Gamma_xy + omega_x*omega_y;
    const double T_3 = Gamma_yz - omega_y*omega_z - omegadot_x;
    const double T_4 = Gamma_xz - omega_x*omega_z + omegadot_y;
    const double T_5 = 0.5*Gamma_xx + 0.5*Gamma_yy + 0.5*(omega_x*omega_x) + 0.5*(omega_y*omega_y) + (omega_z*omega_z);
    const double T_6 = omegadot_z;
    const double S_1 = Gamma_xz - omega_x*omega_z - omegadot_y;
    const double S_2 = Gamma_yz - omega_y*omega_z + omegadot_x;
    (void)a_x;
    (void)a_y;
    (void)a_z;
    (void)omega_x;
    (void)omega_y;
    (void)omega_z;
    (void)omegadot_x;
    (void)omegadot_y;
    (void)omegadot_z;
    (void)Gamma_xx;
    (void)Gamma_xy;
    (void)Gamma_xz;
    (void)Gamma_yy;
    (void)Gamma_yz;
    (void)Gamma_zz;

    A[0] = /* A_0 */
        (c[0])
        + (c[1]) * (a_z)
        + (c[2]) * (T_5)
        + (c[3]) * (T_6)
        + (c[4]) * ((a_x*a_x))
        + (c[5]) * ((a_y*a_y))
        + (c[6]) * ((a_z*a_z))
        ;
    A[1] = /* A_1c */
        (c[7] + c[8] + c[9]) * (a_x)
        + (c[10] + c[11] + c[12]) * (a_y)
        + (c[13]) * (T_3)
        + (c[14]) * (T_4)
        + (c[15]) * (S_1)
        + (c[16]) * (S_2)
        + (c[17] + c[18]) * (a_x*a_z)
        + (c[19] + c[20]) * (a_y*a_z)
        ;
    A[2] = /* A_1s */
        (c[21] + c[22] + c[23]) * (a_x)
        + (c[24] + c[25] + c[26]) * (a_y)
        + (c[27]) * (T_3)
        + (c[28]) * (T_4)
        + (c[29]) * (S_1)
        + (c[30]) * (S_2)
        + (c[31] + c[32]) * (a_x*a_z)
        + (c[33] + c[34]) * (a_y*a_z)
        ;
    A[3] = /* A_2c */
        (c[35]) * (T_1)
        + (c[36]) * (T_2)
        + (c[37]) * ((a_x*a_x))
        + (c[38]) * (a_x*a_y)
        + (c[39]) * ((a_y*a_y))
        ;
    A[4] = /* A_2s */
        (c[40]) * (T_1)
        + (c[41]) * (T_2)
        + (c[42]) * ((a_x*a_x))
        + (c[43]) * (a_x*a_y)
        + (c[44]) * ((a_y*a_y))
        ;
}

void ragg_simplified_amplitudes(const double in[RAGG_SIMPLIFIED_INPUTS], const double p[RAGG_SIMPLIFIED_PARAMETERS],
                              double A[RAGG_SIMPLIFIED_AMPLITUDES]) {
    double c[FOLDED];
    fold(p, c);
    evaluate(in, c, A);
}

void ragg_simplified_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                          double *G) {
    double c[FOLDED];
    fold(p, c);
    for (size_t i = 0; i < n; ++i) {
        double x[RAGG_SIMPLIFIED_INPUTS], A[AMPLITUDES];
        for (size_t k = 0; k < RAGG_SIMPLIFIED_INPUTS; ++k) {
            x[k] = in[k][i];
        }
        evaluate(x, c, A);
        const double phi = angle ? angle[i] : disc_angle(t[i], p[1]);
        double g = A[0];
        for (size_t h = 1; 2 * h < AMPLITUDES; ++h) {
            g += A[2 * h - 1] * cos((double)h * phi) + A[2 * h] * sin((double)h * phi);
        }
        G[i] = g;
    }
}

/* Harmonics of an accelerometer's own angle times motion monomials. */
static void basis(double psi, const double *in, double X[BASIS]) {
    const double a_x = in[0];
    const double a_y = in[1];
    const double a_z = in[2];
    const double omega_x = in[3];
    const double omega_y = in[4];
    const double omega_z = in[5];
    const double omegadot_x = in[6];
    const double omegadot_y = in[7];
    const double omegadot_z = in[8];
    const double Gamma_xx = in[9];
    const double Gamma_xy = in[10];
    const double Gamma_xz = in[11];
    const double Gamma_yy = in[12];
    const double Gamma_yz = in[13];
    const double Gamma_zz = in[14];
    const double T_1 = 0.5*Gamma_xx - 0.5*Gamma_yy - 0.5*(omega_x*omega_x) + 0.5*(omega_y*omega_y);
    const double T_2 = -Gamma_xy + omega_x*omega_y;
    const double T_3 = Gamma_yz - omega_y*omega_z - omegadot_x;
    const double T_4 = Gamma_xz - omega_x*omega_z + omegadot_y;
    const double T_5 = 0.5*Gamma_xx + 0.5*Gamma_yy + 0.5*(omega_x*omega_x) + 0.5*(omega_y*omega_y) + (omega_z*omega_z);
    const double T_6 = omegadot_z;
    const double S_1 = Gamma_xz - omega_x*omega_z - omegadot_y;
    const double S_2 = Gamma_yz - omega_y*omega_z + omegadot_x;
    (void)a_x;
    (void)a_y;
    (void)a_z;
    (void)omega_x;
    (void)omega_y;
    (void)omega_z;
    (void)omegadot_x;
    (void)omegadot_y;
    (void)omegadot_z;
    (void)Gamma_xx;
    (void)Gamma_xy;
    (void)Gamma_xz;
    (void)Gamma_yy;
    (void)Gamma_yz;
    (void)Gamma_zz;

    const double c1 = cos(1.0 * psi), s1 = sin(1.0 * psi);
    const double c2 = cos(2.0 * psi), s2 = sin(2.0 * psi);
    X[0] = 1.0 * ((a_x*a_x));
    X[1] = 1.0 * ((a_y*a_y));
    X[2] = 1.0 * ((a_z*a_z));
    X[3] = 1.0 * (a_z);
    X[4] = 1.0 * (T_5);
    X[5] = 1.0 * (T_6);
    X[6] = 1.0;
    X[7] = c1 * (a_x*a_z);
    X[8] = c1 * (a_x);
    X[9] = c1 * (a_y*a_z);
    X[10] = c1 * (a_y);
    X[11] = c1 * (T_4);
    X[12] = c1 * (S_2);
    X[13] = s1 * (a_x*a_z);
    X[14] = s1 * (a_x);
    X[15] = s1 * (a_y*a_z);
    X[16] = s1 * (a_y);
    X[17] = s1 * (T_3);
    X[18] = s1 * (S_1);
    X[19] = c2 * ((a_x*a_x));
    X[20] = c2 * (a_x*a_y);
    X[21] = c2 * ((a_y*a_y));
    X[22] = c2 * (T_1);
    X[23] = c2 * (T_2);
    X[24] = s2 * ((a_x*a_x));
    X[25] = s2 * (a_x*a_y);
    X[26] = s2 * ((a_y*a_y));
    X[27] = s2 * (T_1);
    X[28] = s2 * (T_2);
}

/* Derivatives of the basis' coefficients by k1, R, beta_x, beta_z, vartheta_x, vartheta_y, vartheta_z, K0, K2, K4, K5, K6, K7, K8. */
static void slopes(const double *p, size_t j, double C[SLOPES][BASIS]) {
        const double radius = p[0];
        const double dR = p[2 + j];
        const double beta_x = p[6 + j];
        const double beta_z = p[10 + j];
        const double vartheta_x = p[14 + j];
        const double vartheta_y = p[18 + j];
        const double vartheta_z = p[22 + j];
        const double K0 = p[26 + j];
        const double K1 = p[30 + j];
        const double K2 = p[34 + j];
        const double K4 = p[38 + j];
        const double K5 = p[42 + j];
        const double K6 = p[46 + j];
        const double K7 = p[50 + j];
        const double K8 = p[54 + j];
        const double k_VI = p[58 + j];
        const double R = radius + dR, k1 = k_VI * K1;
        (void)vartheta_x;

    for (size_t a = 0; a < SLOPES; ++a) {
        for (size_t b = 0; b < BASIS; ++b) {
            C[a][b] = 0.0;
        }
    }
    C[0][0] = 0.5*(K2 + K5);
    C[0][1] = 0.5*(K2 + K5);
    C[0][2] = K7;
    C[0][3] = 1.0*(-beta_x*vartheta_z + vartheta_y);
    C[0][4] = -R*vartheta_z;
    C[0][5] = R;
    C[0][6] = K0;
    C[0][7] = -K8;
    C[0][8] = 1.0*(beta_x*vartheta_y - beta_z + vartheta_z);
    C[0][9] = -K4;
    C[0][10] = 1.0*(beta_z*vartheta_z + 1.0);
    C[0][11] = -R*vartheta_y;
    C[0][12] = -R*beta_x;
    C[0][13] = K4;
    C[0][14] = 1.0*(-beta_z*vartheta_z - 1.0);
    C[0][15] = -K8;
    C[0][16] = 1.0*(beta_x*vartheta_y - beta_z + vartheta_z);
    C[0][17] = -R*vartheta_y;
    C[0][18] = R*beta_x;
    C[0][19] = 0.5*(-K2 + K5);
    C[0][20] = K6;
    C[0][21] = 0.5*(K2 - K5);
    C[0][22] = R*(2.0*beta_z - vartheta_z);
    C[0][23] = R;
    C[0][24] = -0.5*K6;
    C[0][25] = 1.0*(-K2 + K5);
    C[0][26] = 0.5*K6;
    C[0][27] = R;
    C[0][28] = R*(-2.0*beta_z + vartheta_z);
    C[1][4] = -k1*vartheta_z;
    C[1][5] = k1;
    C[1][11] = -k1*vartheta_y;
    C[1][12] = -beta_x*k1;
    C[1][17] = -k1*vartheta_y;
    C[1][18] = beta_x*k1;
    C[1][22] = k1*(2.0*beta_z - vartheta_z);
    C[1][23] = k1;
    C[1][27] = k1;
    C[1][28] = k1*(-2.0*beta_z + vartheta_z);
    C[2][3] = -k1*vartheta_z;
    C[2][8] = k1*vartheta_y;
    C[2][12] = -R*k1;
    C[2][16] = k1*vartheta_y;
    C[2][18] = R*k1;
    C[3][8] = -k1;
    C[3][10] = k1*vartheta_z;
    C[3][14] = -k1*vartheta_z;
    C[3][16] = -k1;
    C[3][22] = 2.0*R*k1;
    C[3][28] = -2.0*R*k1;
    C[5][3] = k1;
    C[5][8] = beta_x*k1;
    C[5][11] = -R*k1;
    C[5][16] = beta_x*k1;
    C[5][17] = -R*k1;
    C[6][3] = -beta_x*k1;
    C[6][4] = -R*k1;
    C[6][8] = k1;
    C[6][10] = beta_z*k1;
    C[6][14] = -beta_z*k1;
    C[6][16] = k1;
    C[6][22] = -R*k1;
    C[6][28] = R*k1;
    C[7][6] = k1;
    C[8][0] = 0.5*k1;
    C[8][1] = 0.5*k1;
    C[8][19] = -0.5*k1;
    C[8][21] = 0.5*k1;
    C[8][25] = -k1;
    C[9][9] = -k1;
    C[9][13] = k1;
    C[10][0] = 0.5*k1;
    C[10][1] = 0.5*k1;
    C[10][19] = 0.5*k1;
    C[10][21] = -0.5*k1;
    C[10][25] = k1;
    C[11][20] = k1;
    C[11][24] = -0.5*k1;
    C[11][26] = 0.5*k1;
    C[12][2] = k1;
    C[13][7] = -k1;
    C[13][15] = -k1;
}

void ragg_simplified_jacobian(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                            double *J) {
    static const double sign[4] = { 1.0, 1.0, -1.0, -1.0 };
    static const double place[4] = { 0.0, 2.0, 1.0, 3.0 };
    double C[4][SLOPES][BASIS], c[FOLDED];
    fold(p, c);
    for (size_t j = 0; j < 4; ++j) {
        slopes(p, j, C[j]);
    }
    for (size_t i = 0; i < n; ++i) {
        double x[RAGG_SIMPLIFIED_INPUTS], X[BASIS], A[AMPLITUDES];
        for (size_t k = 0; k < RAGG_SIMPLIFIED_INPUTS; ++k) {
            x[k] = in[k][i];
        }
        const double phi = angle ? angle[i] : disc_angle(t[i], p[1]);
        for (size_t k = 0; k < RAGG_SIMPLIFIED_PARAMETERS; ++k) {
            J[k * n + i] = 0.0;
        }
        for (size_t j = 0; j < 4; ++j) {
            double by[SLOPES];
            basis(phi + place[j] * 1.570796326794896619231321691640, x, X);
            for (size_t a = 0; a < SLOPES; ++a) {
                by[a] = 0.0;
                for (size_t b = 0; b < BASIS; ++b) {
                    by[a] += C[j][a][b] * X[b];
                }
                by[a] *= sign[j];
            }
            const double K1 = p[30 + j], k_VI = p[58 + j];
            J[i] += by[1]; /* radius */
            J[(2 + j) * n + i] = by[1]; /* dR */
            J[(6 + j) * n + i] = by[2]; /* beta_x */
            J[(10 + j) * n + i] = by[3]; /* beta_z */
            J[(14 + j) * n + i] = by[4]; /* vartheta_x */
            J[(18 + j) * n + i] = by[5]; /* vartheta_y */
            J[(22 + j) * n + i] = by[6]; /* vartheta_z */
            J[(26 + j) * n + i] = by[7]; /* K0 */
            J[(30 + j) * n + i] = k_VI * by[0]; /* K1 */
            J[(34 + j) * n + i] = by[8]; /* K2 */
            J[(38 + j) * n + i] = by[9]; /* K4 */
            J[(42 + j) * n + i] = by[10]; /* K5 */
            J[(46 + j) * n + i] = by[11]; /* K6 */
            J[(50 + j) * n + i] = by[12]; /* K7 */
            J[(54 + j) * n + i] = by[13]; /* K8 */
            J[(58 + j) * n + i] = K1 * by[0]; /* k_VI */
        }
        if (!angle) {
            evaluate(x, c, A);
            double slope = 0.0;
            for (size_t h = 1; 2 * h < AMPLITUDES; ++h) {
                slope += (double)h * (A[2 * h] * cos((double)h * phi) - A[2 * h - 1] * sin((double)h * phi));
            }
            J[n + i] = 6.283185307179586476925286766559 * t[i] * slope; /* spin_frequency */
        }
    }
}
