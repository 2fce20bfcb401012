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

enum { ROWS = 217, STEP = 64, INPUTS = 63 };

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
    const double *restrict in_C__heat_rr = in[18] + at;
    const double *restrict in_C__heat_rt = in[19] + at;
    const double *restrict in_C__heat_start = in[20] + at;
    const double *restrict in_C__heat_tt = in[21] + at;
    const double *restrict in_C__mount_a_x = in[22] + at;
    const double *restrict in_C__mount_a_y = in[23] + at;
    const double *restrict in_C__mount_a_z = in[24] + at;
    const double *restrict in_C__mount_omega_x = in[25] + at;
    const double *restrict in_C__mount_omega_y = in[26] + at;
    const double *restrict in_C__mount_omega_z = in[27] + at;
    const double *restrict in_C__mount_omegadot_x = in[28] + at;
    const double *restrict in_C__mount_omegadot_y = in[29] + at;
    const double *restrict in_C__mount_omegadot_z = in[30] + at;
    const double *restrict in_C__play_axial = in[31] + at;
    const double *restrict in_C__play_radial = in[32] + at;
    const double *restrict in_C__play_tangential = in[33] + at;
    const double *restrict in_C__slip_axial = in[34] + at;
    const double *restrict in_C__slip_radial = in[35] + at;
    const double *restrict in_C__slip_tangential = in[36] + at;
    const double *restrict in_G_out = in[37] + at;
    const double *restrict in_angular_vibration_rms = in[38] + at;
    const double *restrict in_balance_current = in[39] + at;
    const double *restrict in_d2_a_x = in[40] + at;
    const double *restrict in_d2_a_y = in[41] + at;
    const double *restrict in_d2_a_z = in[42] + at;
    const double *restrict in_d2_omegadot_x = in[43] + at;
    const double *restrict in_d2_omegadot_y = in[44] + at;
    const double *restrict in_d2_omegadot_z = in[45] + at;
    const double *restrict in_d2_spin_angle = in[46] + at;
    const double *restrict in_d_a_x = in[47] + at;
    const double *restrict in_d_a_y = in[48] + at;
    const double *restrict in_d_a_z = in[49] + at;
    const double *restrict in_d_omegadot_x = in[50] + at;
    const double *restrict in_d_omegadot_y = in[51] + at;
    const double *restrict in_d_omegadot_z = in[52] + at;
    const double *restrict in_d_spin_angle = in[53] + at;
    const double *restrict in_d_temperature = in[54] + at;
    const double *restrict in_fuel_mass = in[55] + at;
    const double *restrict in_pitch = in[56] + at;
    const double *restrict in_pressure = in[57] + at;
    const double *restrict in_roll = in[58] + at;
    const double *restrict in_second_order_current = in[59] + at;
    const double *restrict in_temperature = in[60] + at;
    const double *restrict in_vibration_rms = in[61] + at;
    const double *restrict in_yaw = in[62] + at;
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
        const double C__heat_rr = in_C__heat_rr[i];
        const double C__heat_rt = in_C__heat_rt[i];
        const double C__heat_start = in_C__heat_start[i];
        const double C__heat_tt = in_C__heat_tt[i];
        const double C__mount_a_x = in_C__mount_a_x[i];
        const double C__mount_a_y = in_C__mount_a_y[i];
        const double C__mount_a_z = in_C__mount_a_z[i];
        const double C__mount_omega_x = in_C__mount_omega_x[i];
        const double C__mount_omega_y = in_C__mount_omega_y[i];
        const double C__mount_omega_z = in_C__mount_omega_z[i];
        const double C__mount_omegadot_x = in_C__mount_omegadot_x[i];
        const double C__mount_omegadot_y = in_C__mount_omegadot_y[i];
        const double C__mount_omegadot_z = in_C__mount_omegadot_z[i];
        const double C__play_axial = in_C__play_axial[i];
        const double C__play_radial = in_C__play_radial[i];
        const double C__play_tangential = in_C__play_tangential[i];
        const double C__slip_axial = in_C__slip_axial[i];
        const double C__slip_radial = in_C__slip_radial[i];
        const double C__slip_tangential = in_C__slip_tangential[i];
        const double G_out = in_G_out[i];
        const double angular_vibration_rms = in_angular_vibration_rms[i];
        const double balance_current = in_balance_current[i];
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
        const double second_order_current = in_second_order_current[i];
        const double temperature = in_temperature[i];
        const double vibration_rms = in_vibration_rms[i];
        const double x0 = cos_of_pitch[i];
        const double x1 = cos_of_yaw[i];
        const double attitude_xx = x0*x1;
        const double x2 = sin_of_yaw[i];
        const double x3 = cos_of_roll[i];
        const double x4 = x2*x3;
        const double x5 = sin_of_pitch[i];
        const double x6 = sin_of_roll[i];
        const double x7 = x1*x6;
        const double attitude_xy = FMA(x5, x7, -x4);
        const double x8 = x2*x6;
        const double x9 = x1*x3;
        const double attitude_xz = FMA(x5, x9, x8);
        const double attitude_yx = x0*x2;
        const double attitude_yy = FMA(x5, x8, x9);
        const double attitude_yz = FMA(x4, x5, -x7);
        const double attitude_zx = -x5;
        const double attitude_zy = x0*x6;
        const double attitude_zz = x0*x3;
        const double cos_yaw = x1;
        const double sin_yaw = x2;
        const double x10 = (omega_y*omega_y);
        const double x11 = (omega_z*omega_z);
        const double x12 = x10 + x11;
        const double x13 = -Gamma_xx - x12;
        const double M_xx = x13;
        const double x14 = omega_x*omega_y;
        const double x15 = -Gamma_xy - omegadot_z + x14;
        const double M_xy = x15;
        const double x16 = omega_x*omega_z;
        const double x17 = omegadot_y + x16;
        const double x18 = -Gamma_xz + x17;
        const double M_xz = x18;
        const double x19 = omegadot_z + x14;
        const double x20 = -Gamma_xy + x19;
        const double M_yx = x20;
        const double x21 = (omega_x*omega_x);
        const double x22 = x11 + x21;
        const double x23 = -Gamma_yy - x22;
        const double M_yy = x23;
        const double x24 = omega_y*omega_z;
        const double x25 = -Gamma_yz - omegadot_x + x24;
        const double M_yz = x25;
        const double x26 = -Gamma_xz - omegadot_y + x16;
        const double M_zx = x26;
        const double x27 = omegadot_x + x24;
        const double x28 = -Gamma_yz + x27;
        const double M_zy = x28;
        const double x29 = x10 + x21;
        const double x30 = -Gamma_zz - x29;
        const double M_zz = x30;
        const double cos_psi = FMA(-sin_j, sin_phi, cos_j*cos_phi);
        const double sin_psi = FMA(cos_phi, sin_j, cos_j*sin_phi);
        const double x31 = dR + radius;
        const double b_disc_r_x = x31;
        const double x32 = beta_z*x31;
        const double b_disc_r_y = x32;
        const double x33 = beta_x*x31;
        const double b_disc_r_z = x33;
        const double x34 = -beta_x*beta_z;
        const double b_disc_tau_zy = x34;
        const double b_r_x = FMA(-b_disc_r_y, sin_psi, b_disc_r_x*cos_psi);
        const double b_r_y = FMA(b_disc_r_y, cos_psi, b_disc_r_x*sin_psi);
        const double x35 = FMA(beta_z, cos_psi, sin_psi);
        const double x36 = -x35;
        const double b_tau_xx = x36;
        const double x37 = FMA(-beta_z, sin_psi, cos_psi);
        const double b_tau_xy = x37;
        const double b_tau_yx = x37;
        const double b_tau_yy = x35;
        const double x38 = beta_x*cos_psi;
        const double b_tau_zx = FMA(-b_disc_tau_zy, sin_psi, -x38);
        const double x39 = beta_x*sin_psi;
        const double b_tau_zy = FMA(b_disc_tau_zy, cos_psi, -x39);
        const double x40 = 2.0*sin_phi;
        const double x41 = 3.141592653589793*spin_frequency;
        const double x42 = -x40*x41;
        const double rate_cos_phi_true = x42;
        const double x43 = 2.0*cos_phi;
        const double x44 = x41*x43;
        const double rate_sin_phi_true = x44;
        const double x45 = 4.0*cos_phi;
        const double x46 = (3.141592653589793*3.141592653589793)*(spin_frequency*spin_frequency);
        const double x47 = -x45*x46;
        const double rate_rate_cos_phi_true = x47;
        const double x48 = 4.0*sin_phi;
        const double x49 = -x46*x48;
        const double rate_rate_sin_phi_true = x49;
        const double x50 = 2.0*omega_z;
        const double x51 = FMA(-d_spin_angle, x50, -d_spin_angle*d_spin_angle);
        const double spin_xx = x51;
        const double spin_yy = x51;
        const double x52 = d_spin_angle*omega_x;
        const double spin_zx = 2.0*x52;
        const double x53 = d_spin_angle*omega_y;
        const double spin_zy = 2.0*x53;
        const double b_f_x = FMA(M_xz, b_disc_r_z, FMA(M_xy, b_r_y, FMA(M_xx, b_r_x, a_x)));
        const double b_f_y = FMA(M_yz, b_disc_r_z, FMA(M_yy, b_r_y, FMA(M_yx, b_r_x, a_y)));
        const double b_f_z = FMA(M_zz, b_disc_r_z, FMA(M_zy, b_r_y, FMA(M_zx, b_r_x, a_z)));
        const double b_f_xj = FMA(b_f_y, b_tau_xy, b_f_x*b_tau_xx);
        const double b_f_yj = FMA(-b_f_z, beta_x, FMA(b_f_y, b_tau_yy, b_f_x*b_tau_yx));
        const double b_f_zj = FMA(b_f_y, b_tau_zy, FMA(b_f_x, b_tau_zx, -b_f_z));
        const double f_disc_r_x = x31;
        const double f_disc_r_y = x32;
        const double f_disc_r_z = x33;
        const double f_disc_tau_zy = x34;
        const double f_r_x = FMA(-f_disc_r_y, sin_psi, cos_psi*f_disc_r_x);
        const double f_r_y = FMA(f_disc_r_x, sin_psi, cos_psi*f_disc_r_y);
        const double f_tau_xx = x36;
        const double f_tau_xy = x37;
        const double f_tau_yx = x37;
        const double f_tau_yy = x35;
        const double f_tau_zx = FMA(-f_disc_tau_zy, sin_psi, -x38);
        const double f_tau_zy = FMA(cos_psi, f_disc_tau_zy, -x39);
        const double x54 = 1.0/x31;
        const double f_arm_x = f_r_x*x54;
        const double f_arm_y = f_r_y*x54;
        const double f_arm_z = f_disc_r_z*x54;
        const double x55 = 2.0*omega_y;
        const double x56 = omegadot_y*x55;
        const double x57 = omegadot_z*x50;
        const double x58 = -x56 - x57;
        const double rate_M_xx = x58;
        const double x59 = FMA(omega_y, omegadot_x, omega_x*omegadot_y);
        const double x60 = -d_omegadot_z + x59;
        const double rate_M_xy = x60;
        const double x61 = FMA(omega_z, omegadot_x, omega_x*omegadot_z);
        const double x62 = d_omegadot_y + x61;
        const double rate_M_xz = x62;
        const double V2__rate_cos_phi_true = x42;
        const double V2__rate_sin_phi_true = x44;
        const double rate_cos_psi = FMA(-V2__rate_sin_phi_true, sin_j, V2__rate_cos_phi_true*cos_j);
        const double rate_sin_psi = FMA(V2__rate_sin_phi_true, cos_j, V2__rate_cos_phi_true*sin_j);
        const double rate_b_r_x = FMA(-b_disc_r_y, rate_sin_psi, b_disc_r_x*rate_cos_psi);
        const double rate_b_r_y = FMA(b_disc_r_y, rate_cos_psi, b_disc_r_x*rate_sin_psi);
        const double rate_b_f_x = FMA(b_r_y, rate_M_xy, FMA(b_r_x, rate_M_xx, FMA(b_disc_r_z, rate_M_xz, FMA(M_xy, rate_b_r_y, FMA(M_xx, rate_b_r_x, d_a_x)))));
        const double x63 = d_omegadot_z + x59;
        const double rate_M_yx = x63;
        const double x64 = 2.0*omegadot_x;
        const double x65 = omega_x*x64;
        const double x66 = -x57 - x65;
        const double rate_M_yy = x66;
        const double x67 = FMA(omega_z, omegadot_y, omega_y*omegadot_z);
        const double x68 = -d_omegadot_x + x67;
        const double rate_M_yz = x68;
        const double rate_b_f_y = FMA(b_r_y, rate_M_yy, FMA(b_r_x, rate_M_yx, FMA(b_disc_r_z, rate_M_yz, FMA(M_yy, rate_b_r_y, FMA(M_yx, rate_b_r_x, d_a_y)))));
        const double x69 = -d_omegadot_y + x61;
        const double rate_M_zx = x69;
        const double x70 = d_omegadot_x + x67;
        const double rate_M_zy = x70;
        const double x71 = -x56 - x65;
        const double rate_M_zz = x71;
        const double rate_b_f_z = FMA(b_r_y, rate_M_zy, FMA(b_r_x, rate_M_zx, FMA(b_disc_r_z, rate_M_zz, FMA(M_zy, rate_b_r_y, FMA(M_zx, rate_b_r_x, d_a_z)))));
        const double rate_b_tau_yx = FMA(-beta_z, rate_sin_psi, rate_cos_psi);
        const double rate_b_tau_yy = FMA(beta_z, rate_cos_psi, rate_sin_psi);
        const double rate_b_f_yj = FMA(-beta_x, rate_b_f_z, FMA(b_tau_yy, rate_b_f_y, FMA(b_tau_yx, rate_b_f_x, FMA(b_f_y, rate_b_tau_yy, b_f_x*rate_b_tau_yx))));
        const double rate_b_tau_zx = FMA(-beta_x, rate_cos_psi, -b_disc_tau_zy*rate_sin_psi);
        const double rate_b_tau_zy = FMA(-beta_x, rate_sin_psi, b_disc_tau_zy*rate_cos_psi);
        const double rate_b_f_zj = FMA(b_tau_zy, rate_b_f_y, FMA(b_tau_zx, rate_b_f_x, FMA(b_f_y, rate_b_tau_zy, FMA(b_f_x, rate_b_tau_zx, -rate_b_f_z))));
        const double rate_V2__rate_cos_phi_true = x47;
        const double rate_V2__rate_sin_phi_true = x49;
        const double x72 = FMA(2.0, omegadot_z*omegadot_z, d_omegadot_z*x50);
        const double x73 = FMA(2.0, omegadot_y*omegadot_y, d_omegadot_y*x55);
        const double x74 = -x72 - x73;
        const double rate_rate_M_xx = x74;
        const double x75 = FMA(omegadot_y, x64, FMA(d_omegadot_y, omega_x, d_omegadot_x*omega_y));
        const double x76 = -d2_omegadot_z + x75;
        const double rate_rate_M_xy = x76;
        const double x77 = FMA(omegadot_z, x64, FMA(d_omegadot_z, omega_x, d_omegadot_x*omega_z));
        const double x78 = d2_omegadot_y + x77;
        const double rate_rate_M_xz = x78;
        const double rate_rate_cos_psi = FMA(-rate_V2__rate_sin_phi_true, sin_j, cos_j*rate_V2__rate_cos_phi_true);
        const double rate_rate_sin_psi = FMA(rate_V2__rate_cos_phi_true, sin_j, cos_j*rate_V2__rate_sin_phi_true);
        const double rate_rate_b_r_x = FMA(-b_disc_r_y, rate_rate_sin_psi, b_disc_r_x*rate_rate_cos_psi);
        const double rate_rate_b_r_y = FMA(b_disc_r_y, rate_rate_cos_psi, b_disc_r_x*rate_rate_sin_psi);
        const double x79 = 2.0*rate_b_r_x;
        const double x80 = 2.0*rate_b_r_y;
        const double rate_rate_b_f_x = FMA(rate_M_xy, x80, FMA(rate_M_xx, x79, FMA(b_r_y, rate_rate_M_xy, FMA(b_r_x, rate_rate_M_xx, FMA(b_disc_r_z, rate_rate_M_xz, FMA(M_xy, rate_rate_b_r_y, FMA(M_xx, rate_rate_b_r_x, d2_a_x)))))));
        const double x81 = d2_omegadot_z + x75;
        const double rate_rate_M_yx = x81;
        const double x82 = 2.0*omega_x;
        const double x83 = FMA(2.0, omegadot_x*omegadot_x, d_omegadot_x*x82);
        const double x84 = -x72 - x83;
        const double rate_rate_M_yy = x84;
        const double x85 = FMA(2.0, omegadot_y*omegadot_z, FMA(d_omegadot_z, omega_y, d_omegadot_y*omega_z));
        const double x86 = -d2_omegadot_x + x85;
        const double rate_rate_M_yz = x86;
        const double rate_rate_b_f_y = FMA(rate_M_yy, x80, FMA(rate_M_yx, x79, FMA(b_r_y, rate_rate_M_yy, FMA(b_r_x, rate_rate_M_yx, FMA(b_disc_r_z, rate_rate_M_yz, FMA(M_yy, rate_rate_b_r_y, FMA(M_yx, rate_rate_b_r_x, d2_a_y)))))));
        const double x87 = -d2_omegadot_y + x77;
        const double rate_rate_M_zx = x87;
        const double x88 = d2_omegadot_x + x85;
        const double rate_rate_M_zy = x88;
        const double x89 = -x73 - x83;
        const double rate_rate_M_zz = x89;
        const double rate_rate_b_f_z = FMA(rate_M_zy, x80, FMA(rate_M_zx, x79, FMA(b_r_y, rate_rate_M_zy, FMA(b_r_x, rate_rate_M_zx, FMA(b_disc_r_z, rate_rate_M_zz, FMA(M_zy, rate_rate_b_r_y, FMA(M_zx, rate_rate_b_r_x, d2_a_z)))))));
        const double rate_rate_b_tau_yx = FMA(-beta_z, rate_rate_sin_psi, rate_rate_cos_psi);
        const double rate_rate_b_tau_yy = FMA(beta_z, rate_rate_cos_psi, rate_rate_sin_psi);
        const double x90 = 2.0*rate_b_f_x;
        const double x91 = 2.0*rate_b_f_y;
        const double rate_rate_b_f_yj = FMA(rate_b_tau_yy, x91, FMA(rate_b_tau_yx, x90, FMA(-beta_x, rate_rate_b_f_z, FMA(b_tau_yy, rate_rate_b_f_y, FMA(b_tau_yx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_yy, b_f_x*rate_rate_b_tau_yx))))));
        const double rate_rate_b_tau_zx = FMA(-beta_x, rate_rate_cos_psi, -b_disc_tau_zy*rate_rate_sin_psi);
        const double rate_rate_b_tau_zy = FMA(-beta_x, rate_rate_sin_psi, b_disc_tau_zy*rate_rate_cos_psi);
        const double rate_rate_b_f_zj = FMA(rate_b_tau_zy, x91, FMA(rate_b_tau_zx, x90, FMA(b_tau_zy, rate_rate_b_f_y, FMA(b_tau_zx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_zy, FMA(b_f_x, rate_rate_b_tau_zx, -rate_rate_b_f_z))))));
        const double f_f_x = FMA(M_xz, f_disc_r_z, FMA(M_xy, f_r_y, FMA(M_xx, f_r_x, a_x)));
        const double f_f_y = FMA(M_yz, f_disc_r_z, FMA(M_yy, f_r_y, FMA(M_yx, f_r_x, a_y)));
        const double f_f_z = FMA(M_zz, f_disc_r_z, FMA(M_zy, f_r_y, FMA(M_zx, f_r_x, a_z)));
        const double f_f_xj = FMA(f_f_y, f_tau_xy, f_f_x*f_tau_xx);
        const double f_f_yj = FMA(f_f_y, f_tau_yy, FMA(-beta_x, f_f_z, f_f_x*f_tau_yx));
        const double f_f_zj = FMA(f_f_y, f_tau_zy, FMA(f_f_x, f_tau_zx, -f_f_z));
        const double f_f_i = FMA(-f_f_zj, vartheta_y, FMA(f_f_yj, vartheta_z, f_f_xj));
        const double f_f_o = FMA(f_f_zj, vartheta_x, FMA(-f_f_xj, vartheta_z, f_f_yj));
        const double f_f_p = FMA(-f_f_yj, vartheta_x, FMA(f_f_xj, vartheta_y, f_f_zj));
        const double q_disc_r_x = x31;
        const double q_r_x = cos_psi*q_disc_r_x;
        const double q_r_y = q_disc_r_x*sin_psi;
        const double q_arm_x = q_r_x*x54;
        const double q_arm_y = q_r_y*x54;
        const double q_f_x = FMA(M_xy, q_r_y, FMA(M_xx, q_r_x, a_x));
        const double q_f_y = FMA(M_yy, q_r_y, FMA(M_yx, q_r_x, a_y));
        const double q_f_z = FMA(M_zy, q_r_y, FMA(M_zx, q_r_x, a_z));
        const double q_f_xj = FMA(-q_f_x, sin_psi, cos_psi*q_f_y);
        const double q_f_yj = FMA(q_f_y, sin_psi, cos_psi*q_f_x);
        const double x92 = K6*q_f_yj;
        const double x93 = (q_f_xj*q_f_xj);
        const double x94 = K4*q_f_z;
        const double x95 = K8*q_f_z;
        const double i_sensed = FMA(-q_f_yj, x95, FMA(-q_f_xj, x94, FMA(q_f_xj, x92, FMA(K7, q_f_z*q_f_z, FMA(K5, q_f_yj*q_f_yj, FMA(K2, x93, K0 + f_f_i))))));
        const double V2__rate_M_xx = x58;
        const double V2__rate_M_xy = x60;
        const double V2__rate_M_xz = x62;
        const double V2__rate_cos_psi = FMA(-rate_sin_phi_true, sin_j, cos_j*rate_cos_phi_true);
        const double V2__rate_sin_psi = FMA(rate_cos_phi_true, sin_j, cos_j*rate_sin_phi_true);
        const double rate_f_r_x = FMA(-V2__rate_sin_psi, f_disc_r_y, V2__rate_cos_psi*f_disc_r_x);
        const double rate_f_r_y = FMA(V2__rate_sin_psi, f_disc_r_x, V2__rate_cos_psi*f_disc_r_y);
        const double rate_f_f_x = FMA(V2__rate_M_xz, f_disc_r_z, FMA(V2__rate_M_xy, f_r_y, FMA(V2__rate_M_xx, f_r_x, FMA(M_xy, rate_f_r_y, FMA(M_xx, rate_f_r_x, d_a_x)))));
        const double V2__rate_M_yx = x63;
        const double V2__rate_M_yy = x66;
        const double V2__rate_M_yz = x68;
        const double rate_f_f_y = FMA(V2__rate_M_yz, f_disc_r_z, FMA(V2__rate_M_yy, f_r_y, FMA(V2__rate_M_yx, f_r_x, FMA(M_yy, rate_f_r_y, FMA(M_yx, rate_f_r_x, d_a_y)))));
        const double x96 = FMA(V2__rate_cos_psi, beta_z, V2__rate_sin_psi);
        const double rate_f_tau_xx = -x96;
        const double x97 = FMA(-V2__rate_sin_psi, beta_z, V2__rate_cos_psi);
        const double rate_f_tau_xy = x97;
        const double rate_f_f_xj = FMA(f_tau_xy, rate_f_f_y, FMA(f_tau_xx, rate_f_f_x, FMA(f_f_y, rate_f_tau_xy, f_f_x*rate_f_tau_xx)));
        const double V2__rate_M_zx = x69;
        const double V2__rate_M_zy = x70;
        const double V2__rate_M_zz = x71;
        const double rate_f_f_z = FMA(V2__rate_M_zz, f_disc_r_z, FMA(V2__rate_M_zy, f_r_y, FMA(V2__rate_M_zx, f_r_x, FMA(M_zy, rate_f_r_y, FMA(M_zx, rate_f_r_x, d_a_z)))));
        const double rate_f_tau_yx = x97;
        const double rate_f_tau_yy = x96;
        const double rate_f_f_yj = FMA(f_tau_yy, rate_f_f_y, FMA(f_tau_yx, rate_f_f_x, FMA(f_f_y, rate_f_tau_yy, FMA(-beta_x, rate_f_f_z, f_f_x*rate_f_tau_yx))));
        const double rate_f_tau_zx = FMA(-V2__rate_sin_psi, f_disc_tau_zy, -V2__rate_cos_psi*beta_x);
        const double rate_f_tau_zy = FMA(-V2__rate_sin_psi, beta_x, V2__rate_cos_psi*f_disc_tau_zy);
        const double rate_f_f_zj = FMA(f_tau_zy, rate_f_f_y, FMA(f_tau_zx, rate_f_f_x, FMA(f_f_y, rate_f_tau_zy, FMA(f_f_x, rate_f_tau_zx, -rate_f_f_z))));
        const double rate_f_f_i = FMA(-rate_f_f_zj, vartheta_y, FMA(rate_f_f_yj, vartheta_z, rate_f_f_xj));
        const double rate_V2__rate_M_xx = x74;
        const double rate_V2__rate_M_xy = x76;
        const double rate_V2__rate_M_xz = x78;
        const double rate_V2__rate_cos_psi = FMA(-rate_rate_sin_phi_true, sin_j, cos_j*rate_rate_cos_phi_true);
        const double rate_V2__rate_sin_psi = FMA(rate_rate_cos_phi_true, sin_j, cos_j*rate_rate_sin_phi_true);
        const double rate_rate_f_r_x = FMA(-f_disc_r_y, rate_V2__rate_sin_psi, f_disc_r_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_r_y = FMA(f_disc_r_y, rate_V2__rate_cos_psi, f_disc_r_x*rate_V2__rate_sin_psi);
        const double x98 = 2.0*rate_f_r_x;
        const double x99 = 2.0*rate_f_r_y;
        const double rate_rate_f_f_x = FMA(f_r_y, rate_V2__rate_M_xy, FMA(f_r_x, rate_V2__rate_M_xx, FMA(f_disc_r_z, rate_V2__rate_M_xz, FMA(V2__rate_M_xy, x99, FMA(V2__rate_M_xx, x98, FMA(M_xy, rate_rate_f_r_y, FMA(M_xx, rate_rate_f_r_x, d2_a_x)))))));
        const double rate_V2__rate_M_yx = x81;
        const double rate_V2__rate_M_yy = x84;
        const double rate_V2__rate_M_yz = x86;
        const double rate_rate_f_f_y = FMA(f_r_y, rate_V2__rate_M_yy, FMA(f_r_x, rate_V2__rate_M_yx, FMA(f_disc_r_z, rate_V2__rate_M_yz, FMA(V2__rate_M_yy, x99, FMA(V2__rate_M_yx, x98, FMA(M_yy, rate_rate_f_r_y, FMA(M_yx, rate_rate_f_r_x, d2_a_y)))))));
        const double x100 = FMA(beta_z, rate_V2__rate_cos_psi, rate_V2__rate_sin_psi);
        const double rate_rate_f_tau_xx = -x100;
        const double x101 = FMA(-beta_z, rate_V2__rate_sin_psi, rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_xy = x101;
        const double x102 = 2.0*rate_f_f_x;
        const double x103 = 2.0*rate_f_f_y;
        const double rate_rate_f_f_xj = FMA(rate_f_tau_xy, x103, FMA(rate_f_tau_xx, x102, FMA(f_tau_xy, rate_rate_f_f_y, FMA(f_tau_xx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_xy, f_f_x*rate_rate_f_tau_xx)))));
        const double rate_V2__rate_M_zx = x87;
        const double rate_V2__rate_M_zy = x88;
        const double rate_V2__rate_M_zz = x89;
        const double rate_rate_f_f_z = FMA(f_r_y, rate_V2__rate_M_zy, FMA(f_r_x, rate_V2__rate_M_zx, FMA(f_disc_r_z, rate_V2__rate_M_zz, FMA(V2__rate_M_zy, x99, FMA(V2__rate_M_zx, x98, FMA(M_zy, rate_rate_f_r_y, FMA(M_zx, rate_rate_f_r_x, d2_a_z)))))));
        const double rate_rate_f_tau_yx = x101;
        const double rate_rate_f_tau_yy = x100;
        const double rate_rate_f_f_yj = FMA(rate_f_tau_yy, x103, FMA(rate_f_tau_yx, x102, FMA(f_tau_yy, rate_rate_f_f_y, FMA(f_tau_yx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_yy, FMA(-beta_x, rate_rate_f_f_z, f_f_x*rate_rate_f_tau_yx))))));
        const double rate_rate_f_tau_zx = FMA(-f_disc_tau_zy, rate_V2__rate_sin_psi, -beta_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_zy = FMA(-beta_x, rate_V2__rate_sin_psi, f_disc_tau_zy*rate_V2__rate_cos_psi);
        const double rate_rate_f_f_zj = FMA(rate_f_tau_zy, x103, FMA(rate_f_tau_zx, x102, FMA(f_tau_zy, rate_rate_f_f_y, FMA(f_tau_zx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_zy, FMA(f_f_x, rate_rate_f_tau_zx, -rate_rate_f_f_z))))));
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
        const double x104 = 2.0*rate_q_r_x;
        const double x105 = 2.0*rate_q_r_y;
        const double rate_rate_q_f_x = FMA(q_r_y, rate_V2__rate_M_xy, FMA(q_r_x, rate_V2__rate_M_xx, FMA(V2__rate_M_xy, x105, FMA(V2__rate_M_xx, x104, FMA(M_xy, rate_rate_q_r_y, FMA(M_xx, rate_rate_q_r_x, d2_a_x))))));
        const double rate_rate_q_f_y = FMA(q_r_y, rate_V2__rate_M_yy, FMA(q_r_x, rate_V2__rate_M_yx, FMA(V2__rate_M_yy, x105, FMA(V2__rate_M_yx, x104, FMA(M_yy, rate_rate_q_r_y, FMA(M_yx, rate_rate_q_r_x, d2_a_y))))));
        const double x106 = 2.0*rate_q_f_y;
        const double x107 = 2.0*rate_q_f_x;
        const double rate_rate_q_f_xj = FMA(-rate_rate_q_f_x, sin_psi, FMA(q_f_y, rate_V2__rate_cos_psi, FMA(-q_f_x, rate_V2__rate_sin_psi, FMA(cos_psi, rate_rate_q_f_y, FMA(-V2__rate_sin_psi, x107, V2__rate_cos_psi*x106)))));
        const double rate_rate_q_f_yj = FMA(rate_rate_q_f_y, sin_psi, FMA(q_f_y, rate_V2__rate_sin_psi, FMA(q_f_x, rate_V2__rate_cos_psi, FMA(cos_psi, rate_rate_q_f_x, FMA(V2__rate_sin_psi, x106, V2__rate_cos_psi*x107)))));
        const double rate_rate_q_f_z = FMA(q_r_y, rate_V2__rate_M_zy, FMA(q_r_x, rate_V2__rate_M_zx, FMA(V2__rate_M_zy, x105, FMA(V2__rate_M_zx, x104, FMA(M_zy, rate_rate_q_r_y, FMA(M_zx, rate_rate_q_r_x, d2_a_z))))));
        const double x108 = 2.0*K2;
        const double x109 = 2.0*K5;
        const double x110 = 2.0*K7;
        const double x111 = FMA(q_f_xj, x108, x92 - x94);
        const double x112 = FMA(q_f_yj, x109, FMA(K6, q_f_xj, -x95));
        const double x113 = FMA(-q_f_z, x110, FMA(K8, q_f_yj, K4*q_f_xj));
        const double rate_rate_i_sensed = FMA(-rate_rate_q_f_z, x113, FMA(rate_rate_q_f_yj, x112, FMA(rate_rate_q_f_xj, x111, FMA(-rate_q_f_z, FMA(-rate_q_f_z, x110, FMA(K8, rate_q_f_yj, K4*rate_q_f_xj)), FMA(rate_q_f_yj, FMA(rate_q_f_yj, x109, FMA(-K8, rate_q_f_z, K6*rate_q_f_xj)), FMA(rate_q_f_xj, FMA(rate_q_f_xj, x108, FMA(-K4, rate_q_f_z, K6*rate_q_f_yj)), rate_rate_f_f_i))))));
        const double x114 = FMA(-f_tau_zx, vartheta_y, FMA(f_tau_yx, vartheta_z, f_tau_xx));
        const double vibration_axis_ix = x114;
        const double x115 = FMA(-f_tau_zy, vartheta_y, FMA(f_tau_yy, vartheta_z, f_tau_xy));
        const double vibration_axis_iy = x115;
        const double x116 = FMA(-beta_x, vartheta_z, vartheta_y);
        const double vibration_axis_iz = x116;
        const double vibration_axis_ox = FMA(f_tau_zx, vartheta_x, FMA(-f_tau_xx, vartheta_z, f_tau_yx));
        const double vibration_axis_oy = FMA(f_tau_zy, vartheta_x, FMA(-f_tau_xy, vartheta_z, f_tau_yy));
        const double vibration_axis_oz = -beta_x - vartheta_x;
        const double vibration_axis_px = FMA(-f_tau_yx, vartheta_x, FMA(f_tau_xx, vartheta_y, f_tau_zx));
        const double vibration_axis_py = FMA(-f_tau_yy, vartheta_x, FMA(f_tau_xy, vartheta_y, f_tau_zy));
        const double vibration_axis_pz = FMA(beta_x, vartheta_x, -(1.0));
        const double bar_i_vibration_rectification = K1*k_VI;
        const double bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x113;
        const double bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x112;
        const double bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x111;
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
        const double x117 = d_spin_angle + omega_z;
        const double x118 = 2.0*x117;
        const double bar_rate_dR_arm_stretch = FMA(-bar_q_p_second_order_misalignment, FMA(-q_arm_x, x55, q_arm_y*x82), FMA(bar_q_f_y, q_arm_x*x118, FMA(-bar_q_f_x, q_arm_y*x118, FMA(bar_f_f_z, FMA(-f_arm_x, x55, 2.0*f_arm_y*omega_x), FMA(bar_f_f_y, FMA(-f_arm_z, x82, f_arm_x*x118), bar_f_f_x*FMA(-f_arm_y, x118, 2.0*f_arm_z*omega_y))))));
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
        const double bar_K2_thermal_second_order = bar_i_vibration_rectification*x93;
        const double bar_K1_thermal_scale = i_sensed*k_VI;
        const double bar_vartheta_y_thermal_misalignment = -bar_i_vibration_rectification*f_f_zj;
        const double bar_vartheta_z_mount_hysteresis = bar_i_vibration_rectification*f_f_yj;
        const double bar_dR_arm_stretch = FMA(bar_f_spin_axis_wobble_r_z, beta_x, FMA(bar_f_disc_r_y, beta_z, bar_f_disc_r_x + bar_q_disc_r_x));
        const double x119 = bar_f_f_z - bar_q_p_second_order_misalignment;
        const double bar_rate_rate_run_out_z = x119;
        const double x120 = bar_f_f_y + bar_q_f_y;
        const double bar_rate_rate_run_out_y = x120;
        const double x121 = bar_f_f_x + bar_q_f_x;
        const double bar_rate_rate_run_out_x = x121;
        const double bar_rate_run_out_z = FMA(-bar_q_f_y, x82, FMA(bar_q_f_x, x55, FMA(-bar_f_f_y, x82, bar_f_f_x*x55)));
        const double bar_rate_run_out_y = FMA(-bar_q_p_second_order_misalignment, x82, FMA(-bar_q_f_x, x50, FMA(-bar_f_f_x, x50, 2.0*bar_f_f_z*omega_x)));
        const double bar_rate_run_out_x = FMA(bar_q_p_second_order_misalignment, x55, FMA(bar_q_f_y, x50, FMA(-bar_f_f_z, x55, bar_f_f_y*x50)));
        const double bar_run_out_z = FMA(-bar_q_p_second_order_misalignment, x30, FMA(bar_q_f_y, x25, FMA(bar_q_f_x, x18, FMA(bar_f_f_z, x30, FMA(bar_f_f_y, x25, bar_f_f_x*x18)))));
        const double bar_run_out_y = FMA(-bar_q_p_second_order_misalignment, x28, FMA(bar_q_f_y, x23, FMA(bar_q_f_x, x15, FMA(bar_f_f_z, x28, FMA(bar_f_f_y, x23, bar_f_f_x*x15)))));
        const double bar_run_out_x = FMA(-bar_q_p_second_order_misalignment, x26, FMA(bar_q_f_y, x20, FMA(bar_q_f_x, x13, FMA(bar_f_f_z, x26, FMA(bar_f_f_y, x20, bar_f_f_x*x13)))));
        const double bar_wobble_zy = FMA(bar_q_spin_axis_wobble_tau_yz, sin_psi, FMA(bar_q_spin_axis_wobble_tau_xz, cos_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_y, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zy, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yy, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xy, bar_f_spin_axis_wobble_r_z*f_r_y))))));
        const double bar_wobble_zx = FMA(bar_q_spin_axis_wobble_tau_yz, cos_psi, FMA(-bar_q_spin_axis_wobble_tau_xz, sin_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_x, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zx, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yx, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xx, bar_f_spin_axis_wobble_r_z*f_r_x))))));
        const double bar_wobble_yz = FMA(-bar_q_p_second_order_misalignment, q_f_y, FMA(-bar_f_spin_axis_wobble_tau_yy, beta_x, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zy)));
        const double bar_wobble_xz = FMA(-bar_q_p_second_order_misalignment, q_f_x, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_x, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zx)));
        const double bar_sin_psi = FMA(bar_q_spin_axis_wobble_r_y, q_disc_r_x, FMA(-bar_f_spin_axis_wobble_tau_zy, beta_x, FMA(-bar_f_spin_axis_wobble_tau_zx, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xy, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_x, FMA(-bar_f_spin_axis_wobble_r_x, f_disc_r_y, -bar_f_spin_axis_wobble_tau_xx + bar_f_spin_axis_wobble_tau_yy - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy)))))));
        const double bar_cos_psi = FMA(bar_q_spin_axis_wobble_r_x, q_disc_r_x, FMA(bar_f_spin_axis_wobble_tau_zy, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_zx, beta_x, FMA(bar_f_spin_axis_wobble_tau_yy, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xx, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_y, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_x, bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx)))))));
        const double x122 = bar_f_f_z*f_disc_r_z;
        const double bar_M_zz = x122;
        const double x123 = bar_f_f_z*f_r_y;
        const double x124 = bar_q_p_second_order_misalignment*q_r_y;
        const double bar_M_zy = x123 - x124;
        const double x125 = bar_q_p_second_order_misalignment*q_r_x;
        const double bar_M_zx = FMA(bar_f_f_z, f_r_x, -x125);
        const double x126 = bar_f_f_y*f_disc_r_z;
        const double bar_M_yz = x126;
        const double x127 = bar_f_f_y*f_r_y;
        const double x128 = bar_q_f_y*q_r_y;
        const double bar_M_yy = x127 + x128;
        const double x129 = bar_q_f_y*q_r_x;
        const double bar_M_yx = FMA(bar_f_f_y, f_r_x, x129);
        const double x130 = bar_f_f_x*f_disc_r_z;
        const double bar_M_xz = x130;
        const double x131 = bar_f_f_x*f_r_y;
        const double x132 = bar_q_f_x*q_r_y;
        const double bar_M_xy = x131 + x132;
        const double x133 = bar_q_f_x*q_r_x;
        const double bar_M_xx = FMA(bar_f_f_x, f_r_x, x133);
        const double bar_sin_phi_true = FMA(-bar_cos_psi, sin_j, bar_sin_psi*cos_j);
        const double bar_cos_phi_true = FMA(bar_sin_psi, sin_j, bar_cos_psi*cos_j);
        const double bar_sin_delta_phi = FMA(-bar_cos_phi_true, sin_phi, bar_sin_phi_true*cos_phi);
        const double bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx;
        const double bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx;
        const double bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy;
        const double bar_time_offset_omega_z = FMA(bar_M_zy, omega_y, FMA(bar_M_zx, omega_x, FMA(bar_M_yz, omega_y, FMA(-bar_M_yy, x50, FMA(-bar_M_xx, x50, bar_M_xz*omega_x)))));
        const double bar_time_offset_omega_y = FMA(-bar_M_zz, x55, FMA(bar_M_zy, omega_z, FMA(bar_M_yz, omega_z, FMA(bar_M_yx, omega_x, FMA(-bar_M_xx, x55, bar_M_xy*omega_x)))));
        const double bar_time_offset_omega_x = FMA(-bar_M_zz, x82, FMA(bar_M_zx, omega_z, FMA(-bar_M_yy, x82, FMA(bar_M_yx, omega_y, FMA(bar_M_xz, omega_z, bar_M_xy*omega_y)))));
        const double bar_time_offset_a_z = x119;
        const double bar_time_offset_a_y = x120;
        const double bar_time_offset_a_x = x121;
        const double bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy;
        const double bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx;
        const double bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx;
        const double x134 = a_y*bar_time_offset_a_z;
        const double x135 = bar_time_offset_omega_z*omega_y;
        const double x136 = bar_time_offset_omegadot_z*omegadot_y;
        const double x137 = x135 + x136;
        const double bar_imu_turn_zy = x134 + x137;
        const double x138 = a_x*bar_time_offset_a_z;
        const double x139 = FMA(bar_time_offset_omegadot_z, omegadot_x, bar_time_offset_omega_z*omega_x);
        const double x140 = x138 + x139;
        const double bar_imu_turn_zx = x140;
        const double x141 = a_z*bar_time_offset_a_y;
        const double x142 = FMA(bar_time_offset_omegadot_y, omegadot_z, bar_time_offset_omega_y*omega_z);
        const double x143 = x141 + x142;
        const double bar_imu_turn_yz = x143;
        const double x144 = a_x*bar_time_offset_a_y;
        const double x145 = FMA(bar_time_offset_omegadot_y, omegadot_x, bar_time_offset_omega_y*omega_x);
        const double bar_imu_turn_yx = x144 + x145;
        const double x146 = a_z*bar_time_offset_a_x;
        const double x147 = bar_time_offset_omega_x*omega_z;
        const double x148 = bar_time_offset_omegadot_x*omegadot_z;
        const double x149 = x147 + x148;
        const double bar_imu_turn_xz = x146 + x149;
        const double x150 = a_y*bar_time_offset_a_x;
        const double x151 = FMA(bar_time_offset_omegadot_x, omegadot_y, bar_time_offset_omega_x*omega_y);
        const double bar_imu_turn_xy = x150 + x151;
        const double x152 = (angular_vibration_rms*angular_vibration_rms);
        const double x153 = bar_M_yy*x152;
        const double x154 = bar_M_zz*x152;
        const double x155 = bar_M_xx*x152;
        const double x156 = K1*bar_K1_thermal_scale;
        const double x157 = bar_run_out_x*cos_phi;
        const double x158 = bar_run_out_y*cos_phi;
        const double x159 = bar_run_out_z*cos_phi;
        const double x160 = FMA(-rate_sin_phi_true, x40, rate_cos_phi_true*x43);
        const double x161 = (cos_phi*cos_phi);
        const double x162 = (sin_phi*sin_phi);
        const double x163 = x161 - x162;
        const double x164 = FMA(-2.0, rate_sin_phi_true*rate_sin_phi_true, FMA(-rate_rate_sin_phi_true, x40, FMA(rate_rate_cos_phi_true, x43, 2.0*rate_cos_phi_true*rate_cos_phi_true)));
        const double x165 = FMA(rate_sin_phi_true, x43, rate_cos_phi_true*x40);
        const double x166 = FMA(rate_rate_sin_phi_true, x43, FMA(rate_rate_cos_phi_true, x40, 4.0*rate_cos_phi_true*rate_sin_phi_true));
        const double x167 = (attitude_yx*attitude_yx);
        const double x168 = (attitude_yz*attitude_yz);
        const double x169 = attitude_xx*attitude_yx;
        const double x170 = attitude_xz*attitude_yz;
        const double x171 = -x170;
        const double x172 = attitude_xx*attitude_zx;
        const double x173 = attitude_xz*attitude_zz;
        const double x174 = -x173;
        const double x175 = attitude_yx*attitude_zx;
        const double x176 = attitude_yz*attitude_zz;
        const double x177 = -x176;
        const double x178 = (attitude_xz*attitude_xz);
        const double x179 = (attitude_xx*attitude_xx);
        const double x180 = (attitude_zx*attitude_zx);
        const double x181 = (attitude_zz*attitude_zz);
        const double x182 = (1.0) - x181;
        const double x183 = 2.0*bar_M_xx;
        const double x184 = attitude_xx*x183;
        const double x185 = 2.0*bar_M_yy;
        const double x186 = attitude_yx*x185;
        const double x187 = 2.0*attitude_zx;
        const double x188 = bar_M_zz*x187;
        const double x189 = attitude_xx*attitude_zy;
        const double x190 = attitude_xy*attitude_zx;
        const double x191 = attitude_yx*attitude_zy;
        const double x192 = attitude_yy*attitude_zx;
        const double x193 = attitude_xx*attitude_yy;
        const double x194 = attitude_xy*attitude_yx;
        const double x195 = attitude_xx*attitude_yz;
        const double x196 = attitude_xz*attitude_yx;
        const double x197 = attitude_yx*attitude_zz;
        const double x198 = attitude_yz*attitude_zx;
        const double x199 = attitude_xx*attitude_zz;
        const double x200 = attitude_xz*attitude_zx;
        const double x201 = (attitude_xy*attitude_xy);
        const double x202 = attitude_xy*attitude_yy;
        const double x203 = attitude_xy*attitude_zy;
        const double x204 = attitude_yy*attitude_zy;
        const double x205 = (attitude_yy*attitude_yy);
        const double x206 = (attitude_zy*attitude_zy);
        const double x207 = attitude_xy*attitude_xz;
        const double x208 = attitude_yy*attitude_yz;
        const double x209 = 2.0*attitude_zy*attitude_zz;
        const double x210 = attitude_xy*attitude_yz;
        const double x211 = attitude_xz*attitude_yy;
        const double x212 = attitude_xy*attitude_zz;
        const double x213 = attitude_xz*attitude_zy;
        const double x214 = attitude_yy*attitude_zz;
        const double x215 = attitude_yz*attitude_zy;
        const double x216 = -fuel_mass*x170;
        const double x217 = -fuel_mass*x173;
        const double x218 = -fuel_mass*x176;
        const double x219 = -fuel_mass*x178;
        const double x220 = -fuel_mass*x168;
        const double x221 = -fuel_mass*x181;
        const double x222 = bar_M_xx*fuel_mass;
        const double x223 = 2.0*x222;
        const double x224 = attitude_xx*x223;
        const double x225 = bar_M_yy*fuel_mass;
        const double x226 = 2.0*x225;
        const double x227 = attitude_yx*x226;
        const double x228 = bar_M_zz*fuel_mass;
        const double x229 = x187*x228;
        const double x230 = bar_time_offset_a_x*d_a_x;
        const double x231 = bar_time_offset_a_y*d_a_y;
        const double x232 = bar_time_offset_a_z*d_a_z;
        const double x233 = bar_time_offset_omega_x*omegadot_x;
        const double x234 = bar_time_offset_omega_y*omegadot_y;
        const double x235 = bar_time_offset_omega_z*omegadot_z;
        const double x236 = bar_time_offset_omegadot_x*d_omegadot_x;
        const double x237 = bar_time_offset_omegadot_y*d_omegadot_y;
        const double x238 = bar_time_offset_omegadot_z*d_omegadot_z;
        const double x239 = bar_i_vibration_rectification*(f_f_i*f_f_i);
        const double x240 = (f_f_o*f_f_o);
        const double x241 = bar_i_vibration_rectification*f_f_i;
        const double x242 = (f_f_p*f_f_p);
        const double x243 = bar_sin_delta_phi*cos_phi;
        const double x244 = (cos_phi*cos_phi*cos_phi);
        const double x245 = (sin_phi*sin_phi*sin_phi);
        const double x246 = -bar_M_zz*fuel_mass;
        const double x247 = -bar_M_zz;
        const double x248 = x233 + x234 + x235;
        const double x249 = x236 + x237 + x238;
        const double x250 = -x146;
        const double x251 = -x134;
        const double x252 = a_x*bar_time_offset_a_x;
        const double x253 = a_y*bar_time_offset_a_y;
        const double x254 = -omegadot_y;
        const double x255 = FMA(-293.15, (1.0), temperature);
        const double x256 = -x255;
        const double x257 = FMA(C__heat_tt, cos_j*cos_j, FMA(-2.0, C__heat_rt*cos_j*sin_j, C__heat_rr*sin_j*sin_j));
        const double x258 = bar_i_vibration_rectification*i_sensed;
        const double x259 = FMA(-C__play_radial, sin_j, C__play_tangential*cos_j);
        const double x260 = f_r_x*x122;
        const double x261 = 0.5*(q_r_x*q_r_x);
        const double x262 = 0.5*(f_disc_r_z*f_disc_r_z);
        const double x263 = (f_r_x*f_r_x);
        const double x264 = 0.5*x263;
        const double x265 = x262 - x264;
        const double x266 = f_r_x*x130;
        const double x267 = 0.5*(q_r_y*q_r_y);
        const double x268 = 0.5*(f_r_y*f_r_y);
        const double x269 = x262 - x268;
        const double x270 = f_r_x*x126;
        const double x271 = (1.0/6.0)*(q_r_x*q_r_x*q_r_x);
        const double x272 = f_r_x*x262;
        const double x273 = FMA(-1.0/6.0, f_r_x*f_r_x*f_r_x, x272);
        const double x274 = (f_disc_r_z*f_disc_r_z*f_disc_r_z);
        const double x275 = (1.0/6.0)*x274;
        const double x276 = FMA(-0.5, f_disc_r_z*x263, x275);
        const double x277 = f_r_y*x260;
        const double x278 = f_r_y*x262;
        const double x279 = FMA(-f_r_y, x264, x278);
        const double x280 = FMA(-f_r_x, x268, x272);
        const double x281 = f_disc_r_z*x268;
        const double x282 = (1.0/6.0)*(q_r_y*q_r_y*q_r_y);
        const double x283 = FMA(-1.0/6.0, f_r_y*f_r_y*f_r_y, x278);
        const double x284 = x275 - x281;
        const double x285 = bar_i_vibration_rectification*rate_rate_i_sensed;
        const double x286 = -bar_M_zz*x6;
        const double x287 = -bar_M_zz*x5;
        const double x288 = FMA(sin_yaw, sin_yaw, FMA(-cos_yaw, cos_yaw, (1.0)));
        const double x289 = -x288;
        const double x290 = cos_yaw*sin_yaw;
        const double x291 = cos_yaw - (1.0);
        const double x292 = -Gamma_zz;
        const double x293 = 2.0*Gamma_yz;
        const double x294 = 2.0*Gamma_xz;
        const double x295 = (vibration_rms*vibration_rms);
        const double x296 = K4*vibration_axis_ix;
        const double x297 = vibration_axis_px*x296;
        const double x298 = K6*vibration_axis_ix;
        const double x299 = vibration_axis_ox*x298;
        const double x300 = K8*vibration_axis_ox;
        const double x301 = vibration_axis_px*x300;
        const double x302 = K2*(vibration_axis_ix*vibration_axis_ix);
        const double x303 = K5*(vibration_axis_ox*vibration_axis_ox);
        const double x304 = K7*(vibration_axis_px*vibration_axis_px);
        const double x305 = vibration_axis_py*x296;
        const double x306 = K4*vibration_axis_px;
        const double x307 = vibration_axis_iy*x306;
        const double x308 = vibration_axis_oy*x298;
        const double x309 = K6*vibration_axis_ox;
        const double x310 = vibration_axis_iy*x309;
        const double x311 = vibration_axis_py*x300;
        const double x312 = K8*vibration_axis_px;
        const double x313 = vibration_axis_oy*x312;
        const double x314 = vibration_axis_ix*x108;
        const double x315 = vibration_axis_iy*x314;
        const double x316 = vibration_axis_ox*x109;
        const double x317 = vibration_axis_oy*x316;
        const double x318 = vibration_axis_px*x110;
        const double x319 = vibration_axis_py*x318;
        const double x320 = vibration_axis_pz*x296;
        const double x321 = vibration_axis_iz*x306;
        const double x322 = vibration_axis_oz*x298;
        const double x323 = vibration_axis_iz*x309;
        const double x324 = vibration_axis_pz*x300;
        const double x325 = vibration_axis_oz*x312;
        const double x326 = vibration_axis_iz*x314;
        const double x327 = vibration_axis_oz*x316;
        const double x328 = vibration_axis_pz*x318;
        const double x329 = K4*vibration_axis_iy;
        const double x330 = vibration_axis_py*x329;
        const double x331 = K6*vibration_axis_iy;
        const double x332 = vibration_axis_oy*x331;
        const double x333 = K8*vibration_axis_oy;
        const double x334 = vibration_axis_py*x333;
        const double x335 = K2*(vibration_axis_iy*vibration_axis_iy);
        const double x336 = K5*(vibration_axis_oy*vibration_axis_oy);
        const double x337 = K7*(vibration_axis_py*vibration_axis_py);
        const double x338 = vibration_axis_pz*x329;
        const double x339 = K4*vibration_axis_iz;
        const double x340 = vibration_axis_py*x339;
        const double x341 = vibration_axis_oz*x331;
        const double x342 = K6*vibration_axis_iz;
        const double x343 = vibration_axis_oy*x342;
        const double x344 = vibration_axis_pz*x333;
        const double x345 = K8*vibration_axis_oz;
        const double x346 = vibration_axis_py*x345;
        const double x347 = vibration_axis_iy*vibration_axis_iz*x108;
        const double x348 = vibration_axis_oy*vibration_axis_oz*x109;
        const double x349 = vibration_axis_py*vibration_axis_pz*x110;
        const double x350 = vibration_axis_pz*x339;
        const double x351 = vibration_axis_oz*x342;
        const double x352 = vibration_axis_pz*x345;
        const double x353 = K2*(vibration_axis_iz*vibration_axis_iz);
        const double x354 = K5*(vibration_axis_oz*vibration_axis_oz);
        const double x355 = K7*(vibration_axis_pz*vibration_axis_pz);

        rows[0][i] = bar_i_vibration_rectification*((double)((i_sensed) > 0.0) - (double)((i_sensed) < 0.0)); /* adc-nonlinearity.h */
        rows[1][i] = -x153 - x154; /* angular-jitter.W_xx */
        rows[2][i] = -bar_spin_axis_tilt_Gamma_xy*x152; /* angular-jitter.W_xy */
        rows[3][i] = -bar_spin_axis_tilt_Gamma_xz*x152; /* angular-jitter.W_xz */
        rows[4][i] = -x154 - x155; /* angular-jitter.W_yy */
        rows[5][i] = -bar_spin_axis_tilt_Gamma_yz*x152; /* angular-jitter.W_yz */
        rows[6][i] = -x153 - x155; /* angular-jitter.W_zz */
        rows[7][i] = bar_i_vibration_rectification*(FMA(f_tau_xy, omega_y, f_tau_xx*omega_x))*(FMA(f_tau_zy, omega_y, FMA(f_tau_zx, omega_x, -x117))); /* anisoinertia.K_ip */
        rows[8][i] = bar_dR_arm_stretch; /* arm-length.delta_R */
        rows[9][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_zj, FMA(bar_rate_dR_arm_stretch, rate_b_f_zj, b_f_zj*bar_dR_arm_stretch)); /* arm-sag.c_z */
        rows[10][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_yj, FMA(bar_rate_dR_arm_stretch, rate_b_f_yj, b_f_yj*bar_dR_arm_stretch)); /* arm-stretch.c_r */
        rows[11][i] = balance_current*x156; /* balancing-loop.dK1_di */
        rows[12][i] = bar_K2_thermal_second_order*second_order_current; /* balancing-loop.dK2_di */
        rows[13][i] = FMA(bar_rate_run_out_x, rate_cos_phi_true, FMA(bar_rate_rate_run_out_x, rate_rate_cos_phi_true, x157)); /* bearing-run-out.c_x1 */
        rows[14][i] = FMA(bar_run_out_x, sin_phi, FMA(bar_rate_run_out_x, rate_sin_phi_true, bar_rate_rate_run_out_x*rate_rate_sin_phi_true)); /* bearing-run-out.s_x1 */
        rows[15][i] = FMA(bar_rate_run_out_y, rate_cos_phi_true, FMA(bar_rate_rate_run_out_y, rate_rate_cos_phi_true, x158)); /* bearing-run-out.c_y1 */
        rows[16][i] = FMA(bar_run_out_y, sin_phi, FMA(bar_rate_run_out_y, rate_sin_phi_true, bar_rate_rate_run_out_y*rate_rate_sin_phi_true)); /* bearing-run-out.s_y1 */
        rows[17][i] = FMA(bar_rate_run_out_z, rate_cos_phi_true, FMA(bar_rate_rate_run_out_z, rate_rate_cos_phi_true, x159)); /* bearing-run-out.c_z1 */
        rows[18][i] = FMA(bar_run_out_z, sin_phi, FMA(bar_rate_run_out_z, rate_sin_phi_true, bar_rate_rate_run_out_z*rate_rate_sin_phi_true)); /* bearing-run-out.s_z1 */
        rows[19][i] = FMA(bar_run_out_x, x163, FMA(bar_rate_run_out_x, x160, bar_rate_rate_run_out_x*x164)); /* bearing-run-out.c_x2 */
        rows[20][i] = FMA(x157, x40, FMA(bar_rate_run_out_x, x165, bar_rate_rate_run_out_x*x166)); /* bearing-run-out.s_x2 */
        rows[21][i] = FMA(bar_run_out_y, x163, FMA(bar_rate_run_out_y, x160, bar_rate_rate_run_out_y*x164)); /* bearing-run-out.c_y2 */
        rows[22][i] = FMA(x158, x40, FMA(bar_rate_run_out_y, x165, bar_rate_rate_run_out_y*x166)); /* bearing-run-out.s_y2 */
        rows[23][i] = FMA(bar_run_out_z, x163, FMA(bar_rate_run_out_z, x160, bar_rate_rate_run_out_z*x164)); /* bearing-run-out.c_z2 */
        rows[24][i] = FMA(x159, x40, FMA(bar_rate_run_out_z, x165, bar_rate_rate_run_out_z*x166)); /* bearing-run-out.s_z2 */
        rows[25][i] = bar_i_vibration_rectification*time; /* bias-drift.dK0_dt */
        rows[26][i] = bar_i_vibration_rectification*(FMA(-C__slip_radial, sin_j, C__slip_tangential*cos_j)); /* bias-hysteresis.h_i */
        rows[27][i] = bar_i_vibration_rectification*(FMA(C__slip_tangential, sin_j, C__slip_radial*cos_j)); /* bias-hysteresis.h_o */
        rows[28][i] = -C__slip_axial*bar_i_vibration_rectification; /* bias-hysteresis.h_p */
        rows[29][i] = 0.0; /* bias-hysteresis.w */
        rows[30][i] = bar_i_vibration_rectification; /* bias-step.dK0 */
        rows[31][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x175 + x177), FMA(bar_spin_axis_tilt_Gamma_xz, (x172 + x174), FMA(-bar_M_zz, (x180 + x182), FMA(-bar_M_yy, (x167 - x168), FMA(-bar_M_xx, (-x178 + x179 - (1.0)), bar_spin_axis_tilt_Gamma_xy*(x169 + x171)))))); /* carrier-gradient.G_xx */
        rows[32][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x191 + x192), FMA(bar_spin_axis_tilt_Gamma_xz, (x189 + x190), FMA(-attitude_zy, x188, FMA(-attitude_yy, x186, FMA(-attitude_xy, x184, bar_spin_axis_tilt_Gamma_xy*(x193 + x194 - (1.0))))))); /* carrier-gradient.G_xy */
        rows[33][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x197 + x198), FMA(bar_spin_axis_tilt_Gamma_xz, (x199 + x200 - (1.0)), FMA(-attitude_zz, x188, FMA(-attitude_yz, x186, FMA(-attitude_xz, x184, bar_spin_axis_tilt_Gamma_xy*(x195 + x196)))))); /* carrier-gradient.G_xz */
        rows[34][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x177 + x204), FMA(bar_spin_axis_tilt_Gamma_xz, (x174 + x203), FMA(-bar_M_zz, (x182 + x206), FMA(-bar_M_yy, (-x168 + x205 - (1.0)), FMA(-bar_M_xx, (-x178 + x201), bar_spin_axis_tilt_Gamma_xy*(x171 + x202)))))); /* carrier-gradient.G_yy */
        rows[35][i] = FMA(-x185, x208, FMA(-x183, x207, FMA(bar_spin_axis_tilt_Gamma_yz, (x214 + x215 - (1.0)), FMA(bar_spin_axis_tilt_Gamma_xz, (x212 + x213), FMA(-bar_M_zz, x209, bar_spin_axis_tilt_Gamma_xy*(x210 + x211)))))); /* carrier-gradient.G_yz */
        rows[36][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x175, x218), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x172, x217), FMA(-bar_M_zz, FMA(fuel_mass, x180, x221), FMA(-bar_M_yy, FMA(fuel_mass, x167, x220), FMA(-bar_M_xx, FMA(fuel_mass, x179, x219), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x169, x216)))))); /* carrier-gradient.F_xx */
        rows[37][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x192, fuel_mass*x191), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x190, fuel_mass*x189), FMA(-attitude_zy, x229, FMA(-attitude_yy, x227, FMA(-attitude_xy, x224, bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x194, fuel_mass*x193)))))); /* carrier-gradient.F_xy */
        rows[38][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x198, fuel_mass*x197), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x200, fuel_mass*x199), FMA(-attitude_zz, x229, FMA(-attitude_yz, x227, FMA(-attitude_xz, x224, bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x196, fuel_mass*x195)))))); /* carrier-gradient.F_xz */
        rows[39][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x204, x218), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x203, x217), FMA(-bar_M_zz, FMA(fuel_mass, x206, x221), FMA(-bar_M_yy, FMA(fuel_mass, x205, x220), FMA(-bar_M_xx, FMA(fuel_mass, x201, x219), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x202, x216)))))); /* carrier-gradient.F_yy */
        rows[40][i] = FMA(-x209, x228, FMA(-x208, x226, FMA(-x207, x223, FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x215, fuel_mass*x214), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x213, fuel_mass*x212), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x211, fuel_mass*x210)))))); /* carrier-gradient.F_yz */
        rows[41][i] = FMA(time, x238, FMA(time, x237, FMA(time, x236, FMA(time, x235, FMA(time, x234, FMA(time, x233, FMA(time, x232, FMA(time, x231, time*x230)))))))); /* clock-drift.epsilon */
        rows[42][i] = f_f_o*x239; /* cubic-cross.K_iio */
        rows[43][i] = f_f_p*x239; /* cubic-cross.K_iip */
        rows[44][i] = x240*x241; /* cubic-cross.K_ioo */
        rows[45][i] = f_f_o*f_f_p*x241; /* cubic-cross.K_iop */
        rows[46][i] = x241*x242; /* cubic-cross.K_ipp */
        rows[47][i] = bar_i_vibration_rectification*(f_f_o*f_f_o*f_f_o); /* cubic-cross.K_ooo */
        rows[48][i] = bar_i_vibration_rectification*f_f_p*x240; /* cubic-cross.K_oop */
        rows[49][i] = bar_i_vibration_rectification*f_f_o*x242; /* cubic-cross.K_opp */
        rows[50][i] = bar_i_vibration_rectification*(f_f_p*f_f_p*f_f_p); /* cubic-cross.K_ppp */
        rows[51][i] = bar_i_vibration_rectification*(f_f_i*f_f_i*f_f_i); /* cubic-input.K_iii */
        rows[52][i] = FMA(-bar_q_p_second_order_misalignment, FMA(q_r_y, spin_zy, q_r_x*spin_zx), FMA(bar_q_f_y, FMA(q_r_y, spin_yy, d2_spin_angle*q_r_x), FMA(bar_q_f_x, FMA(-d2_spin_angle, q_r_y, q_r_x*spin_xx), FMA(bar_f_f_z, FMA(f_r_y, spin_zy, f_r_x*spin_zx), FMA(bar_f_f_y, FMA(f_r_y, spin_yy, d2_spin_angle*f_r_x), bar_f_f_x*FMA(-d2_spin_angle, f_r_y, f_r_x*spin_xx)))))); /* disc-spin.share */
        rows[53][i] = x243; /* encoder-harmonic.c_1 */
        rows[54][i] = bar_sin_delta_phi*sin_phi; /* encoder-harmonic.s_1 */
        rows[55][i] = bar_sin_delta_phi*x163; /* encoder-harmonic.c_2 */
        rows[56][i] = x243*x40; /* encoder-harmonic.s_2 */
        rows[57][i] = bar_sin_delta_phi*(FMA(-3.0, cos_phi*x162, x244)); /* encoder-harmonic.c_3 */
        rows[58][i] = bar_sin_delta_phi*(FMA(3.0, sin_phi*x161, -x245)); /* encoder-harmonic.s_3 */
        rows[59][i] = bar_sin_delta_phi*(FMA(-6.0, x161*x162, FMA(sin_phi, sin_phi*sin_phi*sin_phi, cos_phi*cos_phi*cos_phi*cos_phi))); /* encoder-harmonic.c_4 */
        rows[60][i] = bar_sin_delta_phi*(FMA(-x245, x45, x244*x48)); /* encoder-harmonic.s_4 */
        rows[61][i] = -x222 - x246; /* fuel-gradient.G_xx */
        rows[62][i] = bar_spin_axis_tilt_Gamma_xy*fuel_mass; /* fuel-gradient.G_xy */
        rows[63][i] = bar_spin_axis_tilt_Gamma_xz*fuel_mass; /* fuel-gradient.G_xz */
        rows[64][i] = -x225 - x246; /* fuel-gradient.G_yy */
        rows[65][i] = bar_spin_axis_tilt_Gamma_yz*fuel_mass; /* fuel-gradient.G_yz */
        rows[66][i] = time*x156; /* gain-drift.dK1_dt */
        rows[67][i] = x156; /* gain-step.dK1 */
        rows[68][i] = -bar_M_xx - x247; /* gradient-offset.G_xx */
        rows[69][i] = bar_spin_axis_tilt_Gamma_xy; /* gradient-offset.G_xy */
        rows[70][i] = bar_spin_axis_tilt_Gamma_xz; /* gradient-offset.G_xz */
        rows[71][i] = -bar_M_yy - x247; /* gradient-offset.G_yy */
        rows[72][i] = bar_spin_axis_tilt_Gamma_yz; /* gradient-offset.G_yz */
        rows[73][i] = -bar_time_offset_omega_x; /* gyro-bias.b_x */
        rows[74][i] = -bar_time_offset_omega_y; /* gyro-bias.b_y */
        rows[75][i] = -bar_time_offset_omega_z; /* gyro-bias.b_z */
        rows[76][i] = x248; /* gyro-delay.delta_w */
        rows[77][i] = x249; /* gyro-delay.delta_d */
        rows[78][i] = FMA(-bar_time_offset_omegadot_x, d_a_x, -a_x*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xx */
        rows[79][i] = FMA(-bar_time_offset_omegadot_x, d_a_y, -a_y*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xy */
        rows[80][i] = FMA(-bar_time_offset_omegadot_x, d_a_z, -a_z*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xz */
        rows[81][i] = FMA(-bar_time_offset_omegadot_y, d_a_x, -a_x*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yx */
        rows[82][i] = FMA(-bar_time_offset_omegadot_y, d_a_y, -a_y*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yy */
        rows[83][i] = FMA(-bar_time_offset_omegadot_y, d_a_z, -a_z*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yz */
        rows[84][i] = FMA(-bar_time_offset_omegadot_z, d_a_x, -a_x*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zx */
        rows[85][i] = FMA(-bar_time_offset_omegadot_z, d_a_y, -a_y*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zy */
        rows[86][i] = FMA(-bar_time_offset_omegadot_z, d_a_z, -a_z*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zz */
        rows[87][i] = -x151; /* gyro-misalignment.m_xy */
        rows[88][i] = -x149; /* gyro-misalignment.m_xz */
        rows[89][i] = -x145; /* gyro-misalignment.m_yx */
        rows[90][i] = -x142; /* gyro-misalignment.m_yz */
        rows[91][i] = -x139; /* gyro-misalignment.m_zx */
        rows[92][i] = -x137; /* gyro-misalignment.m_zy */
        rows[93][i] = FMA(-bar_time_offset_omegadot_x, omegadot_x, -bar_time_offset_omega_x*omega_x); /* gyro-scale.s_x */
        rows[94][i] = FMA(-bar_time_offset_omegadot_y, omegadot_y, -bar_time_offset_omega_y*omega_y); /* gyro-scale.s_y */
        rows[95][i] = FMA(-bar_time_offset_omegadot_z, omegadot_z, -bar_time_offset_omega_z*omega_z); /* gyro-scale.s_z */
        rows[96][i] = -bar_time_offset_a_x; /* imu-acceleration-bias.b_x */
        rows[97][i] = -bar_time_offset_a_y; /* imu-acceleration-bias.b_y */
        rows[98][i] = -bar_time_offset_a_z; /* imu-acceleration-bias.b_z */
        rows[99][i] = -x150; /* imu-acceleration-misalignment.m_xy */
        rows[100][i] = x250; /* imu-acceleration-misalignment.m_xz */
        rows[101][i] = -x144; /* imu-acceleration-misalignment.m_yx */
        rows[102][i] = -x141; /* imu-acceleration-misalignment.m_yz */
        rows[103][i] = -x138; /* imu-acceleration-misalignment.m_zx */
        rows[104][i] = x251; /* imu-acceleration-misalignment.m_zy */
        rows[105][i] = -(a_x*a_x)*bar_time_offset_a_x; /* imu-acceleration-quadratic.q_x */
        rows[106][i] = -(a_y*a_y)*bar_time_offset_a_y; /* imu-acceleration-quadratic.q_y */
        rows[107][i] = -x252; /* imu-acceleration-scale.s_x */
        rows[108][i] = -x253; /* imu-acceleration-scale.s_y */
        rows[109][i] = -a_z*bar_time_offset_a_z; /* imu-acceleration-scale.s_z */
        rows[110][i] = FMA(-bar_time_offset_a_z, d2_a_z, FMA(-bar_time_offset_a_y, d2_a_y, -bar_time_offset_a_x*d2_a_x)); /* imu-filter.b_a */
        rows[111][i] = FMA(-bar_time_offset_omegadot_z, d2_omegadot_z, FMA(-bar_time_offset_omegadot_y, d2_omegadot_y, FMA(-bar_time_offset_omegadot_x, d2_omegadot_x, FMA(-bar_time_offset_omega_z, d_omegadot_z, FMA(-bar_time_offset_omega_y, d_omegadot_y, -bar_time_offset_omega_x*d_omegadot_x))))); /* imu-filter.b_w */
        rows[112][i] = FMA(bar_time_offset_a_z, (-x16 - x254), FMA(-bar_time_offset_a_y, x19, bar_time_offset_a_x*x12)); /* imu-lever-arm.l_x */
        rows[113][i] = FMA(-bar_time_offset_a_z, x27, FMA(bar_time_offset_a_y, x22, bar_time_offset_a_x*(omegadot_z - x14))); /* imu-lever-arm.l_y */
        rows[114][i] = FMA(bar_time_offset_a_z, x29, FMA(-bar_time_offset_a_x, x17, bar_time_offset_a_y*(omegadot_x - x24))); /* imu-lever-arm.l_z */
        rows[115][i] = -bar_imu_turn_yz + bar_imu_turn_zy; /* imu-misalignment.e_x */
        rows[116][i] = bar_imu_turn_xz - bar_imu_turn_zx; /* imu-misalignment.e_y */
        rows[117][i] = -bar_imu_turn_xy + bar_imu_turn_yx; /* imu-misalignment.e_z */
        rows[118][i] = x230; /* imu-skew.delta_x */
        rows[119][i] = x231; /* imu-skew.delta_y */
        rows[120][i] = bar_time_offset_a_x*x256; /* imu-thermal.db_x_dT */
        rows[121][i] = bar_time_offset_a_y*x256; /* imu-thermal.db_y_dT */
        rows[122][i] = -x252*x255; /* imu-thermal.ds_x_dT */
        rows[123][i] = -x253*x255; /* imu-thermal.ds_y_dT */
        rows[124][i] = bar_i_vibration_rectification*x257; /* inner-temperature.b */
        rows[125][i] = x156*x257; /* inner-temperature.s */
        rows[126][i] = C__heat_start*bar_i_vibration_rectification; /* inner-temperature.b_0 */
        rows[127][i] = C__heat_start*x156; /* inner-temperature.s_0 */
        rows[128][i] = 0.0; /* inner-temperature.tau */
        rows[129][i] = -bar_i_vibration_rectification*rate_f_f_i; /* lag.tau */
        rows[130][i] = bar_i_vibration_rectification*(FMA(B_y, f_tau_zy, FMA(B_x, f_tau_zx, -B_z))); /* magnetic-axial-bias.dK0_dBz */
        rows[131][i] = bar_i_vibration_rectification*(FMA(B_z, x116, FMA(B_y, x115, B_x*x114))); /* magnetic-bias.dK0_dB */
        rows[132][i] = x258*(FMA(B_y, f_tau_xy, B_x*f_tau_xx)); /* magnetic-scale.dK1_dB */
        rows[133][i] = bar_vartheta_y_thermal_misalignment*time; /* misalignment-drift.dvartheta_y_dt */
        rows[134][i] = bar_vartheta_y_thermal_misalignment; /* misalignment-step.dvartheta_y */
        rows[135][i] = b_f_xj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yx */
        rows[136][i] = b_f_yj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yy */
        rows[137][i] = b_f_zj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yz */
        rows[138][i] = b_f_xj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zx */
        rows[139][i] = b_f_yj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zy */
        rows[140][i] = b_f_zj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zz */
        rows[141][i] = bar_vartheta_y_thermal_misalignment*x259; /* mount-hysteresis.e_yx */
        rows[142][i] = -C__play_axial*bar_vartheta_y_thermal_misalignment; /* mount-hysteresis.e_yz */
        rows[143][i] = bar_vartheta_z_mount_hysteresis*x259; /* mount-hysteresis.e_zx */
        rows[144][i] = 0.0; /* mount-hysteresis.w */
        rows[145][i] = FMA(C__mount_omegadot_z, bar_time_offset_omegadot_z, FMA(C__mount_omegadot_y, bar_time_offset_omegadot_y, FMA(C__mount_omegadot_x, bar_time_offset_omegadot_x, FMA(C__mount_omega_z, bar_time_offset_omega_z, FMA(C__mount_omega_y, bar_time_offset_omega_y, FMA(C__mount_omega_x, bar_time_offset_omega_x, FMA(C__mount_a_z, bar_time_offset_a_z, FMA(C__mount_a_y, bar_time_offset_a_y, C__mount_a_x*bar_time_offset_a_x)))))))); /* mount-resonance.share */
        rows[146][i] = 0.0; /* mount-resonance.f_0 */
        rows[147][i] = 0.0; /* mount-resonance.Q */
        rows[148][i] = FMA(-bar_q_f_x, x261, FMA(bar_f_f_x, x265, x260)); /* near-mass.T_xxx */
        rows[149][i] = FMA(-q_r_x, x132, FMA(-f_r_x, x131, FMA(-bar_q_f_y, x261, FMA(bar_f_f_z, f_disc_r_z*f_r_y, bar_f_f_y*x265)))); /* near-mass.T_xxy */
        rows[150][i] = FMA(bar_q_p_second_order_misalignment, x261, FMA(bar_f_f_z, x265, -x266)); /* near-mass.T_xxz */
        rows[151][i] = FMA(-q_r_x, x128, FMA(-f_r_x, x127, FMA(-bar_q_f_x, x267, FMA(bar_f_f_z, f_disc_r_z*f_r_x, bar_f_f_x*x269)))); /* near-mass.T_xyy */
        rows[152][i] = FMA(-f_r_y, x130, FMA(-f_r_x, x123, FMA(bar_q_p_second_order_misalignment, q_r_x*q_r_y, -x270))); /* near-mass.T_xyz */
        rows[153][i] = FMA(f_r_y, x122, FMA(-bar_q_f_y, x267, bar_f_f_y*x269)); /* near-mass.T_yyy */
        rows[154][i] = FMA(-f_r_y, x126, FMA(bar_q_p_second_order_misalignment, x267, bar_f_f_z*x269)); /* near-mass.T_yyz */
        rows[155][i] = FMA(-bar_q_f_x, x271, FMA(-bar_f_f_z, x276, bar_f_f_x*x273)); /* near-mass.T_xxxx */
        rows[156][i] = FMA(-x132, x261, FMA(-bar_q_f_y, x271, FMA(bar_f_f_y, x273, FMA(bar_f_f_x, x279, x277)))); /* near-mass.T_xxxy */
        rows[157][i] = FMA(bar_q_p_second_order_misalignment, x271, FMA(bar_f_f_z, x273, bar_f_f_x*x276)); /* near-mass.T_xxxz */
        rows[158][i] = FMA(-x133, x267, FMA(-x128, x261, FMA(bar_f_f_z, FMA(-1.0/3.0, x274, FMA(f_disc_r_z, x264, x281)), FMA(bar_f_f_y, x279, bar_f_f_x*x280)))); /* near-mass.T_xxyy */
        rows[159][i] = FMA(x124, x261, FMA(-f_r_y, x266, FMA(bar_f_f_z, x279, bar_f_f_y*x276))); /* near-mass.T_xxyz */
        rows[160][i] = FMA(-x129, x267, FMA(-bar_q_f_x, x282, FMA(bar_f_f_y, x280, FMA(bar_f_f_x, x283, x277)))); /* near-mass.T_xyyy */
        rows[161][i] = FMA(x125, x267, FMA(-f_r_y, x270, FMA(bar_f_f_z, x280, bar_f_f_x*x284))); /* near-mass.T_xyyz */
        rows[162][i] = FMA(-bar_q_f_y, x282, FMA(-bar_f_f_z, x284, bar_f_f_y*x283)); /* near-mass.T_yyyy */
        rows[163][i] = FMA(bar_q_p_second_order_misalignment, x282, FMA(bar_f_f_z, x283, bar_f_f_y*x284)); /* near-mass.T_yyyz */
        rows[164][i] = x241*fabs(f_f_i); /* odd-quadratic.K_oq */
        rows[165][i] = -G_out*x258; /* output-curve.c_2 */
        rows[166][i] = -(G_out*G_out)*x258; /* output-curve.c_3 */
        rows[167][i] = x285; /* output-filter.b */
        rows[168][i] = x258; /* output-gain-step.g */
        rows[169][i] = bar_i_vibration_rectification*(FMA(f_tau_yy, (-x254 - x52), FMA(-beta_x, (d2_spin_angle + omegadot_z), f_tau_yx*(omegadot_x + x53)))); /* pendulum-angular.K_pa */
        rows[170][i] = bar_i_vibration_rectification*(FMA(-101325.0, (1.0), pressure)); /* pressure-bias.dK0_dp */
        rows[171][i] = bar_K2_thermal_second_order*time; /* second-order-drift.dK2_dt */
        rows[172][i] = x285; /* second-order-loop.b */
        rows[173][i] = FMA(bar_q_p_second_order_misalignment, (f_f_p + q_f_z), FMA(bar_q_o_second_order_misalignment, (f_f_o - q_f_yj), bar_q_i_second_order_misalignment*(f_f_i - q_f_xj))); /* second-order-misalignment.kappa */
        rows[174][i] = bar_K2_thermal_second_order; /* second-order-step.dK2 */
        rows[175][i] = FMA(-bar_M_xx, x6, -x286); /* self-gradient.G_xx_roll */
        rows[176][i] = bar_spin_axis_tilt_Gamma_xy*x6; /* self-gradient.G_xy_roll */
        rows[177][i] = bar_spin_axis_tilt_Gamma_xz*x6; /* self-gradient.G_xz_roll */
        rows[178][i] = FMA(-bar_M_yy, x6, -x286); /* self-gradient.G_yy_roll */
        rows[179][i] = bar_spin_axis_tilt_Gamma_yz*x6; /* self-gradient.G_yz_roll */
        rows[180][i] = FMA(-bar_M_xx, x5, -x287); /* self-gradient.G_xx_pitch */
        rows[181][i] = bar_spin_axis_tilt_Gamma_xy*x5; /* self-gradient.G_xy_pitch */
        rows[182][i] = bar_spin_axis_tilt_Gamma_xz*x5; /* self-gradient.G_xz_pitch */
        rows[183][i] = FMA(-bar_M_yy, x5, -x287); /* self-gradient.G_yy_pitch */
        rows[184][i] = bar_spin_axis_tilt_Gamma_yz*x5; /* self-gradient.G_yz_pitch */
        rows[185][i] = FMA(-bar_M_yy, x288, FMA(-bar_M_xx, x289, 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw)); /* self-gradient-yaw.G_d */
        rows[186][i] = FMA(-x185, x290, FMA(x183, x290, bar_spin_axis_tilt_Gamma_xy*x289)); /* self-gradient-yaw.G_xy */
        rows[187][i] = FMA(bar_spin_axis_tilt_Gamma_yz, sin_yaw, bar_spin_axis_tilt_Gamma_xz*x291); /* self-gradient-yaw.G_xz */
        rows[188][i] = FMA(-bar_spin_axis_tilt_Gamma_xz, sin_yaw, bar_spin_axis_tilt_Gamma_yz*x291); /* self-gradient-yaw.G_yz */
        rows[189][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (-Gamma_yy - x292), FMA(bar_M_zz, x293, FMA(-bar_M_yy, x293, FMA(Gamma_xz, bar_spin_axis_tilt_Gamma_xy, FMA(-Gamma_xy, bar_spin_axis_tilt_Gamma_xz, -x135 - x136 + x143 + x251))))); /* spin-axis-tilt.alpha_x */
        rows[190][i] = FMA(bar_spin_axis_tilt_Gamma_xz, (Gamma_xx + x292), FMA(-bar_M_zz, x294, FMA(bar_M_xx, x294, FMA(-Gamma_yz, bar_spin_axis_tilt_Gamma_xy, FMA(Gamma_xy, bar_spin_axis_tilt_Gamma_yz, x140 - x147 - x148 + x250))))); /* spin-axis-tilt.alpha_y */
        rows[191][i] = FMA(bar_wobble_zy, cos_phi, FMA(-bar_wobble_zx, sin_phi, FMA(-bar_wobble_yz, cos_phi, bar_wobble_xz*sin_phi))); /* spin-axis-wobble.w_x */
        rows[192][i] = FMA(-bar_wobble_zy, sin_phi, FMA(-bar_wobble_zx, cos_phi, FMA(bar_wobble_yz, sin_phi, bar_wobble_xz*cos_phi))); /* spin-axis-wobble.w_y */
        rows[193][i] = bar_sin_delta_phi; /* spin-phase-offset.phi_0 */
        rows[194][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_phi */
        rows[195][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_walk */
        rows[196][i] = 2.0*bar_sin_delta_phi*time*x41; /* spin-rate-offset.epsilon */
        rows[197][i] = -bar_sin_delta_phi*omegadot_z; /* spin-servo.c */
        rows[198][i] = bar_i_vibration_rectification*x255; /* thermal-bias.dK0_dT */
        rows[199][i] = bar_i_vibration_rectification*d_temperature; /* thermal-lag.dK0_dTdot */
        rows[200][i] = d_temperature*x156; /* thermal-lag.dK1_dTdot */
        rows[201][i] = bar_vartheta_y_thermal_misalignment*x255; /* thermal-misalignment.dvartheta_y_dT */
        rows[202][i] = x156*x255; /* thermal-scale.dK1_dT */
        rows[203][i] = bar_K2_thermal_second_order*x255; /* thermal-second-order.dK2_dT */
        rows[204][i] = x230 + x231 + x232 + x248 + x249; /* time-offset.delta_t */
        rows[205][i] = bar_i_vibration_rectification*(FMA(x295, x304, FMA(x295, x303, FMA(x295, x302, FMA(x295, x301, FMA(x295, x299, x295*x297)))))); /* vibration-level.L_xx */
        rows[206][i] = bar_i_vibration_rectification*(FMA(x295, x319, FMA(x295, x317, FMA(x295, x315, FMA(x295, x313, FMA(x295, x311, FMA(x295, x310, FMA(x295, x308, FMA(x295, x307, x295*x305))))))))); /* vibration-level.L_xy */
        rows[207][i] = bar_i_vibration_rectification*(FMA(x295, x328, FMA(x295, x327, FMA(x295, x326, FMA(x295, x325, FMA(x295, x324, FMA(x295, x323, FMA(x295, x322, FMA(x295, x321, x295*x320))))))))); /* vibration-level.L_xz */
        rows[208][i] = bar_i_vibration_rectification*(FMA(x295, x337, FMA(x295, x336, FMA(x295, x335, FMA(x295, x334, FMA(x295, x332, x295*x330)))))); /* vibration-level.L_yy */
        rows[209][i] = bar_i_vibration_rectification*(FMA(x295, x349, FMA(x295, x348, FMA(x295, x347, FMA(x295, x346, FMA(x295, x344, FMA(x295, x343, FMA(x295, x341, FMA(x295, x340, x295*x338))))))))); /* vibration-level.L_yz */
        rows[210][i] = bar_i_vibration_rectification*(FMA(x295, x355, FMA(x295, x354, FMA(x295, x353, FMA(x295, x352, FMA(x295, x351, x295*x350)))))); /* vibration-level.L_zz */
        rows[211][i] = bar_i_vibration_rectification*(x297 + x299 + x301 + x302 + x303 + x304); /* vibration-rectification.P_xx */
        rows[212][i] = bar_i_vibration_rectification*(x305 + x307 + x308 + x310 + x311 + x313 + x315 + x317 + x319); /* vibration-rectification.P_xy */
        rows[213][i] = bar_i_vibration_rectification*(x320 + x321 + x322 + x323 + x324 + x325 + x326 + x327 + x328); /* vibration-rectification.P_xz */
        rows[214][i] = bar_i_vibration_rectification*(x330 + x332 + x334 + x335 + x336 + x337); /* vibration-rectification.P_yy */
        rows[215][i] = bar_i_vibration_rectification*(x338 + x340 + x341 + x343 + x344 + x346 + x347 + x348 + x349); /* vibration-rectification.P_yz */
        rows[216][i] = bar_i_vibration_rectification*(x350 + x351 + x352 + x353 + x354 + x355); /* vibration-rectification.P_zz */
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
