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

enum { ROWS = 163, STEP = 64, INPUTS = 41 };

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
        const double x0 = (omega_y*omega_y);
        const double x1 = (omega_z*omega_z);
        const double M_xx = -Gamma_xx - x0 - x1;
        const double M_xy = FMA(omega_x, omega_y, -Gamma_xy - omegadot_z);
        const double M_xz = FMA(omega_x, omega_z, -Gamma_xz + omegadot_y);
        const double M_yx = FMA(omega_x, omega_y, -Gamma_xy + omegadot_z);
        const double x2 = (omega_x*omega_x);
        const double M_yy = -Gamma_yy - x1 - x2;
        const double M_yz = FMA(omega_y, omega_z, -Gamma_yz - omegadot_x);
        const double M_zx = FMA(omega_x, omega_z, -Gamma_xz - omegadot_y);
        const double M_zy = FMA(omega_y, omega_z, -Gamma_yz + omegadot_x);
        const double M_zz = -Gamma_zz - x0 - x2;
        const double cos_psi = FMA(-sin_j, sin_phi, cos_j*cos_phi);
        const double sin_psi = FMA(cos_phi, sin_j, cos_j*sin_phi);
        const double x3 = dR + radius;
        const double f_disc_r_x = x3;
        const double f_disc_r_y = beta_z*x3;
        const double f_disc_r_z = beta_x*x3;
        const double f_disc_tau_zy = -beta_x*beta_z;
        const double f_r_x = FMA(-f_disc_r_y, sin_psi, cos_psi*f_disc_r_x);
        const double f_r_y = FMA(f_disc_r_x, sin_psi, cos_psi*f_disc_r_y);
        const double x4 = FMA(beta_z, cos_psi, sin_psi);
        const double f_tau_xx = -x4;
        const double x5 = FMA(-beta_z, sin_psi, cos_psi);
        const double f_tau_xy = x5;
        const double f_tau_yx = x5;
        const double f_tau_yy = x4;
        const double f_tau_zx = FMA(-f_disc_tau_zy, sin_psi, -beta_x*cos_psi);
        const double f_tau_zy = FMA(-beta_x, sin_psi, cos_psi*f_disc_tau_zy);
        const double f_f_x = FMA(M_xz, f_disc_r_z, FMA(M_xy, f_r_y, FMA(M_xx, f_r_x, a_x)));
        const double f_f_y = FMA(M_yz, f_disc_r_z, FMA(M_yy, f_r_y, FMA(M_yx, f_r_x, a_y)));
        const double f_f_z = FMA(M_zz, f_disc_r_z, FMA(M_zy, f_r_y, FMA(M_zx, f_r_x, a_z)));
        const double f_f_xj = FMA(f_f_y, f_tau_xy, f_f_x*f_tau_xx);
        const double f_f_yj = FMA(f_f_y, f_tau_yy, FMA(-beta_x, f_f_z, f_f_x*f_tau_yx));
        const double f_f_zj = FMA(f_f_y, f_tau_zy, FMA(f_f_x, f_tau_zx, -f_f_z));
        const double f_f_i = FMA(-f_f_zj, vartheta_y, FMA(f_f_yj, vartheta_z, f_f_xj));
        const double q_disc_r_x = x3;
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
    const double spin_frequency = p[1];
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
        const double x1 = (omega_z*omega_z);
        const double x2 = x0 + x1;
        const double x3 = -Gamma_xx - x2;
        const double M_xx = x3;
        const double x4 = omega_x*omega_y;
        const double x5 = -Gamma_xy - omegadot_z + x4;
        const double M_xy = x5;
        const double x6 = omega_x*omega_z;
        const double x7 = omegadot_y + x6;
        const double x8 = -Gamma_xz + x7;
        const double M_xz = x8;
        const double x9 = omegadot_z + x4;
        const double x10 = -Gamma_xy + x9;
        const double M_yx = x10;
        const double x11 = (omega_x*omega_x);
        const double x12 = x1 + x11;
        const double x13 = -Gamma_yy - x12;
        const double M_yy = x13;
        const double x14 = omega_y*omega_z;
        const double x15 = -Gamma_yz - omegadot_x + x14;
        const double M_yz = x15;
        const double x16 = -Gamma_xz - omegadot_y + x6;
        const double M_zx = x16;
        const double x17 = omegadot_x + x14;
        const double x18 = -Gamma_yz + x17;
        const double M_zy = x18;
        const double x19 = x0 + x11;
        const double x20 = -Gamma_zz - x19;
        const double M_zz = x20;
        const double cos_psi = FMA(-sin_j, sin_phi, cos_j*cos_phi);
        const double sin_psi = FMA(cos_phi, sin_j, cos_j*sin_phi);
        const double x21 = dR + radius;
        const double b_disc_r_x = x21;
        const double x22 = beta_z*x21;
        const double b_disc_r_y = x22;
        const double x23 = beta_x*x21;
        const double b_disc_r_z = x23;
        const double x24 = -beta_x*beta_z;
        const double b_disc_tau_zy = x24;
        const double b_r_x = FMA(-b_disc_r_y, sin_psi, b_disc_r_x*cos_psi);
        const double b_r_y = FMA(b_disc_r_y, cos_psi, b_disc_r_x*sin_psi);
        const double x25 = FMA(beta_z, cos_psi, sin_psi);
        const double x26 = -x25;
        const double b_tau_xx = x26;
        const double x27 = FMA(-beta_z, sin_psi, cos_psi);
        const double b_tau_xy = x27;
        const double b_tau_yx = x27;
        const double b_tau_yy = x25;
        const double x28 = beta_x*cos_psi;
        const double b_tau_zx = FMA(-b_disc_tau_zy, sin_psi, -x28);
        const double x29 = beta_x*sin_psi;
        const double b_tau_zy = FMA(b_disc_tau_zy, cos_psi, -x29);
        const double x30 = 2.0*sin_phi;
        const double x31 = 3.141592653589793*spin_frequency;
        const double x32 = -x30*x31;
        const double rate_cos_phi_true = x32;
        const double x33 = 2.0*cos_phi;
        const double x34 = x31*x33;
        const double rate_sin_phi_true = x34;
        const double x35 = 4.0*cos_phi;
        const double x36 = (3.141592653589793*3.141592653589793)*(spin_frequency*spin_frequency);
        const double x37 = -x35*x36;
        const double rate_rate_cos_phi_true = x37;
        const double x38 = 4.0*sin_phi;
        const double x39 = -x36*x38;
        const double rate_rate_sin_phi_true = x39;
        const double x40 = 2.0*omega_z;
        const double x41 = FMA(-d_spin_angle, x40, -d_spin_angle*d_spin_angle);
        const double spin_xx = x41;
        const double spin_yy = x41;
        const double x42 = d_spin_angle*omega_x;
        const double spin_zx = 2.0*x42;
        const double x43 = d_spin_angle*omega_y;
        const double spin_zy = 2.0*x43;
        const double b_f_x = FMA(M_xz, b_disc_r_z, FMA(M_xy, b_r_y, FMA(M_xx, b_r_x, a_x)));
        const double b_f_y = FMA(M_yz, b_disc_r_z, FMA(M_yy, b_r_y, FMA(M_yx, b_r_x, a_y)));
        const double b_f_z = FMA(M_zz, b_disc_r_z, FMA(M_zy, b_r_y, FMA(M_zx, b_r_x, a_z)));
        const double b_f_xj = FMA(b_f_y, b_tau_xy, b_f_x*b_tau_xx);
        const double b_f_yj = FMA(-b_f_z, beta_x, FMA(b_f_y, b_tau_yy, b_f_x*b_tau_yx));
        const double b_f_zj = FMA(b_f_y, b_tau_zy, FMA(b_f_x, b_tau_zx, -b_f_z));
        const double f_disc_r_x = x21;
        const double f_disc_r_y = x22;
        const double f_disc_r_z = x23;
        const double f_disc_tau_zy = x24;
        const double f_r_x = FMA(-f_disc_r_y, sin_psi, cos_psi*f_disc_r_x);
        const double f_r_y = FMA(f_disc_r_x, sin_psi, cos_psi*f_disc_r_y);
        const double f_tau_xx = x26;
        const double f_tau_xy = x27;
        const double f_tau_yx = x27;
        const double f_tau_yy = x25;
        const double f_tau_zx = FMA(-f_disc_tau_zy, sin_psi, -x28);
        const double f_tau_zy = FMA(cos_psi, f_disc_tau_zy, -x29);
        const double x44 = 1.0/x21;
        const double f_arm_x = f_r_x*x44;
        const double f_arm_y = f_r_y*x44;
        const double f_arm_z = f_disc_r_z*x44;
        const double x45 = 2.0*omega_y;
        const double x46 = omegadot_y*x45;
        const double x47 = omegadot_z*x40;
        const double x48 = -x46 - x47;
        const double rate_M_xx = x48;
        const double x49 = FMA(omega_y, omegadot_x, omega_x*omegadot_y);
        const double x50 = -d_omegadot_z + x49;
        const double rate_M_xy = x50;
        const double x51 = FMA(omega_z, omegadot_x, omega_x*omegadot_z);
        const double x52 = d_omegadot_y + x51;
        const double rate_M_xz = x52;
        const double V2__rate_cos_phi_true = x32;
        const double V2__rate_sin_phi_true = x34;
        const double rate_cos_psi = FMA(-V2__rate_sin_phi_true, sin_j, V2__rate_cos_phi_true*cos_j);
        const double rate_sin_psi = FMA(V2__rate_sin_phi_true, cos_j, V2__rate_cos_phi_true*sin_j);
        const double rate_b_r_x = FMA(-b_disc_r_y, rate_sin_psi, b_disc_r_x*rate_cos_psi);
        const double rate_b_r_y = FMA(b_disc_r_y, rate_cos_psi, b_disc_r_x*rate_sin_psi);
        const double rate_b_f_x = FMA(b_r_y, rate_M_xy, FMA(b_r_x, rate_M_xx, FMA(b_disc_r_z, rate_M_xz, FMA(M_xy, rate_b_r_y, FMA(M_xx, rate_b_r_x, d_a_x)))));
        const double x53 = d_omegadot_z + x49;
        const double rate_M_yx = x53;
        const double x54 = 2.0*omegadot_x;
        const double x55 = omega_x*x54;
        const double x56 = -x47 - x55;
        const double rate_M_yy = x56;
        const double x57 = FMA(omega_z, omegadot_y, omega_y*omegadot_z);
        const double x58 = -d_omegadot_x + x57;
        const double rate_M_yz = x58;
        const double rate_b_f_y = FMA(b_r_y, rate_M_yy, FMA(b_r_x, rate_M_yx, FMA(b_disc_r_z, rate_M_yz, FMA(M_yy, rate_b_r_y, FMA(M_yx, rate_b_r_x, d_a_y)))));
        const double x59 = -d_omegadot_y + x51;
        const double rate_M_zx = x59;
        const double x60 = d_omegadot_x + x57;
        const double rate_M_zy = x60;
        const double x61 = -x46 - x55;
        const double rate_M_zz = x61;
        const double rate_b_f_z = FMA(b_r_y, rate_M_zy, FMA(b_r_x, rate_M_zx, FMA(b_disc_r_z, rate_M_zz, FMA(M_zy, rate_b_r_y, FMA(M_zx, rate_b_r_x, d_a_z)))));
        const double rate_b_tau_yx = FMA(-beta_z, rate_sin_psi, rate_cos_psi);
        const double rate_b_tau_yy = FMA(beta_z, rate_cos_psi, rate_sin_psi);
        const double rate_b_f_yj = FMA(-beta_x, rate_b_f_z, FMA(b_tau_yy, rate_b_f_y, FMA(b_tau_yx, rate_b_f_x, FMA(b_f_y, rate_b_tau_yy, b_f_x*rate_b_tau_yx))));
        const double rate_b_tau_zx = FMA(-beta_x, rate_cos_psi, -b_disc_tau_zy*rate_sin_psi);
        const double rate_b_tau_zy = FMA(-beta_x, rate_sin_psi, b_disc_tau_zy*rate_cos_psi);
        const double rate_b_f_zj = FMA(b_tau_zy, rate_b_f_y, FMA(b_tau_zx, rate_b_f_x, FMA(b_f_y, rate_b_tau_zy, FMA(b_f_x, rate_b_tau_zx, -rate_b_f_z))));
        const double rate_V2__rate_cos_phi_true = x37;
        const double rate_V2__rate_sin_phi_true = x39;
        const double x62 = FMA(2.0, omegadot_z*omegadot_z, d_omegadot_z*x40);
        const double x63 = FMA(2.0, omegadot_y*omegadot_y, d_omegadot_y*x45);
        const double x64 = -x62 - x63;
        const double rate_rate_M_xx = x64;
        const double x65 = FMA(omegadot_y, x54, FMA(d_omegadot_y, omega_x, d_omegadot_x*omega_y));
        const double x66 = -d2_omegadot_z + x65;
        const double rate_rate_M_xy = x66;
        const double x67 = FMA(omegadot_z, x54, FMA(d_omegadot_z, omega_x, d_omegadot_x*omega_z));
        const double x68 = d2_omegadot_y + x67;
        const double rate_rate_M_xz = x68;
        const double rate_rate_cos_psi = FMA(-rate_V2__rate_sin_phi_true, sin_j, cos_j*rate_V2__rate_cos_phi_true);
        const double rate_rate_sin_psi = FMA(rate_V2__rate_cos_phi_true, sin_j, cos_j*rate_V2__rate_sin_phi_true);
        const double rate_rate_b_r_x = FMA(-b_disc_r_y, rate_rate_sin_psi, b_disc_r_x*rate_rate_cos_psi);
        const double rate_rate_b_r_y = FMA(b_disc_r_y, rate_rate_cos_psi, b_disc_r_x*rate_rate_sin_psi);
        const double x69 = 2.0*rate_b_r_x;
        const double x70 = 2.0*rate_b_r_y;
        const double rate_rate_b_f_x = FMA(rate_M_xy, x70, FMA(rate_M_xx, x69, FMA(b_r_y, rate_rate_M_xy, FMA(b_r_x, rate_rate_M_xx, FMA(b_disc_r_z, rate_rate_M_xz, FMA(M_xy, rate_rate_b_r_y, FMA(M_xx, rate_rate_b_r_x, d2_a_x)))))));
        const double x71 = d2_omegadot_z + x65;
        const double rate_rate_M_yx = x71;
        const double x72 = 2.0*omega_x;
        const double x73 = FMA(2.0, omegadot_x*omegadot_x, d_omegadot_x*x72);
        const double x74 = -x62 - x73;
        const double rate_rate_M_yy = x74;
        const double x75 = FMA(2.0, omegadot_y*omegadot_z, FMA(d_omegadot_z, omega_y, d_omegadot_y*omega_z));
        const double x76 = -d2_omegadot_x + x75;
        const double rate_rate_M_yz = x76;
        const double rate_rate_b_f_y = FMA(rate_M_yy, x70, FMA(rate_M_yx, x69, FMA(b_r_y, rate_rate_M_yy, FMA(b_r_x, rate_rate_M_yx, FMA(b_disc_r_z, rate_rate_M_yz, FMA(M_yy, rate_rate_b_r_y, FMA(M_yx, rate_rate_b_r_x, d2_a_y)))))));
        const double x77 = -d2_omegadot_y + x67;
        const double rate_rate_M_zx = x77;
        const double x78 = d2_omegadot_x + x75;
        const double rate_rate_M_zy = x78;
        const double x79 = -x63 - x73;
        const double rate_rate_M_zz = x79;
        const double rate_rate_b_f_z = FMA(rate_M_zy, x70, FMA(rate_M_zx, x69, FMA(b_r_y, rate_rate_M_zy, FMA(b_r_x, rate_rate_M_zx, FMA(b_disc_r_z, rate_rate_M_zz, FMA(M_zy, rate_rate_b_r_y, FMA(M_zx, rate_rate_b_r_x, d2_a_z)))))));
        const double rate_rate_b_tau_yx = FMA(-beta_z, rate_rate_sin_psi, rate_rate_cos_psi);
        const double rate_rate_b_tau_yy = FMA(beta_z, rate_rate_cos_psi, rate_rate_sin_psi);
        const double x80 = 2.0*rate_b_f_x;
        const double x81 = 2.0*rate_b_f_y;
        const double rate_rate_b_f_yj = FMA(rate_b_tau_yy, x81, FMA(rate_b_tau_yx, x80, FMA(-beta_x, rate_rate_b_f_z, FMA(b_tau_yy, rate_rate_b_f_y, FMA(b_tau_yx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_yy, b_f_x*rate_rate_b_tau_yx))))));
        const double rate_rate_b_tau_zx = FMA(-beta_x, rate_rate_cos_psi, -b_disc_tau_zy*rate_rate_sin_psi);
        const double rate_rate_b_tau_zy = FMA(-beta_x, rate_rate_sin_psi, b_disc_tau_zy*rate_rate_cos_psi);
        const double rate_rate_b_f_zj = FMA(rate_b_tau_zy, x81, FMA(rate_b_tau_zx, x80, FMA(b_tau_zy, rate_rate_b_f_y, FMA(b_tau_zx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_zy, FMA(b_f_x, rate_rate_b_tau_zx, -rate_rate_b_f_z))))));
        const double f_f_x = FMA(M_xz, f_disc_r_z, FMA(M_xy, f_r_y, FMA(M_xx, f_r_x, a_x)));
        const double f_f_y = FMA(M_yz, f_disc_r_z, FMA(M_yy, f_r_y, FMA(M_yx, f_r_x, a_y)));
        const double f_f_z = FMA(M_zz, f_disc_r_z, FMA(M_zy, f_r_y, FMA(M_zx, f_r_x, a_z)));
        const double f_f_xj = FMA(f_f_y, f_tau_xy, f_f_x*f_tau_xx);
        const double f_f_yj = FMA(f_f_y, f_tau_yy, FMA(-beta_x, f_f_z, f_f_x*f_tau_yx));
        const double f_f_zj = FMA(f_f_y, f_tau_zy, FMA(f_f_x, f_tau_zx, -f_f_z));
        const double f_f_i = FMA(-f_f_zj, vartheta_y, FMA(f_f_yj, vartheta_z, f_f_xj));
        const double f_f_o = FMA(f_f_zj, vartheta_x, FMA(-f_f_xj, vartheta_z, f_f_yj));
        const double f_f_p = FMA(-f_f_yj, vartheta_x, FMA(f_f_xj, vartheta_y, f_f_zj));
        const double q_disc_r_x = x21;
        const double q_r_x = cos_psi*q_disc_r_x;
        const double q_r_y = q_disc_r_x*sin_psi;
        const double q_arm_x = q_r_x*x44;
        const double q_arm_y = q_r_y*x44;
        const double q_f_x = FMA(M_xy, q_r_y, FMA(M_xx, q_r_x, a_x));
        const double q_f_y = FMA(M_yy, q_r_y, FMA(M_yx, q_r_x, a_y));
        const double q_f_z = FMA(M_zy, q_r_y, FMA(M_zx, q_r_x, a_z));
        const double q_f_xj = FMA(-q_f_x, sin_psi, cos_psi*q_f_y);
        const double q_f_yj = FMA(q_f_y, sin_psi, cos_psi*q_f_x);
        const double x82 = K6*q_f_yj;
        const double x83 = K4*q_f_z;
        const double x84 = K8*q_f_z;
        const double i_sensed = FMA(-q_f_yj, x84, FMA(-q_f_xj, x83, FMA(q_f_xj, x82, FMA(K7, q_f_z*q_f_z, FMA(K5, q_f_yj*q_f_yj, FMA(K2, q_f_xj*q_f_xj, K0 + f_f_i))))));
        const double V2__rate_M_xx = x48;
        const double V2__rate_M_xy = x50;
        const double V2__rate_M_xz = x52;
        const double V2__rate_cos_psi = FMA(-rate_sin_phi_true, sin_j, cos_j*rate_cos_phi_true);
        const double V2__rate_sin_psi = FMA(rate_cos_phi_true, sin_j, cos_j*rate_sin_phi_true);
        const double rate_f_r_x = FMA(-V2__rate_sin_psi, f_disc_r_y, V2__rate_cos_psi*f_disc_r_x);
        const double rate_f_r_y = FMA(V2__rate_sin_psi, f_disc_r_x, V2__rate_cos_psi*f_disc_r_y);
        const double rate_f_f_x = FMA(V2__rate_M_xz, f_disc_r_z, FMA(V2__rate_M_xy, f_r_y, FMA(V2__rate_M_xx, f_r_x, FMA(M_xy, rate_f_r_y, FMA(M_xx, rate_f_r_x, d_a_x)))));
        const double V2__rate_M_yx = x53;
        const double V2__rate_M_yy = x56;
        const double V2__rate_M_yz = x58;
        const double rate_f_f_y = FMA(V2__rate_M_yz, f_disc_r_z, FMA(V2__rate_M_yy, f_r_y, FMA(V2__rate_M_yx, f_r_x, FMA(M_yy, rate_f_r_y, FMA(M_yx, rate_f_r_x, d_a_y)))));
        const double x85 = FMA(V2__rate_cos_psi, beta_z, V2__rate_sin_psi);
        const double rate_f_tau_xx = -x85;
        const double x86 = FMA(-V2__rate_sin_psi, beta_z, V2__rate_cos_psi);
        const double rate_f_tau_xy = x86;
        const double rate_f_f_xj = FMA(f_tau_xy, rate_f_f_y, FMA(f_tau_xx, rate_f_f_x, FMA(f_f_y, rate_f_tau_xy, f_f_x*rate_f_tau_xx)));
        const double V2__rate_M_zx = x59;
        const double V2__rate_M_zy = x60;
        const double V2__rate_M_zz = x61;
        const double rate_f_f_z = FMA(V2__rate_M_zz, f_disc_r_z, FMA(V2__rate_M_zy, f_r_y, FMA(V2__rate_M_zx, f_r_x, FMA(M_zy, rate_f_r_y, FMA(M_zx, rate_f_r_x, d_a_z)))));
        const double rate_f_tau_yx = x86;
        const double rate_f_tau_yy = x85;
        const double rate_f_f_yj = FMA(f_tau_yy, rate_f_f_y, FMA(f_tau_yx, rate_f_f_x, FMA(f_f_y, rate_f_tau_yy, FMA(-beta_x, rate_f_f_z, f_f_x*rate_f_tau_yx))));
        const double rate_f_tau_zx = FMA(-V2__rate_sin_psi, f_disc_tau_zy, -V2__rate_cos_psi*beta_x);
        const double rate_f_tau_zy = FMA(-V2__rate_sin_psi, beta_x, V2__rate_cos_psi*f_disc_tau_zy);
        const double rate_f_f_zj = FMA(f_tau_zy, rate_f_f_y, FMA(f_tau_zx, rate_f_f_x, FMA(f_f_y, rate_f_tau_zy, FMA(f_f_x, rate_f_tau_zx, -rate_f_f_z))));
        const double rate_f_f_i = FMA(-rate_f_f_zj, vartheta_y, FMA(rate_f_f_yj, vartheta_z, rate_f_f_xj));
        const double rate_V2__rate_M_xx = x64;
        const double rate_V2__rate_M_xy = x66;
        const double rate_V2__rate_M_xz = x68;
        const double rate_V2__rate_cos_psi = FMA(-rate_rate_sin_phi_true, sin_j, cos_j*rate_rate_cos_phi_true);
        const double rate_V2__rate_sin_psi = FMA(rate_rate_cos_phi_true, sin_j, cos_j*rate_rate_sin_phi_true);
        const double rate_rate_f_r_x = FMA(-f_disc_r_y, rate_V2__rate_sin_psi, f_disc_r_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_r_y = FMA(f_disc_r_y, rate_V2__rate_cos_psi, f_disc_r_x*rate_V2__rate_sin_psi);
        const double x87 = 2.0*rate_f_r_x;
        const double x88 = 2.0*rate_f_r_y;
        const double rate_rate_f_f_x = FMA(f_r_y, rate_V2__rate_M_xy, FMA(f_r_x, rate_V2__rate_M_xx, FMA(f_disc_r_z, rate_V2__rate_M_xz, FMA(V2__rate_M_xy, x88, FMA(V2__rate_M_xx, x87, FMA(M_xy, rate_rate_f_r_y, FMA(M_xx, rate_rate_f_r_x, d2_a_x)))))));
        const double rate_V2__rate_M_yx = x71;
        const double rate_V2__rate_M_yy = x74;
        const double rate_V2__rate_M_yz = x76;
        const double rate_rate_f_f_y = FMA(f_r_y, rate_V2__rate_M_yy, FMA(f_r_x, rate_V2__rate_M_yx, FMA(f_disc_r_z, rate_V2__rate_M_yz, FMA(V2__rate_M_yy, x88, FMA(V2__rate_M_yx, x87, FMA(M_yy, rate_rate_f_r_y, FMA(M_yx, rate_rate_f_r_x, d2_a_y)))))));
        const double x89 = FMA(beta_z, rate_V2__rate_cos_psi, rate_V2__rate_sin_psi);
        const double rate_rate_f_tau_xx = -x89;
        const double x90 = FMA(-beta_z, rate_V2__rate_sin_psi, rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_xy = x90;
        const double x91 = 2.0*rate_f_f_x;
        const double x92 = 2.0*rate_f_f_y;
        const double rate_rate_f_f_xj = FMA(rate_f_tau_xy, x92, FMA(rate_f_tau_xx, x91, FMA(f_tau_xy, rate_rate_f_f_y, FMA(f_tau_xx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_xy, f_f_x*rate_rate_f_tau_xx)))));
        const double rate_V2__rate_M_zx = x77;
        const double rate_V2__rate_M_zy = x78;
        const double rate_V2__rate_M_zz = x79;
        const double rate_rate_f_f_z = FMA(f_r_y, rate_V2__rate_M_zy, FMA(f_r_x, rate_V2__rate_M_zx, FMA(f_disc_r_z, rate_V2__rate_M_zz, FMA(V2__rate_M_zy, x88, FMA(V2__rate_M_zx, x87, FMA(M_zy, rate_rate_f_r_y, FMA(M_zx, rate_rate_f_r_x, d2_a_z)))))));
        const double rate_rate_f_tau_yx = x90;
        const double rate_rate_f_tau_yy = x89;
        const double rate_rate_f_f_yj = FMA(rate_f_tau_yy, x92, FMA(rate_f_tau_yx, x91, FMA(f_tau_yy, rate_rate_f_f_y, FMA(f_tau_yx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_yy, FMA(-beta_x, rate_rate_f_f_z, f_f_x*rate_rate_f_tau_yx))))));
        const double rate_rate_f_tau_zx = FMA(-f_disc_tau_zy, rate_V2__rate_sin_psi, -beta_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_zy = FMA(-beta_x, rate_V2__rate_sin_psi, f_disc_tau_zy*rate_V2__rate_cos_psi);
        const double rate_rate_f_f_zj = FMA(rate_f_tau_zy, x92, FMA(rate_f_tau_zx, x91, FMA(f_tau_zy, rate_rate_f_f_y, FMA(f_tau_zx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_zy, FMA(f_f_x, rate_rate_f_tau_zx, -rate_rate_f_f_z))))));
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
        const double x93 = 2.0*rate_q_r_x;
        const double x94 = 2.0*rate_q_r_y;
        const double rate_rate_q_f_x = FMA(q_r_y, rate_V2__rate_M_xy, FMA(q_r_x, rate_V2__rate_M_xx, FMA(V2__rate_M_xy, x94, FMA(V2__rate_M_xx, x93, FMA(M_xy, rate_rate_q_r_y, FMA(M_xx, rate_rate_q_r_x, d2_a_x))))));
        const double rate_rate_q_f_y = FMA(q_r_y, rate_V2__rate_M_yy, FMA(q_r_x, rate_V2__rate_M_yx, FMA(V2__rate_M_yy, x94, FMA(V2__rate_M_yx, x93, FMA(M_yy, rate_rate_q_r_y, FMA(M_yx, rate_rate_q_r_x, d2_a_y))))));
        const double x95 = 2.0*rate_q_f_y;
        const double x96 = 2.0*rate_q_f_x;
        const double rate_rate_q_f_xj = FMA(-rate_rate_q_f_x, sin_psi, FMA(q_f_y, rate_V2__rate_cos_psi, FMA(-q_f_x, rate_V2__rate_sin_psi, FMA(cos_psi, rate_rate_q_f_y, FMA(-V2__rate_sin_psi, x96, V2__rate_cos_psi*x95)))));
        const double rate_rate_q_f_yj = FMA(rate_rate_q_f_y, sin_psi, FMA(q_f_y, rate_V2__rate_sin_psi, FMA(q_f_x, rate_V2__rate_cos_psi, FMA(cos_psi, rate_rate_q_f_x, FMA(V2__rate_sin_psi, x95, V2__rate_cos_psi*x96)))));
        const double rate_rate_q_f_z = FMA(q_r_y, rate_V2__rate_M_zy, FMA(q_r_x, rate_V2__rate_M_zx, FMA(V2__rate_M_zy, x94, FMA(V2__rate_M_zx, x93, FMA(M_zy, rate_rate_q_r_y, FMA(M_zx, rate_rate_q_r_x, d2_a_z))))));
        const double x97 = 2.0*K2;
        const double x100 = FMA(q_f_xj, x97, x82 - x83);
        const double x98 = 2.0*K5;
        const double x101 = FMA(q_f_yj, x98, FMA(K6, q_f_xj, -x84));
        const double x99 = 2.0*K7;
        const double x102 = FMA(-q_f_z, x99, FMA(K8, q_f_yj, K4*q_f_xj));
        const double rate_rate_i_sensed = FMA(-rate_rate_q_f_z, x102, FMA(rate_rate_q_f_yj, x101, FMA(rate_rate_q_f_xj, x100, FMA(-rate_q_f_z, FMA(-rate_q_f_z, x99, FMA(K8, rate_q_f_yj, K4*rate_q_f_xj)), FMA(rate_q_f_yj, FMA(rate_q_f_yj, x98, FMA(-K8, rate_q_f_z, K6*rate_q_f_xj)), FMA(rate_q_f_xj, FMA(rate_q_f_xj, x97, FMA(-K4, rate_q_f_z, K6*rate_q_f_yj)), rate_rate_f_f_i))))));
        const double x103 = FMA(-f_tau_zx, vartheta_y, FMA(f_tau_yx, vartheta_z, f_tau_xx));
        const double vibration_axis_ix = x103;
        const double x104 = FMA(-f_tau_zy, vartheta_y, FMA(f_tau_yy, vartheta_z, f_tau_xy));
        const double vibration_axis_iy = x104;
        const double x105 = FMA(-beta_x, vartheta_z, vartheta_y);
        const double vibration_axis_iz = x105;
        const double vibration_axis_ox = FMA(f_tau_zx, vartheta_x, FMA(-f_tau_xx, vartheta_z, f_tau_yx));
        const double vibration_axis_oy = FMA(f_tau_zy, vartheta_x, FMA(-f_tau_xy, vartheta_z, f_tau_yy));
        const double vibration_axis_oz = -beta_x - vartheta_x;
        const double vibration_axis_px = FMA(-f_tau_yx, vartheta_x, FMA(f_tau_xx, vartheta_y, f_tau_zx));
        const double vibration_axis_py = FMA(-f_tau_yy, vartheta_x, FMA(f_tau_xy, vartheta_y, f_tau_zy));
        const double vibration_axis_pz = FMA(beta_x, vartheta_x, -(1.0));
        const double bar_i_vibration_rectification = K1*k_VI;
        const double bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x102;
        const double bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x101;
        const double bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x100;
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
        const double x106 = d_spin_angle + omega_z;
        const double x107 = 2.0*x106;
        const double bar_rate_dR_arm_stretch = FMA(-bar_q_p_second_order_misalignment, FMA(-q_arm_x, x45, q_arm_y*x72), FMA(bar_q_f_y, q_arm_x*x107, FMA(-bar_q_f_x, q_arm_y*x107, FMA(bar_f_f_z, FMA(-f_arm_x, x45, 2.0*f_arm_y*omega_x), FMA(bar_f_f_y, FMA(-f_arm_z, x72, f_arm_x*x107), bar_f_f_x*FMA(-f_arm_y, x107, 2.0*f_arm_z*omega_y))))));
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
        const double x108 = bar_f_f_z - bar_q_p_second_order_misalignment;
        const double bar_rate_rate_run_out_z = x108;
        const double x109 = bar_f_f_y + bar_q_f_y;
        const double bar_rate_rate_run_out_y = x109;
        const double x110 = bar_f_f_x + bar_q_f_x;
        const double bar_rate_rate_run_out_x = x110;
        const double bar_rate_run_out_z = FMA(-bar_q_f_y, x72, FMA(bar_q_f_x, x45, FMA(-bar_f_f_y, x72, bar_f_f_x*x45)));
        const double bar_rate_run_out_y = FMA(-bar_q_p_second_order_misalignment, x72, FMA(-bar_q_f_x, x40, FMA(-bar_f_f_x, x40, 2.0*bar_f_f_z*omega_x)));
        const double bar_rate_run_out_x = FMA(bar_q_p_second_order_misalignment, x45, FMA(bar_q_f_y, x40, FMA(-bar_f_f_z, x45, bar_f_f_y*x40)));
        const double bar_run_out_z = FMA(-bar_q_p_second_order_misalignment, x20, FMA(bar_q_f_y, x15, FMA(bar_q_f_x, x8, FMA(bar_f_f_z, x20, FMA(bar_f_f_y, x15, bar_f_f_x*x8)))));
        const double bar_run_out_y = FMA(-bar_q_p_second_order_misalignment, x18, FMA(bar_q_f_y, x13, FMA(bar_q_f_x, x5, FMA(bar_f_f_z, x18, FMA(bar_f_f_y, x13, bar_f_f_x*x5)))));
        const double bar_run_out_x = FMA(-bar_q_p_second_order_misalignment, x16, FMA(bar_q_f_y, x10, FMA(bar_q_f_x, x3, FMA(bar_f_f_z, x16, FMA(bar_f_f_y, x10, bar_f_f_x*x3)))));
        const double bar_wobble_zy = FMA(bar_q_spin_axis_wobble_tau_yz, sin_psi, FMA(bar_q_spin_axis_wobble_tau_xz, cos_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_y, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zy, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yy, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xy, bar_f_spin_axis_wobble_r_z*f_r_y))))));
        const double bar_wobble_zx = FMA(bar_q_spin_axis_wobble_tau_yz, cos_psi, FMA(-bar_q_spin_axis_wobble_tau_xz, sin_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_x, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zx, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yx, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xx, bar_f_spin_axis_wobble_r_z*f_r_x))))));
        const double bar_wobble_yz = FMA(-bar_q_p_second_order_misalignment, q_f_y, FMA(-bar_f_spin_axis_wobble_tau_yy, beta_x, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zy)));
        const double bar_wobble_xz = FMA(-bar_q_p_second_order_misalignment, q_f_x, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_x, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zx)));
        const double bar_sin_psi = FMA(bar_q_spin_axis_wobble_r_y, q_disc_r_x, FMA(-bar_f_spin_axis_wobble_tau_zy, beta_x, FMA(-bar_f_spin_axis_wobble_tau_zx, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xy, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_x, FMA(-bar_f_spin_axis_wobble_r_x, f_disc_r_y, -bar_f_spin_axis_wobble_tau_xx + bar_f_spin_axis_wobble_tau_yy - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy)))))));
        const double bar_cos_psi = FMA(bar_q_spin_axis_wobble_r_x, q_disc_r_x, FMA(bar_f_spin_axis_wobble_tau_zy, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_zx, beta_x, FMA(bar_f_spin_axis_wobble_tau_yy, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xx, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_y, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_x, bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx)))))));
        const double x111 = bar_f_f_z*f_disc_r_z;
        const double bar_M_zz = x111;
        const double x112 = bar_f_f_z*f_r_y;
        const double x113 = bar_q_p_second_order_misalignment*q_r_y;
        const double bar_M_zy = x112 - x113;
        const double x114 = bar_q_p_second_order_misalignment*q_r_x;
        const double bar_M_zx = FMA(bar_f_f_z, f_r_x, -x114);
        const double x115 = bar_f_f_y*f_disc_r_z;
        const double bar_M_yz = x115;
        const double x116 = bar_f_f_y*f_r_y;
        const double x117 = bar_q_f_y*q_r_y;
        const double bar_M_yy = x116 + x117;
        const double x118 = bar_q_f_y*q_r_x;
        const double bar_M_yx = FMA(bar_f_f_y, f_r_x, x118);
        const double x119 = bar_f_f_x*f_disc_r_z;
        const double bar_M_xz = x119;
        const double x120 = bar_f_f_x*f_r_y;
        const double x121 = bar_q_f_x*q_r_y;
        const double bar_M_xy = x120 + x121;
        const double x122 = bar_q_f_x*q_r_x;
        const double bar_M_xx = FMA(bar_f_f_x, f_r_x, x122);
        const double bar_sin_phi_true = FMA(-bar_cos_psi, sin_j, bar_sin_psi*cos_j);
        const double bar_cos_phi_true = FMA(bar_sin_psi, sin_j, bar_cos_psi*cos_j);
        const double bar_sin_delta_phi = FMA(-bar_cos_phi_true, sin_phi, bar_sin_phi_true*cos_phi);
        const double bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx;
        const double bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx;
        const double bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy;
        const double bar_time_offset_omega_z = FMA(bar_M_zy, omega_y, FMA(bar_M_zx, omega_x, FMA(bar_M_yz, omega_y, FMA(-bar_M_yy, x40, FMA(-bar_M_xx, x40, bar_M_xz*omega_x)))));
        const double bar_time_offset_omega_y = FMA(-bar_M_zz, x45, FMA(bar_M_zy, omega_z, FMA(bar_M_yz, omega_z, FMA(bar_M_yx, omega_x, FMA(-bar_M_xx, x45, bar_M_xy*omega_x)))));
        const double bar_time_offset_omega_x = FMA(-bar_M_zz, x72, FMA(bar_M_zx, omega_z, FMA(-bar_M_yy, x72, FMA(bar_M_yx, omega_y, FMA(bar_M_xz, omega_z, bar_M_xy*omega_y)))));
        const double bar_time_offset_a_z = x108;
        const double bar_time_offset_a_y = x109;
        const double bar_time_offset_a_x = x110;
        const double bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy;
        const double bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx;
        const double bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx;
        const double x123 = a_y*bar_time_offset_a_z;
        const double x124 = bar_time_offset_omega_z*omega_y;
        const double x125 = bar_time_offset_omegadot_z*omegadot_y;
        const double bar_imu_turn_zy = x123 + x124 + x125;
        const double x126 = a_x*bar_time_offset_a_z;
        const double x127 = FMA(bar_time_offset_omegadot_z, omegadot_x, FMA(bar_time_offset_omega_z, omega_x, x126));
        const double bar_imu_turn_zx = x127;
        const double x128 = a_z*bar_time_offset_a_y;
        const double x129 = FMA(bar_time_offset_omegadot_y, omegadot_z, FMA(bar_time_offset_omega_y, omega_z, x128));
        const double bar_imu_turn_yz = x129;
        const double x130 = a_x*bar_time_offset_a_y;
        const double bar_imu_turn_yx = FMA(bar_time_offset_omegadot_y, omegadot_x, FMA(bar_time_offset_omega_y, omega_x, x130));
        const double x131 = a_z*bar_time_offset_a_x;
        const double x132 = bar_time_offset_omega_x*omega_z;
        const double x133 = bar_time_offset_omegadot_x*omegadot_z;
        const double bar_imu_turn_xz = x131 + x132 + x133;
        const double x134 = a_y*bar_time_offset_a_x;
        const double bar_imu_turn_xy = FMA(bar_time_offset_omegadot_x, omegadot_y, FMA(bar_time_offset_omega_x, omega_y, x134));
        const double x135 = (angular_vibration_rms*angular_vibration_rms);
        const double x136 = bar_M_yy*x135;
        const double x137 = bar_M_zz*x135;
        const double x138 = bar_M_xx*x135;
        const double x139 = bar_run_out_x*cos_phi;
        const double x140 = bar_run_out_y*cos_phi;
        const double x141 = bar_run_out_z*cos_phi;
        const double x142 = FMA(-rate_sin_phi_true, x30, rate_cos_phi_true*x33);
        const double x143 = (cos_phi*cos_phi);
        const double x144 = (sin_phi*sin_phi);
        const double x145 = x143 - x144;
        const double x146 = FMA(-2.0, rate_sin_phi_true*rate_sin_phi_true, FMA(-rate_rate_sin_phi_true, x30, FMA(rate_rate_cos_phi_true, x33, 2.0*rate_cos_phi_true*rate_cos_phi_true)));
        const double x147 = FMA(rate_sin_phi_true, x33, rate_cos_phi_true*x30);
        const double x148 = FMA(rate_rate_sin_phi_true, x33, FMA(rate_rate_cos_phi_true, x30, 4.0*rate_cos_phi_true*rate_sin_phi_true));
        const double x149 = bar_time_offset_a_x*d_a_x;
        const double x150 = bar_time_offset_a_y*d_a_y;
        const double x151 = bar_time_offset_a_z*d_a_z;
        const double x152 = bar_time_offset_omega_x*omegadot_x;
        const double x153 = bar_time_offset_omega_y*omegadot_y;
        const double x154 = bar_time_offset_omega_z*omegadot_z;
        const double x155 = bar_time_offset_omegadot_x*d_omegadot_x;
        const double x156 = bar_time_offset_omegadot_y*d_omegadot_y;
        const double x157 = bar_time_offset_omegadot_z*d_omegadot_z;
        const double x158 = bar_i_vibration_rectification*(f_f_i*f_f_i);
        const double x159 = (f_f_o*f_f_o);
        const double x160 = bar_i_vibration_rectification*f_f_i;
        const double x161 = (f_f_p*f_f_p);
        const double x162 = bar_sin_delta_phi*cos_phi;
        const double x163 = (cos_phi*cos_phi*cos_phi);
        const double x164 = (sin_phi*sin_phi*sin_phi);
        const double x165 = -bar_M_zz*fuel_mass;
        const double x166 = K1*bar_K1_thermal_scale;
        const double x167 = -bar_M_zz;
        const double x168 = x152 + x153 + x154;
        const double x169 = x155 + x156 + x157;
        const double x170 = -x131;
        const double x171 = -x123;
        const double x172 = -omegadot_y;
        const double x173 = f_r_x*x111;
        const double x174 = 0.5*(q_r_x*q_r_x);
        const double x175 = 0.5*(f_disc_r_z*f_disc_r_z);
        const double x176 = (f_r_x*f_r_x);
        const double x177 = 0.5*x176;
        const double x178 = x175 - x177;
        const double x179 = f_r_x*x119;
        const double x180 = 0.5*(q_r_y*q_r_y);
        const double x181 = 0.5*(f_r_y*f_r_y);
        const double x182 = x175 - x181;
        const double x183 = f_r_x*x115;
        const double x184 = (1.0/6.0)*(q_r_x*q_r_x*q_r_x);
        const double x185 = f_r_x*x175;
        const double x186 = FMA(-1.0/6.0, f_r_x*f_r_x*f_r_x, x185);
        const double x187 = (f_disc_r_z*f_disc_r_z*f_disc_r_z);
        const double x188 = (1.0/6.0)*x187;
        const double x189 = FMA(-0.5, f_disc_r_z*x176, x188);
        const double x190 = f_r_y*x173;
        const double x191 = f_r_y*x175;
        const double x192 = FMA(-f_r_y, x177, x191);
        const double x193 = FMA(-f_r_x, x181, x185);
        const double x194 = f_disc_r_z*x181;
        const double x195 = (1.0/6.0)*(q_r_y*q_r_y*q_r_y);
        const double x196 = FMA(-1.0/6.0, f_r_y*f_r_y*f_r_y, x191);
        const double x197 = x188 - x194;
        const double x198 = bar_i_vibration_rectification*rate_rate_i_sensed;
        const double x199 = sin_of_roll[i];
        const double x200 = -bar_M_zz*x199;
        const double x201 = sin_of_pitch[i];
        const double x202 = -bar_M_zz*x201;
        const double x203 = FMA(sin_yaw, sin_yaw, FMA(-cos_yaw, cos_yaw, (1.0)));
        const double x204 = -x203;
        const double x205 = 2.0*cos_yaw*sin_yaw;
        const double x206 = cos_yaw - (1.0);
        const double x207 = -Gamma_zz;
        const double x208 = 2.0*Gamma_yz;
        const double x209 = 2.0*Gamma_xz;
        const double x210 = FMA(-293.15, (1.0), temperature);
        const double x211 = (vibration_rms*vibration_rms);
        const double x212 = K4*vibration_axis_ix;
        const double x213 = vibration_axis_px*x212;
        const double x214 = K6*vibration_axis_ix;
        const double x215 = vibration_axis_ox*x214;
        const double x216 = K8*vibration_axis_ox;
        const double x217 = vibration_axis_px*x216;
        const double x218 = K2*(vibration_axis_ix*vibration_axis_ix);
        const double x219 = K5*(vibration_axis_ox*vibration_axis_ox);
        const double x220 = K7*(vibration_axis_px*vibration_axis_px);
        const double x221 = vibration_axis_py*x212;
        const double x222 = K4*vibration_axis_px;
        const double x223 = vibration_axis_iy*x222;
        const double x224 = vibration_axis_oy*x214;
        const double x225 = K6*vibration_axis_ox;
        const double x226 = vibration_axis_iy*x225;
        const double x227 = vibration_axis_py*x216;
        const double x228 = K8*vibration_axis_px;
        const double x229 = vibration_axis_oy*x228;
        const double x230 = vibration_axis_ix*x97;
        const double x231 = vibration_axis_iy*x230;
        const double x232 = vibration_axis_ox*x98;
        const double x233 = vibration_axis_oy*x232;
        const double x234 = vibration_axis_px*x99;
        const double x235 = vibration_axis_py*x234;
        const double x236 = vibration_axis_pz*x212;
        const double x237 = vibration_axis_iz*x222;
        const double x238 = vibration_axis_oz*x214;
        const double x239 = vibration_axis_iz*x225;
        const double x240 = vibration_axis_pz*x216;
        const double x241 = vibration_axis_oz*x228;
        const double x242 = vibration_axis_iz*x230;
        const double x243 = vibration_axis_oz*x232;
        const double x244 = vibration_axis_pz*x234;
        const double x245 = K4*vibration_axis_iy;
        const double x246 = vibration_axis_py*x245;
        const double x247 = K6*vibration_axis_iy;
        const double x248 = vibration_axis_oy*x247;
        const double x249 = K8*vibration_axis_oy;
        const double x250 = vibration_axis_py*x249;
        const double x251 = K2*(vibration_axis_iy*vibration_axis_iy);
        const double x252 = K5*(vibration_axis_oy*vibration_axis_oy);
        const double x253 = K7*(vibration_axis_py*vibration_axis_py);
        const double x254 = vibration_axis_pz*x245;
        const double x255 = K4*vibration_axis_iz;
        const double x256 = vibration_axis_py*x255;
        const double x257 = vibration_axis_oz*x247;
        const double x258 = K6*vibration_axis_iz;
        const double x259 = vibration_axis_oy*x258;
        const double x260 = vibration_axis_pz*x249;
        const double x261 = K8*vibration_axis_oz;
        const double x262 = vibration_axis_py*x261;
        const double x263 = vibration_axis_iy*vibration_axis_iz*x97;
        const double x264 = vibration_axis_oy*vibration_axis_oz*x98;
        const double x265 = vibration_axis_py*vibration_axis_pz*x99;
        const double x266 = vibration_axis_pz*x255;
        const double x267 = vibration_axis_oz*x258;
        const double x268 = vibration_axis_pz*x261;
        const double x269 = K2*(vibration_axis_iz*vibration_axis_iz);
        const double x270 = K5*(vibration_axis_oz*vibration_axis_oz);
        const double x271 = K7*(vibration_axis_pz*vibration_axis_pz);

        rows[0][i] = bar_i_vibration_rectification*((double)((i_sensed) > 0.0) - (double)((i_sensed) < 0.0)); /* adc-nonlinearity.h */
        rows[1][i] = -x136 - x137; /* angular-jitter.W_xx */
        rows[2][i] = -bar_spin_axis_tilt_Gamma_xy*x135; /* angular-jitter.W_xy */
        rows[3][i] = -bar_spin_axis_tilt_Gamma_xz*x135; /* angular-jitter.W_xz */
        rows[4][i] = -x137 - x138; /* angular-jitter.W_yy */
        rows[5][i] = -bar_spin_axis_tilt_Gamma_yz*x135; /* angular-jitter.W_yz */
        rows[6][i] = -x136 - x138; /* angular-jitter.W_zz */
        rows[7][i] = bar_i_vibration_rectification*(FMA(f_tau_xy, omega_y, f_tau_xx*omega_x))*(FMA(f_tau_zy, omega_y, FMA(f_tau_zx, omega_x, -x106))); /* anisoinertia.K_ip */
        rows[8][i] = bar_dR_arm_stretch; /* arm-length.delta_R */
        rows[9][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_zj, FMA(bar_rate_dR_arm_stretch, rate_b_f_zj, b_f_zj*bar_dR_arm_stretch)); /* arm-sag.c_z */
        rows[10][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_yj, FMA(bar_rate_dR_arm_stretch, rate_b_f_yj, b_f_yj*bar_dR_arm_stretch)); /* arm-stretch.c_r */
        rows[11][i] = FMA(bar_rate_run_out_x, rate_cos_phi_true, FMA(bar_rate_rate_run_out_x, rate_rate_cos_phi_true, x139)); /* bearing-run-out.c_x1 */
        rows[12][i] = FMA(bar_run_out_x, sin_phi, FMA(bar_rate_run_out_x, rate_sin_phi_true, bar_rate_rate_run_out_x*rate_rate_sin_phi_true)); /* bearing-run-out.s_x1 */
        rows[13][i] = FMA(bar_rate_run_out_y, rate_cos_phi_true, FMA(bar_rate_rate_run_out_y, rate_rate_cos_phi_true, x140)); /* bearing-run-out.c_y1 */
        rows[14][i] = FMA(bar_run_out_y, sin_phi, FMA(bar_rate_run_out_y, rate_sin_phi_true, bar_rate_rate_run_out_y*rate_rate_sin_phi_true)); /* bearing-run-out.s_y1 */
        rows[15][i] = FMA(bar_rate_run_out_z, rate_cos_phi_true, FMA(bar_rate_rate_run_out_z, rate_rate_cos_phi_true, x141)); /* bearing-run-out.c_z1 */
        rows[16][i] = FMA(bar_run_out_z, sin_phi, FMA(bar_rate_run_out_z, rate_sin_phi_true, bar_rate_rate_run_out_z*rate_rate_sin_phi_true)); /* bearing-run-out.s_z1 */
        rows[17][i] = FMA(bar_run_out_x, x145, FMA(bar_rate_run_out_x, x142, bar_rate_rate_run_out_x*x146)); /* bearing-run-out.c_x2 */
        rows[18][i] = FMA(x139, x30, FMA(bar_rate_run_out_x, x147, bar_rate_rate_run_out_x*x148)); /* bearing-run-out.s_x2 */
        rows[19][i] = FMA(bar_run_out_y, x145, FMA(bar_rate_run_out_y, x142, bar_rate_rate_run_out_y*x146)); /* bearing-run-out.c_y2 */
        rows[20][i] = FMA(x140, x30, FMA(bar_rate_run_out_y, x147, bar_rate_rate_run_out_y*x148)); /* bearing-run-out.s_y2 */
        rows[21][i] = FMA(bar_run_out_z, x145, FMA(bar_rate_run_out_z, x142, bar_rate_rate_run_out_z*x146)); /* bearing-run-out.c_z2 */
        rows[22][i] = FMA(x141, x30, FMA(bar_rate_run_out_z, x147, bar_rate_rate_run_out_z*x148)); /* bearing-run-out.s_z2 */
        rows[23][i] = bar_i_vibration_rectification*time; /* bias-drift.dK0_dt */
        rows[24][i] = bar_i_vibration_rectification; /* bias-step.dK0 */
        rows[25][i] = FMA(time, x157, FMA(time, x156, FMA(time, x155, FMA(time, x154, FMA(time, x153, FMA(time, x152, FMA(time, x151, FMA(time, x150, time*x149)))))))); /* clock-drift.epsilon */
        rows[26][i] = f_f_o*x158; /* cubic-cross.K_iio */
        rows[27][i] = f_f_p*x158; /* cubic-cross.K_iip */
        rows[28][i] = x159*x160; /* cubic-cross.K_ioo */
        rows[29][i] = f_f_o*f_f_p*x160; /* cubic-cross.K_iop */
        rows[30][i] = x160*x161; /* cubic-cross.K_ipp */
        rows[31][i] = bar_i_vibration_rectification*(f_f_o*f_f_o*f_f_o); /* cubic-cross.K_ooo */
        rows[32][i] = bar_i_vibration_rectification*f_f_p*x159; /* cubic-cross.K_oop */
        rows[33][i] = bar_i_vibration_rectification*f_f_o*x161; /* cubic-cross.K_opp */
        rows[34][i] = bar_i_vibration_rectification*(f_f_p*f_f_p*f_f_p); /* cubic-cross.K_ppp */
        rows[35][i] = bar_i_vibration_rectification*(f_f_i*f_f_i*f_f_i); /* cubic-input.K_iii */
        rows[36][i] = FMA(-bar_q_p_second_order_misalignment, FMA(q_r_y, spin_zy, q_r_x*spin_zx), FMA(bar_q_f_y, FMA(q_r_y, spin_yy, d2_spin_angle*q_r_x), FMA(bar_q_f_x, FMA(-d2_spin_angle, q_r_y, q_r_x*spin_xx), FMA(bar_f_f_z, FMA(f_r_y, spin_zy, f_r_x*spin_zx), FMA(bar_f_f_y, FMA(f_r_y, spin_yy, d2_spin_angle*f_r_x), bar_f_f_x*FMA(-d2_spin_angle, f_r_y, f_r_x*spin_xx)))))); /* disc-spin.share */
        rows[37][i] = x162; /* encoder-harmonic.c_1 */
        rows[38][i] = bar_sin_delta_phi*sin_phi; /* encoder-harmonic.s_1 */
        rows[39][i] = bar_sin_delta_phi*x145; /* encoder-harmonic.c_2 */
        rows[40][i] = x162*x30; /* encoder-harmonic.s_2 */
        rows[41][i] = bar_sin_delta_phi*(FMA(-3.0, cos_phi*x144, x163)); /* encoder-harmonic.c_3 */
        rows[42][i] = bar_sin_delta_phi*(FMA(3.0, sin_phi*x143, -x164)); /* encoder-harmonic.s_3 */
        rows[43][i] = bar_sin_delta_phi*(FMA(-6.0, x143*x144, FMA(sin_phi, sin_phi*sin_phi*sin_phi, cos_phi*cos_phi*cos_phi*cos_phi))); /* encoder-harmonic.c_4 */
        rows[44][i] = bar_sin_delta_phi*(FMA(-x164, x35, x163*x38)); /* encoder-harmonic.s_4 */
        rows[45][i] = FMA(-bar_M_xx, fuel_mass, -x165); /* fuel-gradient.G_xx */
        rows[46][i] = bar_spin_axis_tilt_Gamma_xy*fuel_mass; /* fuel-gradient.G_xy */
        rows[47][i] = bar_spin_axis_tilt_Gamma_xz*fuel_mass; /* fuel-gradient.G_xz */
        rows[48][i] = FMA(-bar_M_yy, fuel_mass, -x165); /* fuel-gradient.G_yy */
        rows[49][i] = bar_spin_axis_tilt_Gamma_yz*fuel_mass; /* fuel-gradient.G_yz */
        rows[50][i] = time*x166; /* gain-drift.dK1_dt */
        rows[51][i] = x166; /* gain-step.dK1 */
        rows[52][i] = -bar_M_xx - x167; /* gradient-offset.G_xx */
        rows[53][i] = bar_spin_axis_tilt_Gamma_xy; /* gradient-offset.G_xy */
        rows[54][i] = bar_spin_axis_tilt_Gamma_xz; /* gradient-offset.G_xz */
        rows[55][i] = -bar_M_yy - x167; /* gradient-offset.G_yy */
        rows[56][i] = bar_spin_axis_tilt_Gamma_yz; /* gradient-offset.G_yz */
        rows[57][i] = -bar_time_offset_omega_x; /* gyro-bias.b_x */
        rows[58][i] = -bar_time_offset_omega_y; /* gyro-bias.b_y */
        rows[59][i] = -bar_time_offset_omega_z; /* gyro-bias.b_z */
        rows[60][i] = x168; /* gyro-delay.delta_w */
        rows[61][i] = x169; /* gyro-delay.delta_d */
        rows[62][i] = FMA(-bar_time_offset_omegadot_x, d_a_x, -a_x*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xx */
        rows[63][i] = FMA(-bar_time_offset_omegadot_x, d_a_y, -a_y*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xy */
        rows[64][i] = FMA(-bar_time_offset_omegadot_x, d_a_z, -a_z*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xz */
        rows[65][i] = FMA(-bar_time_offset_omegadot_y, d_a_x, -a_x*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yx */
        rows[66][i] = FMA(-bar_time_offset_omegadot_y, d_a_y, -a_y*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yy */
        rows[67][i] = FMA(-bar_time_offset_omegadot_y, d_a_z, -a_z*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yz */
        rows[68][i] = FMA(-bar_time_offset_omegadot_z, d_a_x, -a_x*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zx */
        rows[69][i] = FMA(-bar_time_offset_omegadot_z, d_a_y, -a_y*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zy */
        rows[70][i] = FMA(-bar_time_offset_omegadot_z, d_a_z, -a_z*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zz */
        rows[71][i] = FMA(-bar_time_offset_omegadot_x, omegadot_x, -bar_time_offset_omega_x*omega_x); /* gyro-scale.s_x */
        rows[72][i] = FMA(-bar_time_offset_omegadot_y, omegadot_y, -bar_time_offset_omega_y*omega_y); /* gyro-scale.s_y */
        rows[73][i] = FMA(-bar_time_offset_omegadot_z, omegadot_z, -bar_time_offset_omega_z*omega_z); /* gyro-scale.s_z */
        rows[74][i] = -bar_time_offset_a_x; /* imu-acceleration-bias.b_x */
        rows[75][i] = -bar_time_offset_a_y; /* imu-acceleration-bias.b_y */
        rows[76][i] = -bar_time_offset_a_z; /* imu-acceleration-bias.b_z */
        rows[77][i] = -x134; /* imu-acceleration-misalignment.m_xy */
        rows[78][i] = x170; /* imu-acceleration-misalignment.m_xz */
        rows[79][i] = -x130; /* imu-acceleration-misalignment.m_yx */
        rows[80][i] = -x128; /* imu-acceleration-misalignment.m_yz */
        rows[81][i] = -x126; /* imu-acceleration-misalignment.m_zx */
        rows[82][i] = x171; /* imu-acceleration-misalignment.m_zy */
        rows[83][i] = -a_x*bar_time_offset_a_x; /* imu-acceleration-scale.s_x */
        rows[84][i] = -a_y*bar_time_offset_a_y; /* imu-acceleration-scale.s_y */
        rows[85][i] = -a_z*bar_time_offset_a_z; /* imu-acceleration-scale.s_z */
        rows[86][i] = FMA(bar_time_offset_a_z, (-x172 - x6), FMA(-bar_time_offset_a_y, x9, bar_time_offset_a_x*x2)); /* imu-lever-arm.l_x */
        rows[87][i] = FMA(-bar_time_offset_a_z, x17, FMA(bar_time_offset_a_y, x12, bar_time_offset_a_x*(omegadot_z - x4))); /* imu-lever-arm.l_y */
        rows[88][i] = FMA(bar_time_offset_a_z, x19, FMA(-bar_time_offset_a_x, x7, bar_time_offset_a_y*(omegadot_x - x14))); /* imu-lever-arm.l_z */
        rows[89][i] = -bar_imu_turn_yz + bar_imu_turn_zy; /* imu-misalignment.e_x */
        rows[90][i] = bar_imu_turn_xz - bar_imu_turn_zx; /* imu-misalignment.e_y */
        rows[91][i] = -bar_imu_turn_xy + bar_imu_turn_yx; /* imu-misalignment.e_z */
        rows[92][i] = -bar_i_vibration_rectification*rate_f_f_i; /* lag.tau */
        rows[93][i] = bar_i_vibration_rectification*(FMA(B_z, x105, FMA(B_y, x104, B_x*x103))); /* magnetic-bias.dK0_dB */
        rows[94][i] = b_f_xj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yx */
        rows[95][i] = b_f_yj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yy */
        rows[96][i] = b_f_zj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yz */
        rows[97][i] = b_f_xj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zx */
        rows[98][i] = b_f_yj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zy */
        rows[99][i] = b_f_zj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zz */
        rows[100][i] = FMA(-bar_q_f_x, x174, FMA(bar_f_f_x, x178, x173)); /* near-mass.T_xxx */
        rows[101][i] = FMA(-q_r_x, x121, FMA(-f_r_x, x120, FMA(-bar_q_f_y, x174, FMA(bar_f_f_z, f_disc_r_z*f_r_y, bar_f_f_y*x178)))); /* near-mass.T_xxy */
        rows[102][i] = FMA(bar_q_p_second_order_misalignment, x174, FMA(bar_f_f_z, x178, -x179)); /* near-mass.T_xxz */
        rows[103][i] = FMA(-q_r_x, x117, FMA(-f_r_x, x116, FMA(-bar_q_f_x, x180, FMA(bar_f_f_z, f_disc_r_z*f_r_x, bar_f_f_x*x182)))); /* near-mass.T_xyy */
        rows[104][i] = FMA(-f_r_y, x119, FMA(-f_r_x, x112, FMA(bar_q_p_second_order_misalignment, q_r_x*q_r_y, -x183))); /* near-mass.T_xyz */
        rows[105][i] = FMA(f_r_y, x111, FMA(-bar_q_f_y, x180, bar_f_f_y*x182)); /* near-mass.T_yyy */
        rows[106][i] = FMA(-f_r_y, x115, FMA(bar_q_p_second_order_misalignment, x180, bar_f_f_z*x182)); /* near-mass.T_yyz */
        rows[107][i] = FMA(-bar_q_f_x, x184, FMA(-bar_f_f_z, x189, bar_f_f_x*x186)); /* near-mass.T_xxxx */
        rows[108][i] = FMA(-x121, x174, FMA(-bar_q_f_y, x184, FMA(bar_f_f_y, x186, FMA(bar_f_f_x, x192, x190)))); /* near-mass.T_xxxy */
        rows[109][i] = FMA(bar_q_p_second_order_misalignment, x184, FMA(bar_f_f_z, x186, bar_f_f_x*x189)); /* near-mass.T_xxxz */
        rows[110][i] = FMA(-x122, x180, FMA(-x117, x174, FMA(bar_f_f_z, FMA(-1.0/3.0, x187, FMA(f_disc_r_z, x177, x194)), FMA(bar_f_f_y, x192, bar_f_f_x*x193)))); /* near-mass.T_xxyy */
        rows[111][i] = FMA(x113, x174, FMA(-f_r_y, x179, FMA(bar_f_f_z, x192, bar_f_f_y*x189))); /* near-mass.T_xxyz */
        rows[112][i] = FMA(-x118, x180, FMA(-bar_q_f_x, x195, FMA(bar_f_f_y, x193, FMA(bar_f_f_x, x196, x190)))); /* near-mass.T_xyyy */
        rows[113][i] = FMA(x114, x180, FMA(-f_r_y, x183, FMA(bar_f_f_z, x193, bar_f_f_x*x197))); /* near-mass.T_xyyz */
        rows[114][i] = FMA(-bar_q_f_y, x195, FMA(-bar_f_f_z, x197, bar_f_f_y*x196)); /* near-mass.T_yyyy */
        rows[115][i] = FMA(bar_q_p_second_order_misalignment, x195, FMA(bar_f_f_z, x196, bar_f_f_y*x197)); /* near-mass.T_yyyz */
        rows[116][i] = x160*fabs(f_f_i); /* odd-quadratic.K_oq */
        rows[117][i] = x198; /* output-filter.b */
        rows[118][i] = bar_i_vibration_rectification*i_sensed; /* output-gain-step.g */
        rows[119][i] = bar_i_vibration_rectification*(FMA(f_tau_yy, (-x172 - x42), FMA(-beta_x, (d2_spin_angle + omegadot_z), f_tau_yx*(omegadot_x + x43)))); /* pendulum-angular.K_pa */
        rows[120][i] = bar_i_vibration_rectification*(FMA(-101325.0, (1.0), pressure)); /* pressure-bias.dK0_dp */
        rows[121][i] = x198; /* second-order-loop.b */
        rows[122][i] = FMA(bar_q_p_second_order_misalignment, (f_f_p + q_f_z), FMA(bar_q_o_second_order_misalignment, (f_f_o - q_f_yj), bar_q_i_second_order_misalignment*(f_f_i - q_f_xj))); /* second-order-misalignment.kappa */
        rows[123][i] = FMA(-bar_M_xx, x199, -x200); /* self-gradient.G_xx_roll */
        rows[124][i] = bar_spin_axis_tilt_Gamma_xy*x199; /* self-gradient.G_xy_roll */
        rows[125][i] = bar_spin_axis_tilt_Gamma_xz*x199; /* self-gradient.G_xz_roll */
        rows[126][i] = FMA(-bar_M_yy, x199, -x200); /* self-gradient.G_yy_roll */
        rows[127][i] = bar_spin_axis_tilt_Gamma_yz*x199; /* self-gradient.G_yz_roll */
        rows[128][i] = FMA(-bar_M_xx, x201, -x202); /* self-gradient.G_xx_pitch */
        rows[129][i] = bar_spin_axis_tilt_Gamma_xy*x201; /* self-gradient.G_xy_pitch */
        rows[130][i] = bar_spin_axis_tilt_Gamma_xz*x201; /* self-gradient.G_xz_pitch */
        rows[131][i] = FMA(-bar_M_yy, x201, -x202); /* self-gradient.G_yy_pitch */
        rows[132][i] = bar_spin_axis_tilt_Gamma_yz*x201; /* self-gradient.G_yz_pitch */
        rows[133][i] = FMA(-bar_M_yy, x203, FMA(-bar_M_xx, x204, 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw)); /* self-gradient-yaw.G_d */
        rows[134][i] = FMA(bar_spin_axis_tilt_Gamma_xy, x204, FMA(-bar_M_yy, x205, bar_M_xx*x205)); /* self-gradient-yaw.G_xy */
        rows[135][i] = FMA(bar_spin_axis_tilt_Gamma_yz, sin_yaw, bar_spin_axis_tilt_Gamma_xz*x206); /* self-gradient-yaw.G_xz */
        rows[136][i] = FMA(-bar_spin_axis_tilt_Gamma_xz, sin_yaw, bar_spin_axis_tilt_Gamma_yz*x206); /* self-gradient-yaw.G_yz */
        rows[137][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (-Gamma_yy - x207), FMA(bar_M_zz, x208, FMA(-bar_M_yy, x208, FMA(Gamma_xz, bar_spin_axis_tilt_Gamma_xy, FMA(-Gamma_xy, bar_spin_axis_tilt_Gamma_xz, -x124 - x125 + x129 + x171))))); /* spin-axis-tilt.alpha_x */
        rows[138][i] = FMA(bar_spin_axis_tilt_Gamma_xz, (Gamma_xx + x207), FMA(-bar_M_zz, x209, FMA(bar_M_xx, x209, FMA(-Gamma_yz, bar_spin_axis_tilt_Gamma_xy, FMA(Gamma_xy, bar_spin_axis_tilt_Gamma_yz, x127 - x132 - x133 + x170))))); /* spin-axis-tilt.alpha_y */
        rows[139][i] = FMA(bar_wobble_zy, cos_phi, FMA(-bar_wobble_zx, sin_phi, FMA(-bar_wobble_yz, cos_phi, bar_wobble_xz*sin_phi))); /* spin-axis-wobble.w_x */
        rows[140][i] = FMA(-bar_wobble_zy, sin_phi, FMA(-bar_wobble_zx, cos_phi, FMA(bar_wobble_yz, sin_phi, bar_wobble_xz*cos_phi))); /* spin-axis-wobble.w_y */
        rows[141][i] = bar_sin_delta_phi; /* spin-phase-offset.phi_0 */
        rows[142][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_phi */
        rows[143][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_walk */
        rows[144][i] = 2.0*bar_sin_delta_phi*time*x31; /* spin-rate-offset.epsilon */
        rows[145][i] = -bar_sin_delta_phi*omegadot_z; /* spin-servo.c */
        rows[146][i] = bar_i_vibration_rectification*x210; /* thermal-bias.dK0_dT */
        rows[147][i] = bar_i_vibration_rectification*d_temperature; /* thermal-lag.dK0_dTdot */
        rows[148][i] = d_temperature*x166; /* thermal-lag.dK1_dTdot */
        rows[149][i] = x166*x210; /* thermal-scale.dK1_dT */
        rows[150][i] = x149 + x150 + x151 + x168 + x169; /* time-offset.delta_t */
        rows[151][i] = bar_i_vibration_rectification*(FMA(x211, x220, FMA(x211, x219, FMA(x211, x218, FMA(x211, x217, FMA(x211, x215, x211*x213)))))); /* vibration-level.L_xx */
        rows[152][i] = bar_i_vibration_rectification*(FMA(x211, x235, FMA(x211, x233, FMA(x211, x231, FMA(x211, x229, FMA(x211, x227, FMA(x211, x226, FMA(x211, x224, FMA(x211, x223, x211*x221))))))))); /* vibration-level.L_xy */
        rows[153][i] = bar_i_vibration_rectification*(FMA(x211, x244, FMA(x211, x243, FMA(x211, x242, FMA(x211, x241, FMA(x211, x240, FMA(x211, x239, FMA(x211, x238, FMA(x211, x237, x211*x236))))))))); /* vibration-level.L_xz */
        rows[154][i] = bar_i_vibration_rectification*(FMA(x211, x253, FMA(x211, x252, FMA(x211, x251, FMA(x211, x250, FMA(x211, x248, x211*x246)))))); /* vibration-level.L_yy */
        rows[155][i] = bar_i_vibration_rectification*(FMA(x211, x265, FMA(x211, x264, FMA(x211, x263, FMA(x211, x262, FMA(x211, x260, FMA(x211, x259, FMA(x211, x257, FMA(x211, x256, x211*x254))))))))); /* vibration-level.L_yz */
        rows[156][i] = bar_i_vibration_rectification*(FMA(x211, x271, FMA(x211, x270, FMA(x211, x269, FMA(x211, x268, FMA(x211, x267, x211*x266)))))); /* vibration-level.L_zz */
        rows[157][i] = bar_i_vibration_rectification*(x213 + x215 + x217 + x218 + x219 + x220); /* vibration-rectification.P_xx */
        rows[158][i] = bar_i_vibration_rectification*(x221 + x223 + x224 + x226 + x227 + x229 + x231 + x233 + x235); /* vibration-rectification.P_xy */
        rows[159][i] = bar_i_vibration_rectification*(x236 + x237 + x238 + x239 + x240 + x241 + x242 + x243 + x244); /* vibration-rectification.P_xz */
        rows[160][i] = bar_i_vibration_rectification*(x246 + x248 + x250 + x251 + x252 + x253); /* vibration-rectification.P_yy */
        rows[161][i] = bar_i_vibration_rectification*(x254 + x256 + x257 + x259 + x260 + x262 + x263 + x264 + x265); /* vibration-rectification.P_yz */
        rows[162][i] = bar_i_vibration_rectification*(x266 + x267 + x268 + x269 + x270 + x271); /* vibration-rectification.P_zz */
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
