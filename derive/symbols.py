"""Every symbol of the paper's instrument: name, LaTeX, unit, meaning.

Units are SI. The paper gives specific force in g and the null bias in g; here both are in m/s^2,
so the scale factor ``K1`` is in A/(m/s^2) and the second-order coefficients in (m/s^2)/(m/s^2)^2.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import sympy as sp

from derive.names import channel_in_code


@dataclass(frozen=True)
class Channel:
    """A recorded time series that enters the model: its column name, LaTeX, SI unit and meaning."""

    name: str
    latex: str
    unit: str
    meaning: str

    @property
    def local(self) -> str:
        """Its name in the derivation and in generated code (:func:`local`)."""
        return local(self.name)

    @property
    def symbol(self) -> sp.Symbol:
        return symbol(self.local)


@dataclass(frozen=True)
class Parameter:
    """A constant of the instrument: one value, or one for each of its ``count`` accelerometers (A1, A2, A3, A4)."""

    name: str
    latex: str
    unit: str
    meaning: str
    shared: bool = False
    count: int = 4

    @property
    def symbol(self) -> sp.Symbol:
        return symbol(self.name)

    @property
    def size(self) -> int:
        """Number of values: 1 if shared, else one for each accelerometer."""
        return 1 if self.shared else self.count


@cache
def symbol(name: str) -> sp.Symbol:
    """The one SymPy symbol of this name (all are real)."""
    return sp.Symbol(name, real=True)


_AXES = "xyz"

COMPONENTS = ("xx", "xy", "xz", "yy", "yz", "zz")
"""Of a symmetric tensor, as the names of its columns and parameters end."""

TRACELESS = COMPONENTS[:-1]
"""Those of one without trace that determine it."""


def traceless(values: Mapping[str, sp.Expr], name: str) -> sp.Matrix:
    """(3 x 3) of ``name`` with a component for ``{}``, ``G_{}`` say: a gradient outside its masses is free of trace."""
    xx, xy, xz, yy, yz = (values[name.format(k)] for k in TRACELESS)
    return sp.Matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, -(xx + yy)]])


def symmetric(values: Mapping[str, sp.Expr], name: str) -> sp.Matrix:
    """(3 x 3) of ``name_xx``, ``name_xy`` ... ``name_zz``."""
    return sp.Matrix(3, 3, lambda i, k: values[f"{name}_{''.join(sorted(_AXES[i] + _AXES[k]))}"])


MOTION: tuple[Channel, ...] = (
    *(Channel(f"a_{k}", f"a_{k}", "m/s^2", f"specific force of the disc centre, {k} (f_cmm)") for k in _AXES),
    *(
        Channel(f"omega_{k}", rf"\omega_{{im{k}}}", "rad/s", f"angular rate against inertial space, {k}")
        for k in _AXES
    ),
    *(
        Channel(f"omegadot_{k}", rf"\dot\omega_{{im{k}}}", "rad/s^2", f"angular acceleration, {k}")
        for k in _AXES
    ),
    *(
        Channel(f"Gamma_{k}", rf"\Gamma_{{{k}}}", "s^-2", f"gravity gradient {k} at the disc centre")
        for k in COMPONENTS
    ),
)

DISC: tuple[Parameter, ...] = (
    Parameter("radius", "R", "m", "nominal distance of the accelerometers from the disc centre", shared=True),
    Parameter("spin_frequency", r"\Omega/2\pi", "Hz", "rotation frequency of the disc", shared=True),
)

ACCELEROMETER: tuple[Parameter, ...] = (
    Parameter("dR", "dR", "m", "radial distance error"),
    Parameter("beta_x", r"\beta_x", "rad", "altitude angle of the mounting position"),
    Parameter("beta_z", r"\beta_z", "rad", "initial phase angle of the mounting position"),
    Parameter("vartheta_x", r"\vartheta_x", "rad", "misalignment about the tangential axis"),
    Parameter("vartheta_y", r"\vartheta_y", "rad", "misalignment about the radial axis"),
    Parameter("vartheta_z", r"\vartheta_z", "rad", "misalignment about the axial axis"),
    Parameter("K0", "K_0", "m/s^2", "null bias"),
    Parameter("K1", "K_1", "A/(m/s^2)", "linear scale factor"),
    Parameter("K2", "K_2", "1/(m/s^2)", "second-order coefficient of f_i^2"),
    Parameter("K4", "K_4", "1/(m/s^2)", "second-order coefficient of f_i f_p"),
    Parameter("K5", "K_5", "1/(m/s^2)", "second-order coefficient of f_o^2"),
    Parameter("K6", "K_6", "1/(m/s^2)", "second-order coefficient of f_i f_o"),
    Parameter("K7", "K_7", "1/(m/s^2)", "second-order coefficient of f_p^2"),
    Parameter("K8", "K_8", "1/(m/s^2)", "second-order coefficient of f_o f_p"),
    Parameter("k_VI", "k_{V/I}", "V/A", "current-to-voltage gain"),
)

INSTRUMENT: tuple[Parameter, ...] = DISC + ACCELEROMETER
"""The parameters of the paper's instrument, in the order in which every parameter vector holds them."""

ANGLES: tuple[str, ...] = ("beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z")
SECOND_ORDER: tuple[str, ...] = ("K2", "K4", "K5", "K6", "K7", "K8")

QUARTER_TURNS: tuple[int, ...] = (0, 2, 1, 3)
"""Nominal place of A1, A2, A3, A4 on the disc, in quarters of a turn ahead of A1."""

SIGNS: tuple[int, ...] = (1, 1, -1, -1)
"""Sign of V_1 ... V_4 in G_out (Eq. 15)."""

# Disc angle, and the constant cosine and sine of an accelerometer's nominal place on the disc.
COS_PHI, SIN_PHI = symbol("cos_phi"), symbol("sin_phi")
COS_J, SIN_J = symbol("cos_j"), symbol("sin_j")
TIME = symbol("time")

AUXILIARY: tuple[str, ...] = (
    "temperature", "pressure", "roll", "pitch", "yaw", "B_x", "B_y", "B_z",
    "fuel_mass", "vibration_rms", "angular_vibration_rms", "balance_current", "second_order_current", "mass_x", "mass_y", "mass_z", "G_out",
)  # fmt: skip
"""Channels beyond the motion that packaged effects need."""

RATES: tuple[str, ...] = (
    *(f"{d}_{c.name}" for d in ("d", "d2") for c in MOTION),
    *(f"d_{name}" for name in AUXILIARY),
    "d_spin_angle",
    "d2_spin_angle",
)
"""First and second time derivatives of the motion and of the disc angle: formed from it, never read from a file."""

_OWN = frozenset((*(c.name for c in MOTION), *AUXILIARY, *RATES))
_INPUTS = _OWN | {q.name for q in INSTRUMENT} | {"cos_phi", "sin_phi", "cos_j", "sin_j", "time"}


def local(column: str) -> str:
    """The name of a recorded channel in the derivation and in generated code.

    A column may have any name, even that of an intermediate value or a keyword of C. Names that the
    derivation does not define have a name space of their own: parameters of effects are ``<id>__<name>`` (see
    :mod:`derive.names`), and nothing else has two underscores but second names of intermediate values, ``V2__<name>``.
    """
    return column if column in _OWN else channel_in_code(column)


def is_taken(name: str) -> bool:
    """Whether an intermediate value must not have this name: an input has it, or the emitters make it of one."""
    return name in _INPUTS or name.startswith(("in_", "out_", "C__", "H__"))


# Rate and acceleration of the disc angle: of the encoder, or 2 pi spin_frequency and zero where there is none.
SPIN_RATE, SPIN_ACCELERATION = symbol("d_spin_angle"), symbol("d2_spin_angle")
