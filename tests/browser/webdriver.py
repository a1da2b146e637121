"""A headless Chromium driven through chromedriver: plain HTTP and JSON, standard library only."""

import base64
import json
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

CHROMIUM_FLAGS = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-dev-shm-usage", "--hide-scrollbars", "--force-device-scale-factor=1",
]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Browser:
    """Use as a context: the browser, its driver and its profile folder are gone afterwards."""

    def __init__(self, width=1280, height=900, dark=False):
        self.size = (width, height)
        self.dark = dark

    def __enter__(self):
        self.profile = tempfile.mkdtemp(prefix="flexura-browser-")
        try:
            self._start()
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def _start(self):
        port = free_port()
        self.address = f"http://127.0.0.1:{port}"
        self.driver = subprocess.Popen(
            ["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        self._wait_until_ready()
        width, height = self.size
        flags = CHROMIUM_FLAGS + [f"--user-data-dir={self.profile}",
                                  f"--window-size={width},{height}"]
        if self.dark:
            flags.append("--blink-settings=preferredColorScheme=0")
        capabilities = {
            "browserName": "chrome",
            "goog:chromeOptions": {"args": flags},
            "goog:loggingPrefs": {"browser": "ALL"},
        }
        answer = self._call("POST", "/session", {"capabilities": {"alwaysMatch": capabilities}})
        self.session = "/session/" + answer["sessionId"]
        self.resize(width, height)

    def __exit__(self, *_):
        if getattr(self, "session", None):
            try:
                self._call("DELETE", self.session)
            except (OSError, RuntimeError):
                pass  # the driver is ended below in any case
        if getattr(self, "driver", None):
            self.driver.terminate()
            self.driver.wait(timeout=20)
        shutil.rmtree(self.profile, ignore_errors=True)

    def _wait_until_ready(self):
        for _ in range(100):
            try:
                if self._call("GET", "/status")["ready"]:
                    return
            except OSError:
                time.sleep(0.1)
        raise RuntimeError("chromedriver did not become ready")

    def _call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.address + path, data, method=method,
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=90) as response:
                return json.load(response)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def open(self, address):
        self._call("POST", self.session + "/url", {"url": address})

    def resize(self, width, height):
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.devtools("Emulation.setDeviceMetricsOverride", metrics)

    def devtools(self, command, parameters):
        return self._call("POST", self.session + "/goog/cdp/execute",
                          {"cmd": command, "params": parameters})

    def script(self, source, *arguments):
        """The value that the body of a JavaScript function returns."""
        return self._call("POST", self.session + "/execute/sync",
                          {"script": source, "args": list(arguments)})

    def log(self):
        return self._call("POST", self.session + "/se/log", {"type": "browser"})

    def screenshot(self, file, whole_page=True):
        if whole_page:
            width, height = self.size
            self.resize(width, max(height, self.script(
                "return document.documentElement.scrollHeight")))
            time.sleep(0.3)
        picture = self._call("GET", self.session + "/screenshot")
        pathlib.Path(file).write_bytes(base64.b64decode(picture))
        if whole_page:
            self.resize(*self.size)
