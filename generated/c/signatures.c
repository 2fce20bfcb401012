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

enum { ROWS = 219, STEP = 64, INPUTS = 68 };

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
    const double *restrict in_C__curvature_axial = in[18] + at;
    const double *restrict in_C__curvature_radial = in[19] + at;
    const double *restrict in_C__curvature_tangential = in[20] + at;
    const double *restrict in_C__heat_rr = in[21] + at;
    const double *restrict in_C__heat_rt = in[22] + at;
    const double *restrict in_C__heat_start = in[23] + at;
    const double *restrict in_C__heat_tt = in[24] + at;
    const double *restrict in_C__mount_a_x = in[25] + at;
    const double *restrict in_C__mount_a_y = in[26] + at;
    const double *restrict in_C__mount_a_z = in[27] + at;
    const double *restrict in_C__mount_omega_x = in[28] + at;
    const double *restrict in_C__mount_omega_y = in[29] + at;
    const double *restrict in_C__mount_omega_z = in[30] + at;
    const double *restrict in_C__mount_omegadot_x = in[31] + at;
    const double *restrict in_C__mount_omegadot_y = in[32] + at;
    const double *restrict in_C__mount_omegadot_z = in[33] + at;
    const double *restrict in_C__play_axial = in[34] + at;
    const double *restrict in_C__play_radial = in[35] + at;
    const double *restrict in_C__play_tangential = in[36] + at;
    const double *restrict in_C__rate_axial = in[37] + at;
    const double *restrict in_C__rate_radial = in[38] + at;
    const double *restrict in_C__rate_tangential = in[39] + at;
    const double *restrict in_C__slip_axial = in[40] + at;
    const double *restrict in_C__slip_radial = in[41] + at;
    const double *restrict in_C__slip_tangential = in[42] + at;
    const double *restrict in_G_out = in[43] + at;
    const double *restrict in_angular_vibration_rms = in[44] + at;
    const double *restrict in_balance_current = in[45] + at;
    const double *restrict in_d2_a_x = in[46] + at;
    const double *restrict in_d2_a_y = in[47] + at;
    const double *restrict in_d2_a_z = in[48] + at;
    const double *restrict in_d2_omegadot_x = in[49] + at;
    const double *restrict in_d2_omegadot_y = in[50] + at;
    const double *restrict in_d2_omegadot_z = in[51] + at;
    const double *restrict in_d2_spin_angle = in[52] + at;
    const double *restrict in_d_a_x = in[53] + at;
    const double *restrict in_d_a_y = in[54] + at;
    const double *restrict in_d_a_z = in[55] + at;
    const double *restrict in_d_omegadot_x = in[56] + at;
    const double *restrict in_d_omegadot_y = in[57] + at;
    const double *restrict in_d_omegadot_z = in[58] + at;
    const double *restrict in_d_spin_angle = in[59] + at;
    const double *restrict in_d_temperature = in[60] + at;
    const double *restrict in_fuel_mass = in[61] + at;
    const double *restrict in_pitch = in[62] + at;
    const double *restrict in_pressure = in[63] + at;
    const double *restrict in_roll = in[64] + at;
    const double *restrict in_temperature = in[65] + at;
    const double *restrict in_vibration_rms = in[66] + at;
    const double *restrict in_yaw = in[67] + at;
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
        const double C__curvature_axial = in_C__curvature_axial[i];
        const double C__curvature_radial = in_C__curvature_radial[i];
        const double C__curvature_tangential = in_C__curvature_tangential[i];
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
        const double C__rate_axial = in_C__rate_axial[i];
        const double C__rate_radial = in_C__rate_radial[i];
        const double C__rate_tangential = in_C__rate_tangential[i];
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
        const double x152 = C__rate_tangential*cos_j;
        const double x153 = C__rate_radial*sin_j;
        const double x154 = FMA(C__rate_tangential, sin_j, C__rate_radial*cos_j);
        const double x155 = C__curvature_tangential*cos_j;
        const double x156 = C__curvature_radial*sin_j;
        const double x157 = FMA(C__curvature_tangential, sin_j, C__curvature_radial*cos_j);
        const double x158 = (angular_vibration_rms*angular_vibration_rms);
        const double x159 = bar_M_yy*x158;
        const double x160 = bar_M_zz*x158;
        const double x161 = bar_M_xx*x158;
        const double x162 = K1*bar_K1_thermal_scale;
        const double x163 = bar_run_out_x*cos_phi;
        const double x164 = bar_run_out_y*cos_phi;
        const double x165 = bar_run_out_z*cos_phi;
        const double x166 = FMA(-rate_sin_phi_true, x40, rate_cos_phi_true*x43);
        const double x167 = (cos_phi*cos_phi);
        const double x168 = (sin_phi*sin_phi);
        const double x169 = x167 - x168;
        const double x170 = FMA(-2.0, rate_sin_phi_true*rate_sin_phi_true, FMA(-rate_rate_sin_phi_true, x40, FMA(rate_rate_cos_phi_true, x43, 2.0*rate_cos_phi_true*rate_cos_phi_true)));
        const double x171 = FMA(rate_sin_phi_true, x43, rate_cos_phi_true*x40);
        const double x172 = FMA(rate_rate_sin_phi_true, x43, FMA(rate_rate_cos_phi_true, x40, 4.0*rate_cos_phi_true*rate_sin_phi_true));
        const double x173 = (attitude_yx*attitude_yx);
        const double x174 = (attitude_yz*attitude_yz);
        const double x175 = attitude_xx*attitude_yx;
        const double x176 = attitude_xz*attitude_yz;
        const double x177 = -x176;
        const double x178 = attitude_xx*attitude_zx;
        const double x179 = attitude_xz*attitude_zz;
        const double x180 = -x179;
        const double x181 = attitude_yx*attitude_zx;
        const double x182 = attitude_yz*attitude_zz;
        const double x183 = -x182;
        const double x184 = (attitude_xz*attitude_xz);
        const double x185 = (attitude_xx*attitude_xx);
        const double x186 = (attitude_zx*attitude_zx);
        const double x187 = (attitude_zz*attitude_zz);
        const double x188 = (1.0) - x187;
        const double x189 = 2.0*bar_M_xx;
        const double x190 = attitude_xx*x189;
        const double x191 = 2.0*bar_M_yy;
        const double x192 = attitude_yx*x191;
        const double x193 = 2.0*attitude_zx;
        const double x194 = bar_M_zz*x193;
        const double x195 = attitude_xx*attitude_zy;
        const double x196 = attitude_xy*attitude_zx;
        const double x197 = attitude_yx*attitude_zy;
        const double x198 = attitude_yy*attitude_zx;
        const double x199 = attitude_xx*attitude_yy;
        const double x200 = attitude_xy*attitude_yx;
        const double x201 = attitude_xx*attitude_yz;
        const double x202 = attitude_xz*attitude_yx;
        const double x203 = attitude_yx*attitude_zz;
        const double x204 = attitude_yz*attitude_zx;
        const double x205 = attitude_xx*attitude_zz;
        const double x206 = attitude_xz*attitude_zx;
        const double x207 = (attitude_xy*attitude_xy);
        const double x208 = attitude_xy*attitude_yy;
        const double x209 = attitude_xy*attitude_zy;
        const double x210 = attitude_yy*attitude_zy;
        const double x211 = (attitude_yy*attitude_yy);
        const double x212 = (attitude_zy*attitude_zy);
        const double x213 = attitude_xy*attitude_xz;
        const double x214 = attitude_yy*attitude_yz;
        const double x215 = 2.0*attitude_zy*attitude_zz;
        const double x216 = attitude_xy*attitude_yz;
        const double x217 = attitude_xz*attitude_yy;
        const double x218 = attitude_xy*attitude_zz;
        const double x219 = attitude_xz*attitude_zy;
        const double x220 = attitude_yy*attitude_zz;
        const double x221 = attitude_yz*attitude_zy;
        const double x222 = -fuel_mass*x176;
        const double x223 = -fuel_mass*x179;
        const double x224 = -fuel_mass*x182;
        const double x225 = -fuel_mass*x184;
        const double x226 = -fuel_mass*x174;
        const double x227 = -fuel_mass*x187;
        const double x228 = bar_M_xx*fuel_mass;
        const double x229 = 2.0*x228;
        const double x230 = attitude_xx*x229;
        const double x231 = bar_M_yy*fuel_mass;
        const double x232 = 2.0*x231;
        const double x233 = attitude_yx*x232;
        const double x234 = bar_M_zz*fuel_mass;
        const double x235 = x193*x234;
        const double x236 = bar_time_offset_a_x*d_a_x;
        const double x237 = bar_time_offset_a_y*d_a_y;
        const double x238 = bar_time_offset_a_z*d_a_z;
        const double x239 = bar_time_offset_omega_x*omegadot_x;
        const double x240 = bar_time_offset_omega_y*omegadot_y;
        const double x241 = bar_time_offset_omega_z*omegadot_z;
        const double x242 = bar_time_offset_omegadot_x*d_omegadot_x;
        const double x243 = bar_time_offset_omegadot_y*d_omegadot_y;
        const double x244 = bar_time_offset_omegadot_z*d_omegadot_z;
        const double x245 = bar_i_vibration_rectification*(f_f_i*f_f_i);
        const double x246 = (f_f_o*f_f_o);
        const double x247 = bar_i_vibration_rectification*f_f_i;
        const double x248 = (f_f_p*f_f_p);
        const double x249 = bar_sin_delta_phi*cos_phi;
        const double x250 = (cos_phi*cos_phi*cos_phi);
        const double x251 = (sin_phi*sin_phi*sin_phi);
        const double x252 = -bar_M_zz*fuel_mass;
        const double x253 = -bar_M_zz;
        const double x254 = x239 + x240 + x241;
        const double x255 = x242 + x243 + x244;
        const double x256 = -x146;
        const double x257 = -x134;
        const double x258 = a_x*bar_time_offset_a_x;
        const double x259 = a_y*bar_time_offset_a_y;
        const double x260 = -omegadot_y;
        const double x261 = FMA(-293.15, (1.0), temperature);
        const double x262 = -x261;
        const double x263 = FMA(C__heat_tt, cos_j*cos_j, FMA(-2.0, C__heat_rt*cos_j*sin_j, C__heat_rr*sin_j*sin_j));
        const double x264 = bar_i_vibration_rectification*i_sensed;
        const double x265 = FMA(-C__play_radial, sin_j, C__play_tangential*cos_j);
        const double x266 = f_r_x*x122;
        const double x267 = 0.5*(q_r_x*q_r_x);
        const double x268 = 0.5*(f_disc_r_z*f_disc_r_z);
        const double x269 = (f_r_x*f_r_x);
        const double x270 = 0.5*x269;
        const double x271 = x268 - x270;
        const double x272 = f_r_x*x130;
        const double x273 = 0.5*(q_r_y*q_r_y);
        const double x274 = 0.5*(f_r_y*f_r_y);
        const double x275 = x268 - x274;
        const double x276 = f_r_x*x126;
        const double x277 = (1.0/6.0)*(q_r_x*q_r_x*q_r_x);
        const double x278 = f_r_x*x268;
        const double x279 = FMA(-1.0/6.0, f_r_x*f_r_x*f_r_x, x278);
        const double x280 = (f_disc_r_z*f_disc_r_z*f_disc_r_z);
        const double x281 = (1.0/6.0)*x280;
        const double x282 = FMA(-0.5, f_disc_r_z*x269, x281);
        const double x283 = f_r_y*x266;
        const double x284 = f_r_y*x268;
        const double x285 = FMA(-f_r_y, x270, x284);
        const double x286 = FMA(-f_r_x, x274, x278);
        const double x287 = f_disc_r_z*x274;
        const double x288 = (1.0/6.0)*(q_r_y*q_r_y*q_r_y);
        const double x289 = FMA(-1.0/6.0, f_r_y*f_r_y*f_r_y, x284);
        const double x290 = x281 - x287;
        const double x291 = bar_i_vibration_rectification*rate_rate_i_sensed;
        const double x292 = -bar_M_zz*x6;
        const double x293 = -bar_M_zz*x5;
        const double x294 = FMA(sin_yaw, sin_yaw, FMA(-cos_yaw, cos_yaw, (1.0)));
        const double x295 = -x294;
        const double x296 = cos_yaw*sin_yaw;
        const double x297 = cos_yaw - (1.0);
        const double x298 = -Gamma_zz;
        const double x299 = 2.0*Gamma_yz;
        const double x300 = 2.0*Gamma_xz;
        const double x301 = (vibration_rms*vibration_rms);
        const double x302 = K4*vibration_axis_ix;
        const double x303 = vibration_axis_px*x302;
        const double x304 = K6*vibration_axis_ix;
        const double x305 = vibration_axis_ox*x304;
        const double x306 = K8*vibration_axis_ox;
        const double x307 = vibration_axis_px*x306;
        const double x308 = K2*(vibration_axis_ix*vibration_axis_ix);
        const double x309 = K5*(vibration_axis_ox*vibration_axis_ox);
        const double x310 = K7*(vibration_axis_px*vibration_axis_px);
        const double x311 = vibration_axis_py*x302;
        const double x312 = K4*vibration_axis_px;
        const double x313 = vibration_axis_iy*x312;
        const double x314 = vibration_axis_oy*x304;
        const double x315 = K6*vibration_axis_ox;
        const double x316 = vibration_axis_iy*x315;
        const double x317 = vibration_axis_py*x306;
        const double x318 = K8*vibration_axis_px;
        const double x319 = vibration_axis_oy*x318;
        const double x320 = vibration_axis_ix*x108;
        const double x321 = vibration_axis_iy*x320;
        const double x322 = vibration_axis_ox*x109;
        const double x323 = vibration_axis_oy*x322;
        const double x324 = vibration_axis_px*x110;
        const double x325 = vibration_axis_py*x324;
        const double x326 = vibration_axis_pz*x302;
        const double x327 = vibration_axis_iz*x312;
        const double x328 = vibration_axis_oz*x304;
        const double x329 = vibration_axis_iz*x315;
        const double x330 = vibration_axis_pz*x306;
        const double x331 = vibration_axis_oz*x318;
        const double x332 = vibration_axis_iz*x320;
        const double x333 = vibration_axis_oz*x322;
        const double x334 = vibration_axis_pz*x324;
        const double x335 = K4*vibration_axis_iy;
        const double x336 = vibration_axis_py*x335;
        const double x337 = K6*vibration_axis_iy;
        const double x338 = vibration_axis_oy*x337;
        const double x339 = K8*vibration_axis_oy;
        const double x340 = vibration_axis_py*x339;
        const double x341 = K2*(vibration_axis_iy*vibration_axis_iy);
        const double x342 = K5*(vibration_axis_oy*vibration_axis_oy);
        const double x343 = K7*(vibration_axis_py*vibration_axis_py);
        const double x344 = vibration_axis_pz*x335;
        const double x345 = K4*vibration_axis_iz;
        const double x346 = vibration_axis_py*x345;
        const double x347 = vibration_axis_oz*x337;
        const double x348 = K6*vibration_axis_iz;
        const double x349 = vibration_axis_oy*x348;
        const double x350 = vibration_axis_pz*x339;
        const double x351 = K8*vibration_axis_oz;
        const double x352 = vibration_axis_py*x351;
        const double x353 = vibration_axis_iy*vibration_axis_iz*x108;
        const double x354 = vibration_axis_oy*vibration_axis_oz*x109;
        const double x355 = vibration_axis_py*vibration_axis_pz*x110;
        const double x356 = vibration_axis_pz*x345;
        const double x357 = vibration_axis_oz*x348;
        const double x358 = vibration_axis_pz*x351;
        const double x359 = K2*(vibration_axis_iz*vibration_axis_iz);
        const double x360 = K5*(vibration_axis_oz*vibration_axis_oz);
        const double x361 = K7*(vibration_axis_pz*vibration_axis_pz);

        rows[0][i] = bar_i_vibration_rectification*(FMA(-vartheta_z, FMA(beta_z, (x152 - x153), x154), FMA(beta_z, x154, FMA(-C__rate_axial, vartheta_y, -x152 + x153)))); /* accelerometer-resonance.u */
        rows[1][i] = bar_i_vibration_rectification*(FMA(-vartheta_z, FMA(beta_z, (x155 - x156), x157), FMA(beta_z, x157, FMA(-C__curvature_axial, vartheta_y, -x155 + x156)))); /* accelerometer-resonance.v */
        rows[2][i] = 0.0; /* accelerometer-resonance.f_0 */
        rows[3][i] = 0.0; /* accelerometer-resonance.Q */
        rows[4][i] = bar_i_vibration_rectification*((double)((i_sensed) > 0.0) - (double)((i_sensed) < 0.0)); /* adc-nonlinearity.h */
        rows[5][i] = -x159 - x160; /* angular-jitter.W_xx */
        rows[6][i] = -bar_spin_axis_tilt_Gamma_xy*x158; /* angular-jitter.W_xy */
        rows[7][i] = -bar_spin_axis_tilt_Gamma_xz*x158; /* angular-jitter.W_xz */
        rows[8][i] = -x160 - x161; /* angular-jitter.W_yy */
        rows[9][i] = -bar_spin_axis_tilt_Gamma_yz*x158; /* angular-jitter.W_yz */
        rows[10][i] = -x159 - x161; /* angular-jitter.W_zz */
        rows[11][i] = bar_i_vibration_rectification*(FMA(f_tau_xy, omega_y, f_tau_xx*omega_x))*(FMA(f_tau_zy, omega_y, FMA(f_tau_zx, omega_x, -x117))); /* anisoinertia.K_ip */
        rows[12][i] = bar_dR_arm_stretch; /* arm-length.delta_R */
        rows[13][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_zj, FMA(bar_rate_dR_arm_stretch, rate_b_f_zj, b_f_zj*bar_dR_arm_stretch)); /* arm-sag.c_z */
        rows[14][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_yj, FMA(bar_rate_dR_arm_stretch, rate_b_f_yj, b_f_yj*bar_dR_arm_stretch)); /* arm-stretch.c_r */
        rows[15][i] = balance_current*x162; /* balancing-loop.dK1_di */
        rows[16][i] = FMA(bar_rate_run_out_x, rate_cos_phi_true, FMA(bar_rate_rate_run_out_x, rate_rate_cos_phi_true, x163)); /* bearing-run-out.c_x1 */
        rows[17][i] = FMA(bar_run_out_x, sin_phi, FMA(bar_rate_run_out_x, rate_sin_phi_true, bar_rate_rate_run_out_x*rate_rate_sin_phi_true)); /* bearing-run-out.s_x1 */
        rows[18][i] = FMA(bar_rate_run_out_y, rate_cos_phi_true, FMA(bar_rate_rate_run_out_y, rate_rate_cos_phi_true, x164)); /* bearing-run-out.c_y1 */
        rows[19][i] = FMA(bar_run_out_y, sin_phi, FMA(bar_rate_run_out_y, rate_sin_phi_true, bar_rate_rate_run_out_y*rate_rate_sin_phi_true)); /* bearing-run-out.s_y1 */
        rows[20][i] = FMA(bar_rate_run_out_z, rate_cos_phi_true, FMA(bar_rate_rate_run_out_z, rate_rate_cos_phi_true, x165)); /* bearing-run-out.c_z1 */
        rows[21][i] = FMA(bar_run_out_z, sin_phi, FMA(bar_rate_run_out_z, rate_sin_phi_true, bar_rate_rate_run_out_z*rate_rate_sin_phi_true)); /* bearing-run-out.s_z1 */
        rows[22][i] = FMA(bar_run_out_x, x169, FMA(bar_rate_run_out_x, x166, bar_rate_rate_run_out_x*x170)); /* bearing-run-out.c_x2 */
        rows[23][i] = FMA(x163, x40, FMA(bar_rate_run_out_x, x171, bar_rate_rate_run_out_x*x172)); /* bearing-run-out.s_x2 */
        rows[24][i] = FMA(bar_run_out_y, x169, FMA(bar_rate_run_out_y, x166, bar_rate_rate_run_out_y*x170)); /* bearing-run-out.c_y2 */
        rows[25][i] = FMA(x164, x40, FMA(bar_rate_run_out_y, x171, bar_rate_rate_run_out_y*x172)); /* bearing-run-out.s_y2 */
        rows[26][i] = FMA(bar_run_out_z, x169, FMA(bar_rate_run_out_z, x166, bar_rate_rate_run_out_z*x170)); /* bearing-run-out.c_z2 */
        rows[27][i] = FMA(x165, x40, FMA(bar_rate_run_out_z, x171, bar_rate_rate_run_out_z*x172)); /* bearing-run-out.s_z2 */
        rows[28][i] = bar_i_vibration_rectification*time; /* bias-drift.dK0_dt */
        rows[29][i] = bar_i_vibration_rectification*(FMA(-C__slip_radial, sin_j, C__slip_tangential*cos_j)); /* bias-hysteresis.h_i */
        rows[30][i] = bar_i_vibration_rectification*(FMA(C__slip_tangential, sin_j, C__slip_radial*cos_j)); /* bias-hysteresis.h_o */
        rows[31][i] = -C__slip_axial*bar_i_vibration_rectification; /* bias-hysteresis.h_p */
        rows[32][i] = 0.0; /* bias-hysteresis.w */
        rows[33][i] = bar_i_vibration_rectification; /* bias-step.dK0 */
        rows[34][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x181 + x183), FMA(bar_spin_axis_tilt_Gamma_xz, (x178 + x180), FMA(-bar_M_zz, (x186 + x188), FMA(-bar_M_yy, (x173 - x174), FMA(-bar_M_xx, (-x184 + x185 - (1.0)), bar_spin_axis_tilt_Gamma_xy*(x175 + x177)))))); /* carrier-gradient.G_xx */
        rows[35][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x197 + x198), FMA(bar_spin_axis_tilt_Gamma_xz, (x195 + x196), FMA(-attitude_zy, x194, FMA(-attitude_yy, x192, FMA(-attitude_xy, x190, bar_spin_axis_tilt_Gamma_xy*(x199 + x200 - (1.0))))))); /* carrier-gradient.G_xy */
        rows[36][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x203 + x204), FMA(bar_spin_axis_tilt_Gamma_xz, (x205 + x206 - (1.0)), FMA(-attitude_zz, x194, FMA(-attitude_yz, x192, FMA(-attitude_xz, x190, bar_spin_axis_tilt_Gamma_xy*(x201 + x202)))))); /* carrier-gradient.G_xz */
        rows[37][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x183 + x210), FMA(bar_spin_axis_tilt_Gamma_xz, (x180 + x209), FMA(-bar_M_zz, (x188 + x212), FMA(-bar_M_yy, (-x174 + x211 - (1.0)), FMA(-bar_M_xx, (-x184 + x207), bar_spin_axis_tilt_Gamma_xy*(x177 + x208)))))); /* carrier-gradient.G_yy */
        rows[38][i] = FMA(-x191, x214, FMA(-x189, x213, FMA(bar_spin_axis_tilt_Gamma_yz, (x220 + x221 - (1.0)), FMA(bar_spin_axis_tilt_Gamma_xz, (x218 + x219), FMA(-bar_M_zz, x215, bar_spin_axis_tilt_Gamma_xy*(x216 + x217)))))); /* carrier-gradient.G_yz */
        rows[39][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x181, x224), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x178, x223), FMA(-bar_M_zz, FMA(fuel_mass, x186, x227), FMA(-bar_M_yy, FMA(fuel_mass, x173, x226), FMA(-bar_M_xx, FMA(fuel_mass, x185, x225), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x175, x222)))))); /* carrier-gradient.F_xx */
        rows[40][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x198, fuel_mass*x197), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x196, fuel_mass*x195), FMA(-attitude_zy, x235, FMA(-attitude_yy, x233, FMA(-attitude_xy, x230, bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x200, fuel_mass*x199)))))); /* carrier-gradient.F_xy */
        rows[41][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x204, fuel_mass*x203), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x206, fuel_mass*x205), FMA(-attitude_zz, x235, FMA(-attitude_yz, x233, FMA(-attitude_xz, x230, bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x202, fuel_mass*x201)))))); /* carrier-gradient.F_xz */
        rows[42][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x210, x224), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x209, x223), FMA(-bar_M_zz, FMA(fuel_mass, x212, x227), FMA(-bar_M_yy, FMA(fuel_mass, x211, x226), FMA(-bar_M_xx, FMA(fuel_mass, x207, x225), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x208, x222)))))); /* carrier-gradient.F_yy */
        rows[43][i] = FMA(-x215, x234, FMA(-x214, x232, FMA(-x213, x229, FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x221, fuel_mass*x220), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x219, fuel_mass*x218), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x217, fuel_mass*x216)))))); /* carrier-gradient.F_yz */
        rows[44][i] = FMA(time, x244, FMA(time, x243, FMA(time, x242, FMA(time, x241, FMA(time, x240, FMA(time, x239, FMA(time, x238, FMA(time, x237, time*x236)))))))); /* clock-drift.epsilon */
        rows[45][i] = f_f_o*x245; /* cubic-cross.K_iio */
        rows[46][i] = f_f_p*x245; /* cubic-cross.K_iip */
        rows[47][i] = x246*x247; /* cubic-cross.K_ioo */
        rows[48][i] = f_f_o*f_f_p*x247; /* cubic-cross.K_iop */
        rows[49][i] = x247*x248; /* cubic-cross.K_ipp */
        rows[50][i] = bar_i_vibration_rectification*(f_f_o*f_f_o*f_f_o); /* cubic-cross.K_ooo */
        rows[51][i] = bar_i_vibration_rectification*f_f_p*x246; /* cubic-cross.K_oop */
        rows[52][i] = bar_i_vibration_rectification*f_f_o*x248; /* cubic-cross.K_opp */
        rows[53][i] = bar_i_vibration_rectification*(f_f_p*f_f_p*f_f_p); /* cubic-cross.K_ppp */
        rows[54][i] = bar_i_vibration_rectification*(f_f_i*f_f_i*f_f_i); /* cubic-input.K_iii */
        rows[55][i] = FMA(-bar_q_p_second_order_misalignment, FMA(q_r_y, spin_zy, q_r_x*spin_zx), FMA(bar_q_f_y, FMA(q_r_y, spin_yy, d2_spin_angle*q_r_x), FMA(bar_q_f_x, FMA(-d2_spin_angle, q_r_y, q_r_x*spin_xx), FMA(bar_f_f_z, FMA(f_r_y, spin_zy, f_r_x*spin_zx), FMA(bar_f_f_y, FMA(f_r_y, spin_yy, d2_spin_angle*f_r_x), bar_f_f_x*FMA(-d2_spin_angle, f_r_y, f_r_x*spin_xx)))))); /* disc-spin.share */
        rows[56][i] = x249; /* encoder-harmonic.c_1 */
        rows[57][i] = bar_sin_delta_phi*sin_phi; /* encoder-harmonic.s_1 */
        rows[58][i] = bar_sin_delta_phi*x169; /* encoder-harmonic.c_2 */
        rows[59][i] = x249*x40; /* encoder-harmonic.s_2 */
        rows[60][i] = bar_sin_delta_phi*(FMA(-3.0, cos_phi*x168, x250)); /* encoder-harmonic.c_3 */
        rows[61][i] = bar_sin_delta_phi*(FMA(3.0, sin_phi*x167, -x251)); /* encoder-harmonic.s_3 */
        rows[62][i] = bar_sin_delta_phi*(FMA(-6.0, x167*x168, FMA(sin_phi, sin_phi*sin_phi*sin_phi, cos_phi*cos_phi*cos_phi*cos_phi))); /* encoder-harmonic.c_4 */
        rows[63][i] = bar_sin_delta_phi*(FMA(-x251, x45, x250*x48)); /* encoder-harmonic.s_4 */
        rows[64][i] = -x228 - x252; /* fuel-gradient.G_xx */
        rows[65][i] = bar_spin_axis_tilt_Gamma_xy*fuel_mass; /* fuel-gradient.G_xy */
        rows[66][i] = bar_spin_axis_tilt_Gamma_xz*fuel_mass; /* fuel-gradient.G_xz */
        rows[67][i] = -x231 - x252; /* fuel-gradient.G_yy */
        rows[68][i] = bar_spin_axis_tilt_Gamma_yz*fuel_mass; /* fuel-gradient.G_yz */
        rows[69][i] = time*x162; /* gain-drift.dK1_dt */
        rows[70][i] = x162; /* gain-step.dK1 */
        rows[71][i] = -bar_M_xx - x253; /* gradient-offset.G_xx */
        rows[72][i] = bar_spin_axis_tilt_Gamma_xy; /* gradient-offset.G_xy */
        rows[73][i] = bar_spin_axis_tilt_Gamma_xz; /* gradient-offset.G_xz */
        rows[74][i] = -bar_M_yy - x253; /* gradient-offset.G_yy */
        rows[75][i] = bar_spin_axis_tilt_Gamma_yz; /* gradient-offset.G_yz */
        rows[76][i] = -bar_time_offset_omega_x; /* gyro-bias.b_x */
        rows[77][i] = -bar_time_offset_omega_y; /* gyro-bias.b_y */
        rows[78][i] = -bar_time_offset_omega_z; /* gyro-bias.b_z */
        rows[79][i] = x254; /* gyro-delay.delta_w */
        rows[80][i] = x255; /* gyro-delay.delta_d */
        rows[81][i] = FMA(-bar_time_offset_omegadot_x, d_a_x, -a_x*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xx */
        rows[82][i] = FMA(-bar_time_offset_omegadot_x, d_a_y, -a_y*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xy */
        rows[83][i] = FMA(-bar_time_offset_omegadot_x, d_a_z, -a_z*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xz */
        rows[84][i] = FMA(-bar_time_offset_omegadot_y, d_a_x, -a_x*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yx */
        rows[85][i] = FMA(-bar_time_offset_omegadot_y, d_a_y, -a_y*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yy */
        rows[86][i] = FMA(-bar_time_offset_omegadot_y, d_a_z, -a_z*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yz */
        rows[87][i] = FMA(-bar_time_offset_omegadot_z, d_a_x, -a_x*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zx */
        rows[88][i] = FMA(-bar_time_offset_omegadot_z, d_a_y, -a_y*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zy */
        rows[89][i] = FMA(-bar_time_offset_omegadot_z, d_a_z, -a_z*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zz */
        rows[90][i] = -x151; /* gyro-misalignment.m_xy */
        rows[91][i] = -x149; /* gyro-misalignment.m_xz */
        rows[92][i] = -x145; /* gyro-misalignment.m_yx */
        rows[93][i] = -x142; /* gyro-misalignment.m_yz */
        rows[94][i] = -x139; /* gyro-misalignment.m_zx */
        rows[95][i] = -x137; /* gyro-misalignment.m_zy */
        rows[96][i] = FMA(-bar_time_offset_omegadot_x, omegadot_x, -bar_time_offset_omega_x*omega_x); /* gyro-scale.s_x */
        rows[97][i] = FMA(-bar_time_offset_omegadot_y, omegadot_y, -bar_time_offset_omega_y*omega_y); /* gyro-scale.s_y */
        rows[98][i] = FMA(-bar_time_offset_omegadot_z, omegadot_z, -bar_time_offset_omega_z*omega_z); /* gyro-scale.s_z */
        rows[99][i] = -bar_time_offset_a_x; /* imu-acceleration-bias.b_x */
        rows[100][i] = -bar_time_offset_a_y; /* imu-acceleration-bias.b_y */
        rows[101][i] = -bar_time_offset_a_z; /* imu-acceleration-bias.b_z */
        rows[102][i] = -x150; /* imu-acceleration-misalignment.m_xy */
        rows[103][i] = x256; /* imu-acceleration-misalignment.m_xz */
        rows[104][i] = -x144; /* imu-acceleration-misalignment.m_yx */
        rows[105][i] = -x141; /* imu-acceleration-misalignment.m_yz */
        rows[106][i] = -x138; /* imu-acceleration-misalignment.m_zx */
        rows[107][i] = x257; /* imu-acceleration-misalignment.m_zy */
        rows[108][i] = -(a_x*a_x)*bar_time_offset_a_x; /* imu-acceleration-quadratic.q_x */
        rows[109][i] = -(a_y*a_y)*bar_time_offset_a_y; /* imu-acceleration-quadratic.q_y */
        rows[110][i] = -x258; /* imu-acceleration-scale.s_x */
        rows[111][i] = -x259; /* imu-acceleration-scale.s_y */
        rows[112][i] = -a_z*bar_time_offset_a_z; /* imu-acceleration-scale.s_z */
        rows[113][i] = FMA(-bar_time_offset_a_z, d2_a_z, FMA(-bar_time_offset_a_y, d2_a_y, -bar_time_offset_a_x*d2_a_x)); /* imu-filter.b_a */
        rows[114][i] = FMA(-bar_time_offset_omegadot_z, d2_omegadot_z, FMA(-bar_time_offset_omegadot_y, d2_omegadot_y, FMA(-bar_time_offset_omegadot_x, d2_omegadot_x, FMA(-bar_time_offset_omega_z, d_omegadot_z, FMA(-bar_time_offset_omega_y, d_omegadot_y, -bar_time_offset_omega_x*d_omegadot_x))))); /* imu-filter.b_w */
        rows[115][i] = FMA(bar_time_offset_a_z, (-x16 - x260), FMA(-bar_time_offset_a_y, x19, bar_time_offset_a_x*x12)); /* imu-lever-arm.l_x */
        rows[116][i] = FMA(-bar_time_offset_a_z, x27, FMA(bar_time_offset_a_y, x22, bar_time_offset_a_x*(omegadot_z - x14))); /* imu-lever-arm.l_y */
        rows[117][i] = FMA(bar_time_offset_a_z, x29, FMA(-bar_time_offset_a_x, x17, bar_time_offset_a_y*(omegadot_x - x24))); /* imu-lever-arm.l_z */
        rows[118][i] = -bar_imu_turn_yz + bar_imu_turn_zy; /* imu-misalignment.e_x */
        rows[119][i] = bar_imu_turn_xz - bar_imu_turn_zx; /* imu-misalignment.e_y */
        rows[120][i] = -bar_imu_turn_xy + bar_imu_turn_yx; /* imu-misalignment.e_z */
        rows[121][i] = x236; /* imu-skew.delta_x */
        rows[122][i] = x237; /* imu-skew.delta_y */
        rows[123][i] = bar_time_offset_a_x*x262; /* imu-thermal.db_x_dT */
        rows[124][i] = bar_time_offset_a_y*x262; /* imu-thermal.db_y_dT */
        rows[125][i] = -x258*x261; /* imu-thermal.ds_x_dT */
        rows[126][i] = -x259*x261; /* imu-thermal.ds_y_dT */
        rows[127][i] = bar_i_vibration_rectification*x263; /* inner-temperature.b */
        rows[128][i] = x162*x263; /* inner-temperature.s */
        rows[129][i] = C__heat_start*bar_i_vibration_rectification; /* inner-temperature.b_0 */
        rows[130][i] = C__heat_start*x162; /* inner-temperature.s_0 */
        rows[131][i] = 0.0; /* inner-temperature.tau */
        rows[132][i] = -bar_i_vibration_rectification*rate_f_f_i; /* lag.tau */
        rows[133][i] = bar_i_vibration_rectification*(FMA(B_y, f_tau_zy, FMA(B_x, f_tau_zx, -B_z))); /* magnetic-axial-bias.dK0_dBz */
        rows[134][i] = bar_i_vibration_rectification*(FMA(B_z, x116, FMA(B_y, x115, B_x*x114))); /* magnetic-bias.dK0_dB */
        rows[135][i] = x264*(FMA(B_y, f_tau_xy, B_x*f_tau_xx)); /* magnetic-scale.dK1_dB */
        rows[136][i] = bar_vartheta_y_thermal_misalignment*time; /* misalignment-drift.dvartheta_y_dt */
        rows[137][i] = bar_vartheta_y_thermal_misalignment; /* misalignment-step.dvartheta_y */
        rows[138][i] = b_f_xj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yx */
        rows[139][i] = b_f_yj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yy */
        rows[140][i] = b_f_zj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yz */
        rows[141][i] = b_f_xj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zx */
        rows[142][i] = b_f_yj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zy */
        rows[143][i] = b_f_zj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zz */
        rows[144][i] = bar_vartheta_y_thermal_misalignment*x265; /* mount-hysteresis.e_yx */
        rows[145][i] = -C__play_axial*bar_vartheta_y_thermal_misalignment; /* mount-hysteresis.e_yz */
        rows[146][i] = bar_vartheta_z_mount_hysteresis*x265; /* mount-hysteresis.e_zx */
        rows[147][i] = 0.0; /* mount-hysteresis.w */
        rows[148][i] = FMA(C__mount_omegadot_z, bar_time_offset_omegadot_z, FMA(C__mount_omegadot_y, bar_time_offset_omegadot_y, FMA(C__mount_omegadot_x, bar_time_offset_omegadot_x, FMA(C__mount_omega_z, bar_time_offset_omega_z, FMA(C__mount_omega_y, bar_time_offset_omega_y, FMA(C__mount_omega_x, bar_time_offset_omega_x, FMA(C__mount_a_z, bar_time_offset_a_z, FMA(C__mount_a_y, bar_time_offset_a_y, C__mount_a_x*bar_time_offset_a_x)))))))); /* mount-resonance.share */
        rows[149][i] = 0.0; /* mount-resonance.f_0 */
        rows[150][i] = 0.0; /* mount-resonance.Q */
        rows[151][i] = FMA(-bar_q_f_x, x267, FMA(bar_f_f_x, x271, x266)); /* near-mass.T_xxx */
        rows[152][i] = FMA(-q_r_x, x132, FMA(-f_r_x, x131, FMA(-bar_q_f_y, x267, FMA(bar_f_f_z, f_disc_r_z*f_r_y, bar_f_f_y*x271)))); /* near-mass.T_xxy */
        rows[153][i] = FMA(bar_q_p_second_order_misalignment, x267, FMA(bar_f_f_z, x271, -x272)); /* near-mass.T_xxz */
        rows[154][i] = FMA(-q_r_x, x128, FMA(-f_r_x, x127, FMA(-bar_q_f_x, x273, FMA(bar_f_f_z, f_disc_r_z*f_r_x, bar_f_f_x*x275)))); /* near-mass.T_xyy */
        rows[155][i] = FMA(-f_r_y, x130, FMA(-f_r_x, x123, FMA(bar_q_p_second_order_misalignment, q_r_x*q_r_y, -x276))); /* near-mass.T_xyz */
        rows[156][i] = FMA(f_r_y, x122, FMA(-bar_q_f_y, x273, bar_f_f_y*x275)); /* near-mass.T_yyy */
        rows[157][i] = FMA(-f_r_y, x126, FMA(bar_q_p_second_order_misalignment, x273, bar_f_f_z*x275)); /* near-mass.T_yyz */
        rows[158][i] = FMA(-bar_q_f_x, x277, FMA(-bar_f_f_z, x282, bar_f_f_x*x279)); /* near-mass.T_xxxx */
        rows[159][i] = FMA(-x132, x267, FMA(-bar_q_f_y, x277, FMA(bar_f_f_y, x279, FMA(bar_f_f_x, x285, x283)))); /* near-mass.T_xxxy */
        rows[160][i] = FMA(bar_q_p_second_order_misalignment, x277, FMA(bar_f_f_z, x279, bar_f_f_x*x282)); /* near-mass.T_xxxz */
        rows[161][i] = FMA(-x133, x273, FMA(-x128, x267, FMA(bar_f_f_z, FMA(-1.0/3.0, x280, FMA(f_disc_r_z, x270, x287)), FMA(bar_f_f_y, x285, bar_f_f_x*x286)))); /* near-mass.T_xxyy */
        rows[162][i] = FMA(x124, x267, FMA(-f_r_y, x272, FMA(bar_f_f_z, x285, bar_f_f_y*x282))); /* near-mass.T_xxyz */
        rows[163][i] = FMA(-x129, x273, FMA(-bar_q_f_x, x288, FMA(bar_f_f_y, x286, FMA(bar_f_f_x, x289, x283)))); /* near-mass.T_xyyy */
        rows[164][i] = FMA(x125, x273, FMA(-f_r_y, x276, FMA(bar_f_f_z, x286, bar_f_f_x*x290))); /* near-mass.T_xyyz */
        rows[165][i] = FMA(-bar_q_f_y, x288, FMA(-bar_f_f_z, x290, bar_f_f_y*x289)); /* near-mass.T_yyyy */
        rows[166][i] = FMA(bar_q_p_second_order_misalignment, x288, FMA(bar_f_f_z, x289, bar_f_f_y*x290)); /* near-mass.T_yyyz */
        rows[167][i] = x247*fabs(f_f_i); /* odd-quadratic.K_oq */
        rows[168][i] = -G_out*x264; /* output-curve.c_2 */
        rows[169][i] = -(G_out*G_out)*x264; /* output-curve.c_3 */
        rows[170][i] = x291; /* output-filter.b */
        rows[171][i] = x264; /* output-gain-step.g */
        rows[172][i] = bar_i_vibration_rectification*(FMA(f_tau_yy, (-x260 - x52), FMA(-beta_x, (d2_spin_angle + omegadot_z), f_tau_yx*(omegadot_x + x53)))); /* pendulum-angular.K_pa */
        rows[173][i] = bar_i_vibration_rectification*(FMA(-101325.0, (1.0), pressure)); /* pressure-bias.dK0_dp */
        rows[174][i] = bar_K2_thermal_second_order*time; /* second-order-drift.dK2_dt */
        rows[175][i] = x291; /* second-order-loop.b */
        rows[176][i] = FMA(bar_q_p_second_order_misalignment, (f_f_p + q_f_z), FMA(bar_q_o_second_order_misalignment, (f_f_o - q_f_yj), bar_q_i_second_order_misalignment*(f_f_i - q_f_xj))); /* second-order-misalignment.kappa */
        rows[177][i] = FMA(-bar_M_xx, x6, -x292); /* self-gradient.G_xx_roll */
        rows[178][i] = bar_spin_axis_tilt_Gamma_xy*x6; /* self-gradient.G_xy_roll */
        rows[179][i] = bar_spin_axis_tilt_Gamma_xz*x6; /* self-gradient.G_xz_roll */
        rows[180][i] = FMA(-bar_M_yy, x6, -x292); /* self-gradient.G_yy_roll */
        rows[181][i] = bar_spin_axis_tilt_Gamma_yz*x6; /* self-gradient.G_yz_roll */
        rows[182][i] = FMA(-bar_M_xx, x5, -x293); /* self-gradient.G_xx_pitch */
        rows[183][i] = bar_spin_axis_tilt_Gamma_xy*x5; /* self-gradient.G_xy_pitch */
        rows[184][i] = bar_spin_axis_tilt_Gamma_xz*x5; /* self-gradient.G_xz_pitch */
        rows[185][i] = FMA(-bar_M_yy, x5, -x293); /* self-gradient.G_yy_pitch */
        rows[186][i] = bar_spin_axis_tilt_Gamma_yz*x5; /* self-gradient.G_yz_pitch */
        rows[187][i] = FMA(-bar_M_yy, x294, FMA(-bar_M_xx, x295, 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw)); /* self-gradient-yaw.G_d */
        rows[188][i] = FMA(-x191, x296, FMA(x189, x296, bar_spin_axis_tilt_Gamma_xy*x295)); /* self-gradient-yaw.G_xy */
        rows[189][i] = FMA(bar_spin_axis_tilt_Gamma_yz, sin_yaw, bar_spin_axis_tilt_Gamma_xz*x297); /* self-gradient-yaw.G_xz */
        rows[190][i] = FMA(-bar_spin_axis_tilt_Gamma_xz, sin_yaw, bar_spin_axis_tilt_Gamma_yz*x297); /* self-gradient-yaw.G_yz */
        rows[191][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (-Gamma_yy - x298), FMA(bar_M_zz, x299, FMA(-bar_M_yy, x299, FMA(Gamma_xz, bar_spin_axis_tilt_Gamma_xy, FMA(-Gamma_xy, bar_spin_axis_tilt_Gamma_xz, -x135 - x136 + x143 + x257))))); /* spin-axis-tilt.alpha_x */
        rows[192][i] = FMA(bar_spin_axis_tilt_Gamma_xz, (Gamma_xx + x298), FMA(-bar_M_zz, x300, FMA(bar_M_xx, x300, FMA(-Gamma_yz, bar_spin_axis_tilt_Gamma_xy, FMA(Gamma_xy, bar_spin_axis_tilt_Gamma_yz, x140 - x147 - x148 + x256))))); /* spin-axis-tilt.alpha_y */
        rows[193][i] = FMA(bar_wobble_zy, cos_phi, FMA(-bar_wobble_zx, sin_phi, FMA(-bar_wobble_yz, cos_phi, bar_wobble_xz*sin_phi))); /* spin-axis-wobble.w_x */
        rows[194][i] = FMA(-bar_wobble_zy, sin_phi, FMA(-bar_wobble_zx, cos_phi, FMA(bar_wobble_yz, sin_phi, bar_wobble_xz*cos_phi))); /* spin-axis-wobble.w_y */
        rows[195][i] = bar_sin_delta_phi; /* spin-phase-offset.phi_0 */
        rows[196][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_phi */
        rows[197][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_walk */
        rows[198][i] = 2.0*bar_sin_delta_phi*time*x41; /* spin-rate-offset.epsilon */
        rows[199][i] = -bar_sin_delta_phi*omegadot_z; /* spin-servo.c */
        rows[200][i] = bar_i_vibration_rectification*x261; /* thermal-bias.dK0_dT */
        rows[201][i] = bar_i_vibration_rectification*d_temperature; /* thermal-lag.dK0_dTdot */
        rows[202][i] = d_temperature*x162; /* thermal-lag.dK1_dTdot */
        rows[203][i] = bar_vartheta_y_thermal_misalignment*x261; /* thermal-misalignment.dvartheta_y_dT */
        rows[204][i] = x162*x261; /* thermal-scale.dK1_dT */
        rows[205][i] = bar_K2_thermal_second_order*x261; /* thermal-second-order.dK2_dT */
        rows[206][i] = x236 + x237 + x238 + x254 + x255; /* time-offset.delta_t */
        rows[207][i] = bar_i_vibration_rectification*(FMA(x301, x310, FMA(x301, x309, FMA(x301, x308, FMA(x301, x307, FMA(x301, x305, x301*x303)))))); /* vibration-level.L_xx */
        rows[208][i] = bar_i_vibration_rectification*(FMA(x301, x325, FMA(x301, x323, FMA(x301, x321, FMA(x301, x319, FMA(x301, x317, FMA(x301, x316, FMA(x301, x314, FMA(x301, x313, x301*x311))))))))); /* vibration-level.L_xy */
        rows[209][i] = bar_i_vibration_rectification*(FMA(x301, x334, FMA(x301, x333, FMA(x301, x332, FMA(x301, x331, FMA(x301, x330, FMA(x301, x329, FMA(x301, x328, FMA(x301, x327, x301*x326))))))))); /* vibration-level.L_xz */
        rows[210][i] = bar_i_vibration_rectification*(FMA(x301, x343, FMA(x301, x342, FMA(x301, x341, FMA(x301, x340, FMA(x301, x338, x301*x336)))))); /* vibration-level.L_yy */
        rows[211][i] = bar_i_vibration_rectification*(FMA(x301, x355, FMA(x301, x354, FMA(x301, x353, FMA(x301, x352, FMA(x301, x350, FMA(x301, x349, FMA(x301, x347, FMA(x301, x346, x301*x344))))))))); /* vibration-level.L_yz */
        rows[212][i] = bar_i_vibration_rectification*(FMA(x301, x361, FMA(x301, x360, FMA(x301, x359, FMA(x301, x358, FMA(x301, x357, x301*x356)))))); /* vibration-level.L_zz */
        rows[213][i] = bar_i_vibration_rectification*(x303 + x305 + x307 + x308 + x309 + x310); /* vibration-rectification.P_xx */
        rows[214][i] = bar_i_vibration_rectification*(x311 + x313 + x314 + x316 + x317 + x319 + x321 + x323 + x325); /* vibration-rectification.P_xy */
        rows[215][i] = bar_i_vibration_rectification*(x326 + x327 + x328 + x329 + x330 + x331 + x332 + x333 + x334); /* vibration-rectification.P_xz */
        rows[216][i] = bar_i_vibration_rectification*(x336 + x338 + x340 + x341 + x342 + x343); /* vibration-rectification.P_yy */
        rows[217][i] = bar_i_vibration_rectification*(x344 + x346 + x347 + x349 + x350 + x352 + x353 + x354 + x355); /* vibration-rectification.P_yz */
        rows[218][i] = bar_i_vibration_rectification*(x356 + x357 + x358 + x359 + x360 + x361); /* vibration-rectification.P_zz */
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
