"""model.toml: what it means in SI, what is refused, edits that keep the text; kinematics and order, from the file to the figures."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from commands import ragg

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.instrument.instrument import PAPER_FORM, PARAMETERS, PRESETS, EffectSetting, Form
from ragg_runtime.instrument.model_toml import add_effect, parse_instrument, remove_effect
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.io import Flight, read_flight
from ragg_runtime.io.files import convert
from ragg_runtime.model import derive
from ragg_runtime.model.model import evaluate_output, load_packaged, make_vector, scale_factor
from ragg_runtime.model.record import SPIN, Record, measure_spin, record
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.reference.simulate import simulate
from ragg_runtime.screening import screen
from ragg_runtime.simulate import simulate_flight
from tests.simulated import RATE

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


def sure(sigma: str) -> str:
    return TEXT.replace('unit = "mA/g"', f'unit = "mA/g", sigma = {sigma}')


def test_values_in_si() -> None:
    instrument = parse_instrument(TEXT)
    k = instrument.accelerometers
    assert (instrument.radius, instrument.spin_frequency, instrument.g0) == (0.1, 0.25, 9.8)
    assert k["dR"] == pytest.approx([0, 30e-6, 35e-6, 25e-6])
    assert k["beta_x"] == pytest.approx([18 / 3600 * math.pi / 180] * 4)
    assert k["K0"] == pytest.approx([98e-6] * 4)
    assert k["K1"] == pytest.approx(np.array([10, 10.001, 10.0015, 10.002]) * 1e-3 / 9.8)
    assert k["K2"] == pytest.approx(np.array([5, 1, 8, 7]) * 1e-6 / 9.8)
    assert k["k_VI"] == pytest.approx([1e9] * 4)
    assert list(k) == [p.name for p in PARAMETERS]
    assert all(not np.any(k[n]) for n in k if n not in TEXT)
    assert all(v.shape == (4,) and not v.flags.writeable for v in k.values())


@pytest.mark.parametrize("text", ['"0,1 m"', '"0.1m"', '" 1e-1  m "', '{ value = 10, unit = "cm" }'])
def test_a_quantity_is_written_as_people_do(text: str) -> None:
    assert parse_instrument(with_line('"0.1 m"', text)).radius == pytest.approx(0.1)


def test_effects() -> None:
    cubic = '{ id = "cubic-input", K_iii = { value = [2, 0, 0, 0], unit = "ug/g^3" } }'
    table = '{ id = "mine", stage = "transducer", add = "c*f_i^5", c = { value = 3, unit = "ug/g^5" } }'
    instrument = parse_instrument(with_effects(f'["lag", {cubic}, {table}]'))
    lag, cubic, mine = instrument.effects
    assert lag == EffectSetting("lag")
    assert lag.si("tau", "s", instrument.g0) is None
    assert cubic.si("K_iii", "1/(m/s^2)^2", instrument.g0) == pytest.approx([2e-6 / 9.8**2, 0, 0, 0])
    assert instrument.effect("cubic-input") is cubic
    assert instrument.effect("arm-sag") is None
    assert mine.expression is not None
    assert (mine.expression["stage"], mine.expression["add"]) == ("transducer", "c*f_i^5")
    assert mine.expression["params"]["c"]["unit"] == "ug/g^5"
    assert mine.si("c", "1/(m/s^2)^4", instrument.g0) == pytest.approx([3e-6 / 9.8**4] * 4)


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        (with_line("radius =", "raduis ="), ("[disc]", "'raduis'", "did you mean 'radius'?")),
        (with_line("[disc]", "[disk]"), ("'disk'", "did you mean 'disc'?")),
        (with_line('"0.1 m"', '"0.1 s"'), ("[disc] radius", "dimension", "'s'", "[length]")),
        (with_line('"0.1 m"', "0.1"), ("[disc] radius", "unit is missing")),
        (with_line('"0.1 m"', '"0.1"'), ("[disc] radius", "unit is missing")),
        (with_line('"0.1 m"', "{ value = 0.1, unit = 3 }"), ("[disc] radius", "unit is not a text")),
        *(
            (with_line('"0.1 m"', x), ("[disc] radius", "not a quantity"))
            for x in ("true", '"m"', '"1.2.3 m"', '{ value = 1, unit = "m", std = 1 }')
        ),
        (with_line('"0.1 m"', '"1,234 m"'), ("[disc] radius", "not a unit")),  # a thousand, or one?
        (with_line('"0.1 m"', '"1e999 m"'), ("[disc] radius", "not finite")),
        (with_line('"0.1 m"', '"-0.1 m"'), ("[disc] radius", "positive", "-0.1 m")),
        (with_line('"0.1 m"', '{ value = [1, 2, 3, 4], unit = "m" }'), ("[disc] radius", "one number")),
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
        *(
            (sure(x), ("K1", "sigma"))
            for x in ("0", "-0.1", "[0.1, 0.1, 0, 0.1]", "[0.1, 0.1]", "nan", '"0.01 mA/g"')
        ),
        ("model = 3\n" + TEXT, ("[model]", "table")),
        *(
            (f"{TEXT}[model]\n{line}", words)
            for line, words in (
                ('kinematic = "full"', ("kinematic", "kinematics", "did you mean")),
                ('kinematics = "half"', ("kinematics", "'half'", '"platform" or "full"')),
                ('order = "papr"', ("order", "papr", '"paper" or "exact"')),
                ("order = 2", ("order", "2", "mounting")),
                ("order = { mounting = 3 }", ("mounting", "3", '1 or 2 or "exact"')),
                ("order = { second_order_angles = 1 }", ("second_order_angles", "true or false")),
            )
        ),
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


@pytest.mark.parametrize(
    ("sigma", "four"), [("0.01", [0.01] * 4), ("[0.1, 0.2, 0.3, 0.4]", [0.1, 0.2, 0.3, 0.4])]
)
def test_the_sheet_can_say_how_sure_it_is(sigma: str, four: list[float]) -> None:
    instrument = parse_instrument(sure(sigma))
    np.testing.assert_allclose(instrument.sigma("K1"), np.array(four) * 1e-3 / 9.8, rtol=1e-14)
    np.testing.assert_allclose(instrument.sigma("K2"), 20e-6 / 9.8, rtol=1e-14)  # as sure as is plausible


EXAMPLE = (Path(__file__).parents[2] / "ragg_runtime" / "example.toml").read_text("utf-8")
EXACT = Form(kinematics="full", mounting="exact", misalignment="exact", second_order_angles=True)


def sheet(model: str) -> str:
    """The example with another table [model] (or none)."""
    head, _, rest = EXAMPLE.partition("[model]")
    return head + model + "\n" + rest[rest.index("[disc]") :]


@pytest.mark.parametrize(
    ("table", "form"),
    [
        ("", PAPER_FORM),
        ('[model]\nkinematics = "full"\norder = "exact"', EXACT),
        ("[model]\norder = { mounting = 2 }", Form(mounting=2)),
        (
            '[model]\norder = { mounting = "exact", misalignment = 1, second_order_angles = true }',
            Form(mounting="exact", second_order_angles=True),
        ),
    ],
)
def test_forms_are_read(table: str, form: Form) -> None:
    instrument = parse_instrument(sheet(table))
    assert instrument.form == form
    assert (form.preset is None) == (form.order not in PRESETS.values())


def test_new_writes_full_kinematics_where_the_sheet_has_no_form_and_says_so(tmp_path: Path) -> None:
    (tmp_path / "sheet.toml").write_text(sheet(""))
    stderr = ragg("new", tmp_path / "from-sheet", "--from", tmp_path / "sheet.toml").stderr
    assert "no [model]" in stderr
    assert 'kinematics = "full"' in stderr
    assert (tmp_path / "from-sheet" / "model.toml").read_text().startswith(sheet("").rstrip())
    (tmp_path / "platform.toml").write_text(sheet("[model]"))
    m = api.new(tmp_path / "platform", tmp_path / "platform.toml")
    assert (m.model, m.notes) == (load_packaged(), ())
    m = api.new(tmp_path / "own")
    assert (m.instrument.form, m.model, m.notes) == (Form(kinematics="full"), load_packaged("full"), ())
    assert api.load(tmp_path / "from-sheet").model is load_packaged("full")


def test_disc_spin_is_offered_to_models_that_lack_it_alone(tmp_path: Path) -> None:
    full, platform = load_packaged("full"), load_packaged()
    assert platform.effect("disc-spin") is not None
    assert full.effect("disc-spin") is None
    m = api.new(tmp_path / "full")
    with pytest.raises(UserError, match="the effect disc-spin is already in the model"):
        api.add(m, "disc-spin")
    (tmp_path / "bad.toml").write_text(EXAMPLE.replace("effects = []", 'effects = ["disc-spin"]'))
    with pytest.raises(UserError, match="the effect disc-spin is already in the model"):
        api.new(tmp_path / "bad", tmp_path / "bad.toml")
    keeping = parse_instrument(sheet("[model]\norder = { second_order_angles = true }"))
    assert derive.load_model(keeping).effect("second-order-misalignment") is None


@pytest.mark.parametrize(
    "form",
    [PAPER_FORM, EXACT, Form(kinematics="full", mounting="exact", second_order_angles=True)],
    ids=["paper", "exact", "mixed"],
)
def test_a_flight_without_noise_is_predicted_by_the_form_that_flew(form: Form) -> None:
    """Nominal error below 0.1 Eo; measured below 1e-5."""
    instrument = replace(parse_instrument(EXAMPLE), form=form)
    flight = simulate_flight(instrument, (), noise=0.0, sheet_error=0.0, duration=120.0, no_gradient=False)
    model = derive.load_model(instrument, candidates=False)
    p = make_vector(model, instrument)
    r = record(flight, instrument)
    left = (flight.outputs["G_out"] - evaluate_output(model.chain, r, p)) / scale_factor(model, p)
    assert np.sqrt(np.mean(left**2)) < 1e-5
    other = replace(instrument, form=PAPER_FORM if form == EXACT else EXACT)
    away = derive.load_model(other, candidates=False)
    q = make_vector(away, other)
    left = (flight.outputs["G_out"] - evaluate_output(away.chain, r, q)) / scale_factor(away, q)
    assert np.sqrt(np.mean(left**2)) > 0.1


@pytest.mark.parametrize(
    ("f", "bits"), [(0.25, 20), (0.3, 16)]
)  # steps in time with the samples: no white noise
def test_the_rate_of_the_encoder_is_smooth_and_has_no_seams(f: float, bits: int) -> None:
    """A swing of the disc comes out, the encoder's steps hardly; parts of a record give what the whole gives."""
    rate, step, w = 16.0, 2 * np.pi / 2**bits, 2 * np.pi * 0.5
    t, inner = np.arange(4000) / rate, slice(20, -20)

    def coded(angle: np.ndarray) -> np.ndarray:
        return np.mod(step * np.round(angle / step), 2 * np.pi)

    swinging = coded(2 * np.pi * f * t + 200 * step * np.sin(w * t))
    first, second = measure_spin(swinging, t, rate).values()
    assert np.std((first - 2 * np.pi * f - 200 * step * w * np.cos(w * t))[inner]) < 0.02 * 200 * step * w
    assert np.std((second + 200 * step * w**2 * np.sin(w * t))[inner]) < 0.05 * 200 * step * w**2
    assert np.std(measure_spin(coded(2 * np.pi * f * t), t, rate)[SPIN[1]][inner]) < 16 * step
    whole = Record(t, {"spin_angle": swinging}, rate, np.ones(t.size, bool), f)
    part = whole.part(slice(1000, 2000)).series(SPIN[1])
    np.testing.assert_allclose(part, second[1000:2000], rtol=0, atol=1e-9)
    plain = replace(whole, wide={})
    for name, value in zip(SPIN, (2 * np.pi * f, 0.0), strict=True):
        np.testing.assert_array_equal(plain.series(name), value)


def test_a_paper_model_lacks_the_spin_and_with_it_the_error_is_the_noise(tmp_path: Path) -> None:
    (tmp_path / "sheet.toml").write_text(sheet("[model]"))
    m = api.new(tmp_path / "paper", tmp_path / "sheet.toml")
    full = replace(m.instrument, form=Form(kinematics="full"))
    flight = simulate_flight(full, (), seed=4, duration=100.0, rate=RATE)
    same = simulate_flight(m.instrument, ["disc-spin:share=1"], seed=4, duration=100.0, rate=RATE)
    np.testing.assert_array_equal(flight.outputs["G_out"], same.outputs["G_out"])
    d = api.diagnose(m, [flight])
    assert (d.verdict, d.found) == ("missing-effect", ("disc-spin",))
    assert d.after.rms_Eo < 1.02 * d.noise_floor
    (share,) = next(r.parameters for r in d.ranking if r.effect == "disc-spin")
    assert abs(share.value - 1) < 4 * share.std
    assert share.std < 0.2


S = scenario(5, trim="table-v", duration=80.0, rate=RATE)


def flown(start: float) -> Flight:
    """A flight that begins when the disc has been turning for so many seconds, at whole turns (of 4 s) as at none."""
    turn = start % 4.0
    flight = simulate(
        S.instrument, S.motion, S.duration, S.rate, start=turn, gravity=S.gravity, noise=S.noise, seed=1
    ).flight()
    return replace(flight, time=flight.time + (start - turn), began=None)


@pytest.mark.parametrize("start", [-3.0, 0.00037, 1802.0])
def test_seconds_count_from_zero_whatever_the_first_sample_is(start: float) -> None:
    x = flown(start)
    r = record(x, S.sheet)
    expected = 2 * np.pi * np.mod(0.25 * x.time, 1.0)
    assert np.max(np.abs(np.exp(1j * r.phi) - np.exp(1j * expected))) < 1e-11
    assert r.time[0] == 0.0
    later = record(x.part(slice(100, None)), S.sheet)
    assert later.phi[0] == pytest.approx(np.angle(np.exp(1j * expected[100])), abs=1e-11)
    assert not [n for n in screen(load_packaged(), S.sheet, x).notes if "mistake" in n]


def test_instants_count_from_the_first_sample_and_the_sheet_may_say_otherwise() -> None:
    x = replace(flown(10.0), instants=True)
    assert record(x, S.sheet).phi[0] == 0.0
    cut = x.part(slice(8, None))
    assert record(cut, S.sheet).phi[0] == pytest.approx(2 * np.pi * 0.25 * 8 / RATE)
    assert abs(record(x, replace(S.sheet, angle_origin="zero")).phi[0]) == pytest.approx(np.pi)
    late = replace(S.sheet, angle_origin="first-sample")
    assert record(flown(10.0), late).phi[0] == 0.0
    said = sheet('[model]\nangle_origin = "first-sample"')
    assert parse_instrument(said).angle_origin == "first-sample"
    with pytest.raises(UserError, match="angle_origin"):
        parse_instrument(said.replace("first-sample", "first"))


def test_where_the_sheet_speaks_against_it_the_user_is_asked() -> None:
    x = flown(0.0)
    x = replace(x, time=x.time + 10.0, began=None)  # half a turn
    with pytest.raises(UserError, match="angle_origin") as caught:
        screen(load_packaged(), S.sheet, x)
    assert "at the first sample (t = 10 s), not at t = 0" in str(caught.value)
    screen(load_packaged(), replace(S.sheet, angle_origin="first-sample"), x)


@pytest.mark.parametrize("stamp", ["2026-03-01T12:00:{:05.2f}Z", "12:00:{:05.2f}"])
def test_what_is_converted_keeps_its_angle(stamp: str, tmp_path: Path) -> None:
    columns = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z", "G_out")
    units = ("m/s^2",) * 3 + ("rad/s",) * 3 + ("V",)
    head = ",".join(["time", *(f"{n} [{u}]" for n, u in zip(columns, units, strict=True))])
    rng = np.random.default_rng(1)
    rows = [f"{stamp.format(10 + k / 8)},{','.join(map(str, rng.normal(size=7)))}" for k in range(64)]
    (tmp_path / "a.csv").write_text("\n".join([head, *rows]) + "\n")
    first = read_flight(tmp_path / "a.csv", 9.8)
    report = convert(tmp_path / "a.csv", tmp_path / "b.csv")
    second = read_flight(tmp_path / "b.csv", 9.8)
    assert first.instants
    assert not second.instants
    assert second.time[0] == 0.0
    np.testing.assert_allclose(record(first, S.sheet).phi, record(second, S.sheet).phi, atol=1e-9)
    assert any("time counts from" in n for n in report["notes"])
