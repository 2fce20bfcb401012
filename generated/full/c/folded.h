/* The analytical model of the RAGG, folded for evaluation (paper, Eq. 1-15, with the rate of the disc in Eq. 9).
 *
 * Derived; do not edit: change the derivation and run `make derive`. Units are SI, G_out in V.
 * Fast: compile with optimisation for the machine at hand (-O3 -march=native -ffp-contract=off).
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
#ifndef RAGG_FOLDED_H
#define RAGG_FOLDED_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RAGG_FOLDED_INPUTS 17
#define RAGG_FOLDED_PARAMETERS 62

/* G_out over n instants t, s: the same bits for a sample wherever it stands (as long as the compiler contracts
 * no products on its own). angle is the disc angle, rad,
 * or NULL for 2 pi spin_frequency t. */
void ragg_folded_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                        double *G);

#ifdef __cplusplus
}
#endif

#endif
