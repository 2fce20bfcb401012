"""The whole loop in a real browser, by mouse and by keyboard; every view, sizes and schemes, and accessibility."""

from __future__ import annotations

import os
import re
import shutil
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


def best(page: Page) -> str:
    """The effect that stands first."""
    effect = page.locator(".ranking li").first.get_attribute("data-effect")
    assert effect is not None
    return effect


def calibrated(page: Page) -> float:
    """The error of the current model."""
    row = page.locator(".banner tr", has_text="current model")
    return float(row.locator("td").nth(1).inner_text().replace("\u202f", ""))


def drawn(page: Page, what: str) -> None:
    picture = page.get_by_alt_text(what, exact=True)
    expect(picture).to_have_js_property("complete", True, timeout=PATIENCE)
    assert picture.evaluate("x => x.naturalWidth") > 0  # of a broken one 0


def test_01_verdict_errors_and_effects(page: Page) -> None:
    assert "token" not in page.url
    expect(page.locator(".view-loop .headline")).to_contain_text(
        re.compile(rf"Missing: .*\b{best(page)}\b.*\. With it the error falls")
    )
    assert calibrated(page) > 0.0
    assert page.title().startswith("model")  # the flight's name is text, and stays text
    expect(page.locator("#what")).to_contain_text(HOSTILE[:10])
    assert page.locator("img:not(.picture)").count() == 0
    expect(page.locator(".ranking li .evidence small").first).to_have_text(re.compile(r"^0\.\d\d$|^> 0.99$"))
    assert not page.locator("details.others li").first.is_visible()  # what is not significant is folded


def test_02_one_window_on_the_flight_for_what_is_drawn_over_time(page: Page) -> None:
    for what in ("time", "spectrum", "channels"):
        drawn(page, what)
    page.get_by_label("from", exact=True).fill("30")
    page.keyboard.press("Tab")
    page.wait_for_url(re.compile("from=30"))
    page.locator("#main").focus()
    drawn(page, "time")
    page.keyboard.press("0")
    expect(page.get_by_label("from", exact=True)).to_have_value("0")


def test_05_by_keyboard_alone_an_effect_is_added_undone_and_added_again(page: Page, server: Served) -> None:
    effect, before = best(page), calibrated(page)
    page.evaluate("() => scrollTo(0, 0)")
    page.locator("#main").focus()
    page.keyboard.press("j")
    page.keyboard.press("Enter")
    expect(page.locator(".ranking li:first-child .about pre").first).to_be_visible()
    page.keyboard.press("Space")
    page.keyboard.press("a")
    expect(page.locator(".chip")).to_contain_text(effect, timeout=PATIENCE)
    idle(page)
    assert calibrated(page) < before
    drawn(page, "steps")
    assert effects(server) == [effect]
    page.keyboard.press("u")
    expect(page.locator(".headline")).to_contain_text(
        re.compile(rf"Missing: .*\b{effect}\b"), timeout=PATIENCE
    )
    assert effects(server) == []
    idle(page)
    page.locator("#main").focus()
    page.keyboard.press("j")
    page.keyboard.press("Space")
    page.keyboard.press("a")
    expect(page.locator(".chip")).to_contain_text(effect, timeout=PATIENCE)
    idle(page)
    page.keyboard.press("4")
    expect(page.locator("section", has_text="History").locator("tbody tr")).to_have_count(4)
    page.keyboard.press("1")
    for title, what in (
        ("Is the residual noise?", "whiteness"),
        ("Residual against a channel", "against:temperature"),
    ):
        page.get_by_text(title).click()
        drawn(page, what)
    idle(page)


def test_06_the_test_sheet_is_edited_and_what_is_no_sheet_is_not_saved(page: Page, server: Served) -> None:
    page.keyboard.press("3")
    field, save = page.get_by_label("model.toml"), page.get_by_role("button", name="Save", exact=True)
    old = field.input_value()
    field.fill(old.replace("K0 = {", "K0 = twelve {"))
    save.click()
    expect(page.locator("#trouble")).to_be_visible()
    field.fill(old.replace("K0 = {", "K0 = { fixed = true,"))
    save.click()
    with suppress(TooLate):  # it may be done before
        page.get_by_role("button", name="Cancel").click(timeout=2000)
    expect(page.get_by_role("button", name="Discard")).to_be_hidden(timeout=PATIENCE)
    assert load_model_dir(server.folder / "model").history[-1].action == "edit"  # type: ignore[attr-defined]
    idle(page)  # what was cancelled ends at its next step; until then the page is busy
    page.locator("#main").focus()
    page.keyboard.press("u")
    expect(field).to_have_value(old, timeout=PATIENCE)
    idle(page)


def test_07_files_to_take_along(page: Page) -> None:
    page.keyboard.press("6")
    with page.expect_download() as got:
        page.get_by_role("link", name="Shell commands").click()
    commands = Path(got.value.path()).read_text()
    for verb in ("diagnose", "compensate"):
        assert f"ragg {verb}" in commands
    assert commands.count("# done: ragg add") == 1
    page.keyboard.press("1")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_08_every_view_opens_and_is_accessible(page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
    for key in "123456" if scheme == "light" else "1":
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
    page.set_viewport_size({"width": 1440, "height": 900})


def test_10_a_foreign_file_opens_the_column_dialog_at_once(page: Page, server: Served) -> None:
    page.keyboard.press("5")
    page.locator("input[type=file]").set_input_files(server.folder / "foreign.csv")  # type: ignore[attr-defined]
    text = page.get_by_label("mapping.toml")
    expect(page.locator("section", has=text).locator("li")).to_have_count(3, timeout=PATIENCE)
    expect(page.locator("#trouble")).to_be_hidden()
    save = page.get_by_role("button", name="Save with the model and open the flight")
    expect(save).to_be_disabled()
    text.fill(text.input_value().replace('unit = "?"', 'unit = "m/s^2"'))
    expect(save).to_be_enabled()
    expect(page.locator("section", has=text).locator("tbody tr")).to_have_count(7)
    save.click()
    expect(page.locator("#what")).to_contain_text("foreign", timeout=PATIENCE)
