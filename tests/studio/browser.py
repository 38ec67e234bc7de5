"""browser.py -- Debian's Chromium without a window, over its debugging pipe.

    with Browser(folder) as browser:
        page = browser.open(address)
        page.wait("document.body.dataset.shown === '1'")
        page.drag([(100, 100), (200, 120)])
        page.screenshot("page.png")

Chromium reads commands from its descriptor 3 and writes answers to 4, each a
JSON text that ends with a NUL: nothing but the standard library is needed.
"""

import base64
import json
import os
import select
import shutil
import subprocess
import time

FLAGS = [
    "--headless", "--no-sandbox", "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run",
    "--disable-background-networking", "--force-device-scale-factor=1",
    "--remote-debugging-pipe", "--disable-dev-shm-usage",
]


def find():
    return shutil.which("chromium") or shutil.which("google-chrome")


class Page:
    def __init__(self, browser, session):
        self.browser, self.session = browser, session

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def run(self, script):
        """The value of a script, which may await."""
        done = self.call(
            "Runtime.evaluate", expression=script, awaitPromise=True,
            returnByValue=True)
        if "exceptionDetails" in done:
            raise AssertionError(
                f"{script}: {done['exceptionDetails']['exception']}")
        return done["result"].get("value")

    def wait(self, condition, seconds=90):
        end = time.monotonic() + seconds
        while not self.run(condition):
            if time.monotonic() > end:
                raise AssertionError(
                    f"not after {seconds} s: {condition}; "
                    + str(self.run("document.body.innerText")))
            time.sleep(.05)

    def mouse(self, kind, x, y, button="left", **more):
        self.call(
            "Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button,
            buttons=0 if kind == "mouseReleased" else 1, clickCount=1, **more)

    def drag(self, path):
        self.mouse("mousePressed", *path[0])
        for x, y in path[1:]:
            self.mouse("mouseMoved", x, y)
        self.mouse("mouseReleased", *path[-1])

    def move(self, x, y):
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def click(self, x, y):
        self.drag([(x, y)])

    def press(self, selector):
        self.run(f"document.querySelector({selector!r}).click()")

    def key(self, key, code="", modifiers=0):
        for kind in ("keyDown", "keyUp"):
            self.call(
                "Input.dispatchKeyEvent", type=kind, key=key, code=code,
                modifiers=modifiers)

    def touch(self, kind, points):
        self.call(
            "Input.dispatchTouchEvent", type=kind,
            touchPoints=[{"x": x, "y": y, "id": i}
                         for i, (x, y) in enumerate(points)])

    def size(self, width, height, mobile=False):
        self.call(
            "Emulation.setDeviceMetricsOverride", width=width, height=height,
            deviceScaleFactor=1, mobile=mobile)

    def screenshot(self, path):
        data = self.call("Page.captureScreenshot", format="png")["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

    def reload(self):
        self.run("window.stale = true")
        self.call("Page.reload")
        self.wait("!window.stale && document.readyState === 'complete'")

    def close(self):
        self.call("Page.close")


class Browser:
    def __init__(self, folder, size=(1280, 800)):
        self.count, self.rest = 0, b""
        self.console = []
        mine_in, theirs_out = os.pipe()
        theirs_in, mine_out = os.pipe()
        self.reads, self.writes = mine_in, mine_out

        def descriptors():
            # Whatever numbers they have, they are to be 3 and 4.
            a, b = os.dup(theirs_in), os.dup(theirs_out)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self.process = subprocess.Popen(
            [find(), *FLAGS, f"--window-size={size[0]},{size[1]}",
             f"--user-data-dir={folder}", "about:blank"],
            preexec_fn=descriptors, close_fds=False,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(theirs_in)
        os.close(theirs_out)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(20)
        os.close(self.reads)
        os.close(self.writes)

    def receive(self, seconds):
        end = time.monotonic() + seconds
        while b"\0" not in self.rest:
            ready, _, _ = select.select(
                [self.reads], [], [], max(0, end - time.monotonic()))
            if not ready:
                raise AssertionError("the browser does not answer")
            data = os.read(self.reads, 1 << 20)
            if not data:
                raise AssertionError("the browser has ended")
            self.rest += data
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, session=None, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.writes, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive(120)
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']}")
                return answer["result"]
            if answer.get("method") == "Runtime.exceptionThrown":
                self.console.append(answer["params"]["exceptionDetails"])
            if answer.get("method") == "Log.entryAdded":
                self.console.append(answer["params"]["entry"])

    def open(self, address, size=(1280, 800)):
        target = self.call("Target.createTarget", url=address)["targetId"]
        session = self.call(
            "Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = Page(self, session)
        page.call("Page.enable")
        page.call("Runtime.enable")
        page.call("Log.enable")
        page.size(*size)
        page.wait("location.protocol === 'http:' &&"
                  " document.readyState === 'complete'")
        return page
