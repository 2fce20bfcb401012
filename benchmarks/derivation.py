"""How long deriving takes, against the plain SymPy way to the same harmonics.

The plain way is what one writes first: put the stages into one expression, ``expand``, rewrite cosines and
sines as exponentials, ``expand`` again, ``collect`` by harmonic and by motion number. It is given the
same model: all four accelerometers with parameters of their own, the motion as recorded, and ends at the
amplitudes of G_out. (That one accelerometer serves for four, and that T and S carry all motion, is part of
what makes the derivation fast.) Both must yield the same amplitudes, which is checked at a random point.
All times are CPU (user and system) of a fresh process, start of the interpreter included.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks import RATIO, Row, at_most

ROOT = Path(__file__).resolve().parents[1]

MOST = 3.0
"""s CPU that deriving everything may take, cold."""


def cpu_seconds(arguments: Sequence[str], repeats: int = 1) -> float:
    """Smallest CPU time, s, of a fresh Python process with these arguments; it must succeed."""
    times = []
    for _ in range(repeats):
        process = subprocess.Popen([sys.executable, *arguments], cwd=ROOT, stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise RuntimeError(f"python {' '.join(arguments)}: exit status {process.returncode}")
        times.append(used.ru_utime + used.ru_stime)
    return min(times)


def plain(merged: bool = False) -> dict[tuple[int, str], Any]:
    """Amplitudes of G_out by SymPy expressions alone: (harmonic, "c" or "s") -> expression.

    The stages as they are written; if ``merged``, with k_VI K1 and radius + dR replaced by k1 and R first.
    """
    import sympy as sp

    from derive.chain import accelerometer
    from derive.symbols import COS_J, COS_PHI, QUARTER_TURNS, SIGNS, SIN_J, SIN_PHI, symbol

    phi = sp.Symbol("phi", real=True)
    a = accelerometer()
    output = sp.Integer(0)
    for j, (sign, quarter) in enumerate(zip(SIGNS, QUARTER_TURNS, strict=True)):
        values: dict[sp.Symbol, sp.Expr] = {
            COS_PHI: sp.cos(phi),
            SIN_PHI: sp.sin(phi),
            COS_J: sp.Integer((1, 0, -1, 0)[quarter]),
            SIN_J: sp.Integer((0, 1, 0, -1)[quarter]),
            **_own_symbols(j, merged),
        }
        for s, e in a.tape.assignments:
            values[s] = e.xreplace(values)
        output += sign * values[a.voltage]

    expanded = sp.expand(output)
    exponentials = sp.expand(expanded.rewrite(sp.exp))
    by_wave: dict[sp.Expr, list[sp.Expr]] = {}
    for term in sp.Add.make_args(exponentials):  # sp.collect mistakes exp(2 i phi) for a power of exp(i phi)
        steady, wave = term.as_independent(phi)
        by_wave.setdefault(wave, []).append(steady)
    motion = [symbol(f"{v}_{k}") for v in ("a", "omega", "omegadot") for k in "xyz"]
    motion += [symbol(f"Gamma_{k}") for k in ("xx", "xy", "xz", "yy", "yz", "zz")]
    found: dict[tuple[int, str], Any] = {}
    for n in range(5):
        up, down = (sp.Add(*by_wave.get(sp.exp(sp.I * k * phi), [])) for k in (n, -n))
        found[n, "c"] = sp.collect(sp.expand(up + down) if n else up, motion)
        if n:
            found[n, "s"] = sp.collect(sp.expand(sp.I * (up - down)), motion)
    return found


def _own_symbols(j: int, merged: bool) -> dict[Any, Any]:
    """Parameters of accelerometer j under names of their own; ``merged``: in k1 = k_VI K1, R = radius + dR."""
    import sympy as sp

    from derive.symbols import ACCELEROMETER, symbol

    own = {q.symbol: symbol(f"{q.name}_{j + 1}") for q in ACCELEROMETER}
    if merged:
        own |= {symbol("K1"): symbol(f"k1_{j + 1}"), symbol("k_VI"): sp.Integer(1)}
        own |= {symbol("dR"): symbol(f"R_{j + 1}"), symbol("radius"): sp.Integer(0)}
    return own


def verify(found: Mapping[tuple[int, str], Any]) -> None:
    """The plain amplitudes are the derived ones, in exact rationals at a random point."""
    import random

    import sympy as sp

    from derive.propagation import (
        COEFFICIENT_PARAMETERS,
        MOTION_NUMBERS,
        amplitude_name,
        collect,
        motion_numbers,
    )
    from derive.symbols import MOTION, symbol

    draw = random.Random(1)

    def numbers(names: Sequence[str]) -> dict[Any, Any]:
        return {symbol(n): sp.Rational(draw.randint(-9, 9), draw.randint(1, 5)) for n in names}

    motion = numbers([c.name for c in MOTION])
    parameters = [numbers(COEFFICIENT_PARAMETERS) for _ in range(4)]
    radius, k_VI = sp.Rational(3, 7), sp.Rational(5, 3)
    point = {**motion, symbol("radius"): radius}
    for j, own in enumerate(parameters):
        apart = {
            symbol("dR"): own[symbol("R")] - radius,
            symbol("k_VI"): k_VI,
            symbol("K1"): own[symbol("k1")] / k_VI,
        }
        point |= {symbol(f"{s.name}_{j + 1}"): v for s, v in {**own, **apart}.items()}
    T = {**motion, **{symbol(n): e.xreplace(motion) for n, e in motion_numbers().items()}}
    weights = {"Sigma": (1, 1, 1, 1), "D1234": (1, 1, -1, -1), "D12": (1, -1, 0, 0), "D34": (0, 0, 1, -1)}
    for (n, phase), e in found.items():
        derived = sum(
            sum(
                w * t.coefficient.as_expr().xreplace(own)
                for w, own in zip(weights[t.combination], parameters, strict=True)
            )
            * sp.Mul(*(T[symbol(m)] ** k for m, k in zip(MOTION_NUMBERS, t.motion, strict=True)))
            for t in collect().amplitudes[amplitude_name(n, phase)]
        )
        if sp.expand(e.xreplace(point)) != derived:
            raise RuntimeError(f"the two ways differ in {amplitude_name(n, phase)}")


def plain_seconds(merged: bool) -> float:
    """CPU time, s, of the plain way in a fresh process; its result is verified afterwards."""
    script = (
        f"import time; from benchmarks.derivation import plain, verify; found = plain({merged})\n"
        "print(time.process_time(), flush=True); verify(found)"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return float(done.stdout)


def run() -> list[Row]:
    """Cold derivation of everything, of the harmonics alone, and the plain way."""
    start = cpu_seconds(["-c", "import sympy"], repeats=2)
    series = cpu_seconds(["-c", "from derive.propagation import collect; collect()"], repeats=3)
    with tempfile.TemporaryDirectory() as folder:
        whole = cpu_seconds(["-m", "ragg_runtime", "derive", "--out", folder])
    as_written, merged = plain_seconds(False), plain_seconds(True)
    times, cold = as_written / series, "cold, start included"
    return [
        Row("start of Python and SymPy", start, "s CPU"),
        at_most("derive everything, cold", whole, "s CPU", MOST, "all models in Python, C, LaTeX"),
        Row("derive the harmonics, cold", series, "s CPU", "start included"),
        Row("plain SymPy, cold", as_written, "s CPU", "start included; stages as written"),
        Row(
            "plain SymPy in k1 and R, cold",
            merged,
            "s CPU",
            "start included; k_VI K1 and radius + dR merged first",
        ),
        Row("plain / derived", times, RATIO, cold, "at least 20", met=times >= 20),
        Row("plain in k1 and R / derived", merged / series, RATIO, cold),
        Row(
            "plain in k1 and R / derived, start taken off",
            (merged - start) / max(series - start, 1e-3),
            RATIO,
        ),
        Row("plain / derive everything", as_written / whole, RATIO, "all effects, C and LaTeX besides"),
    ]
