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

enum { ROWS = 126, STEP = 64 };

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
        const double x29 = -x27 - x28;
        const double rate_M_xx = x29;
        const double x30 = FMA(omega_y, omegadot_x, omega_x*omegadot_y);
        const double x31 = -d_omegadot_z + x30;
        const double rate_M_xy = x31;
        const double x32 = FMA(omega_z, omegadot_x, omega_x*omegadot_z);
        const double x33 = d_omegadot_y + x32;
        const double rate_M_xz = x33;
        const double x34 = 2.0*sin_phi;
        const double x35 = 3.141592653589793*spin_frequency;
        const double x36 = -x34*x35;
        const double rate_cos_phi_true = x36;
        const double x37 = 2.0*x35;
        const double x38 = cos_phi*x37;
        const double rate_sin_phi_true = x38;
        const double rate_cos_psi = FMA(-rate_sin_phi_true, sin_j, cos_j*rate_cos_phi_true);
        const double rate_sin_psi = FMA(rate_cos_phi_true, sin_j, cos_j*rate_sin_phi_true);
        const double rate_b_r_x = FMA(-b_disc_r_y, rate_sin_psi, b_disc_r_x*rate_cos_psi);
        const double rate_b_r_y = FMA(b_disc_r_y, rate_cos_psi, b_disc_r_x*rate_sin_psi);
        const double rate_b_f_x = FMA(b_r_y, rate_M_xy, FMA(b_r_x, rate_M_xx, FMA(b_disc_r_z, rate_M_xz, FMA(M_xy, rate_b_r_y, FMA(M_xx, rate_b_r_x, d_a_x)))));
        const double x39 = d_omegadot_z + x30;
        const double rate_M_yx = x39;
        const double x40 = 2.0*omegadot_x;
        const double x41 = omega_x*x40;
        const double x42 = -x28 - x41;
        const double rate_M_yy = x42;
        const double x43 = FMA(omega_z, omegadot_y, omega_y*omegadot_z);
        const double x44 = -d_omegadot_x + x43;
        const double rate_M_yz = x44;
        const double rate_b_f_y = FMA(b_r_y, rate_M_yy, FMA(b_r_x, rate_M_yx, FMA(b_disc_r_z, rate_M_yz, FMA(M_yy, rate_b_r_y, FMA(M_yx, rate_b_r_x, d_a_y)))));
        const double x45 = -d_omegadot_y + x32;
        const double rate_M_zx = x45;
        const double x46 = d_omegadot_x + x43;
        const double rate_M_zy = x46;
        const double x47 = -x27 - x41;
        const double rate_M_zz = x47;
        const double rate_b_f_z = FMA(b_r_y, rate_M_zy, FMA(b_r_x, rate_M_zx, FMA(b_disc_r_z, rate_M_zz, FMA(M_zy, rate_b_r_y, FMA(M_zx, rate_b_r_x, d_a_z)))));
        const double rate_b_tau_yx = FMA(-beta_z, rate_sin_psi, rate_cos_psi);
        const double rate_b_tau_yy = FMA(beta_z, rate_cos_psi, rate_sin_psi);
        const double rate_b_f_yj = FMA(-beta_x, rate_b_f_z, FMA(b_tau_yy, rate_b_f_y, FMA(b_tau_yx, rate_b_f_x, FMA(b_f_y, rate_b_tau_yy, b_f_x*rate_b_tau_yx))));
        const double rate_b_tau_zx = FMA(-beta_x, rate_cos_psi, -b_disc_tau_zy*rate_sin_psi);
        const double rate_b_tau_zy = FMA(-beta_x, rate_sin_psi, b_disc_tau_zy*rate_cos_psi);
        const double rate_b_f_zj = FMA(b_tau_zy, rate_b_f_y, FMA(b_tau_zx, rate_b_f_x, FMA(b_f_y, rate_b_tau_zy, FMA(b_f_x, rate_b_tau_zx, -rate_b_f_z))));
        const double x48 = FMA(2.0, omegadot_z*omegadot_z, d_omegadot_z*x21);
        const double x49 = FMA(2.0, omegadot_y*omegadot_y, d_omegadot_y*x26);
        const double x50 = -x48 - x49;
        const double rate_rate_M_xx = x50;
        const double x51 = FMA(omegadot_y, x40, FMA(d_omegadot_y, omega_x, d_omegadot_x*omega_y));
        const double x52 = -d2_omegadot_z + x51;
        const double rate_rate_M_xy = x52;
        const double x53 = FMA(omegadot_z, x40, FMA(d_omegadot_z, omega_x, d_omegadot_x*omega_z));
        const double x54 = d2_omegadot_y + x53;
        const double rate_rate_M_xz = x54;
        const double x55 = 4.0*cos_phi;
        const double x56 = (3.141592653589793*3.141592653589793)*(spin_frequency*spin_frequency);
        const double x57 = -x55*x56;
        const double rate_rate_cos_phi_true = x57;
        const double x58 = 4.0*sin_phi;
        const double x59 = -x56*x58;
        const double rate_rate_sin_phi_true = x59;
        const double rate_rate_cos_psi = FMA(-rate_rate_sin_phi_true, sin_j, cos_j*rate_rate_cos_phi_true);
        const double rate_rate_sin_psi = FMA(rate_rate_cos_phi_true, sin_j, cos_j*rate_rate_sin_phi_true);
        const double rate_rate_b_r_x = FMA(-b_disc_r_y, rate_rate_sin_psi, b_disc_r_x*rate_rate_cos_psi);
        const double rate_rate_b_r_y = FMA(b_disc_r_y, rate_rate_cos_psi, b_disc_r_x*rate_rate_sin_psi);
        const double x60 = 2.0*rate_b_r_x;
        const double x61 = 2.0*rate_b_r_y;
        const double rate_rate_b_f_x = FMA(rate_M_xy, x61, FMA(rate_M_xx, x60, FMA(b_r_y, rate_rate_M_xy, FMA(b_r_x, rate_rate_M_xx, FMA(b_disc_r_z, rate_rate_M_xz, FMA(M_xy, rate_rate_b_r_y, FMA(M_xx, rate_rate_b_r_x, d2_a_x)))))));
        const double x62 = d2_omegadot_z + x51;
        const double rate_rate_M_yx = x62;
        const double x63 = 2.0*omega_x;
        const double x64 = FMA(2.0, omegadot_x*omegadot_x, d_omegadot_x*x63);
        const double x65 = -x48 - x64;
        const double rate_rate_M_yy = x65;
        const double x66 = FMA(2.0, omegadot_y*omegadot_z, FMA(d_omegadot_z, omega_y, d_omegadot_y*omega_z));
        const double x67 = -d2_omegadot_x + x66;
        const double rate_rate_M_yz = x67;
        const double rate_rate_b_f_y = FMA(rate_M_yy, x61, FMA(rate_M_yx, x60, FMA(b_r_y, rate_rate_M_yy, FMA(b_r_x, rate_rate_M_yx, FMA(b_disc_r_z, rate_rate_M_yz, FMA(M_yy, rate_rate_b_r_y, FMA(M_yx, rate_rate_b_r_x, d2_a_y)))))));
        const double x68 = -d2_omegadot_y + x53;
        const double rate_rate_M_zx = x68;
        const double x69 = d2_omegadot_x + x66;
        const double rate_rate_M_zy = x69;
        const double x70 = -x49 - x64;
        const double rate_rate_M_zz = x70;
        const double rate_rate_b_f_z = FMA(rate_M_zy, x61, FMA(rate_M_zx, x60, FMA(b_r_y, rate_rate_M_zy, FMA(b_r_x, rate_rate_M_zx, FMA(b_disc_r_z, rate_rate_M_zz, FMA(M_zy, rate_rate_b_r_y, FMA(M_zx, rate_rate_b_r_x, d2_a_z)))))));
        const double rate_rate_b_tau_yx = FMA(-beta_z, rate_rate_sin_psi, rate_rate_cos_psi);
        const double rate_rate_b_tau_yy = FMA(beta_z, rate_rate_cos_psi, rate_rate_sin_psi);
        const double x71 = 2.0*rate_b_f_x;
        const double x72 = 2.0*rate_b_f_y;
        const double rate_rate_b_f_yj = FMA(rate_b_tau_yy, x72, FMA(rate_b_tau_yx, x71, FMA(-beta_x, rate_rate_b_f_z, FMA(b_tau_yy, rate_rate_b_f_y, FMA(b_tau_yx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_yy, b_f_x*rate_rate_b_tau_yx))))));
        const double rate_rate_b_tau_zx = FMA(-beta_x, rate_rate_cos_psi, -b_disc_tau_zy*rate_rate_sin_psi);
        const double rate_rate_b_tau_zy = FMA(-beta_x, rate_rate_sin_psi, b_disc_tau_zy*rate_rate_cos_psi);
        const double rate_rate_b_f_zj = FMA(rate_b_tau_zy, x72, FMA(rate_b_tau_zx, x71, FMA(b_tau_zy, rate_rate_b_f_y, FMA(b_tau_zx, rate_rate_b_f_x, FMA(b_f_y, rate_rate_b_tau_zy, FMA(b_f_x, rate_rate_b_tau_zx, -rate_rate_b_f_z))))));
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
        const double x73 = K6*q_f_yj;
        const double x74 = K4*q_f_z;
        const double x75 = K8*q_f_z;
        const double i_sensed = FMA(-q_f_yj, x75, FMA(-q_f_xj, x74, FMA(q_f_xj, x73, FMA(K7, q_f_z*q_f_z, FMA(K5, q_f_yj*q_f_yj, FMA(K2, q_f_xj*q_f_xj, K0 + f_f_i))))));
        const double V2__rate_M_xx = x29;
        const double V2__rate_M_xy = x31;
        const double V2__rate_M_xz = x33;
        const double V2__rate_cos_phi_true = x36;
        const double V2__rate_sin_phi_true = x38;
        const double V2__rate_cos_psi = FMA(-V2__rate_sin_phi_true, sin_j, V2__rate_cos_phi_true*cos_j);
        const double V2__rate_sin_psi = FMA(V2__rate_sin_phi_true, cos_j, V2__rate_cos_phi_true*sin_j);
        const double rate_f_r_x = FMA(-V2__rate_sin_psi, f_disc_r_y, V2__rate_cos_psi*f_disc_r_x);
        const double rate_f_r_y = FMA(V2__rate_sin_psi, f_disc_r_x, V2__rate_cos_psi*f_disc_r_y);
        const double rate_f_f_x = FMA(V2__rate_M_xz, f_disc_r_z, FMA(V2__rate_M_xy, f_r_y, FMA(V2__rate_M_xx, f_r_x, FMA(M_xy, rate_f_r_y, FMA(M_xx, rate_f_r_x, d_a_x)))));
        const double V2__rate_M_yx = x39;
        const double V2__rate_M_yy = x42;
        const double V2__rate_M_yz = x44;
        const double rate_f_f_y = FMA(V2__rate_M_yz, f_disc_r_z, FMA(V2__rate_M_yy, f_r_y, FMA(V2__rate_M_yx, f_r_x, FMA(M_yy, rate_f_r_y, FMA(M_yx, rate_f_r_x, d_a_y)))));
        const double x76 = FMA(V2__rate_cos_psi, beta_z, V2__rate_sin_psi);
        const double rate_f_tau_xx = -x76;
        const double x77 = FMA(-V2__rate_sin_psi, beta_z, V2__rate_cos_psi);
        const double rate_f_tau_xy = x77;
        const double rate_f_f_xj = FMA(f_tau_xy, rate_f_f_y, FMA(f_tau_xx, rate_f_f_x, FMA(f_f_y, rate_f_tau_xy, f_f_x*rate_f_tau_xx)));
        const double V2__rate_M_zx = x45;
        const double V2__rate_M_zy = x46;
        const double V2__rate_M_zz = x47;
        const double rate_f_f_z = FMA(V2__rate_M_zz, f_disc_r_z, FMA(V2__rate_M_zy, f_r_y, FMA(V2__rate_M_zx, f_r_x, FMA(M_zy, rate_f_r_y, FMA(M_zx, rate_f_r_x, d_a_z)))));
        const double rate_f_tau_yx = x77;
        const double rate_f_tau_yy = x76;
        const double rate_f_f_yj = FMA(f_tau_yy, rate_f_f_y, FMA(f_tau_yx, rate_f_f_x, FMA(f_f_y, rate_f_tau_yy, FMA(-beta_x, rate_f_f_z, f_f_x*rate_f_tau_yx))));
        const double rate_f_tau_zx = FMA(-V2__rate_sin_psi, f_disc_tau_zy, -V2__rate_cos_psi*beta_x);
        const double rate_f_tau_zy = FMA(-V2__rate_sin_psi, beta_x, V2__rate_cos_psi*f_disc_tau_zy);
        const double rate_f_f_zj = FMA(f_tau_zy, rate_f_f_y, FMA(f_tau_zx, rate_f_f_x, FMA(f_f_y, rate_f_tau_zy, FMA(f_f_x, rate_f_tau_zx, -rate_f_f_z))));
        const double rate_f_f_i = FMA(-rate_f_f_zj, vartheta_y, FMA(rate_f_f_yj, vartheta_z, rate_f_f_xj));
        const double rate_V2__rate_M_xx = x50;
        const double rate_V2__rate_M_xy = x52;
        const double rate_V2__rate_M_xz = x54;
        const double rate_V2__rate_cos_phi_true = x57;
        const double rate_V2__rate_sin_phi_true = x59;
        const double rate_V2__rate_cos_psi = FMA(-rate_V2__rate_sin_phi_true, sin_j, cos_j*rate_V2__rate_cos_phi_true);
        const double rate_V2__rate_sin_psi = FMA(rate_V2__rate_cos_phi_true, sin_j, cos_j*rate_V2__rate_sin_phi_true);
        const double rate_rate_f_r_x = FMA(-f_disc_r_y, rate_V2__rate_sin_psi, f_disc_r_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_r_y = FMA(f_disc_r_y, rate_V2__rate_cos_psi, f_disc_r_x*rate_V2__rate_sin_psi);
        const double x78 = 2.0*rate_f_r_x;
        const double x79 = 2.0*rate_f_r_y;
        const double rate_rate_f_f_x = FMA(f_r_y, rate_V2__rate_M_xy, FMA(f_r_x, rate_V2__rate_M_xx, FMA(f_disc_r_z, rate_V2__rate_M_xz, FMA(V2__rate_M_xy, x79, FMA(V2__rate_M_xx, x78, FMA(M_xy, rate_rate_f_r_y, FMA(M_xx, rate_rate_f_r_x, d2_a_x)))))));
        const double rate_V2__rate_M_yx = x62;
        const double rate_V2__rate_M_yy = x65;
        const double rate_V2__rate_M_yz = x67;
        const double rate_rate_f_f_y = FMA(f_r_y, rate_V2__rate_M_yy, FMA(f_r_x, rate_V2__rate_M_yx, FMA(f_disc_r_z, rate_V2__rate_M_yz, FMA(V2__rate_M_yy, x79, FMA(V2__rate_M_yx, x78, FMA(M_yy, rate_rate_f_r_y, FMA(M_yx, rate_rate_f_r_x, d2_a_y)))))));
        const double x80 = FMA(beta_z, rate_V2__rate_cos_psi, rate_V2__rate_sin_psi);
        const double rate_rate_f_tau_xx = -x80;
        const double x81 = FMA(-beta_z, rate_V2__rate_sin_psi, rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_xy = x81;
        const double x82 = 2.0*rate_f_f_x;
        const double x83 = 2.0*rate_f_f_y;
        const double rate_rate_f_f_xj = FMA(rate_f_tau_xy, x83, FMA(rate_f_tau_xx, x82, FMA(f_tau_xy, rate_rate_f_f_y, FMA(f_tau_xx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_xy, f_f_x*rate_rate_f_tau_xx)))));
        const double rate_V2__rate_M_zx = x68;
        const double rate_V2__rate_M_zy = x69;
        const double rate_V2__rate_M_zz = x70;
        const double rate_rate_f_f_z = FMA(f_r_y, rate_V2__rate_M_zy, FMA(f_r_x, rate_V2__rate_M_zx, FMA(f_disc_r_z, rate_V2__rate_M_zz, FMA(V2__rate_M_zy, x79, FMA(V2__rate_M_zx, x78, FMA(M_zy, rate_rate_f_r_y, FMA(M_zx, rate_rate_f_r_x, d2_a_z)))))));
        const double rate_rate_f_tau_yx = x81;
        const double rate_rate_f_tau_yy = x80;
        const double rate_rate_f_f_yj = FMA(rate_f_tau_yy, x83, FMA(rate_f_tau_yx, x82, FMA(f_tau_yy, rate_rate_f_f_y, FMA(f_tau_yx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_yy, FMA(-beta_x, rate_rate_f_f_z, f_f_x*rate_rate_f_tau_yx))))));
        const double rate_rate_f_tau_zx = FMA(-f_disc_tau_zy, rate_V2__rate_sin_psi, -beta_x*rate_V2__rate_cos_psi);
        const double rate_rate_f_tau_zy = FMA(-beta_x, rate_V2__rate_sin_psi, f_disc_tau_zy*rate_V2__rate_cos_psi);
        const double rate_rate_f_f_zj = FMA(rate_f_tau_zy, x83, FMA(rate_f_tau_zx, x82, FMA(f_tau_zy, rate_rate_f_f_y, FMA(f_tau_zx, rate_rate_f_f_x, FMA(f_f_y, rate_rate_f_tau_zy, FMA(f_f_x, rate_rate_f_tau_zx, -rate_rate_f_f_z))))));
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
        const double x84 = 2.0*rate_q_r_x;
        const double x85 = 2.0*rate_q_r_y;
        const double rate_rate_q_f_x = FMA(q_r_y, rate_V2__rate_M_xy, FMA(q_r_x, rate_V2__rate_M_xx, FMA(V2__rate_M_xy, x85, FMA(V2__rate_M_xx, x84, FMA(M_xy, rate_rate_q_r_y, FMA(M_xx, rate_rate_q_r_x, d2_a_x))))));
        const double rate_rate_q_f_y = FMA(q_r_y, rate_V2__rate_M_yy, FMA(q_r_x, rate_V2__rate_M_yx, FMA(V2__rate_M_yy, x85, FMA(V2__rate_M_yx, x84, FMA(M_yy, rate_rate_q_r_y, FMA(M_yx, rate_rate_q_r_x, d2_a_y))))));
        const double x86 = 2.0*rate_q_f_y;
        const double x87 = 2.0*rate_q_f_x;
        const double rate_rate_q_f_xj = FMA(-rate_rate_q_f_x, sin_psi, FMA(q_f_y, rate_V2__rate_cos_psi, FMA(-q_f_x, rate_V2__rate_sin_psi, FMA(cos_psi, rate_rate_q_f_y, FMA(-V2__rate_sin_psi, x87, V2__rate_cos_psi*x86)))));
        const double rate_rate_q_f_yj = FMA(rate_rate_q_f_y, sin_psi, FMA(q_f_y, rate_V2__rate_sin_psi, FMA(q_f_x, rate_V2__rate_cos_psi, FMA(cos_psi, rate_rate_q_f_x, FMA(V2__rate_sin_psi, x86, V2__rate_cos_psi*x87)))));
        const double rate_rate_q_f_z = FMA(q_r_y, rate_V2__rate_M_zy, FMA(q_r_x, rate_V2__rate_M_zx, FMA(V2__rate_M_zy, x85, FMA(V2__rate_M_zx, x84, FMA(M_zy, rate_rate_q_r_y, FMA(M_zx, rate_rate_q_r_x, d2_a_z))))));
        const double x88 = 2.0*K2;
        const double x89 = 2.0*K5;
        const double x90 = 2.0*K7;
        const double x91 = FMA(q_f_xj, x88, x73 - x74);
        const double x92 = FMA(q_f_yj, x89, FMA(K6, q_f_xj, -x75));
        const double x93 = FMA(-q_f_z, x90, FMA(K8, q_f_yj, K4*q_f_xj));
        const double rate_rate_i_sensed = FMA(-rate_rate_q_f_z, x93, FMA(rate_rate_q_f_yj, x92, FMA(rate_rate_q_f_xj, x91, FMA(-rate_q_f_z, FMA(-rate_q_f_z, x90, FMA(K8, rate_q_f_yj, K4*rate_q_f_xj)), FMA(rate_q_f_yj, FMA(rate_q_f_yj, x89, FMA(-K8, rate_q_f_z, K6*rate_q_f_xj)), FMA(rate_q_f_xj, FMA(rate_q_f_xj, x88, FMA(-K4, rate_q_f_z, K6*rate_q_f_yj)), rate_rate_f_f_i))))));
        const double x94 = FMA(-f_tau_zx, vartheta_y, FMA(f_tau_yx, vartheta_z, f_tau_xx));
        const double vibration_axis_ix = x94;
        const double x95 = FMA(-f_tau_zy, vartheta_y, FMA(f_tau_yy, vartheta_z, f_tau_xy));
        const double vibration_axis_iy = x95;
        const double x96 = FMA(-beta_x, vartheta_z, vartheta_y);
        const double vibration_axis_iz = x96;
        const double vibration_axis_ox = FMA(f_tau_zx, vartheta_x, FMA(-f_tau_xx, vartheta_z, f_tau_yx));
        const double vibration_axis_oy = FMA(f_tau_zy, vartheta_x, FMA(-f_tau_xy, vartheta_z, f_tau_yy));
        const double vibration_axis_oz = -beta_x - vartheta_x;
        const double vibration_axis_px = FMA(-f_tau_yx, vartheta_x, FMA(f_tau_xx, vartheta_y, f_tau_zx));
        const double vibration_axis_py = FMA(-f_tau_yy, vartheta_x, FMA(f_tau_xy, vartheta_y, f_tau_zy));
        const double vibration_axis_pz = FMA(beta_x, vartheta_x, -(1.0));
        const double bar_i_vibration_rectification = K1*k_VI;
        const double bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x93;
        const double bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x92;
        const double bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x91;
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
        const double x97 = d_spin_angle + omega_z;
        const double x98 = 2.0*x97;
        const double bar_rate_dR_arm_stretch = FMA(-bar_q_p_second_order_misalignment, FMA(-q_arm_x, x26, q_arm_y*x63), FMA(bar_q_f_y, q_arm_x*x98, FMA(-bar_q_f_x, q_arm_y*x98, FMA(bar_f_f_z, FMA(-f_arm_x, x26, 2.0*f_arm_y*omega_x), FMA(bar_f_f_y, FMA(-f_arm_z, x63, f_arm_x*x98), bar_f_f_x*FMA(-f_arm_y, x98, 2.0*f_arm_z*omega_y))))));
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
        const double x99 = bar_f_f_z*f_disc_r_z;
        const double bar_M_zz = x99;
        const double x100 = bar_f_f_z*f_r_y;
        const double x101 = bar_q_p_second_order_misalignment*q_r_y;
        const double bar_M_zy = x100 - x101;
        const double x102 = bar_q_p_second_order_misalignment*q_r_x;
        const double bar_M_zx = FMA(bar_f_f_z, f_r_x, -x102);
        const double x103 = bar_f_f_y*f_disc_r_z;
        const double bar_M_yz = x103;
        const double x104 = bar_f_f_y*f_r_y;
        const double x105 = bar_q_f_y*q_r_y;
        const double bar_M_yy = x104 + x105;
        const double x106 = bar_q_f_y*q_r_x;
        const double bar_M_yx = FMA(bar_f_f_y, f_r_x, x106);
        const double x107 = bar_f_f_x*f_disc_r_z;
        const double bar_M_xz = x107;
        const double x108 = bar_f_f_x*f_r_y;
        const double x109 = bar_q_f_x*q_r_y;
        const double bar_M_xy = x108 + x109;
        const double x110 = bar_q_f_x*q_r_x;
        const double bar_M_xx = FMA(bar_f_f_x, f_r_x, x110);
        const double bar_sin_phi_true = FMA(-bar_cos_psi, sin_j, bar_sin_psi*cos_j);
        const double bar_cos_phi_true = FMA(bar_sin_psi, sin_j, bar_cos_psi*cos_j);
        const double bar_sin_delta_phi = FMA(-bar_cos_phi_true, sin_phi, bar_sin_phi_true*cos_phi);
        const double bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx;
        const double bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx;
        const double bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy;
        const double bar_time_offset_omega_z = FMA(bar_M_zy, omega_y, FMA(bar_M_zx, omega_x, FMA(bar_M_yz, omega_y, FMA(-bar_M_yy, x21, FMA(-bar_M_xx, x21, bar_M_xz*omega_x)))));
        const double bar_time_offset_omega_y = FMA(-bar_M_zz, x26, FMA(bar_M_zy, omega_z, FMA(bar_M_yz, omega_z, FMA(bar_M_yx, omega_x, FMA(-bar_M_xx, x26, bar_M_xy*omega_x)))));
        const double bar_time_offset_omega_x = FMA(-bar_M_zz, x63, FMA(bar_M_zx, omega_z, FMA(-bar_M_yy, x63, FMA(bar_M_yx, omega_y, FMA(bar_M_xz, omega_z, bar_M_xy*omega_y)))));
        const double bar_time_offset_a_z = bar_f_f_z - bar_q_p_second_order_misalignment;
        const double bar_time_offset_a_y = bar_f_f_y + bar_q_f_y;
        const double bar_time_offset_a_x = bar_f_f_x + bar_q_f_x;
        const double bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy;
        const double bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx;
        const double bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx;
        const double x111 = a_y*bar_time_offset_a_z;
        const double x112 = bar_time_offset_omega_z*omega_y;
        const double x113 = bar_time_offset_omegadot_z*omegadot_y;
        const double bar_imu_turn_zy = x111 + x112 + x113;
        const double x114 = a_x*bar_time_offset_a_z;
        const double x115 = FMA(bar_time_offset_omegadot_z, omegadot_x, FMA(bar_time_offset_omega_z, omega_x, x114));
        const double bar_imu_turn_zx = x115;
        const double x116 = a_z*bar_time_offset_a_y;
        const double x117 = FMA(bar_time_offset_omegadot_y, omegadot_z, FMA(bar_time_offset_omega_y, omega_z, x116));
        const double bar_imu_turn_yz = x117;
        const double x118 = a_x*bar_time_offset_a_y;
        const double bar_imu_turn_yx = FMA(bar_time_offset_omegadot_y, omegadot_x, FMA(bar_time_offset_omega_y, omega_x, x118));
        const double x119 = a_z*bar_time_offset_a_x;
        const double x120 = bar_time_offset_omega_x*omega_z;
        const double x121 = bar_time_offset_omegadot_x*omegadot_z;
        const double bar_imu_turn_xz = x119 + x120 + x121;
        const double x122 = a_y*bar_time_offset_a_x;
        const double bar_imu_turn_xy = FMA(bar_time_offset_omegadot_x, omegadot_y, FMA(bar_time_offset_omega_x, omega_y, x122));
        const double x123 = bar_time_offset_a_x*d_a_x;
        const double x124 = bar_time_offset_a_y*d_a_y;
        const double x125 = bar_time_offset_a_z*d_a_z;
        const double x126 = bar_time_offset_omega_x*omegadot_x;
        const double x127 = bar_time_offset_omega_y*omegadot_y;
        const double x128 = bar_time_offset_omega_z*omegadot_z;
        const double x129 = bar_time_offset_omegadot_x*d_omegadot_x;
        const double x130 = bar_time_offset_omegadot_y*d_omegadot_y;
        const double x131 = bar_time_offset_omegadot_z*d_omegadot_z;
        const double x132 = bar_i_vibration_rectification*(f_f_i*f_f_i);
        const double x133 = (f_f_o*f_f_o);
        const double x134 = bar_i_vibration_rectification*f_f_i;
        const double x135 = (f_f_p*f_f_p);
        const double x136 = bar_sin_delta_phi*cos_phi;
        const double x137 = (cos_phi*cos_phi);
        const double x138 = (sin_phi*sin_phi);
        const double x139 = (cos_phi*cos_phi*cos_phi);
        const double x140 = (sin_phi*sin_phi*sin_phi);
        const double x141 = K1*bar_K1_thermal_scale;
        const double x142 = -bar_M_zz;
        const double x143 = x126 + x127 + x128;
        const double x144 = x129 + x130 + x131;
        const double x145 = -x119;
        const double x146 = -x111;
        const double x147 = -omegadot_y;
        const double x148 = f_r_x*x99;
        const double x149 = 0.5*(q_r_x*q_r_x);
        const double x150 = 0.5*(f_disc_r_z*f_disc_r_z);
        const double x151 = (f_r_x*f_r_x);
        const double x152 = 0.5*x151;
        const double x153 = x150 - x152;
        const double x154 = f_r_x*x107;
        const double x155 = 0.5*(q_r_y*q_r_y);
        const double x156 = 0.5*(f_r_y*f_r_y);
        const double x157 = x150 - x156;
        const double x158 = f_r_x*x103;
        const double x159 = (1.0/6.0)*(q_r_x*q_r_x*q_r_x);
        const double x160 = f_r_x*x150;
        const double x161 = FMA(-1.0/6.0, f_r_x*f_r_x*f_r_x, x160);
        const double x162 = (f_disc_r_z*f_disc_r_z*f_disc_r_z);
        const double x163 = (1.0/6.0)*x162;
        const double x164 = FMA(-0.5, f_disc_r_z*x151, x163);
        const double x165 = f_r_y*x148;
        const double x166 = f_r_y*x150;
        const double x167 = FMA(-f_r_y, x152, x166);
        const double x168 = FMA(-f_r_x, x156, x160);
        const double x169 = f_disc_r_z*x156;
        const double x170 = (1.0/6.0)*(q_r_y*q_r_y*q_r_y);
        const double x171 = FMA(-1.0/6.0, f_r_y*f_r_y*f_r_y, x166);
        const double x172 = x163 - x169;
        const double x173 = sin(roll);
        const double x174 = -bar_M_zz*x173;
        const double x175 = sin(pitch);
        const double x176 = -bar_M_zz*x175;
        const double x177 = -Gamma_zz;
        const double x178 = 2.0*Gamma_yz;
        const double x179 = 2.0*Gamma_xz;
        const double x180 = FMA(-293.15, (1.0), temperature);
        const double x181 = K4*vibration_axis_ix;
        const double x182 = K6*vibration_axis_ix;
        const double x183 = K8*vibration_axis_ox;
        const double x184 = K4*vibration_axis_px;
        const double x185 = K6*vibration_axis_ox;
        const double x186 = K8*vibration_axis_px;
        const double x187 = vibration_axis_ix*x88;
        const double x188 = vibration_axis_ox*x89;
        const double x189 = vibration_axis_px*x90;
        const double x190 = K4*vibration_axis_iy;
        const double x191 = K6*vibration_axis_iy;
        const double x192 = K8*vibration_axis_oy;
        const double x193 = K4*vibration_axis_iz;
        const double x194 = K6*vibration_axis_iz;
        const double x195 = K8*vibration_axis_oz;

        rows[0][i] = bar_i_vibration_rectification*(FMA(f_tau_xy, omega_y, f_tau_xx*omega_x))*(FMA(f_tau_zy, omega_y, FMA(f_tau_zx, omega_x, -x97))); /* anisoinertia.K_ip */
        rows[1][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_zj, FMA(bar_rate_dR_arm_stretch, rate_b_f_zj, b_f_zj*bar_dR_arm_stretch)); /* arm-sag.c_z */
        rows[2][i] = FMA(bar_rate_rate_dR_arm_stretch, rate_rate_b_f_yj, FMA(bar_rate_dR_arm_stretch, rate_b_f_yj, b_f_yj*bar_dR_arm_stretch)); /* arm-stretch.c_r */
        rows[3][i] = bar_i_vibration_rectification*time; /* bias-drift.dK0_dt */
        rows[4][i] = bar_i_vibration_rectification; /* bias-step.dK0 */
        rows[5][i] = FMA(time, x131, FMA(time, x130, FMA(time, x129, FMA(time, x128, FMA(time, x127, FMA(time, x126, FMA(time, x125, FMA(time, x124, time*x123)))))))); /* clock-drift.epsilon */
        rows[6][i] = f_f_o*x132; /* cubic-cross.K_iio */
        rows[7][i] = f_f_p*x132; /* cubic-cross.K_iip */
        rows[8][i] = x133*x134; /* cubic-cross.K_ioo */
        rows[9][i] = f_f_o*f_f_p*x134; /* cubic-cross.K_iop */
        rows[10][i] = x134*x135; /* cubic-cross.K_ipp */
        rows[11][i] = bar_i_vibration_rectification*(f_f_o*f_f_o*f_f_o); /* cubic-cross.K_ooo */
        rows[12][i] = bar_i_vibration_rectification*f_f_p*x133; /* cubic-cross.K_oop */
        rows[13][i] = bar_i_vibration_rectification*f_f_o*x135; /* cubic-cross.K_opp */
        rows[14][i] = bar_i_vibration_rectification*(f_f_p*f_f_p*f_f_p); /* cubic-cross.K_ppp */
        rows[15][i] = bar_i_vibration_rectification*(f_f_i*f_f_i*f_f_i); /* cubic-input.K_iii */
        rows[16][i] = FMA(-bar_q_p_second_order_misalignment, FMA(q_r_y, spin_zy, q_r_x*spin_zx), FMA(bar_q_f_y, FMA(q_r_y, spin_yy, d2_spin_angle*q_r_x), FMA(bar_q_f_x, FMA(-d2_spin_angle, q_r_y, q_r_x*spin_xx), FMA(bar_f_f_z, FMA(f_r_y, spin_zy, f_r_x*spin_zx), FMA(bar_f_f_y, FMA(f_r_y, spin_yy, d2_spin_angle*f_r_x), bar_f_f_x*FMA(-d2_spin_angle, f_r_y, f_r_x*spin_xx)))))); /* disc-spin.share */
        rows[17][i] = x136; /* encoder-harmonic.c_1 */
        rows[18][i] = bar_sin_delta_phi*sin_phi; /* encoder-harmonic.s_1 */
        rows[19][i] = bar_sin_delta_phi*(x137 - x138); /* encoder-harmonic.c_2 */
        rows[20][i] = x136*x34; /* encoder-harmonic.s_2 */
        rows[21][i] = bar_sin_delta_phi*(FMA(-3.0, cos_phi*x138, x139)); /* encoder-harmonic.c_3 */
        rows[22][i] = bar_sin_delta_phi*(FMA(3.0, sin_phi*x137, -x140)); /* encoder-harmonic.s_3 */
        rows[23][i] = bar_sin_delta_phi*(FMA(-6.0, x137*x138, FMA(sin_phi, sin_phi*sin_phi*sin_phi, cos_phi*cos_phi*cos_phi*cos_phi))); /* encoder-harmonic.c_4 */
        rows[24][i] = bar_sin_delta_phi*(FMA(-x140, x55, x139*x58)); /* encoder-harmonic.s_4 */
        rows[25][i] = time*x141; /* gain-drift.dK1_dt */
        rows[26][i] = x141; /* gain-step.dK1 */
        rows[27][i] = -bar_M_xx - x142; /* gradient-offset.G_xx */
        rows[28][i] = bar_spin_axis_tilt_Gamma_xy; /* gradient-offset.G_xy */
        rows[29][i] = bar_spin_axis_tilt_Gamma_xz; /* gradient-offset.G_xz */
        rows[30][i] = -bar_M_yy - x142; /* gradient-offset.G_yy */
        rows[31][i] = bar_spin_axis_tilt_Gamma_yz; /* gradient-offset.G_yz */
        rows[32][i] = -bar_time_offset_omega_x; /* gyro-bias.b_x */
        rows[33][i] = -bar_time_offset_omega_y; /* gyro-bias.b_y */
        rows[34][i] = -bar_time_offset_omega_z; /* gyro-bias.b_z */
        rows[35][i] = x143; /* gyro-delay.delta_w */
        rows[36][i] = x144; /* gyro-delay.delta_d */
        rows[37][i] = FMA(-bar_time_offset_omegadot_x, d_a_x, -a_x*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xx */
        rows[38][i] = FMA(-bar_time_offset_omegadot_x, d_a_y, -a_y*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xy */
        rows[39][i] = FMA(-bar_time_offset_omegadot_x, d_a_z, -a_z*bar_time_offset_omega_x); /* gyro-g-sensitivity.d_xz */
        rows[40][i] = FMA(-bar_time_offset_omegadot_y, d_a_x, -a_x*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yx */
        rows[41][i] = FMA(-bar_time_offset_omegadot_y, d_a_y, -a_y*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yy */
        rows[42][i] = FMA(-bar_time_offset_omegadot_y, d_a_z, -a_z*bar_time_offset_omega_y); /* gyro-g-sensitivity.d_yz */
        rows[43][i] = FMA(-bar_time_offset_omegadot_z, d_a_x, -a_x*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zx */
        rows[44][i] = FMA(-bar_time_offset_omegadot_z, d_a_y, -a_y*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zy */
        rows[45][i] = FMA(-bar_time_offset_omegadot_z, d_a_z, -a_z*bar_time_offset_omega_z); /* gyro-g-sensitivity.d_zz */
        rows[46][i] = FMA(-bar_time_offset_omegadot_x, omegadot_x, -bar_time_offset_omega_x*omega_x); /* gyro-scale.s_x */
        rows[47][i] = FMA(-bar_time_offset_omegadot_y, omegadot_y, -bar_time_offset_omega_y*omega_y); /* gyro-scale.s_y */
        rows[48][i] = FMA(-bar_time_offset_omegadot_z, omegadot_z, -bar_time_offset_omega_z*omega_z); /* gyro-scale.s_z */
        rows[49][i] = -bar_time_offset_a_x; /* imu-acceleration-bias.b_x */
        rows[50][i] = -bar_time_offset_a_y; /* imu-acceleration-bias.b_y */
        rows[51][i] = -bar_time_offset_a_z; /* imu-acceleration-bias.b_z */
        rows[52][i] = -x122; /* imu-acceleration-misalignment.m_xy */
        rows[53][i] = x145; /* imu-acceleration-misalignment.m_xz */
        rows[54][i] = -x118; /* imu-acceleration-misalignment.m_yx */
        rows[55][i] = -x116; /* imu-acceleration-misalignment.m_yz */
        rows[56][i] = -x114; /* imu-acceleration-misalignment.m_zx */
        rows[57][i] = x146; /* imu-acceleration-misalignment.m_zy */
        rows[58][i] = -a_x*bar_time_offset_a_x; /* imu-acceleration-scale.s_x */
        rows[59][i] = -a_y*bar_time_offset_a_y; /* imu-acceleration-scale.s_y */
        rows[60][i] = -a_z*bar_time_offset_a_z; /* imu-acceleration-scale.s_z */
        rows[61][i] = FMA(bar_time_offset_a_z, (-x147 - x4), FMA(-bar_time_offset_a_y, x6, bar_time_offset_a_x*x2)); /* imu-lever-arm.l_x */
        rows[62][i] = FMA(-bar_time_offset_a_z, x10, FMA(bar_time_offset_a_y, x8, bar_time_offset_a_x*(omegadot_z - x3))); /* imu-lever-arm.l_y */
        rows[63][i] = FMA(bar_time_offset_a_z, x11, FMA(-bar_time_offset_a_x, x5, bar_time_offset_a_y*(omegadot_x - x9))); /* imu-lever-arm.l_z */
        rows[64][i] = -bar_imu_turn_yz + bar_imu_turn_zy; /* imu-misalignment.e_x */
        rows[65][i] = bar_imu_turn_xz - bar_imu_turn_zx; /* imu-misalignment.e_y */
        rows[66][i] = -bar_imu_turn_xy + bar_imu_turn_yx; /* imu-misalignment.e_z */
        rows[67][i] = -bar_i_vibration_rectification*rate_f_f_i; /* lag.tau */
        rows[68][i] = bar_i_vibration_rectification*(FMA(B_z, x96, FMA(B_y, x95, B_x*x94))); /* magnetic-bias.dK0_dB */
        rows[69][i] = b_f_xj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yx */
        rows[70][i] = b_f_yj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yy */
        rows[71][i] = b_f_zj*bar_vartheta_y_mount_compliance; /* mount-compliance.c_yz */
        rows[72][i] = b_f_xj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zx */
        rows[73][i] = b_f_yj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zy */
        rows[74][i] = b_f_zj*bar_vartheta_z_mount_compliance; /* mount-compliance.c_zz */
        rows[75][i] = FMA(-bar_q_f_x, x149, FMA(bar_f_f_x, x153, x148)); /* near-mass.T_xxx */
        rows[76][i] = FMA(-q_r_x, x109, FMA(-f_r_x, x108, FMA(-bar_q_f_y, x149, FMA(bar_f_f_z, f_disc_r_z*f_r_y, bar_f_f_y*x153)))); /* near-mass.T_xxy */
        rows[77][i] = FMA(bar_q_p_second_order_misalignment, x149, FMA(bar_f_f_z, x153, -x154)); /* near-mass.T_xxz */
        rows[78][i] = FMA(-q_r_x, x105, FMA(-f_r_x, x104, FMA(-bar_q_f_x, x155, FMA(bar_f_f_z, f_disc_r_z*f_r_x, bar_f_f_x*x157)))); /* near-mass.T_xyy */
        rows[79][i] = FMA(-f_r_y, x107, FMA(-f_r_x, x100, FMA(bar_q_p_second_order_misalignment, q_r_x*q_r_y, -x158))); /* near-mass.T_xyz */
        rows[80][i] = FMA(f_r_y, x99, FMA(-bar_q_f_y, x155, bar_f_f_y*x157)); /* near-mass.T_yyy */
        rows[81][i] = FMA(-f_r_y, x103, FMA(bar_q_p_second_order_misalignment, x155, bar_f_f_z*x157)); /* near-mass.T_yyz */
        rows[82][i] = FMA(-bar_q_f_x, x159, FMA(-bar_f_f_z, x164, bar_f_f_x*x161)); /* near-mass.T_xxxx */
        rows[83][i] = FMA(-x109, x149, FMA(-bar_q_f_y, x159, FMA(bar_f_f_y, x161, FMA(bar_f_f_x, x167, x165)))); /* near-mass.T_xxxy */
        rows[84][i] = FMA(bar_q_p_second_order_misalignment, x159, FMA(bar_f_f_z, x161, bar_f_f_x*x164)); /* near-mass.T_xxxz */
        rows[85][i] = FMA(-x110, x155, FMA(-x105, x149, FMA(bar_f_f_z, FMA(-1.0/3.0, x162, FMA(f_disc_r_z, x152, x169)), FMA(bar_f_f_y, x167, bar_f_f_x*x168)))); /* near-mass.T_xxyy */
        rows[86][i] = FMA(x101, x149, FMA(-f_r_y, x154, FMA(bar_f_f_z, x167, bar_f_f_y*x164))); /* near-mass.T_xxyz */
        rows[87][i] = FMA(-x106, x155, FMA(-bar_q_f_x, x170, FMA(bar_f_f_y, x168, FMA(bar_f_f_x, x171, x165)))); /* near-mass.T_xyyy */
        rows[88][i] = FMA(x102, x155, FMA(-f_r_y, x158, FMA(bar_f_f_z, x168, bar_f_f_x*x172))); /* near-mass.T_xyyz */
        rows[89][i] = FMA(-bar_q_f_y, x170, FMA(-bar_f_f_z, x172, bar_f_f_y*x171)); /* near-mass.T_yyyy */
        rows[90][i] = FMA(bar_q_p_second_order_misalignment, x170, FMA(bar_f_f_z, x171, bar_f_f_y*x172)); /* near-mass.T_yyyz */
        rows[91][i] = x134*fabs(f_f_i); /* odd-quadratic.K_oq */
        rows[92][i] = bar_i_vibration_rectification*rate_rate_i_sensed; /* output-filter.b */
        rows[93][i] = bar_i_vibration_rectification*i_sensed; /* output-gain-step.g */
        rows[94][i] = bar_i_vibration_rectification*(FMA(f_tau_yy, (-x147 - x23), FMA(-beta_x, (d2_spin_angle + omegadot_z), f_tau_yx*(omegadot_x + x24)))); /* pendulum-angular.K_pa */
        rows[95][i] = bar_i_vibration_rectification*(FMA(-101325.0, (1.0), pressure)); /* pressure-bias.dK0_dp */
        rows[96][i] = FMA(bar_q_p_second_order_misalignment, (f_f_p + q_f_z), FMA(bar_q_o_second_order_misalignment, (f_f_o - q_f_yj), bar_q_i_second_order_misalignment*(f_f_i - q_f_xj))); /* second-order-misalignment.kappa */
        rows[97][i] = FMA(-bar_M_xx, x173, -x174); /* self-gradient.G_xx_roll */
        rows[98][i] = bar_spin_axis_tilt_Gamma_xy*x173; /* self-gradient.G_xy_roll */
        rows[99][i] = bar_spin_axis_tilt_Gamma_xz*x173; /* self-gradient.G_xz_roll */
        rows[100][i] = FMA(-bar_M_yy, x173, -x174); /* self-gradient.G_yy_roll */
        rows[101][i] = bar_spin_axis_tilt_Gamma_yz*x173; /* self-gradient.G_yz_roll */
        rows[102][i] = FMA(-bar_M_xx, x175, -x176); /* self-gradient.G_xx_pitch */
        rows[103][i] = bar_spin_axis_tilt_Gamma_xy*x175; /* self-gradient.G_xy_pitch */
        rows[104][i] = bar_spin_axis_tilt_Gamma_xz*x175; /* self-gradient.G_xz_pitch */
        rows[105][i] = FMA(-bar_M_yy, x175, -x176); /* self-gradient.G_yy_pitch */
        rows[106][i] = bar_spin_axis_tilt_Gamma_yz*x175; /* self-gradient.G_yz_pitch */
        rows[107][i] = FMA(bar_spin_axis_tilt_Gamma_yz, (-Gamma_yy - x177), FMA(bar_M_zz, x178, FMA(-bar_M_yy, x178, FMA(Gamma_xz, bar_spin_axis_tilt_Gamma_xy, FMA(-Gamma_xy, bar_spin_axis_tilt_Gamma_xz, -x112 - x113 + x117 + x146))))); /* spin-axis-tilt.alpha_x */
        rows[108][i] = FMA(bar_spin_axis_tilt_Gamma_xz, (Gamma_xx + x177), FMA(-bar_M_zz, x179, FMA(bar_M_xx, x179, FMA(-Gamma_yz, bar_spin_axis_tilt_Gamma_xy, FMA(Gamma_xy, bar_spin_axis_tilt_Gamma_yz, x115 - x120 - x121 + x145))))); /* spin-axis-tilt.alpha_y */
        rows[109][i] = FMA(bar_wobble_zy, cos_phi, FMA(-bar_wobble_zx, sin_phi, FMA(-bar_wobble_yz, cos_phi, bar_wobble_xz*sin_phi))); /* spin-axis-wobble.w_x */
        rows[110][i] = FMA(-bar_wobble_zy, sin_phi, FMA(-bar_wobble_zx, cos_phi, FMA(bar_wobble_yz, sin_phi, bar_wobble_xz*cos_phi))); /* spin-axis-wobble.w_y */
        rows[111][i] = bar_sin_delta_phi; /* spin-phase-offset.phi_0 */
        rows[112][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_phi */
        rows[113][i] = bar_sin_delta_phi; /* spin-rate-jitter.sigma_walk */
        rows[114][i] = bar_sin_delta_phi*time*x37; /* spin-rate-offset.epsilon */
        rows[115][i] = bar_i_vibration_rectification*x180; /* thermal-bias.dK0_dT */
        rows[116][i] = bar_i_vibration_rectification*d_temperature; /* thermal-lag.dK0_dTdot */
        rows[117][i] = d_temperature*x141; /* thermal-lag.dK1_dTdot */
        rows[118][i] = x141*x180; /* thermal-scale.dK1_dT */
        rows[119][i] = x123 + x124 + x125 + x143 + x144; /* time-offset.delta_t */
        rows[120][i] = bar_i_vibration_rectification*(FMA(vibration_axis_px, x183, FMA(vibration_axis_px, x181, FMA(vibration_axis_ox, x182, FMA(K7, vibration_axis_px*vibration_axis_px, FMA(K5, vibration_axis_ox*vibration_axis_ox, K2*vibration_axis_ix*vibration_axis_ix)))))); /* vibration-rectification.P_xx */
        rows[121][i] = bar_i_vibration_rectification*(FMA(vibration_axis_py, x189, FMA(vibration_axis_py, x183, FMA(vibration_axis_py, x181, FMA(vibration_axis_oy, x188, FMA(vibration_axis_oy, x186, FMA(vibration_axis_oy, x182, FMA(vibration_axis_iy, x187, FMA(vibration_axis_iy, x185, vibration_axis_iy*x184))))))))); /* vibration-rectification.P_xy */
        rows[122][i] = bar_i_vibration_rectification*(FMA(vibration_axis_pz, x189, FMA(vibration_axis_pz, x183, FMA(vibration_axis_pz, x181, FMA(vibration_axis_oz, x188, FMA(vibration_axis_oz, x186, FMA(vibration_axis_oz, x182, FMA(vibration_axis_iz, x187, FMA(vibration_axis_iz, x185, vibration_axis_iz*x184))))))))); /* vibration-rectification.P_xz */
        rows[123][i] = bar_i_vibration_rectification*(FMA(vibration_axis_py, x192, FMA(vibration_axis_py, x190, FMA(vibration_axis_oy, x191, FMA(K7, vibration_axis_py*vibration_axis_py, FMA(K5, vibration_axis_oy*vibration_axis_oy, K2*vibration_axis_iy*vibration_axis_iy)))))); /* vibration-rectification.P_yy */
        rows[124][i] = bar_i_vibration_rectification*(FMA(vibration_axis_pz, x192, FMA(vibration_axis_pz, x190, FMA(vibration_axis_py, x195, FMA(vibration_axis_py, x193, FMA(vibration_axis_py, vibration_axis_pz*x90, FMA(vibration_axis_oz, x191, FMA(vibration_axis_oy, x194, FMA(vibration_axis_oy, vibration_axis_oz*x89, vibration_axis_iy*vibration_axis_iz*x88))))))))); /* vibration-rectification.P_yz */
        rows[125][i] = bar_i_vibration_rectification*(FMA(vibration_axis_pz, x195, FMA(vibration_axis_pz, x193, FMA(vibration_axis_oz, x194, FMA(K7, vibration_axis_pz*vibration_axis_pz, FMA(K5, vibration_axis_oz*vibration_axis_oz, K2*vibration_axis_iz*vibration_axis_iz)))))); /* vibration-rectification.P_zz */
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
