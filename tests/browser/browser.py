"""A headless Chromium, driven through its DevTools protocol over a pipe."""

from __future__ import annotations

import base64
import contextlib
import itertools
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

PATIENCE = 60.0
"""Seconds for which something is waited for on a busy machine."""


class Navigated(Exception):
    """The page of a call has given way to the next."""


class Browser:
    """A browser with one page."""

    def __init__(self) -> None:
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self.outgoing = os.pipe()
        self.incoming, from_browser = os.pipe()

        def connect() -> None:
            # The protocol is spoken on the descriptors 3 and 4, which may be in use by these pipes.
            high = [os.dup(to_browser), os.dup(from_browser)]
            high = [os.dup(fd) if fd < 5 else fd for fd in high]
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        command = ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                   "--no-first-run", "--disable-background-networking", "--hide-scrollbars",
                   "--remote-debugging-pipe", f"--user-data-dir={self.profile.name}", "about:blank"]
        self.process = subprocess.Popen(
            command, pass_fds=(3, 4, to_browser, from_browser), preexec_fn=connect,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.numbers = itertools.count(1)
        self.read = b""
        self.faults: list[str] = []
        self.session: str | None = None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.target = target
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log"]:
            self.call(f"{domain}.enable")

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Calls a method of the page and returns its result."""
        number = next(self.numbers)
        message = {"id": number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.outgoing, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.next_message()
            if answer.get("id") == number:
                if "navigated" in answer.get("error", {}).get("message", ""):
                    raise Navigated(method)
                assert "error" not in answer, f"{method}: {answer['error']}"
                return answer["result"]
            self.note(answer)

    def next_message(self) -> dict[str, Any]:
        while b"\0" not in self.read:
            part = os.read(self.incoming, 1 << 16)
            assert part, "the browser has ended"
            self.read += part
        message, self.read = self.read.split(b"\0", 1)
        return json.loads(message)

    def note(self, message: dict[str, Any]) -> None:
        """Keeps what the console of the page would show as an error."""
        what, more = message.get("method"), message.get("params", {})
        if what == "Runtime.exceptionThrown":
            self.faults.append(json.dumps(more["exceptionDetails"])[:600])
        if what == "Log.entryAdded" and more["entry"]["level"] == "error":
            self.faults.append(f"{more['entry']['text']} {more['entry'].get('url', '')}")
        if what == "Runtime.consoleAPICalled" and more["type"] in ("error", "assert"):
            self.faults.append(json.dumps(more["args"])[:600])

    def value(self, script: str) -> Any:
        """The value of an expression in the page."""
        found = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in found, f"{script}: {found['exceptionDetails']}"
        return found["result"].get("value")

    def wait(self, script: str) -> Any:
        """The value of an expression once it is true."""
        until = time.monotonic() + PATIENCE
        while True:
            # While a page gives way to the next there is no value.
            with contextlib.suppress(Navigated):
                if found := self.value(script):
                    return found
            assert time.monotonic() < until, f"never true: {script}"
            time.sleep(0.002)

    def mouse(self, kind: str, x: float, y: float) -> None:
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1, clickCount=1)

    def key(self, key: str, code: int) -> None:
        text = "\r" if key == "Enter" else ""
        for kind in ["keyDown", "keyUp"]:
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code, text=text)

    def picture(self, path: Path, width: int, height: int, scheme: str = "light", whole: bool = False) -> None:
        """Leaves a picture of the page."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        time.sleep(0.5)
        shot = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        path.write_bytes(base64.b64decode(shot["data"]))

    def close_page(self) -> None:
        session, self.session = self.session, None
        self.call("Target.closeTarget", targetId=self.target)
        self.session = session

    def end(self) -> None:
        self.process.terminate()
        self.process.wait()
        self.profile.cleanup()
