"""The whole loop in a real browser, by mouse and by keyboard; every view, sizes and schemes, and accessibility."""

from __future__ import annotations

import os
import re
import shutil
import zipfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from serving import Served, brief, foreign, served

from ragg_runtime import api
from ragg_runtime.model.directory import load_model_dir

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update"]
PATIENCE = 120_000  # ms; a busy machine is no failure

if CHROMIUM is None and not os.environ.get("CI"):
    pytest.skip("no Chromium here (apt-get install chromium)", allow_module_level=True)

from axe_playwright_python.sync_playwright import Axe  # noqa: E402
from playwright.sync_api import Browser, Page, expect, sync_playwright  # noqa: E402
from playwright.sync_api import TimeoutError as TooLate  # noqa: E402

expect.set_options(timeout=60_000)  # ms; a busy machine is no failure

HOSTILE = 'a"><img src=x onerror=document.title=1>'


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    assert CHROMIUM is not None, "the browser tests need Chromium: apt-get install chromium"
    with sync_playwright() as p:
        made = p.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield made
        made.close()


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    folder = tmp_path_factory.mktemp("studio")
    api.new(folder / "model")
    flight = folder / f"{HOSTILE.replace('/', '')}.parquet"
    brief(flight)
    foreign(folder / "foreign.csv")
    with served(folder / "model", flight) as s:
        s.folder = folder  # type: ignore[attr-defined]
        yield s


@pytest.fixture(scope="module")
def page(browser: Browser, server: Served) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1440, "height": 900}, reduced_motion="reduce")
    made = context.new_page()
    made.set_default_timeout(PATIENCE)
    troubles: list[str] = []
    made.on("pageerror", lambda e: troubles.append(str(e)))
    made.on(
        "request",
        lambda r: troubles.append(r.url) if not r.url.startswith((server.origin, "data:", "blob:")) else None,
    )
    made.goto(server.address)  # before the model is read: the page follows
    expect(made.locator(".ranking li").first).to_be_visible(timeout=PATIENCE)
    yield made
    context.close()
    assert troubles == []


def idle(page: Page) -> None:
    expect(page.locator("html:not([data-busy])")).to_be_attached(timeout=PATIENCE)


def effects(server: Served) -> list[str]:
    return [e.id for e in load_model_dir(server.folder / "model").instrument.effects]  # type: ignore[attr-defined]


def shown(page: Page, selector: str) -> bytes:
    """What a figure looks like now."""
    return page.locator(selector).screenshot()


def in_view(page: Page, selector: str) -> dict[str, float]:
    page.locator(selector).scroll_into_view_if_needed()
    box = page.locator(selector).bounding_box()
    assert box is not None
    return dict(box)


def changes(page: Page, selector: str, before: bytes) -> None:
    for _ in range(1200):
        if shown(page, selector) != before:
            return
        page.wait_for_timeout(50)
    raise AssertionError(f"{selector} does not change")


def best(page: Page) -> str:
    """The effect that stands first."""
    effect = page.locator(".ranking li").first.get_attribute("data-effect")
    assert effect is not None
    return effect


def figure(page: Page, selector: str) -> float:
    """A number of the banner."""
    return float(page.locator(selector).inner_text().replace("\u202f", ""))


def test_01_verdict_errors_and_effects(page: Page) -> None:
    assert "token" not in page.url
    expect(page.locator(".view-loop .headline")).to_contain_text(
        re.compile(rf"Missing: .*\b{best(page)}\b.*\. With it the error falls")
    )
    assert figure(page, ".errors .nominal b") > figure(page, ".errors .calibrated b") > 0.0
    assert page.title().startswith("model")  # the flight's name is text, and stays text
    expect(page.locator("#what")).to_contain_text(HOSTILE[:10])
    assert page.locator("img").count() == 0
    expect(page.locator(".ranking li .evidence small").first).to_have_text(re.compile(r"^0\.\d\d$|^> 0.99$"))
    assert not page.locator("details.others li").first.is_visible()  # what is not significant is folded


def test_02_pointing_and_ticking_show_what_an_effect_explains(page: Page, server: Served) -> None:
    before = shown(page, ".plot.residual")
    page.hover(".ranking li:first-child .title")
    expect(page.locator("figure.residual .legend")).to_contain_text("predicted signature")
    changes(page, ".plot.residual", before)
    page.mouse.move(5, 5)
    expect(page.locator("figure.residual .legend")).not_to_contain_text("predicted signature")
    page.check(".ranking li:first-child input")
    expect(page.locator(".foreseen b")).to_have_text(re.compile(r"^\d"))
    expect(page.locator(".steps .foreseen")).to_be_attached()
    expect(page.locator("figure.spectrum .legend")).to_contain_text("with what is ticked")
    assert effects(server) == []
    page.uncheck(".ranking li:first-child input")


def test_03_one_window_of_time_for_all_figures(page: Page) -> None:
    spectrum, gram = shown(page, ".plot.spectrum"), shown(page, ".plot.spectrogram")
    box = in_view(page, ".plot.residual .u-over")
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] * 0.25, middle)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.75, middle, steps=5)
    page.mouse.up()
    expect(page.locator(".window")).to_have_text(re.compile(r"^(29|30)[\d.]* – (89|90)[\d.]* s of 120"))
    changes(page, ".plot.spectrum", spectrum)
    changes(page, ".plot.spectrogram", gram)
    page.wait_for_timeout(250)
    page.mouse.move(box["x"] + box["width"] * 0.4, middle)
    for name, said in (
        ("residual", r" s · residual −?[\d.]+.* Eo$"),
        ("measured", " s · measured .* · model "),
    ):
        expect(page.locator(f"figure.{name} .readout")).to_have_text(re.compile(said))  # linked
    assert "from=" in page.url
    page.keyboard.press("0")
    expect(page.locator(".window")).to_contain_text("0 – 120")
    for key, name in zip("vice", ("V", "inline", "cross", "Eo"), strict=True):
        page.keyboard.press(key)
        expect(page.locator(".figure-head [aria-pressed=true]")).to_have_text(name)


def test_04_a_cell_of_the_map_lays_its_term_over_the_residual(page: Page) -> None:
    cell = page.locator(".heat tbody button").first
    expect(cell).to_be_visible(timeout=PATIENCE)
    cell.click()
    expect(page.locator("figure.residual .legend")).to_contain_text("term, fitted alone")
    page.locator(".heat button[aria-pressed=true]").click()
    box = in_view(page, ".plot.spectrum .u-over")
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] * 0.3, y)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.8, y, steps=4)
    page.mouse.up()
    expect(page.locator(".heat tr.marked").first).to_be_attached()
    page.mouse.dblclick(box["x"] + 20, y)
    expect(page.locator(".heat tr.marked")).to_have_count(0)


def test_05_by_keyboard_alone_an_effect_is_added_undone_and_redone(page: Page, server: Served) -> None:
    effect, before = best(page), figure(page, ".errors .calibrated b")
    page.evaluate("() => scrollTo(0, 0)")
    page.locator("#main").focus()
    page.keyboard.press("j")
    page.keyboard.press("Enter")
    expect(page.locator(".ranking li:first-child math").first).to_be_visible()
    page.keyboard.press("Space")
    page.keyboard.press("a")
    expect(page.locator(".chip")).to_contain_text(effect, timeout=PATIENCE)
    idle(page)
    assert figure(page, ".errors .calibrated b") < before
    expect(page.locator("figure.spectrum .legend")).to_contain_text("before the last step")
    assert effects(server) == [effect]
    page.keyboard.press("u")
    expect(page.locator(".headline")).to_contain_text(
        re.compile(rf"Missing: .*\b{effect}\b"), timeout=PATIENCE
    )
    assert effects(server) == []
    idle(page)
    page.keyboard.press("r")
    expect(page.locator(".chip")).to_contain_text(effect, timeout=PATIENCE)
    idle(page)
    page.keyboard.press("4")
    expect(page.locator(".history .badge")).to_have_count(1)
    page.keyboard.press("1")
    page.get_by_text("Is the residual noise?").click()
    for what in ("against:temperature", "whiteness"):
        expect(page.get_by_alt_text(what)).to_have_js_property("complete", True)
        assert page.get_by_alt_text(what).evaluate("x => x.naturalWidth") > 0  # of a broken one 0
    idle(page)


def test_06_the_test_sheet_is_edited_and_what_is_no_number_is_not_saved(page: Page, server: Served) -> None:
    page.keyboard.press("3")
    expect(page.locator("section", has_text="Discs").locator("tbody tr")).to_have_count(1)
    field = page.get_by_label("K0 of A1, ug")
    old = field.input_value()
    field.fill("twelve")
    expect(page.locator(".sheet [aria-invalid=true]")).to_have_count(1)
    expect(page.get_by_role("button", name="Save 1 changed parameter")).to_be_disabled()
    field.fill(str(float(old) + 1))
    page.get_by_role("button", name="Save 1 changed parameter").click()
    with suppress(TooLate):  # it may be done before
        page.get_by_role("button", name="Cancel").click(timeout=2000)
    expect(page.get_by_role("button", name="Nothing changed")).to_be_visible(timeout=PATIENCE)
    assert load_model_dir(server.folder / "model").history[-1].action == "edit"  # type: ignore[attr-defined]
    idle(page)  # what was cancelled ends at its next step; until then the page is busy
    page.locator("#main").focus()
    page.keyboard.press("u")
    expect(page.get_by_label("K0 of A1, ug")).to_have_value(old, timeout=PATIENCE)
    idle(page)


def test_07_compensated_channels_and_files(page: Page) -> None:
    page.keyboard.press("6")
    page.get_by_role("button", name="Compensate", exact=True).click()
    expect(page.get_by_alt_text("compensated")).to_have_js_property("complete", True, timeout=PATIENCE)
    assert page.get_by_alt_text("compensated").evaluate("x => x.naturalWidth") > 0  # of a broken one 0
    expect(page.locator(".view-apply tbody tr", has_text="inline").first).to_be_visible()
    with page.expect_download() as got:
        page.get_by_role("link", name="Save as CSV").click()
    rows = Path(got.value.path()).read_text().splitlines()
    assert rows[0] == "time [s],inline [Eo],cross [Eo],inline_std [Eo],cross_std [Eo],quality [1]"
    idle(page)
    page.keyboard.press("7")
    with page.expect_download() as got:
        page.get_by_role("link", name="Shell commands").click()
    commands = Path(got.value.path()).read_text()
    for verb in ("diagnose", "compensate"):
        assert f"ragg {verb}" in commands
    assert commands.count("# done: ragg add") == 1
    with page.expect_download() as got:
        page.get_by_role("link", name="The model in C").click()
    with zipfile.ZipFile(got.value.path()) as z:
        assert "model-c/Makefile" in z.namelist()
    page.keyboard.press("1")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_08_every_view_opens_and_is_accessible(page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
    for key in "1234567" if scheme == "light" else "1":
        page.locator("#main").focus()
        page.keyboard.press(key)
        expect(page.locator("#main h2").first).to_be_visible()
        found: dict[str, Any] = Axe().run(page).response
        bad = [
            (v["id"], [n["target"] for n in v["nodes"]][:3])
            for v in found["violations"]
            if v["impact"] in ("serious", "critical")
        ]
        assert bad == [], (scheme, key)
    page.keyboard.press("1")


@pytest.mark.parametrize("width, height", [(1280, 720), (3840, 2160), (820, 1180)])
def test_09_nothing_runs_over_at_any_size(page: Page, width: int, height: int) -> None:
    page.set_viewport_size({"width": width, "height": height})
    page.wait_for_timeout(200)
    assert page.evaluate("() => document.documentElement.scrollWidth - innerWidth") <= 0
    box = page.locator(".plot.residual .u-over").bounding_box()
    assert box is not None
    assert box["width"] > 0.4 * width
    page.set_viewport_size({"width": 1440, "height": 900})


def test_10_a_foreign_file_opens_the_column_dialog_at_once(page: Page, server: Served) -> None:
    page.keyboard.press("5")
    page.locator("input[type=file]").set_input_files(server.folder / "foreign.csv")  # type: ignore[attr-defined]
    asked = page.locator("section > .wide .mapping tbody tr")
    expect(asked).to_have_count(3, timeout=PATIENCE)
    expect(page.locator("#trouble")).to_be_hidden()
    save = page.get_by_role("button", name="Save with the model and open the flight")
    expect(save).to_be_disabled()
    for axis in "xyz":
        page.get_by_label(f"unit of a_{axis}", exact=True).fill("m/s^2")
    expect(save).to_be_enabled()
    expect(asked.first.locator(".sparkline path")).to_be_attached()
    save.click()
    expect(page.locator("#what")).to_contain_text("foreign", timeout=PATIENCE)
