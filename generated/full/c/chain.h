/* The instrument as a chain of stages (paper, Eq. 1-15).
 *
 * Derived; do not edit: change the derivation and derive again. Units are SI, outputs V.
 * Effects beyond the paper's instrument: none.
 * Inputs, one series each: a_x a_y a_z omega_x omega_y omega_z omegadot_x omegadot_y omegadot_z Gamma_xx Gamma_xy Gamma_xz Gamma_yy Gamma_yz Gamma_zz d2_spin_angle d_spin_angle
 * Parameters: one value, or four in the order A1, A2, A3, A4, one after the other:
 *   radius (1): nominal distance of the accelerometers from the disc centre
 *   spin_frequency (1): rotation frequency of the disc
 *   dR (4): radial distance error
 *   beta_x (4): altitude angle of the mounting position
 *   beta_z (4): initial phase angle of the mounting position
 *   vartheta_x (4): misalignment about the tangential axis
 *   vartheta_y (4): misalignment about the radial axis
 *   vartheta_z (4): misalignment about the axial axis
 *   K0 (4): null bias
 *   K1 (4): linear scale factor
 *   K2 (4): second-order coefficient of f_i^2
 *   K4 (4): second-order coefficient of f_i f_p
 *   K5 (4): second-order coefficient of f_o^2
 *   K6 (4): second-order coefficient of f_i f_o
 *   K7 (4): second-order coefficient of f_p^2
 *   K8 (4): second-order coefficient of f_o f_p
 *   k_VI (4): current-to-voltage gain
 */
#ifndef RAGG_CHAIN_H
#define RAGG_CHAIN_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RAGG_CHAIN_INPUTS 17
#define RAGG_CHAIN_PARAMETERS 62
#define RAGG_CHAIN_ROWS 15

/* V_1 ... V_4 over n instants t, s: V[j * n + i]. angle is the disc angle, rad, or NULL for
 * 2 pi spin_frequency t. */
void ragg_chain_voltages(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                        double *V);

/* G_out = V_1 + V_2 - V_3 - V_4. */
void ragg_chain_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                      double *G);

/* Derivatives of V_j, j = 0 ... 3: D[row * n + i], rows by
 *   dR
 *   beta_x
 *   beta_z
 *   vartheta_x
 *   vartheta_y
 *   vartheta_z
 *   K0
 *   K1
 *   K2
 *   K4
 *   K5
 *   K6
 *   K7
 *   K8
 *   k_VI
 */
void ragg_chain_derivatives(size_t j, size_t n, const double *t, const double *const *in, const double *p,
                           const double *angle, double *D);

#ifdef __cplusplus
}
#endif

#endif
