"""Chromium without a window, driven over a pipe in the Chrome DevTools Protocol: real pointer events, no packages."""

import contextlib
import json
import os
import shutil
import subprocess
import time

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

#: Chromium without a window, which draws WebGL with its processor.
HEADLESS = ("--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")

#: Widths of a window, px: telephones', a tablet's, a small and a large desk's.
WIDTHS = (390, 500, 900, 1001, 1400)

#: What of a page is cut off: wider than the window without scrolling, hidden, outside its picture or its cell.
CUT_OFF = """(() => {
  const found = new Set(), width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width + 1) found.add("the page is wider than the window");
  const scrolls = e => e && (["auto", "scroll"].includes(getComputedStyle(e).overflowX) || scrolls(e.parentElement));
  for (const e of document.querySelectorAll("body *")) {
    const box = e.getBoundingClientRect(), said = `${e.tagName} ${e.textContent.trim().slice(0, 40)}`;
    const svg = e.ownerSVGElement?.getBoundingClientRect();
    if (svg) {
      const over = [svg.left - box.left, box.right - svg.right, svg.top - box.top, box.bottom - svg.bottom];
      if (e.tagName === "text" && box.width && Math.max(...over) > 1) found.add(`outside its picture: ${said}`);
      continue;
    }
    if (["TD", "TH"].includes(e.tagName) && e.scrollWidth > e.clientWidth + 1) found.add(`beyond its cell: ${said}`);
    const hides = ["hidden", "clip"].includes(getComputedStyle(e).overflowX);
    if (hides && e.clientWidth && e.scrollWidth > e.clientWidth + 1) found.add(`cut off: ${said} ${e.value ?? ""}`);
    if (box.width && box.right > width + 1 && !scrolls(e.parentElement)) found.add(`beyond the window: ${said}`);
  }
  return [...found];
})()"""


class Browser:
    """One page. Raises :class:`AssertionError` with the page's words for what goes wrong in it."""

    def __init__(self, profile, *more, width=1366, height=900):
        down, self._write = os.pipe()
        self._read, up = os.pipe()
        shell = f"exec {CHROMIUM} \"$@\" 3<&{down} 4>&{up}"
        options = [*HEADLESS, *more, "--remote-debugging-pipe",
                   f"--user-data-dir={profile}", f"--window-size={width},{height}", "about:blank"]  # fmt: skip
        self._process = subprocess.Popen(
            ["bash", "-c", shell, "bash", *options], pass_fds=(down, up), stderr=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(down), os.close(up)
        self._buffer, self._number, self._session, self.complaints = b"", 0, None, []
        target = next(t for t in self._call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self._session = self._call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self._call(f"{domain}.enable")

    def _message(self):
        while b"\0" not in self._buffer:
            part = os.read(self._read, 1 << 16)
            assert part, "Chromium has ended"
            self._buffer += part
        text, _, self._buffer = self._buffer.partition(b"\0")
        return json.loads(text)

    def _call(self, method, **parameters):
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._message()
            if answer.get("method") in ("Runtime.exceptionThrown", "Log.entryAdded"):
                self.complaints.append(answer["params"])
            if answer.get("method") == "Network.requestWillBeSent":
                url = answer["params"]["request"]["url"]
                if not url.startswith(("file:", "data:")):
                    self.complaints.append(url)
            if answer.get("id") == self._number:
                assert "error" not in answer, answer
                return answer["result"]

    def open(self, uri):
        self._call("Page.navigate", url=uri)
        self.wait("document.body && document.body.dataset.solved === 'yes'")

    def cut_off(self, uri, width):
        """What of a page is cut off in a window of this width, px."""
        size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        self._call("Emulation.setDeviceMetricsOverride", **size)
        self._call("Page.navigate", url=uri)
        self.wait("document.readyState === 'complete'")
        time.sleep(0.5)
        return self.value(CUT_OFF)

    def value(self, expression):
        """Value of a JavaScript expression."""
        result = self._call("Runtime.evaluate", expression=expression, returnByValue=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def wait(self, expression, seconds=30.0):
        end = time.monotonic() + seconds
        while not self.value(expression):
            assert time.monotonic() < end, f"{expression}: not so after {seconds} s"
            time.sleep(0.02)

    def drag(self, element, share):
        """Drag the thumb of a slider from its middle to a share of its width."""
        box = f"document.getElementById({json.dumps(element)})"
        self.value(f"{box}.scrollIntoView({{block: 'center'}})")
        x, y, w, h = self.value(f"(r => [r.x, r.y, r.width, r.height])({box}.getBoundingClientRect())")
        pointer = {"y": y + h / 2, "button": "left", "clickCount": 1}
        self._call("Input.dispatchMouseEvent", type="mousePressed", x=x + w / 2, **pointer)
        for part in (0.25, 0.5, 0.75, 1.0):
            at = x + w * (0.5 + part * (share - 0.5))
            self._call("Input.dispatchMouseEvent", type="mouseMoved", x=at, buttons=1, **pointer)
        self._call("Input.dispatchMouseEvent", type="mouseReleased", x=at, **pointer)

    def close(self):
        with contextlib.suppress(OSError):
            os.close(self._write)
        self._process.terminate()
        self._process.wait(20)
        os.close(self._read)
