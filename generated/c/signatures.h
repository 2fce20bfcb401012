/* Signatures: what each candidate effect would add to V_j.
 *
 * Derived; do not edit: change the derivation and derive again. Units are SI, outputs V.
 * Effects beyond the paper's instrument: adc-nonlinearity, angular-jitter, anisoinertia, arm-length, arm-sag, arm-stretch, balancing-loop, bearing-run-out, bias-drift, bias-hysteresis, bias-step, carrier-gradient, clock-drift, cubic-cross, cubic-input, disc-spin, encoder-harmonic, fuel-gradient, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-delay, gyro-g-sensitivity, gyro-misalignment, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-quadratic, imu-acceleration-scale, imu-filter, imu-lever-arm, imu-misalignment, imu-skew, imu-thermal, inner-temperature, lag, magnetic-axial-bias, magnetic-bias, magnetic-scale, misalignment-drift, misalignment-step, mount-compliance, mount-hysteresis, mount-resonance, near-mass, odd-quadratic, output-curve, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-drift, second-order-loop, second-order-misalignment, second-order-step, self-gradient, self-gradient-yaw, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, spin-servo, thermal-bias, thermal-lag, thermal-misalignment, thermal-scale, thermal-second-order, time-offset, vibration-level, vibration-rectification.
 * Inputs, one series each: a_x a_y a_z omega_x omega_y omega_z omegadot_x omegadot_y omegadot_z Gamma_xx Gamma_xy Gamma_xz Gamma_yy Gamma_yz Gamma_zz B_x B_y B_z heat_rr heat_rt heat_start heat_tt mount_a_x mount_a_y mount_a_z mount_omega_x mount_omega_y mount_omega_z mount_omegadot_x mount_omegadot_y mount_omegadot_z play_axial play_radial play_tangential slip_axial slip_radial slip_tangential G_out angular_vibration_rms balance_current d2_a_x d2_a_y d2_a_z d2_omegadot_x d2_omegadot_y d2_omegadot_z d2_spin_angle d_a_x d_a_y d_a_z d_omegadot_x d_omegadot_y d_omegadot_z d_spin_angle d_temperature fuel_mass pitch pressure roll second_order_current temperature vibration_rms yaw
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
#ifndef RAGG_SIGNATURES_H
#define RAGG_SIGNATURES_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RAGG_SIGNATURES_INPUTS 63
#define RAGG_SIGNATURES_PARAMETERS 62
#define RAGG_SIGNATURES_ROWS 217

/* V_1 ... V_4 over n instants t, s: V[j * n + i]. angle is the disc angle, rad, or NULL for
 * 2 pi spin_frequency t. */
void ragg_signatures_voltages(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                        double *V);

/* G_out = V_1 + V_2 - V_3 - V_4. */
void ragg_signatures_output(size_t n, const double *t, const double *const *in, const double *p, const double *angle,
                      double *G);

/* Derivatives of V_j, j = 0 ... 3: D[row * n + i], rows by
 *   adc-nonlinearity.h
 *   angular-jitter.W_xx
 *   angular-jitter.W_xy
 *   angular-jitter.W_xz
 *   angular-jitter.W_yy
 *   angular-jitter.W_yz
 *   angular-jitter.W_zz
 *   anisoinertia.K_ip
 *   arm-length.delta_R
 *   arm-sag.c_z
 *   arm-stretch.c_r
 *   balancing-loop.dK1_di
 *   balancing-loop.dK2_di
 *   bearing-run-out.c_x1
 *   bearing-run-out.s_x1
 *   bearing-run-out.c_y1
 *   bearing-run-out.s_y1
 *   bearing-run-out.c_z1
 *   bearing-run-out.s_z1
 *   bearing-run-out.c_x2
 *   bearing-run-out.s_x2
 *   bearing-run-out.c_y2
 *   bearing-run-out.s_y2
 *   bearing-run-out.c_z2
 *   bearing-run-out.s_z2
 *   bias-drift.dK0_dt
 *   bias-hysteresis.h_i
 *   bias-hysteresis.h_o
 *   bias-hysteresis.h_p
 *   bias-hysteresis.w
 *   bias-step.dK0
 *   carrier-gradient.G_xx
 *   carrier-gradient.G_xy
 *   carrier-gradient.G_xz
 *   carrier-gradient.G_yy
 *   carrier-gradient.G_yz
 *   carrier-gradient.F_xx
 *   carrier-gradient.F_xy
 *   carrier-gradient.F_xz
 *   carrier-gradient.F_yy
 *   carrier-gradient.F_yz
 *   clock-drift.epsilon
 *   cubic-cross.K_iio
 *   cubic-cross.K_iip
 *   cubic-cross.K_ioo
 *   cubic-cross.K_iop
 *   cubic-cross.K_ipp
 *   cubic-cross.K_ooo
 *   cubic-cross.K_oop
 *   cubic-cross.K_opp
 *   cubic-cross.K_ppp
 *   cubic-input.K_iii
 *   disc-spin.share
 *   encoder-harmonic.c_1
 *   encoder-harmonic.s_1
 *   encoder-harmonic.c_2
 *   encoder-harmonic.s_2
 *   encoder-harmonic.c_3
 *   encoder-harmonic.s_3
 *   encoder-harmonic.c_4
 *   encoder-harmonic.s_4
 *   fuel-gradient.G_xx
 *   fuel-gradient.G_xy
 *   fuel-gradient.G_xz
 *   fuel-gradient.G_yy
 *   fuel-gradient.G_yz
 *   gain-drift.dK1_dt
 *   gain-step.dK1
 *   gradient-offset.G_xx
 *   gradient-offset.G_xy
 *   gradient-offset.G_xz
 *   gradient-offset.G_yy
 *   gradient-offset.G_yz
 *   gyro-bias.b_x
 *   gyro-bias.b_y
 *   gyro-bias.b_z
 *   gyro-delay.delta_w
 *   gyro-delay.delta_d
 *   gyro-g-sensitivity.d_xx
 *   gyro-g-sensitivity.d_xy
 *   gyro-g-sensitivity.d_xz
 *   gyro-g-sensitivity.d_yx
 *   gyro-g-sensitivity.d_yy
 *   gyro-g-sensitivity.d_yz
 *   gyro-g-sensitivity.d_zx
 *   gyro-g-sensitivity.d_zy
 *   gyro-g-sensitivity.d_zz
 *   gyro-misalignment.m_xy
 *   gyro-misalignment.m_xz
 *   gyro-misalignment.m_yx
 *   gyro-misalignment.m_yz
 *   gyro-misalignment.m_zx
 *   gyro-misalignment.m_zy
 *   gyro-scale.s_x
 *   gyro-scale.s_y
 *   gyro-scale.s_z
 *   imu-acceleration-bias.b_x
 *   imu-acceleration-bias.b_y
 *   imu-acceleration-bias.b_z
 *   imu-acceleration-misalignment.m_xy
 *   imu-acceleration-misalignment.m_xz
 *   imu-acceleration-misalignment.m_yx
 *   imu-acceleration-misalignment.m_yz
 *   imu-acceleration-misalignment.m_zx
 *   imu-acceleration-misalignment.m_zy
 *   imu-acceleration-quadratic.q_x
 *   imu-acceleration-quadratic.q_y
 *   imu-acceleration-scale.s_x
 *   imu-acceleration-scale.s_y
 *   imu-acceleration-scale.s_z
 *   imu-filter.b_a
 *   imu-filter.b_w
 *   imu-lever-arm.l_x
 *   imu-lever-arm.l_y
 *   imu-lever-arm.l_z
 *   imu-misalignment.e_x
 *   imu-misalignment.e_y
 *   imu-misalignment.e_z
 *   imu-skew.delta_x
 *   imu-skew.delta_y
 *   imu-thermal.db_x_dT
 *   imu-thermal.db_y_dT
 *   imu-thermal.ds_x_dT
 *   imu-thermal.ds_y_dT
 *   inner-temperature.b
 *   inner-temperature.s
 *   inner-temperature.b_0
 *   inner-temperature.s_0
 *   inner-temperature.tau
 *   lag.tau
 *   magnetic-axial-bias.dK0_dBz
 *   magnetic-bias.dK0_dB
 *   magnetic-scale.dK1_dB
 *   misalignment-drift.dvartheta_y_dt
 *   misalignment-step.dvartheta_y
 *   mount-compliance.c_yx
 *   mount-compliance.c_yy
 *   mount-compliance.c_yz
 *   mount-compliance.c_zx
 *   mount-compliance.c_zy
 *   mount-compliance.c_zz
 *   mount-hysteresis.e_yx
 *   mount-hysteresis.e_yz
 *   mount-hysteresis.e_zx
 *   mount-hysteresis.w
 *   mount-resonance.share
 *   mount-resonance.f_0
 *   mount-resonance.Q
 *   near-mass.T_xxx
 *   near-mass.T_xxy
 *   near-mass.T_xxz
 *   near-mass.T_xyy
 *   near-mass.T_xyz
 *   near-mass.T_yyy
 *   near-mass.T_yyz
 *   near-mass.T_xxxx
 *   near-mass.T_xxxy
 *   near-mass.T_xxxz
 *   near-mass.T_xxyy
 *   near-mass.T_xxyz
 *   near-mass.T_xyyy
 *   near-mass.T_xyyz
 *   near-mass.T_yyyy
 *   near-mass.T_yyyz
 *   odd-quadratic.K_oq
 *   output-curve.c_2
 *   output-curve.c_3
 *   output-filter.b
 *   output-gain-step.g
 *   pendulum-angular.K_pa
 *   pressure-bias.dK0_dp
 *   second-order-drift.dK2_dt
 *   second-order-loop.b
 *   second-order-misalignment.kappa
 *   second-order-step.dK2
 *   self-gradient.G_xx_roll
 *   self-gradient.G_xy_roll
 *   self-gradient.G_xz_roll
 *   self-gradient.G_yy_roll
 *   self-gradient.G_yz_roll
 *   self-gradient.G_xx_pitch
 *   self-gradient.G_xy_pitch
 *   self-gradient.G_xz_pitch
 *   self-gradient.G_yy_pitch
 *   self-gradient.G_yz_pitch
 *   self-gradient-yaw.G_d
 *   self-gradient-yaw.G_xy
 *   self-gradient-yaw.G_xz
 *   self-gradient-yaw.G_yz
 *   spin-axis-tilt.alpha_x
 *   spin-axis-tilt.alpha_y
 *   spin-axis-wobble.w_x
 *   spin-axis-wobble.w_y
 *   spin-phase-offset.phi_0
 *   spin-rate-jitter.sigma_phi
 *   spin-rate-jitter.sigma_walk
 *   spin-rate-offset.epsilon
 *   spin-servo.c
 *   thermal-bias.dK0_dT
 *   thermal-lag.dK0_dTdot
 *   thermal-lag.dK1_dTdot
 *   thermal-misalignment.dvartheta_y_dT
 *   thermal-scale.dK1_dT
 *   thermal-second-order.dK2_dT
 *   time-offset.delta_t
 *   vibration-level.L_xx
 *   vibration-level.L_xy
 *   vibration-level.L_xz
 *   vibration-level.L_yy
 *   vibration-level.L_yz
 *   vibration-level.L_zz
 *   vibration-rectification.P_xx
 *   vibration-rectification.P_xy
 *   vibration-rectification.P_xz
 *   vibration-rectification.P_yy
 *   vibration-rectification.P_yz
 *   vibration-rectification.P_zz
 */
void ragg_signatures_derivatives(size_t j, size_t n, const double *t, const double *const *in, const double *p,
                           const double *angle, double *D);

#ifdef __cplusplus
}
#endif

#endif
