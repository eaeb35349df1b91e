# SPDX-License-Identifier: MIT
"""Chromium without a window, driven through its debugging pipe. Standard library only."""
import base64
import fcntl
import json
import os
import shutil
import subprocess
import tempfile
import time

PROGRAM = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)


class Page:
    """One page of a browser without network. Errors and warnings of its console are in `complaints`."""

    def __init__(self, width=1280, height=860):
        self.profile = tempfile.mkdtemp(prefix="topoadapt-chromium-")
        to_read, self.to = os.pipe()
        self.back, to_write = os.pipe()

        def pipes():
            # By way of high numbers, since 3 and 4 may be taken by these pipes.
            high = [fcntl.fcntl(end, fcntl.F_DUPFD, 100) for end in (to_read, to_write)]
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        self.browser = subprocess.Popen(
            [PROGRAM, "--headless", "--no-sandbox", "--remote-debugging-pipe", "--user-data-dir=" + self.profile,
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars", "--disable-dev-shm-usage",
             "--no-first-run", "--disable-background-networking", f"--window-size={width},{height}", "about:blank"],
            preexec_fn=pipes, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(to_write)
        self.left, self.number, self.session = b"", 0, None
        self.complaints, self.requests = [], []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.call("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=0, uploadThroughput=0)
        self.size(width, height)

    def close(self):
        try:
            self.session = None
            self.call("Browser.close")
            self.browser.wait(20)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self.browser.kill()
            self.browser.wait()
        os.close(self.to)
        os.close(self.back)
        shutil.rmtree(self.profile, ignore_errors=True)

    def message(self):
        while b"\0" not in self.left:
            more = os.read(self.back, 1 << 20)
            if not more:
                raise RuntimeError("the browser has ended")
            self.left += more
        text, self.left = self.left.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        self.number += 1
        order = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            order["sessionId"] = self.session
        os.write(self.to, json.dumps(order).encode() + b"\0")
        while True:
            answer = self.message()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(method + ": " + str(answer["error"]))
                return answer["result"]
            self.note(answer.get("method"), answer.get("params", {}))

    def note(self, method, told):
        if method == "Runtime.exceptionThrown":
            self.complaints.append(str(told["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.complaints.append(str([a.get("value", a.get("description")) for a in told["args"]]))
        elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            # Software rendering is slow at reading back pictures, and says so.
            if "ReadPixels" not in told["entry"]["text"]:
                self.complaints.append(told["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(told["request"]["url"][:200])

    def size(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.settle()

    def run(self, script):
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(script + ": " + str(answer["exceptionDetails"]))
        return answer["result"].get("value")

    def open(self, path, seconds=300):
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        self.until("document.body && document.body.dataset.ready === 'yes'", seconds)
        self.settle()

    def until(self, condition, seconds=300):
        end = time.monotonic() + seconds
        while not self.run(condition):
            if time.monotonic() > end:
                raise RuntimeError("never true: " + condition + " " + str(self.complaints))
            time.sleep(0.05)

    def settle(self):
        """Two pictures later."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def drag(self, selector, dx, dy):
        x, y = self.run(f"(() => {{ const b = document.querySelector('{selector}').getBoundingClientRect();"
                        "return [b.x + b.width / 2, b.y + b.height / 2]; })()")
        for kind, at in (("mousePressed", (x, y)), ("mouseMoved", (x + dx, y + dy)), ("mouseReleased", (x + dx, y + dy))):
            self.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left", buttons=1, clickCount=1)

    def slide(self, selector, value):
        self.run(f"(() => {{ const s = document.querySelector('{selector}'); s.value = {value};"
                 "s.dispatchEvent(new Event('input', {bubbles: true})); })()")

    def screenshot(self):
        self.settle()
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
