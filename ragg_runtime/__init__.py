"""Numbers: what turns a recorded flight into an answer about the instrument.

Glossary (symbols follow the paper; inside everything is in SI, ``g`` is the model file's g0)
---------------------------------------------------------------------------------------------
RAGG
    Rotating accelerometer gravity gradiometer: four accelerometers on a disc that spins at Omega.
measurement frame
    The frame x, y, z of the stabilised platform. The disc turns about z by ``phi = Omega t``.
A1, A2, A3, A4
    The accelerometers, at phi, phi + 180, phi + 90 and phi + 270 degrees, at distance ``R`` of the centre.
specific force
    What an accelerometer measures, acceleration less gravitation: f = a + omegadot x r + omega x (omega x r)
    - Gamma r, with ``a`` that of the disc centre (the paper's f_cmm).
gravity gradient
    ``Gamma_xx`` ... ``Gamma_zz``, s^-2; 1 Eo (eotvos) = 1e-9 s^-2.
input, output and pendulum axis
    f_i along the sensitive axis (tangential), f_o and f_p across it.
null bias, scale factor, second-order coefficients
    ``K0``; ``K1``; ``K2`` (f_i^2), ``K4`` (f_i f_p), ``K5`` (f_o^2), ``K6`` (f_i f_o), ``K7`` (f_p^2),
    ``K8`` (f_o f_p) of an accelerometer (Eq. 1-6).
mounting errors
    ``dR`` radial distance, ``beta_x`` altitude, ``beta_z`` initial phase of the position; ``vartheta_x``,
    ``vartheta_y``, ``vartheta_z`` misalignment of the triad.
G_out
    V_1 + V_2 - V_3 - V_4, V: the output before demodulation (Eq. 15); k_ggi is its scale factor, the sum of
    k_VI K1 R_j.
inline, cross
    Demodulated channels: Gamma_xx - Gamma_yy and Gamma_xy.
instrument, flight
    Parameters of one gradiometer (``model.toml``); a record of motion, auxiliaries and output.
effect
    A physical cause beyond the paper's model, with parameters that vanish where it is absent.
"""
