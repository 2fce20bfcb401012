/* Signatures: what each candidate effect would add to V_j.
 * Derived; do not edit: change the derivation and derive again. */
#include "signatures.h"

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

enum { ROWS = 162, STEP = 64, INPUTS = 41 };

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
    const double *restrict in_d2_spin_angle = in[25] + at;
    const double *restrict in_d_spin_angle = in[32] + at;
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

/* Derivatives of V_j at n <= STEP samples from at on, a row every stride numbers.
 * STEP samples are read: a loop of a known length is compiled to vectors in a third of the time, and faster ones. */
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
    const double *restrict in_B_x = in[15] + at;
    const double *restrict in_B_y = in[16] + at;
    const double *restrict in_B_z = in[17] + at;
    const double *restrict in_angular_vibration_rms = in[18] + at;
    const double *restrict in_d2_a_x = in[19] + at;
    const double *restrict in_d2_a_y = in[20] + at;
    const double *restrict in_d2_a_z = in[21] + at;
    const double *restrict in_d2_omegadot_x = in[22] + at;
    const double *restrict in_d2_omegadot_y = in[23] + at;
    const double *restrict in_d2_omegadot_z = in[24] + at;
    const double *restrict in_d2_spin_angle = in[25] + at;
    const double *restrict in_d_a_x = in[26] + at;
    const double *restrict in_d_a_y = in[27] + at;
    const double *restrict in_d_a_z = in[28] + at;
    const double *restrict in_d_omegadot_x = in[29] + at;
    const double *restrict in_d_omegadot_y = in[30] + at;
    const double *restrict in_d_omegadot_z = in[31] + at;
    const double *restrict in_d_spin_angle = in[32] + at;
    const double *restrict in_d_temperature = in[33] + at;
    const double *restrict in_fuel_mass = in[34] + at;
    const double *restrict in_pitch = in[35] + at;
    const double *restrict in_pressure = in[36] + at;
    const double *restrict in_roll = in[37] + at;
    const double *restrict in_temperature = in[38] + at;
    const double *restrict in_vibration_rms = in[39] + at;
    const double *restrict in_yaw = in[40] + at;
    /* beforehand: a call within the loop would keep it from becoming one of vectors */
    double cos_of_pitch[BLOCK], sin_of_pitch[BLOCK];
    encoder(STEP, in_pitch, cos_of_pitch, sin_of_pitch);
    double cos_of_roll[BLOCK], sin_of_roll[BLOCK];
    encoder(STEP, in_roll, cos_of_roll, sin_of_roll);
    double cos_of_yaw[BLOCK], sin_of_yaw[BLOCK];
    encoder(STEP, in_yaw, cos_of_yaw, sin_of_yaw);
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
    const double cos_j = COS_J[j], sin_j = SIN_J[j];
    (void)cos_j, (void)sin_j, (void)t, (void)cosine, (void)sine;

    double rows[ROWS][STEP]; /* which overlap nothing: the loop becomes one of vectors */
    for (size_t i = 0; i < STEP; ++i) {
        const double time = t[at + i];
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
        const double B_x = in_B_x[i];
        const double B_y = in_B_y[i];
        const double B_z = in_B_z[i];
        const double angular_vibration_rms = in_angular_vibration_rms[i];
        const double d2_a_x = in_d2_a_x[i];
        const double d2_a_y = in_d2_a_y[i];
        const double d2_a_z = in_d2_a_z[i];
        const double d2_omegadot_x = in_d2_omegadot_x[i];
        const double d2_omegadot_y = in_d2_omegadot_y[i];
        const double d2_omegadot_z = in_d2_omegadot_z[i];
        const double d2_spin_angle = in_d2_spin_angle[i];
        const double d_a_x = in_d_a_x[i];
        const double d_a_y = in_d_a_y[i];
        const double d_a_z = in_d_a_z[i];
        const double d_omegadot_x = in_d_omegadot_x[i];
        const double d_omegadot_y = in_d_omegadot_y[i];
        const double d_omegadot_z = in_d_omegadot_z[i];
        const double d_spin_angle = in_d_spin_angle[i];
        const double d_temperature = in_d_temperature[i];
        const double fuel_mass = in_fuel_mass[i];
        const double pressure = in_pressure[i];
        const double temperature = in_temperature[i];
        const double vibration_rms = in_vibration_rms[i];
        const double cos_yaw = cos_of_yaw[i];
        const double sin_yaw = sin_of_yaw[i];
        const double x0 = (omega_y*omega_y);
        const double x1 = d_spin_angle + omega_z;
        const double x2 = -x1;
        const double x3 = -x1*x2;
        const double M_xx = -Gamma_xx - x0 - x3;
        const double x4 = d2_spin_angle + omegadot_z;
        const double x5 = omega_x*omega_y;
        const double x6 = Gamma_xy - x5;
        const double M_xy = -x4 - x6;
        const double x7 = -omegadot_y;
        const double x8 = d_spin_angle*omega_x;
        const double x9 = x7 + x8;
        const double M_xz = FMA(-omega_x, x2, -Gamma_xz - x9);
        const double x10 = omegadot_z + x5;
        const double x11 = -Gamma_xy + x10;
        const double M_yx = d2_spin_angle + x11;
        const double x12 = (omega_x*omega_x);
        const double M_yy = -Gamma_yy - x12 - x3;
        const double x13 = d_spin_angle*omega_y;
        const double x14 = omegadot_x + x13;
        const double M_yz = FMA(omega_y, x1, -Gamma_yz - x14);
        const double x15 = Gamma_xz + omegadot_y;
        const double M_zx = FMA(omega_x, x1, -x15 + x8);
        const double x16 = -omegadot_x;
        const double M_zy = FMA(-omega_y, x2, -Gamma_yz + x13 - x16);
        const double x17 = x0 + x12;
        const double x18 = -Gamma_zz - x17;
        const double M_zz = x18;
        const double cos_psi = FMA(-sin_j, sin_phi, cos_j*cos_phi);
        const double sin_psi = FMA(cos_phi, sin_j, cos_j*sin_phi);
        const double x19 = dR + radius;
        const double b_disc_r_x = x19;
        const double x20 = beta_z*x19;
        const double b_disc_r_y = x20;
        const double x21 = beta_x*x19;
        const double b_disc_r_z = x21;
        const double x22 = -beta_x*beta_z;
        const double b_disc_tau_zy = x22;
        const double b_r_x = FMA(-b_disc_r_y, sin_psi, b_disc_r_x*cos_psi);
        const double b_r_y = FMA(b_disc_r_y, cos_psi, b_disc_r_x*sin_psi);
        const double x23 = FMA(beta_z, cos_psi, sin_psi);
        const double x24 = -x23;
        const double b_tau_xx = x24;
        const double x25 = FMA(-beta_z, sin_psi, cos_psi);
        const double b_tau_xy = x25;
        const double b_tau_yx = x25;
        const double b_tau_yy = x23;
        const double x26 = beta_x*cos_psi;
        const double b_tau_zx = FMA(-b_disc_tau_zy, sin_psi, -x26);
        const double x27 = beta_x*sin_psi;
        const double b_tau_zy = FMA(b_disc_tau_zy, cos_psi, -x27);
        const double x28 = d_spin_angle*sin_phi;
        const double x29 = -x28;
        const double rate_cos_phi_true = x29;
        const double x30 = cos_phi*d_spin_angle;
        const double rate_sin_phi_true = x30;
        const double x31 = d2_spin_angle*sin_phi;
        const double x32 = (d_spin_angle*d_spin_angle);
        const double x33 = cos_phi*x32;
        const double x34 = -x31 - x33;
        const double rate_rate_cos_phi_true = x34;
        const double x35 = cos_phi*d2_spin_angle;
        const double x36 = sin_phi*x32;
        const double x37 = x35 - x36;
        const double rate_rate_sin_phi_true = x37;
        const double b_f_x = FMA(M_xz, b_disc_r_z, FMA(M_xy, b_r_y, FMA(M_xx, b_r_x, a_x)));
        const double b_f_y = FMA(M_yz, b_disc_r_z, FMA(M_yy, b_r_y, FMA(M_yx, b_r_x, a_y)));
        const double b_f_z = FMA(M_zz, b_disc_r_z, FMA(M_zy, b_r_y, FMA(M_zx, b_r_x, a_z)));
        const double b_f_xj = FMA(b_f_y, b_tau_xy, b_f_x*b_tau_xx);
        const double b_f_yj = FMA(-b_f_z, beta_x, FMA(b_f_y, b_tau_yy, b_f_x*b_tau_yx));
        const double b_f_zj = FMA(b_f_y, b_tau_zy, FMA(b_f_x, b_tau_zx, -b_f_z));
        const double f_disc_r_x = x19;
        const double f_disc_r_y = x20;
        const double f_disc_r_z = x21;
        const double f_disc_tau_zy = x22;
        const double f_r_x = FMA(-f_disc_r_y, sin_psi, cos_psi*f_disc_r_x);
        const double f_r_y = FMA(f_disc_r_x, sin_psi, cos_psi*f_disc_r_y);
        const double f_tau_xx = x24;
        const double f_tau_xy = x25;
        const double f_tau_yx = x25;
        const double f_tau_yy = x23;
        const double f_tau_zx = FMA(-f_disc_tau_zy, sin_psi, -x26);
        const double f_tau_zy = FMA(cos_psi, f_disc_tau_zy, -x27);
        const double x38 = 1.0/x19;
        const double f_arm_x = f_r_x*x38;
        const double f_arm_y = f_r_y*x38;
        const double f_arm_z = f_disc_r_z*x38;
        const double x39 = 2.0*omega_y;
        const double x40 = omegadot_y*x39;
        const double x41 = 2.0*d_spin_angle;
        const double x42 = 2.0*omega_z;
        const double x43 = -x41 - x42;
        const double x44 = FMA(omegadot_z, x43, d2_spin_angle*x43);
        const double x45 = -x40 + x44;
        const double rate_M_xx = x45;
        const double x46 = FMA(omega_y, omegadot_x, omega_x*omegadot_y);
        const double x47 = -d_omegadot_z + x46;
        const double rate_M_xy = x47;
        const double x48 = omega_x*omegadot_z;
        const double x49 = FMA(omega_z, omegadot_x, d_omegadot_y + x48);
        const double rate_M_xz = x49;
        const double V2__rate_cos_phi_true = x29;
        const double V2__rate_sin_phi_true = x30;
        const double rate_cos_psi = FMA(-V2__rate_sin_phi_true, sin_j, V2__rate_cos_phi_true*cos_j);
        const double rate_sin_psi = FMA(V2__rate_sin_phi_true, cos_j, V2__rate_cos_phi_true*sin_j);
        const double rate_b_r_x = FMA(-b_disc_r_y, rate_sin_psi, b_disc_r_x*rate_cos_psi);
        const double rate_b_r_y = FMA(b_disc_r_y, rate_cos_psi, b_disc_r_x*rate_sin_psi);
        const double rate_b_f_x = FMA(b_r_y, rate_M_xy, FMA(b_r_x, rate_M_xx, FMA(b_disc_r_z, rate_M_xz, FMA(M_xy, rate_b_r_y, FMA(M_xx, rate_b_r_x, d_a_x)))));
        const double x50 = d_omegadot_z + x46;
        const double rate_M_yx = x50;
        const double x51 = 2.0*omegadot_x;
        const double x52 = omega_x*x51;
        const double x53 = x44 - x52;
        const double rate_M_yy = x53;
        const double x54 = omega_y*omegadot_z;
        const double x55 = FMA(omega_z, omegadot_y, -d_omegadot_x + x54);
        const double rate_M_yz = x55;
        const double rate_b_f_y = FMA(b_r_y, rate_M_yy, FMA(b_r_x, rate_M_yx, FMA(b_disc_r_z, rate_M_yz, FMA(M_yy, rate_b_r_y, FMA(M_yx, rate_b_r_x, d_a_y)))));
        const double x56 = 2.0*d2_spin_angle;
        const double x57 = omega_z + x41;
        const double x58 = FMA(omegadot_x, x57, FMA(omega_x, x56, -d_omegadot_y + x48));
        const double rate_M_zx = x58;
        const double x59 = FMA(omegadot_y, x57, FMA(omega_y, x56, d_omegadot_x + x54));
        const double rate_M_zy = x59;
        const double x60 = -x40 - x52;
        const double rate_M_zz = x60;
        const double rate_b_f_z = FMA(b_r_y, rate_M_zy, FMA(b_r_x, rate_M_zx, FMA(b_disc_r_z, rate_M_zz, FMA(M_zy, rate_b_r_y, FMA(M_zx, rate_b_r_x, d_a_z)))));
        const double rate_b_tau_yx = FMA(-beta_z, rate_sin_psi, rate_cos_psi);
        const double rate_b_tau_yy = FMA(beta_z, rate_cos_psi, rate_sin_psi);
        const double rate_b_f_yj = FMA(-beta_x, rate_b_f_z, FMA(b_tau_yy, rate_b_f_y, FMA(b_tau_yx, rate_b_f_x, FMA(b_f_y, rate_b_tau_yy, b_f_x*rate_b_tau_yx))));
        const double rate_b_tau_zx = FMA(-beta_x, rate_cos_psi, -b_disc_tau_zy*rate_sin_psi);
        const double rate_b_tau_zy = FMA(-beta_x, rate_sin_psi, b_disc_tau_zy*rate_cos_psi);
        const double rate_b_f_zj = FMA(b_tau_zy, rate_b_f_y, FMA(b_tau_zx, rate_b_f_x, FMA(b_f_y, rate_b_tau_zy, FMA(b_f_x, rate_b_tau_zx, -rate_b_f_z))));
        const double rate_V2__rate_cos_phi_true = x34;
        const double rate_V2__rate_sin_phi_true = x37;
        const double x61 = 2.0*(omegadot_y*omegadot_y);
        const double x62 = d_omegadot_y*x39;
        const double x63 = 2.0*omegadot_z;
        const double x64 = -x56 - x63;
        const double x65 = FMA(omegadot_z, x64, FMA(d_omegadot_z, x43, d2_spin_angle*x64));
        const double x66 = -x61 - x62 + x65;
        const double rate_rate_M_xx = x66;
        const double x67 = FMA(omegadot_y, x51, FMA(d_omegadot_y, omega_x, d_omegadot_x*omega_y));
        const double x68 = -d2_omegadot_z + x67;
        const double rate_rate_M_xy = x68;
        const double x69 = d_omegadot_z*omega_x;
        const double x70 = FMA(omegadot_x, x63, FMA(d_omegadot_x, omega_z, d2_omegadot_y + x69));
        const double rate_rate_M_xz = x70;
        const double rate_rate_cos_psi = FMA(-rate_V2__rate_sin_phi_true, sin_j, cos_j*rate_V2__rate_cos_phi_true);
        const double rate_rate_sin_psi = FMA(rate_V2__rate_cos_phi_true, sin_j, cos_j*rate_V2__rate_sin_phi_true);
        const double rate_rate_b_r_x = FMA(-b_disc_r_y, rate_rate_sin_psi, b_disc_r_x*rate_rate_cos_psi);
        const double rate_rate_b_r_y = FMA(b_disc_r_y, rate_rate_cos_psi, b_disc_r_x*rate_rate_sin_psi);
        const double x71 = 2.0*rate_b_r_x;
        const double x72 = 2.0*rate_b_r_y;
        const double rate_rate_b_f_x = FMA(rate_M_xy, x72, FMA(rate_M_xx, x71, FMA(b_r_y, rate_rate_M_xy, FMA(b_r_x, rate_rate_M_xx, FMA(b_disc_r_z, rate_rate_M_xz, FMA(M_xy, rate_rate_b_r_y, FMA(M_xx, rate_rate_b_r_x, d2_a_x)))))));
        const double x73 = d2_omegadot_z + x67;
        const double rate_rate_M_yx = x73;
        const double x74 = 2.0*(omegadot_x*omegadot_x);
        const double x75 = 2.0*omega_x;
        const double x76 = d_omegadot_x*x75;
        const double x77 = x65 - x74 - x76;
        const double rate_rate_M_yy = x77;
        const double x78 = d_omegadot_z*omega_y;
        const double x79 = FMA(omegadot_y, x63, FMA(d_omegadot_y, omega_z, -d2_omegadot_x + x78));
        const double rate_rate_M_yz = x79;
        const double rate_rate_b_f_y = FMA(rate_M_yy, x72, FMA(rate_M_yx, x71, FMA(b_r_y, rate_rate_M_yy, FMA(b_r_x, rate_rate_M_yx, FMA(b_disc_r_z, rate_rate_M_yz, FMA(M_yy, rate_rate_b_r_y, FMA(M_yx, rate_rate_b_r_x, d2_a_y)))))));
        const double x80 = omegadot_z + x56;
        const double x81 = FMA(omegadot_x, x80, FMA(omegadot_x, x56, FMA(omegadot_x, omegadot_z, FMA(d_omegadot_x, x57, -d2_omegadot_y + x69))));
        const double rate_rate_M_zx = x81;
        const double x82 = FMA(omegadot_y, x80, FMA(omegadot_y, x56, FMA(omegadot_y, omegadot_z, FMA(d_omegadot_y, x57, d2_omegadot_x + x78))));
        const double rate_rate_M_zy = x82;
        const double x83 = -x61 - x62 - x74 - x76;
        const double rate_rate_M_zz = x83;
        const double rate_rate_b_f_z = FMA(rate_M_zy, x72, FMA(rate_M_zx, x71, FMA(b_r_y, rate_rate_M_zy, FMA(b_r_x, rate_rate_M_zx, FMA(b_disc_r_z, rate_rate_M_zz, FMA(M_zy, rate_rate_b_r_y, FMA(M_zx, rate_rate_b_r_x, d2_a_z)))))));
        const double rate_rate_b_tau_yx = FMA(-beta_z, rate_rate_sin_psi, rate_rate_cos_psi);
        const double rate_rate_b_tau_yy = FMA(beta_z, rate_rate_cos_psi, rate_rate_sin_psi);
        const double x84 = 2.0*rate_b_f_x;
        const double x85 = 2.0*rate_b_f_y;
        const double rate_rate_b_f_yj = FMA(rate_b_tau_yy, x85, FMA(rate_b_tau_yx, x84, FMA(-beta_x, rate_rate_b_f_z, FMA(b_tau_yy, rate_rate_b_f_y, FMA(b_tau_yx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_yy, b_f_x*rate_rate_b_tau_yx))))));
        const double rate_rate_b_tau_zx = FMA(-beta_x, rate_rate_cos_psi, -b_disc_tau_zy*rate_rate_sin_psi);
        const double rate_rate_b_tau_zy = FMA(-beta_x, rate_rate_sin_psi, b_disc_tau_zy*rate_rate_cos_psi);
        const double rate_rate_b_f_zj = FMA(rate_b_tau_zy, x85, FMA(rate_b_tau_zx, x84, FMA(b_tau_zy, rate_rate_b_f_y, FMA(b_tau_zx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_zy, FMA(b_f_x, rate_rate_b_tau_zx, -rate_rate_b_f_z))))));
        const double f_f_x = FMA(M_xz, f_disc_r_z, FMA(M_xy, f_r_y, FMA(M_xx, f_r_x, a_x)));
        const double f_f_y = FMA(M_yz, f_disc_r_z, FMA(M_yy, f_r_y, FMA(M_yx, f_r_x, a_y)));
        const double f_f_z = FMA(M_zz, f_disc_r_z, FMA(M_zy, f_r_y, FMA(M_zx, f_r_x, a_z)));
        const double f_f_xj = FMA(f_f_y, f_tau_xy, f_f_x*f_tau_xx);
        const double f_f_yj = FMA(f_f_y, f_tau_yy, FMA(-beta_x, f_f_z, f_f_x*f_tau_yx));
        const double f_f_zj = FMA(f_f_y, f_tau_zy, FMA(f_f_x, f_tau_zx, -f_f_z));
        const double f_f_i = FMA(-f_f_zj, vartheta_y, FMA(f_f_yj, vartheta_z, f_f_xj));
        const double f_f_o = FMA(f_f_zj, vartheta_x, FMA(-f_f_xj, vartheta_z, f_f_yj));
        const double f_f_p = FMA(-f_f_yj, vartheta_x, FMA(f_f_xj, vartheta_y, f_f_zj));
        const double q_disc_r_x = x19;
        const double q_r_x = cos_psi*q_disc_r_x;
        const double q_r_y = q_disc_r_x*sin_psi;
        const double q_arm_x = q_r_x*x38;
        const double q_arm_y = q_r_y*x38;
        const double q_f_x = FMA(M_xy, q_r_y, FMA(M_xx, q_r_x, a_x));
        const double q_f_y = FMA(M_yy, q_r_y, FMA(M_yx, q_r_x, a_y));
        const double q_f_z = FMA(M_zy, q_r_y, FMA(M_zx, q_r_x, a_z));
        const double q_f_xj = FMA(-q_f_x, sin_psi, cos_psi*q_f_y);
        const double q_f_yj = FMA(q_f_y, sin_psi, cos_psi*q_f_x);
        const double x86 = K6*q_f_yj;
        const double x87 = K4*q_f_z;
        const double x88 = K8*q_f_z;
        const double i_sensed = FMA(-q_f_yj, x88, FMA(-q_f_xj, x87, FMA(q_f_xj, x86, FMA(K7, q_f_z*q_f_z, FMA(K5, q_f_yj*q_f_yj, FMA(K2, q_f_xj*q_f_xj, K0 + f_f_i))))));
        const double V2__rate_M_xx = x45;
        const double V2__rate_M_xy = x47;
        const double V2__rate_M_xz = x49;
        const double V2__rate_cos_psi = FMA(-rate_sin_phi_true, sin_j, cos_j*rate_cos_phi_true);
        const double V2__rate_sin_psi = FMA(rate_cos_phi_true, sin_j, cos_j*rate_sin_phi_true);
        const double rate_f_r_x = FMA(-V2__rate_sin_psi, f_disc_r_y, V2__rate_cos_psi*f_disc_r_x);
        const double rate_f_r_y = FMA(V2__rate_sin_psi, f_disc_r_x, V2__rate_cos_psi*f_disc_r_y);
        const double rate_f_f_x = FMA(V2__rate_M_xz, f_disc_r_z, FMA(V2__rate_M_xy, f_r_y, FMA(V2__rate_M_xx, f_r_x, FMA(M_xy, rate_f_r_y, FMA(M_xx, rate_f_r_x, d_a_x)))));
        const double V2__rate_M_yx = x50;
        const double V2__rate_M_yy = x53;
        const double V2__rate_M_yz = x55;
        const double rate_f_f_y = FMA(V2__rate_M_yz, f_disc_r_z, FMA(V2__rate_M_yy, f_r_y, FMA(V2__rate_M_yx, f_r_x, FMA(M_yy, rate_f_r_y, FMA(M_yx, rate_f_r_x, d_a_y)))));
        const double x89 = FMA(V2__rate_cos_psi, beta_z, V2__rate_sin_psi);
        const double rate_f_tau_xx = -x89;
        const double x90 = FMA(-V2__rate_sin_psi, beta_z, V2__rate_cos_psi);
        const double rate_f_tau_xy = x90;
        const double rate_f_f_xj = FMA(f_tau_xy, rate_f_f_y, FMA(f_tau_xx, rate_f_f_x, FMA(f_f_y, rate_f_tau_xy, f_f_x*rate_f_tau_xx)));
        const double V2__rate_M_zx = x58;
        const double V2__rate_M_zy = x59;
        const double V2__rate_M_zz = x60;
        const double rate_f_f_z = FMA(V2__rate_M_zz, f_disc_r_z, FMA(V2__rate_M_zy, f_r_y, FMA(V2__rate_M_zx, f_r_x, FMA(M_zy, rate_f_r_y, FMA(M_zx, rate_f_r_x, d_a_z)))));
        const double rate_f_tau_yx = x90;
        const double rate_f_tau_yy = x89;
        const double rate_f_f_yj = FMA(f_tau_yy, rate_f_f_y, FMA(f_tau_yx, rate_f_f_x, FMA(f_f_y, rate_f_tau_yy, FMA(-beta_x, rate_f_f_z, f_f_x*rate_f_tau_yx))));
        const double rate_f_tau_zx = FMA(-V2__rate_sin_psi, f_disc_tau_zy, -V2__rate_cos_psi*beta_x);
        const double rate_f_tau_zy = FMA(-V2__rate_sin_psi, beta_x, V2__rate_cos_psi*f_disc_tau_zy);
        const double rate_f_f_zj = FMA(f_tau_zy, rate_f_f_y, FMA(f_tau_zx, rate_f_f_x, FMA(f_f_y, rate_f_tau_zy, FMA(f_f_x, rate_f_tau_zx, -rate_f_f_z))));
        const double rate_f_f_i = FMA(-rate_f_f_zj, vartheta_y, FMA(rate_f_f_yj, vartheta_z, rate_f_f_xj));
        const double rate_V2__rate_M_xx = x66;
        const double rate_V2__rate_M_xy = x68;
        const double rate_V2__rate_M_xz = x70;
        const double rate_V2__rate_cos_psi = FMA(-rate_rate_sin_phi_true, sin_j, cos_j*rate_rate_cos_phi_true);
        const double rate_V2__rate_sin_psi = FMA(rate_rate_cos_phi_true, sin_j, cos_j*rate_rate_sin_phi_true);
        const double rate_rate_f_r_x = FMA(-f_disc_r_y, rate_V2__rate_sin_psi, f_disc_r_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_r_y = FMA(f_disc_r_y, rate_V2__rate_cos_psi, f_disc_r_x*rate_V2__rate_sin_psi);
        const double x91 = 2.0*rate_f_r_x;
        const double x92 = 2.0*rate_f_r_y;
        const double rate_rate_f_f_x = FMA(f_r_y, rate_V2__rate_M_xy, FMA(f_r_x, rate_V2__rate_M_xx, FMA(f_disc_r_z, rate_V2__rate_M_xz, FMA(V2__rate_M_xy, x92, FMA(V2__rate_M_xx, x91, FMA(M_xy, rate_rate_f_r_y, FMA(M_xx, rate_rate_f_r_x, d2_a_x)))))));
        const double rate_V2__rate_M_yx = x73;
        const double rate_V2__rate_M_yy = x77;
        const double rate_V2__rate_M_yz = x79;
        const double rate_rate_f_f_y = FMA(f_r_y, rate_V2__rate_M_yy, FMA(f_r_x, rate_V2__rate_M_yx, FMA(f_disc_r_z, rate_V2__rate_M_yz, FMA(V2__rate_M_yy, x92, FMA(V2__rate_M_yx, x91, FMA(M_yy, rate_rate_f_r_y, FMA(M_yx, rate_rate_f_r_x, d2_a_y)))))));
        const double x93 = FMA(beta_z, rate_V2__rate_cos_psi, rate_V2__rate_sin_psi);
        const double rate_rate_f_tau_xx = -x93;
        const double x94 = FMA(-beta_z, rate_V2__rate_sin_psi, rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_xy = x94;
        const double x95 = 2.0*rate_f_f_x;
        const double x96 = 2.0*rate_f_f_y;
        const double rate_rate_f_f_xj = FMA(rate_f_tau_xy, x96, FMA(rate_f_tau_xx, x95, FMA(f_tau_xy, rate_rate_f_f_y, FMA(f_tau_xx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_xy, f_f_x*rate_rate_f_tau_xx)))));
        const double rate_V2__rate_M_zx = x81;
        const double rate_V2__rate_M_zy = x82;
        const double rate_V2__rate_M_zz = x83;
        const double rate_rate_f_f_z = FMA(f_r_y, rate_V2__rate_M_zy, FMA(f_r_x, rate_V2__rate_M_zx, FMA(f_disc_r_z, rate_V2__rate_M_zz, FMA(V2__rate_M_zy, x92, FMA(V2__rate_M_zx, x91, FMA(M_zy, rate_rate_f_r_y, FMA(M_zx, rate_rate_f_r_x, d2_a_z)))))));
        const double rate_rate_f_tau_yx = x94;
        const double rate_rate_f_tau_yy = x93;
        const double rate_rate_f_f_yj = FMA(rate_f_tau_yy, x96, FMA(rate_f_tau_yx, x95, FMA(f_tau_yy, rate_rate_f_f_y, FMA(f_tau_yx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_yy, FMA(-beta_x, rate_rate_f_f_z, f_f_x*rate_rate_f_tau_yx))))));
        const double rate_rate_f_tau_zx = FMA(-f_disc_tau_zy, rate_V2__rate_sin_psi, -beta_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_zy = FMA(-beta_x, rate_V2__rate_sin_psi, f_disc_tau_zy*rate_V2__rate_cos_psi);
        const double rate_rate_f_f_zj = FMA(rate_f_tau_zy, x96, FMA(rate_f_tau_zx, x95, FMA(f_tau_zy, rate_rate_f_f_y, FMA(f_tau_zx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_zy, FMA(f_f_x, rate_rate_f_tau_zx, -rate_rate_f_f_z))))));
        const double rate_rate_f_f_i = FMA(-rate_rate_f_f_zj, vartheta_y, FMA(rate_rate_f_f_yj, vartheta_z, rate_rate_f_f_xj));
        const double rate_q_r_x = V2__rate_cos_psi*q_disc_r_x;
        const double rate_q_r_y = V2__rate_sin_psi*q_disc_r_x;
        const double rate_q_f_x = FMA(V2__rate_M_xy, q_r_y, FMA(V2__rate_M_xx, q_r_x, FMA(M_xy, rate_q_r_y, FMA(M_xx, rate_q_r_x, d_a_x))));
        const double rate_q_f_y = FMA(V2__rate_M_yy, q_r_y, FMA(V2__rate_M_yx, q_r_x, FMA(M_yy, rate_q_r_y, FMA(M_yx, rate_q_r_x, d_a_y))));
        const double rate_q_f_xj = FMA(-rate_q_f_x, sin_psi, FMA(cos_psi, rate_q_f_y, FMA(-V2__rate_sin_psi, q_f_x, V2__rate_cos_psi*q_f_y)));
        const double rate_q_f_yj = FMA(rate_q_f_y, sin_psi, FMA(cos_psi, rate_q_f_x, FMA(V2__rate_sin_psi, q_f_y, V2__rate_cos_psi*q_f_x)));
        const double rate_q_f_z = FMA(V2__rate_M_zy, q_r_y, FMA(V2__rate_M_zx, q_r_x, FMA(M_zy, rate_q_r_y, FMA(M_zx, rate_q_r_x, d_a_z))));
        const double rate_rate_q_r_x = q_disc_r_x*rate_V2__rate_cos_psi;
        const double rate_rate_q_r_y = q_disc_r_x*rate_V2__rate_sin_psi;
        const double x97 = 2.0*rate_q_r_x;
        const double x98 = 2.0*rate_q_r_y;
        const double rate_rate_q_f_x = FMA(q_r_y, rate_V2__rate_M_xy, FMA(q_r_x, rate_V2__rate_M_xx, FMA(V2__rate_M_xy, x98, FMA(V2__rate_M_xx, x97, FMA(M_xy, rate_rate_q_r_y, FMA(M_xx, rate_rate_q_r_x, d2_a_x))))));
        const double rate_rate_q_f_y = FMA(q_r_y, rate_V2__rate_M_yy, FMA(q_r_x, rate_V2__rate_M_yx, FMA(V2__rate_M_yy, x98, FMA(V2__rate_M_yx, x97, FMA(M_yy, rate_rate_q_r_y, FMA(M_yx, rate_rate_q_r_x, d2_a_y))))));
        const double x100 = 2.0*rate_q_f_x;
        const double x99 = 2.0*rate_q_f_y;
        const double rate_rate_q_f_xj = FMA(-rate_rate_q_f_x, sin_psi, FMA(q_f_y, rate_V2__rate_cos_psi, FMA(-q_f_x, rate_V2__rate_sin_psi, FMA(cos_psi, rate_rate_q_f_y, FMA(-V2__rate_sin_psi, x100, V2__rate_cos_psi*x99)))));
        const double rate_rate_q_f_yj = FMA(rate_rate_q_f_y, sin_psi, FMA(q_f_y, rate_V2__rate_sin_psi, FMA(q_f_x, rate_V2__rate_cos_psi, FMA(cos_psi, rate_rate_q_f_x, FMA(V2__rate_sin_psi, x99, V2__rate_cos_psi*x100)))));
        const double rate_rate_q_f_z = FMA(q_r_y, rate_V2__rate_M_zy, FMA(q_r_x, rate_V2__rate_M_zx, FMA(V2__rate_M_zy, x98, FMA(V2__rate_M_zx, x97, FMA(M_zy, rate_rate_q_r_y, FMA(M_zx, rate_rate_q_r_x, d2_a_z))))));
        const double x101 = 2.0*K2;
        const double x102 = 2.0*K5;
        const double x103 = 2.0*K7;
        const double x104 = FMA(q_f_xj, x101, x86 - x87);
        const double x105 = FMA(q_f_yj, x102, FMA(K6, q_f_xj, -x88));
        const double x106 = FMA(-q_f_z, x103, FMA(K8, q_f_yj, K4*q_f_xj));
        const double rate_rate_i_sensed = FMA(-rate_rate_q_f_z, x106, FMA(rate_rate_q_f_yj, x105, FMA(rate_rate_q_f_xj, x104, FMA(-rate_q_f_z, FMA(-rate_q_f_z, x103, FMA(K8, rate_q_f_yj, K4*rate_q_f_xj)), FMA(rate_q_f_yj, FMA(rate_q_f_yj, x102, FMA(-K8, rate_q_f_z, K6*rate_q_f_xj)), FMA(rate_q_f_xj, FMA(rate_q_f_xj, x101, FMA(-K4, rate_q_f_z, K6*rate_q_f_yj)), rate_rate_f_f_i))))));
        const double x107 = FMA(-f_tau_zx, vartheta_y, FMA(f_tau_yx, vartheta_z, f_tau_xx));
        const double vibration_axis_ix = x107;
        const double x108 = FMA(-f_tau_zy, vartheta_y, FMA(f_tau_yy, vartheta_z, f_tau_xy));
        const double vibration_axis_iy = x108;
        const double x109 = FMA(-beta_x, vartheta_z, vartheta_y);
        const double vibration_axis_iz = x109;
        const double vibration_axis_ox = FMA(f_tau_zx, vartheta_x, FMA(-f_tau_xx, vartheta_z, f_tau_yx));
        const double vibration_axis_oy = FMA(f_tau_zy, vartheta_x, FMA(-f_tau_xy, vartheta_z, f_tau_yy));
        const double vibration_axis_oz = -beta_x - vartheta_x;
        const double vibration_axis_px = FMA(-f_tau_yx, vartheta_x, FMA(f_tau_xx, vartheta_y, f_tau_zx));
        const double vibration_axis_py = FMA(-f_tau_yy, vartheta_x, FMA(f_tau_xy, vartheta_y, f_tau_zy));
        const double vibration_axis_pz = FMA(beta_x, vartheta_x, -(1.0));
        const double bar_i_vibration_rectification = K1*k_VI;
        const double bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x106;
        const double bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x105;
        const double bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x104;
        const double bar_q_f_y = FMA(bar_q_o_second_order_misalignment, sin_psi, bar_q_i_second_order_misalignment*cos_psi);
        const double bar_q_f_x = FMA(-bar_q_i_second_order_misalignment, sin_psi, bar_q_o_second_order_misalignment*cos_psi);
        const double bar_q_spin_axis_wobble_tau_yz = bar_q_o_second_order_misalignment*q_f_z;
        const double bar_q_spin_axis_wobble_tau_yy = bar_q_o_second_order_misalignment*q_f_y;
        const double bar_q_spin_axis_wobble_tau_yx = bar_q_o_second_order_misalignment*q_f_x;
        const double bar_q_spin_axis_wobble_tau_xz = bar_q_i_second_order_misalignment*q_f_z;
        const double bar_q_spin_axis_wobble_tau_xy = bar_q_i_second_order_misalignment*q_f_y;
        const double bar_q_spin_axis_wobble_tau_xx = bar_q_i_second_order_misalignment*q_f_x;
        const double bar_q_spin_axis_wobble_r_z = FMA(-M_zz, bar_q_p_second_order_misalignment, FMA(M_yz, bar_q_f_y, M_xz*bar_q_f_x));
        const double bar_q_spin_axis_wobble_r_y = FMA(-M_zy, bar_q_p_second_order_misalignment, FMA(M_yy, bar_q_f_y, M_xy*bar_q_f_x));
        const double bar_q_spin_axis_wobble_r_x = FMA(-M_zx, bar_q_p_second_order_misalignment, FMA(M_yx, bar_q_f_y, M_xx*bar_q_f_x));
        const double bar_q_disc_r_x = FMA(bar_q_spin_axis_wobble_r_y, sin_psi, bar_q_spin_axis_wobble_r_x*cos_psi);
        const double bar_f_f_zj = -bar_i_vibration_rectification*vartheta_y;
        const double bar_f_f_yj = bar_i_vibration_rectification*vartheta_z;
        const double bar_f_f_z = FMA(-bar_f_f_yj, beta_x, -bar_f_f_zj);
        const double bar_f_f_y = FMA(bar_i_vibration_rectification, f_tau_xy, FMA(bar_f_f_zj, f_tau_zy, bar_f_f_yj*f_tau_yy));
        const double bar_f_f_x = FMA(bar_i_vibration_rectification, f_tau_xx, FMA(bar_f_f_zj, f_tau_zx, bar_f_f_yj*f_tau_yx));
        const double bar_rate_rate_dR_arm_stretch = FMA(bar_q_f_y, q_arm_y, FMA(bar_q_f_x, q_arm_x, FMA(bar_f_f_z, f_arm_z, FMA(bar_f_f_y, f_arm_y, bar_f_f_x*f_arm_x))));
        const double x110 = 2.0*x1;
        const double bar_rate_dR_arm_stretch = FMA(-bar_q_p_second_order_misalignment, FMA(-q_arm_x, x39, q_arm_y*x75), FMA(bar_q_f_y, q_arm_x*x110, FMA(-bar_q_f_x, q_arm_y*x110, FMA(bar_f_f_z, FMA(-f_arm_x, x39, 2.0*f_arm_y*omega_x), FMA(bar_f_f_y, FMA(-f_arm_z, x75, f_arm_x*x110), bar_f_f_x*FMA(-f_arm_y, x110, 2.0*f_arm_z*omega_y))))));
        const double bar_f_spin_axis_wobble_tau_zz = bar_f_f_zj*f_f_z;
        const double bar_f_spin_axis_wobble_tau_zy = bar_f_f_zj*f_f_y;
        const double bar_f_spin_axis_wobble_tau_zx = bar_f_f_zj*f_f_x;
        const double bar_f_spin_axis_wobble_tau_yz = bar_f_f_yj*f_f_z;
        const double bar_f_spin_axis_wobble_tau_yy = bar_f_f_yj*f_f_y;
        const double bar_f_spin_axis_wobble_tau_yx = bar_f_f_yj*f_f_x;
        const double bar_f_spin_axis_wobble_tau_xz = bar_i_vibration_rectification*f_f_z;
        const double bar_f_spin_axis_wobble_tau_xy = bar_i_vibration_rectification*f_f_y;
        const double bar_f_spin_axis_wobble_tau_xx = bar_i_vibration_rectification*f_f_x;
        const double bar_f_spin_axis_wobble_r_z = FMA(M_zz, bar_f_f_z, FMA(M_yz, bar_f_f_y, M_xz*bar_f_f_x));
        const double bar_f_spin_axis_wobble_r_y = FMA(M_zy, bar_f_f_z, FMA(M_yy, bar_f_f_y, M_xy*bar_f_f_x));
        const double bar_f_spin_axis_wobble_r_x = FMA(M_zx, bar_f_f_z, FMA(M_yx, bar_f_f_y, M_xx*bar_f_f_x));
        const double bar_f_disc_r_y = FMA(-bar_f_spin_axis_wobble_r_x, sin_psi, bar_f_spin_axis_wobble_r_y*cos_psi);
        const double bar_f_disc_r_x = FMA(bar_f_spin_axis_wobble_r_y, sin_psi, bar_f_spin_axis_wobble_r_x*cos_psi);
        const double bar_K1_thermal_scale = i_sensed*k_VI;
        const double bar_vartheta_z_mount_compliance = bar_i_vibration_rectification*f_f_yj;
        const double bar_vartheta_y_mount_compliance = -bar_i_vibration_rectification*f_f_zj;
        const double bar_dR_arm_stretch = FMA(bar_f_spin_axis_wobble_r_z, beta_x, FMA(bar_f_disc_r_y, beta_z, bar_f_disc_r_x + bar_q_disc_r_x));
        const double x111 = bar_f_f_z - bar_q_p_second_order_misalignment;
        const double bar_rate_rate_run_out_z = x111;
        const double x112 = bar_f_f_y + bar_q_f_y;
        const double bar_rate_rate_run_out_y = x112;
        const double x113 = bar_f_f_x + bar_q_f_x;
        const double bar_rate_rate_run_out_x = x113;
        const double bar_rate_run_out_z = FMA(-bar_q_f_y, x75, FMA(bar_q_f_x, x39, FMA(-bar_f_f_y, x75, bar_f_f_x*x39)));
        const double bar_rate_run_out_y = FMA(-bar_q_p_second_order_misalignment, x75, FMA(-bar_q_f_x, x42, FMA(-bar_f_f_x, x42, 2.0*bar_f_f_z*omega_x)));
        const double bar_rate_run_out_x = FMA(bar_q_p_second_order_misalignment, x39, FMA(bar_q_f_y, x42, FMA(-bar_f_f_z, x39, bar_f_f_y*x42)));
        const double x114 = omega_x*omega_z;
        const double x115 = omegadot_y + x114;
        const double x116 = -Gamma_xz + x115;
        const double x117 = omega_y*omega_z;
        const double x118 = -Gamma_yz - omegadot_x + x117;
        const double bar_run_out_z = FMA(-bar_q_p_second_order_misalignment, x18, FMA(bar_q_f_y, x118, FMA(bar_q_f_x, x116, FMA(bar_f_f_z, x18, FMA(bar_f_f_y, x118, bar_f_f_x*x116)))));
        const double x119 = omegadot_x + x117;
        const double x120 = -Gamma_yz + x119;
        const double x121 = -omegadot_z - x6;
        const double x122 = (omega_z*omega_z);
        const double x123 = x12 + x122;
        const double x124 = -Gamma_yy - x123;
        const double bar_run_out_y = FMA(-bar_q_p_second_order_misalignment, x120, FMA(bar_q_f_y, x124, FMA(bar_q_f_x, x121, FMA(bar_f_f_z, x120, FMA(bar_f_f_y, x124, bar_f_f_x*x121)))));
        const double x125 = x114 - x15;
        const double x126 = x0 + x122;
        const double x127 = -Gamma_xx - x126;
        const double bar_run_out_x = FMA(-bar_q_p_second_order_misalignment, x125, FMA(bar_q_f_y, x11, FMA(bar_q_f_x, x127, FMA(bar_f_f_z, x125, FMA(bar_f_f_y, x11, bar_f_f_x*x127)))));
        const double bar_wobble_zy = FMA(bar_q_spin_axis_wobble_tau_yz, sin_psi, FMA(bar_q_spin_axis_wobble_tau_xz, cos_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_y, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zy, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yy, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xy, bar_f_spin_axis_wobble_r_z*f_r_y))))));
        const double bar_wobble_zx = FMA(bar_q_spin_axis_wobble_tau_yz, cos_psi, FMA(-bar_q_spin_axis_wobble_tau_xz, sin_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_x, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zx, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yx, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xx, bar_f_spin_axis_wobble_r_z*f_r_x))))));
        const double bar_wobble_yz = FMA(-bar_q_p_second_order_misalignment, q_f_y, FMA(-bar_f_spin_axis_wobble_tau_yy, beta_x, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zy)));
        const double bar_wobble_xz = FMA(-bar_q_p_second_order_misalignment, q_f_x, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_x, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zx)));
        const double bar_sin_psi = FMA(bar_q_spin_axis_wobble_r_y, q_disc_r_x, FMA(-bar_f_spin_axis_wobble_tau_zy, beta_x, FMA(-bar_f_spin_axis_wobble_tau_zx, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xy, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_x, FMA(-bar_f_spin_axis_wobble_r_x, f_disc_r_y, -bar_f_spin_axis_wobble_tau_xx + bar_f_spin_axis_wobble_tau_yy - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy)))))));
        const double bar_cos_psi = FMA(bar_q_spin_axis_wobble_r_x, q_disc_r_x, FMA(bar_f_spin_axis_wobble_tau_zy, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_zx, beta_x, FMA(bar_f_spin_axis_wobble_tau_yy, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xx, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_y, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_x, bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx)))))));
        const double x128 = bar_f_f_z*f_disc_r_z;
        const double bar_M_zz = x128;
        const double x129 = bar_f_f_z*f_r_y;
        const double x130 = bar_q_p_second_order_misalignment*q_r_y;
        const double bar_M_zy = x129 - x130;
        const double x131 = bar_q_p_second_order_misalignment*q_r_x;
        const double bar_M_zx = FMA(bar_f_f_z, f_r_x, -x131);
        const double x132 = bar_f_f_y*f_disc_r_z;
        const double bar_M_yz = x132;
        const double x133 = bar_f_f_y*f_r_y;
        const double x134 = bar_q_f_y*q_r_y;
        const double bar_M_yy = x133 + x134;
        const double x135 = bar_q_f_y*q_r_x;
        const double bar_M_yx = FMA(bar_f_f_y, f_r_x, x135);
        const double x136 = bar_f_f_x*f_disc_r_z;
        const double bar_M_xz = x136;
        const double x137 = bar_f_f_x*f_r_y;
        const double x138 = bar_q_f_x*q_r_y;
        const double bar_M_xy = x137 + x138;
        const double x139 = bar_q_f_x*q_r_x;
        const double bar_M_xx = FMA(bar_f_f_x, f_r_x, x139);
        const double x140 = -bar_M_xy + bar_M_yx;
        const double bar_spin_acceleration_true = x140;
        const double x141 = bar_M_zx*omega_x;
        const double x142 = bar_M_zy*omega_y;
        const double x143 = FMA(bar_M_yy, x43, bar_M_xx*x43);
        const double bar_spin_rate_true = FMA(2.0, x142, FMA(2.0, x141, x143));
        const double bar_sin_phi_true = FMA(-bar_cos_psi, sin_j, bar_sin_psi*cos_j);
        const double bar_cos_phi_true = FMA(bar_sin_psi, sin_j, bar_cos_psi*cos_j);
        const double bar_sin_delta_phi = FMA(-bar_cos_phi_true, sin_phi, bar_sin_phi_true*cos_phi);
        const double bar_time_offset_omegadot_z = x140;
        const double bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx;
        const double bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy;
        const double bar_time_offset_omega_z = FMA(bar_M_yz, omega_y, FMA(bar_M_xz, omega_x, x141 + x142 + x143));
        const double bar_time_offset_omega_y = FMA(-bar_M_zz, x39, FMA(bar_M_zy, x57, FMA(bar_M_yz, omega_z, FMA(bar_M_yx, omega_x, FMA(-bar_M_xx, x39, bar_M_xy*omega_x)))));
        const double bar_time_offset_omega_x = FMA(-bar_M_zz, x75, FMA(bar_M_zx, x57, FMA(-bar_M_yy, x75, FMA(bar_M_yx, omega_y, FMA(bar_M_xz, omega_z, bar_M_xy*omega_y)))));
        const double bar_time_offset_a_z = x111;
        const double bar_time_offset_a_y = x112;
        const double bar_time_offset_a_x = x113;
        const double bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy;
        const double bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx;
        const double bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx;
        const double x144 = a_y*bar_time_offset_a_z;
        const double x145 = bar_time_offset_omega_z*omega_y;
        const double x146 = bar_time_offset_omegadot_z*omegadot_y;
        const double bar_imu_turn_zy = x144 + x145 + x146;
        const double x147 = a_x*bar_time_offset_a_z;
        const double x148 = FMA(bar_time_offset_omegadot_z, omegadot_x, FMA(bar_time_offset_omega_z, omega_x, x147));
        const double bar_imu_turn_zx = x148;
        const double x149 = a_z*bar_time_offset_a_y;
        const double x150 = FMA(bar_time_offset_omegadot_y, omegadot_z, FMA(bar_time_offset_omega_y, omega_z, x149));
        const double bar_imu_turn_yz = x150;
        const double x151 = a_x*bar_time_offset_a_y;
        const double bar_imu_turn_yx = FMA(bar_time_offset_omegadot_y, omegadot_x, FMA(bar_time_offset_omega_y, omega_x, x151));
        const double x152 = a_z*bar_time_offset_a_x;
        const double x153 = bar_time_offset_omega_x*omega_z;
        const double x154 = bar_time_offset_omegadot_x*omegadot_z;
        const double bar_imu_turn_xz = x152 + x153 + x154;
        const double x155 = a_y*bar_time_offset_a_x;
        const double bar_imu_turn_xy = FMA(bar_time_offset_omegadot_x, omegadot_y, FMA(bar_time_offset_omega_x, omega_y, x155));
        const double x156 = (angular_vibration_rms*angular_vibration_rms);
        const double x157 = bar_M_yy*x156;
        const double x158 = bar_M_zz*x156;
        const double x159 = bar_M_xx*x156;
        const double x160 = bar_run_out_x*cos_phi;
        const double x161 = bar_run_out_y*cos_phi;
        const double x162 = bar_run_out_z*cos_phi;
        const double x163 = 2.0*cos_phi;
        const double x164 = 2.0*sin_phi;
        const double x165 = FMA(-rate_sin_phi_true, x164, rate_cos_phi_true*x163);
        const double x166 = (cos_phi*cos_phi);
        const double x167 = (sin_phi*sin_phi);
        const double x168 = x166 - x167;
        const double x169 = FMA(-2.0, rate_sin_phi_true*rate_sin_phi_true, FMA(-rate_rate_sin_phi_true, x164, FMA(rate_rate_cos_phi_true, x163, 2.0*rate_cos_phi_true*rate_cos_phi_true)));
        const double x170 = FMA(rate_sin_phi_true, x163, rate_cos_phi_true*x164);
        const double x171 = FMA(rate_rate_sin_phi_true, x163, FMA(rate_rate_cos_phi_true, x164, 4.0*rate_cos_phi_true*rate_sin_phi_true));
        const double x172 = bar_time_offset_a_x*d_a_x;
        const double x173 = bar_time_offset_a_y*d_a_y;
        const double x174 = bar_time_offset_a_z*d_a_z;
        const double x175 = bar_time_offset_omega_x*omegadot_x;
        const double x176 = bar_time_offset_omega_y*omegadot_y;
        const double x177 = bar_time_offset_omega_z*omegadot_z;
        const double x178 = bar_time_offset_omegadot_x*d_omegadot_x;
        const double x179 = bar_time_offset_omegadot_y*d_omegadot_y;
        const double x180 = bar_time_offset_omegadot_z*d_omegadot_z;
        const double x181 = bar_i_vibration_rectification*(f_f_i*f_f_i);
        const double x182 = (f_f_o*f_f_o);
        const double x183 = bar_i_vibration_rectification*f_f_i;
        const double x184 = (f_f_p*f_f_p);
        const double x185 = bar_sin_delta_phi*cos_phi;
        const double x186 = bar_spin_rate_true*x28;
        const double x187 = 4.0*cos_phi;
        const double x188 = (cos_phi*cos_phi*cos_phi);
        const double x189 = (sin_phi*sin_phi*sin_phi);
        const double x190 = 9.0*x166;
        const double x191 = 9.0*x32;
        const double x192 = 3.0*x188;
        const double x193 = 9.0*x167;
        const double x194 = (cos_phi*cos_phi*cos_phi*cos_phi);
        const double x195 = (sin_phi*sin_phi*sin_phi*sin_phi);
        const double x196 = x166*x167;
        const double x197 = 16.0*x188;
        const double x198 = 16.0*x32;
        const double x199 = 4.0*d_spin_angle;
        const double x200 = 24.0*x196;
        const double x201 = 4.0*d2_spin_angle;
        const double x202 = -bar_M_zz*fuel_mass;
        const double x203 = K1*bar_K1_thermal_scale;
        const double x204 = -bar_M_zz;
        const double x205 = x175 + x176 + x177;
        const double x206 = x178 + x179 + x180;
        const double x207 = -x152;
        const double x208 = -x144;
        const double x209 = f_r_x*x128;
        const double x210 = 0.5*(q_r_x*q_r_x);
        const double x211 = 0.5*(f_disc_r_z*f_disc_r_z);
        const double x212 = (f_r_x*f_r_x);
        const double x213 = 0.5*x212;
        const double x214 = x211 - x213;
        const double x215 = f_r_x*x136;
        const double x216 = 0.5*(q_r_y*q_r_y);
        const double x217 = 0.5*(f_r_y*f_r_y);
        const double x218 = x211 - x217;
        const double x219 = f_r_x*x132;
        const double x220 = (1.0/6.0)*(q_r_x*q_r_x*q_r_x);
        const double x221 = f_r_x*x211;
        const double x222 = FMA(-1.0/6.0, f_r_x*f_r_x*f_r_x, x221);
        const double x223 = (f_disc_r_z*f_disc_r_z*f_disc_r_z);
        const double x224 = (1.0/6.0)*x223;
        const double x225 = FMA(-0.5, f_disc_r_z*x212, x224);
        const double x226 = f_r_y*x209;
        const double x227 = f_r_y*x211;
        const double x228 = FMA(-f_r_y, x213, x227);
        const double x229 = FMA(-f_r_x, x217, x221);
        const double x230 = f_disc_r_z*x217;
        const double x231 = (1.0/6.0)*(q_r_y*q_r_y*q_r_y);
        const double x232 = FMA(-1.0/6.0, f_r_y*f_r_y*f_r_y, x227);
        const double x233 = x224 - x230;
        const double x234 = bar_i_vibration_rectification*rate_rate_i_sensed;
        const double x235 = sin_of_roll[i];
        const double x236 = -bar_M_zz*x235;
        const double x237 = sin_of_pitch[i];
        const double x238 = -bar_M_zz*x237;
        const double x239 = FMA(sin_yaw, sin_yaw, FMA(-cos_yaw, cos_yaw, (1.0)));
        const double x240 = -x239;
        const double x241 = 2.0*cos_yaw*sin_yaw;
        const double x242 = cos_yaw - (1.0);
        const double x243 = -Gamma_zz;
        const double x244 = 2.0*Gamma_yz;
        const double x245 = 2.0*Gamma_xz;
        const double x246 = FMA(-293.15, (1.0), temperature);
        const double x247 = (vibration_rms*vibration_rms);
        const double x248 = K4*vibration_axis_ix;
        const double x249 = vibration_axis_px*x248;
        const double x250 = K6*vibration_axis_ix;
        const double x251 = vibration_axis_ox*x250;
        const double x252 = K8*vibration_axis_ox;
        const double x253 = vibration_axis_px*x252;
        const double x254 = K2*(vibration_axis_ix*vibration_axis_ix);
        const double x255 = K5*(vibration_axis_ox*vibration_axis_ox);
        const double x256 = K7*(vibration_axis_px*vibration_axis_px);
        const double x257 = vibration_axis_py*x248;
        const double x258 = K4*vibration_axis_px;
        const double x259 = vibration_axis_iy*x258;
        const double x260 = vibration_axis_oy*x250;
        const double x261 = K6*vibration_axis_ox;
        const double x262 = vibration_axis_iy*x261;
        const double x263 = vibration_axis_py*x252;
        const double x264 = K8*vibration_axis_px;
        const double x265 = vibration_axis_oy*x264;
        const double x266 = vibration_axis_ix*x101;
        const double x267 = vibration_axis_iy*x266;
        const double x268 = vibration_axis_ox*x102;
        const double x269 = vibration_axis_oy*x268;
        const double x270 = vibration_axis_px*x103;
        const double x271 = vibration_axis_py*x270;
        const double x272 = vibration_axis_pz*x248;
        const double x273 = vibration_axis_iz*x258;
        const double x274 = vibration_axis_oz*x250;
        const double x275 = vibration_axis_iz*x261;
        const double x276 = vibration_axis_pz*x252;
        const double x277 = vibration_axis_oz*x264;
        const double x278 = vibration_axis_iz*x266;
        const double x279 = vibration_axis_oz*x268;
        const double x280 = vibration_axis_pz*x270;
        const double x281 = K4*vibration_axis_iy;
        const double x282 = vibration_axis_py*x281;
        const double x283 = K6*vibration_axis_iy;
        const double x284 = vibration_axis_oy*x283;
        const double x285 = K8*vibration_axis_oy;
        const double x286 = vibration_axis_py*x285;
        const double x287 = K2*(vibration_axis_iy*vibration_axis_iy);
        const double x288 = K5*(vibration_axis_oy*vibration_axis_oy);
        const double x289 = K7*(vibration_axis_py*vibration_axis_py);
        const double x290 = vibration_axis_pz*x281;
        const double x291 = K4*vibration_axis_iz;
        const double x292 = vibration_axis_py*x291;
        const double x293 = vibration_axis_oz*x283;
        const double x294 = K6*vibration_axis_iz;
        const double x295 = vibration_axis_oy*x294;
        const double x296 = vibration_axis_pz*x285;
        const double x297 = K8*vibration_axis_oz;
        const double x298 = vibration_axis_py*x297;
        const double x299 = vibration_axis_iy*vibration_axis_iz*x101;
        const double x300 = vibration_axis_oy*vibration_axis_oz*x102;
        const double x301 = vibration_axis_py*vibration_axis_pz*x103;
        const double x302 = vibration_axis_pz*x291;
        const double x303 = vibration_axis_oz*x294;
        const double x304 = vibration_axis_pz*x297;
        const double x305 = K2*(vibration_axis_iz*vibration_axis_iz);
        const double x306 = K5*(vibration_axis_oz*vibration_axis_oz);
        const double x307 = K7*(vibration_axis_pz*vibration_axis_pz);

        rows[0][i] = bar_i_vibration_rectification*((double)((i_sensed) > 0.0) - (double)((i_sensed) < 0.0)); /* adc-nonlinearity.h */
        rows[1][i] = -x157 - x158; /* angular-jitter.W_xx */
        rows[2][i] = -bar_spin_axis_tilt_Gamma_xy*x156; /* angular-jitter.W_xy */
        rows[3][i] = -bar_spin_axis_tilt_Gamma_xz*x156; /* angular-jitter.W_xz */
        rows[4][i] = -x158 - x159; /* angular-jitter.W_yy */
        rows[5][i] = -bar_spin_axis_tilt_Gamma_yz*x156; /* angular-jitter.W_yz */
        rows[6][i] = -x157 - x159; /* angular-jitter.W_zz */
        rows[7][i] = bar_i_vibration_rectification*(FMA(f_tau_xy, omega_y, f_tau_xx*omega_x))*(FMA(f_tau_zy, omega_y, FMA(f_tau_zx, omega_x, -x1))); /* anisoinertia.K_ip */
        rows[8][i] = bar_dR_arm_stretch; /* arm-length.delta_R */
        rows[9][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_zj, FMA(bar_rate_dR_arm_stretch, rate_b_f_zj, b_f_zj*bar_dR_arm_stretch)); /* arm-sag.c_z */
        rows[10][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_yj, FMA(bar_rate_dR_arm_stretch, rate_b_f_yj, b_f_yj*bar_dR_arm_stretch)); /* arm-stretch.c_r */
        rows[11][i] = FMA(bar_rate_run_out_x, rate_cos_phi_true, FMA(bar_rate_rate_run_out_x, rate_rate_cos_phi_true, x160)); /* bearing-run-out.c_x1 */
        rows[12][i] = FMA(bar_run_out_x, sin_phi, FMA(bar_rate_run_out_x, rate_sin_phi_true, bar_rate_rate_run_out_x*rate_rate_sin_phi_true)); /* bearing-run-out.s_x1 */
        rows[13][i] = FMA(bar_rate_run_out_y, rate_cos_phi_true, FMA(bar_rate_rate_run_out_y, rate_rate_cos_phi_true, x161)); /* bearing-run-out.c_y1 */
        rows[14][i] = FMA(bar_run_out_y, sin_phi, FMA(bar_rate_run_out_y, rate_sin_phi_true, bar_rate_rate_run_out_y*rate_rate_sin_phi_true)); /* bearing-run-out.s_y1 */
        rows[15][i] = FMA(bar_rate_run_out_z, rate_cos_phi_true, FMA(bar_rate_rate_run_out_z, rate_rate_cos_phi_true, x162)); /* bearing-run-out.c_z1 */
        rows[16][i] = FMA(bar_run_out_z, sin_phi, FMA(bar_rate_run_out_z, rate_sin_phi_true, bar_rate_rate_run_out_z*rate_rate_sin_phi_true)); /* bearing-run-out.s_z1 */
        rows[17][i] = FMA(bar_run_out_x, x168, FMA(bar_rate_run_out_x, x165, bar_rate_rate_run_out_x*x169)); /* bearing-run-out.c_x2 */
        rows[18][i] = FMA(x160, x164, FMA(bar_rate_run_out_x, x170, bar_rate_rate_run_out_x*x171)); /* bearing-run-out.s_x2 */
        rows[19][i] = FMA(bar_run_out_y, x168, FMA(bar_rate_run_out_y, x165, bar_rate_rate_run_out_y*x169)); /* bearing-run-out.c_y2 */
        rows[20][i] = FMA(x161, x164, FMA(bar_rate_run_out_y, x170, bar_rate_rate_run_out_y*x171)); /* bearing-run-out.s_y2 */
        rows[21][i] = FMA(bar_run_out_z, x168, FMA(bar_rate_run_out_z, x165, bar_rate_rate_run_out_z*x169)); /* bearing-run-out.c_z2 */
        rows[22][i] = FMA(x162, x164, FMA(bar_rate_run_out_z, x170, bar_rate_rate_run_out_z*x171)); /* bearing-run-out.s_z2 */
        rows[23][i] = bar_i_vibration_rectification*time; /* bias-drift.dK0_dt */
        rows[24][i] = bar_i_vibration_rectification; /* bias-step.dK0 */
        rows[25][i] = FMA(time, x180, FMA(time, x179, FMA(time, x178, FMA(time, x177, FMA(time, x176, FMA(time, x175, FMA(time, x174, FMA(time, x173, time*x172)))))))); /* clock-drift.epsilon */
        rows[26][i] = f_f_o*x181; /* cubic-cross.K_iio */
        rows[27][i] = f_f_p*x181; /* cubic-cross.K_iip */
        rows[28][i] = x182*x183; /* cubic-cross.K_ioo */
        rows[29][i] = f_f_o*f_f_p*x183; /* cubic-cross.K_iop */
        rows[30][i] = x183*x184; /* cubic-cross.K_ipp */
        rows[31][i] = bar_i_vibration_rectification*(f_f_o*f_f_o*f_f_o); /* cubic-cross.K_ooo */
        rows[32][i] = bar_i_vibration_rectification*f_f_p*x182; /* cubic-cross.K_oop */
        rows[33][i] = bar_i_vibration_rectification*f_f_o*x184; /* cubic-cross.K_opp */
        rows[34][i] = bar_i_vibration_rectification*(f_f_p*f_f_p*f_f_p); /* cubic-cross.K_ppp */
        rows[35][i] = bar_i_vibration_rectification*(f_f_i*f_f_i*f_f_i); /* cubic-input.K_iii */
        rows[36][i] = FMA(bar_spin_acceleration_true, x34, x185 - x186); /* encoder-harmonic.c_1 */
        rows[37][i] = FMA(bar_spin_rate_true, x30, FMA(bar_spin_acceleration_true, x37, bar_sin_delta_phi*sin_phi)); /* encoder-harmonic.s_1 */
        rows[38][i] = FMA(-x186, x187, FMA(bar_spin_acceleration_true, FMA(-x187, x31, FMA(-4.0, x166*x32, 4.0*x167*x32)), bar_sin_delta_phi*x168)); /* encoder-harmonic.c_2 */
        rows[39][i] = FMA(x164, x185, FMA(bar_spin_rate_true, FMA(-x167, x41, x166*x41), bar_spin_acceleration_true*FMA(-x167, x56, FMA(-8.0, sin_phi*x33, 2.0*d2_spin_angle*x166)))); /* encoder-harmonic.s_2 */
        rows[40][i] = FMA(bar_spin_rate_true, FMA(-x190, x28, 3.0*d_spin_angle*x189), FMA(bar_spin_acceleration_true, FMA(-x190, x31, FMA(-x188, x191, FMA(3.0, d2_spin_angle*x189, 27.0*cos_phi*x167*x32))), bar_sin_delta_phi*FMA(-3.0, cos_phi*x167, x188))); /* encoder-harmonic.c_3 */
        rows[41][i] = FMA(bar_spin_rate_true, FMA(-x193, x30, d_spin_angle*x192), FMA(bar_spin_acceleration_true, FMA(-x193, x35, FMA(x189, x191, FMA(-27.0, x166*x36, d2_spin_angle*x192))), bar_sin_delta_phi*FMA(3.0, sin_phi*x166, -x189))); /* encoder-harmonic.s_3 */
        rows[42][i] = FMA(bar_spin_rate_true, FMA(-x197, x28, 16.0*cos_phi*d_spin_angle*x189), FMA(bar_spin_acceleration_true, FMA(-x197, x31, FMA(-x195, x198, FMA(-x194, x198, FMA(96.0, x166*x167*x32, 16.0*cos_phi*d2_spin_angle*x189)))), bar_sin_delta_phi*FMA(-6.0, x196, x194 + x195))); /* encoder-harmonic.c_4 */
        rows[43][i] = FMA(bar_spin_rate_true, FMA(x195, x199, FMA(-d_spin_angle, x200, x194*x199)), FMA(bar_spin_acceleration_true, FMA(x195, x201, FMA(x194, x201, FMA(-64.0, x188*x36, FMA(-d2_spin_angle, x200, 64.0*x189*x33)))), bar_sin_delta_phi*FMA(-x187, x189, 4.0*sin_phi*x188))); /* encoder-harmonic.s_4 */
        rows[44][i] = FMA(-bar_M_xx, fuel_mass, -x202); /* fuel-gradient.G_xx */
        rows[45][i] = bar_spin_axis_tilt_Gamma_xy*fuel_mass; /* fuel-gradient.G_xy */
        rows[46][i] = bar_spin_axis_tilt_Gamma_xz*fuel_mass; /* fuel-gradient.G_xz */
        rows[47][i] = FMA(-bar_M_yy, fuel_mass, -x202); /* fuel-gradient.G_yy */
        rows[48][i] = bar_spin_axis_tilt_Gamma_yz*fuel_mass; /* fuel-gradient.G_yz */
        rows[49][i] = time*x203; /* gain-drift.dK1_dt */
        rows[50][i] = x203; /* gain-step.dK1 */
        rows[51][i] = -bar_M_xx - x204; /* gradient-offset.G_xx */
        rows[52][i] = bar_spin_axis_tilt_Gamma_xy; /* gradient-offset.G_xy */
        rows[53][i] = bar_spin_axis_tilt_Gamma_xz; /* gradient-offset.G_xz */
        rows[54][i] = -bar_M_yy - x204; /* gradient-offset.G_yy */
        rows[55][i] = bar_spin_axis_tilt_Gamma_yz; /* gradient-offset.G_yz */
        rows[56][i] = -bar_time_offset_omega_x; /* gyro-bias.b_x */
        rows[57][i] = -bar_time_offset_omega_y; /* gyro-bias.b_y */
        rows[58][i] = -bar_time_offset_omega_z; /* gyro-bias.b_z */
        rows[59][i] = x205; /* gyro-delay.delta_w */
        rows[60][i] = x206; /* gyro-delay.delta_d */
        rows[61][i] = FMA(-bar_time_offset_omegadot_x, d_a_x, -a_x*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xx */
        rows[62][i] = FMA(-bar_time_offset_omegadot_x, d_a_y, -a_y*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xy */
        rows[63][i] = FMA(-bar_time_offset_omegadot_x, d_a_z, -a_z*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xz */
        rows[64][i] = FMA(-bar_time_offset_omegadot_y, d_a_x, -a_x*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yx */
        rows[65][i] = FMA(-bar_time_offset_omegadot_y, d_a_y, -a_y*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yy */
        rows[66][i] = FMA(-bar_time_offset_omegadot_y, d_a_z, -a_z*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yz */
        rows[67][i] = FMA(-bar_time_offset_omegadot_z, d_a_x, -a_x*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zx */
        rows[68][i] = FMA(-bar_time_offset_omegadot_z, d_a_y, -a_y*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zy */
        rows[69][i] = FMA(-bar_time_offset_omegadot_z, d_a_z, -a_z*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zz */
        rows[70][i] = FMA(-bar_time_offset_omegadot_x, omegadot_x, -bar_time_offset_omega_x*omega_x); /* gyro-scale.s_x */
        rows[71][i] = FMA(-bar_time_offset_omegadot_y, omegadot_y, -bar_time_offset_omega_y*omega_y); /* gyro-scale.s_y */
        rows[72][i] = FMA(-bar_time_offset_omegadot_z, omegadot_z, -bar_time_offset_omega_z*omega_z); /* gyro-scale.s_z */
        rows[73][i] = -bar_time_offset_a_x; /* imu-acceleration-bias.b_x */
        rows[74][i] = -bar_time_offset_a_y; /* imu-acceleration-bias.b_y */
        rows[75][i] = -bar_time_offset_a_z; /* imu-acceleration-bias.b_z */
        rows[76][i] = -x155; /* imu-acceleration-misalignment.m_xy */
        rows[77][i] = x207; /* imu-acceleration-misalignment.m_xz */
        rows[78][i] = -x151; /* imu-acceleration-misalignment.m_yx */
        rows[79][i] = -x149; /* imu-acceleration-misalignment.m_yz */
        rows[80][i] = -x147; /* imu-acceleration-misalignment.m_zx */
        rows[81][i] = x208; /* imu-acceleration-misalignment.m_zy */
        rows[82][i] = -a_x*bar_time_offset_a_x; /* imu-acceleration-scale.s_x */
        rows[83][i] = -a_y*bar_time_offset_a_y; /* imu-acceleration-scale.s_y */
        rows[84][i] = -a_z*bar_time_offset_a_z; /* imu-acceleration-scale.s_z */
        rows[85][i] = FMA(bar_time_offset_a_z, (-x114 - x7), FMA(-bar_time_offset_a_y, x10, bar_time_offset_a_x*x126)); /* imu-lever-arm.l_x */
        rows[86][i] = FMA(-bar_time_offset_a_z, x119, FMA(bar_time_offset_a_y, x123, bar_time_offset_a_x*(omegadot_z - x5))); /* imu-lever-arm.l_y */
        rows[87][i] = FMA(bar_time_offset_a_z, x17, FMA(-bar_time_offset_a_x, x115, bar_time_offset_a_y*(-x117 - x16))); /* imu-lever-arm.l_z */
        rows[88][i] = -bar_imu_turn_yz + bar_imu_turn_zy; /* imu-misalignment.e_x */
        rows[89][i] = bar_imu_turn_xz - bar_imu_turn_zx; /* imu-misalignment.e_y */
        rows[90][i] = -bar_imu_turn_xy + bar_imu_turn_yx; /* imu-misalignment.e_z */
        rows[91][i] = -bar_i_vibration_rectification*rate_f_f_i; /* lag.tau */
        rows[92][i] = bar_i_vibration_rectification*(FMA(B_z, x109, FMA(B_y, x108, B_x*x107))); /* magnetic-bias.dK0_dB */
        rows[93][i] = b_f_xj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yx */
        rows[94][i] = b_f_yj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yy */
        rows[95][i] = b_f_zj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yz */
        rows[96][i] = b_f_xj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zx */
        rows[97][i] = b_f_yj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zy */
        rows[98][i] = b_f_zj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zz */
        rows[99][i] = FMA(-bar_q_f_x, x210, FMA(bar_f_f_x, x214, x209)); /* near-mass.T_xxx */
        rows[100][i] = FMA(-q_r_x, x138, FMA(-f_r_x, x137, FMA(-bar_q_f_y, x210, FMA(bar_f_f_z, f_disc_r_z*f_r_y, bar_f_f_y*x214)))); /* near-mass.T_xxy */
        rows[101][i] = FMA(bar_q_p_second_order_misalignment, x210, FMA(bar_f_f_z, x214, -x215)); /* near-mass.T_xxz */
        rows[102][i] = FMA(-q_r_x, x134, FMA(-f_r_x, x133, FMA(-bar_q_f_x, x216, FMA(bar_f_f_z, f_disc_r_z*f_r_x, bar_f_f_x*x218)))); /* near-mass.T_xyy */
        rows[103][i] = FMA(-f_r_y, x136, FMA(-f_r_x, x129, FMA(bar_q_p_second_order_misalignment, q_r_x*q_r_y, -x219))); /* near-mass.T_xyz */
        rows[104][i] = FMA(f_r_y, x128, FMA(-bar_q_f_y, x216, bar_f_f_y*x218)); /* near-mass.T_yyy */
        rows[105][i] = FMA(-f_r_y, x132, FMA(bar_q_p_second_order_misalignment, x216, bar_f_f_z*x218)); /* near-mass.T_yyz */
        rows[106][i] = FMA(-bar_q_f_x, x220, FMA(-bar_f_f_z, x225, bar_f_f_x*x222)); /* near-mass.T_xxxx */
        rows[107][i] = FMA(-x138, x210, FMA(-bar_q_f_y, x220, FMA(bar_f_f_y, x222, FMA(bar_f_f_x, x228, x226)))); /* near-mass.T_xxxy */
        rows[108][i] = FMA(bar_q_p_second_order_misalignment, x220, FMA(bar_f_f_z, x222, bar_f_f_x*x225)); /* near-mass.T_xxxz */
        rows[109][i] = FMA(-x139, x216, FMA(-x134, x210, FMA(bar_f_f_z, FMA(-1.0/3.0, x223, FMA(f_disc_r_z, x213, x230)), FMA(bar_f_f_y, x228, bar_f_f_x*x229)))); /* near-mass.T_xxyy */
        rows[110][i] = FMA(x130, x210, FMA(-f_r_y, x215, FMA(bar_f_f_z, x228, bar_f_f_y*x225))); /* near-mass.T_xxyz */
        rows[111][i] = FMA(-x135, x216, FMA(-bar_q_f_x, x231, FMA(bar_f_f_y, x229, FMA(bar_f_f_x, x232, x226)))); /* near-mass.T_xyyy */
        rows[112][i] = FMA(x131, x216, FMA(-f_r_y, x219, FMA(bar_f_f_z, x229, bar_f_f_x*x233))); /* near-mass.T_xyyz */
        rows[113][i] = FMA(-bar_q_f_y, x231, FMA(-bar_f_f_z, x233, bar_f_f_y*x232)); /* near-mass.T_yyyy */
        rows[114][i] = FMA(bar_q_p_second_order_misalignment, x231, FMA(bar_f_f_z, x232, bar_f_f_y*x233)); /* near-mass.T_yyyz */
        rows[115][i] = x183*fabs(f_f_i); /* odd-quadratic.K_oq */
        rows[116][i] = x234; /* output-filter.b */
        rows[117][i] = bar_i_vibration_rectification*i_sensed; /* output-gain-step.g */
        rows[118][i] = bar_i_vibration_rectification*(FMA(-f_tau_yy, x9, FMA(-beta_x, x4, f_tau_yx*x14))); /* pendulum-angular.K_pa */
        rows[119][i] = bar_i_vibration_rectification*(FMA(-101325.0, (1.0), pressure)); /* pressure-bias.dK0_dp */
        rows[120][i] = x234; /* second-order-loop.b */
        rows[121][i] = FMA(bar_q_p_second_order_misalignment, (f_f_p + q_f_z), FMA(bar_q_o_second_order_misalignment, (f_f_o - q_f_yj), bar_q_i_second_order_misalignment*(f_f_i - q_f_xj))); /* second-order-misalignment.kappa */
        rows[122][i] = FMA(-bar_M_xx, x235, -x236); /* self-gradient.G_xx_roll */
        rows[123][i] = bar_spin_axis_tilt_Gamma_xy*x235; /* self-gradient.G_xy_roll */
        rows[124][i] = bar_spin_axis_tilt_Gamma_xz*x235; /* self-gradient.G_xz_roll */
        rows[125][i] = FMA(-bar_M_yy, x235, -x236); /* self-gradient.G_yy_roll */
        rows[126][i] = bar_spin_axis_tilt_Gamma_yz*x235; /* self-gradient.G_yz_roll */
        rows[127][i] = FMA(-bar_M_xx, x237, -x238); /* self-gradient.G_xx_pitch */
        rows[128][i] = bar_spin_axis_tilt_Gamma_xy*x237; /* self-gradient.G_xy_pitch */
        rows[129][i] = bar_spin_axis_tilt_Gamma_xz*x237; /* self-gradient.G_xz_pitch */
        rows[130][i] = FMA(-bar_M_yy, x237, -x238); /* self-gradient.G_yy_pitch */
        rows[131][i] = bar_spin_axis_tilt_Gamma_yz*x237; /* self-gradient.G_yz_pitch */
        rows[132][i] = FMA(-bar_M_yy, x239, FMA(-bar_M_xx, x240, 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw)); /* self-gradient-yaw.G_d */
        rows[133][i] = FMA(bar_spin_axis_tilt_Gamma_xy, x240, FMA(-bar_M_yy, x241, bar_M_xx*x241)); /* self-gradient-yaw.G_xy */
        rows[134][i] = FMA(bar_spin_axis_tilt_Gamma_yz, sin_yaw, bar_spin_axis_tilt_Gamma_xz*x242); /* self-gradient-yaw.G_xz */
        rows[135][i] = FMA(-bar_spin_axis_tilt_Gamma_xz, sin_yaw, bar_spin_axis_tilt_Gamma_yz*x242); /* self-gradient-yaw.G_yz */
        rows[136][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (-Gamma_yy - x243), FMA(bar_M_zz, x244, FMA(-bar_M_yy, x244, FMA(Gamma_xz, bar_spin_axis_tilt_Gamma_xy, FMA(-Gamma_xy, bar_spin_axis_tilt_Gamma_xz, -x145 - x146 + x150 + x208))))); /* spin-axis-tilt.alpha_x */
        rows[137][i] = FMA(bar_spin_axis_tilt_Gamma_xz, (Gamma_xx + x243), FMA(-bar_M_zz, x245, FMA(bar_M_xx, x245, FMA(-Gamma_yz, bar_spin_axis_tilt_Gamma_xy, FMA(Gamma_xy, bar_spin_axis_tilt_Gamma_yz, x148 - x153 - x154 + x207))))); /* spin-axis-tilt.alpha_y */
        rows[138][i] = FMA(bar_wobble_zy, cos_phi, FMA(-bar_wobble_zx, sin_phi, FMA(-bar_wobble_yz, cos_phi, bar_wobble_xz*sin_phi))); /* spin-axis-wobble.w_x */
        rows[139][i] = FMA(-bar_wobble_zy, sin_phi, FMA(-bar_wobble_zx, cos_phi, FMA(bar_wobble_yz, sin_phi, bar_wobble_xz*cos_phi))); /* spin-axis-wobble.w_y */
        rows[140][i] = bar_sin_delta_phi; /* spin-phase-offset.phi_0 */
        rows[141][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_phi */
        rows[142][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_walk */
        rows[143][i] = FMA(bar_spin_rate_true, FMA(d2_spin_angle, time, d_spin_angle), FMA(bar_spin_acceleration_true, x56, bar_sin_delta_phi*d_spin_angle*time)); /* spin-rate-offset.epsilon */
        rows[144][i] = FMA(-bar_spin_rate_true, d_omegadot_z, FMA(-bar_spin_acceleration_true, d2_omegadot_z, -bar_sin_delta_phi*omegadot_z)); /* spin-servo.c */
        rows[145][i] = bar_i_vibration_rectification*x246; /* thermal-bias.dK0_dT */
        rows[146][i] = bar_i_vibration_rectification*d_temperature; /* thermal-lag.dK0_dTdot */
        rows[147][i] = d_temperature*x203; /* thermal-lag.dK1_dTdot */
        rows[148][i] = x203*x246; /* thermal-scale.dK1_dT */
        rows[149][i] = x172 + x173 + x174 + x205 + x206; /* time-offset.delta_t */
        rows[150][i] = bar_i_vibration_rectification*(FMA(x247, x256, FMA(x247, x255, FMA(x247, x254, FMA(x247, x253, FMA(x247, x251, x247*x249)))))); /* vibration-level.L_xx */
        rows[151][i] = bar_i_vibration_rectification*(FMA(x247, x271, FMA(x247, x269, FMA(x247, x267, FMA(x247, x265, FMA(x247, x263, FMA(x247, x262, FMA(x247, x260, FMA(x247, x259, x247*x257))))))))); /* vibration-level.L_xy */
        rows[152][i] = bar_i_vibration_rectification*(FMA(x247, x280, FMA(x247, x279, FMA(x247, x278, FMA(x247, x277, FMA(x247, x276, FMA(x247, x275, FMA(x247, x274, FMA(x247, x273, x247*x272))))))))); /* vibration-level.L_xz */
        rows[153][i] = bar_i_vibration_rectification*(FMA(x247, x289, FMA(x247, x288, FMA(x247, x287, FMA(x247, x286, FMA(x247, x284, x247*x282)))))); /* vibration-level.L_yy */
        rows[154][i] = bar_i_vibration_rectification*(FMA(x247, x301, FMA(x247, x300, FMA(x247, x299, FMA(x247, x298, FMA(x247, x296, FMA(x247, x295, FMA(x247, x293, FMA(x247, x292, x247*x290))))))))); /* vibration-level.L_yz */
        rows[155][i] = bar_i_vibration_rectification*(FMA(x247, x307, FMA(x247, x306, FMA(x247, x305, FMA(x247, x304, FMA(x247, x303, x247*x302)))))); /* vibration-level.L_zz */
        rows[156][i] = bar_i_vibration_rectification*(x249 + x251 + x253 + x254 + x255 + x256); /* vibration-rectification.P_xx */
        rows[157][i] = bar_i_vibration_rectification*(x257 + x259 + x260 + x262 + x263 + x265 + x267 + x269 + x271); /* vibration-rectification.P_xy */
        rows[158][i] = bar_i_vibration_rectification*(x272 + x273 + x274 + x275 + x276 + x277 + x278 + x279 + x280); /* vibration-rectification.P_xz */
        rows[159][i] = bar_i_vibration_rectification*(x282 + x284 + x286 + x287 + x288 + x289); /* vibration-rectification.P_yy */
        rows[160][i] = bar_i_vibration_rectification*(x290 + x292 + x293 + x295 + x296 + x298 + x299 + x300 + x301); /* vibration-rectification.P_yz */
        rows[161][i] = bar_i_vibration_rectification*(x302 + x303 + x304 + x305 + x306 + x307); /* vibration-rectification.P_zz */
    }
    for (size_t k = 0; k < ROWS; ++k) {
        for (size_t i = 0; i < n; ++i) {
            out_D[k * stride + i] = rows[k][i];
        }
    }
}

/* The n < STEP last samples of all series, from at on, with the last of them for those that are not there. */
static void widened(size_t n, size_t at, const double *t, const double *cosine, const double *sine,
                    const double *const *in, double wide[INPUTS + 3][STEP]) {
    for (size_t i = 0; i < STEP; ++i) {
        const size_t from = i < n ? i : n - 1;
        for (size_t k = 0; k < INPUTS; ++k) {
            wide[k][i] = in[k][at + from];
        }
        wide[INPUTS][i] = t[at + from];
        wide[INPUTS + 1][i] = cosine[from];
        wide[INPUTS + 2][i] = sine[from];
    }
}

void ragg_signatures_voltages(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                        double *V) {
    double cosine[BLOCK], sine[BLOCK];
    for (size_t at = 0, size; at < n; at += size) {
        size = turning(at, n, t, p[1], angle, cosine, sine);
        for (size_t j = 0; j < 4; ++j) {
            block(j, size, at, t, cosine, sine, in, p, V + j * n + at);
        }
    }
}

void ragg_signatures_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
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

void ragg_signatures_derivatives(size_t j, size_t n, const double *t, const double *const *in, const double *p,
                           const double *angle, double *D) {
    double cosine[BLOCK], sine[BLOCK];
    double wide[INPUTS + 3][STEP];
    const double *last[INPUTS];
    for (size_t k = 0; k < INPUTS; ++k) {
        last[k] = wide[k];
    }
    for (size_t at = 0, size; at < n; at += size) {
        size = turning(at, n, t, p[1], angle, cosine, sine);
        for (size_t k = 0; k < size; k += STEP) {
            const size_t count = size - k < STEP ? size - k : STEP;
            const int few = count < STEP;
            if (few) {
                widened(count, at + k, t, cosine + k, sine + k, in, wide);
            }
            slopes(j, count, few ? 0 : at + k, n, few ? wide[INPUTS] : t, few ? wide[INPUTS + 1] : cosine + k,
                   few ? wide[INPUTS + 2] : sine + k, few ? last : in, p, D + at + k);
        }
    }
}
