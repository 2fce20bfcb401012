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

enum { ROWS = 216, STEP = 64, INPUTS = 63 };

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
    const double *restrict in_d2_spin_angle = in[46] + at;
    const double *restrict in_d_spin_angle = in[53] + at;
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
        const double x11 = d_spin_angle + omega_z;
        const double x12 = -x11;
        const double x13 = -x11*x12;
        const double M_xx = -Gamma_xx - x10 - x13;
        const double x14 = d2_spin_angle + omegadot_z;
        const double x15 = omega_x*omega_y;
        const double x16 = Gamma_xy - x15;
        const double M_xy = -x14 - x16;
        const double x17 = -omegadot_y;
        const double x18 = d_spin_angle*omega_x;
        const double x19 = x17 + x18;
        const double M_xz = FMA(-omega_x, x12, -Gamma_xz - x19);
        const double x20 = omegadot_z + x15;
        const double x21 = -Gamma_xy + x20;
        const double M_yx = d2_spin_angle + x21;
        const double x22 = (omega_x*omega_x);
        const double M_yy = -Gamma_yy - x13 - x22;
        const double x23 = d_spin_angle*omega_y;
        const double x24 = omegadot_x + x23;
        const double M_yz = FMA(omega_y, x11, -Gamma_yz - x24);
        const double x25 = Gamma_xz + omegadot_y;
        const double M_zx = FMA(omega_x, x11, x18 - x25);
        const double x26 = -omegadot_x;
        const double M_zy = FMA(-omega_y, x12, -Gamma_yz + x23 - x26);
        const double x27 = x10 + x22;
        const double x28 = -Gamma_zz - x27;
        const double M_zz = x28;
        const double cos_psi = FMA(-sin_j, sin_phi, cos_j*cos_phi);
        const double sin_psi = FMA(cos_phi, sin_j, cos_j*sin_phi);
        const double x29 = dR + radius;
        const double b_disc_r_x = x29;
        const double x30 = beta_z*x29;
        const double b_disc_r_y = x30;
        const double x31 = beta_x*x29;
        const double b_disc_r_z = x31;
        const double x32 = -beta_x*beta_z;
        const double b_disc_tau_zy = x32;
        const double b_r_x = FMA(-b_disc_r_y, sin_psi, b_disc_r_x*cos_psi);
        const double b_r_y = FMA(b_disc_r_y, cos_psi, b_disc_r_x*sin_psi);
        const double x33 = FMA(beta_z, cos_psi, sin_psi);
        const double x34 = -x33;
        const double b_tau_xx = x34;
        const double x35 = FMA(-beta_z, sin_psi, cos_psi);
        const double b_tau_xy = x35;
        const double b_tau_yx = x35;
        const double b_tau_yy = x33;
        const double x36 = beta_x*cos_psi;
        const double b_tau_zx = FMA(-b_disc_tau_zy, sin_psi, -x36);
        const double x37 = beta_x*sin_psi;
        const double b_tau_zy = FMA(b_disc_tau_zy, cos_psi, -x37);
        const double x38 = d_spin_angle*sin_phi;
        const double x39 = -x38;
        const double rate_cos_phi_true = x39;
        const double x40 = cos_phi*d_spin_angle;
        const double rate_sin_phi_true = x40;
        const double x41 = d2_spin_angle*sin_phi;
        const double x42 = (d_spin_angle*d_spin_angle);
        const double x43 = cos_phi*x42;
        const double x44 = -x41 - x43;
        const double rate_rate_cos_phi_true = x44;
        const double x45 = cos_phi*d2_spin_angle;
        const double x46 = sin_phi*x42;
        const double x47 = x45 - x46;
        const double rate_rate_sin_phi_true = x47;
        const double b_f_x = FMA(M_xz, b_disc_r_z, FMA(M_xy, b_r_y, FMA(M_xx, b_r_x, a_x)));
        const double b_f_y = FMA(M_yz, b_disc_r_z, FMA(M_yy, b_r_y, FMA(M_yx, b_r_x, a_y)));
        const double b_f_z = FMA(M_zz, b_disc_r_z, FMA(M_zy, b_r_y, FMA(M_zx, b_r_x, a_z)));
        const double b_f_xj = FMA(b_f_y, b_tau_xy, b_f_x*b_tau_xx);
        const double b_f_yj = FMA(-b_f_z, beta_x, FMA(b_f_y, b_tau_yy, b_f_x*b_tau_yx));
        const double b_f_zj = FMA(b_f_y, b_tau_zy, FMA(b_f_x, b_tau_zx, -b_f_z));
        const double f_disc_r_x = x29;
        const double f_disc_r_y = x30;
        const double f_disc_r_z = x31;
        const double f_disc_tau_zy = x32;
        const double f_r_x = FMA(-f_disc_r_y, sin_psi, cos_psi*f_disc_r_x);
        const double f_r_y = FMA(f_disc_r_x, sin_psi, cos_psi*f_disc_r_y);
        const double f_tau_xx = x34;
        const double f_tau_xy = x35;
        const double f_tau_yx = x35;
        const double f_tau_yy = x33;
        const double f_tau_zx = FMA(-f_disc_tau_zy, sin_psi, -x36);
        const double f_tau_zy = FMA(cos_psi, f_disc_tau_zy, -x37);
        const double x48 = 1.0/x29;
        const double f_arm_x = f_r_x*x48;
        const double f_arm_y = f_r_y*x48;
        const double f_arm_z = f_disc_r_z*x48;
        const double x49 = 2.0*omega_y;
        const double x50 = omegadot_y*x49;
        const double x51 = 2.0*d_spin_angle;
        const double x52 = 2.0*omega_z;
        const double x53 = -x51 - x52;
        const double x54 = FMA(omegadot_z, x53, d2_spin_angle*x53);
        const double x55 = -x50 + x54;
        const double rate_M_xx = x55;
        const double x56 = FMA(omega_y, omegadot_x, omega_x*omegadot_y);
        const double x57 = -d_omegadot_z + x56;
        const double rate_M_xy = x57;
        const double x58 = omega_x*omegadot_z;
        const double x59 = FMA(omega_z, omegadot_x, d_omegadot_y + x58);
        const double rate_M_xz = x59;
        const double V2__rate_cos_phi_true = x39;
        const double V2__rate_sin_phi_true = x40;
        const double rate_cos_psi = FMA(-V2__rate_sin_phi_true, sin_j, V2__rate_cos_phi_true*cos_j);
        const double rate_sin_psi = FMA(V2__rate_sin_phi_true, cos_j, V2__rate_cos_phi_true*sin_j);
        const double rate_b_r_x = FMA(-b_disc_r_y, rate_sin_psi, b_disc_r_x*rate_cos_psi);
        const double rate_b_r_y = FMA(b_disc_r_y, rate_cos_psi, b_disc_r_x*rate_sin_psi);
        const double rate_b_f_x = FMA(b_r_y, rate_M_xy, FMA(b_r_x, rate_M_xx, FMA(b_disc_r_z, rate_M_xz, FMA(M_xy, rate_b_r_y, FMA(M_xx, rate_b_r_x, d_a_x)))));
        const double x60 = d_omegadot_z + x56;
        const double rate_M_yx = x60;
        const double x61 = 2.0*omegadot_x;
        const double x62 = omega_x*x61;
        const double x63 = x54 - x62;
        const double rate_M_yy = x63;
        const double x64 = omega_y*omegadot_z;
        const double x65 = FMA(omega_z, omegadot_y, -d_omegadot_x + x64);
        const double rate_M_yz = x65;
        const double rate_b_f_y = FMA(b_r_y, rate_M_yy, FMA(b_r_x, rate_M_yx, FMA(b_disc_r_z, rate_M_yz, FMA(M_yy, rate_b_r_y, FMA(M_yx, rate_b_r_x, d_a_y)))));
        const double x66 = 2.0*d2_spin_angle;
        const double x67 = omega_z + x51;
        const double x68 = FMA(omegadot_x, x67, FMA(omega_x, x66, -d_omegadot_y + x58));
        const double rate_M_zx = x68;
        const double x69 = FMA(omegadot_y, x67, FMA(omega_y, x66, d_omegadot_x + x64));
        const double rate_M_zy = x69;
        const double x70 = -x50 - x62;
        const double rate_M_zz = x70;
        const double rate_b_f_z = FMA(b_r_y, rate_M_zy, FMA(b_r_x, rate_M_zx, FMA(b_disc_r_z, rate_M_zz, FMA(M_zy, rate_b_r_y, FMA(M_zx, rate_b_r_x, d_a_z)))));
        const double rate_b_tau_yx = FMA(-beta_z, rate_sin_psi, rate_cos_psi);
        const double rate_b_tau_yy = FMA(beta_z, rate_cos_psi, rate_sin_psi);
        const double rate_b_f_yj = FMA(-beta_x, rate_b_f_z, FMA(b_tau_yy, rate_b_f_y, FMA(b_tau_yx, rate_b_f_x, FMA(b_f_y, rate_b_tau_yy, b_f_x*rate_b_tau_yx))));
        const double rate_b_tau_zx = FMA(-beta_x, rate_cos_psi, -b_disc_tau_zy*rate_sin_psi);
        const double rate_b_tau_zy = FMA(-beta_x, rate_sin_psi, b_disc_tau_zy*rate_cos_psi);
        const double rate_b_f_zj = FMA(b_tau_zy, rate_b_f_y, FMA(b_tau_zx, rate_b_f_x, FMA(b_f_y, rate_b_tau_zy, FMA(b_f_x, rate_b_tau_zx, -rate_b_f_z))));
        const double rate_V2__rate_cos_phi_true = x44;
        const double rate_V2__rate_sin_phi_true = x47;
        const double x71 = 2.0*(omegadot_y*omegadot_y);
        const double x72 = d_omegadot_y*x49;
        const double x73 = 2.0*omegadot_z;
        const double x74 = -x66 - x73;
        const double x75 = FMA(omegadot_z, x74, FMA(d_omegadot_z, x53, d2_spin_angle*x74));
        const double x76 = -x71 - x72 + x75;
        const double rate_rate_M_xx = x76;
        const double x77 = FMA(omegadot_y, x61, FMA(d_omegadot_y, omega_x, d_omegadot_x*omega_y));
        const double x78 = -d2_omegadot_z + x77;
        const double rate_rate_M_xy = x78;
        const double x79 = d_omegadot_z*omega_x;
        const double x80 = FMA(omegadot_x, x73, FMA(d_omegadot_x, omega_z, d2_omegadot_y + x79));
        const double rate_rate_M_xz = x80;
        const double rate_rate_cos_psi = FMA(-rate_V2__rate_sin_phi_true, sin_j, cos_j*rate_V2__rate_cos_phi_true);
        const double rate_rate_sin_psi = FMA(rate_V2__rate_cos_phi_true, sin_j, cos_j*rate_V2__rate_sin_phi_true);
        const double rate_rate_b_r_x = FMA(-b_disc_r_y, rate_rate_sin_psi, b_disc_r_x*rate_rate_cos_psi);
        const double rate_rate_b_r_y = FMA(b_disc_r_y, rate_rate_cos_psi, b_disc_r_x*rate_rate_sin_psi);
        const double x81 = 2.0*rate_b_r_x;
        const double x82 = 2.0*rate_b_r_y;
        const double rate_rate_b_f_x = FMA(rate_M_xy, x82, FMA(rate_M_xx, x81, FMA(b_r_y, rate_rate_M_xy, FMA(b_r_x, rate_rate_M_xx, FMA(b_disc_r_z, rate_rate_M_xz, FMA(M_xy, rate_rate_b_r_y, FMA(M_xx, rate_rate_b_r_x, d2_a_x)))))));
        const double x83 = d2_omegadot_z + x77;
        const double rate_rate_M_yx = x83;
        const double x84 = 2.0*(omegadot_x*omegadot_x);
        const double x85 = 2.0*omega_x;
        const double x86 = d_omegadot_x*x85;
        const double x87 = x75 - x84 - x86;
        const double rate_rate_M_yy = x87;
        const double x88 = d_omegadot_z*omega_y;
        const double x89 = FMA(omegadot_y, x73, FMA(d_omegadot_y, omega_z, -d2_omegadot_x + x88));
        const double rate_rate_M_yz = x89;
        const double rate_rate_b_f_y = FMA(rate_M_yy, x82, FMA(rate_M_yx, x81, FMA(b_r_y, rate_rate_M_yy, FMA(b_r_x, rate_rate_M_yx, FMA(b_disc_r_z, rate_rate_M_yz, FMA(M_yy, rate_rate_b_r_y, FMA(M_yx, rate_rate_b_r_x, d2_a_y)))))));
        const double x90 = omegadot_z + x66;
        const double x91 = FMA(omegadot_x, x90, FMA(omegadot_x, x66, FMA(omegadot_x, omegadot_z, FMA(d_omegadot_x, x67, -d2_omegadot_y + x79))));
        const double rate_rate_M_zx = x91;
        const double x92 = FMA(omegadot_y, x90, FMA(omegadot_y, x66, FMA(omegadot_y, omegadot_z, FMA(d_omegadot_y, x67, d2_omegadot_x + x88))));
        const double rate_rate_M_zy = x92;
        const double x93 = -x71 - x72 - x84 - x86;
        const double rate_rate_M_zz = x93;
        const double rate_rate_b_f_z = FMA(rate_M_zy, x82, FMA(rate_M_zx, x81, FMA(b_r_y, rate_rate_M_zy, FMA(b_r_x, rate_rate_M_zx, FMA(b_disc_r_z, rate_rate_M_zz, FMA(M_zy, rate_rate_b_r_y, FMA(M_zx, rate_rate_b_r_x, d2_a_z)))))));
        const double rate_rate_b_tau_yx = FMA(-beta_z, rate_rate_sin_psi, rate_rate_cos_psi);
        const double rate_rate_b_tau_yy = FMA(beta_z, rate_rate_cos_psi, rate_rate_sin_psi);
        const double x94 = 2.0*rate_b_f_x;
        const double x95 = 2.0*rate_b_f_y;
        const double rate_rate_b_f_yj = FMA(rate_b_tau_yy, x95, FMA(rate_b_tau_yx, x94, FMA(-beta_x, rate_rate_b_f_z, FMA(b_tau_yy, rate_rate_b_f_y, FMA(b_tau_yx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_yy, b_f_x*rate_rate_b_tau_yx))))));
        const double rate_rate_b_tau_zx = FMA(-beta_x, rate_rate_cos_psi, -b_disc_tau_zy*rate_rate_sin_psi);
        const double rate_rate_b_tau_zy = FMA(-beta_x, rate_rate_sin_psi, b_disc_tau_zy*rate_rate_cos_psi);
        const double rate_rate_b_f_zj = FMA(rate_b_tau_zy, x95, FMA(rate_b_tau_zx, x94, FMA(b_tau_zy, rate_rate_b_f_y, FMA(b_tau_zx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_zy, FMA(b_f_x, rate_rate_b_tau_zx, -rate_rate_b_f_z))))));
        const double f_f_x = FMA(M_xz, f_disc_r_z, FMA(M_xy, f_r_y, FMA(M_xx, f_r_x, a_x)));
        const double f_f_y = FMA(M_yz, f_disc_r_z, FMA(M_yy, f_r_y, FMA(M_yx, f_r_x, a_y)));
        const double f_f_z = FMA(M_zz, f_disc_r_z, FMA(M_zy, f_r_y, FMA(M_zx, f_r_x, a_z)));
        const double f_f_xj = FMA(f_f_y, f_tau_xy, f_f_x*f_tau_xx);
        const double f_f_yj = FMA(f_f_y, f_tau_yy, FMA(-beta_x, f_f_z, f_f_x*f_tau_yx));
        const double f_f_zj = FMA(f_f_y, f_tau_zy, FMA(f_f_x, f_tau_zx, -f_f_z));
        const double f_f_i = FMA(-f_f_zj, vartheta_y, FMA(f_f_yj, vartheta_z, f_f_xj));
        const double f_f_o = FMA(f_f_zj, vartheta_x, FMA(-f_f_xj, vartheta_z, f_f_yj));
        const double f_f_p = FMA(-f_f_yj, vartheta_x, FMA(f_f_xj, vartheta_y, f_f_zj));
        const double q_disc_r_x = x29;
        const double q_r_x = cos_psi*q_disc_r_x;
        const double q_r_y = q_disc_r_x*sin_psi;
        const double q_arm_x = q_r_x*x48;
        const double q_arm_y = q_r_y*x48;
        const double q_f_x = FMA(M_xy, q_r_y, FMA(M_xx, q_r_x, a_x));
        const double q_f_y = FMA(M_yy, q_r_y, FMA(M_yx, q_r_x, a_y));
        const double q_f_z = FMA(M_zy, q_r_y, FMA(M_zx, q_r_x, a_z));
        const double q_f_xj = FMA(-q_f_x, sin_psi, cos_psi*q_f_y);
        const double q_f_yj = FMA(q_f_y, sin_psi, cos_psi*q_f_x);
        const double x96 = K6*q_f_yj;
        const double x97 = (q_f_xj*q_f_xj);
        const double x98 = K4*q_f_z;
        const double x99 = K8*q_f_z;
        const double i_sensed = FMA(-q_f_yj, x99, FMA(-q_f_xj, x98, FMA(q_f_xj, x96, FMA(K7, q_f_z*q_f_z, FMA(K5, q_f_yj*q_f_yj, FMA(K2, x97, K0 + f_f_i))))));
        const double V2__rate_M_xx = x55;
        const double V2__rate_M_xy = x57;
        const double V2__rate_M_xz = x59;
        const double V2__rate_cos_psi = FMA(-rate_sin_phi_true, sin_j, cos_j*rate_cos_phi_true);
        const double V2__rate_sin_psi = FMA(rate_cos_phi_true, sin_j, cos_j*rate_sin_phi_true);
        const double rate_f_r_x = FMA(-V2__rate_sin_psi, f_disc_r_y, V2__rate_cos_psi*f_disc_r_x);
        const double rate_f_r_y = FMA(V2__rate_sin_psi, f_disc_r_x, V2__rate_cos_psi*f_disc_r_y);
        const double rate_f_f_x = FMA(V2__rate_M_xz, f_disc_r_z, FMA(V2__rate_M_xy, f_r_y, FMA(V2__rate_M_xx, f_r_x, FMA(M_xy, rate_f_r_y, FMA(M_xx, rate_f_r_x, d_a_x)))));
        const double V2__rate_M_yx = x60;
        const double V2__rate_M_yy = x63;
        const double V2__rate_M_yz = x65;
        const double rate_f_f_y = FMA(V2__rate_M_yz, f_disc_r_z, FMA(V2__rate_M_yy, f_r_y, FMA(V2__rate_M_yx, f_r_x, FMA(M_yy, rate_f_r_y, FMA(M_yx, rate_f_r_x, d_a_y)))));
        const double x100 = FMA(V2__rate_cos_psi, beta_z, V2__rate_sin_psi);
        const double rate_f_tau_xx = -x100;
        const double x101 = FMA(-V2__rate_sin_psi, beta_z, V2__rate_cos_psi);
        const double rate_f_tau_xy = x101;
        const double rate_f_f_xj = FMA(f_tau_xy, rate_f_f_y, FMA(f_tau_xx, rate_f_f_x, FMA(f_f_y, rate_f_tau_xy, f_f_x*rate_f_tau_xx)));
        const double V2__rate_M_zx = x68;
        const double V2__rate_M_zy = x69;
        const double V2__rate_M_zz = x70;
        const double rate_f_f_z = FMA(V2__rate_M_zz, f_disc_r_z, FMA(V2__rate_M_zy, f_r_y, FMA(V2__rate_M_zx, f_r_x, FMA(M_zy, rate_f_r_y, FMA(M_zx, rate_f_r_x, d_a_z)))));
        const double rate_f_tau_yx = x101;
        const double rate_f_tau_yy = x100;
        const double rate_f_f_yj = FMA(f_tau_yy, rate_f_f_y, FMA(f_tau_yx, rate_f_f_x, FMA(f_f_y, rate_f_tau_yy, FMA(-beta_x, rate_f_f_z, f_f_x*rate_f_tau_yx))));
        const double rate_f_tau_zx = FMA(-V2__rate_sin_psi, f_disc_tau_zy, -V2__rate_cos_psi*beta_x);
        const double rate_f_tau_zy = FMA(-V2__rate_sin_psi, beta_x, V2__rate_cos_psi*f_disc_tau_zy);
        const double rate_f_f_zj = FMA(f_tau_zy, rate_f_f_y, FMA(f_tau_zx, rate_f_f_x, FMA(f_f_y, rate_f_tau_zy, FMA(f_f_x, rate_f_tau_zx, -rate_f_f_z))));
        const double rate_f_f_i = FMA(-rate_f_f_zj, vartheta_y, FMA(rate_f_f_yj, vartheta_z, rate_f_f_xj));
        const double rate_V2__rate_M_xx = x76;
        const double rate_V2__rate_M_xy = x78;
        const double rate_V2__rate_M_xz = x80;
        const double rate_V2__rate_cos_psi = FMA(-rate_rate_sin_phi_true, sin_j, cos_j*rate_rate_cos_phi_true);
        const double rate_V2__rate_sin_psi = FMA(rate_rate_cos_phi_true, sin_j, cos_j*rate_rate_sin_phi_true);
        const double rate_rate_f_r_x = FMA(-f_disc_r_y, rate_V2__rate_sin_psi, f_disc_r_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_r_y = FMA(f_disc_r_y, rate_V2__rate_cos_psi, f_disc_r_x*rate_V2__rate_sin_psi);
        const double x102 = 2.0*rate_f_r_x;
        const double x103 = 2.0*rate_f_r_y;
        const double rate_rate_f_f_x = FMA(f_r_y, rate_V2__rate_M_xy, FMA(f_r_x, rate_V2__rate_M_xx, FMA(f_disc_r_z, rate_V2__rate_M_xz, FMA(V2__rate_M_xy, x103, FMA(V2__rate_M_xx, x102, FMA(M_xy, rate_rate_f_r_y, FMA(M_xx, rate_rate_f_r_x, d2_a_x)))))));
        const double rate_V2__rate_M_yx = x83;
        const double rate_V2__rate_M_yy = x87;
        const double rate_V2__rate_M_yz = x89;
        const double rate_rate_f_f_y = FMA(f_r_y, rate_V2__rate_M_yy, FMA(f_r_x, rate_V2__rate_M_yx, FMA(f_disc_r_z, rate_V2__rate_M_yz, FMA(V2__rate_M_yy, x103, FMA(V2__rate_M_yx, x102, FMA(M_yy, rate_rate_f_r_y, FMA(M_yx, rate_rate_f_r_x, d2_a_y)))))));
        const double x104 = FMA(beta_z, rate_V2__rate_cos_psi, rate_V2__rate_sin_psi);
        const double rate_rate_f_tau_xx = -x104;
        const double x105 = FMA(-beta_z, rate_V2__rate_sin_psi, rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_xy = x105;
        const double x106 = 2.0*rate_f_f_x;
        const double x107 = 2.0*rate_f_f_y;
        const double rate_rate_f_f_xj = FMA(rate_f_tau_xy, x107, FMA(rate_f_tau_xx, x106, FMA(f_tau_xy, rate_rate_f_f_y, FMA(f_tau_xx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_xy, f_f_x*rate_rate_f_tau_xx)))));
        const double rate_V2__rate_M_zx = x91;
        const double rate_V2__rate_M_zy = x92;
        const double rate_V2__rate_M_zz = x93;
        const double rate_rate_f_f_z = FMA(f_r_y, rate_V2__rate_M_zy, FMA(f_r_x, rate_V2__rate_M_zx, FMA(f_disc_r_z, rate_V2__rate_M_zz, FMA(V2__rate_M_zy, x103, FMA(V2__rate_M_zx, x102, FMA(M_zy, rate_rate_f_r_y, FMA(M_zx, rate_rate_f_r_x, d2_a_z)))))));
        const double rate_rate_f_tau_yx = x105;
        const double rate_rate_f_tau_yy = x104;
        const double rate_rate_f_f_yj = FMA(rate_f_tau_yy, x107, FMA(rate_f_tau_yx, x106, FMA(f_tau_yy, rate_rate_f_f_y, FMA(f_tau_yx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_yy, FMA(-beta_x, rate_rate_f_f_z, f_f_x*rate_rate_f_tau_yx))))));
        const double rate_rate_f_tau_zx = FMA(-f_disc_tau_zy, rate_V2__rate_sin_psi, -beta_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_zy = FMA(-beta_x, rate_V2__rate_sin_psi, f_disc_tau_zy*rate_V2__rate_cos_psi);
        const double rate_rate_f_f_zj = FMA(rate_f_tau_zy, x107, FMA(rate_f_tau_zx, x106, FMA(f_tau_zy, rate_rate_f_f_y, FMA(f_tau_zx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_zy, FMA(f_f_x, rate_rate_f_tau_zx, -rate_rate_f_f_z))))));
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
        const double x108 = 2.0*rate_q_r_x;
        const double x109 = 2.0*rate_q_r_y;
        const double rate_rate_q_f_x = FMA(q_r_y, rate_V2__rate_M_xy, FMA(q_r_x, rate_V2__rate_M_xx, FMA(V2__rate_M_xy, x109, FMA(V2__rate_M_xx, x108, FMA(M_xy, rate_rate_q_r_y, FMA(M_xx, rate_rate_q_r_x, d2_a_x))))));
        const double rate_rate_q_f_y = FMA(q_r_y, rate_V2__rate_M_yy, FMA(q_r_x, rate_V2__rate_M_yx, FMA(V2__rate_M_yy, x109, FMA(V2__rate_M_yx, x108, FMA(M_yy, rate_rate_q_r_y, FMA(M_yx, rate_rate_q_r_x, d2_a_y))))));
        const double x110 = 2.0*rate_q_f_y;
        const double x111 = 2.0*rate_q_f_x;
        const double rate_rate_q_f_xj = FMA(-rate_rate_q_f_x, sin_psi, FMA(q_f_y, rate_V2__rate_cos_psi, FMA(-q_f_x, rate_V2__rate_sin_psi, FMA(cos_psi, rate_rate_q_f_y, FMA(-V2__rate_sin_psi, x111, V2__rate_cos_psi*x110)))));
        const double rate_rate_q_f_yj = FMA(rate_rate_q_f_y, sin_psi, FMA(q_f_y, rate_V2__rate_sin_psi, FMA(q_f_x, rate_V2__rate_cos_psi, FMA(cos_psi, rate_rate_q_f_x, FMA(V2__rate_sin_psi, x110, V2__rate_cos_psi*x111)))));
        const double rate_rate_q_f_z = FMA(q_r_y, rate_V2__rate_M_zy, FMA(q_r_x, rate_V2__rate_M_zx, FMA(V2__rate_M_zy, x109, FMA(V2__rate_M_zx, x108, FMA(M_zy, rate_rate_q_r_y, FMA(M_zx, rate_rate_q_r_x, d2_a_z))))));
        const double x112 = 2.0*K2;
        const double x113 = 2.0*K5;
        const double x114 = 2.0*K7;
        const double x115 = FMA(q_f_xj, x112, x96 - x98);
        const double x116 = FMA(q_f_yj, x113, FMA(K6, q_f_xj, -x99));
        const double x117 = FMA(-q_f_z, x114, FMA(K8, q_f_yj, K4*q_f_xj));
        const double rate_rate_i_sensed = FMA(-rate_rate_q_f_z, x117, FMA(rate_rate_q_f_yj, x116, FMA(rate_rate_q_f_xj, x115, FMA(-rate_q_f_z, FMA(-rate_q_f_z, x114, FMA(K8, rate_q_f_yj, K4*rate_q_f_xj)), FMA(rate_q_f_yj, FMA(rate_q_f_yj, x113, FMA(-K8, rate_q_f_z, K6*rate_q_f_xj)), FMA(rate_q_f_xj, FMA(rate_q_f_xj, x112, FMA(-K4, rate_q_f_z, K6*rate_q_f_yj)), rate_rate_f_f_i))))));
        const double x118 = FMA(-f_tau_zx, vartheta_y, FMA(f_tau_yx, vartheta_z, f_tau_xx));
        const double vibration_axis_ix = x118;
        const double x119 = FMA(-f_tau_zy, vartheta_y, FMA(f_tau_yy, vartheta_z, f_tau_xy));
        const double vibration_axis_iy = x119;
        const double x120 = FMA(-beta_x, vartheta_z, vartheta_y);
        const double vibration_axis_iz = x120;
        const double vibration_axis_ox = FMA(f_tau_zx, vartheta_x, FMA(-f_tau_xx, vartheta_z, f_tau_yx));
        const double vibration_axis_oy = FMA(f_tau_zy, vartheta_x, FMA(-f_tau_xy, vartheta_z, f_tau_yy));
        const double vibration_axis_oz = -beta_x - vartheta_x;
        const double vibration_axis_px = FMA(-f_tau_yx, vartheta_x, FMA(f_tau_xx, vartheta_y, f_tau_zx));
        const double vibration_axis_py = FMA(-f_tau_yy, vartheta_x, FMA(f_tau_xy, vartheta_y, f_tau_zy));
        const double vibration_axis_pz = FMA(beta_x, vartheta_x, -(1.0));
        const double bar_i_vibration_rectification = K1*k_VI;
        const double bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x117;
        const double bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x116;
        const double bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x115;
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
        const double x121 = 2.0*x11;
        const double bar_rate_dR_arm_stretch = FMA(-bar_q_p_second_order_misalignment, FMA(-q_arm_x, x49, q_arm_y*x85), FMA(bar_q_f_y, q_arm_x*x121, FMA(-bar_q_f_x, q_arm_y*x121, FMA(bar_f_f_z, FMA(-f_arm_x, x49, 2.0*f_arm_y*omega_x), FMA(bar_f_f_y, FMA(-f_arm_z, x85, f_arm_x*x121), bar_f_f_x*FMA(-f_arm_y, x121, 2.0*f_arm_z*omega_y))))));
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
        const double bar_K2_thermal_second_order = bar_i_vibration_rectification*x97;
        const double bar_K1_thermal_scale = i_sensed*k_VI;
        const double bar_vartheta_y_thermal_misalignment = -bar_i_vibration_rectification*f_f_zj;
        const double bar_vartheta_z_mount_hysteresis = bar_i_vibration_rectification*f_f_yj;
        const double bar_dR_arm_stretch = FMA(bar_f_spin_axis_wobble_r_z, beta_x, FMA(bar_f_disc_r_y, beta_z, bar_f_disc_r_x + bar_q_disc_r_x));
        const double x122 = bar_f_f_z - bar_q_p_second_order_misalignment;
        const double bar_rate_rate_run_out_z = x122;
        const double x123 = bar_f_f_y + bar_q_f_y;
        const double bar_rate_rate_run_out_y = x123;
        const double x124 = bar_f_f_x + bar_q_f_x;
        const double bar_rate_rate_run_out_x = x124;
        const double bar_rate_run_out_z = FMA(-bar_q_f_y, x85, FMA(bar_q_f_x, x49, FMA(-bar_f_f_y, x85, bar_f_f_x*x49)));
        const double bar_rate_run_out_y = FMA(-bar_q_p_second_order_misalignment, x85, FMA(-bar_q_f_x, x52, FMA(-bar_f_f_x, x52, 2.0*bar_f_f_z*omega_x)));
        const double bar_rate_run_out_x = FMA(bar_q_p_second_order_misalignment, x49, FMA(bar_q_f_y, x52, FMA(-bar_f_f_z, x49, bar_f_f_y*x52)));
        const double x125 = omega_x*omega_z;
        const double x126 = omegadot_y + x125;
        const double x127 = -Gamma_xz + x126;
        const double x128 = omega_y*omega_z;
        const double x129 = -Gamma_yz - omegadot_x + x128;
        const double bar_run_out_z = FMA(-bar_q_p_second_order_misalignment, x28, FMA(bar_q_f_y, x129, FMA(bar_q_f_x, x127, FMA(bar_f_f_z, x28, FMA(bar_f_f_y, x129, bar_f_f_x*x127)))));
        const double x130 = omegadot_x + x128;
        const double x131 = -Gamma_yz + x130;
        const double x132 = -omegadot_z - x16;
        const double x133 = (omega_z*omega_z);
        const double x134 = x133 + x22;
        const double x135 = -Gamma_yy - x134;
        const double bar_run_out_y = FMA(-bar_q_p_second_order_misalignment, x131, FMA(bar_q_f_y, x135, FMA(bar_q_f_x, x132, FMA(bar_f_f_z, x131, FMA(bar_f_f_y, x135, bar_f_f_x*x132)))));
        const double x136 = x125 - x25;
        const double x137 = x10 + x133;
        const double x138 = -Gamma_xx - x137;
        const double bar_run_out_x = FMA(-bar_q_p_second_order_misalignment, x136, FMA(bar_q_f_y, x21, FMA(bar_q_f_x, x138, FMA(bar_f_f_z, x136, FMA(bar_f_f_y, x21, bar_f_f_x*x138)))));
        const double bar_wobble_zy = FMA(bar_q_spin_axis_wobble_tau_yz, sin_psi, FMA(bar_q_spin_axis_wobble_tau_xz, cos_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_y, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zy, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yy, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xy, bar_f_spin_axis_wobble_r_z*f_r_y))))));
        const double bar_wobble_zx = FMA(bar_q_spin_axis_wobble_tau_yz, cos_psi, FMA(-bar_q_spin_axis_wobble_tau_xz, sin_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_x, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zx, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yx, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xx, bar_f_spin_axis_wobble_r_z*f_r_x))))));
        const double bar_wobble_yz = FMA(-bar_q_p_second_order_misalignment, q_f_y, FMA(-bar_f_spin_axis_wobble_tau_yy, beta_x, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zy)));
        const double bar_wobble_xz = FMA(-bar_q_p_second_order_misalignment, q_f_x, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_x, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zx)));
        const double bar_sin_psi = FMA(bar_q_spin_axis_wobble_r_y, q_disc_r_x, FMA(-bar_f_spin_axis_wobble_tau_zy, beta_x, FMA(-bar_f_spin_axis_wobble_tau_zx, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xy, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_x, FMA(-bar_f_spin_axis_wobble_r_x, f_disc_r_y, -bar_f_spin_axis_wobble_tau_xx + bar_f_spin_axis_wobble_tau_yy - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy)))))));
        const double bar_cos_psi = FMA(bar_q_spin_axis_wobble_r_x, q_disc_r_x, FMA(bar_f_spin_axis_wobble_tau_zy, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_zx, beta_x, FMA(bar_f_spin_axis_wobble_tau_yy, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xx, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_y, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_x, bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx)))))));
        const double x139 = bar_f_f_z*f_disc_r_z;
        const double bar_M_zz = x139;
        const double x140 = bar_f_f_z*f_r_y;
        const double x141 = bar_q_p_second_order_misalignment*q_r_y;
        const double bar_M_zy = x140 - x141;
        const double x142 = bar_q_p_second_order_misalignment*q_r_x;
        const double bar_M_zx = FMA(bar_f_f_z, f_r_x, -x142);
        const double x143 = bar_f_f_y*f_disc_r_z;
        const double bar_M_yz = x143;
        const double x144 = bar_f_f_y*f_r_y;
        const double x145 = bar_q_f_y*q_r_y;
        const double bar_M_yy = x144 + x145;
        const double x146 = bar_q_f_y*q_r_x;
        const double bar_M_yx = FMA(bar_f_f_y, f_r_x, x146);
        const double x147 = bar_f_f_x*f_disc_r_z;
        const double bar_M_xz = x147;
        const double x148 = bar_f_f_x*f_r_y;
        const double x149 = bar_q_f_x*q_r_y;
        const double bar_M_xy = x148 + x149;
        const double x150 = bar_q_f_x*q_r_x;
        const double bar_M_xx = FMA(bar_f_f_x, f_r_x, x150);
        const double x151 = -bar_M_xy + bar_M_yx;
        const double bar_spin_acceleration_true = x151;
        const double x152 = bar_M_zx*omega_x;
        const double x153 = bar_M_zy*omega_y;
        const double x154 = FMA(bar_M_yy, x53, bar_M_xx*x53);
        const double bar_spin_rate_true = FMA(2.0, x153, FMA(2.0, x152, x154));
        const double bar_sin_phi_true = FMA(-bar_cos_psi, sin_j, bar_sin_psi*cos_j);
        const double bar_cos_phi_true = FMA(bar_sin_psi, sin_j, bar_cos_psi*cos_j);
        const double bar_sin_delta_phi = FMA(-bar_cos_phi_true, sin_phi, bar_sin_phi_true*cos_phi);
        const double bar_time_offset_omegadot_z = x151;
        const double bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx;
        const double bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy;
        const double bar_time_offset_omega_z = FMA(bar_M_yz, omega_y, FMA(bar_M_xz, omega_x, x152 + x153 + x154));
        const double bar_time_offset_omega_y = FMA(-bar_M_zz, x49, FMA(bar_M_zy, x67, FMA(bar_M_yz, omega_z, FMA(bar_M_yx, omega_x, FMA(-bar_M_xx, x49, bar_M_xy*omega_x)))));
        const double bar_time_offset_omega_x = FMA(-bar_M_zz, x85, FMA(bar_M_zx, x67, FMA(-bar_M_yy, x85, FMA(bar_M_yx, omega_y, FMA(bar_M_xz, omega_z, bar_M_xy*omega_y)))));
        const double bar_time_offset_a_z = x122;
        const double bar_time_offset_a_y = x123;
        const double bar_time_offset_a_x = x124;
        const double bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy;
        const double bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx;
        const double bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx;
        const double x155 = a_y*bar_time_offset_a_z;
        const double x156 = bar_time_offset_omega_z*omega_y;
        const double x157 = bar_time_offset_omegadot_z*omegadot_y;
        const double x158 = x156 + x157;
        const double bar_imu_turn_zy = x155 + x158;
        const double x159 = a_x*bar_time_offset_a_z;
        const double x160 = FMA(bar_time_offset_omegadot_z, omegadot_x, bar_time_offset_omega_z*omega_x);
        const double x161 = x159 + x160;
        const double bar_imu_turn_zx = x161;
        const double x162 = a_z*bar_time_offset_a_y;
        const double x163 = FMA(bar_time_offset_omegadot_y, omegadot_z, bar_time_offset_omega_y*omega_z);
        const double x164 = x162 + x163;
        const double bar_imu_turn_yz = x164;
        const double x165 = a_x*bar_time_offset_a_y;
        const double x166 = FMA(bar_time_offset_omegadot_y, omegadot_x, bar_time_offset_omega_y*omega_x);
        const double bar_imu_turn_yx = x165 + x166;
        const double x167 = a_z*bar_time_offset_a_x;
        const double x168 = bar_time_offset_omega_x*omega_z;
        const double x169 = bar_time_offset_omegadot_x*omegadot_z;
        const double x170 = x168 + x169;
        const double bar_imu_turn_xz = x167 + x170;
        const double x171 = a_y*bar_time_offset_a_x;
        const double x172 = FMA(bar_time_offset_omegadot_x, omegadot_y, bar_time_offset_omega_x*omega_y);
        const double bar_imu_turn_xy = x171 + x172;
        const double x173 = (angular_vibration_rms*angular_vibration_rms);
        const double x174 = bar_M_yy*x173;
        const double x175 = bar_M_zz*x173;
        const double x176 = bar_M_xx*x173;
        const double x177 = K1*bar_K1_thermal_scale;
        const double x178 = bar_run_out_x*cos_phi;
        const double x179 = bar_run_out_y*cos_phi;
        const double x180 = bar_run_out_z*cos_phi;
        const double x181 = 2.0*cos_phi;
        const double x182 = 2.0*sin_phi;
        const double x183 = FMA(-rate_sin_phi_true, x182, rate_cos_phi_true*x181);
        const double x184 = (cos_phi*cos_phi);
        const double x185 = (sin_phi*sin_phi);
        const double x186 = x184 - x185;
        const double x187 = FMA(-2.0, rate_sin_phi_true*rate_sin_phi_true, FMA(-rate_rate_sin_phi_true, x182, FMA(rate_rate_cos_phi_true, x181, 2.0*rate_cos_phi_true*rate_cos_phi_true)));
        const double x188 = FMA(rate_sin_phi_true, x181, rate_cos_phi_true*x182);
        const double x189 = FMA(rate_rate_sin_phi_true, x181, FMA(rate_rate_cos_phi_true, x182, 4.0*rate_cos_phi_true*rate_sin_phi_true));
        const double x190 = (attitude_yx*attitude_yx);
        const double x191 = (attitude_yz*attitude_yz);
        const double x192 = attitude_xx*attitude_yx;
        const double x193 = attitude_xz*attitude_yz;
        const double x194 = -x193;
        const double x195 = attitude_xx*attitude_zx;
        const double x196 = attitude_xz*attitude_zz;
        const double x197 = -x196;
        const double x198 = attitude_yx*attitude_zx;
        const double x199 = attitude_yz*attitude_zz;
        const double x200 = -x199;
        const double x201 = (attitude_xz*attitude_xz);
        const double x202 = (attitude_xx*attitude_xx);
        const double x203 = (attitude_zx*attitude_zx);
        const double x204 = (attitude_zz*attitude_zz);
        const double x205 = (1.0) - x204;
        const double x206 = 2.0*bar_M_xx;
        const double x207 = attitude_xx*x206;
        const double x208 = 2.0*bar_M_yy;
        const double x209 = attitude_yx*x208;
        const double x210 = 2.0*attitude_zx;
        const double x211 = bar_M_zz*x210;
        const double x212 = attitude_xx*attitude_zy;
        const double x213 = attitude_xy*attitude_zx;
        const double x214 = attitude_yx*attitude_zy;
        const double x215 = attitude_yy*attitude_zx;
        const double x216 = attitude_xx*attitude_yy;
        const double x217 = attitude_xy*attitude_yx;
        const double x218 = attitude_xx*attitude_yz;
        const double x219 = attitude_xz*attitude_yx;
        const double x220 = attitude_yx*attitude_zz;
        const double x221 = attitude_yz*attitude_zx;
        const double x222 = attitude_xx*attitude_zz;
        const double x223 = attitude_xz*attitude_zx;
        const double x224 = (attitude_xy*attitude_xy);
        const double x225 = attitude_xy*attitude_yy;
        const double x226 = attitude_xy*attitude_zy;
        const double x227 = attitude_yy*attitude_zy;
        const double x228 = (attitude_yy*attitude_yy);
        const double x229 = (attitude_zy*attitude_zy);
        const double x230 = attitude_xy*attitude_xz;
        const double x231 = attitude_yy*attitude_yz;
        const double x232 = 2.0*attitude_zy*attitude_zz;
        const double x233 = attitude_xy*attitude_yz;
        const double x234 = attitude_xz*attitude_yy;
        const double x235 = attitude_xy*attitude_zz;
        const double x236 = attitude_xz*attitude_zy;
        const double x237 = attitude_yy*attitude_zz;
        const double x238 = attitude_yz*attitude_zy;
        const double x239 = -fuel_mass*x193;
        const double x240 = -fuel_mass*x196;
        const double x241 = -fuel_mass*x199;
        const double x242 = -fuel_mass*x201;
        const double x243 = -fuel_mass*x191;
        const double x244 = -fuel_mass*x204;
        const double x245 = bar_M_xx*fuel_mass;
        const double x246 = 2.0*x245;
        const double x247 = attitude_xx*x246;
        const double x248 = bar_M_yy*fuel_mass;
        const double x249 = 2.0*x248;
        const double x250 = attitude_yx*x249;
        const double x251 = bar_M_zz*fuel_mass;
        const double x252 = x210*x251;
        const double x253 = bar_time_offset_a_x*d_a_x;
        const double x254 = bar_time_offset_a_y*d_a_y;
        const double x255 = bar_time_offset_a_z*d_a_z;
        const double x256 = bar_time_offset_omega_x*omegadot_x;
        const double x257 = bar_time_offset_omega_y*omegadot_y;
        const double x258 = bar_time_offset_omega_z*omegadot_z;
        const double x259 = bar_time_offset_omegadot_x*d_omegadot_x;
        const double x260 = bar_time_offset_omegadot_y*d_omegadot_y;
        const double x261 = bar_time_offset_omegadot_z*d_omegadot_z;
        const double x262 = bar_i_vibration_rectification*(f_f_i*f_f_i);
        const double x263 = (f_f_o*f_f_o);
        const double x264 = bar_i_vibration_rectification*f_f_i;
        const double x265 = (f_f_p*f_f_p);
        const double x266 = bar_sin_delta_phi*cos_phi;
        const double x267 = bar_spin_rate_true*x38;
        const double x268 = 4.0*cos_phi;
        const double x269 = (cos_phi*cos_phi*cos_phi);
        const double x270 = (sin_phi*sin_phi*sin_phi);
        const double x271 = 9.0*x184;
        const double x272 = 9.0*x42;
        const double x273 = 3.0*x269;
        const double x274 = 9.0*x185;
        const double x275 = (cos_phi*cos_phi*cos_phi*cos_phi);
        const double x276 = (sin_phi*sin_phi*sin_phi*sin_phi);
        const double x277 = x184*x185;
        const double x278 = 16.0*x269;
        const double x279 = 16.0*x42;
        const double x280 = 4.0*d_spin_angle;
        const double x281 = 24.0*x277;
        const double x282 = 4.0*d2_spin_angle;
        const double x283 = -bar_M_zz*fuel_mass;
        const double x284 = -bar_M_zz;
        const double x285 = x256 + x257 + x258;
        const double x286 = x259 + x260 + x261;
        const double x287 = -x167;
        const double x288 = -x155;
        const double x289 = a_x*bar_time_offset_a_x;
        const double x290 = a_y*bar_time_offset_a_y;
        const double x291 = FMA(-293.15, (1.0), temperature);
        const double x292 = -x291;
        const double x293 = FMA(C__heat_tt, cos_j*cos_j, FMA(-2.0, C__heat_rt*cos_j*sin_j, C__heat_rr*sin_j*sin_j));
        const double x294 = bar_i_vibration_rectification*i_sensed;
        const double x295 = FMA(-C__play_radial, sin_j, C__play_tangential*cos_j);
        const double x296 = f_r_x*x139;
        const double x297 = 0.5*(q_r_x*q_r_x);
        const double x298 = 0.5*(f_disc_r_z*f_disc_r_z);
        const double x299 = (f_r_x*f_r_x);
        const double x300 = 0.5*x299;
        const double x301 = x298 - x300;
        const double x302 = f_r_x*x147;
        const double x303 = 0.5*(q_r_y*q_r_y);
        const double x304 = 0.5*(f_r_y*f_r_y);
        const double x305 = x298 - x304;
        const double x306 = f_r_x*x143;
        const double x307 = (1.0/6.0)*(q_r_x*q_r_x*q_r_x);
        const double x308 = f_r_x*x298;
        const double x309 = FMA(-1.0/6.0, f_r_x*f_r_x*f_r_x, x308);
        const double x310 = (f_disc_r_z*f_disc_r_z*f_disc_r_z);
        const double x311 = (1.0/6.0)*x310;
        const double x312 = FMA(-0.5, f_disc_r_z*x299, x311);
        const double x313 = f_r_y*x296;
        const double x314 = f_r_y*x298;
        const double x315 = FMA(-f_r_y, x300, x314);
        const double x316 = FMA(-f_r_x, x304, x308);
        const double x317 = f_disc_r_z*x304;
        const double x318 = (1.0/6.0)*(q_r_y*q_r_y*q_r_y);
        const double x319 = FMA(-1.0/6.0, f_r_y*f_r_y*f_r_y, x314);
        const double x320 = x311 - x317;
        const double x321 = bar_i_vibration_rectification*rate_rate_i_sensed;
        const double x322 = -bar_M_zz*x6;
        const double x323 = -bar_M_zz*x5;
        const double x324 = FMA(sin_yaw, sin_yaw, FMA(-cos_yaw, cos_yaw, (1.0)));
        const double x325 = -x324;
        const double x326 = cos_yaw*sin_yaw;
        const double x327 = cos_yaw - (1.0);
        const double x328 = -Gamma_zz;
        const double x329 = 2.0*Gamma_yz;
        const double x330 = 2.0*Gamma_xz;
        const double x331 = (vibration_rms*vibration_rms);
        const double x332 = K4*vibration_axis_ix;
        const double x333 = vibration_axis_px*x332;
        const double x334 = K6*vibration_axis_ix;
        const double x335 = vibration_axis_ox*x334;
        const double x336 = K8*vibration_axis_ox;
        const double x337 = vibration_axis_px*x336;
        const double x338 = K2*(vibration_axis_ix*vibration_axis_ix);
        const double x339 = K5*(vibration_axis_ox*vibration_axis_ox);
        const double x340 = K7*(vibration_axis_px*vibration_axis_px);
        const double x341 = vibration_axis_py*x332;
        const double x342 = K4*vibration_axis_px;
        const double x343 = vibration_axis_iy*x342;
        const double x344 = vibration_axis_oy*x334;
        const double x345 = K6*vibration_axis_ox;
        const double x346 = vibration_axis_iy*x345;
        const double x347 = vibration_axis_py*x336;
        const double x348 = K8*vibration_axis_px;
        const double x349 = vibration_axis_oy*x348;
        const double x350 = vibration_axis_ix*x112;
        const double x351 = vibration_axis_iy*x350;
        const double x352 = vibration_axis_ox*x113;
        const double x353 = vibration_axis_oy*x352;
        const double x354 = vibration_axis_px*x114;
        const double x355 = vibration_axis_py*x354;
        const double x356 = vibration_axis_pz*x332;
        const double x357 = vibration_axis_iz*x342;
        const double x358 = vibration_axis_oz*x334;
        const double x359 = vibration_axis_iz*x345;
        const double x360 = vibration_axis_pz*x336;
        const double x361 = vibration_axis_oz*x348;
        const double x362 = vibration_axis_iz*x350;
        const double x363 = vibration_axis_oz*x352;
        const double x364 = vibration_axis_pz*x354;
        const double x365 = K4*vibration_axis_iy;
        const double x366 = vibration_axis_py*x365;
        const double x367 = K6*vibration_axis_iy;
        const double x368 = vibration_axis_oy*x367;
        const double x369 = K8*vibration_axis_oy;
        const double x370 = vibration_axis_py*x369;
        const double x371 = K2*(vibration_axis_iy*vibration_axis_iy);
        const double x372 = K5*(vibration_axis_oy*vibration_axis_oy);
        const double x373 = K7*(vibration_axis_py*vibration_axis_py);
        const double x374 = vibration_axis_pz*x365;
        const double x375 = K4*vibration_axis_iz;
        const double x376 = vibration_axis_py*x375;
        const double x377 = vibration_axis_oz*x367;
        const double x378 = K6*vibration_axis_iz;
        const double x379 = vibration_axis_oy*x378;
        const double x380 = vibration_axis_pz*x369;
        const double x381 = K8*vibration_axis_oz;
        const double x382 = vibration_axis_py*x381;
        const double x383 = vibration_axis_iy*vibration_axis_iz*x112;
        const double x384 = vibration_axis_oy*vibration_axis_oz*x113;
        const double x385 = vibration_axis_py*vibration_axis_pz*x114;
        const double x386 = vibration_axis_pz*x375;
        const double x387 = vibration_axis_oz*x378;
        const double x388 = vibration_axis_pz*x381;
        const double x389 = K2*(vibration_axis_iz*vibration_axis_iz);
        const double x390 = K5*(vibration_axis_oz*vibration_axis_oz);
        const double x391 = K7*(vibration_axis_pz*vibration_axis_pz);

        rows[0][i] = bar_i_vibration_rectification*((double)((i_sensed) > 0.0) - (double)((i_sensed) < 0.0)); /* adc-nonlinearity.h */
        rows[1][i] = -x174 - x175; /* angular-jitter.W_xx */
        rows[2][i] = -bar_spin_axis_tilt_Gamma_xy*x173; /* angular-jitter.W_xy */
        rows[3][i] = -bar_spin_axis_tilt_Gamma_xz*x173; /* angular-jitter.W_xz */
        rows[4][i] = -x175 - x176; /* angular-jitter.W_yy */
        rows[5][i] = -bar_spin_axis_tilt_Gamma_yz*x173; /* angular-jitter.W_yz */
        rows[6][i] = -x174 - x176; /* angular-jitter.W_zz */
        rows[7][i] = bar_i_vibration_rectification*(FMA(f_tau_xy, omega_y, f_tau_xx*omega_x))*(FMA(f_tau_zy, omega_y, FMA(f_tau_zx, omega_x, -x11))); /* anisoinertia.K_ip */
        rows[8][i] = bar_dR_arm_stretch; /* arm-length.delta_R */
        rows[9][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_zj, FMA(bar_rate_dR_arm_stretch, rate_b_f_zj, b_f_zj*bar_dR_arm_stretch)); /* arm-sag.c_z */
        rows[10][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_yj, FMA(bar_rate_dR_arm_stretch, rate_b_f_yj, b_f_yj*bar_dR_arm_stretch)); /* arm-stretch.c_r */
        rows[11][i] = balance_current*x177; /* balancing-loop.dK1_di */
        rows[12][i] = bar_K2_thermal_second_order*second_order_current; /* balancing-loop.dK2_di */
        rows[13][i] = FMA(bar_rate_run_out_x, rate_cos_phi_true, FMA(bar_rate_rate_run_out_x, rate_rate_cos_phi_true, x178)); /* bearing-run-out.c_x1 */
        rows[14][i] = FMA(bar_run_out_x, sin_phi, FMA(bar_rate_run_out_x, rate_sin_phi_true, bar_rate_rate_run_out_x*rate_rate_sin_phi_true)); /* bearing-run-out.s_x1 */
        rows[15][i] = FMA(bar_rate_run_out_y, rate_cos_phi_true, FMA(bar_rate_rate_run_out_y, rate_rate_cos_phi_true, x179)); /* bearing-run-out.c_y1 */
        rows[16][i] = FMA(bar_run_out_y, sin_phi, FMA(bar_rate_run_out_y, rate_sin_phi_true, bar_rate_rate_run_out_y*rate_rate_sin_phi_true)); /* bearing-run-out.s_y1 */
        rows[17][i] = FMA(bar_rate_run_out_z, rate_cos_phi_true, FMA(bar_rate_rate_run_out_z, rate_rate_cos_phi_true, x180)); /* bearing-run-out.c_z1 */
        rows[18][i] = FMA(bar_run_out_z, sin_phi, FMA(bar_rate_run_out_z, rate_sin_phi_true, bar_rate_rate_run_out_z*rate_rate_sin_phi_true)); /* bearing-run-out.s_z1 */
        rows[19][i] = FMA(bar_run_out_x, x186, FMA(bar_rate_run_out_x, x183, bar_rate_rate_run_out_x*x187)); /* bearing-run-out.c_x2 */
        rows[20][i] = FMA(x178, x182, FMA(bar_rate_run_out_x, x188, bar_rate_rate_run_out_x*x189)); /* bearing-run-out.s_x2 */
        rows[21][i] = FMA(bar_run_out_y, x186, FMA(bar_rate_run_out_y, x183, bar_rate_rate_run_out_y*x187)); /* bearing-run-out.c_y2 */
        rows[22][i] = FMA(x179, x182, FMA(bar_rate_run_out_y, x188, bar_rate_rate_run_out_y*x189)); /* bearing-run-out.s_y2 */
        rows[23][i] = FMA(bar_run_out_z, x186, FMA(bar_rate_run_out_z, x183, bar_rate_rate_run_out_z*x187)); /* bearing-run-out.c_z2 */
        rows[24][i] = FMA(x180, x182, FMA(bar_rate_run_out_z, x188, bar_rate_rate_run_out_z*x189)); /* bearing-run-out.s_z2 */
        rows[25][i] = bar_i_vibration_rectification*time; /* bias-drift.dK0_dt */
        rows[26][i] = bar_i_vibration_rectification*(FMA(-C__slip_radial, sin_j, C__slip_tangential*cos_j)); /* bias-hysteresis.h_i */
        rows[27][i] = bar_i_vibration_rectification*(FMA(C__slip_tangential, sin_j, C__slip_radial*cos_j)); /* bias-hysteresis.h_o */
        rows[28][i] = -C__slip_axial*bar_i_vibration_rectification; /* bias-hysteresis.h_p */
        rows[29][i] = 0.0; /* bias-hysteresis.w */
        rows[30][i] = bar_i_vibration_rectification; /* bias-step.dK0 */
        rows[31][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x198 + x200), FMA(bar_spin_axis_tilt_Gamma_xz, (x195 + x197), FMA(-bar_M_zz, (x203 + x205), FMA(-bar_M_yy, (x190 - x191), FMA(-bar_M_xx, (-x201 + x202 - (1.0)), bar_spin_axis_tilt_Gamma_xy*(x192 + x194)))))); /* carrier-gradient.G_xx */
        rows[32][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x214 + x215), FMA(bar_spin_axis_tilt_Gamma_xz, (x212 + x213), FMA(-attitude_zy, x211, FMA(-attitude_yy, x209, FMA(-attitude_xy, x207, bar_spin_axis_tilt_Gamma_xy*(x216 + x217 - (1.0))))))); /* carrier-gradient.G_xy */
        rows[33][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x220 + x221), FMA(bar_spin_axis_tilt_Gamma_xz, (x222 + x223 - (1.0)), FMA(-attitude_zz, x211, FMA(-attitude_yz, x209, FMA(-attitude_xz, x207, bar_spin_axis_tilt_Gamma_xy*(x218 + x219)))))); /* carrier-gradient.G_xz */
        rows[34][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x200 + x227), FMA(bar_spin_axis_tilt_Gamma_xz, (x197 + x226), FMA(-bar_M_zz, (x205 + x229), FMA(-bar_M_yy, (-x191 + x228 - (1.0)), FMA(-bar_M_xx, (-x201 + x224), bar_spin_axis_tilt_Gamma_xy*(x194 + x225)))))); /* carrier-gradient.G_yy */
        rows[35][i] = FMA(-x208, x231, FMA(-x206, x230, FMA(bar_spin_axis_tilt_Gamma_yz, (x237 + x238 - (1.0)), FMA(bar_spin_axis_tilt_Gamma_xz, (x235 + x236), FMA(-bar_M_zz, x232, bar_spin_axis_tilt_Gamma_xy*(x233 + x234)))))); /* carrier-gradient.G_yz */
        rows[36][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x198, x241), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x195, x240), FMA(-bar_M_zz, FMA(fuel_mass, x203, x244), FMA(-bar_M_yy, FMA(fuel_mass, x190, x243), FMA(-bar_M_xx, FMA(fuel_mass, x202, x242), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x192, x239)))))); /* carrier-gradient.F_xx */
        rows[37][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x215, fuel_mass*x214), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x213, fuel_mass*x212), FMA(-attitude_zy, x252, FMA(-attitude_yy, x250, FMA(-attitude_xy, x247, bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x217, fuel_mass*x216)))))); /* carrier-gradient.F_xy */
        rows[38][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x221, fuel_mass*x220), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x223, fuel_mass*x222), FMA(-attitude_zz, x252, FMA(-attitude_yz, x250, FMA(-attitude_xz, x247, bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x219, fuel_mass*x218)))))); /* carrier-gradient.F_xz */
        rows[39][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x227, x241), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x226, x240), FMA(-bar_M_zz, FMA(fuel_mass, x229, x244), FMA(-bar_M_yy, FMA(fuel_mass, x228, x243), FMA(-bar_M_xx, FMA(fuel_mass, x224, x242), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x225, x239)))))); /* carrier-gradient.F_yy */
        rows[40][i] = FMA(-x232, x251, FMA(-x231, x249, FMA(-x230, x246, FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x238, fuel_mass*x237), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x236, fuel_mass*x235), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x234, fuel_mass*x233)))))); /* carrier-gradient.F_yz */
        rows[41][i] = FMA(time, x261, FMA(time, x260, FMA(time, x259, FMA(time, x258, FMA(time, x257, FMA(time, x256, FMA(time, x255, FMA(time, x254, time*x253)))))))); /* clock-drift.epsilon */
        rows[42][i] = f_f_o*x262; /* cubic-cross.K_iio */
        rows[43][i] = f_f_p*x262; /* cubic-cross.K_iip */
        rows[44][i] = x263*x264; /* cubic-cross.K_ioo */
        rows[45][i] = f_f_o*f_f_p*x264; /* cubic-cross.K_iop */
        rows[46][i] = x264*x265; /* cubic-cross.K_ipp */
        rows[47][i] = bar_i_vibration_rectification*(f_f_o*f_f_o*f_f_o); /* cubic-cross.K_ooo */
        rows[48][i] = bar_i_vibration_rectification*f_f_p*x263; /* cubic-cross.K_oop */
        rows[49][i] = bar_i_vibration_rectification*f_f_o*x265; /* cubic-cross.K_opp */
        rows[50][i] = bar_i_vibration_rectification*(f_f_p*f_f_p*f_f_p); /* cubic-cross.K_ppp */
        rows[51][i] = bar_i_vibration_rectification*(f_f_i*f_f_i*f_f_i); /* cubic-input.K_iii */
        rows[52][i] = FMA(bar_spin_acceleration_true, x44, x266 - x267); /* encoder-harmonic.c_1 */
        rows[53][i] = FMA(bar_spin_rate_true, x40, FMA(bar_spin_acceleration_true, x47, bar_sin_delta_phi*sin_phi)); /* encoder-harmonic.s_1 */
        rows[54][i] = FMA(-x267, x268, FMA(bar_spin_acceleration_true, FMA(-x268, x41, FMA(-4.0, x184*x42, 4.0*x185*x42)), bar_sin_delta_phi*x186)); /* encoder-harmonic.c_2 */
        rows[55][i] = FMA(x182, x266, FMA(bar_spin_rate_true, FMA(-x185, x51, x184*x51), bar_spin_acceleration_true*FMA(-x185, x66, FMA(-8.0, sin_phi*x43, 2.0*d2_spin_angle*x184)))); /* encoder-harmonic.s_2 */
        rows[56][i] = FMA(bar_spin_rate_true, FMA(-x271, x38, 3.0*d_spin_angle*x270), FMA(bar_spin_acceleration_true, FMA(-x271, x41, FMA(-x269, x272, FMA(3.0, d2_spin_angle*x270, 27.0*cos_phi*x185*x42))), bar_sin_delta_phi*FMA(-3.0, cos_phi*x185, x269))); /* encoder-harmonic.c_3 */
        rows[57][i] = FMA(bar_spin_rate_true, FMA(-x274, x40, d_spin_angle*x273), FMA(bar_spin_acceleration_true, FMA(-x274, x45, FMA(x270, x272, FMA(-27.0, x184*x46, d2_spin_angle*x273))), bar_sin_delta_phi*FMA(3.0, sin_phi*x184, -x270))); /* encoder-harmonic.s_3 */
        rows[58][i] = FMA(bar_spin_rate_true, FMA(-x278, x38, 16.0*cos_phi*d_spin_angle*x270), FMA(bar_spin_acceleration_true, FMA(-x278, x41, FMA(-x276, x279, FMA(-x275, x279, FMA(96.0, x184*x185*x42, 16.0*cos_phi*d2_spin_angle*x270)))), bar_sin_delta_phi*FMA(-6.0, x277, x275 + x276))); /* encoder-harmonic.c_4 */
        rows[59][i] = FMA(bar_spin_rate_true, FMA(x276, x280, FMA(-d_spin_angle, x281, x275*x280)), FMA(bar_spin_acceleration_true, FMA(x276, x282, FMA(x275, x282, FMA(-64.0, x269*x46, FMA(-d2_spin_angle, x281, 64.0*x270*x43)))), bar_sin_delta_phi*FMA(-x268, x270, 4.0*sin_phi*x269))); /* encoder-harmonic.s_4 */
        rows[60][i] = -x245 - x283; /* fuel-gradient.G_xx */
        rows[61][i] = bar_spin_axis_tilt_Gamma_xy*fuel_mass; /* fuel-gradient.G_xy */
        rows[62][i] = bar_spin_axis_tilt_Gamma_xz*fuel_mass; /* fuel-gradient.G_xz */
        rows[63][i] = -x248 - x283; /* fuel-gradient.G_yy */
        rows[64][i] = bar_spin_axis_tilt_Gamma_yz*fuel_mass; /* fuel-gradient.G_yz */
        rows[65][i] = time*x177; /* gain-drift.dK1_dt */
        rows[66][i] = x177; /* gain-step.dK1 */
        rows[67][i] = -bar_M_xx - x284; /* gradient-offset.G_xx */
        rows[68][i] = bar_spin_axis_tilt_Gamma_xy; /* gradient-offset.G_xy */
        rows[69][i] = bar_spin_axis_tilt_Gamma_xz; /* gradient-offset.G_xz */
        rows[70][i] = -bar_M_yy - x284; /* gradient-offset.G_yy */
        rows[71][i] = bar_spin_axis_tilt_Gamma_yz; /* gradient-offset.G_yz */
        rows[72][i] = -bar_time_offset_omega_x; /* gyro-bias.b_x */
        rows[73][i] = -bar_time_offset_omega_y; /* gyro-bias.b_y */
        rows[74][i] = -bar_time_offset_omega_z; /* gyro-bias.b_z */
        rows[75][i] = x285; /* gyro-delay.delta_w */
        rows[76][i] = x286; /* gyro-delay.delta_d */
        rows[77][i] = FMA(-bar_time_offset_omegadot_x, d_a_x, -a_x*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xx */
        rows[78][i] = FMA(-bar_time_offset_omegadot_x, d_a_y, -a_y*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xy */
        rows[79][i] = FMA(-bar_time_offset_omegadot_x, d_a_z, -a_z*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xz */
        rows[80][i] = FMA(-bar_time_offset_omegadot_y, d_a_x, -a_x*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yx */
        rows[81][i] = FMA(-bar_time_offset_omegadot_y, d_a_y, -a_y*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yy */
        rows[82][i] = FMA(-bar_time_offset_omegadot_y, d_a_z, -a_z*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yz */
        rows[83][i] = FMA(-bar_time_offset_omegadot_z, d_a_x, -a_x*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zx */
        rows[84][i] = FMA(-bar_time_offset_omegadot_z, d_a_y, -a_y*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zy */
        rows[85][i] = FMA(-bar_time_offset_omegadot_z, d_a_z, -a_z*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zz */
        rows[86][i] = -x172; /* gyro-misalignment.m_xy */
        rows[87][i] = -x170; /* gyro-misalignment.m_xz */
        rows[88][i] = -x166; /* gyro-misalignment.m_yx */
        rows[89][i] = -x163; /* gyro-misalignment.m_yz */
        rows[90][i] = -x160; /* gyro-misalignment.m_zx */
        rows[91][i] = -x158; /* gyro-misalignment.m_zy */
        rows[92][i] = FMA(-bar_time_offset_omegadot_x, omegadot_x, -bar_time_offset_omega_x*omega_x); /* gyro-scale.s_x */
        rows[93][i] = FMA(-bar_time_offset_omegadot_y, omegadot_y, -bar_time_offset_omega_y*omega_y); /* gyro-scale.s_y */
        rows[94][i] = FMA(-bar_time_offset_omegadot_z, omegadot_z, -bar_time_offset_omega_z*omega_z); /* gyro-scale.s_z */
        rows[95][i] = -bar_time_offset_a_x; /* imu-acceleration-bias.b_x */
        rows[96][i] = -bar_time_offset_a_y; /* imu-acceleration-bias.b_y */
        rows[97][i] = -bar_time_offset_a_z; /* imu-acceleration-bias.b_z */
        rows[98][i] = -x171; /* imu-acceleration-misalignment.m_xy */
        rows[99][i] = x287; /* imu-acceleration-misalignment.m_xz */
        rows[100][i] = -x165; /* imu-acceleration-misalignment.m_yx */
        rows[101][i] = -x162; /* imu-acceleration-misalignment.m_yz */
        rows[102][i] = -x159; /* imu-acceleration-misalignment.m_zx */
        rows[103][i] = x288; /* imu-acceleration-misalignment.m_zy */
        rows[104][i] = -(a_x*a_x)*bar_time_offset_a_x; /* imu-acceleration-quadratic.q_x */
        rows[105][i] = -(a_y*a_y)*bar_time_offset_a_y; /* imu-acceleration-quadratic.q_y */
        rows[106][i] = -x289; /* imu-acceleration-scale.s_x */
        rows[107][i] = -x290; /* imu-acceleration-scale.s_y */
        rows[108][i] = -a_z*bar_time_offset_a_z; /* imu-acceleration-scale.s_z */
        rows[109][i] = FMA(-bar_time_offset_a_z, d2_a_z, FMA(-bar_time_offset_a_y, d2_a_y, -bar_time_offset_a_x*d2_a_x)); /* imu-filter.b_a */
        rows[110][i] = FMA(-bar_time_offset_omegadot_z, d2_omegadot_z, FMA(-bar_time_offset_omegadot_y, d2_omegadot_y, FMA(-bar_time_offset_omegadot_x, d2_omegadot_x, FMA(-bar_time_offset_omega_z, d_omegadot_z, FMA(-bar_time_offset_omega_y, d_omegadot_y, -bar_time_offset_omega_x*d_omegadot_x))))); /* imu-filter.b_w */
        rows[111][i] = FMA(bar_time_offset_a_z, (-x125 - x17), FMA(-bar_time_offset_a_y, x20, bar_time_offset_a_x*x137)); /* imu-lever-arm.l_x */
        rows[112][i] = FMA(-bar_time_offset_a_z, x130, FMA(bar_time_offset_a_y, x134, bar_time_offset_a_x*(omegadot_z - x15))); /* imu-lever-arm.l_y */
        rows[113][i] = FMA(bar_time_offset_a_z, x27, FMA(-bar_time_offset_a_x, x126, bar_time_offset_a_y*(-x128 - x26))); /* imu-lever-arm.l_z */
        rows[114][i] = -bar_imu_turn_yz + bar_imu_turn_zy; /* imu-misalignment.e_x */
        rows[115][i] = bar_imu_turn_xz - bar_imu_turn_zx; /* imu-misalignment.e_y */
        rows[116][i] = -bar_imu_turn_xy + bar_imu_turn_yx; /* imu-misalignment.e_z */
        rows[117][i] = x253; /* imu-skew.delta_x */
        rows[118][i] = x254; /* imu-skew.delta_y */
        rows[119][i] = bar_time_offset_a_x*x292; /* imu-thermal.db_x_dT */
        rows[120][i] = bar_time_offset_a_y*x292; /* imu-thermal.db_y_dT */
        rows[121][i] = -x289*x291; /* imu-thermal.ds_x_dT */
        rows[122][i] = -x290*x291; /* imu-thermal.ds_y_dT */
        rows[123][i] = bar_i_vibration_rectification*x293; /* inner-temperature.b */
        rows[124][i] = x177*x293; /* inner-temperature.s */
        rows[125][i] = C__heat_start*bar_i_vibration_rectification; /* inner-temperature.b_0 */
        rows[126][i] = C__heat_start*x177; /* inner-temperature.s_0 */
        rows[127][i] = 0.0; /* inner-temperature.tau */
        rows[128][i] = -bar_i_vibration_rectification*rate_f_f_i; /* lag.tau */
        rows[129][i] = bar_i_vibration_rectification*(FMA(B_y, f_tau_zy, FMA(B_x, f_tau_zx, -B_z))); /* magnetic-axial-bias.dK0_dBz */
        rows[130][i] = bar_i_vibration_rectification*(FMA(B_z, x120, FMA(B_y, x119, B_x*x118))); /* magnetic-bias.dK0_dB */
        rows[131][i] = x294*(FMA(B_y, f_tau_xy, B_x*f_tau_xx)); /* magnetic-scale.dK1_dB */
        rows[132][i] = bar_vartheta_y_thermal_misalignment*time; /* misalignment-drift.dvartheta_y_dt */
        rows[133][i] = bar_vartheta_y_thermal_misalignment; /* misalignment-step.dvartheta_y */
        rows[134][i] = b_f_xj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yx */
        rows[135][i] = b_f_yj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yy */
        rows[136][i] = b_f_zj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yz */
        rows[137][i] = b_f_xj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zx */
        rows[138][i] = b_f_yj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zy */
        rows[139][i] = b_f_zj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zz */
        rows[140][i] = bar_vartheta_y_thermal_misalignment*x295; /* mount-hysteresis.e_yx */
        rows[141][i] = -C__play_axial*bar_vartheta_y_thermal_misalignment; /* mount-hysteresis.e_yz */
        rows[142][i] = bar_vartheta_z_mount_hysteresis*x295; /* mount-hysteresis.e_zx */
        rows[143][i] = 0.0; /* mount-hysteresis.w */
        rows[144][i] = FMA(C__mount_omegadot_z, bar_time_offset_omegadot_z, FMA(C__mount_omegadot_y, bar_time_offset_omegadot_y, FMA(C__mount_omegadot_x, bar_time_offset_omegadot_x, FMA(C__mount_omega_z, bar_time_offset_omega_z, FMA(C__mount_omega_y, bar_time_offset_omega_y, FMA(C__mount_omega_x, bar_time_offset_omega_x, FMA(C__mount_a_z, bar_time_offset_a_z, FMA(C__mount_a_y, bar_time_offset_a_y, C__mount_a_x*bar_time_offset_a_x)))))))); /* mount-resonance.share */
        rows[145][i] = 0.0; /* mount-resonance.f_0 */
        rows[146][i] = 0.0; /* mount-resonance.Q */
        rows[147][i] = FMA(-bar_q_f_x, x297, FMA(bar_f_f_x, x301, x296)); /* near-mass.T_xxx */
        rows[148][i] = FMA(-q_r_x, x149, FMA(-f_r_x, x148, FMA(-bar_q_f_y, x297, FMA(bar_f_f_z, f_disc_r_z*f_r_y, bar_f_f_y*x301)))); /* near-mass.T_xxy */
        rows[149][i] = FMA(bar_q_p_second_order_misalignment, x297, FMA(bar_f_f_z, x301, -x302)); /* near-mass.T_xxz */
        rows[150][i] = FMA(-q_r_x, x145, FMA(-f_r_x, x144, FMA(-bar_q_f_x, x303, FMA(bar_f_f_z, f_disc_r_z*f_r_x, bar_f_f_x*x305)))); /* near-mass.T_xyy */
        rows[151][i] = FMA(-f_r_y, x147, FMA(-f_r_x, x140, FMA(bar_q_p_second_order_misalignment, q_r_x*q_r_y, -x306))); /* near-mass.T_xyz */
        rows[152][i] = FMA(f_r_y, x139, FMA(-bar_q_f_y, x303, bar_f_f_y*x305)); /* near-mass.T_yyy */
        rows[153][i] = FMA(-f_r_y, x143, FMA(bar_q_p_second_order_misalignment, x303, bar_f_f_z*x305)); /* near-mass.T_yyz */
        rows[154][i] = FMA(-bar_q_f_x, x307, FMA(-bar_f_f_z, x312, bar_f_f_x*x309)); /* near-mass.T_xxxx */
        rows[155][i] = FMA(-x149, x297, FMA(-bar_q_f_y, x307, FMA(bar_f_f_y, x309, FMA(bar_f_f_x, x315, x313)))); /* near-mass.T_xxxy */
        rows[156][i] = FMA(bar_q_p_second_order_misalignment, x307, FMA(bar_f_f_z, x309, bar_f_f_x*x312)); /* near-mass.T_xxxz */
        rows[157][i] = FMA(-x150, x303, FMA(-x145, x297, FMA(bar_f_f_z, FMA(-1.0/3.0, x310, FMA(f_disc_r_z, x300, x317)), FMA(bar_f_f_y, x315, bar_f_f_x*x316)))); /* near-mass.T_xxyy */
        rows[158][i] = FMA(x141, x297, FMA(-f_r_y, x302, FMA(bar_f_f_z, x315, bar_f_f_y*x312))); /* near-mass.T_xxyz */
        rows[159][i] = FMA(-x146, x303, FMA(-bar_q_f_x, x318, FMA(bar_f_f_y, x316, FMA(bar_f_f_x, x319, x313)))); /* near-mass.T_xyyy */
        rows[160][i] = FMA(x142, x303, FMA(-f_r_y, x306, FMA(bar_f_f_z, x316, bar_f_f_x*x320))); /* near-mass.T_xyyz */
        rows[161][i] = FMA(-bar_q_f_y, x318, FMA(-bar_f_f_z, x320, bar_f_f_y*x319)); /* near-mass.T_yyyy */
        rows[162][i] = FMA(bar_q_p_second_order_misalignment, x318, FMA(bar_f_f_z, x319, bar_f_f_y*x320)); /* near-mass.T_yyyz */
        rows[163][i] = x264*fabs(f_f_i); /* odd-quadratic.K_oq */
        rows[164][i] = -G_out*x294; /* output-curve.c_2 */
        rows[165][i] = -(G_out*G_out)*x294; /* output-curve.c_3 */
        rows[166][i] = x321; /* output-filter.b */
        rows[167][i] = x294; /* output-gain-step.g */
        rows[168][i] = bar_i_vibration_rectification*(FMA(-f_tau_yy, x19, FMA(-beta_x, x14, f_tau_yx*x24))); /* pendulum-angular.K_pa */
        rows[169][i] = bar_i_vibration_rectification*(FMA(-101325.0, (1.0), pressure)); /* pressure-bias.dK0_dp */
        rows[170][i] = bar_K2_thermal_second_order*time; /* second-order-drift.dK2_dt */
        rows[171][i] = x321; /* second-order-loop.b */
        rows[172][i] = FMA(bar_q_p_second_order_misalignment, (f_f_p + q_f_z), FMA(bar_q_o_second_order_misalignment, (f_f_o - q_f_yj), bar_q_i_second_order_misalignment*(f_f_i - q_f_xj))); /* second-order-misalignment.kappa */
        rows[173][i] = bar_K2_thermal_second_order; /* second-order-step.dK2 */
        rows[174][i] = FMA(-bar_M_xx, x6, -x322); /* self-gradient.G_xx_roll */
        rows[175][i] = bar_spin_axis_tilt_Gamma_xy*x6; /* self-gradient.G_xy_roll */
        rows[176][i] = bar_spin_axis_tilt_Gamma_xz*x6; /* self-gradient.G_xz_roll */
        rows[177][i] = FMA(-bar_M_yy, x6, -x322); /* self-gradient.G_yy_roll */
        rows[178][i] = bar_spin_axis_tilt_Gamma_yz*x6; /* self-gradient.G_yz_roll */
        rows[179][i] = FMA(-bar_M_xx, x5, -x323); /* self-gradient.G_xx_pitch */
        rows[180][i] = bar_spin_axis_tilt_Gamma_xy*x5; /* self-gradient.G_xy_pitch */
        rows[181][i] = bar_spin_axis_tilt_Gamma_xz*x5; /* self-gradient.G_xz_pitch */
        rows[182][i] = FMA(-bar_M_yy, x5, -x323); /* self-gradient.G_yy_pitch */
        rows[183][i] = bar_spin_axis_tilt_Gamma_yz*x5; /* self-gradient.G_yz_pitch */
        rows[184][i] = FMA(-bar_M_yy, x324, FMA(-bar_M_xx, x325, 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw)); /* self-gradient-yaw.G_d */
        rows[185][i] = FMA(-x208, x326, FMA(x206, x326, bar_spin_axis_tilt_Gamma_xy*x325)); /* self-gradient-yaw.G_xy */
        rows[186][i] = FMA(bar_spin_axis_tilt_Gamma_yz, sin_yaw, bar_spin_axis_tilt_Gamma_xz*x327); /* self-gradient-yaw.G_xz */
        rows[187][i] = FMA(-bar_spin_axis_tilt_Gamma_xz, sin_yaw, bar_spin_axis_tilt_Gamma_yz*x327); /* self-gradient-yaw.G_yz */
        rows[188][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (-Gamma_yy - x328), FMA(bar_M_zz, x329, FMA(-bar_M_yy, x329, FMA(Gamma_xz, bar_spin_axis_tilt_Gamma_xy, FMA(-Gamma_xy, bar_spin_axis_tilt_Gamma_xz, -x156 - x157 + x164 + x288))))); /* spin-axis-tilt.alpha_x */
        rows[189][i] = FMA(bar_spin_axis_tilt_Gamma_xz, (Gamma_xx + x328), FMA(-bar_M_zz, x330, FMA(bar_M_xx, x330, FMA(-Gamma_yz, bar_spin_axis_tilt_Gamma_xy, FMA(Gamma_xy, bar_spin_axis_tilt_Gamma_yz, x161 - x168 - x169 + x287))))); /* spin-axis-tilt.alpha_y */
        rows[190][i] = FMA(bar_wobble_zy, cos_phi, FMA(-bar_wobble_zx, sin_phi, FMA(-bar_wobble_yz, cos_phi, bar_wobble_xz*sin_phi))); /* spin-axis-wobble.w_x */
        rows[191][i] = FMA(-bar_wobble_zy, sin_phi, FMA(-bar_wobble_zx, cos_phi, FMA(bar_wobble_yz, sin_phi, bar_wobble_xz*cos_phi))); /* spin-axis-wobble.w_y */
        rows[192][i] = bar_sin_delta_phi; /* spin-phase-offset.phi_0 */
        rows[193][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_phi */
        rows[194][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_walk */
        rows[195][i] = FMA(bar_spin_rate_true, FMA(d2_spin_angle, time, d_spin_angle), FMA(bar_spin_acceleration_true, x66, bar_sin_delta_phi*d_spin_angle*time)); /* spin-rate-offset.epsilon */
        rows[196][i] = FMA(-bar_spin_rate_true, d_omegadot_z, FMA(-bar_spin_acceleration_true, d2_omegadot_z, -bar_sin_delta_phi*omegadot_z)); /* spin-servo.c */
        rows[197][i] = bar_i_vibration_rectification*x291; /* thermal-bias.dK0_dT */
        rows[198][i] = bar_i_vibration_rectification*d_temperature; /* thermal-lag.dK0_dTdot */
        rows[199][i] = d_temperature*x177; /* thermal-lag.dK1_dTdot */
        rows[200][i] = bar_vartheta_y_thermal_misalignment*x291; /* thermal-misalignment.dvartheta_y_dT */
        rows[201][i] = x177*x291; /* thermal-scale.dK1_dT */
        rows[202][i] = bar_K2_thermal_second_order*x291; /* thermal-second-order.dK2_dT */
        rows[203][i] = x253 + x254 + x255 + x285 + x286; /* time-offset.delta_t */
        rows[204][i] = bar_i_vibration_rectification*(FMA(x331, x340, FMA(x331, x339, FMA(x331, x338, FMA(x331, x337, FMA(x331, x335, x331*x333)))))); /* vibration-level.L_xx */
        rows[205][i] = bar_i_vibration_rectification*(FMA(x331, x355, FMA(x331, x353, FMA(x331, x351, FMA(x331, x349, FMA(x331, x347, FMA(x331, x346, FMA(x331, x344, FMA(x331, x343, x331*x341))))))))); /* vibration-level.L_xy */
        rows[206][i] = bar_i_vibration_rectification*(FMA(x331, x364, FMA(x331, x363, FMA(x331, x362, FMA(x331, x361, FMA(x331, x360, FMA(x331, x359, FMA(x331, x358, FMA(x331, x357, x331*x356))))))))); /* vibration-level.L_xz */
        rows[207][i] = bar_i_vibration_rectification*(FMA(x331, x373, FMA(x331, x372, FMA(x331, x371, FMA(x331, x370, FMA(x331, x368, x331*x366)))))); /* vibration-level.L_yy */
        rows[208][i] = bar_i_vibration_rectification*(FMA(x331, x385, FMA(x331, x384, FMA(x331, x383, FMA(x331, x382, FMA(x331, x380, FMA(x331, x379, FMA(x331, x377, FMA(x331, x376, x331*x374))))))))); /* vibration-level.L_yz */
        rows[209][i] = bar_i_vibration_rectification*(FMA(x331, x391, FMA(x331, x390, FMA(x331, x389, FMA(x331, x388, FMA(x331, x387, x331*x386)))))); /* vibration-level.L_zz */
        rows[210][i] = bar_i_vibration_rectification*(x333 + x335 + x337 + x338 + x339 + x340); /* vibration-rectification.P_xx */
        rows[211][i] = bar_i_vibration_rectification*(x341 + x343 + x344 + x346 + x347 + x349 + x351 + x353 + x355); /* vibration-rectification.P_xy */
        rows[212][i] = bar_i_vibration_rectification*(x356 + x357 + x358 + x359 + x360 + x361 + x362 + x363 + x364); /* vibration-rectification.P_xz */
        rows[213][i] = bar_i_vibration_rectification*(x366 + x368 + x370 + x371 + x372 + x373); /* vibration-rectification.P_yy */
        rows[214][i] = bar_i_vibration_rectification*(x374 + x376 + x377 + x379 + x380 + x382 + x383 + x384 + x385); /* vibration-rectification.P_yz */
        rows[215][i] = bar_i_vibration_rectification*(x386 + x387 + x388 + x389 + x390 + x391); /* vibration-rectification.P_zz */
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
