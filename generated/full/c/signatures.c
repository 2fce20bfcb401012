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

enum { ROWS = 218, STEP = 64, INPUTS = 68 };

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
    const double *restrict in_d2_spin_angle = in[52] + at;
    const double *restrict in_d_spin_angle = in[59] + at;
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
        const double x173 = C__rate_tangential*cos_j;
        const double x174 = C__rate_radial*sin_j;
        const double x175 = FMA(C__rate_tangential, sin_j, C__rate_radial*cos_j);
        const double x176 = C__curvature_tangential*cos_j;
        const double x177 = C__curvature_radial*sin_j;
        const double x178 = FMA(C__curvature_tangential, sin_j, C__curvature_radial*cos_j);
        const double x179 = (angular_vibration_rms*angular_vibration_rms);
        const double x180 = bar_M_yy*x179;
        const double x181 = bar_M_zz*x179;
        const double x182 = bar_M_xx*x179;
        const double x183 = K1*bar_K1_thermal_scale;
        const double x184 = bar_run_out_x*cos_phi;
        const double x185 = bar_run_out_y*cos_phi;
        const double x186 = bar_run_out_z*cos_phi;
        const double x187 = 2.0*cos_phi;
        const double x188 = 2.0*sin_phi;
        const double x189 = FMA(-rate_sin_phi_true, x188, rate_cos_phi_true*x187);
        const double x190 = (cos_phi*cos_phi);
        const double x191 = (sin_phi*sin_phi);
        const double x192 = x190 - x191;
        const double x193 = FMA(-2.0, rate_sin_phi_true*rate_sin_phi_true, FMA(-rate_rate_sin_phi_true, x188, FMA(rate_rate_cos_phi_true, x187, 2.0*rate_cos_phi_true*rate_cos_phi_true)));
        const double x194 = FMA(rate_sin_phi_true, x187, rate_cos_phi_true*x188);
        const double x195 = FMA(rate_rate_sin_phi_true, x187, FMA(rate_rate_cos_phi_true, x188, 4.0*rate_cos_phi_true*rate_sin_phi_true));
        const double x196 = (attitude_yx*attitude_yx);
        const double x197 = (attitude_yz*attitude_yz);
        const double x198 = attitude_xx*attitude_yx;
        const double x199 = attitude_xz*attitude_yz;
        const double x200 = -x199;
        const double x201 = attitude_xx*attitude_zx;
        const double x202 = attitude_xz*attitude_zz;
        const double x203 = -x202;
        const double x204 = attitude_yx*attitude_zx;
        const double x205 = attitude_yz*attitude_zz;
        const double x206 = -x205;
        const double x207 = (attitude_xz*attitude_xz);
        const double x208 = (attitude_xx*attitude_xx);
        const double x209 = (attitude_zx*attitude_zx);
        const double x210 = (attitude_zz*attitude_zz);
        const double x211 = (1.0) - x210;
        const double x212 = 2.0*bar_M_xx;
        const double x213 = attitude_xx*x212;
        const double x214 = 2.0*bar_M_yy;
        const double x215 = attitude_yx*x214;
        const double x216 = 2.0*attitude_zx;
        const double x217 = bar_M_zz*x216;
        const double x218 = attitude_xx*attitude_zy;
        const double x219 = attitude_xy*attitude_zx;
        const double x220 = attitude_yx*attitude_zy;
        const double x221 = attitude_yy*attitude_zx;
        const double x222 = attitude_xx*attitude_yy;
        const double x223 = attitude_xy*attitude_yx;
        const double x224 = attitude_xx*attitude_yz;
        const double x225 = attitude_xz*attitude_yx;
        const double x226 = attitude_yx*attitude_zz;
        const double x227 = attitude_yz*attitude_zx;
        const double x228 = attitude_xx*attitude_zz;
        const double x229 = attitude_xz*attitude_zx;
        const double x230 = (attitude_xy*attitude_xy);
        const double x231 = attitude_xy*attitude_yy;
        const double x232 = attitude_xy*attitude_zy;
        const double x233 = attitude_yy*attitude_zy;
        const double x234 = (attitude_yy*attitude_yy);
        const double x235 = (attitude_zy*attitude_zy);
        const double x236 = attitude_xy*attitude_xz;
        const double x237 = attitude_yy*attitude_yz;
        const double x238 = 2.0*attitude_zy*attitude_zz;
        const double x239 = attitude_xy*attitude_yz;
        const double x240 = attitude_xz*attitude_yy;
        const double x241 = attitude_xy*attitude_zz;
        const double x242 = attitude_xz*attitude_zy;
        const double x243 = attitude_yy*attitude_zz;
        const double x244 = attitude_yz*attitude_zy;
        const double x245 = -fuel_mass*x199;
        const double x246 = -fuel_mass*x202;
        const double x247 = -fuel_mass*x205;
        const double x248 = -fuel_mass*x207;
        const double x249 = -fuel_mass*x197;
        const double x250 = -fuel_mass*x210;
        const double x251 = bar_M_xx*fuel_mass;
        const double x252 = 2.0*x251;
        const double x253 = attitude_xx*x252;
        const double x254 = bar_M_yy*fuel_mass;
        const double x255 = 2.0*x254;
        const double x256 = attitude_yx*x255;
        const double x257 = bar_M_zz*fuel_mass;
        const double x258 = x216*x257;
        const double x259 = bar_time_offset_a_x*d_a_x;
        const double x260 = bar_time_offset_a_y*d_a_y;
        const double x261 = bar_time_offset_a_z*d_a_z;
        const double x262 = bar_time_offset_omega_x*omegadot_x;
        const double x263 = bar_time_offset_omega_y*omegadot_y;
        const double x264 = bar_time_offset_omega_z*omegadot_z;
        const double x265 = bar_time_offset_omegadot_x*d_omegadot_x;
        const double x266 = bar_time_offset_omegadot_y*d_omegadot_y;
        const double x267 = bar_time_offset_omegadot_z*d_omegadot_z;
        const double x268 = bar_i_vibration_rectification*(f_f_i*f_f_i);
        const double x269 = (f_f_o*f_f_o);
        const double x270 = bar_i_vibration_rectification*f_f_i;
        const double x271 = (f_f_p*f_f_p);
        const double x272 = bar_sin_delta_phi*cos_phi;
        const double x273 = bar_spin_rate_true*x38;
        const double x274 = 4.0*cos_phi;
        const double x275 = (cos_phi*cos_phi*cos_phi);
        const double x276 = (sin_phi*sin_phi*sin_phi);
        const double x277 = 9.0*x190;
        const double x278 = 9.0*x42;
        const double x279 = 3.0*x275;
        const double x280 = 9.0*x191;
        const double x281 = (cos_phi*cos_phi*cos_phi*cos_phi);
        const double x282 = (sin_phi*sin_phi*sin_phi*sin_phi);
        const double x283 = x190*x191;
        const double x284 = 16.0*x275;
        const double x285 = 16.0*x42;
        const double x286 = 4.0*d_spin_angle;
        const double x287 = 24.0*x283;
        const double x288 = 4.0*d2_spin_angle;
        const double x289 = -bar_M_zz*fuel_mass;
        const double x290 = -bar_M_zz;
        const double x291 = x262 + x263 + x264;
        const double x292 = x265 + x266 + x267;
        const double x293 = -x167;
        const double x294 = -x155;
        const double x295 = a_x*bar_time_offset_a_x;
        const double x296 = a_y*bar_time_offset_a_y;
        const double x297 = FMA(-293.15, (1.0), temperature);
        const double x298 = -x297;
        const double x299 = FMA(C__heat_tt, cos_j*cos_j, FMA(-2.0, C__heat_rt*cos_j*sin_j, C__heat_rr*sin_j*sin_j));
        const double x300 = bar_i_vibration_rectification*i_sensed;
        const double x301 = FMA(-C__play_radial, sin_j, C__play_tangential*cos_j);
        const double x302 = f_r_x*x139;
        const double x303 = 0.5*(q_r_x*q_r_x);
        const double x304 = 0.5*(f_disc_r_z*f_disc_r_z);
        const double x305 = (f_r_x*f_r_x);
        const double x306 = 0.5*x305;
        const double x307 = x304 - x306;
        const double x308 = f_r_x*x147;
        const double x309 = 0.5*(q_r_y*q_r_y);
        const double x310 = 0.5*(f_r_y*f_r_y);
        const double x311 = x304 - x310;
        const double x312 = f_r_x*x143;
        const double x313 = (1.0/6.0)*(q_r_x*q_r_x*q_r_x);
        const double x314 = f_r_x*x304;
        const double x315 = FMA(-1.0/6.0, f_r_x*f_r_x*f_r_x, x314);
        const double x316 = (f_disc_r_z*f_disc_r_z*f_disc_r_z);
        const double x317 = (1.0/6.0)*x316;
        const double x318 = FMA(-0.5, f_disc_r_z*x305, x317);
        const double x319 = f_r_y*x302;
        const double x320 = f_r_y*x304;
        const double x321 = FMA(-f_r_y, x306, x320);
        const double x322 = FMA(-f_r_x, x310, x314);
        const double x323 = f_disc_r_z*x310;
        const double x324 = (1.0/6.0)*(q_r_y*q_r_y*q_r_y);
        const double x325 = FMA(-1.0/6.0, f_r_y*f_r_y*f_r_y, x320);
        const double x326 = x317 - x323;
        const double x327 = bar_i_vibration_rectification*rate_rate_i_sensed;
        const double x328 = -bar_M_zz*x6;
        const double x329 = -bar_M_zz*x5;
        const double x330 = FMA(sin_yaw, sin_yaw, FMA(-cos_yaw, cos_yaw, (1.0)));
        const double x331 = -x330;
        const double x332 = cos_yaw*sin_yaw;
        const double x333 = cos_yaw - (1.0);
        const double x334 = -Gamma_zz;
        const double x335 = 2.0*Gamma_yz;
        const double x336 = 2.0*Gamma_xz;
        const double x337 = (vibration_rms*vibration_rms);
        const double x338 = K4*vibration_axis_ix;
        const double x339 = vibration_axis_px*x338;
        const double x340 = K6*vibration_axis_ix;
        const double x341 = vibration_axis_ox*x340;
        const double x342 = K8*vibration_axis_ox;
        const double x343 = vibration_axis_px*x342;
        const double x344 = K2*(vibration_axis_ix*vibration_axis_ix);
        const double x345 = K5*(vibration_axis_ox*vibration_axis_ox);
        const double x346 = K7*(vibration_axis_px*vibration_axis_px);
        const double x347 = vibration_axis_py*x338;
        const double x348 = K4*vibration_axis_px;
        const double x349 = vibration_axis_iy*x348;
        const double x350 = vibration_axis_oy*x340;
        const double x351 = K6*vibration_axis_ox;
        const double x352 = vibration_axis_iy*x351;
        const double x353 = vibration_axis_py*x342;
        const double x354 = K8*vibration_axis_px;
        const double x355 = vibration_axis_oy*x354;
        const double x356 = vibration_axis_ix*x112;
        const double x357 = vibration_axis_iy*x356;
        const double x358 = vibration_axis_ox*x113;
        const double x359 = vibration_axis_oy*x358;
        const double x360 = vibration_axis_px*x114;
        const double x361 = vibration_axis_py*x360;
        const double x362 = vibration_axis_pz*x338;
        const double x363 = vibration_axis_iz*x348;
        const double x364 = vibration_axis_oz*x340;
        const double x365 = vibration_axis_iz*x351;
        const double x366 = vibration_axis_pz*x342;
        const double x367 = vibration_axis_oz*x354;
        const double x368 = vibration_axis_iz*x356;
        const double x369 = vibration_axis_oz*x358;
        const double x370 = vibration_axis_pz*x360;
        const double x371 = K4*vibration_axis_iy;
        const double x372 = vibration_axis_py*x371;
        const double x373 = K6*vibration_axis_iy;
        const double x374 = vibration_axis_oy*x373;
        const double x375 = K8*vibration_axis_oy;
        const double x376 = vibration_axis_py*x375;
        const double x377 = K2*(vibration_axis_iy*vibration_axis_iy);
        const double x378 = K5*(vibration_axis_oy*vibration_axis_oy);
        const double x379 = K7*(vibration_axis_py*vibration_axis_py);
        const double x380 = vibration_axis_pz*x371;
        const double x381 = K4*vibration_axis_iz;
        const double x382 = vibration_axis_py*x381;
        const double x383 = vibration_axis_oz*x373;
        const double x384 = K6*vibration_axis_iz;
        const double x385 = vibration_axis_oy*x384;
        const double x386 = vibration_axis_pz*x375;
        const double x387 = K8*vibration_axis_oz;
        const double x388 = vibration_axis_py*x387;
        const double x389 = vibration_axis_iy*vibration_axis_iz*x112;
        const double x390 = vibration_axis_oy*vibration_axis_oz*x113;
        const double x391 = vibration_axis_py*vibration_axis_pz*x114;
        const double x392 = vibration_axis_pz*x381;
        const double x393 = vibration_axis_oz*x384;
        const double x394 = vibration_axis_pz*x387;
        const double x395 = K2*(vibration_axis_iz*vibration_axis_iz);
        const double x396 = K5*(vibration_axis_oz*vibration_axis_oz);
        const double x397 = K7*(vibration_axis_pz*vibration_axis_pz);

        rows[0][i] = bar_i_vibration_rectification*(FMA(-vartheta_z, FMA(beta_z, (x173 - x174), x175), FMA(beta_z, x175, FMA(-C__rate_axial, vartheta_y, -x173 + x174)))); /* accelerometer-resonance.u */
        rows[1][i] = bar_i_vibration_rectification*(FMA(-vartheta_z, FMA(beta_z, (x176 - x177), x178), FMA(beta_z, x178, FMA(-C__curvature_axial, vartheta_y, -x176 + x177)))); /* accelerometer-resonance.v */
        rows[2][i] = 0.0; /* accelerometer-resonance.f_0 */
        rows[3][i] = 0.0; /* accelerometer-resonance.Q */
        rows[4][i] = bar_i_vibration_rectification*((double)((i_sensed) > 0.0) - (double)((i_sensed) < 0.0)); /* adc-nonlinearity.h */
        rows[5][i] = -x180 - x181; /* angular-jitter.W_xx */
        rows[6][i] = -bar_spin_axis_tilt_Gamma_xy*x179; /* angular-jitter.W_xy */
        rows[7][i] = -bar_spin_axis_tilt_Gamma_xz*x179; /* angular-jitter.W_xz */
        rows[8][i] = -x181 - x182; /* angular-jitter.W_yy */
        rows[9][i] = -bar_spin_axis_tilt_Gamma_yz*x179; /* angular-jitter.W_yz */
        rows[10][i] = -x180 - x182; /* angular-jitter.W_zz */
        rows[11][i] = bar_i_vibration_rectification*(FMA(f_tau_xy, omega_y, f_tau_xx*omega_x))*(FMA(f_tau_zy, omega_y, FMA(f_tau_zx, omega_x, -x11))); /* anisoinertia.K_ip */
        rows[12][i] = bar_dR_arm_stretch; /* arm-length.delta_R */
        rows[13][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_zj, FMA(bar_rate_dR_arm_stretch, rate_b_f_zj, b_f_zj*bar_dR_arm_stretch)); /* arm-sag.c_z */
        rows[14][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_yj, FMA(bar_rate_dR_arm_stretch, rate_b_f_yj, b_f_yj*bar_dR_arm_stretch)); /* arm-stretch.c_r */
        rows[15][i] = balance_current*x183; /* balancing-loop.dK1_di */
        rows[16][i] = FMA(bar_rate_run_out_x, rate_cos_phi_true, FMA(bar_rate_rate_run_out_x, rate_rate_cos_phi_true, x184)); /* bearing-run-out.c_x1 */
        rows[17][i] = FMA(bar_run_out_x, sin_phi, FMA(bar_rate_run_out_x, rate_sin_phi_true, bar_rate_rate_run_out_x*rate_rate_sin_phi_true)); /* bearing-run-out.s_x1 */
        rows[18][i] = FMA(bar_rate_run_out_y, rate_cos_phi_true, FMA(bar_rate_rate_run_out_y, rate_rate_cos_phi_true, x185)); /* bearing-run-out.c_y1 */
        rows[19][i] = FMA(bar_run_out_y, sin_phi, FMA(bar_rate_run_out_y, rate_sin_phi_true, bar_rate_rate_run_out_y*rate_rate_sin_phi_true)); /* bearing-run-out.s_y1 */
        rows[20][i] = FMA(bar_rate_run_out_z, rate_cos_phi_true, FMA(bar_rate_rate_run_out_z, rate_rate_cos_phi_true, x186)); /* bearing-run-out.c_z1 */
        rows[21][i] = FMA(bar_run_out_z, sin_phi, FMA(bar_rate_run_out_z, rate_sin_phi_true, bar_rate_rate_run_out_z*rate_rate_sin_phi_true)); /* bearing-run-out.s_z1 */
        rows[22][i] = FMA(bar_run_out_x, x192, FMA(bar_rate_run_out_x, x189, bar_rate_rate_run_out_x*x193)); /* bearing-run-out.c_x2 */
        rows[23][i] = FMA(x184, x188, FMA(bar_rate_run_out_x, x194, bar_rate_rate_run_out_x*x195)); /* bearing-run-out.s_x2 */
        rows[24][i] = FMA(bar_run_out_y, x192, FMA(bar_rate_run_out_y, x189, bar_rate_rate_run_out_y*x193)); /* bearing-run-out.c_y2 */
        rows[25][i] = FMA(x185, x188, FMA(bar_rate_run_out_y, x194, bar_rate_rate_run_out_y*x195)); /* bearing-run-out.s_y2 */
        rows[26][i] = FMA(bar_run_out_z, x192, FMA(bar_rate_run_out_z, x189, bar_rate_rate_run_out_z*x193)); /* bearing-run-out.c_z2 */
        rows[27][i] = FMA(x186, x188, FMA(bar_rate_run_out_z, x194, bar_rate_rate_run_out_z*x195)); /* bearing-run-out.s_z2 */
        rows[28][i] = bar_i_vibration_rectification*time; /* bias-drift.dK0_dt */
        rows[29][i] = bar_i_vibration_rectification*(FMA(-C__slip_radial, sin_j, C__slip_tangential*cos_j)); /* bias-hysteresis.h_i */
        rows[30][i] = bar_i_vibration_rectification*(FMA(C__slip_tangential, sin_j, C__slip_radial*cos_j)); /* bias-hysteresis.h_o */
        rows[31][i] = -C__slip_axial*bar_i_vibration_rectification; /* bias-hysteresis.h_p */
        rows[32][i] = 0.0; /* bias-hysteresis.w */
        rows[33][i] = bar_i_vibration_rectification; /* bias-step.dK0 */
        rows[34][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x204 + x206), FMA(bar_spin_axis_tilt_Gamma_xz, (x201 + x203), FMA(-bar_M_zz, (x209 + x211), FMA(-bar_M_yy, (x196 - x197), FMA(-bar_M_xx, (-x207 + x208 - (1.0)), bar_spin_axis_tilt_Gamma_xy*(x198 + x200)))))); /* carrier-gradient.G_xx */
        rows[35][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x220 + x221), FMA(bar_spin_axis_tilt_Gamma_xz, (x218 + x219), FMA(-attitude_zy, x217, FMA(-attitude_yy, x215, FMA(-attitude_xy, x213, bar_spin_axis_tilt_Gamma_xy*(x222 + x223 - (1.0))))))); /* carrier-gradient.G_xy */
        rows[36][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x226 + x227), FMA(bar_spin_axis_tilt_Gamma_xz, (x228 + x229 - (1.0)), FMA(-attitude_zz, x217, FMA(-attitude_yz, x215, FMA(-attitude_xz, x213, bar_spin_axis_tilt_Gamma_xy*(x224 + x225)))))); /* carrier-gradient.G_xz */
        rows[37][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (x206 + x233), FMA(bar_spin_axis_tilt_Gamma_xz, (x203 + x232), FMA(-bar_M_zz, (x211 + x235), FMA(-bar_M_yy, (-x197 + x234 - (1.0)), FMA(-bar_M_xx, (-x207 + x230), bar_spin_axis_tilt_Gamma_xy*(x200 + x231)))))); /* carrier-gradient.G_yy */
        rows[38][i] = FMA(-x214, x237, FMA(-x212, x236, FMA(bar_spin_axis_tilt_Gamma_yz, (x243 + x244 - (1.0)), FMA(bar_spin_axis_tilt_Gamma_xz, (x241 + x242), FMA(-bar_M_zz, x238, bar_spin_axis_tilt_Gamma_xy*(x239 + x240)))))); /* carrier-gradient.G_yz */
        rows[39][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x204, x247), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x201, x246), FMA(-bar_M_zz, FMA(fuel_mass, x209, x250), FMA(-bar_M_yy, FMA(fuel_mass, x196, x249), FMA(-bar_M_xx, FMA(fuel_mass, x208, x248), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x198, x245)))))); /* carrier-gradient.F_xx */
        rows[40][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x221, fuel_mass*x220), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x219, fuel_mass*x218), FMA(-attitude_zy, x258, FMA(-attitude_yy, x256, FMA(-attitude_xy, x253, bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x223, fuel_mass*x222)))))); /* carrier-gradient.F_xy */
        rows[41][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x227, fuel_mass*x226), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x229, fuel_mass*x228), FMA(-attitude_zz, x258, FMA(-attitude_yz, x256, FMA(-attitude_xz, x253, bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x225, fuel_mass*x224)))))); /* carrier-gradient.F_xz */
        rows[42][i] = FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x233, x247), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x232, x246), FMA(-bar_M_zz, FMA(fuel_mass, x235, x250), FMA(-bar_M_yy, FMA(fuel_mass, x234, x249), FMA(-bar_M_xx, FMA(fuel_mass, x230, x248), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x231, x245)))))); /* carrier-gradient.F_yy */
        rows[43][i] = FMA(-x238, x257, FMA(-x237, x255, FMA(-x236, x252, FMA(bar_spin_axis_tilt_Gamma_yz, FMA(fuel_mass, x244, fuel_mass*x243), FMA(bar_spin_axis_tilt_Gamma_xz, FMA(fuel_mass, x242, fuel_mass*x241), bar_spin_axis_tilt_Gamma_xy*FMA(fuel_mass, x240, fuel_mass*x239)))))); /* carrier-gradient.F_yz */
        rows[44][i] = FMA(time, x267, FMA(time, x266, FMA(time, x265, FMA(time, x264, FMA(time, x263, FMA(time, x262, FMA(time, x261, FMA(time, x260, time*x259)))))))); /* clock-drift.epsilon */
        rows[45][i] = f_f_o*x268; /* cubic-cross.K_iio */
        rows[46][i] = f_f_p*x268; /* cubic-cross.K_iip */
        rows[47][i] = x269*x270; /* cubic-cross.K_ioo */
        rows[48][i] = f_f_o*f_f_p*x270; /* cubic-cross.K_iop */
        rows[49][i] = x270*x271; /* cubic-cross.K_ipp */
        rows[50][i] = bar_i_vibration_rectification*(f_f_o*f_f_o*f_f_o); /* cubic-cross.K_ooo */
        rows[51][i] = bar_i_vibration_rectification*f_f_p*x269; /* cubic-cross.K_oop */
        rows[52][i] = bar_i_vibration_rectification*f_f_o*x271; /* cubic-cross.K_opp */
        rows[53][i] = bar_i_vibration_rectification*(f_f_p*f_f_p*f_f_p); /* cubic-cross.K_ppp */
        rows[54][i] = bar_i_vibration_rectification*(f_f_i*f_f_i*f_f_i); /* cubic-input.K_iii */
        rows[55][i] = FMA(bar_spin_acceleration_true, x44, x272 - x273); /* encoder-harmonic.c_1 */
        rows[56][i] = FMA(bar_spin_rate_true, x40, FMA(bar_spin_acceleration_true, x47, bar_sin_delta_phi*sin_phi)); /* encoder-harmonic.s_1 */
        rows[57][i] = FMA(-x273, x274, FMA(bar_spin_acceleration_true, FMA(-x274, x41, FMA(-4.0, x190*x42, 4.0*x191*x42)), bar_sin_delta_phi*x192)); /* encoder-harmonic.c_2 */
        rows[58][i] = FMA(x188, x272, FMA(bar_spin_rate_true, FMA(-x191, x51, x190*x51), bar_spin_acceleration_true*FMA(-x191, x66, FMA(-8.0, sin_phi*x43, 2.0*d2_spin_angle*x190)))); /* encoder-harmonic.s_2 */
        rows[59][i] = FMA(bar_spin_rate_true, FMA(-x277, x38, 3.0*d_spin_angle*x276), FMA(bar_spin_acceleration_true, FMA(-x277, x41, FMA(-x275, x278, FMA(3.0, d2_spin_angle*x276, 27.0*cos_phi*x191*x42))), bar_sin_delta_phi*FMA(-3.0, cos_phi*x191, x275))); /* encoder-harmonic.c_3 */
        rows[60][i] = FMA(bar_spin_rate_true, FMA(-x280, x40, d_spin_angle*x279), FMA(bar_spin_acceleration_true, FMA(-x280, x45, FMA(x276, x278, FMA(-27.0, x190*x46, d2_spin_angle*x279))), bar_sin_delta_phi*FMA(3.0, sin_phi*x190, -x276))); /* encoder-harmonic.s_3 */
        rows[61][i] = FMA(bar_spin_rate_true, FMA(-x284, x38, 16.0*cos_phi*d_spin_angle*x276), FMA(bar_spin_acceleration_true, FMA(-x284, x41, FMA(-x282, x285, FMA(-x281, x285, FMA(96.0, x190*x191*x42, 16.0*cos_phi*d2_spin_angle*x276)))), bar_sin_delta_phi*FMA(-6.0, x283, x281 + x282))); /* encoder-harmonic.c_4 */
        rows[62][i] = FMA(bar_spin_rate_true, FMA(x282, x286, FMA(-d_spin_angle, x287, x281*x286)), FMA(bar_spin_acceleration_true, FMA(x282, x288, FMA(x281, x288, FMA(-64.0, x275*x46, FMA(-d2_spin_angle, x287, 64.0*x276*x43)))), bar_sin_delta_phi*FMA(-x274, x276, 4.0*sin_phi*x275))); /* encoder-harmonic.s_4 */
        rows[63][i] = -x251 - x289; /* fuel-gradient.G_xx */
        rows[64][i] = bar_spin_axis_tilt_Gamma_xy*fuel_mass; /* fuel-gradient.G_xy */
        rows[65][i] = bar_spin_axis_tilt_Gamma_xz*fuel_mass; /* fuel-gradient.G_xz */
        rows[66][i] = -x254 - x289; /* fuel-gradient.G_yy */
        rows[67][i] = bar_spin_axis_tilt_Gamma_yz*fuel_mass; /* fuel-gradient.G_yz */
        rows[68][i] = time*x183; /* gain-drift.dK1_dt */
        rows[69][i] = x183; /* gain-step.dK1 */
        rows[70][i] = -bar_M_xx - x290; /* gradient-offset.G_xx */
        rows[71][i] = bar_spin_axis_tilt_Gamma_xy; /* gradient-offset.G_xy */
        rows[72][i] = bar_spin_axis_tilt_Gamma_xz; /* gradient-offset.G_xz */
        rows[73][i] = -bar_M_yy - x290; /* gradient-offset.G_yy */
        rows[74][i] = bar_spin_axis_tilt_Gamma_yz; /* gradient-offset.G_yz */
        rows[75][i] = -bar_time_offset_omega_x; /* gyro-bias.b_x */
        rows[76][i] = -bar_time_offset_omega_y; /* gyro-bias.b_y */
        rows[77][i] = -bar_time_offset_omega_z; /* gyro-bias.b_z */
        rows[78][i] = x291; /* gyro-delay.delta_w */
        rows[79][i] = x292; /* gyro-delay.delta_d */
        rows[80][i] = FMA(-bar_time_offset_omegadot_x, d_a_x, -a_x*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xx */
        rows[81][i] = FMA(-bar_time_offset_omegadot_x, d_a_y, -a_y*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xy */
        rows[82][i] = FMA(-bar_time_offset_omegadot_x, d_a_z, -a_z*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xz */
        rows[83][i] = FMA(-bar_time_offset_omegadot_y, d_a_x, -a_x*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yx */
        rows[84][i] = FMA(-bar_time_offset_omegadot_y, d_a_y, -a_y*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yy */
        rows[85][i] = FMA(-bar_time_offset_omegadot_y, d_a_z, -a_z*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yz */
        rows[86][i] = FMA(-bar_time_offset_omegadot_z, d_a_x, -a_x*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zx */
        rows[87][i] = FMA(-bar_time_offset_omegadot_z, d_a_y, -a_y*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zy */
        rows[88][i] = FMA(-bar_time_offset_omegadot_z, d_a_z, -a_z*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zz */
        rows[89][i] = -x172; /* gyro-misalignment.m_xy */
        rows[90][i] = -x170; /* gyro-misalignment.m_xz */
        rows[91][i] = -x166; /* gyro-misalignment.m_yx */
        rows[92][i] = -x163; /* gyro-misalignment.m_yz */
        rows[93][i] = -x160; /* gyro-misalignment.m_zx */
        rows[94][i] = -x158; /* gyro-misalignment.m_zy */
        rows[95][i] = FMA(-bar_time_offset_omegadot_x, omegadot_x, -bar_time_offset_omega_x*omega_x); /* gyro-scale.s_x */
        rows[96][i] = FMA(-bar_time_offset_omegadot_y, omegadot_y, -bar_time_offset_omega_y*omega_y); /* gyro-scale.s_y */
        rows[97][i] = FMA(-bar_time_offset_omegadot_z, omegadot_z, -bar_time_offset_omega_z*omega_z); /* gyro-scale.s_z */
        rows[98][i] = -bar_time_offset_a_x; /* imu-acceleration-bias.b_x */
        rows[99][i] = -bar_time_offset_a_y; /* imu-acceleration-bias.b_y */
        rows[100][i] = -bar_time_offset_a_z; /* imu-acceleration-bias.b_z */
        rows[101][i] = -x171; /* imu-acceleration-misalignment.m_xy */
        rows[102][i] = x293; /* imu-acceleration-misalignment.m_xz */
        rows[103][i] = -x165; /* imu-acceleration-misalignment.m_yx */
        rows[104][i] = -x162; /* imu-acceleration-misalignment.m_yz */
        rows[105][i] = -x159; /* imu-acceleration-misalignment.m_zx */
        rows[106][i] = x294; /* imu-acceleration-misalignment.m_zy */
        rows[107][i] = -(a_x*a_x)*bar_time_offset_a_x; /* imu-acceleration-quadratic.q_x */
        rows[108][i] = -(a_y*a_y)*bar_time_offset_a_y; /* imu-acceleration-quadratic.q_y */
        rows[109][i] = -x295; /* imu-acceleration-scale.s_x */
        rows[110][i] = -x296; /* imu-acceleration-scale.s_y */
        rows[111][i] = -a_z*bar_time_offset_a_z; /* imu-acceleration-scale.s_z */
        rows[112][i] = FMA(-bar_time_offset_a_z, d2_a_z, FMA(-bar_time_offset_a_y, d2_a_y, -bar_time_offset_a_x*d2_a_x)); /* imu-filter.b_a */
        rows[113][i] = FMA(-bar_time_offset_omegadot_z, d2_omegadot_z, FMA(-bar_time_offset_omegadot_y, d2_omegadot_y, FMA(-bar_time_offset_omegadot_x, d2_omegadot_x, FMA(-bar_time_offset_omega_z, d_omegadot_z, FMA(-bar_time_offset_omega_y, d_omegadot_y, -bar_time_offset_omega_x*d_omegadot_x))))); /* imu-filter.b_w */
        rows[114][i] = FMA(bar_time_offset_a_z, (-x125 - x17), FMA(-bar_time_offset_a_y, x20, bar_time_offset_a_x*x137)); /* imu-lever-arm.l_x */
        rows[115][i] = FMA(-bar_time_offset_a_z, x130, FMA(bar_time_offset_a_y, x134, bar_time_offset_a_x*(omegadot_z - x15))); /* imu-lever-arm.l_y */
        rows[116][i] = FMA(bar_time_offset_a_z, x27, FMA(-bar_time_offset_a_x, x126, bar_time_offset_a_y*(-x128 - x26))); /* imu-lever-arm.l_z */
        rows[117][i] = -bar_imu_turn_yz + bar_imu_turn_zy; /* imu-misalignment.e_x */
        rows[118][i] = bar_imu_turn_xz - bar_imu_turn_zx; /* imu-misalignment.e_y */
        rows[119][i] = -bar_imu_turn_xy + bar_imu_turn_yx; /* imu-misalignment.e_z */
        rows[120][i] = x259; /* imu-skew.delta_x */
        rows[121][i] = x260; /* imu-skew.delta_y */
        rows[122][i] = bar_time_offset_a_x*x298; /* imu-thermal.db_x_dT */
        rows[123][i] = bar_time_offset_a_y*x298; /* imu-thermal.db_y_dT */
        rows[124][i] = -x295*x297; /* imu-thermal.ds_x_dT */
        rows[125][i] = -x296*x297; /* imu-thermal.ds_y_dT */
        rows[126][i] = bar_i_vibration_rectification*x299; /* inner-temperature.b */
        rows[127][i] = x183*x299; /* inner-temperature.s */
        rows[128][i] = C__heat_start*bar_i_vibration_rectification; /* inner-temperature.b_0 */
        rows[129][i] = C__heat_start*x183; /* inner-temperature.s_0 */
        rows[130][i] = 0.0; /* inner-temperature.tau */
        rows[131][i] = -bar_i_vibration_rectification*rate_f_f_i; /* lag.tau */
        rows[132][i] = bar_i_vibration_rectification*(FMA(B_y, f_tau_zy, FMA(B_x, f_tau_zx, -B_z))); /* magnetic-axial-bias.dK0_dBz */
        rows[133][i] = bar_i_vibration_rectification*(FMA(B_z, x120, FMA(B_y, x119, B_x*x118))); /* magnetic-bias.dK0_dB */
        rows[134][i] = x300*(FMA(B_y, f_tau_xy, B_x*f_tau_xx)); /* magnetic-scale.dK1_dB */
        rows[135][i] = bar_vartheta_y_thermal_misalignment*time; /* misalignment-drift.dvartheta_y_dt */
        rows[136][i] = bar_vartheta_y_thermal_misalignment; /* misalignment-step.dvartheta_y */
        rows[137][i] = b_f_xj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yx */
        rows[138][i] = b_f_yj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yy */
        rows[139][i] = b_f_zj*bar_vartheta_y_thermal_misalignment; /* mount-compliance.c_yz */
        rows[140][i] = b_f_xj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zx */
        rows[141][i] = b_f_yj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zy */
        rows[142][i] = b_f_zj*bar_vartheta_z_mount_hysteresis; /* mount-compliance.c_zz */
        rows[143][i] = bar_vartheta_y_thermal_misalignment*x301; /* mount-hysteresis.e_yx */
        rows[144][i] = -C__play_axial*bar_vartheta_y_thermal_misalignment; /* mount-hysteresis.e_yz */
        rows[145][i] = bar_vartheta_z_mount_hysteresis*x301; /* mount-hysteresis.e_zx */
        rows[146][i] = 0.0; /* mount-hysteresis.w */
        rows[147][i] = FMA(C__mount_omegadot_z, bar_time_offset_omegadot_z, FMA(C__mount_omegadot_y, bar_time_offset_omegadot_y, FMA(C__mount_omegadot_x, bar_time_offset_omegadot_x, FMA(C__mount_omega_z, bar_time_offset_omega_z, FMA(C__mount_omega_y, bar_time_offset_omega_y, FMA(C__mount_omega_x, bar_time_offset_omega_x, FMA(C__mount_a_z, bar_time_offset_a_z, FMA(C__mount_a_y, bar_time_offset_a_y, C__mount_a_x*bar_time_offset_a_x)))))))); /* mount-resonance.share */
        rows[148][i] = 0.0; /* mount-resonance.f_0 */
        rows[149][i] = 0.0; /* mount-resonance.Q */
        rows[150][i] = FMA(-bar_q_f_x, x303, FMA(bar_f_f_x, x307, x302)); /* near-mass.T_xxx */
        rows[151][i] = FMA(-q_r_x, x149, FMA(-f_r_x, x148, FMA(-bar_q_f_y, x303, FMA(bar_f_f_z, f_disc_r_z*f_r_y, bar_f_f_y*x307)))); /* near-mass.T_xxy */
        rows[152][i] = FMA(bar_q_p_second_order_misalignment, x303, FMA(bar_f_f_z, x307, -x308)); /* near-mass.T_xxz */
        rows[153][i] = FMA(-q_r_x, x145, FMA(-f_r_x, x144, FMA(-bar_q_f_x, x309, FMA(bar_f_f_z, f_disc_r_z*f_r_x, bar_f_f_x*x311)))); /* near-mass.T_xyy */
        rows[154][i] = FMA(-f_r_y, x147, FMA(-f_r_x, x140, FMA(bar_q_p_second_order_misalignment, q_r_x*q_r_y, -x312))); /* near-mass.T_xyz */
        rows[155][i] = FMA(f_r_y, x139, FMA(-bar_q_f_y, x309, bar_f_f_y*x311)); /* near-mass.T_yyy */
        rows[156][i] = FMA(-f_r_y, x143, FMA(bar_q_p_second_order_misalignment, x309, bar_f_f_z*x311)); /* near-mass.T_yyz */
        rows[157][i] = FMA(-bar_q_f_x, x313, FMA(-bar_f_f_z, x318, bar_f_f_x*x315)); /* near-mass.T_xxxx */
        rows[158][i] = FMA(-x149, x303, FMA(-bar_q_f_y, x313, FMA(bar_f_f_y, x315, FMA(bar_f_f_x, x321, x319)))); /* near-mass.T_xxxy */
        rows[159][i] = FMA(bar_q_p_second_order_misalignment, x313, FMA(bar_f_f_z, x315, bar_f_f_x*x318)); /* near-mass.T_xxxz */
        rows[160][i] = FMA(-x150, x309, FMA(-x145, x303, FMA(bar_f_f_z, FMA(-1.0/3.0, x316, FMA(f_disc_r_z, x306, x323)), FMA(bar_f_f_y, x321, bar_f_f_x*x322)))); /* near-mass.T_xxyy */
        rows[161][i] = FMA(x141, x303, FMA(-f_r_y, x308, FMA(bar_f_f_z, x321, bar_f_f_y*x318))); /* near-mass.T_xxyz */
        rows[162][i] = FMA(-x146, x309, FMA(-bar_q_f_x, x324, FMA(bar_f_f_y, x322, FMA(bar_f_f_x, x325, x319)))); /* near-mass.T_xyyy */
        rows[163][i] = FMA(x142, x309, FMA(-f_r_y, x312, FMA(bar_f_f_z, x322, bar_f_f_x*x326))); /* near-mass.T_xyyz */
        rows[164][i] = FMA(-bar_q_f_y, x324, FMA(-bar_f_f_z, x326, bar_f_f_y*x325)); /* near-mass.T_yyyy */
        rows[165][i] = FMA(bar_q_p_second_order_misalignment, x324, FMA(bar_f_f_z, x325, bar_f_f_y*x326)); /* near-mass.T_yyyz */
        rows[166][i] = x270*fabs(f_f_i); /* odd-quadratic.K_oq */
        rows[167][i] = -G_out*x300; /* output-curve.c_2 */
        rows[168][i] = -(G_out*G_out)*x300; /* output-curve.c_3 */
        rows[169][i] = x327; /* output-filter.b */
        rows[170][i] = x300; /* output-gain-step.g */
        rows[171][i] = bar_i_vibration_rectification*(FMA(-f_tau_yy, x19, FMA(-beta_x, x14, f_tau_yx*x24))); /* pendulum-angular.K_pa */
        rows[172][i] = bar_i_vibration_rectification*(FMA(-101325.0, (1.0), pressure)); /* pressure-bias.dK0_dp */
        rows[173][i] = bar_K2_thermal_second_order*time; /* second-order-drift.dK2_dt */
        rows[174][i] = x327; /* second-order-loop.b */
        rows[175][i] = FMA(bar_q_p_second_order_misalignment, (f_f_p + q_f_z), FMA(bar_q_o_second_order_misalignment, (f_f_o - q_f_yj), bar_q_i_second_order_misalignment*(f_f_i - q_f_xj))); /* second-order-misalignment.kappa */
        rows[176][i] = FMA(-bar_M_xx, x6, -x328); /* self-gradient.G_xx_roll */
        rows[177][i] = bar_spin_axis_tilt_Gamma_xy*x6; /* self-gradient.G_xy_roll */
        rows[178][i] = bar_spin_axis_tilt_Gamma_xz*x6; /* self-gradient.G_xz_roll */
        rows[179][i] = FMA(-bar_M_yy, x6, -x328); /* self-gradient.G_yy_roll */
        rows[180][i] = bar_spin_axis_tilt_Gamma_yz*x6; /* self-gradient.G_yz_roll */
        rows[181][i] = FMA(-bar_M_xx, x5, -x329); /* self-gradient.G_xx_pitch */
        rows[182][i] = bar_spin_axis_tilt_Gamma_xy*x5; /* self-gradient.G_xy_pitch */
        rows[183][i] = bar_spin_axis_tilt_Gamma_xz*x5; /* self-gradient.G_xz_pitch */
        rows[184][i] = FMA(-bar_M_yy, x5, -x329); /* self-gradient.G_yy_pitch */
        rows[185][i] = bar_spin_axis_tilt_Gamma_yz*x5; /* self-gradient.G_yz_pitch */
        rows[186][i] = FMA(-bar_M_yy, x330, FMA(-bar_M_xx, x331, 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw)); /* self-gradient-yaw.G_d */
        rows[187][i] = FMA(-x214, x332, FMA(x212, x332, bar_spin_axis_tilt_Gamma_xy*x331)); /* self-gradient-yaw.G_xy */
        rows[188][i] = FMA(bar_spin_axis_tilt_Gamma_yz, sin_yaw, bar_spin_axis_tilt_Gamma_xz*x333); /* self-gradient-yaw.G_xz */
        rows[189][i] = FMA(-bar_spin_axis_tilt_Gamma_xz, sin_yaw, bar_spin_axis_tilt_Gamma_yz*x333); /* self-gradient-yaw.G_yz */
        rows[190][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (-Gamma_yy - x334), FMA(bar_M_zz, x335, FMA(-bar_M_yy, x335, FMA(Gamma_xz, bar_spin_axis_tilt_Gamma_xy, FMA(-Gamma_xy, bar_spin_axis_tilt_Gamma_xz, -x156 - x157 + x164 + x294))))); /* spin-axis-tilt.alpha_x */
        rows[191][i] = FMA(bar_spin_axis_tilt_Gamma_xz, (Gamma_xx + x334), FMA(-bar_M_zz, x336, FMA(bar_M_xx, x336, FMA(-Gamma_yz, bar_spin_axis_tilt_Gamma_xy, FMA(Gamma_xy, bar_spin_axis_tilt_Gamma_yz, x161 - x168 - x169 + x293))))); /* spin-axis-tilt.alpha_y */
        rows[192][i] = FMA(bar_wobble_zy, cos_phi, FMA(-bar_wobble_zx, sin_phi, FMA(-bar_wobble_yz, cos_phi, bar_wobble_xz*sin_phi))); /* spin-axis-wobble.w_x */
        rows[193][i] = FMA(-bar_wobble_zy, sin_phi, FMA(-bar_wobble_zx, cos_phi, FMA(bar_wobble_yz, sin_phi, bar_wobble_xz*cos_phi))); /* spin-axis-wobble.w_y */
        rows[194][i] = bar_sin_delta_phi; /* spin-phase-offset.phi_0 */
        rows[195][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_phi */
        rows[196][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_walk */
        rows[197][i] = FMA(bar_spin_rate_true, FMA(d2_spin_angle, time, d_spin_angle), FMA(bar_spin_acceleration_true, x66, bar_sin_delta_phi*d_spin_angle*time)); /* spin-rate-offset.epsilon */
        rows[198][i] = FMA(-bar_spin_rate_true, d_omegadot_z, FMA(-bar_spin_acceleration_true, d2_omegadot_z, -bar_sin_delta_phi*omegadot_z)); /* spin-servo.c */
        rows[199][i] = bar_i_vibration_rectification*x297; /* thermal-bias.dK0_dT */
        rows[200][i] = bar_i_vibration_rectification*d_temperature; /* thermal-lag.dK0_dTdot */
        rows[201][i] = d_temperature*x183; /* thermal-lag.dK1_dTdot */
        rows[202][i] = bar_vartheta_y_thermal_misalignment*x297; /* thermal-misalignment.dvartheta_y_dT */
        rows[203][i] = x183*x297; /* thermal-scale.dK1_dT */
        rows[204][i] = bar_K2_thermal_second_order*x297; /* thermal-second-order.dK2_dT */
        rows[205][i] = x259 + x260 + x261 + x291 + x292; /* time-offset.delta_t */
        rows[206][i] = bar_i_vibration_rectification*(FMA(x337, x346, FMA(x337, x345, FMA(x337, x344, FMA(x337, x343, FMA(x337, x341, x337*x339)))))); /* vibration-level.L_xx */
        rows[207][i] = bar_i_vibration_rectification*(FMA(x337, x361, FMA(x337, x359, FMA(x337, x357, FMA(x337, x355, FMA(x337, x353, FMA(x337, x352, FMA(x337, x350, FMA(x337, x349, x337*x347))))))))); /* vibration-level.L_xy */
        rows[208][i] = bar_i_vibration_rectification*(FMA(x337, x370, FMA(x337, x369, FMA(x337, x368, FMA(x337, x367, FMA(x337, x366, FMA(x337, x365, FMA(x337, x364, FMA(x337, x363, x337*x362))))))))); /* vibration-level.L_xz */
        rows[209][i] = bar_i_vibration_rectification*(FMA(x337, x379, FMA(x337, x378, FMA(x337, x377, FMA(x337, x376, FMA(x337, x374, x337*x372)))))); /* vibration-level.L_yy */
        rows[210][i] = bar_i_vibration_rectification*(FMA(x337, x391, FMA(x337, x390, FMA(x337, x389, FMA(x337, x388, FMA(x337, x386, FMA(x337, x385, FMA(x337, x383, FMA(x337, x382, x337*x380))))))))); /* vibration-level.L_yz */
        rows[211][i] = bar_i_vibration_rectification*(FMA(x337, x397, FMA(x337, x396, FMA(x337, x395, FMA(x337, x394, FMA(x337, x393, x337*x392)))))); /* vibration-level.L_zz */
        rows[212][i] = bar_i_vibration_rectification*(x339 + x341 + x343 + x344 + x345 + x346); /* vibration-rectification.P_xx */
        rows[213][i] = bar_i_vibration_rectification*(x347 + x349 + x350 + x352 + x353 + x355 + x357 + x359 + x361); /* vibration-rectification.P_xy */
        rows[214][i] = bar_i_vibration_rectification*(x362 + x363 + x364 + x365 + x366 + x367 + x368 + x369 + x370); /* vibration-rectification.P_xz */
        rows[215][i] = bar_i_vibration_rectification*(x372 + x374 + x376 + x377 + x378 + x379); /* vibration-rectification.P_yy */
        rows[216][i] = bar_i_vibration_rectification*(x380 + x382 + x383 + x385 + x386 + x388 + x389 + x390 + x391); /* vibration-rectification.P_yz */
        rows[217][i] = bar_i_vibration_rectification*(x392 + x393 + x394 + x395 + x396 + x397); /* vibration-rectification.P_zz */
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
