/* The instrument as a chain of stages (paper, Eq. 1-15).
 * Derived; do not edit: change the derivation and derive again. */
#include "chain.h"

#include <math.h>

/* Disc angle, rad, within half a turn of 0; the turns are dropped exactly, whatever the time. */
static double disc_angle(double t, double spin_frequency) {
    const double turns = spin_frequency * t;
    const double error = fma(spin_frequency, t, -turns);
    return 6.283185307179586476925286766559 * ((turns - nearbyint(turns)) + error);
}

static const double COS_J[4] = { 1.0, -1.0, 0.0, 0.0 };
static const double SIN_J[4] = { 0.0, 0.0, 1.0, -1.0 };

static double accelerometer(size_t j, size_t i, double time, double cos_phi, double sin_phi, const double *const *in,
                            const double *p) {
    const double a_x = in[0][i];
    const double a_y = in[1][i];
    const double a_z = in[2][i];
    const double omega_x = in[3][i];
    const double omega_y = in[4][i];
    const double omega_z = in[5][i];
    const double omegadot_x = in[6][i];
    const double omegadot_y = in[7][i];
    const double omegadot_z = in[8][i];
    const double Gamma_xx = in[9][i];
    const double Gamma_xy = in[10][i];
    const double Gamma_xz = in[11][i];
    const double Gamma_yy = in[12][i];
    const double Gamma_yz = in[13][i];
    const double Gamma_zz = in[14][i];
    const double radius = p[0];
    const double dR = p[2 + j];
    const double beta_x = p[6 + j];
    const double beta_z = p[10 + j];
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
    const double cos_j = COS_J[j], sin_j = SIN_J[j];
    const double x0 = (omega_y*omega_y);
    const double x1 = (omega_z*omega_z);
    const double M_xx = -Gamma_xx - x0 - x1;
    const double M_xy = -Gamma_xy + omega_x*omega_y - omegadot_z;
    const double M_xz = -Gamma_xz + omega_x*omega_z + omegadot_y;
    const double M_yx = -Gamma_xy + omega_x*omega_y + omegadot_z;
    const double x2 = (omega_x*omega_x);
    const double M_yy = -Gamma_yy - x1 - x2;
    const double M_yz = -Gamma_yz + omega_y*omega_z - omegadot_x;
    const double M_zx = -Gamma_xz + omega_x*omega_z - omegadot_y;
    const double M_zy = -Gamma_yz + omega_y*omega_z + omegadot_x;
    const double M_zz = -Gamma_zz - x0 - x2;
    const double cos_psi = cos_j*cos_phi - sin_j*sin_phi;
    const double sin_psi = cos_j*sin_phi + cos_phi*sin_j;
    const double x3 = dR + radius;
    const double f_disc_r_x = x3;
    const double f_disc_r_y = beta_z*x3;
    const double f_disc_r_z = beta_x*x3;
    const double f_disc_tau_zy = -beta_x*beta_z;
    const double f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi;
    const double f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi;
    const double x4 = beta_z*cos_psi + sin_psi;
    const double f_tau_xx = -x4;
    const double x5 = -beta_z*sin_psi + cos_psi;
    const double f_tau_xy = x5;
    const double f_tau_yx = x5;
    const double f_tau_yy = x4;
    const double f_tau_zx = -beta_x*cos_psi - f_disc_tau_zy*sin_psi;
    const double f_tau_zy = -beta_x*sin_psi + cos_psi*f_disc_tau_zy;
    const double f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x;
    const double f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y;
    const double f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z;
    const double f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy;
    const double f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy;
    const double f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z;
    const double f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y;
    const double q_disc_r_x = x3;
    const double q_r_x = cos_psi*q_disc_r_x;
    const double q_r_y = q_disc_r_x*sin_psi;
    const double q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x;
    const double q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y;
    const double q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z;
    const double q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi;
    const double q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi;
    const double i_sensed = K0 + K2*(q_f_xj*q_f_xj) - K4*q_f_xj*q_f_z + K5*(q_f_yj*q_f_yj) + K6*q_f_xj*q_f_yj + K7*(q_f_z*q_f_z) - K8*q_f_yj*q_f_z + f_f_i;
    const double V = K1*i_sensed*k_VI;
    (void)time, (void)cos_j, (void)sin_j, (void)cos_phi, (void)sin_phi;

    return V;
}

static void slopes(size_t j, size_t i, double time, double cos_phi, double sin_phi, const double *const *in,
                   const double *p, size_t n, double *D) {
    const double a_x = in[0][i];
    const double a_y = in[1][i];
    const double a_z = in[2][i];
    const double omega_x = in[3][i];
    const double omega_y = in[4][i];
    const double omega_z = in[5][i];
    const double omegadot_x = in[6][i];
    const double omegadot_y = in[7][i];
    const double omegadot_z = in[8][i];
    const double Gamma_xx = in[9][i];
    const double Gamma_xy = in[10][i];
    const double Gamma_xz = in[11][i];
    const double Gamma_yy = in[12][i];
    const double Gamma_yz = in[13][i];
    const double Gamma_zz = in[14][i];
    const double radius = p[0];
    const double dR = p[2 + j];
    const double beta_x = p[6 + j];
    const double beta_z = p[10 + j];
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
    const double cos_j = COS_J[j], sin_j = SIN_J[j];
    const double x0 = (omega_y*omega_y);
    const double x1 = (omega_z*omega_z);
    const double M_xx = -Gamma_xx - x0 - x1;
    const double M_xy = -Gamma_xy + omega_x*omega_y - omegadot_z;
    const double M_xz = -Gamma_xz + omega_x*omega_z + omegadot_y;
    const double M_yx = -Gamma_xy + omega_x*omega_y + omegadot_z;
    const double x2 = (omega_x*omega_x);
    const double M_yy = -Gamma_yy - x1 - x2;
    const double M_yz = -Gamma_yz + omega_y*omega_z - omegadot_x;
    const double M_zx = -Gamma_xz + omega_x*omega_z - omegadot_y;
    const double M_zy = -Gamma_yz + omega_y*omega_z + omegadot_x;
    const double M_zz = -Gamma_zz - x0 - x2;
    const double cos_psi = cos_j*cos_phi - sin_j*sin_phi;
    const double sin_psi = cos_j*sin_phi + cos_phi*sin_j;
    const double x3 = dR + radius;
    const double f_disc_r_x = x3;
    const double f_disc_r_y = beta_z*x3;
    const double f_disc_r_z = beta_x*x3;
    const double f_disc_tau_zy = -beta_x*beta_z;
    const double f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi;
    const double f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi;
    const double x4 = beta_z*cos_psi + sin_psi;
    const double f_tau_xx = -x4;
    const double x5 = -beta_z*sin_psi + cos_psi;
    const double f_tau_xy = x5;
    const double f_tau_yx = x5;
    const double f_tau_yy = x4;
    const double f_tau_zx = -beta_x*cos_psi - f_disc_tau_zy*sin_psi;
    const double f_tau_zy = -beta_x*sin_psi + cos_psi*f_disc_tau_zy;
    const double f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x;
    const double f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y;
    const double f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z;
    const double f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy;
    const double f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy;
    const double f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z;
    const double f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y;
    const double q_disc_r_x = x3;
    const double q_r_x = cos_psi*q_disc_r_x;
    const double q_r_y = q_disc_r_x*sin_psi;
    const double q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x;
    const double q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y;
    const double q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z;
    const double q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi;
    const double q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi;
    const double x10 = K4*q_f_z;
    const double x11 = K8*q_f_z;
    const double x6 = K6*q_f_xj;
    const double x7 = (q_f_xj*q_f_xj);
    const double x8 = (q_f_yj*q_f_yj);
    const double x9 = (q_f_z*q_f_z);
    const double i_sensed = K0 + K2*x7 + K5*x8 + K7*x9 + f_f_i - q_f_xj*x10 - q_f_yj*x11 + q_f_yj*x6;
    const double bar_i_sensed = K1*k_VI;
    const double bar_q_f_yj = bar_i_sensed*(2.0*K5*q_f_yj - x11 + x6);
    const double bar_q_f_xj = bar_i_sensed*(2.0*K2*q_f_xj + K6*q_f_yj - x10);
    const double bar_q_f_z = bar_i_sensed*(-K4*q_f_xj + 2.0*K7*q_f_z - K8*q_f_yj);
    const double bar_q_f_y = bar_q_f_xj*cos_psi + bar_q_f_yj*sin_psi;
    const double bar_q_f_x = -bar_q_f_xj*sin_psi + bar_q_f_yj*cos_psi;
    const double bar_q_r_y = M_xy*bar_q_f_x + M_yy*bar_q_f_y + M_zy*bar_q_f_z;
    const double bar_q_r_x = M_xx*bar_q_f_x + M_yx*bar_q_f_y + M_zx*bar_q_f_z;
    const double bar_q_disc_r_x = bar_q_r_x*cos_psi + bar_q_r_y*sin_psi;
    const double bar_f_f_zj = -bar_i_sensed*vartheta_y;
    const double bar_f_f_yj = bar_i_sensed*vartheta_z;
    const double bar_f_f_z = -bar_f_f_yj*beta_x - bar_f_f_zj;
    const double bar_f_f_y = bar_f_f_yj*f_tau_yy + bar_f_f_zj*f_tau_zy + bar_i_sensed*f_tau_xy;
    const double bar_f_f_x = bar_f_f_yj*f_tau_yx + bar_f_f_zj*f_tau_zx + bar_i_sensed*f_tau_xx;
    const double bar_f_tau_zy = bar_f_f_zj*f_f_y;
    const double bar_f_tau_zx = bar_f_f_zj*f_f_x;
    const double bar_f_tau_yy = bar_f_f_yj*f_f_y;
    const double bar_f_tau_yx = bar_f_f_yj*f_f_x;
    const double bar_f_tau_xy = bar_i_sensed*f_f_y;
    const double bar_f_tau_xx = bar_i_sensed*f_f_x;
    const double bar_f_r_y = M_xy*bar_f_f_x + M_yy*bar_f_f_y + M_zy*bar_f_f_z;
    const double bar_f_r_x = M_xx*bar_f_f_x + M_yx*bar_f_f_y + M_zx*bar_f_f_z;
    const double bar_f_disc_tau_zy = -bar_f_tau_zx*sin_psi + bar_f_tau_zy*cos_psi;
    const double bar_f_disc_r_z = M_xz*bar_f_f_x + M_yz*bar_f_f_y + M_zz*bar_f_f_z;
    const double bar_f_disc_r_y = -bar_f_r_x*sin_psi + bar_f_r_y*cos_psi;
    const double bar_f_disc_r_x = bar_f_r_x*cos_psi + bar_f_r_y*sin_psi;
    const double x12 = bar_i_sensed*q_f_xj;
    (void)time, (void)cos_j, (void)sin_j, (void)cos_phi, (void)sin_phi;

    D[0 * n + i] = bar_f_disc_r_x + bar_f_disc_r_y*beta_z + bar_f_disc_r_z*beta_x + bar_q_disc_r_x; /* dR */
    D[1 * n + i] = bar_f_disc_r_z*x3 - bar_f_disc_tau_zy*beta_z - bar_f_f_yj*f_f_z - bar_f_tau_zx*cos_psi - bar_f_tau_zy*sin_psi; /* beta_x */
    D[2 * n + i] = bar_f_disc_r_y*x3 - bar_f_disc_tau_zy*beta_x - bar_f_tau_xx*cos_psi - bar_f_tau_xy*sin_psi - bar_f_tau_yx*sin_psi + bar_f_tau_yy*cos_psi; /* beta_z */
    D[3 * n + i] = 0.0; /* vartheta_x */
    D[4 * n + i] = -bar_i_sensed*f_f_zj; /* vartheta_y */
    D[5 * n + i] = bar_i_sensed*f_f_yj; /* vartheta_z */
    D[6 * n + i] = bar_i_sensed; /* K0 */
    D[7 * n + i] = i_sensed*k_VI; /* K1 */
    D[8 * n + i] = bar_i_sensed*x7; /* K2 */
    D[9 * n + i] = -q_f_z*x12; /* K4 */
    D[10 * n + i] = bar_i_sensed*x8; /* K5 */
    D[11 * n + i] = q_f_yj*x12; /* K6 */
    D[12 * n + i] = bar_i_sensed*x9; /* K7 */
    D[13 * n + i] = -bar_i_sensed*q_f_yj*q_f_z; /* K8 */
    D[14 * n + i] = K1*i_sensed; /* k_VI */
}

void ragg_chain_voltages(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                        double *V) {
    for (size_t i = 0; i < n; ++i) {
        const double phi = angle ? angle[i] : disc_angle(t[i], p[1]);
        const double c = cos(phi), s = sin(phi);
        for (size_t j = 0; j < 4; ++j) {
            V[j * n + i] = accelerometer(j, i, t[i], c, s, in, p);
        }
    }
}

void ragg_chain_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                      double *G) {
    for (size_t i = 0; i < n; ++i) {
        const double phi = angle ? angle[i] : disc_angle(t[i], p[1]);
        const double c = cos(phi), s = sin(phi);
        double v[4];
        for (size_t j = 0; j < 4; ++j) {
            v[j] = accelerometer(j, i, t[i], c, s, in, p);
        }
        G[i] = (v[0] + v[1]) - (v[2] + v[3]);
    }
}

void ragg_chain_derivatives(size_t j, size_t n, const double *t, const double *const *in, const double *p,
                           const double *angle, double *D) {
    for (size_t i = 0; i < n; ++i) {
        const double phi = angle ? angle[i] : disc_angle(t[i], p[1]);
        slopes(j, i, t[i], cos(phi), sin(phi), in, p, n, D);
    }
}
