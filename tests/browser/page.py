"""Drives the page of `pellicle explore` as a user would, and compares its numbers with those of `pellicle run`."""

from __future__ import annotations

import json
import os
import resource
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from browser import PATIENCE, Browser

CASE = """title = "Ball on a hard coating"

[foundation]
substrate = { young_modulus = "3 GPa", poisson_ratio = 0.35 }

[[foundation.layer]]
thickness = "2 um"                  # of the coating
young_modulus = "200 GPa"
poisson_ratio = 0.25
yield_strength = "6 GPa"

[indenter]
kind = "sphere"
radius = "0.5 mm"

[load]
force = "20 mN"

[grid]
elements = 64
"""

THICKNESS = "foundation.layer[0].thickness"
DRAGGED, TYPED = 40, 12

STATE = """(() => ({
  text: document.getElementById("toml").value,
  elements: Number(document.body.dataset.elements), sketch: document.body.dataset.sketch === "true",
  milliseconds: Number(document.body.dataset.milliseconds), answers: Number(document.body.dataset.answers),
  error: document.getElementById("error").hidden ? null : document.getElementById("error").textContent,
  numbers: Object.fromEntries([...document.querySelectorAll("#numbers td[data-key]")].map((cell) =>
    [cell.dataset.key, [cell.dataset.value, cell.nextSibling.dataset.error]])),
}))()"""


class Explorer:
    """The program, and its page in the browser."""

    def __init__(self, program: str, folder: Path, browser: Browser, *case: str) -> None:
        self.program, self.folder, self.browser = program, folder, browser
        self.server = subprocess.Popen([program, "explore", *case, "--no-browser"], cwd=folder,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert self.server.stdout
        self.address = self.server.stdout.readline().strip()
        browser.call("Page.navigate", url=self.address)

    def answered(self, before: int) -> dict[str, Any]:
        """What is shown after the next answer."""
        self.browser.wait(f"Number(document.body?.dataset.answers ?? 0) > {before}")
        return self.browser.value(STATE)

    def now(self) -> dict[str, Any]:
        self.browser.wait("document.body?.dataset.answers && !document.body.dataset.busy")
        return self.browser.value(STATE)

    def at_rest(self) -> dict[str, Any]:
        """What is shown once nothing more is asked for."""
        while True:
            before = self.now()
            time.sleep(0.5)
            if self.now()["answers"] == before["answers"]:
                return self.now()

    def run(self, shown: dict[str, Any]) -> dict[str, Any]:
        """The first step of the summary of a case that is shown."""
        (self.folder / "case.toml").write_text(shown["text"])
        sets = ["--set", f"grid.elements={shown['elements']}"] if shown["sketch"] else []
        done = subprocess.run([self.program, "run", "case.toml", "--json", *sets], cwd=self.folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)["steps"][-1]

    def compare(self, shown: dict[str, Any]) -> int:
        """Asserts that every number that is shown is that of a run, to the bit; returns how many."""
        step = self.run(shown)
        for key, (value, error) in shown["numbers"].items():
            expected: Any = step
            for part in key.split("."):
                expected = expected[part]
            assert json.loads(value) == expected, f"{key}: {value} is not {expected}\n{shown['text']}"
            estimate = (step["grid_error"].get(key) or {}).get("estimate")
            assert json.loads(error) == estimate, f"{key}: ± {error} is not {estimate}"
        assert len(shown["numbers"]) > 5, shown
        return len(shown["numbers"])

    def focus(self, field: str) -> None:
        script = f"(() => {{ const e = document.getElementById({json.dumps(field)}); e.scrollIntoView({{block: 'center'}}); e.focus(); e.select?.(); return true; }})()"
        assert self.browser.value(script), field

    def type(self, field: str, value: str) -> dict[str, Any]:
        """Types a value into a field, and returns what is shown then."""
        before = self.now()["answers"]
        self.focus(f"at-{field}")
        self.browser.call("Input.insertText", text=value)
        self.browser.key("Enter", 13)
        return self.answered(before)

    def choose(self, field: str, word: str) -> dict[str, Any]:
        before = self.now()["answers"]
        assert self.browser.value(
            f"(() => {{ const e = document.getElementById({json.dumps(field)}); e.value = {json.dumps(word)};"
            " e.dispatchEvent(new Event('change')); return e.value; })()") == word
        return self.answered(before)

    def click(self, label: str) -> dict[str, Any]:
        before = self.now()["answers"]
        clicked = f"(() => {{ const b = [...document.querySelectorAll('button')].find((b) => b.textContent === {json.dumps(label)}); b.click(); return true; }})()"
        assert self.browser.value(clicked)
        return self.answered(before)


def drags_a_slider(explorer: Explorer) -> None:
    """Each of 40 positions of a slider shows the numbers of a run at that value."""
    browser = explorer.browser
    explorer.at_rest()
    explorer.focus(f"slide-{THICKNESS}")
    box = browser.value(f"(() => {{ const b = document.getElementById('slide-{THICKNESS}').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; }})()")
    left, top, width, height = box
    x, y = left + width / 2, top + height / 2
    browser.mouse("mousePressed", x, y)
    shown = []
    for _ in range(DRAGGED):
        before = browser.value(STATE)["answers"]
        x += width / (2.5 * DRAGGED)
        browser.mouse("mouseMoved", x, y)
        shown.append(explorer.answered(before))
    browser.mouse("mouseReleased", x, y)
    values = {state["text"].split("thickness = ")[1].split("\n")[0] for state in shown}
    assert len(values) == DRAGGED, values
    assert all("# of the coating" in value for value in values), "the comments stay"
    numbers = sum(explorer.compare(state) for state in shown)
    print(f"browser: {numbers} numbers of {DRAGGED} answers at N = {shown[0]['elements']} are those of run; "
          f"{told(shown)}")


def told(shown: list[dict[str, Any]]) -> str:
    times = sorted(state["milliseconds"] for state in shown)
    return f"median {statistics.median(times):.0f} ms from the hand to the numbers, slowest {times[-1]:.0f} ms"


def sketches_first(explorer: Explorer) -> None:
    """With 256 elements a moving slider shows a sketch, which says so, and the hand at rest all elements."""
    explorer.at_rest()
    shown = explorer.type("grid.elements", "256")
    assert (shown["elements"], shown["sketch"]) == (256, False), shown
    explorer.focus(f"slide-{THICKNESS}")
    before = explorer.now()["answers"]
    explorer.browser.key("ArrowLeft", 37)
    sketch = explorer.answered(before)
    assert (sketch["elements"], sketch["sketch"]) == (64, True), sketch
    assert explorer.browser.value("document.querySelector('#state').textContent").startswith("sketch, N = 64")
    fine = explorer.at_rest()
    assert (fine["elements"], fine["sketch"]) == (256, False), fine
    for state in [sketch, fine]:
        explorer.compare(state)
    typed = [explorer.type(THICKNESS, f"{2 + 0.1 * i:.1f} um") for i in range(TYPED)]
    explorer.compare(typed[-1])
    print(f"browser: at N = 256 {told(typed)}")


def shows_a_bad_value_at_its_field(explorer: Explorer) -> None:
    good = explorer.at_rest()
    bad = explorer.type(THICKNESS, "-1 um")
    fault = f"document.querySelector('#form [data-path=\"{THICKNESS}\"] > .fault:not([hidden])')?.textContent"
    assert "found \"-1 um\", wanted a positive length" in explorer.browser.value(fault), bad
    assert bad["error"] and bad["numbers"] == good["numbers"], "the last result stays"
    assert explorer.browser.value("document.body.classList.contains('stale')")
    mended = explorer.type(THICKNESS, "2 um")
    assert mended["error"] is None and explorer.browser.value(fault) is None
    explorer.compare(mended)


def changes_more_than_numbers(explorer: Explorer) -> None:
    """Kinds, layers, alternatives and stresses: each leads to a case that runs."""
    explorer.type("grid.elements", "32")
    assert explorer.choose("kind-indenter", "cone")["error"] is None
    explorer.choose("kind-indenter", "sphere")
    explorer.type("indenter.radius", "0.4 mm")
    before = explorer.now()["text"].count("thickness")
    layered = explorer.click("add a layer on top")
    assert layered["error"] is None and layered["text"].count("thickness") == before + 1
    explorer.type(THICKNESS, "50 nm")
    explorer.browser.value("document.getElementById('pin').click()")
    explorer.compare(explorer.type("foundation.layer[0].young_modulus", "400 GPa"))
    changed = explorer.browser.value("[...document.querySelectorAll('#numbers td.pinned')].map((cell) => cell.textContent)")
    assert any(text.endswith(" %") for text in changed), changed
    curve = explorer.click("by forces")
    assert "forces = { from = " in curve["text"] and curve["error"] is None, curve
    assert not explorer.browser.value("document.getElementById('curve').hidden")
    explorer.compare(curve)
    stressed = explorer.click("Stresses")
    assert stressed["error"] is None
    assert explorer.browser.value("document.querySelectorAll('#stresses td[data-key]').length") > 8
    assert explorer.browser.value("document.querySelectorAll('#critical li').length") > 0
    explorer.click("Without stresses")


def survives_a_thousand_requests(explorer: Explorer) -> None:
    """All are served or refused, the program needs hardly more memory, and the page lives on."""
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most if most < 4096 else 4096, most))
    host, port = explorer.address.split("/")[2].split(":")
    path = explorer.address.split(port, 1)[1]
    request = f"GET {path}form HTTP/1.1\r\nHost: {host}:{port}\r\n\r\n".encode()

    def memory() -> int:
        status = Path(f"/proc/{explorer.server.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0]) // 1024

    before = memory()
    connections = []
    for _ in range(1000):
        connections.append(socket.create_connection((host, int(port))))
    answers = {"served": 0, "refused": 0}
    for connection in connections:
        try:
            connection.sendall(request)
        except OSError:  # closed already
            pass
    for connection in connections:
        found = b""
        try:
            while part := connection.recv(1 << 16):
                found += part
        except OSError:
            pass
        served = found.startswith(b"HTTP/1.1 200")
        assert served or not found or found.startswith(b"HTTP/1.1 503"), found[:80]
        answers["served" if served else "refused"] += 1
        connection.close()
    after = memory()
    assert answers["served"] > 0, answers
    assert after - before < 64, f"{before} to {after} MB"
    explorer.compare(explorer.type(THICKNESS, "2.2 um"))
    print(f"browser: of 1000 requests at once {answers['served']} served, {answers['refused']} refused; memory {before} to {after} MB")


def takes_pictures(explorer: Explorer, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    explorer.type("grid.elements", "128")
    explorer.type("foundation.layer[0].thickness", "100 nm")
    browser = explorer.browser
    browser.value("scrollTo(0, 0)")
    for name, width, height, scheme in [("wide", 1440, 1000, "light"), ("narrow", 390, 844, "light"),
                                        ("dark", 1440, 1000, "dark"), ("narrow-dark", 390, 844, "dark")]:
        browser.picture(folder / f"{name}.png", width, height, scheme)
        height = min(4000, browser.value("document.documentElement.scrollHeight"))
        browser.picture(folder / f"{name}-whole.png", width, height, scheme)
    assert browser.value("document.documentElement.scrollWidth <= innerWidth"), "a narrow screen scrolls down only"
    browser.call("Emulation.clearDeviceMetricsOverride")


def ends_with_its_page(explorer: Explorer) -> None:
    explorer.browser.close_page()
    assert explorer.server.wait(PATIENCE) == 0


def every_template_opens(program: str, folder: Path) -> None:
    browser = Browser()
    try:
        explorer = Explorer(program, folder, browser)
        count = browser.wait("document.querySelectorAll('#templates button').length")
        assert count > 10, count
        for name in ["hertz", "rough-periodic"]:
            browser.value(f"[...document.querySelectorAll('#templates b')].find((b) => b.textContent === '{name}').click()")
            shown = explorer.now()
            assert shown["error"] is None and len(shown["numbers"]) > 5, shown
            # What is loaded again goes on where it was.
            title = explorer.type("title", "another")["text"]
            browser.call("Page.reload")
            browser.wait("document.readyState === 'complete' && !document.getElementById('explorer').hidden")
            assert explorer.now()["text"] == title
            browser.value("document.getElementById('other').click()")
            browser.wait("document.querySelectorAll('#templates button').length && !document.getElementById('chooser').hidden")
        assert not browser.faults, browser.faults
        ends_with_its_page(explorer)
    finally:
        browser.end()


def main() -> None:
    program = os.path.abspath(sys.argv[1])
    pictures = Path(sys.argv[2]).absolute() if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["PELLICLE_CACHE"] = str(folder / "cache")
        (folder / "case.toml").write_text(CASE)
        browser = Browser()
        try:
            explorer = Explorer(program, folder, browser, "case.toml")
            drags_a_slider(explorer)
            sketches_first(explorer)
            shows_a_bad_value_at_its_field(explorer)
            survives_a_thousand_requests(explorer)
            changes_more_than_numbers(explorer)
            if pictures:
                takes_pictures(explorer, pictures)
            assert not browser.faults, browser.faults
            ends_with_its_page(explorer)
        finally:
            browser.end()
        every_template_opens(program, folder)
    print("browser: passed")


if __name__ == "__main__":
    main()
