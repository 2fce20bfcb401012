/* Signatures: what each candidate effect would add to V_j.
 * Derived; do not edit: change the derivation and derive again. */
#include "signatures.h"

#include <math.h>

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

/* The nearest whole number, without a call, for |x| < 2^51. */
static inline double nearest(double x) { return (x + 6755399441055744.0) - 6755399441055744.0; }

/* Cosine and sine of (high + low) + quarters pi/2, for quarters -2 ... 2, |high| up to about pi/4, |low| < 1e-6:
 * Taylor series up to the 17th and 16th power. */
static inline void turn(double high, double low, double quarters, double *cosine, double *sine) {
    const double x = high + low, rest = (high - x) + low;
    const double z = x * x;
    const double s_tail = FMA(z, FMA(z, FMA(z, FMA(z, FMA(z, FMA(z, FMA(z, (1.0 / 355687428096000.0), (-1.0 / 1307674368000.0)), (1.0 / 6227020800.0)), (-1.0 / 39916800.0)), (1.0 / 362880.0)), (-1.0 / 5040.0)), (1.0 / 120.0)), (-1.0 / 6.0));
    const double c_tail = FMA(z, FMA(z, FMA(z, FMA(z, FMA(z, FMA(z, (1.0 / 20922789888000.0), (-1.0 / 87178291200.0)), (1.0 / 479001600.0)), (-1.0 / 3628800.0)), (1.0 / 40320.0)), (-1.0 / 720.0)), (1.0 / 24.0));
    const double half = 0.5 * z;
    const double s = x + FMA(x * z, s_tail, FMA(-half, rest, rest));
    const double c = (1.0 - half) + (((1.0 - (1.0 - half)) - half) + FMA(z * z, c_tail, -x * rest));
    const double q = fabs(quarters);
    const double even = 1.0 - q, odd = quarters * (2.0 - q); /* one of them is 0, the other 1 or -1 */
    *cosine = FMA(even, c, -odd * s);
    *sine = FMA(even, s, odd * c);
}

/* Cosine and sine of the disc angle at n <= BLOCK instants. Whole turns are dropped exactly, whatever the time. */
static void disc(size_t n, const double *restrict t, double spin_frequency, double *restrict cosine,
                 double *restrict sine) {
    for (size_t i = 0; i < n; ++i) {
        double turns, error, high, low;
        two_product(spin_frequency, t[i], &turns, &error);
        const double part = turns - nearest(turns); /* exact, as is what follows */
        const double quarters = nearest(4.0 * part);
        const double rest = part - 0.25 * quarters;
        two_product(6.283185307179586, rest, &high, &low);
        turn(high, FMA(6.283185307179586, error, FMA(2.4492935982947064e-16, rest, low)), quarters, cosine + i, sine + i);
    }
}

/* The same of an encoder's angle, rad. */
static void encoder(size_t n, const double *restrict angle, double *restrict cosine, double *restrict sine) {
    for (size_t i = 0; i < n; ++i) {
        const double quarters = nearest(0.6366197723675814 * angle[i]);
        double high, low;
        two_product(quarters, 1.5707963267948966, &high, &low);
        const double difference = angle[i] - high;
        const double rest = difference - low;
        const double further = ((difference - rest) - low) - 6.123233995736766e-17 * quarters;
        turn(rest, further, quarters - 4.0 * nearest(0.25 * quarters), cosine + i, sine + i);
    }
}

/* At n <= BLOCK samples from at on; returns n. */
static size_t turning(size_t at, size_t end, const double *t, double spin_frequency, const double *angle,
                      double *cosine, double *sine) {
    const size_t n = end - at < BLOCK ? end - at : BLOCK;
    if (angle) {
        encoder(n, angle + at, cosine, sine);
    } else {
        disc(n, t + at, spin_frequency, cosine, sine);
    }
    return n;
}

enum { ROWS = 124, STEP = 64 };

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
    const double *restrict in_B_x = in[15] + at;
    const double *restrict in_B_y = in[16] + at;
    const double *restrict in_B_z = in[17] + at;
    const double *restrict in_d2_a_x = in[18] + at;
    const double *restrict in_d2_a_y = in[19] + at;
    const double *restrict in_d2_a_z = in[20] + at;
    const double *restrict in_d2_omegadot_x = in[21] + at;
    const double *restrict in_d2_omegadot_y = in[22] + at;
    const double *restrict in_d2_omegadot_z = in[23] + at;
    const double *restrict in_d2_spin_angle = in[24] + at;
    const double *restrict in_d_a_x = in[25] + at;
    const double *restrict in_d_a_y = in[26] + at;
    const double *restrict in_d_a_z = in[27] + at;
    const double *restrict in_d_omegadot_x = in[28] + at;
    const double *restrict in_d_omegadot_y = in[29] + at;
    const double *restrict in_d_omegadot_z = in[30] + at;
    const double *restrict in_d_spin_angle = in[31] + at;
    const double *restrict in_d_temperature = in[32] + at;
    const double *restrict in_pitch = in[33] + at;
    const double *restrict in_pressure = in[34] + at;
    const double *restrict in_roll = in[35] + at;
    const double *restrict in_temperature = in[36] + at;
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
    for (size_t i = 0; i < n; ++i) {
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
        const double pitch = in_pitch[i];
        const double pressure = in_pressure[i];
        const double roll = in_roll[i];
        const double temperature = in_temperature[i];
        const double x0 = (omega_y*omega_y);
        const double x1 = (omega_z*omega_z);
        const double x2 = x0 + x1;
        const double M_xx = -Gamma_xx - x2;
        const double x3 = omega_x*omega_y;
        const double M_xy = -Gamma_xy - omegadot_z + x3;
        const double x4 = omega_x*omega_z;
        const double x5 = omegadot_y + x4;
        const double M_xz = -Gamma_xz + x5;
        const double x6 = omegadot_z + x3;
        const double M_yx = -Gamma_xy + x6;
        const double x7 = (omega_x*omega_x);
        const double x8 = x1 + x7;
        const double M_yy = -Gamma_yy - x8;
        const double x9 = omega_y*omega_z;
        const double M_yz = -Gamma_yz - omegadot_x + x9;
        const double M_zx = -Gamma_xz - omegadot_y + x4;
        const double x10 = omegadot_x + x9;
        const double M_zy = -Gamma_yz + x10;
        const double x11 = x0 + x7;
        const double M_zz = -Gamma_zz - x11;
        const double cos_psi = FMA(-sin_j, sin_phi, cos_j*cos_phi);
        const double sin_psi = FMA(cos_phi, sin_j, cos_j*sin_phi);
        const double x12 = dR + radius;
        const double b_disc_r_x = x12;
        const double x13 = beta_z*x12;
        const double b_disc_r_y = x13;
        const double x14 = beta_x*x12;
        const double b_disc_r_z = x14;
        const double x15 = -beta_x*beta_z;
        const double b_disc_tau_zy = x15;
        const double b_r_x = FMA(-b_disc_r_y, sin_psi, b_disc_r_x*cos_psi);
        const double b_r_y = FMA(b_disc_r_y, cos_psi, b_disc_r_x*sin_psi);
        const double x16 = FMA(beta_z, cos_psi, sin_psi);
        const double x17 = -x16;
        const double b_tau_xx = x17;
        const double x18 = FMA(-beta_z, sin_psi, cos_psi);
        const double b_tau_xy = x18;
        const double b_tau_yx = x18;
        const double b_tau_yy = x16;
        const double x19 = beta_x*cos_psi;
        const double b_tau_zx = FMA(-b_disc_tau_zy, sin_psi, -x19);
        const double x20 = beta_x*sin_psi;
        const double b_tau_zy = FMA(b_disc_tau_zy, cos_psi, -x20);
        const double x21 = 2.0*omega_z;
        const double x22 = FMA(-d_spin_angle, x21, -d_spin_angle*d_spin_angle);
        const double spin_xx = x22;
        const double spin_yy = x22;
        const double x23 = d_spin_angle*omega_x;
        const double spin_zx = 2.0*x23;
        const double x24 = d_spin_angle*omega_y;
        const double spin_zy = 2.0*x24;
        const double b_f_x = FMA(M_xz, b_disc_r_z, FMA(M_xy, b_r_y, FMA(M_xx, b_r_x, a_x)));
        const double b_f_y = FMA(M_yz, b_disc_r_z, FMA(M_yy, b_r_y, FMA(M_yx, b_r_x, a_y)));
        const double b_f_z = FMA(M_zz, b_disc_r_z, FMA(M_zy, b_r_y, FMA(M_zx, b_r_x, a_z)));
        const double b_f_xj = FMA(b_f_y, b_tau_xy, b_f_x*b_tau_xx);
        const double b_f_yj = FMA(-b_f_z, beta_x, FMA(b_f_y, b_tau_yy, b_f_x*b_tau_yx));
        const double b_f_zj = FMA(b_f_y, b_tau_zy, FMA(b_f_x, b_tau_zx, -b_f_z));
        const double f_disc_r_x = x12;
        const double f_disc_r_y = x13;
        const double f_disc_r_z = x14;
        const double f_disc_tau_zy = x15;
        const double f_r_x = FMA(-f_disc_r_y, sin_psi, cos_psi*f_disc_r_x);
        const double f_r_y = FMA(f_disc_r_x, sin_psi, cos_psi*f_disc_r_y);
        const double f_tau_xx = x17;
        const double f_tau_xy = x18;
        const double f_tau_yx = x18;
        const double f_tau_yy = x16;
        const double f_tau_zx = FMA(-f_disc_tau_zy, sin_psi, -x19);
        const double f_tau_zy = FMA(cos_psi, f_disc_tau_zy, -x20);
        const double x25 = 1.0/x12;
        const double f_arm_x = f_r_x*x25;
        const double f_arm_y = f_r_y*x25;
        const double f_arm_z = f_disc_r_z*x25;
        const double x26 = 2.0*omega_y;
        const double x27 = omegadot_y*x26;
        const double x28 = omegadot_z*x21;
        const double rate_M_xx = -x27 - x28;
        const double x29 = FMA(omega_y, omegadot_x, omega_x*omegadot_y);
        const double rate_M_xy = -d_omegadot_z + x29;
        const double x30 = FMA(omega_z, omegadot_x, omega_x*omegadot_z);
        const double rate_M_xz = d_omegadot_y + x30;
        const double x31 = 2.0*sin_phi;
        const double x32 = 3.141592653589793*spin_frequency;
        const double rate_cos_phi_true = -x31*x32;
        const double x33 = 2.0*x32;
        const double rate_sin_phi_true = cos_phi*x33;
        const double rate_cos_psi = FMA(-rate_sin_phi_true, sin_j, cos_j*rate_cos_phi_true);
        const double rate_sin_psi = FMA(rate_cos_phi_true, sin_j, cos_j*rate_sin_phi_true);
        const double rate_b_r_x = FMA(-b_disc_r_y, rate_sin_psi, b_disc_r_x*rate_cos_psi);
        const double rate_b_r_y = FMA(b_disc_r_y, rate_cos_psi, b_disc_r_x*rate_sin_psi);
        const double rate_b_f_x = FMA(b_r_y, rate_M_xy, FMA(b_r_x, rate_M_xx, FMA(b_disc_r_z, rate_M_xz, FMA(M_xy, rate_b_r_y, FMA(M_xx, rate_b_r_x, d_a_x)))));
        const double rate_M_yx = d_omegadot_z + x29;
        const double x34 = 2.0*omegadot_x;
        const double x35 = omega_x*x34;
        const double rate_M_yy = -x28 - x35;
        const double x36 = FMA(omega_z, omegadot_y, omega_y*omegadot_z);
        const double rate_M_yz = -d_omegadot_x + x36;
        const double rate_b_f_y = FMA(b_r_y, rate_M_yy, FMA(b_r_x, rate_M_yx, FMA(b_disc_r_z, rate_M_yz, FMA(M_yy, rate_b_r_y, FMA(M_yx, rate_b_r_x, d_a_y)))));
        const double rate_M_zx = -d_omegadot_y + x30;
        const double rate_M_zy = d_omegadot_x + x36;
        const double rate_M_zz = -x27 - x35;
        const double rate_b_f_z = FMA(b_r_y, rate_M_zy, FMA(b_r_x, rate_M_zx, FMA(b_disc_r_z, rate_M_zz, FMA(M_zy, rate_b_r_y, FMA(M_zx, rate_b_r_x, d_a_z)))));
        const double x37 = FMA(-beta_z, rate_sin_psi, rate_cos_psi);
        const double rate_b_tau_yx = x37;
        const double x38 = FMA(beta_z, rate_cos_psi, rate_sin_psi);
        const double rate_b_tau_yy = x38;
        const double rate_b_f_yj = FMA(-beta_x, rate_b_f_z, FMA(b_tau_yy, rate_b_f_y, FMA(b_tau_yx, rate_b_f_x, FMA(b_f_y, rate_b_tau_yy, b_f_x*rate_b_tau_yx))));
        const double x39 = beta_x*rate_cos_psi;
        const double rate_b_tau_zx = FMA(-b_disc_tau_zy, rate_sin_psi, -x39);
        const double x40 = beta_x*rate_sin_psi;
        const double rate_b_tau_zy = FMA(b_disc_tau_zy, rate_cos_psi, -x40);
        const double rate_b_f_zj = FMA(b_tau_zy, rate_b_f_y, FMA(b_tau_zx, rate_b_f_x, FMA(b_f_y, rate_b_tau_zy, FMA(b_f_x, rate_b_tau_zx, -rate_b_f_z))));
        const double x41 = FMA(2.0, omegadot_z*omegadot_z, d_omegadot_z*x21);
        const double x42 = FMA(2.0, omegadot_y*omegadot_y, d_omegadot_y*x26);
        const double rate_rate_M_xx = -x41 - x42;
        const double x43 = FMA(omegadot_y, x34, FMA(d_omegadot_y, omega_x, d_omegadot_x*omega_y));
        const double rate_rate_M_xy = -d2_omegadot_z + x43;
        const double x44 = FMA(omegadot_z, x34, FMA(d_omegadot_z, omega_x, d_omegadot_x*omega_z));
        const double rate_rate_M_xz = d2_omegadot_y + x44;
        const double x45 = 4.0*cos_phi;
        const double x46 = (3.141592653589793*3.141592653589793)*(spin_frequency*spin_frequency);
        const double rate_rate_cos_phi_true = -x45*x46;
        const double x47 = 4.0*sin_phi;
        const double rate_rate_sin_phi_true = -x46*x47;
        const double rate_rate_cos_psi = FMA(-rate_rate_sin_phi_true, sin_j, cos_j*rate_rate_cos_phi_true);
        const double rate_rate_sin_psi = FMA(rate_rate_cos_phi_true, sin_j, cos_j*rate_rate_sin_phi_true);
        const double rate_rate_b_r_x = FMA(-b_disc_r_y, rate_rate_sin_psi, b_disc_r_x*rate_rate_cos_psi);
        const double rate_rate_b_r_y = FMA(b_disc_r_y, rate_rate_cos_psi, b_disc_r_x*rate_rate_sin_psi);
        const double x48 = 2.0*rate_b_r_x;
        const double x49 = 2.0*rate_b_r_y;
        const double rate_rate_b_f_x = FMA(rate_M_xy, x49, FMA(rate_M_xx, x48, FMA(b_r_y, rate_rate_M_xy, FMA(b_r_x, rate_rate_M_xx, FMA(b_disc_r_z, rate_rate_M_xz, FMA(M_xy, rate_rate_b_r_y, FMA(M_xx, rate_rate_b_r_x, d2_a_x)))))));
        const double rate_rate_M_yx = d2_omegadot_z + x43;
        const double x50 = 2.0*omega_x;
        const double x51 = FMA(2.0, omegadot_x*omegadot_x, d_omegadot_x*x50);
        const double rate_rate_M_yy = -x41 - x51;
        const double x52 = FMA(2.0, omegadot_y*omegadot_z, FMA(d_omegadot_z, omega_y, d_omegadot_y*omega_z));
        const double rate_rate_M_yz = -d2_omegadot_x + x52;
        const double rate_rate_b_f_y = FMA(rate_M_yy, x49, FMA(rate_M_yx, x48, FMA(b_r_y, rate_rate_M_yy, FMA(b_r_x, rate_rate_M_yx, FMA(b_disc_r_z, rate_rate_M_yz, FMA(M_yy, rate_rate_b_r_y, FMA(M_yx, rate_rate_b_r_x, d2_a_y)))))));
        const double rate_rate_M_zx = -d2_omegadot_y + x44;
        const double rate_rate_M_zy = d2_omegadot_x + x52;
        const double rate_rate_M_zz = -x42 - x51;
        const double rate_rate_b_f_z = FMA(rate_M_zy, x49, FMA(rate_M_zx, x48, FMA(b_r_y, rate_rate_M_zy, FMA(b_r_x, rate_rate_M_zx, FMA(b_disc_r_z, rate_rate_M_zz, FMA(M_zy, rate_rate_b_r_y, FMA(M_zx, rate_rate_b_r_x, d2_a_z)))))));
        const double x53 = FMA(-beta_z, rate_rate_sin_psi, rate_rate_cos_psi);
        const double rate_rate_b_tau_yx = x53;
        const double x54 = FMA(beta_z, rate_rate_cos_psi, rate_rate_sin_psi);
        const double rate_rate_b_tau_yy = x54;
        const double x55 = 2.0*rate_b_f_x;
        const double x56 = 2.0*rate_b_f_y;
        const double rate_rate_b_f_yj = FMA(rate_b_tau_yy, x56, FMA(rate_b_tau_yx, x55, FMA(-beta_x, rate_rate_b_f_z, FMA(b_tau_yy, rate_rate_b_f_y, FMA(b_tau_yx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_yy, b_f_x*rate_rate_b_tau_yx))))));
        const double x57 = beta_x*rate_rate_cos_psi;
        const double rate_rate_b_tau_zx = FMA(-b_disc_tau_zy, rate_rate_sin_psi, -x57);
        const double x58 = beta_x*rate_rate_sin_psi;
        const double rate_rate_b_tau_zy = FMA(b_disc_tau_zy, rate_rate_cos_psi, -x58);
        const double rate_rate_b_f_zj = FMA(rate_b_tau_zy, x56, FMA(rate_b_tau_zx, x55, FMA(b_tau_zy, rate_rate_b_f_y, FMA(b_tau_zx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_zy, FMA(b_f_x, rate_rate_b_tau_zx, -rate_rate_b_f_z))))));
        const double f_f_x = FMA(M_xz, f_disc_r_z, FMA(M_xy, f_r_y, FMA(M_xx, f_r_x, a_x)));
        const double f_f_y = FMA(M_yz, f_disc_r_z, FMA(M_yy, f_r_y, FMA(M_yx, f_r_x, a_y)));
        const double f_f_z = FMA(M_zz, f_disc_r_z, FMA(M_zy, f_r_y, FMA(M_zx, f_r_x, a_z)));
        const double f_f_xj = FMA(f_f_y, f_tau_xy, f_f_x*f_tau_xx);
        const double f_f_yj = FMA(f_f_y, f_tau_yy, FMA(-beta_x, f_f_z, f_f_x*f_tau_yx));
        const double f_f_zj = FMA(f_f_y, f_tau_zy, FMA(f_f_x, f_tau_zx, -f_f_z));
        const double f_f_i = FMA(-f_f_zj, vartheta_y, FMA(f_f_yj, vartheta_z, f_f_xj));
        const double f_f_o = FMA(f_f_zj, vartheta_x, FMA(-f_f_xj, vartheta_z, f_f_yj));
        const double f_f_p = FMA(-f_f_yj, vartheta_x, FMA(f_f_xj, vartheta_y, f_f_zj));
        const double q_disc_r_x = x12;
        const double q_r_x = cos_psi*q_disc_r_x;
        const double q_r_y = q_disc_r_x*sin_psi;
        const double q_arm_x = q_r_x*x25;
        const double q_arm_y = q_r_y*x25;
        const double q_f_x = FMA(M_xy, q_r_y, FMA(M_xx, q_r_x, a_x));
        const double q_f_y = FMA(M_yy, q_r_y, FMA(M_yx, q_r_x, a_y));
        const double q_f_z = FMA(M_zy, q_r_y, FMA(M_zx, q_r_x, a_z));
        const double q_f_xj = FMA(-q_f_x, sin_psi, cos_psi*q_f_y);
        const double q_f_yj = FMA(q_f_y, sin_psi, cos_psi*q_f_x);
        const double x59 = K6*q_f_yj;
        const double x60 = K4*q_f_z;
        const double x61 = K8*q_f_z;
        const double i_sensed = FMA(-q_f_yj, x61, FMA(-q_f_xj, x60, FMA(q_f_xj, x59, FMA(K7, q_f_z*q_f_z, FMA(K5, q_f_yj*q_f_yj, FMA(K2, q_f_xj*q_f_xj, K0 + f_f_i))))));
        const double rate_f_r_x = FMA(-f_disc_r_y, rate_sin_psi, f_disc_r_x*rate_cos_psi);
        const double rate_f_r_y = FMA(f_disc_r_y, rate_cos_psi, f_disc_r_x*rate_sin_psi);
        const double rate_f_f_x = FMA(f_r_y, rate_M_xy, FMA(f_r_x, rate_M_xx, FMA(f_disc_r_z, rate_M_xz, FMA(M_xy, rate_f_r_y, FMA(M_xx, rate_f_r_x, d_a_x)))));
        const double rate_f_f_y = FMA(f_r_y, rate_M_yy, FMA(f_r_x, rate_M_yx, FMA(f_disc_r_z, rate_M_yz, FMA(M_yy, rate_f_r_y, FMA(M_yx, rate_f_r_x, d_a_y)))));
        const double rate_f_f_z = FMA(f_r_y, rate_M_zy, FMA(f_r_x, rate_M_zx, FMA(f_disc_r_z, rate_M_zz, FMA(M_zy, rate_f_r_y, FMA(M_zx, rate_f_r_x, d_a_z)))));
        const double rate_f_tau_xx = -x38;
        const double rate_f_tau_xy = x37;
        const double rate_f_f_xj = FMA(f_tau_xy, rate_f_f_y, FMA(f_tau_xx, rate_f_f_x, FMA(f_f_y, rate_f_tau_xy, f_f_x*rate_f_tau_xx)));
        const double rate_f_tau_yx = x37;
        const double rate_f_tau_yy = x38;
        const double rate_f_f_yj = FMA(f_tau_yy, rate_f_f_y, FMA(f_tau_yx, rate_f_f_x, FMA(f_f_y, rate_f_tau_yy, FMA(-beta_x, rate_f_f_z, f_f_x*rate_f_tau_yx))));
        const double rate_f_tau_zx = FMA(-f_disc_tau_zy, rate_sin_psi, -x39);
        const double rate_f_tau_zy = FMA(f_disc_tau_zy, rate_cos_psi, -x40);
        const double rate_f_f_zj = FMA(f_tau_zy, rate_f_f_y, FMA(f_tau_zx, rate_f_f_x, FMA(f_f_y, rate_f_tau_zy, FMA(f_f_x, rate_f_tau_zx, -rate_f_f_z))));
        const double rate_f_f_i = FMA(-rate_f_f_zj, vartheta_y, FMA(rate_f_f_yj, vartheta_z, rate_f_f_xj));
        const double rate_rate_f_r_x = FMA(-f_disc_r_y, rate_rate_sin_psi, f_disc_r_x*rate_rate_cos_psi);
        const double rate_rate_f_r_y = FMA(f_disc_r_y, rate_rate_cos_psi, f_disc_r_x*rate_rate_sin_psi);
        const double x62 = 2.0*rate_f_r_x;
        const double x63 = 2.0*rate_f_r_y;
        const double rate_rate_f_f_x = FMA(rate_M_xy, x63, FMA(rate_M_xx, x62, FMA(f_r_y, rate_rate_M_xy, FMA(f_r_x, rate_rate_M_xx, FMA(f_disc_r_z, rate_rate_M_xz, FMA(M_xy, rate_rate_f_r_y, FMA(M_xx, rate_rate_f_r_x, d2_a_x)))))));
        const double rate_rate_f_f_y = FMA(rate_M_yy, x63, FMA(rate_M_yx, x62, FMA(f_r_y, rate_rate_M_yy, FMA(f_r_x, rate_rate_M_yx, FMA(f_disc_r_z, rate_rate_M_yz, FMA(M_yy, rate_rate_f_r_y, FMA(M_yx, rate_rate_f_r_x, d2_a_y)))))));
        const double rate_rate_f_f_z = FMA(rate_M_zy, x63, FMA(rate_M_zx, x62, FMA(f_r_y, rate_rate_M_zy, FMA(f_r_x, rate_rate_M_zx, FMA(f_disc_r_z, rate_rate_M_zz, FMA(M_zy, rate_rate_f_r_y, FMA(M_zx, rate_rate_f_r_x, d2_a_z)))))));
        const double rate_rate_f_tau_xx = -x54;
        const double rate_rate_f_tau_xy = x53;
        const double x64 = 2.0*rate_f_f_x;
        const double x65 = 2.0*rate_f_f_y;
        const double rate_rate_f_f_xj = FMA(rate_f_tau_xy, x65, FMA(rate_f_tau_xx, x64, FMA(f_tau_xy, rate_rate_f_f_y, FMA(f_tau_xx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_xy, f_f_x*rate_rate_f_tau_xx)))));
        const double rate_rate_f_tau_yx = x53;
        const double rate_rate_f_tau_yy = x54;
        const double rate_rate_f_f_yj = FMA(rate_f_tau_yy, x65, FMA(rate_f_tau_yx, x64, FMA(f_tau_yy, rate_rate_f_f_y, FMA(f_tau_yx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_yy, FMA(-beta_x, rate_rate_f_f_z, f_f_x*rate_rate_f_tau_yx))))));
        const double rate_rate_f_tau_zx = FMA(-f_disc_tau_zy, rate_rate_sin_psi, -x57);
        const double rate_rate_f_tau_zy = FMA(f_disc_tau_zy, rate_rate_cos_psi, -x58);
        const double rate_rate_f_f_zj = FMA(rate_f_tau_zy, x65, FMA(rate_f_tau_zx, x64, FMA(f_tau_zy, rate_rate_f_f_y, FMA(f_tau_zx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_zy, FMA(f_f_x, rate_rate_f_tau_zx, -rate_rate_f_f_z))))));
        const double rate_rate_f_f_i = FMA(-rate_rate_f_f_zj, vartheta_y, FMA(rate_rate_f_f_yj, vartheta_z, rate_rate_f_f_xj));
        const double rate_q_r_x = q_disc_r_x*rate_cos_psi;
        const double rate_q_r_y = q_disc_r_x*rate_sin_psi;
        const double rate_q_f_x = FMA(q_r_y, rate_M_xy, FMA(q_r_x, rate_M_xx, FMA(M_xy, rate_q_r_y, FMA(M_xx, rate_q_r_x, d_a_x))));
        const double rate_q_f_y = FMA(q_r_y, rate_M_yy, FMA(q_r_x, rate_M_yx, FMA(M_yy, rate_q_r_y, FMA(M_yx, rate_q_r_x, d_a_y))));
        const double rate_q_f_z = FMA(q_r_y, rate_M_zy, FMA(q_r_x, rate_M_zx, FMA(M_zy, rate_q_r_y, FMA(M_zx, rate_q_r_x, d_a_z))));
        const double rate_q_f_xj = FMA(-rate_q_f_x, sin_psi, FMA(q_f_y, rate_cos_psi, FMA(-q_f_x, rate_sin_psi, cos_psi*rate_q_f_y)));
        const double rate_q_f_yj = FMA(rate_q_f_y, sin_psi, FMA(q_f_y, rate_sin_psi, FMA(q_f_x, rate_cos_psi, cos_psi*rate_q_f_x)));
        const double rate_rate_q_r_x = q_disc_r_x*rate_rate_cos_psi;
        const double rate_rate_q_r_y = q_disc_r_x*rate_rate_sin_psi;
        const double x66 = 2.0*rate_q_r_x;
        const double x67 = 2.0*rate_q_r_y;
        const double rate_rate_q_f_x = FMA(rate_M_xy, x67, FMA(rate_M_xx, x66, FMA(q_r_y, rate_rate_M_xy, FMA(q_r_x, rate_rate_M_xx, FMA(M_xy, rate_rate_q_r_y, FMA(M_xx, rate_rate_q_r_x, d2_a_x))))));
        const double rate_rate_q_f_y = FMA(rate_M_yy, x67, FMA(rate_M_yx, x66, FMA(q_r_y, rate_rate_M_yy, FMA(q_r_x, rate_rate_M_yx, FMA(M_yy, rate_rate_q_r_y, FMA(M_yx, rate_rate_q_r_x, d2_a_y))))));
        const double rate_rate_q_f_z = FMA(rate_M_zy, x67, FMA(rate_M_zx, x66, FMA(q_r_y, rate_rate_M_zy, FMA(q_r_x, rate_rate_M_zx, FMA(M_zy, rate_rate_q_r_y, FMA(M_zx, rate_rate_q_r_x, d2_a_z))))));
        const double x68 = 2.0*rate_q_f_y;
        const double x69 = 2.0*rate_q_f_x;
        const double rate_rate_q_f_xj = FMA(-rate_sin_psi, x69, FMA(-rate_rate_q_f_x, sin_psi, FMA(rate_cos_psi, x68, FMA(q_f_y, rate_rate_cos_psi, FMA(-q_f_x, rate_rate_sin_psi, cos_psi*rate_rate_q_f_y)))));
        const double rate_rate_q_f_yj = FMA(rate_sin_psi, x68, FMA(rate_rate_q_f_y, sin_psi, FMA(rate_cos_psi, x69, FMA(q_f_y, rate_rate_sin_psi, FMA(q_f_x, rate_rate_cos_psi, cos_psi*rate_rate_q_f_x)))));
        const double x70 = 2.0*K2;
        const double x71 = 2.0*K5;
        const double x72 = 2.0*K7;
        const double x73 = FMA(q_f_xj, x70, x59 - x60);
        const double x74 = FMA(q_f_yj, x71, FMA(K6, q_f_xj, -x61));
        const double x75 = FMA(-q_f_z, x72, FMA(K8, q_f_yj, K4*q_f_xj));
        const double rate_rate_i_sensed = FMA(-rate_rate_q_f_z, x75, FMA(rate_rate_q_f_yj, x74, FMA(rate_rate_q_f_xj, x73, FMA(-rate_q_f_z, FMA(-rate_q_f_z, x72, FMA(K8, rate_q_f_yj, K4*rate_q_f_xj)), FMA(rate_q_f_yj, FMA(rate_q_f_yj, x71, FMA(-K8, rate_q_f_z, K6*rate_q_f_xj)), FMA(rate_q_f_xj, FMA(rate_q_f_xj, x70, FMA(-K4, rate_q_f_z, K6*rate_q_f_yj)), rate_rate_f_f_i))))));
        const double x76 = FMA(-f_tau_zx, vartheta_y, FMA(f_tau_yx, vartheta_z, f_tau_xx));
        const double vibration_axis_ix = x76;
        const double x77 = FMA(-f_tau_zy, vartheta_y, FMA(f_tau_yy, vartheta_z, f_tau_xy));
        const double vibration_axis_iy = x77;
        const double x78 = FMA(-beta_x, vartheta_z, vartheta_y);
        const double vibration_axis_iz = x78;
        const double vibration_axis_ox = FMA(f_tau_zx, vartheta_x, FMA(-f_tau_xx, vartheta_z, f_tau_yx));
        const double vibration_axis_oy = FMA(f_tau_zy, vartheta_x, FMA(-f_tau_xy, vartheta_z, f_tau_yy));
        const double vibration_axis_oz = -beta_x - vartheta_x;
        const double vibration_axis_px = FMA(-f_tau_yx, vartheta_x, FMA(f_tau_xx, vartheta_y, f_tau_zx));
        const double vibration_axis_py = FMA(-f_tau_yy, vartheta_x, FMA(f_tau_xy, vartheta_y, f_tau_zy));
        const double vibration_axis_pz = FMA(beta_x, vartheta_x, -(1.0));
        const double bar_i_vibration_rectification = K1*k_VI;
        const double bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x75;
        const double bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x74;
        const double bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x73;
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
        const double x79 = d_spin_angle + omega_z;
        const double x80 = 2.0*x79;
        const double bar_rate_dR_arm_stretch = FMA(-bar_q_p_second_order_misalignment, FMA(-q_arm_x, x26, q_arm_y*x50), FMA(bar_q_f_y, q_arm_x*x80, FMA(-bar_q_f_x, q_arm_y*x80, FMA(bar_f_f_z, FMA(-f_arm_x, x26, 2.0*f_arm_y*omega_x), FMA(bar_f_f_y, FMA(-f_arm_z, x50, f_arm_x*x80), bar_f_f_x*FMA(-f_arm_y, x80, 2.0*f_arm_z*omega_y))))));
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
        const double bar_wobble_zy = FMA(bar_q_spin_axis_wobble_tau_yz, sin_psi, FMA(bar_q_spin_axis_wobble_tau_xz, cos_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_y, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zy, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yy, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xy, bar_f_spin_axis_wobble_r_z*f_r_y))))));
        const double bar_wobble_zx = FMA(bar_q_spin_axis_wobble_tau_yz, cos_psi, FMA(-bar_q_spin_axis_wobble_tau_xz, sin_psi, FMA(bar_q_spin_axis_wobble_r_z, q_r_x, FMA(bar_f_spin_axis_wobble_tau_zz, f_tau_zx, FMA(bar_f_spin_axis_wobble_tau_yz, f_tau_yx, FMA(bar_f_spin_axis_wobble_tau_xz, f_tau_xx, bar_f_spin_axis_wobble_r_z*f_r_x))))));
        const double bar_wobble_yz = FMA(-bar_q_p_second_order_misalignment, q_f_y, FMA(-bar_f_spin_axis_wobble_tau_yy, beta_x, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zy)));
        const double bar_wobble_xz = FMA(-bar_q_p_second_order_misalignment, q_f_x, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_x, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_z, -bar_f_spin_axis_wobble_tau_zx)));
        const double bar_sin_psi = FMA(bar_q_spin_axis_wobble_r_y, q_disc_r_x, FMA(-bar_f_spin_axis_wobble_tau_zy, beta_x, FMA(-bar_f_spin_axis_wobble_tau_zx, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_yx, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xy, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_x, FMA(-bar_f_spin_axis_wobble_r_x, f_disc_r_y, -bar_f_spin_axis_wobble_tau_xx + bar_f_spin_axis_wobble_tau_yy - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy)))))));
        const double bar_cos_psi = FMA(bar_q_spin_axis_wobble_r_x, q_disc_r_x, FMA(bar_f_spin_axis_wobble_tau_zy, f_disc_tau_zy, FMA(-bar_f_spin_axis_wobble_tau_zx, beta_x, FMA(bar_f_spin_axis_wobble_tau_yy, beta_z, FMA(-bar_f_spin_axis_wobble_tau_xx, beta_z, FMA(bar_f_spin_axis_wobble_r_y, f_disc_r_y, FMA(bar_f_spin_axis_wobble_r_x, f_disc_r_x, bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx)))))));
        const double x81 = bar_f_f_z*f_disc_r_z;
        const double bar_M_zz = x81;
        const double x82 = bar_f_f_z*f_r_y;
        const double x83 = bar_q_p_second_order_misalignment*q_r_y;
        const double bar_M_zy = x82 - x83;
        const double x84 = bar_q_p_second_order_misalignment*q_r_x;
        const double bar_M_zx = FMA(bar_f_f_z, f_r_x, -x84);
        const double x85 = bar_f_f_y*f_disc_r_z;
        const double bar_M_yz = x85;
        const double x86 = bar_f_f_y*f_r_y;
        const double x87 = bar_q_f_y*q_r_y;
        const double bar_M_yy = x86 + x87;
        const double x88 = bar_q_f_y*q_r_x;
        const double bar_M_yx = FMA(bar_f_f_y, f_r_x, x88);
        const double x89 = bar_f_f_x*f_disc_r_z;
        const double bar_M_xz = x89;
        const double x90 = bar_f_f_x*f_r_y;
        const double x91 = bar_q_f_x*q_r_y;
        const double bar_M_xy = x90 + x91;
        const double x92 = bar_q_f_x*q_r_x;
        const double bar_M_xx = FMA(bar_f_f_x, f_r_x, x92);
        const double bar_sin_phi_true = FMA(-bar_cos_psi, sin_j, bar_sin_psi*cos_j);
        const double bar_cos_phi_true = FMA(bar_sin_psi, sin_j, bar_cos_psi*cos_j);
        const double bar_sin_delta_phi = FMA(-bar_cos_phi_true, sin_phi, bar_sin_phi_true*cos_phi);
        const double bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx;
        const double bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx;
        const double bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy;
        const double bar_time_offset_omega_z = FMA(bar_M_zy, omega_y, FMA(bar_M_zx, omega_x, FMA(bar_M_yz, omega_y, FMA(-bar_M_yy, x21, FMA(-bar_M_xx, x21, bar_M_xz*omega_x)))));
        const double bar_time_offset_omega_y = FMA(-bar_M_zz, x26, FMA(bar_M_zy, omega_z, FMA(bar_M_yz, omega_z, FMA(bar_M_yx, omega_x, FMA(-bar_M_xx, x26, bar_M_xy*omega_x)))));
        const double bar_time_offset_omega_x = FMA(-bar_M_zz, x50, FMA(bar_M_zx, omega_z, FMA(-bar_M_yy, x50, FMA(bar_M_yx, omega_y, FMA(bar_M_xz, omega_z, bar_M_xy*omega_y)))));
        const double bar_time_offset_a_z = bar_f_f_z - bar_q_p_second_order_misalignment;
        const double bar_time_offset_a_y = bar_f_f_y + bar_q_f_y;
        const double bar_time_offset_a_x = bar_f_f_x + bar_q_f_x;
        const double bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy;
        const double bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx;
        const double bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx;
        const double x93 = a_y*bar_time_offset_a_z;
        const double x94 = bar_time_offset_omega_z*omega_y;
        const double x95 = bar_time_offset_omegadot_z*omegadot_y;
        const double bar_imu_turn_zy = x93 + x94 + x95;
        const double x96 = a_x*bar_time_offset_a_z;
        const double x97 = FMA(bar_time_offset_omegadot_z, omegadot_x, FMA(bar_time_offset_omega_z, omega_x, x96));
        const double bar_imu_turn_zx = x97;
        const double x98 = a_z*bar_time_offset_a_y;
        const double x99 = FMA(bar_time_offset_omegadot_y, omegadot_z, FMA(bar_time_offset_omega_y, omega_z, x98));
        const double bar_imu_turn_yz = x99;
        const double x100 = a_x*bar_time_offset_a_y;
        const double bar_imu_turn_yx = FMA(bar_time_offset_omegadot_y, omegadot_x, FMA(bar_time_offset_omega_y, omega_x, x100));
        const double x101 = a_z*bar_time_offset_a_x;
        const double x102 = bar_time_offset_omega_x*omega_z;
        const double x103 = bar_time_offset_omegadot_x*omegadot_z;
        const double bar_imu_turn_xz = x101 + x102 + x103;
        const double x104 = a_y*bar_time_offset_a_x;
        const double bar_imu_turn_xy = FMA(bar_time_offset_omegadot_x, omegadot_y, FMA(bar_time_offset_omega_x, omega_y, x104));
        const double x105 = bar_time_offset_a_x*d_a_x;
        const double x106 = bar_time_offset_a_y*d_a_y;
        const double x107 = bar_time_offset_a_z*d_a_z;
        const double x108 = bar_time_offset_omega_x*omegadot_x;
        const double x109 = bar_time_offset_omega_y*omegadot_y;
        const double x110 = bar_time_offset_omega_z*omegadot_z;
        const double x111 = bar_time_offset_omegadot_x*d_omegadot_x;
        const double x112 = bar_time_offset_omegadot_y*d_omegadot_y;
        const double x113 = bar_time_offset_omegadot_z*d_omegadot_z;
        const double x114 = bar_i_vibration_rectification*(f_f_i*f_f_i);
        const double x115 = (f_f_o*f_f_o);
        const double x116 = bar_i_vibration_rectification*f_f_i;
        const double x117 = (f_f_p*f_f_p);
        const double x118 = bar_sin_delta_phi*cos_phi;
        const double x119 = (cos_phi*cos_phi);
        const double x120 = (sin_phi*sin_phi);
        const double x121 = (cos_phi*cos_phi*cos_phi);
        const double x122 = (sin_phi*sin_phi*sin_phi);
        const double x123 = K1*bar_K1_thermal_scale;
        const double x124 = -bar_M_zz;
        const double x125 = -x101;
        const double x126 = -x93;
        const double x127 = -omegadot_y;
        const double x128 = f_r_x*x81;
        const double x129 = 0.5*(q_r_x*q_r_x);
        const double x130 = 0.5*(f_disc_r_z*f_disc_r_z);
        const double x131 = (f_r_x*f_r_x);
        const double x132 = 0.5*x131;
        const double x133 = x130 - x132;
        const double x134 = f_r_x*x89;
        const double x135 = 0.5*(q_r_y*q_r_y);
        const double x136 = 0.5*(f_r_y*f_r_y);
        const double x137 = x130 - x136;
        const double x138 = f_r_x*x85;
        const double x139 = (1.0/6.0)*(q_r_x*q_r_x*q_r_x);
        const double x140 = f_r_x*x130;
        const double x141 = FMA(-1.0/6.0, f_r_x*f_r_x*f_r_x, x140);
        const double x142 = (f_disc_r_z*f_disc_r_z*f_disc_r_z);
        const double x143 = (1.0/6.0)*x142;
        const double x144 = FMA(-0.5, f_disc_r_z*x131, x143);
        const double x145 = f_r_y*x128;
        const double x146 = f_r_y*x130;
        const double x147 = FMA(-f_r_y, x132, x146);
        const double x148 = FMA(-f_r_x, x136, x140);
        const double x149 = f_disc_r_z*x136;
        const double x150 = (1.0/6.0)*(q_r_y*q_r_y*q_r_y);
        const double x151 = FMA(-1.0/6.0, f_r_y*f_r_y*f_r_y, x146);
        const double x152 = x143 - x149;
        const double x153 = sin(roll);
        const double x154 = -bar_M_zz*x153;
        const double x155 = sin(pitch);
        const double x156 = -bar_M_zz*x155;
        const double x157 = -Gamma_zz;
        const double x158 = 2.0*Gamma_yz;
        const double x159 = 2.0*Gamma_xz;
        const double x160 = FMA(-293.15, (1.0), temperature);
        const double x161 = K4*vibration_axis_ix;
        const double x162 = K6*vibration_axis_ix;
        const double x163 = K8*vibration_axis_ox;
        const double x164 = K4*vibration_axis_px;
        const double x165 = K6*vibration_axis_ox;
        const double x166 = K8*vibration_axis_px;
        const double x167 = vibration_axis_ix*x70;
        const double x168 = vibration_axis_ox*x71;
        const double x169 = vibration_axis_px*x72;
        const double x170 = K4*vibration_axis_iy;
        const double x171 = K6*vibration_axis_iy;
        const double x172 = K8*vibration_axis_oy;
        const double x173 = K4*vibration_axis_iz;
        const double x174 = K6*vibration_axis_iz;
        const double x175 = K8*vibration_axis_oz;

        rows[0][i] = bar_i_vibration_rectification*(FMA(f_tau_xy, omega_y, f_tau_xx*omega_x))*(FMA(f_tau_zy, omega_y, FMA(f_tau_zx, omega_x, -x79))); /* anisoinertia.K_ip */
        rows[1][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_zj, FMA(bar_rate_dR_arm_stretch, rate_b_f_zj, b_f_zj*bar_dR_arm_stretch)); /* arm-sag.c_z */
        rows[2][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_yj, FMA(bar_rate_dR_arm_stretch, rate_b_f_yj, b_f_yj*bar_dR_arm_stretch)); /* arm-stretch.c_r */
        rows[3][i] = bar_i_vibration_rectification*time; /* bias-drift.dK0_dt */
        rows[4][i] = bar_i_vibration_rectification; /* bias-step.dK0 */
        rows[5][i] = FMA(time, x113, FMA(time, x112, FMA(time, x111, FMA(time, x110, FMA(time, x109, FMA(time, x108, FMA(time, x107, FMA(time, x106, time*x105)))))))); /* clock-drift.epsilon */
        rows[6][i] = f_f_o*x114; /* cubic-cross.K_iio */
        rows[7][i] = f_f_p*x114; /* cubic-cross.K_iip */
        rows[8][i] = x115*x116; /* cubic-cross.K_ioo */
        rows[9][i] = f_f_o*f_f_p*x116; /* cubic-cross.K_iop */
        rows[10][i] = x116*x117; /* cubic-cross.K_ipp */
        rows[11][i] = bar_i_vibration_rectification*(f_f_o*f_f_o*f_f_o); /* cubic-cross.K_ooo */
        rows[12][i] = bar_i_vibration_rectification*f_f_p*x115; /* cubic-cross.K_oop */
        rows[13][i] = bar_i_vibration_rectification*f_f_o*x117; /* cubic-cross.K_opp */
        rows[14][i] = bar_i_vibration_rectification*(f_f_p*f_f_p*f_f_p); /* cubic-cross.K_ppp */
        rows[15][i] = bar_i_vibration_rectification*(f_f_i*f_f_i*f_f_i); /* cubic-input.K_iii */
        rows[16][i] = FMA(-bar_q_p_second_order_misalignment, FMA(q_r_y, spin_zy, q_r_x*spin_zx), FMA(bar_q_f_y, FMA(q_r_y, spin_yy, d2_spin_angle*q_r_x), FMA(bar_q_f_x, FMA(-d2_spin_angle, q_r_y, q_r_x*spin_xx), FMA(bar_f_f_z, FMA(f_r_y, spin_zy, f_r_x*spin_zx), FMA(bar_f_f_y, FMA(f_r_y, spin_yy, d2_spin_angle*f_r_x), bar_f_f_x*FMA(-d2_spin_angle, f_r_y, f_r_x*spin_xx)))))); /* disc-spin.share */
        rows[17][i] = x118; /* encoder-harmonic.c_1 */
        rows[18][i] = bar_sin_delta_phi*sin_phi; /* encoder-harmonic.s_1 */
        rows[19][i] = bar_sin_delta_phi*(x119 - x120); /* encoder-harmonic.c_2 */
        rows[20][i] = x118*x31; /* encoder-harmonic.s_2 */
        rows[21][i] = bar_sin_delta_phi*(FMA(-3.0, cos_phi*x120, x121)); /* encoder-harmonic.c_3 */
        rows[22][i] = bar_sin_delta_phi*(FMA(3.0, sin_phi*x119, -x122)); /* encoder-harmonic.s_3 */
        rows[23][i] = bar_sin_delta_phi*(FMA(-6.0, x119*x120, FMA(sin_phi, sin_phi*sin_phi*sin_phi, cos_phi*cos_phi*cos_phi*cos_phi))); /* encoder-harmonic.c_4 */
        rows[24][i] = bar_sin_delta_phi*(FMA(-x122, x45, x121*x47)); /* encoder-harmonic.s_4 */
        rows[25][i] = time*x123; /* gain-drift.dK1_dt */
        rows[26][i] = x123; /* gain-step.dK1 */
        rows[27][i] = -bar_M_xx - x124; /* gradient-offset.G_xx */
        rows[28][i] = bar_spin_axis_tilt_Gamma_xy; /* gradient-offset.G_xy */
        rows[29][i] = bar_spin_axis_tilt_Gamma_xz; /* gradient-offset.G_xz */
        rows[30][i] = -bar_M_yy - x124; /* gradient-offset.G_yy */
        rows[31][i] = bar_spin_axis_tilt_Gamma_yz; /* gradient-offset.G_yz */
        rows[32][i] = -bar_time_offset_omega_x; /* gyro-bias.b_x */
        rows[33][i] = -bar_time_offset_omega_y; /* gyro-bias.b_y */
        rows[34][i] = -bar_time_offset_omega_z; /* gyro-bias.b_z */
        rows[35][i] = FMA(-bar_time_offset_omegadot_x, d_a_x, -a_x*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xx */
        rows[36][i] = FMA(-bar_time_offset_omegadot_x, d_a_y, -a_y*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xy */
        rows[37][i] = FMA(-bar_time_offset_omegadot_x, d_a_z, -a_z*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xz */
        rows[38][i] = FMA(-bar_time_offset_omegadot_y, d_a_x, -a_x*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yx */
        rows[39][i] = FMA(-bar_time_offset_omegadot_y, d_a_y, -a_y*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yy */
        rows[40][i] = FMA(-bar_time_offset_omegadot_y, d_a_z, -a_z*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yz */
        rows[41][i] = FMA(-bar_time_offset_omegadot_z, d_a_x, -a_x*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zx */
        rows[42][i] = FMA(-bar_time_offset_omegadot_z, d_a_y, -a_y*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zy */
        rows[43][i] = FMA(-bar_time_offset_omegadot_z, d_a_z, -a_z*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zz */
        rows[44][i] = FMA(-bar_time_offset_omegadot_x, omegadot_x, -bar_time_offset_omega_x*omega_x); /* gyro-scale.s_x */
        rows[45][i] = FMA(-bar_time_offset_omegadot_y, omegadot_y, -bar_time_offset_omega_y*omega_y); /* gyro-scale.s_y */
        rows[46][i] = FMA(-bar_time_offset_omegadot_z, omegadot_z, -bar_time_offset_omega_z*omega_z); /* gyro-scale.s_z */
        rows[47][i] = -bar_time_offset_a_x; /* imu-acceleration-bias.b_x */
        rows[48][i] = -bar_time_offset_a_y; /* imu-acceleration-bias.b_y */
        rows[49][i] = -bar_time_offset_a_z; /* imu-acceleration-bias.b_z */
        rows[50][i] = -x104; /* imu-acceleration-misalignment.m_xy */
        rows[51][i] = x125; /* imu-acceleration-misalignment.m_xz */
        rows[52][i] = -x100; /* imu-acceleration-misalignment.m_yx */
        rows[53][i] = -x98; /* imu-acceleration-misalignment.m_yz */
        rows[54][i] = -x96; /* imu-acceleration-misalignment.m_zx */
        rows[55][i] = x126; /* imu-acceleration-misalignment.m_zy */
        rows[56][i] = -a_x*bar_time_offset_a_x; /* imu-acceleration-scale.s_x */
        rows[57][i] = -a_y*bar_time_offset_a_y; /* imu-acceleration-scale.s_y */
        rows[58][i] = -a_z*bar_time_offset_a_z; /* imu-acceleration-scale.s_z */
        rows[59][i] = FMA(bar_time_offset_a_z, (-x127 - x4), FMA(-bar_time_offset_a_y, x6, bar_time_offset_a_x*x2)); /* imu-lever-arm.l_x */
        rows[60][i] = FMA(-bar_time_offset_a_z, x10, FMA(bar_time_offset_a_y, x8, bar_time_offset_a_x*(omegadot_z - x3))); /* imu-lever-arm.l_y */
        rows[61][i] = FMA(bar_time_offset_a_z, x11, FMA(-bar_time_offset_a_x, x5, bar_time_offset_a_y*(omegadot_x - x9))); /* imu-lever-arm.l_z */
        rows[62][i] = -bar_imu_turn_yz + bar_imu_turn_zy; /* imu-misalignment.e_x */
        rows[63][i] = bar_imu_turn_xz - bar_imu_turn_zx; /* imu-misalignment.e_y */
        rows[64][i] = -bar_imu_turn_xy + bar_imu_turn_yx; /* imu-misalignment.e_z */
        rows[65][i] = -bar_i_vibration_rectification*rate_f_f_i; /* lag.tau */
        rows[66][i] = bar_i_vibration_rectification*(FMA(B_z, x78, FMA(B_y, x77, B_x*x76))); /* magnetic-bias.dK0_dB */
        rows[67][i] = b_f_xj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yx */
        rows[68][i] = b_f_yj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yy */
        rows[69][i] = b_f_zj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yz */
        rows[70][i] = b_f_xj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zx */
        rows[71][i] = b_f_yj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zy */
        rows[72][i] = b_f_zj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zz */
        rows[73][i] = FMA(-bar_q_f_x, x129, FMA(bar_f_f_x, x133, x128)); /* near-mass.T_xxx */
        rows[74][i] = FMA(-q_r_x, x91, FMA(-f_r_x, x90, FMA(-bar_q_f_y, x129, FMA(bar_f_f_z, f_disc_r_z*f_r_y, bar_f_f_y*x133)))); /* near-mass.T_xxy */
        rows[75][i] = FMA(bar_q_p_second_order_misalignment, x129, FMA(bar_f_f_z, x133, -x134)); /* near-mass.T_xxz */
        rows[76][i] = FMA(-q_r_x, x87, FMA(-f_r_x, x86, FMA(-bar_q_f_x, x135, FMA(bar_f_f_z, f_disc_r_z*f_r_x, bar_f_f_x*x137)))); /* near-mass.T_xyy */
        rows[77][i] = FMA(-f_r_y, x89, FMA(-f_r_x, x82, FMA(bar_q_p_second_order_misalignment, q_r_x*q_r_y, -x138))); /* near-mass.T_xyz */
        rows[78][i] = FMA(f_r_y, x81, FMA(-bar_q_f_y, x135, bar_f_f_y*x137)); /* near-mass.T_yyy */
        rows[79][i] = FMA(-f_r_y, x85, FMA(bar_q_p_second_order_misalignment, x135, bar_f_f_z*x137)); /* near-mass.T_yyz */
        rows[80][i] = FMA(-bar_q_f_x, x139, FMA(-bar_f_f_z, x144, bar_f_f_x*x141)); /* near-mass.T_xxxx */
        rows[81][i] = FMA(-x129, x91, FMA(-bar_q_f_y, x139, FMA(bar_f_f_y, x141, FMA(bar_f_f_x, x147, x145)))); /* near-mass.T_xxxy */
        rows[82][i] = FMA(bar_q_p_second_order_misalignment, x139, FMA(bar_f_f_z, x141, bar_f_f_x*x144)); /* near-mass.T_xxxz */
        rows[83][i] = FMA(-x135, x92, FMA(-x129, x87, FMA(bar_f_f_z, FMA(-1.0/3.0, x142, FMA(f_disc_r_z, x132, x149)), FMA(bar_f_f_y, x147, bar_f_f_x*x148)))); /* near-mass.T_xxyy */
        rows[84][i] = FMA(x129, x83, FMA(-f_r_y, x134, FMA(bar_f_f_z, x147, bar_f_f_y*x144))); /* near-mass.T_xxyz */
        rows[85][i] = FMA(-x135, x88, FMA(-bar_q_f_x, x150, FMA(bar_f_f_y, x148, FMA(bar_f_f_x, x151, x145)))); /* near-mass.T_xyyy */
        rows[86][i] = FMA(x135, x84, FMA(-f_r_y, x138, FMA(bar_f_f_z, x148, bar_f_f_x*x152))); /* near-mass.T_xyyz */
        rows[87][i] = FMA(-bar_q_f_y, x150, FMA(-bar_f_f_z, x152, bar_f_f_y*x151)); /* near-mass.T_yyyy */
        rows[88][i] = FMA(bar_q_p_second_order_misalignment, x150, FMA(bar_f_f_z, x151, bar_f_f_y*x152)); /* near-mass.T_yyyz */
        rows[89][i] = x116*fabs(f_f_i); /* odd-quadratic.K_oq */
        rows[90][i] = bar_i_vibration_rectification*rate_rate_i_sensed; /* output-filter.b */
        rows[91][i] = bar_i_vibration_rectification*i_sensed; /* output-gain-step.g */
        rows[92][i] = bar_i_vibration_rectification*(FMA(f_tau_yy, (-x127 - x23), FMA(-beta_x, (d2_spin_angle + omegadot_z), f_tau_yx*(omegadot_x + x24)))); /* pendulum-angular.K_pa */
        rows[93][i] = bar_i_vibration_rectification*(FMA(-101325.0, (1.0), pressure)); /* pressure-bias.dK0_dp */
        rows[94][i] = FMA(bar_q_p_second_order_misalignment, (f_f_p + q_f_z), FMA(bar_q_o_second_order_misalignment, (f_f_o - q_f_yj), bar_q_i_second_order_misalignment*(f_f_i - q_f_xj))); /* second-order-misalignment.kappa */
        rows[95][i] = FMA(-bar_M_xx, x153, -x154); /* self-gradient.G_xx_roll */
        rows[96][i] = bar_spin_axis_tilt_Gamma_xy*x153; /* self-gradient.G_xy_roll */
        rows[97][i] = bar_spin_axis_tilt_Gamma_xz*x153; /* self-gradient.G_xz_roll */
        rows[98][i] = FMA(-bar_M_yy, x153, -x154); /* self-gradient.G_yy_roll */
        rows[99][i] = bar_spin_axis_tilt_Gamma_yz*x153; /* self-gradient.G_yz_roll */
        rows[100][i] = FMA(-bar_M_xx, x155, -x156); /* self-gradient.G_xx_pitch */
        rows[101][i] = bar_spin_axis_tilt_Gamma_xy*x155; /* self-gradient.G_xy_pitch */
        rows[102][i] = bar_spin_axis_tilt_Gamma_xz*x155; /* self-gradient.G_xz_pitch */
        rows[103][i] = FMA(-bar_M_yy, x155, -x156); /* self-gradient.G_yy_pitch */
        rows[104][i] = bar_spin_axis_tilt_Gamma_yz*x155; /* self-gradient.G_yz_pitch */
        rows[105][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (-Gamma_yy - x157), FMA(bar_M_zz, x158, FMA(-bar_M_yy, x158, FMA(Gamma_xz, bar_spin_axis_tilt_Gamma_xy, FMA(-Gamma_xy, bar_spin_axis_tilt_Gamma_xz, x126 - x94 - x95 + x99))))); /* spin-axis-tilt.alpha_x */
        rows[106][i] = FMA(bar_spin_axis_tilt_Gamma_xz, (Gamma_xx + x157), FMA(-bar_M_zz, x159, FMA(bar_M_xx, x159, FMA(-Gamma_yz, bar_spin_axis_tilt_Gamma_xy, FMA(Gamma_xy, bar_spin_axis_tilt_Gamma_yz, -x102 - x103 + x125 + x97))))); /* spin-axis-tilt.alpha_y */
        rows[107][i] = FMA(bar_wobble_zy, cos_phi, FMA(-bar_wobble_zx, sin_phi, FMA(-bar_wobble_yz, cos_phi, bar_wobble_xz*sin_phi))); /* spin-axis-wobble.w_x */
        rows[108][i] = FMA(-bar_wobble_zy, sin_phi, FMA(-bar_wobble_zx, cos_phi, FMA(bar_wobble_yz, sin_phi, bar_wobble_xz*cos_phi))); /* spin-axis-wobble.w_y */
        rows[109][i] = bar_sin_delta_phi; /* spin-phase-offset.phi_0 */
        rows[110][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_phi */
        rows[111][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_walk */
        rows[112][i] = bar_sin_delta_phi*time*x33; /* spin-rate-offset.epsilon */
        rows[113][i] = bar_i_vibration_rectification*x160; /* thermal-bias.dK0_dT */
        rows[114][i] = bar_i_vibration_rectification*d_temperature; /* thermal-lag.dK0_dTdot */
        rows[115][i] = d_temperature*x123; /* thermal-lag.dK1_dTdot */
        rows[116][i] = x123*x160; /* thermal-scale.dK1_dT */
        rows[117][i] = x105 + x106 + x107 + x108 + x109 + x110 + x111 + x112 + x113; /* time-offset.delta_t */
        rows[118][i] = bar_i_vibration_rectification*(FMA(vibration_axis_px, x163, FMA(vibration_axis_px, x161, FMA(vibration_axis_ox, x162, FMA(K7, vibration_axis_px*vibration_axis_px, FMA(K5, vibration_axis_ox*vibration_axis_ox, K2*vibration_axis_ix*vibration_axis_ix)))))); /* vibration-rectification.P_xx */
        rows[119][i] = bar_i_vibration_rectification*(FMA(vibration_axis_py, x169, FMA(vibration_axis_py, x163, FMA(vibration_axis_py, x161, FMA(vibration_axis_oy, x168, FMA(vibration_axis_oy, x166, FMA(vibration_axis_oy, x162, FMA(vibration_axis_iy, x167, FMA(vibration_axis_iy, x165, vibration_axis_iy*x164))))))))); /* vibration-rectification.P_xy */
        rows[120][i] = bar_i_vibration_rectification*(FMA(vibration_axis_pz, x169, FMA(vibration_axis_pz, x163, FMA(vibration_axis_pz, x161, FMA(vibration_axis_oz, x168, FMA(vibration_axis_oz, x166, FMA(vibration_axis_oz, x162, FMA(vibration_axis_iz, x167, FMA(vibration_axis_iz, x165, vibration_axis_iz*x164))))))))); /* vibration-rectification.P_xz */
        rows[121][i] = bar_i_vibration_rectification*(FMA(vibration_axis_py, x172, FMA(vibration_axis_py, x170, FMA(vibration_axis_oy, x171, FMA(K7, vibration_axis_py*vibration_axis_py, FMA(K5, vibration_axis_oy*vibration_axis_oy, K2*vibration_axis_iy*vibration_axis_iy)))))); /* vibration-rectification.P_yy */
        rows[122][i] = bar_i_vibration_rectification*(FMA(vibration_axis_pz, x172, FMA(vibration_axis_pz, x170, FMA(vibration_axis_py, x175, FMA(vibration_axis_py, x173, FMA(vibration_axis_py, vibration_axis_pz*x72, FMA(vibration_axis_oz, x171, FMA(vibration_axis_oy, x174, FMA(vibration_axis_oy, vibration_axis_oz*x71, vibration_axis_iy*vibration_axis_iz*x70))))))))); /* vibration-rectification.P_yz */
        rows[123][i] = bar_i_vibration_rectification*(FMA(vibration_axis_pz, x175, FMA(vibration_axis_pz, x173, FMA(vibration_axis_oz, x174, FMA(K7, vibration_axis_pz*vibration_axis_pz, FMA(K5, vibration_axis_oz*vibration_axis_oz, K2*vibration_axis_iz*vibration_axis_iz)))))); /* vibration-rectification.P_zz */
    }
    for (size_t k = 0; k < ROWS; ++k) {
        for (size_t i = 0; i < n; ++i) {
            out_D[k * stride + i] = rows[k][i];
        }
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
    for (size_t at = 0, size; at < n; at += size) {
        size = turning(at, n, t, p[1], angle, cosine, sine);
        for (size_t k = 0; k < size; k += STEP) {
            slopes(j, size - k < STEP ? size - k : STEP, at + k, n, t, cosine + k, sine + k, in, p, D + at + k);
        }
    }
}
