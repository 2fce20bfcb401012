"""The film strip of docs/studio.md: the demonstration in the studio before a tick, with it, and once it is derived.

``python -m examples.film_strip`` draws it anew; it needs the extra ``dev`` and Chromium.
"""

from __future__ import annotations

import io
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

FLIGHT = Path(__file__).parent / "demo-flight.parquet"
TARGET = Path(__file__).parents[1] / "docs" / "studio.jpg"
SIZE = (1440, 1080)
WIDTH, GAP = 800, 10


def frames(page: Page, address: str) -> list[bytes]:
    """Three views of the loop."""
    page.goto(address)
    page.wait_for_selector(".ranking li", timeout=60_000)
    page.wait_for_selector(".heat button.deep", timeout=60_000)
    shots = [page.screenshot()]
    page.click(".ranking li:first-child .title")
    page.check(".ranking li:first-child input")
    page.wait_for_timeout(2500)
    shots.append(page.screenshot())
    page.keyboard.press("a")
    page.mouse.move(5, 500)
    page.wait_for_selector(".verdict.good", timeout=60_000)
    page.wait_for_timeout(2500)
    return [*shots, page.screenshot()]


def main() -> None:
    """Start the studio, take the frames, join them."""
    ragg = [sys.executable, "-m", "ragg_runtime"]
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as p:
        model = Path(folder) / "demo"
        subprocess.run([*ragg, "new", str(model)], check=True, stdout=subprocess.DEVNULL)
        command = [*ragg, "studio", str(model), str(FLIGHT), "--no-browser"]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        assert server.stdout is not None
        browser = p.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        try:
            page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
            shots = frames(page, server.stdout.readline().strip())
        finally:
            browser.close()
            server.terminate()
            server.wait()
    height = WIDTH * SIZE[1] // SIZE[0]
    strip = Image.new("RGB", (WIDTH, 3 * height + 2 * GAP), "white")
    for k, shot in enumerate(shots):
        small = Image.open(io.BytesIO(shot)).convert("RGB").resize((WIDTH, height), Image.Resampling.LANCZOS)
        strip.paste(small, (0, k * (height + GAP)))
    strip.save(TARGET, quality=82, optimize=True)


if __name__ == "__main__":
    main()
