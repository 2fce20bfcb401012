"""model.toml: what it means in SI, what is refused, and edits that keep the user's text."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.instrument.instrument import PARAMETERS, EffectSetting
from ragg_runtime.instrument.model_toml import add_effect, parse_instrument, remove_effect, set_parameters
from ragg_runtime.instrument.units import RawQuantity

TEXT = """# The maker's test sheet.
effects = []  # none yet

[disc]
radius = "0.1 m"
spin_frequency = "0.25 Hz"
g0 = "9.8 m/s^2"

[accelerometers]
dR = { value = [0, 30, 35, 25], unit = "um" }  # with the ruler
beta_x = { value = 18, unit = "arcsec" }
K0 = "10 ug"
K1 = { value = [10, 10.001, 10.0015, 10.002], unit = "mA/g" }
# after the repair:
K2 = { value = [5, 1, 8, 7], unit = "ug/g^2" }
k_VI = "1e9 ohm"
"""


def with_line(old: str, new: str) -> str:
    assert TEXT.count(old) == 1
    return TEXT.replace(old, new)


def with_effects(effects: str) -> str:
    return with_line("effects = []  # none yet", f"effects = {effects}")


def test_values_in_si() -> None:
    found = parse_instrument(TEXT)
    k = found.accelerometers
    assert (found.radius, found.spin_frequency, found.g0) == (0.1, 0.25, 9.8)
    assert k["dR"] == pytest.approx([0, 30e-6, 35e-6, 25e-6])
    assert k["beta_x"] == pytest.approx([18 / 3600 * math.pi / 180] * 4)
    assert k["K0"] == pytest.approx([98e-6] * 4)
    assert k["K1"] == pytest.approx(np.array([10, 10.001, 10.0015, 10.002]) * 1e-3 / 9.8)
    assert k["K2"] == pytest.approx(np.array([5, 1, 8, 7]) * 1e-6 / 9.8)
    assert k["k_VI"] == pytest.approx([1e9] * 4)
    assert list(k) == [p.name for p in PARAMETERS]
    assert all(not np.any(k[n]) for n in k if n not in TEXT)
    assert all(v.shape == (4,) and not v.flags.writeable for v in k.values())


def test_effects() -> None:
    cubic = '{ id = "cubic-input", K_iii = { value = [2, 0, 0, 0], unit = "ug/g^3" } }'
    own = '{ id = "mine", stage = "transducer", add = "c*f_i^5", c = { value = 3, unit = "ug/g^5" } }'
    found = parse_instrument(with_effects(f'["lag", {cubic}, {own}]'))
    lag, cubic, mine = found.effects
    assert lag == EffectSetting("lag")
    assert lag.si("tau", "s", found.g0) is None
    assert cubic.si("K_iii", "1/(m/s^2)^2", found.g0) == pytest.approx([2e-6 / 9.8**2, 0, 0, 0])
    assert found.effect("cubic-input") is cubic
    assert found.effect("arm-sag") is None
    assert mine.expression is not None
    assert (mine.expression["stage"], mine.expression["add"]) == ("transducer", "c*f_i^5")
    assert mine.expression["params"]["c"]["unit"] == "ug/g^5"
    assert mine.si("c", "1/(m/s^2)^4", found.g0) == pytest.approx([3e-6 / 9.8**4] * 4)


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        (with_line("radius =", "raduis ="), ("[disc]", "'raduis'", "did you mean 'radius'?")),
        (with_line("[disc]", "[disk]"), ("'disk'", "did you mean 'disc'?")),
        (with_line('"0.1 m"', '"0.1 s"'), ("[disc] radius", "dimension", "'s'", "[length]")),
        (with_line('"0.1 m"', "0.1"), ("[disc] radius", "unit is missing")),
        (with_line('"0.1 m"', '"-0.1 m"'), ("[disc] radius", "positive", "-0.1 m")),
        (with_line('"0.1 m"', '{ value = [1, 2, 3, 4], unit = "m" }'), ("[disc] radius", "one number")),
        (with_line('g0 = "9.8 m/s^2"', 'g0 = "1 g"'), ("[disc] g0", "defines")),
        (with_line('g0 = "9.8 m/s^2"', ""), ("[disc]", "g0 is missing")),
        (with_line("[0, 30, 35, 25]", "[0, 30, 35]"), ("[accelerometers] dR", "3 values", "4")),
        (with_line("[0, 30, 35, 25]", "[0, 30, 35, nan]"), ("[accelerometers] dR", "not finite")),
        (with_line("[0, 30, 35, 25]", '"zero"'), ("[accelerometers] dR", "not a number")),
        (with_line("[0, 30, 35, 25]", "[0, 30, 35, -2e5]"), ("[accelerometers] dR", "radius + dR")),
        (with_line('unit = "ug/g^2"', 'unit = "ug"'), ("[accelerometers] K2", "dimension", "1/(m/s^2)")),
        (with_line('k_VI = "1e9 ohm"', 'k_VI = "0 ohm"'), ("[accelerometers] k_VI", "zero")),
        (with_line('"10 ug"', '"1e308 mg"').replace("9.8", "9.8e9"), ("[accelerometers] K0", "not finite")),
        (with_line('"0.1 m"', '"0.1 m'), ("not a TOML file", "line 5")),
        (with_effects('["lag", "arm-sag", "lag"]'), ("effects", "'lag'", "twice")),
        (with_effects('"lag"'), ("effects", "list")),
        (with_effects("[{ tau = 3 }]"), ("effects, entry 1", "not an effect")),
        (with_effects('["arm-sag", { id = "lag", tau = 3 }]'), ("effects, entry 2 (lag): tau", "unit")),
        (with_effects('[{ id = "x", stage = "transducer" }]'), ("entry 1 (x)", "add")),
        (with_effects('[{ id = "x", stage = "output", add = "c", c = "1 V" }]'), ("entry 1 (x): c", "unit")),
        (TEXT.replace("[accelerometers]", "[accelerometers.inner]"), ("[accelerometers]", "'inner'")),
        ("", ("[disc] is missing",)),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, facts: tuple[str, ...]) -> None:
    path = tmp_path / "sheet.toml"
    with pytest.raises(UserError) as caught:
        parse_instrument(text, path)
    assert [f for f in (str(path), *facts) if f not in str(caught.value)] == []


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="does not exist"):
        read_text(tmp_path / "none.toml")
    with pytest.raises(UserError, match="directory"):
        read_text(tmp_path)
    (tmp_path / "latin.toml").write_bytes(TEXT.replace("ug", "µg").encode("latin-1"))
    with pytest.raises(UserError, match="not UTF-8"):
        read_text(tmp_path / "latin.toml")
    (tmp_path / "windows.toml").write_bytes(b"\xef\xbb\xbf" + TEXT.replace("\n", "\r\n").encode())
    assert parse_instrument(read_text(tmp_path / "windows.toml")).radius == 0.1


def test_edits_keep_everything_else() -> None:
    given = {"dR": RawQuantity((1.0, 2.5, 3.0, 4.0), "um"), "K5": RawQuantity(7.0, "ug/g^2")}
    text = set_parameters(TEXT, given)
    found = parse_instrument(text)
    assert found.accelerometers["dR"] == pytest.approx([1e-6, 2.5e-6, 3e-6, 4e-6])
    assert found.accelerometers["K5"] == pytest.approx([7e-6 / 9.8] * 4)
    kept = [line for line in TEXT.splitlines() if not line.startswith("dR")]
    assert [line for line in text.splitlines() if line in kept] == kept
    assert "# with the ruler" in next(line for line in text.splitlines() if line.startswith("dR"))
    with pytest.raises(UserError, match="did you mean 'K5'"):
        set_parameters(TEXT, {"k5": RawQuantity(7.0, "ug/g^2")})


def test_effects_come_and_go_without_a_trace() -> None:
    cubic = EffectSetting("cubic-input", {"K_iii": RawQuantity((2.0, 0.0, 0.0, 0.0), "ug/g^3")})
    lag = EffectSetting("lag", {"tau": RawQuantity(1.5, "ms")})
    text = add_effect(add_effect(add_effect(TEXT, EffectSetting("lag")), cubic), lag)
    assert parse_instrument(text).effects == (lag, cubic)
    assert remove_effect(remove_effect(text, "lag"), "cubic-input") == TEXT
    with pytest.raises(UserError, match="not in the model"):
        remove_effect(TEXT, "lag")


TABLES = "\n[[effects]]\nid = 'odd-quadratic'\n"


@pytest.mark.parametrize(("head", "tail"), [
    ("effects = [\n  'arm-sag',  # why\n]\n", ""), ('effects = ["arm-sag"]\n', ""), ("# none\n", ""), ("", TABLES),
])  # fmt: skip
def test_effects_are_added_to_any_form_of_the_list(head: str, tail: str) -> None:
    text = head + TEXT.replace("effects = []  # none yet\n", "") + tail
    before = [e.id for e in parse_instrument(text).effects]
    added = add_effect(text, EffectSetting("lag", {"tau": RawQuantity(1.0, "ms")}))
    assert [e.id for e in parse_instrument(added).effects] == [*before, "lag"]
    assert all(comment in added for comment in ("# with the ruler", "# after the repair:"))
    assert [e.id for e in parse_instrument(remove_effect(added, "lag")).effects] == before


def sure(sigma: str) -> str:
    return TEXT.replace('unit = "mA/g"', f'unit = "mA/g", sigma = {sigma}')


@pytest.mark.parametrize(
    ("sigma", "four"), [("0.01", [0.01] * 4), ("[0.1, 0.2, 0.3, 0.4]", [0.1, 0.2, 0.3, 0.4])]
)
def test_the_sheet_can_say_how_sure_it_is(sigma: str, four: list[float]) -> None:
    known = parse_instrument(sure(sigma))
    np.testing.assert_allclose(known.sigma("K1"), np.array(four) * 1e-3 / 9.8, rtol=1e-14)
    np.testing.assert_allclose(known.sigma("K2"), 20e-6 / 9.8, rtol=1e-14)  # as sure as is plausible
    kept = parse_instrument(set_parameters(sure(sigma), {"K1": RawQuantity(10.5, "mA/g")}))
    np.testing.assert_array_equal(kept.sigma("K1"), known.sigma("K1"))


@pytest.mark.parametrize("sigma", ["0", "-0.1", "[0.1, 0.1, 0, 0.1]", "[0.1, 0.1]", "nan", '"0.01 mA/g"'])
def test_a_sigma_that_is_none_is_refused(sigma: str) -> None:
    with pytest.raises(UserError) as refused:
        parse_instrument(sure(sigma))
    assert "K1" in str(refused.value)
    assert "sigma" in str(refused.value)
