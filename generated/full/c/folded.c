/* The analytical model of the RAGG, folded for evaluation (paper, Eq. 1-15, with the rate of the disc in Eq. 9).
 * Derived; do not edit: change the derivation and run `make derive`. */
#include "folded.h"

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
enum { FOLDED = 49 };

typedef long double wide; /* what is folded once may be folded carefully */

/* The coefficients: all that the instrument's parameters contribute. */
static void fold(const double *p, double c[FOLDED]) {
    wide e[33][4];
    for (int j = 0; j < 4; ++j) {
        const wide radius = p[0];
        const wide dR = p[2 + j];
        const wide beta_x = p[6 + j];
        const wide beta_z = p[10 + j];
        const wide vartheta_x = p[14 + j];
        const wide vartheta_y = p[18 + j];
        const wide vartheta_z = p[22 + j];
        const wide K0 = p[26 + j];
        const wide K1 = p[30 + j];
        const wide K2 = p[34 + j];
        const wide K4 = p[38 + j];
        const wide K5 = p[42 + j];
        const wide K6 = p[46 + j];
        const wide K7 = p[50 + j];
        const wide K8 = p[54 + j];
        const wide k_VI = p[58 + j];
        const wide R = radius + dR, k1 = k_VI * K1;
        (void)vartheta_x;

        e[0][j] = R*k1;
        e[1][j] = k1;
        e[2][j] = K2*(R*R)*k1;
        e[3][j] = -K4*(R*R)*k1;
        e[4][j] = K5*(R*R)*k1;
        e[5][j] = K6*(R*R)*k1;
        e[6][j] = K7*(R*R)*k1;
        e[7][j] = -K8*(R*R)*k1;
        e[8][j] = (R*beta_x*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0);
        e[9][j] = (R*beta_x*k1)*(beta_x*vartheta_y - beta_z + vartheta_z);
        e[10][j] = (R*beta_x*k1)*(-beta_x*vartheta_z + vartheta_y);
        e[11][j] = (R*beta_z*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0);
        e[12][j] = (R*beta_z*k1)*(beta_x*vartheta_y - beta_z + vartheta_z);
        e[13][j] = (R*beta_z*k1)*(beta_x*vartheta_y + vartheta_z);
        e[14][j] = (R*beta_z*k1)*(-beta_x*vartheta_z + vartheta_y);
        e[15][j] = (R*k1)*(beta_x*vartheta_y - beta_z + vartheta_z);
        e[16][j] = (R*k1)*(-beta_x*vartheta_z + vartheta_y);
        e[17][j] = 2.0*K2*R*k1;
        e[18][j] = -K4*R*k1;
        e[19][j] = 2.0*K5*R*k1;
        e[20][j] = K6*R*k1;
        e[21][j] = 2.0*K7*R*k1;
        e[22][j] = -K8*R*k1;
        e[23][j] = (beta_z*k1)*(beta_x*vartheta_y + vartheta_z);
        e[24][j] = k1*(beta_x*vartheta_y - beta_z + vartheta_z);
        e[25][j] = k1*(-beta_x*vartheta_z + vartheta_y);
        e[26][j] = K0*k1;
        e[27][j] = K2*k1;
        e[28][j] = -K4*k1;
        e[29][j] = K5*k1;
        e[30][j] = K6*k1;
        e[31][j] = K7*k1;
        e[32][j] = -K8*k1;
    }
    c[0] = (double)(e[26][0] + e[26][1] - e[26][2] - e[26][3]);
    c[1] = (double)(e[1][2] - e[1][3] + e[24][0] - e[24][1] + e[23][2] - e[23][3]);
    c[2] = (double)(e[1][0] - e[1][1] + e[23][0] - e[23][1] - e[24][2] + e[24][3]);
    c[3] = (double)(e[25][0] + e[25][1] - e[25][2] - e[25][3]);
    c[4] = (double)(e[15][0] + e[15][1] - e[11][2] - e[11][3]);
    c[5] = (double)(e[0][2] + e[0][3] + e[12][0] + e[12][1] + e[13][2] + e[13][3]);
    c[6] = (double)(e[9][0] - e[9][1] + e[8][2] - e[8][3]);
    c[7] = (double)(e[0][0] + e[0][1] + e[13][0] + e[13][1] + e[12][2] + e[12][3]);
    c[8] = (double)(e[11][0] + e[11][1] - e[15][2] - e[15][3]);
    c[9] = (double)(e[8][0] - e[8][1] - e[9][2] + e[9][3]);
    c[10] = (double)(e[16][0] - e[16][1] + e[14][2] - e[14][3]);
    c[11] = (double)(e[14][0] - e[14][1] - e[16][2] + e[16][3]);
    c[12] = (double)(e[10][0] + e[10][1] - e[10][2] - e[10][3]);
    c[13] = (double)(e[29][0] + e[29][1] - e[27][2] - e[27][3]);
    c[14] = (double)(e[30][0] + e[30][1] + e[30][2] + e[30][3]);
    c[15] = (double)(e[32][0] - e[32][1] + e[28][2] - e[28][3]);
    c[16] = (double)(e[19][0] - e[19][1]);
    c[17] = (double)(-e[17][2] + e[17][3]);
    c[18] = (double)(e[20][0] - e[20][1]);
    c[19] = (double)(e[20][2] - e[20][3]);
    c[20] = (double)(e[22][0] + e[22][1]);
    c[21] = (double)(e[18][2] + e[18][3]);
    c[22] = (double)(e[27][0] + e[27][1] - e[29][2] - e[29][3]);
    c[23] = (double)(e[28][0] - e[28][1] - e[32][2] + e[32][3]);
    c[24] = (double)(e[20][0] - e[20][1]);
    c[25] = (double)(e[20][2] - e[20][3]);
    c[26] = (double)(e[17][0] - e[17][1]);
    c[27] = (double)(-e[19][2] + e[19][3]);
    c[28] = (double)(e[18][0] + e[18][1]);
    c[29] = (double)(-e[22][2] - e[22][3]);
    c[30] = (double)(e[31][0] + e[31][1] - e[31][2] - e[31][3]);
    c[31] = (double)(e[22][0] + e[22][1]);
    c[32] = (double)(e[18][2] + e[18][3]);
    c[33] = (double)(e[18][0] + e[18][1]);
    c[34] = (double)(-e[22][2] - e[22][3]);
    c[35] = (double)(e[21][0] - e[21][1]);
    c[36] = (double)(-e[21][2] + e[21][3]);
    c[37] = (double)(e[4][0] + e[4][1]);
    c[38] = (double)(e[5][0] + e[5][1]);
    c[39] = (double)(e[7][0] - e[7][1]);
    c[40] = (double)(-e[2][2] - e[2][3]);
    c[41] = (double)(e[5][2] + e[5][3]);
    c[42] = (double)(e[3][2] - e[3][3]);
    c[43] = (double)(e[2][0] + e[2][1]);
    c[44] = (double)(e[3][0] - e[3][1]);
    c[45] = (double)(-e[4][2] - e[4][3]);
    c[46] = (double)(-e[7][2] + e[7][3]);
    c[47] = (double)(e[6][0] + e[6][1]);
    c[48] = (double)(-e[6][2] - e[6][3]);
}

/* G_out of n samples from at on, by the cosine and sine of the disc angle. */
static inline void block(size_t n, const double *const *in, size_t at, const double *restrict cosine,
                         const double *restrict sine, const double c[FOLDED], double *restrict G) {
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
    for (size_t i = 0; i < n; ++i) {
        const double cos_phi = cosine[i], sin_phi = sine[i];
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
        const double of_platform_xr = FMA(M_xy, sin_phi, M_xx*cos_phi);
        const double of_platform_xt = FMA(-M_xx, sin_phi, M_xy*cos_phi);
        const double of_platform_yr = FMA(M_yy, sin_phi, M_yx*cos_phi);
        const double of_platform_yt = FMA(-M_yx, sin_phi, M_yy*cos_phi);
        const double of_platform_zr = FMA(M_zy, sin_phi, M_zx*cos_phi);
        const double of_platform_zt = FMA(-M_zx, sin_phi, M_zy*cos_phi);
        const double x3 = 2.0*d_spin_angle;
        const double x4 = omega_z*x3;
        const double x5 = (d_spin_angle*d_spin_angle);
        const double x6 = omega_x*x3;
        const double x7 = omega_y*x3;
        const double a_r = FMA(a_y, sin_phi, a_x*cos_phi);
        const double a_t = FMA(-a_x, sin_phi, a_y*cos_phi);
        const double M_rr = FMA(of_platform_yr, sin_phi, FMA(cos_phi, of_platform_xr, -x4 - x5));
        const double M_rt = FMA(of_platform_yt, sin_phi, FMA(cos_phi, of_platform_xt, -d2_spin_angle));
        const double M_rz = FMA(M_yz, sin_phi, M_xz*cos_phi);
        const double M_tr = FMA(-of_platform_xr, sin_phi, FMA(cos_phi, of_platform_yr, d2_spin_angle));
        const double M_tt = FMA(-of_platform_xt, sin_phi, FMA(cos_phi, of_platform_yt, -x4 - x5));
        const double M_tz = FMA(-M_xz, sin_phi, M_yz*cos_phi);
        const double M_zr = FMA(sin_phi, x7, FMA(cos_phi, x6, of_platform_zr));
        const double M_zt = FMA(-sin_phi, x6, FMA(cos_phi, x7, of_platform_zt));
        G[i] = FMA(a_z, FMA(a_z, c[30], FMA(M_zt, c[36], FMA(M_zr, c[35], FMA(M_tt, c[34], FMA(M_tr, c[33], FMA(M_rt, c[32], FMA(M_rr, c[31], c[3]))))))), FMA(a_t, FMA(a_z, c[23], FMA(a_t, c[22], FMA(M_zt, c[29], FMA(M_zr, c[28], FMA(M_tt, c[27], FMA(M_tr, c[26], FMA(M_rt, c[25], FMA(M_rr, c[24], c[2])))))))), FMA(a_r, FMA(a_z, c[15], FMA(a_t, c[14], FMA(a_r, c[13], FMA(M_zt, c[21], FMA(M_zr, c[20], FMA(M_tt, c[19], FMA(M_tr, c[18], FMA(M_rt, c[17], FMA(M_rr, c[16], c[1]))))))))), FMA(M_zz, c[12], FMA(M_zt, FMA(M_zt, c[48], c[11]), FMA(M_zr, FMA(M_zr, c[47], c[10]), FMA(M_tz, c[9], FMA(M_tt, FMA(M_zt, c[46], FMA(M_tt, c[45], c[8])), FMA(M_tr, FMA(M_zr, c[44], FMA(M_tr, c[43], c[7])), FMA(M_rz, c[6], FMA(M_rt, FMA(M_zt, c[42], FMA(M_tt, c[41], FMA(M_rt, c[40], c[5]))), FMA(M_rr, FMA(M_zr, c[39], FMA(M_tr, c[38], FMA(M_rr, c[37], c[4]))), c[0]))))))))))));
    }
}

enum { PIECE = 16 }; /* few: the arithmetic of the angle and the reading of the channels go on at once */

/* G_out of n <= PIECE samples from at on. */
static inline void piece(size_t n, size_t at, const double *t, const double *const *in, double spin_frequency,
                         const double *angle, const double c[FOLDED], double *G) {
    double cosine[PIECE], sine[PIECE];
    turning(at, at + n, t, spin_frequency, angle, cosine, sine);
    block(n, in, at, cosine, sine, c, G + at);
}

void ragg_folded_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                        double *G) {
    double c[FOLDED];
    size_t at = 0;
    fold(p, c);
    for (; at + PIECE <= n; at += PIECE) {
        piece(PIECE, at, t, in, p[1], angle, c, G);
    }
    piece(n - at, at, t, in, p[1], angle, c, G);
}
