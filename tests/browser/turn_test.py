#!/usr/bin/env python3
"""Opens a report of driven linkages in headless Chromium and reads it.

turn_test.py REPORT.html [--screenshots FOLDER]

Exit status 77 where chromium or chromedriver is not installed, which ctest counts as skipped.
"""

import sys
import time

import page
from page import FLEXURE_PATHS, UNTIDY, PageTest

# Of a section every chart: its title and the number of its lines.
CHARTS = """
  return [...document.querySelectorAll(arguments[0] + ' .chart:not(.surface)')].map((chart) => [
    chart.querySelector('figcaption').textContent,
    chart.querySelectorAll('.chart-lines > g').length,
  ]);
"""

# How far apart places of the figure are on the screen: the crank's pin from its shaft.
CRANK = """
  const turn = Turn.unpack(State.chosen.study.linkage);
  const [x, y] = Turn.rigidAt(turn, arguments[0]).flexures[0][0];
  return [Math.hypot(x, y), Math.atan2(y, x) * 180 / Math.PI];
"""

# The colour of the sheet at shares of the surface's width and height.
PIXEL = """
  const sheet = document.querySelector('.surface-sheet');
  const copy = document.createElement('canvas'); // of the one pixel, to read that alone
  const context = copy.getContext('2d');
  context.drawImage(sheet, -Math.round(arguments[0] * sheet.width),
    -Math.round(arguments[1] * sheet.height));
  const [r, g, b] = context.getImageData(0, 0, 1, 1).data;
  return [r, g, b];
"""

POINT = """
  const frame = document.querySelector(arguments[0]);
  const box = frame.getBoundingClientRect();
  frame.dispatchEvent(new PointerEvent('pointermove', { bubbles: true,
    clientX: box.left + arguments[1] * box.width, clientY: box.top + arguments[2] * box.height }));
  return frame.querySelector('.chart-tip').textContent;
"""


class TurnTest(PageTest):
    def setUp(self):
        super().setUp()
        self.open_study("turn")
        time.sleep(0.2)

    def charts(self, selector):
        self.drawn(f"{selector} .chart-line")
        return self.browser.script(CHARTS, selector)

    def click(self, selector):
        self.browser.script("document.querySelector(arguments[0]).click()", selector)
        time.sleep(0.1)

    def test_the_linkage_turns(self):
        shapes = []
        for share in (0.0, 0.301, 0.303, 0.9):
            self.seek(share)
            for selector in (".bodies path", ".connections path", ".traces path",
                             ".rigid-ways path", ".ghost-flexures path", ".ground-line"):
                self.assertGreater(len(self.drawn(selector)), 0, selector)
            shapes.append([path["d"] for path in self.browser.script(FLEXURE_PATHS)])
        for before, after in zip(shapes, shapes[1:]):
            self.assertNotEqual(before, after)
        self.assertFalse(any("NaN" in d or not d for shape in shapes for d in shape))
        # Two flexures by each of the three methods that have a motion.
        self.assertEqual(6, len(shapes[0]))
        self.assertEqual("crank angle324.0°", "".join(self.texts(".readout > *")))

    def test_a_crank_keeps_its_length_between_solved_angles(self):
        for angle in (0.0, 2.5, 91.7, 177.3, 357.5):
            length, turned = self.browser.script(CRANK, angle)
            self.assertAlmostEqual(10.0, length, delta=1e-3)
            self.assertAlmostEqual(angle, turned % 360, delta=0.01)

    def test_play_goes_round(self):
        self.choose("#speed", self.texts("#speed option").index("a turn in 2 s"))
        self.seek(0.97)
        self.click("#play")
        for _ in range(30):
            time.sleep(0.1)
            if self.browser.script("return State.chosen.position") < 180:
                break
        self.assertLess(self.browser.script("return State.chosen.position"), 180)
        self.assertEqual(1, self.count(".play.is-playing"))
        self.click("#play")

    def test_deflections_are_exaggerated(self):
        self.assertEqual(["×2"], self.texts(".exaggeration-value"))
        before = self.drawn(".flexures path")
        still = self.drawn(".ghost-flexures path")
        self.browser.script("const s = document.getElementById('exaggeration'); s.value = s.max;"
                            "s.dispatchEvent(new Event('input'))")
        self.assertNotEqual(before, self.drawn(".flexures path"))
        self.assertEqual(still, self.drawn(".ghost-flexures path"))
        self.assertNotEqual(["×2"], self.texts(".exaggeration-value"))

    def test_traces_are_chosen(self):
        self.assertEqual(["all", "tip.P", "crank", "piston", "tip", "none"],
                         self.texts("#traced option"))
        self.assertEqual(4, self.count(".rigid-ways path"))
        self.assertEqual(12, self.count(".traces .trace"))
        self.choose("#traced", 1)
        self.assertEqual(1, self.count(".rigid-ways path"))
        self.choose("#traced", 5)
        self.assertEqual(0, self.count(".traces path"))

    def test_frequencies_in_both_units(self):
        self.assertEqual([["Frequency, Hz", 3]], self.charts(".frequencies"))
        tip = self.browser.script(POINT, ".frequencies .chart-frame", 0.5, 0.5)
        self.assertRegex(tip, r"mode 1.*Hz · .*rad/s")
        self.click("[name=frequency-unit][value=angular]")
        self.choose("#mode-count", 3)
        self.assertEqual([["Frequency, rad/s", 4]], self.charts(".frequencies"))

    def test_every_flexure_has_its_curves_and_peaks(self):
        charts = self.charts(".curves")
        self.assertEqual(["rod", "leaf"], self.texts(".curves h3"))
        self.assertEqual(6, len(charts))
        self.assertEqual(["Deflection at mid-length, mm", 3], charts[1])
        self.assertIn("360", self.texts(".curves .chart-axis text"))
        self.assertEqual(6, self.count("#turn-peaks tbody tr"))
        self.assertIn("−0.3000at 90°", self.texts("#turn-peaks td"))
        self.assertIn("strength / stress", self.texts("#turn-peaks .unit"))

    def test_a_chart_turns_the_linkage(self):
        self.browser.script(
            "const f = document.querySelector('.curves .chart-frame');"
            "const b = f.getBoundingClientRect();"
            "f.dispatchEvent(new PointerEvent('pointerdown', { clientX: b.left + 0.6 * b.width }))")
        position = self.browser.script("return State.chosen.position")
        self.assertTrue(90 < position < 270, position)

    def test_stress_has_a_surface(self):
        # The rod's fibre on +n by the periodic solution: pulled about 260 degrees, pushed about 90.
        pulled = self.browser.script(PIXEL, 0.69, 0.45)
        pushed = self.browser.script(PIXEL, 0.30, 0.45)
        self.assertGreater(pulled[0], pulled[2] + 60)
        self.assertGreater(pushed[2], pushed[0] + 20)
        self.click("[name=fibre][value=lower]")
        other = self.browser.script(PIXEL, 0.69, 0.45)
        self.assertGreater(other[2], other[0])
        tip = self.browser.script(POINT, ".surface .chart-frame", 0.5, 0.5)
        self.assertRegex(tip, r"crank angle \d+.*, s .* mm.*N/mm²")
        self.assertEqual(["quasi_static", "periodic", "midha"],
                         self.texts("#surface-method option"))
        self.choose("#surface-flexure", 1)
        self.assertIn("of leaf", self.texts(".surface figcaption")[0])

    def test_orbits_of_points_and_bodies(self):
        charts = self.charts(".orbits")
        self.assertEqual([3, 3, 3], [lines for _, lines in charts])
        self.assertEqual(["tip.P", "crank", "piston", "tip"], self.texts("#subject option"))
        before = self.drawn(".orbits .chart-line")
        self.choose("#subject", 3)
        self.assertNotEqual(before, self.drawn(".orbits .chart-line"))

    def test_rays_meet_bands(self):
        ((title, rays),) = self.charts(".campbell")
        self.assertEqual("Frequency, Hz", title)
        self.assertGreaterEqual(rays, 4)
        self.assertEqual(3, self.count(".campbell .band"))
        self.assertIn("1×", self.texts(".campbell .ray-name"))

    def test_stability(self):
        self.assertIn("largest multiplier is 1.15: the periodic motion is unstable",
                      self.texts(".verdict")[0])
        self.assertEqual(3, self.count("#multipliers tbody tr"))
        plane, size, strain = self.charts(".stability")
        self.assertEqual(("Largest size of a multiplier", 1), tuple(size))
        self.assertEqual(("Largest bending strain in the turn", 2), tuple(strain))
        # Five multipliers, and two speeds that are unstable; three more buckle.
        self.assertEqual(7, self.count(".stability .chart-event"))
        self.assertEqual(10, self.count(".stability .unstable-range"))
        self.assertIn("2 of 25 speeds are unstable, between 1600 and 1700 rpm",
                      " ".join(self.texts(".stability .hint")))

    def test_the_unit_circle_is_round(self):
        box = self.browser.script(
            "const b = document.querySelector('.stability .chart-line').getBBox();"
            "return [b.width, b.height]")
        self.assertAlmostEqual(box[0], box[1], delta=0.5)

    def test_what_drives_and_shakes(self):
        self.assertEqual([1, 3, 1, 1], [lines for _, lines in self.charts(".rigid")])

    def test_facts_and_costs(self):
        facts = " ".join(self.texts(".linkage-facts div"))
        for words in ("motor", "600 rpm", "crank-rocker", "0.02 of critical", "3.44 times"):
            self.assertIn(words, facts)
        self.assertEqual(2, self.count(".findings li"))
        cells = self.texts("#comparison td")
        for words in ("10 turns", "61.0 %", "reference", "stopped", "2.0 %"):
            self.assertIn(words, cells)
        notes = " ".join(self.texts("#comparison .note"))
        self.assertIn("The coupling terms are not small", notes)
        self.assertIn("It did not settle within 400 turns", notes)

    def test_a_method_is_hidden_everywhere(self):
        before = self.charts(".curves")[0][1]
        self.click("[data-toggle=quasi_static]")
        self.assertEqual(before - 1, self.charts(".curves")[0][1])
        self.assertEqual(4, len(self.browser.script(FLEXURE_PATHS)))
        self.assertEqual(2, self.charts(".orbits")[0][1])
        self.click("[data-toggle=quasi_static]")

    def test_one_method_and_no_speeds(self):
        self.open_study("slow")
        time.sleep(0.2)
        self.assertEqual(2, len(self.browser.script(FLEXURE_PATHS)))
        self.assertEqual(0, self.count(".stability") + self.count(".campbell"))
        self.assertEqual(3, len(self.charts(".rigid")))

    def test_what_never_ran_says_why(self):
        self.open_study("jammed")
        time.sleep(0.2)
        self.assertIn("cannot be put together", self.texts(".study-stopped")[0])
        self.assertEqual(2, len(self.drawn(".still-flexures path")))
        self.assertEqual(0, self.count(".chart") + self.count(".transport"))
        self.assertIn("motor", " ".join(self.texts(".linkage-facts dd")))

    def test_texts_are_tidy_at_common_sizes(self):
        for width in (1100, 1280, 1920, 400):
            self.browser.resize(width, 900)
            for study in self.studies:
                with self.subTest(width=width, study=study):
                    self.open_study(study)
                    self.assertEqual([], self.browser.script(UNTIDY))
        self.browser.resize(1280, 900)


if __name__ == "__main__":
    sys.exit(page.main(__name__, __doc__))
