"""What the tests of a report share: the page in headless Chromium, and what readers do with it.

A test is called as: NAME_test.py REPORT.html [--screenshots FOLDER]
Exit status 77 where chromium or chromedriver is not installed, or localhost has no address, which
ctest counts as skipped.
"""

import argparse
import pathlib
import shutil
import socket
import sys
import time
import unittest

from webdriver import Browser

SKIPPED = 77
report = None

SEEK = """
  const slider = document.getElementById('load-slider');
  slider.value = arguments[0] * slider.max;
  slider.dispatchEvent(new Event('input'));
"""
FLEXURE_PATHS = """
  return [...document.querySelectorAll('.flexures path')].map((path) => {
    const box = path.getBBox();
    return { modeling: path.dataset.modeling, d: path.getAttribute('d'),
             size: Math.max(box.width, box.height) };
  });
"""
STUDIES = "return [...document.querySelectorAll('#tabs button')].map((tab) => tab.dataset.study);"

# Texts that stick out of the page or of what clips them, and texts that lie on one another.
UNTIDY = r"""
  const visible = (e) => e.getClientRects().length > 0 && !e.closest('.chart-tip, .table-frame');
  const leaves = [...document.querySelectorAll('body *')].filter((e) => visible(e)
    && !['SCRIPT', 'STYLE', 'OPTION', 'OPTGROUP', 'SELECT', 'TITLE'].includes(e.tagName)
    && [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim()));
  const found = [];
  const name = (e) => `${e.tagName} "${e.textContent.trim().slice(0, 40)}"`;
  const boxes = leaves.map((e) => {
    const range = document.createRange();
    range.selectNodeContents(e);
    return { e, box: range.getBoundingClientRect() };
  });
  const drawn = (e) => e.closest('.view-svg') !== null;
  for (const { e, box } of boxes) {
    const svg = e.closest('svg');
    const frame = svg ? svg.getBoundingClientRect()
      : { left: 0, right: document.documentElement.clientWidth };
    if (box.left < frame.left - 1 || box.right > frame.right + 1) {
      found.push(`${name(e)} sticks out`);
    }
    if (svg && !drawn(e) && (box.top < frame.top - 2 || box.bottom > frame.bottom + 2)) {
      found.push(`${name(e)} is cut off`);
    }
  }
  // Names in the drawing lie where the mechanism is; all other texts keep clear of each other.
  const placed = boxes.filter(({ e }) => !drawn(e));
  for (let i = 0; i < placed.length; ++i) {
    for (let j = i + 1; j < placed.length; ++j) {
      const [a, b] = [placed[i], placed[j]];
      if (a.e.contains(b.e) || b.e.contains(a.e)) continue;
      const w = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left);
      const h = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
      if (w > 1.5 && h > 3) found.push(`${name(a.e)} lies on ${name(b.e)}`);
    }
  }
  if (document.documentElement.scrollWidth > document.documentElement.clientWidth) {
    found.push('the page scrolls sideways');
  }
  return found;
"""


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(1280, 900)
        cls.browser.__enter__()
        cls.addClassCleanup(cls.browser.__exit__, None, None, None)

    def setUp(self):
        self.browser.open(report.as_uri())
        time.sleep(0.2)
        self.studies = self.browser.script(STUDIES)

    def tearDown(self):
        entries = [e for e in self.browser.log() if e["level"] in ("SEVERE", "WARNING")]
        self.assertEqual([], entries, "the console must stay silent")
        requests = self.browser.script(
            "return performance.getEntriesByType('resource').map((e) => e.name)")
        self.assertEqual([], requests, "the page must ask the network for nothing")

    def open_study(self, name):
        self.browser.script(
            "[...document.querySelectorAll('#tabs button')]"
            ".find((tab) => tab.dataset.study === arguments[0]).click()", name)
        time.sleep(0.15)

    def kind(self):
        return self.browser.script(
            "return document.querySelector('[aria-selected=true]').dataset.kind")

    def seek(self, share):
        self.browser.script(SEEK, share)
        time.sleep(0.1)

    def drawn(self, selector):
        """The outlines of what is drawn, all of which must be numbers."""
        paths = self.browser.script(
            "return [...document.querySelectorAll(arguments[0])]"
            ".map((path) => path.getAttribute('d'))", selector)
        self.assertFalse(any("NaN" in d or not d for d in paths), selector)
        return paths

    def count(self, selector):
        return self.browser.script(
            "return document.querySelectorAll(arguments[0]).length", selector)

    def texts(self, selector):
        return self.browser.script(
            "return [...document.querySelectorAll(arguments[0])].map((e) => e.textContent)",
            selector)

    def choose(self, selector, index):
        self.browser.script(
            "const s = document.querySelector(arguments[0]); s.selectedIndex = arguments[1];"
            "s.dispatchEvent(new Event('change'))", selector, index)
        time.sleep(0.1)


def take_screenshots(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for dark in (False, True):
        with Browser(1280, 900, dark) as browser:
            browser.open(report.as_uri())
            for number, study in enumerate(browser.script(STUDIES)):
                browser.script("document.querySelectorAll('#tabs button')[arguments[0]].click()",
                               number)
                time.sleep(0.3)
                theme = "dark" if dark else "light"
                plain = "".join(c if c.isalnum() else "_" for c in study)
                browser.screenshot(folder / f"{number}_{plain}_{theme}.png")


def hindrance():
    """Why no browser can be driven here; empty if one can."""
    missing = [tool for tool in ("chromium", "chromedriver") if shutil.which(tool) is None]
    if missing:
        return (f"{' and '.join(missing)} not installed "
                "(Debian packages chromium, chromium-driver)")
    try:
        socket.getaddrinfo("localhost", None)
    except OSError:  # as in a fresh chroot; the driver then does not reach its browser
        return "the name localhost is unknown (a line '127.0.0.1 localhost' in /etc/hosts)"
    return ""


def main(module, description):
    global report
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("report", type=pathlib.Path)
    parser.add_argument("--screenshots", type=pathlib.Path)
    options = parser.parse_args()
    if hindrance():
        print(f"skipped: {hindrance()}")
        return SKIPPED
    report = options.report.resolve(strict=True)
    if options.screenshots:
        take_screenshots(options.screenshots)
    outcome = unittest.main(module=module, argv=[sys.argv[0]], exit=False).result
    return 0 if outcome.wasSuccessful() else 1

