/* The analytical model of the RAGG (paper, Eq. 16-19).
 * Derived; do not edit: change the derivation and run `make derive`. */
#include "analytical.h"

#include <math.h>

enum { AMPLITUDES = 9, FOLDED = 183, BASIS = 118, SLOPES = 14 };

/* Disc angle, rad, within half a turn of 0; the turns are dropped exactly, whatever the time. */
static double disc_angle(double t, double spin_frequency) {
    const double turns = spin_frequency * t;
    const double error = fma(spin_frequency, t, -turns);
    return 6.283185307179586476925286766559 * ((turns - nearbyint(turns)) + error);
}

static double D12(const double x[4]) { return x[0] - x[1]; }
static double D34(const double x[4]) { return x[2] - x[3]; }
static double D1234(const double x[4]) { return (x[0] + x[1]) - (x[2] + x[3]); }
static double Sigma(const double x[4]) { return (x[0] + x[1]) + (x[2] + x[3]); }

/* Error-propagation coefficients: all that the instrument's parameters contribute. */
static void fold(const double *p, double c[FOLDED]) {
    double e[78][4];
    for (size_t j = 0; j < 4; ++j) {
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
        const double R = radius + dR, k1 = k_VI * K1;
        (void)vartheta_x;

        e[0][j] = K0*k1;
        e[1][j] = k1*(-beta_x*vartheta_z + vartheta_y);
        e[2][j] = (R*k1)*(-beta_x*(beta_z*beta_z)*vartheta_y - beta_x*vartheta_y - (beta_z*beta_z)*vartheta_z - vartheta_z);
        e[3][j] = R*k1;
        e[4][j] = R*(beta_z*beta_z)*k1;
        e[5][j] = (R*beta_x*k1)*(beta_x*vartheta_z - vartheta_y);
        e[6][j] = (0.5*k1)*(K2 + K5);
        e[7][j] = -0.5*K4*R*k1;
        e[8][j] = 0.5*K8*R*k1;
        e[9][j] = 0.5*K4*R*k1;
        e[10][j] = K7*k1;
        e[11][j] = K8*R*k1;
        e[12][j] = -K4*R*k1;
        e[13][j] = (0.5*(R*R)*k1)*(K2 + K5);
        e[14][j] = 0.5*K7*(R*R)*k1;
        e[15][j] = K5*(R*R)*k1;
        e[16][j] = -K6*(R*R)*k1;
        e[17][j] = K2*(R*R)*k1;
        e[18][j] = k1*(beta_x*vartheta_y - beta_z + vartheta_z);
        e[19][j] = k1;
        e[20][j] = (beta_z*k1)*(beta_x*vartheta_y + vartheta_z);
        e[21][j] = k1*(-beta_x*vartheta_y + beta_z - vartheta_z);
        e[22][j] = (R*beta_z*k1)*(beta_x*vartheta_z - vartheta_y);
        e[23][j] = (R*k1)*(-beta_x*vartheta_z + vartheta_y);
        e[24][j] = (R*k1)*(beta_x*vartheta_z - vartheta_y);
        e[25][j] = (R*beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z);
        e[26][j] = (R*beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0);
        e[27][j] = (R*beta_x*k1)*(beta_x*vartheta_y - beta_z + vartheta_z);
        e[28][j] = -K8*k1;
        e[29][j] = -K4*k1;
        e[30][j] = (R*k1)*(-K2 - K5);
        e[31][j] = -2.0*K5*R*k1;
        e[32][j] = -K6*R*k1;
        e[33][j] = K6*R*k1;
        e[34][j] = 2.0*K2*R*k1;
        e[35][j] = K8*k1;
        e[36][j] = (R*k1)*(K2 + K5);
        e[37][j] = 2.0*K5*R*k1;
        e[38][j] = 2.0*K7*R*k1;
        e[39][j] = -2.0*K7*R*k1;
        e[40][j] = 0.5*K4*(R*R)*k1;
        e[41][j] = -0.5*K8*(R*R)*k1;
        e[42][j] = -0.5*K4*(R*R)*k1;
        e[43][j] = 0.5*K8*(R*R)*k1;
        e[44][j] = K8*(R*R)*k1;
        e[45][j] = -K4*(R*R)*k1;
        e[46][j] = -K8*(R*R)*k1;
        e[47][j] = K4*(R*R)*k1;
        e[48][j] = -k1;
        e[49][j] = (beta_z*k1)*(-beta_x*vartheta_y - vartheta_z);
        e[50][j] = (R*beta_z*k1)*(-beta_x*vartheta_z + vartheta_y);
        e[51][j] = (R*beta_x*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0);
        e[52][j] = K4*k1;
        e[53][j] = -2.0*K2*R*k1;
        e[54][j] = (R*k1)*(beta_x*(beta_z*beta_z)*vartheta_y - beta_x*vartheta_y + (beta_z*beta_z)*vartheta_z + 2.0*beta_z - vartheta_z);
        e[55][j] = (R*beta_z*k1)*(2.0*beta_x*vartheta_y - beta_z + 2.0*vartheta_z);
        e[56][j] = (0.5*k1)*(-K2 + K5);
        e[57][j] = K6*k1;
        e[58][j] = (0.5*k1)*(K2 - K5);
        e[59][j] = -0.5*K8*R*k1;
        e[60][j] = 2.0*K5*(R*R)*k1;
        e[61][j] = 2.0*K2*(R*R)*k1;
        e[62][j] = -0.5*K7*(R*R)*k1;
        e[63][j] = (R*k1)*(-beta_x*(beta_z*beta_z)*vartheta_y + beta_x*vartheta_y - (beta_z*beta_z)*vartheta_z - 2.0*beta_z + vartheta_z);
        e[64][j] = -0.5*K6*k1;
        e[65][j] = k1*(-K2 + K5);
        e[66][j] = 0.5*K6*k1;
        e[67][j] = -K8*R*k1;
        e[68][j] = -2.0*K5*(R*R)*k1;
        e[69][j] = K6*(R*R)*k1;
        e[70][j] = K7*(R*R)*k1;
        e[71][j] = (R*k1)*(K2 - K5);
        e[72][j] = (R*k1)*(-K2 + K5);
        e[73][j] = (0.5*(R*R)*k1)*(-K2 + K5);
        e[74][j] = (0.5*(R*R)*k1)*(K2 - K5);
        e[75][j] = -0.5*K6*(R*R)*k1;
        e[76][j] = ((R*R)*k1)*(K2 - K5);
        e[77][j] = 0.5*K6*(R*R)*k1;
    }
    c[0] = D1234(e[0]); /* K0*k1 */
    c[1] = D1234(e[1]); /* k1*(-beta_x*vartheta_z + vartheta_y) */
    c[2] = D1234(e[2]); /* (R*k1)*(-beta_x*(beta_z*beta_z)*vartheta_y - beta_x*vartheta_y - (beta_z*beta_z)*vartheta_z - vartheta_z) */
    c[3] = D1234(e[3]); /* R*k1 */
    c[4] = D1234(e[4]); /* R*(beta_z*beta_z)*k1 */
    c[5] = D1234(e[5]); /* (R*beta_x*k1)*(beta_x*vartheta_z - vartheta_y) */
    c[6] = D1234(e[6]); /* (0.5*k1)*(K2 + K5) */
    c[7] = D1234(e[7]); /* -0.5*K4*R*k1 */
    c[8] = D1234(e[8]); /* 0.5*K8*R*k1 */
    c[9] = D1234(e[6]); /* (0.5*k1)*(K2 + K5) */
    c[10] = D1234(e[8]); /* 0.5*K8*R*k1 */
    c[11] = D1234(e[9]); /* 0.5*K4*R*k1 */
    c[12] = D1234(e[10]); /* K7*k1 */
    c[13] = D1234(e[11]); /* K8*R*k1 */
    c[14] = D1234(e[12]); /* -K4*R*k1 */
    c[15] = D1234(e[13]); /* (0.5*(R*R)*k1)*(K2 + K5) */
    c[16] = D1234(e[13]); /* (0.5*(R*R)*k1)*(K2 + K5) */
    c[17] = D1234(e[14]); /* 0.5*K7*(R*R)*k1 */
    c[18] = D1234(e[14]); /* 0.5*K7*(R*R)*k1 */
    c[19] = D1234(e[15]); /* K5*(R*R)*k1 */
    c[20] = D1234(e[16]); /* -K6*(R*R)*k1 */
    c[21] = D1234(e[17]); /* K2*(R*R)*k1 */
    c[22] = D12(e[18]); /* k1*(beta_x*vartheta_y - beta_z + vartheta_z) */
    c[23] = D34(e[19]); /* k1 */
    c[24] = D34(e[20]); /* (beta_z*k1)*(beta_x*vartheta_y + vartheta_z) */
    c[25] = D12(e[19]); /* k1 */
    c[26] = D12(e[20]); /* (beta_z*k1)*(beta_x*vartheta_y + vartheta_z) */
    c[27] = D34(e[21]); /* k1*(-beta_x*vartheta_y + beta_z - vartheta_z) */
    c[28] = D12(e[22]); /* (R*beta_z*k1)*(beta_x*vartheta_z - vartheta_y) */
    c[29] = D34(e[23]); /* (R*k1)*(-beta_x*vartheta_z + vartheta_y) */
    c[30] = D12(e[24]); /* (R*k1)*(beta_x*vartheta_z - vartheta_y) */
    c[31] = D34(e[22]); /* (R*beta_z*k1)*(beta_x*vartheta_z - vartheta_y) */
    c[32] = D12(e[25]); /* (R*beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z) */
    c[33] = D34(e[26]); /* (R*beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0) */
    c[34] = D12(e[26]); /* (R*beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0) */
    c[35] = D34(e[27]); /* (R*beta_x*k1)*(beta_x*vartheta_y - beta_z + vartheta_z) */
    c[36] = D12(e[28]); /* -K8*k1 */
    c[37] = D34(e[29]); /* -K4*k1 */
    c[38] = D12(e[30]); /* (R*k1)*(-K2 - K5) */
    c[39] = D34(e[30]); /* (R*k1)*(-K2 - K5) */
    c[40] = D12(e[31]); /* -2.0*K5*R*k1 */
    c[41] = D34(e[32]); /* -K6*R*k1 */
    c[42] = D12(e[33]); /* K6*R*k1 */
    c[43] = D34(e[34]); /* 2.0*K2*R*k1 */
    c[44] = D12(e[29]); /* -K4*k1 */
    c[45] = D34(e[35]); /* K8*k1 */
    c[46] = D34(e[30]); /* (R*k1)*(-K2 - K5) */
    c[47] = D12(e[36]); /* (R*k1)*(K2 + K5) */
    c[48] = D12(e[32]); /* -K6*R*k1 */
    c[49] = D34(e[37]); /* 2.0*K5*R*k1 */
    c[50] = D12(e[34]); /* 2.0*K2*R*k1 */
    c[51] = D34(e[32]); /* -K6*R*k1 */
    c[52] = D34(e[38]); /* 2.0*K7*R*k1 */
    c[53] = D12(e[39]); /* -2.0*K7*R*k1 */
    c[54] = D12(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[55] = D34(e[41]); /* -0.5*K8*(R*R)*k1 */
    c[56] = D12(e[41]); /* -0.5*K8*(R*R)*k1 */
    c[57] = D34(e[42]); /* -0.5*K4*(R*R)*k1 */
    c[58] = D12(e[43]); /* 0.5*K8*(R*R)*k1 */
    c[59] = D34(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[60] = D12(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[61] = D34(e[41]); /* -0.5*K8*(R*R)*k1 */
    c[62] = D34(e[44]); /* K8*(R*R)*k1 */
    c[63] = D34(e[45]); /* -K4*(R*R)*k1 */
    c[64] = D12(e[46]); /* -K8*(R*R)*k1 */
    c[65] = D12(e[47]); /* K4*(R*R)*k1 */
    c[66] = D12(e[48]); /* -k1 */
    c[67] = D12(e[49]); /* (beta_z*k1)*(-beta_x*vartheta_y - vartheta_z) */
    c[68] = D34(e[18]); /* k1*(beta_x*vartheta_y - beta_z + vartheta_z) */
    c[69] = D12(e[18]); /* k1*(beta_x*vartheta_y - beta_z + vartheta_z) */
    c[70] = D34(e[19]); /* k1 */
    c[71] = D34(e[20]); /* (beta_z*k1)*(beta_x*vartheta_y + vartheta_z) */
    c[72] = D12(e[24]); /* (R*k1)*(beta_x*vartheta_z - vartheta_y) */
    c[73] = D34(e[22]); /* (R*beta_z*k1)*(beta_x*vartheta_z - vartheta_y) */
    c[74] = D12(e[50]); /* (R*beta_z*k1)*(-beta_x*vartheta_z + vartheta_y) */
    c[75] = D34(e[24]); /* (R*k1)*(beta_x*vartheta_z - vartheta_y) */
    c[76] = D12(e[51]); /* (R*beta_x*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0) */
    c[77] = D34(e[25]); /* (R*beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z) */
    c[78] = D12(e[25]); /* (R*beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z) */
    c[79] = D34(e[26]); /* (R*beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0) */
    c[80] = D12(e[52]); /* K4*k1 */
    c[81] = D34(e[28]); /* -K8*k1 */
    c[82] = D34(e[30]); /* (R*k1)*(-K2 - K5) */
    c[83] = D12(e[36]); /* (R*k1)*(K2 + K5) */
    c[84] = D12(e[33]); /* K6*R*k1 */
    c[85] = D34(e[31]); /* -2.0*K5*R*k1 */
    c[86] = D12(e[53]); /* -2.0*K2*R*k1 */
    c[87] = D34(e[33]); /* K6*R*k1 */
    c[88] = D12(e[28]); /* -K8*k1 */
    c[89] = D34(e[29]); /* -K4*k1 */
    c[90] = D12(e[36]); /* (R*k1)*(K2 + K5) */
    c[91] = D34(e[36]); /* (R*k1)*(K2 + K5) */
    c[92] = D12(e[31]); /* -2.0*K5*R*k1 */
    c[93] = D34(e[32]); /* -K6*R*k1 */
    c[94] = D12(e[33]); /* K6*R*k1 */
    c[95] = D34(e[34]); /* 2.0*K2*R*k1 */
    c[96] = D12(e[39]); /* -2.0*K7*R*k1 */
    c[97] = D34(e[39]); /* -2.0*K7*R*k1 */
    c[98] = D12(e[43]); /* 0.5*K8*(R*R)*k1 */
    c[99] = D34(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[100] = D12(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[101] = D34(e[41]); /* -0.5*K8*(R*R)*k1 */
    c[102] = D12(e[42]); /* -0.5*K4*(R*R)*k1 */
    c[103] = D34(e[43]); /* 0.5*K8*(R*R)*k1 */
    c[104] = D12(e[43]); /* 0.5*K8*(R*R)*k1 */
    c[105] = D34(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[106] = D12(e[46]); /* -K8*(R*R)*k1 */
    c[107] = D12(e[47]); /* K4*(R*R)*k1 */
    c[108] = D34(e[46]); /* -K8*(R*R)*k1 */
    c[109] = D34(e[47]); /* K4*(R*R)*k1 */
    c[110] = Sigma(e[54]); /* (R*k1)*(beta_x*(beta_z*beta_z)*vartheta_y - beta_x*vartheta_y + (beta_z*beta_z)*vartheta_z + 2.0*beta_z - vartheta_z) */
    c[111] = Sigma(e[3]); /* R*k1 */
    c[112] = Sigma(e[55]); /* (R*beta_z*k1)*(2.0*beta_x*vartheta_y - beta_z + 2.0*vartheta_z) */
    c[113] = Sigma(e[56]); /* (0.5*k1)*(-K2 + K5) */
    c[114] = Sigma(e[57]); /* K6*k1 */
    c[115] = Sigma(e[9]); /* 0.5*K4*R*k1 */
    c[116] = Sigma(e[8]); /* 0.5*K8*R*k1 */
    c[117] = Sigma(e[58]); /* (0.5*k1)*(K2 - K5) */
    c[118] = Sigma(e[59]); /* -0.5*K8*R*k1 */
    c[119] = Sigma(e[9]); /* 0.5*K4*R*k1 */
    c[120] = Sigma(e[11]); /* K8*R*k1 */
    c[121] = Sigma(e[12]); /* -K4*R*k1 */
    c[122] = Sigma(e[60]); /* 2.0*K5*(R*R)*k1 */
    c[123] = Sigma(e[16]); /* -K6*(R*R)*k1 */
    c[124] = Sigma(e[16]); /* -K6*(R*R)*k1 */
    c[125] = Sigma(e[61]); /* 2.0*K2*(R*R)*k1 */
    c[126] = Sigma(e[62]); /* -0.5*K7*(R*R)*k1 */
    c[127] = Sigma(e[14]); /* 0.5*K7*(R*R)*k1 */
    c[128] = Sigma(e[3]); /* R*k1 */
    c[129] = Sigma(e[55]); /* (R*beta_z*k1)*(2.0*beta_x*vartheta_y - beta_z + 2.0*vartheta_z) */
    c[130] = Sigma(e[63]); /* (R*k1)*(-beta_x*(beta_z*beta_z)*vartheta_y + beta_x*vartheta_y - (beta_z*beta_z)*vartheta_z - 2.0*beta_z + vartheta_z) */
    c[131] = Sigma(e[64]); /* -0.5*K6*k1 */
    c[132] = Sigma(e[65]); /* k1*(-K2 + K5) */
    c[133] = Sigma(e[8]); /* 0.5*K8*R*k1 */
    c[134] = Sigma(e[7]); /* -0.5*K4*R*k1 */
    c[135] = Sigma(e[66]); /* 0.5*K6*k1 */
    c[136] = Sigma(e[9]); /* 0.5*K4*R*k1 */
    c[137] = Sigma(e[8]); /* 0.5*K8*R*k1 */
    c[138] = Sigma(e[12]); /* -K4*R*k1 */
    c[139] = Sigma(e[67]); /* -K8*R*k1 */
    c[140] = Sigma(e[16]); /* -K6*(R*R)*k1 */
    c[141] = Sigma(e[61]); /* 2.0*K2*(R*R)*k1 */
    c[142] = Sigma(e[68]); /* -2.0*K5*(R*R)*k1 */
    c[143] = Sigma(e[69]); /* K6*(R*R)*k1 */
    c[144] = Sigma(e[70]); /* K7*(R*R)*k1 */
    c[145] = D12(e[71]); /* (R*k1)*(K2 - K5) */
    c[146] = D34(e[33]); /* K6*R*k1 */
    c[147] = D12(e[33]); /* K6*R*k1 */
    c[148] = D34(e[72]); /* (R*k1)*(-K2 + K5) */
    c[149] = D12(e[32]); /* -K6*R*k1 */
    c[150] = D34(e[71]); /* (R*k1)*(K2 - K5) */
    c[151] = D12(e[71]); /* (R*k1)*(K2 - K5) */
    c[152] = D34(e[33]); /* K6*R*k1 */
    c[153] = D12(e[42]); /* -0.5*K4*(R*R)*k1 */
    c[154] = D34(e[41]); /* -0.5*K8*(R*R)*k1 */
    c[155] = D12(e[41]); /* -0.5*K8*(R*R)*k1 */
    c[156] = D34(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[157] = D12(e[41]); /* -0.5*K8*(R*R)*k1 */
    c[158] = D34(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[159] = D12(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[160] = D34(e[43]); /* 0.5*K8*(R*R)*k1 */
    c[161] = D12(e[33]); /* K6*R*k1 */
    c[162] = D34(e[72]); /* (R*k1)*(-K2 + K5) */
    c[163] = D12(e[72]); /* (R*k1)*(-K2 + K5) */
    c[164] = D34(e[32]); /* -K6*R*k1 */
    c[165] = D12(e[71]); /* (R*k1)*(K2 - K5) */
    c[166] = D34(e[33]); /* K6*R*k1 */
    c[167] = D12(e[33]); /* K6*R*k1 */
    c[168] = D34(e[72]); /* (R*k1)*(-K2 + K5) */
    c[169] = D12(e[41]); /* -0.5*K8*(R*R)*k1 */
    c[170] = D34(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[171] = D12(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[172] = D34(e[43]); /* 0.5*K8*(R*R)*k1 */
    c[173] = D12(e[40]); /* 0.5*K4*(R*R)*k1 */
    c[174] = D34(e[43]); /* 0.5*K8*(R*R)*k1 */
    c[175] = D12(e[43]); /* 0.5*K8*(R*R)*k1 */
    c[176] = D34(e[42]); /* -0.5*K4*(R*R)*k1 */
    c[177] = D1234(e[73]); /* (0.5*(R*R)*k1)*(-K2 + K5) */
    c[178] = D1234(e[16]); /* -K6*(R*R)*k1 */
    c[179] = D1234(e[74]); /* (0.5*(R*R)*k1)*(K2 - K5) */
    c[180] = D1234(e[75]); /* -0.5*K6*(R*R)*k1 */
    c[181] = D1234(e[76]); /* ((R*R)*k1)*(K2 - K5) */
    c[182] = D1234(e[77]); /* 0.5*K6*(R*R)*k1 */
}

static void evaluate(const double *in, const double c[FOLDED], double A[AMPLITUDES]) {
    const double a_x = in[0];
    const double a_y = in[1];
    const double a_z = in[2];
    const double omega_x = in[3];
    const double omega_y = in[4];
    const double omega_z = in[5];
    const double omegadot_x = in[6];
    const double omegadot_y = in[7];
    const double omegadot_z = in[8];
    const double Gamma_xx = in[9];
    const double Gamma_xy = in[10];
    const double Gamma_xz = in[11];
    const double Gamma_yy = in[12];
    const double Gamma_yz = in[13];
    const double Gamma_zz = in[14];
    const double T_1 = 0.5*Gamma_xx - 0.5*Gamma_yy - 0.5*(omega_x*omega_x) + 0.5*(omega_y*omega_y);
    const double T_2 = -Gamma_xy + omega_x*omega_y;
    const double T_3 = Gamma_yz - omega_y*omega_z - omegadot_x;
    const double T_4 = Gamma_xz - omega_x*omega_z + omegadot_y;
    const double T_5 = 0.5*Gamma_xx + 0.5*Gamma_yy + 0.5*(omega_x*omega_x) + 0.5*(omega_y*omega_y) + (omega_z*omega_z);
    const double T_6 = omegadot_z;
    const double S_1 = Gamma_xz - omega_x*omega_z - omegadot_y;
    const double S_2 = Gamma_yz - omega_y*omega_z + omegadot_x;
    const double S_4 = Gamma_zz + (omega_x*omega_x) + (omega_y*omega_y);
    (void)a_x;
    (void)a_y;
    (void)a_z;
    (void)omega_x;
    (void)omega_y;
    (void)omega_z;
    (void)omegadot_x;
    (void)omegadot_y;
    (void)omegadot_z;
    (void)Gamma_xx;
    (void)Gamma_xy;
    (void)Gamma_xz;
    (void)Gamma_yy;
    (void)Gamma_yz;
    (void)Gamma_zz;

    A[0] = /* A_0 */
        (c[0])
        + (c[1]) * (a_z)
        + (c[2]) * (T_5)
        + (c[3] + c[4]) * (T_6)
        + (c[5]) * (S_4)
        + (c[6]) * ((a_x*a_x))
        + (c[7]) * (T_3*a_x)
        + (c[8]) * (T_4*a_x)
        + (c[9]) * ((a_y*a_y))
        + (c[10]) * (T_3*a_y)
        + (c[11]) * (T_4*a_y)
        + (c[12]) * ((a_z*a_z))
        + (c[13]) * (T_5*a_z)
        + (c[14]) * (T_6*a_z)
        + (c[15]) * ((T_1*T_1))
        + (c[16]) * ((T_2*T_2))
        + (c[17]) * ((T_3*T_3))
        + (c[18]) * ((T_4*T_4))
        + (c[19]) * ((T_5*T_5))
        + (c[20]) * (T_5*T_6)
        + (c[21]) * ((T_6*T_6))
        ;
    A[1] = /* A_1c */
        (c[22] + c[23] + c[24]) * (a_x)
        + (c[25] + c[26] + c[27]) * (a_y)
        + (c[28] + c[29]) * (T_3)
        + (c[30] + c[31]) * (T_4)
        + (c[32] + c[33]) * (S_1)
        + (c[34] + c[35]) * (S_2)
        + (c[36] + c[37]) * (a_x*a_z)
        + (c[38]) * (T_1*a_x)
        + (c[39]) * (T_2*a_x)
        + (c[40] + c[41]) * (T_5*a_x)
        + (c[42] + c[43]) * (T_6*a_x)
        + (c[44] + c[45]) * (a_y*a_z)
        + (c[46]) * (T_1*a_y)
        + (c[47]) * (T_2*a_y)
        + (c[48] + c[49]) * (T_5*a_y)
        + (c[50] + c[51]) * (T_6*a_y)
        + (c[52]) * (T_3*a_z)
        + (c[53]) * (T_4*a_z)
        + (c[54] + c[55]) * (T_1*T_3)
        + (c[56] + c[57]) * (T_1*T_4)
        + (c[58] + c[59]) * (T_2*T_3)
        + (c[60] + c[61]) * (T_2*T_4)
        + (c[62]) * (T_3*T_5)
        + (c[63]) * (T_3*T_6)
        + (c[64]) * (T_4*T_5)
        + (c[65]) * (T_4*T_6)
        ;
    A[2] = /* A_1s */
        (c[66] + c[67] + c[68]) * (a_x)
        + (c[69] + c[70] + c[71]) * (a_y)
        + (c[72] + c[73]) * (T_3)
        + (c[74] + c[75]) * (T_4)
        + (c[76] + c[77]) * (S_1)
        + (c[78] + c[79]) * (S_2)
        + (c[80] + c[81]) * (a_x*a_z)
        + (c[82]) * (T_1*a_x)
        + (c[83]) * (T_2*a_x)
        + (c[84] + c[85]) * (T_5*a_x)
        + (c[86] + c[87]) * (T_6*a_x)
        + (c[88] + c[89]) * (a_y*a_z)
        + (c[90]) * (T_1*a_y)
        + (c[91]) * (T_2*a_y)
        + (c[92] + c[93]) * (T_5*a_y)
        + (c[94] + c[95]) * (T_6*a_y)
        + (c[96]) * (T_3*a_z)
        + (c[97]) * (T_4*a_z)
        + (c[98] + c[99]) * (T_1*T_3)
        + (c[100] + c[101]) * (T_1*T_4)
        + (c[102] + c[103]) * (T_2*T_3)
        + (c[104] + c[105]) * (T_2*T_4)
        + (c[106]) * (T_3*T_5)
        + (c[107]) * (T_3*T_6)
        + (c[108]) * (T_4*T_5)
        + (c[109]) * (T_4*T_6)
        ;
    A[3] = /* A_2c */
        (c[110]) * (T_1)
        + (c[111] + c[112]) * (T_2)
        + (c[113]) * ((a_x*a_x))
        + (c[114]) * (a_x*a_y)
        + (c[115]) * (T_3*a_x)
        + (c[116]) * (T_4*a_x)
        + (c[117]) * ((a_y*a_y))
        + (c[118]) * (T_3*a_y)
        + (c[119]) * (T_4*a_y)
        + (c[120]) * (T_1*a_z)
        + (c[121]) * (T_2*a_z)
        + (c[122]) * (T_1*T_5)
        + (c[123]) * (T_1*T_6)
        + (c[124]) * (T_2*T_5)
        + (c[125]) * (T_2*T_6)
        + (c[126]) * ((T_3*T_3))
        + (c[127]) * ((T_4*T_4))
        ;
    A[4] = /* A_2s */
        (c[128] + c[129]) * (T_1)
        + (c[130]) * (T_2)
        + (c[131]) * ((a_x*a_x))
        + (c[132]) * (a_x*a_y)
        + (c[133]) * (T_3*a_x)
        + (c[134]) * (T_4*a_x)
        + (c[135]) * ((a_y*a_y))
        + (c[136]) * (T_3*a_y)
        + (c[137]) * (T_4*a_y)
        + (c[138]) * (T_1*a_z)
        + (c[139]) * (T_2*a_z)
        + (c[140]) * (T_1*T_5)
        + (c[141]) * (T_1*T_6)
        + (c[142]) * (T_2*T_5)
        + (c[143]) * (T_2*T_6)
        + (c[144]) * (T_3*T_4)
        ;
    A[5] = /* A_3c */
        (c[145] + c[146]) * (T_1*a_x)
        + (c[147] + c[148]) * (T_2*a_x)
        + (c[149] + c[150]) * (T_1*a_y)
        + (c[151] + c[152]) * (T_2*a_y)
        + (c[153] + c[154]) * (T_1*T_3)
        + (c[155] + c[156]) * (T_1*T_4)
        + (c[157] + c[158]) * (T_2*T_3)
        + (c[159] + c[160]) * (T_2*T_4)
        ;
    A[6] = /* A_3s */
        (c[161] + c[162]) * (T_1*a_x)
        + (c[163] + c[164]) * (T_2*a_x)
        + (c[165] + c[166]) * (T_1*a_y)
        + (c[167] + c[168]) * (T_2*a_y)
        + (c[169] + c[170]) * (T_1*T_3)
        + (c[171] + c[172]) * (T_1*T_4)
        + (c[173] + c[174]) * (T_2*T_3)
        + (c[175] + c[176]) * (T_2*T_4)
        ;
    A[7] = /* A_4c */
        (c[177]) * ((T_1*T_1))
        + (c[178]) * (T_1*T_2)
        + (c[179]) * ((T_2*T_2))
        ;
    A[8] = /* A_4s */
        (c[180]) * ((T_1*T_1))
        + (c[181]) * (T_1*T_2)
        + (c[182]) * ((T_2*T_2))
        ;
}

void ragg_analytical_amplitudes(const double in[RAGG_ANALYTICAL_INPUTS], const double p[RAGG_ANALYTICAL_PARAMETERS],
                              double A[RAGG_ANALYTICAL_AMPLITUDES]) {
    double c[FOLDED];
    fold(p, c);
    evaluate(in, c, A);
}

void ragg_analytical_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                          double *G) {
    double c[FOLDED];
    fold(p, c);
    for (size_t i = 0; i < n; ++i) {
        double x[RAGG_ANALYTICAL_INPUTS], A[AMPLITUDES];
        for (size_t k = 0; k < RAGG_ANALYTICAL_INPUTS; ++k) {
            x[k] = in[k][i];
        }
        evaluate(x, c, A);
        const double phi = angle ? angle[i] : disc_angle(t[i], p[1]);
        double g = A[0];
        for (size_t h = 1; 2 * h < AMPLITUDES; ++h) {
            g += A[2 * h - 1] * cos((double)h * phi) + A[2 * h] * sin((double)h * phi);
        }
        G[i] = g;
    }
}

/* Harmonics of an accelerometer's own angle times motion monomials. */
static void basis(double psi, const double *in, double X[BASIS]) {
    const double a_x = in[0];
    const double a_y = in[1];
    const double a_z = in[2];
    const double omega_x = in[3];
    const double omega_y = in[4];
    const double omega_z = in[5];
    const double omegadot_x = in[6];
    const double omegadot_y = in[7];
    const double omegadot_z = in[8];
    const double Gamma_xx = in[9];
    const double Gamma_xy = in[10];
    const double Gamma_xz = in[11];
    const double Gamma_yy = in[12];
    const double Gamma_yz = in[13];
    const double Gamma_zz = in[14];
    const double T_1 = 0.5*Gamma_xx - 0.5*Gamma_yy - 0.5*(omega_x*omega_x) + 0.5*(omega_y*omega_y);
    const double T_2 = -Gamma_xy + omega_x*omega_y;
    const double T_3 = Gamma_yz - omega_y*omega_z - omegadot_x;
    const double T_4 = Gamma_xz - omega_x*omega_z + omegadot_y;
    const double T_5 = 0.5*Gamma_xx + 0.5*Gamma_yy + 0.5*(omega_x*omega_x) + 0.5*(omega_y*omega_y) + (omega_z*omega_z);
    const double T_6 = omegadot_z;
    const double S_1 = Gamma_xz - omega_x*omega_z - omegadot_y;
    const double S_2 = Gamma_yz - omega_y*omega_z + omegadot_x;
    const double S_4 = Gamma_zz + (omega_x*omega_x) + (omega_y*omega_y);
    (void)a_x;
    (void)a_y;
    (void)a_z;
    (void)omega_x;
    (void)omega_y;
    (void)omega_z;
    (void)omegadot_x;
    (void)omegadot_y;
    (void)omegadot_z;
    (void)Gamma_xx;
    (void)Gamma_xy;
    (void)Gamma_xz;
    (void)Gamma_yy;
    (void)Gamma_yz;
    (void)Gamma_zz;

    const double c1 = cos(1.0 * psi), s1 = sin(1.0 * psi);
    const double c2 = cos(2.0 * psi), s2 = sin(2.0 * psi);
    const double c3 = cos(3.0 * psi), s3 = sin(3.0 * psi);
    const double c4 = cos(4.0 * psi), s4 = sin(4.0 * psi);
    X[0] = 1.0 * ((a_x*a_x));
    X[1] = 1.0 * (T_3*a_x);
    X[2] = 1.0 * (T_4*a_x);
    X[3] = 1.0 * ((a_y*a_y));
    X[4] = 1.0 * (T_3*a_y);
    X[5] = 1.0 * (T_4*a_y);
    X[6] = 1.0 * ((a_z*a_z));
    X[7] = 1.0 * (T_5*a_z);
    X[8] = 1.0 * (T_6*a_z);
    X[9] = 1.0 * (a_z);
    X[10] = 1.0 * ((T_1*T_1));
    X[11] = 1.0 * ((T_2*T_2));
    X[12] = 1.0 * ((T_3*T_3));
    X[13] = 1.0 * ((T_4*T_4));
    X[14] = 1.0 * ((T_5*T_5));
    X[15] = 1.0 * (T_5*T_6);
    X[16] = 1.0 * (T_5);
    X[17] = 1.0 * ((T_6*T_6));
    X[18] = 1.0 * (T_6);
    X[19] = 1.0 * (S_4);
    X[20] = 1.0;
    X[21] = c1 * (a_x*a_z);
    X[22] = c1 * (T_1*a_x);
    X[23] = c1 * (T_5*a_x);
    X[24] = c1 * (T_6*a_x);
    X[25] = c1 * (a_x);
    X[26] = c1 * (a_y*a_z);
    X[27] = c1 * (T_2*a_y);
    X[28] = c1 * (T_5*a_y);
    X[29] = c1 * (T_6*a_y);
    X[30] = c1 * (a_y);
    X[31] = c1 * (T_4*a_z);
    X[32] = c1 * (T_1*T_3);
    X[33] = c1 * (T_1*T_4);
    X[34] = c1 * (T_2*T_3);
    X[35] = c1 * (T_2*T_4);
    X[36] = c1 * (T_3);
    X[37] = c1 * (T_4*T_5);
    X[38] = c1 * (T_4*T_6);
    X[39] = c1 * (T_4);
    X[40] = c1 * (S_1);
    X[41] = c1 * (S_2);
    X[42] = s1 * (a_x*a_z);
    X[43] = s1 * (T_2*a_x);
    X[44] = s1 * (T_5*a_x);
    X[45] = s1 * (T_6*a_x);
    X[46] = s1 * (a_x);
    X[47] = s1 * (a_y*a_z);
    X[48] = s1 * (T_1*a_y);
    X[49] = s1 * (T_5*a_y);
    X[50] = s1 * (T_6*a_y);
    X[51] = s1 * (a_y);
    X[52] = s1 * (T_3*a_z);
    X[53] = s1 * (T_1*T_3);
    X[54] = s1 * (T_1*T_4);
    X[55] = s1 * (T_2*T_3);
    X[56] = s1 * (T_2*T_4);
    X[57] = s1 * (T_3*T_5);
    X[58] = s1 * (T_3*T_6);
    X[59] = s1 * (T_3);
    X[60] = s1 * (T_4);
    X[61] = s1 * (S_1);
    X[62] = s1 * (S_2);
    X[63] = c2 * ((a_x*a_x));
    X[64] = c2 * (a_x*a_y);
    X[65] = c2 * (T_3*a_x);
    X[66] = c2 * (T_4*a_x);
    X[67] = c2 * ((a_y*a_y));
    X[68] = c2 * (T_3*a_y);
    X[69] = c2 * (T_4*a_y);
    X[70] = c2 * (T_1*a_z);
    X[71] = c2 * (T_2*a_z);
    X[72] = c2 * (T_1*T_5);
    X[73] = c2 * (T_1*T_6);
    X[74] = c2 * (T_1);
    X[75] = c2 * (T_2*T_5);
    X[76] = c2 * (T_2*T_6);
    X[77] = c2 * (T_2);
    X[78] = c2 * ((T_3*T_3));
    X[79] = c2 * ((T_4*T_4));
    X[80] = s2 * ((a_x*a_x));
    X[81] = s2 * (a_x*a_y);
    X[82] = s2 * (T_3*a_x);
    X[83] = s2 * (T_4*a_x);
    X[84] = s2 * ((a_y*a_y));
    X[85] = s2 * (T_3*a_y);
    X[86] = s2 * (T_4*a_y);
    X[87] = s2 * (T_1*a_z);
    X[88] = s2 * (T_2*a_z);
    X[89] = s2 * (T_1*T_5);
    X[90] = s2 * (T_1*T_6);
    X[91] = s2 * (T_1);
    X[92] = s2 * (T_2*T_5);
    X[93] = s2 * (T_2*T_6);
    X[94] = s2 * (T_2);
    X[95] = s2 * (T_3*T_4);
    X[96] = c3 * (T_1*a_x);
    X[97] = c3 * (T_2*a_x);
    X[98] = c3 * (T_1*a_y);
    X[99] = c3 * (T_2*a_y);
    X[100] = c3 * (T_1*T_3);
    X[101] = c3 * (T_1*T_4);
    X[102] = c3 * (T_2*T_3);
    X[103] = c3 * (T_2*T_4);
    X[104] = s3 * (T_1*a_x);
    X[105] = s3 * (T_2*a_x);
    X[106] = s3 * (T_1*a_y);
    X[107] = s3 * (T_2*a_y);
    X[108] = s3 * (T_1*T_3);
    X[109] = s3 * (T_1*T_4);
    X[110] = s3 * (T_2*T_3);
    X[111] = s3 * (T_2*T_4);
    X[112] = c4 * ((T_1*T_1));
    X[113] = c4 * (T_1*T_2);
    X[114] = c4 * ((T_2*T_2));
    X[115] = s4 * ((T_1*T_1));
    X[116] = s4 * (T_1*T_2);
    X[117] = s4 * ((T_2*T_2));
}

/* Derivatives of the basis' coefficients by k1, R, beta_x, beta_z, vartheta_x, vartheta_y, vartheta_z, K0, K2, K4, K5, K6, K7, K8. */
static void slopes(const double *p, size_t j, double C[SLOPES][BASIS]) {
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
        const double R = radius + dR, k1 = k_VI * K1;
        (void)vartheta_x;

    for (size_t a = 0; a < SLOPES; ++a) {
        for (size_t b = 0; b < BASIS; ++b) {
            C[a][b] = 0.0;
        }
    }
    C[0][0] = 0.5*(K2 + K5);
    C[0][1] = -0.5*K4*R;
    C[0][2] = 0.5*K8*R;
    C[0][3] = 0.5*(K2 + K5);
    C[0][4] = 0.5*K8*R;
    C[0][5] = 0.5*K4*R;
    C[0][6] = K7;
    C[0][7] = K8*R;
    C[0][8] = -K4*R;
    C[0][9] = 1.0*(-beta_x*vartheta_z + vartheta_y);
    C[0][10] = (0.5*(R*R))*(K2 + K5);
    C[0][11] = (0.5*(R*R))*(K2 + K5);
    C[0][12] = 0.5*K7*(R*R);
    C[0][13] = 0.5*K7*(R*R);
    C[0][14] = K5*(R*R);
    C[0][15] = -K6*(R*R);
    C[0][16] = R*(-beta_x*(beta_z*beta_z)*vartheta_y - beta_x*vartheta_y - (beta_z*beta_z)*vartheta_z - vartheta_z);
    C[0][17] = K2*(R*R);
    C[0][18] = R*((beta_z*beta_z) + 1.0);
    C[0][19] = (R*beta_x)*(beta_x*vartheta_z - vartheta_y);
    C[0][20] = K0;
    C[0][21] = -K8;
    C[0][22] = R*(-K2 - K5);
    C[0][23] = -2.0*K5*R;
    C[0][24] = K6*R;
    C[0][25] = 1.0*(beta_x*vartheta_y - beta_z + vartheta_z);
    C[0][26] = -K4;
    C[0][27] = R*(K2 + K5);
    C[0][28] = -K6*R;
    C[0][29] = 2.0*K2*R;
    C[0][30] = 1.0*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0);
    C[0][31] = -2.0*K7*R;
    C[0][32] = 0.5*K4*(R*R);
    C[0][33] = -0.5*K8*(R*R);
    C[0][34] = 0.5*K8*(R*R);
    C[0][35] = 0.5*K4*(R*R);
    C[0][36] = (R*beta_z)*(beta_x*vartheta_z - vartheta_y);
    C[0][37] = -K8*(R*R);
    C[0][38] = K4*(R*R);
    C[0][39] = R*(beta_x*vartheta_z - vartheta_y);
    C[0][40] = (R*beta_x)*(-beta_x*vartheta_y + beta_z - vartheta_z);
    C[0][41] = (R*beta_x)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0);
    C[0][42] = K4;
    C[0][43] = R*(K2 + K5);
    C[0][44] = K6*R;
    C[0][45] = -2.0*K2*R;
    C[0][46] = 1.0*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0);
    C[0][47] = -K8;
    C[0][48] = R*(K2 + K5);
    C[0][49] = -2.0*K5*R;
    C[0][50] = K6*R;
    C[0][51] = 1.0*(beta_x*vartheta_y - beta_z + vartheta_z);
    C[0][52] = -2.0*K7*R;
    C[0][53] = 0.5*K8*(R*R);
    C[0][54] = 0.5*K4*(R*R);
    C[0][55] = -0.5*K4*(R*R);
    C[0][56] = 0.5*K8*(R*R);
    C[0][57] = -K8*(R*R);
    C[0][58] = K4*(R*R);
    C[0][59] = R*(beta_x*vartheta_z - vartheta_y);
    C[0][60] = (R*beta_z)*(-beta_x*vartheta_z + vartheta_y);
    C[0][61] = (R*beta_x)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0);
    C[0][62] = (R*beta_x)*(-beta_x*vartheta_y + beta_z - vartheta_z);
    C[0][63] = 0.5*(-K2 + K5);
    C[0][64] = K6;
    C[0][65] = 0.5*K4*R;
    C[0][66] = 0.5*K8*R;
    C[0][67] = 0.5*(K2 - K5);
    C[0][68] = -0.5*K8*R;
    C[0][69] = 0.5*K4*R;
    C[0][70] = K8*R;
    C[0][71] = -K4*R;
    C[0][72] = 2.0*K5*(R*R);
    C[0][73] = -K6*(R*R);
    C[0][74] = R*(beta_x*(beta_z*beta_z)*vartheta_y - beta_x*vartheta_y + (beta_z*beta_z)*vartheta_z + 2.0*beta_z - vartheta_z);
    C[0][75] = -K6*(R*R);
    C[0][76] = 2.0*K2*(R*R);
    C[0][77] = R*(2.0*beta_x*beta_z*vartheta_y - (beta_z*beta_z) + 2.0*beta_z*vartheta_z + 1.0);
    C[0][78] = -0.5*K7*(R*R);
    C[0][79] = 0.5*K7*(R*R);
    C[0][80] = -0.5*K6;
    C[0][81] = 1.0*(-K2 + K5);
    C[0][82] = 0.5*K8*R;
    C[0][83] = -0.5*K4*R;
    C[0][84] = 0.5*K6;
    C[0][85] = 0.5*K4*R;
    C[0][86] = 0.5*K8*R;
    C[0][87] = -K4*R;
    C[0][88] = -K8*R;
    C[0][89] = -K6*(R*R);
    C[0][90] = 2.0*K2*(R*R);
    C[0][91] = R*(2.0*beta_x*beta_z*vartheta_y - (beta_z*beta_z) + 2.0*beta_z*vartheta_z + 1.0);
    C[0][92] = -2.0*K5*(R*R);
    C[0][93] = K6*(R*R);
    C[0][94] = R*(-beta_x*(beta_z*beta_z)*vartheta_y + beta_x*vartheta_y - (beta_z*beta_z)*vartheta_z - 2.0*beta_z + vartheta_z);
    C[0][95] = K7*(R*R);
    C[0][96] = R*(K2 - K5);
    C[0][97] = K6*R;
    C[0][98] = -K6*R;
    C[0][99] = R*(K2 - K5);
    C[0][100] = -0.5*K4*(R*R);
    C[0][101] = -0.5*K8*(R*R);
    C[0][102] = -0.5*K8*(R*R);
    C[0][103] = 0.5*K4*(R*R);
    C[0][104] = K6*R;
    C[0][105] = R*(-K2 + K5);
    C[0][106] = R*(K2 - K5);
    C[0][107] = K6*R;
    C[0][108] = -0.5*K8*(R*R);
    C[0][109] = 0.5*K4*(R*R);
    C[0][110] = 0.5*K4*(R*R);
    C[0][111] = 0.5*K8*(R*R);
    C[0][112] = (0.5*(R*R))*(-K2 + K5);
    C[0][113] = -K6*(R*R);
    C[0][114] = (0.5*(R*R))*(K2 - K5);
    C[0][115] = -0.5*K6*(R*R);
    C[0][116] = (R*R)*(K2 - K5);
    C[0][117] = 0.5*K6*(R*R);
    C[1][1] = -0.5*K4*k1;
    C[1][2] = 0.5*K8*k1;
    C[1][4] = 0.5*K8*k1;
    C[1][5] = 0.5*K4*k1;
    C[1][7] = K8*k1;
    C[1][8] = -K4*k1;
    C[1][10] = (R*k1)*(K2 + K5);
    C[1][11] = (R*k1)*(K2 + K5);
    C[1][12] = K7*R*k1;
    C[1][13] = K7*R*k1;
    C[1][14] = 2.0*K5*R*k1;
    C[1][15] = -2.0*K6*R*k1;
    C[1][16] = k1*(-beta_x*(beta_z*beta_z)*vartheta_y - beta_x*vartheta_y - (beta_z*beta_z)*vartheta_z - vartheta_z);
    C[1][17] = 2.0*K2*R*k1;
    C[1][18] = k1*((beta_z*beta_z) + 1.0);
    C[1][19] = (beta_x*k1)*(beta_x*vartheta_z - vartheta_y);
    C[1][22] = k1*(-K2 - K5);
    C[1][23] = -2.0*K5*k1;
    C[1][24] = K6*k1;
    C[1][27] = k1*(K2 + K5);
    C[1][28] = -K6*k1;
    C[1][29] = 2.0*K2*k1;
    C[1][31] = -2.0*K7*k1;
    C[1][32] = K4*R*k1;
    C[1][33] = -K8*R*k1;
    C[1][34] = K8*R*k1;
    C[1][35] = K4*R*k1;
    C[1][36] = (beta_z*k1)*(beta_x*vartheta_z - vartheta_y);
    C[1][37] = -2.0*K8*R*k1;
    C[1][38] = 2.0*K4*R*k1;
    C[1][39] = k1*(beta_x*vartheta_z - vartheta_y);
    C[1][40] = (beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z);
    C[1][41] = (beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0);
    C[1][43] = k1*(K2 + K5);
    C[1][44] = K6*k1;
    C[1][45] = -2.0*K2*k1;
    C[1][48] = k1*(K2 + K5);
    C[1][49] = -2.0*K5*k1;
    C[1][50] = K6*k1;
    C[1][52] = -2.0*K7*k1;
    C[1][53] = K8*R*k1;
    C[1][54] = K4*R*k1;
    C[1][55] = -K4*R*k1;
    C[1][56] = K8*R*k1;
    C[1][57] = -2.0*K8*R*k1;
    C[1][58] = 2.0*K4*R*k1;
    C[1][59] = k1*(beta_x*vartheta_z - vartheta_y);
    C[1][60] = (beta_z*k1)*(-beta_x*vartheta_z + vartheta_y);
    C[1][61] = (beta_x*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0);
    C[1][62] = (beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z);
    C[1][65] = 0.5*K4*k1;
    C[1][66] = 0.5*K8*k1;
    C[1][68] = -0.5*K8*k1;
    C[1][69] = 0.5*K4*k1;
    C[1][70] = K8*k1;
    C[1][71] = -K4*k1;
    C[1][72] = 4.0*K5*R*k1;
    C[1][73] = -2.0*K6*R*k1;
    C[1][74] = k1*(beta_x*(beta_z*beta_z)*vartheta_y - beta_x*vartheta_y + (beta_z*beta_z)*vartheta_z + 2.0*beta_z - vartheta_z);
    C[1][75] = -2.0*K6*R*k1;
    C[1][76] = 4.0*K2*R*k1;
    C[1][77] = k1*(2.0*beta_x*beta_z*vartheta_y - (beta_z*beta_z) + 2.0*beta_z*vartheta_z + 1.0);
    C[1][78] = -K7*R*k1;
    C[1][79] = K7*R*k1;
    C[1][82] = 0.5*K8*k1;
    C[1][83] = -0.5*K4*k1;
    C[1][85] = 0.5*K4*k1;
    C[1][86] = 0.5*K8*k1;
    C[1][87] = -K4*k1;
    C[1][88] = -K8*k1;
    C[1][89] = -2.0*K6*R*k1;
    C[1][90] = 4.0*K2*R*k1;
    C[1][91] = k1*(2.0*beta_x*beta_z*vartheta_y - (beta_z*beta_z) + 2.0*beta_z*vartheta_z + 1.0);
    C[1][92] = -4.0*K5*R*k1;
    C[1][93] = 2.0*K6*R*k1;
    C[1][94] = k1*(-beta_x*(beta_z*beta_z)*vartheta_y + beta_x*vartheta_y - (beta_z*beta_z)*vartheta_z - 2.0*beta_z + vartheta_z);
    C[1][95] = 2.0*K7*R*k1;
    C[1][96] = k1*(K2 - K5);
    C[1][97] = K6*k1;
    C[1][98] = -K6*k1;
    C[1][99] = k1*(K2 - K5);
    C[1][100] = -K4*R*k1;
    C[1][101] = -K8*R*k1;
    C[1][102] = -K8*R*k1;
    C[1][103] = K4*R*k1;
    C[1][104] = K6*k1;
    C[1][105] = k1*(-K2 + K5);
    C[1][106] = k1*(K2 - K5);
    C[1][107] = K6*k1;
    C[1][108] = -K8*R*k1;
    C[1][109] = K4*R*k1;
    C[1][110] = K4*R*k1;
    C[1][111] = K8*R*k1;
    C[1][112] = (R*k1)*(-K2 + K5);
    C[1][113] = -2.0*K6*R*k1;
    C[1][114] = (R*k1)*(K2 - K5);
    C[1][115] = -K6*R*k1;
    C[1][116] = (2.0*R*k1)*(K2 - K5);
    C[1][117] = K6*R*k1;
    C[2][9] = -k1*vartheta_z;
    C[2][16] = (R*k1*vartheta_y)*(-(beta_z*beta_z) - 1.0);
    C[2][19] = (R*k1)*(2.0*beta_x*vartheta_z - vartheta_y);
    C[2][25] = k1*vartheta_y;
    C[2][30] = beta_z*k1*vartheta_y;
    C[2][36] = R*beta_z*k1*vartheta_z;
    C[2][39] = R*k1*vartheta_z;
    C[2][40] = (R*k1)*(-2.0*beta_x*vartheta_y + beta_z - vartheta_z);
    C[2][41] = (R*k1)*(-2.0*beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0);
    C[2][46] = -beta_z*k1*vartheta_y;
    C[2][51] = k1*vartheta_y;
    C[2][59] = R*k1*vartheta_z;
    C[2][60] = -R*beta_z*k1*vartheta_z;
    C[2][61] = (R*k1)*(2.0*beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0);
    C[2][62] = (R*k1)*(-2.0*beta_x*vartheta_y + beta_z - vartheta_z);
    C[2][74] = (R*k1*vartheta_y)*((beta_z*beta_z) - 1.0);
    C[2][77] = 2.0*R*beta_z*k1*vartheta_y;
    C[2][91] = 2.0*R*beta_z*k1*vartheta_y;
    C[2][94] = (R*k1*vartheta_y)*(1.0 - (beta_z*beta_z));
    C[3][16] = (2.0*R*beta_z*k1)*(-beta_x*vartheta_y - vartheta_z);
    C[3][18] = 2.0*R*beta_z*k1;
    C[3][25] = -k1;
    C[3][30] = k1*(beta_x*vartheta_y + vartheta_z);
    C[3][36] = (R*k1)*(beta_x*vartheta_z - vartheta_y);
    C[3][40] = R*beta_x*k1;
    C[3][41] = (R*beta_x*k1)*(-beta_x*vartheta_y - vartheta_z);
    C[3][46] = k1*(-beta_x*vartheta_y - vartheta_z);
    C[3][51] = -k1;
    C[3][60] = (R*k1)*(-beta_x*vartheta_z + vartheta_y);
    C[3][61] = (R*beta_x*k1)*(beta_x*vartheta_y + vartheta_z);
    C[3][62] = R*beta_x*k1;
    C[3][74] = (2.0*R*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1.0);
    C[3][77] = (2.0*R*k1)*(beta_x*vartheta_y - beta_z + vartheta_z);
    C[3][91] = (2.0*R*k1)*(beta_x*vartheta_y - beta_z + vartheta_z);
    C[3][94] = (2.0*R*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1.0);
    C[5][9] = k1;
    C[5][16] = (R*beta_x*k1)*(-(beta_z*beta_z) - 1.0);
    C[5][19] = -R*beta_x*k1;
    C[5][25] = beta_x*k1;
    C[5][30] = beta_x*beta_z*k1;
    C[5][36] = -R*beta_z*k1;
    C[5][39] = -R*k1;
    C[5][40] = -R*(beta_x*beta_x)*k1;
    C[5][41] = -R*(beta_x*beta_x)*beta_z*k1;
    C[5][46] = -beta_x*beta_z*k1;
    C[5][51] = beta_x*k1;
    C[5][59] = -R*k1;
    C[5][60] = R*beta_z*k1;
    C[5][61] = R*(beta_x*beta_x)*beta_z*k1;
    C[5][62] = -R*(beta_x*beta_x)*k1;
    C[5][74] = (R*beta_x*k1)*((beta_z*beta_z) - 1.0);
    C[5][77] = 2.0*R*beta_x*beta_z*k1;
    C[5][91] = 2.0*R*beta_x*beta_z*k1;
    C[5][94] = (R*beta_x*k1)*(1.0 - (beta_z*beta_z));
    C[6][9] = -beta_x*k1;
    C[6][16] = (R*k1)*(-(beta_z*beta_z) - 1.0);
    C[6][19] = R*(beta_x*beta_x)*k1;
    C[6][25] = k1;
    C[6][30] = beta_z*k1;
    C[6][36] = R*beta_x*beta_z*k1;
    C[6][39] = R*beta_x*k1;
    C[6][40] = -R*beta_x*k1;
    C[6][41] = -R*beta_x*beta_z*k1;
    C[6][46] = -beta_z*k1;
    C[6][51] = k1;
    C[6][59] = R*beta_x*k1;
    C[6][60] = -R*beta_x*beta_z*k1;
    C[6][61] = R*beta_x*beta_z*k1;
    C[6][62] = -R*beta_x*k1;
    C[6][74] = (R*k1)*((beta_z*beta_z) - 1.0);
    C[6][77] = 2.0*R*beta_z*k1;
    C[6][91] = 2.0*R*beta_z*k1;
    C[6][94] = (R*k1)*(1.0 - (beta_z*beta_z));
    C[7][20] = k1;
    C[8][0] = 0.5*k1;
    C[8][3] = 0.5*k1;
    C[8][10] = 0.5*(R*R)*k1;
    C[8][11] = 0.5*(R*R)*k1;
    C[8][17] = (R*R)*k1;
    C[8][22] = -R*k1;
    C[8][27] = R*k1;
    C[8][29] = 2.0*R*k1;
    C[8][43] = R*k1;
    C[8][45] = -2.0*R*k1;
    C[8][48] = R*k1;
    C[8][63] = -0.5*k1;
    C[8][67] = 0.5*k1;
    C[8][76] = 2.0*(R*R)*k1;
    C[8][81] = -k1;
    C[8][90] = 2.0*(R*R)*k1;
    C[8][96] = R*k1;
    C[8][99] = R*k1;
    C[8][105] = -R*k1;
    C[8][106] = R*k1;
    C[8][112] = -0.5*(R*R)*k1;
    C[8][114] = 0.5*(R*R)*k1;
    C[8][116] = (R*R)*k1;
    C[9][1] = -0.5*R*k1;
    C[9][5] = 0.5*R*k1;
    C[9][8] = -R*k1;
    C[9][26] = -k1;
    C[9][32] = 0.5*(R*R)*k1;
    C[9][35] = 0.5*(R*R)*k1;
    C[9][38] = (R*R)*k1;
    C[9][42] = k1;
    C[9][54] = 0.5*(R*R)*k1;
    C[9][55] = -0.5*(R*R)*k1;
    C[9][58] = (R*R)*k1;
    C[9][65] = 0.5*R*k1;
    C[9][69] = 0.5*R*k1;
    C[9][71] = -R*k1;
    C[9][83] = -0.5*R*k1;
    C[9][85] = 0.5*R*k1;
    C[9][87] = -R*k1;
    C[9][100] = -0.5*(R*R)*k1;
    C[9][103] = 0.5*(R*R)*k1;
    C[9][109] = 0.5*(R*R)*k1;
    C[9][110] = 0.5*(R*R)*k1;
    C[10][0] = 0.5*k1;
    C[10][3] = 0.5*k1;
    C[10][10] = 0.5*(R*R)*k1;
    C[10][11] = 0.5*(R*R)*k1;
    C[10][14] = (R*R)*k1;
    C[10][22] = -R*k1;
    C[10][23] = -2.0*R*k1;
    C[10][27] = R*k1;
    C[10][43] = R*k1;
    C[10][48] = R*k1;
    C[10][49] = -2.0*R*k1;
    C[10][63] = 0.5*k1;
    C[10][67] = -0.5*k1;
    C[10][72] = 2.0*(R*R)*k1;
    C[10][81] = k1;
    C[10][92] = -2.0*(R*R)*k1;
    C[10][96] = -R*k1;
    C[10][99] = -R*k1;
    C[10][105] = R*k1;
    C[10][106] = -R*k1;
    C[10][112] = 0.5*(R*R)*k1;
    C[10][114] = -0.5*(R*R)*k1;
    C[10][116] = -(R*R)*k1;
    C[11][15] = -(R*R)*k1;
    C[11][24] = R*k1;
    C[11][28] = -R*k1;
    C[11][44] = R*k1;
    C[11][50] = R*k1;
    C[11][64] = k1;
    C[11][73] = -(R*R)*k1;
    C[11][75] = -(R*R)*k1;
    C[11][80] = -0.5*k1;
    C[11][84] = 0.5*k1;
    C[11][89] = -(R*R)*k1;
    C[11][93] = (R*R)*k1;
    C[11][97] = R*k1;
    C[11][98] = -R*k1;
    C[11][104] = R*k1;
    C[11][107] = R*k1;
    C[11][113] = -(R*R)*k1;
    C[11][115] = -0.5*(R*R)*k1;
    C[11][117] = 0.5*(R*R)*k1;
    C[12][6] = k1;
    C[12][12] = 0.5*(R*R)*k1;
    C[12][13] = 0.5*(R*R)*k1;
    C[12][31] = -2.0*R*k1;
    C[12][52] = -2.0*R*k1;
    C[12][78] = -0.5*(R*R)*k1;
    C[12][79] = 0.5*(R*R)*k1;
    C[12][95] = (R*R)*k1;
    C[13][2] = 0.5*R*k1;
    C[13][4] = 0.5*R*k1;
    C[13][7] = R*k1;
    C[13][21] = -k1;
    C[13][33] = -0.5*(R*R)*k1;
    C[13][34] = 0.5*(R*R)*k1;
    C[13][37] = -(R*R)*k1;
    C[13][47] = -k1;
    C[13][53] = 0.5*(R*R)*k1;
    C[13][56] = 0.5*(R*R)*k1;
    C[13][57] = -(R*R)*k1;
    C[13][66] = 0.5*R*k1;
    C[13][68] = -0.5*R*k1;
    C[13][70] = R*k1;
    C[13][82] = 0.5*R*k1;
    C[13][86] = 0.5*R*k1;
    C[13][88] = -R*k1;
    C[13][101] = -0.5*(R*R)*k1;
    C[13][102] = -0.5*(R*R)*k1;
    C[13][108] = -0.5*(R*R)*k1;
    C[13][111] = 0.5*(R*R)*k1;
}

void ragg_analytical_jacobian(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                            double *J) {
    static const double sign[4] = { 1.0, 1.0, -1.0, -1.0 };
    static const double place[4] = { 0.0, 2.0, 1.0, 3.0 };
    double C[4][SLOPES][BASIS], c[FOLDED];
    fold(p, c);
    for (size_t j = 0; j < 4; ++j) {
        slopes(p, j, C[j]);
    }
    for (size_t i = 0; i < n; ++i) {
        double x[RAGG_ANALYTICAL_INPUTS], X[BASIS], A[AMPLITUDES];
        for (size_t k = 0; k < RAGG_ANALYTICAL_INPUTS; ++k) {
            x[k] = in[k][i];
        }
        const double phi = angle ? angle[i] : disc_angle(t[i], p[1]);
        for (size_t k = 0; k < RAGG_ANALYTICAL_PARAMETERS; ++k) {
            J[k * n + i] = 0.0;
        }
        for (size_t j = 0; j < 4; ++j) {
            double by[SLOPES];
            basis(phi + place[j] * 1.570796326794896619231321691640, x, X);
            for (size_t a = 0; a < SLOPES; ++a) {
                by[a] = 0.0;
                for (size_t b = 0; b < BASIS; ++b) {
                    by[a] += C[j][a][b] * X[b];
                }
                by[a] *= sign[j];
            }
            const double K1 = p[30 + j], k_VI = p[58 + j];
            J[i] += by[1]; /* radius */
            J[(2 + j) * n + i] = by[1]; /* dR */
            J[(6 + j) * n + i] = by[2]; /* beta_x */
            J[(10 + j) * n + i] = by[3]; /* beta_z */
            J[(14 + j) * n + i] = by[4]; /* vartheta_x */
            J[(18 + j) * n + i] = by[5]; /* vartheta_y */
            J[(22 + j) * n + i] = by[6]; /* vartheta_z */
            J[(26 + j) * n + i] = by[7]; /* K0 */
            J[(30 + j) * n + i] = k_VI * by[0]; /* K1 */
            J[(34 + j) * n + i] = by[8]; /* K2 */
            J[(38 + j) * n + i] = by[9]; /* K4 */
            J[(42 + j) * n + i] = by[10]; /* K5 */
            J[(46 + j) * n + i] = by[11]; /* K6 */
            J[(50 + j) * n + i] = by[12]; /* K7 */
            J[(54 + j) * n + i] = by[13]; /* K8 */
            J[(58 + j) * n + i] = K1 * by[0]; /* k_VI */
        }
        if (!angle) {
            evaluate(x, c, A);
            double slope = 0.0;
            for (size_t h = 1; 2 * h < AMPLITUDES; ++h) {
                slope += (double)h * (A[2 * h] * cos((double)h * phi) - A[2 * h - 1] * sin((double)h * phi));
            }
            J[n + i] = 6.283185307179586476925286766559 * t[i] * slope; /* spin_frequency */
        }
    }
}
