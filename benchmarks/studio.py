"""The studio, measured in the browser: opening, the preview of a tick, zooming over a day at 100 Hz, memory.

Needs Playwright and Chromium; without them there are no rows. The demonstration's flight, and a day of output alone
(the first look at a record is at the output; what then examines it runs meanwhile, as it does for a user).
"""

from __future__ import annotations

import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from benchmarks import Row

FLIGHT = Path(__file__).resolve().parents[1] / "examples" / "demo-flight.parquet"
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--enable-precise-memory-info"]
TICKS = 12
DAY = 8_640_000

TICK = """async (n) => {
  const box = document.querySelectorAll(".ranking input:enabled")[n % 8], found = [];
  const text = () => (document.querySelector(".foreseen b") || {}).textContent || "";
  for (let k = 0; k < 2; k++) {
    const before = text(), began = performance.now();
    box.click();
    while (text() === before && performance.now() - began < 5000) await new Promise((r) => setTimeout(r, 1));
    if (text()) found.push(performance.now() - began);
    await new Promise((r) => setTimeout(r, 400));
  }
  return found;
}"""

MOVE = """async (pan) => {
  const over = document.querySelector(".plot.measured .u-over"), r = over.getBoundingClientRect();
  let frames = 0, run = true, worst = 0, last = performance.now();
  const began = last;
  const frame = () => {
    const now = performance.now();
    frames++;
    worst = Math.max(worst, now - last);
    last = now;
    if (run) requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  for (let k = 0; k < 60; k++) {
    const at = { clientX: r.left + 400, clientY: r.top + 40, bubbles: true, cancelable: true };
    const back = k < (pan ? 30 : 35) ? -100 : 100;
    over.dispatchEvent(new WheelEvent("wheel", { deltaY: back, shiftKey: pan, ...at }));
    await new Promise((done) => setTimeout(done, 16));
  }
  run = false;
  return [(1000 * frames) / (performance.now() - began), worst, performance.memory.usedJSHeapSize / 1e6];
}"""


def run() -> list[Row]:
    """Latencies and memory."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        return []
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        return []
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as p:
        browser = p.chromium.launch(executable_path=chromium, args=FLAGS)
        try:
            return [*_demonstration(browser, Path(folder)), *_day(browser, Path(folder))]
        finally:
            browser.close()


@contextmanager
def _served(folder: Path, name: str, flight: Path) -> Iterator[str]:
    model = folder / name
    ragg = [sys.executable, "-m", "ragg_runtime"]
    subprocess.run([*ragg, "new", str(model)], check=True, stdout=subprocess.DEVNULL)
    command = [*ragg, "studio", str(model), str(flight), "--no-browser"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert process.stdout is not None
    try:
        yield process.stdout.readline().strip()
    finally:
        process.terminate()
        process.wait(10)
        process.stdout.close()


def _row(name: str, values: list[float], unit: str, most: float, note: str = "") -> Row:
    middle = statistics.median(values)
    text = f"at most {most:g} {unit}"
    return Row(
        name, middle, unit, note, text, low=min(values), high=max(values), better="lower", met=middle <= most
    )


def _demonstration(browser: Any, folder: Path) -> list[Row]:
    with _served(folder, "demo", FLIGHT) as address:
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        began = time.perf_counter()
        page.goto(address)
        page.wait_for_selector(".ranking li", timeout=60_000)
        opened = time.perf_counter() - began
        page.wait_for_timeout(1500)
        ticks = [x for n in range(TICKS) for x in page.evaluate(TICK, n)]
        page.close()
    note = "12 min at 16 Hz: read, compared, every effect tested"
    return [
        _row("open the demonstration", [opened], "s", 10.0, note),
        _row("tick to foreseen error on the page", ticks, "ms", 100.0, f"{len(ticks)} ticks"),
    ]


def _day(browser: Any, folder: Path) -> list[Row]:
    import numpy as np
    import pyarrow as pa
    import pyarrow.parquet as pq

    t = np.arange(DAY) / 100.0
    series = {
        "time": ("s", t),
        "G_out": ("V", np.random.default_rng(0).normal(size=DAY) + 20 * np.sin(1.57 * t)),
    }
    fields = [pa.field(name, pa.float64(), metadata={"units": unit}) for name, (unit, _) in series.items()]
    table = pa.Table.from_arrays([pa.array(x) for _, x in series.values()], schema=pa.schema(fields))
    pq.write_table(table, folder / "day.parquet", use_dictionary=False)
    with _served(folder, "day", folder / "day.parquet") as address:
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        began = time.perf_counter()
        page.goto(address)
        page.wait_for_selector("html[data-drawn]", timeout=60_000)
        opened = time.perf_counter() - began
        page.wait_for_timeout(1000)
        rate, worst, heap = page.evaluate(MOVE, False)
        page.wait_for_selector("html:not([data-busy])", state="attached", timeout=120_000)
        page.keyboard.press("0")
        for _ in range(6):
            page.keyboard.press("+")
        page.wait_for_timeout(1000)
        panned, late, _ = page.evaluate(MOVE, True)
        page.close()
    return [
        _row("first figure of a day at 100 Hz", [opened], "s", 3.0, "8.6 million samples, Parquet"),
        Row(
            "zooming over it",
            rate,
            "frames/s",
            f"worst frame {worst:.0f} ms; drawn by software, while the server reads the day",
            "60 frames/s",
            better="higher",
            met=rate >= 55.0,
        ),
        Row(
            "panning over it",
            panned,
            "frames/s",
            f"worst frame {late:.0f} ms; drawn by software, once it is read",
            "60 frames/s",
            better="higher",
            met=panned >= 55.0,
        ),
        _row("memory of its page", [heap], "MB", 500.0, "JavaScript heap"),
    ]
