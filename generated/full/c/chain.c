/* The instrument as a chain of stages (paper, Eq. 1-15).
 * Derived; do not edit: change the derivation and derive again. */
#include "chain.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* A product added to something, rounded once where the processor does that. */
#ifdef FP_FAST_FMA
#define FMA(x, y, z) fma(x, y, z)
#else
#define FMA(x, y, z) ((x) * (y) + (z))
#endif

enum { BLOCK = 128 }; /* samples at a time: what is between two loops stays in the first cache */

/* x y = *high + *low, exactly. */
static inline void two_product(double x, double y, double *high, double *low) {
    const double product = x * y;
#ifdef FP_FAST_FMA
    *low = fma(x, y, -product);
#else
    const double split = 134217729.0, a = split * x, b = split * y;
    const double x1 = a - (a - x), x2 = x - x1, y1 = b - (b - y), y2 = y - y1;
    *low = ((x1 * y1 - product) + x1 * y2 + x2 * y1) + x2 * y2;
#endif
    *high = product;
}

/* x, or -x in the third and fourth of four quarters. */
static inline double with_sign(double x, uint64_t quarters) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits ^= (quarters & 2) << 62;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Cosine and sine of turns + error whole turns, |turns| < 2^49 and |error| < 1e-6. The quarter turns are dropped exactly; of the
 * rest, r, sine and cosine are 2 pi r + r S(r^2) and 1 + r^2 C(r^2), with polynomials S and C. */
static inline void turn(double turns, double error, double *cosine, double *sine) {
    const double shifted = FMA(4.0, turns, 6755399441055744.0); /* its last bits count quarter turns */
    const double part = FMA(-0.25, shifted - 6755399441055744.0, turns);
    const double r = part + error, rest = 6.283185307179586 * ((part - r) + error), z = r * r;
    const double c = FMA(z, -19.739208802178716, 1.0), lost = FMA(z, -19.739208802178716, 1.0 - c);
    const double sin_r = FMA(6.283185307179586, r, FMA(rest, c, r * FMA(z, FMA(z, FMA(z, FMA(z, FMA(z, FMA(z, 3.7808689593022957, -15.093804209987114), 42.058685020160894), -76.70585970427454), 81.60524927594804), -41.341702240399634), 2.251550647758967e-16)));
    const double cos_r = c + FMA(z * z, FMA(z, FMA(z, FMA(z, FMA(z, FMA(z, -1.7012215232036352, 7.903305164742355), -26.426254911246687), 60.24464136502278), -85.45681720668455), 64.9393940226683), FMA(-6.283185307179586 * rest, r, lost));
    uint64_t quarters;
    memcpy(&quarters, &shifted, sizeof quarters);
    *sine = with_sign(quarters & 1 ? cos_r : sin_r, quarters);
    *cosine = with_sign(quarters & 1 ? sin_r : cos_r, quarters + 1);
}

/* Cosine and sine of the disc angle at n instants, whatever the time. */
static inline void disc(size_t n, const double *restrict t, double spin_frequency, double *restrict cosine,
                        double *restrict sine) {
    for (size_t i = 0; i < n; ++i) {
        double turns, error;
        two_product(spin_frequency, t[i], &turns, &error);
        turn(turns, error, cosine + i, sine + i);
    }
}

/* The same of an encoder's angle, rad. */
static inline void encoder(size_t n, const double *restrict angle, double *restrict cosine, double *restrict sine) {
    for (size_t i = 0; i < n; ++i) {
        double turns, error;
        two_product(0.15915494309189535, angle[i], &turns, &error);
        turn(turns, FMA(-9.839338337591243e-18, angle[i], error), cosine + i, sine + i);
    }
}

/* At n <= BLOCK samples from at on, or as many as there are; returns n. */
static inline size_t turning(size_t at, size_t end, const double *t, double spin_frequency, const double *angle,
                             double *cosine, double *sine) {
    const size_t n = end - at < BLOCK ? end - at : BLOCK;
    if (angle) {
        encoder(n, angle + at, cosine, sine);
    } else {
        disc(n, t + at, spin_frequency, cosine, sine);
    }
    return n;
}

enum { ROWS = 15, STEP = 64 };

static const double COS_J[4] = { 1.0, -1.0, 0.0, 0.0 };
static const double SIN_J[4] = { 0.0, 0.0, 1.0, -1.0 };

/* V_j at n samples from at on, by the cosine and sine of the disc angle. */
static void block(size_t j, size_t n, size_t at, const double *restrict t, const double *restrict cosine,
                  const double *restrict sine, const double *const *in, const double *p, double *restrict out_V) {
    const double *restrict in_a_x = in[0] + at;
    const double *restrict in_a_y = in[1] + at;
    const double *restrict in_a_z = in[2] + at;
    const double *restrict in_omega_x = in[3] + at;
    const double *restrict in_omega_y = in[4] + at;
    const double *restrict in_omega_z = in[5] + at;
    const double *restrict in_omegadot_x = in[6] + at;
    const double *restrict in_omegadot_y = in[7] + at;
    const double *restrict in_omegadot_z = in[8] + at;
    const double *restrict in_Gamma_xx = in[9] + at;
    const double *restrict in_Gamma_xy = in[10] + at;
    const double *restrict in_Gamma_xz = in[11] + at;
    const double *restrict in_Gamma_yy = in[12] + at;
    const double *restrict in_Gamma_yz = in[13] + at;
    const double *restrict in_Gamma_zz = in[14] + at;
    const double *restrict in_d2_spin_angle = in[15] + at;
    const double *restrict in_d_spin_angle = in[16] + at;
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
    (void)cos_j, (void)sin_j, (void)t, (void)cosine, (void)sine;

    for (size_t i = 0; i < n; ++i) {
        const double cos_phi = cosine[i];
        const double sin_phi = sine[i];
        const double a_x = in_a_x[i];
        const double a_y = in_a_y[i];
        const double a_z = in_a_z[i];
        const double omega_x = in_omega_x[i];
        const double omega_y = in_omega_y[i];
        const double omega_z = in_omega_z[i];
        const double omegadot_x = in_omegadot_x[i];
        const double omegadot_y = in_omegadot_y[i];
        const double omegadot_z = in_omegadot_z[i];
        const double Gamma_xx = in_Gamma_xx[i];
        const double Gamma_xy = in_Gamma_xy[i];
        const double Gamma_xz = in_Gamma_xz[i];
        const double Gamma_yy = in_Gamma_yy[i];
        const double Gamma_yz = in_Gamma_yz[i];
        const double Gamma_zz = in_Gamma_zz[i];
        const double d2_spin_angle = in_d2_spin_angle[i];
        const double d_spin_angle = in_d_spin_angle[i];
        const double x0 = (omega_y*omega_y);
        const double x1 = d_spin_angle + omega_z;
        const double x2 = -x1;
        const double x3 = -x1*x2;
        const double M_xx = -Gamma_xx - x0 - x3;
        const double x4 = d2_spin_angle + omegadot_z;
        const double M_xy = FMA(omega_x, omega_y, -Gamma_xy - x4);
        const double x5 = d_spin_angle*omega_x;
        const double M_xz = FMA(-omega_x, x2, -Gamma_xz + omegadot_y - x5);
        const double M_yx = FMA(omega_x, omega_y, -Gamma_xy + x4);
        const double x6 = (omega_x*omega_x);
        const double M_yy = -Gamma_yy - x3 - x6;
        const double x7 = d_spin_angle*omega_y;
        const double M_yz = FMA(omega_y, x1, -Gamma_yz - omegadot_x - x7);
        const double M_zx = FMA(omega_x, x1, -Gamma_xz - omegadot_y + x5);
        const double M_zy = FMA(-omega_y, x2, -Gamma_yz + omegadot_x + x7);
        const double M_zz = -Gamma_zz - x0 - x6;
        const double cos_psi = FMA(-sin_j, sin_phi, cos_j*cos_phi);
        const double sin_psi = FMA(cos_phi, sin_j, cos_j*sin_phi);
        const double x8 = dR + radius;
        const double f_disc_r_x = x8;
        const double f_disc_r_y = beta_z*x8;
        const double f_disc_r_z = beta_x*x8;
        const double f_disc_tau_zy = -beta_x*beta_z;
        const double f_r_x = FMA(-f_disc_r_y, sin_psi, cos_psi*f_disc_r_x);
        const double f_r_y = FMA(f_disc_r_x, sin_psi, cos_psi*f_disc_r_y);
        const double x9 = FMA(beta_z, cos_psi, sin_psi);
        const double f_tau_xx = -x9;
        const double x10 = FMA(-beta_z, sin_psi, cos_psi);
        const double f_tau_xy = x10;
        const double f_tau_yx = x10;
        const double f_tau_yy = x9;
        const double f_tau_zx = FMA(-f_disc_tau_zy, sin_psi, -beta_x*cos_psi);
        const double f_tau_zy = FMA(-beta_x, sin_psi, cos_psi*f_disc_tau_zy);
        const double f_f_x = FMA(M_xz, f_disc_r_z, FMA(M_xy, f_r_y, FMA(M_xx, f_r_x, a_x)));
        const double f_f_y = FMA(M_yz, f_disc_r_z, FMA(M_yy, f_r_y, FMA(M_yx, f_r_x, a_y)));
        const double f_f_z = FMA(M_zz, f_disc_r_z, FMA(M_zy, f_r_y, FMA(M_zx, f_r_x, a_z)));
        const double f_f_xj = FMA(f_f_y, f_tau_xy, f_f_x*f_tau_xx);
        const double f_f_yj = FMA(f_f_y, f_tau_yy, FMA(-beta_x, f_f_z, f_f_x*f_tau_yx));
        const double f_f_zj = FMA(f_f_y, f_tau_zy, FMA(f_f_x, f_tau_zx, -f_f_z));
        const double f_f_i = FMA(-f_f_zj, vartheta_y, FMA(f_f_yj, vartheta_z, f_f_xj));
        const double q_disc_r_x = x8;
        const double q_r_x = cos_psi*q_disc_r_x;
        const double q_r_y = q_disc_r_x*sin_psi;
        const double q_f_x = FMA(M_xy, q_r_y, FMA(M_xx, q_r_x, a_x));
        const double q_f_y = FMA(M_yy, q_r_y, FMA(M_yx, q_r_x, a_y));
        const double q_f_z = FMA(M_zy, q_r_y, FMA(M_zx, q_r_x, a_z));
        const double q_f_xj = FMA(-q_f_x, sin_psi, cos_psi*q_f_y);
        const double q_f_yj = FMA(q_f_y, sin_psi, cos_psi*q_f_x);
        const double i_sensed = FMA(-K8, q_f_yj*q_f_z, FMA(K7, q_f_z*q_f_z, FMA(K6, q_f_xj*q_f_yj, FMA(K5, q_f_yj*q_f_yj, FMA(-K4, q_f_xj*q_f_z, FMA(K2, q_f_xj*q_f_xj, K0 + f_f_i))))));
        const double V = K1*i_sensed*k_VI;

        out_V[i] = V;
    }
}

/* Derivatives of V_j at n <= STEP samples from at on, a row every stride numbers. */
static void slopes(size_t j, size_t n, size_t at, size_t stride, const double *restrict t, const double *restrict cosine,
                   const double *restrict sine, const double *const *in, const double *p, double *restrict out_D) {
    const double *restrict in_a_x = in[0] + at;
    const double *restrict in_a_y = in[1] + at;
    const double *restrict in_a_z = in[2] + at;
    const double *restrict in_omega_x = in[3] + at;
    const double *restrict in_omega_y = in[4] + at;
    const double *restrict in_omega_z = in[5] + at;
    const double *restrict in_omegadot_x = in[6] + at;
    const double *restrict in_omegadot_y = in[7] + at;
    const double *restrict in_omegadot_z = in[8] + at;
    const double *restrict in_Gamma_xx = in[9] + at;
    const double *restrict in_Gamma_xy = in[10] + at;
    const double *restrict in_Gamma_xz = in[11] + at;
    const double *restrict in_Gamma_yy = in[12] + at;
    const double *restrict in_Gamma_yz = in[13] + at;
    const double *restrict in_Gamma_zz = in[14] + at;
    const double *restrict in_d2_spin_angle = in[15] + at;
    const double *restrict in_d_spin_angle = in[16] + at;
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
    (void)cos_j, (void)sin_j, (void)t, (void)cosine, (void)sine;

    double rows[ROWS][STEP]; /* which overlap nothing: the loop becomes one of vectors */
    for (size_t i = 0; i < n; ++i) {
        const double cos_phi = cosine[i];
        const double sin_phi = sine[i];
        const double a_x = in_a_x[i];
        const double a_y = in_a_y[i];
        const double a_z = in_a_z[i];
        const double omega_x = in_omega_x[i];
        const double omega_y = in_omega_y[i];
        const double omega_z = in_omega_z[i];
        const double omegadot_x = in_omegadot_x[i];
        const double omegadot_y = in_omegadot_y[i];
        const double omegadot_z = in_omegadot_z[i];
        const double Gamma_xx = in_Gamma_xx[i];
        const double Gamma_xy = in_Gamma_xy[i];
        const double Gamma_xz = in_Gamma_xz[i];
        const double Gamma_yy = in_Gamma_yy[i];
        const double Gamma_yz = in_Gamma_yz[i];
        const double Gamma_zz = in_Gamma_zz[i];
        const double d2_spin_angle = in_d2_spin_angle[i];
        const double d_spin_angle = in_d_spin_angle[i];
        const double x0 = (omega_y*omega_y);
        const double x1 = d_spin_angle + omega_z;
        const double x2 = -x1;
        const double x3 = -x1*x2;
        const double M_xx = -Gamma_xx - x0 - x3;
        const double x4 = d2_spin_angle + omegadot_z;
        const double M_xy = FMA(omega_x, omega_y, -Gamma_xy - x4);
        const double x5 = d_spin_angle*omega_x;
        const double M_xz = FMA(-omega_x, x2, -Gamma_xz + omegadot_y - x5);
        const double M_yx = FMA(omega_x, omega_y, -Gamma_xy + x4);
        const double x6 = (omega_x*omega_x);
        const double M_yy = -Gamma_yy - x3 - x6;
        const double x7 = d_spin_angle*omega_y;
        const double M_yz = FMA(omega_y, x1, -Gamma_yz - omegadot_x - x7);
        const double M_zx = FMA(omega_x, x1, -Gamma_xz - omegadot_y + x5);
        const double M_zy = FMA(-omega_y, x2, -Gamma_yz + omegadot_x + x7);
        const double M_zz = -Gamma_zz - x0 - x6;
        const double cos_psi = FMA(-sin_j, sin_phi, cos_j*cos_phi);
        const double sin_psi = FMA(cos_phi, sin_j, cos_j*sin_phi);
        const double x8 = dR + radius;
        const double f_disc_r_x = x8;
        const double f_disc_r_y = beta_z*x8;
        const double f_disc_r_z = beta_x*x8;
        const double f_disc_tau_zy = -beta_x*beta_z;
        const double f_r_x = FMA(-f_disc_r_y, sin_psi, cos_psi*f_disc_r_x);
        const double f_r_y = FMA(f_disc_r_x, sin_psi, cos_psi*f_disc_r_y);
        const double x9 = FMA(beta_z, cos_psi, sin_psi);
        const double f_tau_xx = -x9;
        const double x10 = FMA(-beta_z, sin_psi, cos_psi);
        const double f_tau_xy = x10;
        const double f_tau_yx = x10;
        const double f_tau_yy = x9;
        const double f_tau_zx = FMA(-f_disc_tau_zy, sin_psi, -beta_x*cos_psi);
        const double f_tau_zy = FMA(-beta_x, sin_psi, cos_psi*f_disc_tau_zy);
        const double f_f_x = FMA(M_xz, f_disc_r_z, FMA(M_xy, f_r_y, FMA(M_xx, f_r_x, a_x)));
        const double f_f_y = FMA(M_yz, f_disc_r_z, FMA(M_yy, f_r_y, FMA(M_yx, f_r_x, a_y)));
        const double f_f_z = FMA(M_zz, f_disc_r_z, FMA(M_zy, f_r_y, FMA(M_zx, f_r_x, a_z)));
        const double f_f_xj = FMA(f_f_y, f_tau_xy, f_f_x*f_tau_xx);
        const double f_f_yj = FMA(f_f_y, f_tau_yy, FMA(-beta_x, f_f_z, f_f_x*f_tau_yx));
        const double f_f_zj = FMA(f_f_y, f_tau_zy, FMA(f_f_x, f_tau_zx, -f_f_z));
        const double f_f_i = FMA(-f_f_zj, vartheta_y, FMA(f_f_yj, vartheta_z, f_f_xj));
        const double q_disc_r_x = x8;
        const double q_r_x = cos_psi*q_disc_r_x;
        const double q_r_y = q_disc_r_x*sin_psi;
        const double q_f_x = FMA(M_xy, q_r_y, FMA(M_xx, q_r_x, a_x));
        const double q_f_y = FMA(M_yy, q_r_y, FMA(M_yx, q_r_x, a_y));
        const double q_f_z = FMA(M_zy, q_r_y, FMA(M_zx, q_r_x, a_z));
        const double q_f_xj = FMA(-q_f_x, sin_psi, cos_psi*q_f_y);
        const double q_f_yj = FMA(q_f_y, sin_psi, cos_psi*q_f_x);
        const double x11 = K6*q_f_xj;
        const double x12 = (q_f_xj*q_f_xj);
        const double x13 = (q_f_yj*q_f_yj);
        const double x14 = (q_f_z*q_f_z);
        const double x15 = K4*q_f_z;
        const double x16 = K8*q_f_z;
        const double i_sensed = FMA(-q_f_yj, x16, FMA(q_f_yj, x11, FMA(-q_f_xj, x15, FMA(K7, x14, FMA(K5, x13, FMA(K2, x12, K0 + f_f_i))))));
        const double bar_i_sensed = K1*k_VI;
        const double bar_q_f_yj = bar_i_sensed*(FMA(2.0, K5*q_f_yj, x11 - x16));
        const double bar_q_f_xj = bar_i_sensed*(FMA(K6, q_f_yj, FMA(2.0, K2*q_f_xj, -x15)));
        const double bar_q_f_z = bar_i_sensed*(FMA(-K8, q_f_yj, FMA(-K4, q_f_xj, 2.0*K7*q_f_z)));
        const double bar_q_f_y = FMA(bar_q_f_yj, sin_psi, bar_q_f_xj*cos_psi);
        const double bar_q_f_x = FMA(-bar_q_f_xj, sin_psi, bar_q_f_yj*cos_psi);
        const double bar_q_r_y = FMA(M_zy, bar_q_f_z, FMA(M_yy, bar_q_f_y, M_xy*bar_q_f_x));
        const double bar_q_r_x = FMA(M_zx, bar_q_f_z, FMA(M_yx, bar_q_f_y, M_xx*bar_q_f_x));
        const double bar_q_disc_r_x = FMA(bar_q_r_y, sin_psi, bar_q_r_x*cos_psi);
        const double bar_f_f_zj = -bar_i_sensed*vartheta_y;
        const double bar_f_f_yj = bar_i_sensed*vartheta_z;
        const double bar_f_f_z = FMA(-bar_f_f_yj, beta_x, -bar_f_f_zj);
        const double bar_f_f_y = FMA(bar_i_sensed, f_tau_xy, FMA(bar_f_f_zj, f_tau_zy, bar_f_f_yj*f_tau_yy));
        const double bar_f_f_x = FMA(bar_i_sensed, f_tau_xx, FMA(bar_f_f_zj, f_tau_zx, bar_f_f_yj*f_tau_yx));
        const double bar_f_tau_zy = bar_f_f_zj*f_f_y;
        const double bar_f_tau_zx = bar_f_f_zj*f_f_x;
        const double bar_f_tau_yy = bar_f_f_yj*f_f_y;
        const double bar_f_tau_yx = bar_f_f_yj*f_f_x;
        const double bar_f_tau_xy = bar_i_sensed*f_f_y;
        const double bar_f_tau_xx = bar_i_sensed*f_f_x;
        const double bar_f_r_y = FMA(M_zy, bar_f_f_z, FMA(M_yy, bar_f_f_y, M_xy*bar_f_f_x));
        const double bar_f_r_x = FMA(M_zx, bar_f_f_z, FMA(M_yx, bar_f_f_y, M_xx*bar_f_f_x));
        const double bar_f_disc_tau_zy = FMA(-bar_f_tau_zx, sin_psi, bar_f_tau_zy*cos_psi);
        const double bar_f_disc_r_z = FMA(M_zz, bar_f_f_z, FMA(M_yz, bar_f_f_y, M_xz*bar_f_f_x));
        const double bar_f_disc_r_y = FMA(-bar_f_r_x, sin_psi, bar_f_r_y*cos_psi);
        const double bar_f_disc_r_x = FMA(bar_f_r_y, sin_psi, bar_f_r_x*cos_psi);
        const double x17 = bar_i_sensed*q_f_xj;

        rows[0][i] = FMA(bar_f_disc_r_z, beta_x, FMA(bar_f_disc_r_y, beta_z, bar_f_disc_r_x + bar_q_disc_r_x)); /* dR */
        rows[1][i] = FMA(-bar_f_tau_zy, sin_psi, FMA(-bar_f_tau_zx, cos_psi, FMA(-bar_f_f_yj, f_f_z, FMA(-bar_f_disc_tau_zy, beta_z, bar_f_disc_r_z*x8)))); /* beta_x */
        rows[2][i] = FMA(bar_f_tau_yy, cos_psi, FMA(-bar_f_tau_yx, sin_psi, FMA(-bar_f_tau_xy, sin_psi, FMA(-bar_f_tau_xx, cos_psi, FMA(-bar_f_disc_tau_zy, beta_x, bar_f_disc_r_y*x8))))); /* beta_z */
        rows[3][i] = 0.0; /* vartheta_x */
        rows[4][i] = -bar_i_sensed*f_f_zj; /* vartheta_y */
        rows[5][i] = bar_i_sensed*f_f_yj; /* vartheta_z */
        rows[6][i] = bar_i_sensed; /* K0 */
        rows[7][i] = i_sensed*k_VI; /* K1 */
        rows[8][i] = bar_i_sensed*x12; /* K2 */
        rows[9][i] = -q_f_z*x17; /* K4 */
        rows[10][i] = bar_i_sensed*x13; /* K5 */
        rows[11][i] = q_f_yj*x17; /* K6 */
        rows[12][i] = bar_i_sensed*x14; /* K7 */
        rows[13][i] = -bar_i_sensed*q_f_yj*q_f_z; /* K8 */
        rows[14][i] = K1*i_sensed; /* k_VI */
    }
    for (size_t k = 0; k < ROWS; ++k) {
        for (size_t i = 0; i < n; ++i) {
            out_D[k * stride + i] = rows[k][i];
        }
    }
}

void ragg_chain_voltages(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                        double *V) {
    double cosine[BLOCK], sine[BLOCK];
    for (size_t at = 0, size; at < n; at += size) {
        size = turning(at, n, t, p[1], angle, cosine, sine);
        for (size_t j = 0; j < 4; ++j) {
            block(j, size, at, t, cosine, sine, in, p, V + j * n + at);
        }
    }
}

void ragg_chain_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                      double *G) {
    double cosine[BLOCK], sine[BLOCK], v[4][BLOCK];
    for (size_t at = 0, size; at < n; at += size) {
        size = turning(at, n, t, p[1], angle, cosine, sine);
        for (size_t j = 0; j < 4; ++j) {
            block(j, size, at, t, cosine, sine, in, p, v[j]);
        }
        for (size_t i = 0; i < size; ++i) {
            G[at + i] = (v[0][i] + v[1][i]) - (v[2][i] + v[3][i]);
        }
    }
}

void ragg_chain_derivatives(size_t j, size_t n, const double *t, const double *const *in, const double *p,
                           const double *angle, double *D) {
    double cosine[BLOCK], sine[BLOCK];
    for (size_t at = 0, size; at < n; at += size) {
        size = turning(at, n, t, p[1], angle, cosine, sine);
        for (size_t k = 0; k < size; k += STEP) {
            slopes(j, size - k < STEP ? size - k : STEP, at + k, n, t, cosine + k, sine + k, in, p, D + at + k);
        }
    }
}
