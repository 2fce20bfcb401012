/* The analytical model of the RAGG (paper, Eq. 16-19).
 *
 * Derived; do not edit: change the derivation and run `make derive`. Units are SI, outputs V.
 * Inputs, one series each: a_x a_y a_z omega_x omega_y omega_z omegadot_x omegadot_y omegadot_z Gamma_xx Gamma_xy Gamma_xz Gamma_yy Gamma_yz Gamma_zz
 * Parameters: one value, or four in the order A1, A2, A3, A4, one after the other:
 *   radius (1), m: nominal distance of the accelerometers from the disc centre
 *   spin_frequency (1), Hz: rotation frequency of the disc
 *   dR (4), m: radial distance error
 *   beta_x (4), rad: altitude angle of the mounting position
 *   beta_z (4), rad: initial phase angle of the mounting position
 *   vartheta_x (4), rad: misalignment about the tangential axis
 *   vartheta_y (4), rad: misalignment about the radial axis
 *   vartheta_z (4), rad: misalignment about the axial axis
 *   K0 (4), m/s^2: null bias
 *   K1 (4), A/(m/s^2): linear scale factor
 *   K2 (4), 1/(m/s^2): second-order coefficient of f_i^2
 *   K4 (4), 1/(m/s^2): second-order coefficient of f_i f_p
 *   K5 (4), 1/(m/s^2): second-order coefficient of f_o^2
 *   K6 (4), 1/(m/s^2): second-order coefficient of f_i f_o
 *   K7 (4), 1/(m/s^2): second-order coefficient of f_p^2
 *   K8 (4), 1/(m/s^2): second-order coefficient of f_o f_p
 *   k_VI (4), V/A: current-to-voltage gain
 */
#ifndef RAGG_ANALYTICAL_H
#define RAGG_ANALYTICAL_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RAGG_ANALYTICAL_INPUTS 15
#define RAGG_ANALYTICAL_PARAMETERS 62
#define RAGG_ANALYTICAL_AMPLITUDES 9

/* Amplitudes A_0, A_1c, A_1s, A_2c, A_2s, A_3c, A_3s, A_4c, A_4s of Eq. 17 at one instant. */
void ragg_analytical_amplitudes(const double in[RAGG_ANALYTICAL_INPUTS], const double p[RAGG_ANALYTICAL_PARAMETERS],
                              double A[RAGG_ANALYTICAL_AMPLITUDES]);

/* G_out over n instants t, s. in[k] is the series of input k; angle is the disc angle, rad, or NULL for
 * 2 pi spin_frequency t. */
void ragg_analytical_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                          double *G);

/* Derivatives of G_out by every parameter: J[k * n + i] by parameter k at instant i. */
void ragg_analytical_jacobian(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                            double *J);

#ifdef __cplusplus
}
#endif

#endif
